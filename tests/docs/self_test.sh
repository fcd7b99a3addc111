#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Plants one mistake after the other in an otherwise clean little site: site_check.sh must accept the clean one and
# must name each mistake.
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree"/{docs,scripts,src}
    cp "$here/../../scripts/site_hook.py" "$tree/scripts/"
    echo 'int a;' >"$tree/src/a.cpp"
    printf '# Front\n\n[page](docs/page.md#part) and [source](src/a.cpp)\n' >"$tree/README.md"
    echo '# Changes' >"$tree/CHANGELOG.md"
    printf '# Page\n\n## Part\n\n[source](../src/a.cpp) [folder](../src) [front](../README.md)\n' >"$tree/docs/page.md"
    printf '%s\n' 'site_name: test' 'use_directory_urls: false' 'hooks: [scripts/site_hook.py]' \
        'theme: {name: material, font: false}' 'nav: [index.md, page.md, changelog.md]' >"$tree/mkdocs.yml"
}

# finds FILE TEXT REASON: after TEXT is appended to FILE, the check must fail and say REASON.
finds() {
    local file=$1 text=$2 reason=$3 output
    clean_tree
    printf '%s\n' "$text" >>"$tree/$file"
    if output=$("$here/site_check.sh" "$tree" 2>&1) || ! grep -qF "$reason" <<<"$output"; then
        echo "site_check.sh missed '$text' in $file; it said: $output"
        failures=$((failures + 1))
    fi
}

clean_tree
"$here/site_check.sh" "$tree" || { echo "the clean site was rejected"; exit 1; }
finds docs/page.md '[gone](gone.md)' gone.md
finds docs/page.md '[gone](../src/gone.cpp)' gone.cpp
finds README.md '[gone](docs/page.md#gone)' 'names an anchor that does not exist'
finds docs/page.md '![far](https://example.org/a.png)' 'from another host'
finds docs/alone.md '# Alone' 'the navigation does not reach it'
[[ $failures -eq 0 ]] || exit 1
echo "documents self-test: every planted mistake was found"
