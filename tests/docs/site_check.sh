#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# site_check.sh [ROOT]: builds the site of ROOT into a temporary folder and fails on any warning, on
# a page of docs/ that the navigation does not reach, on a dead link or anchor, and on anything
# loaded from another host.
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
root=$(realpath "${1:-$here/../..}")
command -v mkdocs >/dev/null || { echo "mkdocs is missing: scripts/install.sh --tests installs it" >&2; exit 1; }
site=$(mktemp -d)
trap 'rm -rf "$site"' EXIT

mkdocs build --strict --config-file "$root/mkdocs.yml" --site-dir "$site/html" >"$site/log" 2>&1 || {
    grep -E 'WARNING|ERROR|Error' "$site/log" || cat "$site/log"
    exit 1
}
/usr/bin/python3 "$here/site_links.py" "$site/html" "$root/docs"
