#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""foveation.py SCENE... [--width PX] [--height PX] [--camera C] [--field DEGREES]
[--foveation X,Y:FOVEA:PERIPHERY]... [--designs NAME]... [--set KEY=VALUE]...: what a frame costs, and how far its image
is from a full one, with and without foveation. The camera C of the scene gets the width, the height and the field of
view of a headset. The percentages compare with the plain frame of the same design; docs/foveation.md says what the
columns mean.

Runs with DEGS_PROGRAM (default build/release/sim/degs)."""
import argparse
import json
import math
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SETTINGS = ("0.5,0.5:20:30", "0.5,0.5:10:20", "0.5,0.5:5:15")
DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1")
PARTS = ("fovea", "middle", "periphery")


def write_camera(scene, options, file):
    """The camera of a headset at the place of one of the scene's: square pixels, `field` degrees wide."""
    subprocess.run([PROGRAM, "scene", "cameras", scene, "--out", file], check=True, stdout=subprocess.DEVNULL)
    with open(file, encoding="utf-8") as cameras:
        camera = json.load(cameras)[options.camera]
    focal = options.width / 2 / math.tan(math.radians(options.field / 2))
    camera = {**{key: camera[key] for key in ("id", "img_name", "position", "rotation")},
              "width": options.width, "height": options.height, "fx": focal, "fy": focal}
    with open(file, "w", encoding="utf-8") as cameras:
        json.dump([camera], cameras)


def measure(scene, camera, design, setting, keys):
    """The cost of a run, and the errors of what each level shows."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", str(ROOT / "configs" / (design + ".yaml")), "--scene", scene,
                   "--camera-file", camera, "--out", folder]
        command += ["--foveation", setting] if setting else ["--no-reference"]
        command += [word for key in keys for word in ("--set", key)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
    streams = report["dram"]["streams"].values()
    whole = report["camera"]["width"] * report["camera"]["height"]
    return {"pixels": report["foveation"]["pixels_drawn"] if setting else whole,
            "cycles": report["timing"]["cycles"],
            "bytes": sum(stream["bytes_read"] + stream["bytes_written"] for stream in streams),
            "energy": report["energy"]["nj_per_frame"], "useful": report["slots"]["utilization"],
            "levels": {level["name"]: level for level in report["foveation"]["images"][0]["levels"]} if setting else {}}


def error_words(levels, name):
    """PSNR and FLIP of what a level shows."""
    if name not in levels:
        return "-"
    level = levels[name]
    psnr = "identical" if level["psnr_db"] == "inf" else f"{level['psnr_db']:.1f}"
    return f"{psnr} / {level['flip']:.4f}"


def line(design, setting, run, base):
    """A row of the table."""
    parts = [design, f"`{setting}`" if setting else "plain"]
    for name in ("pixels", "cycles", "bytes", "energy"):
        digits = {"pixels": 2, "cycles": 2, "bytes": 1, "energy": 2}[name]
        change = "" if run is base else f" ({100 * (run[name] / base[name] - 1):+.0f} %)"
        parts.append(f"{run[name] / 1e6:.{digits}f}{change}")
    parts.append(f"{100 * run['useful']:.0f}")
    return "| " + " | ".join(parts + [error_words(run["levels"], name) for name in PARTS]) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--width", type=int, default=2064)
    parser.add_argument("--height", type=int, default=2208)
    parser.add_argument("--camera", type=int, default=1)
    parser.add_argument("--field", type=float, default=90)
    parser.add_argument("--foveation", action="append")
    parser.add_argument("--designs", action="append", choices=DESIGNS)
    parser.add_argument("--set", action="append", default=[], dest="keys", metavar="KEY=VALUE")
    options = parser.parse_args()
    for scene in options.scenes:
        print(f"{pathlib.Path(scene).parent.name or scene}: {options.width} × {options.height}, {options.field:g} degrees "
              "wide\n")
        print("| design | foveation | Mpixels | Mcycles | MB | mJ | useful % | " + " | ".join(PARTS) + " |")
        print("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|")
        with tempfile.TemporaryDirectory() as folder:
            camera = os.path.join(folder, "cameras.json")
            write_camera(scene, options, camera)
            for design in options.designs or DESIGNS:
                base = measure(scene, camera, design, "", options.keys)
                print(line(design, "", base, base), flush=True)
                for setting in options.foveation or SETTINGS:
                    run = measure(scene, camera, design, setting, options.keys)
                    print(line(design, setting, run, base), flush=True)
        print()


if __name__ == "__main__":
    main()
