# SPDX-License-Identifier: Apache-2.0
"""tables_test.py: the tables of scripts/tables that give times and differences as ratios, on results made up here:
regime, timeline and workload. Needs no program."""

import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
sys.path.insert(0, str(ROOT / "python"))
from degs.report import Report  # noqa: E402
from measuring.tables import answered, flat  # noqa: E402
from tables import regime, timeline, workload  # noqa: E402


def made(declaration, result):
    """The cells of a table whose points have the results that a function gives them."""
    making = declaration()
    asked = next(making)
    try:
        making.send(answered(asked, {point: Report(result(point)) for point in flat(asked)}))
    except StopIteration as stop:
        return [[cell.strip() for cell in line.split("|")[1:-1]] for line in stop.value.splitlines()[2:]]
    raise AssertionError("the table asks for more points")


class Regime(unittest.TestCase):
    def real(self, point):
        """The row of docs/regime.csv that a point stands for, by its scene and camera."""
        words = dict(zip(point.options, point.options[1:]))
        return next(row for row in regime.real_views() if regime.synthetic(row) == point.scene
                    and row["camera"] == words["--camera"] and row["pixels"].split("x")[0] == words["--width"])

    def counts(self, point):
        """Twice the measured counts."""
        if point.options[-1] == str(regime.GINI_WIDTH):
            return {"view": {"footprint_gini": 1.44}}
        row = self.real(point)
        width, height = map(int, row["pixels"].split("x"))
        values = {name: 2 * float(row[name]) for name in ("visible", "fragments_per_pixel", "fragments_per_splat")}
        pairs = 2 * float(row["pairs_per_tile"]) * ((width + 15) // 16) * ((height + 15) // 16)
        return {"scene": {"gaussians": int(row["gaussians"])},
                "view": {**values, "tile_pairs": pairs, "camera": {"width": width, "height": height},
                         "footprint_px": {"p50": 2 * float(row["footprint_p50"])},
                         "terminated_share": 2 * float(row["ended"]) / 100,
                         "covered_share": 2 * float(row["covered"]) / 100}}

    def test_counts(self):
        rows = {name: cells for name, *cells in made(regime.regime_counts, self.counts)}
        for name in regime.COUNTS:
            self.assertEqual(rows[name][1], "+100 to +100", name)
        self.assertEqual(rows["visible"][0], "12.6 to 50.2")
        self.assertEqual(rows["pairs_per_tile"][0], "150 to 696")
        self.assertEqual(rows["gini"], ["68 to 74", "+95 to +112"])  # 144 over 74 and over 68

    def test_arrays(self):
        def useful(point):
            row = self.real(point)
            apart = -7 if row["measured"] == "garden0" else 2
            return {"slots": {"frame_utilization": (float(row[point.source]) + apart) / 100}}
        self.assertEqual(made(regime.regime_arrays, useful)[0],
                         ["degs-64", "31.4 to 77.2", "-7.0 to +2.0", "garden0 near 1920x1080"])

    def test_paths(self):
        def along(point):
            number = int(point.options[point.options.index("--camera") + 1])
            return {"slots": {"utilization": number ** 2 / 100}, "timing": {"latency_ms": 9 - number}}
        rows = made(regime.regime_paths, along)
        self.assertEqual([row[:2] for row in rows[:3]], [["interior", design] for design in regime.ARRAYS])
        self.assertEqual(rows[-1], ["garden", "gscore-64", "0.0 / 12.5 / 49.0", "2.00 / 5.50 / 9.00"])


class Times(unittest.TestCase):
    def test_traces_and_maps(self):
        """A design later in the list takes longer for pictures, an earlier one for timelines; one run of four is odd."""
        def took(point):
            place = timeline.DESIGNS.index(point.source) + 1
            seconds = 10 * (1 + ("--maps" in point.options) * place + ("--trace" in point.options) / place)
            return {"runs": [{"processor_s": seconds + late} for late in (0, 0, 100, 0)]}
        self.assertEqual(made(timeline.trace_cost, took), [["`--trace`", "1.20 (gcc-64)", "2.00 (degs-64)"],
                                                           ["`--maps`", "2.00 (degs-64)", "6.00 (gcc-64)"]])

    def test_start_from_a_file(self):
        def took(point):
            runs = [(1, 4), (2, 2), (3, 5)] if "--packed" not in point.options else [(0.5, 1), (0.5, 0.5), (0.2, 3)]
            return {"runs": [{"load_s": load, "workload_s": work} for load, work in runs]}
        self.assertEqual(made(workload.workload_start, took), [[name, "0.25"] for name in workload.SCENES])


unittest.main()
