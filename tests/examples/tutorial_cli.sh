#!/usr/bin/env bash
# A tutorial's program runs, writes what its page shows, and finds what its page says.
# Usage: tutorial_cli.sh PATH_OF_PROGRAM
set -u
program=$(realpath "$1")
name=$(basename "$program")
source "$(dirname "$(realpath "$0")")/cli.sh"
if ! command -v gnuplot >/dev/null && [[ $name =~ _(02|06|08)_ ]]; then
  echo "$name: skipped, gnuplot is missing"
  exit 77
fi

"$program" --output out >said 2>stderr || fail "exit code $?: $(cat stderr)"
[ -s stderr ] && fail "something on stderr: $(cat stderr)"

# files NAMES...: these and no others.
files() {
  [ "$(ls -A out | sort | tr '\n' ' ')" = "$(printf '%s\n' "$@" | sort | tr '\n' ' ')" ] || fail "other files than promised: $(ls -A out)"
  for file in "$@"; do [ -s "out/$file" ] || fail "$file is empty"; done
}
# value KEY: what stands behind a key at a line's beginning.
value() { awk -v key="$1" '$1 == key { print $2; exit }' said; }
# holds KEY CONDITION: CONDITION is of v, the key's value.
holds() {
  local v
  v=$(value "$1")
  [ -n "$v" ] && awk -v v="$v" "BEGIN { exit !($2) }" || fail "$1 is '$v', but must be: $2"
}
says() { grep -qE "$1" said || fail "does not say '$1'"; }

case $name in
  tutorial_01_*)
    files first_map.png map.png map.yaml scans.log
    holds map_error 'v < 0.1'
    # One's own log gives the same map.
    "$program" --log out/scans.log --output own >/dev/null || fail "exit code $? with --log"
    cmp -s out/map.png own/map.png || fail "--log gives another map"
    "$program" --log missing.log --output no >/dev/null 2>stderr
    [ $? -eq 2 ] && [ ! -e no ] && grep -q missing.log stderr || fail "a missing log: $(cat stderr)"
    ;;
  tutorial_02_*)
    files localise.png errors.png scans.log
    holds position_rmse_m 'v < 0.02'
    holds position_worst_m 'v < 0.08'
    holds odometry_worst_m 'v > 0.3'
    holds within_3_sigma 'v > 0.97'
    holds collisions 'v == 0'
    ;;
  tutorial_03_*)
    files where_to_go.png
    # By gain; and what was predicted to tell most tells more than the average in truth.
    awk '$1 == "way" { if (n++ && $2 > last) exit 1; last = $2; sum += $3; if (n == 1) first = $3 }
         END { exit !(n >= 4 && first > sum / n) }' said || fail "the order of the ways: $(cat said)"
    ;;
  tutorial_04_*)
    files explorer.png map.png map.yaml
    says '^explored: (complete|nothing_informative) '
    says '^back: returned '
    holds explored_fraction 'v > 0.97'
    holds collisions 'v == 0'
    holds worst_error_m 'v < 0.1'
    holds home_m 'v < 0.3'
    ;;
  tutorial_05_*)
    files cell_policy.png
    says '^laws hold$'
    holds Counting 'v > 0.9'
    holds LogOdds 'v < 0.3'
    says '^Counting explorer: (complete|nothing_informative) .* 0 collisions'
    ;;
  tutorial_06_*)
    files entropy.png
    says '^laws hold$'
    holds table_error_nats 'v < 1e-4'
    says '^Gini ended 3 of 3'
    says '^Shannon ended 3 of 3'
    ;;
  tutorial_07_*)
    files own_robot.png
    says '^stopped (complete|nothing_informative) '
    holds explored_fraction 'v > 0.97'
    holds collisions 'v == 0'
    holds worst_error_m 'v < 0.1'
    ;;
  tutorial_08_*)
    files r_o.png r_u.png n_max.png gamma.png alpha.png scans.log
    # More gamma, less sigma; N_max of 1, 3 and 10 forget alike, 100 does not.
    awk '$1 == "gamma" { if (n++ && $7 >= last) exit 1; last = $7 } END { if (n != 5) exit 1 }' said || fail "sigma does not fall with gamma: $(cat said)"
    awk '$1 == "N_max" { if ($2 < 100 && $(NF - 1) > 20) exit 1; if ($2 == 100 && $(NF - 1) <= 40) exit 1; ++n } END { if (n != 4) exit 1 }' said || fail "N_max: $(cat said)"
    ;;
  *) fail "nothing is known of $name" ;;
esac

[ $failures -eq 0 ] && echo "$name: as its page says"
exit $((failures > 0))
