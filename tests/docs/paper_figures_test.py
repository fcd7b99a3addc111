#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""paper_figures_test.py: what scripts/paper_figures.py writes for a comparison of two designs on many views."""
import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts/paper_figures.py"
SLOTS = ("useful", "boundary", "terminated", "conflict", "ports", "padding", "starved", "blocked", "drain")


def comparison(designs, views):
    runs = []
    for v in range(views):
        for d in range(designs):
            ratio = {"latency": 1 + d * (v + 1), "throughput": None, "energy": 1}
            ratio["latency_per_mm2"] = 2 * ratio["latency"]
            runs.append({"config": f"design {d}", "view": v, "ratio": ratio,
                         "slots": {s: 0.5 if s in ("useful", "drain") else 0 for s in SLOTS}})
    return {"configs": [{"name": f"design {d}"} for d in range(designs)], "runs": runs,
            "views": [{"scene": f"scene {v}", "camera": 0, "width": 64, "height": 48} for v in range(views)]}


def figures(folder, results, *options):
    (folder / "compare.json").write_text(json.dumps(results), encoding="utf-8")
    return subprocess.run([sys.executable, str(SCRIPT), str(folder), *options], capture_output=True, text=True)


def check(folder, options, millimetres, means):
    run = figures(folder, comparison(2, 3), *options)
    assert run.returncode == 0, run.stderr
    command = f"scripts/paper_figures.py {folder} {' '.join(options)}".strip()
    for name in ("ratios", "slots"):
        file = folder / "figures" / name
        svg, pdf = file.with_suffix(".svg").read_text(), file.with_suffix(".pdf").read_bytes().decode("latin-1")
        points = float(re.search(r'<svg [^>]*width="([0-9.]+)pt"', svg, re.S).group(1))
        assert abs(points / 72 * 25.4 - millimetres) < 0.1, (name, points)
        box = re.search(r"/MediaBox \[ 0 0 ([0-9.]+) ", pdf)
        assert abs(float(box.group(1)) - points) < 0.1, box.group(0)
        assert f"<desc>{command}</desc>" in svg and command in pdf, name
        assert file.with_suffix(".csv").read_text().startswith(f"# {command}\n"), name
    with open(folder / "figures/ratios.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    assert {row[0] for row in rows[1:]} == ({"speed", "frames per joule"} if len(options) == 0 else {"speed"}), rows
    mean = [row for row in rows if row[:2] == ["speed", "geometric mean"]][0]
    assert all(abs(float(a) - b) < 1e-9 for a, b in zip(mean[2:], means)), mean


def main():
    cube = (2 * 3 * 4) ** (1 / 3)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check(folder, [], 85, [1, cube])
        check(folder, ["--width", "page", "--equal-area"], 178, [2, 2 * cube])
        run = figures(folder, comparison(40, 1))
        assert run.returncode == 1 and "40 designs are too many" in run.stderr, run.stderr
        (folder / "compare.json").unlink()
        run = subprocess.run([sys.executable, str(SCRIPT), name], capture_output=True, text=True)
        assert run.returncode == 1 and "neither compare.json nor results.json" in run.stderr, run.stderr


if __name__ == "__main__":
    main()
