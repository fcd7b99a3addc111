# SPDX-License-Identifier: Apache-2.0
"""Table of docs/reproduction.md on energy efficiency: energy of a frame over that of DeGS."""
from statistics import geometric_mean

from measuring.points import FIVE, run
from measuring.tables import markdown, table

BASELINES = ("gscore-64", "gbu-64", "gcc-64")


@table("docs/reproduction.md")
def energy_ratios():
    """All of it, and the chip without its memory; each also times area over area."""
    found = yield {design: [run(design, scene, f"--camera {camera} --resolution 1080p")
                            for scene in FIVE for camera in (2, 1)] for design in ("degs-64", *BASELINES)}
    energies = {design: {"with memory": [report.energy.total_nj for report in reports],
                         "without": [report.energy.total_nj - report.energy.dram_nj for report in reports]}
                for design, reports in found.items()}
    rows = []
    for design in BASELINES:
        per_area = found[design][0].area.mm2 / found["degs-64"][0].area.mm2
        cells = []
        for part, values in energies[design].items():
            ratio = geometric_mean([theirs / ours for theirs, ours in zip(values, energies["degs-64"][part])])
            cells += [f"{ratio:.2f}", f"{ratio * per_area:.2f}"]
        rows.append([design, *cells])
    return markdown(["degs-64 over …", "with memory", "per mm²", "without memory", "per mm²"], rows)
