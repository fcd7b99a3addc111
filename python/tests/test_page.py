# SPDX-License-Identifier: Apache-2.0
"""docs/python.md: its examples, as doctest runs them, and the names that it lists."""

import doctest
import re

import degs
from conftest import ROOT

PAGE = ROOT / "docs/python.md"


def test_the_examples_of_the_page():
    blocks = re.findall(r"^```pycon\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) == 5
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "docs/python.md", str(PAGE), 0)
    report: list = []
    failed, tried = doctest.DocTestRunner().run(test, out=report.append)
    assert tried > 10 and not failed, "".join(report)


def test_every_name_of_the_package_is_explained():
    page = PAGE.read_text()
    have = {name for name in dir(degs.Design) if not name.startswith("_")} - {"arguments", "options", "refusal", "file"}
    for name in have - {"changes"}:
        assert f"`{name}(" in page, name
    for name in set(degs.__all__) - {"Node", "Section", "Report", "program", "version"}:
        assert f"degs.{name}" in page, name
