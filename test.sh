#!/usr/bin/env bash
# Sets up, builds and runs every test. Arguments go to ctest: ./test.sh -R plugin
set -euo pipefail
cd "$(dirname "$0")"
source cmake/setup.sh

install_missing_packages
build_preset release
ctest --preset release -j2 "$@"
