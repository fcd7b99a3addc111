#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""relaxed.py [--views SCENE:CAMERA...] [--runs N]: what feedback costs in exact runs of DeGS with 64 PEs, as the table
of docs/speed.md has it.

Each line leaves out one kind of feedback, by keys of the configuration, and has the error of the cycles and the host
time (`host.sim_s`, the shortest of N runs in turn) over those of the design as it is, over all views: smallest and
largest. Runs with DEGS_PROGRAM (default build/release/sim/degs); scenes are SCENE/scene.ply in DEGS_SCENES (default
../shared/scenes)."""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes")))
RELAXED = {
    "no reuse distance": ["scheduler.reuse_cycles=1", "array.writeback_cycles=1"],
    "finished tiles seen 64 cycles late": ["monitor.latency_cycles=64"],
    "finished tiles not seen": ["monitor.cancel=false"],
}


def run(view, changes):
    """Cycles and host seconds of a run."""
    scene, camera = view.split(":")
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs/degs-64.yaml"), "--scene", str(SCENES / scene / "scene.ply"),
                   "--camera", camera, "--no-reference", "--set", "pipeline.numbers=fp32", "--out", folder]
        for change in changes:
            command += ["--set", change]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
    return report["timing"]["cycles"], report["host"]["sim_s"]


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--views", nargs="+", default=[f"{scene}:2" for scene in
                                                       ["flowers", "guitar", "seal", "skull", "st-peter"]])
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    errors, times = {name: [] for name in RELAXED}, {name: [] for name in RELAXED}
    for view in options.views:
        plain, found = [], {name: [] for name in RELAXED}
        for _ in range(options.runs):
            plain.append(run(view, []))
            for name, changes in RELAXED.items():
                found[name].append(run(view, changes))
        for name, runs in found.items():
            errors[name].append(100 * (runs[0][0] / plain[0][0] - 1))
            times[name].append(min(s for _, s in runs) / min(s for _, s in plain))
    print("| left out | cycles, % | host time |")
    print("|---|---:|---:|")
    for name in RELAXED:
        print(f"| {name} | {min(errors[name]):+.1f} to {max(errors[name]):+.1f} | "
              f"{min(times[name]):.2f} to {max(times[name]):.2f} |")


if __name__ == "__main__":
    main()
