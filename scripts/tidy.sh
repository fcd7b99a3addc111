#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy.sh: clang-tidy over src/ and sim/, one process per core. Wants no build: it takes the compile
# commands of a configuration of its own, in which every source is alone, so an include that is
# missing is an error here. A clean source is remembered under build/tidy by a hash of itself, of
# every project header behind it and of the checks, and is not read again until one of them changes.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
cache=build/tidy
commands=$cache/commands
mkdir -p "$cache"
common=$({ cat .clang-tidy; clang-tidy --version; } | sha256sum | cut -c1-64)

# Lines "source dependency" for the project's own files; includes are written from include/, src/ or
# the root.
files=$(find include src sim -name '*.[ch]pp' -o -name '*.inc' | sort)
dependencies=$(xargs grep -HE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' <<<"$files" | awk -F '[:"]' -v files="$files" '
    BEGIN {
        total = split(files, list, "\n")
        for (i = 1; i <= total; ++i) known[list[i]]
    }
    {
        header = ("include/" $3) in known ? "include/" $3 : ("src/" $3) in known ? "src/" $3 : $3
        if (header in known) needs[$1] = needs[$1] " " header
    }
    END {
        for (i = 1; i <= total; ++i) {
            if (list[i] !~ /\.cpp$/) continue
            split("", seen)
            count = 1
            queue[1] = list[i]
            for (at = 1; at <= count; ++at) {
                if (queue[at] in seen) continue
                seen[queue[at]]
                print list[i], queue[at]
                more = split(needs[queue[at]], next_files, " ")
                for (n = 1; n <= more; ++n) queue[++count] = next_files[n]
            }
        }
    }')

key_of() {
    { echo "$common $1"; awk -v source="$1" '$1 == source { print $2 }' <<<"$dependencies" | xargs -r sha256sum; } |
        sha256sum | cut -c1-64
}

declare -a pending=()
total=0
for source in $(find src sim -name '*.cpp' | sort); do
    total=$((total + 1))
    key=$(key_of "$source")
    [[ -e $cache/$key ]] || pending+=("$key $source")
done
echo "clang-tidy: $total sources, $((total - ${#pending[@]})) unchanged, ${#pending[@]} to check"
[[ ${#pending[@]} -gt 0 ]] || exit 0
cmake -S . -B "$commands" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=OFF -DDEGS_BUILD_TESTS=OFF \
    >"$commands.log" || { cat "$commands.log"; exit 1; }

# stderr is kept back: clang-tidy counts there the warnings of foreign headers that it does not
# show.
check='key=$1 source=$2 log=$(mktemp)
if clang-tidy -p "'"$commands"'" --quiet --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-Wno-unknown-pragmas "$source" 2>"$log"; then
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
