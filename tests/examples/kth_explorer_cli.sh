#!/usr/bin/env bash
# The command line of kth_explorer: what it refuses, what it writes, and that runs repeat.
# Usage: kth_explorer_cli.sh PATH_OF_KTH_EXPLORER
set -u
program=$(realpath "$1")
source "$(dirname "$(realpath "$0")")/cli.sh"

mkdir inputs run
cd inputs
printf '\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x10\x08\0\0\0\0' >truncated.png
printf 'image: truncated.png\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n' >truncated.yaml
printf 'P5\n1 1\n255\n\xff' >one.pgm
printf 'image: one.pgm\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n' >no_resolution.yaml
cat >two_points.xml <<'XML'
<?xml version="1.0" encoding="UTF-8"?>
<floor BuildingName="x" FloorName="1">
  <Scale PixelDistance="1000" RealDistance="10"/>
  <space name="a" type="room">
    <contour>
      <centroid x="50" y="50"/>
      <linesegment x1="0" y1="0" x2="100" y2="0" type="Wall" target=""/>
      <linesegment x1="100" y1="0" x2="0" y2="0" type="Wall" target=""/>
    </contour>
  </space>
</floor>
XML
cat >room.xml <<'XML'
<?xml version="1.0" encoding="UTF-8"?>
<floor BuildingName="x" FloorName="2">
  <Scale PixelDistance="1000" RealDistance="100"/>
  <space name="a" type="room">
    <contour>
      <centroid x="50" y="50"/>
      <linesegment x1="0" y1="0" x2="100" y2="0" type="Wall" target=""/>
      <linesegment x1="100" y1="0" x2="100" y2="100" type="Wall" target=""/>
      <linesegment x1="100" y1="100" x2="0" y2="100" type="Wall" target=""/>
      <linesegment x1="0" y1="100" x2="0" y2="0" type="Wall" target=""/>
    </contour>
  </space>
</floor>
XML
printf '# a line\n0,0 1,1\n' >two_corners.txt
printf '20,11 22,11 22,13 20,13\n' >no_go.txt
cd ../run

refused "a truncated PNG" truncated.png --map ../inputs/truncated.yaml
refused "a YAML without resolution" resolution --map ../inputs/no_resolution.yaml
refused "an XML with a space of two points" two_points.xml --map ../inputs/two_points.xml
refused "a map that is not there" absent.yaml --map ../inputs/absent.yaml
refused "a negative alpha" alpha --alpha -1
refused "a strategy that is not there" strategy --strategy sideways
refused "an information that is not there" information --information gossip
refused "a navigation that is not there" navigation --navigation stars
refused "a filter that is not there" filter --filter kalman
refused "a controller that is not there" controller --controller joystick
refused "a radius of nothing" radius --radius 0
refused "a radius that fits nowhere" room --radius 2 --bounds 1,1,3,3
refused "bounds that are no box" bounds --bounds 1,2,3
refused "bounds the wrong way around" "X0 < X1" --bounds 5,5,1,9
refused "bounds without a number" bounds --bounds ""
refused "no-go areas that are not there" absent.txt --no-go ../inputs/absent.txt
refused "a no-go area of two corners" "line 2 has 2 corners" --no-go ../inputs/two_corners.txt
refused "a start outside of the bounds" start --start 30,14 --bounds 1,1,10,10
refused "an alpha that is no number" alpha --alpha nan
refused "a start inside a wall" start --start 0.1,0.1
refused "a start that is no point" --start --start 3
refused "a start of more than a point" --start --start 3,4,5
output=/dev/null/x refused "an output below a file" /dev/null/x
refused "resolution 0" --resolution --resolution 0
refused "a negative seed" --seed --seed -1
refused "a seed that is too large" 18446744073709551616 --seed 18446744073709551616
refused "uncertainty frontiers of other cells" "needs --cells dispersion" --frontiers uncertain --information size
refused "uncertainty frontiers by BIG" "needs --information" --frontiers uncertain --cells dispersion
refused "a map without a name" --map --map ""
refused "a start without a point" --start --start ""
refused "a negative duration" --duration --duration -5
refused "an unknown option" --frobnicate --frobnicate
refused "an unknown entropy" --entropy --entropy gibbs
refused "a compass of another kind" --compass --compass maybe
refused "loops of another kind" --loops --loops maybe
refused "negative threads" --threads --threads -1
refused "a mission that is not there" absent.mission --resume absent.mission
refused "a mission without a name" --resume --resume ""
refused "a place to save without a folder" absent/a.mission --save absent/a.mission
refused "a folder to save to" "is a folder" --save ../inputs

