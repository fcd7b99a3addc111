#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# riscv.sh BUILD COMPILER PROGRAM: builds examples/riscv against an installed package, boots its
# firmware on a flat memory and on LPDDR5, and compares the checksums of both frames with those of
# PROGRAM for the same scene and views, for a design with a number set and one in single precision.
# Every boot may take a minute.
set -euo pipefail

command -v riscv64-unknown-elf-gcc >/dev/null || {
    echo "skipped: the firmware needs riscv64-unknown-elf-gcc (scripts/install.sh --tests installs it)"
    exit 77
}
build=$1
compiler=$2
program=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=tests/packaging/functions.sh
. "$(dirname "${BASH_SOURCE[0]}")/functions.sh"

quietly install cmake --install "$build" --prefix "$work/prefix" --component degs
quietly configure cmake -S "$work/prefix/share/degs/examples/riscv" -B "$work/riscv" \
    -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler"
quietly compile cmake --build "$work/riscv"
quietly generate "$program" scene generate object --gaussians 2000 --out "$work/scene.ply"
export SYSTEMC_DISABLE_COPYRIGHT_MESSAGE=1
firmware=$work/riscv/firmware.elf
for design in degs-64 gscore-64; do
    configuration=$work/prefix/share/degs/configs/$design.yaml
    for camera in 0 1; do
        quietly run "$program" run "$configuration" --scene "$work/scene.ply" --camera "$camera" --no-reference \
            --out "$work/run"
        sed -n 's/.*"crc32": "\([0-9a-f]*\)".*/image \1/p' "$work/run/report.json"
    done >"$work/expected"
    [[ $(sort -u "$work/expected" | wc -l) == 2 ]] || { echo "degs run reports:"; cat "$work/expected"; exit 1; }
    lpddr5=--lpddr5
    [[ $design == degs-64 ]] || lpddr5="--memory $work/prefix/share/degs/configs/memory/lpddr5-3200x128.yaml"
    for memory in "" "$lpddr5"; do
        begin=$EPOCHREALTIME
        # shellcheck disable=SC2086 # words of the command line
        timeout 60 "$work/riscv/riscv" "$configuration" "$work/scene.ply" "$firmware" $memory 0 1 >"$work/said" ||
            { echo "$design with '$memory' fails or takes more than 60 s:"; cat "$work/said"; exit 1; }
        taken=$(awk -v a="$begin" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f s", b - a }')
        grep '^image ' "$work/said" >"$work/images"
        diff "$work/expected" "$work/images" || { echo "$design: other images than those of degs run"; exit 1; }
        echo "$design, ${memory:+${memory##*/}, }$(tr '\n' ' ' <"$work/images")$(grep instructions "$work/said"), $taken"
    done
done
# refused SENTENCE ARGUMENT...: the platform ends with an error that says this.
refused() {
    if "$work/riscv/riscv" "${@:2}" >"$work/said" 2>&1 || ! grep -q "$1" "$work/said"; then
        echo "the platform says of ${*:2}:"
        cat "$work/said"
        exit 1
    fi
}
refused 'scene.ply is no ELF file' "$configuration" "$work/scene.ply" "$work/scene.ply"
refused 'no camera 99' "$configuration" "$work/scene.ply" "$firmware" 99
refused 'nothing.yaml' "$configuration" "$work/scene.ply" "$firmware" --memory "$work/nothing.yaml"
refused 'usage:' "$configuration" "$work/scene.ply"
