#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""analytic.py [--designs CONFIG...] [--scenes SCENE...] [--exact FOLDER]: the analytic fidelity against exact runs, as
the table of docs/analytic.md has it.

For each design and each view of the scenes one exact run and one estimate: the share of the views within 10 % of the
exact cycles, the median error without sign, the worst one with its view, and the time of the estimate after the frame
is projected, median and longest. Runs with DEGS_PROGRAM (default build/release/sim/degs); scenes are SCENE/scene.ply in
DEGS_SCENES (default ../shared/scenes), with the cameras of their cameras.json. A design is a file of configs without
its ending. --exact keeps the cycles of exact runs in a folder, and takes those that are there."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes")))
ALL_SCENES = ["flowers", "flowers-small", "fruit-drops", "garden-crop", "guitar", "seal", "skull", "st-peter"]
SIZES = ["16", "64", "256", "1024"]
LISTS = ["--set", "pipeline.tiles=exact"]  # with which the tables of docs/analytic.md were measured
ALL_DESIGNS = [f"{family}-{size}" for family in ["degs", "gscore", "gbu", "gcc"] for size in SIZES]
ALL_DESIGNS += ["degs-64-tuned", "degs-256-tuned", "degs-1024-tuned", "degs-1024-streams"]


def run(design, scene, camera, fidelity):
    """report.json, or analytic.json, of a run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (design + ".yaml")), "--scene",
                   str(SCENES / scene / "scene.ply"), "--camera", str(camera), "--no-reference", "--fidelity", fidelity,
                   "--out", folder, *LISTS]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        name = "analytic.json" if fidelity == "analytic" else "report.json"
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return json.load(file)


def exact_cycles(design, scene, camera, folder):
    """From the folder, if it is there."""
    kept = pathlib.Path(folder) / f"{design}.{scene}.{camera}" if folder else None
    if kept and kept.exists():
        return int(kept.read_text(encoding="utf-8"))
    cycles = run(design, scene, camera, "exact")["timing"]["cycles"]
    if kept:
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(str(cycles), encoding="utf-8")
    return cycles


def row(design, views, folder):
    """Prints a line of the table; returns errors and times."""
    errors, times = {}, []
    for scene, camera in views:
        report = run(design, scene, camera, "analytic")
        errors[f"{scene}, camera {camera}"] = \
            report["timing"]["cycles"] / exact_cycles(design, scene, camera, folder) - 1
        times.append(1e3 * report["host"]["estimate_s"])
    print_line(design, errors, times)
    return errors, times


def print_line(name, errors, times):
    """One line of the table."""
    near = sum(abs(error) <= 0.1 for error in errors.values())
    worst = max(errors, key=lambda view: abs(errors[view]))
    cells = [name, f"{near} of {len(errors)}", f"{100 * statistics.median(map(abs, errors.values())):.1f}",
             f"{100 * errors[worst]:+.0f}: {worst}", f"{statistics.median(times):.1f}", f"{max(times):.1f}"]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--designs", nargs="+", default=ALL_DESIGNS)
    parser.add_argument("--scenes", nargs="+", default=ALL_SCENES)
    parser.add_argument("--exact", default="")
    options = parser.parse_args()
    views = []
    for scene in options.scenes:
        with open(SCENES / scene / "cameras.json", encoding="utf-8") as file:
            views += [(scene, camera) for camera in range(len(json.load(file)))]
    print("| design | within 10 % | median error, % | worst, % | time, ms | longest, ms |")
    print("|---|---:|---:|---|---:|---:|")
    errors, times = {}, []
    for design in options.designs:
        new_errors, new_times = row(design, views, options.exact)
        errors.update({f"{design}, {view}": error for view, error in new_errors.items()})
        times += new_times
    print_line("all", errors, times)


if __name__ == "__main__":
    main()
