#!/usr/bin/env bash
# Sets up, builds and runs every test. Arguments go to ctest: ./test.sh -R plugin
set -euo pipefail
cd "$(dirname "$0")"
source cmake/setup.sh

install_missing_packages
(install_missing_packages "${talus_browser_packages[@]}") || echo "No browser: reports are not looked at" >&2
(install_missing_packages "${talus_schema_packages[@]}") || echo "No python3-jsonschema: the schema is not held against scenes" >&2
build_preset release
ctest --preset release -j2 "$@"
