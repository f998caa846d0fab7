#!/usr/bin/env bash
# What it costs to include everything: the processor time of parsing incognita.hpp against that of <Eigen/Dense> and the
# standard headers that it uses. Takes turns, compares the least of each (other work only adds), fails above 1.4 times.
# Usage: parse_time.sh [compiler]
set -euo pipefail
compiler=${1:-g++}
include=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../include" && pwd)
turns=9
bound=1.4

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
read -ra eigen < <(pkg-config --cflags eigen3)
flags=(-std=c++20 -I "$include" "${eigen[@]}")

echo '#include <incognita/incognita.hpp>' >"$work/incognita.cpp"
# -MM names the project's own headers and leaves out those of the system.
headers=$("$compiler" "${flags[@]}" -MM "$work/incognita.cpp" | grep -o '[^ ]*\.hpp')
{
  echo '#include <Eigen/Dense>'
  # shellcheck disable=SC2086
  grep -hoE '^#include <[a-z_0-9]+>' $headers | sort -u
} >"$work/baseline.cpp"

seconds() {
  local TIMEFORMAT='%U %S'
  { time "$compiler" "${flags[@]}" -fsyntax-only "$1"; } 2>&1 | awk '{ printf "%.3f\n", $1 + $2 }'
}
least() { sort -n "$1" | head -1; }

# Once untimed, to warm the file cache and to show what does not compile.
"$compiler" "${flags[@]}" -fsyntax-only "$work/incognita.cpp" "$work/baseline.cpp"
for ((turn = 0; turn < turns; ++turn)); do
  seconds "$work/incognita.cpp" >>"$work/incognita.s"
  seconds "$work/baseline.cpp" >>"$work/baseline.s"
done

awk -v all="$(least "$work/incognita.s")" -v base="$(least "$work/baseline.s")" -v bound="$bound" \
  -v standard="$(($(wc -l <"$work/baseline.cpp") - 1))" 'BEGIN {
  printf "Parsing incognita.hpp takes %.2f s, <Eigen/Dense> and %d standard headers %.2f s: %.2f times (bound %.1f)\n",
    all, standard, base, all / base, bound
  exit !(all <= bound * base)
}'
