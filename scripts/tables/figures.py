# SPDX-License-Identifier: Apache-2.0
"""The paper's figures as studies: tables of docs/reproduction.md with published values beside ours, and curves.

docs/published.csv has the published values, and says where each stands and which point of which study stands beside it.
The scene is flowers, with the cameras and resolutions of each study; docs/measured.csv has every value."""
import ast
import functools
import operator
import re
import statistics

from measuring.points import ROOT, rows_of, sweep
from measuring.tables import csv_text, markdown, table

PAGE = "docs/reproduction.md"
PUBLISHED = ROOT / "docs/published.csv"
SCENE = "flowers"
CAMERAS = ("2", "1")
HEIGHTS = {"720p": "720", "1080p": "1080", "2K": "1440", "4K": "2160", "8K": "4320"}
KEYS = ("study", "point", "over", "measure")  # of a value in docs/measured.csv
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}
SIZES = ("16", "64", "256", "1024")
BUFFERS = {"gaussian_buffer.bytes": 73728, "span_buffer.bytes": 2048, "packing.bytes": 32768,
           "feature_buffer.bytes": 8192, "pixel_buffer.bytes": 16384}  # of Table I
BANKS = {16: (2, 4, 8, 16), 64: (4, 8, 16, 32), 256: (8, 16, 32, 64), 1024: (32, 64)}  # that can be built
SHOWN = {"redundancy": "-(16|1024)$", "pressure": "2K", "banks": "-(64|1024),", "buffers": "× 1/2$"}  # rows of curves
IN_SPACE, IN_TIME = "1 - slots.useful - slots.terminated", "slots.terminated"


class Mistake(Exception):
    """A sentence for the user."""


class Value:
    """What is measured: `measure` at one point of a study, over the same at another point if there is `over`."""

    def __init__(self, study, point, measure, over=""):
        self.study, self.point, self.measure, self.over = study, point, measure, over

    def key(self):
        return (self.study, self.point, self.over, self.measure)


class Curve:
    """A table of our values: rows and columns of headings with what they select."""

    def __init__(self, study, corner, rows, columns, unit):
        self.study, self.corner, self.rows, self.columns, self.unit = study, corner, rows, columns, unit

    def value(self, row, column):
        point = " ".join(part for part in (row[1], column[1]) if part)
        return Value(self.study, point, column[2], column[3])


def column(heading, measure, point="", over=""):
    return (heading, point, measure, over)


def buffer_rows():
    """A row for each buffer and factor, with all varied keys, because only one is varied at a time."""
    def point(varied, factor):
        return " ".join(f"{key}={round(size * (factor if key == varied else 1))}" for key, size in BUFFERS.items())
    return [(f"{key.split('.')[0].replace('_buffer', '')} buffer × {name}", point(key, factor))
            for key in BUFFERS for name, factor in (("1/4", 0.25), ("1/2", 0.5), ("2", 2), ("4", 4))
            if (key, factor) != ("pixel_buffer.bytes", 0.25)]


def degs_rows(resolutions=("",)):
    return [(f"degs-{pes}" + (f", {name}" if name else ""),
             f"design=degs-{pes}" + (f" height={HEIGHTS[name]}" if name else ""))
            for pes in SIZES for name in resolutions]


PRESSURE = [column("Slicing Units", "stages.slicing.busy"), column("Span Units", "stages.span.busy"),
            column("Packing Units", "stages.packing.busy"), column("starved slots", "slots.starved"),
            column("conflict", "slots.conflict"), column("useful", "slots.utilization")]
