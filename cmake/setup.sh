# What examples/run, tests/run, benchmarks/run and docs/run share: Debian packages, and steps whose output goes to build/setup.log.
# The caller sets `root`, the project's folder, before it sources this file.
# shellcheck shell=bash disable=SC2034
: "${root:?}"

build_packages=(g++ cmake ninja-build pkg-config libeigen3-dev libpugixml-dev libyaml-cpp-dev libpng-dev
  nlohmann-json3-dev zlib1g-dev)
example_packages=(libcli11-dev libcairo2-dev fonts-dejavu-core gnuplot-nox libjs-chart.js libtomlplusplus-dev)
mpi_packages=(libopenmpi-dev openmpi-bin)
docs_packages=(doxygen libjs-mathjax)
test_packages=(catch2 liboctomap-dev make python3 "${mpi_packages[@]}" "${docs_packages[@]}")
benchmark_packages=(libbenchmark-dev libcli11-dev gnuplot-nox python3)
peer_packages=(liboctomap-dev libmrpt-maps-dev)
all_test_packages=(libbenchmark-dev clang libomp-dev llvm libclang-rt-14-dev)

mkdir -p "$root/build"
log="$root/build/setup.log"
: >"$log"

say() { printf '%s\n' "$*"; }

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# logged <command...>: runs a command from the project's folder with its output in the log.
logged() {
  printf '\n$ %s\n' "$*" >>"$log"
  (cd -- "$root" && "$@") >>"$log" 2>&1 </dev/null
}

# step <command...>: as logged, but a failure shows the end of the log and ends the script.
step() {
  logged "$@" && return
  tail -n 100 "$log" >&2
  fail "Set-up failed; the whole log is $log"
}

# The packages among the arguments that dpkg does not have.
missing_packages() {
  local package installed missing=()
  installed=$(dpkg-query -W -f '${Package}=${db:Status-Status}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"$package=installed"$'\n'* ]] || missing+=("$package")
  done
  echo "${missing[*]}"
}

# install_packages <package...>: installs what is missing with apt, through sudo when not root. Without apt it names the
# programs that are missing; CMake names the libraries.
install_packages() {
  local missing program sudo=()
  if ! command -v apt-get >/dev/null; then
    missing=
    for program in g++ cmake ninja pkg-config; do
      command -v "$program" >/dev/null || missing+=" $program"
    done
    [[ -z $missing ]] || fail "Missing programs:$missing. Install them and run this again (apt is not on this machine)."
    return
  fi

  missing=$(missing_packages "$@")
  [[ -n $missing ]] || return 0
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || fail "Missing packages; as root, run: apt-get install $missing"
    sudo=(sudo)
  fi
  say "Installing with ${sudo[*]:+sudo }apt-get: $missing"
  # The lists of packages are fetched only when they are absent or too old for the install to succeed.
  local install=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends
    -o DPkg::Lock::Timeout=300)
  # shellcheck disable=SC2206  # one word for each package
  install+=($missing)
  logged "${install[@]}" && return
  step "${sudo[@]}" apt-get update
  step "${install[@]}"
}

# The packages that a browser test needs and whose programs are not there, wherever they are from: another npm than Debian's
# does not go together with Debian's.
missing_browser_packages() {
  local missing=()
  command -v chromium >/dev/null || command -v chromium-browser >/dev/null || command -v google-chrome-stable >/dev/null || missing+=(chromium)
  command -v node >/dev/null || missing+=(nodejs)
  command -v npm >/dev/null || missing+=(npm)
  echo "${missing[*]}"
}

# How many compilers to run at once: one for each processor, and 2 GB of free memory for each.
job_count() {
  local processors memory_kb
  processors=$(nproc)
  memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo 2>/dev/null || true)
  local by_memory=$((${memory_kb:-2000000} / 2000000))
  ((by_memory >= 1)) || by_memory=1
  echo $((processors < by_memory ? processors : by_memory))
}
