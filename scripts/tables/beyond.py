# SPDX-License-Identifier: Apache-2.0
"""Tables and the picture of docs/beyond-the-paper.md: machines of our own against those of the paper and the baselines,
on the scenes that their search did not see, with cameras 2 (close-up) and 1 (small splats)."""
from statistics import geometric_mean

from measuring.numbers import svg_of
from measuring.points import run
from measuring.tables import csv_text, markdown, table

PAGE = "docs/beyond-the-paper.md"
SCENES = ("fruit-drops", "guitar", "seal", "skull", "st-peter")
VIEWS = {"2": "close-up", "1": "small splats"}
CAMERAS = {"2": "--camera 2 --resolution 720p", "1": "--camera 1"}  # camera 1 has that size
FAST = "--memory configs/memory/lpddr5-6400x256.yaml"
LISTS = "pipeline.tiles=exact"  # of all machines, so that lists are no part of a gain
# Arrays alone, or behind a memory with this rate in GB/s: options and keys.
SETTINGS = {"alone": ("--array-only", (LISTS,)), "204.8": (f"--frames 3 {FAST}", (LISTS,)),
            "409.6": (f"--frames 3 {FAST}", (LISTS, "memory.lpddr5.channels=32")),
            "819.2": (f"--frames 3 {FAST}", (LISTS, "memory.lpddr5.channels=64"))}
# Machines of a table: name, design and changed keys.
SMALL = {name: (name,) for name in ("degs-64", "degs-64-tuned", "degs-x-64", "gscore-64", "gbu-64", "gcc-64")}
OURS = {name: (name,) for name in ("degs-256", "degs-x-256")}
MIDDLE = {**OURS, "4 × gscore-64": ("gscore-64", "clusters=4"), "gbu-256": ("gbu-256",),
          "4 × gcc-64": ("gcc-64", "clusters=4")}
LARGE = {"degs-1024": ("degs-1024",), "degs-x-1024": ("degs-x-1024",), "16 × gcc-64": ("gcc-64", "clusters=16")}
MECHANISMS = {"degs-x-64": ("degs-x-64",),
              "pairs of segments": ("degs-x-64", "scheduler.reuse_cycles=2", "array.writeback_cycles=2"),
              "no conflicts": ("degs-x-64", "scheduler.reuse_cycles=1", "array.writeback_cycles=1")}
# The front end of degs-x-256 step by step, and what smaller records would bring.
FRONT = {"degs-256": ("degs-256",), "degs-256, priority": ("degs-256", "memory.priority=blending"),
         "degs-x-256": ("degs-x-256",), "without priority": ("degs-x-256", "memory.priority=age"),
         "without the cache": ("degs-x-256", "front.cache_bytes=0"),
         "multicast for the cache": ("degs-x-256", "front.cache_bytes=0", "front.multicast_window=64"),
         "longest list first": ("degs-x-256", "tile_order=longest_list"),
         "records in Morton order": ("degs-x-256", "memory.layout=morton"),
         "list entries of 6 B": ("degs-x-256", "traffic.list_entry_bytes=6"),
         "SH of 1 B": ("degs-x-256", "traffic.sh_value_bytes=1", "pipeline.numbers=tuned:sh_dc=e4m3:sh_rest=e4m3")}
GROUPS = {"64": (SMALL, ("alone", "204.8")), "256": (MIDDLE, ("204.8", "409.6")), "1024": (LARGE, ("819.2", "204.8")),
          "256-ours": (OURS, ("alone",)), "mechanisms": (MECHANISMS, ("alone",)), "front": (FRONT, ("204.8",))}


def runs(machines, setting):
    """Points by machine and camera, one for each scene."""
    options, keys = SETTINGS[setting]
    return {name: {camera: [run(design, scene, f"{CAMERAS[camera]} {options}", *changes, *keys) for scene in SCENES]
                   for camera in VIEWS} for name, (design, *changes) in machines.items()}


def bound_of(report):
    """The utilisation that no scheduler could exceed with the splats and rows of this run, or None.

    Useful tasks / (PEs x cycles), where the cycles are the most of splats / (Slicing Units x splats per cycle), rows /
    (Span Units x rows per cycle) and useful tasks / PEs. Other accelerators have no such units."""
    if "stages.slicing" not in report:
        return None
    keys, clusters = report.config, report.config.clusters
    least = report.slots.useful / report.slots.pes
    return least / max(report.stages.slicing.splats / (clusters * keys.slicing.count * keys.slicing.splats_per_cycle),
                       report.stages.span.rows * keys.span.cycles_per_row /
                       (clusters * keys.span.count * keys.span.rows_per_cycle), least)


def rate(report):
    """Frames per second."""
    return report.timing.throughput_fps or report.timing.fps


