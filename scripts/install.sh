#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install.sh [--tests]: installs what a fresh Debian 12 lacks to build the model (and, with --tests,
# to check it). The one list of packages of this project; does nothing when everything is present.
set -euo pipefail

packages=(
    g++ cmake ninja-build pkg-config
    libsystemc-dev libglm-dev libopenexr-dev libpng-dev zlib1g-dev libzstd-dev libzip-dev libwebp-dev libhwy-dev
    libyaml-cpp-dev nlohmann-json3-dev libcli11-dev libstb-dev libtinygltf-dev libxxhash-dev libpugixml-dev
    libjemalloc-dev
)
test_packages=(chromium libgtest-dev libgmock-dev libbenchmark-dev clang clang-format clang-tidy libclang-rt-14-dev
    ccache dpkg-dev file gcc-riscv64-unknown-elf jupyter-nbconvert libxml2-utils mandoc mkdocs-material munge mypy procps
    pyflakes3 python3 python3-ipykernel python3-jsonschema python3-matplotlib python3-numpy python3-pandas
    python3-pil python3-pip python3-pytest python3-setuptools python3-tqdm python3-wheel python3-yaml slurm-wlm
    verilator zsh)
[[ ${1:-} != --tests ]] || packages+=("${test_packages[@]}")

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
    [[ $status == 'install ok installed' ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
    echo "packages: all ${#packages[@]} are installed"
    exit 0
fi

echo "packages: installing ${missing[*]}"
as_root=()
if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null || {
        echo "packages: run this as root, or install them yourself: ${missing[*]}" >&2
        exit 1
    }
    as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}"
