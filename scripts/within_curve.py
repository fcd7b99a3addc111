#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `--within` costs for which error: the picture of docs/sampling.md.

    within_curve.py run [--csv FILE]     measures what FILE (docs/within.csv) lacks
    within_curve.py table [--csv FILE]   Markdown table of medians
    within_curve.py draw [--csv FILE]    docs/images/within.svg

`run` takes degs-64 and gscore-64 on the five close-ups, at 1080p and 4k, and compares an exact run with samples of seed 1
at each error: the share of the tiles that are simulated, which no other program disturbs, and the processor seconds
host.run_s over those of the exact run. A row is written when its run has ended, so `run` goes on where it stopped.
Medians are over the views where the design samples at all four errors. DEGS_PROGRAM and DEGS_SCENES are those of
sampling.py."""
import argparse
import csv
import statistics
from pathlib import Path

from sampling import CLOSEUPS, ROOT, run

DESIGNS = ("degs-64", "gscore-64")
RESOLUTIONS = ("1080p", "4k")
ERRORS = (1, 2, 3, 5)
COLUMNS = ["design", "scene", "resolution", "within", "tiles", "time"]


def load(file):
    if not Path(file).exists():
        return {}
    with open(file, newline="", encoding="utf-8") as rows:
        return {tuple(row[key] for key in COLUMNS[:4]): row for row in csv.DictReader(rows)}


def measure(file):
    done = load(file)
    with open(file, "a", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        if not done:
            writer.writeheader()
        for resolution in RESOLUTIONS:
            for scene in CLOSEUPS:
                for design in DESIGNS:
                    keys = [(design, scene, resolution, str(error)) for error in ERRORS]
                    missing = [key for key in keys if key not in done]
                    exact = run(design, f"{scene}:2", resolution, []) if missing else None
                    for key in missing:
                        writer.writerow(row_of(key, exact, run(design, f"{scene}:2", resolution,
                                                               ["--within", f"{key[3]}%"])))
                        out.flush()


def row_of(key, exact, report):
    row = dict(zip(COLUMNS, key), tiles="", time=f"{report['host']['run_s'] / exact['host']['run_s']:.3f}")
    if "sampling" in report:
        facts = report["sampling"]
        row["tiles"] = f"{facts['tiles_simulated'] / facts['tiles']:.3f}"
    return row


def medians(file):
    """By design and resolution: the number of views, and for every error the median share and time."""
    rows = load(file)
    found = {}
    for design in DESIGNS:
        for resolution in RESOLUTIONS:
            views = [[rows[design, scene, resolution, str(error)] for error in ERRORS] for scene in CLOSEUPS]
            sampled = [view for view in views if all(row["tiles"] for row in view)]
            found[design, resolution] = len(sampled), [
                tuple(statistics.median(float(view[i][name]) for view in sampled) for name in ("tiles", "time"))
                for i in range(len(ERRORS)) if sampled]
    return found


def table(file):
    print("| design | | views | " + " | ".join(f"±{error} %: tiles, time" for error in ERRORS) + " |")
    print("|---|---|--:|" + "--:|" * len(ERRORS))
    for (design, resolution), (views, points) in medians(file).items():
        cells = [f"{tiles:.2f}, {time:.2f}" for tiles, time in points] or [""] * len(ERRORS)
        print(f"| {design} | {resolution} | {views} of {len(CLOSEUPS)} | " + " | ".join(cells) + " |")


def draw(file):
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import pyplot
    matplotlib.rcParams.update({"svg.hashsalt": "degs", "font.size": 9})
    figure, axes = pyplot.subplots(figsize=(5.2, 3.1))
    for (design, resolution), (_, points) in medians(file).items():
        if points:
            color = f"C{DESIGNS.index(design)}"
            style = "-" if resolution == RESOLUTIONS[0] else "--"
            axes.plot(ERRORS, [time for _, time in points], style, marker="o", color=color,
                      label=f"{design}, {resolution}")
    axes.set(xlabel="error asked for, ±%", ylabel="time / exact", xticks=ERRORS, ylim=(0, None))
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(ROOT / "docs/images/within.svg", metadata={"Title": "Time over error", "Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["run", "table", "draw"])
    parser.add_argument("--csv", default=ROOT / "docs/within.csv")
    options = parser.parse_args()
    {"run": measure, "table": table, "draw": draw}[options.command](options.csv)


if __name__ == "__main__":
    main()
