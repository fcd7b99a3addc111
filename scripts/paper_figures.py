#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Figures for a paper from the results of `degs compare` or of a small `degs sweep`.

    scripts/paper_figures.py FOLDER [--width column|page] [--equal-area] [--out DIR]

DIR (default FOLDER/figures) gets ratios and slots, each as .svg and .pdf in the width of one column (85 mm) or of two
(178 mm) and as .csv with units in its header. All three say the command that makes them again. Needs Debian's
python3-matplotlib, and so its Python."""
import argparse
import csv
import json
import math
import shlex
import sys
from pathlib import Path

try:
    import matplotlib
except ImportError:
    sys.exit("This script needs matplotlib: apt-get install python3-matplotlib.")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

WIDTHS = {"column": 85, "page": 178}  # mm
MM_PER_INCH = 25.4
MOST_DESIGNS = 12
FONT = 7  # pt, the smallest of a figure
# Any colour vision tells these colours apart (M. Okabe, K. Ito, Color Universal Design, 2008), and
# the hatches do so in print without colour.
COLOURS = ("#0072b2", "#e69f00", "#56b4e9", "#d55e00", "#009e73", "#f0e442", "#cc79a7", "#999999", "#ffffff")
HATCHES = ("", "////", "", "\\\\\\\\", "xxxx", "", "....", "++++", "")
RATIOS = (("latency", "speed"), ("throughput", "throughput"), ("energy", "frames per joule"))
SLOTS = ("useful", "boundary", "terminated", "conflict", "ports", "padding", "starved", "blocked", "drain")


class Results:
    """Runs by design and view, of a comparison or of a sweep."""

    def __init__(self, folder):
        files = [folder / name for name in ("compare.json", "results.json") if (folder / name).exists()]
        if not files:
            sys.exit(f"'{folder}' has neither compare.json nor results.json.")
        data = json.loads(files[0].read_text(encoding="utf-8"))
        swept = "variants" in data
        self.designs = [design["name"] for design in data["variants" if swept else "configs"]]
        if len(self.designs) > MOST_DESIGNS:
            sys.exit(f"{len(self.designs)} designs are too many for bars; at most {MOST_DESIGNS} can be told apart.")
        self.first = self.designs[data["baseline"] if swept else 0]
        self.views = [f"{v['scene']}, camera {v['camera']}, {v['width']}×{v['height']}" for v in data["views"]]
        self.runs = {(self.designs[r["variant"]] if swept else r["config"], r["view"]): r for r in data["runs"]}

    def ratio(self, design, view, key):
        return self.runs.get((design, view), {}).get("ratio", {}).get(key)

    def rows(self, key):
        """(view, ratios by design), and the geometric means of designs that have all views."""
        rows = [(name, [self.ratio(d, v, key) for d in self.designs]) for v, name in enumerate(self.views)]
        if len(rows) > 1:
            columns = zip(*(ratios for _, ratios in rows))
            rows.append(("geometric mean", [mean(column) for column in columns]))
        return rows


def mean(values):
    if any(value is None or value <= 0 for value in values):
        return None
    return math.exp(sum(map(math.log, values)) / len(values))


def bar_style(number):
    return {"color": COLOURS[number % len(COLOURS)], "hatch": HATCHES[number % len(HATCHES)], "edgecolor": "black",
            "linewidth": 0.4}


def legend(figure, handles, labels, width):
    columns = min(len(labels), 3 if width == "column" else 5)
    figure.legend(handles, labels, loc="upper center", ncol=columns, frameon=False,
                  handlelength=1.4, columnspacing=1)
    return -(-len(labels) // columns)


def draw_ratios(results, width, equal):
    shown = [(key + ("_per_mm2" if equal else ""), words) for key, words in RATIOS]
    shown = [(key, words) for key, words in shown if any(any(r) for _, r in results.rows(key))]
    if not shown:
        return None, []
    inches = WIDTHS[width] / MM_PER_INCH
    figure, panels = pyplot.subplots(len(shown), 1, figsize=(inches, 1.35 * len(shown) + 0.5), squeeze=False, sharex=True)
    table = [["measure, times that of " + results.first + (", at its area" if equal else ""), "view"] + results.designs]
    for axes, (key, words) in zip(panels[:, 0], shown):
        rows = results.rows(key)
        bar = 0.8 / len(results.designs)
        for d, design in enumerate(results.designs):
            places = [g - 0.4 + bar * (d + 0.5) for g in range(len(rows))]
            axes.bar(places, [ratios[d] or 0 for _, ratios in rows], bar, label=design, **bar_style(d))
        axes.axhline(1, color="black", linewidth=0.6)
        axes.set_ylabel(f"{words} ×")
        axes.set_xticks(range(len(rows)))
        crowded = len(rows) > WIDTHS[width] / 20  # mm that a label takes
        axes.set_xticklabels([name if crowded else name.replace(", ", "\n") for name, _ in rows],
                             rotation=90 if crowded else 0)
        table += [[words, name] + ["" if r is None else repr(r) for r in ratios] for name, ratios in rows]
    lines = legend(figure, *panels[0, 0].get_legend_handles_labels(), width)
    figure.tight_layout(pad=0.3, rect=(0, 0, 1, 1 - 0.18 * lines / figure.get_figheight()))
    return figure, table


def draw_slots(results, width):
    bars = [(d, v) for v in range(len(results.views)) for d in results.designs
            if (results.runs.get((d, v)) or {}).get("slots", {}).get("useful") is not None]
    if not bars:
        return None, []
    present = [s for s in SLOTS if any(results.runs[b]["slots"][s] for b in bars)]
    figure, axes = pyplot.subplots(figsize=(WIDTHS[width] / MM_PER_INCH, 0.17 * len(bars) + 1.1))
    table = [["design", "view"] + [f"{s}, % of PE-cycles" for s in present]]
    left = [0.0] * len(bars)
    for number, slot in enumerate(present):
        shares = [100 * results.runs[b]["slots"][slot] for b in bars]
        axes.barh(range(len(bars)), shares, 0.8, left, label=slot, **bar_style(number))
        left = [a + b for a, b in zip(left, shares)]
    for bar in bars:
        slots = results.runs[bar]["slots"]
        table.append([bar[0], results.views[bar[1]]] + [repr(100 * slots[s]) for s in present])
    several = len(results.views) > 1
    axes.set_yticks(range(len(bars)))
    axes.set_yticklabels([d + (f", view {v + 1}" if several else "") for d, v in bars])
    axes.invert_yaxis()
    axes.set_xlim(0, 100)
    axes.set_xlabel("PE-cycles from the first task to the last, %")
    lines = legend(figure, *axes.get_legend_handles_labels(), width)
    figure.tight_layout(pad=0.3, rect=(0, 0, 1, 1 - 0.18 * lines / figure.get_figheight()))
    return figure, table


def save(figure, table, file, command):
    """Whoever finds one of the files finds the command in it."""
    figure.savefig(f"{file}.pdf", metadata={"Title": file.name, "Keywords": command, "CreationDate": None})
    figure.savefig(f"{file}.svg", metadata={"Title": file.name, "Date": None})
    svg = Path(f"{file}.svg").read_text(encoding="utf-8")
    escaped = command.replace("&", "&amp;").replace("<", "&lt;")
    at = svg.index(">", svg.index("<svg")) + 1
    Path(f"{file}.svg").write_text(f"{svg[:at]}\n <desc>{escaped}</desc>{svg[at:]}", encoding="utf-8")
    with open(f"{file}.csv", "w", encoding="utf-8", newline="") as out:
        out.write(f"# {command}\n")
        csv.writer(out, lineterminator="\n").writerows(table)
    pyplot.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="what `degs compare` or `degs sweep` wrote")
    parser.add_argument("--width", choices=WIDTHS, default="column")
    parser.add_argument("--equal-area", action="store_true", help="scale every design to the area of the first")
    parser.add_argument("--out", type=Path, help="folder for the figures")
    options = parser.parse_args()
    pyplot.rcParams.update({"font.size": FONT, "axes.titlesize": FONT, "axes.labelsize": FONT, "legend.fontsize": FONT,
                            "xtick.labelsize": FONT, "ytick.labelsize": FONT, "pdf.fonttype": 42, "hatch.linewidth": 0.4,
                            "svg.hashsalt": "degs", "axes.linewidth": 0.5})
    results = Results(options.folder)
    out = options.out or options.folder / "figures"
    out.mkdir(parents=True, exist_ok=True)
    command = shlex.join(["scripts/paper_figures.py"] + sys.argv[1:])
    for name, (figure, table) in {"ratios": draw_ratios(results, options.width, options.equal_area),
                                  "slots": draw_slots(results, options.width)}.items():
        if figure is not None:
            save(figure, table, out / name, command)
            print(f"{out / name}.svg, .pdf, .csv")


if __name__ == "__main__":
    main()