mkdir -p blocked/overview.png
output=blocked refused "a result whose name is a folder" overview.png --duration 1e6
mkdir blocked/recording.incognita
rmdir blocked/overview.png
output=blocked refused "a recording whose name is a folder" recording.incognita --record --duration 1e6
rm -r blocked

help_names help map cells frontiers entropy alpha filter compass loops strategy information navigation controller radius bounds \
  no-go return save resume duration seed start resolution threads output record report quiet

# run NAME ARGUMENTS...: 20 s of a mission into the folder NAME.
run() { run_quietly "$@" --duration 20 --seed 1; }
run one --threads 1
run again --threads 1
run two --threads 2
run behavioral --threads 2 --entropy behavioral --alpha 1
run shannon --threads 2 --entropy shannon

# metrics.json has one key a line.
metrics() { grep -vE "^  \"([a-z_]*time[a-z_]*|threads${2:-})\":" "$1/metrics.json"; }
same_metrics() {
  [ "$(metrics "$1" "${3:-}")" = "$(metrics "$2" "${3:-}")" ] ||
    fail "$1 and $2 differ: $(diff <(metrics "$1" "${3:-}") <(metrics "$2" "${3:-}"))"
}
same_metrics one again
same_metrics one two
same_metrics behavioral shannon '|entropy|alpha'
for file in trajectory_estimated.tum trajectory_true.tum map.yaml map.png belief_log_odds.npy belief_probability.npy belief_frame.json; do
  cmp -s one/$file two/$file || fail "$file differs with the number of threads"
done

for file in metrics.json map.yaml map.png trajectory_estimated.tum trajectory_true.tum decisions.csv progress.csv overview.png \
  belief_log_odds.npy belief_probability.npy belief_frame.json; do
  [ -s one/$file ] || fail "$file is missing or empty"
done
[ "$(ls -A one | wc -l)" -eq 11 ] || fail "other files than promised: $(ls -A one)"
for key in map seed entropy alpha compass loops controller resolution_m duration_s scans distance_m collisions decisions stop_reason \
  translation_rmse_m translation_mae_m heading_rmse_rad nees_mean map_error map_uncertainty_bits_per_step \
  explored_fraction explored_area_m2 wall_time_s real_time_factor threads; do
  grep -q "^  \"$key\": " one/metrics.json || fail "metrics.json lacks $key"
done
grep -q '"duration_s": 20.0,' one/metrics.json || fail "duration_s is not 20: $(grep duration_s one/metrics.json)"
grep -q '"stop_reason": "out_of_time"' one/metrics.json || fail "the stop reason: $(grep stop_reason one/metrics.json)"
grep -q "$work" one/metrics.json && fail "a path is in metrics.json"

# Recorded, it is the same run, and an earlier recording gives way.
mkdir recorded
echo "an earlier one" >recorded/recording.incognita
run recorded --threads 1 --record
same_metrics one recorded
for file in trajectory_estimated.tum trajectory_true.tum map.yaml map.png progress.csv; do
  cmp -s one/$file recorded/$file || fail "$file differs when the run is recorded"
done
decided() { rev "$1/decisions.csv" | cut -d, -f2- ; }  # but for how long it took
[ "$(decided one)" = "$(decided recorded)" ] || fail "decisions.csv differs when the run is recorded"
[ "$(ls -A recorded | wc -l)" -eq 12 ] || fail "other files than promised: $(ls -A recorded)"
[ "$(head -c 8 recorded/recording.incognita)" = INCOGREC ] || fail "recording.incognita is none"
grep -aq '"stop_reason":"out_of_time"' recorded/recording.incognita || fail "the recording does not say how the run ended"
grep -aq '"seed":1' recorded/recording.incognita || fail "the recording does not say what the run was made with"

# A part of the floor, with a pose that is known, and back.
run part --threads 1 --filter none --bounds 17,8,40,16 --no-go ../inputs/no_go.txt --radius 0.25 --return
grep -q '"returned": true' part/metrics.json || fail "the robot has not returned: $(grep returned part/metrics.json)"
run without --threads 1 --filter none --bounds 17,8,40,16 --no-go ../inputs/no_go.txt --radius 0.25
[ "$(metrics part | grep -vE '"(returned|return_distance_m)"')" = "$(metrics without | grep -vE '"(returned|return_distance_m)"')" ] ||
  fail "the way back is in the metrics"
