#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# resolutions.sh [--quick] [--whole] [FOLDER]: PE utilization of every shipped design from 720p to
# 8K, measured with build/release/sim/degs on one core and printed as Markdown tables: arrays alone,
# or with --whole complete accelerators with their latencies. Every comparison stays in FOLDER with
# its reports, and one that is there already is not run again; so the script goes on where it was
# stopped, and a changed program or configuration needs another FOLDER. All of it takes many hours;
# --quick runs two small comparisons. Environment variables choose what is run, as lists of words:
#     DESIGNS      names of files in configs/ without .yaml (default: all)
#     SCENES       trained scenes in DEGS_SCENES (default ../shared/scenes), or
#                  synthetic:NAME,gaussians=N
#     RESOLUTIONS  (default: 720p 1080p 2k 4k 8k)
#     CAMERAS      (default: 2 1; close-ups, and the same scenes small)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_PROGRAM:-build/release/sim/degs}
folder=${DEGS_SCENES:-../shared/scenes}
quick=no options=(--array-only) kind=array
while [[ ${1:-} == --* ]]; do
    case $1 in
    --quick) quick=yes ;;
    --whole) options=() kind=whole ;;
    *) echo "resolutions.sh: $1 is no option; there are --quick and --whole." >&2 && exit 2 ;;
    esac
    shift
done
out=${1:-$(mktemp -d)}

trained="flowers guitar seal skull st-peter"
if [[ $quick == yes ]]; then
    read -ra designs <<<"${DESIGNS:-degs-64 gscore-64 gbu-64 gcc-64}"
    read -ra scenes <<<"${SCENES:-synthetic:object,gaussians=2000 synthetic:landscape,gaussians=3000}"
    read -ra resolutions <<<"${RESOLUTIONS:-720p}"
    read -ra cameras <<<"${CAMERAS:-1}"
else
    read -ra designs <<<"${DESIGNS:-$(basename -s .yaml configs/*.yaml | tr '\n' ' ')}"
    read -ra scenes <<<"${SCENES:-$trained synthetic:landscape,gaussians=3000000}"
    read -ra resolutions <<<"${RESOLUTIONS:-720p 1080p 2k 4k 8k}"
    read -ra cameras <<<"${CAMERAS:-2 1}"
fi

# path_of SCENE RESOLUTION CAMERA: where a comparison is kept. Designs are part of its name, so that
# another list of designs is another comparison.
path_of() {
    local list
    list=$(printf '%s ' "${designs[@]}" | cksum | cut -d' ' -f1)
    echo "$out/$kind-${1//[:,=]/-}-$2-camera$3-$list"
}

# measure SCENE RESOLUTION CAMERA: runs the comparison unless it is there. It gets its name when it
# is complete.
measure() {
    local path scene=$1 files=()
    path=$(path_of "$@")
    [[ ! -e $path/compare.csv ]] || return 0
    [[ $scene == synthetic:* ]] || scene=$folder/$scene/scene.ply
    for design in "${designs[@]}"; do files+=("configs/$design.yaml"); done
    rm -rf "$path.part"
    "$program" compare "${files[@]}" --scene "$scene" --camera "$3" --resolution "$2" --jobs 1 --no-reference \
        "${options[@]}" --out "$path.part" > /dev/null
    mv "$path.part" "$path"
}

# Names of synthetic scenes have commas, so they are quoted in a comparison.
plain_csv() { sed -E 's/"[^"]*"/scene/g' "$1"; }

# cells KIND CAMERA SCENE…: a table of all designs over all resolutions with geometric means over
# the scenes. KIND is `slots`: useful share of all slots / of those that were supplied, i.e. without
# starved and drain; or `latency`: ms.
cells() {
    local what=$1 camera=$2 resolution scene files
    shift 2
    {
        for resolution in "${resolutions[@]}"; do
            for scene in "$@"; do
                files=$(path_of "$scene" "$resolution" "$camera")/compare.csv
                awk -F, -v r="$resolution" '
                    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
                    { print r, $column["config"], $column["slots.useful"], $column["slots.starved"],
                            $column["slots.drain"], $column["latency_ms"] }' <(plain_csv "$files")
            done
        done
    } | awk -v what="$what" '
        !($1 in resolution) { resolution[$1] = 1; columns[++width] = $1 }
        !($2 in design) { design[$2] = 1; rows[++height] = $2 }
        { n[$1, $2]++; useful[$1, $2] += log($3); supplied[$1, $2] += log($3 / (1 - $4 - $5)); ms[$1, $2] += log($6) }
        END {
            line = "| design |"; rule = "|---|"
            for (c = 1; c <= width; ++c) { line = line " " columns[c] " |"; rule = rule "--:|" }
            print line; print rule
            for (r = 1; r <= height; ++r) {
                line = "| " rows[r] " |"
                for (c = 1; c <= width; ++c) {
                    k = columns[c] SUBSEP rows[r]
                    if (what == "slots")
                        cell = sprintf("%.1f / %.1f", 100 * exp(useful[k] / n[k]), 100 * exp(supplied[k] / n[k]))
                    else
                        cell = sprintf("%.3f", exp(ms[k] / n[k]))
                    line = line " " cell " |"
                }
                print line
            }
            print ""
        }'
}

for resolution in "${resolutions[@]}"; do
    for scene in "${scenes[@]}"; do
        for camera in "${cameras[@]}"; do measure "$scene" "$resolution" "$camera"; done
    done
done

groups=("")
for scene in "${scenes[@]}"; do
    if [[ $scene == synthetic:* ]]; then groups+=("$scene"); else groups[0]+="$scene "; fi
done
for group in "${groups[@]}"; do
    [[ -n $group ]] || continue
    read -ra members <<<"$group"
    name=${members[0]}
    [[ ${#members[@]} -eq 1 ]] || name="geometric mean of ${#members[@]} scenes"
    for camera in "${cameras[@]}"; do
        echo "### PE utilization in percent, of all slots / of all but starved and drain: $kind, $name, camera $camera"
        echo
        cells slots "$camera" "${members[@]}"
        [[ $kind == whole ]] || continue
        echo "### Latency in ms: $name, camera $camera"
        echo
        cells latency "$camera" "${members[@]}"
    done
done
echo "comparisons with all reports: $out"
