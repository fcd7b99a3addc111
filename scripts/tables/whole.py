# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/reproduction.md on whole accelerators with 64 PEs, and on what other publications report of GSCore and
GCC: geometric means over five scenes."""
from statistics import geometric_mean

from measuring.points import FIVE, run
from measuring.tables import markdown, table

PAGE = "docs/reproduction.md"
CAMERAS = ("2", "1")
DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64", "degs-64-tuned")
SLOW, FAST = "memory.bandwidth_gb_per_s=51.2", "memory.bandwidth_gb_per_s=204.8"
EXACT, SQUARES, NO_SKIP = "pipeline.tiles=exact", "pipeline.tiles=square", "array.subtile_skip=none"


def views(design, camera, options="", *keys):
    """A point for each of the five scenes."""
    return [run(design, scene, f"--camera {camera} {options}".strip(), *keys) for scene in FIVE]


def by_camera(design, options="", *keys):
    return [views(design, camera, options, *keys) for camera in CAMERAS]


def mean(reports, measure):
    return geometric_mean([measure(report) for report in reports])


def cycles(reports):
    return mean(reports, lambda report: report.cycles)


def latency(report):
    return report.latency_ms


def both(form, values):
    """Camera 2 · camera 1."""
    return " · ".join(form.format(value) for value in values)


@table(PAGE)
def whole_accelerators():
    """One frame alone at the size of the camera's own image."""
    found = yield {design: by_camera(design) for design in DESIGNS}
    first, rows = found["degs-64"], []
    for design, cameras in found.items():
        slower = [mean(reports, latency) / mean(ours, latency) for reports, ours in zip(cameras, first)]
        area = cameras[0][0].area.mm2 / first[0][0].area.mm2
        rows.append([design, both("{:.3f}", [mean(reports, latency) for reports in cameras]), both("{:.2f}", slower),
                     both("{:.2f}", [value * area for value in slower]),
                     *(both("{:.1f}", [mean(reports, lambda report: report.dram[name] / 1e6) for reports in cameras])
                       for name in ("bytes_read", "bytes_written"))])
    return markdown(["config", "latency, ms", "DeGS faster", "per mm²", "MB read", "MB written"], rows)


@table(PAGE)
def whole_paths():
    """A camera path of four frames against one frame alone, flowers."""
    found = yield {design: [[run(design, "flowers", f"--camera {camera} {path}".strip()) for path in ("", "--frames 4")]
                            for camera in CAMERAS] for design in DESIGNS}
    first, rows = found["degs-64"], []
    for design, cameras in found.items():
        rates = [path.timing.throughput_fps for _, path in cameras]
        gains = [path.timing.throughput_fps / rate for (_, path), rate in zip(first, rates)]
        area = cameras[0][0].area.mm2 / first[0][0].area.mm2
        rows.append([design, both("{:.0f}", [1000 / alone.latency_ms for alone, _ in cameras]), both("{:.0f}", rates),
                     both("{:.2f}", gains), both("{:.2f}", [gain * area for gain in gains])])
    return markdown(["config", "fps, one frame", "fps, path", "throughput of DeGS higher", "per mm²"], rows)


@table(PAGE)
def whole_checks():
    """Published relations within one design beside ours."""
    sizes = ("720p", "1080p", "2k")
    asked = {"slow": views("gscore-64", "1", "--resolution 2k", SLOW),
             "wide": views("gscore-256", "1", "--resolution 2k", SLOW),
             "fast": views("gscore-256", "1", "--resolution 2k", FAST),
             **{f"slots {size}": views("gscore-64", "1", f"--resolution {size}", SLOW) for size in sizes}}
    ways = {"none": ("gscore-64", EXACT, NO_SKIP), "box": ("gscore-64", EXACT),
            "test": ("gscore-64", EXACT, "array.subtile_skip=exact"), "square": ("gscore-64", SQUARES, NO_SKIP),
            **{f"gcc {wait}": ("gcc-64", f"array.discovery_cycles={wait}") for wait in (1, 4, 8)}}
    one, arrays = yield [asked, {name: by_camera(design, "--array-only", *keys)
                                 for name, (design, *keys) in ways.items()}]

    def over(slow, fast):
        return [f"{cycles(theirs) / cycles(ours):.2f}" for theirs, ours in zip(arrays[slow], arrays[fast])]
    gains = {name: f"{mean(one['slow'], latency) / mean(one[name], latency):.2f}" for name in ("wide", "fast")}
    slots = [mean(one[f"slots {size}"], lambda report: 64 * report.cycles / report.camera.width / report.camera.height)
             for size in sizes]
    rows = [["GSCore at 51.2 GB/s, 4 times the lanes (camera 1, 2560 px)", "1.12× (Neo)", "", gains["wide"]],
            ["the same with 4 times the bandwidth", "3.83× (Neo)", "", gains["fast"]],
            ["GSCore lane slots per pixel at 51.2 GB/s, 720p / 1080p / QHD", "1041 / 992 / 1099 (Neo, derived)", "",
             " / ".join(f"{value:.0f}" for value in slots)],
            ["GSCore array, exact tile lists over 3σ squares", "1.71× (GSCore, by FlashGS)", *over("square", "none")],
            ["sub-tile skipping (oriented box) on top", "+15 % (likewise)", *over("none", "box")],
            ["the same with an exact sub-tile test", "", *over("none", "test")],
            ["useful share of 16 × 16 squares without skipping, %", "10.3; 13.7 (Lumina; GBU)",
             *(f"{100 * mean(reports, lambda report: report.slots.utilization):.1f}" for reports in arrays["square"])],
            ["GCC array, cycles with a discovery of 4 cycles over 1", "", *over("gcc 4", "gcc 1")],
            ["the same of 8 cycles over 1", "", *over("gcc 8", "gcc 1")]]
    return markdown(["check", "published", "camera 2", "camera 1"], rows, 2)
