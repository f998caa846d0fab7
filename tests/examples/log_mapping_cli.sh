#!/usr/bin/env bash
# The command line of log_mapping: what it refuses, what it writes, and that runs repeat.
# Usage: log_mapping_cli.sh PATH_OF_LOG_MAPPING
set -u
program=$(realpath "$1")
source "$(dirname "$(realpath "$0")")/cli.sh"

# A robot drives 2 m along a room of 8 x 6 m, from its middle, heading for the wall 4 m ahead. 181 beams; a gap ahead
# on the left returns nothing. Odometry is 2 % long. Written as CARMEN log, as JSON, and as JSON with the true poses.
mkdir inputs run
awk -v pi=3.14159265358979 'BEGIN {
  json = "{\"map\": {"; true_json = "{\"map\": {"
  for (i = 0; i <= 40; ++i) {
    x = 0.05 * i; time = sprintf("%.6f", 1000 + 0.2 * i)
    line = "FLASER 181"; list = ""
    for (k = 0; k <= 180; ++k) {
      a = (k - 90) * pi / 180; c = cos(a); s = sin(a)
      r = (c > 1e-9) ? (4 - x) / c : 1e9
      t = (s > 1e-9) ? 3 / s : (s < -1e-9) ? -3 / s : 1e9
      if (t < r) r = t
      if (k > 120 && k < 130) r = 81.83
      r = sprintf("%.2f", r)
      line = line " " r; list = list (k ? "," : "") r
    }
    o = sprintf("%.6f", 1.02 * x)
    print "ODOM", o, "0 0 0 0 0", time, "robot", time > "inputs/room.log"
    print line, o, "0 0", o, "0 0", time, "robot", time > "inputs/room.log"
    json = json (i ? "," : "") sprintf("\"%s\": {\"range\": [%s], \"x\": %s, \"y\": 0, \"theta\": 0}", time, list, o)
    true_json = true_json (i ? "," : "") sprintf("\"%s\": {\"range\": [%s], \"x\": %.6f, \"y\": 5, \"theta\": 0}", time, list, x)
  }
  print json "}}" > "inputs/room.json"
  print true_json "}}" > "inputs/true.json"
  print "# t1 t2 x y z roll pitch yaw" > "inputs/relations.txt"
  print "1000.0 1008.000001 2 0 0 0 0 0" > "inputs/relations.txt"
  print "1004 1006 0.5 0 0 0 0 0" > "inputs/relations.txt"
  print "1004 1006.1 9 9 0 0 0 0" > "inputs/relations.txt"
}'
cd inputs
head -c 20000 room.json >truncated.json
head -c 20000 room.log >truncated.log
: >empty.json
: >empty.log
mkdir folder.json
cp room.json room.dat
cp room.log carmen.json
echo '{"map": {}}' >no_scans.json
echo '{"map": {"1": {"range": [1, 2], "x": 0, "y": 0, "theta": 0}}}' >two_beams.json
sed 's/"x": 0.510000/"x": 900000/' room.json >jump.json
echo '1 2 3 4 5' >short.txt
: >empty.txt
cd ../run

refused "no log" --log
refused "a log without a name" --log --log ""
refused "loops of another kind" --loops --log ../inputs/room.dat --loops maybe
refused "a compass of another kind" --compass --log ../inputs/room.dat --compass maybe
refused "a log that is not there" absent.json --log ../inputs/absent.json
refused "a folder" "is a folder" --log ../inputs/folder.json
refused "an unknown extension" room.dat --log ../inputs/room.dat
refused "a truncated JSON" truncated.json --log ../inputs/truncated.json
refused "a truncated CARMEN log" "truncated.log: line" --log ../inputs/truncated.log
refused "an empty JSON" empty.json --log ../inputs/empty.json
refused "an empty CARMEN log" empty.log --log ../inputs/empty.log
refused "a JSON without scans" "no scans" --log ../inputs/no_scans.json
refused "a CARMEN log called JSON" carmen.json --log ../inputs/carmen.json
refused "beams of unknown angles" "2 readings" --log ../inputs/two_beams.json
refused "odometry that jumps away" "jump.json: at time" --log ../inputs/jump.json
refused "relations with too few numbers" "short.txt: line 1" --log ../inputs/room.json --relations ../inputs/short.txt
refused "no relations" empty.txt --log ../inputs/room.json --relations ../inputs/empty.txt
refused "a reference of another log" two_beams.json --log ../inputs/room.json --reference ../inputs/two_beams.json
refused "a frame angle that is no number" --frame-angle-deg --log ../inputs/room.json --frame-angle-deg nan
refused "resolution 0" --resolution --log ../inputs/room.json --resolution 0
refused "a negative range" --usable-range --log ../inputs/room.json --usable-range -1
refused "a beam step of 0" --beams --log ../inputs/room.json --beams -90,0
refused "a laser of two numbers" --laser --log ../inputs/room.json --laser 1,2
refused "an unknown meaning" --no-return-is --log ../inputs/room.json --no-return-is free
refused "an unknown option" --frobnicate --log ../inputs/room.json --frobnicate
output=/dev/null/x refused "an output below a file" /dev/null/x --log ../inputs/room.json

