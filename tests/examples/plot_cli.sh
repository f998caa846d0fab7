#!/usr/bin/env bash
# The command line of plot: what it refuses, what it writes, and the numbers of runs that are made up.
# Usage: plot_cli.sh PATH_OF_PLOT
set -u
program=$(realpath "$1")
if ! command -v gnuplot >/dev/null; then
  echo "plot: skipped, gnuplot is missing"
  exit 77
fi
source "$(dirname "$(realpath "$0")")/cli.sh"
mkdir runs run
header=time_s,explored_fraction,map_entropy_bits,position_error_m,three_sigma_m,nees,distance_m

# make_run NAME SEED ALPHA SECONDS FACTOR: each second it explores FACTOR hundredths and drives half a metre.
make_run() {
  local folder=../runs/$1
  mkdir "$folder"
  cat >"$folder/metrics.json" <<JSON
{
  "map": "embedded",
  "seed": $2,
  "alpha": $3,
  "strategy": "online",
  "duration_s": $4.0,
  "distance_m": $(awk -v s="$4" 'BEGIN { print s / 2 }'),
  "collisions": 0,
  "stop_reason": "complete",
  "translation_rmse_m": 0.0$5,
  "heading_rmse_rad": 0.001,
  "nees_mean": null,
  "explored_fraction": 0.$5,
  "wall_time_s": 0.$2
}
JSON
  awk -v header=$header -v seconds="$4" -v factor="$5" 'BEGIN {
    print header
    for (t = 1; t <= seconds; ++t) print t "," factor * t / 100 "," 1000 - factor * t ",0.01,0.05,," t / 2
  }' >"$folder/progress.csv"
  printf 'time_s,candidates,evaluation_time_s\n1,2,0.01\n2,,0.0%s\n3,1,0.9\n' "$5" >"$folder/decisions.csv"
}
cd run
make_run a1 1 0.2 10 2
make_run a2 2 0.2 10 3
make_run a3 3 0.2 6 7
make_run b1 1 3.0 8 1
make_run b2 2 3.0 8 2
make_run b3 3 3.0 8 3
make_run b4 4 3.0 8 4

# broken NAME FILE COMMAND...: a copy of a1 whose FILE is what COMMAND makes of it.
broken() {
  local folder=../runs/$1 file=$2
  shift 2
  cp -r ../runs/a1 "$folder"
  "$@" <../runs/a1/"$file" >"$folder/$file"
}
broken truncated_json metrics.json head -c 60
broken array metrics.json echo '[1, 2]'
broken deep metrics.json awk 'BEGIN { for (i = 0; i < 200000; ++i) printf "[" }'
broken no_duration metrics.json grep -v '"duration_s"'
broken text_rmse metrics.json sed 's/"heading_rmse_rad": 0.001/"heading_rmse_rad": "small"/'
broken huge_number metrics.json sed 's/0.001/1e999/'
broken no_column progress.csv sed 's/three_sigma_m/sigma/'
broken a_word progress.csv sed 's/^4,0.08/4,much/'
broken infinite progress.csv sed 's/^4,0.08/4,inf/'
broken short_line progress.csv sed 's/^5,.*/5,0.1/'
broken backwards progress.csv sed 's/^5,/3,/'
broken no_time progress.csv sed 's/^5,/,/'
broken drives_back progress.csv sed 's/,3$/,1/'
broken no_rows progress.csv head -1
broken empty progress.csv true
broken bad_decision decisions.csv sed 's/0.9/soon/'
for file in metrics.json progress.csv decisions.csv; do
  cp -r ../runs/a1 ../runs/without_$file
  rm ../runs/without_$file/$file
done

refused "no runs" runs
refused "a folder that is not there" "absent: there is no such folder" ../runs/absent
refused "a file for a folder" "metrics.json: is not a folder" ../runs/a1/metrics.json
refused "a folder without a name" runs ""
refused "a folder given twice" "is given twice" ../runs/a1 ../runs/b1 ../runs/../runs/a1/
for file in metrics.json progress.csv decisions.csv; do
  refused "a run without $file" "without_$file/$file: there is no such file" ../runs/a1 ../runs/without_$file
