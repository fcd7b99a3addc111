# SPDX-License-Identifier: Apache-2.0
"""What the tests share: the package of this source tree, the program of DEGS_PROGRAM, a small scene."""

import os
import resource
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
SCENE = "synthetic:object,gaussians=300"


MOST_S = 0.2
"""Of processors, for an estimate in a session: generous, because tests run beside each other. docs/python.md says what
was measured on an idle machine."""


def used_s(session):
    """Processor seconds of this process, of the server of a session and of its forks that have ended."""
    own = resource.getrusage(resource.RUSAGE_SELF)
    with open(f"/proc/{session._process.pid}/stat", encoding="ascii") as file:
        ticks = [int(word) for word in file.read().rsplit(")", 1)[1].split()[11:15]]
    return own.ru_utime + own.ru_stime + sum(ticks) / os.sysconf("SC_CLK_TCK")


def estimate_times(session, count):
    """Many estimates of one view, of different designs, which do not make the view each time."""
    import degs
    view = {"scene": "synthetic:object,gaussians=20000", "camera": 2, "resolution": "720p", "fidelity": "analytic"}
    design = degs.Design("degs-64")
    session.run(design, **view)
    begun = used_s(session)
    rates = [25.6 + number % 50 for number in range(count)]
    reports = [session.run(design, **view, keys={"memory.bandwidth_gb_per_s": rate}) for rate in rates]
    assert (used_s(session) - begun) / count < MOST_S
    assert len({report.cycles for report in reports}) > 10
    assert all(report.host.load_s + report.host.workload_s == 0 for report in reports[2:])


@pytest.fixture
def environment():
    """The environment of a process that imports the package."""
    return {**os.environ, "PYTHONPATH": str(ROOT / "python")}
