#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares `degs explore` with simulating every design of a study.

    search_cost.py [FOLDER] [--study beyond-64]

prints a table of docs/explore.md; FOLDER (default out/search-cost) keeps the runs. The goals are area, latency and
energy under two limits. Rows "chosen with an error" say what a choice of as many designs reaches that knows all
latencies and energies but for independent errors of this size: medians of the seeds. The views are smaller than
the study's own, so that all takes some minutes. The first search estimates all designs; where it may estimate 24 of
them only, the seed decides which.
"""
import argparse
import json
import math
import random
import statistics
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/sim/degs"
STUDIES = ROOT / "configs/studies"
GOALS = "area_mm2,latency_ms,energy.nj_per_frame"
LIMITS = {"beyond-64": "area_mm2<=2.8,worst(latency_ms)<=1.05*baseline",
          "beyond-256": "area_mm2<=1.1*baseline,worst(latency_ms)<=1.05*baseline"}
ERRORS = [0.002, 0.005, 0.01, 0.02]
VIEWS = ["--scene", "synthetic:object,gaussians=6000", "--scene", "synthetic:outdoor,gaussians=20000", "--camera", "1",
         "--width", "320"]
SEEDS = range(1, 6)
BUDGET = 12  # a fifth of the designs


def explore(study, folder, *options):
    """The file explore.json and the front of a search."""
    subprocess.run([PROGRAM, "explore", STUDIES / f"{study}.yaml", "--goals", GOALS, "--limits", LIMITS[study], *VIEWS,
                    "--out", folder, *options], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    found = json.loads((folder / "explore.json").read_text())
    designs = [design for design in found["results"]["designs"] if design["within"] == "yes"]
    return found, [tuple(design[goal] for goal in found["goals"]) for design in designs]


def beats(a, b):
    return a != b and all(x <= y for x, y in zip(a, b))


def front_of(points):
    return [point for point in set(points) if not any(beats(other, point) for other in points)]


def volume(points, worst):
    """Slices along the last goal; all goals shall be small."""
    if len(worst) == 1:
        return max([worst[0] - point[0] for point in points] + [0])
    points = sorted((point for point in points if point[-1] < worst[-1]), key=lambda point: point[-1])
    ends = [point[-1] for point in points[1:]] + [worst[-1]]
    return sum((end - point[-1]) * volume([each[:-1] for each in points[:count]], worst[:-1])
               for count, (point, end) in enumerate(zip(points, ends), start=1))


def share_of_volume(points, all_points):
    """Every goal from 0, its best value, to 1, its worst within the limits; the volume ends at 1.1."""
    lows = [min(values) for values in zip(*all_points)]
    highs = [max(values) for values in zip(*all_points)]

    def scaled(chosen):
        return [tuple((x - low) / (high - low) for x, low, high in zip(point, lows, highs)) for point in chosen]

    worst = (1.1,) * len(lows)
    return volume(scaled(points), worst) / volume(scaled(all_points), worst)


def best_afterwards(points, first):
    """The places of as many designs as the budget allows that make the volume largest one after the other."""
    chosen = [first]
    while len(chosen) < BUDGET:
        left = [place for place in range(len(points)) if place not in chosen]
        chosen.append(max(left, key=lambda place: share_of_volume([points[c] for c in chosen + [place]], points)))
    return chosen


def with_errors(points, error, seed):
    """Areas are known, as in an estimate."""
    draws = random.Random(seed)
    return [(area, *(value * math.exp(draws.gauss(0, error)) for value in others)) for area, *others in points]


def chosen_rows(points, first, best):
    """The rows of choices that know more than a search does."""
    chosen = [points[place] for place in best_afterwards(points, first)]
    print(f"| the best, chosen afterwards |  | {BUDGET} |  | {share_of_volume(chosen, points):.4f} | "
          f"{len(best & set(chosen))} of {len(best)} |")
    for error in ERRORS:
        shares = [share_of_volume([points[place] for place in best_afterwards(with_errors(points, error, seed), first)],
                                  points) for seed in SEEDS]
        print(f"| chosen with an error of {100 * error:.1f} % |  | {BUDGET} |  | {statistics.median(shares):.4f} |  |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "out/search-cost")
    parser.add_argument("--study", choices=list(LIMITS), default="beyond-64")
    options = parser.parse_args()
    folder, study = options.folder / options.study, options.study
    everything, all_points = explore(study, folder / "all", "--budget", "100000")
    best = set(front_of(all_points))
    cycles = everything["search"]["simulated_cycles"]
    print("| search | estimated | simulated | of the cycles | of the hypervolume | designs of the front |")
    print("|---|--:|--:|--:|--:|--:|")
    designs = {design["name"]: design for design in everything["results"]["designs"]}
    baseline = designs[study.replace("beyond", "degs-x")]
    chosen_rows(all_points, all_points.index(tuple(baseline[goal] for goal in everything["goals"])), best)
    whole, points = explore(study, folder / "whole", "--budget", str(BUDGET))
    row("all estimated", whole, points, all_points, best, cycles)
    for seed in SEEDS:
        bred, points = explore(study, folder / f"seed-{seed}", "--budget", str(BUDGET),
                               "--population", "8", "--generations", "3", "--seed", str(seed))
        row(f"seed {seed}", bred, points, all_points, best, cycles)


def row(name, found, points, all_points, best, cycles):
    spent = found["search"]
    print(f"| {name} | {spent['estimated']} | {spent['simulated']} | {spent['simulated_cycles'] / cycles:.3f} | "
          f"{share_of_volume(points, all_points):.4f} | {len(best & set(points))} of {len(best)} |", flush=True)


if __name__ == "__main__":
    main()
