# SPDX-License-Identifier: Apache-2.0
"""Table of docs/tile-binner.md: what the ways to list Gaussians by tiles cost."""
from statistics import geometric_mean

from measuring.points import run
from measuring.tables import markdown, table

MODES = ("exact", "tight", "box", "square")
SCENES = ("flowers", "synthetic:landscape,gaussians=3000000")
MEASURES = {"list entries, thousands": lambda report: report.workload.tile_pairs / 1e3,
            "latency, ms": lambda report: report.latency_ms,
            "useful slots, %": lambda report: 100 * report.slots.utilization,
            "MB read": lambda report: report.dram.bytes_read / 1e6}


@table("docs/tile-binner.md")
def tile_lists():
    """Whole accelerators at 1080p; four values stand in a cell."""
    found = yield {design: {mode: [run(design, scene, "--camera 2 --resolution 1080p", f"pipeline.tiles={mode}")
                                   for scene in SCENES] for mode in MODES}
                   for design in ("degs-64", "degs-1024", "gscore-64", "gbu-64", "gcc-64")}

    def cell(reports, measure):
        value = geometric_mean([measure(report) for report in reports])
        return f"{value:.0f}" if value >= 100 else f"{value:.3g}"
    rows = [[design, *(" / ".join(cell(reports, measure) for reports in modes.values())
                       for measure in MEASURES.values())] for design, modes in found.items()]
    return markdown([f"design: {' / '.join(MODES)}", *MEASURES], rows)
