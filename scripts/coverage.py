#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Intervals of sampled runs against exact cycles, over all shipped designs: what docs/sampling.md says of coverage.

    coverage.py run [--csv FILE] [--seeds N] [--resolutions R...]    measures what FILE (docs/coverage.csv) lacks
    coverage.py table                                                Markdown table of designs from docs/coverage.csv
    coverage.py misses                                               every interval that misses

`run` takes every design of configs, every scene of DEGS_SCENES (default ../shared/scenes) with cameras 1 and 2, and
compares one exact run with N sampled ones (`--within 1%`, seeds 1 to N) of the whole accelerator. A row is written when
its run has ended, so `run` goes on where it stopped. A design that refuses to sample whatever the frame is (with a cache,
clusters or too few tiles) is asked at most four times at a resolution. The program is DEGS_PROGRAM, or
build/release/sim/degs; host times are not measured."""
import argparse
import collections
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = Path(os.environ.get("DEGS_SCENES", ROOT / "../shared/scenes"))
MEASURED = ROOT / "docs/coverage.csv"
COLUMNS = ["design", "scene", "camera", "resolution", "seed", "exact", "sampled", "low", "high", "tiles"]
KEYS = COLUMNS[:5]
CAMERAS = ("2", "1")
LISTS = ["--set", "pipeline.tiles=exact"]  # with which docs/coverage.csv was measured
PATIENCE = 4  # refusals in a row after which a design is not asked again at a resolution


def report_of(design, scene, camera, resolution, more):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "run", ROOT / f"configs/{design}.yaml", "--scene", SCENES / scene / "scene.ply",
                        "--camera", camera, "--resolution", resolution, "--no-reference", "--out", folder, *LISTS, *more],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return json.loads((Path(folder) / "report.json").read_text())


def load(file):
    if not Path(file).exists():
        return {}
    with open(file, newline="") as rows:
        return {tuple(row[key] for key in KEYS): row for row in csv.DictReader(rows)}


def sampled_row(key, exact, report):
    row = dict(zip(KEYS, key), exact=exact, sampled="", low="", high="", tiles="")
    if "sampling" in report:
        facts = report["sampling"]
        low, high = facts["intervals"]["timing"]["cycles"]
        row |= {"sampled": round(report["timing"]["cycles"]), "low": round(low), "high": round(high),
                "tiles": f"{facts['tiles_measured'] / facts['tiles']:.3f}"}
    return row


def run(options):
    done = load(options.csv)
    new = not Path(options.csv).exists()
    scenes = sorted(path.parent.name for path in SCENES.glob("*/scene.ply"))
    designs = sorted(path.stem for path in (ROOT / "configs").glob("*.yaml"))
    refused = collections.Counter()
    with open(options.csv, "a", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        if new:
            writer.writeheader()
        for resolution in options.resolutions:
            for scene in scenes:
                for camera in CAMERAS:
                    for design in designs:
                        measure(writer, file, done, refused, options.seeds, (design, scene, camera, resolution))


def measure(writer, file, done, refused, seeds, view):
    """The runs of a design and a view that are not done yet."""
    design, _, _, resolution = view
    exact = None
    for seed in map(str, range(1, seeds + 1)):
        key = (*view, seed)
        row = done.get(key)
        if row is None:
            if refused[design, resolution] >= PATIENCE:
                return
            exact = exact or report_of(*view, [])["timing"]["cycles"]
            row = sampled_row(key, exact, report_of(*view, ["--within", "1%", "--seed", seed]))
            writer.writerow(row)
            file.flush()
            print(*row.values(), flush=True)
        refused[design, resolution] = 0 if row["sampled"] else refused[design, resolution] + 1
        if not row["sampled"]:
            return  # another seed has the same frame


def holds(row):
    return float(row["low"]) <= float(row["exact"]) <= float(row["high"])


def table():
    rows = list(load(MEASURED).values())
    print("| design | sampled runs | intervals that hold | exact instead | median error, % | tiles, % |")
    print("|---|--:|--:|--:|--:|--:|")
    for design in [*sorted({row["design"] for row in rows}), "all"]:
        own = [row for row in rows if design in (row["design"], "all")]
        sampled = [row for row in own if row["sampled"]]
        cells = [str(len(sampled)), "", str(len(own) - len(sampled)), "", ""]
        if sampled:
            errors = sorted(abs(float(row["sampled"]) / float(row["exact"]) - 1) for row in sampled)
            cells[1] = f"{100 * sum(map(holds, sampled)) / len(sampled):.1f} %"
            cells[3] = f"{100 * errors[len(errors) // 2]:.2f}"
            cells[4] = f"{100 * sum(float(row['tiles']) for row in sampled) / len(sampled):.0f}"
        print(f"| {design} | " + " | ".join(cells) + " |")


def misses():
    for row in load(MEASURED).values():
        if row["sampled"] and not holds(row):
            print(*(f"{name}={value}" for name, value in row.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["run", "table", "misses"])
    parser.add_argument("--csv", default=MEASURED)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--resolutions", nargs="+", default=["1080p", "4k"])
    options = parser.parse_args()
    return {"run": lambda: run(options), "table": table, "misses": misses}[options.command]()


if __name__ == "__main__":
    sys.exit(main())
