# SPDX-License-Identifier: Apache-2.0
"""ratios_test.py: the ratios of scripts/tables/ratios.py on reports made up here; and that its steps end at the files of
the joint reading. Needs no program."""

import sys
import types
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from tables import figures, ratios  # noqa: E402


def report(ms, mm2, total=10, dram=4):
    return types.SimpleNamespace(latency_ms=ms, area=types.SimpleNamespace(mm2=mm2),
                                 energy=types.SimpleNamespace(total_nj=total, dram_nj=dram),
                                 timing=types.SimpleNamespace(throughput_fps=1000 / ms))


class Ratios(unittest.TestCase):
    def setUp(self):
        """DeGS takes 1 ms on 2 mm2 in one scene and 2 ms in the other; the baselines 3 ms, or 12, on 4 mm2."""
        def designs(degs, other):
            return {"degs": report(degs, 2), **{name: report(other, 4, 30, 20) for name in ratios.BASELINES}}
        self.scenes = {"a": designs(1, 3), "b": designs(2, 24)}

    def test_times_area(self):
        self.assertEqual(ratios.ratios(self.scenes["a"], ratios.latency), [6, 6, 6])
        self.assertEqual(ratios.ratios(self.scenes["a"], ratios.interval), [6, 6, 6])
        for mean, least, most in ratios.means(self.scenes, ratios.latency):
            self.assertAlmostEqual(mean, 12)  # of 6 and 24
            self.assertEqual((least, most), (6, 24))

    def test_energy(self):
        for share, ours, theirs in ((1, 10, 30), (0, 6, 10), (0.25, 7, 15)):
            value = ratios.ratios(self.scenes["a"], ratios.energy_of(share))[0]
            self.assertAlmostEqual(value, theirs * 4 / (ours * 2))

    def test_a_part_that_does_not_scale(self):
        # 100 units, 20 of them fixed: with the others 8 times as fast 30 are left.
        self.assertAlmostEqual(ratios.fixed(8, 100 / 30), 0.2)
        self.assertAlmostEqual(ratios.fixed(64, 64), 0)


class Published(unittest.TestCase):
    def test_values_are_those_of_the_list(self):
        """docs/published.csv has every number of the paper; the page repeats some of them."""
        listed = {row["quantity"]: row["value"] for row in figures.published()}
        words = {"latency": "latency", "throughput": "throughput", "energy": "energy efficiency"}
        for measure, values in ratios.PAPER.items():
            for name, value in zip(ratios.BASELINES.values(), values):
                self.assertEqual(float(listed[f"{words[measure]} per mm² of DeGS over {name}"]), value)
        for title, speedup, small, large in ratios.SPEEDUPS.values():
            self.assertEqual(float(listed[f"speed-up of {title} from 16 to 1024 PEs, 2K"]), speedup)
            for pes, value in ((16, small), (1024, large)):
                self.assertEqual(float(listed[f"PE utilisation of {title}, {pes} PEs, 2K"]), value)
        means = [listed[f"PE utilisation of DeGS, {pes} PEs, mean (ours 2K)"] for pes in ratios.SIZES]
        self.assertEqual(means, list(ratios.MEANS))


class Steps(unittest.TestCase):
    def test_lead_to_the_files(self):
        *_, (_, last, _) = ratios.readings()
        for design in ratios.ALL:
            file = ROOT / f"configs/readings/{design}-64-joint.yaml"
            text = yaml.safe_load(file.read_text(encoding="utf-8"))
            self.assertEqual(text["include"], f"../{design}-64.yaml")
            keys = {f"{section}.{key}={value}" for section, values in text.items() if isinstance(values, dict)
                    for key, value in values.items()}
            self.assertEqual(keys, set(last[design]), file.name)

    def test_each_changes_one_key(self):
        names = [name for name, *_ in ratios.readings()]
        self.assertEqual(len(names), len(ratios.STEPS) + 2)
        keys = [sum(map(len, each.values())) for _, each, _ in ratios.readings()]
        self.assertEqual(keys[1:], list(range(len(ratios.STEPS) + 1)))


unittest.main()
