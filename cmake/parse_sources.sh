# To be sourced: write_parse_sources COMPILER FOLDER writes incognita.cpp, which includes everything, and baseline.cpp,
# which includes <Eigen/Dense> and the standard headers that everything uses. Sets parse_flags, what both compile with.
write_parse_sources() {
  local compiler=$1 folder=$2 include eigen headers
  include=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../include" && pwd)
  read -ra eigen < <(pkg-config --cflags eigen3)
  parse_flags=(-std=c++20 -I "$include" "${eigen[@]}" -fsyntax-only)
  echo '#include <incognita/incognita.hpp>' >"$folder/incognita.cpp"
  # -MM names the project's own headers and leaves out those of the system.
  headers=$("$compiler" "${parse_flags[@]}" -MM "$folder/incognita.cpp" | grep -o '[^ ]*\.hpp')
  {
    echo '#include <Eigen/Dense>'
    # shellcheck disable=SC2086
    grep -hoE '^#include <[a-z_0-9]+>' $headers | sort -u
  } >"$folder/baseline.cpp"
}
