#!/usr/bin/env bash
# kth_explorer is killed at ten moments after its first frame; each time what it had recorded must be readable, and an earlier recording be there still.
# Usage: recording_killed.sh PATH_OF_KTH_EXPLORER PATH_OF_RECORDING_SUMMARY
set -u
program=$(realpath "$1")
summary=$(realpath "$2")
source "$(dirname "$(realpath "$0")")/cli.sh"
RANDOM=7

mkdir run
echo "an earlier one" >run/recording.incognita
partial=run/recording.incognita.partial
for attempt in 1 2 3 4 5 6 7 8 9 10; do
  rm -f "$partial"
  "$program" --quiet --record --output run --threads 1 --seed "$attempt" --resolution 0.05 --duration 100000 &
  pid=$!
  for ((tries = 0; tries < 3000; ++tries)); do
    [ "$("$summary" "$partial" 2>/dev/null | cut -d ' ' -f 1)" -ge 1 ] 2>/dev/null && break
    sleep 0.01
  done
  sleep "0.$(printf '%03d' $((RANDOM % 700)))"
  before=$(stat -c %s "$partial")
  kill -9 $pid || fail "run $attempt had ended before it was killed"
  wait $pid 2>/dev/null
  head -c "$before" "$partial" >before
  if ! read -r frames decisions last_s torn kind < <("$summary" "$partial"); then
    fail "run $attempt is not readable"
    continue
  fi
  read -r frames_before decisions_before _ < <("$summary" before)
  [ "$frames" -ge "$frames_before" ] && [ "$decisions" -ge "$decisions_before" ] ||
    fail "run $attempt had $frames_before frames and $decisions_before decisions, and has $frames and $decisions"
  [ "$kind" = cut ] || fail "run $attempt has an end"
  # A frame each half second, from 0 on.
  awk -v frames="$frames" -v last_s="$last_s" 'BEGIN { exit frames != 2 * last_s + 1 }' ||
    fail "run $attempt has $frames frames up to $last_s s"
  [ "$(cat run/recording.incognita)" = "an earlier one" ] || fail "run $attempt has replaced an earlier recording"
  echo "run $attempt: $frames frames, $decisions decisions, $torn bytes torn"
done
[ "$(ls -A run | sort | tr '\n' ' ')" = "recording.incognita recording.incognita.partial " ] || fail "something else was left: $(ls -A run)"

[ $failures -eq 0 ] && echo "kth_explorer: what it has recorded outlives it"
exit $((failures > 0))
