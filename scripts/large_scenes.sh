#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# large_scenes.sh [FOLDER]: makes a tiled scene of a million Gaussians and prints the PE utilization
# and the time of a frame of DeGS, GSCore and GBU with 64 and 256 PEs on it, in fp32 and in the
# numbers of the paper, as a Markdown table. Complete accelerators, without reference images. Scene
# and comparisons stay in FOLDER, and what is there already is not made again. Takes a few minutes
# of one core. Environment variables: DEGS_PROGRAM (default build/release/sim/degs), DEGS_SCENES
# (default ../shared/scenes), SCENE (a scene there, or synthetic:NAME; default skull), GAUSSIANS
# (default 1000000), RESOLUTION (default 1080p), CAMERA (default 2, the close-up), DESIGNS and PES
# (lists, default "degs gscore gbu" and "64 256").
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
scene=${SCENE:-skull} gaussians=${GAUSSIANS:-1000000} resolution=${RESOLUTION:-1080p} camera=${CAMERA:-2}
out=${1:-$(mktemp -d)}
read -ra designs <<<"${DESIGNS:-degs gscore gbu}"
read -ra sizes <<<"${PES:-64 256}"
configs=()
for pes in "${sizes[@]}"; do
    for design in "${designs[@]}"; do configs+=("configs/$design-$pes.yaml"); done
done

source=$scene
[[ $scene == synthetic:* ]] || source=${DEGS_SCENES:-../shared/scenes}/$scene/scene.ply
tiled=$out/tiled.glb
[[ -e $tiled ]] || "$program" scene tile "$source" --gaussians "$gaussians" --out "$tiled" > /dev/null

# compare NUMBERS: a folder gets its name when it is complete.
compare() {
    [[ ! -e $out/$1 ]] || return 0
    rm -rf "$out/$1.part"
    "$program" compare "${configs[@]}" --scene "$tiled" --camera "$camera" --resolution "$resolution" --jobs 1 \
        --no-reference --set "pipeline.numbers=$1" --out "$out/$1.part" > /dev/null
    mv "$out/$1.part" "$out/$1"
}

# cell CSV CONFIG: utilization in percent and latency in ms.
cell() {
    awk -F, -v config="$2" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        $column["config"] == config {
            printf "%.1f | %.2f", 100 * $column["slots.utilization"], $column["latency_ms"] }' "$1"
}

compare fp32
compare paper
"$program" scene info "$tiled" --json |
    awk -F'[:,]' -v s="$scene" -v r="$resolution" -v c="$camera" '
        /"gaussians"/ { printf "%s tiled to%s Gaussians, %s, camera %s\n\n", s, $2, r, c; exit }'
echo "| design | PEs | fp32: utilization % | ms | paper's numbers: utilization % | ms |"
echo "|---|--:|--:|--:|--:|--:|"
for pes in "${sizes[@]}"; do
    for design in "${designs[@]}"; do
        echo "| $design | $pes | $(cell "$out/fp32/compare.csv" "$design-$pes") |" \
            "$(cell "$out/paper/compare.csv" "$design-$pes") |"
    done
done
