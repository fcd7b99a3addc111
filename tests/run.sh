#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds and runs all tests, also under the sanitizers. Runs from any
# directory; stops at the first step that fails, ends with the summary of CTest and the time of each
# step, which must not be above its ceiling (house/times.py). Static analysis takes as long again:
# scripts/tidy.sh.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=${DEGS_JOBS:-2}
tests=$((jobs + 1)) # at a time: some of them wait for servers or for the clock
mkdir -p build
log=build/times.csv # of this run, complete or not
echo "step,seconds,processor_s,others,processors" >"$log"
marks=$(mktemp)
trap 'rm -f "$marks"' EXIT

# now: the seconds of the clock, those of a processor that this script used, and those that all of
# the machine used. `times` would start from zero in a subshell.
now() {
    times >"$marks"
    awk -v clock="$EPOCHREALTIME" -v ticks="$(getconf CLK_TCK)" '
        function seconds(text, parts) { split(text, parts, /[ms]/); return 60 * parts[1] + parts[2] }
        FNR == NR { own += seconds($1) + seconds($2); next }
        /^cpu / { print clock, own, ($2 + $3 + $4 + $7 + $8 + $9) / ticks }' "$marks" /proc/stat >"$marks.now"
    mv "$marks.now" "$marks"
    read -r clock own all <"$marks"
}
name=
# end_step: writes what the step took into the log.
end_step() {
    local clock own all
    now
    [[ ! $name ]] || awk -v step="$name" -v processors="$(nproc)" -v a="$began" -v b="$clock $own $all" 'BEGIN {
        split(a, before); split(b, after)
        for (i = 1; i <= 3; ++i) d[i] = after[i] - before[i]
        others = (d[3] - d[2]) / d[1]
        printf "%s,%.1f,%.1f,%.2f,%d\n", step, d[1], d[2], (others > 0 ? others : 0), processors }' >>"$log"
    began="$clock $own $all"
}
# step NAME WORDS: what follows is a step of the log and of the table of ceilings.
step() {
    end_step
    name=$1
    echo "== $(date +%M:%S -u -d "@$SECONDS") $2"
}

step "packages" "packages"
scripts/install.sh --tests

step "release" "build (preset release)"
cmake --preset release -DDEGS_BUILD_TESTS=ON
cmake --build --preset release -j "$jobs"

step "asan" "build (preset asan)"
cmake --preset asan
cmake --build --preset asan -j "$jobs"

step "asan tests" "hostile inputs, fuzz targets and small runs under the sanitizers"
ctest --preset asan -j "$tests" --no-tests=error

step "all tests" "all tests, house rules, formatting"
ctest --preset release -j "$tests" --no-tests=error -LE lint
end_step
echo "== $(date +%M:%S -u -d "@$SECONDS") time of each step, from $log"
# Another machine may be slower than that of the ceilings: DEGS_TIMES=strict makes them an error.
tests/house/times.py "$log" || [[ ${DEGS_TIMES:-} != strict ]]