done
refused "a JSON that is cut off" "truncated_json/metrics.json: not valid JSON: cut off or malformed at line 5" ../runs/truncated_json
refused "a JSON of an array" 'is "[1,2]", but must be an object' ../runs/array
refused "a JSON of countless arrays" "nests deeper than 16" ../runs/deep
refused "metrics without a duration" 'lacks "duration_s"' ../runs/no_duration
refused "a metric of words" '"heading_rmse_rad" is ""small"", but must be a number or null' ../runs/text_rmse
refused "a number out of range" "a number is out of range" ../runs/huge_number
refused "a column that is missing" 'must name the column "three_sigma_m"' ../runs/no_column
refused "a word for a number" 'progress.csv: line 5: explored_fraction is "much", but must be a finite number or empty' ../runs/a_word
refused "an infinite value" 'line 5: explored_fraction is "inf"' ../runs/infinite
refused "a line that is short" 'line 6 is "5,0.1" with 2 values, but must have 7' ../runs/short_line
refused "time that goes back" "line 6: time_s is 3, but must be > 4" ../runs/backwards
refused "a line without time" "line 6: time_s is empty" ../runs/no_time
refused "a distance that falls" "line 7: distance_m is 1, but must be >= 2.5" ../runs/drives_back
refused "no rows" "progress.csv: holds no rows" ../runs/no_rows
refused "an empty table" 'must name the column "time_s"' ../runs/empty
refused "a decision that took no number" 'decisions.csv: line 4: evaluation_time_s is "soon"' ../runs/bad_decision
refused "a key that is not there" 'lacks "gravity", which --group names' ../runs/a1 --group gravity
refused "a key without a name" --group ../runs/a1 --group ""
refused "an unknown option" --frobnicate ../runs/a1 --frobnicate
output=/dev/null/x refused "an output below a file" /dev/null/x ../runs/a1
mkdir -p blocked/plot.csv
output=blocked refused "a result whose name is a folder" plot.csv ../runs/a1
rm -r blocked
for seed in $(seq 10 22); do make_run many$seed $seed $seed 3 1; done
refused "more groups than can be told apart" "13 groups by alpha, but must make at most 12" ../runs/many*

help_names help group output quiet

run() { run_quietly "$@"; }
run both ../runs/a1 ../runs/b1 ../runs/a2 ../runs/b2 ../runs/a3 ../runs/b3 ../runs/b4
run again ../runs/a1 ../runs/b1 ../runs/a2 ../runs/b2 ../runs/a3 ../runs/b3 ../runs/b4
for file in explored.png entropy.png error.png nees.png summary.png plot.csv; do
  [ -s both/$file ] || fail "$file is missing or empty"
done
[ "$(ls -A both | wc -l)" -eq 6 ] || fail "other files than promised: $(ls -A both)"
cmp -s both/plot.csv again/plot.csv || fail "plot.csv is not the same again"

# row FOLDER START END: there is one line that starts so, and the rest of it is END.
row() {
  local rest
  rest=$(grep -F -- "$2" "$1/plot.csv")
  [ "$rest" = "$2$3" ] || fail "plot.csv of $1: \"$rest\" instead of \"$2$3\""
}
[ "$(head -1 both/plot.csv)" = group,quantity,over,at,runs,low,median,high ] || fail "the header of plot.csv: $(head -1 both/plot.csv)"
# Three runs: the least and the greatest. Two are left after 6 s.
row both "alpha=0.2,explored_fraction,time_s,4," 3,0.08,0.12,0.28
row both "alpha=0.2,explored_fraction,time_s,6," 3,0.12,0.18,0.42
row both "alpha=0.2,explored_fraction,time_s,7," 2,0.14,0.175,0.21
row both "alpha=0.2,explored_fraction,distance_m,2," 3,0.08,0.12,0.28
row both "alpha=0.2,explored_fraction,distance_m,4," 2,0.16,0.2,0.24
row both "alpha=0.2,map_entropy_bits,time_s,10," 2,970,975,980
# Four runs: the quartiles, a quarter of the way between the first two.
row both "alpha=3,explored_fraction,time_s,4," 4,0.07,0.1,0.13
row both "alpha=3,position_error_m,time_s,8," 4,0.01,0.01,0.01
row both "alpha=3,three_sigma_m,time_s,8," 4,0.05,0.05,0.05
grep -q "alpha=3,explored_fraction,time_s,9," both/plot.csv && fail "a curve goes on after the end of its runs"
grep -q ",nees," both/plot.csv && fail "there is a NEES without one in the runs"
row both "alpha=0.2,duration_s,end,," 3,6,10,10
row both "alpha=3,explored_fraction,end,," 4,0.175,0.25,0.325
row both "alpha=0.2,decision_time_s,end,," 3,0.02,0.03,0.07
grep -q nees_mean both/plot.csv && fail "a metric of null is in plot.csv"

# One run alone, and runs by another key.
run one ../runs/a1
row one "all,explored_fraction,time_s,4," 1,0.08,0.08,0.08
run by_seed ../runs/a1 ../runs/b1 ../runs/b2 --group seed
row by_seed "seed=1,explored_fraction,time_s,4," 2,0.04,0.06,0.08
row by_seed "seed=2,explored_fraction,time_s,4," 1,0.08,0.08,0.08
run by_two --group seed,alpha ../runs/a1 ../runs/b1
row by_two '"seed=1, alpha=3",explored_fraction,time_s,4,' 1,0.04,0.04,0.04
run together ../runs/a1 ../runs/b1 --group strategy
row together "strategy=online,explored_fraction,time_s,4," 2,0.04,0.06,0.08

[ $failures -eq 0 ] && echo "plot: the command line is as promised"
exit $((failures > 0))
