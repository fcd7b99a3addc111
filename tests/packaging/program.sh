#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program.sh BUILD: installs the program into a folder of its own and tries what a user would: the
# command, its manual page, and completion in a shell.
set -euo pipefail

build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" --component program >"$work/log" || { cat "$work/log"; exit 1; }
"$work/prefix/bin/degs" --version | grep -q '^degs [0-9]'
for kind in design study memory technology numbers; do
    "$work/prefix/bin/degs" config --schema $kind | cmp - "$work/prefix/share/degs/schema/$kind.json"
done
mandoc -T lint -W warning "$work/prefix/share/man/man1/degs.1"
grep -q '^\.TH DEGS 1' "$work/prefix/share/man/man1/degs.1"
# shellcheck disable=SC1091 # made above
. "$work/prefix/share/bash-completion/completions/degs"
COMP_WORDS=(degs comp) COMP_CWORD=1
_degs
[[ ${COMPREPLY[*]} == compare ]] || { echo "completed to '${COMPREPLY[*]}'"; exit 1; }
grep -q '^#compdef degs' "$work/prefix/share/zsh/site-functions/_degs"
complete -p degs | grep -q -- '-F _degs degs'
