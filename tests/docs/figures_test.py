# SPDX-License-Identifier: Apache-2.0
"""figures_test.py: scripts/tables/figures.py on results made up here, with one planted mistake after the other; and that
docs/published.csv and docs/measured.csv belong together. Needs no program."""

import csv
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from tables import figures  # noqa: E402
from measuring.points import HEIGHTS, rows_of, study_resolutions  # noqa: E402
from measuring.tables import placed_marks  # noqa: E402


def results():
    """Two scenes with two cameras each, two designs; `a` takes 2 and 8 cycles with camera 2, `b` twice as many."""
    rows = []
    for scene, cycles in (("s", 2), ("t", 8)):
        for camera, more in (("2", 1), ("1", 10)):
            for design, times in (("a", 1), ("b", 2)):
                rows.append({"design": design, "scene": scene, "camera": camera, "height": "720",
                             "cycles": str(cycles * more * times), "slots.useful": str(cycles / 10)})
    return rows


class Selecting(unittest.TestCase):
    def test_means(self):
        one = figures.measured(results(), figures.Value("x", "design=a", "cycles"))
        self.assertAlmostEqual(one["2"], 4)  # geometric
        self.assertAlmostEqual(one["1"], 40)
        loss = figures.measured(results(), figures.Value("x", "design=a", "1 - slots.useful"))
        self.assertAlmostEqual(loss["2"], 0.5)  # arithmetic
        ratio = figures.measured(results(), figures.Value("x", "design=b", "(cycles - 0) / 2", "design=a"))
        self.assertAlmostEqual(ratio["2"], 2)

    def test_mistakes(self):
        for point, reason in (("height=720", "more than one"), ("design=c", "no point"), ("pes=64", "no column")):
            with self.assertRaisesRegex(figures.Mistake, reason):
                figures.measured(results(), figures.Value("x", point, "cycles"))
        with self.assertRaisesRegex(figures.Mistake, "no column"):
            figures.measured(results(), figures.Value("x", "design=a", "slots.gone"))
        with self.assertRaisesRegex(figures.Mistake, "in some of its views"):
            figures.measured(results()[1:], figures.Value("x", "design=a", "cycles"))


class Differences(unittest.TestCase):
    def test_words(self):
        for number, text, unit, words in (
                (0.757, "88.5", "%", "−12.8"), (0.885, "88.5", "%", "+0.0"), (3.0, "6", "×", "−50 %"),
                (2.2, "2.14..2.80", "×", "inside"), (1.07, "2.14..2.80", "×", "−50 %"), (0.31, "10..30", "%", "+1.0"),
                (0.81, ">80", "%", "holds"), (0.8, ">80", "%", "does not hold"), (0.04, "<5", "%", "holds"),
                (-0.1, "<0", "%", "holds"), (0.1, "<0", "%", "does not hold")):
            self.assertEqual(figures.difference(number, text, unit), words, (number, text))


class Files(unittest.TestCase):
    def test_every_value_is_whole(self):
        with figures.PUBLISHED.open(newline="") as file:
            for number, row in enumerate(csv.DictReader(file), 2):
                place = f"docs/published.csv:{number}"
                self.assertTrue(all(row[key] for key in ("figure", "section", "quantity", "value")), place)
                self.assertNotIn(None, list(row) + list(row.values()), place)
                self.assertIn(row["basis"], ("text", "table", "words"), place)
                self.assertRegex(row["value"], r"^[<>]?[0-9.]+(e-[0-9]+)?(\.\.[0-9.]+)?$", place)
                if row["basis"] == "words":
                    self.assertIn(row["value"][0], "<>", f"{place}: words give an order, not a number")
                if row["study"]:
                    self.assertTrue((ROOT / f"configs/studies/{row['study']}.yaml").exists(), place)
                    self.assertTrue(row["point"] and row["measure"], place)
                else:
                    self.assertTrue(row["note"], f"{place}: says nowhere why no study stands beside it")

    def test_peak_throughput(self):
        """Table III rounds what 8 operations of a PE in every cycle of 1 GHz are in 10^12 per second."""
        peaks = {int(row["pes"]): float(row["value"]) for row in figures.published()
                 if row["quantity"] == "peak throughput"}
        self.assertEqual(sorted(peaks), [16, 64, 256, 1024])
        for pes, tops in peaks.items():
            # The last row rounds the whole product down.
            self.assertLessEqual(abs(pes * 8e9 / 1e12 - tops), 0.05 if pes < 1024 else 0.2, pes)

    def test_a_point_names_one_resolution_of_its_study(self):
        for value in figures.all_values():
            heights = {str(HEIGHTS[name]) for name in study_resolutions(value.study).split(",")}
            for point in filter(None, (value.point, value.over)):
                named = figures.conditions(point).get("height")
                self.assertTrue(named in heights or not named and len(heights) == 1, (value.study, point))

    def test_measured_values_are_those_of_the_tables(self):
        wanted = {value.key() for value in figures.all_values()}
        stored = {tuple(row[key] for key in figures.KEYS) for row in rows_of(ROOT / "docs/measured.csv")}
        self.assertFalse(sorted(wanted - stored)[:3], "docs/measured.csv lacks values of the tables")
        self.assertFalse(sorted(stored - wanted)[:3], "docs/measured.csv has values that no table shows")

    def test_every_figure_with_a_study_is_on_the_page(self):
        marks = {name for page, name in placed_marks() if page == figures.PAGE}
        wanted = {figures.name_of(row["figure"]) for row in figures.published() if row["study"]}
        self.assertLessEqual(wanted | {f"curve-{name}" for name in figures.CURVES}, marks)


unittest.main()
