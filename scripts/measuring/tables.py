# SPDX-License-Identifier: Apache-2.0
"""Tables: what is declared in scripts/tables, and where it stands.

    @table("docs/others.md")
    def frame_times():
        reports = yield {design: run(design, "flowers", "--camera 2") for design in ("degs-64", "gscore-64")}
        return markdown(["design", "ms"], [[name, f"{report.latency_ms:.2f}"] for name, report in reports.items()])

A declaration yields points, or a list or dictionary of them, gets their results in the same form, and returns text. On
a page it stands below `<!-- measured: NAME -->`, up to the next empty line; any other file is all of it."""
import csv
import dataclasses
import importlib
import inspect
import io
import pathlib
import pkgutil
import typing

from .points import ROOT, Point

TABLES = {}


@dataclasses.dataclass(frozen=True)
class Table:
    """A table, a CSV file or a picture."""

    name: str
    place: str
    make: typing.Callable

    def path(self):
        return ROOT / self.place

    def points(self):
        """The points that the declaration asks for first."""
        return flat(next(self.make()))

    def text(self):
        """What stands in its place now; None if there is no place."""
        text = self.path().read_text(encoding="utf-8") if self.path().exists() else ""
        if not self.place.endswith(".md"):
            return text or None
        span = self.span(text)
        return text[slice(*span)] if span else None

    def span(self, page):
        """Where the text of the table begins and ends in its page."""
        mark = f"<!-- measured: {self.name} -->\n\n"
        if mark not in page:
            return None
        start = page.index(mark) + len(mark)
        end = page.find("\n\n", start)
        return start, len(page.rstrip("\n")) if end < 0 else end

    def write(self, text):
        """Puts a text in its place."""
        text = text.rstrip("\n")
        if not self.place.endswith(".md"):
            self.path().write_text(text + "\n", encoding="utf-8")
            return
        page = self.path().read_text(encoding="utf-8")
        span = self.span(page)
        if span is None:
            raise ValueError(f"{self.place} has no '<!-- measured: {self.name} -->' with an empty line below it.")
        if "\n\n" in text:
            raise ValueError(f"{self.name} has an empty line, which would end it in {self.place}.")
        self.path().write_text(page[:span[0]] + text + page[span[1]:], encoding="utf-8")


def table(place, name="", *arguments):
    """Declares a table by a generator function; `arguments` go to it."""
    def declared(function):
        called = name or function.__name__.replace("_", "-")
        if called in TABLES:
            raise ValueError(f"two tables are named {called}")
        if not inspect.isgeneratorfunction(function):
            raise ValueError(f"{called} yields no points")
        TABLES[called] = Table(called, place, lambda: function(*arguments))
        return function
    return declared


def declared_tables():
    """All tables by their names."""
    package = importlib.import_module("tables")
    for module in pkgutil.iter_modules(package.__path__):
        importlib.import_module(f"tables.{module.name}")
    return dict(sorted(TABLES.items(), key=lambda item: (item[1].place, item[0])))


def flat(asked):
    """The points of what a declaration yields."""
    if isinstance(asked, Point):
        return [asked]
    return [point for each in (asked.values() if isinstance(asked, dict) else asked) for point in flat(each)]


def answered(asked, results):
    """Results in the form in which they were asked for."""
    if isinstance(asked, Point):
        return results[asked]
    if isinstance(asked, dict):
        return {name: answered(each, results) for name, each in asked.items()}
    return [answered(each, results) for each in asked]


def markdown(head, rows, texts=1):
    """A Markdown table, of which the first `texts` columns are texts and the others numbers."""
    rule = ["---"] * texts + ["--:"] * (len(head) - texts)
    return "\n".join(f"| {' | '.join(str(cell) for cell in row)} |" for row in [head, rule, *rows])


def csv_text(head, rows):
    """A CSV file."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([head, *rows])
    return text.getvalue()


def placed_marks(root=ROOT):
    """(page, name) of every table that a page has a place for."""
    for page in [root / "README.md", *sorted(pathlib.Path(root, "docs").glob("*.md"))]:
        for line in page.read_text(encoding="utf-8").splitlines():
            if line.startswith("<!-- measured: "):
                yield str(page.relative_to(root)), line[len("<!-- measured: "):-len(" -->")]
