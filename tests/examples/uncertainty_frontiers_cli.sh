#!/usr/bin/env bash
# The command line of uncertainty_frontiers: what it refuses, what it writes, and that runs repeat.
# Usage: uncertainty_frontiers_cli.sh PATH_OF_UNCERTAINTY_FRONTIERS
set -u
program=$(realpath "$1")
if ! command -v gnuplot >/dev/null; then
  echo "uncertainty_frontiers: skipped, gnuplot is missing"
  exit 77
fi
source "$(dirname "$(realpath "$0")")/cli.sh"
mkdir run
cd run

refused "an experiment that is not there" experiment --experiment alchemy
refused "no seeds" seeds --seeds 0
refused "seeds that are no number" seeds --seeds some
refused "negative threads" threads --threads -1
refused "an unknown option" --frobnicate --frobnicate
output=/dev/null/x refused "an output below a file" /dev/null/x
refused "an output without a name" --output --output ""

mkdir -p blocked/corridors.csv
output=blocked refused "a result whose name is a folder" corridors.csv --experiment corridors --seeds 1
rm -r blocked

help_names help experiment seeds threads output quiet

run() { run_quietly "$@"; }
run figures --experiment figures
[ "$(ls -A figures)" = figures.png ] && [ -s figures/figures.png ] || fail "other figures than promised: $(ls -A figures)"
run one --experiment corridors --seeds 2 --threads 1
run two --experiment corridors --seeds 2 --threads 2
cmp -s one/corridors.csv two/corridors.csv || fail "corridors.csv differs with the number of threads"
for file in corridors.csv corridors_around.png corridors_home.png; do
  [ -s one/$file ] || fail "$file is missing or empty"
done
[ "$(ls -A one | wc -l)" -eq 3 ] || fail "other files than promised: $(ls -A one)"
[ "$(tail -n +2 one/corridors.csv | wc -l)" -eq 4 ] || fail "corridors.csv has not two rows for each of 2 seeds"

[ $failures -eq 0 ] && echo "uncertainty_frontiers: the command line is as promised"
exit $((failures > 0))
