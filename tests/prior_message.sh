#!/usr/bin/env bash
# What the compiler says of a prior for cells that cannot have one.
# Usage: prior_message.sh COMPILER
set -euo pipefail
include=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../include" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/prior.cpp" <<'CPP'
#include <incognita/map/prior.hpp>
struct Counting {
  struct State {
    int count = 0;
  };
  struct Beam {};
  Beam beam(double) const { return {}; }
  void hit(State&, const Beam&, float, incognita::ScanStamp) const {}
  void pass(State&, const Beam&, float, incognita::ScanStamp) const {}
  bool ignores_passes(const State&) const { return false; }
  void forget_stamp(State&) const {}
  static float log_odds(const State& state) { return static_cast<float>(state.count); }
#ifdef WITH_PRIOR
  State state_of_log_odds(float log_odds) const { return {static_cast<int>(log_odds)}; }
#endif
};
void use(const incognita::Grid<float, 2>& grid) { static_cast<void>(incognita::map_with_prior<Counting>(grid)); }
CPP
read -ra eigen < <(pkg-config --cflags eigen3)
compile() { "$1" -std=c++20 -I "$include" "${eigen[@]}" -fsyntax-only "${@:2}" "$folder/prior.cpp"; }
compile "$1" -DWITH_PRIOR
if compile "$1" 2>"$folder/errors"; then
  echo "a prior for cells that cannot have one compiles" >&2
  exit 1
fi
grep -q 'this cell policy cannot start from log-odds; give it State state_of_log_odds(float) const' "$folder/errors" ||
  { cat "$folder/errors" >&2; exit 1; }
# Little else, so that it is found.
[ "$(grep -c ' error: ' "$folder/errors")" -eq 1 ] || { cat "$folder/errors" >&2; exit 1; }
