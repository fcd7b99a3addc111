# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/results.md on whole accelerators, single scenes and images; tables/resolutions.py has the sizes."""
from statistics import geometric_mean

from measuring.points import FIVE, run
from measuring.tables import markdown, table
from tables.resolutions import arrays, useful

PAGE = "docs/results.md"
SIZES = {"2": "1080p", "1": "720p"}  # of the images of a camera
LOSSES = ("boundary", "terminated", "conflict", "starved", "blocked")
# Scenes that the table of losses shows by camera and design; its means are of all five.
SHOWN = {("2", "degs-64"): FIVE, ("2", "degs-64-tuned"): ("st-peter",), ("1", "degs-64"): ("flowers", "st-peter"),
         ("1", "degs-64-tuned"): ()}
EIGHT = ("flowers", "flowers-small", "fruit-drops", "garden-crop", "guitar", "seal", "skull", "st-peter")
DESIGNS = ("degs-16", "degs-64", "degs-64-tuned", "degs-256", "degs-1024")


def whole(design, scene, camera):
    return run(design, scene, f"--camera {camera} --resolution {SIZES[camera]}")


def percent(report):
    return 100 * report.slots.utilization


@table(PAGE)
def results_conditions():
    """Designs of DeGS under the conditions of every page."""
    two, sizes = ("flowers", "st-peter"), "[sizes](#all-designs-from-720p-to-2k)"
    rows = []
    for camera, size in SIZES.items():
        alone = {design: arrays(design, FIVE, camera, size) for design in DESIGNS}
        behind = {design: [whole(design, scene, camera) for scene in FIVE]
                  for design in (DESIGNS if camera == "2" else ("degs-64", "degs-64-tuned"))}
        ends = {design: arrays(design, two, camera, "1080p") for design in ("degs-16", "degs-1024")}
        rows += [("five", camera, size, "array alone", alone, sizes),
                 ("five", camera, size, "whole", behind, "[scenes](#by-scene)"),
                 ("two", camera, "1080p", "array alone", ends, "[readings](readings.md)")]
    found = yield [points for *_, points, _ in rows]
    return markdown(["scenes", "camera", "image", "", "tables", *DESIGNS],
                    [[*words, page, *(f"{useful(reports[design]):.1f}" if design in reports else ""
                                      for design in DESIGNS)]
                     for (*words, _, page), reports in zip(rows, found)], 5)


@table(PAGE)
def results_scenes():
    """Arrays alone at 64 PEs by scene, with both cameras."""
    designs = {"DeGS": "degs-64", "DeGS tuned": "degs-64-tuned", "GSCore": "gscore-64", "GBU": "gbu-64",
               "GCC": "gcc-64"}
    found = yield {scene: [[arrays(design, (scene,), camera, size) for camera, size in SIZES.items()]
                           for design in designs.values()] for scene in FIVE}
    return markdown(["scene", *designs], [[scene, *(", ".join(f"{useful(reports):.1f}" for reports in cameras)
                                                    for cameras in by_design)] for scene, by_design in found.items()])


@table(PAGE)
def results_losses():
    """Percent of the PE-cycles in the blending window, whole accelerators."""
    found = yield {(camera, design): {scene: whole(design, scene, camera) for scene in FIVE}
                   for camera, design in SHOWN}
    rows = []
    for (camera, design), reports in found.items():
        for scene in SHOWN[camera, design]:
            slots = reports[scene].slots
            rows.append([scene, camera, design, f"{percent(reports[scene]):.1f}",
                         *(f"{100 * slots[name] / slots.total:.1f}" for name in LOSSES), reports[scene].cycles])
        mean = geometric_mean([percent(report) for report in reports.values()])
        rows.append(["**geometric mean**", camera, design, f"**{mean:.1f}**", *[""] * (len(LOSSES) + 1)])
    return markdown(["scene", "camera", "config", "useful", *LOSSES, "cycles"], rows, 3)


@table(PAGE)
def results_widths():
    """The paper-literal DeGS on close-ups by PEs: utilisation (cycles)."""
    sizes = (16, 64, 256, 1024)
    found = yield {scene: [whole(f"degs-{pes}", scene, "2") for pes in sizes] for scene in FIVE}
    return markdown(["scene", f"{sizes[0]} PEs", *sizes[1:]],
                    [[scene, *(f"{percent(report):.1f} % ({report.cycles})" for report in reports)]
                     for scene, reports in found.items()])


@table(PAGE)
def results_images():
    """Images in fp32 against the reference, and updates of pixels that it has not, or has alone."""
    designs = {"exact": "degs-64-tuned", "outward": "degs-64"}
    found = yield {ends: [run(design, scene, f"--camera {camera} --reference", "pipeline.numbers=fp32")
                          for scene in EIGHT for camera in (0, 1, 2)] for ends, design in designs.items()}
    rows = []
    for ends, reports in found.items():
        decibels = [report["image.psnr_db"] for report in reports]
        more = [(abs(report.slots.useful - report.workload.fragments), report.workload.fragments)
                for report in reports]
        differs = "{} of {:.0f} million".format(max(more)[0], max(more)[1] / 1e6) if ends == "exact" else ""
        rows.append([ends, f"{min(decibels):.0f} to {max(decibels):.0f}", differs])
    return markdown(["span ends", "PSNR, dB", "updates of pixels that differ, at most"], rows)
