# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/foveation.md: what a frame costs, and how far its image is from a full one, with foveation."""
from measuring.numbers import beside
from measuring.points import run
from measuring.tables import markdown, table

HEADSET = "--camera 1 --width 2064 --height 2208 --field 90"
SETTINGS = ("0.5,0.5:20:30", "0.5,0.5:10:20", "0.5,0.5:5:15")
DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1")
PARTS = ("fovea", "middle", "periphery")


def millions(report):
    """Pixels that are drawn, cycles, bytes and nJ of the frame, in millions."""
    pixels = report.foveation.pixels_drawn if "foveation" in report else report.camera.width * report.camera.height
    return [value / 1e6 for value in (pixels, report.cycles, report.dram.bytes_read + report.dram.bytes_written,
                                      report.energy.nj_per_frame)]


def errors(report):
    """PSNR and FLIP of what each level shows."""
    found = {}
    for level in report.foveation.images[0].levels if "foveation" in report else []:
        psnr = "identical" if level.psnr_db == float("inf") else f"{level.psnr_db:.1f}"
        found[level.name] = f"{psnr} / {level.flip:.4f}"
    return [found.get(name, "-") for name in PARTS]


@table("docs/foveation.md", "foveation-flowers", "flowers")
@table("docs/foveation.md", "foveation-skull", "skull")
def foveation(scene):
    """A headset 90 degrees wide, at the place of a camera of the scene."""
    options = {"plain": HEADSET, **{f"`{setting}`": f"{HEADSET} --foveation {setting} --reference"
                                    for setting in SETTINGS}}
    found = yield {design: {name: run(design, scene, words) for name, words in options.items()} for design in DESIGNS}
    rows = []
    for design, reports in found.items():
        base = millions(reports["plain"])
        for name, report in reports.items():
            cells = beside(millions(report), base if name != "plain" else None, (2, 2, 1, 2), "+.0f")
            rows.append([design, name, *cells, f"{100 * report.slots.utilization:.0f}", *errors(report)])
    return markdown(["design", "foveation", "Mpixels", "Mcycles", "MB", "mJ", "useful %", *PARTS], rows, 2)
