#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# workload_start.sh [FOLDER]: prints how long degs-64 takes to get its frame from a scene and from a
# workload file, as a Markdown table: load_s + workload_s of an estimate without the cache, the
# least of RUNS, one kind after the other in turn. Scenes and files stay in FOLDER. Environment
# variables: DEGS_PROGRAM (default build/release/sim/degs), DEGS_SCENES (default ../shared/scenes),
# DEGS_SCENES_LARGE (default ../shared/scenes-large), RUNS (default 5), GAUSSIANS of a landscape
# (default 1000000).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
small=${DEGS_SCENES:-../shared/scenes} large=${DEGS_SCENES_LARGE:-../shared/scenes-large}
gaussians=${GAUSSIANS:-1000000}
out=${1:-$(mktemp -d)}
mkdir -p "$out"

landscape=$out/landscape.ply
[[ -e $landscape ]] ||
    "$program" scene generate landscape "$landscape" --gaussians "$gaussians" > /dev/null
full=$out/flowers-full/lod-meta.json
if [[ -d $large/flowers-full && ! -e $full ]]; then
    python3 scripts/join_sog.py "$large/flowers-full" "$out/flowers-full" > /dev/null
fi

# start OPTION...: seconds until the frame is there.
start() {
    "$program" run configs/degs-64.yaml --no-cache --fidelity analytic "$@" --out "$out/estimate" > /dev/null
    python3 -c 'import json, sys
host = json.load(open(sys.argv[1]))["host"]
print(host["load_s"] + host["workload_s"])' "$out/estimate/analytic.json"
}

echo "| scene | from the scene, ms | from the file, ms | ratio | file, MB |"
echo "|---|--:|--:|--:|--:|"
for scene in "$small/flowers/scene.ply" "$small/garden-crop/scene.ply" "$full" "$landscape"; do
    [[ -e $scene ]] || continue
    name=$(basename "$(dirname "$scene")")
    [[ $scene != "$landscape" ]] || name=landscape
    file=$out/$name.degsw
    "$program" workload pack configs/degs-64.yaml --scene "$scene" --camera 0 --out "$file" > /dev/null
    for ((run = 0; run < ${RUNS:-5}; ++run)); do
        echo "$(start --scene "$scene" --camera 0) $(start --workload "$file")"
    done | awk -v name="$name" -v bytes="$(stat -c %s "$file")" '
        NR == 1 || $1 < scene { scene = $1 }
        NR == 1 || $2 < file { file = $2 }
        END { printf "| %s | %.0f | %.0f | %.2f | %.1f |\n", name, 1e3 * scene, 1e3 * file, file / scene, bytes / 1e6 }'
done