DEFAULT_BUFFERS = " ".join(f"{key}={size}" for key, size in BUFFERS.items())
CURVES = {
    "pressure": Curve("pressure", "design, resolution", degs_rows(("720p", "2K")), PRESSURE, "%"),
    "redundancy": Curve("redundancy", "design", [(f"{name}-{pes}", f"design={name}-{pes}")
                                                 for name in ("gscore", "gbu", "gcc", "degs") for pes in SIZES],
                        [column("in space", IN_SPACE), column("in time", IN_TIME), column("useful", "slots.useful")],
                        "%"),
    "bandwidth": Curve("bandwidth", "design @ GB/s",
                       [(f"degs-{pes} @ {speed}", f"design=degs-{pes}@{speed}")
                        for pes in ("64", "256") for speed in ("204.8", "102.4", "51.2")],
                       [column("preprocessing, kcycles", "preprocessing_cycles / 1000"),
                        column("the rest, kcycles", "(cycles - preprocessing_cycles) / 1000")], ""),
    "banks": Curve("banks", "design", [(f"degs-{pes}, {banks} banks", f"design=degs-{pes} scheduler.banks={banks}")
                                       for pes, counts in BANKS.items() for banks in counts],
                   [column("in space", IN_SPACE), column("useful", "slots.useful")], "%"),
    "segment-length": Curve("segment-length", "resolution", [(name, f"height={HEIGHTS[name]}")
                                                             for name in ("720p", "2K")],
                            [column(f"{n} px", "1 - slots.utilization", f"scheduler.segment_length={n}")
                             for n in (4, 8, 16, 32)], "%"),
    "tile-size": Curve("tile-size", "tile", [(f"{n} px", f"tile_size={n}") for n in (8, 16, 32, 64)],
                       [column(f"segments of {n} px: {words}", measure, f"scheduler.segment_length={n}")
                        for n in (8, 16) for words, measure in
                        (("dominance", "slots.conflict - slots.useful"), ("useful", "slots.useful"))], "%"),
    "tiles-of-16": Curve("tiles-of-16", "design", [(name, f"design={name}") for name in
                                                   ("degs-64", "degs-64-streams", "gscore-64", "gscore-64-no-skip")],
                         [column("useful", "slots.utilization"), column("starved", "slots.starved"),
                          column("conflict", "slots.conflict"), column("ended", "slots.terminated")], "%"),
    "ablation": Curve("ablation", "design", [(name, f"design={name}")
                                             for name in ("neither", "no-parsing", "no-reorganisation", "both")],
                      [column("speed", "1 / latency_ms", "", "design=neither"),
                       column("frames per joule", "1 / energy.nj_per_frame", "", "design=neither")], "×"),
    "buffers": Curve("buffers", "buffer", buffer_rows(),
                     [column("latency", "latency_ms", "", DEFAULT_BUFFERS),
                      column("area", "area_mm2", "", DEFAULT_BUFFERS)], "×"),
}


def conditions(text):
    return dict(part.split("=", 1) for part in text.split())


@functools.lru_cache(maxsize=None)
def published():
    """The rows of docs/published.csv."""
    return rows_of(PUBLISHED)


def value_of(row):
    """What stands beside a published value, or None if no study measures it."""
    return Value(row["study"], row["point"], row["measure"], row["over"]) if row["study"] else None


def all_values():
    """Every value of all tables once."""
    values = [value_of(row) for row in published() if row["study"]]
    for curve in CURVES.values():
        values += [curve.value(row, each) for row in curve.rows for each in curve.columns]
    return list({value.key(): value for value in values}.values())


def evaluated(measure, row):
    """The number that an expression of measures has at one point."""
    def name_of(node):
        return f"{name_of(node.value)}.{node.attr}" if isinstance(node, ast.Attribute) else node.id

    def number(node):
        if isinstance(node, ast.BinOp):
            return OPERATORS[type(node.op)](number(node.left), number(node.right))
        if isinstance(node, ast.Constant):
            return node.value
        if name_of(node) not in row:
            raise Mistake(f"'{name_of(node)}' of the measure '{measure}' is no column of the study's results.csv.")
        if not row[name_of(node)]:
            raise Mistake(f"'{name_of(node)}' has no value for {row['design']}.")
        return float(row[name_of(node)])
    return number(ast.parse(measure, mode="eval").body)


def selected(rows, study, text):
    """The row of each view that has all that `text` demands; more or fewer than one is a mistake."""
    wanted = conditions(text)
    found = {}
    for row in rows:
        missing = wanted.keys() - row.keys()
        if missing:
            raise Mistake(f"'{sorted(missing)[0]}' of '{text}' is no column of the results of {study}.")
        if all(row[key] == value for key, value in wanted.items()):
            view = (row["scene"], row["camera"])
            if view in found:
                raise Mistake(f"'{text}' selects more than one point of {study} in scene {view[0]}, camera {view[1]}.")
            found[view] = row
    if found.keys() != {(row["scene"], row["camera"]) for row in rows}:
        raise Mistake(f"'{text}' selects no point of {study} in some of its views.")
    return found


