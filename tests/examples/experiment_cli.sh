#!/usr/bin/env bash
# The command line of experiment: what it refuses before the first unit, that rows depend neither on threads nor on ranks, and that a study
# outlives kills, a full disk and a second process.
# Usage: experiment_cli.sh PATH_OF_EXPERIMENT
set -u
program=$(realpath "$1")
if ! command -v gnuplot >/dev/null; then
  echo "experiment: skipped, gnuplot is missing"
  exit 77
fi
source "$(dirname "$(realpath "$0")")/cli.sh"
mkdir run
cd run
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
data=${INCOGNITA_DATA_DIR:-}
unset INCOGNITA_DATA_DIR

# study NAME LINE...: a small study with lines of its own, which begin at line 20.
study() {
  local name=$1
  shift
  cat >"$name.toml" <<'END'
title = "Tried"
[[map]]
name = "office"
plan = "generated"
width_m = 14
height_m = 12
plan_seed = 2
duration_s = 30
beams = 90
[[method]]
name = "A1"
[[method]]
name = "A5"
[[method]]
name = "B2"
[[trials]]
name = "starts"
starts = [1, 2]
seeds = [1, 2]
END
  printf '%s\n' "$@" >>"$name.toml"
}

refused "no study" study
refused "a study that is not there" nowhere.toml nowhere.toml
echo 'title = ' >broken.toml
refused "a study that is no TOML" "broken.toml:1: is not TOML" broken.toml
study extra '[[method]]' 'name = "A9"'
refused "a method that is not there" 'extra.toml:21: there is no method "A9"' extra.toml
study extra '[[method]]' 'name = "A2"' 'gama = 3'
refused "a setting that is not there" 'extra.toml:22: there is no setting "gama"' extra.toml
study extra '[[method]]' 'name = "A2"' 'gamma = -3'
refused "a setting below its bound" 'extra.toml:22: gamma is -3, but must be in' extra.toml
study extra '[[method]]' 'name = "A2"' 'hits_max = 2.5'
refused "a fraction for a whole number" 'extra.toml:22: hits_max is not a whole number' extra.toml
study extra '[[method]]' 'name = "A2"' 'entropy = "Tsallis"'
refused "a word that is not there" 'extra.toml:22: entropy is "Tsallis", but must be one of behavioral' extra.toml
study extra '[[method]]' 'name = "A5"'
refused "a method twice" 'extra.toml:21: name is "A5", which another has already' extra.toml
study extra '[[method]]' 'name = "A1b"' 'like = "A1"' 'decision_cells = "log-odds"'
refused "a composition that is none" 'has decision_cells of its own' extra.toml
study extra '[[map]]' 'name = "lost"' 'file = "nowhere.yaml"'
refused "a map that is not there" 'extra.toml:22: there is no file "nowhere.yaml"' extra.toml
study extra '[[map]]' 'name = "castle"' 'plan = "castle"'
refused "a plan that is not there" 'extra.toml:22: plan is "castle", but must be one of generated' extra.toml
study extra '[[map]]' 'name = "huge"' 'plan = "generated"' 'width_m = 5000' 'height_m = 20' 'plan_seed = 1'
refused "a plan that is too large" 'extra.toml:23: width_m is 5000, but must be in 10..500' extra.toml
study extra '[[trials]]' 'name = "more"' 'starts = [0]' 'seeds = [1]'
refused "a start that is none" 'extra.toml:22: starts is 0, but must be in 1..' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "beauty"' 'less = "A5"' 'than = "A1"'
refused "a metric that is not there" 'extra.toml:22: metric is "beauty", but must be one of' extra.toml
study extra '[robots]' 'many = true'
refused "a table that is not there" 'extra.toml:20: there is no key "robots" here' extra.toml
study good
refused "negative threads" threads good.toml --threads -1
output=/dev/null/x refused "an output below a file" /dev/null/x good.toml
rm -f ./*.toml

help_names help data resume report threads output quiet

# What is shipped can be read, and has a report before its first mission; scaling, whose buildings take seconds to make, is alike.
for shipped in quick alpha; do
  "$program" $shipped --quiet --report --output "shipped_$shipped" >stdout 2>stderr || fail "$shipped: $(cat stderr)"
  grep -q '^0 of [1-9][0-9]* missions are in this report\.$' "shipped_$shipped/report.md" || fail "$shipped: the report says something else"
done
if [ -d "$data" ]; then
  for shipped in ablation ablation-paper; do
    "$program" $shipped --quiet --report --data "$data" --output "shipped_$shipped" >stdout 2>stderr || fail "$shipped: $(cat stderr)"
  done
else
  echo "experiment: the studies on floors of KTH are not read, as the data are missing"
fi

# rows FOLDER: in an order of their own.
rows() { sort "$1/results.jsonl"; }

study good '[[claim]]' 'says = "Scans help"' 'metric = "translation_rmse_m"' 'less = "A5"' 'than = "A1"' \
  '[report]' 'tables = ["translation_rmse_m", "explored_fraction"]' 'curves = ["explored_fraction"]'
run_quietly one good.toml --threads 1
run_quietly two good.toml --threads 2
[ "$(wc -l <one/results.jsonl)" -eq 12 ] || fail "not a row for each of 12 units"
[ "$(rows one)" = "$(rows two)" ] || fail "rows differ with the number of threads"
grep -q '^| office | A5 | 4 | ' one/report.md || fail "the report does not say what missions took"
for file in report.md study.json costs.jsonl office_curves.png office_boxes.png office_ways.png; do
  [ -s one/$file ] || fail "$file is missing or empty"
done
grep -q '^| Scans help | translation_rmse_m, A5 - A1 | office | 4 |.*\*\*' one/report.md || fail "the report does not judge the claim"
if command -v mpirun >/dev/null && "$program" --help | grep -q mpirun; then
  mpirun -n 2 "$program" good.toml --quiet --output ranks >stdout 2>stderr || fail "mpirun: exit code $?: $(cat stderr)"
  [ "$(rows one)" = "$(rows ranks)" ] || fail "rows differ on two ranks"
  mpirun -n 2 "$program" nowhere.toml --quiet --output none >stdout 2>stderr && fail "mpirun goes on without a study"
  [ "$(grep -c 'nowhere.toml' stderr)" -ge 1 ] || fail "mpirun does not say that the study is not there"
fi

# What is there is not written over, and what is done is not done again.
"$program" good.toml --quiet --output one >stdout 2>stderr && fail "results are there, and it went on without --resume"
grep -q 'has results already' stderr || fail "it does not say that results are there: $(cat stderr)"
cp one/results.jsonl before.jsonl
run_quietly one good.toml --resume
cmp -s one/results.jsonl before.jsonl || fail "a study that is complete has been run again"
sed -i 's/beams = 90/beams = 91/' good.toml
"$program" good.toml --quiet --output one --resume >stdout 2>stderr && fail "rows of another study are taken"
grep -q 'beams is 91, but was 90' stderr || fail "it does not say what differs: $(cat stderr)"
sed -i 's/beams = 91/beams = 90/' good.toml
sed -i 's/seeds = \[1, 2\]/seeds = [1, 2, 3]/' good.toml
run_quietly one good.toml --resume
[ "$(wc -l <one/results.jsonl)" -eq 18 ] || fail "trials that were added are not run"
sed -i 's/seeds = \[1, 2, 3\]/seeds = [1, 2]/' good.toml

# Killed at ten moments, and gone on with each time.
RANDOM=5
killed=0
"$program" good.toml --quiet --output killed --threads 2 &
for attempt in 1 2 3 4 5 6 7 8 9 10; do
  pid=$!
  sleep "0.$(printf '%03d' $((RANDOM % 400 + 30)))"
  kill -9 $pid 2>/dev/null && killed=$((killed + 1))
  wait $pid 2>/dev/null
  "$program" good.toml --quiet --output killed --threads 2 --resume &
done
wait $! || fail "after ten kills --resume fails"
[ "$(rows one | grep -v '"seed":3')" = "$(rows killed)" ] || fail "rows differ after kills"
echo "experiment: killed $killed times"

# A second process is refused, while the first goes on.
study long
sed -i 's/duration_s = 30/duration_s = 3000/; s/height_m = 12/height_m = 40/; s/width_m = 14/width_m = 60/' long.toml
"$program" long.toml --quiet --output long --threads 1 &
pid=$!
for ((tries = 0; tries < 500; ++tries)); do
  [ -e long/study.json ] && break
  sleep 0.02
done
"$program" long.toml --quiet --output long --resume >stdout 2>stderr && fail "two processes write to one folder"
grep -q 'is in use: another process writes a study there' stderr || fail "the second process does not say why it stops: $(cat stderr)"
kill -9 $pid
wait $pid 2>/dev/null

# A disk that is full after some rows: what was written stays, and it can be gone on with.
(
  trap '' XFSZ
  ulimit -f 16
  "$program" good.toml --quiet --output full --threads 1 >stdout 2>stderr
)
[ $? -eq 2 ] || fail "a full disk is not said by exit code 2"
grep -q 'cannot write full/' stderr || fail "it does not say that the disk is full: $(cat stderr)"
[ "$(tail -c 1 full/results.jsonl | wc -l)" -eq 1 ] || fail "half a row was left"
run_quietly full good.toml --resume
[ "$(rows killed)" = "$(rows full)" ] || fail "rows differ after a full disk"

[ $failures -eq 0 ] && echo "experiment: studies are as promised"
exit $((failures > 0))
