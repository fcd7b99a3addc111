# SPDX-License-Identifier: Apache-2.0
"""Drives the program `degs` from Python: runs with their pictures, designs whose keys complete, studies as data frames.

    import degs
    report = degs.run("degs-64", "synthetic:object,gaussians=2000", camera=2, width=320)
    report.cycles, report.energy.nj_per_frame, report.image.shape

Each call is a process of its own, or with `degs.Session` a request to one server. docs/python.md is the tour."""

from .commands import accuracy, memory, motion, scene, soc, workload
from .design import Design, Section
from .process import DegsWarning, Error, Missing, program, version
from .report import Node, Report, run
from .session import Session
from .studies import Study, bandwidth, buffers, compare, gains, results, statistics, sweep

__all__ = ["Design", "DegsWarning", "Error", "Missing", "Node", "Report", "Section", "Session", "Study", "accuracy",
           "bandwidth", "buffers", "compare", "gains", "memory", "motion", "program", "results", "run", "scene", "soc",
           "statistics", "sweep", "version", "workload"]
__version__ = "0.1.0"

for _each in (DegsWarning, Error, Missing):
    _each.__module__ = __name__  # Messages show the names that users import.
