# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/analytic.md: estimates against exact runs, their intervals, ranks, energies, and what changes are worth."""
from statistics import correlation, mean, median

from measuring.points import run
from measuring.tables import csv_text, markdown, table

from tables.gains import pairs

PAGE = "docs/analytic.md"
FAMILIES = ("degs", "gscore", "gbu", "gcc", "orange")
DESIGNS = ("degs-16", "degs-64", "degs-256", "degs-1024", "degs-64-tuned", "degs-256-tuned", "degs-x-64",
           "gscore-16", "gscore-64", "gscore-256", "gscore-1024", "gbu-16", "gbu-64", "gbu-256", "gbu-1024",
           "gcc-16", "gcc-64", "gcc-256", "gcc-1024", "orange-o1", "orange-o2", "orange-o4")
# Other memories and lists, and clusters.
CHANGED = (("degs-64", "memory.model=lpddr5"), ("degs-256", "memory.model=lpddr5"), ("degs-1024", "memory.model=lpddr5"),
           ("degs-64", "memory.bandwidth_gb_per_s=51.2"), ("degs-256", "clusters=2"), ("degs-64", "pipeline.tiles=exact"),
           ("gscore-64", "memory.model=lpddr5"), ("gscore-256", "memory.bandwidth_gb_per_s=51.2"),
           ("gscore-64", "clusters=2"), ("gscore-64", "pipeline.tiles=square"), ("gbu-64", "memory.model=lpddr5"),
           ("gbu-256", "memory.bandwidth_gb_per_s=51.2"), ("gbu-64", "pipeline.tiles=exact"),
           ("gcc-64", "memory.model=lpddr5"), ("gcc-256", "memory.bandwidth_gb_per_s=51.2"), ("gcc-64", "clusters=2"),
           ("orange-o2", "memory.model=lpddr5"), ("orange-o4", "memory.bandwidth_gb_per_s=51.2"))
CALIBRATION = (("flowers", "--camera 1 --resolution 720p"), ("flowers", "--camera 2 --resolution 720p"),
               ("skull", "--camera 0 --resolution 720p"), ("skull", "--camera 2 --resolution 1080p"),
               ("guitar", "--camera 1 --resolution 720p"), ("guitar", "--camera 2 --resolution 1080p"),
               ("seal", "--camera 0 --resolution 1080p"), ("seal", "--camera 1 --resolution 720p"),
               ("seal", "--camera 2 --resolution 1080p"), ("st-peter", "--camera 0 --resolution 1080p"),
               ("st-peter", "--camera 1 --resolution 720p"), ("st-peter", "--camera 1 --resolution 1080p"),
               ("garden-crop", "--camera 1 --resolution 720p"), ("garden-crop", "--camera 2 --resolution 1080p"),
               ("synthetic:landscape,gaussians=300000", "--camera 2 --resolution 720p"),
               ("synthetic:interior,gaussians=200000", "--camera 2 --resolution 720p"),
               ("synthetic:garden,gaussians=500000", "--camera 1 --resolution 1080p"))
# Views that took no part in the choice of any constant.
HELD_OUT = (("flowers-full", "--camera 2 --resolution 1080p"), ("flowers-small", "--camera 0 --resolution 1080p"),
            ("fruit-drops", "--camera 1 --resolution 1080p"),
            ("synthetic:interior,gaussians=500000", "--camera 0 --resolution 1080p"),
            ("synthetic:landscape,gaussians=1000000", "--camera 1 --resolution 720p"))


def subjects():
    """(design, changed key or nothing)."""
    return [*((name, "") for name in DESIGNS), *CHANGED]


def both():
    """[design, key, scene, options, exact report, estimate], each subject on each view."""
    asked = {(name, key, *view): [run(name, *view, *filter(None, (key,))),
                                  run(name, view[0], f"{view[1]} --fidelity analytic", *filter(None, (key,)))]
             for name, key in subjects() for view in CALIBRATION + HELD_OUT}
    found = yield asked
    return [[*subject, *reports] for subject, reports in found.items()]


def is_held_out(row):
    return tuple(row[2:4]) in HELD_OUT


def error(row):
    """Of the estimated cycles."""
    return row[5].timing.cycles / row[4].timing.cycles - 1


