#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""records.py records|lists|rows|joint|rounding [--quick] [FOLDER]: tables of docs/readings.md and docs/numbers.md
as Markdown, on what records, tile lists and Row Generation are worth; measured with
build/release/sim/degs.

  records   latency per mm2 over DeGS by the records that all designs read
  lists     cycles of DeGS and GSCore by how list entries reach memory
  rows      utilisation of the arrays of GBU by the rows that an engine solves per cycle, at 2K
  joint     latency per mm2 over DeGS with the files of configs/readings, and DeGS by single keys
  rounding  PSNR of images by number set whose Gaussians are rounded to records of FP16 and of 27 B,
            from 720p to 8K; with --quick of one small synthetic scene at 720p

Reports stay in FOLDER, and what is there already is not run again. Environment variables:
DEGS_PROGRAM, DEGS_SCENES, and lists of words: SCENES (of `records` and `lists`), TRAINED (of
`rounding`), RESOLUTION (default 1080p), CAMERA (default 2).
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = os.environ.get("DEGS_PROGRAM", ROOT / "build/release/sim/degs")
FOLDER = Path(os.environ.get("DEGS_SCENES", ROOT / "../shared/scenes"))
SCENES = os.environ.get("SCENES", "flowers synthetic:landscape,gaussians=1000000 "
                        "synthetic:landscape,gaussians=3000000 synthetic:landscape,gaussians=6000000").split()
TRAINED = os.environ.get("TRAINED", "flowers skull").split()
RESOLUTION = os.environ.get("RESOLUTION", "1080p")
CAMERA = os.environ.get("CAMERA", "2")
EQUAL = {"FP16, SH of visible (shipped)": (),
         "27 B, SH of visible": ("pipeline.records=tuned", "traffic.sh=visible"),
         "FP32, SH of all": ("pipeline.records=fp32", "traffic.sh=all")}
LISTS = {"stream (shipped)": (),
         "combined in 8 KB": ("binning.entries=combined",),
         "combined in 64 KB": ("binning.entries=combined", "binning.buffer_bytes=65536"),
         "combined in 8 KB, ends in memory": ("binning.entries=combined", "binning.head_bytes=0"),
         "a burst per entry": ("binning.entries=entries",),
         "a burst per entry, ends in memory": ("binning.entries=entries", "binning.head_bytes=0")}
PASSES = {"degs-64": "sorting.memory_passes=2", "gscore-64": "sorting.memory_levels=2"}
NUMBERS = ("ideal", "fp32", "fp16", "paper", "tuned")
RECORDS = ("fp16", "tuned")
SIZES = ("720p", "1080p", "2k", "4k", "8k")
STREAMS = ("tile_lists_written", "tile_lists_sorted", "list_heads")


def path_of(scene):
    """A scene file, or the name of a synthetic scene."""
    return scene if scene.startswith("synthetic:") else str(FOLDER / scene / "scene.ply")


