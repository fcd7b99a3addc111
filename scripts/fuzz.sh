#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# fuzz.sh [SECONDS] [TARGET...]: builds the fuzz targets (preset `asan`, which needs clang) and runs
# each of them for SECONDS (default 600), one after the other, or only those named. What is found
# stays in build/asan/fuzz/findings, as does every input that reaches new code in
# build/asan/fuzz/corpus, where the next run goes on. The exit code is 1 if a target found
# something.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=600
if [[ ${1:-} =~ ^[0-9]+$ ]]; then
    seconds=$1
    shift
fi
cmake --preset asan >/dev/null
cmake --build --preset asan --target degs_fuzzers -j "${DEGS_JOBS:-2}"
bin=build/asan/tests/fuzz
"$bin/degs_fuzz_seeds" build/asan/fuzz/corpus
targets=("$@")
if [[ ${#targets[@]} -eq 0 ]]; then
    for file in "$bin"/*.limits; do
        targets+=("$(basename "$file" .limits)")
    done
fi
code=0
for target in "${targets[@]}"; do
    IFS=';' read -r -a limits <"$bin/$target.limits"
    findings=build/asan/fuzz/findings/$target
    mkdir -p "$findings"
    if nice "$bin/degs_fuzz_$target" "${limits[@]}" -max_total_time="$seconds" -print_final_stats=1 \
        -artifact_prefix="$findings/" "build/asan/fuzz/corpus/$target" >"$findings/log" 2>&1; then
        runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$findings/log")
        covered=$(grep -a -o 'cov: [0-9]*' "$findings/log" | tail -1)
        echo "$target: nothing found in $runs inputs of $seconds s, ${covered#cov: } edges covered"
    else
        echo "$target: a finding; see $findings"
        code=1
    fi
done
exit "$code"
