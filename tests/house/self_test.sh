#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Plants one violation after the other in an otherwise clean little tree: the check must accept the
# clean tree and must find each violation, by rule, file and line.
set -euo pipefail

check=$(realpath "$(dirname "${BASH_SOURCE[0]}")")/house_check.sh
places=$(mktemp -d)
trap 'rm -rf "$places"' EXIT
tree=$places/tree
licence='// SPDX-License-Identifier: Apache-2.0'
failures=0

make_tree() {
    mkdir -p "$tree"/include/degs "$tree"/src/{base,config,splat,scene,tlm,dram,modules,baselines/gscore,platform} "$tree/src/splat/wing" "$tree/sim" "$tree/tests/house"
    printf '%s\n' "$licence" '#include <vector>' '#include "base/error.hpp"' >"$tree/src/splat/a.hpp"
    printf '%s\n' "$licence" '#include "splat/a.hpp"' 'int s = snprintf(b, 2, "x");' >"$tree/src/scene/a.cpp"
    printf '%s\n' "$licence" '#include <systemc>' '#include <tlm>' '#include "tlm/b.hpp"' >"$tree/src/tlm/a.hpp"
    printf '%s\n' "$licence" '#include "splat/a.hpp"' '#include "tlm/a.hpp"' >"$tree/src/modules/a.cpp"
    printf '%s\n' "$licence" '#include "modules/a.hpp"' >"$tree/src/baselines/gscore/a.cpp"
    printf '%s\n' "$licence" 'int main() { std::cout << 1; }' 'using namespace x;' \
        '// Words' '// of two lines' 'int i; ///< of a tile' >"$tree/sim/main.cpp"
    printf '%s\n' "$licence" | tee "$tree/src/base/error.hpp" >"$tree/src/tlm/b.hpp"
    printf '%s\n' "$licence" '#include "splat/a.hpp"' >"$tree/src/splat/wing/b.hpp"
    printf '%s\n' "$licence" '#include <tlm_utils/simple_target_socket.h>' '#include "degs/b.hpp"' >"$tree/include/degs/a.hpp"
    "$(dirname "$check")/folders.py" "$tree" --print >"$tree/tests/house/folders.txt"
}
make_tree
cp -r "$tree" "$places/clean"

clean_tree() {
    rm -rf "$tree"
    cp -r "$places/clean" "$tree"
}

# finds RULE FILE LINE TEXT: after TEXT is appended to FILE, RULE must fail there and say so.
finds() {
    local rule=$1 file=$2 line=$3 text=$4 output
    clean_tree
    [[ -e $tree/$file || $rule == licence ]] || echo "$licence" >"$tree/$file"
    printf '%s\n' "$text" >>"$tree/$file"
    if output=$("$check" "$rule" "$tree") || ! grep -qF "$file:$line:" <<<"$output"; then
        echo "house $rule missed '${text:0:60}' in $file:$line; it said: $output"
        failures=$((failures + 1))
    fi
}

clean_tree
"$check" all "$tree" || { echo "the clean tree was rejected"; exit 1; }

