#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ranges.sh [--quick] [--tables] [FOLDER]: the tables of docs/readings.md: what the published
# figures become over the readings that the paper's text allows, and what every single assumption is
# worth, measured with build/release/sim/degs on one core and printed as Markdown. Single readings
# are FOLDER/readings-speed.csv and FOLDER/readings-utilization.csv, of which docs has copies. Every
# comparison stays in FOLDER with its reports, and one that is there already is not run again; a
# changed program or configuration needs another FOLDER. All of it takes some twenty minutes;
# --quick measures one tiny view, and --tables runs nothing and prints what FOLDER has. Environment
# variables choose what is run, as lists of words:
#     SCENES      trained scenes in DEGS_SCENES (default ../shared/scenes), or
#                 synthetic:NAME,gaussians=N
#                 (default: flowers st-peter)
#     RESOLUTION  of the views of utilisation and speed-ups, or their width (default 1080p)
#     CAMERAS     (default: 2 1; close-ups, and the same scenes small)
#     GAUSSIANS   of the synthetic outdoor scene (default: 1000000 3000000 6000000)
#     KINDS       which measurements (default: speed utilization small-tiles frames)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
folder=${DEGS_SCENES:-../shared/scenes}
scenes="flowers st-peter" resolution=${RESOLUTION:-1080p} cameras="2 1" gaussians="1000000 3000000 6000000" run=yes
while [[ ${1:-} == --* ]]; do
    case $1 in
    --quick) scenes=synthetic:object,gaussians=500 resolution=${RESOLUTION:-320} cameras=1 gaussians=500 ;;
    --tables) run=no ;;
    *) echo "ranges.sh: $1 is no option; there are --quick and --tables." >&2 && exit 2 ;;
    esac
    shift
done
out=${1:-$(mktemp -d)}
read -ra scenes <<<"${SCENES:-$scenes}"
read -ra cameras <<<"${CAMERAS:-$cameras}"
read -ra gaussians <<<"${GAUSSIANS:-$gaussians}"
read -ra kinds <<<"${KINDS:-speed utilization small-tiles frames}"

# Readings, a line each: name | file | class | settings. A reading of a baseline is compared with
# the shipped DeGS and the other way round. Classes:
#     shipped   as the file has it
#     open      the text leaves it open
#     against   a sentence of the paper says otherwise
#     squares   of all designs at once: the lists of the 3-sigma square; compared with each other
#               only
#     slow      the same with the slow memory of Sec. V-E
limited="span_buffer.ports=1 packing.ports=2 feature_buffer.ports=1 feature_buffer.sram_banks=8 \
feature_buffer.fill_cycles=1 pixel_buffer.ports=1 pixel_buffer.sram_banks=32"
narrow="slicing.distribution=broadcast pixel_buffer.state_bytes=16"
engines="tile_size=16 engines.count=8 engines.row_pes=8" # and their share of the one scheduler, or all rows at once
wide="slicing.rows=tile pixel_buffer.release=bank span.rows=pool scheduler.termination=task"

