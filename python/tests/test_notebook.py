# SPDX-License-Identifier: Apache-2.0
"""The notebooks run as they stand, are typed, and docs/python.md shows what they answer."""

import json
import subprocess

import pytest
from conftest import ROOT

FOLDER = ROOT / "python/notebooks"
NOTEBOOKS = {"afternoon": ("an-architects-afternoon", 3), "change": ("what-should-i-change", 4)}


def cells_of(file):
    return json.loads(file.read_text())["cells"]


def test_every_notebook_is_tried():
    assert {file.stem for file in FOLDER.glob("*.ipynb")} == {name for name, _ in NOTEBOOKS.values()}


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_is_kept_without_outputs(name):
    cells = cells_of(FOLDER / f"{NOTEBOOKS[name][0]}.ipynb")
    assert all(not cell["outputs"] and cell["execution_count"] is None for cell in cells if cell["cell_type"] == "code")


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_is_typed(name, tmp_path, environment):
    cells = cells_of(FOLDER / f"{NOTEBOOKS[name][0]}.ipynb")
    script = tmp_path / "cells.py"
    script.write_text("\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code") + "\n")
    said = subprocess.run(["mypy", "--strict", "--config-file", ROOT / "python/pyproject.toml", "--cache-dir", tmp_path, script],
                          env={**environment, "MYPYPATH": environment["PYTHONPATH"]}, capture_output=True, text=True)
    assert said.returncode == 0, said.stdout


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_answers_what_the_page_shows(name, tmp_path):
    subprocess.run([ROOT / "scripts/notebook.py", tmp_path, "--only", name], check=True)
    assert (tmp_path / f"{name}.txt").read_text() in (ROOT / "docs/python.md").read_text()
    file, figures = NOTEBOOKS[name]
    outputs = [output for cell in cells_of(tmp_path / f"{file}.ipynb") for output in cell.get("outputs", [])]
    assert not [output for output in outputs if output["output_type"] == "error"]
    assert len(list(tmp_path.glob(f"{name}-*.png"))) == figures
    assert len(list((ROOT / "docs/images").glob(f"{name}-*.png"))) == figures
