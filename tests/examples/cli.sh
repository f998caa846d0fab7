# What the tests of command lines share. Source it with $program, the program under test; it changes to a new folder, which
# is removed in the end, and counts in $failures.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failures=0

fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

# refused NAME TEXT ARGUMENTS...: exit code 2, one line on stderr with TEXT in it, nothing written.
refused() {
  local name=$1 text=$2 before after code
  shift 2
  before=$(find . | sort)
  "$program" --quiet --output "${output:-out/deep}" "$@" >../stdout.$$ 2>../stderr.$$
  code=$?
  after=$(find . | sort)
  [ $code -eq 2 ] || fail "$name: exit code $code instead of 2"
  [ "$(wc -l <../stderr.$$)" -eq 1 ] || fail "$name: not one line on stderr: $(cat ../stderr.$$)"
  [ -s ../stdout.$$ ] && fail "$name: something on stdout: $(cat ../stdout.$$)"
  grep -qiF -- "$text" ../stderr.$$ || fail "$name: \"$text\" is not in: $(cat ../stderr.$$)"
  [ "$before" = "$after" ] || fail "$name: left something behind: $after"
  rm -f ../stdout.$$ ../stderr.$$
}

# run_quietly NAME ARGUMENTS...: exit code 0, nothing printed, results in the folder NAME.
run_quietly() {
  local name=$1
  shift
  "$program" --quiet --output "$name" "$@" >stdout 2>stderr || fail "$name: exit code $?: $(cat stderr)"
  [ -s stdout ] || [ -s stderr ] && fail "$name: --quiet prints"
}

# help_names OPTIONS...: --help prints to stdout alone, in lines of at most 80 columns, and names each option.
help_names() {
  local help option wide
  help=$("$program" --help 2>stderr) || fail "--help: exit code $?"
  [ -s stderr ] && fail "--help: something on stderr"
  wide=$(grep -E '.{81}' <<<"$help") && fail "--help is wider than 80 columns: $wide"
  for option in "$@"; do
    grep -q -- "--$option\b" <<<"$help" || fail "--help does not name --$option"
  done
}
