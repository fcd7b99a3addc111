#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# try_documents.sh [--slow] [--update] [--list] [PAGE...]: runs the commands that README.md and
# docs/ show, with the program of the preset `release` (or DEGS_PROGRAM), and compares the output
# that the pages show. --slow runs those that are marked as slow (trained scenes from DEGS_SCENES;
# most of an hour), --update writes shown output anew.
set -euo pipefail

top=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
exec /usr/bin/python3 "$top/tests/docs/documents.py" "${DEGS_PROGRAM:-$top/build/release/sim/degs}" "$@"
