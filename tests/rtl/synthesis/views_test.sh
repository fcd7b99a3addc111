#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# views_test.sh: compiles views_test.sv with Verilator and runs it. It ends with 77 if there is no
# Verilator.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")"
command -v verilator >/dev/null || { echo "skipped: Verilator is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
verilator --binary -j 1 -Wno-fatal -Wno-lint --top-module views_test -Mdir "$folder" views_test.sv \
    select_in_turn.sv select_oldest.sv segment_queue.sv >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
"$folder/Vviews_test"
