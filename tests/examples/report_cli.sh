#!/usr/bin/env bash
# The command line of report: what it refuses, and what it writes.
# Usage: report_cli.sh PATH_OF_REPORT
set -u
program=$(realpath "$1")
source "$(dirname "$(realpath "$0")")/cli.sh"

# A recording by hand: its magic and version, then a record of one setup and one of one frame, as docs/recording.md has them. Numbers are little
# endian; `record TYPE FILE` adds the length and the checksum, which gzip computes too.
mkdir inputs run
cd inputs
u32() { printf "\\x$(printf %02x $(($1 & 255)))\\x$(printf %02x $(($1 >> 8 & 255)))\\x$(printf %02x $(($1 >> 16 & 255)))\\x$(printf %02x $(($1 >> 24 & 255)))"; }
record() {
  { u32 "$1"; u32 "$(wc -c <"$2")"; cat "$2"; } >part
  cat part
  gzip -c part | tail -c 8 | head -c 4
}
zero='\0\0\0\0\0\0\0\0'
one='\0\0\0\0\0\0\xf0\x3f'
minus_one='\0\0\0\0\0\0\xf0\xbf'
# Parameters; resolution, step of log-odds, thresholds, radius, range, 1 each; no beams, no metrics, no plan.
printf "\\x0c{\"seed\": 42}$one$one$minus_one$one$one$one\0\0\0" >setup
# The time, the pose, six numbers of the covariance, flags, no beams, no metrics, no tiles.
printf "$zero$zero$zero$zero$one$zero$one$zero$zero$one\\x01\0\0\0" >frame
printf '\x08complete\x0d{"scans": 17}' >end
{ printf INCOGREC; u32 1; record 1 setup; record 2 frame; } >torn_at_a_record.incognita
{ cat torn_at_a_record.incognita; record 4 end; } >whole.incognita
{ cat torn_at_a_record.incognita; record 2 frame | head -c 50; } >torn.incognita
{ printf INCOGREC; u32 1; record 1 setup; } >no_frame.incognita
head -c 20 whole.incognita >cut.incognita
{ printf INCOGREC; u32 9; record 1 setup; } >version.incognita
sed 's/seed/feed/' whole.incognita >damaged.incognita
printf 'P5\n1 1\n255\n\xff' >image.pgm
: >empty.incognita
mkdir folder.incognita
mkdir -p usual/recording_of && cp whole.incognita usual/recording_of/recording.incognita
cd ../run

refused "no recording" "RECORDING or --compare"
refused "a recording without a name" empty ""
refused "a recording that is not there" absent.incognita ../inputs/absent.incognita
refused "a folder" "folder.incognita" ../inputs/folder.incognita
refused "an empty file" empty.incognita ../inputs/empty.incognita
refused "an image" "is not a recording" ../inputs/image.pgm
refused "a recording without a setup" "cut off" ../inputs/cut.incognita
refused "a recording of another version" "version 9" ../inputs/version.incognita
refused "a damaged recording" checksum ../inputs/damaged.incognita
refused "one recording to compare" --compare --compare ../inputs/whole.incognita
refused "three recordings to compare" "" --compare ../inputs/whole.incognita ../inputs/whole.incognita ../inputs/whole.incognita
refused "a second one that is not there" absent.incognita --compare ../inputs/whole.incognita ../inputs/absent.incognita
refused "an unknown option" --frobnicate ../inputs/whole.incognita --frobnicate
output=/dev/null/x refused "an output below a file" /dev/null/x ../inputs/whole.incognita
mkdir -p blocked/report.html
output=blocked refused "a page whose name is a folder" report.html ../inputs/whole.incognita
rm -r blocked

help_names help compare output quiet

run_quietly whole ../inputs/whole.incognita
run_quietly again ../inputs/whole.incognita
run_quietly named.html ../inputs/whole.incognita
run_quietly torn ../inputs/torn.incognita
run_quietly torn_at_a_record ../inputs/torn_at_a_record.incognita
run_quietly no_frame ../inputs/no_frame.incognita
run_quietly usual ../inputs/usual/recording_of/recording.incognita
run_quietly compare --compare ../inputs/whole.incognita ../inputs/torn.incognita

[ "$(ls -A whole)" = report.html ] || fail "other files than promised: $(ls -A whole)"
cmp -s whole/report.html again/report.html || fail "the page is not the same again"
cmp -s whole/report.html named.html || fail "the page is another by another name"
grep -q '{{' <(grep -v 'Chart' whole/report.html | head -200) && fail "a mark of the template is left"
grep -qE '(src|href)="?https?:' whole/report.html && fail "the page asks for something"
grep -q '<title>incognita: recording_of</title>' usual/report.html || fail "the name of a run: $(grep '<title>' usual/report.html)"
grep -q '<title>incognita: whole and torn</title>' compare/report.html || fail "the names of two runs: $(grep '<title>' compare/report.html)"
[ "$(grep -c 'class="run"' compare/report.html)" -eq 2 ] || fail "not two runs"
"$program" --output said ../inputs/whole.incognita | grep -q 'said/report.html' || fail "it does not say where the page is"

# What the page holds of a run, unpacked: zlib's format is gzip's, but for the head and the end.
unpacked() {
  grep -o 'class="run">[^<]*' "$1/report.html" | head -1 | cut -d'>' -f2 | base64 -d |
    { printf '\x1f\x8b\x08\0\0\0\0\0\0\0'; tail -c +3; } | gzip -dc 2>/dev/null | tr -d '\0'
}
holds() { grep -qaF -- "$2" <(unpacked "$1") || fail "$1 does not hold $2: $(unpacked "$1" | head -c 600)"; }
holds whole '"is_whole":true'
holds whole '"stop_reason":"complete"'
holds whole 'seed\": 42'
holds whole 'scans\": 17'
holds torn '"is_whole":false,"torn_bytes":50'
holds torn_at_a_record '"is_whole":false,"torn_bytes":0'
holds no_frame '"frames_recorded":0'

[ $failures -eq 0 ] && echo "report: the command line is as promised"
exit $((failures > 0))
