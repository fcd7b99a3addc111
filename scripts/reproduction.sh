#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# reproduction.sh [FOLDER]: tables of docs/results.md (arrays alone) and docs/reproduction.md (whole
# accelerators, and checks against other publications), measured with build/release/sim/degs on the
# trained scenes in DEGS_SCENES (default ../shared/scenes). Every comparison stays in FOLDER with
# its reports. scripts/figures.py has the paper's figures.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
scenes=${DEGS_SCENES:-../shared/scenes}
out=${1:-$(mktemp -d)}
closeups=(flowers guitar seal skull st-peter)
views=()
for scene in "${closeups[@]}"; do
    views+=(--scene "$scenes/$scene/scene.ply")
done

# compare NAME CONFIG… -- OPTION…: a comparison in FOLDER/NAME, quietly.
compare() {
    local name=$1 configs=()
    shift
    while [[ $1 != -- ]]; do
        case $1 in
        *=*) configs+=("${1%%=*}=configs/${1#*=}.yaml") ;;
        *) configs+=("configs/$1.yaml") ;;
        esac
        shift
    done
    shift
    "$program" compare "${configs[@]}" "$@" --no-reference --out "$out/$name" > /dev/null
}

# means NAME CAMERA COLUMN…: per configuration the geometric means of columns of
# FOLDER/NAME/compare.csv over the views of a camera, tab separated, in the order of the
# configurations. Empty cells are left out.
means() {
    awk -F, -v camera="$2" -v wanted="${*:3}" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; n = split(wanted, names, " "); next }
        $column["camera"] == camera {
            config = $column["config"]
            if (!(config in seen)) { seen[config] = 1; order[++count] = config }
            for (k = 1; k <= n; ++k) {
                value = $column[names[k]]
                if (value != "") { sum[config, k] += log(value); number[config, k]++ }
            }
        }
        END {
            for (c = 1; c <= count; ++c) {
                line = order[c]
                for (k = 1; k <= n; ++k)
                    line = line "\t" (number[order[c], k] ? exp(sum[order[c], k] / number[order[c], k]) : "")
                print line
            }
        }' "$out/$1/compare.csv"
}
# mean NAME CAMERA CONFIG COLUMN
mean() { means "$1" "$2" "$4" | awk -F'\t' -v c="$3" '$1 == c { print $2 }'; }
over() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a / b }'; }

designs=(degs gscore gbu gcc)
sizes=(16 64 256 1024)
all=()
for design in "${designs[@]}"; do
    for size in "${sizes[@]}"; do all+=("$design-$size"); done
done

compare arrays degs-64-tuned "${all[@]}" -- "${views[@]}" --cameras 2,1 --array-only
for camera in 2 1; do
    echo "### Arrays alone, PE utilization in percent, geometric mean of five scenes, camera $camera"
    echo
    echo "| PEs | DeGS | GSCore | GBU | GCC |"
    echo "|--:|--:|--:|--:|--:|"
    for size in "${sizes[@]}"; do
        line="| $size |"
        for design in "${designs[@]}"; do
            line+=$(mean arrays "$camera" "$design-$size" slots.utilization | awk '{ printf " %.1f |", 100 * $1 }')
        done
        echo "$line"
    done
    mean arrays "$camera" degs-64-tuned slots.utilization | awk '{ printf "\ndegs-64-tuned: %.1f\n\n", 100 * $1 }'
done

