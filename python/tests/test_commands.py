# SPDX-License-Identifier: Apache-2.0
"""The other commands as functions: reports, tables, and every option of the program as an argument."""

import json
import re
from inspect import signature

import degs
import numpy
import pytest
from conftest import SCENE
from degs.process import call

SPELLED = {"set": "keys", "no-reference": "reference", "no-cache": "cache", "no-curve": "curve",
           "no-error-images": "error_images"}


def options_of(*commands):
    """The options of commands, as arguments."""
    shown = set()
    for command in commands:
        shown |= set(re.findall(r"^  (?:-h, )?--([a-z-]+)", call([*command.split(), "--help"]), re.MULTILINE))
    return {SPELLED.get(option, option.replace("-", "_")) for option in shown} - {"help", "json"}


@pytest.mark.parametrize("function, commands", [
    (degs.memory, ["memory"]), (degs.soc, ["soc"]), (degs.motion, ["motion"]), (degs.accuracy, ["accuracy"]),
    (degs.scene, [f"scene {action}" for action in ("info", "cameras", "generate", "convert", "tile")]),
    (degs.workload, ["workload export", "workload pack"]),
])
def test_every_option_of_the_program_is_an_argument(function, commands):
    assert options_of(*commands) <= set(signature(function).parameters)


def test_memory(tmp_path):
    report = degs.memory("lpddr5-6400x128", requests=2000, reads_per_write=3, keys={"name": "mine"}, out=tmp_path)
    assert report.to_dict() == json.loads((tmp_path / "memory.json").read_text()) and report.folder == tmp_path
    assert report.traffic.reads_per_write == 3 and report.config.name == "mine" and "GB/s" in repr(report)
    assert report.table["offered_fraction"].is_monotonic_increasing and (report.table["latency_ns.mean"] > 0).all()
    assert degs.memory("lpddr5-6400x128", requests=1000, curve=False).table.empty
    with pytest.raises(degs.Error, match="did you mean 'lpddr5-6400x128'"):
        degs.memory("lpddr5-6400x129")
    with pytest.raises(degs.Error, match="--requests"):
        degs.memory("lpddr5-6400x128", requests=1)


def test_soc():
    report = degs.soc("degs-16", SCENE, width=32, load=[0, 20], refresh=0, memory="lpddr5-6400x128", clock_ghz=0.5)
    assert report.table["offered_gb_per_s"].tolist() == [0, 20] and report.config.clock_ghz == 0.5
    assert report.points[1].latency_ns >= report.points[0].latency_ns and report.memory.name == "lpddr5-6400x128"
    with pytest.raises(degs.Error, match="did you mean the argument 'camera'"):
        degs.soc("degs-16", SCENE, camra=1)
    with pytest.raises(degs.Error, match="only those of degs.run"):
        report.image


def test_scene(tmp_path):
    report = degs.scene("info", SCENE, camera=1, width=64)
    assert report.scene.gaussians == 300 and report.view.visible > 0 and report.view.camera.width == 64
    assert len(report.table) == len(report.cameras) == len(degs.scene("cameras", SCENE).cameras)
    file = tmp_path / "s.ply"
    assert degs.scene("generate", "object", gaussians=50, seed=3, out=file).file == str(file)
    degs.scene("convert", SCENE, out=tmp_path / "s.glb")
    assert degs.scene("info", tmp_path / "s.glb").scene.gaussians == 300
    degs.scene("tile", file, copies="2x1", out=tmp_path / "t.glb")
    assert degs.scene("info", tmp_path / "t.glb").scene.gaussians == 100
    cameras = degs.scene("cameras", file, out=tmp_path / "c.json")
    assert json.loads((tmp_path / "c.json").read_text()) == cameras.to_dict()["cameras"]
    for action, options in (("inform", {}), ("info", {"copies": "2x1"}), ("info", {"out": "x"}), ("convert", {})):
        with pytest.raises(degs.Error):
            degs.scene(action, SCENE, **options)


def test_workload(tmp_path):
    design = degs.Design("degs-16").with_({"tile_size": 16})
    report = degs.workload("export", design, SCENE, width=48)
    assert report.tiles.size_px == 16 and len(report.tables["lists"]) == report.files[0].records
    assert len(report.tables["rows"]) == report.files[1].records
    file = tmp_path / "frame.degsw"
    packed = degs.workload("pack", [design, "gscore-16"], SCENE, width=48, reference=False, out=file)
    assert packed.file == str(file) and "frames" in packed.printed
    assert degs.workload("export", design, workload=file).tiles.to_dict() == report.tiles.to_dict()
    with pytest.raises(degs.Error, match="one design"):
        degs.workload("export", [design, "gscore-16"], SCENE)


def test_motion():
    designs = {"small": "degs-16", "wide": degs.Design("degs-64").with_({"span.count": 4})}
    report = degs.motion(designs, SCENE, width=32, between=2, frames=4, rates=[90, 60], fidelity="analytic", progress=False)
    assert report.frames == 4 and report.fidelity == "analytic"
    assert report.table[["design", "hz"]].values.tolist() == [["small", 90], ["small", 60], ["wide", 90], ["wide", 60]]
    frames = report.tables["frames"]
    assert frames["wide.latency_ms"].max() == pytest.approx(report.designs[1].latency_ms.worst)
    eyes = degs.motion("degs-16", SCENE, width=32, frames=2, eyes=0.1, keys={"span.count": 2})
    assert eyes.eyes_m == 0.1 and len(eyes.table) == 3


def test_accuracy(tmp_path):
    report = degs.accuracy(SCENE, numbers=["ideal", "paper"], width=48, out=tmp_path)
    assert report.to_dict()["rows"] == json.loads((tmp_path / "accuracy.json").read_text())
    assert report.table["numbers"].tolist() == ["ideal", "paper"] and report.rows[0].identical
    single = degs.accuracy(single_gaussian=True, numbers="fp16", splats=20)
    assert (single.table["gaussians"] == 20).all()
    hard = degs.accuracy(hard_cases=True, only="H5", numbers="fp32")
    assert hard.cases[0].case == "H5" and hard.table["case"].tolist() == ["H5"]
    speed = degs.accuracy(SCENE, speed="degs-16", width=32, fidelities="exact,analytic", numbers="paper")
    assert set(speed.table["fidelity"]) == {"exact", "analytic"} and speed.view.width == 32


def test_accuracy_by_the_rules_and_views_of_runs():
    def rows(**options):
        return degs.accuracy(SCENE, numbers="paper", error_images=False, **{"width": 48, **options}).table

    plain = rows()
    for options in ({"rules": "khr"}, {"order": "distance", "cut": 9}, {"low_pass": 1}, {"antialiasing": "on"}):
        assert rows(**options)["alpha_error_mean"][0] != plain["alpha_error_mean"][0], options
    assert rows(rules="khr").equals(rows(order="distance", cut=9))
    assert rows(crop="8,8,16x12")["resolution"].tolist() == ["16x12"]
    assert rows(width=None, resolution=["40x30", "720p"])["resolution"].tolist() == ["40x30", "960x720"]
    eyes = rows(eyes=0.1, units_per_metre=2)
    assert eyes["eye"].tolist() == ["left", "right"] and eyes["max_abs_error"].nunique() == 2
    views = rows(views=[0, 2])
    assert views["camera"].tolist() == [0, 2]
    assert views["psnr_db"].tolist() == [rows(camera=camera)["psnr_db"][0] for camera in (0, 2)]
    assert numpy.isfinite(views["psnr_db"]).all()
    with pytest.raises(degs.Error, match="hard"):
        degs.accuracy(hard_cases=True, crop="0,0,8x8")
