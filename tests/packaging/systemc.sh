#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# systemc.sh BUILD COMPILER [PROGRAM]: builds the library and the tests of the accelerator on a
# platform with the SystemC under the prefix DEGS_OTHER_SYSTEMC, where every warning is an error,
# also that of a deprecated call, and runs the tests. DEGS_CCI_PREFIX, if set, is that of a SystemC
# CCI that was built with this SystemC; its parameters are tested then. Installs the library and
# builds the example platform, which must give the image of PROGRAM. Keeps its build beside BUILD.
# Exits with 77 if no prefix is named.
set -euo pipefail

build=$1
compiler=$2
program=${3:-}
prefix=${DEGS_OTHER_SYSTEMC:-}
if [[ -z $prefix ]]; then
    echo "DEGS_OTHER_SYSTEMC names no other SystemC, so nothing has been built with one"
    exit 77
fi
# shellcheck source=tests/packaging/functions.sh
. "$(dirname "${BASH_SOURCE[0]}")/functions.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
other=$build-other-systemc
cmake -S "$(cached CMAKE_HOME_DIRECTORY)" -B "$other" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O1 -g0" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_COMPILER_LAUNCHER="$(cached DEGS_CCACHE)" -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 -DDEGS_BUILD_SIM=OFF -DDEGS_WARNINGS_AS_ERRORS=ON -DDEGS_BUILD_TESTS=ON \
    -DCMAKE_PREFIX_PATH="$prefix" -DDEGS_CCI_PREFIX="${DEGS_CCI_PREFIX:-}" \
    -DDEGS_SCENES="$(cached DEGS_SCENES)" >"$other.log" || { cat "$other.log"; exit 1; }
grep "degs: SystemC .*$prefix" "$other.log"
cmake --build "$other" --target degs_platform_tests
(cd "$other" && ctest -R '^platform/' --output-on-failure --no-tests=error -j "${DEGS_JOBS:-2}")

[[ $program ]] || exit 0
quietly install cmake --install "$other" --prefix "$work/prefix" --component degs
quietly configure cmake -S "$work/prefix/share/degs/examples/platform" -B "$work/platform" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/prefix"
quietly compile cmake --build "$work/platform"
make_scene "$program"
for design in degs-64 gscore-64; do
    design=$work/prefix/share/degs/configs/$design.yaml
    example_draws "$work/platform/platform" "$design" "$(image_of "$program" "$design")"
done
