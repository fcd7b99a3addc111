#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""regime.py: prints the counts of real whole scenes beside those of the synthetic scenes that stand for them.

docs/regime.csv has the real ones. Without an option the views are measured with `degs scene info`; --utilization runs
three designs on each view. --only TEXT takes the rows whose first word contains TEXT, --gaussians N draws every scene
with that many Gaussians at most. --path FILE runs whole accelerators with a million Gaussians along 8 views of a camera
file, which scripts/camera_path.py moves into the scenes that --only names; --quick takes 2 small views of 20 000.
--large measures cameras 1 and 2 of the trained scenes in DEGS_SCENES_LARGE (default ../shared/scenes-large) at 1080p
instead. Runs DEGS_PROGRAM (default: degs of the search path, else build/release/sim/degs)."""
import argparse
import csv
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from camera_path import SPACES, moved_path
from join_sog import join

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM") or shutil.which("degs") or str(ROOT / "build/release/sim/degs")
LARGE = pathlib.Path(os.environ.get("DEGS_SCENES_LARGE", ROOT / "../shared/scenes-large"))
DESIGNS = ["degs-64", "degs-1024", "gscore-64"]
# The lists, and the banks of degs-1024, with which the real scenes were measured.
LISTS = ["--set", "pipeline.tiles=exact"]
AS_MEASURED = {"degs-1024": ["--set", "scheduler.segments_per_cycle=8", "--set", "scheduler.issue_width=8"]}
COUNTS = ["visible", "pairs_per_tile", "fragments_per_pixel", "fragments_per_splat", "footprint_p50", "ended",
          "covered", "gini"]


def call(*arguments):
    """What the program prints."""
    return subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True).stdout


def scene_of(row, most):
    gaussians = min(int(row["gaussians"]), most) if most else int(row["gaussians"])
    return f"synthetic:{row['synthetic']},gaussians={gaussians}", gaussians


def view_of(scene, row, width):
    """Statistics of the synthetic view."""
    return json.loads(call("scene", "info", scene, "--camera", row["camera"], "--width", width, "--json"))["view"]


def size_of(row):
    width = row["pixels"].split("x")[0]
    return ["--camera", row["camera"], "--width", width]


def counts_of(row, most):
    """The counts of the synthetic view; visible splats as a share, because --gaussians changes their number."""
    scene, gaussians = scene_of(row, most)
    view = view_of(scene, row, row["pixels"].split("x", maxsplit=1)[0])
    width, height = (int(side) for side in row["pixels"].split("x"))
    tiles = -(-width // 16) * -(-height // 16)
    # The captures' Gini coefficients are of images 960 pixels wide.
    gini = 100 * view_of(scene, row, "960")["footprint_gini"] if row["gini"] else 0
    return {"gini": gini, "visible": 100 * view["visible"] / gaussians, "pairs_per_tile": view["tile_pairs"] / tiles,
            "fragments_per_pixel": view["fragments_per_pixel"], "fragments_per_splat": view["fragments_per_splat"],
            "footprint_p50": view["footprint_px"]["p50"], "ended": 100 * view["terminated_share"],
            "covered": 100 * view["covered_share"]}


def utilizations_of(row, most):
    """Useful PE cycles of the frame in percent, of the array alone."""
    result = {}
    for design in DESIGNS:
        with tempfile.TemporaryDirectory() as folder:
            call("run", str(ROOT / f"configs/{design}.yaml"), *LISTS, *AS_MEASURED.get(design, []),
                 "--scene", scene_of(row, most)[0], *size_of(row),
                 "--array-only", "--no-reference", "--no-cache", "--out", folder + "/out")
            report = json.loads(pathlib.Path(folder, "out/report.json").read_text(encoding="utf-8"))
        result[design] = 100 * report["slots"]["frame_utilization"]
    return result


def cell(measured, made, relative):
    """measured | synthetic | difference, in percent or points."""
    difference = 100 * (made / measured - 1) if relative else made - measured
    return f"{measured:.3g} / {made:.3g} / {difference:+.0f}"


def print_table(rows, names, measure, relative):
    """A row for each view, and then how far each number is from the measured one over all views."""
    print("| measured / synthetic / difference | " + " | ".join(names) + " |")
    print("| --- |" + " ---: |" * len(names))
    found = {name: [] for name in names}
    for row in rows:
        made = measure(row)
        measured = {name: float(row[name]) for name in names if row[name]}
        if "visible" in measured:
            measured["visible"] *= 100 / int(row["gaussians"])
        cells = [cell(measured[name], made[name], relative) if name in measured else "" for name in names]
        view = f"{row['measured']} {row['view']} {row['pixels']}"
        for name, text in zip(names, cells):
            if text:
                found[name].append((measured[name], int(text.split(" / ")[2]), view))
        print(f"| {view} | " + " | ".join(cells) + " |", flush=True)
    print(f"\n| | measured | difference, {'%' if relative else 'points'} | largest |\n| --- | --- | --- | --- |")
    for name in filter(found.get, names):
        measured, differences, _ = zip(*found[name])
        farthest = max(found[name], key=lambda entry: abs(entry[1]))
        print(f"| {name} | {min(measured):.3g} to {max(measured):.3g} | {min(differences):+d} to {max(differences):+d} | "
              f"{farthest[2]} |")


def print_path(file, only, gaussians, quick):
    """Least, median and largest value over the views of a real path, for each scene and design."""
    most, views, width = (20_000, 2, "320") if quick else (gaussians or 1_000_000, 8, "1920")
    print("| scene | | useful slots, % | latency, ms |\n| --- | --- | ---: | ---: |")
    for name in [name for name in SPACES if only in name]:
        with tempfile.TemporaryDirectory() as folder:
            cameras = pathlib.Path(folder, "path.json")
            cameras.write_text(json.dumps(moved_path(file, name, views)), encoding="utf-8")
            call("compare", *[str(ROOT / f"configs/{design}.yaml") for design in DESIGNS], "--scene",
                 f"synthetic:{name},gaussians={most}", "--camera-file", str(cameras), "--camera", "all", "--width",
                 width, *LISTS, "--no-reference", "--out", folder + "/out")
            with open(folder + "/out/compare.csv", encoding="utf-8") as rows:
                found = list(csv.DictReader(rows))
        for design in DESIGNS:
            mine = [row for row in found if row["config"] == design]
            cells = []
            for key, factor, form in (("slots.utilization", 100, ".1f"), ("latency_ms", 1, ".2f")):
                values = [factor * float(row[key]) for row in mine]
                cells.append(" / ".join(format(of(values), form) for of in (min, statistics.median, max)))
            print(f"| {name} | {design} | {' | '.join(cells)} |", flush=True)


def print_large(only):
    """Views of the large trained scenes; those that came in parts are joined first."""
    folders = [folder for folder in sorted(LARGE.glob("*")) if folder.is_dir() and only in folder.name]
    if not folders:
        print(f"regime.py: no large scene is in {LARGE}; DEGS_SCENES_LARGE names another folder.", file=sys.stderr)
        return
    print("| scene | camera | Gaussians | visible | fragments per pixel | fragments per visible splat |")
    print("| --- |" + " ---: |" * 5)
    for folder in folders:
        with tempfile.TemporaryDirectory() as made:
            scene = join(folder, made + "/" + folder.name) if list(folder.glob("*.sog")) else str(folder)
            for camera in ("1", "2"):
                info = json.loads(call("scene", "info", scene, "--camera", camera, "--resolution", "1080p", "--json"))
                view = info["view"]
                print(f"| {folder.name} | {camera} | {info['scene']['gaussians']} | {view['visible']} | "
                      f"{view['fragments_per_pixel']:.1f} | {view['fragments_per_splat']:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--utilization", action="store_true")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--path", metavar="FILE")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--gaussians", type=int, default=0)
    options = parser.parse_args()
    if options.large:
        print_large(options.only)
        return
    if options.path:
        print_path(options.path, options.only, options.gaussians, options.quick)
        return
    with open(ROOT / "docs/regime.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if options.only in row["measured"]]
    if not rows:
        sys.exit(f"regime.py: no row of docs/regime.csv is called '{options.only}'.")
    if options.utilization:
        print_table(rows, DESIGNS, lambda row: utilizations_of(row, options.gaussians), False)
    else:
        print_table(rows, COUNTS, lambda row: counts_of(row, options.gaussians), True)


if __name__ == "__main__":
    main()
