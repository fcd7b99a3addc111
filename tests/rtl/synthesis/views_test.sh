#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# views_test.sh: compiles views_test.sv and pipelined_test.sv with Verilator and runs them. It ends
# with 77 if there is no Verilator.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")"
command -v verilator >/dev/null || { echo "skipped: Verilator is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
compare() { # the test and the views that it has
    local -r test=$1
    shift
    verilator --binary -j 1 -Wno-fatal -Wno-lint --top-module "$test" -Mdir "$folder/$test" "$test.sv" "$@" \
        >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
    "$folder/$test/V$test"
}
compare views_test select_in_turn.sv select_oldest.sv segment_queue.sv select_foreseen.sv
compare pipelined_test pipelined_select.sv
compare packing_test ../packing_unit.sv
