#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# container.sh ROOT: the Containerfile is in order, what it copies can be configured, and its check
# finds mistakes. With DEGS_SLOW_TESTS=1, podman or docker builds and runs the image, if one works.
set -euo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root"
if [[ ${DEGS_SLOW_TESTS:-} == 1 ]]; then
    scripts/container.sh
else
    scripts/container.sh --check
fi

# What the first stage copies is enough to configure the build.
sed -n '/AS build/,/^FROM debian/{/--from=/d; s/^COPY //p}' Containerfile | awk '{for (i = 1; i < NF; ++i) print $i}' |
    grep -v -e '^docs$' -e '\.md$' -e '^LICENSE$' | while read -r source; do
    mkdir -p "$work/src/$(dirname "$source")"
    cp -r "$source" "$work/src/$source"
done
(cd "$work/src" && cmake --preset release -DDEGS_BUILD_TESTS=OFF) >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }

refused() { # WORDS SED: the file, changed so, is refused with these words
    sed "$2" Containerfile >"$work/Containerfile"
    if scripts/container.sh --check "$work/Containerfile" >"$work/said" 2>&1; then
        echo "not refused: $2"
        exit 1
    fi
    grep -q -- "$1" "$work/said" || { echo "$2 is refused for another reason:"; cat "$work/said"; exit 1; }
}
refused "COPY of 'source'" 's/^COPY src src/COPY source src/'
refused "package 'libfoo-dev'" 's/xargs apt-get install \(.*\) </apt-get install \1 zlib1g-dev libfoo-dev </'
refused "as root" '/^USER/d'
refused "not degs" 's,^ENTRYPOINT.*,ENTRYPOINT ["/bin/sh"],'
refused "one stage" '0,/^FROM/s/^FROM.*//'
