#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# results.sh [FOLDER]: the tables of docs/results.md, measured with build/release/sim/degs on the
# trained scenes in DEGS_SCENES (default ../shared/scenes). Ratios of times come from single runs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
scenes=${DEGS_SCENES:-../shared/scenes}
out=${1:-$(mktemp -d)}
closeups=(flowers guitar seal skull st-peter)

# value FILE SECTION KEY: one scalar of a report.
value() {
    awk -v section="\"$2\":" -v key="\"$3\":" '
        $1 == section { inside = 1 }
        inside && $1 == key { gsub(/[",]/, "", $2); print $2; exit }' "$1"
}
run() { # CONFIG SCENE CAMERA [more…]
    "$program" run "configs/$1.yaml" --scene "$scenes/$2/scene.ply" --camera "$3" --out "$out" "${@:4}" \
        > /dev/null
}
percent() { awk -v x="$1" 'BEGIN { printf "%.1f", 100 * x }'; }
share() { awk -v x="$(value "$out/report.json" slots "$1")" -v t="$(value "$out/report.json" slots total)" \
    'BEGIN { printf "%.1f", 100 * x / t }'; }

echo "### Slots at 64 PEs, percent of PE-cycles in the blending window"
echo
echo "| scene | camera | config | useful | boundary | terminated | conflict | starved | blocked | cycles |"
echo "|---|--:|---|--:|--:|--:|--:|--:|--:|--:|"
for camera in 2 1; do
    for config in degs-64 degs-64-tuned; do
        product=0
        for scene in "${closeups[@]}"; do
            run "$config" "$scene" "$camera" --no-reference
            utilization=$(value "$out/report.json" slots utilization)
            product=$(awk -v p="$product" -v u="$utilization" 'BEGIN { print p + log(u) }')
            echo "| $scene | $camera | $config | $(percent "$utilization") | $(share boundary) |" \
                "$(share terminated) | $(share conflict) | $(share starved) | $(share blocked) |" \
                "$(value "$out/report.json" timing cycles) |"
        done
        awk -v p="$product" -v c="$camera" -v f="$config" -v n="${#closeups[@]}" \
            'BEGIN { printf "| **geometric mean** | %s | %s | **%.1f** | | | | | | |\n", c, f, 100 * exp(p / n) }'
    done
done

echo
echo "### Image and speed, fp32"
echo
echo "| scene | camera | exact ends, dB | outward ends, dB | updates off | simulation / reference render | reference ns per fragment |"
echo "|---|--:|--:|--:|--:|--:|--:|"
for scene in flowers flowers-small fruit-drops garden-crop guitar seal skull st-peter; do
    for camera in 0 1 2; do
        run degs-64 "$scene" "$camera" --set pipeline.numbers=fp32 # its ends are outward then
        outward=$(value "$out/report.json" image psnr_db)
        run degs-64-tuned "$scene" "$camera" --set pipeline.numbers=fp32
        report=$out/report.json
        fragments=$(value "$report" workload fragments)
        echo "| $scene | $camera | $(awk -v x="$(value "$report" image psnr_db)" 'BEGIN { printf "%.0f", x }') |" \
            "$(awk -v x="$outward" 'BEGIN { printf "%.0f", x }') |" \
            "$(($(value "$report" slots useful) - fragments)) of $fragments |" \
            "$(awk -v x="$(value "$report" host sim_over_render)" 'BEGIN { printf "%.2f", x }') |" \
            "$(awk -v s="$(value "$report" host render_s)" -v f="$fragments" 'BEGIN { printf "%.1f", 1e9 * s / f }') |"
    done
done

echo
echo "### Scaling, paper-literal, camera 2: utilisation (cycles)"
echo
echo "| scene | 16 PEs | 64 | 256 | 1024 |"
echo "|---|--:|--:|--:|--:|"
for scene in "${closeups[@]}"; do
    line="| $scene |"
    for pes in 16 64 256 1024; do
        run "degs-$pes" "$scene" 2 --no-reference
        line+=" $(percent "$(value "$out/report.json" slots utilization)") %"
        line+=" ($(value "$out/report.json" timing cycles)) |"
    done
    echo "$line"
done
