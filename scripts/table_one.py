#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""table_one.py [--sizes] [PROGRAM]: the rows of the paper's Table I beside those of the cost model, as a Markdown table.

The numbers of the paper stand in docs/published.csv, those of the model come from `degs config --cost`. Fails if a sum
of the model does not round to that of the paper. --sizes: areas of the shipped designs by their
number of PEs, as the model has them."""
import csv
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DESIGNS = {"DeGS": "degs-64", "GSCore": "gscore-64", "GBU": "gbu-64", "GCC": "gcc-64"}
BLOCKS = {  # of the model, that a row of the paper stands for; a total is all of them
    "DeGS": {"Projection Unit": ["projection"], "Sorting Unit": ["sorting"], "Span Engine": ["slicing", "span"],
             "Packing Scheduler": ["packing"], "Blending Array": ["blending"], "Gaussian Buffer": ["gaussian_buffer"],
             "Feature Buffer": ["feature_buffer"], "Span Buffer": ["span_buffer"],
             "Packing Buffer": ["packing_buffer"], "Pixel Buffer": ["pixel_buffer"],
             "Compute Units": ["projection", "sorting", "slicing", "span", "packing", "blending"],
             "SRAM": ["gaussian_buffer", "feature_buffer", "span_buffer", "packing_buffer", "pixel_buffer"]},
    "GSCore": {"P & S": ["projection", "sorting"], "Blending": ["blending"],
               "SRAM": ["gaussian_buffer", "pixel_buffer"]},
    "GBU": {"P & S": ["projection", "sorting"], "Blending": ["row_pes"], "Scheduler": ["row_generation"],
            "SRAM": ["list_buffer", "splat_buffer", "row_queues", "reuse_cache", "pixel_buffer"]},
    "GCC": {"P & S": ["grouping", "projection", "colour"], "Blending": ["blending"],
            "SRAM": ["group_buffer", "pixel_buffer"]},
}


def paper():
    """(accelerator, row) of the paper's Table I with its texts of mm2 and W, in its order."""
    rows = {}
    with (ROOT / "docs/published.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            if row["figure"] == "Table I" and row["unit"] in ("mm2", "W"):
                rows.setdefault((row["design"], row["quantity"]), {})[row["unit"]] = row["value"]
    return rows


def area_of(program, design, options=()):
    """The section `area` of a design."""
    command = [program, "config", str(ROOT / "configs" / f"{design}.yaml"), "--cost", "--format", "json", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["area"]


SIZES = ("16", "64", "256", "1024")
FREE = ("--set", "cost.logic.widths=false")
BY_SIZE = [("DeGS", "degs-{}", ()), ("DeGS, [widths](#widths) free", "degs-{}", FREE),
           ("DeGS tuned", "degs-{}-tuned", ()), ("GSCore", "gscore-{}", ()), ("GBU", "gbu-{}", ()),
           ("GCC", "gcc-{}", ())]


def print_sizes(program):
    print("| | " + " | ".join(f"{size} PEs" for size in SIZES) + " |")
    print("|---|" + "---:|" * len(SIZES))
    for name, design, options in BY_SIZE:
        shipped = [size for size in SIZES if (ROOT / "configs" / f"{design.format(size)}.yaml").exists()]
        cells = [f"{area_of(program, design.format(size), options)['mm2']:.3f}" if size in shipped else ""
                 for size in SIZES]
        print(f"| {name}, mm² | " + " | ".join(cells) + " |")


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--sizes"]
    program = arguments[0] if arguments else "degs"
    if len(arguments) + 1 < len(sys.argv):
        print_sizes(program)
        return
    areas = {name: area_of(program, design) for name, design in DESIGNS.items()}
    print("| accelerator | row | mm², paper | mm², model | W, paper | W, model |")
    print("|---|---|---:|---:|---:|---:|")
    for (accelerator, row), texts in paper().items():
        area, mm2, watts = areas[accelerator], texts["mm2"], texts["W"]
        parts = [area] if row == "Total" else [area["blocks"][block] for block in BLOCKS[accelerator][row]]
        model = [sum(part[key] for part in parts) for key in ("mm2", "power_w")]
        for text, value in zip((mm2, watts), model):
            if abs(value - float(text)) > 0.5 * 10 ** -len(text.split(".")[1]):
                sys.exit(f"table_one.py: {accelerator}, {row}: {value} does not round to {text} of the paper.")
        print(f"| {accelerator} | {row} | {mm2} | {model[0]:.3f} | {watts} | {model[1]:.3f} |")


if __name__ == "__main__":
    main()
