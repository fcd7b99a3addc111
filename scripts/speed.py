#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""speed.py run [--seeds N] [--configs CONFIG...] [--views SCENE:CAMERA...] [--resolution R]: measures speed against
error with `degs accuracy --speed` and keeps the result in docs/speed.csv, with the commit and the processor.
speed.py table [--short]: prints docs/speed.csv as the table of docs/speed.md, or the lines of README.md.

Runs with DEGS_PROGRAM (default build/release/sim/degs); scenes are SCENE/scene.ply in DEGS_SCENES (default
../shared/scenes). A configuration is a file of configs without its ending."""
import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes")))
KEPT = ROOT / "docs/speed.csv"
COLUMNS = ["scene", "camera", "width", "height", "accelerator", "numbers", "fidelity", "runs", "over_render",
           "fragments_per_s", "cycles_error", "utilization_error", "dram_error", "psnr_db", "sampled", "held"]


def line_of(*command):
    """The first line of what a command prints."""
    return subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout.split("\n")[0].strip()


def machine():
    """The processor as Linux names it, and how many of them there are."""
    names = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
             if line.startswith("model name")]
    return f"{len(names)} x {names[0]}" if names else "unknown"


def measure(view, options):
    """speed.json of one view."""
    scene, camera = view.split(":")
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "accuracy", "--scene", str(SCENES / scene / "scene.ply"), "--camera", camera, "--seeds",
                   str(options.seeds), "--out", folder]
        command += ["--resolution", options.resolution] if options.resolution else []
        command += ["--fidelities", options.fidelities] if options.fidelities else []
        command += ["--speed", *(str(ROOT / "configs" / (name + ".yaml")) for name in options.configs)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "speed.json"), encoding="utf-8") as file:
            return json.load(file)


def middle(rows, key):
    """Median without sign; empty if no row has the number."""
    values = [abs(row[key]) for row in rows if row[key] is not None]
    return f"{statistics.median(values):.6g}" if values else ""


def groups_of(result):
    """A line of the file for each accelerator, number set and fidelity."""
    held = {(entry["accelerator"], entry["numbers"], entry["fidelity"]): entry for entry in result["intervals"]}
    groups = {}
    for row in result["rows"]:
        groups.setdefault((row["accelerator"], row["numbers"], row["fidelity"]), []).append(row)
    for key, rows in groups.items():
        intervals = held.get(key, {})
        yield {**{name: result["view"][name] for name in ("scene", "camera", "width", "height")},
               "accelerator": key[0], "numbers": key[1], "fidelity": key[2], "runs": len(rows),
               **{name: middle(rows, name) for name in ("over_render", "fragments_per_s", "cycles_error",
                                                        "utilization_error", "dram_error", "psnr_db")},
               "sampled": intervals.get("sampled", ""), "held": intervals.get("held", "")}


def run(options):
    """Writes docs/speed.csv."""
    kept = []
    for view in options.views:
        print(view, file=sys.stderr, flush=True)
        kept += groups_of(measure(view, options))
    with open(KEPT, "w", encoding="utf-8", newline="") as file:
        file.write(f"# {machine()}; commit {line_of('git', 'rev-parse', '--short', 'HEAD')}; "
                   f"{options.seeds} seeds of each sample\n")
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept)


def percentage(text):
    """A share as percent in two digits."""
    return f"{100 * float(text):.2g}" if text else ""


def holds(row):
    """How many intervals hold the exact cycles."""
    if not row["sampled"]:
        return ""
    return f"{row['held']} of {row['sampled']}" if row["sampled"] != "0" else "exact instead"


def table(options):
    """Prints Markdown."""
    with open(KEPT, encoding="utf-8", newline="") as file:
        file.readline()  # machine and commit
        rows = list(csv.DictReader(file))
    headings = ["view", "design", "numbers", "fidelity", "× render", "M fragments/s", "cycles, %", "utilization, %",
                "DRAM, %", "PSNR, dB", "intervals hold"]
    dashes = ["---"] * 4 + ["---:"] * 7
    short = [0, 1, 3, 4, 6, 10] if options.short else range(len(headings))
    for cells in (headings, dashes):
        print("| " + " | ".join(cells[column] for column in short) + " |")
    for row in rows:
        if options.short and row["numbers"] in ("ideal", "fp32") and row["accelerator"].startswith("degs"):
            continue  # the design computes in a set of its own
        if row["numbers"] == "ideal" and (options.short or not row["accelerator"].startswith("degs")):
            continue  # what double precision costs stands in the rows of DeGS
        if row["fidelity"] == "strict" and not options.short and not row["accelerator"].startswith("degs"):
            continue  # the baselines take nearly the time of exact
        if row["accelerator"].startswith("degs") and not options.short and \
                (row["numbers"], row["fidelity"]) not in (("ideal", "strict"), ("fp32", "exact")) and \
                row["numbers"] in ("ideal", "fp32"):
            continue  # the errors of its other runs hardly differ from those in the design's own set
        cells = [f"{row['scene']}:{row['camera']}", row["accelerator"], row["numbers"], row["fidelity"],
                 f"{float(row['over_render']):.3g}", f"{float(row['fragments_per_s']) / 1e6:.3g}",
                 percentage(row["cycles_error"]), percentage(row["utilization_error"]), percentage(row["dram_error"]),
                 f"{float(row['psnr_db']):.3g}" if row["psnr_db"] else "", holds(row)]
        print("| " + " | ".join(cells[column] for column in short) + " |")


def main():
    """Runs or prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    measuring = commands.add_parser("run")
    measuring.add_argument("--seeds", type=int, default=10)
    measuring.add_argument("--configs", nargs="+", default=["degs-64", "gscore-64", "gbu-64", "gcc-64"])
    measuring.add_argument("--views", nargs="+", default=["flowers:2", "flowers:1"])
    measuring.add_argument("--resolution", default="")
    measuring.add_argument("--fidelities", default="")
    measuring.set_defaults(act=run)
    printing = commands.add_parser("table")
    printing.add_argument("--short", action="store_true")
    printing.set_defaults(act=table)
    options = parser.parse_args()
    options.act(options)


if __name__ == "__main__":
    sys.exit(main())
