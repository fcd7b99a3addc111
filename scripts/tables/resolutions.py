# SPDX-License-Identifier: Apache-2.0
"""PE utilization of arrays alone from 720p to 2K."""
from statistics import geometric_mean

from measuring.points import FIVE, run
from measuring.tables import csv_text, markdown, table

SIZES = {"720p": "720p", "1080p": "1080p", "2K": "2k", "4K": "4k"}
VIEWS = {"2": ("720p", "1080p", "2K"), "1": ("720p",)}  # sizes by camera
OURS = ("degs-16", "degs-64", "degs-256", "degs-1024", "degs-1024-streams", "degs-64-tuned", "degs-256-tuned",
        "degs-1024-tuned")
BASELINES = tuple(f"{name}-{pes}" for name in ("gscore", "gbu", "gcc") for pes in (16, 64, 256, 1024))
SHOWN = (*OURS, *(name for name in BASELINES if name.endswith(("-64", "-1024"))))
# One segment of a bank for four PEs.
WIDER = {"degs-256": 4, "degs-1024": 8, "degs-256-tuned": 4, "degs-1024-tuned": 8}


def arrays(design, scenes, camera, size, *keys):
    """Points of an array alone, one for each scene."""
    return [run(design, scene, f"--camera {camera} --resolution {SIZES[size]} --array-only", *keys)
            for scene in scenes]


def useful(reports):
    """Percent of all slots: a geometric mean."""
    return 100 * geometric_mean([report.slots.utilization for report in reports])


def useful_of_supplied(reports):
    """Percent of the slots to which the front of the array had supplied work, as Sec. II-B may be read."""
    slots = [report.slots for report in reports]
    return 100 * geometric_mean([each.useful / (each.total - each.starved - each.drain) for each in slots])


@table("docs/resolutions.csv", "resolutions")
def every_design():
    """All designs of the paper, and ours of its units."""
    found = yield {(camera, design, size): arrays(design, FIVE, camera, size)
                   for camera, sizes in VIEWS.items() for design in (*OURS, *BASELINES) for size in sizes}
    return csv_text(["camera", "design", "resolution", "useful of all slots, %", "useful of supplied slots, %"],
                    [[*names, f"{useful(reports):.1f}", f"{useful_of_supplied(reports):.1f}"]
                     for names, reports in found.items()])


def by_resolution(camera):
    """A row for each design."""
    sizes = VIEWS[camera]
    found = yield {design: [arrays(design, FIVE, camera, size) for size in sizes] for design in SHOWN}
    return markdown(["design", *sizes], [[design, *(f"{useful(reports):.1f}" for reports in by_size)]
                                         for design, by_size in found.items()])


table("docs/results.md", "resolutions-close-ups", "2")(by_resolution)
table("docs/results.md", "resolutions-small-splats", "1")(by_resolution)


@table("docs/cost.md")
def cost_of_widths():
    """What more segments of a bank are worth: utilization with them and as shipped, and what that is per area."""
    sizes = ("1080p", "4K")
    keys = {design: [f"scheduler.{key}={width}" for key in ("issue_width", "segments_per_cycle")]
            for design, width in WIDER.items()}
    found = yield {design: [[arrays(design, FIVE, "2", size, *more), arrays(design, FIVE, "2", size)] for size in sizes]
                   for design, more in keys.items()}
    rows = []
    for design, by_size in found.items():
        values = [[useful(reports) for reports in pair] for pair in by_size]
        areas = [reports[0].area.mm2 for reports in by_size[0]]
        gains = [100 * (shipped / wide * areas[0] / areas[1] - 1) for wide, shipped in values]
        ends = list(dict.fromkeys(f"{gain:+.1f}" for gain in (min(gains), max(gains))))
        rows.append([f"`{design}`", *(f"{wide:.1f}, {shipped:.1f}" for wide, shipped in values),
                     f"{' to '.join(ends)} %"])
    return markdown(["", *sizes, "per mm²"], rows)
