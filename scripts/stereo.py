#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""stereo.py SCENE[=UNITS]... [--eyes M] [--width PX] [--height PX] [--camera C]: what two eyes of a headset save when
they share the reading of the scene. UNITS are scene units for a metre (default 1). Each of five accelerators renders a
frame of two views with every step of sharing that it has, with its own memory; the lines are percent of
the same frame with eyes that share nothing. docs/stereo.md says what they mean.

Runs with DEGS_PROGRAM (default build/release/sim/degs)."""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
# Design, the section that has the key, and the steps of sharing beside `nothing`.
TILED = ("projection", ("geometry", "sh", "colour"))
DESIGNS = {"degs-64": TILED, "gscore-64": TILED, "gbu-64": TILED, "gcc-64": ("grouping", ("geometry",)),
           "orange-o1": TILED}


def measure(scene, units, design, key, options):
    """The section `views` and the dates of a run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (design + ".yaml")), "--scene", scene, "--camera",
                   str(options.camera), "--width", str(options.width), "--height", str(options.height), "--eyes",
                   str(options.eyes), "--units-per-metre", units, "--no-reference", "--set", key, "--out", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
    frame = report["views"]["per_frame"]
    streams = report["dram"]["streams"]
    return {"scene": sum(streams[name]["bytes_read"] for name in ("geometry", "means", "shapes", "sh")
                         if name in streams),
            "bytes": frame["bytes_read"] + frame["bytes_written"], "cycles": frame["cycles"],
            "energy": frame["energy_nj"]}


def line(design, shared, run, base):
    """A row of the table."""
    parts = [design, f"`{shared}`"]
    for name in ("scene", "bytes", "cycles", "energy"):
        change = 100 * (run[name] / base[name] - 1)
        value = {"scene": f"{run[name] / 1e6:.1f}", "bytes": f"{run[name] / 1e6:.1f}",
                 "cycles": f"{run[name] / 1e6:.2f}", "energy": f"{run[name] / 1e6:.2f}"}[name]
        parts.append(value if run is base else f"{value} ({change:+.1f} %)")
    return "| " + " | ".join(parts) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--eyes", type=float, default=0.065)
    parser.add_argument("--width", type=int, default=2064)
    parser.add_argument("--height", type=int, default=2208)
    parser.add_argument("--camera", type=int, default=1)
    options = parser.parse_args()
    for name in options.scenes:
        scene, _, units = name.partition("=")
        print(f"{pathlib.Path(scene).parent.name or scene}: 2 × {options.width} × {options.height}, eyes "
              f"{options.eyes} m apart, {units or 1} units for a metre\n")
        print("| design | shared | scene read, MB | memory, MB | Mcycles | mJ |\n|---|---|--:|--:|--:|--:|")
        for design, (section, steps) in DESIGNS.items():
            base = None
            for shared in ("nothing", *steps):
                run = measure(scene, units or "1", design, f"{section}.shared_by_views={shared}", options)
                base = base or run
                print(line(design, shared, run, base), flush=True)
        print()


if __name__ == "__main__":
    main()
