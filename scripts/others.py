#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""others.py [--quick]: prints the tables of docs/others.md, which has numbers of other publications beside ours.

docs/others.csv has the published ones. Their scenes are not here; synthetic scenes with as many Gaussians stand for
them. --quick takes scenes of 1000 Gaussians and images with a quarter of the width and height, which shows that the
script works and nothing else. Runs DEGS_PROGRAM (default: degs of the search path, else build/release/sim/degs)."""
import argparse
import csv
import functools
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM") or shutil.which("degs") or str(ROOT / "build/release/sim/degs")
RESOLUTIONS = {"720p": "1280x720", "1080p": "1920x1080", "2k": "2560x1440"}
LANDSCAPE, GARDEN, OBJECT = (f"synthetic:{name}" for name in ("landscape", "garden", "object"))
GAUSSIANS = {LANDSCAPE: 1026508, GARDEN: 1026508, OBJECT: 334000}  # Tanks & Temples train, NeRF-Synthetic Lego
ONE, WIDE = "readings/gscore-64-published", "readings/gscore-256-published"
SLOW, FAST = "memory.bandwidth_gb_per_s=51.2", "memory.bandwidth_gb_per_s=204.8"
FOUR, SQUARES, STREAM = "clusters=4", "pipeline.tiles=square", "binning.entries=stream"
# What configs/readings/gscore-64-published.yaml changes, for another design.
ALIKE = ("pipeline.records=fp32", "traffic.sh=all", "binning.entries=entries", "binning.head_bytes=0",
         "sorting.memory_levels=2")
DESIGNS = {"as shipped, 51.2 GB/s, 64 lanes": ("gscore-64", SLOW),
           "as published, 64 lanes": (ONE,),
           "as published, 256 lanes in one array": (WIDE,),
           "as published, 4 clusters of 64 lanes": (ONE, FOUR)}
TRIED = {"`sorting.memory_levels=4`": (ONE, FOUR, "sorting.memory_levels=4"),
         "`array.subtile_skip=none`": (ONE, FOUR, "array.subtile_skip=none"),
         "`memory.bandwidth_gb_per_s=33.4`": (ONE, FOUR, "memory.bandwidth_gb_per_s=33.4"),
         "`pipeline.tiles=square`": (ONE, FOUR, SQUARES),
         "`pipeline.tiles=square`, `traffic.sh=visible`": (ONE, FOUR, SQUARES, "traffic.sh=visible")}
STAGES = {"feature_extraction": ("geometry", "sh", "splats_written"),
          "sorting": ("tile_lists_written", "tile_lists_sorted", "list_heads"),
          "rasterisation": ("splats_read", "frame_buffer")}
FRAMES, GIB = 60, 1024**3 / 1e9
most = 0  # Gaussians of a scene at most, with --quick


def scene_of(scene):
    return f"{scene},gaussians={min(GAUSSIANS[scene], most) if most else GAUSSIANS[scene]}"


@functools.lru_cache(maxsize=None)
def report(design, scene, size):
    """The report of a run; `design` is a file and its changed keys, `size` are words of the command line."""
    with tempfile.TemporaryDirectory() as folder:
        sets = [word for key in design[1:] for word in ("--set", key)]
        subprocess.run([PROGRAM, "run", str(ROOT / f"configs/{design[0]}.yaml"), "--scene", scene_of(scene), *size,
                        "--no-reference", "--no-cache", "--out", folder + "/out", *sets], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return json.loads(pathlib.Path(folder, "out/report.json").read_text(encoding="utf-8"))


def large(design, resolution, scene=LANDSCAPE):
    size = ("--height", str(int(RESOLUTIONS[resolution].split("x")[1]) // 4)) if most else ("--resolution", resolution)
    return report(design, scene, ("--camera", "2", *size))


def lego(design):
    side = str(800 // 4 if most else 800)
    return report(design, OBJECT, ("--camera", "1", "--width", side, "--height", side))


def latency(found):
    return found["timing"]["latency_ms"]


def bytes_of(found, names=None):
    """GB of the named streams, or of all."""
    streams = found["dram"]["streams"]
    return sum(streams[n]["bytes_read"] + streams[n]["bytes_written"] for n in names or streams if n in streams) / 1e9


def published(measure, resolution=None):
    with open(ROOT / "docs/others.csv", encoding="utf-8") as file:
        return [float(row["value"]) for row in csv.DictReader(file)
                if row["measure"] == measure and resolution in (None, row["resolution"])]


def mean(values):
    return sum(values) / len(values)


def print_row(*cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def print_views():
    """How much there is to draw in the synthetic views."""
    for scene in (LANDSCAPE, GARDEN):
        for resolution in ("720p", "2k"):
            words = [PROGRAM, "scene", "info", scene_of(scene), "--camera", "2", "--resolution", resolution, "--json"]
            view = json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout)["view"]
            print(f"{scene_of(scene)}, {resolution}: {view['fragments_per_pixel']:.0f} fragments per pixel, "
                  f"{view['fragments_per_splat']:.0f} per visible splat")


def print_times():
    """Frame times and their growth."""
    print_row("GSCore, frame time in ms", *RESOLUTIONS, "growth")
    print_row("---", *["--:"] * 4)
    scenes = [published("frame_ms", size) for size in RESOLUTIONS.values()]
    means = [mean(values) for values in scenes]
    print_row("Neo, 16 cores, mean of the six scenes (range)",
              *(f"{mean(values):.1f} ({min(values):.1f} to {max(values):.1f})" for values in scenes),
              f"{means[2] / means[0]:.2f}")
    four = [1000 / published("fps_4_cores", size)[0] for size in RESOLUTIONS.values()]
    print_row("Neo, 4 cores", *(f"{value:.1f}" for value in four), f"{four[2] / four[0]:.2f}")
    rows = [(name, design, LANDSCAPE) for name, design in {**DESIGNS, **TRIED}.items()]
    rows.insert(len(DESIGNS), ("as before, `garden`", (ONE, FOUR), GARDEN))
    for name, design, scene in rows:
        values = [latency(large(design, resolution, scene)) for resolution in RESOLUTIONS]
        print_row(name, *(f"{value:.1f}" for value in values), f"{values[2] / values[0]:.2f}")


def print_traffic():
    """Bytes by stage, and what they need of the memory's rate."""
    print_row("GSCore, traffic per frame", "720p, GB", "2k, GB", "growth",
              "features / sorting / rasterisation at 2k, %", "mean rate, 720p / 2k, GB/s")
    print_row("---", *["--:"] * 5)
    small, big = RESOLUTIONS["720p"], RESOLUTIONS["2k"]
    times = [mean(published("frame_ms", size)) / 1000 for size in (small, big)]
    parts = {size: [published("traffic_" + stage, size)[0] * GIB / FRAMES for stage in STAGES] for size in (small, big)}
    low, high = sum(parts[small]), sum(parts[big])
    print_row("Neo, figure 5", f"{low:.2f}", f"{high:.2f}", f"{high / low:.2f}",
              " / ".join(f"{100 * part / high:.0f}" for part in parts[big]),
              f"{low / times[0]:.1f} / {high / times[1]:.1f}")
    total = mean(published("traffic_total", big)) * GIB / FRAMES
    print_row("Neo, figure 16", "", f"{total:.2f}", "", "", f"{total / times[1]:.1f} at 2k")
    for name, design in {"as shipped, 64 lanes": ("gscore-64", SLOW), "as published, 4 clusters": (ONE, FOUR),
                         "the same, 3σ squares": (ONE, FOUR, SQUARES)}.items():
        found = [large(design, resolution) for resolution in ("720p", "2k")]
        low, high = (bytes_of(one) for one in found)
        print_row(name, f"{low:.2f}", f"{high:.2f}", f"{high / low:.2f}",
                  " / ".join(f"{100 * bytes_of(found[1], names) / high:.0f}" for names in STAGES.values()),
                  " / ".join(f"{1000 * bytes_of(one) / latency(one):.1f}" for one in found))


