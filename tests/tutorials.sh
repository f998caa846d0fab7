#!/usr/bin/env bash
# The tutorials say what is: each ```cpp block of docs/tutorials/NN_*.md is a piece of the sources of examples/tutorial_NN_*, but for its
# indentation; every picture and page is there, is small, is linked, and the pictures' commands name programs that exist.
set -u
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
docs=$root/docs/tutorials
failures=0
fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

# check_blocks PAGE SOURCES...
check_blocks() {
  awk -v page="$1" '
    FILENAME != page { if (FNR == 1) code[++lines] = "\f"; code[++lines] = $0; next }
    $0 == "```cpp" { in_block = 1; size = 0; first = FNR + 1; next }
    in_block && $0 == "```" { in_block = 0; ++blocks; if (!is_found()) { print page ":" first ": is not in the program"; bad = 1 } next }
    in_block { block[++size] = $0 }
    END {
      if (blocks == 0) { print page ": shows no code"; bad = 1 }
      if (in_block) { print page ": a block has no end"; bad = 1 }
      exit bad
    }
    function is_found(    i, j, lead) {
      for (i = 1; i + size - 1 <= lines; ++i) {
        lead = length(code[i]) - length(block[1])
        if (lead < 0 || substr(code[i], lead + 1) != block[1] || substr(code[i], 1, lead) !~ /^ *$/) continue
        lead = substr(code[i], 1, lead)
        for (j = 2; j <= size; ++j) if (code[i + j - 1] != (block[j] == "" ? "" : lead block[j])) break
        if (j > size) return 1
      }
      return 0
    }' "${@:2}" "$1" >&2
}

pages=0
for page in "$docs"/[0-9][0-9]_*.md; do
  pages=$((pages + 1))
  name=$(basename "$page" .md)
  folder=$root/examples/tutorial_$name
  [ -f "$folder/main.cpp" ] || { fail "$name has no program"; continue; }
  check_blocks "$page" "$folder"/*.?pp || fail "$name.md differs from its program"
  grep -qF "($name.md)" "$docs/README.md" || fail "README.md does not name $name.md"
  grep -qF "examples/run tutorial_$name" "$page" || fail "$name.md does not say how to run it"
  [ "$(wc -l <"$page")" -le 140 ] || fail "$name.md is long"
  for link in $(awk '/^```/ { code = !code } !code' "$page" | grep -o '](\([^)#]*\))' | sed 's/^](//; s/)$//'); do
    [ -e "$docs/$link" ] || fail "$name.md links to $link, which is not there"
  done
done
[ $pages -eq "$(ls -d "$root"/examples/tutorial_*/ | wc -l)" ] || fail "there are $pages pages and another number of programs"

for picture in "$docs"/*.png; do
  name=$(basename "$picture")
  [ "$(stat -c %s "$picture")" -lt 150000 ] || fail "$name is 150 kB or more"
  grep -qF "($name)" "$docs"/[0-9]*.md || fail "no page shows $name"
  command=$(grep -F "| $name | \`examples/run " "$docs/README.md") || { fail "README.md does not say how to make $name"; continue; }
  program=$(sed 's/.*examples\/run \([a-z0-9_]*\) .*/\1/' <<<"$command")
  [ -f "$root/examples/$program/main.cpp" ] || fail "README.md makes $name by $program, which is not there"
done

[ $failures -eq 0 ] && echo "tutorials: $pages pages are as their programs"
exit $((failures > 0))
