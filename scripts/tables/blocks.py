# SPDX-License-Identifier: Apache-2.0
"""Tables on pages of blocks: what single keys of a design change."""
import dataclasses
import typing
from statistics import geometric_mean

from measuring.points import FIVE, run
from measuring.tables import markdown, table

ALONE = "--array-only"


@dataclasses.dataclass(frozen=True)
class Row:
    """A design with changed keys on a scene."""

    cells: tuple  # its first cells
    design: str
    keys: tuple = ()
    scene: str = "flowers"
    camera: str = "2"


@dataclasses.dataclass(frozen=True)
class Column:
    """A measure of a report and that of the first row; what is given here comes before what the row says."""

    heading: str
    measure: typing.Callable
    camera: str = ""
    scene: str = ""
    keys: tuple = ()


def grid(corner, rows, columns, options=ALONE):
    """A table of runs, whose first columns are those of the corner."""
    found = yield [[run(row.design, column.scene or row.scene,
                        f"--camera {column.camera or row.camera} {options}".strip(), *row.keys, *column.keys)
                    for column in columns] for row in rows]
    lines = [[*row.cells, *(column.measure(report, first) for column, report, first in zip(columns, reports, found[0]))]
             for row, reports in zip(rows, found)]
    return markdown([*corner, *(column.heading for column in columns)], lines, len(corner))


def useful(report, _):
    return f"{100 * report.slots.utilization:.1f}"


def kcycles(report, _):
    return f"{report.cycles / 1e3:.1f}"


def cycles(report, _):
    return str(report.cycles)


def milliseconds(report, _):
    return f"{report.latency_ms:.3f}"


def area(report, _):
    return f"{report.area.mm2:.2f}"


def pes(report, _):
    return str(report.slots.pes)


def more_cycles(report, first):
    return f"{100 * (report.cycles / first.cycles - 1):+.1f}"


def speed(report, first):
    return f"{first.cycles / report.cycles:.2f}"


def share(name):
    return lambda report, _: f"{100 * report.slots[name] / report.slots.total:.1f}"


def busy(report, _):
    return f"{100 * report.stages.slicing.busy:.0f}, {100 * report.stages.span.busy:.0f}"


def cameras(*measures):
    """Columns of (heading, measure) with camera 2, then with camera 1."""
    return [Column(f"camera {camera}: {heading}", measure, camera) for camera in "21" for heading, measure in measures]


def scenes(*measures):
    """Columns of (heading, measure) for a close-up of two scenes."""
    return [Column(f"{scene}: {heading}", measure, scene=scene) for scene in ("flowers", "st-peter")
            for heading, measure in measures]


def declare(page, name, corner, rows, columns, options=ALONE):
    table(f"docs/{page}.md", name, corner, rows, columns, options)(grid)


declare("gaussian-slicing-unit", "slicing-distribution", ["kcycles"],
        [Row((f"`degs-{size}`",), f"degs-{size}") for size in (64, 256, 1024)],
        [Column(f"camera {camera}, `{way}`", kcycles, camera, keys=(f"slicing.distribution={way}",))
         for camera in "21" for way in ("broadcast", "splats")])

declare("gbu", "gbu-keys", ["key", "value"],
        [Row(("as configured", ""), "gbu-64"),
         *(Row((f"`{key}`" + more, value), "gbu-64", (f"{key}={value}",)) for key, value, more in
           (("engines.end_probe", "false", ""), ("engines.queue_depth", "1", ""), ("engines.queue_depth", "4", ""),
            ("engines.queue_depth", "64", ""), ("engines.rows_per_cycle", "0", ""), ("engines.rows_per_cycle", "1", ""),
            ("pixel_buffer.bytes", "16384", " (one context per engine)")))],
        cameras(("useful, %", useful)))

declare("gcc", "gcc-discovery", ["scene"],
        [Row((scene,), "gcc-64", scene=scene) for scene in ("flowers", "skull", "st-peter")],
        [Column(f"camera {camera}: *P* = {wait}", useful, camera, keys=(f"array.discovery_cycles={wait}",))
         for camera in "21" for wait in (1, 4, 8)])
declare("gcc", "gcc-sizes", ["design"], [Row((f"gcc-{size}",), f"gcc-{size}") for size in (16, 64, 256, 1024)],
        cameras(("useful, %", useful)))
