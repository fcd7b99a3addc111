#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""times.py LOG [LIMITS]: compares the log of tests/run.sh with the ceilings of tests/house/times.csv.

The log (build/times.csv) has a line for each step: its seconds, the seconds of a processor that it used (user + sys),
the mean number of processors that others used meanwhile, and the number of processors. The ceilings hold for two idle
processors and without a compiler cache. Where a step had others beside it, or another number of processors, the script
says that it cannot judge. It fails if a step that it can judge is above its ceiling, has none, or is missing.
"""
import csv
import sys
from pathlib import Path

PROCESSORS = 2
OTHERS = 0.1  # of a processor, at most: what a machine does that nobody uses
AIM_S = 900


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def unjudged(row):
    """Why the time of a step says nothing, or an empty text."""
    if int(row["processors"]) != PROCESSORS:
        return f"cannot judge: {row['processors']} processors, and the ceilings are for {PROCESSORS}"
    if float(row["others"]) > OTHERS:
        return f"cannot judge: others used {float(row['others']):.2f} processors"
    return ""


def verdict(row, limits):
    """(whether the step is good, what to say of it)."""
    if row["step"] not in limits:
        return False, "no ceiling in the table"
    why, limit = unjudged(row), limits[row["step"]]
    if why:
        return True, why
    good = float(row["seconds"]) <= limit
    return good, f"ceiling {limit:.0f} s" + ("" if good else ": TOO LONG")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    limits = {row["step"]: float(row["seconds"])
              for row in rows_of(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).with_name("times.csv"))}
    rows, failed = rows_of(sys.argv[1]), False
    for row in rows:
        good, words = verdict(row, limits)
        failed |= not good
        print(f"{row['step']:10} {float(row['seconds']):7.1f} s, {float(row['processor_s']):7.1f} s of a processor, {words}")
    missing = limits.keys() - {row["step"] for row in rows}
    for step in sorted(missing):
        print(f"{step:10} is not in the log")
    total = sum(float(row["seconds"]) for row in rows)
    if not any(map(unjudged, rows)):
        print(f"all steps {total:.0f} s; the aim is {AIM_S} s{'' if total <= AIM_S else ', which is missed'}")
    sys.exit(failed or bool(missing))


if __name__ == "__main__":
    main()
