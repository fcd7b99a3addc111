# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/others.md: numbers of other publications beside ours.

docs/others.csv has the published ones. Their scenes are not here; synthetic scenes with as many Gaussians stand for
them."""
from measuring.points import ROOT, rows_of, run, view
from measuring.tables import markdown, table

PAGE = "docs/others.md"
RESOLUTIONS = {"720p": "1280x720", "1080p": "1920x1080", "2k": "2560x1440"}
LANDSCAPE = "synthetic:landscape,gaussians=1026508"  # as many as Tanks & Temples, train
GARDEN = "synthetic:garden,gaussians=1026508"
LEGO = "synthetic:object,gaussians=334000"  # as many as NeRF-Synthetic, Lego
ONE, WIDE = "readings/gscore-64-published", "readings/gscore-256-published"
SLOW, FAST = "memory.bandwidth_gb_per_s=51.2", "memory.bandwidth_gb_per_s=204.8"
FOUR, SQUARES, STREAM = "clusters=4", "pipeline.tiles=square", "binning.entries=stream"
NO_SKIP, MANY_PAIRS = "array.subtile_skip=none", "binning.pairs_per_cycle=32"
# What configs/readings/gscore-64-published.yaml changes, for another design.
ALIKE = ("pipeline.records=fp32", "traffic.sh=all", "binning.entries=entries", "binning.head_bytes=0",
         "sorting.memory_levels=2")
DESIGNS = {"as shipped, 51.2 GB/s, 64 lanes": ("gscore-64", SLOW),
           "as published, 64 lanes": (ONE,),
           "as published, 256 lanes in one array": (WIDE,),
           "as published, 4 clusters of 64 lanes": (ONE, FOUR)}
TRIED = {"`sorting.memory_levels=4`": (ONE, FOUR, "sorting.memory_levels=4"),
         "`array.subtile_skip=none`": (ONE, FOUR, NO_SKIP),
         "`memory.bandwidth_gb_per_s=33.4`": (ONE, FOUR, "memory.bandwidth_gb_per_s=33.4"),
         "`pipeline.tiles=square`": (ONE, FOUR, SQUARES),
         "`pipeline.tiles=square`, `traffic.sh=visible`": (ONE, FOUR, SQUARES, "traffic.sh=visible")}
STAGES = {"feature_extraction": ("geometry", "sh", "splats_written"),
          "sorting": ("tile_lists_written", "tile_lists_sorted", "list_heads"),
          "rasterisation": ("splats_read", "frame_buffer")}
FRAMES, GIB = 60, 1024**3 / 1e9


def large(design, resolution, scene=LANDSCAPE):
    """A run of a file with changed keys."""
    return run(design[0], scene, f"--camera 2 --resolution {resolution}", *design[1:])


def lego(design):
    return run(design[0], LEGO, "--camera 1 --width 800 --height 800", *design[1:])


def gigabytes(report, names=None):
    """GB of the named streams, or of all."""
    streams = report.to_dict()["dram"]["streams"]
    return sum(streams[name]["bytes_read"] + streams[name]["bytes_written"]
               for name in names or streams if name in streams) / 1e9


def published(measure, resolution=None):
    return [float(row["value"]) for row in rows_of(ROOT / "docs/others.csv")
            if row["measure"] == measure and resolution in (None, row["resolution"])]


def mean(values):
    return sum(values) / len(values)


@table(PAGE)
def others_views():
    """How much there is to draw."""
    found = yield {(scene, resolution): view(scene, f"--camera 2 --resolution {resolution}")
                   for scene in (LANDSCAPE, GARDEN) for resolution in ("720p", "2k")}
    rows = [[f"`{scene}`", resolution, f"{report.view.fragments_per_pixel:.0f}",
             f"{report.view.fragments_per_splat:.0f}"] for (scene, resolution), report in found.items()]
    return markdown(["scene", "resolution", "fragments per pixel", "per visible splat"], rows, 2)


@table(PAGE)
def others_times():
    """Frame times and their growth."""
    designs = [(name, design, LANDSCAPE) for name, design in {**DESIGNS, **TRIED}.items()]
    designs.insert(len(DESIGNS), ("as before, `garden`", (ONE, FOUR), GARDEN))
    found = yield {name: [large(design, resolution, scene) for resolution in RESOLUTIONS]
                   for name, design, scene in designs}
    scenes = [published("frame_ms", size) for size in RESOLUTIONS.values()]
    four = [1000 / published("fps_4_cores", size)[0] for size in RESOLUTIONS.values()]
    rows = [["Neo, 16 cores, mean of the six scenes (range)",
             *(f"{mean(values):.1f} ({min(values):.1f} to {max(values):.1f})" for values in scenes),
             f"{mean(scenes[2]) / mean(scenes[0]):.2f}"],
            ["Neo, 4 cores", *(f"{value:.1f}" for value in four), f"{four[2] / four[0]:.2f}"]]
    for name, reports in found.items():
        times = [report.latency_ms for report in reports]
        rows.append([name, *(f"{value:.1f}" for value in times), f"{times[2] / times[0]:.2f}"])
    return markdown(["GSCore, frame time in ms", *RESOLUTIONS, "growth"], rows)


@table(PAGE)
def others_traffic():
    """Bytes by stage, and what they need of the memory's rate."""
    designs = {"as shipped, 64 lanes": ("gscore-64", SLOW), "as published, 4 clusters": (ONE, FOUR),
               "the same, 3σ squares": (ONE, FOUR, SQUARES)}
    found = yield {name: [large(design, resolution) for resolution in ("720p", "2k")]
                   for name, design in designs.items()}
    sizes = RESOLUTIONS["720p"], RESOLUTIONS["2k"]
    times = [mean(published("frame_ms", size)) / 1000 for size in sizes]
    parts = [[published(f"traffic_{stage}", size)[0] * GIB / FRAMES for stage in STAGES] for size in sizes]
    low, high = map(sum, parts)
    total = mean(published("traffic_total", sizes[1])) * GIB / FRAMES
    rows = [["Neo, figure 5", f"{low:.2f}", f"{high:.2f}", f"{high / low:.2f}",
             " / ".join(f"{100 * part / high:.0f}" for part in parts[1]),
             f"{low / times[0]:.1f} / {high / times[1]:.1f}"],
            ["Neo, figure 16", "", f"{total:.2f}", "", "", f"{total / times[1]:.1f} at 2k"]]
    for name, reports in found.items():
        low, high = map(gigabytes, reports)
        rows.append([name, f"{low:.2f}", f"{high:.2f}", f"{high / low:.2f}",
                     " / ".join(f"{100 * gigabytes(reports[1], names) / high:.0f}" for names in STAGES.values()),
                     " / ".join(f"{1000 * gigabytes(report) / report.latency_ms:.1f}" for report in reports)])
    return markdown(["GSCore, traffic per frame", "720p, GB", "2k, GB", "growth",
                     "features / sorting / rasterisation at 2k, %", "mean rate, 720p / 2k, GB/s"], rows)


