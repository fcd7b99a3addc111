#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""advice.py: follows the advice of `degs run`, and prints for every design, view, loss and key whether the loss falls.

    advice.py CONFIG ... --scenes SCENE ... [--cameras N ...] [--width PIXELS] [--least SHARE] [--set KEY=VALUE ...]

Every key that a run names for a loss is changed alone (or the two keys of "KEY and KEY" together), to two, four, eight
and sixteen times its value (or the same part of it), as far as the design allows. The advice holds if one of these runs
loses fewer PE-cycles to the loss than 95 % of those before and takes no more cycles. Prints a line for each case with
the two ratios of the best run, and in the end how many hold. --failures prints the others alone.

Runs DEGS_PROGRAM (default: degs of the search path, else build/release/sim/degs)."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM") or shutil.which("degs") or str(ROOT / "build/release/sim/degs")
FACTORS = (2, 4, 8, 16)
HOLDS = 0.95  # a loss has fallen below this part of it; less may be the noise of another schedule


def report_of(config, view, settings):
    """The report of a run, and None with the message of a refused one."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", config, "--scene", view[0], "--no-reference", "--out", folder]
        for option, value in zip(("--camera", "--width"), view[1:]):
            command += [option, str(value)] if value is not None else []
        for setting in settings:
            command += ["--set", setting]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            return None, run.stderr.strip()
        return json.loads((pathlib.Path(folder) / "report.json").read_text(encoding="utf-8")), ""


def moved(report, key, way, factor):
    """The setting of a key that is raised or lowered by a factor."""
    now = report["config"]
    for part in key.split("."):
        now = now[part]
    return f"{key}={max(now, 1) * factor if way == 'raise' else now // factor:.12g}"


def steps_of(advice, report):
    """Settings that the advice "raise KEY", "lower KEY and KEY" or "KEY=VALUE" can mean."""
    words = re.fullmatch(r"(raise|lower) (\S+)(?: and (\S+))?", advice)
    if not words:
        return [[advice]]
    way, key, linked = words.groups()
    if linked is None:
        return [[moved(report, key, way, factor)] for factor in FACTORS]
    return [[moved(report, key, way, factor), moved(report, linked, way, other)]
            for factor in FACTORS for other in (factor, factor * factor)]


def lost_to(report, reason):
    """Cycles of the whole array lost in the class or the time of a reason, whatever they were lost for."""
    kind = reason.split(",")[0]
    share = sum(loss["share"] for loss in report["losses"] if loss["reason"].split(",")[0] == kind)
    return share * report["timing"]["cycles"]


def follow(config, view, settings, report, loss, advice):
    """(holds, loss / loss before, cycles / cycles before) of the best step; nothing if no step is allowed."""
    best = None
    for step in steps_of(advice, report):
        after, _ = report_of(config, view, settings + step)
        if after is None:
            continue
        lost = lost_to(after, loss["reason"]) / lost_to(report, loss["reason"])
        cycles = after["timing"]["cycles"] / report["timing"]["cycles"]
        result = (lost < HOLDS and cycles <= 1, lost, cycles)
        if best is None or (result[0], -result[1]) > (best[0], -best[1]):
            best = result
    return best


def cases_of(options, config, view):
    """The lines of a design on a view, each with whether its advice holds."""
    name = f"{pathlib.Path(config).stem} · {view[0]} {view[1] if view[1] is not None else ''}".rstrip()
    report, message = report_of(config, view, options.set)
    if report is None:
        sys.exit(f"advice.py: {name}: {message}")
    cases = []
    for loss in report["losses"]:
        if loss["share"] < options.least:
            continue
        for advice in loss["keys"]:
            best = follow(config, view, options.set, report, loss, advice)
            what = "no step is allowed" if best is None else f"loss × {best[1]:.3f}, frame × {best[2]:.3f}"
            holds = best is not None and best[0]
            cases.append((holds, f"{'holds' if holds else 'FAILS'} · {name} · {loss['reason']} "
                                 f"{100 * loss['share']:.1f} % · {advice} · {what}"))
    return cases


def main():
    """Prints the cases and their number; fails if an advice does not hold and --strict is given."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("configs", nargs="+", metavar="CONFIG")
    parser.add_argument("--scenes", nargs="+", required=True, metavar="SCENE")
    parser.add_argument("--cameras", nargs="+", type=int, default=[None], metavar="N")
    parser.add_argument("--width", type=int, metavar="PIXELS")
    parser.add_argument("--least", type=float, default=0.05, metavar="SHARE", help="of smaller losses nothing is asked")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="for all designs and runs")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="designs and views at a time")
    parser.add_argument("--failures", action="store_true", help="print only advice that does not hold")
    parser.add_argument("--strict", action="store_true", help="exit with 1 if an advice does not hold")
    options = parser.parse_args()
    pairs = [(config, (scene, camera, options.width))
             for config in options.configs for scene in options.scenes for camera in options.cameras]
    held = asked = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for cases in pool.map(lambda pair: cases_of(options, *pair), pairs):
            for holds, line in cases:
                held += holds
                asked += 1
                if not (holds and options.failures):
                    print(line, flush=True)
    print(f"{held} of {asked} (design, view, loss, key) cases: the loss falls and the frame is no longer")
    sys.exit(1 if options.strict and held != asked else 0)


if __name__ == "__main__":
    main()
