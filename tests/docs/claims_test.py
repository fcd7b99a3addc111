# SPDX-License-Identifier: Apache-2.0
"""claims_test.py: the verdicts and measures of scripts/tables/claims.py on results made up here; and that every claim of
docs/published.csv is tried with what docs/claims.csv has, of studies that exist. Needs no program."""

import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from measuring import points  # noqa: E402
from tables import claims, figures  # noqa: E402


def results(study="claims", **of_degs):
    """A grid of one view in which DeGS is twice as good as GBU, the best of the baselines, at every size."""
    rows = []
    for name, times in (("degs", 1), ("gbu", 2), ("gcc", 3), ("gscore", 4)):
        for pes in figures.SIZES:
            row = {"study": study, "scene": "s", "height": "2160", "design": f"{name}-{pes}", "axis": "",
                   "useful": 0.9 / times, "ended": 0.1, "latency_ms": times / int(pes), "area_mm2": 1, "throughput_fps": "", "nj_per_frame": times}
            rows.append(row | (of_degs if name == "degs" else {}))
    return claims.Data(rows)


class Verdicts(unittest.TestCase):
    def verdict(self, **scenes):
        """For points by scene, true where a claim holds."""
        listed = [claims.Point(scene, "", value) for scene, values in scenes.items() for value in values]
        return claims.verdict(listed, [point for point in listed if not point.value])

    def test_rule(self):
        self.assertEqual(self.verdict(a=[1, 1], b=[1]), "holds")
        self.assertEqual(self.verdict(a=[1, 1], b=[1, 0]), "holds on a")
        self.assertEqual(self.verdict(a=[1], b=[0, 1], c=[1, 1]), "holds on a, c")
        self.assertEqual(self.verdict(a=[1, 0], b=[1, 1, 1, 0]), "does not hold")

    def test_bounds(self):
        for value, text, unit, good in ((0.81, ">80", "%", True), (0.8, ">80", "%", False), (0.99, "<1", "×", True),
                                        (1.0, ">1", "×", False), (99, ">100", "fps", False), (-0.01, ">0", "%", False)):
            self.assertEqual(claims.holds(value, text, unit), good, (value, text))


class Measures(unittest.TestCase):
    def test_best(self):
        points = list(claims.best("scaling", "useful", 1)(results("scaling")))
        self.assertEqual([round(point.value, 6) for point in points], [2] * 4)
        self.assertEqual(points[0].label, "s 4K, gbu-16")
        self.assertEqual([round(point.value, 6) for point in claims.best("claims", "latency_ms", -1)(results())], [2] * 4)
        self.assertEqual([round(point.value, 6) for point in claims.best("claims", "latency_ms", -1, True)(results(area_mm2=4))],
                         [0.5] * 4)
        self.assertEqual(list(claims.best("claims", "throughput_fps", 1)(results())), [])  # no path was run

    def test_scaling(self):
        self.assertEqual([point.value for point in claims.graceful(results("scaling"))], [1])
        self.assertEqual([point.value for point in claims.scale_of_best(results())], [1, 1, 1])
        self.assertEqual([point.value for point in claims.scale_of_best(results(latency_ms=1))], [16 / 1024] * 3)
        self.assertEqual([point.value for point in claims.utilization_of_degs(results("scaling", useful=0.7))], [0.7] * 4)

    def test_what_was_not_measured(self):
        with self.assertRaisesRegex(figures.Mistake, "lacks useful of degs-64"):
            claims.Data([]).get("useful", "claims", "s", "2160", "degs-64")


class Files(unittest.TestCase):
    def setUp(self):
        self.stored = claims.Data(points.rows_of(ROOT / "docs/claims.csv"))

    def test_every_claim_is_tried(self):
        rows = claims.claims()
        self.assertEqual([row["quantity"] for row in rows], list(claims.CLAIMS))
        for row in rows:
            self.assertIn(row["value"][0], "<>", row["quantity"])
            scenes = {point.scene for point in claims.tried(self.stored, row)[0]}
            # A comparison with the flat has no point in it, and no pixel of garden-crop ends early.
            few = {"gain outdoors over gain indoors": {"garden", "landscape"},
                   "redundancy in time, 1024 over 16 PEs": set(claims.SCENES) - {"garden-crop"}}
            self.assertEqual(scenes, few.get(row["quantity"], set(claims.SCENES)), row["quantity"])

    def test_all_runs_are_stored(self):
        heights = {name.lower(): height for name, height in figures.HEIGHTS.items()}
        wanted = {(study, scene, heights[name]) for study, scene, names, _ in claims.RUNS for name in names.split(",")}
        self.assertEqual(wanted, {key[:3] for key in self.stored.rows})
        for study in {run[0] for run in claims.RUNS}:
            self.assertTrue((ROOT / f"configs/studies/{study}.yaml").exists(), study)

    def test_runs_become_rows(self):
        row = {"height": "720", "design": "a", "pes": "16", "slots.utilization": "0.5", "slots.terminated": "0.25",
               "latency_ms": "2", "preprocessing_cycles": "3", "cycles": "12", "throughput_fps": "",
               "energy.nj_per_frame": "7", "area_mm2": "4", "scheduler.banks": "8"}
        line = claims.kept("banks", "s", row)
        self.assertEqual([line[name] for name in ("study", "scene", "axis", "preprocessing", "throughput_fps", "ended")],
                         ["banks", "s", "8", "0.25", "", "0.25"])


unittest.main()
