#!/usr/bin/env bash
# Builds and tests with each compiler that is installed: what must pass before a change goes in.
set -euo pipefail
cd "$(dirname "$0")"

for compiler in g++ clang++; do
  if ! command -v "$compiler" > /dev/null; then
    echo "$compiler is not installed: not built with it"
    continue
  fi
  cmake -S . -B "build/$compiler" -DCMAKE_CXX_COMPILER="$compiler" "$@"
  cmake --build "build/$compiler"
  ctest --test-dir "build/$compiler" --output-on-failure
done
