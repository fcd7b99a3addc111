# SPDX-License-Identifier: Apache-2.0
"""Sessions: the results and errors of single calls from one server, and what happens when something ends early."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from inspect import signature

import degs
import pytest
from conftest import ROOT, SCENE, estimate_times

ESTIMATE = {"scene": SCENE, "camera": 2, "width": 96, "fidelity": "analytic"}


@pytest.fixture
def session():
    """A session, and no process of it afterwards."""
    with degs.Session() as each:
        yield each
        server = each._process
    assert server.returncode == 0 and not children_of(server.pid)


def children_of(pid):
    """The processes that a process has begun and not buried."""
    try:
        with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as file:
            return [int(word) for word in file.read().split()]
    except FileNotFoundError:
        return []


def wait_for(what, seconds=20):
    """The first true value of `what`."""
    begun = time.monotonic()
    while not what():
        assert time.monotonic() < begun + seconds
        time.sleep(0.01)
    return what()


def without_host(report):
    """A report without what differs from run to run."""
    return {key: value for key, value in report.to_dict().items() if key != "host"}


def test_a_session_has_the_functions_of_the_module(session):
    names = set(degs.__all__) - {"Session", "Design", "Study", "program"}
    functions = {name for name in names if callable(getattr(degs, name)) and not isinstance(getattr(degs, name), type)}
    assert "run" in functions and "accuracy" in functions
    for name in functions:
        assert signature(getattr(session, name)) == signature(getattr(degs, name)), name


def test_reports_are_those_of_single_calls(session):
    for options in (ESTIMATE, {**ESTIMATE, "fidelity": None}, {**ESTIMATE, "keys": {"tile_size": 16}}):
        alone = without_host(degs.run("degs-64", **options))
        for _ in range(3):  # The second time the view is kept.
            assert without_host(session.run("degs-64", **options)) == alone
    assert (session.run("degs-64", SCENE, width=48).image == degs.run("degs-64", SCENE, width=48).image).all()


def test_other_commands_in_a_session(session):
    axes = {"span.count": [4, 8]}
    frame = session.sweep("degs-64", axes, SCENE, width=48, fidelity="analytic")
    assert frame["cycles"].tolist() == degs.sweep("degs-64", axes, SCENE, width=48, fidelity="analytic")["cycles"].tolist()
    assert session.version() == degs.version() and len(session.statistics()) == len(degs.statistics())
    assert session.compare(["degs-64", "gscore-64"], SCENE, width=32)["config"].tolist() == ["degs-64", "gscore-64"]


def test_errors_are_those_of_single_calls(session):
    for options in ({"scene": "nothing.ply"}, {"camera": 9}, {"keys": {"span.cuont": 3}}, {"fidelity": "exakt"}):
        caught = []
        for function in (degs.run, session.run):
            with pytest.raises(degs.Error) as error:
                function("degs-64", **{**ESTIMATE, **options})
            caught.append(error.value)
        alone, served = caught
        assert str(served) == str(alone) and served.code == alone.code == 2 and type(served) is type(alone)
    assert session.run("degs-64", **ESTIMATE).cycles > 0


def test_warnings_are_those_of_single_calls(session):
    keys = {"memory.model": "lpddr5", "memory.latency_ns": 30}
    with pytest.warns(degs.DegsWarning, match="'memory.latency_ns' has no effect") as caught:
        session.run("degs-64", **ESTIMATE, keys=keys)
    assert caught[0].filename == __file__


def test_threads_share_a_session(session):
    counts = [2, 3, 4, 8] * 5
    with ThreadPoolExecutor(6) as pool:
        cycles = list(pool.map(lambda count: session.run("degs-64", **ESTIMATE, span={"count": count}).cycles, counts))
    assert cycles[:4] * 5 == cycles and len(set(cycles)) > 1


def test_a_folder_is_that_of_the_caller(session, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    session.scene("generate", "object", gaussians=50, out="s.ply")
    assert (tmp_path / "s.ply").is_file()
    assert session.run("degs-16", "s.ply", width=32, out="results").folder.is_dir()
    assert (tmp_path / "results/report.json").is_file()


def test_a_file_that_changes_is_read_again(session, tmp_path):
    file = str(tmp_path / "s.ply")
    for gaussians in (50, 70, 90):
        session.scene("generate", "object", gaussians=gaussians, out=file)
        for _ in range(2):
            report = session.run("degs-16", file, width=32, fidelity="analytic")
            assert report.scene.gaussians == gaussians


def test_a_request_that_is_killed_is_an_error_of_its_call(session):
    view = {"scene": "synthetic:object,gaussians=200000", "resolution": "4k"}
    design = degs.Design("degs-64")
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(session.run, design, **view)
        os.kill(wait_for(lambda: children_of(session._process.pid))[0], signal.SIGKILL)
        with pytest.raises(degs.Error, match="signal 9") as caught:
            future.result()
    assert caught.value.code == 128 + signal.SIGKILL
    assert session.run("degs-64", **ESTIMATE).cycles > 0


def test_a_server_that_is_killed(session):
    session.run("degs-64", **ESTIMATE)
    other = degs.Session()
    other._process.kill()
    with pytest.raises(degs.Error, match="The server of the session has ended: .*SIGKILL"):
        other.run("degs-64", **ESTIMATE)
    other.close()
    with pytest.raises(degs.Error, match="The session is closed."):
        other.run("degs-64", **ESTIMATE)


def test_a_server_that_cannot_start():
    session = degs.Session(jobs=0)
    with pytest.raises(degs.Error, match="The server of the session has ended: .*--jobs"):
        session.version()


def test_what_no_line_holds(session):
    for scene, sentence in (("a\udcff.ply", "UTF-8"), ("a" * 2000000, "bytes"), ("a\0b", "cannot hold a zero")):
        with pytest.raises(degs.Error, match=sentence):
            session.run("degs-64", scene)
    assert session.version() == degs.version()


def test_an_interrupt_ends_one_call(session):
    timer = threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        session.run("degs-64", "synthetic:object,gaussians=300000", resolution="8k")
    assert not children_of(session._process.pid)
    assert session.run("degs-64", **ESTIMATE).cycles > 0


def test_a_server_ends_with_python(environment):
    code = ("import degs, os, threading, time; session = degs.Session(); "
            "threading.Thread(target=session.run, args=('degs-64', 'synthetic:object,gaussians=300000'), "
            "kwargs={'resolution': '8k'}, daemon=True).start(); print(session._process.pid, flush=True); time.sleep(60)")
    with subprocess.Popen([sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, text=True) as python:
        server = int(python.stdout.readline())
        wait_for(lambda: children_of(server))
        python.kill()
    wait_for(lambda: not os.path.exists(f"/proc/{server}"))


def test_a_session_that_nobody_has_ends_its_server():
    session = degs.Session()
    server = session._process
    assert session.version() == degs.version()
    del session
    assert server.poll() == 0


def test_fifty_estimates(session):
    estimate_times(session, 50)


def test_the_protocol_is_json_lines(environment):
    lines = [{"id": "a", "arguments": ["--version"]}, {"id": 1, "arguments": ["config", "nothing.yaml"]}]
    text = "\n".join(map(json.dumps, lines)) + "\nnonsense\n"
    said = subprocess.run([degs.program(), "serve"], input=text, stdout=subprocess.PIPE, text=True, check=True,
                          cwd=ROOT, env=environment)
    answers = [json.loads(line) for line in said.stdout.splitlines()]
    ends = {answer["id"]: answer["code"] for answer in answers if "code" in answer}
    assert ends == {"a": 0, 1: 2, None: 2}
    assert {answer["id"] for answer in answers if "said" in answer} == {1, None}
