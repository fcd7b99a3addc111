#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""notebook.py [FOLDER] [--only NAME] [--update]: runs the notebooks of python/notebooks and keeps what they show.

FOLDER (default out/notebook) gets each notebook with its outputs, as .ipynb and .html, its figures as NAME-N.png, and
what its last cell prints, as NAME.txt, which is printed, too. --update also puts the figures into docs/images and the
answers into docs/python.md. NAME is afternoon or change. The program is that of DEGS_PROGRAM, or the one of build/.
Needs Debian's jupyter-nbconvert, python3-ipykernel and python3-matplotlib, and so its Python."""

import argparse
import base64
import os
import re
from pathlib import Path

import nbformat
from nbconvert import HTMLExporter
from nbconvert.preprocessors import ExecutePreprocessor

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOKS = {"afternoon": ROOT / "python/notebooks/an-architects-afternoon.ipynb",
             "change": ROOT / "python/notebooks/what-should-i-change.ipynb"}
PAGE = ROOT / "docs/python.md"
ANSWER = r"(<!-- elsewhere: scripts/notebook.py writes this block of {} -->\n```text\n).*?(```\n)"
LIMIT_S = 600  # of a cell, on a machine that others use, too


def executed(file):
    """The notebook with its outputs. An error in a cell ends the script with that error."""
    os.environ.update({"PYTHONPATH": str(ROOT / "python"), "PYDEVD_DISABLE_FILE_VALIDATION": "1"})
    notebook = nbformat.read(file, as_version=4)
    ExecutePreprocessor(timeout=LIMIT_S, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(ROOT)}})
    return notebook


def figures_of(notebook):
    """The pictures that cells draw, but not those of reports, which have HTML, too."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if "image/png" in data and "text/html" not in data:
                yield base64.b64decode(data["image/png"])


def answer_of(notebook):
    """What the last cell prints."""
    return "".join(output["text"] for output in notebook.cells[-1]["outputs"] if output.get("name") == "stdout")


def keep(name, folder, update):
    """Runs a notebook and writes what it shows."""
    notebook = executed(NOTEBOOKS[name])
    file = folder / NOTEBOOKS[name].name
    nbformat.write(notebook, file)
    file.with_suffix(".html").write_text(HTMLExporter().from_notebook_node(notebook)[0])
    for number, picture in enumerate(figures_of(notebook), 1):
        for place in [folder, *([ROOT / "docs/images"] if update else [])]:
            (place / f"{name}-{number}.png").write_bytes(picture)
    answer = answer_of(notebook)
    (folder / f"{name}.txt").write_text(answer)
    if update:
        block = re.compile(ANSWER.format(name), re.DOTALL)
        PAGE.write_text(block.sub(lambda found: found[1] + answer + found[2], PAGE.read_text()))
    print(answer, end="")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "out/notebook")
    parser.add_argument("--only", choices=list(NOTEBOOKS), help="run this notebook alone")
    parser.add_argument("--update", action="store_true", help="write docs/images and docs/python.md, too")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for name in [options.only] if options.only else NOTEBOOKS:
        keep(name, options.folder, options.update)


if __name__ == "__main__":
    main()