readings_speed() {
    cat <<END
degs | degs-64 | shipped |
degs-broadcast | degs-64 | open | slicing.distribution=broadcast
degs-skip | degs-64 | open | slicing.distribution=broadcast_skip
degs-one-context | degs-64 | open | pixel_buffer.state_bytes=16
degs-2-streams | degs-64 | open | slicing.interleave=2
degs-4-streams | degs-64 | against | slicing.interleave=4 slicing.count=4 pixel_buffer.bytes=32768
degs-rows | degs-64 | open | slicing.rows=tile
degs-release | degs-64 | open | pixel_buffer.release=bank
degs-pool | degs-64 | open | span.rows=pool
degs-ports | degs-64 | open | $limited
degs-task | degs-64 | open | scheduler.termination=task
degs-least | degs-64 | open | $narrow $limited
degs-most | degs-64 | open | $wide slicing.interleave=2
degs-pixel | degs-64 | against | scheduler.termination=pixel
degs-ends | degs-64 | against | pipeline.span_ends=exact
degs-dead-rows | degs-64 | against | slicing.skip_dead_rows=true
degs-tuned | degs-64-tuned | against | degs-64-tuned
degs-squares | degs-64 | squares | pipeline.tiles=square
degs-squares-least | degs-64 | squares | pipeline.tiles=square $narrow $limited
degs-squares-most | degs-64 | squares | pipeline.tiles=square $wide slicing.interleave=2
degs-slow | degs-64 | slow | memory.bandwidth_gb_per_s=51.2
gscore | gscore-64 | shipped |
gscore-none | gscore-64 | open | array.subtile_skip=none
gscore-exact | gscore-64 | open | array.subtile_skip=exact
gscore-clusters | gscore-64 | against | array.clusters=4
gscore-deep | gscore-64 | against | array.termination_cycles=192 array.pipeline_cycles=192
gscore-least | gscore-64 | against | array.subtile_skip=none array.termination_cycles=192 array.pipeline_cycles=192
gscore-squares | gscore-64 | squares | pipeline.tiles=square
gscore-squares-exact | gscore-64 | squares | pipeline.tiles=square array.subtile_skip=exact
gscore-squares-none | gscore-64 | squares | pipeline.tiles=square array.subtile_skip=none
gscore-slow | gscore-64 | slow | memory.bandwidth_gb_per_s=51.2
gbu | gbu-64 | shipped |
gbu-8-of-8 | gbu-64 | open | $engines engines.rows_per_cycle=1
gbu-4-of-16 | gbu-64 | open | tile_size=16 engines.count=4 engines.row_pes=16 engines.rows_per_cycle=2
gbu-1-of-64 | gbu-64 | open | tile_size=64 engines.count=1 engines.row_pes=64 engines.rows_per_cycle=8
gbu-all-rows | gbu-64 | open | engines.rows_per_cycle=0
gbu-short | gbu-64 | open | engines.queue_depth=1
gbu-long | gbu-64 | open | engines.queue_depth=64
gbu-no-probe | gbu-64 | against | engines.end_probe=false
gbu-least | gbu-64 | open | tile_size=64 engines.count=1 engines.row_pes=64 engines.rows_per_cycle=8 engines.queue_depth=1
gbu-most | gbu-64 | open | $engines engines.rows_per_cycle=0 engines.queue_depth=64
gbu-squares | gbu-64 | squares | pipeline.tiles=square
gbu-squares-most | gbu-64 | squares | pipeline.tiles=square $engines engines.rows_per_cycle=0 engines.queue_depth=64
gbu-slow | gbu-64 | slow | memory.bandwidth_gb_per_s=51.2
gcc | gcc-64 | shipped |
gcc-2 | gcc-64 | open | array.discovery_cycles=2
gcc-4 | gcc-64 | open | array.discovery_cycles=4
gcc-8 | gcc-64 | open | array.discovery_cycles=8
gcc-squares | gcc-64 | squares | pipeline.tiles=square
gcc-slow | gcc-64 | slow | memory.bandwidth_gb_per_s=51.2
END
}

readings_utilization() {
    local n
    for n in 16 1024; do
        cat <<END
degs-$n | degs-$n | shipped |
degs-$n-broadcast | degs-$n | open | slicing.distribution=broadcast
degs-$n-one-context | degs-$n | open | pixel_buffer.state_bytes=16
degs-$n-rows | degs-$n | open | slicing.rows=tile
degs-$n-release | degs-$n | open | pixel_buffer.release=bank
degs-$n-pool | degs-$n | open | span.rows=pool
degs-$n-task | degs-$n | open | scheduler.termination=task
degs-$n-ports | degs-$n | open | $limited
degs-$n-least | degs-$n | open | $narrow $limited
degs-$n-pixel | degs-$n | against | scheduler.termination=pixel
degs-$n-ends | degs-$n | against | pipeline.span_ends=exact
degs-$n-squares | degs-$n | squares | pipeline.tiles=square
gscore-$n | gscore-$n | shipped |
gscore-$n-none | gscore-$n | open | array.subtile_skip=none
gscore-$n-exact | gscore-$n | open | array.subtile_skip=exact
gscore-$n-squares | gscore-$n | squares | pipeline.tiles=square
gscore-$n-squares-none | gscore-$n | squares | pipeline.tiles=square array.subtile_skip=none
gbu-$n | gbu-$n | shipped |
gbu-$n-small | gbu-$n | open | tile_size=16 engines.count=$((n / 8)) engines.row_pes=8 engines.rows_per_cycle=$((n < 64 ? 64 / n : 1))
gbu-$n-all-rows | gbu-$n | open | engines.rows_per_cycle=0
gbu-$n-small-all-rows | gbu-$n | open | tile_size=16 engines.count=$((n / 8)) engines.row_pes=8 engines.rows_per_cycle=0
gbu-$n-short | gbu-$n | open | engines.queue_depth=1
gbu-$n-long | gbu-$n | open | engines.queue_depth=64
gbu-$n-squares | gbu-$n | squares | pipeline.tiles=square
END
    done
    echo "degs-16-most | degs-16 | open | $wide"
    echo "degs-1024-2-streams | degs-1024 | open | slicing.interleave=2"
    echo "degs-1024-4-streams | degs-1024 | against | slicing.interleave=4 pixel_buffer.bytes=524288"
    echo "degs-1024-most | degs-1024 | open | $wide slicing.interleave=2"
    echo "degs-1024-tuned | degs-1024-tuned | against | degs-1024-tuned"
}

