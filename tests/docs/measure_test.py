#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""measure_test.py: scripts/measure.py with a program made up here: points are shared and kept, and what is stale is
found by its keys, its text and its probe."""
import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FAKE = '''#!/usr/bin/python3
import json, os, pathlib, sys
here, words = pathlib.Path(__file__).parent, sys.argv[1:]
with open(here / "calls", "a") as calls:
    calls.write(words[0] + "\\n")
if words[0] == "config":
    print("speed:", (here / "speed").read_text())
    print("words:", json.dumps(words))
else:
    if "synthetic:broken" in words:
        sys.exit("degs: this scene is broken")
    out = pathlib.Path(words[words.index("--out") + 1])
    out.mkdir(exist_ok=True)
    cycles = int((here / "cycles").read_text()) * (2 if "span.count=2" in words else 1)
    (out / "report.json").write_text(json.dumps({"timing": {"cycles": cycles, "latency_ms": cycles / 1e6},
                                                  "host": {"fidelity": "exact", "sim_s": cycles / 1e9}}))
'''


class Measure(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)
        program = self.folder / "degs"
        program.write_text(FAKE)
        program.chmod(0o755)
        self.set("speed", "1")
        self.set("cycles", "1000000")
        (self.folder / "docs").mkdir()
        self.page = self.folder / "docs/page.md"
        self.page.write_text("Words.\n\n<!-- measured: double -->\n\n| old |\n\nMore words.\n")
        os.environ["DEGS_PROGRAM"] = str(program)
        sys.path.insert(0, str(ROOT / "scripts"))
        import measure
        from measuring import points, records, tables
        self.measure, self.points, self.records, self.tables = measure, points, records, tables
        for module in (points, records, tables):
            self.addCleanup(setattr, module, "ROOT", module.ROOT)
            module.ROOT = self.folder
        records.FILE = self.folder / "docs/tables.json"
        self.addCleanup(setattr, records, "LONG_S", records.LONG_S)
        records.LONG_S = 60  # on a busy machine, too, a probe is the point itself and no run more
        tables.TABLES.clear()

        @tables.table("docs/page.md")
        def double():
            found = yield [points.run("degs-64", "synthetic:object", "", *keys) for keys in ((), ("span.count=2",))]
            return tables.markdown(["cycles"], [[report.cycles] for report in found])

        @tables.table("docs/file.csv")
        def later():
            first = yield points.run("degs-64", "synthetic:object")
            second = yield {"two": points.run("degs-64", "synthetic:object", "", "span.count=2")}
            return f"ratio\n{second['two'].cycles / first.cycles}"
        self.all = dict(tables.TABLES)

    def set(self, name, text):
        (self.folder / name).write_text(text)

    def make(self, tables=None):
        self.points.values_of.cache_clear()
        store = self.measure.Store(self.folder / "kept")
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            return self.measure.Making(tables or self.all, store, 2, False).all()

    def stale(self):
        self.points.values_of.cache_clear()
        return self.records.check(self.all, 2)[0]

    def runs(self):
        return (self.folder / "calls").read_text().split().count("run")

    def test_points_are_shared_and_kept(self):
        self.assertEqual(self.make(), [])
        self.assertIn("| cycles |\n| --- |\n| 1000000 |\n| 2000000 |\n\nMore words.", self.page.read_text())
        self.assertEqual((self.folder / "docs/file.csv").read_text(), "ratio\n2.0\n")
        self.assertEqual(self.runs(), 2)
        self.make()
        self.assertEqual(self.runs(), 2)
        self.assertEqual(self.stale(), [])

    def test_each_run_whose_times_count_is_kept(self):
        @self.tables.table("docs/times.csv")
        def times():
            report = yield self.points.run("degs-64", "synthetic:object", runs=3)
            spent = [host.processor_s > 0 for host in report.runs]
            return f"runs\n{[host.sim_s for host in report.runs]} {spent}"
        self.make({"times": self.tables.TABLES["times"]})
        self.assertEqual((self.folder / "docs/times.csv").read_text(), "runs\n[0.001, 0.001, 0.001] [True, True, True]\n")

    def test_a_study_is_found_again_by_another_process(self):
        """The texts that a study depends on come in one order, whatever the seed of the hashes is."""
        studies = self.folder / "configs/studies"
        studies.mkdir(parents=True)
        names = [f"{letter}.yaml" for letter in "hdbfacge"]
        for name in names:
            (studies / name).write_text(f"rate: {name}")
        (studies / "s.yaml").write_text("designs: []\nmemories: [" +
                                        ", ".join(f"{{include: {name}}}" for name in names) + "]\n")
        texts = list(self.points.depends_on(self.points.sweep("s")))
        self.assertEqual(texts[1:9], [f'{{"rate": "{name}"}}' for name in sorted(names)])
        # A comment changes nothing, a value does.
        (studies / "a.yaml").write_text("# words\nrate: a.yaml")
        self.assertEqual(list(self.points.depends_on(self.points.sweep("s"))), texts)
        (studies / "a.yaml").write_text("rate: 2")
        self.assertNotEqual(list(self.points.depends_on(self.points.sweep("s"))), texts)

    def test_a_changed_number_of_the_model_names_the_tables(self):
        self.make()
        self.set("cycles", "1000001")
        found = self.stale()
        self.assertEqual(len(found), 2)
        self.assertIn("docs/page.md: the table double is stale", found[0])
        self.assertRegex(found[0], r"timing.cycles was \d000000 and is \d00000[12]. .*scripts/measure.py double")

    def test_a_changed_value_of_a_key_is_found_but_no_changed_meaning(self):
        self.make()
        self.set("speed", "1  # in other words")
        self.assertEqual(self.stale(), [])
        self.set("speed", "2")
        self.assertEqual(len(self.stale()), 2)
        self.assertIn("values of their keys", self.stale()[0])

    def test_a_new_key_is_taken_in_where_nothing_else_changed(self):
        self.make()
        self.set("speed", "1\ndeep: {inner: {fresh: 7}}")
        self.assertEqual(len(self.stale()), 2)
        self.points.values_of.cache_clear()
        self.assertEqual(self.records.take_in(self.all, "deep.inner.other"), ["double", "later"])
        self.assertEqual(len(self.stale()), 2)
        self.set("speed", "1\nfresh: 7")
        self.points.values_of.cache_clear()
        self.assertEqual(self.records.take_in(self.all, "fresh"), [])
        self.assertEqual(self.stale(), [])
        self.set("speed", "2\nfresh: 7\nsecond: 8")
        self.points.values_of.cache_clear()
        self.assertEqual(self.records.take_in(self.all, "second"), ["double", "later"])

    def test_a_probe_that_changed_stays_so_for_tables_that_were_not_measured_again(self):
        @self.tables.table("docs/second.csv")
        def second():
            return f"cycles\n{(yield self.points.run('degs-64', 'synthetic:object')).cycles}"
        tables = dict(self.tables.TABLES)
        self.make({name: tables[name] for name in ("second", "later")})
        self.set("cycles", "1000001")
        (self.folder / "kept").rename(self.folder / "of the build before")
        self.make({"second": tables["second"]})
        stale = self.records.check({name: tables[name] for name in ("second", "later")}, 2)[0]
        self.assertEqual(len(stale), 1)
        self.assertIn("the table later is stale", stale[0])

    def test_a_table_without_a_record_is_stale(self):
        self.make({"later": self.all["later"]})
        self.assertEqual(len(self.stale()), 1)
        self.assertIn("the table double is stale: no record", self.stale()[0])

    def test_a_part_of_the_tables_can_be_checked(self):
        self.make()
        self.set("cycles", "1000001")
        self.assertEqual(len(self.records.check({"later": self.all["later"]}, 2)[0]), 1)

    def test_a_changed_text_is_found(self):
        self.make()
        self.page.write_text(self.page.read_text().replace("2000000", "1999999"))
        self.assertEqual(len(self.stale()), 1)
        self.assertIn("its text is not what was measured", self.stale()[0])

    def test_a_table_without_its_points_leaves_the_others_alone(self):
        @self.tables.table("docs/page.md")
        def broken():
            yield self.points.run("degs-64", "synthetic:broken")

        @self.tables.table("docs/page.md")
        def broken_later():
            yield self.points.run("degs-64", "synthetic:object", "", "span.count=4")
            yield self.points.run("degs-64", "synthetic:broken")
        wrong = self.make(dict(self.tables.TABLES))
        self.assertEqual(len(wrong), 2)
        self.assertIn("broken: this scene is broken", wrong[0].replace("degs: ", ""))
        self.assertIn("broken-later: this scene is broken", wrong[1].replace("degs: ", ""))
        self.assertEqual((self.folder / "docs/file.csv").read_text(), "ratio\n2.0\n")


if __name__ == "__main__":
    unittest.main()
