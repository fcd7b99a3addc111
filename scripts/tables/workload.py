# SPDX-License-Identifier: Apache-2.0
"""Table of docs/workload.md: how long the frame of a design takes from a scene and from a workload file."""
from measuring.points import run
from measuring.tables import markdown, table

SCENES = {"`flowers`": "flowers", "`garden-crop`": "garden-crop", "`flowers-full`": "flowers-full",
          "`landscape`, 1 M": "ply:synthetic:landscape,gaussians=1000000"}
# An estimate takes its frame as a simulation does, and is over in a moment.
ESTIMATE = "--camera 0 --no-cache --fidelity analytic"


@table("docs/workload.md")
def workload_start():
    """Seconds until the frame is there, the least of the runs, over those from the scene."""
    found = yield {name: [run("degs-64", scene, ESTIMATE + source, runs=5) for source in ("", " --packed")]
                   for name, scene in SCENES.items()}

    def least(report):
        return min(host.load_s + host.workload_s for host in report.runs)
    return markdown(["scene", "time from the file over that from the scene"],
                    [[name, f"{least(packed) / least(scene):.2f}"] for name, (scene, packed) in found.items()])