mkdir -p blocked/overview.png
output=blocked refused "a result whose name is a folder" overview.png --log ../inputs/room.json
rm -r blocked

help_names help log reference relations frame-angle-deg resolution beams laser no-return usable-range no-return-is \
  output quiet

# run NAME ARGUMENTS...: maps into the folder NAME.
run() { run_quietly "$@"; }
# value FOLDER KEY: metrics.json has one key a line.
value() { sed -n "s/^  \"$2\": \(.*[^,]\),\{0,1\}$/\1/p" "$1/metrics.json"; }
# between FOLDER KEY LOW HIGH
between() {
  local got
  got=$(value "$1" "$2")
  awk -v v="$got" -v low="$3" -v high="$4" 'BEGIN { exit !(v != "" && v != "null" && v + 0 >= low && v + 0 <= high) }' ||
    fail "$1: $2 is $got, not in $3..$4"
}
run json --log ../inputs/room.json
run again --log ../inputs/room.json
run full --log ../inputs/room.json --reference ../inputs/true.json --relations ../inputs/relations.txt
run carmen --log ../inputs/room.log
run turned --log ../inputs/room.log --frame-angle-deg 30 --relations ../inputs/relations.txt

for file in metrics.json map.yaml map.png overview.png trajectory_estimated.tum trajectory_odometry.tum; do
  [ -s json/$file ] || fail "$file is missing or empty"
done
[ "$(ls -A json | wc -l)" -eq 6 ] || fail "other files than promised: $(ls -A json)"
[ -s full/trajectory_reference.tum ] || fail "trajectory_reference.tum is missing or empty"
[ "$(ls -A full | wc -l)" -eq 7 ] || fail "other files than promised: $(ls -A full)"
for key in log reference relations scans beams duration_s distance_m relations_matched relations_translation_mean_m \
  relations_rotation_mean_deg odometry_relations_translation_mean_m odometry_relations_rotation_mean_deg ate_rmse_m \
  lost_scans wall_time_s real_time_factor compass loops resolution_m frame_angle_deg no_return_m usable_range_m; do
  [ -n "$(value json $key)" ] || fail "metrics.json lacks $key"
done
for key in reference relations relations_matched relations_translation_mean_m relations_rotation_mean_deg ate_rmse_m; do
  [ "$(value json $key)" = null ] || fail "$key is $(value json $key), not null"
done
grep -q "$work" full/metrics.json && fail "a path is in metrics.json"
for file in trajectory_estimated.tum map.yaml map.png overview.png; do
  cmp -s json/$file again/$file || fail "$file is not the same again"
done
cmp -s json/map.png carmen/map.png || fail "the JSON and the CARMEN log give different maps"
cmp -s json/map.png turned/map.png && fail "--frame-angle-deg does not turn the map"
between full scans 41 41
between full duration_s 7.999 8.001
between full no_return_m 81.83 81.83
between full relations_matched 2 2
between full odometry_relations_translation_mean_m 0.024 0.026
between full relations_translation_mean_m 0 0.01
between full ate_rmse_m 0 0.01
between turned relations_translation_mean_m 0 0.01
between full lost_scans 0 0

# Without a return nothing is free, unless asked for.
run clear --log ../inputs/room.json --no-return-is clear --usable-range 6
cmp -s json/map.png clear/map.png && fail "--no-return-is clear changes nothing"

[ $failures -eq 0 ] && echo "log_mapping: the command line is as promised"
exit $((failures > 0))
