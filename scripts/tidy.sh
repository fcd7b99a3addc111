#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy.sh [BUILD]: clang-tidy over src/ and sim/ with the compile commands of a finished Ninja build (default
# build/release), one process per core. A clean source is remembered under build/tidy by a hash of itself, of
# every project header it was compiled with and of the checks, and is not read again until one of them changes.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/release}
cache=build/tidy
mkdir -p "$cache"
common=$({ cat .clang-tidy; clang-tidy --version; } | sha256sum | cut -c1-64)

# Lines "source dependency" for the project's own files, from what Ninja recorded while compiling. Paths may be relative
# to the build (ccache with a base_dir).
dependencies=$(ninja -C "$build" -t deps | awk -v root="$PWD/" -v build="$(cd "$build" && pwd)/" '
    /^[^ ].*: #deps/ { source = ""; next }
    /^    / {
        path = $1
        if (path !~ /^\//) path = build path
        while (sub(/[^\/]+\/\.\.\//, "", path)) {}
        if (source == "") source = path
        if (index(path, root) == 1) print substr(source, length(root) + 1), substr(path, length(root) + 1)
    }' | sort -u)

key_of() {
    { echo "$common $1"; awk -v source="$1" '$1 == source { print $2 }' <<<"$dependencies" | xargs -r sha256sum; } |
        sha256sum | cut -c1-64
}

declare -a pending=()
total=0
for source in $(find src sim -name '*.cpp' | sort); do
    total=$((total + 1))
    if ! grep -q "^$source " <<<"$dependencies"; then
        echo "clang-tidy: $build has not compiled $source; build it first" >&2
        exit 2
    fi
    key=$(key_of "$source")
    [[ -e $cache/$key ]] || pending+=("$key $source")
done
echo "clang-tidy: $total sources, $((total - ${#pending[@]})) unchanged, ${#pending[@]} to check"
[[ ${#pending[@]} -gt 0 ]] || exit 0

# stderr is kept back: clang-tidy counts there the warnings of foreign headers that it does not show.
check='key=$1 source=$2 log=$(mktemp)
if clang-tidy -p "'"$build"'" --quiet --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-Wno-unknown-pragmas "$source" 2>"$log"; then
    touch "'"$cache"'/$key"
else
    grep -v "warnings\? generated\|warnings\? treated as errors" "$log" || true
    echo "clang-tidy: $source fails"
    status=1
fi
rm -f "$log"
exit "${status:-0}"'
printf '%s\n' "${pending[@]}" | xargs -P "$(nproc)" -L 1 bash -c "$check" tidy || {
    echo "clang-tidy: there are findings, see above" >&2
    exit 1
}
echo "clang-tidy: clean"
