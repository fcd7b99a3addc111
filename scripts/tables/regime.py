# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/regime.md: how near synthetic scenes come to the real ones of docs/regime.csv, and whole accelerators
on them; of docs/large-scenes.md: the regime of a large trained scene."""
from statistics import median

from measuring.points import ROOT, rows_of, run, view
from measuring.tables import markdown, table

PAGE = "docs/regime.md"
SCENES = ("synthetic:interior,gaussians=1000000", "synthetic:garden,gaussians=1000000")
DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64")
ARRAYS = ("degs-64", "degs-1024", "gscore-64")
# The lists, and the banks of degs-1024, with which the real scenes were measured.
LISTS = "pipeline.tiles=exact"
BANKS = {"degs-1024": ("scheduler.segments_per_cycle=8", "scheduler.issue_width=8")}
GINI_WIDTH = 960  # of the images whose Gini coefficients were measured
PATHS = {"interior": "room", "garden": "garden"}  # the real cameras that are moved into a place
VIEWS = 8  # of a path


def tiles(camera):
    """Tiles of 16 pixels, which `degs scene info` counts pairs of."""
    return -(-camera.width // 16) * -(-camera.height // 16)


# The counts of `degs scene info` that docs/regime.csv has; shares are in percent.
COUNTS = {"visible": lambda info: 100 * info.view.visible / info.scene.gaussians,
          "pairs_per_tile": lambda info: info.view.tile_pairs / tiles(info.view.camera),
          "fragments_per_pixel": lambda info: info.view.fragments_per_pixel,
          "fragments_per_splat": lambda info: info.view.fragments_per_splat,
          "footprint_p50": lambda info: info.view.footprint_px.p50,
          "ended": lambda info: 100 * info.view.terminated_share,
          "covered": lambda info: 100 * info.view.covered_share}


def real_views():
    """The rows of docs/regime.csv."""
    return rows_of(ROOT / "docs/regime.csv")


def synthetic(row):
    """The scene that stands for a real one."""
    return f"synthetic:{row['synthetic']},gaussians={row['gaussians']}"


def camera_of(row, width=0):
    """The view, in the size of the real one unless a width is given."""
    return f"--camera {row['camera']} --width {width or row['pixels'].split('x')[0]}"


def measured(row, count):
    """A count of the real view, as COUNTS has it."""
    return float(row[count]) * (100 / float(row["gaussians"]) if count == "visible" else 1)


def number(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def span(values, form):
    """Least to most."""
    return f"{format(min(values), form)} to {format(max(values), form)}"


@table(PAGE)
def regime_counts():
    """Ranges of the real counts, and by how many percent those of the synthetic views differ."""
    rows = real_views()
    found = yield {"views": [view(synthetic(row), camera_of(row)) for row in rows],
                   "gini": [view(synthetic(row), camera_of(row, GINI_WIDTH)) for row in rows if row["gini"]]}
    pairs = {count: [(measured(row, count), of(info)) for row, info in zip(rows, found["views"])]
             for count, of in COUNTS.items()}
    pairs["gini"] = [(float(row["gini"]), 100 * info.view.footprint_gini)
                     for row, info in zip([row for row in rows if row["gini"]], found["gini"])]
    return markdown(["", "measured", "difference, %"],
                    [[count, f"{number(min(real for real, _ in each))} to {number(max(real for real, _ in each))}",
                      span([100 * (made / real - 1) for real, made in each], "+.0f")] for count, each in pairs.items()])


@table(PAGE)
def regime_arrays():
    """Useful slots of arrays alone on the real scenes, and by how many points those on the synthetic ones differ."""
    rows = real_views()
    found = yield {design: [run(design, synthetic(row), f"{camera_of(row)} --array-only", LISTS,
                                *BANKS.get(design, ())) for row in rows] for design in ARRAYS}
    lines = []
    for design, reports in found.items():
        differences = {f"{row['measured']} {row['view']} {row['pixels']}":
                       100 * report.slots.frame_utilization - float(row[design])
                       for row, report in zip(rows, reports)}
        lines.append([design, span([float(row[design]) for row in rows], ".1f"), span(differences.values(), "+.1f"),
                      max(differences, key=lambda name: abs(differences[name]))])
    return markdown(["", "measured", "difference, points", "largest"], lines)


@table(PAGE)
def regime_paths():
    """Whole accelerators along real paths: least, median and largest value of the views."""
    found = yield {(place, design): [run(design, f"synthetic:{place},gaussians=1000000",
                                         f"--path {cameras}:{VIEWS} --camera {camera} --width 1920", LISTS)
                                     for camera in range(VIEWS)]
                   for place, cameras in PATHS.items() for design in ARRAYS}

    def three(values, form):
        return " / ".join(format(of(values), form) for of in (min, median, max))
    return markdown(["scene", "", "useful slots, %", "latency, ms"],
                    [[*names, three([100 * report.slots.utilization for report in reports], ".1f"),
                      three([report.latency_ms for report in reports], ".2f")] for names, reports in found.items()], 2)


@table(PAGE)
def regime_bandwidth():
    """Latency of DeGS-64, and latency times area of the others over its own; a cell has both scenes."""
    found = yield {(size, rate): {design: [run(design, scene, f"--camera 1 --resolution {size}",
                                               f"memory.bandwidth_gb_per_s={rate}") for scene in SCENES]
                                  for design in DESIGNS} for rate in ("204.8", "51.2") for size in ("720p", "4k")}
    rows = []
    for (size, rate), by_design in found.items():
        costs = {design: [report.latency_ms * report.area.mm2 for report in reports]
                 for design, reports in by_design.items()}
        rows.append([size, rate, " · ".join(f"{report.latency_ms:.3f}" for report in by_design["degs-64"]),
                     *(" · ".join(f"{other / ours:.2f}" for other, ours in zip(costs[design], costs["degs-64"]))
                       for design in DESIGNS[1:])])
    return markdown(["whole", "GB/s", "DeGS-64, ms", *(f"{design} ×" for design in DESIGNS[1:])], rows)


@table("docs/large-scenes.md")
def large_scenes():
    """Fragments per visible splat of a scene at its finest level."""
    found = yield {camera: view("flowers-full", f"--camera {camera} --resolution 1080p") for camera in "12"}
    return markdown(["camera", "fragments per visible splat"],
                    [[camera, f"{info.view.fragments_per_splat:.1f}"] for camera, info in found.items()])