def interval(row):
    return row[5]["timing.cycles_interval"]


def holds(row):
    low, high = interval(row)
    return low <= row[4].timing.cycles <= high


def half_width(row):
    low, high = interval(row)
    return (high - low) / 2 / row[5].timing.cycles


@table("docs/estimates.csv", "estimates-csv")
def estimates_csv():
    """Every pair."""
    rows = yield from both()
    return csv_text(["design", "key", "scene", "view", "held_out", "exact", "estimate", "low", "high", "carrying_tiles",
                     "standard_error", "limited_share"],
                    [[*row[:4], int(is_held_out(row)), row[4].timing.cycles, round(row[5].timing.cycles),
                      *map(round, interval(row)), f"{row[5]['sample.carrying_tiles']:.1f}",
                      f"{row[5]['sample.standard_error']:.4f}",
                      f"{row[5].limited_share:.3f}"] for row in rows])


@table(PAGE)
def estimate_intervals():
    """By accelerator: errors, and intervals that hold, on views of the calibration and on others."""
    rows = yield from both()
    lines = []
    for family in (*FAMILIES, "all"):
        own = [row for row in rows if family in (row[0].split("-")[0], "all")]
        cells = []
        for part in ([row for row in own if not is_held_out(row)], [row for row in own if is_held_out(row)]):
            cells += [f"{sum(map(holds, part))} of {len(part)}", f"{100 * median(abs(error(row)) for row in part):.1f}",
                      f"{100 * max(map(error, part), key=abs):+.0f}", f"{100 * median(map(half_width, part)):.1f}"]
        lines.append([family, *cells])
    return markdown(["accelerator", "calibration: hold", "median error, %", "worst, %", "median half-width, %",
                     "held out: hold", "median error, %", "worst, %", "median half-width, %"], lines)


@table(PAGE)
def estimate_energies():
    """By accelerator: errors of the estimated energy of a frame."""
    rows = yield from both()
    lines = []
    for family in (*FAMILIES, "all"):
        errors = [row[5].energy.nj_per_frame / row[4].energy.nj_per_frame - 1 for row in rows
                  if family in (row[0].split("-")[0], "all")]
        lines.append([family, f"{100 * median(map(abs, errors)):.1f}", f"{100 * max(errors, key=abs):+.0f}"])
    return markdown(["accelerator", "median error of the energy, %", "worst, %"], lines)


def ranks(values):
    """From 1; equal values share the mean of theirs."""
    return [sum(other < value for other in values) + (sum(other == value for other in values) + 1) / 2
            for value in values]


@table(PAGE)
def estimate_ranks():
    """Spearman's rank correlation over the shipped designs of each view."""
    rows = yield from both()
    lines = []
    for name, number in (("cycles", lambda report: report.timing.cycles),
                         ("energy", lambda report: report.energy.nj_per_frame)):
        found = []
        for view in CALIBRATION + HELD_OUT:
            own = [row for row in rows if tuple(row[2:4]) == view and not row[1]]
            found.append(correlation(*(ranks([number(row[place]) for row in own]) for place in (4, 5))))
        lines.append([name, f"{mean(found):.3f}", f"{min(found):.3f}"])
    return markdown(["designs ranked by", "correlation of the ranks", "least of a view"], lines)


@table(PAGE)
def estimate_times():
    """By accelerator: milliseconds of the host for an estimate of a projected view."""
    rows = yield from both()
    lines = []
    for family in (*FAMILIES, "all"):
        times = [1e3 * row[5].host.estimate_s for row in rows if family in (row[0].split("-")[0], "all")]
        lines.append([family, f"{median(times):.0f}", f"{max(times):.0f}"])
    return markdown(["accelerator", "median time, ms", "longest, ms"], lines)


@table(PAGE)
def estimate_changes():
    """Intervals of the gains that `losses` names, against runs of the changed designs."""
    found = yield from pairs()
    rows = [("below 5 %", [row for row in found if row[4] < 5]), ("5 % and more", [row for row in found if row[4] >= 5]),
            ("all", found)]
    return markdown(["estimated gain", "changes", "intervals that hold"],
                    [[name, len(own), sum(row[6][0] <= row[5] <= row[6][1] for row in own)]
                     for name, own in rows])
