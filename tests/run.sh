#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh [--all]: installs what is missing, builds, and runs the core suite: all block suites, laws,
# hard cases, the first draws of each random suite, the program, its package and Python. With --all
# also what takes long: sanitizers and fuzz targets, all draws, RTL and synthesis, projects outside,
# clusters, containers, documents, benchmarks. Runs from any directory, stops at the first step that
# fails, and ends with the time of each step. Static analysis is scripts/tidy.sh.
set -euo pipefail

case "${1:-} $#" in
    ' 0') all= ;;
    '--all 1') all=1 ;;
    *) echo "usage: run.sh [--all]" >&2; exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=${DEGS_JOBS:-2}
tests=$((jobs + 1)) # at a time: some of them wait for servers or for the clock

name= began= times=()
# step NAME: what follows is a step, whose time is printed at the end.
step() {
    [[ ! $name ]] || times+=("$name $((SECONDS - began)) s")
    name=$1 began=$SECONDS
    [[ ! $name ]] || echo "== $((SECONDS / 60)) min $((SECONDS % 60)) s: $name"
}

step "packages"
scripts/install.sh --tests

step "build"
cmake --preset release -DDEGS_BUILD_TESTS=ON -DDEGS_ALL_TESTS=OFF
cmake --build --preset release -j "$jobs"

step "core suite"
ctest --preset release -j "$tests" --no-tests=error

if [[ $all ]]; then
    step "build of what takes long"
    cmake --preset release -DDEGS_ALL_TESTS=ON
    cmake --build --preset release -j "$jobs"

    step "what takes long"
    ctest --preset all -j "$tests" --no-tests=error

    step "build with sanitizers"
    cmake --preset asan
    cmake --build --preset asan -j "$jobs"

    step "hostile inputs, small runs and fuzz targets under the sanitizers"
    ctest --preset asan -j "$tests" --no-tests=error
fi
step ""
echo "== $((SECONDS / 60)) min $((SECONDS % 60)) s: done"
printf '%s\n' "${times[@]}"
if [[ ! $all ]]; then
    left=$(ctest --test-dir build/release -N -L '^all$' | sed -n 's/^Total Tests: //p')
    echo "Left out: $left tests that take long, and those that need a build of their own: sanitizers and"
    echo "fuzz targets, RTL, benchmarks, an accelerator from outside. tests/run.sh --all runs them, too."
fi
