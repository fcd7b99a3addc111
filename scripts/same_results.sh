#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# same_results.sh OLD NEW [--quick]: runs all shipped configurations with two builds of the program
# and lists every key of report.json that differs (but for the section `host` and the version of the
# program) and every image that differs. OLD and NEW are programs, e.g.
# ../before/build/release/sim/degs build/release/sim/degs; each reads the folder `configs` of its
# own source tree, which is the nearest one above it. The trained scenes come from DEGS_SCENES
# (default ../shared/scenes) as far as they exist; --quick keeps to one of them and to a synthetic
# scene. The exit code is 1 if anything differs.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '3,8s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
export DEGS_SCENES=${DEGS_SCENES:-$here/../../shared/scenes}
exec python3 "$here/same_results.py" "$@"
