#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sampling.py [--seeds N] [--within E] [--resolution R] --configs CONFIG... --views SCENE:CAMERA...: sampled runs against
exact ones, as the tables of docs/sampling.md have them.

For each configuration and view one exact run and N sampled ones with the seeds 1 .. N: how many intervals of the cycles
hold the exact number, the median error, the share of the tiles, and the median time over that of the exact run: all of
host.wall_s but loading and projection, so that a run that falls back pays for its sample, too. Runs with DEGS_PROGRAM
(default build/release/sim/degs); scenes are SCENE/scene.ply in DEGS_SCENES (default ../shared/scenes). A configuration
is a file of configs without its ending; what follows a '+' in its name goes to --set."""
import argparse
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


def run(config, view, resolution, more):
    """The report of a run."""
    name, *overrides = config.split("+")
    scene, camera = view.split(":")
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (name + ".yaml")), "--scene",
                   str(SCENES / scene / "scene.ply"), "--camera", camera, "--no-reference", "--out", folder]
        command += ["--resolution", resolution] if resolution else []
        for override in overrides:
            command += ["--set", override]
        subprocess.run(command + more, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            return json.load(file)


def seconds(report):
    """What a user waits for: everything but reading the scene and projecting it."""
    host = report["host"]
    return host["wall_s"] - host["load_s"] - host["workload_s"]


def row(config, view, options):
    """One line of the table, and its counts."""
    exact = run(config, view, options.resolution, [])
    cycles = exact["timing"]["cycles"]
    held, errors, shares, times, fallen = 0, [], [], [], 0
    for seed in range(1, options.seeds + 1):
        report = run(config, view, options.resolution, ["--within", options.within, "--seed", str(seed)])
        times.append(seconds(report) / seconds(exact))
        if "sampling" not in report:
            fallen += 1
            continue
        facts = report["sampling"]
        low, high = facts["intervals"]["timing"]["cycles"]
        held += low <= cycles <= high
        errors.append(abs(report["timing"]["cycles"] / cycles - 1))
        shares.append(facts["tiles_measured"] / facts["tiles"])
    sampled = len(errors)
    cells = [config.replace("+", " "), view.replace(":", ", camera "), f"{held} of {sampled}", str(fallen)]
    cells += [f"{100 * statistics.median(errors):.2f}", f"{100 * statistics.mean(shares):.0f}"] if errors else ["", ""]
    cells.append(f"{statistics.median(times):.2f}")
    print("| " + " | ".join(cells) + " |", flush=True)
    return held, sampled, errors


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--within", default="1%")
    parser.add_argument("--resolution", default="")
    parser.add_argument("--configs", nargs="+", default=["degs-64", "gscore-64"])
    parser.add_argument("--views", nargs="+", default=["flowers:2"])
    options = parser.parse_args()
    print("| design | view | intervals that hold | exact instead | median error, % | tiles, % | time / exact |")
    print("|---|---|---:|---:|---:|---:|---:|")
    held, sampled, errors = 0, 0, []
    for config in options.configs:
        for view in options.views:
            more = row(config, view, options)
            held, sampled, errors = held + more[0], sampled + more[1], errors + more[2]
    if sampled:
        print(f"\n{held} of {sampled} intervals hold the exact number; the median error is "
              f"{100 * statistics.median(errors):.2f} %.")


if __name__ == "__main__":
    sys.exit(main())
