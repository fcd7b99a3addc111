# SPDX-License-Identifier: Apache-2.0
"""What the tests share: the package of this source tree, the program of DEGS_PROGRAM, a small scene."""

import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
SCENE = "synthetic:object,gaussians=300"


@pytest.fixture
def environment():
    """The environment of a process that imports the package."""
    return {**os.environ, "PYTHONPATH": str(ROOT / "python")}
