#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# accelerator_lines.sh example|all: a table of the lines of the files of examples/own-accelerator,
# or of all that an accelerator has beyond the kit, comments included, for
# docs/adding-an-accelerator.md.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
example=examples/own-accelerator
lines() { find "$@" -type f \( -name '*.hpp' -o -name '*.cpp' \) -print0 | xargs -0 cat | wc -l; }
case ${1:-} in
example)
    echo '| file | lines |'
    echo '|---|---:|'
    for file in array.hpp array.cpp config.hpp config.cpp engine.cpp analytic.cpp main.cpp CMakeLists.txt; do
        echo "| [\`$file\`](../$example/$file) | $(wc -l <"$example/$file") |"
    done
    ;;
all)
    echo '| accelerator | lines |'
    echo '|---|---:|'
    for folder in "$example" src/baselines/*/; do
        echo "$(basename "$folder") $(lines "$folder")"
    done | sort -k2 -n | sed 's/^\(.*\) \(.*\)$/| \1 | \2 |/'
    ;;
*)
    echo "usage: accelerator_lines.sh example|all" >&2
    exit 2
    ;;
esac
