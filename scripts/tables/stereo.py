# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/stereo.md: what two eyes of a headset save when they share the reading of the scene."""
from measuring.numbers import beside
from measuring.points import run
from measuring.tables import markdown, table

HEADSET = "--camera 1 --width 2064 --height 2208 --eyes 0.065"
# The section that has the key, and the steps of sharing; the first is compared with.
TILED = ("projection", ("nothing", "geometry", "sh", "colour"))
DESIGNS = {"degs-64": TILED, "gscore-64": TILED, "gbu-64": TILED, "gcc-64": ("grouping", ("nothing", "geometry")),
           "orange-o1": TILED}
SCENE_STREAMS = ("geometry", "means", "shapes", "sh")


def millions(report):
    """Bytes of the scene, all bytes, cycles and nJ of a frame, in millions."""
    streams, frame = report.to_dict()["dram"]["streams"], report.views.per_frame
    scene = sum(streams[name]["bytes_read"] for name in SCENE_STREAMS if name in streams)
    return [value / 1e6 for value in (scene, frame.bytes_read + frame.bytes_written, frame.cycles, frame.energy_nj)]


@table("docs/stereo.md", "stereo-flowers", "flowers", 1)
@table("docs/stereo.md", "stereo-skull", "skull", 7)
def stereo(scene, units):
    """Every step of sharing that a design has, with its own memory. `units` of the scene are taken for a metre."""
    found = yield {design: {step: run(design, scene, f"{HEADSET} --units-per-metre {units}",
                                      f"{section}.shared_by_views={step}") for step in steps}
                   for design, (section, steps) in DESIGNS.items()}
    rows = []
    for design, reports in found.items():
        base = millions(reports["nothing"])
        for step, report in reports.items():
            cells = beside(millions(report), base if step != "nothing" else None, (1, 1, 2, 2), "+.1f")
            rows.append([design, f"`{step}`", *cells])
    return markdown(["design", "shared", "scene read, MB", "memory, MB", "Mcycles", "mJ"], rows, 2)
