# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/readings.md and docs/numbers.md on what records, tile lists and rows of engines are worth, and on
images of rounded records."""
from measuring.points import accuracy, run
from measuring.tables import markdown, table

PAGE = "docs/readings.md"
FLOWERS = {"flowers": "flowers"}
MIDDLE = {**FLOWERS, "`landscape`, 3 M": "synthetic:landscape,gaussians=3000000"}
LARGE = {**MIDDLE, "`landscape`, 6 M": "synthetic:landscape,gaussians=6000000"}
VIEW = "--camera 2 --resolution 1080p"
BASELINES = {"gscore-64": "GSCore", "gbu-64": "GBU", "gcc-64": "GCC"}
DESIGNS = ("degs-64", *BASELINES)
LISTS = {"stream (shipped)": (),
         "combined in 8 KB": ("binning.entries=combined",),
         "combined in 8 KB, ends in memory": ("binning.entries=combined", "binning.head_bytes=0"),
         "a burst per entry": ("binning.entries=entries",),
         "a burst per entry, ends in memory": ("binning.entries=entries", "binning.head_bytes=0")}
PASSES = {"degs-64": "sorting.memory_passes=2", "gscore-64": "sorting.memory_levels=2"}
STREAMS = ("tile_lists_written", "tile_lists_sorted", "list_heads")
RATES = (0, 8, 4, 2, 1)
NUMBERS = ("ideal", "fp32", "fp16", "paper", "tuned")
RECORDS = ("fp16", "tuned")


def ratios(reports):
    """Latency x area of the baselines over that of DeGS."""
    costs = {design: report.latency_ms * report.area.mm2 for design, report in reports.items()}
    return [f"{costs[design] / costs['degs-64']:.2f}" for design in BASELINES]


@table(PAGE)
def readings_records():
    """Records of 236 B for all designs. GCC reads SH in a stage of its own, of Gaussians that it draws."""
    keys = {design: ("pipeline.records=fp32", *(() if design == "gcc-64" else ("traffic.sh=all",)))
            for design in DESIGNS}
    found = yield {scene: {design: run(design, file, VIEW, *keys[design]) for design in DESIGNS}
                   for scene, file in LARGE.items()}
    return markdown(["scene", "DeGS-64, ms", *BASELINES.values()],
                    [[scene, f"{reports['degs-64'].latency_ms:.3f}", *ratios(reports)]
                     for scene, reports in found.items()])


@table(PAGE)
def readings_rows():
    """Useful share of the slots of arrays alone by the rows that engines solve per cycle."""
    found = yield {f"gbu-{pes}": [run(f"gbu-{pes}", "flowers", "--camera 2 --resolution 2k --array-only",
                                      f"engines.rows_per_cycle={rate}") for rate in RATES]
                   for pes in (16, 64, 256, 1024)}
    rows = []
    for design, reports in found.items():
        areas = {rate: f"{report.area.mm2:.2f}" for rate, report in zip(RATES, reports)}
        rows.append([design, *(f"{100 * report.slots.utilization:.1f}" for report in reports),
                     " / ".join(areas[rate] for rate in (0, 8, 1))])
    return markdown(["design", "all", *RATES[1:], "area of 0 / 8 / 1, mm2"], rows)


def list_share(report):
    """Percent of all bytes that make and sort lists."""
    streams = {name: stream["bytes_read"] + stream["bytes_written"]
               for name, stream in report.to_dict()["dram"]["streams"].items()}
    return 100 * sum(streams.get(name, 0) for name in STREAMS) / sum(streams.values())


@table(PAGE)
def readings_lists():
    """How list entries reach memory."""
    ways = {**{name: {design: keys for design in PASSES} for name, keys in LISTS.items()},
            "stream, 2 passes of sorting through memory": {design: (key,) for design, key in PASSES.items()}}
    found = yield {scene: {name: [run(design, file, VIEW, *keys) for design, keys in way.items()]
                           for name, way in ways.items()} for scene, file in MIDDLE.items()}
    rows = [[scene, name, *(cell for report in reports for cell in (report.cycles, f"{list_share(report):.0f}"))]
            for scene, named in found.items() for name, reports in named.items()]
    return markdown(["scene", "entries", "DeGS-64, cycles", "lists, % of bytes", "GSCore-64, cycles",
                     "lists, % of bytes"], rows, 2)


@table("docs/numbers.md")
def numbers_records():
    """PSNR of images whose Gaussians are rounded to records; number sets with the same values share a row."""
    names = [f"{numbers}:records={kind}" for numbers in NUMBERS for kind in RECORDS]
    sizes = ("720p", "1080p", "2k", "4k", "8k")
    found = yield {scene: [accuracy(scene, f"--camera 2 --resolution {size} --numbers {','.join(names)}")
                           for size in sizes] for scene in ("flowers", "skull")}
    shared = {}
    for numbers in NUMBERS:
        first = names.index(f"{numbers}:records={RECORDS[0]}")
        for scene, images in found.items():
            cells = [" / ".join(f"{float(row['psnr_db']):.1f}" for row in image[first:first + len(RECORDS)])
                     for image in images]
            shared.setdefault((scene, *cells), []).append(f"`{numbers}`")
    return markdown(["FP16 / 27 B", "scene", *(size.replace("k", "K") for size in sizes)],
                    [[", ".join(names), *cells] for cells, names in shared.items()], 2)