grep -q '"nees_mean": null' part/metrics.json || fail "a known pose has a NEES: $(grep nees part/metrics.json)"
grep -q '"returned": null' one/metrics.json || fail "returned though not asked to: $(grep returned one/metrics.json)"
# 20 s of exploration, and the way back.
awk '$1 > 20.5 { later = 1 } END { exit !later }' part/trajectory_true.tum || fail "the way back is not in the trajectory"
awk -F, 'NR > 1 && $1 > 20.0 { exit 1 }' part/progress.csv || fail "the way back is in the progress"

# A mission that stops and goes on is the one that never stopped.
run first --threads 2 --save first.mission --return
run_quietly whole --threads 1 --duration 40 --seed 1 --save whole.mission
run_quietly resumed --threads 1 --duration 40 --seed 1 --resume first.mission --save resumed/resumed.mission
same_metrics whole resumed
for file in trajectory_estimated.tum trajectory_true.tum map.yaml map.png progress.csv overview.png; do
  cmp -s whole/$file resumed/$file || fail "$file is not that of a mission that never stopped"
done
untimed() { cut -d, -f1-6 "$1/decisions.csv"; }
[ "$(untimed whole)" = "$(untimed resumed)" ] || fail "a mission that goes on decides otherwise"
[ "$(wc -c <whole.mission)" -eq "$(wc -c <resumed/resumed.mission)" ] || fail "a mission that goes on is saved with another size"
run_quietly dispersion --threads 1 --duration 5 --cells dispersion --filter none --save dispersion.mission
run_quietly resumed_dispersion --threads 1 --duration 8 --cells dispersion --filter none --resume dispersion.mission

# So is one that MPPI steers.
run_quietly mppi_first --threads 1 --duration 10 --seed 1 --controller mppi --save mppi.mission
run_quietly mppi_whole --threads 1 --duration 15 --seed 1 --controller mppi
run_quietly mppi_resumed --threads 2 --duration 15 --seed 1 --controller mppi --resume mppi.mission
same_metrics mppi_whole mppi_resumed
cmp -s mppi_whole/trajectory_true.tum mppi_resumed/trajectory_true.tum || fail "MPPI goes on otherwise than if it had never stopped"
cmp -s mppi_whole/trajectory_true.tum whole/trajectory_true.tum && fail "MPPI steers as the follower does"

cp first.mission flipped.mission
printf '\x55' | dd of=flipped.mission bs=1 seek=100000 conv=notrunc status=none
cmp -s first.mission flipped.mission && fail "the flipped byte is the same"
head -c 100000 first.mission >short.mission
printf 'no mission\n' >other.txt
refused "a mission with a flipped byte" "flipped.mission: is damaged" --resume flipped.mission
refused "half a mission" "short.mission: is damaged" --resume short.mission
refused "a file that is no mission" "is not a mission file" --resume other.txt
refused "a mission of another map" 'mission.map = embedded' --resume first.mission --map ../inputs/room.xml --start 5,5
refused "a mission of another seed" 'mission.seed = 1' --resume first.mission --seed 2
refused "a mission of another controller" 'mission.controller = follower' --resume first.mission --controller mppi
refused "a mission of another start" 'mission.T_start_world' --resume first.mission --start 19,12
refused "a mission of other cells" 'cells.rule = 0' --resume first.mission --cells log-odds
refused "a mission of another filter" 'filter.start' --resume first.mission --filter dead-reckoning
refused "a mission of another resolution" 'map.resolution_m = 0.1' --resume first.mission --resolution 0.2
refused "a mission of another radius" 'explorer.travel.robot_radius_m = 0.2' --resume first.mission --radius 0.25
refused "a mission that has lasted longer" 'has lasted 20' --resume first.mission --duration 10

# The report, and the recording that it is of, beside all else, which they do not change.
run reported --threads 1 --report
same_metrics one reported
[ "$(ls -A reported | wc -l)" -eq 13 ] || fail "other files than promised: $(ls -A reported)"
for file in recording.incognita report.html; do
  [ -s reported/$file ] || fail "$file is missing or empty"
done
grep -q '<title>incognita: embedded floor plan</title>' reported/report.html || fail "the title of the report"
grep -q "$work" reported/report.html && fail "a path is in the report"

times=$(tail -n +2 one/progress.csv | cut -d, -f1 | tr '\n' ' ')
[ "$times" = "$(seq -s ' ' 1 20) " ] || fail "progress.csv has not a line each second: $times"
head -1 one/decisions.csv | grep -q '^time_s,candidates,' || fail "the header of decisions.csv: $(head -1 one/decisions.csv)"
[ "$(wc -l <one/decisions.csv)" -gt 1 ] || fail "decisions.csv has no decision"

[ $failures -eq 0 ] && echo "kth_explorer: the command line is as promised"
exit $((failures > 0))