@table(PAGE)
def others_ratios():
    """Lego, and ratios of frame times."""
    files = (("gscore-64", SLOW), (ONE,), (ONE, STREAM))
    many = {"one": (), "four": (FOUR,), "fast": (FOUR, FAST), "many": (FOUR, MANY_PAIRS),
            "many, fast": (FOUR, FAST, MANY_PAIRS)}
    orange = [("orange-o4", SLOW, *keys) for keys in ((), ALIKE, (*ALIKE, STREAM))]
    found = yield {"lego": [lego(file) for file in files], "gbu": lego(("gbu-64", SLOW)),
                   "bare": [lego((*file, SQUARES, NO_SKIP)) for file in files],
                   "orange": [large(design, "2k") for design in orange],
                   **{name: [large((*file, *keys), "2k") for file in files] for name, keys in many.items()}}
    times = {name: [report.latency_ms for report in found[name]] for name in (*many, "orange", "bare", "lego")}

    def ratios(before, after):
        return [f"{slow / fast:.2f}" for slow, fast in zip(times[before], times[after])]

    def rates(name):
        return [f"{1000 / time:.0f}" for time in times[name]]
    own = [" / ".join(f"{published(f'fps_{name}{end}')[0]:.0f}" for end in ("", "_rebuilt"))
           for name in ("GSCore", "GBU")]
    rows = [["GSCore, Lego, fps (own / RenderSim)", own[0], *rates("lego")],
            ["the same, 3σ squares, no sub-tile skipping", "", *rates("bare")],
            ["GBU, Lego, fps (own / RenderSim)", own[1], f"{1000 / found['gbu'].latency_ms:.0f}", "", ""]]
    for name, measure, streams in (("Gaussians read, MB", "dram_Gaussian_In_FIFO", ("geometry", "sh")),
                                   ("splat records read, MB", "dram_GFeat_Buffer", ("splats_read",)),
                                   ("lists, and records written, MB", "", (*STAGES["sorting"], "splats_written"))):
        rows.append([f"GSCore, Lego, {name}", f"{published(measure)[0]:.1f}" if measure else "none named",
                     *(f"{1000 * gigabytes(report, streams):.1f}" for report in found["lego"])])
    rows += [["GSCore, 16 over 4 cores, 2k", f"{published('speedup_cores')[0]:.2f}", *ratios("one", "four")],
             ["GSCore, 204.8 over 51.2 GB/s, 2k", f"{published('speedup_bandwidth')[0]:.2f}", *ratios("four", "fast")],
             [f"the same, `{MANY_PAIRS}`", "", *ratios("many", "many, fast")],
             ["ORANGE with the same keys over GSCore, 2k", f"{published('speedup_ORANGE')[0]:.2f}",
              *ratios("one", "orange")]]
    return markdown(["measure", "published", "as shipped, 51.2 GB/s", "as published", "as published, lists as a stream"],
                    rows)
