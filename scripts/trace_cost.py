#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""trace_cost.py [--runs N] [CONFIG...]: processor time of `degs run` with --trace and with --maps over the same without,
smallest and median of N alternating runs, as the table of docs/timeline.md has them.

Runs with DEGS_PROGRAM (default build/release/sim/degs) on camera 2 of flowers in DEGS_SCENES (default ../shared/scenes),
without the cache. A configuration is a file of configs without its ending."""
import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENE = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes"))) / "flowers/scene.ply"
OPTIONS = {"": [], "--trace": ["trace.json"], "--maps": ["maps"]}


def seconds(config, option):
    """Processor time of one run, user and system."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (config + ".yaml")), "--scene", str(SCENE), "--camera", "2",
                   "--no-reference", "--no-cache", "--out", folder]
        command += [option, os.path.join(folder, OPTIONS[option][0])] if option else []
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=4)
    parser.add_argument("configs", nargs="*", default=["degs-64", "degs-64-tuned", "gscore-64", "gbu-64", "gcc-64"])
    options = parser.parse_args()
    print("| design | with `--trace` | median | with `--maps` | median |")
    print("|---|---:|---:|---:|---:|")
    for config in options.configs:
        times = {option: [] for option in OPTIONS}
        for _ in range(options.runs):
            for option, measured in times.items():
                measured.append(seconds(config, option))
        cells = []
        for option in ("--trace", "--maps"):
            for of in (min, statistics.median):
                cells.append(f"{of(times[option]) / of(times['']):.2f}")
        print(f"| {config} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
