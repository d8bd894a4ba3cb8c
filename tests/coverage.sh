#!/usr/bin/env bash
# Which lines and branches the quick tests run, by folder, held against tests/coverage.txt: exit code 1 where a folder
# fell below its floor. --raise writes the floors anew where more is covered; --worst lists the files with the most
# that is never run; --again reads the counters of the last run without building or testing.
#
# What is not counted though it ran: a process that ends by _exit() or is killed takes its counters along (children
# that check-plugin stops, runs that tests kill), one that may write small files only does not count, and the library
# of tests/libraries/outside has a build of its own.
# Tests labelled slow or browser are left out, so the floors are those of the quick ones.
set -euo pipefail
cd "$(dirname "$0")/.."
source cmake/setup.sh

again=no words=()
for word in "$@"; do
  case $word in
    --raise | --worst) words+=("$word") ;;
    --again) again=yes ;;
    *) sed -n '2,4s/^# //p' "$0"; exit 2 ;;
  esac
done

build=build/coverage
if [[ $again == no ]]; then
  install_missing_packages "${talus_packages[@]}" "${talus_coverage_packages[@]}"
  build_preset coverage
  rm -rf "$build/counters"
  export GCOV_ERROR_FILE=$PWD/$build/counters.errors
  rm -f "$GCOV_ERROR_FILE"
  ctest --preset coverage -j2 -LE '^slow$|browser'
fi

if [[ -s $build/counters.errors ]]; then
  sort -u "$build/counters.errors" >&2
  echo "Counters were lost, by a process that was killed while it wrote them: please run this again" >&2
  exit 1
fi

# Beside the counters of each program gcov wants the graphs that they belong to.
for program in "$build"/counters/*; do
  (cd "$build" && find "$PWD" -name '*.gcno' -not -path '*/counters/*') | while read -r graph; do
    counted=$program${graph%.gcno}.gcda
    [[ ! -f $counted ]] || ln -sf "$graph" "${counted%.gcda}.gcno"
  done
done

# A branch that only an exception takes, at each call that might throw, is the compiler's and not ours.
gcovr --root . --object-directory "$build" -j "$(nproc)" --exclude-throw-branches --exclude-unreachable-branches \
  --filter '(core|plugins|contact_models|apps)/' --json-summary "$build/coverage.json" "$build/counters"
python3 tests/coverage.py "$build/coverage.json" tests/coverage.txt "${words[@]}"
