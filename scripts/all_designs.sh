#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# all_designs.sh: runs shipped designs on two scenes at 720p, 4K and 8K and prints a table. A run
# fails if it takes longer than its limit (a hang), ends with an error (a broken invariant is one),
# or shows an image below the floor against the double-precision reference. The exit code is 1 if a
# run fails. Environment variables choose what is run; the first three are lists of words:
#     DESIGNS      names of files in configs/ without .yaml (default: all)
#     SCENES       scene files or synthetic scenes (default: synthetic:object, and flowers of
#                  DEGS_SCENES if it exists)
#     RESOLUTIONS  (default: 720p 4k 8k)
#     SECONDS_EACH limit of a run in seconds of wall-clock time (default: 3600)
#     REFERENCE    no: skip the reference image, which an 8K run spends much of its time with
#                  (default: yes)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
flowers=${DEGS_SCENES:-../shared/scenes}/flowers/scene.ply
read -ra designs <<<"${DESIGNS:-$(basename -s .yaml configs/*.yaml | tr '\n' ' ')}"
read -ra scenes <<<"${SCENES:-synthetic:object $([[ ! -e $flowers ]] || echo "$flowers")}"
read -ra resolutions <<<"${RESOLUTIONS:-720p 4k 8k}"
limit=${SECONDS_EACH:-3600}
options=()
[[ ${REFERENCE:-yes} == yes ]] || options+=(--no-reference)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# floor_of DESIGN: PSNR in dB that its image must reach. Formats decide: `paper` with outward ends
# stays above 50 dB, `tuned` and single precision (the baselines) above 70 dB.
floor_of() {
    case $1 in
    *-tuned) echo 70 ;;
    degs-*) echo 50 ;;
    *) echo 70 ;;
    esac
}

# row DESIGN SCENE RESOLUTION: a line of the table out of the report; fails if the image is below
# the floor.
row() {
    python3 - "$out/report.json" "$1" "$2" "$3" "$(floor_of "$1")" <<'PYTHON'
import json, sys
file, design, scene, resolution, floor = sys.argv[1:]
with open(file) as text:
    report = json.load(text)
psnr = report["image"]["psnr_db"]
psnr = float(psnr) if psnr is not None else None
good = psnr is None or psnr >= float(floor)
timing, slots = report["timing"], report["slots"]
print(f"| {design} | {scene} | {resolution} | {timing['cycles']:,} | {timing['fps']:.1f} | "
      f"{100 * (slots['utilization'] or 0):.1f} | {'–' if psnr is None else f'{psnr:.1f}'} | "
      f"{report['host']['wall_s']:.0f} | {'' if good else f'below {floor} dB'} |")
sys.exit(0 if good else 1)
PYTHON
}

failed=0
echo "| design | scene | height | cycles | fps | utilization % | PSNR dB | host s | |"
echo "|---|---|---|---:|---:|---:|---:|---:|---|"
for scene in "${scenes[@]}"; do
    short=${scene#synthetic:}
    [[ $short != */* ]] || short=$(basename "$(dirname "$short")")
    for resolution in "${resolutions[@]}"; do
        for design in "${designs[@]}"; do
            status=0
            timeout "$limit" "$program" run "configs/$design.yaml" --scene "$scene" --camera 2 --resolution "$resolution" \
                "${options[@]}" --out "$out" >"$out/said" 2>&1 || status=$?
            if [[ $status -eq 0 ]]; then
                row "$design" "$short" "$resolution" || failed=$((failed + 1))
            else
                [[ $status -ne 124 ]] || echo "no end within $limit s" >"$out/said"
                echo "| $design | $short | $resolution | | | | | | **$(tail -n 1 "$out/said")** |"
                failed=$((failed + 1))
            fi
        done
    done
done
[[ $failed -eq 0 ]] || { echo "$failed runs failed" >&2; exit 1; }
