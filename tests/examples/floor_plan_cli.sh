#!/usr/bin/env bash
# The command line of floor_plan: what it refuses, what it writes, and that plans repeat.
# Usage: floor_plan_cli.sh PATH_OF_FLOOR_PLAN
set -u
program=$(realpath "$1")
source "$(dirname "$(realpath "$0")")/cli.sh"
mkdir run
cd run

refused "a plan that is not there" plan --plan castle
refused "a size of one number" '--size: "40" is not of the form X,Y' --size 40
refused "a size of words" '--size: "wide,high" is not of the form' --size wide,high
refused "a size of nothing" size --size ""
refused "a building that is too small" "size_m is 5, but must be at least" --size 5,40
refused "a building that is too large" "size_m is 5000, but must be at most 40000 cells" --size 5000,40
refused "more pixels than a file holds" "plan.png: the image has 30000 x 30000 pixels" --size 1500,1500
refused "a seed that is none" seed --seed -1
refused "a resolution of 0" "resolution_m is 0, but must be finite and > 0" --resolution 0
refused "a door that the robot does not pass" "door_m is 0.9, but must be at least 1.1" --radius 0.5
refused "a radius that is no number" radius --radius wide
refused "a probability above 1" "hall_chance is 1.5, but must be 0 to 1" --halls 1.5
refused "furniture below 0" "furniture_share is -1, but must be 0 to 1" --furniture -1
refused "a size for a plan that is drawn" "--size is for a generated building, not for rooms-32" --plan rooms-32 --size 40,30
refused "an unknown option" --frobnicate --frobnicate
output=/dev/null/x refused "an output below a file" /dev/null/x
output= refused "an output without a name" --output --output ""
mkdir -p blocked/plan.png
output=blocked refused "a result whose name is a folder" plan.png
rm -r blocked

help_names help plan size seed resolution radius door corridor halls furniture output quiet

run_quietly one --size 40,30 --seed 3
run_quietly same --size 40,30 --seed 3
run_quietly other --size 40,30 --seed 4
for file in plan.yaml plan.png overview.png; do
  [ -s one/$file ] || fail "$file is missing or empty"
  cmp -s one/$file same/$file || fail "$file differs when it is made again"
done
[ "$(ls -A one | wc -l)" -eq 3 ] || fail "other files than promised: $(ls -A one)"
cmp -s one/plan.png other/plan.png && fail "another seed gives the same plan"
grep -q "^resolution: 0.05$" one/plan.yaml || fail "plan.yaml: $(cat one/plan.yaml)"
run_quietly drawn --plan rooms-32
grep -q "^resolution: 0.2$" drawn/plan.yaml || fail "plan.yaml of rooms-32: $(cat drawn/plan.yaml)"
"$program" --size 40,30 --output said >stdout || fail "exit code $?"
grep -q "examples/run --map said/plan.yaml" stdout || fail "does not say how to explore: $(cat stdout)"

[ $failures -eq 0 ] && echo "floor_plan: the command line is as promised"
exit $((failures > 0))
