#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants logs of tests/run.sh, good ones and bad ones; times.py must tell them apart and say why."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEAD = "step,seconds,processor_s,others,processors\n"


class Times(unittest.TestCase):
    def judged(self, *lines):
        """Exit code and output of times.py on a log, with ceilings of 10 s for two steps."""
        with tempfile.TemporaryDirectory() as folder:
            log, limits = Path(folder, "log.csv"), Path(folder, "limits.csv")
            log.write_text(HEAD + "".join(line + "\n" for line in lines), encoding="utf-8")
            limits.write_text("step,seconds\nbuild,10\ntests,10\n", encoding="utf-8")
            done = subprocess.run([sys.executable, HERE / "times.py", log, limits], text=True, stdout=subprocess.PIPE,
                                  check=False)
            return done.returncode, done.stdout

    def test_steps_below_their_ceilings_are_good(self):
        code, said = self.judged("build,9,17,0.02,2", "tests,10,15,0.1,2")
        self.assertEqual(code, 0)
        self.assertIn("all steps 19 s; the aim is 900 s\n", said)

    def test_a_step_above_its_ceiling_fails(self):
        code, said = self.judged("build,10.1,17,0.02,2", "tests,10,15,0.02,2")
        self.assertEqual(code, 1)
        self.assertRegex(said, "build .* ceiling 10 s: TOO LONG")

    def test_a_loaded_machine_is_not_judged(self):
        code, said = self.judged("build,99,17,0.5,2", "tests,10,15,0.02,2")
        self.assertEqual(code, 0)
        self.assertIn("cannot judge: others used 0.50 processors", said)
        self.assertNotIn("aim", said)

    def test_another_number_of_processors_is_not_judged(self):
        code, said = self.judged("build,99,17,0,1", "tests,99,15,0,1")
        self.assertEqual(code, 0)
        self.assertIn("cannot judge: 1 processors, and the ceilings are for 2", said)

    def test_every_step_needs_a_ceiling_and_a_line(self):
        self.assertEqual(self.judged("build,9,17,0,2")[0], 1)
        self.assertEqual(self.judged("build,9,17,0,2", "tests,9,17,0,2", "more,1,1,0,2")[0], 1)

    def test_the_total_is_compared_with_the_aim(self):
        code, said = self.judged("build,9,17,0,2", "tests,9,17,0,2")
        self.assertNotIn("missed", said)
        self.assertEqual(code, 0)

    def test_the_table_has_the_steps_of_the_script(self):
        steps = {line.split('"')[1] for line in (HERE.parent / "run.sh").read_text(encoding="utf-8").splitlines()
                 if line.lstrip().startswith('step "')}
        limits = {line.split(",")[0] for line in (HERE / "times.csv").read_text(encoding="utf-8").splitlines()[1:]}
        self.assertEqual(steps, limits)


if __name__ == "__main__":
    unittest.main()
