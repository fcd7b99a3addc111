#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""measure.py [TABLE...]: measures tables, CSV files and pictures of the documents, and writes them where they stand.

    measure.py                  everything; goes on where it was stopped
    measure.py others-times     one table, or several; 'others*' is a pattern, docs/others.md all of a page
    measure.py --list           names, places and what is measured already
    measure.py --check          is a table stale? Tries the cheapest point of each
    measure.py --quick          makes all with tiny views and writes nothing: the declarations work
    measure.py --new-key KEY    a key was added that changes no result: records take it in, if they are right without it

Tables are declared in scripts/tables. Results of single points are kept in out/measure and shared between tables;
docs/tables.json records what each table depended on. measuring/scenes.py says where scenes are. The program is
DEGS_PROGRAM or build/release/sim/degs."""
import argparse
import concurrent.futures
import fnmatch
import functools
import sys
import tempfile
import time

from measuring import points, records
from measuring.store import Store
from measuring.tables import answered, declared_tables, flat, placed_marks


class Progress:
    """A line on stderr: points done, and how long the others will take."""

    def __init__(self, seconds, jobs):
        self.seconds, self.jobs, self.done, self.spent, self.shown = dict(seconds), jobs, 0, 0.0, 0.0
        self.all = len(seconds)

    def finished(self, point, seconds):
        """Longer or shorter points than expected are so for what is left, too."""
        self.spent += seconds
        self.done += 1
        expected = self.seconds.pop(point)
        self.shown += expected
        if self.done % 10 == 0 or sys.stderr.isatty() or self.done == self.all:
            left = sum(self.seconds.values()) * (self.spent / self.shown if self.shown else 1) / self.jobs
            print(f"{self.done} of {self.all} points done · about {left / 60:.0f} min left",
                  end="\r" if sys.stderr.isatty() and self.done < self.all else "\n", file=sys.stderr, flush=True)


class Open:
    """A table while it is made: what it asked for, and the points of that which have no result yet."""

    def __init__(self, table, small):
        self.table, self.small, self.made = table, small, table.make()
        self.before = []
        self.ask(next(self.made))

    def ask(self, asked):
        """`points` has for each point of the declaration the one that is measured."""
        self.asked = asked
        self.points = {point: self.small(point) for point in flat(asked)}
        self.missing = set(self.points.values())

    def answer(self, results):
        """Goes on with the results; True with the text in `self.text` when the table is made."""
        found = {point: points.shown(point, results[each][0]) for point, each in self.points.items()}
        self.before += self.points
        try:
            self.ask(self.made.send(answered(self.asked, found)))
        except StopIteration as stop:
            self.text = stop.value
            return True
        return False


class Making:
    """Tables while they are made: each goes on when all points that it asked for have results."""

    def __init__(self, tables, store, jobs, quick):
        self.store, self.jobs, self.quick = store, jobs, quick
        self.results, self.failed, self.wrong, self.written = {}, {}, [], 0
        small = functools.lru_cache(maxsize=None)(points.Point.quick if quick else lambda point: point)
        self.open = {name: Open(table, small) for name, table in tables.items()}

    def wanted(self):
        """Points without a result, in the order of the tables."""
        asked = dict.fromkeys(point for table in self.open.values() for point in table.points.values())
        return [point for point in asked if point not in self.results and point not in self.failed]

    def load(self, todo):
        """Takes what was measured before; returns what was not."""
        left = []
        for point in todo:
            try:
                kept = self.store.get(point)
            except Exception as problem:  # pylint: disable=broad-except
                self.failed[point] = str(problem)
                continue
            if kept:
                self.results[point] = kept
            else:
                left.append(point)
        return left

    def take(self, point, made):
        """A result, or why there is none."""
        try:
            values, seconds = made()
        except Exception as problem:  # pylint: disable=broad-except
            self.failed[point] = str(problem)
            return 0.0
        self.results[point] = (values, seconds)
        self.store.put(point, values, seconds)
        return seconds

    def measure(self, todo):
        """All points of a round. Those whose times count, or that have processes of their own, come last and alone."""
        alone = [point for point in todo if point.is_timed() or point.is_parallel()]
        progress = Progress(self.store.seconds(todo), self.jobs)
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            running = {pool.submit(points.measured, point): point for point in todo if point not in alone}
            try:
                for future in concurrent.futures.as_completed(running):
                    progress.finished(running[future], self.take(running[future], future.result))
                    self.advance({running[future]})
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        for point in alone:
            jobs = 1 if point.is_timed() else self.jobs
            progress.finished(point, jobs * self.take(point, lambda each=point, n=jobs: points.measured(each, n)))
            self.advance({point})

    def advance(self, measured):
        """Tables that waited for these points, or for none, go on; finished ones are written."""
        for name, table in list(self.open.items()):
            if table.missing.isdisjoint(measured) and table.missing:
                continue
            while name in self.open:
                failed = [point for point in table.missing if point in self.failed]
                if failed:
                    self.wrong.append(f"{name}: {self.failed[failed[0]]}")
                    del self.open[name]
                    break
                table.missing = {point for point in table.missing if point not in self.results}
                if table.missing:
                    break
                if table.answer(self.results):
                    del self.open[name]
                    self.finish(table.table, table.before, table.text)

    def finish(self, table, asked, text):
        self.written += 1
        if self.quick:
            return
        table.write(text)
        records.add(table, table.points(), {point: self.results[point] for point in asked})
        print(f"{table.place}: {table.name}", flush=True)

    def all(self):
        """Rounds, until no table asks for more."""
        while self.open:
            wanted = self.wanted()
            left = self.load(wanted)
            self.advance(set(wanted) - set(left))
            if left:
                self.measure(left)
        return self.wrong


def chosen(tables, names):
    if not names:
        return tables
    picked = {}
    for wanted in names:
        found = {name: table for name, table in tables.items()
                 if fnmatch.fnmatchcase(name, wanted) or table.place == wanted}
        if not found:
            sys.exit(f"measure.py: no table and no page is named {wanted}; measure.py --list has all.")
        picked |= found
    return picked


def check(picked, tables, jobs):
    """Fails with a sentence for each of the `picked` tables that is stale, and for what names no table."""
    began = time.monotonic()
    stale, untried = records.check(picked, jobs)
    stale += [f"docs/tables.json: there is no table {name} in scripts/tables" for name in records.read()["tables"]
              if name not in tables]
    stale += [f"{page}: there is no table {name} in scripts/tables" for page, name in placed_marks()
              if name not in tables or tables[name].place != page]
    for line in untried:
        print(f"not tried: {line}")
    print(f"{len(picked) - len(untried)} tables checked in {time.monotonic() - began:.0f} s")
    if stale:
        sys.exit("\n".join(stale))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="*", metavar="TABLE")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--new-key", metavar="KEY")
    parser.add_argument("--jobs", type=int, default=2, help="points at a time (default: 2)")
    parser.add_argument("--folder", default=str(points.ROOT / "out/measure"), help="results (default: out/measure)")
    options = parser.parse_args()
    everything = declared_tables()
    tables = chosen(everything, options.tables)
    if options.check:
        check(tables, everything, options.jobs)
        return
    if options.new_key:
        others = records.take_in(tables, options.new_key)
        print(f"{len(tables) - len(others)} records have {options.new_key}; as they were: {', '.join(others) or 'none'}")
        return
    if options.list:
        kept = records.read()["tables"]
        for name, table in tables.items():
            print(f"{name:32} {table.place:28} {'measured' if name in kept else 'not measured'}")
        return
    with tempfile.TemporaryDirectory(prefix="degs-measure-") as temporary:
        making = Making(tables, Store(temporary if options.quick else options.folder), options.jobs, options.quick)
        wrong = making.all()
    print(f"{making.written} of {len(tables)} tables made")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
