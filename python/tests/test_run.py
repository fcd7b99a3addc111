# SPDX-License-Identifier: Apache-2.0
"""Runs: reports, pictures, options, mistakes, threads, and where the program is found."""

import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from inspect import signature
from pathlib import Path

import degs
import numpy
import pytest
from conftest import ROOT, SCENE
from degs import process
from degs.process import call
from PIL import Image


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """A run whose files are kept, and their folder."""
    folder = tmp_path_factory.mktemp("run")
    return degs.run("degs-64", SCENE, camera=2, width=96, out=folder), folder


def test_the_report_is_that_of_the_file(kept):
    report, folder = kept
    said = json.loads((folder / "report.json").read_text())
    assert report.to_dict() == said and report.folder == folder
    assert report.cycles == report.timing.cycles == report["timing.cycles"] == said["timing"]["cycles"]
    assert report.energy.nj_per_frame == said["energy"]["nj_per_frame"]
    assert report.losses[0].share == said["losses"][0]["share"]
    assert report.losses_frame["share"].is_monotonic_decreasing
    assert report.slots.to_series()["useful"] == said["slots"]["useful"]
    assert "energy.nj_per_frame" in report and "energy.nj" not in report
    assert {"cycles", "energy"} <= set(dir(report)) and "nj_per_frame" in dir(report.energy)
    assert repr(report).startswith("scene")


def test_the_picture_is_that_of_the_file(kept):
    report, folder = kept
    assert report.image.shape == (54, 96, 3) and report.image.dtype == numpy.uint8
    assert (report.image == numpy.asarray(Image.open(folder / "image.png").convert("RGB"))).all()
    assert report._repr_png_() == (folder / "image.png").read_bytes()
    assert '<img src="data:image/png;base64,' in report._repr_html_() and "slots" in report._repr_html_()


@pytest.mark.parametrize("path, sentence", [
    ("cycels", "'cycels' does not exist in the report, did you mean 'cycles'?"),
    ("energy.nj_per_frme", "'nj_per_frme' does not exist in 'energy', did you mean 'nj_per_frame' or 'nj_per_pixel'?"),
    ("energy.x", "'x' does not exist in 'energy'; there are: covers, total_nj"),
    ("cycles.x", "'cycles' has no parts, and so no 'x'."),
])
def test_what_is_missing_lists_near_names(kept, path, sentence):
    with pytest.raises(degs.Missing) as caught:
        kept[0][path]
    assert str(caught.value).startswith(sentence)
    with pytest.raises(AttributeError):
        kept[0].no_such_thing


def test_keys_change_the_design(kept):
    design = degs.Design("degs-64")
    for report in (degs.run(design, SCENE, width=64, keys={"span.count": 4}),
                   degs.run(design, SCENE, width=64, span={"count": 4}),
                   degs.run(design.with_({"span.count": 4}), SCENE, width=64)):
        assert report.config.span.count == 4 and report.folder is None
    assert design.changes == {}
    half = degs.run("degs-64", SCENE, camera=2, width=96, clock_ghz=0.5)
    assert half.clock_ghz == 0.5 and half.latency_ms > kept[0].latency_ms


def test_options_reach_the_program(tmp_path):
    report = degs.run("degs-64", SCENE, width=64, frames=3, reference=False, maps=tmp_path / "maps",
                      trace=tmp_path / "trace.json")
    assert report.frames == 3 and report.throughput_fps > 0 and report["image.psnr_db"] is None
    assert (tmp_path / "maps").is_dir() and (tmp_path / "trace.json").is_file()
    estimate = degs.run("degs-64", SCENE, width=64, fidelity="analytic", what_if=["span.count=4", "span.count=16"])
    assert estimate.cycles > 0 and "takes about" in repr(estimate) and "<pre>" in estimate._repr_html_()
    assert estimate.area.to_dict() == degs.run("degs-64", SCENE, width=64).area.to_dict()
    with pytest.raises(degs.Error, match="An estimate has no picture"):
        estimate.image


