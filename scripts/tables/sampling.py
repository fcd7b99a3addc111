# SPDX-License-Identifier: Apache-2.0
"""Tables and picture of docs/sampling.md: intervals of `--within` against exact runs, and what they cost."""
from statistics import median

from measuring.numbers import svg_of
from measuring.points import FIVE, run
from measuring.tables import csv_text, markdown, table

PAGE = "docs/sampling.md"
# Designs with the heights of their frames, as some have too few tiles at 1080p, and the
# keys that take out what couples the tiles of others.
SAMPLED = {"degs-16": ("1080p",), "degs@32": ("1080p",), "degs-64": ("1080p",), "degs-256": ("4k",),
           "gscore-16": ("1080p",), "gscore-64": ("4k",), "gscore-256": ("4k",), "gcc-16": ("4k",),
           "gcc-64": ("4k", "view_size=32"), "gbu-16": ("1080p", "reuse_cache.bytes=0"),
           "gbu-64": ("4k", "reuse_cache.bytes=0"), "orange-o1": ("1080p",),
           "degs-64-tuned": ("4k", "slicing.interleave=1")}
# Views that took no part in the choice of the rule.
HELD_OUT = (("seal", "1"), ("st-peter", "2"))
SEEDS = 30  # of each view
ERRORS = (1, 2, 3, 5)


def coverage_runs():
    """By design: [scene, camera, exact report, sampled reports]."""
    def runs(seeds):
        return {(name, *view): [run(name, view[0], f"--camera {view[1]} --resolution {size}{seed}", *keys)
                                for seed in seeds(name, view)]
                for name, (size, *keys) in SAMPLED.items() for view in HELD_OUT}

    def within(seed):
        return f" --within 1% --seed {seed}"
    first = yield runs(lambda *_: ("", within(1)))
    # A design that refuses a sample refuses it with every seed.
    others = yield runs(lambda name, view: [within(seed) for seed in range(2, SEEDS + 1)
                                            if is_sampled(first[name, *view][1])])
    return {name: [[*view, first[name, *view][0], [first[name, *view][1], *others[name, *view]]] for view in HELD_OUT]
            for name in SAMPLED}


def holds(report, exact):
    low, high = report["sampling"]["intervals"]["timing"]["cycles"]
    return low <= exact.cycles <= high


def is_sampled(report):
    return "sampling" in report.to_dict()


@table("docs/coverage.csv", "coverage-csv")
def coverage_csv():
    """Every run."""
    found = yield from coverage_runs()
    rows = []
    for name, views in found.items():
        for scene, camera, exact, sampled in views:
            for seed, report in enumerate(sampled, 1):
                cells = [""] * 4
                if is_sampled(report):
                    facts = report["sampling"]
                    low, high = facts["intervals"]["timing"]["cycles"]
                    cells = [round(report.cycles), round(low), round(high),
                             f"{facts['tiles_measured'] / facts['tiles']:.3f}"]
                rows.append([name, " ".join(SAMPLED[name][1:]), SAMPLED[name][0], scene, camera, seed, exact.cycles, *cells])
    return csv_text(["design", "keys", "size", "scene", "camera", "seed", "exact", "sampled", "low", "high", "tiles"], rows)


@table(PAGE)
def coverage():
    """By design: intervals that hold, runs that were exact, runs wider than asked for, error, share and time."""
    found = yield from coverage_runs()
    rows = []
    for name, views in [*found.items(), ("all", sum(found.values(), []))]:
        pairs = [(report, exact) for _, _, exact, sampled in views for report in sampled]
        own = [(report, exact) for report, exact in pairs if is_sampled(report)]
        cells = ["", "", "", "", ""]
        if own:
            facts = [report["sampling"] for report, _ in own]
            held = sum(holds(*pair) for pair in own)
            cells = [f"{held} of {len(own)}", sum(each["reached"] > 0.01 for each in facts),
                     f"{100 * median(abs(report.cycles / exact.cycles - 1) for report, exact in own):.2f}",
                     f"{100 * median(each['tiles_measured'] / each['tiles'] for each in facts):.0f}",
                     f"{median(report.host.run_s / exact.host.run_s for report, exact in own):.2f}"]
        rows.append([", ".join([name, *SAMPLED.get(name, ())]), cells[0], len(pairs) - len(own), *cells[1:]])
    return markdown(["design", "intervals that hold", "exact instead", "wider than asked for", "median error, %",
                     "tiles, %", "time"], rows)


def within_runs():
    """By design and resolution: [exact report, [report by error]] of the close-ups; times are the least of three."""
    found = yield {(name, size): [[run(name, scene, f"--camera 2 --resolution {size}", runs=3),
                                   [run(name, scene, f"--camera 2 --resolution {size} --within {error}%", runs=3)
                                    for error in ERRORS]] for scene in FIVE]
                   for name in ("degs-64", "gscore-64") for size in ("1080p", "4k")}
    return found


def times(exact, reports):
    """Times of runs over that of the exact one. A run of a second takes up to half as long again now and then."""
    def least(report):
        return min(host.run_s for host in report.runs)

    return [least(report) / least(exact) for report in reports]


def longest(exact, reports):
    """The longest of times(). Where all are exact runs instead, they are the same run, and the median of all counts."""
    if any(map(is_sampled, reports)):
        return max(times(exact, reports))
    return (median(host.run_s for report in reports for host in report.runs)
            / median(host.run_s for host in exact.runs))


def medians(views):
    """(share of the tiles, time over that of the exact run) by error, over views that are sampled at all."""
    sampled = [(reports, times(exact, reports)) for exact, reports in views if all(map(is_sampled, reports))]
    return len(sampled), [(median(r[i]["sampling"]["tiles_simulated"] / r[i]["sampling"]["tiles"] for r, _ in sampled),
                           median(t[i] for _, t in sampled)) for i in range(len(ERRORS))] if sampled else []


@table(PAGE)
def within_cost():
    """Medians of tiles and time by error; the longest time of any run over its exact one."""
    found = yield from within_runs()
    rows = []
    for (name, size), views in found.items():
        count, cells = medians(views)
        rows.append([f"{name}, {size}", f"{count} of {len(views)}",
                     *([f"{tiles:.2f}, {time:.2f}" for tiles, time in cells] or [""] * len(ERRORS)),
                     f"{max(longest(*view) for view in views):.2f}"])
    return markdown(["design", "views", *(f"±{error} %: tiles, time" for error in ERRORS), "longest of all"], rows)


@table("docs/images/within.svg", "within-picture")
def within_picture():
    """Time over error."""
    found = yield from within_runs()

    def draw(figure):
        axes = figure.subplots()
        for (name, size), views in found.items():
            _, points = medians(views)
            if points:
                axes.plot(ERRORS, [time for _, time in points], "-" if size == "1080p" else "--", marker="o",
                          color=f"C{['degs-64', 'gscore-64'].index(name)}", label=f"{name}, {size}")
        axes.set(xlabel="error asked for, ±%", ylabel="time / exact", xticks=ERRORS, ylim=(0, None))
        if found:
            axes.legend(frameon=False)
    return svg_of(draw, (5.2, 3.1))