def measured(rows, value):
    """Mean over the scenes for each camera: geometric, but arithmetic for differences, which may be below zero."""
    points = selected(rows, value.study, value.point)
    numbers = {view: evaluated(value.measure, row) for view, row in points.items()}
    if value.over:
        others = selected(rows, value.study, value.over)
        numbers = {view: number / evaluated(value.measure, others[view]) for view, number in numbers.items()}
    means = {}
    for camera in sorted({camera for _, camera in numbers}):
        of_camera = [number for view, number in numbers.items() if view[1] == camera]
        arithmetic = not value.over and " - " in value.measure or min(of_camera) <= 0
        means[camera] = (sum(of_camera) / len(of_camera) if arithmetic else
                         statistics.geometric_mean(of_camera))
    return means


def shown(number, unit):
    """Ours as the tables show it: percent with one decimal, all else with two or none."""
    if unit == "%":
        return f"{100 * number:.1f}".replace("-", "−")
    return f"{number:.0f}" if abs(number) >= 100 else f"{number:.2f}"


def difference(number, text, unit):
    """How far `number` is from a published value: in points of percent, or else as a share of it."""
    number = round(number * 100, 1) if unit == "%" else number
    bounds = [float(part) for part in text.lstrip("<>").split("..")]
    if text[0] in "<>":
        good = number < bounds[0] if text[0] == "<" else number > bounds[0]
        return "holds" if good else "does not hold"
    if bounds[0] <= number <= bounds[-1] and len(bounds) > 1:
        return "inside"
    nearest = min(bounds, key=lambda bound: abs(bound - number))
    text = f"{number - nearest:+.1f}" if unit == "%" else f"{100 * (number / nearest - 1):+.0f} %"
    return text.replace("-", "−")


def as_published(text, unit):
    words = text.replace("..", " to ").replace("<", "< ").replace(">", "> ")
    return words + (unit if unit == "×" else f" {unit}")


def of_studies(values):
    """The studies that values are of, as points."""
    return {value.study: sweep(value.study, SCENE) for value in values}


def means_of(found, value):
    """Means of a value by camera, from the results of the studies."""
    return measured(found[value.study], value)


def figure_table(figure):
    """Published values beside ours."""
    rows = [row for row in published() if row["figure"] == figure and row["study"]]
    found = yield of_studies(map(value_of, rows))
    lines = []
    for row in rows:
        means = means_of(found, value_of(row))
        lines.append([row["quantity"], as_published(row["value"], row["unit"])])
        for camera in CAMERAS:
            lines[-1] += [shown(means[camera], row["unit"]), difference(means[camera], row["value"], row["unit"])]
    head = ["what", "published"]
    return markdown(head + [word for camera in CAMERAS for word in (f"camera {camera}", "difference")], lines)


def curve_table(name):
    """Our values along the axes of a study, the rows of it that the page shows."""
    chart = CURVES[name]
    found = yield of_studies([chart.value(row, each) for row in chart.rows for each in chart.columns])
    lines = []
    for row in chart.rows:
        if re.search(SHOWN.get(name, ""), row[0]):
            means = [means_of(found, chart.value(row, each)) for each in chart.columns]
            lines.append([row[0], *(" · ".join(shown(each[camera], chart.unit) for camera in CAMERAS)
                                    for each in means)])
    return markdown([chart.corner] + [each[0] for each in chart.columns], lines)


def name_of(figure):
    """figure-14a of Fig. 14a."""
    return figure.lower().replace("fig.", "figure").replace("sec.", "section").replace(" ", "-")


for each_figure in dict.fromkeys(row["figure"] for row in published() if row["study"]):
    table(PAGE, name_of(each_figure), each_figure)(figure_table)
for each_curve in CURVES:
    table(PAGE, f"curve-{each_curve}", each_curve)(curve_table)


@table("docs/measured.csv", "measured-values")
def measured_values():
    """Every value of all tables and of all curves."""
    values = all_values()
    found = yield of_studies(values)
    return csv_text([*KEYS, *(f"camera {camera}" for camera in CAMERAS)],
                    sorted([*value.key(), *(f"{means_of(found, value)[camera]:.5g}" for camera in CAMERAS)]
                           for value in values))