readings_small-tiles() { # the paper's Table II: tiles of 16 px, 64 PEs
    local design m class=open
    for design in degs-64 degs-64-tuned; do
        for m in 1 2 4 8; do
            echo "$design-$m | $design | $class | tile_size=16 slicing.interleave=$m slicing.count=$((m > 2 ? m : 2))"
        done
        class=against
    done
    echo "degs-64-wide | degs-64 | open | tile_size=16 $wide slicing.interleave=8 slicing.count=8"
    echo "gscore-64 | gscore-64 | shipped |"
    echo "gscore-64-none | gscore-64 | open | array.subtile_skip=none"
    echo "gbu-64-tiles | gbu-64 | open | $engines engines.rows_per_cycle=1"
}

readings_frames() { printf '%s\n' "degs | degs-64 | shipped |" "gscore | gscore-64 | shipped |" \
    "gbu | gbu-64 | shipped |" "gcc | gcc-64 | shipped |"; }

# measure KIND SCENE CAMERA RESOLUTION|WIDTH [OPTION…]: one view of all readings of a kind.
measure() {
    local kind=$1 scene=$2 size=--resolution path files=() sets=() name file class settings setting
    [[ $4 == *[!0-9]* ]] || size=--width
    path=$out/$kind-${scene//[:,=]/-}-camera$3
    [[ $run == yes && ! -e $path/compare.csv ]] || return 0
    [[ $scene == synthetic:* ]] || scene=$folder/$scene/scene.ply
    while IFS='|' read -r name file class settings; do
        files+=("${name// /}=configs/${file// /}.yaml")
        for setting in $settings; do
            [[ $setting != *=* ]] || sets+=(--set "${name// /}:$setting")
        done
    done < <("readings_$kind")
    rm -rf "$path.part"
    "$program" compare "${files[@]}" "${sets[@]}" --scene "$scene" --camera "$3" "$size" "$4" --jobs 1 \
        --no-reference "${@:5}" --out "$path.part" > /dev/null
    mv "$path.part" "$path"
}

# table TABLE KIND [1]: scripts/ranges.awk makes a table from the readings of a kind and their runs.
table() {
    local csv
    {
        "readings_$2" | sed 's/^/reading | /'
        for csv in "$out/$2"-*/compare.csv; do
            [[ -e $csv && $csv != *.part/* ]] || continue
            sed -E 's/"[^"]*"/scene/g' "$csv" | awk -F, -v view="$(basename "$(dirname "$csv")")" '
                NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
                { print "run | " view " | " $column["config"] " | " $column["camera"] " | " $column["latency_ms"] " | " \
                        $column["area_mm2"] " | " $column["slots.utilization"] }'
        done
    } | awk -F ' *[|] *' -v table="$1" -v csv="${3:-0}" -v cameras="${cameras[*]}" -f scripts/ranges.awk
}

wanted() { [[ " ${kinds[*]} " == *" $1 "* ]]; }

for camera in "${cameras[@]}"; do
    for scene in "${scenes[@]}"; do
        ! wanted speed || measure speed "$scene" "$camera" "$resolution"
        ! wanted utilization || measure utilization "$scene" "$camera" "$resolution" --array-only
        ! wanted small-tiles || measure small-tiles "$scene" "$camera" 720p --array-only
    done
done
if wanted frames; then
    for scene in "${scenes[@]}"; do
        for camera in "${cameras[@]}"; do measure frames "$scene" "$camera" "$resolution"; done
    done
    for number in "${gaussians[@]}"; do measure frames "synthetic:landscape,gaussians=$number" 2 "$resolution"; done
fi

if wanted utilization; then
    echo "### PE utilization in percent, 16 and 1024 PEs, arrays alone: the range"
    echo
    table least-most utilization
    table one-change utilization 1 > "$out/readings-utilization.csv"
fi
if wanted speed; then
    echo "### Speed-up per mm2 of DeGS-64 over the baselines, one frame: the range"
    echo
    table range speed
    table speed speed 1 > "$out/readings-speed.csv"
fi
if wanted frames; then
    echo "### Speed-up per mm2 of DeGS-64 over the baselines, one frame, by view"
    echo
    table frames frames
fi
if wanted small-tiles; then
    echo "### PE utilization in percent, tiles of 16 px, 64 PEs, 720p, arrays alone"
    echo
    table one-change small-tiles
fi
echo "comparisons with all reports: $out"
