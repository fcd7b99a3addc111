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

for page in "${pages[@]}"; do
    # [text](target), ![text](target "title") and [text](target#anchor)
    while IFS=: read -r line target; do
        target=${target#*\](}
        target=${target%%[ \")#]*}
        [[ -n $target && $target != *://* && $target != mailto:* ]] || continue
        links=$((links + 1))
        [[ -e $(dirname "$page")/$target ]] && continue
        echo "${page#./}:$line: $target does not exist"
        dead=$((dead + 1))
    done < <(grep -noE '\]\([^)]+\)' "$page" || true)
done
[[ $dead -eq 0 ]] || { echo "links: $dead of $links are dead"; exit 1; }
echo "links: all $links of ${#pages[@]} pages lead somewhere"
