#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a fresh checkout on Debian 12 to a first image: installs what is missing, builds, runs a
# synthetic scene.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
echo "== 1/3 packages"
scripts/install.sh
echo "== 2/3 build"
cmake --preset release -DDEGS_BUILD_TESTS=OFF
cmake --build --preset release --target degs_program
echo "== 3/3 run"
build/release/sim/degs run configs/degs-64.yaml --scene synthetic:lighthouse --out out/quickstart

for file in image.png image.exr report.json; do
    [[ -s out/quickstart/$file ]] || { echo "quickstart: the run left no out/quickstart/$file" >&2; exit 1; }
done
echo "The image is $PWD/out/quickstart/image.png (high dynamic range: image.exr, all numbers: report.json)"
