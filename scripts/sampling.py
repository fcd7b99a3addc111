#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sampling.py [--seeds N] [--within E] [--resolution R] --configs CONFIG... --views SCENE:CAMERA...: sampled runs against
exact ones, as the tables of docs/sampling.md have them.

For each configuration and view one exact run and N sampled ones with the seeds 1 .. N: how many intervals of the cycles
hold the exact number, the median error, the share of the tiles, and the median time over that of the exact run: the
processor seconds host.run_s, in which a run that falls back pays for its sample, too. Then one line per configuration
and one for all of them. Runs with DEGS_PROGRAM (default build/release/sim/degs); scenes are SCENE/scene.ply in
DEGS_SCENES (default ../shared/scenes). A configuration is a file of configs without its ending; what follows a '+' in
its name goes to --set. `closeups:CAMERA` stands for the five trained scenes that are close-ups. Exits with 1 if fewer
intervals hold than --least says, in percent."""
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
LISTS = ["--set", "pipeline.tiles=exact"]  # with which the tables of docs/sampling.md were measured


def run(config, view, resolution, more):
    """The report of a run."""
    name, *overrides = config.split("+")
    scene, camera = view.split(":")
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (name + ".yaml")), "--scene",
                   str(SCENES / scene / "scene.ply"), "--camera", camera, "--no-reference", "--out", folder, *LISTS]
        command += ["--resolution", resolution] if resolution else []
        for override in overrides:
            command += ["--set", override]
        subprocess.run(command + more, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            return json.load(file)


CLOSEUPS = ["flowers", "guitar", "seal", "skull", "st-peter"]


def views_of(names):
    """SCENE:CAMERA, with `closeups` as five scenes."""
    views = []
    for name in names:
        scene, camera = name.split(":")
        views += [f"{one}:{camera}" for one in (CLOSEUPS if scene == "closeups" else [scene])]
    return views


def row(config, view, options):
    """Prints one line of the table; its counts and lists."""
    exact = run(config, view, options.resolution, [])
    cycles = exact["timing"]["cycles"]
    held, errors, shares, times, fallen = 0, [], [], [], 0
    for seed in range(1, options.seeds + 1):
        report = run(config, view, options.resolution, ["--within", options.within, "--seed", str(seed)])
        times.append(report["host"]["run_s"] / exact["host"]["run_s"])
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
    return {"held": held, "fallen": fallen, "errors": errors, "times": times}


def print_sum(name, rows):
    """What several lines say together."""
    held, fallen = sum(r["held"] for r in rows), sum(r["fallen"] for r in rows)
    errors = [error for r in rows for error in r["errors"]]
    times = [time for r in rows for time in r["times"]]
    error = f", median error {100 * statistics.median(errors):.2f} %" if errors else ""
    print(f"{name}: {held} of {len(errors)} intervals hold, {fallen} runs exact instead{error}, "
          f"median time {statistics.median(times):.2f} of exact")
    return 100 * held / len(errors) if errors else 100


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--within", default="1%")
    parser.add_argument("--resolution", default="")
    parser.add_argument("--configs", nargs="+", default=["degs-64", "gscore-64"])
    parser.add_argument("--views", nargs="+", default=["closeups:2"])
    parser.add_argument("--least", type=float, default=0)
    options = parser.parse_args()
    print("| design | view | intervals that hold | exact instead | median error, % | tiles, % | time / exact |")
    print("|---|---|---:|---:|---:|---:|---:|")
    rows = {config: [row(config, view, options) for view in views_of(options.views)] for config in options.configs}
    print()
    for config, of_config in rows.items():
        print_sum(config, of_config)
    return print_sum("all", [r for of_config in rows.values() for r in of_config]) < options.least


if __name__ == "__main__":
    sys.exit(main())