finds arrows src/splat/a.hpp 4 '#include "tlm/clock_domain.hpp"'
finds arrows src/splat/a.hpp 4 '#include "scene/ply.hpp"'
finds arrows src/scene/a.cpp 4 '#include "modules/degs/engine.hpp"'
finds arrows src/tlm/a.hpp 5 '#include "splat/model/camera.hpp"'
finds arrows src/tlm/a.hpp 5 '  #include <src/splat/model/camera.hpp>'
finds arrows src/tlm/a.hpp 5 '#include "../config/error.hpp"'
finds arrows src/config/a.hpp 2 '#include "tlm/process.hpp"'
finds arrows src/dram/a.hpp 2 '#include "splat/model/camera.hpp"'
finds arrows src/modules/a.cpp 4 '#include "scene/ply.hpp"'
finds arrows src/modules/a.cpp 4 '#include "baselines/gscore/engine.hpp"'
finds arrows src/modules/a.cpp 4 '#include "platform/accelerator.hpp"'
finds arrows src/baselines/gscore/a.cpp 3 '#include "platform/accelerator.hpp"'
finds arrows src/baselines/gscore/a.cpp 3 '#include "sim/report/report.hpp"'
finds arrows src/platform/a.hpp 2 '#include "baselines/gscore/engine.hpp"'
finds public include/degs/a.hpp 4 '#include "config/config.hpp"'
finds public include/degs/a.hpp 4 '#include <dram/timing.hpp>'
finds public include/degs/a.hpp 4 '#include "degs/config/config.hpp"'
finds folders include/degs/a.hpp 4 '#include "splat/a.hpp"'
finds units src/scene/a.cpp 4 '#include "scene/b.cpp"'
finds systemc src/config/a.hpp 2 '#include <systemc>'
finds systemc src/splat/a.hpp 4 '#include <systemc>'
finds systemc src/scene/a.cpp 4 '#include <tlm.h>'
finds systemc src/scene/a.cpp 4 'sc_core::sc_time t;'
finds printing src/splat/a.hpp 4 'void f() { std::cout << 1; }'
finds printing src/tlm/a.hpp 5 'void f() { printf("x"); }'
finds printing src/modules/a.cpp 4 'void f() { exit(1); }'
finds printing src/modules/a.cpp 4 'void f() { std::exit(1); }'
finds namespaces src/tlm/a.hpp 5 'using namespace sc_core;'
finds length src/tlm/a.hpp 505 "$(printf '// %.0s\n' {1..501})"
finds width src/tlm/a.hpp 5 "// $(printf 'x%.0s' {1..99})"
finds width src/tlm/a.hpp 5 "int i; ///< $(printf 'ü%.0s' {1..110})"
finds comments src/tlm/a.hpp 5 '/// The same for a range.'
finds comments src/splat/a.hpp 5 $'int i;\n    // of a tile.'
finds comments include/degs/a.hpp 5 $'// Sections.\n/// Those of a cluster.'
finds casts src/tlm/a.hpp 1 'int i = static_cast<int>(d);'
finds licence src/tlm/bare.hpp 1 '#pragma once'

# finds_folder PLACE CHANGE...: after the command CHANGE, the rule must fail at PLACE.
finds_folder() {
    local place=$1 output
    shift
    clean_tree
    "$@"
    if output=$("$check" folders "$tree") || ! grep -qF "$place:" <<<"$output"; then
        echo "house folders missed $place after '$*'; it said: $output"
        failures=$((failures + 1))
    fi
}

in_file() { printf '%s\n' "$2" >>"$tree/$1"; }
# Folders of all levels: the list of the clean tree is what its sources need.
finds_folder src/base/error.hpp:2 in_file src/base/error.hpp '#include "splat/wing/b.hpp"'
finds_folder src/splat/a.hpp:4 in_file src/splat/a.hpp '#include "splat/wing/b.hpp"'
finds_folder src/tlm/b.hpp:2 in_file src/tlm/b.hpp '#include "base/error.hpp"'
finds_folder src/splat/new:1 eval 'mkdir "$tree/src/splat/new" && echo "$licence" >"$tree/src/splat/new/c.hpp"'
finds_folder tests/house/folders.txt:1 sed -i '1s/$/ src\/tlm/' "$tree/tests/house/folders.txt"
finds_folder src/scene/a.cpp:2 sed -i '/^src\/scene:/s/ src\/splat//' "$tree/tests/house/folders.txt"

# The check of links, likewise.
links=$(dirname "$check")/links_check.sh
clean_tree
echo '[here](src/tlm/a.hpp#part) [web](https://example.org) ![self](page.md "title")' >"$tree/page.md"
"$links" "$tree" || { echo "links_check.sh rejected good links"; exit 1; }
echo '[here](src/tlm/a.hpp) ![gone](images/gone.svg)' >>"$tree/page.md"
if output=$("$links" "$tree") || ! grep -qF "page.md:2: images/gone.svg" <<<"$output"; then
    echo "links_check.sh missed a dead link; it said: $output"
    failures=$((failures + 1))
fi
[[ $failures -eq 0 ]] || exit 1
echo "house self-test: every planted violation was found"
