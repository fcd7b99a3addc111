# SPDX-License-Identifier: Apache-2.0
"""Table of docs/timeline.md: what a timeline and maps cost."""
from statistics import median

from measuring.points import run
from measuring.tables import markdown, table

DESIGNS = ("degs-64", "degs-64-tuned", "gscore-64", "gbu-64", "gcc-64")
OUTPUTS = {"--trace": " --trace {out}/trace.json", "--maps": " --maps {out}/maps"}


def processor_s(report):
    """Of all threads: the median of the runs, because the smallest of four differs by a fifth from time to time."""
    return median(host.processor_s for host in report.runs)


@table("docs/timeline.md")
def trace_cost():
    """Processor time over that of a run without; the least and the most of the designs."""
    found = yield {design: {name: run(design, "flowers", f"--camera 2 --no-cache{output}", runs=4)
                            for name, output in {"": "", **OUTPUTS}.items()} for design in DESIGNS}
    rows = []
    for name in OUTPUTS:
        ratios = {design: processor_s(reports[name]) / processor_s(reports[""]) for design, reports in found.items()}
        rows.append([f"`{name}`", *(f"{ratios[design]:.2f} ({design})"
                                    for design in (min(ratios, key=ratios.get), max(ratios, key=ratios.get)))])
    return markdown(["", "least", "most"], rows)
