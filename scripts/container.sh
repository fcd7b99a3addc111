#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# container.sh: builds the image `degs` of the Containerfile with podman or docker and runs the
# quickstart's scene in it. Where neither works, and with --check [FILE], it only reads the file:
# with hadolint if there is one, and with checks of its own.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
file=Containerfile

# Prints what is wrong with the file; fails if anything is.
check() {
    local faults=0 text packages word source user
    text=$(sed '/^ *#/d' "$file" | sed -e ':a' -e '/\\$/N; s/\\\n//; ta')
    fault() { echo "$file: $1"; faults=$((faults + 1)); }
    while read -r source; do # all words of a COPY but the last, which is the target
        [[ -e $source ]] || fault "COPY of '$source', which does not exist"
    done < <(sed -n '/--from=/d; s/^COPY //p' <<<"$text" | awk '{for (i = 1; i < NF; ++i) print $i}')
    packages=$(sed -n '/packages=(/,/)$/p' scripts/install.sh | tr '()' '  ')
    while read -r word; do
        grep -qw -- "$word" <<<"$packages" || fault "package '$word', which scripts/install.sh does not install"
    done < <(grep -o 'apt-get install[^&<|;]*' <<<"$text" | tr ' ' '\n' | grep -v -e '^-' -e '^apt-get$' -e '^install$' -e '^$')
    user=$(sed -n 's/^USER //p' <<<"$text" | tail -n 1)
    [[ -n $user && $user != root && $user != 0 ]] || fault "the program would run as root"
    [[ $(tail -n 1 <<<"$text") == 'ENTRYPOINT ["/usr/bin/degs"]' ]] || fault "the entry point is not degs"
    [[ $(grep -c '^FROM ' <<<"$text") -ge 2 ]] || fault "the image has the compiler in it: one stage only"
    [[ $faults -eq 0 ]]
}

engine=
if [[ ${1:-} == --check ]]; then
    file=${2:-$file}
else
    for each in podman docker; do
        if [[ -z $engine ]] && command -v $each >/dev/null && timeout 20 $each info >/dev/null 2>&1; then
            engine=$each
        fi
    done
fi
if [[ -z $engine ]]; then
    if command -v hadolint >/dev/null; then
        hadolint --failure-threshold error "$file"
    fi
    check
    echo "container: $file was read and is in order; it was not built, because $(
        [[ ${1:-} == --check ]] && echo "--check asks for no more" || echo "neither podman nor docker runs here")"
    exit 0
fi
$engine build --tag degs --file "$file" .
$engine run --rm degs run /usr/share/degs/configs/degs-64.yaml --scene synthetic:lighthouse --out out
echo "container: the image degs was built with $engine and ran the scene of the quickstart"
