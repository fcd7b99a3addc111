#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The machines of docs/beyond-the-paper.md against those of the paper and the baselines.

    beyond.py run [FOLDER] [--only GROUP]... [--memory SETTING]... [--scene NAME]... [--jobs N]
    beyond.py search SIZE [FOLDER]       `degs explore` of the study beyond-SIZE
    beyond.py picture FILE               throughput over area of the machines in docs/beyond.csv, as SVG
    beyond.py table GROUP TABLE          a Markdown table from docs/beyond.csv; TABLE: array, GB/s, memory

`run` sweeps the designs of a group (64, 256, 1024, mechanisms, front, 4k) over the scenes of DEGS_SCENES that the
search did not see, with cameras 2 (close-up) and 1 (small splats), in each setting of the group: `alone` (arrays), or
the GB/s of an LPDDR5 memory for whole accelerators over a path of four frames (4k: one frame). It goes on with what
FOLDER has, and writes docs/beyond.csv, a row for each design, setting, scene and camera. Other rows stay. `search` has the three other scenes at 720p. The
program is DEGS_PROGRAM, or build/release/sim/degs."""
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
# GB/s: a file of configs/memory, and other keys
MEMORIES = {"204.8": ("lpddr5-6400x256", ""), "102.4": ("lpddr5-6400x128", ""),
            "409.6": ("lpddr5-6400x256", ", channels: 32"), "819.2": ("lpddr5-6400x256", ", channels: 64")}
NAMES = {"2": "close-up", "1": "small splats"}
COLUMNS = ["group", "design", "memory", "scene", "camera", "utilization", "bound", "bounded_by", "conflict", "starved",
           "terminated", "throughput_fps", "latency_ms", "nj_per_frame", "area_mm2", "dram_gb_per_s", "limited_by"]
BASELINES = ("gscore", "gbu", "gcc")
PRIORITY = {"memory.priority": "blending"}
# Designs of a group: name, file of configs, and keys over its values.
GROUPS = {
    "64": [("degs-64", "degs-64", {}), ("degs-64-tuned", "degs-64-tuned", {}), ("degs-x-64", "degs-x-64", {}),
           *((f"{name}-64", f"{name}-64", {}) for name in BASELINES)],
    "256": [("degs-256", "degs-256", {}), ("degs-x-256", "degs-x-256", {}),
            ("4 × gscore-64", "gscore-64", {"clusters": 4}), ("gbu-256", "gbu-256", {}),
            ("4 × gcc-64", "gcc-64", {"clusters": 4})],
    "1024": [("degs-1024", "degs-1024", {}), ("degs-x-1024", "degs-x-1024", {}),
             ("16 × gcc-64", "gcc-64", {"clusters": 16})],
    "mechanisms": [("degs-x-64", "degs-x-64", {}),
                   ("pairs of segments", "degs-x-64", {"scheduler.reuse_cycles": 2, "array.writeback_cycles": 2}),
                   ("no conflicts", "degs-x-64", {"scheduler.reuse_cycles": 1, "array.writeback_cycles": 1})],
    # The front end of degs-x-256 step by step, and what smaller records would bring.
    "front": [("degs-256", "degs-256", {}), ("degs-256, priority", "degs-256", PRIORITY),
              ("degs-x-256", "degs-x-256", {}),
              ("without priority", "degs-x-256", {"memory.priority": "age"}),
              ("without the cache", "degs-x-256", {"front.cache_bytes": 0}),
              ("multicast for the cache", "degs-x-256", {"front.cache_bytes": 0, "front.multicast_window": 64}),
              ("longest list first", "degs-x-256", {"tile_order": "longest_list"}),
              ("records in Morton order", "degs-x-256", {"memory.layout": "morton"}),
              ("list entries of 6 B", "degs-x-256", {"traffic.list_entry_bytes": 6}),
              ("SH of 1 B", "degs-x-256", {"traffic.sh_value_bytes": 1,
                                            "pipeline.formats": "{ sh_dc: e4m3, sh_rest: e4m3 }"})],
    "4k": [(name, name, {}) for name in ("degs-64", "degs-x-64", "degs-256", "degs-x-256")],
}
SETTINGS = {"64": ["alone", "204.8", "102.4"], "256": ["alone", "204.8", "409.6"], "1024": ["819.2", "204.8"],
            "mechanisms": ["alone"], "front": ["204.8"], "4k": ["204.8"]}
ONLY_CAMERA = {"front": "1"}
PICTURED = [("64", "204.8"), ("256", "204.8"), ("1024", "819.2")]
ONLY_DEGS = [("256", "alone")]  # settings without baselines


def mean(values):
    """Geometric mean."""
    return math.exp(sum(math.log(value) for value in values) / len(values))


def write_study(file, group, memory, scenes):
    """A study with the designs of a group behind one memory."""
    lines = [f"study: beyond-{group}-{memory}", "reference: false", f"cameras: [{ONLY_CAMERA.get(group) or ', '.join(CAMERAS)}]"]
    lines += [f"scenes: [{', '.join(str((SCENES_AT / name / 'scene.ply').resolve()) for name in scenes)}]"]
    lines += ["array_only: true"] if memory == "alone" else [
        "resolutions: 4k" if group == "4k" else "frames: 4"]
    lines.append("designs:")
    for name, config, keys in GROUPS[group]:
        if (group, memory) in ONLY_DEGS and not config.startswith("degs"):
            continue
        lines += [f"  - include: {ROOT / 'configs' / (config + '.yaml')}", f"    name: {name}"]
        sections = {}
        for key, value in keys.items():
            section, _, rest = key.partition(".")
            sections.setdefault(section, []).append((rest, value))
        priority = "".join(f"{rest}: {value}, " for rest, value in sections.pop("memory", []))
        for section, values in sections.items():
            inside = ", ".join(f"{rest}: {value}" for rest, value in values)
            lines.append(f"    {section}: " + (f"{{ {inside} }}" if values[0][0] else str(values[0][1])))
        if memory != "alone":
            file_name, keys = MEMORIES[memory]
            lines.append(f"    memory: {{ {priority}model: lpddr5, lpddr5: {{ include: "
                         f"{ROOT / 'configs/memory' / (file_name + '.yaml')}{keys} }} }}")
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
        path = frame if memory == "alone" or group == "4k" else report("-path")
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
    done = [(group, memory) for group in options.only or list(GROUPS) for memory in SETTINGS[group]
            if memory in (options.memory or SETTINGS[group])]
    for group, memory in done:
        name = f"{group}-{memory}"
        folder.mkdir(parents=True, exist_ok=True)
        write_study(folder / (name + ".yaml"), group, memory, options.scene or SCENES)
        sweep(folder / (name + ".yaml"), folder / name, "--jobs", str(options.jobs))
        rows += rows_of(group, memory, folder / name)
    kept = [row for row in measured() if (row["group"], row["memory"]) not in done] if MEASURED.exists() else []
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
    designs, rows = select(group, memory), []
    first = next(iter(designs.values()))
    headings = [f"LPDDR5, {memory} GB/s", "mm²"]
    for camera in first:
        headings += [f"{NAMES[camera]}: fps", "×", "per mm²", "per J"]
    for design, views in designs.items():
        area = float(views[next(iter(first))][0]["area_mm2"])
        cells = [design, f"{area:.2f}"]
        for camera in first:
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


def search(options):
    """The search of a study over the scenes that no table has."""
    scenes = [word for name in SEARCHED for word in ("--scene", str(SCENES_AT / name / "scene.ply"))]
    subprocess.run([PROGRAM, "explore", str(ROOT / f"configs/studies/beyond-{options.size}.yaml"), *scenes, "--out",
                    options.folder or tempfile.mkdtemp(), "--jobs", str(options.jobs)], check=True)


def picture(file):
    """Throughput over area, both logarithmic, a panel for each view: SVG."""
    found = []
    for group, memory in PICTURED:
        for design, views in select(group, memory).items():
            found.append((design, float(views["2"][0]["area_mm2"]),
                          {camera: column(views[camera], "throughput_fps") for camera in CAMERAS}))
    width, height, side, bottom = 960, 460, 60, 44
    ranges = [[function(values) * factor for function, factor in ((min, 0.8), (max, 1.3))]
              for values in ([area for _, area, _ in found], [fps for _, _, by in found for fps in by.values()])]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
           'font-size="12">', f'<rect width="{width}" height="{height}" fill="white"/>']
    for panel, camera in enumerate(CAMERAS):
        left = side + panel * width / 2
        across, up = width / 2 - side - 60, height - bottom - 40

        def place(area, fps, left=left, across=across, up=up):
            share = [math.log(value / low) / math.log(high / low) for value, (low, high) in zip((area, fps), ranges)]
            return left + across * share[0], height - bottom - up * share[1]

        out += [f'<text x="{left + across / 2:.0f}" y="24" text-anchor="middle">{NAMES[camera]}</text>',
                f'<path d="M{left:.0f},40 V{height - bottom} H{left + across:.0f}" fill="none" stroke="black"/>',
                f'<text x="{left + across / 2:.0f}" y="{height - 8}" text-anchor="middle">area, mm²</text>']
        if not panel:
            out.append(f'<text x="14" y="{height / 2}" text-anchor="middle" transform="rotate(-90 14 {height / 2})">'
                       'frames per second</text>')
        for area in (3, 5, 10, 20):
            x, y = place(area, ranges[1][0])
            if ranges[0][0] < area < ranges[0][1]:
                out.append(f'<text x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle">{area}</text>')
        for fps in (500, 1000, 2000, 5000, 10000, 20000):
            x, y = place(ranges[0][0], fps)
            if ranges[1][0] < fps < ranges[1][1]:
                out.append(f'<text x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{fps}</text>')
        for design, area, by in found:
            x, y = place(area, by[camera])
            colour, shift = (("#2166ac", -5) if "-x-" in design else ("#b2182b", 5) if "degs" in design else
                             ("#777777", 13))  # labels that are near each other stand apart
            out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>',
                    f'<text x="{x + 6:.1f}" y="{y + shift:.1f}" font-size="10">{design}</text>']
    Path(file).write_text("\n".join(out + ["</svg>"]) + "\n", encoding="utf-8")


def main():
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    runs = commands.add_parser("run")
    runs.add_argument("folder", nargs="?")
    runs.add_argument("--only", action="append", choices=list(GROUPS))
    runs.add_argument("--memory", action="append", choices=["alone", *MEMORIES])
    runs.add_argument("--scene", action="append")
    searches = commands.add_parser("search")
    searches.add_argument("size")
    searches.add_argument("folder", nargs="?")
    for each in (runs, searches):
        each.add_argument("--jobs", type=int, default=1)
    tables = commands.add_parser("table")
    tables.add_argument("group", choices=list(GROUPS))
    tables.add_argument("table", choices=["array", *MEMORIES, "memory"])
    commands.add_parser("picture").add_argument("file")
    options = parser.parse_args()
    if options.command == "run":
        run(options)
    elif options.command == "search":
        search(options)
    elif options.command == "picture":
        picture(options.file)
    elif options.table in MEMORIES:
        table_whole(options.group, options.table)
    else:
        {"array": table_array, "memory": table_memory}[options.table](options.group)


if __name__ == "__main__":
    main()
