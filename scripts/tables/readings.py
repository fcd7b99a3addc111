# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/readings.md: what the published figures become over the readings that the paper's text allows, and
what every single assumption is worth."""
import dataclasses
from statistics import geometric_mean

from measuring.points import run
from measuring.tables import csv_text, markdown, table

PAGE = "docs/readings.md"
SCENES, CAMERAS = ("flowers", "st-peter"), ("2", "1")  # close-ups, and the same scenes small
OPEN, AGAINST, SHIPPED = "open", "against", "shipped"  # how a reading stands to the text
# Of all designs at once: lists of 3-sigma squares or of exact ellipses, the memory of Sec. V-E.
ALL, ELLIPSES, SLOW = "squares", "ellipses", "slow"
COMMON = (SHIPPED, ALL, ELLIPSES, SLOW)
TITLES = {"degs": "DeGS", "gscore": "GSCore", "gbu": "GBU", "gcc": "GCC"}
# Keys that have a name on the page, which comes first.
SQUARES = ("*squares*", "pipeline.tiles=square")
EXACT = ("*ellipses*", "pipeline.tiles=exact")
NO_SKIP = ("*no skipping*", "array.subtile_skip=none")
EXACT_SKIP = ("*exact skipping*", "array.subtile_skip=exact")
SHORT = ("*short queues*", "engines.queue_depth=1")
PORTS = ("*degs-ports*", "span_buffer.ports=1", "packing.ports=2", "feature_buffer.ports=1",
         "feature_buffer.sram_banks=8", "feature_buffer.fill_cycles=1", "pixel_buffer.ports=1",
         "pixel_buffer.sram_banks=32")
LEAST = ("*degs-least*", "slicing.distribution=broadcast", "pixel_buffer.state_bytes=16", *PORTS[1:])
WIDE = ("slicing.rows=tile", "pixel_buffer.release=bank", "span.rows=pool", "scheduler.termination=task")
MOST = ("*degs-most*", *WIDE, "slicing.interleave=2")
ONE_STREAM = ("*degs-most* of one stream", *WIDE)
DEEP = ("array.termination_cycles=192", "array.pipeline_cycles=192")
ALL_ROWS, LONG = "engines.rows_per_cycle=0", "engines.queue_depth=64"


def engines(pes):
    """GBU with eight Row PEs in an engine."""
    return "*small engines*", "tile_size=16", f"engines.count={pes // 8}", "engines.row_pes=8"


ONE_ENGINE = ("tile_size=64", "engines.count=1", "engines.row_pes=64", "engines.rows_per_cycle=8")
GBU_LEAST = ("*gbu-least*", *ONE_ENGINE, SHORT[1])
GBU_MOST = ("*gbu-most*", *engines(64)[1:], ALL_ROWS, LONG)


@dataclasses.dataclass(frozen=True)
class Reading:
    """A design with changed keys: parts are keys, or tuples of a name and keys."""

    file: str
    text: str
    parts: tuple

    def design(self):
        return self.file.split("-")[0]

    def keys(self):
        return [key for part in self.parts for key in ([part] if isinstance(part, str) else part[1:])]

    def names(self):
        """The parts as the page shows them."""
        return [f"`{part}`" if isinstance(part, str) else part[0] for part in self.parts]

    def said(self):
        return " ".join(self.keys()) or ("as shipped" if self.text == SHIPPED else self.file)

    def runs(self, size, *options):
        """Points by camera, one for each scene."""
        return [[run(self.file, scene, " ".join((f"--camera {camera} --resolution {size}", *options)), *self.keys())
                 for scene in SCENES] for camera in CAMERAS]


def readings(file, *more):
    """The file as shipped and its readings, which are (text, parts...)."""
    return [Reading(file, SHIPPED, ()), *(Reading(file, text, tuple(parts)) for text, *parts in more)]


def alone(pes):
    """Readings of the arrays with so many PEs."""
    small = engines(pes)
    return [
        *readings(f"degs-{pes}", (OPEN, "slicing.distribution=broadcast"), (OPEN, "pixel_buffer.state_bytes=16"),
                  *((OPEN, key) for key in WIDE), (OPEN, PORTS), (OPEN, LEAST),
                  (AGAINST, "scheduler.termination=pixel"), (AGAINST, "pipeline.span_ends=exact"), (ALL, SQUARES),
                  (ELLIPSES, EXACT), *([(OPEN, ONE_STREAM)] if pes < 64 else
                    [(OPEN, "slicing.interleave=2"), (AGAINST, "slicing.interleave=4", "pixel_buffer.bytes=524288"),
                     (OPEN, MOST)])),
        *([Reading(f"degs-{pes}-tuned", AGAINST, ())] if pes >= 64 else []),
        *readings(f"gscore-{pes}", (OPEN, NO_SKIP), (OPEN, EXACT_SKIP), (ALL, SQUARES), (ALL, SQUARES, NO_SKIP),
                  (ELLIPSES, EXACT)),
        *readings(f"gbu-{pes}", (OPEN, small, f"engines.rows_per_cycle={max(1, 64 // pes)}"), (OPEN, ALL_ROWS),
                  *([(OPEN, "engines.rows_per_cycle=1")] if pes == 1024 else []),  # 8 for all engines, as Table I
                  (OPEN, small, ALL_ROWS), (OPEN, SHORT), (OPEN, LONG), (ALL, SQUARES), (ELLIPSES, EXACT))]


UTILIZATION = [*alone(16), *alone(1024)]
SLOWER = "memory.bandwidth_gb_per_s=51.2"
SPEED = [
    *readings("degs-64", (OPEN, "slicing.distribution=broadcast"), (OPEN, "slicing.distribution=broadcast_skip"),
              (OPEN, "pixel_buffer.state_bytes=16"), (OPEN, "slicing.interleave=2"),
              (AGAINST, "slicing.interleave=4", "slicing.count=4", "pixel_buffer.bytes=32768"),
              *((OPEN, key) for key in WIDE), (OPEN, PORTS), (OPEN, LEAST), (OPEN, MOST),
              (AGAINST, "scheduler.termination=pixel"), (AGAINST, "pipeline.span_ends=exact"),
              (AGAINST, "slicing.skip_dead_rows=true"), (ALL, SQUARES), (ALL, SQUARES, LEAST), (ALL, SQUARES, MOST),
              (ELLIPSES, EXACT), (SLOW, SLOWER)),
    Reading("degs-64-tuned", AGAINST, ()),
    *readings("gscore-64", (OPEN, NO_SKIP), (OPEN, EXACT_SKIP), (AGAINST, "array.clusters=4"), (AGAINST, *DEEP),
              (AGAINST, NO_SKIP, *DEEP), (ALL, SQUARES), (ALL, SQUARES, EXACT_SKIP), (ALL, SQUARES, NO_SKIP),
              (ELLIPSES, EXACT), (SLOW, SLOWER)),
    *readings("gbu-64", (OPEN, engines(64), "engines.rows_per_cycle=1"),
              (OPEN, "tile_size=16", "engines.count=4", "engines.row_pes=16", "engines.rows_per_cycle=2"),
              (OPEN, *ONE_ENGINE), (OPEN, ALL_ROWS), (OPEN, SHORT), (OPEN, LONG), (AGAINST, "engines.end_probe=false"),
              (OPEN, GBU_LEAST), (OPEN, GBU_MOST), (ALL, SQUARES), (ALL, SQUARES, GBU_MOST), (ELLIPSES, EXACT), (SLOW, SLOWER)),
    *readings("gcc-64", *((OPEN, f"array.discovery_cycles={cycles}") for cycles in (2, 4, 8)), (ALL, SQUARES),
              (ELLIPSES, EXACT), (SLOW, SLOWER))]
SMALL_TILES = [  # the paper's Table II
    *(Reading(design, text, ("tile_size=16", f"slicing.interleave={streams}", f"slicing.count={max(2, streams)}"))
      for design, text in (("degs-64", OPEN), ("degs-64-tuned", AGAINST)) for streams in (1, 2, 8)),
    Reading("degs-64", OPEN, (("*degs-64-wide*", "tile_size=16", *WIDE, "slicing.interleave=8", "slicing.count=8"),)),
    *readings("gscore-64", (OPEN, NO_SKIP[1])),
    Reading("gbu-64", OPEN, (*engines(64)[1:], "engines.rows_per_cycle=1"))]
BASELINES = [name for name in TITLES if name != "degs"]
FRAMES = {**{f"{scene}, camera {camera}": (scene, camera) for scene in SCENES for camera in sorted(CAMERAS)},
          **{f"`landscape`, {count} M, camera 2": (f"synthetic:landscape,gaussians={count}000000", "2")
             for count in (1, 3, 6)}}


def utilizations(found):
    """Percent by reading: geometric means of the views of each camera."""
    return {reading: [round(100 * geometric_mean([report.slots.utilization for report in reports]), 1)
                      for reports in cameras] for reading, cameras in found.items()}


class Speeds:
    """Latencies and areas of readings. A reading says what the design of Table I is, so it keeps the area of its file
    as shipped."""

    def __init__(self, found):
        self.ms = {reading: [geometric_mean([report.latency_ms for report in reports]) for reports in cameras]
                   for reading, cameras in found.items()}
        shipped = {reading.file: cameras for reading, cameras in found.items() if reading.text == SHIPPED}
        self.mm2 = {reading: shipped.get(reading.file, cameras)[0][0].area.mm2 for reading, cameras in found.items()}

    def over(self, degs, other):
        """Speed-ups per area of a DeGS, by camera."""
        return [slow / fast * self.mm2[other] / self.mm2[degs] for slow, fast in zip(self.ms[other], self.ms[degs])]


def together(one, other):
    """May one reading of the text set them side by side? Both leave it open, or both have the squares."""
    texts = {one.text, other.text}
    return texts <= {OPEN, SHIPPED} or texts == {ALL}


def joined(cells):
    """By camera; once if all are alike."""
    return cells[0] if len(set(cells)) == 1 else " · ".join(cells)


def ends(title, published, values, shipped, form="{:.1f}"):
    """A row of the summary: the least and the most of `values`, which are lists by camera, by their names."""
    sides = [[pick(values, key=lambda names: values[names][camera]) for camera in range(len(CAMERAS))]
             for pick in (min, max)]
    numbers = [" · ".join(form.format(values[names][camera]) for camera, names in enumerate(side)) for side in sides]
    keys = " / ".join(joined([", ".join(names) or "as shipped" for names in side]) for side in sides)
    return [title, published, numbers[0], " · ".join(map(form.format, shipped)), numbers[1], keys]


def of_arrays(found):
    """Rows of the arrays alone."""
    values = utilizations(found)
    published = {"degs": ("88.5", "73.6"), "gscore": ("34.8", "7.1"), "gbu": ("84.7", "18.7")}
    for design, ours in published.items():
        for pes, number in zip((16, 1024), ours):
            own = {reading: each for reading, each in values.items()
                   if reading.file == f"{design}-{pes}" and reading.text in (SHIPPED, OPEN, ALL)}
            yield ends(f"{TITLES[design]}, {pes} PEs", number,
                       {tuple(reading.names()): each for reading, each in own.items()},
                       next(each for reading, each in own.items() if reading.text == SHIPPED))


def of_speeds(found):
    """Rows of the speed-ups per area."""
    speeds = Speeds(found)
    published = {"gscore": "6.02 (7.25)", "gbu": "2.44 (2.36)", "gcc": "1.82 (2.82)"}
    for design, number in published.items():
        values = {tuple(dict.fromkeys(degs.names() + other.names())): speeds.over(degs, other) for degs in found
                  for other in found if degs.design() == "degs" and other.design() == design and together(degs, other)}
        words = ", latency (throughput)" if design == "gscore" else ""
        yield ends(f"DeGS over {TITLES[design]}{words}", number, values, values[()], "{:.2f}")


def of_small_tiles(found):
    """Rows of tiles of 16 px."""
    values = utilizations(found)
    for title, number, files in (("DeGS, 64 PEs, tiles of 16 px, 720p", "90.2", ("degs-64",)),
                                 ("a coupled array, likewise", "23.9", ("gscore-64", "gbu-64"))):
        own = {reading: each for reading, each in values.items() if reading.file in files}
        row = ends(title, number, {tuple(reading.names()): each for reading, each in own.items()},
                   next(iter(own.values())))
        yield [*row[:-1], "[below](#tiles-of-16-px)"]


def points(asked, size, *options):
    return {reading: reading.runs(size, *options) for reading in asked}


@table(PAGE)
def readings_summary():
    """The least and the most of what the text leaves open."""
    arrays, speeds, tiles = yield [points(UTILIZATION, "1080p", "--array-only"), points(SPEED, "1080p"),
                                   points(SMALL_TILES, "720p", "--array-only")]
    rows = [*of_arrays(arrays), *of_speeds(speeds), *of_small_tiles(tiles)]
    text = markdown(["", "published", "least", "shipped", "most", "keys of the least / of the most"], rows)
    return text.replace("--: |\n", "--- |\n", 1)


@table("docs/readings-utilization.csv")
def readings_utilization():
    """Every reading alone."""
    found = yield points(UTILIZATION, "1080p", "--array-only")
    return csv_text(["design", "what is set", "text", *(f"camera {camera}" for camera in CAMERAS)],
                    [[reading.file, reading.said(), reading.text, *values]
                     for reading, values in utilizations(found).items()])


@table("docs/readings-speed.csv")
def readings_speed():
    """Each change alone: one of DeGS against the shipped baselines, one of a baseline against the shipped DeGS;
    `squares`, `ellipses` and `slow` are of all designs."""
    found = yield points(SPEED, "1080p")
    speeds, rows = Speeds(found), []
    # What all designs have in common, by design and text.
    common = {(reading.design(), reading.text): reading for reading in reversed(list(found))
              if reading.text in COMMON}
    for reading in found:
        design, text = reading.design(), reading.text if reading.text in COMMON else SHIPPED
        if design != "degs" and reading in common.values():
            continue
        degs = reading if design == "degs" else common["degs", text]
        whole = reading == degs and reading in common.values() and text != SHIPPED
        others = [common[name, text] if design == "degs" else reading if design == name else None
                  for name in BASELINES]
        cells = [speeds.over(degs, other) if other else [None] * len(CAMERAS) for other in others]
        rows.append(["all" if whole else reading.file, reading.said(), reading.text,
                     *("" if value is None else f"{value:.2f}" for each in cells for value in each)])
    return csv_text(["design", "what is set", "text",
                     *(f"{TITLES[name]} camera {camera}" for name in BASELINES for camera in CAMERAS)], rows)


@table(PAGE)
def readings_frames():
    """The shipped files by view."""
    found = yield {view: {design: run(f"{design}-64", scene, f"--camera {camera} --resolution 1080p")
                          for design in TITLES} for view, (scene, camera) in FRAMES.items()}
    rows = []
    for view, reports in found.items():
        degs = reports["degs"]
        ratios = [reports[name].latency_ms / degs.latency_ms * reports[name].area.mm2 / degs.area.mm2
                  for name in BASELINES]
        rows.append([view, f"{degs.latency_ms:.3f}", *(f"{ratio:.2f}" for ratio in ratios)])
    return markdown(["view", "DeGS-64, ms", *(TITLES[name] for name in BASELINES)], rows)


@table(PAGE)
def readings_small_tiles():
    """Tiles of 16 px, arrays alone."""
    found = yield points(SMALL_TILES, "720p", "--array-only")
    return markdown(["design", "what is set", "text", *(f"camera {camera}" for camera in CAMERAS)],
                    [[reading.file, ", ".join(reading.names()) or "as shipped", reading.text, *values]
                     for reading, values in utilizations(found).items()], 3)


# Open values of baselines that make one faster by 2 % or more somewhere, on at most 2 % more area.
CHEAP = {"gscore": ("array.subtile_skip=exact", "binning.pairs_per_cycle=16", "projection.count=8"),
         "gbu": ("engines.end_probe=false", "engines.queue_depth=32", "engines.rows_per_cycle=0",
                 "engines.rows_per_cycle=8", "sorting.count=8", "list_buffer.chunks=16"),
         "gcc": ("projection.groups_ahead=4",),
         "orange": ("cores.array.fill=batch", "cores.array.fill=none", "binning.pairs_per_cycle=16")}
CHEAP_SIZES = {"orange": ("o1", "o4")}  # others with 64 and 1024 PEs
CHEAP_SCENES = {"flowers": "flowers", "`landscape`": "synthetic:landscape,gaussians=3000000"}
UNBUILT = {("gbu-64", "sorting.count=8"), ("gcc-64", "projection.groups_ahead=4")}  # their buffers are too small


@table(PAGE)
def readings_open_values():
    """What single open values would gain a baseline: percent of area and of frames per second."""
    designs = {f"{family}-{size}": keys for family, keys in CHEAP.items()
               for size in CHEAP_SIZES.get(family, ("64", "1024"))}
    found = yield {design: {key: [run(design, scene, "--camera 2 --resolution 1080p", *filter(None, [key]))
                                  for scene in CHEAP_SCENES.values()]
                            for key in ("", *keys) if (design, key) not in UNBUILT}
                   for design, keys in designs.items()}
    rows = []
    for design, reports in found.items():
        shipped = reports.pop("")
        for key, changed in reports.items():
            area = 100 * (changed[0].area.mm2 / shipped[0].area.mm2 - 1)
            gains = [100 * (before.cycles / after.cycles - 1) for before, after in zip(shipped, changed)]
            if area <= 2 <= max(gains):
                rows.append([design, f"`{key}`", *(f"{value:+.1f}" for value in (area, *gains))])
    return markdown(["design", "key", "area, %", *(f"speed, %: {scene}" for scene in CHEAP_SCENES)], rows, 2)
