# SPDX-License-Identifier: Apache-2.0
"""fronts_test.py: scripts/measuring/fronts.py on small random sets against other ways to the same numbers: volumes by
counting the cells of a grid, fronts by what is lost without a point. Needs no program."""

import itertools
import random
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from measuring.fronts import front_of, grown, share_of_volume, volume  # noqa: E402


def cells(points, worst):
    """The volume of the unit cells below `worst` whose lower corner is worse than a point, of whole numbers."""
    return sum(any(all(x <= corner for x, corner in zip(point, cell)) for point in points)
               for cell in itertools.product(*map(range, worst)))


class Fronts(unittest.TestCase):
    def setUp(self):
        draws = random.Random(5)
        self.sets = [[tuple(draws.randrange(5) for _ in range(goals)) for _ in range(draws.randrange(1, 9))]
                     for goals in (1, 2, 3, 4) for _ in range(30)]

    def test_volume(self):
        for points in self.sets:
            for end in (3, 5):  # some points lie beyond the end, or none do
                worst = (end,) * len(points[0])
                self.assertEqual(volume(points, worst), cells(points, worst), points)

    def test_front(self):
        """The set without a point has less volume if the point is on the front, and the same if it is not."""
        sizes = set()
        for points in map(set, self.sets):
            worst = (5,) * len(next(iter(points)))
            front = front_of(list(points) * 2)
            self.assertEqual(sorted(front), sorted(point for point in points
                                                   if cells(points - {point}, worst) < cells(points, worst)))
            sizes.add(len(front))
        self.assertGreater(len(sizes), 3)

    def test_share(self):
        """Goals of whole numbers from 0 to 10 in their own units, so that the volume ends at cell 11."""
        draws = random.Random(7)
        for _ in range(10):
            inner = [tuple(draws.randrange(11) for _ in range(3)) for _ in range(6)]
            whole = [*inner, (0, 10, 10), (10, 0, 10), (10, 10, 0)]  # every goal has its best and its worst
            some = whole[:3]
            share = cells(some, (11,) * 3) / cells(whole, (11,) * 3)
            units = [[(2 + 0.5 * a, 300 + 40 * b, 1e-3 * c) for a, b, c in points] for points in (some, whole)]
            self.assertAlmostEqual(share_of_volume(*units), share)
        self.assertEqual(share_of_volume([(1, 4)], [(1, 4), (1, 4)]), 1)

    def test_grown(self):
        """Of every step, no other point would make the volume larger."""
        for points in self.sets:
            if len(points) < 3 or len(points[0]) != 3:
                continue
            places = grown(points, 1, 4)
            self.assertEqual((places[0], len(set(places))), (1, min(4, len(points))))
            for step in range(1, len(places)):
                shares = [share_of_volume([points[c] for c in [*places[:step], place]], points)
                          for place in range(len(points))]
                self.assertEqual(shares[places[step]], max(shares))


if __name__ == "__main__":
    unittest.main()
