#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""orange.py [images] [throughput] [sweep] [--scenes NAME...] [--resolution NAME]: the tables of docs/orange.md, all of
them without a name. `images`: error of products of matrices with either origin. `throughput`: DeGS-64 over ORANGE O-4 at
51.2 and 204.8 GB/s, frames in sequence. `sweep`: what 4 to 16 384 multipliers of one core do.

Runs with DEGS_PROGRAM (default build/release/sim/degs) and DEGS_SCENES (default ../shared/scenes). A scene may also be
synthetic:NAME."""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes")))
BANDWIDTHS = {"51.2": "51.2", "204.8": "204.8"}


def scene_of(name):
    """What --scene takes."""
    return name if name.startswith("synthetic:") else str(SCENES / name / "scene.ply")


def degs(*arguments):
    """Runs the program; a folder among the arguments is its output."""
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def config(design):
    """Path of a shipped design."""
    return str(ROOT / "configs" / (design + ".yaml"))


def table(headings, rows):
    """A Markdown table, the first column of which is text."""
    print("| " + " | ".join(headings) + " |")
    print("|---|" + "--:|" * (len(headings) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def images(options):
    """PSNR against double precision, by numbers and origin."""
    numbers = ["fp32", "fp16"]
    rows = []
    for name in options.scenes:
        for camera in options.cameras:
            cells = []
            for origin in ("tile", "image"):
                with tempfile.TemporaryDirectory() as out:
                    degs("accuracy", "--scene", scene_of(name), "--camera", camera, "--resolution",
                         options.resolution, "--tile-size", "8", "--numbers", ",".join(numbers), "--products", origin,
                         "--no-error-images", "--out", out)
                    with open(os.path.join(out, "accuracy.json"), encoding="utf-8") as file:
                        psnr = {row["numbers"]: row["psnr_db"] for row in json.load(file)}
                cells += [f"{psnr[each]:.1f}" for each in numbers]
            rows.append([f"{name}, camera {camera}", cells[0], cells[2], cells[1], cells[3]])
    table(["PSNR in dB", "fp32, tile", "fp32, image", "FP16, tile", "FP16, image"], rows)


def compared(designs, scene, camera, options, *more):
    """Rows of compare.csv by name of the design."""
    with tempfile.TemporaryDirectory() as out:
        degs("compare", *[config(design) for design in designs], "--scene", scene_of(scene), "--camera", camera,
             "--resolution", options.resolution, "--frames", "3", "--no-reference", "--out", out, *more)
        with open(os.path.join(out, "compare.csv"), encoding="utf-8") as file:
            return {row["config"]: row for row in csv.DictReader(file) if row["scene"]}


def throughput(options):
    """Frames per second of DeGS-64 over those of O-4, with what limits the NPU."""
    rows, ratios = [], {each: [] for each in BANDWIDTHS}
    for name in options.scenes:
        for camera in options.cameras:
            cells = []
            for bandwidth in BANDWIDTHS:
                both = compared(["degs-64", "orange-o4"], name, camera, options, "--set",
                                "memory.bandwidth_gb_per_s=" + bandwidth)
                ours, theirs = both["degs-64"], both["orange-o4"]
                ratio = float(ours["throughput_fps"]) / float(theirs["throughput_fps"])
                ratios[bandwidth].append(ratio)
                cells += [f"{float(ours['throughput_fps']):.0f}", f"{float(theirs['throughput_fps']):.0f}",
                          f"{ratio:.2f}"]
            rows.append([f"{name}, camera {camera}", *cells])
    means = [f"{math.exp(sum(map(math.log, each)) / len(each)):.2f}" for each in ratios.values()]
    rows.append(["geometric mean", "", "", means[0], "", "", means[1]])
    table(["scene", "51.2 GB/s: DeGS-64, fps", "O-4, fps", "ratio", "204.8 GB/s: DeGS-64, fps", "O-4, fps", "ratio"],
          rows)


def sweep(options):
    """One core with a square array of 4 to 16 384 multipliers, array alone."""
    sides = [2, 4, 8, 16, 32, 64, 128]
    rows = []
    for side in sides:
        with tempfile.TemporaryDirectory() as out:
            design = os.path.join(out, "design.yaml")
            with open(design, "w", encoding="utf-8") as file:
                file.write(degs("config", "orange", "--pes", str(side * side)))
            command = ["run", design, "--scene", scene_of(options.scenes[0]), "--camera", options.cameras[0],
                       "--resolution", options.resolution, "--array-only", "--no-reference", "--out", out]
            degs(*command)
            with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
                report = json.load(file)
        slots = report["slots"]
        total = sum(slots[each] for each in ("useful", "boundary", "terminated", "conflict", "ports", "padding",
                                             "starved", "blocked", "drain"))
        executed = slots["useful"] + slots["boundary"] + slots["terminated"]
        share = 6 / (math.ceil(6 / side) * side)
        rows.append([f"{side} x {side}", str(side * side), f"{100 * share:.2f}",
                     f"{100 * executed / (executed + slots['padding']):.2f}", f"{100 * slots['useful'] / total:.2f}",
                     f"{report['timing']['cycles'] / 1e6:.2f}"])
    print(f"{options.scenes[0]}, camera {options.cameras[0]}, {options.resolution}, array alone\n")
    table(["array", "multipliers", "reduction alone %", "of busy cycles %", "useful %", "M cycles"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="*")
    parser.add_argument("--scenes", nargs="+", default=["guitar", "skull", "seal"])
    parser.add_argument("--cameras", nargs="+", default=["2", "1"])
    parser.add_argument("--resolution", default="720p")
    options = parser.parse_args()
    makers = {"images": images, "throughput": throughput, "sweep": sweep}
    unknown = [each for each in options.tables if each not in makers]
    if unknown:
        parser.error(f"there is no table '{unknown[0]}'; there are {', '.join(makers)}")
    for name in options.tables or makers:
        makers[name](options)


if __name__ == "__main__":
    main()
