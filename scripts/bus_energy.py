#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bus_energy.py [--width PX] [--designs NAME...]: energy of the memory by the model `bus` over that by `lpddr5`, both of
204.8 GB/s, on cameras 1 and 2 of the trained scenes: mean, least and most of every design, and the share of activations
that `bus` cannot see. Prints the table of docs/cost.md. Runs with DEGS_PROGRAM (default build/release/sim/degs); scenes
are SCENE/scene.ply in DEGS_SCENES (default ../shared/scenes)."""
import argparse
import json
import math
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes")))
VIEWS = [(scene, camera) for scene in ("flowers", "garden-crop", "guitar", "seal", "skull", "st-peter")
         for camera in ("1", "2")]


def report_of(design, view, width, model):
    """report.json of a run."""
    scene, camera = view
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "run", str(ROOT / f"configs/{design}.yaml"), "--scene", str(SCENES / scene / "scene.ply"),
                        "--camera", camera, "--width", width, "--no-reference", "--set", f"memory.model={model}", "--out",
                        folder], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return json.loads(pathlib.Path(folder, "report.json").read_text(encoding="utf-8"))


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--width", default="640")
    parser.add_argument("--designs", nargs="+", default=["degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1"])
    options = parser.parse_args()
    print("| design | bus / lpddr5, mean | least | most | activations, pJ/bit |")
    print("|---|---:|---:|---:|---:|")
    everything = []
    for design in options.designs:
        ratios, activations = [], []
        for view in VIEWS:
            bus, lpddr5 = (report_of(design, view, options.width, model) for model in ("bus", "lpddr5"))
            ratios.append(bus["energy"]["dram_nj"] / lpddr5["energy"]["dram_nj"])
            dram = lpddr5["dram"]
            activations.append(1e3 * dram["energy_nj"]["activate"] / 8 / (dram["bytes_read"] + dram["bytes_written"]))
        everything += ratios
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        print(f"| `{design}` | {mean:.3f} | {min(ratios):.3f} | {max(ratios):.3f} | "
              f"{min(activations):.2f} to {max(activations):.2f} |", flush=True)
    mean = math.exp(sum(map(math.log, everything)) / len(everything))
    print(f"| all | {mean:.3f} | {min(everything):.3f} | {max(everything):.3f} | |")


if __name__ == "__main__":
    main()
