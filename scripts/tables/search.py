# SPDX-License-Identifier: Apache-2.0
"""Tables of docs/explore.md: what `degs explore` finds with a budget, against simulations of all designs of a study."""
import math
import random
from statistics import median

from measuring.fronts import front_of, grown, share_of_volume
from measuring.points import search, study_of
from measuring.tables import markdown, table

PAGE = "docs/explore.md"
GOALS = "area_mm2,latency_ms,energy.nj_per_frame"
LIMITS = {"beyond-64": "area_mm2<=2.8,worst(latency_ms)<=1.05*baseline",
          "beyond-256": "area_mm2<=1.1*baseline,worst(latency_ms)<=1.05*baseline"}
# Smaller than the study's own, so that all takes some minutes.
VIEWS = ("--scene synthetic:object,gaussians=6000 --scene synthetic:outdoor,gaussians=20000 --camera 1 --width 320")
ALL = "--budget 100000"
BUDGET = 12  # a fifth of the designs
FEW = "--population 8 --generations 3"  # so many designs are estimated that the seed decides which
SEEDS = range(1, 6)
ERRORS = (0.002, 0.005, 0.01, 0.02)


def points_of(found):
    """The goals of each design within the limits, by its name."""
    return {design["name"]: tuple(design[goal] for goal in found["goals"])
            for design in found["results"]["designs"] if design["within"] == "yes"}


def with_errors(points, error, seed):
    """Areas are known, as in an estimate; each of the other goals is wrong on its own."""
    draws = random.Random(seed)
    return [(area, *(value * math.exp(draws.gauss(0, error)) for value in others)) for area, *others in points]


def chosen_rows(points, first):
    """Choices that know more than a search does: all goals, or all but for errors; medians of the seeds."""
    best = set(front_of(points))
    chosen = [points[place] for place in grown(points, first, BUDGET)]
    yield ["the best, chosen afterwards", "", BUDGET, "", f"{share_of_volume(chosen, points):.4f}",
           f"{len(best & set(chosen))} of {len(best)}"]
    for error in ERRORS:
        shares = [share_of_volume([points[place] for place in grown(with_errors(points, error, seed), first, BUDGET)],
                                  points) for seed in SEEDS]
        yield [f"chosen with an error of {100 * error:.1f} %", "", BUDGET, "", f"{median(shares):.4f}", ""]


def search_table(study):
    """Rows of choices, and of searches over that which simulates all."""
    searches = {"all estimated": "", **{f"seed {seed}": f"{FEW} --seed {seed}" for seed in SEEDS}}
    everything, found = yield [
        search(study, f"{VIEWS} --goals {GOALS} --limits {LIMITS[study]} {ALL}"),
        {name: search(study, f"{VIEWS} --goals {GOALS} --limits {LIMITS[study]} --budget {BUDGET} {options}")
         for name, options in searches.items()}]
    named = points_of(everything)
    points, best = list(named.values()), set(front_of(named.values()))
    rows = list(chosen_rows(points, list(named).index(study_of(study)[1]["designs"][0]["name"])))
    for name, each in found.items():
        reached, spent = list(points_of(each).values()), each["search"]
        rows.append([name, spent["estimated"], spent["simulated"],
                     f"{spent['simulated_cycles'] / everything['search']['simulated_cycles']:.3f}",
                     f"{share_of_volume(reached, points):.4f}", f"{len(best & set(reached))} of {len(best)}"])
    return markdown(["search", "estimated", "simulated", "of the cycles", "of the hypervolume", "designs of the front"],
                    rows)


for each_study in LIMITS:
    table(PAGE, f"search-{each_study}", each_study)(search_table)
