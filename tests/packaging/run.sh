#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD COMPILER [PROGRAM]: the ways in which another project uses DeGS.
# 1. find_package: installs a build into a folder of its own, moves it elsewhere, and builds and
#    runs outside/ and shadow/, which know nothing but the prefix, with COMPILER and with clang++.
#    shadow/ has headers of its own with the names of ours. The libraries must have been built. The
#    installed example must give the image of PROGRAM, and the snippet of docs/accelerator.md must
#    compile.
# 2. pkg-config: compiles and links outside/main.cpp with what degs.pc says.
# 3. add_subdirectory: builds and runs embedded/ with a SystemC of its own: headers and library
#    under a prefix, which must be taken in place of the SystemC of the system. Compiles a few rooms
#    once more, with the flags of BUILD.
# 4. The same with SystemC as a package for CMake, configured only; degs.pc and degsConfig.cmake
#    must name it.
set -euo pipefail

build=$1
compiler=$2
program=${3:-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
embedded=$(mktemp -d "$build-embedded.XXXXXX") # beside BUILD, so that relative paths are those of its objects, too
trap 'rm -rf "$work" "$embedded"' EXIT
# shellcheck source=tests/packaging/functions.sh
. "$here/functions.sh"
sources=$(cached CMAKE_HOME_DIRECTORY)

quietly install cmake --install "$build" --prefix "$work/first" --component degs
mv "$work/first" "$work/prefix"
compilers=("$compiler")
if command -v clang++ >/dev/null; then
    compilers+=(clang++)
else
    echo "clang++ is not there, so the package is tried with one compiler"
fi
declare -A images # by design: a number set, and single precision
if [[ $program ]]; then
    make_scene "$program"
    for design in degs-64 gscore-64; do
        images[$design]=$(image_of "$program" "$work/prefix/share/degs/configs/$design.yaml")
    done
fi
for each in "${compilers[@]}"; do
    name=$(basename "$each")
    for project in "$here/outside" "$here/shadow" "$work/prefix/share/degs/examples/platform"; do
        target=$(basename "$project")
        quietly configure cmake -S "$project" -B "$work/$name-$target" -DCMAKE_PREFIX_PATH="$work/prefix" \
            -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$each"
        quietly compile cmake --build "$work/$name-$target"
        rm "$work/$name-$target/$target"
        taken=$(seconds 5 cmake --build "$work/$name-$target") || { echo "$name: $taken"; exit 1; }
        echo "$name links $target in $taken s of a processor"
    done
    "$work/$name-outside/outside" 2>/dev/null
    "$work/$name-shadow/shadow" 2>/dev/null
    [[ $program ]] || continue
    for design in "${!images[@]}"; do
        example_draws "$work/$name-platform/platform" "$work/prefix/share/degs/configs/$design.yaml" "${images[$design]}"
    done
done
echo 'accelerator: gpu' >"$work/wrong.yaml"
if "$work/$name-platform/platform" "$work/wrong.yaml" none.ply >"$work/said" || ! grep -q 'wrong.yaml:1' "$work/said"; then
    echo "the example says of a wrong design:"
    cat "$work/said"
    exit 1
fi

# The snippet of the page, with the names that it takes for granted.
{
    echo '#include <tlm_utils/simple_initiator_socket.h>'
    echo '#include <tlm_utils/simple_target_socket.h>'
    snippet=$(awk '/^```/ { on = /^```cpp/ && !done; next } on { print } /load_design/ { done = 1 }' \
        "$sources/docs/accelerator.md")
    grep '^#include' <<<"$snippet"
    echo 'struct Bus : sc_core::sc_module { tlm_utils::simple_target_socket<Bus> in{"in"};'
    echo '    explicit Bus(const sc_core::sc_module_name& name) : sc_module(name) {} };'
    echo 'struct Cpu : sc_core::sc_module { tlm_utils::simple_initiator_socket<Cpu> out{"out"};'
    echo '    explicit Cpu(const sc_core::sc_module_name& name) : sc_module(name) {} };'
    echo 'int sc_main(int, char**) { Bus bus("bus"); Cpu cpu("cpu"); sc_core::sc_signal<bool> interrupt;'
    grep -v '^#include' <<<"$snippet"
    echo 'return 0; }'
} >"$work/snippet.cpp"
grep -q 'load_design' "$work/snippet.cpp" || { echo "the page has no snippet"; exit 1; }
snippet_flags=$(PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name degs.pc)") pkg-config --cflags degs)
# shellcheck disable=SC2086 # words of the command line
"$compiler" -fsyntax-only -Wall -Wextra $snippet_flags "$work/snippet.cpp"

# The public headers are few, each stands alone, and none shows more than SystemC, TLM and the
# standard library.
headers=("$work"/prefix/include/degs/*)
[[ ${#headers[@]} -le 15 ]] || { echo "${#headers[@]} public headers: ${headers[*]}"; exit 1; }
[[ $(find "$work/prefix/include" -type f | wc -l) == "${#headers[@]}" ]] || { echo "headers outside of include/degs"; exit 1; }
if grep -nE '^#include' "${headers[@]}" | grep -vE '<(degs/|systemc>|tlm>|tlm_utils/|cci_configuration>|[a-z_]+>|stdint.h>)|"degs(/|_)'; then
    echo "public headers show more than SystemC, TLM and the standard library"
    exit 1
fi
for header in "${headers[@]}"; do
    [[ $header != */cci.hpp ]] || continue
    echo "#include <degs/$(basename "$header")>" >"$work/alone.cpp"
    # shellcheck disable=SC2086 # words of the command line
    "$compiler" -fsyntax-only -Wall -Wextra -Werror $snippet_flags "$work/alone.cpp"
