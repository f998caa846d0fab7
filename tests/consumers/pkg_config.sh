# The project of examples/embedding/pkg_config, built with the .pc files of a prefix that was moved.
# Usage: pkg_config.sh EMBEDDING BUILD FOLDER_OF_PC COMPILER INCLUDE_DIR
set -eu
embedding=$1 build=$2 export_path=$3 compiler=$4 include_dir=$5
for tool in make pkg-config; do
  command -v $tool >/dev/null || { echo "consumers/pkg_config: skipped, $tool is missing"; exit 77; }
done
export PKG_CONFIG_PATH="$export_path"

# Where the headers are now, by a path that may hold dots, and Eigen behind them.
got=$(pkg-config --variable=includedir incognita)
[ "$(realpath "$got")" = "$(realpath "$include_dir")" ] || { echo "includedir is $got, not $include_dir" >&2; exit 1; }
pkg-config --print-requires incognita | grep -q '^eigen3 >= 3.4' || { echo "eigen3 is not required" >&2; exit 1; }
pkg-config --cflags incognita | grep -q eigen3 || { echo "the flags do not lead to Eigen" >&2; exit 1; }
for flags in "$(pkg-config --cflags incognita)" "$(pkg-config --libs incognita)"; do
  case $flags in *openmp* | *-std=* | *-O*) echo "flags that are the user's to choose: $flags" >&2; exit 1 ;; esac
done
for library in pugixml yaml-cpp png; do
  pkg-config --libs incognita-io | grep -q -- "-l$library" || { echo "incognita-io does not link $library" >&2; exit 1; }
done

rm -rf "$build"
mkdir -p "$build/project"
cp "$embedding/robot.cpp" "$build"
cp "$embedding/pkg_config/Makefile" "$build/project"
make -C "$build/project" CXX="$compiler" CXXFLAGS="-O2"
cd "$build"
project/robot figures.txt
