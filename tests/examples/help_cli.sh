#!/usr/bin/env bash
# The help of the examples that have no other test of their command line, and that they refuse what they do not know.
# Usage: help_cli.sh PATH_OF_PROGRAM...
set -u
programs=$(realpath "$@")
source "$(dirname "$(realpath "$0")")/cli.sh"
mkdir run
cd run
for program in $programs; do
  help_names help output
  "$program" --frobnicate >stdout 2>stderr
  [ $? -eq 2 ] && [ ! -s stdout ] && grep -q "^$(basename "$program"): .*--frobnicate" stderr || fail "$program --frobnicate: $(cat stderr)"
done
[ $failures -eq 0 ] && echo "Help texts are as promised"
exit $((failures > 0))