done

for file in share/degs/configs/degs-64.yaml include/degs/accelerator.hpp include/degs/degs_driver.h \
    share/degs/driver/degs_driver.c share/degs/driver/degs.svd share/degs/driver/degs-ip-xact.xml; do
    [[ -f $work/prefix/$file ]] || { echo "$file was not installed"; exit 1; }
done
if grep -rlE "$build|$work" "$work/prefix" --include='*.cmake' --include='*.pc'; then
    echo "these files name the build folder, or where the package was first"
    exit 1
fi
pc=$(dirname "$(find "$work/prefix" -name degs.pc)")
PKG_CONFIG_PATH=$pc pkg-config --exists --print-errors degs
flags=$(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs degs)
# shellcheck disable=SC2086 # words of the command line
"$compiler" "$here/outside/main.cpp" -O2 $flags -o "$work/by_pkg_config"
"$work/by_pkg_config" 2>/dev/null

# A second SystemC. Its library is another file, so that the program tells which one it uses.
second=$work/systemc
mkdir -p "$second/include" "$second/lib" "$second/cmake"
include=$(cached DEGS_SYSTEMC_INCLUDE)
library=$(realpath "$(cached DEGS_SYSTEMC_LIBRARY)")
ln -s "$include"/{systemc,systemc.h,sysc,tlm,tlm.h,tlm_core,tlm_utils} "$second/include"
cp "$library" "$second/lib/libsystemc.${library##*.}"
if [[ $library == *.so ]]; then
    cp "$library" "$second/lib/$(basename "$library")" # the name that programs ask for
fi
version=$(cached DEGS_SYSTEMC_VERSION)
quietly embedded cmake -S "$here/embedded" -B "$embedded" -G "$(cached CMAKE_GENERATOR)" \
    -DDEGS_SOURCE="$sources" -DSYSTEMC_HOME="$second" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_BUILD_TYPE="$(cached CMAKE_BUILD_TYPE)" -DDEGS_ARCH="$(cached DEGS_ARCH)" \
    -DDEGS_WARNINGS_AS_ERRORS="$(cached DEGS_WARNINGS_AS_ERRORS)" \
    -DCMAKE_UNITY_BUILD="$(cached CMAKE_UNITY_BUILD)" \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE="$(cached CMAKE_UNITY_BUILD_BATCH_SIZE)" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(cached DEGS_CCACHE)"
grep -q "SystemC $version (prefix), $second/lib/" "$work/embedded.log" || { cat "$work/embedded.log"; exit 1; }
quietly embedded_build cmake --build "$embedded" --target embedded
"$embedded/embedded"
used=$(ldd "$embedded/embedded")
if [[ $library == *.so && $used != *" => $second/lib/"* ]]; then
    echo "the program uses another SystemC than that of the prefix: $used"
    exit 1
fi

cat >"$second/cmake/SystemCLanguageConfig.cmake" <<END
add_library(SystemC::systemc UNKNOWN IMPORTED)
set_target_properties(SystemC::systemc PROPERTIES
    IMPORTED_LOCATION "$second/lib/libsystemc.${library##*.}"
    INTERFACE_INCLUDE_DIRECTORIES "$second/include")
END
mkdir "$second/lib/cmake"
mv "$second/cmake" "$second/lib/cmake/SystemCLanguage"
quietly package cmake -S "$sources" -B "$work/package" -G "$(cached CMAKE_GENERATOR)" -DCMAKE_PREFIX_PATH="$second" \
    -DCMAKE_CXX_COMPILER="$compiler" -DDEGS_BUILD_TESTS=OFF -DDEGS_BUILD_SIM=OFF
grep -q "SystemC $version (package), $second/lib/" "$work/package.log" || { cat "$work/package.log"; exit 1; }
[[ $(PKG_CONFIG_PATH=$work/package pkg-config --libs degs) == *"$second/lib/libsystemc"* ]]
[[ $(PKG_CONFIG_PATH=$work/package pkg-config --cflags degs) == *"-isystem"*"$second/include"* ]]
grep -q "\"$second/lib/libsystemc" "$work/package/degsConfig.cmake"
if SYSTEMC_HOME=/nowhere cmake -S "$sources" -B "$work/nowhere" >"$work/nowhere.log" 2>&1; then
    echo "a SYSTEMC_HOME without SystemC is no error"
    exit 1
fi
grep -q "SYSTEMC_HOME names '/nowhere'" "$work/nowhere.log"
