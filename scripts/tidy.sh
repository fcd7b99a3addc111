#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy.sh [--alone]: clang-tidy over src/ and sim/, one process per core. Wants no build: it takes
# the compile commands of a configuration of its own, in which 16 sources of a target are one unit,
# as in the release build: most of the time goes into headers, and units take a quarter of it. With
# --alone, every source is a unit, so that an include that is missing is an error. A clean unit is
# remembered under build/tidy by a hash of its sources, of every project header behind them and of
# the checks, and is not read again until one of them changes.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
unity=ON
case "${1:-} $#" in
    ' 0') ;;
    '--alone 1') unity=OFF ;;
    *) echo "usage: tidy.sh [--alone]" >&2; exit 2 ;;
esac
cache=build/tidy
commands=$cache/commands-$unity
mkdir -p "$cache"
# A unit includes sources, which the house forbids to everybody else (tests/house/house_check.sh).
checks=$([[ $unity == OFF ]] || echo -bugprone-suspicious-include)
common=$({ cat .clang-tidy; echo "$checks"; clang-tidy --version; } | sha256sum | cut -c1-64)
cmake -S . -B "$commands" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=$unity \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 -DDEGS_BUILD_TESTS=OFF >"$commands.log" || { cat "$commands.log"; exit 1; }

# Lines "unit source…" of what the configuration compiles in C++; what it generates is not ours to
# check.
units=$(sed -nE "s|^ *\"file\": \"($PWD/)?(.*\.(cpp\|cxx))\"[, ]*$|\2|p" "$commands/compile_commands.json" | sort |
    grep -E '^(src|sim)/|/Unity/' | xargs awk -v root="$PWD/" '
        FNR == 1 { printf "%s%s", NR == 1 ? "" : "\n", FILENAME ~ /\.cpp$/ ? FILENAME " " FILENAME : FILENAME }
        FILENAME !~ /\.cpp$/ && /^#include/ { gsub(/^#include "|"$/, ""); sub(root, ""); if (/^s/) printf " %s", $0 }
        END { print "" }')

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

# key_of SOURCE…: the hash of a unit.
key_of() {
    { echo "$common $*"; awk -v sources="$*" '
        BEGIN { split(sources, list, " "); for (i in list) wanted[list[i]] }
        $1 in wanted && !seen[$2]++ { print $2 }' <<<"$dependencies" | sort | xargs -r sha256sum; } | sha256sum | cut -c1-64
}

declare -a pending=()
total=0
while read -r unit sources; do
    total=$((total + 1))
    # shellcheck disable=SC2086 # names of sources have no spaces
    key=$(key_of $sources)
    [[ -e $cache/$key ]] || pending+=("$key $unit")
done <<<"$units"
sources=$(awk '{ sum += NF - 1 } END { print sum }' <<<"$units")
[[ $sources -eq $(grep -c '\.cpp$' <<<"$files") ]] ||
    { echo "clang-tidy: units have $sources sources, src and sim have $(grep -c '\.cpp$' <<<"$files")" >&2; exit 1; }
echo "clang-tidy: $sources sources in $total units, $((total - ${#pending[@]})) unchanged, ${#pending[@]} to check"
[[ ${#pending[@]} -gt 0 ]] || exit 0

# stderr is kept back: clang-tidy counts there the warnings of foreign headers that it does not
# show.
check='key=$1 unit=$2 log=$(mktemp)
if clang-tidy -p "'"$commands"'" --config-file=.clang-tidy --checks="'"$checks"'" --quiet \
    --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-Wno-unknown-pragmas "$unit" 2>"$log"; then
    touch "'"$cache"'/$key"
else
    grep -v "warnings\? generated\|warnings\? treated as errors" "$log" || true
    echo "clang-tidy: $unit fails"
    status=1
fi
rm -f "$log"
exit "${status:-0}"'
printf '%s\n' "${pending[@]}" | xargs -P "$(nproc)" -L 1 bash -c "$check" tidy || {
    echo "clang-tidy: there are findings, see above" >&2
    exit 1
}
echo "clang-tidy: clean"
