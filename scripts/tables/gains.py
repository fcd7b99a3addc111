# SPDX-License-Identifier: Apache-2.0
"""Table of docs/timeline.md: what the changes that `losses` names would gain, against runs of the changed designs."""
from statistics import median

from measuring.points import FIVE, run
from measuring.tables import csv_text, markdown, table

DESIGNS = ("degs-64", "degs-256", "degs-64-tuned", "gscore-64", "gscore-256", "gbu-64", "gcc-64", "gcc-256", "orange-o1")
# A design that its memory limits stands beside the same design as it is shipped.
DESIGNS_FED_LESS = {("gscore-64", "25.6"), ("degs-64", "25.6")}
VIEW = "--camera 2 --resolution 720p"


def designs():
    return [*((name, ()) for name in DESIGNS),
            *((name, (f"memory.bandwidth_gb_per_s={rate}",)) for name, rate in sorted(DESIGNS_FED_LESS))]


def pairs():
    """[design, changed keys, scene, change, gain that was named, gain of a run, interval], in %."""
    before = yield {(name, keys, scene): run(name, scene, VIEW, *keys) for name, keys in designs() for scene in FIVE}
    named = {(*view, each["change"]): each for view, report in before.items() if "gains" in report
             for each in report["gains"]}
    after = yield {(name, keys, scene, change): run(name, scene, VIEW, *keys, *change.split(","))
                   for name, keys, scene, change in named}
    return [[*key[:3], key[3], 100 * each["gain"], 100 * (1 - after[key].cycles / before[key[:3]].cycles),
             [100 * end for end in each["interval"]]] for key, each in named.items()]


@table("docs/loss-gains.csv")
def loss_gains_csv():
    found = yield from pairs()
    return csv_text(["design", "keys", "scene", "change", "named_percent", "measured_percent"],
                    [[name, " ".join(keys), scene, change, f"{named:.2f}", f"{real:.2f}"]
                     for name, keys, scene, change, named, real, _ in found])


@table("docs/timeline.md")
def loss_gains():
    """How far the gains lie from those of runs, by design; the worst is named."""
    found = yield from pairs()
    rows = []
    for name, keys in designs():
        own = [row for row in found if row[:2] == [name, keys]]
        if not own:  # a tiny view may lose nothing that a key moves
            rows.append([" ".join([name, *keys]), "", 0, 0, ""])
            continue
        worst = max(own, key=lambda row: abs(row[4] - row[5]))
        rows.append([" ".join([name, *keys]), f"{worst[4]:.1f} for {worst[5]:.1f}: `{worst[3]}`, {worst[2]}",
                     len(own), sum(abs(row[4] - row[5]) <= 2 for row in own),
                     f"{median(abs(row[4] - row[5]) for row in own):.2f}"])
    errors = [abs(row[4] - row[5]) for row in found]
    rows.append(["all", "", len(found), sum(error <= 2 for error in errors),
                 f"{median(errors):.2f}" if errors else ""])
    return markdown(["design", "worst, named for measured, %", "changes", "within 2 points", "median error, points"],
                    rows, texts=2)
