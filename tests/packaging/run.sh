#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD COMPILER: installs a build into a folder of its own and builds and runs the project in outside/
# against it, which knows nothing but the prefix. The libraries must have been built.
set -euo pipefail

build=$1
compiler=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" --component degs >"$work/install.log"
cmake -S "$here/outside" -B "$work/outside" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/outside"
"$work/outside/outside"

for file in share/degs/configs/degs-64.yaml include/degs/modules/accelerator.hpp; do
    [[ -f $work/prefix/$file ]] || { echo "$file was not installed"; exit 1; }
done
if grep -rl "$build" "$work/prefix" --include='*.cmake' --include='*.pc'; then
    echo "these files name the build folder"
    exit 1
fi
pc=$(dirname "$(find "$work/prefix" -name degs.pc)")
PKG_CONFIG_PATH=$pc pkg-config --exists --print-errors degs
[[ $(PKG_CONFIG_PATH=$pc pkg-config --cflags degs) == *"$work/prefix/include/degs"* ]]
