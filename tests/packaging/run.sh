#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD COMPILER: the three ways in which another project uses DeGS.
# 1. find_package: installs a build into a folder of its own and builds and runs outside/, which knows nothing but
#    the prefix. The libraries must have been built.
# 2. pkg-config: compiles and links embedded/main.cpp with what degs.pc says.
# 3. add_subdirectory: builds and runs embedded/, with SystemC as a package for CMake, as a source build installs
#    it. Compiles a few rooms once more, with the flags of BUILD, so that ccache knows the objects.
set -euo pipefail

build=$1
compiler=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
embedded=$(mktemp -d "$build-embedded.XXXXXX") # beside BUILD, so that relative paths are those of its objects, too
trap 'rm -rf "$work" "$embedded"' EXIT

cmake --install "$build" --prefix "$work/prefix" --component degs >"$work/install.log"
cmake -S "$here/outside" -B "$work/outside" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/outside"
"$work/outside/outside"

for file in share/degs/configs/degs-64.yaml include/degs/platform/accelerator.hpp; do
    [[ -f $work/prefix/$file ]] || { echo "$file was not installed"; exit 1; }
done
if grep -rl "$build" "$work/prefix" --include='*.cmake' --include='*.pc'; then
    echo "these files name the build folder"
    exit 1
fi
pc=$(dirname "$(find "$work/prefix" -name degs.pc)")
PKG_CONFIG_PATH=$pc pkg-config --exists --print-errors degs
[[ $(PKG_CONFIG_PATH=$pc pkg-config --cflags degs) == *"$work/prefix/include/degs"* ]]
flags=$(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs degs)
# shellcheck disable=SC2086 # words of the command line
"$compiler" "$here/embedded/main.cpp" -O2 -Wno-psabi $flags -o "$work/by_pkg_config"
"$work/by_pkg_config"

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
sources=$(cached CMAKE_HOME_DIRECTORY)
mkdir "$work/systemc" "$work/without_systemc"
IFS=: read -ra places <<<"$(pkg-config --variable pc_path pkg-config)"
for place in "${places[@]}"; do
    [[ ! -d $place ]] || find "$place" -name '*.pc' ! -name 'systemc*' -exec ln -sf -t "$work/without_systemc" {} +
done
cat >"$work/systemc/SystemCLanguageConfig.cmake" <<END
add_library(SystemC::systemc UNKNOWN IMPORTED)
set_target_properties(SystemC::systemc PROPERTIES
    IMPORTED_LOCATION "$(cached pkgcfg_lib_SYSTEMC_systemc)"
    INTERFACE_INCLUDE_DIRECTORIES "$(cached SYSTEMC_INCLUDE_DIRS)")
END
PKG_CONFIG_LIBDIR=$work/without_systemc cmake -S "$here/embedded" -B "$embedded" -G "$(cached CMAKE_GENERATOR)" \
    -DDEGS_SOURCE="$sources" -DSystemCLanguage_DIR="$work/systemc" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_BUILD_TYPE="$(cached CMAKE_BUILD_TYPE)" -DDEGS_ARCH="$(cached DEGS_ARCH)" \
    -DDEGS_WARNINGS_AS_ERRORS="$(cached DEGS_WARNINGS_AS_ERRORS)" -DDEGS_FAT_ARCHIVES="$(cached DEGS_FAT_ARCHIVES)" \
    -DCMAKE_UNITY_BUILD="$(cached CMAKE_UNITY_BUILD)" \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE="$(cached CMAKE_UNITY_BUILD_BATCH_SIZE)" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(cached DEGS_CCACHE)" >"$work/embedded.log" ||
    { cat "$work/embedded.log"; exit 1; }
if grep -q '^SYSTEMC_FOUND:INTERNAL=1' "$embedded/CMakeCache.txt"; then
    echo "SystemC was found with pkg-config, so this was no test of the package"
    exit 1
fi
cmake --build "$embedded" --target embedded
"$embedded/embedded"
