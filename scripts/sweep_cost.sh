#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# sweep_cost.sh: times a study of 64 points on one scene against 64 single runs of the same points,
# one at a time, and prints both with their ratio. Fails if the study takes more than MOST (default
# 0.75) of the single runs' time. SCENE, WIDTH and CAMERA choose the view; DEGS_PROGRAM is the
# program, default build/release/sim/degs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
scene=${SCENE:-synthetic:object} width=${WIDTH:-320} camera=${CAMERA:-0} most=${MOST:-0.75}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/study.yaml" <<YAML
study: cost
designs:
  - include: $PWD/configs/degs-64.yaml
    name: degs-64
axes:
  gaussian_buffer.bytes: 36KB..288KB x2
  packing.bytes: 16KB..128KB x2
  memory.bandwidth_gb_per_s: 25.6..204.8 x2
YAML
now() { date +%s.%N; }

start=$(now)
"$program" sweep "$folder/study.yaml" --scene "$scene" --width "$width" --camera "$camera" --out "$folder/sweep" \
    >"$folder/said" 2>&1 || { cat "$folder/said"; exit 1; }
sweep=$(awk "BEGIN { print $(now) - $start }")
points=$(tail -n +2 "$folder/sweep/results.csv" | wc -l)

start=$(now)
while IFS=, read -r _ _ gaussians packing bandwidth _; do
    "$program" run configs/degs-64.yaml --scene "$scene" --width "$width" --camera "$camera" --out "$folder/run" \
        --set gaussian_buffer.bytes="$gaussians" --set packing.bytes="$packing" \
        --set memory.bandwidth_gb_per_s="$bandwidth" >/dev/null 2>&1
done < <(tail -n +2 "$folder/sweep/results.csv")
single=$(awk "BEGIN { print $(now) - $start }")

awk "BEGIN { printf \"%d points: sweep %.1f s, single runs %.1f s, ratio %.2f\n\", $points, $sweep, $single,
    $sweep / $single; exit !($points == 64 && $sweep <= $most * $single) }"
