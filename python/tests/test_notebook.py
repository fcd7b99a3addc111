# SPDX-License-Identifier: Apache-2.0
"""The notebook runs as it stands, and docs/python.md shows what it answers."""

import json
import subprocess

from conftest import ROOT

NOTEBOOK = ROOT / "python/notebooks/an-architects-afternoon.ipynb"


def test_the_notebook_is_kept_without_outputs():
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    assert all(not cell["outputs"] and cell["execution_count"] is None for cell in cells if cell["cell_type"] == "code")


def test_the_notebook_answers_what_the_page_shows(tmp_path):
    subprocess.run([ROOT / "scripts/notebook.py", tmp_path], check=True)
    assert (tmp_path / "answer.txt").read_text() in (ROOT / "docs/python.md").read_text()
    shown = json.loads((tmp_path / NOTEBOOK.name).read_text())["cells"]
    outputs = [output for cell in shown for output in cell.get("outputs", [])]
    assert not [output for output in outputs if output["output_type"] == "error"]
    assert len(list(tmp_path.glob("afternoon-*.png"))) == len(list((ROOT / "docs/images").glob("afternoon-*.png"))) == 3
