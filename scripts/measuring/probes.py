# SPDX-License-Identifier: Apache-2.0
"""Probes: cheap runs of points that say whether the program still gives what it gave, by numbers that no host time
enters."""
import dataclasses
import pathlib
import subprocess
import tempfile
import time

from .points import Point, once, rows_of
from degs.process import call, program
from degs.report import Report

# Of a report: what a probe keeps, if it is there.
PROBED = ("timing.cycles", "timing.throughput_fps", "timing.preprocessing_cycles", "slots.useful", "slots.boundary",
          "slots.terminated", "slots.conflict", "slots.starved", "slots.blocked", "dram.bytes_read",
          "dram.bytes_written", "dram.row_hit_rate", "energy.nj_per_frame", "area.mm2", "workload.tile_pairs",
          "workload.fragments", "image.psnr_db")
# Of a row of a study, and of a view.
PROBED_ROW = ("cycles", "preprocessing_cycles", "slots.utilization", "slots.conflict", "dram.bytes_read",
              "dram.bytes_written", "energy.nj_per_frame", "area_mm2")
PROBED_VIEW = ("visible", "tile_pairs", "fragments_per_pixel", "fragments_per_splat", "terminated_share")


def probe_of(point, values, seconds):
    """(seconds, what to run, what it gives) of the cheapest part of a point; None if it has none."""
    if point.kind == "sweep":
        if not values["rows"]:
            return None
        cheapest = min(range(len(values["rows"])), key=lambda index: values["seconds"][index])
        row = values["rows"][cheapest]
        return values["seconds"][cheapest], {**fields(point), "row": row["point"]}, of_row(row)
    if point.kind == "accuracy":
        return None
    return seconds / max(1, point.runs), fields(point), probed(point, values)


def fields(point):
    """A point as JSON has it, without what it does not say."""
    return {name: value for name, value in dataclasses.asdict(dataclasses.replace(point, runs=0)).items() if value}


def probed(point, values):
    if point.kind == "speed":
        return numbers(cycles_of(values["rows"]))
    if point.kind == "search":
        return numbers(ends_of(values))
    report = Report(values["view"] if point.kind == "view" else values)
    names = PROBED_VIEW if point.kind == "view" else PROBED
    return numbers({name: report[name] for name in names if name in report})


def cycles_of(rows):
    """Cycles of speed.json in each number set and fidelity, samples with the first seed."""
    return {f"{row['numbers']} {row['fidelity']}": row["cycles"] for row in rows if row["seed"] in (None, 1)}


def ends_of(values):
    """How far a search of explore.json went, and the sums of the goals that it found."""
    designs = values["results"]["designs"]
    return {**{name: values["search"][name] for name in ("estimated", "simulated", "simulated_cycles")},
            **{goal: sum(design[goal] for design in designs) for goal in values["goals"]}}


def numbers(values):
    """Counts as they are, and other numbers with six digits: more may depend on the compiler."""
    found = {name: float(value) for name, value in values.items() if value not in (None, "")}
    return {name: int(value) if value.is_integer() else float(f"{value:.6g}")
            for name, value in found.items() if abs(value) < float("inf")}


def of_row(row):
    """The numbers of a row of a study that a probe keeps."""
    return numbers({name: row.get(name) for name in PROBED_ROW})


def point_of(probe):
    words = {name: tuple(value) if isinstance(value, list) else value for name, value in probe.items() if name != "row"}
    return Point(**{"source": "", **words})


def small_probe(probe):
    """(seconds, what to run, what it gives) of the same design and keys on a tiny view, in place of a long probe."""
    small = fields(point_of(probe).quick())
    if "row" in probe:
        small["row"] = probe["row"]
    began = time.monotonic()
    values = probed_again(small)
    return time.monotonic() - began, small, values


def probed_again(probe):
    """What a probe gives now."""
    point = point_of(probe)
    if "row" not in probe:
        return probed(point, once(point, 1))
    with tempfile.TemporaryDirectory(prefix="degs-measure-") as folder:
        listed = call([*point.words(), "--list"], warn=False).splitlines()
        count = max(int(line.split()[0]) for line in listed if line.split()[:1] and line.split()[0].isdigit())
        call([*point.words(), "--shard", f"{probe['row']}/{count}", "--out", folder], progress=False, warn=False)
        subprocess.run([program(), *point.words(), "--collect", "--out", folder], check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        rows = [row for row in rows_of(pathlib.Path(folder, "results.csv")) if row["point"] == probe["row"]]
    return of_row(rows[0]) if rows else {}
