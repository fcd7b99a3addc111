#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""thousand_estimates.py SCENE [CAMERA] [RESOLUTION]: a thousand estimates of one view, each of another design with 64
PEs, in one session; prints how long they take. Uses the program of build/release or DEGS_PROGRAM."""

import itertools
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
import degs  # noqa: E402

AXES = {"span.count": range(1, 21), "slicing.count": (1, 2), "memory.bandwidth_gb_per_s": (25.6, 51.2, 102.4, 204.8, 409.6),
        "packing.bytes": ("8KB", "16KB", "24KB", "32KB", "64KB")}


def main(scene, camera="2", resolution="720p"):
    """Takes the time of all estimates after the first, which makes the view."""
    designs = [dict(zip(AXES, values)) for values in itertools.product(*AXES.values())]
    design = degs.Design("degs-64")
    with degs.Session() as session, ThreadPoolExecutor(session.jobs) as pool:
        def cycles(keys):
            return session.run(design, scene, camera=int(camera), resolution=resolution, fidelity="analytic", keys=keys).cycles

        begun = time.monotonic()
        cycles({})
        first = time.monotonic()
        found = list(pool.map(cycles, designs))
        last = time.monotonic()
    print(f"{len(found)} estimates in {last - first:.1f} s, {min(found):,.0f} to {max(found):,.0f} cycles; the first one "
          f"took {first - begun:.2f} s")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