for family in ("gcc", "gscore"):
    declare(family, f"{family}-clusters", ["clusters"],
            [Row((str(count),), f"{family}-64", (f"clusters={count}",)) for count in (1, 2, 4, 8)],
            [Column("PEs", pes), Column("area, mm²", area), *cameras(("cycles", cycles), ("useful, %", useful))], "")

declare("issue-bank", "bank-select", ["design, scene", "camera"],
        [Row((f"`{design}`, {scene}", camera), design, scene=scene, camera=camera)
         for design in ("degs-64", "degs-x-64") for scene in ("flowers", "st-peter") for camera in "21"],
        [Column(f"*n* = {wait}", kcycles, keys=(f"scheduler.select_cycles={wait}",)) for wait in range(4)])
declare("issue-bank", "bank-termination", ["`termination`"],
        [Row((f"`{grain}`",), "degs-64", (f"scheduler.termination={grain}",)) for grain in ("segment", "task", "pixel")],
        scenes(("tasks issued, millions", lambda report, _: f"{report.stages.packing.tasks_issued / 1e6:.1f}"),
               ("terminated, %", share("terminated")), ("useful, %", useful), ("kcycles", kcycles)))

declare("packing-unit", "packing-ablation", ["span parsing", "reorganisation"],
        [Row((parsing, order), "degs-64", tuple(key for key, kept in
                                                (("span.parsing=false", parsing), ("packing.reorganisation=false", order))
                                                if kept == "no"))
         for parsing, order in (("no", "no"), ("no", "yes"), ("yes", "no"), ("yes", "yes"))],
        [Column("kcycles", kcycles), Column("speed ×", speed), Column("useful, %", useful),
         *(Column(f"{name}, %", share(name)) for name in ("boundary", "terminated", "blocked")),
         Column("tasks, millions", lambda report, _: f"{report.stages.packing.tasks_issued / 1e6:.1f}"),
         Column("camera 1: speed ×", speed, "1")])

declare("pixel-buffer", "pixel-contexts", ["design", "`state_bytes`", "contexts"],
        [Row((design, f"{value} {why}".strip(), contexts), design, (f"pixel_buffer.state_bytes={value}",))
         for design, value, why, contexts in
         (("degs-64", 8, "(its file), 0", "2"), ("degs-64", 16, "", "1"),
          ("degs-64-tuned", 16, "(its file)", "2, one per stream"),
          ("degs-64-tuned", 0, "(10.5 B)", "3, one is left over"), ("gbu-64", 8, "(its file)", "2 per engine"),
          ("gbu-64", 0, "(16 B)", "1 per engine"))],
        cameras(("ms", milliseconds), ("useful, %", useful)), "")

PORTS = (("none, kcycles", ()), ("**`gaussian_buffer.ports=1`** with 4 SRAM banks",
                                 ("gaussian_buffer.ports=1", "gaussian_buffer.sram_banks=4")),
         ("**`span_buffer.ports=1`**", ("span_buffer.ports=1",)), ("`packing.ports=1`", ("packing.ports=1",)),
         ("**`packing.ports=2`**", ("packing.ports=2",)), ("`packing.ports=4`", ("packing.ports=4",)),
         *((("`feature_buffer.ports=1` with 1 SRAM bank" if banks == 1 else
             f"**with {banks}**" if banks == 8 else f"with {banks}"),
            ("feature_buffer.ports=1", f"feature_buffer.sram_banks={banks}")) for banks in (1, 4, 8)),
         ("`feature_buffer.fill_cycles=4`", ("feature_buffer.fill_cycles=4",)),
         *((("`pixel_buffer.ports=1` with 8 SRAM banks" if banks == 8 else
             f"**with {banks}**" if banks == 32 else f"with {banks}"),
            ("pixel_buffer.ports=1", f"pixel_buffer.sram_banks={banks}")) for banks in (8, 16, 32)),
         ("`pixel_buffer.ports=2` with 8 SRAM banks", ("pixel_buffer.ports=2", "pixel_buffer.sram_banks=8")))
BOLD = tuple(key for name, keys in PORTS for key in keys if name.startswith("**"))


