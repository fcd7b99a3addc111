#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dynamic.py SCENE... [--frames N] [--camera C]: prints the paper's table of dynamic scenes for scenes that change
over time. Each scene is a name for `degs run --scene`, e.g. synthetic:dynamic or 'folder/*.ply'. Images are 960 px wide,
tiles 16 x 16, arrays of 64 PEs, as in the paper; the last line is DeGS with the tiles of its
Table II. docs/dynamic-scenes.md says what the lines mean.

Runs with DEGS_PROGRAM (default build/release/sim/degs): GSCore and DeGS, each whole and as an array alone."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))


SMALL_TILES = ("--set", "tile_size=16")


def report(scene, design, options, *more):
    """report.json of a run of all frames."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (design + "-64.yaml")), "--scene", scene, "--frames",
                   str(options.frames), "--camera", str(options.camera), "--width", "960", "--no-reference", "--out",
                   folder, *more]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            return json.load(file)


def measure(scene, options):
    """The numbers of a column."""
    whole = {"gscore": report(scene, "gscore", options), "degs": report(scene, "degs", options, *SMALL_TILES),
             "own": report(scene, "degs", options)}
    alone = {"gscore": report(scene, "gscore", options, "--array-only"),
             "degs": report(scene, "degs", options, "--array-only", *SMALL_TILES)}
    changes = whole["degs"]["changes"]
    return {"overlap": changes["active_overlap"], "churn": changes["tile_churn"],
            "p99": changes["p99_tile_candidates"], "gini": changes["footprint_gini"],
            "coupled": whole["gscore"]["slots"]["utilization"], "degs": whole["degs"]["slots"]["utilization"],
            "rendering": alone["gscore"]["timing"]["cycles"] / alone["degs"]["timing"]["cycles"],
            "e2e": whole["gscore"]["timing"]["cycles"] / whole["degs"]["timing"]["cycles"],
            "own": whole["own"]["slots"]["utilization"],
            "own_e2e": whole["gscore"]["timing"]["cycles"] / whole["own"]["timing"]["cycles"]}


def mean(columns, key):
    """Of the columns that have the number; none if one lacks it."""
    values = [column[key] for column in columns]
    return None if None in values else statistics.mean(values)


def cell(column, first, second):
    """Two numbers of a column, each with its form."""
    def words(key, form):
        return "-" if column[key] is None else form.format(column[key])
    return words(*first) + " / " + words(*second)


LINES = [("Active-Gaussian overlap / tile-workload churn", ("overlap", "{:.3f}"), ("churn", "{:.1%}")),
         ("P99 tile candidates / footprint Gini", ("p99", "{:.0f}"), ("gini", "{:.3f}")),
         ("Blending PE utilization, GSCore / DeGS", ("coupled", "{:.1%}"), ("degs", "{:.1%}")),
         ("Rendering speedup / end-to-end speedup", ("rendering", "{:.2f}×"), ("e2e", "{:.2f}×")),
         ("DeGS with its own tiles of 32 × 32: utilization / end-to-end speedup", ("own", "{:.1%}"),
          ("own_e2e", "{:.2f}×"))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--frames", type=int, default=8)
    parser.add_argument("--camera", type=int, default=0)
    options = parser.parse_args()
    columns = [measure(scene, options) for scene in options.scenes]
    names = list(options.scenes)
    if len(columns) > 1:
        columns.append({key: mean(columns, key) for key in columns[0]})
        names.append("mean")
    print("| | " + " | ".join(names) + " |")
    print("|---|" + "---:|" * len(names))
    for name, first, second in LINES:
        print(f"| {name} | " + " | ".join(cell(column, first, second) for column in columns) + " |")


if __name__ == "__main__":
    main()
