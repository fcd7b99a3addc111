# SPDX-License-Identifier: Apache-2.0
"""estimates_test.py: docs/estimates.csv. Intervals follow from the estimate and the three numbers of a view as
docs/analytic.md says, and hold as often as is claimed. Needs no program."""

import csv
import math
import statistics
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# How far simulations lie below and above estimates, by accelerator.
ERRORS = {"degs": (0.03, 0.065), "gscore": (0.015, 0.085), "gbu": (0, 0.07), "gcc": (0.04, 0.055),
          "orange": (0.035, 0.055)}


class Estimates(unittest.TestCase):
    def setUp(self):
        with open(ROOT / "docs/estimates.csv", encoding="utf-8") as file:
            self.rows = list(csv.DictReader(file))
        self.assertGreater(len(self.rows), 300)

    def test_intervals_follow_from_the_view(self):
        for row in self.rows:
            below, above = ERRORS[row["design"].split("-")[0]]
            few = 1 / math.sqrt(float(row["carrying_tiles"]))
            idle = 1 - float(row["limited_share"])
            low = math.log(float(row["estimate"]) / float(row["low"]))
            high = math.log(float(row["high"]) / float(row["estimate"]))
            drawing = 1.645 * float(row["standard_error"])
            # The table has one digit of the tiles and three of the share.
            self.assertAlmostEqual(low, math.hypot(below, drawing) + 0.05 * few + 0.15 * idle, delta=2e-3, msg=row)
            self.assertAlmostEqual(high, math.hypot(above, drawing) + 0.15 * few, delta=5e-3, msg=row)

    def test_standard_errors_are_as_large_as_errors(self):
        """Of estimates that rest on a tenth of the tiles or so, drawing them is most of the error."""
        drawn = [row for row in self.rows if float(row["standard_error"]) > 0.03]
        self.assertGreater(len(drawn), 50)
        scores = [math.log(float(row["exact"]) / float(row["estimate"])) / float(row["standard_error"]) for row in drawn]
        self.assertLess(statistics.mean(score * score for score in scores), 1.5 ** 2)
        self.assertGreater(statistics.mean(score * score for score in scores), 0.6 ** 2)

    def test_nine_in_ten_hold_on_views_that_were_held_out(self):
        held_out = [row for row in self.rows if row["held_out"] == "1"]
        self.assertGreater(len(held_out), 150)
        holding = [float(row["low"]) <= float(row["exact"]) <= float(row["high"]) for row in held_out]
        self.assertGreaterEqual(statistics.mean(holding), 0.9)
        widths = [(float(row["high"]) - float(row["low"])) / 2 / float(row["estimate"]) for row in held_out]
        self.assertLessEqual(statistics.median(widths), 0.08)


if __name__ == "__main__":
    unittest.main()
