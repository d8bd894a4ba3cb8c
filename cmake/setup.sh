# Sourced by demo.sh, test.sh and .ci/run: what they share. Safe to run twice; the second time is quick.

talus_packages=(g++ cmake ninja-build pkg-config libeigen3-dev libboost-dev libboost-program-options-dev
  nlohmann-json3-dev libfmt-dev catch2 zlib1g-dev libxxhash-dev libgeos-dev libbenchmark-dev python3 libjs-dygraphs)

# A browser, and what drives it: reports are looked at in the tests.
talus_browser_packages=(chromium chromium-driver python3-selenium)

# What checks scenes against their JSON Schema in the tests.
talus_schema_packages=(python3-jsonschema)

# What .ci/run checks with beside the tests.
talus_check_packages=(clang clang-format clang-tidy)

# What adds up the counters of a build of preset `coverage`.
talus_coverage_packages=(gcovr)

# install_missing_packages [PACKAGE...]: installs what is missing of these, or of talus_packages. Elsewhere than on Debian and its kin it prints what is needed.
install_missing_packages() {
  if ! command -v apt-get > /dev/null || ! command -v dpkg-query > /dev/null; then
    cat >&2 <<TEXT
This is no Debian, so nothing was installed. Please install a C++20 compiler, CMake 3.25, Ninja,
pkg-config, Python 3, and the headers of Eigen 3.4, Boost 1.74 (DLL, Program_options), nlohmann-json 3.11, fmt 9,
Catch2 2.13, zlib, xxHash, GEOS 3.10, dygraphs 2 and, for the benchmarks, Google Benchmark. Debian 12 calls them:
  ${talus_packages[*]}
Then: cmake --preset release && cmake --build --preset release && ctest --preset release
TEXT
    exit 1
  fi
  local wanted=("$@") missing=() package
  (($#)) || wanted=("${talus_packages[@]}")
  for package in "${wanted[@]}"; do
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null) == installed ]] || missing+=("$package")
  done
  ((${#missing[@]})) || return 0

  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo > /dev/null; then
      printf 'Missing packages, and no sudo. Please run as root:\n  apt-get install %s\n' "${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# build_preset NAME [TARGET...]: configures, and builds these targets, or all, into build/NAME.
build_preset() {
  local preset=$1
  shift
  cmake --preset "$preset" > /dev/null
  cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
}
