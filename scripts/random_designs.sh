#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# random_designs.sh [N [SEED [JOBS]]]: draws N designs (default 200) over all keys of all
# accelerators, runs each of them in processes of its own, JOBS at a time (default 1), and prints a
# command line for every one that hangs, crashes, breaks an invariant or shows a wrong image. The
# exit code is 1 if there is one. docs/random-designs.md explains what is checked.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${DEGS_RANDOM_DESIGNS:-build/release/tests/random/degs_random_designs}
[[ -x $program ]] || {
    echo "$program is missing; build it with: cmake --preset release && cmake --build build/release" >&2
    exit 2
}
exec "$program" --designs "${1:-200}" --seed "${2:-1}" --jobs "${3:-1}"
