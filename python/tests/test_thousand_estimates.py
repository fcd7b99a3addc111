# SPDX-License-Identifier: Apache-2.0
"""A thousand estimates of one view in a session."""

import degs
from conftest import estimate_times


def test_a_thousand_estimates():
    with degs.Session() as session:
        estimate_times(session, 1000)
