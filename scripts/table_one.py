#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""table_one.py [PROGRAM]: the rows of the paper's Table I beside those of the cost model, as a Markdown table.

The numbers of the paper stand here, those of the model come from `degs config --cost`. Fails if a sum of the model does
not round to that of the paper."""
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DESIGNS = {"DeGS": "degs-64", "GSCore": "gscore-64", "GBU": "gbu-64", "GCC": "gcc-64"}
PAPER = [  # accelerator, row, mm2, W, blocks of the model
    ("DeGS", "Projection Unit", "0.92", "0.60", ["projection"]),
    ("DeGS", "Sorting Unit", "0.02", "0.01", ["sorting"]),
    ("DeGS", "Span Engine", "0.17", "0.09", ["slicing", "span"]),
    ("DeGS", "Packing Scheduler", "0.07", "0.04", ["packing"]),
    ("DeGS", "Blending Array", "0.88", "0.23", ["blending"]),
    ("DeGS", "Gaussian Buffer", "0.31", "0.01", ["gaussian_buffer"]),
    ("DeGS", "Feature Buffer", "0.03", "0.001", ["feature_buffer"]),
    ("DeGS", "Span Buffer", "0.04", "0.001", ["span_buffer"]),
    ("DeGS", "Packing Buffer", "0.16", "0.02", ["packing_buffer"]),
    ("DeGS", "Pixel Buffer", "0.12", "0.01", ["pixel_buffer"]),
    ("DeGS", "Total", "2.72", "1.01", None),
    ("GSCore", "P & S", "0.89", "0.58", ["projection", "sorting"]),
    ("GSCore", "Blending", "1.81", "0.25", ["blending"]),
    ("GSCore", "SRAM", "1.25", "0.04", ["gaussian_buffer", "pixel_buffer"]),
    ("GSCore", "Total", "3.95", "0.87", None),
    ("GBU", "P & S", "0.89", "0.58", ["projection", "sorting"]),
    ("GBU", "Blending", "2.88", "0.88", ["row_pes"]),
    ("GBU", "Scheduler", "0.24", "0.07", ["row_generation"]),
    ("GBU", "SRAM", "0.43", "0.06", ["list_buffer", "splat_buffer", "row_queues", "reuse_cache", "pixel_buffer"]),
    ("GBU", "Total", "4.44", "1.59", None),
    ("GCC", "P & S", "0.72", "0.30", ["grouping", "projection", "colour"]),
    ("GCC", "Blending", "0.96", "0.44", ["blending"]),
    ("GCC", "SRAM", "1.01", "0.05", ["group_buffer", "pixel_buffer"]),
    ("GCC", "Total", "2.69", "0.79", None),
]


def area_of(program, design):
    """The section `area` of a design."""
    command = [program, "config", str(ROOT / "configs" / f"{design}.yaml"), "--cost", "--format", "json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["area"]


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "degs"
    areas = {name: area_of(program, design) for name, design in DESIGNS.items()}
    print("| accelerator | row | mm², paper | mm², model | W, paper | W, model |")
    print("|---|---|---:|---:|---:|---:|")
    for accelerator, row, mm2, watts, blocks in PAPER:
        area = areas[accelerator]
        parts = [area] if blocks is None else [area["blocks"][block] for block in blocks]
        model = [sum(part[key] for part in parts) for key in ("mm2", "power_w")]
        for text, value in zip((mm2, watts), model):
            if abs(value - float(text)) > 0.5 * 10 ** -len(text.split(".")[1]):
                sys.exit(f"table_one.py: {accelerator}, {row}: {value} does not round to {text} of the paper.")
        print(f"| {accelerator} | {row} | {mm2} | {model[0]:.3f} | {watts} | {model[1]:.3f} |")


if __name__ == "__main__":
    main()
