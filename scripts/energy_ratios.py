#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""energy_ratios.py FOLDER: energy per frame of every design of a comparison over that of its first, geometric means over
the views, from the reports in the folder that `degs compare --out FOLDER` wrote; all of it, and the chip without its
memory, each also times area over area. Prints a Markdown table."""
import collections
import json
import math
import pathlib
import sys


def geometric_mean(values):
    return math.exp(sum(math.log(value) for value in values) / len(values))


def main():
    if len(sys.argv) != 2:
        sys.exit("energy_ratios.py: FOLDER of a comparison is needed.")
    folder = pathlib.Path(sys.argv[1])
    names = [config["name"] for config in json.loads((folder / "compare.json").read_text())["configs"]]
    energies, areas = collections.defaultdict(dict), {}
    for path in sorted((folder / "reports").glob("*/*.json")):
        number, name = path.stem.split("-", 1)
        if path.stem.endswith("-path"):
            continue
        report = json.loads(path.read_text())
        energy = report["energy"]
        design = names[int(number) - 1]
        energies[design][path.parent.name] = (energy["total_nj"], energy["total_nj"] - energy["dram_nj"])
        areas[design] = report["area"]["mm2"]
    first = names[0]
    print(f"| {first} over ... | with memory | per mm² | without memory | per mm² |")
    print("|---|--:|--:|--:|--:|")
    for design in names[1:]:
        views = energies[design].keys() & energies[first].keys()
        cells = []
        for part in (0, 1):
            ratio = geometric_mean([energies[design][v][part] / energies[first][v][part] for v in sorted(views)])
            cells += [f"{ratio:.2f}", f"{ratio * areas[design] / areas[first]:.2f}"]
        print(f"| {design} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