@table("docs/sram-ports.md")
def ports():
    """Cycles against unlimited ports, and percent of the PE-cycles that are lost to ports."""
    rows = (*PORTS, ("all bold rows, with `feature_buffer.fill_cycles=1`", (*BOLD, "feature_buffer.fill_cycles=1")))
    designs = ("degs-64", "degs-1024-streams")
    found = yield [[run(design, "flowers", f"--camera 2 {ALONE}", *keys) for design in designs] for _, keys in rows]
    lines = [[rows[0][0], *(cell for report in found[0] for cell in (kcycles(report, None), "0"))]]
    for (name, _), reports in zip(rows[1:], found[1:]):
        lines.append([name, *(cell for report, first in zip(reports, found[0])
                              for cell in (more_cycles(report, first) + " %", share("ports")(report, None)))])
    return markdown(["limit", *(cell for design in designs for cell in (f"`{design}`", "lost, %"))], lines)


TUNED = ("scheduler.termination=segment", "pipeline.span_ends=outward", "scheduler.queue_segments_per_pe=4",
         "slicing.rows=splat", "slicing.interleave=1", "slicing.skip_dead_rows=false", "pipeline.tiles=box",
         "feature_buffer.bytes=8192", "pixel_buffer.release=tile", "pipeline.numbers=paper",
         "scheduler.scan=round_robin")
declare("results", "results-choices", ["taken back"],
        [Row(("nothing",), "degs-64-tuned"), *(Row((f"`{key}`",), "degs-64-tuned", (key,)) for key in TUNED)],
        [*cameras(("cycles, %", more_cycles), ("useful, %", useful))], "")

LITERAL = ("slicing.distribution=broadcast", "pixel_buffer.state_bytes=16")
QUEUES = ("scheduler.queue_segments_per_pe=24", "feature_buffer.bytes=262144", "slicing.skip_dead_rows=true",
          "slicing.rows=tile")
UNITS = ("span.count=128", "slicing.rows_per_cycle=32")
TWO = ("pixel_buffer.bytes=524288", "pixel_buffer.release=bank")
declare("results", "results-held-back", ["choices"],
        [Row((words,), "degs-1024", keys) for words, keys in
         (("Table III in this reading (the first command)", LITERAL),
          ("queues of 24 segments per PE, 256 KB Feature Buffer, rows of ended regions skipped, rows inside the tile "
           "only", (*LITERAL, *QUEUES)),
          ("and 128 Span Units, 32 rows per cycle and Slicing Unit (the second command)", (*LITERAL, *QUEUES, *UNITS)),
          ("and two tile contexts (`pixel_buffer.bytes=524288`, `pixel_buffer.release=bank`)",
           (*LITERAL, *QUEUES, *UNITS, *TWO)),
          ("one context, and Slicing Units that share out the splats (`slicing.distribution=splats`)",
           (LITERAL[1], *QUEUES, *UNITS)),
          ("and two tile contexts", (LITERAL[1], *QUEUES, *UNITS, *TWO)),
          ("and banks that take eight segments per cycle (`scheduler.issue_width`, `.segments_per_cycle`)",
           (LITERAL[1], *QUEUES, *UNITS, *TWO, "scheduler.issue_width=8", "scheduler.segments_per_cycle=8")),
          ("the shipped file", ()))],
        scenes(("useful, %", useful), ("kcycles", kcycles), ("Slicing, Span busy, %", busy)))


@table("docs/issue-bank.md")
def bank_features():
    """A Feature Buffer of the banks' entries, and of 8 KB at every size: means over five scenes."""
    entries = {16: 128, 256: 32, 1024: 16}  # of a bank with 8 KB
    found = yield {size: [[run(f"degs-{size}", scene, f"--camera {camera} {ALONE}", *keys) for scene in FIVE]
                          for camera in "21" for keys in ((), ("feature_buffer.bytes=8192",))] for size in entries}

    def mean(reports, measure):
        return geometric_mean([measure(report) for report in reports])

    def pair(groups, form, measure):
        return ", ".join(form.format(mean(reports, measure)) for reports in groups)
    rows = [[size, f"64, {entries[size]}",
             *(cell for pairs in (groups[:2], groups[2:])
               for cell in (pair(pairs, "{:.1f}", lambda report: 100 * report.slots.utilization),
                            pair(pairs, "{:.0f}", lambda report: report.cycles / 1e3)))]
            for size, groups in found.items()]
    return markdown(["PEs", "entries per bank", *(f"camera {camera}: {what}" for camera in "21"
                                                  for what in ("useful, %", "kcycles"))], rows)


