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
unset INCOGNITA_DATA_DIR

# on_ranks ARGUMENT...: mpirun. Open MPI leaks, in modules that it has unloaded, so that nothing can tell their leaks from ours; the other runs can.
on_ranks() { ASAN_OPTIONS=detect_leaks=0 mpirun "$@"; }

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
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = ["A5"]' 'than = "A1"'
refused "a list of one method" 'extra.toml:23: less must be a method, or a list of two' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = ["A5", "A1"]' 'than = "A1"'
refused "a difference against a method" 'extra.toml:24: a claim compares two methods, or two differences of methods' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = "A5"' 'than = "A5"'
refused "a method against itself" 'extra.toml:24: a claim compares something with itself' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = "A5"' 'than = "A1"' 'maps = []'
refused "a claim on no map" 'extra.toml:25: maps is empty' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "corridor_share"' 'less = "A5"' 'than = "A1"'
refused "corridors that are not asked for" 'extra.toml:22: corridor_share is not measured on the map "office", which has no corridor_max_m' extra.toml
study extra '[report]' 'tables = ["nees", "corridor_share"]'
refused "a table of corridors that are not asked for" 'extra.toml:21: corridor_share is measured on no map' extra.toml
study extra '[report]' 'tables = ["nees", "nees"]'
refused "a table twice" 'extra.toml:21: tables has "nees" twice' extra.toml
study extra '[defaults]' 'filter = "none"'
refused "a filter for all" 'extra.toml:21: filter is for a method to say' extra.toml
study extra '[[map]]' 'name = "m"' 'plan = "embedded"' 'cells = "log-odds"'
refused "cells of a map" 'extra.toml:23: cells is for a method to say' extra.toml
study extra '[[map]]' 'name = "m"' 'plan = "embedded"' 'width_m = "wide"'
refused "a width of a plan that is drawn" 'extra.toml:23: width_m is of generated plans alone' extra.toml
study extra '[[method]]' 'name = "A2"' 'robot_radius_m = 0.3'
refused "a method with a robot of its own" 'extra.toml:22: robot_radius_m is for defaults or a map to say' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = "A5"' 'than = "A1"' 'as = "share"'
refused "a claim of another kind" 'extra.toml:25: as is "share", but must be one of difference, ratio' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = ["A5", "A1"]' 'than = ["B2", "A1"]' 'as = "ratio"'
refused "a ratio of differences" 'extra.toml:25: a ratio is of two methods, not of differences' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "collisions"' 'less = "A5"' 'than = "A1"' 'as = "ratio"'
refused "a ratio to nothing" 'extra.toml:25: collisions may be 0, and has no ratio' extra.toml
study extra '[[claim]]' 'says = "x"' 'metric = "nees"' 'less = "A5"' 'than = "A1"' 'maps = ["castle"]'
refused "a claim on a map that is not there" 'extra.toml:25: maps is "castle", but must be one of office' extra.toml
study extra '[defaults]' 'robot_radius_m = 0.6' 'range_max_m = 0.5'
refused "a robot that sees no further than its body" 'extra.toml:10: A1 on office: ExplorerParams: ' extra.toml
study extra '[defaults]' 'robot_radius_m = 9'
refused "a robot that fits nowhere" 'extra.toml:10: A1 on office: random_start: radius_m is 9' extra.toml
printf 'title = "Like a shipped one"\nlike = "quick"\n[defaults]\nrobot_radius_m = 9\n' >extra.toml
refused "a robot that fits nowhere in a study that is like a shipped one" 'studies/quick.toml:22: A1 on office: random_start' extra.toml
study good
refused "negative threads" threads good.toml --threads -1
output=/dev/null/x refused "an output below a file" /dev/null/x good.toml
rm -f ./*.toml

help_names help data resume report threads output quiet

# What is shipped can be read, and has a report before its first mission; scaling, whose buildings take seconds to make, is alike. Rooms of 8 m stand
# for the floors of KTH.
mkdir -p data/kth
{ printf 'P5 80 80 255\n'; head -c 6400 /dev/zero | tr '\0' '\376'; } >data/kth/room.pgm
for floor in 50052749 50010535_PLAN1 50015848; do
  printf 'image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n' >data/kth/$floor.yaml
done
for shipped in quick alpha ablation ablation-paper cells coupling; do
  "$program" $shipped --quiet --report --data data --output "shipped_$shipped" >stdout 2>stderr || fail "$shipped: $(cat stderr)"
  grep -q '^0 of [1-9][0-9]* missions are in this report\.$' "shipped_$shipped/report.md" || fail "$shipped: the report says something else"
done
cmp -s shipped_cells/study.json shipped_coupling/study.json && fail "studies are all alike"
# A floor of other cells is another, though its pixels are the same.
cp shipped_cells/study.json before.json
sed -i 's/resolution: 0.1/resolution: 0.11/' data/kth/50052749.yaml
"$program" cells --quiet --report --data data --output shipped_cells >stdout 2>stderr || fail "another floor, and no rows yet: $(cat stderr)"
cmp -s before.json shipped_cells/study.json && fail "a map of larger cells has the same checksum"

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
grep -q '^| Scans help | translation_rmse_m, A5 - A1 | \*\*undecided\*\* .*, 2 pairs |' one/report.md || fail "the report does not judge the claim"
if command -v mpirun >/dev/null && "$program" --help | grep -q mpirun; then
  on_ranks -n 2 "$program" good.toml --quiet --output ranks >stdout 2>stderr || fail "mpirun: exit code $?: $(cat stderr)"
  [ "$(rows one)" = "$(rows ranks)" ] || fail "rows differ on two ranks"
  on_ranks -n 2 "$program" nowhere.toml --quiet --output none >stdout 2>stderr && fail "mpirun goes on without a study"
  [ "$(grep -c 'nowhere.toml' stderr)" -ge 1 ] || fail "mpirun does not say that the study is not there"
  sed 's/beams = 90/beams = 91/' good.toml >other.toml
  on_ranks -n 1 "$program" good.toml --quiet --output mixed : -n 1 "$program" other.toml --quiet --output mixed >stdout 2>stderr &&
    fail "a rank with another study takes part"
  grep -q 'rank 1 cannot take part: study ' stderr || fail "it does not say that a rank has another study: $(cat stderr)"
  [ "$(sort mixed/results.jsonl | comm -23 - <(rows one) | wc -l)" -eq 0 ] || fail "a rank with another study has given a row"

  # A rank that is killed takes the others with it; what is done stays.
  for delay in 0.4 0.7 1.0; do
    resume=
    [ -e rank_killed/results.jsonl ] && resume=--resume
    on_ranks -n 2 "$program" good.toml --quiet --output rank_killed $resume >stdout 2>stderr &
    sleep $delay
    pgrep -f "^$program good.toml --quiet --output rank_killed" | tail -1 | xargs -r kill -9
    wait $!
  done
  on_ranks -n 2 "$program" good.toml --quiet --output rank_killed --resume >stdout 2>stderr || fail "after killed ranks --resume fails: $(cat stderr)"
  [ "$(rows one)" = "$(rows rank_killed)" ] || fail "rows differ after killed ranks"
else
  echo "experiment: ranks are not tried, as there is no mpirun"
fi

# A mission that is lost has a row as any other.
study lost '[[method]]' 'name = "A2"' 'position_sigma_max_m = 1e-8'
run_quietly lost lost.toml
[ "$(wc -l <lost/results.jsonl)" -eq 16 ] || fail "not a row for each mission where some are lost"
[ "$(grep '"method":"A2"' lost/results.jsonl | grep -vc '"stop_reason":"out_of_time"')" -eq 4 ] || fail "the rows do not say which missions were lost"

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
  head -n "$(wc -l <killed/results.jsonl)" killed/results.jsonl >"killed_$attempt.jsonl" 2>/dev/null  # whole lines
  "$program" good.toml --quiet --output killed --threads 2 --resume &
done
wait $! || fail "after ten kills --resume fails"
[ "$(rows one | grep -v '"seed":3')" = "$(rows killed)" ] || fail "rows differ after kills"
for attempt in 1 2 3 4 5 6 7 8 9 10; do
  size=$(stat -c %s "killed_$attempt.jsonl")
  cmp -s -n "$size" "killed_$attempt.jsonl" killed/results.jsonl || fail "rows before kill $attempt were lost or written again"
done
[ "$(wc -l <killed/costs.jsonl)" -le $((12 + 2 * killed)) ] || fail "more missions were run again than were under way"
[ $killed -gt 0 ] || fail "no process was killed, so nothing was tried"
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
