#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# links_check.sh [ROOT]: every relative link and image of our Markdown pages must lead to a file or
# folder. Prints each dead one as "page:line: target".
set -euo pipefail

cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"
mapfile -t pages < <(find . -name '*.md' -not -path './build/*' -not -path './out/*' -not -path './.git/*' | sort)
[[ ${#pages[@]} -gt 0 ]] || { echo "no Markdown pages under $PWD" >&2; exit 2; }
links=0
dead=0

# [text](target), ![text](target "title") and [text](target#anchor); one grep for all pages, and no
# process for a link.
while IFS=: read -r page line target; do
    target=${target#*\](}
    target=${target%%[ \")#]*}
    [[ -n $target && $target != *://* && $target != mailto:* ]] || continue
    links=$((links + 1))
    [[ -e ${page%/*}/$target ]] && continue
    echo "${page#./}:$line: $target does not exist"
    dead=$((dead + 1))
done < <(grep -HnoE '\]\([^)]+\)' "${pages[@]}" || true)
[[ $dead -eq 0 ]] || { echo "links: $dead of $links are dead"; exit 1; }
echo "links: all $links of ${#pages[@]} pages lead somewhere"
