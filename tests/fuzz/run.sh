#!/usr/bin/env bash
# Fuzzes all targets at once for SECONDS (60), or those that are named: tests/fuzz/run.sh [SECONDS [TARGET...]].
# Inputs that reach something new are kept in build/fuzz/corpus, findings in build/fuzz/findings; exit code 1 if there
# is any. Wants clang.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
targets=("${@:2}")
[[ ${#targets[@]} -gt 0 ]] || mapfile -t targets < <(ls tests/fuzz/corpus)

cmake --preset fuzz > /dev/null
cmake --build --preset fuzz

findings=build/fuzz/findings
mkdir -p "$findings"
declare -A running
for target in "${targets[@]}"; do
  kept=build/fuzz/corpus/$target
  mkdir -p "$kept"
  words=(--target="$target" -max_total_time="$seconds" -rss_limit_mb=2048 -malloc_limit_mb=1024 -timeout=20
    -max_len=8192 -artifact_prefix="$findings/$target-" -print_final_stats=1)
  [[ -f tests/fuzz/$target.dict ]] && words+=(-dict="tests/fuzz/$target.dict")
  nice -n 19 build/fuzz/bin/talus_fuzz "${words[@]}" "$kept" "tests/fuzz/corpus/$target" \
    > "build/fuzz/$target.log" 2>&1 &
  running[$target]=$!
done

failed=0
for target in "${targets[@]}"; do
  if wait "${running[$target]}"; then words=ended; else words="found something: $findings, build/fuzz/$target.log"; failed=1; fi
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$target.log") executions, $words"
done
exit $failed
