# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/speed.md: speed of runs against their errors, and what feedback costs in exact runs."""
from statistics import geometric_mean, median

from measuring.points import FIVE, run, speed
from measuring.tables import csv_text, markdown, table

PAGE = "docs/speed.md"
DESIGNS = ("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1")
CAMERAS = ("2", "1")  # the page shows the first
SEEDS = 10  # of each sample
COLUMNS = ("over_render", "fragments_per_s", "cycles_error", "utilization_error", "dram_error", "psnr_db")

RELAXED = {"no reuse distance": ("scheduler.reuse_cycles=1", "array.writeback_cycles=1"),
           "finished tiles seen 64 cycles late": ("monitor.latency_cycles=64",),
           "finished tiles not seen": ("monitor.cancel=false",)}


@table(PAGE)
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


def middle(runs, column):
    """The median without sign, or None if no run has the number."""
    values = [abs(run[column]) for run in runs if run[column] is not None]
    return median(values) if values else None


def speed_runs():
    """For each view, design, number set and fidelity the medians of the columns, with `runs` and `intervals`."""
    found = yield {(design, camera): speed(design, "flowers", f"--camera {camera} --seeds {SEEDS}")
                   for camera in CAMERAS for design in DESIGNS}
    groups = []
    for (design, camera), measured in found.items():
        intervals = {(each["numbers"], each["fidelity"]): each for each in measured["intervals"]}
        for key in dict.fromkeys((each["numbers"], each["fidelity"]) for each in measured["rows"]):
            runs = [each for each in measured["rows"] if (each["numbers"], each["fidelity"]) == key]
            groups.append({"camera": camera, "design": design, "numbers": key[0], "fidelity": key[1], "runs": len(runs),
                           "own": runs[0]["numbers"] == measured["rows"][-1]["numbers"],
                           "intervals": intervals.get(key, {}), **{name: middle(runs, name) for name in COLUMNS}})
    return groups


@table("docs/speed.csv", "speed-csv")
def speed_csv():
    """Every group of runs."""
    groups = yield from speed_runs()
    return csv_text(["camera", "design", "numbers", "fidelity", "runs", *COLUMNS, "sampled", "held"],
                    [[*(each[name] for name in ("camera", "design", "numbers", "fidelity", "runs")),
                      *("" if each[name] is None else f"{each[name]:.6g}" for name in COLUMNS),
                      each["intervals"].get("sampled", ""), each["intervals"].get("held", "")] for each in groups])


def is_shown(group):
    """What the page has no room for: the other camera, other number sets but for two rows of DeGS, which say what double
    and single precision cost, and `strict` of the baselines, which takes nearly the time of `exact`."""
    if group["camera"] != CAMERAS[0]:
        return False
    if group["design"].startswith("degs"):
        return group["own"] or (group["numbers"], group["fidelity"]) in (("ideal", "strict"), ("fp32", "exact"))
    return group["own"] and group["fidelity"] != "strict"


def percent(share):
    return "" if share is None else f"{100 * share:.2g}"


def held(intervals):
    """How many intervals hold the exact cycles."""
    if not intervals:
        return ""
    return f"{intervals['held']} of {intervals['sampled']}" if intervals["sampled"] else "exact instead"


@table(PAGE)
def speed_errors():
    """The groups that the page shows."""
    groups = yield from speed_runs()
    return markdown(["design", "numbers", "fidelity", "× render", "M fragments/s", "cycles, %", "utilization, %",
                     "DRAM, %", "PSNR, dB", "intervals hold"],
                    [[each["design"], each["numbers"], each["fidelity"], f"{each['over_render']:.3g}",
                      f"{each['fragments_per_s'] / 1e6:.3g}",
                      *(percent(each[name]) for name in ("cycles_error", "utilization_error", "dram_error")),
                      "" if each["psnr_db"] is None else f"{each['psnr_db']:.3g}", held(each["intervals"])]
                     for each in groups if is_shown(each)], texts=3)