def test_a_workload_stands_for_a_scene(tmp_path):
    file = tmp_path / "frame.degsw"
    call(["workload", "pack", "degs-64=" + str(degs.Design("degs-64").file), "--scene", SCENE, "--width", "64", "--out",
          str(file)])
    assert degs.run("degs-64", workload=file).cycles == degs.run("degs-64", SCENE, width=64).cycles
    with pytest.raises(degs.Error, match="--scene"):
        degs.run("degs-64")


def test_every_option_of_the_program_is_an_argument():
    shown = set(re.findall(r"^  (?:-h, )?--([a-z-]+)", call(["run", "--help"]), re.MULTILINE)) - {"help"}
    spelled = {"set": "keys", "no-reference": "reference", "no-cache": "cache"}
    have = set(signature(degs.run).parameters)
    assert {spelled.get(option, option.replace("-", "_")) for option in shown} - have == {"explain"}


@pytest.mark.parametrize("arguments, sentence", [
    ({"scene": "nothing.ply"}, "nothing.ply: there is no such file."),
    ({"camera": 9}, "Camera 9 does not exist"),
    ({"width": 0}, "width"),
    ({"fidelity": "exakt"}, "exakt"),
    ({"keys": {"span.cuont": 3}}, "did you mean 'span.count'"),
    ({"widht": 64}, "key 'widht' is unknown; did you mean the argument 'width'?"),
    ({"camra": 1}, "did you mean the argument 'camera' or 'camera_file'?"),
    ({"spam": {"count": 4}}, "did you mean"),
    ({"keys": {"scheduler.reuse_cycles": 1}}, "must be at least 4 to cover array.writeback_cycles"),
])
def test_a_mistake_is_one_sentence(arguments, sentence):
    with pytest.raises(degs.Error) as caught:
        degs.run("degs-64", **{"scene": SCENE, "width": 64, **arguments})
    assert sentence in str(caught.value) and "\n" not in str(caught.value) and caught.value.code == 2
    assert caught.value.__cause__ is None and caught.value.command[0] == degs.program()


@pytest.mark.parametrize("arguments, sentence", [
    ({"width": True}, "width is True, but needs a value."),
    ({"camera": True}, "camera is True, but needs a value."),
    ({"seed": True}, "seed is True, but needs a value."),
    ({"scene": "a\0b.ply"}, "cannot hold a zero"),
    ({"keys": {"span.count": "1\0"}}, "span.count"),
    ({"camera_file": "\0"}, "cannot hold a zero"),
])
def test_what_no_command_line_holds_is_refused(arguments, sentence):
    with pytest.raises(degs.Error, match=sentence):
        degs.run("degs-64", **{"scene": SCENE, "width": 64, **arguments})


@pytest.mark.parametrize("path", [0, None, 1.5, ("timing", "cycles"), slice(2)])
def test_parts_have_names(kept, path):
    with pytest.raises(degs.Missing, match="A part has a name"):
        kept[0][path]


def test_threads_run_at_once():
    widths = [32, 48, 64, 80]
    with ThreadPoolExecutor(4) as pool:
        reports = list(pool.map(lambda width: degs.run("degs-64", SCENE, width=width), widths))
    assert [report.camera.width for report in reports] == widths
    alone = [degs.run("degs-64", SCENE, width=width).cycles for width in widths]
    assert [report.cycles for report in reports] == alone


