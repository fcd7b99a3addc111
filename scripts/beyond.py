#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The machines of docs/beyond-the-paper.md against those of the paper and the baselines.

    beyond.py run [FOLDER] [--only GROUP]... [--scene NAME]... [--jobs N]
    beyond.py search SIZE [FOLDER]       `degs explore` of the study beyond-SIZE, and the picture of its front
    beyond.py table GROUP TABLE          a Markdown table from docs/beyond.csv; TABLE: array, 204.8, 102.4, memory

`run` sweeps the designs of a group (64, mechanisms, front, 4k) over the scenes of DEGS_SCENES that the search did
not see, with cameras 2 (close-up) and 1 (small splats): the arrays alone, and whole accelerators on LPDDR5 with 204.8
and 102.4 GB/s over a path of two frames. It goes on with what FOLDER has, and writes docs/beyond.csv, a row for each
design, memory, scene and camera. Rows of other groups stay. `search` has the three other
scenes at 720p. The program is DEGS_PROGRAM, or build/release/sim/degs."""
import argparse
import csv
import json
import math
import os
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = os.environ.get("DEGS_PROGRAM", str(ROOT / "build/release/sim/degs"))
SCENES_AT = Path(os.environ.get("DEGS_SCENES", ROOT / "../shared/scenes"))
MEASURED = ROOT / "docs/beyond.csv"
SCENES = ["fruit-drops", "guitar", "seal", "skull", "st-peter"]
SEARCHED = ["flowers", "flowers-small", "garden-crop"]
CAMERAS = ["2", "1"]
MEMORIES = {"204.8": "lpddr5-6400x256", "102.4": "lpddr5-6400x128"}
NAMES = {"2": "close-up", "1": "small splats"}
COLUMNS = ["group", "design", "memory", "scene", "camera", "utilization", "bound", "bounded_by", "conflict", "starved",
           "terminated", "throughput_fps", "latency_ms", "nj_per_frame", "area_mm2", "dram_gb_per_s", "limited_by"]
BASELINES = ("gscore", "gbu", "gcc")
# Designs of a group: name, file of configs, and keys over its values.
GROUPS = {
    "64": [("degs-64", "degs-64", {}), ("degs-64-tuned", "degs-64-tuned", {}), ("degs-x-64", "degs-x-64", {}),
           *((f"{name}-64", f"{name}-64", {}) for name in BASELINES)],
    "mechanisms": [("degs-x-64", "degs-x-64", {}),
                   ("pairs of segments", "degs-x-64", {"scheduler.reuse_cycles": 2, "array.writeback_cycles": 2}),
                   ("no conflicts", "degs-x-64", {"scheduler.reuse_cycles": 1, "array.writeback_cycles": 1}),
                   ("two streams", "degs-x-64", {"slicing.interleave": 2, "slicing.count": 2,
                                                 "pixel_buffer.bytes": 21504}),
                   ("8 Span Units", "degs-x-64", {"span.count": 8}),
                   ("own rows", "degs-x-64", {"span.rows": "fixed"}),
                   ("8 banks of 8", "degs-x-64", {"scheduler.banks": 8, "array.pes_per_bank": 8,
                                                  "scheduler.issue_width": 2})],
    "front": [("degs-x-64", "degs-x-64", {}), ("bursts of 64 B", "degs-x-64", {"traffic.burst_bytes": 64}),
              ("2 Projection Units", "degs-x-64", {"projection.count": 2})],
}
GROUPS["4k"] = [each for each in GROUPS["64"] if each[0] in ("degs-64", "degs-x-64")]
SETTINGS = {"mechanisms": ["alone"], "front": ["204.8"], "4k": ["alone", "204.8"]}  # of a group, where not all


def mean(values):
    """Geometric mean."""
    return math.exp(sum(math.log(value) for value in values) / len(values))


def write_study(file, group, memory, scenes):
    """A study with the designs of a group behind one memory."""
    lines = [f"study: beyond-{group}-{memory}", "reference: false", f"cameras: [{', '.join(CAMERAS)}]"]
    lines += [f"scenes: [{', '.join(str((SCENES_AT / name / 'scene.ply').resolve()) for name in scenes)}]"]
    lines += ["array_only: true"] if memory == "alone" else ["frames: 2"]
    lines += ["resolutions: 4k"] if group == "4k" else []
    lines.append("designs:")
    for name, config, keys in GROUPS[group]:
        lines += [f"  - include: {ROOT / 'configs' / (config + '.yaml')}", f"    name: {name}"]
        sections = {}
        for key, value in keys.items():
            section, _, rest = key.partition(".")
            sections.setdefault(section, []).append((rest, value))
        for section, values in sections.items():
            inside = ", ".join(f"{rest}: {value}" for rest, value in values)
            lines.append(f"    {section}: " + (f"{{ {inside} }}" if values[0][0] else str(values[0][1])))
        if memory != "alone":
            lines.append("    memory: { model: lpddr5, lpddr5: { include: "
                         f"{ROOT / 'configs/memory' / (MEMORIES[memory] + '.yaml')} }} }}")
    Path(file).write_text("\n".join(lines) + "\n", encoding="utf-8")


def bound_of(report):
    """The utilisation that no scheduler could exceed with the splats and rows of this run, and what sets it.

    Useful tasks / (PEs x cycles), where the cycles are the most of splats / (Slicing Units x splats per cycle), rows /
    (Span Units x rows per cycle) and useful tasks / PEs. Other accelerators have no such units: 1."""
    stages, keys = report["stages"], report["config"]
    if "slicing" not in stages:
        return 1.0, ""
    clusters = keys.get("clusters", 1)
    useful = report["slots"]["useful"]
    needs = {"splats": stages["slicing"]["splats"] / (clusters * keys["slicing"]["count"] *
                                                      keys["slicing"]["splats_per_cycle"]),
             "rows": stages["span"]["rows"] * keys["span"]["cycles_per_row"] /
                     (clusters * keys["span"]["count"] * keys["span"]["rows_per_cycle"]),
             "PEs": useful / report["slots"]["pes"]}
    longest = max(needs, key=needs.get)
    return needs["PEs"] / needs[longest], longest


def sweep(study, folder, *more):
    """Runs a study, or goes on with it."""
    subprocess.run([PROGRAM, "sweep", str(study), "--out", str(folder), *more], check=True, stdout=subprocess.DEVNULL)


def rows_of(group, memory, folder):
    """Rows of docs/beyond.csv from the results of a sweep."""
    with open(folder / "results.csv", encoding="utf-8") as file:
        results = list(csv.DictReader(file))
    rows = []
    for result in results:
        def report(ending, number=int(result["point"])):
            with open(folder / f"reports/{number:06}{ending}.json", encoding="utf-8") as file:
                return json.load(file)
        frame = report("")
        path = frame if memory == "alone" else report("-path")
        bound, by = bound_of(frame) if memory == "alone" else ("", "")
        slots, dram = frame["slots"], path["dram"]
        rows.append({
            "group": group, "design": result["design"], "memory": memory, "scene": result["scene"],
            "camera": result["camera"], "utilization": f"{slots['utilization']:.4f}",
            "bound": bound and f"{bound:.4f}", "bounded_by": by,
            **{each: f"{slots[each] / slots['total']:.4f}" for each in ("conflict", "starved", "terminated")},
            "throughput_fps": f"{path['timing']['throughput_fps'] or path['timing']['fps']:.2f}",
            "latency_ms": f"{frame['timing']['latency_ms']:.6f}", "area_mm2": f"{frame['area']['mm2']:.4f}",
            "nj_per_frame": f"{path['energy']['nj_per_frame']:.1f}",
            "dram_gb_per_s": "" if memory == "alone" else
                             f"{(dram['bytes_read'] + dram['bytes_written']) / path['timing']['cycles']:.2f}",
            "limited_by": result["limited_by"]})
    return rows


def run(options):
    """All sweeps of the groups, then docs/beyond.csv."""
    folder = Path(options.folder or tempfile.mkdtemp())
    rows = []
    groups = options.only or list(GROUPS)
    for group in groups:
        for memory in SETTINGS.get(group, ["alone", *MEMORIES]):
            name = f"{group}-{memory}"
            folder.mkdir(parents=True, exist_ok=True)
            write_study(folder / (name + ".yaml"), group, memory, options.scene or SCENES)
            sweep(folder / (name + ".yaml"), folder / name, "--jobs", str(options.jobs))
            rows += rows_of(group, memory, folder / name)
    kept = [row for row in measured() if row["group"] not in groups] if MEASURED.exists() else []
    with open(MEASURED, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept + rows)


def measured():
    """The rows of docs/beyond.csv."""
    with open(MEASURED, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def select(group, memory):
    """Rows by design and camera, in the order of the file."""
    found = {}
    for row in measured():
        if row["group"] == group and row["memory"] == memory:
            found.setdefault(row["design"], {}).setdefault(row["camera"], []).append(row)
    return found


def column(rows, name):
    """Geometric mean of a column."""
    return mean([float(row[name]) for row in rows])


def print_table(headings, rows):
    """A Markdown table, the first column of which is text."""
    print("| " + " | ".join(headings) + " |")
    print("|---|" + "--:|" * (len(headings) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def table_array(group):
    """Utilisation and its bound, arrays alone; slots lost are arithmetic means."""
    headings = ["array alone, %"]
    for camera in CAMERAS:
        headings += [f"{NAMES[camera]}: useful", "lowest", "bound", "conflict", "starved"]
    rows = []
    for design, views in select(group, "alone").items():
        cells = [design]
        for camera in CAMERAS:
            of = views[camera]
            cells += [f"**{100 * column(of, 'utilization'):.1f}**",
                      f"{100 * min(float(row['utilization']) for row in of):.1f}",
                      f"{100 * column(of, 'bound'):.1f}" if of[0]["bounded_by"] else "",
                      *(f"{100 * sum(float(row[each]) for row in of) / len(of):.1f}" if of[0]["bounded_by"] else ""
                        for each in ("conflict", "starved"))]
        rows.append(cells)
    print_table(headings, rows)


def table_whole(group, memory):
    """Throughput, per mm2 and per joule over the first design."""
    headings = [f"LPDDR5, {memory} GB/s", "mm²"]
    for camera in CAMERAS:
        headings += [f"{NAMES[camera]}: fps", "×", "per mm²", "per J"]
    designs, rows = select(group, memory), []
    first = next(iter(designs.values()))
    for design, views in designs.items():
        area = float(views[CAMERAS[0]][0]["area_mm2"])
        cells = [design, f"{area:.2f}"]
        for camera in CAMERAS:
            fps, energy = (column(views[camera], each) / column(first[camera], each)
                           for each in ("throughput_fps", "nj_per_frame"))
            per_area = fps / area * float(first[camera][0]["area_mm2"])
            cells += [f"{column(views[camera], 'throughput_fps'):.0f}", f"{fps:.2f}", f"**{per_area:.2f}**",
                      f"{1 / energy:.2f}"]
        rows.append(cells)
    print_table(headings, rows)


def table_memory(group):
    """Bytes per second moved, and what the reports say limits a frame, by scenes."""
    headings = ["design", "memory"]
    for camera in CAMERAS:
        headings += [f"{NAMES[camera]}: GB/s", "limited by"]
    rows = []
    for memory in MEMORIES:
        for design, views in select(group, memory).items():
            cells = [design, memory]
            for camera in CAMERAS:
                limits = [row["limited_by"] for row in views[camera]]
                cells += [f"{column(views[camera], 'dram_gb_per_s'):.0f}",
                          ", ".join(f"{name} {limits.count(name)}" for name in sorted(set(limits)))]
            rows.append(cells)
    print_table(headings, rows)


def others_of(size, folder):
    """Area and latency of the machines beside the front, over the views of the search, and the front itself."""
    study = folder / "others.yaml"
    names = [f"degs-{size}", f"degs-{size}-tuned", *(f"{name}-{size}" for name in BASELINES)]
    memory = f"{{ model: lpddr5, lpddr5: {{ include: {ROOT / 'configs/memory/lpddr5-6400x256.yaml'} }} }}"
    lines = ["study: others", "reference: false", "cameras: [1, 2]", "resolutions: 720p",
             f"scenes: [{', '.join(str((SCENES_AT / name / 'scene.ply').resolve()) for name in SEARCHED)}]", "designs:"]
    for name in names:
        lines += [f"  - include: {ROOT / 'configs' / (name + '.yaml')}", f"    name: {name}", f"    memory: {memory}"]
    study.write_text("\n".join(lines) + "\n", encoding="utf-8")
    sweep(study, folder / "others")
    with open(folder / "others/results.csv", encoding="utf-8") as file:
        results = list(csv.DictReader(file))
    points = []
    for name in names:
        of = [row for row in results if row["design"] == name]
        points.append((name, float(of[0]["area_mm2"]), mean([float(row["latency_ms"]) for row in of])))
    with open(folder / "front/front.csv", encoding="utf-8") as file:
        front = list(csv.DictReader(file))
    return points, [(float(row["area_mm2"]), float(row["latency_ms"])) for row in front]


def search(options):
    """The search of a study, and docs/images/beyond-SIZE.svg."""
    folder = Path(options.folder or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    scenes = [word for name in SEARCHED for word in ("--scene", str(SCENES_AT / name / "scene.ply"))]
    subprocess.run([PROGRAM, "explore", str(ROOT / f"configs/studies/beyond-{options.size}.yaml"), *scenes, "--out",
                    str(folder / "front"), "--jobs", str(options.jobs)], check=True)
    others, front = others_of(options.size, folder)
    (ROOT / f"docs/images/beyond-{options.size}.svg").write_text(picture(others, front), encoding="utf-8")


def picture(others, front):
    """Latency over area: the designs of the last rung as dots, other machines with their names."""
    width, height, left, bottom = 720, 420, 60, 50
    points = [point[1:] for point in others] + front
    x1, y1 = 1.15 * max(point[0] for point in points), 1.1 * max(point[1] for point in points)

    def place(area, latency):
        return left + (width - left - 20) * area / x1, height - bottom - (height - bottom - 20) * latency / y1

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
           'font-size="12">', f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<path d="M{left},20 V{height - bottom} H{width - 20}" fill="none" stroke="black"/>',
           f'<text x="{width / 2}" y="{height - 12}" text-anchor="middle">area, mm²</text>',
           f'<text x="16" y="{height / 2}" text-anchor="middle" transform="rotate(-90 16 {height / 2})">latency of a '
           'frame, ms</text>']
    for i in range(5):
        x, y = place(x1 * i / 5, y1 * i / 5)
        out += [f'<text x="{x:.1f}" y="{height - bottom + 16}" text-anchor="middle">{x1 * i / 5:.1f}</text>',
                f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{y1 * i / 5:.2f}</text>']
    for name, area, latency in others:
        x, y = place(area, latency)
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="#b2182b"/>',
                f'<text x="{x + 8:.1f}" y="{y + 4:.1f}">{name}</text>']
    for area, latency in front:
        x, y = place(area, latency)
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="#2166ac" fill-opacity="0.7"/>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    runs = commands.add_parser("run")
    runs.add_argument("folder", nargs="?")
    runs.add_argument("--only", action="append", choices=list(GROUPS))
    runs.add_argument("--scene", action="append")
    searches = commands.add_parser("search")
    searches.add_argument("size")
    searches.add_argument("folder", nargs="?")
    for each in (runs, searches):
        each.add_argument("--jobs", type=int, default=1)
    tables = commands.add_parser("table")
    tables.add_argument("group", choices=list(GROUPS))
    tables.add_argument("table", choices=["array", *MEMORIES, "memory"])
    options = parser.parse_args()
    if options.command == "run":
        run(options)
    elif options.command == "search":
        search(options)
    elif options.table in MEMORIES:
        table_whole(options.group, options.table)
    else:
        {"array": table_array, "memory": table_memory}[options.table](options.group)


if __name__ == "__main__":
    main()