def print_ratios():
    """Lego, and ratios of frame times."""
    print_row("measure", "published", "as shipped, 51.2 GB/s", "as published", "as published, lists as a stream")
    print_row("---", *["--:"] * 4)
    files = (("gscore-64", SLOW), (ONE,), (ONE, STREAM))
    columns, gbu = [lego(file) for file in files], lego(("gbu-64", SLOW))
    both = [" / ".join(f"{published(f'fps_{name}{end}')[0]:.0f}" for end in ("", "_rebuilt"))
            for name in ("GSCore", "GBU")]
    print_row("GSCore, Lego, fps (own / RenderSim)", both[0], *(f"{1000 / latency(found):.0f}" for found in columns))
    bare = (SQUARES, "array.subtile_skip=none")
    print_row("the same, 3σ squares, no sub-tile skipping", "",
              *(f"{1000 / latency(lego((*file, *bare))):.0f}" for file in files))
    print_row("GBU, Lego, fps (own / RenderSim)", both[1], f"{1000 / latency(gbu):.0f}", "", "")
    for name, measure, streams in (("Gaussians read, MB", "dram_Gaussian_In_FIFO", ("geometry", "sh")),
                                   ("splat records read, MB", "dram_GFeat_Buffer", ("splats_read",)),
                                   ("lists, and records written, MB", None, (*STAGES["sorting"], "splats_written"))):
        print_row("GSCore, Lego, " + name, f"{published(measure)[0]:.1f}" if measure else "none named",
                  *(f"{1000 * bytes_of(found, streams):.1f}" for found in columns))

    def times(*keys):
        return [latency(large((*file, *keys), "2k")) for file in files]

    one, four, fast = times(), times(FOUR), times(FOUR, FAST)
    print_row("GSCore, 16 over 4 cores, 2k", f"{published('speedup_cores')[0]:.2f}",
              *(f"{before / after:.2f}" for before, after in zip(one, four)))
    print_row("GSCore, 204.8 over 51.2 GB/s, 2k", f"{published('speedup_bandwidth')[0]:.2f}",
              *(f"{before / after:.2f}" for before, after in zip(four, fast)))
    quick = "binning.pairs_per_cycle=32"
    print_row(f"the same, `{quick}`", "",
              *(f"{before / after:.2f}" for before, after in zip(times(FOUR, quick), times(FOUR, FAST, quick))))
    orange = [latency(large(("orange-o4", SLOW, *keys), "2k")) for keys in ((), ALIKE, (*ALIKE, STREAM))]
    print_row("ORANGE with the same keys over GSCore, 2k", f"{published('speedup_ORANGE')[0]:.2f}",
              *(f"{before / after:.2f}" for before, after in zip(one, orange)))


def main():
    global most
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--quick", action="store_true")
    most = 1000 if parser.parse_args().quick else 0
    for part in (print_views, print_times, print_traffic, print_ratios):
        part()
        print()


if __name__ == "__main__":
    main()
