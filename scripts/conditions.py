#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""conditions.py: the PE utilisation of DeGS designs under the conditions of every page, as the table of docs/results.md.

It reads the tables of the pages, so that a value which one of them measures anew is also new here: the test of the
documents compares the table with this output.
"""
import math
import re
from pathlib import Path

DOCS = Path(__file__).resolve().parent.parent / "docs"
DESIGNS = ("degs-16", "degs-64", "degs-64-tuned", "degs-256", "degs-1024")


def rows_after(page, marker):
    """The cells of each row of the first table below `marker`, without its rule; the headings come first."""
    below = (DOCS / page).read_text().split(marker + "\n", 1)[1]
    table = re.search(r"(?:^\|.*\n)+", below, re.MULTILINE)[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.strip().split("\n")]
    return rows[:1] + rows[2:]


def first_number(cell):
    return re.search(r"\d+\.\d", cell)[0]


def by_resolution(marker, size):
    """All slots of the arrays alone, whose cells are 'of all slots / of those that were supplied'."""
    head, *rows = rows_after("results.md", marker)
    return {row[0]: first_number(row[head.index(size)]) for row in rows}


def whole(camera):
    _, *rows = rows_after("results.md", "### Whole accelerator at 64 PEs, percent of PE-cycles in the blending window")
    means = {row[2]: first_number(row[3]) for row in rows if "mean" in row[0] and row[1] == camera}
    if camera == "2":
        head, *rows = rows_after("results.md", "### Whole accelerator, paper-literal DeGS, camera 2: utilisation (cycles)")
        for place, size in enumerate(head[1:], 1):
            values = [float(first_number(row[place])) for row in rows]
            means.setdefault(f"degs-{size.split()[0]}", f"{math.exp(sum(map(math.log, values)) / len(values)):.1f}")
    return means


def beyond(column):
    rows = [*rows_after("beyond-the-paper.md", "<!-- measured: beyond-64-alone -->"),
            *rows_after("beyond-the-paper.md", "<!-- measured: beyond-256-ours-alone -->")]
    return {row[0]: first_number(row[column]) for row in rows if row[0] in DESIGNS}


def readings(place):
    head, *rows = rows_after("readings.md", "## Summary")
    shipped = {row[0]: row[head.index("shipped")] for row in rows}
    return {f"degs-{size}": shipped[f"DeGS, {size} PEs"].split(" · ")[place] for size in (16, 1024)}


def main():
    beyond_page, readings_page = "[own machines](beyond-the-paper.md)", "[readings](readings.md)"
    table = [
        ("five", 2, "1080p", "array alone", by_resolution("<!-- measured: resolutions-close-ups -->", "1080p"),
         "[sizes](#all-designs-from-720p-to-8k)"),
        ("five", 2, "1080p", "whole", whole("2"), "`scripts/results.sh`"),
        ("five others", 2, "1080p", "array alone", beyond(1), beyond_page),
        ("two", 2, "1080p", "array alone", readings(0), readings_page),
        ("five", 1, "720p", "array alone", by_resolution("<!-- measured: resolutions-small-splats -->", "720p"), "[sizes](#all-designs-from-720p-to-8k)"),
        ("five", 1, "720p", "whole", whole("1"), "`scripts/results.sh`"),
        ("five others", 1, "720p", "array alone", beyond(6), beyond_page),
        ("two", 1, "1080p", "array alone", readings(1), readings_page)]
    print("| scenes | camera | image | | " + " | ".join(DESIGNS) + " | printed by |")
    print("|---|--:|---|---|" + "--:|" * len(DESIGNS) + "---|")
    for scenes, camera, image, what, values, source in table:
        cells = [values.get(design, "") for design in DESIGNS]
        print("| " + " | ".join([scenes, str(camera), image, what, *cells, source]) + " |")


main()
