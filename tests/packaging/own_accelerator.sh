#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# own_accelerator.sh BUILD COMPILER: copies examples/own-accelerator out of the sources, configures
# the copy, and compiles its files. With DEGS_SLOW_TESTS=1 it also builds the program, which takes
# minutes of a processor because all of DeGS is compiled once more, and runs it; it must give the
# image of the program that BUILD has of the same files.
set -euo pipefail

build=$1
compiler=$2
work=$(mktemp -d)
outside=$(mktemp -d "$build-own-accelerator.XXXXXX") # beside BUILD, so that ccache may know the relative paths
trap 'rm -rf "$work" "$outside"' EXIT
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
sources=$(cached CMAKE_HOME_DIRECTORY)

# quietly LOG COMMAND...: shows what the command says only if it fails.
quietly() { "${@:2}" >"$work/$1.log" 2>&1 || { cat "$work/$1.log"; return 1; }; }

cp -r "$sources/examples/own-accelerator" "$work"
quietly configure cmake -S "$work/own-accelerator" -B "$outside" -G Ninja -DDEGS_SOURCE="$sources" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_COMPILER_LAUNCHER="$(cached DEGS_CCACHE)" \
    -DDEGS_ARCH="$(cached DEGS_ARCH)"
objects=()
for source in "$work/own-accelerator"/*.cpp; do
    name=$(basename "$source")
    target=row_sweep
    [[ $name != main.cpp ]] || target=own-degs
    objects+=("CMakeFiles/$target.dir/$name.o")
done
quietly compile cmake --build "$outside" --target "${objects[@]}"
built=$(find "$outside" -name '*.a')
[[ ! $built ]] || { echo "the files need libraries only when the program is linked, but these were built:"; echo "$built"; exit 1; }
if [[ ! ${DEGS_SLOW_TESTS:-} ]]; then
    echo "compiled ${#objects[@]} files outside; DEGS_SLOW_TESTS=1 builds and runs the program, too"
    exit
fi

quietly build cmake --build "$outside" -j "${DEGS_JOBS:-2}"
view=(--scene "synthetic:object,gaussians=2000" --width 240)
export DEGS_CACHE= # results neither come from the cache of whoever runs this nor go there
design=$work/own-accelerator/row-sweep-64.yaml
# image PROGRAM: the checksum of the image that it renders.
image() {
    quietly run "$1" run "$design" "${view[@]}" --out "$work/run" >&2 || return 1
    sed -n 's/.*"crc32": "\([0-9a-f]*\)".*/\1/p' "$work/run/report.json"
}
there=$(image "$outside/own-degs")
here=$(image "$build/tests/own-accelerator/own-degs")
[[ $there && $there == "$here" ]] || { echo "image $there outside, $here in the build of DeGS"; exit 1; }
quietly compare "$outside/own-degs" compare "$sources/configs/degs-64.yaml" "$design" "${view[@]}" \
    --out "$work/compare"
for name in degs-64 row-sweep-64; do
    grep -q "$name" "$work/compare.log" || { cat "$work/compare.log"; exit 1; }
done
