#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures as studies: runs them, and puts the published values beside ours.

    figures.py run [FOLDER] [--quick] [--jobs N] [--scene FILE]... [--only STUDY]... [--keep]
    figures.py table FIGURE              Markdown table of published values beside ours
    figures.py curve NAME                Markdown table of our values along the axes of a study

docs/published.csv has the published values, and says where each stands and which point of which study stands beside it.
`run` sweeps the studies into FOLDER (a temporary one by default), works out every value, and with --keep writes
docs/measured.csv, from which `table` and `curve` print the tables of docs/reproduction.md. The scene is flowers of
DEGS_SCENES, unless --scene names others. The program is DEGS_PROGRAM, or build/release/sim/degs. --quick
runs the small views of the studies, and only shows that every value can be worked out.
"""
import argparse
import ast
import csv
import math
import operator
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PUBLISHED = ROOT / "docs/published.csv"
MEASURED = ROOT / "docs/measured.csv"
PROGRAM = Path(os.environ.get("DEGS_PROGRAM", ROOT / "build/release/sim/degs")).absolute()
SCENES = ("flowers",)
CAMERAS = ("2", "1")
HEIGHTS = {"720p": "720", "1080p": "1080", "2K": "1440", "4K": "2160", "8K": "4320"}
KEYS = ("study", "point", "over", "measure")  # of a value in docs/measured.csv
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}
SIZES = ("16", "64", "256", "1024")
BUFFERS = {"gaussian_buffer.bytes": 73728, "span_buffer.bytes": 2048, "packing.bytes": 32768,
           "feature_buffer.bytes": 8192, "pixel_buffer.bytes": 16384}  # of Table I
BANKS = {16: (2, 4, 8, 16), 64: (4, 8, 16, 32), 256: (8, 16, 32, 64), 1024: (32, 64)}  # that can be built
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


def published():
    """The rows of docs/published.csv."""
    with PUBLISHED.open(newline="") as file:
        return list(csv.DictReader(file))


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


def selected(rows, study, text, leave_out=()):
    """The row of each view that has all that `text` demands; more or fewer than one is a mistake."""
    wanted = {key: value for key, value in conditions(text).items() if key not in leave_out}
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


def measured(rows, value, leave_out=()):
    """Mean over the scenes for each camera: geometric, but arithmetic for differences, which may be below zero."""
    points = selected(rows, value.study, value.point, leave_out)
    numbers = {view: evaluated(value.measure, row) for view, row in points.items()}
    if value.over:
        others = selected(rows, value.study, value.over, leave_out)
        numbers = {view: number / evaluated(value.measure, others[view]) for view, number in numbers.items()}
    means = {}
    for camera in sorted({camera for _, camera in numbers}):
        of_camera = [number for view, number in numbers.items() if view[1] == camera]
        arithmetic = not value.over and " - " in value.measure or min(of_camera) <= 0
        means[camera] = (sum(of_camera) / len(of_camera) if arithmetic else
                         math.exp(sum(map(math.log, of_camera)) / len(of_camera)))
    return means


def measured_of(ours, value, camera):
    """The stored number of a value."""
    text = ours.get(value.key(), {}).get(f"camera {camera}")
    if not text:
        raise Mistake(f"docs/measured.csv lacks {value.measure} at '{value.point}' of {value.study}, camera {camera}; "
                      f"run `scripts/figures.py run --only {value.study} --keep`.")
    return float(text)


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def check_heights(value):
    """--quick has other resolutions than the study, so this is what says that a height selects one of its views."""
    text = (ROOT / f"configs/studies/{value.study}.yaml").read_text()
    names = re.search(r"^resolutions: \[?([^\]\n]*)", text, re.MULTILINE)[1].split(", ")
    heights = [HEIGHTS[name.upper().replace("P", "p")] for name in names]
    for point in filter(None, (value.point, value.over)):
        if conditions(point).get("height", heights[0] if len(heights) == 1 else "none") not in heights:
            raise Mistake(f"'{point}' selects none or several of the resolutions of {value.study}: {', '.join(names)}.")


def stored():
    """docs/measured.csv by the keys of its values."""
    return {tuple(row[key] for key in KEYS): row for row in rows_of(MEASURED)} if MEASURED.exists() else {}


def run(options):
    if not os.access(PROGRAM, os.X_OK):
        raise Mistake(f"there is no program {PROGRAM}; build it, or name another in DEGS_PROGRAM.")
    scenes = options.scene or [str(Path(os.environ.get("DEGS_SCENES", ROOT / "../shared/scenes")) / name / "scene.ply")
                               for name in SCENES]
    views = ["--quick"] if options.quick else [word for scene in scenes for word in ("--scene", scene)]
    values = all_values()
    if unknown := set(options.only) - {value.study for value in values}:
        raise Mistake(f"no value is measured by the study '{min(unknown)}'.")
    kept = stored() if options.keep else {}
    for value in values:
        check_heights(value)
    for study in dict.fromkeys(value.study for value in values):
        if options.only and study not in options.only:
            continue
        folder = options.folder / study
        subprocess.run([PROGRAM, "sweep", ROOT / f"configs/studies/{study}.yaml", *views, "--no-reference",
                        "--jobs", str(options.jobs), "--out", folder], check=True, stdout=subprocess.DEVNULL)
        rows = rows_of(folder / "results.csv")
        for value in (each for each in values if each.study == study):
            means = measured(rows, value, ("height",) if options.quick else ())
            kept[value.key()] = dict(zip(KEYS, value.key())) | {
                f"camera {camera}": f"{means[camera]:.5g}" for camera in CAMERAS if camera in means}
        print(f"{study}: {len(rows)} points", flush=True)
    wanted = [value.key() for value in values]
    path = MEASURED if options.keep else options.folder / "measured.csv"
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, [*KEYS, *(f"camera {camera}" for camera in CAMERAS)], lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept[key] for key in sorted(wanted) if key in kept)


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


def markdown(head, rows):
    """Prints a table whose first column is text and whose others are numbers."""
    rule = ["---", *["--:"] * (len(head) - 1)]
    print("\n".join(f"| {' | '.join(row)} |" for row in [head, rule, *rows]))


def table(figure):
    rows, ours = [row for row in published() if row["figure"] == figure and row["study"]], stored()
    if not rows:
        raise Mistake(f"docs/published.csv has no '{figure}' with a study.")
    lines = []
    for row in rows:
        lines.append([row["quantity"], as_published(row["value"], row["unit"])])
        for camera in CAMERAS:
            number = measured_of(ours, value_of(row), camera)
            lines[-1] += [shown(number, row["unit"]), difference(number, row["value"], row["unit"])]
    head = ["what", "published"]
    markdown(head + [word for camera in CAMERAS for word in (f"camera {camera}", "difference")], lines)


def curve(name):
    if name not in CURVES:
        raise Mistake(f"there is no curve '{name}'; there are {', '.join(CURVES)}.")
    chart, ours, lines = CURVES[name], stored(), []
    for row in chart.rows:
        values = [chart.value(row, each) for each in chart.columns]
        lines.append([row[0], *(" · ".join(shown(measured_of(ours, value, camera), chart.unit) for camera in CAMERAS)
                                for value in values)])
    markdown([chart.corner] + [each[0] for each in chart.columns], lines)


def carry_out(command, options):
    """Calls a command; a mistake or a failed program ends the script with one sentence."""
    script = Path(sys.argv[0]).name
    try:
        command(options)
    except Mistake as mistake:
        sys.exit(f"{script}: {mistake}")
    except subprocess.CalledProcessError as failed:
        sys.exit(f"{script}: the program ended with exit code {failed.returncode}.")


def chosen(options):
    """Does what the command line names."""
    if options.command != "run":
        (table if options.command == "table" else curve)(options.name)
        return
    with tempfile.TemporaryDirectory(prefix="degs-figures-") as temporary:
        options.folder = options.folder or Path(temporary)
        options.folder.mkdir(parents=True, exist_ok=True)
        run(options)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser("run")
    command.add_argument("folder", type=Path, nargs="?")
    command.add_argument("--quick", action="store_true")
    command.add_argument("--keep", action="store_true")
    command.add_argument("--jobs", type=int, default=1)
    command.add_argument("--scene", action="append", default=[])
    command.add_argument("--only", action="append", default=[])
    commands.add_parser("table").add_argument("name")
    commands.add_parser("curve").add_argument("name")
    options = parser.parse_args()
    if options.command == "run" and options.quick and options.keep:
        sys.exit("figures.py: --keep needs the full studies; --quick is for a trial.")
    carry_out(chosen, options)


if __name__ == "__main__":
    main()
