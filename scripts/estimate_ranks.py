#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""estimate_ranks.py [--scenes SCENE...] [--jobs N]: how well estimates (--fidelity analytic) rank designs and predict
changes, against exact runs, as docs/analytic.md has it.

Prints, over all views, Spearman's rank correlation of the cycles and of the energy of 17 designs, the error of their
energies by family, and for keys of degs-64 that are halved or doubled alone the error of the estimated change of the
cycles. Runs with DEGS_PROGRAM (default
build/release/sim/degs); scenes are SCENE/scene.ply in DEGS_SCENES (default ../shared/scenes)."""
import argparse
import csv
import os
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES = pathlib.Path(os.environ.get("DEGS_SCENES", str(ROOT / "../shared/scenes")))
COLUMNS = ["cycles", "energy.nj_per_frame"]
FAMILIES = ["degs", "gscore", "gbu", "gcc"]
DESIGNS = [f"{family}-{size}" for family in FAMILIES for size in ["16", "64", "256", "1024"]]
DESIGNS += ["degs-64-tuned"]
CHANGES = """study: changes
designs: [{{include: {design}, name: degs-64, pipeline: {{tiles: exact}}}}]
combine: one_at_a_time
axes:
  span.count: [x1/2, x2]
  slicing.count: [x1/2, x2]
  packing.bytes: [x1/2, x2]
  pixel_buffer.bytes: [x1/2, x2]
  gaussian_buffer.bytes: [x1/2, x2]
  memory.bandwidth_gb_per_s: [x1/4, x1/2, x2]
  memory.latency_ns: [x1/2, x2]
scenes: [{scenes}]
cameras: all
"""
LISTS = ["--set", "pipeline.tiles=exact"]  # with which the tables of docs/analytic.md were measured
NOTABLE = 0.02  # changes whose direction counts


def numbers(command, fidelity, key, columns=("cycles",)):
    """[{view: {design: number}}] of a comparison or a sweep, by column; `key` names a design by its row."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(command + ["--no-reference", "--fidelity", fidelity, "--out", folder], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        name = "results.csv" if command[1] == "sweep" else "compare.csv"
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return read_numbers(file, key, columns)


def read_numbers(file, key, columns):
    """The numbers of an open table."""
    found = [{} for _ in columns]
    for row in csv.DictReader(file):
        for values, column in zip(found, columns):
            values.setdefault((row["scene"], row["camera"]), {})[key(row)] = float(row[column])
    return found


def ranks(values):
    """From 1; equal values share the mean of theirs."""
    return [sum(other < value for other in values) + (sum(other == value for other in values) + 1) / 2
            for value in values]


def spearman(first, second):
    """The correlation of the ranks."""
    return statistics.correlation(ranks(first), ranks(second))


def rank_designs(scenes, jobs):
    """Prints how well estimates rank the designs."""
    command = [PROGRAM, "compare"] + [str(ROOT / "configs" / (name + ".yaml")) for name in DESIGNS]
    command += [word for scene in scenes for word in ["--scene", scene]] + ["--camera", "all", "--jobs", jobs, *LISTS]
    exact, estimated = (numbers(command, fidelity, lambda row: row["config"], COLUMNS)
                        for fidelity in ["exact", "analytic"])
    report_ranks(exact, estimated)


def report_ranks(exact, estimated):
    """Prints the correlations of every column, and the errors of the energy."""
    for column, found, guessed in zip(COLUMNS, exact, estimated):
        ranked = [spearman(list(found[view].values()), [guessed[view][name] for name in found[view]])
                  for view in found]
        print(f"{column}: ranks of {len(DESIGNS)} designs on {len(ranked)} views: Spearman "
              f"{statistics.median(ranked):.3f}, at the worst {min(ranked):.3f}")
    print("\n| designs | median error of the energy, % | worst, % |\n|---|---:|---:|")
    for family in [*FAMILIES, ""]:
        errors = [100 * (estimated[1][view][name] / energy - 1)
                  for view, designs in exact[1].items() for name, energy in designs.items()
                  if name.startswith(family)]
        print(f"| {family or 'all'} | {statistics.median(map(abs, errors)):.1f} | {max(errors, key=abs):+.0f} |")
    print()


def predict_changes(scenes, jobs):
    """Prints how well estimates predict changes of single keys."""
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "changes.yaml"
        study.write_text(CHANGES.format(design=ROOT / "configs/degs-64.yaml", scenes=", ".join(scenes)),
                         encoding="utf-8")
        keys = [line.split(":")[0].strip() for line in CHANGES.split("\n") if line.startswith("  ")]
        command = [PROGRAM, "sweep", str(study), "--jobs", jobs]
        (exact,), (estimated,) = (numbers(command, fidelity, lambda row: tuple(row[key] for key in keys))
                                  for fidelity in ["exact", "analytic"])
    errors, right = [], []
    for view, runs in exact.items():
        # The baseline is the point that agrees in every key with most others.
        own = max(runs, key=lambda point: sum(a == b for other in runs for a, b in zip(point, other)))
        for point in runs:
            if point != own:
                change = runs[point] / runs[own] - 1
                guess = estimated[view][point] / estimated[view][own] - 1
                errors.append(abs(guess - change))
                if abs(change) > NOTABLE:
                    right.append(guess * change > 0)
    print(f"{len(errors)} changes of a key: error of the change {100 * statistics.median(errors):.1f} points, at the "
          f"worst {100 * max(errors):.0f}; direction right in {sum(right)} of {len(right)} above "
          f"{100 * NOTABLE:.0f} %")


def main():
    """Prints all."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", nargs="+", default=["flowers", "skull"])
    parser.add_argument("--jobs", default="2")
    options = parser.parse_args()
    scenes = [str((SCENES / scene / "scene.ply").resolve()) for scene in options.scenes]
    rank_designs(scenes, options.jobs)
    predict_changes(scenes, options.jobs)


if __name__ == "__main__":
    main()
