#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# own_accelerator.sh BUILD COMPILER: installs what an accelerator from outside needs, moves it, and
# builds a copy of the installed examples/own-accelerator, which knows nothing but the prefix, in at
# most 60 s of a processor. The program must give the image of the one that BUILD has of the same
# files. Without the component `kit` the example must be refused with a remedy.
set -euo pipefail

build=$1
compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=tests/packaging/functions.sh
. "$(dirname "${BASH_SOURCE[0]}")/functions.sh"

quietly install cmake --install "$build" --prefix "$work/first" --component degs
mv "$work/first" "$work/prefix"
cp -r "$work/prefix/share/degs/examples/own-accelerator" "$work"
configure=(cmake -S "$work/own-accelerator" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler")
if "${configure[@]}" -B "$work/refused" >"$work/refused.log" 2>&1 ||
    ! tr -s ' \n' ' ' <"$work/refused.log" | grep -q 'no component kit: .* libdegs-kit-dev installs it'; then
    echo "a package without the component kit is not refused with a remedy:"
    cat "$work/refused.log"
    exit 1
fi

quietly install cmake --install "$build" --prefix "$work/first" --component kit
cp -r "$work/first/." "$work/prefix"
rm -r "$work/first"
# Every header that one of the kit includes by a name of this project is there.
(cd "$work/prefix/include/degs-kit" && grep -rhoP '^#include "\K[^"]+|^#include <\Kdegs/[^>]+' . | sort -u) >"$work/included"
[[ -s $work/included ]]
while read -r header; do
    [[ -f $work/prefix/include/degs-kit/$header || -f $work/prefix/include/$header ]] ||
        { echo "headers of the kit include $header, which was not installed"; exit 1; }
done <"$work/included"
if grep -rlE "$build|$work|$(cached CMAKE_HOME_DIRECTORY)" "$work/prefix" --include='*.cmake'; then
    echo "these files name the sources, the build folder, or where the package was first"
    exit 1
fi

export CCACHE_DISABLE=1 # what is measured is a first build
unset CMAKE_CXX_COMPILER_LAUNCHER
built_from_nothing() {
    quietly configure "${configure[@]}" -B "$work/outside" && quietly compile cmake --build "$work/outside"
}
taken=$(seconds 60 built_from_nothing) || { echo "$taken"; exit 1; }
echo "built outside in $taken s of a processor"

view=(--scene "synthetic:object,gaussians=2000" --width 240)
export DEGS_CACHE= # results neither come from the cache of whoever runs this nor go there
design=$work/own-accelerator/row-sweep-64.yaml
# image PROGRAM: the checksum of the image that it renders.
image() {
    quietly run "$1" run "$design" "${view[@]}" --out "$work/run" >&2 || return 1
    sed -n 's/.*"crc32": "\([0-9a-f]*\)".*/\1/p' "$work/run/report.json"
}
there=$(image "$work/outside/own-degs")
here=$(image "$build/tests/own-accelerator/own-degs")
[[ $there && $there == "$here" ]] || { echo "image $there outside, $here in the build of DeGS"; exit 1; }
quietly compare "$work/outside/own-degs" compare "$work/prefix/share/degs/configs/degs-64.yaml" "$design" "${view[@]}" \
    --out "$work/compare"
for name in degs-64 row-sweep-64; do
    grep -q "$name" "$work/compare.log" || { cat "$work/compare.log"; exit 1; }
done