def array(machines):
    """Utilisation and its bound, arrays alone: geometric means; slots lost are arithmetic means."""
    found = yield runs(machines, "alone")
    rows = []
    for name, by_camera in found.items():
        cells = [name]
        for reports in by_camera.values():
            useful = [100 * report.slots.utilization for report in reports]
            cells += [f"**{geometric_mean(useful):.1f}**", f"{min(useful):.1f}"]
            bounds = [bound_of(report) for report in reports]
            cells += [f"{100 * geometric_mean(bounds):.1f}" if None not in bounds else ""]
            cells += ["" if None in bounds else
                      f"{100 * sum(report.slots[lost] / report.slots.total for report in reports) / len(reports):.1f}"
                      for lost in ("conflict", "starved")]
        rows.append(cells)
    return markdown(["array alone, %", *(f"{view}: useful" if not index else words for view in VIEWS.values()
                                         for index, words in enumerate(("", "lowest", "bound", "conflict", "starved")))],
                    rows)


def whole(machines, setting):
    """Throughput, per mm2 and per joule, over the first machine."""
    found = yield runs(machines, setting)
    first, rows = next(iter(found.values())), []
    area = {name: by_camera["2"][0].area.mm2 for name, by_camera in found.items()}
    for name, by_camera in found.items():
        cells = [name, f"{area[name]:.2f}"]
        for camera, reports in by_camera.items():
            fps, energy = ([geometric_mean([of(report) for report in each]) for each in (reports, first[camera])]
                           for of in (rate, lambda report: report.energy.nj_per_frame))
            gain = fps[0] / fps[1]
            cells += [f"{fps[0]:.0f}", f"{gain:.2f}", f"**{gain / area[name] * next(iter(area.values())):.2f}**",
                      f"{energy[1] / energy[0]:.2f}"]
        rows.append(cells)
    return markdown([f"LPDDR5, {setting} GB/s", "mm²",
                     *(words for view in VIEWS.values() for words in (f"{view}: fps", "×", "per mm²", "per J"))], rows)


for group, one in (("64", "alone"), ("64", "204.8"), ("256-ours", "alone"), ("256", "204.8"), ("1024", "819.2"),
                   ("1024", "204.8")):
    if one == "alone":
        table(PAGE, f"beyond-{group}-alone", GROUPS[group][0])(array)
    else:
        table(PAGE, f"beyond-{group}-{one}", GROUPS[group][0], one)(whole)


@table("docs/beyond.csv", "beyond")
def all_runs():
    """A row for each machine, setting, scene and camera."""
    asked = {(group, setting): runs(machines, setting)
             for group, (machines, settings) in GROUPS.items() for setting in settings}
    found = yield asked
    rows = []
    for (group, setting), by_name in found.items():
        for name, by_camera in by_name.items():
            for camera, reports in by_camera.items():
                for scene, report in zip(SCENES, reports):
                    bound = bound_of(report) if setting == "alone" else None
                    moved = report.dram.bytes_read + report.dram.bytes_written
                    rows.append([group, name, setting, scene, camera, f"{report.slots.utilization:.4f}",
                                 f"{bound:.4f}" if bound else "", f"{rate(report):.2f}", f"{report.latency_ms:.6f}",
                                 f"{report.energy.nj_per_frame:.1f}", f"{report.area.mm2:.4f}",
                                 "" if setting == "alone" else f"{moved / report.cycles:.2f}",
                                 report.stages.limited_by])
    return csv_text(["group", "design", "memory", "scene", "camera", "utilization", "bound", "throughput_fps",
                     "latency_ms", "nj_per_frame", "area_mm2", "dram_gb_per_s", "limited_by"], rows)


@table("docs/images/beyond.svg", "beyond-picture")
def picture():
    """Throughput over area, both logarithmic, a panel for each view."""
    found = yield [runs(machines, setting) for machines, setting in
                   ((SMALL, "204.8"), (MIDDLE, "204.8"), (LARGE, "819.2"))]

    def draw(figure):
        for panel, (camera, view) in zip(figure.subplots(1, 2, sharey=True), VIEWS.items()):
            for name, by_camera in ((name, each) for group in found for name, each in group.items()):
                place = by_camera[camera][0].area.mm2, geometric_mean([rate(report) for report in by_camera[camera]])
                colour, shift = (("#2166ac", 4) if "-x-" in name else ("#b2182b", -10) if "degs" in name else
                                 ("#777777", -3))  # labels that are near each other stand apart
                panel.plot(*place, "o", color=colour)
                panel.annotate(name, place, (6, shift), textcoords="offset points", fontsize=8)
            panel.set(xscale="log", yscale="log", title=view, xlabel="area, mm²")
            panel.set_ylabel("frames per second" if camera == "2" else "")
            ticks = [tick for tick in (3, 5, 10, 20, 40, 80) if panel.get_xlim()[0] < tick < panel.get_xlim()[1]]
            panel.set_xticks(ticks, [str(tick) for tick in ticks])
            panel.minorticks_off()
            panel.set_xlim(right=panel.get_xlim()[1] * 2)
    return svg_of(draw, (10, 4.8))