def test_where_the_program_is(monkeypatch, tmp_path):
    real = degs.program()
    assert degs.version() == degs.__version__
    monkeypatch.setenv("DEGS_PROGRAM", str(tmp_path / "nothing"))
    with pytest.raises(degs.Error, match="DEGS_PROGRAM is '.*nothing', which is not a program."):
        degs.program()
    monkeypatch.delenv("DEGS_PROGRAM")
    for folder, package in (("bin", "share/degs/python/degs"), ("bin", "lib/python3/dist-packages/degs"),
                            ("build/asan/sim", "python/degs"), ("build/release/sim", "python/degs")):
        place = tmp_path / folder.replace("/", "-") / folder
        place.mkdir(parents=True, exist_ok=True)
        shutil.copy(real, place / "degs")
        monkeypatch.setattr(process, "HERE", tmp_path / folder.replace("/", "-") / package)
        monkeypatch.setenv("PATH", "")
        assert degs.program() == str(place / "degs")
    monkeypatch.setattr(process, "HERE", tmp_path / "a/b/c/degs")
    with pytest.raises(degs.Error, match="There is no program degs beside this package or on PATH"):
        degs.program()
    monkeypatch.setenv("PATH", str(Path(real).parent))
    assert degs.program() == real


def test_views_share_a_frame():
    eyes = degs.run("degs-64", SCENE, width=32, eyes=0.1, units_per_metre=2)
    assert eyes.views.count == 2
    assert degs.run("degs-64", SCENE, width=32, views=[0, 2, 1]).views.count == 3


def test_an_image_is_foveated():
    report = degs.run("degs-64", SCENE, width=64, foveation="0.5,0.5:5:10")
    assert [level["scale"] for level in report.foveation.images[0]["levels"]] == [1, 2, 4]
    assert report.foveation.pixels_drawn < report.foveation.pixels


def test_a_program_that_dies(monkeypatch, tmp_path):
    for script, sentence in (("kill -9 $$", "ended by the signal SIGKILL"), ("exit 3", "exit code 3"),
                             ("echo 'degs: Memory ran out.' >&2; exit 1", "^Memory ran out.$")):
        fake = tmp_path / "degs"
        fake.write_text(f"#!/bin/sh\n{script}\n")
        fake.chmod(0o755)
        monkeypatch.setenv("DEGS_PROGRAM", str(fake))
        with pytest.raises(degs.Error, match=sentence):
            call(["run"])
    fake.write_text("no program\n")
    with pytest.raises(degs.Error, match="does not start"):
        call(["run"])


@pytest.mark.skipif("DEGS_BUILD" not in os.environ, reason="needs a build folder")
def test_an_installation_is_imported_and_finds_its_program(tmp_path):
    for component in ("program", "python"):
        subprocess.run(["cmake", "--install", os.environ["DEGS_BUILD"], "--prefix", tmp_path, "--component", component],
                       check=True, stdout=subprocess.DEVNULL)
    code = f"import degs; print(degs.program(), degs.run('degs-64', {SCENE!r}, width=32).config.name)"
    environment = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(tmp_path / "share/degs/python"), "HOME": str(tmp_path)}
    said = subprocess.run([sys.executable, "-c", code], env=environment, cwd=tmp_path, check=True, text=True,
                          stdout=subprocess.PIPE)
    assert said.stdout.split() == [str(tmp_path / "bin/degs"), "degs-64"]


def test_pip_installs_the_package(tmp_path):
    shutil.copytree(ROOT / "python", tmp_path / "python", ignore=shutil.ignore_patterns("__pycache__"))
    options = ["--quiet", "--no-index", "--no-deps", "--no-build-isolation", "--target", tmp_path / "site"]
    subprocess.run([sys.executable, "-m", "pip", "install", *options, tmp_path / "python"], check=True,
                   stderr=subprocess.DEVNULL)
    environment = {"PYTHONPATH": str(tmp_path / "site"), "DEGS_PROGRAM": degs.program(), "PATH": "/usr/bin:/bin"}
    code = "import degs; print(degs.__file__, degs.Design('gbu-64').accelerator)"
    said = subprocess.run([sys.executable, "-c", code],
                          env=environment, cwd=tmp_path, check=True, text=True, stdout=subprocess.PIPE)
    assert said.stdout.split() == [str(tmp_path / "site/degs/__init__.py"), "gbu"]
    assert (tmp_path / "site/degs/py.typed").is_file()
