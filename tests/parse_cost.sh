#!/usr/bin/env bash
# Holds down what it costs to include everything: the memory that g++ takes for what it parses and instantiates, for
# incognita.hpp at most 1.4 times that for <Eigen/Dense> and the standard headers that it uses. Memory stands for time
# (benchmarks/parse_time), because it is the same in every run. Usage: parse_cost.sh [compiler]
set -euo pipefail
compiler=${1:-g++}
bound=1.4
source "$(dirname -- "${BASH_SOURCE[0]}")/../cmake/parse_sources.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
write_parse_sources "$compiler" "$work"

megabytes() {
  LC_ALL=C "$compiler" "${parse_flags[@]}" -ftime-report "$1" 2>&1 |
    awk '$1 == "TOTAL" && $NF ~ /^[0-9]+M$/ { print $NF + 0; found = 1 } END { exit !found }'
}
all=$(megabytes "$work/incognita.cpp")
base=$(megabytes "$work/baseline.cpp")
awk -v all="$all" -v base="$base" -v bound="$bound" 'BEGIN {
  printf "Parsing incognita.hpp takes %d MB, <Eigen/Dense> and the standard headers %d MB: %.2f times (bound %.1f)\n",
    all, base, all / base, bound
  exit !(all <= bound * base)
}'
