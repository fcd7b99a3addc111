#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench.sh [--print]: builds and runs degs_bench (tests/bench) and one large frame, and writes the
# results with machine and commit into docs/performance.md, or with --print to the standard output
# only. Takes some minutes, on an otherwise idle machine. Exit code 1 if a limit is exceeded.
# Trained scenes are in DEGS_SCENES (default ../shared/scenes). SCENE, CAMERA and RESOLUTION choose
# the large frame, BENCH_ARGUMENTS is for degs_bench (e.g. --short). DEGS_BUILD is a folder in which
# both have been built; without it the script builds them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${DEGS_BUILD:-build/release}
scene=${SCENE:-synthetic:landscape,gaussians=5000000} camera=${CAMERA:-1} resolution=${RESOLUTION:-4k}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

if [[ -z ${DEGS_BUILD:-} ]]; then
    cmake --preset release >/dev/null
    cmake --build --preset release --target degs_program degs_bench >/dev/null
fi

missed=0
read -ra arguments <<<"${BENCH_ARGUMENTS:-}"
"$build/tests/bench/degs_bench" "${arguments[@]}" --benchmark_out="$folder/bench.json" \
    --benchmark_out_format=json >&2 || missed=1

# `script` gives the program a terminal, on which it shows its progress.
script --quiet --return --command "'$build/sim/degs' run configs/degs-64.yaml --scene '$scene' --camera '$camera' \
    --resolution '$resolution' --no-cache --out '$folder/large'" "$folder/typescript" >/dev/null

scripts/bench_table.py "$folder/bench.json" "$folder/large/report.json" "$folder/typescript" "$@" || missed=1
exit "$missed"
