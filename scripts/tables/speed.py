# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/speed.md: what feedback costs in exact runs."""
from statistics import geometric_mean

from measuring.points import FIVE, run
from measuring.tables import markdown, table

RELAXED = {"no reuse distance": ("scheduler.reuse_cycles=1", "array.writeback_cycles=1"),
           "finished tiles seen 64 cycles late": ("monitor.latency_cycles=64",),
           "finished tiles not seen": ("monitor.cancel=false",)}


@table("docs/speed.md")
def speed_relaxed():
    """Error of the cycles, smallest and largest of the views, and host time over that of the design as it is: the
    geometric mean, because times of single views differ more from run to run than with what is left out."""
    def least(report):
        return min(host.sim_s for host in report.runs)
    found = yield {name: [run("degs-64", scene, "--camera 2", "pipeline.numbers=fp32", *keys, runs=3)
                          for scene in FIVE] for name, keys in {"plain": (), **RELAXED}.items()}
    rows = []
    for name in RELAXED:
        pairs = list(zip(found[name], found["plain"]))
        errors = [100 * (report.cycles / plain.cycles - 1) for report, plain in pairs]
        times = [least(report) / least(plain) for report, plain in pairs]
        rows.append([name, f"{min(errors):+.1f} to {max(errors):+.1f}", f"{geometric_mean(times):.2f}"])
    return markdown(["left out", "cycles, %", "host time"], rows)
