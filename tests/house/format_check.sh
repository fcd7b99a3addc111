#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# format_check.sh [ROOT]: fails and names the lines when clang-format would change a source.
set -euo pipefail

cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"
mapfile -t files < <(find src sim tests examples -type f \( -name '*.hpp' -o -name '*.cpp' -o -name '*.inc' \) | sort)
clang-format --dry-run -Werror --ferror-limit=3 "${files[@]}"
echo "clang-format: ${#files[@]} files are formatted"