echo "### Arrays alone at 64 PEs, PE utilization in percent by scene"
echo
echo "| scene | camera | DeGS | DeGS tuned | GSCore | GBU | GCC |"
echo "|---|--:|--:|--:|--:|--:|--:|"
for camera in 2 1; do
    for scene in "${closeups[@]}"; do
        line="| $scene | $camera |"
        for config in degs-64 degs-64-tuned gscore-64 gbu-64 gcc-64; do
            line+=$(awk -F, -v c="$config" -v s="$scene" -v v="$camera" '
                NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
                $1 == c && $column["scene"] == s && $column["camera"] == v {
                    printf " %.1f |", 100 * $column["slots.utilization"] }' "$out/arrays/compare.csv")
        done
        echo "$line"
    done
done
echo

compare whole degs-64 gscore-64 gbu-64 gcc-64 degs-64-tuned -- "${views[@]}" --cameras 2,1
for camera in 2 1; do
    echo "### Whole accelerators at 64 PEs, one frame, geometric mean of five scenes, camera $camera"
    echo
    echo "| config | latency, ms | DeGS faster | per mm2 | MB read | MB written |"
    echo "|---|--:|--:|--:|--:|--:|"
    means whole "$camera" latency_ms ratio.latency ratio.latency_per_mm2 dram.bytes_read dram.bytes_written |
        awk -F'\t' '{ printf "| %s | %.3f | %.2f | %.2f | %.1f | %.1f |\n", $1, $2, 1 / $3, 1 / $4, $5 / 1e6, $6 / 1e6 }'
    echo
done

compare path degs-64 gscore-64 gbu-64 gcc-64 degs-64-tuned -- --scene "$scenes/flowers/scene.ply" --cameras 2,1 --frames 4
for camera in 2 1; do
    echo "### Steady state over a camera path of four frames, flowers, camera $camera"
    echo
    echo "| config | fps, one frame | fps, path | throughput: DeGS higher | per mm2 |"
    echo "|---|--:|--:|--:|--:|"
    means path "$camera" fps throughput_fps ratio.throughput ratio.throughput_per_mm2 |
        awk -F'\t' '{ printf "| %s | %.0f | %.0f | %.2f | %.2f |\n", $1, $2, $3, 1 / $4, 1 / $5 }'
    echo
done

echo "### Checks against published figures"
echo
echo "| check | ours |"
echo "|---|--:|"
compare bandwidth slow=gscore-64 wide=gscore-256 fast=gscore-256 -- "${views[@]}" --cameras 1 --resolution 2k \
    --set memory.bandwidth_gb_per_s=51.2 --set fast:memory.bandwidth_gb_per_s=204.8
slow=$(mean bandwidth 1 slow latency_ms)
echo "| GSCore, 51.2 GB/s, 4 times the lanes (camera 1, 2560 px) |" \
    "$(over "$slow" "$(mean bandwidth 1 wide latency_ms)") |"
echo "| the same with 4 times the bandwidth, too | $(over "$slow" "$(mean bandwidth 1 fast latency_ms)") |"
for resolution in 720p 1080p 2k; do
    compare "slots-$resolution" gscore-64 -- "${views[@]}" --cameras 1 --resolution "$resolution" \
        --set memory.bandwidth_gb_per_s=51.2
    awk -F, -v r="$resolution" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        { sum += log(64 * $column["cycles"] / ($column["width"] * $column["height"])); ++n }
        END { printf "| GSCore lane slots per pixel at 51.2 GB/s, %s, camera 1 | %.0f |\n", r, exp(sum / n) }' \
        "$out/slots-$resolution/compare.csv"
done
compare skip none=gscore-64 obb=gscore-64 exact=gscore-64 square=gscore-64 -- "${views[@]}" --cameras 2,1 --array-only \
    --set none:array.subtile_skip=none --set exact:array.subtile_skip=exact \
    --set square:array.subtile_skip=none --set square:pipeline.tiles=square
for camera in 2 1; do
    none=$(mean skip "$camera" none cycles)
    echo "| GSCore array, exact tile lists over 3-sigma squares, camera $camera |" \
        "$(over "$(mean skip "$camera" square cycles)" "$none") |"
    echo "| GSCore array, sub-tile skipping (oriented box) on top, camera $camera |" \
        "$(over "$none" "$(mean skip "$camera" obb cycles)") |"
    echo "| the same with an exact sub-tile test |" "$(over "$none" "$(mean skip "$camera" exact cycles)") |"
    echo "| useful share of 16 x 16 squares without any skipping, percent, camera $camera |" \
        "$(mean skip "$camera" square slots.utilization | awk '{ printf "%.1f", 100 * $1 }') |"
done
compare discovery p1=gcc-64 p4=gcc-64 p8=gcc-64 -- "${views[@]}" --cameras 2,1 --array-only \
    --set p4:array.discovery_cycles=4 --set p8:array.discovery_cycles=8
for camera in 2 1; do
    for p in 4 8; do
        echo "| GCC array, cycles with a discovery of $p cycles over 1, camera $camera |" \
            "$(over "$(mean discovery "$camera" "p$p" cycles)" "$(mean discovery "$camera" p1 cycles)") |"
    done
done
echo
echo "comparisons with all reports: $out"
