#!/usr/bin/env bash
# Each room's door includes every header of the room but poses in space and MPPI, which cost time to compile, and incognita.hpp every door but those of io, loops,
# simulation and testing.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../include"
failures=0
missing() {
  echo "$1 does not include $2" >&2
  failures=$((failures + 1))
}
for folder in incognita/*/; do
  door=${folder%/}.hpp
  while read -r header; do
    [[ $header == incognita/geometry/pose3.hpp || $header == incognita/planning/mppi*.hpp ]] && continue
    grep -qF "#include \"$header\"" "$door" || missing "$door" "$header"
  done < <(find "$folder" -name '*.hpp')
  case $door in incognita/io.hpp | incognita/loops.hpp | incognita/simulation.hpp | incognita/testing.hpp) continue ;; esac
  grep -qF "#include \"$door\"" incognita/incognita.hpp || missing incognita/incognita.hpp "$door"
done
exit $((failures > 0))
