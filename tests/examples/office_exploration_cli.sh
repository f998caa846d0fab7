#!/usr/bin/env bash
# The command line of office_exploration: what it refuses, what it writes, and that runs repeat.
# Usage: office_exploration_cli.sh PATH_OF_OFFICE_EXPLORATION
set -u
program=$(realpath "$1")
if ! command -v gnuplot >/dev/null; then
  echo "office_exploration: skipped, gnuplot is missing"
  exit 77
fi
source "$(dirname "$(realpath "$0")")/cli.sh"
mkdir run
cd run

refused "an experiment that is not there" experiment --experiment alchemy
refused "no poses" poses --poses 0
refused "negative poses" poses --poses -3
refused "more poses than are allowed" poses --poses 101
refused "poses that are no number" poses --poses some
refused "negative threads" threads --threads -1
refused "an unknown option" --frobnicate --frobnicate
output=/dev/null/x refused "an output below a file" /dev/null/x
refused "an output without a name" --output --output ""

mkdir -p blocked/runs.csv
output=blocked refused "a result whose name is a folder" runs.csv --experiment turtlebot
rm -r blocked

help_names help experiment poses threads output quiet

# run NAME ARGUMENTS...: the cluttered room from two poses into the folder NAME.
run() { run_quietly "$@" --experiment turtlebot --poses 2; }
run one --threads 1
run two --threads 2
for file in runs.csv curves.csv; do
  cmp -s one/$file two/$file || fail "$file differs with the number of threads"
done
for file in runs.csv curves.csv turtlebot_room.png turtlebot_room_ways.png; do
  [ -s one/$file ] || fail "$file is missing or empty"
done
[ "$(ls -A one | wc -l)" -eq 4 ] || fail "other files than promised: $(ls -A one)"

header=experiment,world,strategy,information,navigation,pose,stop_reason,collisions,mapped_fraction,distance_m
header+=,distance_to_90_percent_m,time_s,position_error_max_m
[ "$(head -1 one/runs.csv)" = "$header" ] || fail "the header of runs.csv: $(head -1 one/runs.csv)"
[ "$(tail -n +2 one/runs.csv | wc -l)" -eq 10 ] || fail "runs.csv has not a row for each of 5 choices and 2 poses"
bad=$(awk -F, 'NR > 1 && ($7 !~ /^(complete|nothing_informative)$/ || $8 != 0 || $9 < 0.95 || $11 == "")' one/runs.csv)
[ -z "$bad" ] || fail "not complete, or not without a collision: $bad"
# A belief may take back a cell beside a wall.
awk -F, 'NR > 1 {
  choice = $3 $4 $5
  if (choice == last && ($7 < fraction - 0.005 || $6 != distance + 1)) exit 1
  last = choice
  distance = $6
  fraction = $7
}' one/curves.csv || fail "curves.csv: a curve falls, or has not a row each metre"

[ $failures -eq 0 ] && echo "office_exploration: the command line is as promised"
exit $((failures > 0))
