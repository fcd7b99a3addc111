#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# house_check.sh RULE [ROOT]: checks one rule about folders and sources, or `all`, and prints every
# violation as "file:line: reason". Rules: arrows public units systemc printing namespaces length
# width comments casts folders licence.
set -euo pipefail

rule=${1:?usage: house_check.sh RULE [ROOT]}
root=$(realpath "${2:-$(dirname "${BASH_SOURCE[0]}")/../..}")
cd "$root"
violations=0

# Files of the given folders that end in one of our C++ suffixes; .inc are those that are included
# several times. Folders may be missing.
sources() {
    local folders=() folder
    for folder in "$@"; do [[ -d $folder ]] && folders+=("$folder"); done
    [[ ${#folders[@]} -eq 0 ]] || find "${folders[@]}" -type f \( -name '*.hpp' -o -name '*.cpp' -o -name '*.inc' \) | sort
}

# forbid REASON PATTERN FILES...: no line may match the extended regular expression.
forbid() {
    local reason=$1 pattern=$2 hits
    shift 2
    [[ $# -gt 0 ]] || return 0
    hits=$(grep -nHE -- "$pattern" "$@" || true)
    [[ -z $hits ]] || refuse "$(sed -E "s|^([^:]*:[0-9]+): *|\\1: $reason: |" <<<"$hits")"
}

# refuse LINES: prints what a rule found, a violation per line.
refuse() {
    [[ -n $1 ]] || return 0
    echo "$1"
    violations=$((violations + $(wc -l <<<"$1")))
}

# may_include ROOM ALLOWED...: of our rooms, files of src/ROOM may include only itself and ALLOWED.
may_include() {
    local room=$1 other forbidden=()
    for other in base config stats cost splat scene accuracy tlm dram modules baselines platform sim tests; do
        [[ " $* " == *" $other "* ]] || forbidden+=("$other")
    done
    local pattern files
    pattern="^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"](\.\./)*(src/)?($(IFS='|'; echo "${forbidden[*]}"))/"
    mapfile -t files < <(sources "src/$room")
    forbid "src/$room may include only: $*" "$pattern" "${files[@]}"
    forbid "includes are written from src/, without .." \
        '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]\.\.?/' "${files[@]}"
}

# Arrows between rooms, the folders of the first level below src.
check_arrows() {
    may_include base
    may_include config base
    may_include stats config base
    may_include cost stats config base
    may_include splat config base
    may_include scene splat config base
    may_include accuracy scene splat config base
    may_include tlm stats config base
    may_include dram tlm stats config base
    may_include modules cost splat dram tlm stats config base
    may_include baselines modules cost splat dram tlm stats config base
    may_include platform modules cost scene splat dram tlm stats config base
}

# What the package installs shows SystemC, TLM and the standard library, and none of our rooms.
check_public() {
    mapfile -t files < <(sources include)
    forbid "public headers include SystemC, TLM, the standard library and each other" \
        '#[[:space:]]*include[[:space:]]*("([^d]|d[^e]|degs/[^"]*/)|<([^>t]|t[^l])[^>]*/)' "${files[@]}"
}

# clang-tidy cannot look for this, because it reads several sources as one.
check_units() {
    mapfile -t files < <(sources include src sim)
    forbid "no source is included" '#[[:space:]]*include[[:space:]]*["<][^">]*\.c(c|pp|xx)?[">]' "${files[@]}"
}

check_systemc() {
    mapfile -t files < <(sources src/base src/config src/stats src/cost src/splat src/scene src/accuracy)
    forbid "no SystemC in configuration, costs, mathematics and loaders" \
        '#[[:space:]]*include[[:space:]]*[<"](systemc|tlm|sysc|tlm_utils)([./>"]|$)|\b(sc_core|tlm)::' "${files[@]}"
}

check_printing() {
    mapfile -t files < <(sources src)
    forbid "only sim/ prints and exits" \
        'std::(cout|cerr|clog|puts|printf|exit|abort|quick_exit|_Exit)\b|(^|[^[:alnum:]_:.>])(printf|fprintf|puts|exit|_exit|abort)[[:space:]]*\(' \
        "${files[@]}"
}

check_namespaces() {
    mapfile -t files < <(sources include src sim tests | grep -E '\.(hpp|inc)$' || true)
    forbid "no using namespace in a header" '^[[:space:]]*using[[:space:]]+namespace\b' "${files[@]}"
}

check_length() {
    # One process for all files: `wc` for each of them would take a minute.
    refuse "$(sources src sim tests | xargs -r awk '
        function judge() { if (lines > 500) print file ":" lines ": " lines " lines, 500 are allowed" }
        FNR == 1 { judge(); file = FILENAME }
        { lines = FNR }
        END { judge() }')"
}

# In characters, not bytes. clang-format wraps C++ and its comments at 100, scripts/wrap_pages.py
# wraps pages at 120; lines of comment in other files are held to 100 here, and those on which a
# comment follows a value to 120.
check_width() {
    refuse "$(find src sim python tests configs scripts cmake examples include CMakeLists.txt -type f \
        -regex '.*\.\([hc]pp\|inc\|yaml\|sh\|py\|cmake\|txt\)' -print0 2>/dev/null |
        LC_ALL=C.UTF-8 xargs -0r grep -nHE '^.{101}' | LC_ALL=C.UTF-8 grep -E \
        -e '^[^:]*:[0-9]+:[[:space:]]*(//|///|#) ' -e '^[^:]*:[0-9]+:.{121}.*' |
        grep -E '[[:space:]:](//|///|///<|#) ' | sort | sed -E 's/^([^:]*:[0-9]+):(.{0,60}).*/\1: too wide: \2/' || true)"
}

# A comment on lines of its own names its subject: nobody should have to read the declaration above
# it first. Only the first line of a block counts; `//` and `///` do not continue each other.
check_comments() {
    mapfile -t files < <(sources include src sim tests examples)
    refuse "$(awk '
        FNR == 1 { before = "" }
        {
            mark = $1 ~ /^\/\// ? $1 : ""
            sub(/[^\/].*/, "", mark)
            text = $0
            sub(/^[ \t]*\/+[ \t]*/, "", text)
            if (mark != "" && mark != before &&
                tolower(text) ~ /^(of|its|those|the same|likewise|their|that of|these)([^a-z]|$)/)
                print FILENAME ":" FNR ": a comment begins with a noun of its own: " text
            before = mark
        }' "${files[@]}")"
}

# A type that fits needs no cast, and where there are few, each of them says something.
check_casts() {
    local casts lines
    mapfile -t files < <(find src sim -type f -regex '.*\.\([hc]pp\|inc\)' 2>/dev/null)
    lines=$(cat "${files[@]}" | wc -l)
    casts=$(cat "${files[@]}" | grep -o 'static_cast<' | wc -l || true)
    [[ $((casts * 1000)) -gt $((lines * 8)) ]] || return 0
    grep -cH 'static_cast<' "${files[@]}" | sort -t: -k2 -nr | awk -F: '$2 > 0 && NR <= 10 { print $1 ":1: " $2 " casts" }'
    echo "src and sim have $casts static_casts in $lines lines; 8 per 1000 lines are allowed"
    violations=$((violations + 1))
}

# Arrows between the folders of all levels below src and sim, and no circle of folders.
check_folders() {
    local found
    found=$("$(dirname "${BASH_SOURCE[0]}")/folders.py" "$root") || refuse "$(grep -v '^house ' <<<"$found")"
}

check_licence() {
    refuse "$(sources src sim tests examples | xargs -r awk -v line='// SPDX-License-Identifier: Apache-2.0' '
        FNR == 1 && $0 == line { good[FILENAME] }
        END { for (i = 1; i < ARGC; ++i) if (!(ARGV[i] in good)) print ARGV[i] ":1: the first line must be " line }')"
}

rules=(arrows public units systemc printing namespaces length width comments casts folders licence)
case " ${rules[*]} all " in
    *" $rule "*) ;;
    *) echo "unknown rule '$rule'; there are: ${rules[*]} all" >&2; exit 2 ;;
esac
if [[ $(sources src | wc -l) -eq 0 ]]; then
    echo "no sources under $root/src" >&2
    exit 2
fi
for each in "${rules[@]}"; do
    if [[ $rule == all || $rule == "$each" ]]; then "check_$each"; fi
done
[[ $violations -eq 0 ]] || { echo "house $rule: $violations violation(s)"; exit 1; }
echo "house $rule: clean"
