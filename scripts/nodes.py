#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The technology files of other nodes, configs/cost/*nm.yaml, from a published table; without an option they are only
compared with it.

    scripts/nodes.py [--write | --markdown]
"""
import math
import pathlib
import sys

ROWS = 28  # nm: the node of Table I, whose rows the factors scale
FO4_PER_NS, FO4_NODE = 40, 45  # [assumed] 25 ps at 45 nm; an INVX1 of NanGate's open library has 25.8
DELAY = {45: 0.81}  # of the same table
# nm: area relative to 45 nm; delay, energy and power relative to 65 nm. The table is that of
# S. Sarangi and B. Baas, "DeepScaleTool: A Tool for the Accurate Estimation of Technology
# Scaling in the Deep-Submicron Era", ISCAS 2021, arXiv:2102.10195.
PUBLISHED = {
    28: (0.35, 0.67, 0.37, 0.56),
    22: (0.22, 0.62, 0.30, 0.48),
    14: (0.08, 0.60, 0.19, 0.32),
    10: (0.03, 0.57, 0.15, 0.26),
    7: (0.011, 0.53, 0.11, 0.21),
}
BETWEEN = {16: (22, 14), 12: (14, 10)}  # [assumed]
# TSMC announced for N5 against N7: 1.84 times the density of logic, 30 % less power at the same
# speed.
BEYOND = {5: (7, (1 / 1.84, 1, 0.7, 0.7))}  # [assumed]
NODES = (22, 16, 14, 12, 10, 7, 5)


def values(node):
    """Area, delay, energy and power of a node on the scale of the published table."""
    if node in BETWEEN:
        high, low = BETWEEN[node]
        share = math.log(high / node) / math.log(high / low)
        return tuple(a * (b / a) ** share for a, b in zip(PUBLISHED[high], PUBLISHED[low]))
    if node in BEYOND:
        from_node, factors = BEYOND[node]
        return tuple(a * b for a, b in zip(PUBLISHED[from_node], factors))
    return PUBLISHED[node]


def fo4_per_ns(node):
    """cost.logic.fo4_per_ns: as many as at 45 nm, by the delay of the node."""
    return FO4_PER_NS * DELAY[FO4_NODE] / values(node)[1]


def factors(node):
    """The same relative to the node of the rows."""
    return tuple(a / b for a, b in zip(values(node), PUBLISHED[ROWS]))


def source(node):
    if node in BETWEEN:
        return "[assumed] between %d and %d nm of DeepScaleTool, geometrically" % BETWEEN[node]
    if node in BEYOND:
        return "[assumed] 7 nm of DeepScaleTool with what TSMC announced of N5 against N7"
    return "DeepScaleTool (Sarangi and Baas, ISCAS 2021)"


def text(node):
    area, _, energy, power = factors(node)
    delay = values(node)[1] / DELAY[FO4_NODE]
    return f"""# SPDX-License-Identifier: Apache-2.0
# The rows of Table I scaled to {node} nm:
# {source(node)}.
# scripts/nodes.py has the numbers and writes this file; docs/cost.md says what they are worth.
include: 28nm.yaml
node: {node} nm
area_factor: {area:.4g}
energy_factor: {energy:.4g}
leakage_factor: {power:.4g}  # [assumed] leakage keeps its share of the power
logic: {{ fo4_per_ns: {fo4_per_ns(node):.4g} }}  # {FO4_PER_NS} at {FO4_NODE} nm, {delay:.4g} of its delay
"""


def markdown():
    lines = ["| file | area | delay | energy | leakage | FO4 per ns | source |", "|---|---:|---:|---:|---:|---:|---|"]
    for node in (ROWS, *NODES):
        numbers = " | ".join(f"{factor:.3f}" for factor in factors(node)) + f" | {fo4_per_ns(node):.1f}"
        lines.append(f"| [`{node}nm.yaml`](../configs/cost/{node}nm.yaml) | {numbers} | {source(node)} |")
    return "\n".join(lines)


def main():
    if "--markdown" in sys.argv[1:]:
        print(markdown())
        return
    folder = pathlib.Path(__file__).resolve().parent.parent / "configs/cost"
    wrong = []
    if f"fo4_per_ns: {fo4_per_ns(ROWS):.4g} " not in (folder / f"{ROWS}nm.yaml").read_text(encoding="utf-8"):
        wrong.append(f"{ROWS}nm.yaml")
    for node in NODES:
        file = folder / f"{node}nm.yaml"
        if "--write" in sys.argv[1:]:
            file.write_text(text(node), encoding="utf-8")
        elif not file.exists() or file.read_text(encoding="utf-8") != text(node):
            wrong.append(file.name)
        print(f"{node:3} nm: area {factors(node)[0]:.3f}, delay {factors(node)[1]:.3f}, "
              f"energy {factors(node)[2]:.3f}, power {factors(node)[3]:.3f}")
    if wrong:
        sys.exit(f"{', '.join(wrong)}: not what scripts/nodes.py --write makes")


if __name__ == "__main__":
    main()
