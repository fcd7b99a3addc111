# SPDX-License-Identifier: Apache-2.0
"""Table of docs/dynamic-scenes.md: the paper's Table II, with means of two seeds of a made-up scene as ours."""
import statistics

from measuring.points import run
from measuring.tables import markdown, table

SCENES = ("synthetic:dynamic", "synthetic:dynamic,seed=2")
VIEW = "--frames 4 --camera 0 --width 960"
SMALL_TILES = "tile_size=16"
RUNS = {"coupled": ("gscore-64", ""), "degs": ("degs-64", "", SMALL_TILES), "own": ("degs-64", ""),
        "coupled array": ("gscore-64", " --array-only"), "degs array": ("degs-64", " --array-only", SMALL_TILES)}


@table("docs/dynamic-scenes.md")
def dynamic_scenes():
    """Whole runs of all frames; the rendering speedup is that of the arrays alone."""
    found = yield {name: [run(design, scene, VIEW + options, *keys) for scene in SCENES]
                   for name, (design, options, *keys) in RUNS.items()}

    def change(name, form):
        """Mean of what changes from frame to frame; '-' if a scene has no such number."""
        values = [report.changes[name] for report in found["degs"]]
        return "-" if None in values else form.format(statistics.mean(values))

    def used(name):
        return f"{statistics.mean(report.slots.utilization for report in found[name]):.1%}"

    def faster(before, after):
        return f"{statistics.mean(old.cycles / new.cycles for old, new in zip(found[before], found[after])):.2f}×"
    overlap, churn = change("active_overlap", "{:.3f}"), change("tile_churn", "{:.1%}")
    longest, gini = change("p99_tile_candidates", "{:.0f}"), change("footprint_gini", "{:.3f}")
    return markdown(["mean", "ours", "paper"], [
        ["Active-Gaussian overlap / tile-workload churn", f"{overlap} / {churn}", "0.329 / 5.1%"],
        ["P99 tile candidates / footprint Gini", f"{longest} / {gini}", "2130 / 0.873"],
        ["Blending PE utilization, coupled / DeGS", f"{used('coupled')} / {used('degs')}", "23.9% / 90.2%"],
        ["Rendering speedup / end-to-end speedup",
         f"{faster('coupled array', 'degs array')} / {faster('coupled', 'degs')}", "4.04× / 2.20×"],
        ["DeGS with its own tiles of 32 × 32: utilization / end-to-end speedup",
         f"{used('own')} / {faster('coupled', 'own')}", ""]])
