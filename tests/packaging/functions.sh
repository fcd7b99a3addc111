# SPDX-License-Identifier: Apache-2.0
# What the scripts of this folder share. $build is the build folder, $work a temporary one.
# shellcheck shell=bash disable=SC2154

# cached VARIABLE: its value in the build.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
# quietly LOG COMMAND...: shows what the command says only if it fails.
quietly() { "${@:2}" >"$work/$1.log" 2>&1 || { cat "$work/$1.log"; return 1; }; }
# seconds LIMIT COMMAND...: runs it, and fails with it or if it takes more time of processors.
# Prints the time, or why it failed.
seconds() {
    local TIMEFORMAT='%U %S' said taken
    said=$({ time "${@:2}" >&2; } 2>&1) || { echo "$said"; return 1; }
    taken=$(awk 'END { print $1 + $2 }' <<<"$said")
    awk -v t="$taken" -v l="$1" 'BEGIN { exit !(t <= l) }' || { echo "took $taken s of a processor: $2"; return 1; }
    echo "$taken"
}
# make_scene PROGRAM: $work/scene.ply, for the function below and the example platform.
make_scene() { "$1" scene generate object --gaussians 2000 --out "$work/scene.ply" >"$work/generate.log"; }
# image_of PROGRAM DESIGN: the checksum that `degs run` reports of that scene.
image_of() {
    "$1" run "$2" --scene "$work/scene.ply" --no-reference --out "$work/run" >"$work/run.log"
    sed -n 's/.*"crc32": "\([0-9a-f]*\)".*/\1/p' "$work/run/report.json" | grep . ||
        { echo "the report has no checksum" >&2; return 1; }
}
# example_draws PLATFORM DESIGN IMAGE: the example platform draws that image of that scene.
example_draws() {
    SYSTEMC_DISABLE_COPYRIGHT_MESSAGE=1 "$1" "$2" "$work/scene.ply" | tee "$work/said"
    grep -q "image $3\$" "$work/said" || { echo "degs run renders the image $3"; return 1; }
}
