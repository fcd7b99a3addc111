#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# sweep_cost.sh: times a study of 64 points on one scene against 64 single runs of the same points,
# one at a time, and prints both with their ratio, on the clock and of a processor. Fails if the
# study takes more than MOST (default 0.4) of the processor time of the single runs. SCENE, WIDTH
# and CAMERA choose the view; DEGS_PROGRAM is the program, default build/release/sim/degs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
scene=${SCENE:-synthetic:object} width=${WIDTH:-320} camera=${CAMERA:-0} most=${MOST:-0.4}
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
TIMEFORMAT='%R %U %S' # seconds of the clock, of the program, and of the system for it

measured() { # FILE COMMAND...: its seconds, into the file
    local file=$1
    shift
    { time "$@" >"$folder/said" 2>&1; } 2>"$file" || { cat "$folder/said"; exit 1; }
}
single_runs() {
    while IFS=, read -r _ _ gaussians packing bandwidth _; do
        "$program" run configs/degs-64.yaml --scene "$scene" --width "$width" --camera "$camera" --out "$folder/run" \
            --set gaussian_buffer.bytes="$gaussians" --set packing.bytes="$packing" \
            --set memory.bandwidth_gb_per_s="$bandwidth" || return
    done < <(tail -n +2 "$folder/sweep/results.csv")
}

measured "$folder/sweep.s" "$program" sweep "$folder/study.yaml" --scene "$scene" --width "$width" --camera "$camera" \
    --out "$folder/sweep"
measured "$folder/single.s" single_runs
points=$(tail -n +2 "$folder/sweep/results.csv" | wc -l)
awk -v points="$points" -v most="$most" '
    { clock[FNR == NR] = $1; processor[FNR == NR] = $2 + $3 }
    END {
        printf "%d points: sweep %.1f s, single runs %.1f s, ratio %.2f; of a processor %.1f s, %.1f s, ratio %.2f\n",
            points, clock[1], clock[0], clock[1] / clock[0], processor[1], processor[0], processor[1] / processor[0]
        exit !(points == 64 && processor[1] <= most * processor[0])
    }' "$folder/sweep.s" "$folder/single.s"
