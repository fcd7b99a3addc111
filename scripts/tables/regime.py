# SPDX-License-Identifier: Apache-2.0
"""Table of docs/regime.md: whole accelerators on the scenes that stand for real ones, by bandwidth."""
from measuring.points import run
from measuring.tables import markdown, table

SCENES = ("synthetic:interior,gaussians=1000000", "synthetic:garden,gaussians=1000000")
DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64")


@table("docs/regime.md")
def regime_bandwidth():
    """Latency of DeGS-64, and latency times area of the others over its own; a cell has both scenes."""
    found = yield {(size, rate): {design: [run(design, scene, f"--camera 1 --resolution {size}",
                                               f"memory.bandwidth_gb_per_s={rate}") for scene in SCENES]
                                  for design in DESIGNS} for rate in ("204.8", "51.2") for size in ("720p", "4k")}
    rows = []
    for (size, rate), by_design in found.items():
        costs = {design: [report.latency_ms * report.area.mm2 for report in reports]
                 for design, reports in by_design.items()}
        rows.append([size, rate, " · ".join(f"{report.latency_ms:.3f}" for report in by_design["degs-64"]),
                     *(" · ".join(f"{other / ours:.2f}" for other, ours in zip(costs[design], costs["degs-64"]))
                       for design in DESIGNS[1:])])
    return markdown(["whole", "GB/s", "DeGS-64, ms", *(f"{design} ×" for design in DESIGNS[1:])], rows)