MEMORIES = {"204.8": "lpddr5-6400x256", "102.4": "lpddr5-6400x128", "51.2": "lpddr5-3200x128"}


def on(memory, design, scene="flowers", options="", *keys):
    return run(design, scene, f"--camera 2 --memory configs/memory/{MEMORIES[memory]}.yaml {options}".strip(), *keys)


@table("docs/memory.md")
def memory_bandwidth():
    """Thousands of cycles on three LPDDR5 memories."""
    found = yield {design: [on(rate, design, options="--resolution 1080p") for rate in MEMORIES]
                   for design in ("degs-64", "degs-256", "gscore-64")}
    rows = []
    for design, reports in found.items():
        for words, name in (("preprocessing", "preprocessing_cycles"), ("blending", "blending_cycles"),
                            ("frame", "cycles")):
            rows.append([f"`{design}`, {words}", *(f"{report.timing[name] / 1e3:.0f}" for report in reports)])
        rows.append([f"`{design}`, MB moved", *(f"{(report.dram.bytes_read + report.dram.bytes_written) / 1e6:.1f}"
                                                for report in reports)])
    return markdown(["", *(f"{rate} GB/s" for rate in MEMORIES)], rows)


@table("docs/memory.md")
def memory_parts():
    """What the cycles of a frame that memory limits consist of; durations are those of configs/memory."""
    report = yield on("51.2", "degs-256")
    dram, channels = report.dram, report.dram.channels
    clock = 2.5  # ns of a CK at 3200 MT/s, and of a cycle at 1 GHz: 1
    each = len(channels.bytes)
    latencies = [stream["read_latency_ns"]["mean"] for stream in dram.to_dict()["streams"].values()
                 if "read_latency_ns" in stream]
    parts = (("bytes", "`transfers.on_bus` / `peak_gb_per_s`", dram.transfers.on_bus / dram.peak_gb_per_s),
             ("row misses", "`channels.accesses` `closed` and `conflicts`, per channel, × (tRP + tRCD) = 16 CK of one "
              "bank, / 16 banks that work at the same time",
              (channels.accesses.closed + channels.accesses.conflicts) / each * 16 * clock / 16),
             ("turns", "`channels.write_batches`, per channel, × 16 CK in which the bus is idle between reads and "
              "writes and back", channels.write_batches / each * 16 * clock),
             ("refresh", "`channels.commands.ref_ab`, per channel, × tRFCab = 84 CK",
              channels.commands.ref_ab / each * 84 * clock),
             ("latency", "the mean `read_latency_ns` of the four reads that wait for each other: geometry, SH, lists, "
              "splats", sum(latencies)))
    rows = [[part, words, f"{value / 1e3:.1f}"] for part, words, value in parts]
    total = sum(value for *_, value in parts)
    rows += [["sum", "", f"{total / 1e3:.1f}"], ["frame", "`timing.cycles`", f"{report.cycles / 1e3:.1f}"],
             ["sum over frame, %", "", f"{100 * total / report.cycles:.1f}"]]
    return markdown(["part", "from `dram` in the report, and from the [timing](lpddr5.md#one-channel)", "kcycles"], rows,
                    2)


@table("docs/memory.md")
def memory_scatter():
    """Records in the order of the scene and in Morton order."""
    outdoor = "synthetic:outdoor,gaussians=1000000"
    names = {"flowers": "flowers", "seal": "seal", "outdoor, 1 M Gaussians": outdoor}
    found = yield {f"{name}{words}": on("51.2", "degs-256", scene, "", *keys) for name, scene in names.items()
                   for words, keys in (("", ()), (", `morton`", ("memory.layout=morton",)))}
    rows = [[name, f"{100 * (1 - report.dram.channels.access_hit_rate):.1f}",
             *(f"{report.timing[part] / 1e3:.0f}" for part in ("preprocessing_cycles", "blending_cycles", "cycles")),
             f"{report['dram.energy_nj.activate'] / 1e3:.0f}"] for name, report in found.items()]
    return markdown(["scene", "accesses that miss their row, %", "preprocessing, kcycles", "blending", "frame",
                     "energy of activation, µJ"], rows)
