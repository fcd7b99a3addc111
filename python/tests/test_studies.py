# SPDX-License-Identifier: Apache-2.0
"""Studies: frames with the numbers of the program's tables, folders that go on, progress, mistakes."""

import csv
import os
import signal
import subprocess
import sys
import time

import degs
import numpy
import pytest
from conftest import ROOT, SCENE

AXES = {"span.count": numpy.array([4, 8]), "packing.bytes": "8KB..16KB x2"}


def test_a_sweep_is_its_table(tmp_path):
    frame = degs.sweep("degs-64", AXES, SCENE, cameras=[0, 2], width=48, jobs=2, out=tmp_path / "out")
    with (tmp_path / "out/results.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert list(frame.columns) == list(rows[0]) and len(frame) == len(rows) == 10  # with the baseline
    assert [int(row["cycles"]) for row in rows] == frame["cycles"].tolist()
    assert [float(row["energy.nj_per_frame"]) for row in rows] == frame["energy.nj_per_frame"].tolist()
    assert frame["span.count"].dtype == numpy.int64 and frame["latency_ms"].dtype == numpy.float64
    assert frame["throughput_fps"].isna().all() and set(frame["limited_by"]) <= {"blending", "memory", "span"}
    units = frame.attrs["units"]
    assert units["cycles"] == "cycles" and units["energy.nj_per_frame"] == "nJ" and units["width"] == "px"
    assert units["stages.span.busy"] == "share"
    assert frame.attrs["meanings"]["packing.bytes"].startswith("bytes")
    assert frame.attrs["keys"] == ["span.count", "packing.bytes"] and frame.attrs["skipped"] == []


def test_points_agree_with_runs():
    design = degs.Design("degs-64").with_({"slicing.count": 1})
    frame = degs.sweep(design, {"span.count": [4]}, SCENE, cameras=2, width=48)
    row = frame[frame["span.count"] == 4].iloc[0]
    report = degs.run(design, SCENE, camera=2, width=48, span={"count": 4})
    assert row["cycles"] == report.cycles
    assert row["energy.nj_per_frame"] == pytest.approx(report.energy.nj_per_frame, rel=1e-14)  # Tables have 15 digits.


def test_views_of_a_frame():
    views = degs.sweep("degs-16", {}, SCENE, width=32, views=[0, 1], crop="0,0,24x16")
    assert views["cycles"].iloc[0] == degs.run("degs-16", SCENE, width=32, views=[0, 1], crop="0,0,24x16").cycles
    eyes = degs.compare("degs-16", SCENE, width=32, eyes=0.1, units_per_metre=2)
    assert eyes["cycles"].iloc[0] == degs.run("degs-16", SCENE, width=32, eyes=0.2).cycles
    others = degs.compare("degs-16", SCENE, width=32, views=[2, 1])
    assert others["cycles"].iloc[0] == degs.run("degs-16", SCENE, width=32, views=[2, 1]).cycles


def test_designs_that_cannot_be_built_are_listed():
    frame = degs.sweep("degs-64", {"scheduler.reuse_cycles": [1, 5]}, SCENE, width=32)
    assert frame["scheduler.reuse_cycles"].tolist() == [degs.Design("degs-64").scheduler.reuse_cycles, 5]
    assert "must be at least 4" in frame.attrs["skipped"][0]["why"]


def test_number_files_are_relative_to_the_current_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fine.yaml").write_text("base: tuned\nalpha: uq0.20\n", encoding="utf-8")
    design = degs.Design("degs-64").with_({"pipeline.numbers": "fine.yaml"})
    assert design.pipeline.numbers == "tuned:alpha=uq0.20"
    values = ["tuned", "./fine.yaml:alpha=uq0.18"]
    axes = ({"pipeline.numbers": values}, {"both": {"keys": {"pipeline.numbers": values, "span.count": [4, 8]}}})
    for varied in axes:
        frame = degs.sweep(design, varied, SCENE, width=32, reference=False)
        assert frame.attrs["skipped"] == [] and len(frame) == 3
        assert frame["pipeline.numbers"].iloc[0] == "tuned:alpha=uq0.20"


def test_several_designs_and_names():
    frame = degs.compare(["degs-64", degs.Design("degs-64").with_({"span.count": 16}), "gscore-64"], SCENE, width=48,
                         camera=[0, 2])
    assert frame["config"].tolist() == ["degs-64", "degs-64-2", "gscore-64"] * 2
    assert frame["ratio.latency"].iloc[0] == 1 and frame.attrs["units"]["area_mm2"] == "mm2"
    named = degs.compare({"small": "degs-16", "large": "degs-64"}, SCENE, width=48, fidelity="analytic")
    assert named["config"].tolist() == ["small", "large"] and set(named["fidelity"]) == {"analytic"}


def test_studies_of_files_and_mappings(tmp_path, monkeypatch):
    shipped = degs.Study(ROOT / "configs/studies/ablation.yaml")
    compared = shipped.compare(quick=True, width=48)
    assert len(compared) >= 2 and "study: ablation" in shipped.yaml()
    swept = shipped.sweep(quick=True, width=48, reference=False, keys={"memory.bandwidth_gb_per_s": 102.4})
    assert swept["image.psnr_db"].isna().all()
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_text(degs.Design("degs-16").yaml().replace('"degs-16"', '"mine"'))
    subprocess.run([degs.program(), "scene", "generate", "object", "--gaussians", "100", "--out", "s.ply"], check=True,
                   stdout=subprocess.DEVNULL)
    study = degs.Study({"designs": ["mine.yaml", "degs-64"], "scenes": "s.ply", "cameras": 0, "width": 32})
    assert study.sweep()["design"].tolist() == ["mine", "degs-64"]
    assert len(study.points()) == 2


def test_a_search_keeps_limits(tmp_path):
    study = degs.Study({"designs": "degs-64", "axes": {"span.count": [4, 8, 16], "slicing.count": [1, 2]},
                        "scenes": SCENE, "cameras": 2, "width": 64, "reference": False})
    front = study.explore(["area_mm2", "latency_ms"], "area_mm2<=2.7", jobs=2)
    best = front[front["on_front"]]
    assert len(best) and (best["area_mm2"] <= 2.7).all() and front["baseline"].sum() == 1
    assert (front[front["area_mm2"] > 2.7]["within"] != "yes").all()
    assert front.attrs["goals"] == ["area_mm2", "latency_ms"] and front.attrs["better"] == ["smaller", "smaller"]
    assert front.attrs["units"]["latency_ms"] == "ms" and front.attrs["correlations"] is None
    few = study.explore(["area_mm2", "latency_ms"], budget=4, jobs=2)
    assert len(few) == 4 and few.attrs["correlations"]["area_mm2"] > 0.9


@pytest.mark.parametrize("study, sentence", [
    ({"axes": {"span.cuont": [1]}}, "span.cuont"),
    ({"axes": {"packing.bytes": "8XB..16XB x2"}}, "XB"),
    ({"scenes": "nothing.ply"}, "nothing.ply: there is no such file."),
    ({"designs": "degs-46"}, "did you mean 'degs-64'"),
    ({"no_such_key": 1}, "no_such_key"),
])
def test_a_mistake_is_one_sentence(study, sentence):
    with pytest.raises(degs.Error) as caught:
        degs.Study({"designs": "degs-64", "scenes": SCENE, "width": 32, **study}).sweep()
    assert sentence in str(caught.value) and "\n" not in str(caught.value)


def test_a_study_that_does_not_exist():
    for call in (degs.Study("nothing.yaml").sweep, degs.Study("nothing.yaml").yaml):
        with pytest.raises(degs.Error, match="nothing.yaml"):
            call()


def test_progress_is_a_bar_or_nothing(capfd):
    degs.sweep("degs-64", {"span.count": [4, 8]}, SCENE, width=32, progress=True)
    assert "2/2" in capfd.readouterr().err
    degs.sweep("degs-64", {"span.count": [4, 8]}, SCENE, width=32, progress=False)
    assert capfd.readouterr().err == ""


def test_progress_without_tqdm(capfd, monkeypatch):
    monkeypatch.setattr("degs.process.tqdm", lambda: None)
    degs.sweep("degs-64", {"span.count": [4, 8]}, SCENE, width=32, progress=True)
    assert "2 of 2 points done" in capfd.readouterr().err


SLOW = """
import degs
degs.sweep("degs-64", {"memory.bandwidth_gb_per_s": list(range(50, 62))}, "synthetic:object,gaussians=1000", width=240,
           jobs=1, out="out", reference=False)
"""


@pytest.mark.parametrize("how, whole", [(signal.SIGKILL, True), (signal.SIGKILL, False), (signal.SIGINT, False)])
def test_a_killed_sweep_goes_on(tmp_path, environment, how, whole):
    """Kills Python and the program, or Python alone, and counts the points that the next call still runs."""
    process = subprocess.Popen([sys.executable, "-c", SLOW], cwd=tmp_path, env=environment, start_new_session=True,
                               stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 30
    while len(list(tmp_path.glob("out/points/*.point"))) < 3:
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.01)
    (os.killpg if whole else os.kill)(process.pid, how)
    process.communicate()
    wait_for_the_end_of(process.pid)
    kept = {file: file.stat().st_mtime_ns for file in tmp_path.glob("out/points/*.point")}
    assert 3 <= len(kept) < 13
    frame = degs.sweep("degs-64", {"memory.bandwidth_gb_per_s": list(range(50, 62))}, "synthetic:object,gaussians=1000",
                       width=240, jobs=2, out=tmp_path / "out", reference=False)
    assert len(frame) == 13 and all(file.stat().st_mtime_ns == date for file, date in kept.items())


def wait_for_the_end_of(session):
    """The program notices that nobody reads what it says and ends with the next point."""
    deadline = time.monotonic() + 20
    while subprocess.run(["pgrep", "-s", str(session)], stdout=subprocess.DEVNULL).returncode == 0:
        assert time.monotonic() < deadline, "the program goes on without Python"
        time.sleep(0.02)


def test_points_that_did_finish_are_in_the_error(tmp_path, monkeypatch):
    real = degs.program()
    fake = tmp_path / "degs"
    fake.write_text(f'#!/bin/sh\n"{real}" "$@" || exit\n'
                    "case $1 in sweep|compare) echo \"degs $1: One point failed.\" >&2; exit 1;; esac\n")
    fake.chmod(0o755)
    design = degs.Design("degs-64").file
    monkeypatch.setenv("DEGS_PROGRAM", str(fake))
    for call in (lambda: degs.sweep(design, {"span.count": [4, 16]}, SCENE, width=32),
                 lambda: degs.compare([design, design, design], SCENE, width=32)):
        with pytest.raises(degs.Error, match="^One point failed.$") as caught:
            call()
        assert caught.value.code == 1 and len(caught.value.results) == 3
    monkeypatch.setenv("DEGS_PROGRAM", real)
    with pytest.raises(degs.Error) as caught:
        degs.sweep("degs-64", {"span.count": [4]}, "nothing.ply")
    assert caught.value.results is None


def test_bandwidth_and_buffers(tmp_path):
    found = degs.bandwidth(["degs-16", "gscore-16"], SCENE, camera=1, width=64, progress=False, out=tmp_path)
    assert found["design"].tolist() == ["degs-16", "gscore-16"] and (tmp_path / "bandwidth.json").exists()
    limited = found[found["gb_per_s"].notna()]
    assert ((limited["low_gb_per_s"] <= limited["gb_per_s"]) & (limited["gb_per_s"] <= limited["high_gb_per_s"])).all()
    fitted = degs.buffers("degs-16", SCENE, 5, camera=1, width=64, progress=False)
    assert (fitted["smallest_bytes"] <= fitted["bytes"]).all() and fitted.attrs["loss"] <= 0.05
    smaller = degs.Design("degs-16").with_(fitted.attrs["settings"])
    assert smaller["packing.bytes"] == fitted.set_index("key").loc["packing.bytes", "smallest_bytes"]
    assert fitted["bytes"].dtype == numpy.int64


def test_gains_stand_beside_runs_of_the_changes():
    design = degs.Design("degs-64").with_({"memory.bandwidth_gb_per_s": 12.8})
    found = degs.gains(design, SCENE, camera=2, width=160, progress=False)
    report = degs.run(design, SCENE, camera=2, width=160, reference=False)
    assert found["change"].tolist() == [each.change for each in report.gains] and len(found) == 3
    assert found["gain"].tolist() == [each.gain for each in report.gains] and found.attrs["cycles"] == report.cycles
    first = found.iloc[0]
    assert first["change"] == "memory.bandwidth_gb_per_s=25.6" and first["low"] < first["gain"] < first["high"]
    faster = degs.run(design, SCENE, camera=2, width=160, reference=False, keys={"memory.bandwidth_gb_per_s": 25.6})
    assert first["measured"] * report.cycles == pytest.approx(report.cycles - faster.cycles) and first["measured"] > 0.1
    assert degs.gains("degs-64", SCENE, camera=2, width=160, fidelity="analytic", progress=False).empty


def test_results_of_a_folder(tmp_path):
    degs.bandwidth("degs-16", SCENE, camera=1, width=64, progress=False, out=tmp_path)
    runs = degs.results(tmp_path)
    assert runs["memory.bandwidth_gb_per_s"].nunique() == len(runs) > 1 and runs.attrs["units"]["cycles"] == "cycles"
    with pytest.raises(degs.Error, match="There are no results in the folder"):
        degs.results(tmp_path / "reports")
