# SPDX-License-Identifier: Apache-2.0
"""estimates_test.py: docs/estimates.csv. Intervals follow from the estimate and the two numbers of a view as
docs/analytic.md says, and hold as often as is claimed. Needs no program."""

import csv
import math
import statistics
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# How far simulations lie below and above estimates, by accelerator.
ERRORS = {"degs": (0.06, 0.07), "gscore": (0.07, 0.06), "gbu": (0.03, 0.14), "gcc": (0.06, 0.07), "orange": (0.05, 0.06)}


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
            # The table has one digit of the tiles and three of the share.
            self.assertAlmostEqual(low, below + 0.05 * few + 0.15 * idle, delta=2e-3, msg=row)
            self.assertAlmostEqual(high, above + 0.15 * few, delta=5e-3, msg=row)

    def test_nine_in_ten_hold_on_views_that_were_held_out(self):
        held_out = [row for row in self.rows if row["held_out"] == "1"]
        self.assertGreater(len(held_out), 150)
        holding = [float(row["low"]) <= float(row["exact"]) <= float(row["high"]) for row in held_out]
        self.assertGreaterEqual(statistics.mean(holding), 0.9)
        widths = [(float(row["high"]) - float(row["low"])) / 2 / float(row["estimate"]) for row in held_out]
        self.assertLessEqual(statistics.median(widths), 0.085)


if __name__ == "__main__":
    unittest.main()
