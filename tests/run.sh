#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds and runs all tests, also under the sanitizers. Runs from any
# directory; stops at the first step that fails, ends with the summary of CTest. Static analysis
# takes as long again: scripts/tidy.sh.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=${DEGS_JOBS:-2}
step() { echo "== $(date +%M:%S -u -d "@$SECONDS") $*"; }

step "packages"
scripts/install.sh --tests

step "build (preset release)"
cmake --preset release -DDEGS_BUILD_TESTS=ON
cmake --build --preset release -j "$jobs"

step "build (preset asan)"
cmake --preset asan
cmake --build --preset asan -j "$jobs"

step "hostile inputs and small runs under the sanitizers"
ctest --preset asan -j "$jobs" --no-tests=error

if command -v clang++ >/dev/null; then
    step "fuzz targets of the readers (preset fuzz)"
    cmake --preset fuzz
    cmake --build --preset fuzz -j "$jobs"
    ctest --preset fuzz -j "$jobs" --no-tests=error
fi

step "all tests, house rules, formatting"
ctest --preset release -j "$jobs" --no-tests=error -LE lint
