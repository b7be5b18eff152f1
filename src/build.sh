# Installs what is missing with Debian's packages and builds a release: sourced by cases/run, tests/run and bench/run.
# cinch_build TARGET... leaves the programs in $cinch_root/build/release.
set -euo pipefail

cinch_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cinch_packages=(g++ cmake ninja-build libeigen3-dev libhdf5-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev
  libjs-chart.js libjs-three libgtest-dev libbenchmark-dev)
cinch_bench_packages=(python3)  # bench/run: history, page and exports
cinch_test_packages=(python3)   # tests/run, besides a browser that looks whether the page draws its figures
cinch_browser=chromium

# Installs those of the named packages that are not there yet.
cinch_install() {
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "installing ${missing[*]}" >&2
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || {
      echo "error: missing packages; run as root: apt-get install ${missing[*]}" >&2
      exit 1
    }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq >&2
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# Configures build/PRESET where it is not yet.
cinch_configure() {
  local build=$cinch_root/build/$1
  # a folder that was copied or moved brings a build of its old place
  if [ -d "$build" ] && ! grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$cinch_root" "$build/CMakeCache.txt"; then
    rm -rf "$build"
  fi
  [ -f "$build/build.ninja" ] || (cd "$cinch_root" && cmake --preset "$1" >&2)
}

cinch_build() {
  cinch_install "${cinch_packages[@]}"
  cinch_configure release
  cmake --build "$cinch_root/build/release" --target "$@" >&2
}