def report(out, design, scene, settings, resolution=RESOLUTION, more=()):
    """The report of a run, as JSON."""
    name = "-".join([design, scene, resolution, CAMERA, *settings, *more]).replace("/", "_").replace(":", "_")
    file = out / name / "report.json"
    if not file.exists():
        sets = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([PROGRAM, "run", ROOT / f"configs/{design}.yaml", "--scene", path_of(scene), "--camera", CAMERA,
                        "--resolution", resolution, "--no-reference", "--out", out / name, *sets, *more],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads(file.read_text())


def records(out):
    """Latency per area over that of DeGS."""
    print("| scene | records | DeGS-64, ms | GSCore | GBU | GCC |\n|---|---|--:|--:|--:|--:|")
    for scene in SCENES:
        for name, settings in EQUAL.items():
            cost = {}
            for design in ("degs-64", "gscore-64", "gbu-64", "gcc-64"):
                # GCC reads SH in a stage of its own, of Gaussians that it draws.
                mine = [s for s in settings if design != "gcc-64" or not s.startswith("traffic.sh=")]
                found = report(out, design, scene, mine)
                cost[design] = found["timing"]["latency_ms"] * found["area"]["mm2"]
                if design == "degs-64":
                    latency = found["timing"]["latency_ms"]
            ratios = " | ".join(f"{cost[d] / cost['degs-64']:.2f}" for d in ("gscore-64", "gbu-64", "gcc-64"))
            print(f"| {scene} | {name} | {latency:.3f} | {ratios} |", flush=True)


def lists(out):
    """Cycles, and the share of traffic that makes and sorts lists."""
    print("| scene | entries | DeGS-64, cycles | lists, % of bytes | GSCore-64, cycles | lists, % of bytes |\n"
          "|---|---|--:|--:|--:|--:|")
    for scene in SCENES:
        for name, settings in [*LISTS.items(), ("stream, 2 passes of sorting through memory", None)]:
            cells = []
            for design in ("degs-64", "gscore-64"):
                found = report(out, design, scene, settings if settings is not None else (PASSES[design],))
                streams = {n: s["bytes_read"] + s["bytes_written"] for n, s in found["dram"]["streams"].items()}
                share = 100 * sum(streams.get(n, 0) for n in STREAMS) / sum(streams.values())
                cells.append(f"{found['timing']['cycles']} | {share:.0f}")
            print(f"| {scene} | {name} | {' | '.join(cells)} |", flush=True)


def rows(out):
    """Useful share of the PE slots of arrays alone, and of whole accelerators at 64 PEs."""
    rates = (0, 8, 4, 2, 1)
    print("| design | " + " | ".join("all" if rate == 0 else str(rate) for rate in rates) + " | area of 0 / 8 / 1, mm2 |")
    print("|---|" + "--:|" * (len(rates) + 1))
    for design in ("gbu-16", "gbu-64", "gbu-256", "gbu-1024"):
        found = {rate: report(out, design, "flowers", (f"engines.rows_per_cycle={rate}",), "2k", ("--array-only",))
                 for rate in rates}
        areas = " / ".join(f"{found[rate]['area']['mm2']:.2f}" for rate in (0, 8, 1))
        print(f"| {design} | " + " | ".join(f"{100 * found[rate]['slots']['utilization']:.1f}" for rate in rates) +
              f" | {areas} |", flush=True)


JOINT = ("pipeline.tiles=box", "slicing.rows=tile", "slicing.interleave=2", "span.rows=pool",
         "pixel_buffer.release=bank", "pipeline.span_ends=exact", "scheduler.termination=pixel")


def joint(out):
    """The joint reading, and how many cycles DeGS takes less by each of its keys alone."""
    print("| scene | useful share of DeGS-64, % | GSCore | GBU | GCC |\n|---|--:|--:|--:|--:|")
    for scene in SCENES:
        cost = {}
        for design in ("degs-64", "gscore-64", "gbu-64", "gcc-64"):
            found = report(out, f"readings/{design}-joint", scene, ())
            cost[design] = found["timing"]["latency_ms"] * found["area"]["mm2"]
            if design == "degs-64":
                useful = 100 * found["slots"]["utilization"]
        ratios = " | ".join(f"{cost[d] / cost['degs-64']:.2f}" for d in ("gscore-64", "gbu-64", "gcc-64"))
        print(f"| {scene} | {useful:.1f} | {ratios} |", flush=True)
    print("\n| key alone | " + " | ".join(SCENES) + " |\n|---|" + "--:|" * len(SCENES))
    for key in JOINT:
        cells = []
        for scene in SCENES:
            base, found = (report(out, "degs-64", scene, keys)["timing"]["cycles"] for keys in ((), (key,)))
            cells.append(f"{100 * (base / found - 1):+.1f}")
        print(f"| `{key}` | {' | '.join(cells)} |", flush=True)


def psnr_of(out, scene, resolution):
    """PSNR in dB by number set and records, of one image of a scene."""
    out = out / f"rounding-{Path(scene).name.replace(':', '_')}-{resolution}"
    names = [f"{numbers}:records={kind}" for numbers in NUMBERS for kind in RECORDS]
    if not (out / "accuracy.json").exists():
        subprocess.run([PROGRAM, "accuracy", "--scene", path_of(scene), "--camera", CAMERA, "--resolution", resolution,
                        "--no-error-images", "--out", out, "--numbers", ",".join(names)],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    rows = json.loads((out / "accuracy.json").read_text())
    return {name: row["psnr_db"] for name, row in zip(names, rows)}


def rounding(out, quick):
    """PSNR of every number set with both kinds of records, by resolution."""
    scenes, sizes = (["synthetic:object,gaussians=2000"], ["720p"]) if quick else (TRAINED, SIZES)
    found = {(scene, size): psnr_of(out, scene, size) for size in sizes for scene in scenes}
    print("| FP16 / 27 B | scene | " + " | ".join(sizes) + " |\n|---|---|" + "--:|" * len(sizes))
    for numbers in NUMBERS:
        for scene in scenes:
            cells = [" / ".join(f"{found[scene, size][f'{numbers}:records={kind}']:.1f}" for kind in RECORDS)
                     for size in sizes]
            print(f"| `{numbers}` | {scene} | {' | '.join(cells)} |")


def main():
    tables = {"records": records, "lists": lists, "rows": rows, "joint": joint, "rounding": rounding}
    words = [word for word in sys.argv[1:] if word != "--quick"]
    quick = len(words) < len(sys.argv) - 1
    if len(words) not in (1, 2) or words[0] not in tables or (quick and words[0] != "rounding"):
        sys.exit(__doc__)
    out = Path(words[1] if len(words) == 2 else tempfile.mkdtemp())
    tables[words[0]](out, *([quick] if words[0] == "rounding" else []))


main()
