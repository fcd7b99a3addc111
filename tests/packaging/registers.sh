#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# registers.sh PROGRAM [--update]: the files in driver/ that the program writes are up to date (or
# are written), the C files compile as C11 without a library, and the XML says what the header says
# and is valid to the standards' schemas.
set -euo pipefail

program=$(realpath "$1")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root/driver"
declare -A files=([c]=degs_registers.h [svd]=degs.svd [ip-xact]=degs-ip-xact.xml)
for format in "${!files[@]}"; do
    "$program" registers --format "$format" >"$work/${files[$format]}"
    if [[ ${2:-} == --update ]]; then
        cp "$work/${files[$format]}" .
    elif ! diff -u "${files[$format]}" "$work/${files[$format]}"; then
        echo "driver/${files[$format]} is out of date: tests/packaging/registers.sh PROGRAM --update"
        exit 1
    fi
done

printf '#include "degs_registers.h"\n_Static_assert(DEGS_REG_STATUS == 12, "");\n' >"$work/alone.c"
for compiler in gcc clang; do
    command -v "$compiler" >/dev/null || { echo "$compiler is not there"; continue; }
    for source in "$work/alone.c" degs_driver.c; do
        "$compiler" -std=c11 -ffreestanding -Wall -Wextra -Wpedantic -Wconversion -Werror -I. -fsyntax-only "$source"
    done
done

# NAME OFFSET WORDS of every register, from each file.
sed -nE 's/^#define DEGS_REG_([A-Z_]+) +0x([0-9A-F]+)u \/\* (([0-9]+) words)?.*/\1 \2 \4/p' degs_registers.h |
    awk '{ sub(/^0+/, "", $2); print $1, ($2 == "" ? 0 : $2), ($3 == "" ? 1 : $3) }' >"$work/c"
rows() { # FILE REGISTERS NAME OFFSET WORDS: XPath of the registers, then of their parts
    local count i
    count=$(xmllint --xpath "count($2)" "$1")
    for ((i = 1; i <= count; i++)); do
        xmllint --xpath "concat($2[$i]/$3, ' ', $2[$i]/$4, ' ', $2[$i]/$5)" "$1"
    done | sed -E "s/\[%s\]//; s/0x|'h//g" |
        while read -r name offset words; do echo "$name $offset $((16#${words:-1}))"; done
}
if ! command -v xmllint >/dev/null; then
    echo "xmllint is missing: run scripts/install.sh --tests"
    exit 1
fi
rows degs.svd "//*[local-name()='register']" "*[local-name()='name']" "*[local-name()='addressOffset']" \
    "*[local-name()='dim']" >"$work/svd"
rows degs-ip-xact.xml "//*[local-name()='register']" "*[local-name()='name']" "*[local-name()='addressOffset']" \
    "*[local-name()='array']/*" >"$work/ip-xact"
[[ $(wc -l <"$work/c") -ge 30 ]] || { echo "the header has no registers"; exit 1; }
diff -u "$work/c" "$work/svd"
diff -u "$work/c" "$work/ip-xact"

svd=$root/tests/packaging/schemas/cmsis-svd/CMSIS-SVD.xsd
ip_xact=$root/tests/packaging/schemas/ip-xact-1685-2022/index.xsd
xmllint --nonet --noout --schema "$svd" degs.svd
xmllint --nonet --noout --schema "$ip_xact" degs-ip-xact.xml degs-tlm2-bus.xml degs-tlm2-abstraction.xml
# Bus and abstraction of the component are those of the two files, and its sockets are ports.
names() { xmllint --xpath "$2" "$1" | tr -d '\n'; }
for kind in bus abstraction; do
    own=$(names degs-tlm2-$kind.xml "/*/*[local-name()='vendor' or local-name()='library' or local-name()='name' or local-name()='version']/text()")
    type=$([[ $kind = bus ]] && echo busType || echo abstractionRef)
    for bus in 1 2; do
        used=$(names degs-ip-xact.xml "(//*[local-name()='$type'])[$bus]/@*" | sed 's/[a-z]*="\([^"]*\)"/\1/g; s/ //g')
        [[ $own = "$used" ]] || { echo "$type $bus is $used, but the file defines $own"; exit 1; }
    done
done
ports=$(names degs-ip-xact.xml "//*[local-name()='ports']/*/*[local-name()='name']/text()")
[[ $ports = registersmemirqreset_nclk ]] || { echo "ports of IP-XACT: $ports"; exit 1; }
# The schemas reject what is wrong.
sed 's/read-only/read-sometimes/' degs.svd >"$work/bad.svd"
sed 's/read-only/read-sometimes/' degs-ip-xact.xml >"$work/bad.xml"
if xmllint --nonet --noout --schema "$svd" "$work/bad.svd" 2>/dev/null ||
    xmllint --nonet --noout --schema "$ip_xact" "$work/bad.xml" 2>/dev/null; then
    echo "the schemas accept an access that does not exist"
    exit 1
fi
