#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants tables of mutants, good ones and bad ones; mutants.py must tell them apart and say why."""
import contextlib
import importlib.util
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts/mutants.py"
SOURCE = '// words\n#include "a.hpp"\nint sum(int a, int b) { return a + b; }\nint twice(int a) { return 2 * a; }\n'
GOOD = """- file: src/base/a.cpp
  what: The sum is one Too large
  from: return a + b;
  to: "return a + b + ($ ? 1 : 0);"
- file: src/base/a.cpp
  what: nothing is doubled
  from: return 2 * a;
  to: "return ($ ? 1 : 2) * a;"
"""


def script():
    spec = importlib.util.spec_from_file_location("mutants", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules["mutants"] = module
    spec.loader.exec_module(module)
    return module


MUTANTS = script()


class Tables(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        (self.root / "src/base").mkdir(parents=True)
        (self.root / "tests/mutants").mkdir(parents=True)
        (self.root / "src/base/a.cpp").write_text(SOURCE, encoding="utf-8")

    def tearDown(self):
        self.folder.cleanup()

    def said(self, table, command="list", name="base"):
        (self.root / f"tests/mutants/{name}.yaml").write_text(table, encoding="utf-8")
        out = io.StringIO()
        try:
            with contextlib.redirect_stdout(out):
                MUTANTS.main(["--root", str(self.root), command])
        except SystemExit as end:
            return 1, f"{end.code}\n"
        return 0, out.getvalue()

    def refused(self, table, reason, name="base"):
        code, said = self.said(table, name=name)
        self.assertEqual(code, 1, said)
        self.assertIn(f"tests/mutants/{name}.yaml: {reason}", said)

    def test_good_tables_are_listed_by_their_names(self):
        code, said = self.said(GOOD)
        self.assertEqual(code, 0, said)
        self.assertIn("base/the-sum-is-one-too-large  src/base/a.cpp: The sum is one Too large\n", said)

    def test_a_stale_entry_is_refused(self):
        self.refused(GOOD.replace("from: return a + b;", "from: return a - b;"),
                     "base/the-sum-is-one-too-large: `from` occurs 0 times in src/base/a.cpp")
        self.refused(GOOD.replace("from: return 2 * a;", "from: return"),
                     "base/nothing-is-doubled: `from` occurs 2 times in src/base/a.cpp")
        self.refused(GOOD.replace("src/base/a.cpp", "src/base/b.cpp"),
                     "base/the-sum-is-one-too-large: there is no src/base/b.cpp")

    def test_an_entry_that_cannot_work_is_refused(self):
        self.refused(GOOD.replace("$", "true"), "base/the-sum-is-one-too-large: there is no $ in `to`")
        self.refused(GOOD.replace("a.cpp", "a.hpp"),
                     "base/the-sum-is-one-too-large: src/base/a.hpp is not a .cpp file of src/base/")
        self.refused(GOOD.replace("from: return 2 * a;", "from: a + b; }"),
                     "base/nothing-is-doubled: it overlaps with base/the-sum-is-one-too-large")
        self.refused(GOOD + GOOD, "base/nothing-is-doubled: another entry has this name")
        self.refused(GOOD.replace("what", "why"), "base/: unknown key why")
        self.refused(GOOD.replace("from: return a + b;", ""), "base/the-sum-is-one-too-large: it needs file,")
        self.refused(GOOD, "sim-base/the-sum-is-one-too-large: src/base/a.cpp is not a .cpp file of sim/", "sim-base")
        self.refused(GOOD + "- {", "while parsing")

    def test_too_few_are_refused(self):
        code, said = self.said(GOOD, "--check")
        self.assertEqual(code, 1)
        self.assertIn("tests/mutants/base.yaml: 2 mutants of base, which needs 3\n", said)
        self.assertIn("tests/mutants/sim.yaml: 0 mutants of sim, which needs 40\n", said)

    def test_a_copy_has_all_of_them_and_a_name_selects_one(self):
        (self.root / "tests/mutants/base.yaml").write_text(GOOD, encoding="utf-8")
        mutants, found = MUTANTS.checked(self.root)
        text = MUTANTS.patched(SOURCE, found["src/base/a.cpp"])
        self.assertEqual(text.splitlines()[1:3], ['#include "degs_mutants.hpp"', '#include "a.hpp"'])
        program = self.root / "copy.cpp"
        main = 'int main() { return 10 * sum(1, 1) + twice(1); }\n'
        program.write_text(text.replace('#include "a.hpp"\n', "") + main, encoding="utf-8")
        (self.root / "degs_mutants.hpp").write_text(MUTANTS.HEADER, encoding="utf-8")
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, "-std=c++17", "-o", self.root / "copy", program], check=True)
        values = {name: subprocess.run([self.root / "copy"], env={"DEGS_MUTANT": name}, check=False).returncode
                  for name in ["", "base/none", *(mutant.name for mutant in mutants)]}
        self.assertEqual(list(values.values()), [22, 22, 32, 21])

    def test_a_skipped_test_has_not_failed(self):
        line = " 1/2 Test #{}: platform/{} ........***{}   0.11 sec\n"
        skipped = line.format(465, "Parameters", "Skipped")
        self.assertIsNone(MUTANTS.failed_test(skipped + " 2/2 Test #7: dram/A .......   Passed    0.02 sec\n"))
        for verdict in ("Failed", "Timeout", "Not Run", "Exception"):
            failed = MUTANTS.failed_test(skipped + line.format(7, "Frames", verdict))
            self.assertEqual((failed[1], failed[2]), ("platform/Frames", verdict))

    def test_the_nearest_and_cheapest_tests_run_first(self):
        (self.root / "tests/sim/goals").mkdir(parents=True)
        (self.root / "tests/sim/goals/fronts_test.cpp").write_text("TEST_P(Fronts, Are) {\n", encoding="utf-8")
        tests = object.__new__(MUTANTS.Tests)
        seconds = {"sim/Judgement": 9, "sim/All/Fronts": 5, "sim/Dear": 4, "sim/Cheap": 0.5, "sim/Fair": 0.75,
                   "dram/Judgement": 0.1}
        tests.tree, tests.suites, tests.seconds, tests.numbers = self.root, {}, seconds, dict.fromkeys(seconds, 1)
        mutant = MUTANTS.Mutant("sim", "sim/goals/judgement.cpp", "wrong", "1", "$", "")
        self.assertEqual(tests.groups(mutant), [["sim/Judgement"], ["sim/All/Fronts"], ["sim/Cheap", "sim/Fair"],
                                                ["sim/Dear"], ["dram/Judgement"]])

    def test_a_mutant_that_lives_long_is_left(self):
        class Slow:
            def groups(self, mutant):
                return [["a"], ["b"]]

            def run(self, folder, names, mutant):
                return "b" if names == ["b"] else None

        mutant = MUTANTS.Mutant("sim", "sim/goals/judgement.cpp", "wrong", "1", "$", "")
        self.assertEqual(MUTANTS.killer(Slow(), self.root, mutant, 60)[:2], (True, "b"))
        self.assertEqual(MUTANTS.killer(Slow(), self.root, mutant, -1)[:2], (False, None))

    def test_a_row_belongs_to_one_form_of_an_entry(self):
        first = MUTANTS.Mutant("base", "src/base/a.cpp", "wrong", "1", "$", "")
        others = [MUTANTS.Mutant("base", "src/base/a.cpp", "wrong", *rest)
                  for rest in (("2", "$", ""), ("1", "!$", ""), ("1", "$", "it is the same"))]
        self.assertEqual(len({first.digest, *(other.digest for other in others)}), 4)
        path = self.root / "mutants.csv"
        rows = {first.digest: MUTANTS.row_of(first, "base/Some.Test", 1.6), "gone": MUTANTS.row_of(others[0], None, 3)}
        MUTANTS.write_rows(path, [first], rows)
        self.assertEqual(MUTANTS.read_rows(path), {first.digest: rows[first.digest]})
        self.assertEqual([MUTANTS.row_of(each, None, 3)["verdict"] for each in (first, others[2])],
                         ["survives", "equivalent"])


if __name__ == "__main__":
    unittest.main()
