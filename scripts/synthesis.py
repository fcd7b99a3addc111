#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""synthesis.py [--quick | --table | --block NAME] [--jobs N] [--out FOLDER]: area and delay of blocks of the Packing
Scheduler and of the array, by synthesis with yosys and static timing with OpenSTA. Prints the tables of
docs/synthesis.md, the fitted laws among them, and writes docs/synthesis.csv. Finished points stay in FOLDER (default
build/synthesis), so that an interrupted run goes on; a point is made again when its sources have changed. --quick makes
three small points and writes nothing, --table prints the tables from docs/synthesis.csv, --block makes only the points
of that block (as in the first column of docs/synthesis.csv) and takes the others from there.

The cells are those of Debian's qflow-tech-osu018. DEGS_RTL_TABLES is the folder that degs_rtl_tables has written
(default build/release/tests/rtl/tables)."""
import argparse
import concurrent.futures
import csv
import hashlib
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
RTL = ROOT / "tests/rtl"
LIBERTY = pathlib.Path("/usr/share/qflow/tech/osu018/osu018_stdcells.lib")
TABLES = pathlib.Path(os.environ.get("DEGS_RTL_TABLES", str(ROOT / "build/release/tests/rtl/tables")))
KEPT = ROOT / "docs/synthesis.csv"
LIMIT_S = 180      # of a processor, for yosys and for ABC; what takes longer has no area
CYCLE_FO4 = 40     # delay target of all points, about 1 GHz in a process of 45 nm
FLOP_AREA = 96.0   # of DFFPOSX1, in units of the library
PARAMETERS = ["n", "k", "serial", "depth", "cut", "issue", "width", "writes", "tag", "tuned", "in", "out", "pairs"]
ARITHMETIC = ["arithmetic.sv", "tables.sv"]
SOURCES = {"select_in_turn": ["synthesis/select_in_turn.sv"], "select_oldest": ["synthesis/select_oldest.sv"],
           "select_foreseen": ["synthesis/select_foreseen.sv"],
           "segment_queue": ["synthesis/segment_queue.sv"], "domain_state": ["synthesis/domain_state.sv"],
           "packing_registers": ["packing_unit.sv", "synthesis/packing_registers.sv"],
           "pixel_loop": ARITHMETIC + ["synthesis/pixel_loop.sv"], "pe": ARITHMETIC + ["pe.sv"],
           "span_unit": ARITHMETIC + ["span_unit.sv"], "row_crossbar": ["synthesis/row_crossbar.sv"],
           "tile_walk": ["synthesis/tile_walk.sv"]}
SOURCES |= dict.fromkeys(("ready_vector", "choose_in_turn", "choose_by_dates", "group_dates"), ["synthesis/pipelined_select.sv"])


def points_of(top, names, *values):
    """Points of a block: one tuple of values for each."""
    return [(top, dict(zip(names.split(), point))) for point in values]


POINTS = (
    points_of("pe", "TUNED", (0,), (1,)) + points_of("span_unit", "TUNED", (0,), (1,)) +
    points_of("pixel_loop", "TUNED", (0,), (1,)) +
    points_of("select_in_turn", "N K SERIAL WIDTH", (16, 1, 0, 8), (16, 2, 0, 8), (48, 4, 0, 16), (128, 2, 0, 8),
              (128, 8, 0, 32), (16, 1, 1, 8), (16, 2, 1, 8), (48, 4, 1, 16), (64, 2, 1, 8)) +
    points_of("select_foreseen", "N K WIDTH", (16, 2, 8)) +
    points_of("select_oldest", "N K", (16, 2), (16, 4), (32, 2), (32, 4), (48, 2)) +
    points_of("ready_vector", "N", (16,), (48,)) + points_of("choose_in_turn", "N K", (16, 2), (48, 4)) +
    points_of("choose_by_dates", "N K", (16, 2), (48, 4)) + points_of("group_dates", "N K WIDTH", (16, 2, 8), (48, 4, 16)) +
    points_of("domain_state", "N ISSUE", (16, 2), (48, 4), (64, 2), (32, 8)) +
    points_of("packing_registers", "WIDTH ISSUE WRITES TAG", (8, 1, 1, 16), (8, 2, 1, 16), (8, 2, 4, 16), (8, 2, 1, 32),
              (16, 2, 1, 16), (16, 4, 1, 16), (32, 1, 1, 16)) +
    points_of("segment_queue", "DEPTH N CUT ISSUE", (32, 16, 1, 1), (32, 16, 2, 2), (64, 16, 2, 2), (32, 16, 4, 4)) +
    points_of("row_crossbar", "IN OUT TAG", (3, 12, 64), (8, 4, 64), (12, 4, 64), (12, 4, 128), (16, 8, 64)) +
    points_of("tile_walk", "PAIRS", (1,), (4,), (8,), (16,), (32,)))
QUICK = (points_of("select_in_turn", "N K SERIAL WIDTH", (8, 1, 0, 8)) + points_of("select_oldest", "N K", (8, 2)) +
         points_of("domain_state", "N ISSUE", (8, 1)))


def name_of(point):
    """A file name of a point, in whichever order it has its parameters."""
    return point[0] + "".join(f"-{key}{point[1][key.upper()]}" for key in PARAMETERS if key.upper() in point[1])


class TooLong(Exception):
    """A tool has used LIMIT_S of a processor."""


def run(command, folder):
    """What a command prints. A tool that is stopped by the limit leaves words of a signal or of a failed ABC."""
    limited = ["bash", "-c", f'ulimit -t {LIMIT_S}; "$@" 2>&1', "bash", *command]
    done = subprocess.run(limited, cwd=folder, check=False, text=True, stdout=subprocess.PIPE)
    if done.returncode in (-24, -9, 137, 152) or "ABC: execution of command" in done.stdout[-400:]:
        raise TooLong
    if done.returncode:
        sys.exit(f"{command}: {done.stdout[-2000:]}")
    return done.stdout


def time_of(folder, netlist, top, clock, command):
    """What OpenSTA prints of a netlist."""
    script = pathlib.Path(folder) / "sta.tcl"
    script.write_text(f"read_liberty {LIBERTY}\nread_verilog {netlist}\nlink_design {top}\n{clock}\n{command}\nexit\n",
                      encoding="utf-8")
    return run(["sta", "-no_splash", "-exit", str(script)], folder)


def arrivals_of(report):
    """Arrival times, ns, at the outputs of the inverters of a chain, in the order of the chain."""
    return {int(place): float(ns) for ns, place in re.findall(r"([\d.]+) [\^v] stage(\d+)/Y", report)}


def fan_out_of_4(folder):
    """Delay, ns, of an INVX1 that drives four: the mean of a rising and a falling one in the middle of a chain."""
    chain = ["module chain (input a, output y);", "wire " + ", ".join(f"n{i}" for i in range(13)) + ";",
             "assign n0 = a;", "assign y = n12;"]
    for i in range(12):
        chain.append(f"INVX1 stage{i} (.A(n{i}), .Y(n{i + 1}));")
        chain += [f"INVX1 load{i}_{j} (.A(n{i + 1}), .Y());" for j in range(3 if i < 11 else 4)]
    (pathlib.Path(folder) / "chain.v").write_text("\n".join(chain + ["endmodule", ""]), encoding="utf-8")
    at = arrivals_of(time_of(folder, "chain.v", "chain", "set_max_delay 100 -from [get_ports a] -to [get_ports y]",
                             "report_checks -path_delay max -digits 6"))
    return (at[9] - at[3]) / 6


def mapping(fo4_ns):
    """Script of ABC. Depth comes first, as that of yosys restores chains out of trees; sizes are for the delay target."""
    target_ps = round(CYCLE_FO4 * fo4_ns * 1000)
    return f"+&get,-n;&st;&dch;&nf;&put;buffer,-c;topo;upsize,-D,{target_ps};dnsize,-D,{target_ps}"


def synthesise(point, fo4_ns, folder):
    """Area and longest path of a point."""
    top, parameters = point
    text = [f"read_verilog -sv {RTL / source}" for source in SOURCES[top]]
    text += ["chparam " + " ".join(f"-set {key} {value}" for key, value in parameters.items()) + f" {top}",
             f"hierarchy -top {top}", f"rename -top {top}", f"synth -flatten -noabc -noshare -top {top}",
             f"dfflibmap -liberty {LIBERTY}", f"abc -liberty {LIBERTY} -constr drive.constr -script {mapping(fo4_ns)}",
             "opt_clean -purge", "setundef -zero",
             "splitnets -ports", "opt_clean -purge", f"stat -liberty {LIBERTY}", "write_verilog -noattr -noexpr netlist.v"]
    folder = pathlib.Path(folder)
    (folder / "drive.constr").write_text("set_driving_cell INVX4\nset_load 0.02 [all_outputs]\n", encoding="utf-8")
    (folder / "run.ys").write_text("\n".join(text) + "\n", encoding="utf-8")
    if "tables.sv" in SOURCES[top]:
        for table in TABLES.glob("*.hex"):
            shutil.copy(table, folder)
    log = run(["yosys", "-Q", "run.ys"], folder)
    area = float(re.findall(r"Chip area for (?:top )?module .*: ([\d.]+)", log)[-1])
    tail = log[log.rindex("Printing statistics"):]
    cells = {cell: int(count) for cell, count in re.findall(r"^\s+(\w+)\s+(\d+)\s*$", tail, re.MULTILINE)}
    flops = sum(count for cell, count in cells.items() if cell.startswith("DFF"))
    report = time_of(folder, "netlist.v", top, "create_clock -period 1000 [get_ports clk]",
                     "report_checks -path_delay max -digits 4")
    slack = float(re.findall(r"(-?[\d.]+)\s+slack", report)[-1])
    return {"area": area, "flops": flops, "fo4": (1000 - slack) / fo4_ns}


def digest_of(point):
    """Says whether a point that is kept is still that of the sources and of this way of making it."""
    parts = [(RTL / source).read_bytes() for source in SOURCES[point[0]]]
    parts += [LIBERTY.read_bytes(), mapping(1).encode()]
    return hashlib.sha256(b"".join(parts)).hexdigest()


def make(point, fo4_ns, out):
    """A point, kept or new; `area` is missing if it took too long."""
    kept, digest = out / (name_of(point) + ".json"), digest_of(point)
    if kept.exists():
        result = json.loads(kept.read_text(encoding="utf-8"))
        if result["digest"] == digest:
            return result
    result, begin = {"digest": digest}, time.time()
    with tempfile.TemporaryDirectory() as folder:
        try:
            result |= synthesise(point, fo4_ns, folder)
        except TooLong:
            pass
    result["seconds"] = round(time.time() - begin, 1)
    kept.write_text(json.dumps(result) + "\n", encoding="utf-8")
    print(f"{name_of(point)}: {result}", file=sys.stderr, flush=True)
    return result


def lanes_of(p):
    """Tasks that packing_unit.sv places in a cycle at most."""
    complete = (p["WIDTH"] - 1 + 16) // p["WIDTH"]
    return (max(complete, p["WRITES"]) + 1) * p["WIDTH"]


def reach_of(p):
    """Pairs of a pixel and a lane that it may reach: no more tasks come before it than there are pixels, and those of
    the open packet."""
    return sum(min(lanes_of(p), p["WIDTH"] + pixel) for pixel in range(16 * p["ISSUE"]))


def queue_bits(p):
    """Flip-flops of the segment queue that are state."""
    entry, domain = (p["DEPTH"] - 1).bit_length(), (p["N"] - 1).bit_length()
    return p["DEPTH"] * (1 + 16 + entry + domain) + p["N"] * (1 + 2 * entry)


# Laws: a name, the points that they are for, whether the registers count, and their terms. The
# registers of a selection are those of the domain state, which has a law of its own.
LAWS = [
    ("selection in turn, one date", lambda top, p: top == "select_in_turn" and not p["SERIAL"], False,
     {"N": lambda p: p["N"], "N K": lambda p: p["N"] * p["K"]}),
    ("selection in turn, serial dates", lambda top, p: top == "select_in_turn" and p["SERIAL"], False,
     {"N K": lambda p: p["N"] * p["K"], "N (K − 1)": lambda p: p["N"] * (p["K"] - 1)}),
    ("choice in n cycles", lambda top, p: top == "choose_by_dates", False, {"N K": lambda p: p["N"] * p["K"]}),
    ("selection of the oldest", lambda top, p: top == "select_oldest", True,
     {"N²": lambda p: p["N"] ** 2, "N² K": lambda p: p["N"] ** 2 * p["K"]}),
    ("segment queue", lambda top, p: top == "segment_queue", True,
     {"F": queue_bits, "F (C + K)": lambda p: queue_bits(p) * (p["CUT"] + p["ISSUE"])}),
    ("domain state", lambda top, p: top == "domain_state", True,
     {"N": lambda p: p["N"], "N K": lambda p: p["N"] * p["ISSUE"]}),
    ("Packing Unit", lambda top, p: top == "packing_registers", True,
     {"(L + W) B": lambda p: (lanes_of(p) + p["WIDTH"]) * (p["TAG"] + 5),
      "R B": lambda p: reach_of(p) * (p["TAG"] + 5), "R": reach_of}),
    ("crossbar", lambda top, p: top == "row_crossbar", True,
     {"(I + 1) O B": lambda p: (p["IN"] + 1) * p["OUT"] * p["TAG"], "(I + O) B": lambda p: (p["IN"] + p["OUT"]) * p["TAG"]}),
    ("tiles of a splat", lambda top, p: top == "tile_walk", True, {"": lambda p: 1, "P": lambda p: p["PAIRS"]}),
]
DELAYS = [
    ("selection in turn, one date", lambda top, p: top == "select_in_turn" and not p["SERIAL"],
     {"": lambda p: 1, "K log₂ N": lambda p: p["K"] * math.log2(p["N"])}),
    ("selection in turn, serial dates", lambda top, p: top == "select_in_turn" and p["SERIAL"],
     {"log₂ N": lambda p: math.log2(p["N"]), "(K − 1) log₂ N": lambda p: (p["K"] - 1) * math.log2(p["N"])}),
    ("choice by dates", lambda top, p: top == "choose_by_dates", {"log₂ N K": lambda p: math.log2(p["N"] * p["K"])}),
    ("choice among registered", lambda top, p: top == "choose_in_turn",
     {"log₂ N K": lambda p: math.log2(p["N"] * p["K"])}),
    ("dates after a group", lambda top, p: top == "group_dates", {"log₂ N K": lambda p: math.log2(p["N"] * p["K"])}),
    ("selection of the oldest", lambda top, p: top == "select_oldest", {"": lambda p: 1, "K": lambda p: p["K"]}),
    ("segment queue", lambda top, p: top == "segment_queue",
     {"C": lambda p: p["CUT"], "log₂ DEPTH": lambda p: math.log2(p["DEPTH"])}),
    ("Packing Unit", lambda top, p: top == "packing_registers", {"log₂ 16 K": lambda p: math.log2(16 * p["ISSUE"])}),
]


def solve(matrix, right):
    """The solution of a small system of linear equations, by elimination."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i in range(len(rows)):
        best = max(range(i, len(rows)), key=lambda r: abs(rows[r][i]))
        rows[i], rows[best] = rows[best], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for r, row in enumerate(rows):
            if r != i:
                rows[r] = [a - row[i] * b for a, b in zip(row, rows[i])]
    return [row[-1] for row in rows]


def fit(rows, terms):
    """Coefficients for which the squares of the relative residuals have the least sum."""
    scaled = [[term(p) / area for term in terms.values()] for p, area in rows]
    normal = [[sum(row[i] * row[j] for row in scaled) for j in range(len(terms))] for i in range(len(terms))]
    return solve(normal, [sum(row[i] for row in scaled) for i in range(len(terms))])


def words_of(coefficients, terms):
    """A law as a reader writes it."""
    words = " + ".join(f"{c:.{1 if abs(c) >= 10 else 2}f} {term}".strip() for c, term in zip(coefficients, terms))
    return words.replace("+ -", "− ")


def law_of(name, mine, terms):
    """Prints the law through (parameters, number) of some points, and gives what it says of each of them."""
    coefficients = fit(mine, terms)
    said = [sum(c * term(p) for c, term in zip(coefficients, terms.values())) for p, _ in mine]
    worst = max(abs(law / number - 1) for law, (_, number) in zip(said, mine))
    print(f"| {name} | {words_of(coefficients, terms)} | {len(mine)} | {100 * worst:.1f} % |")
    return said, worst


def laws_of(points, results):
    """Prints the laws. Gives (area of the law, residual) of every point that has one, and the residuals of delays."""
    found, delays = {}, {}
    print("| law | area in library units, or FO4 | points | largest residual |\n|---|---|--:|--:|")
    for name, fits, registers, terms in LAWS:
        mine = [(point, results[name_of(point)]) for point in points if fits(*point) and "area" in results[name_of(point)]]
        if len(mine) <= len(terms):
            continue
        areas = [result["area"] - (0 if registers else result["flops"] * FLOP_AREA) for _, result in mine]
        said, _ = law_of(name, [(point[1], area) for (point, _), area in zip(mine, areas)], terms)
        for (point, _), area, law in zip(mine, areas, said):
            found[name_of(point)] = (law, law / area - 1)
    for name, fits, terms in DELAYS:
        mine = [(point[1], results[name_of(point)]["fo4"]) for point in points
                if fits(*point) and "fo4" in results[name_of(point)]]
        if len(mine) > len(terms):
            delays[name] = ("", law_of(name + ", FO4", mine, terms)[1])
    print()
    return found, delays


def cells_of(point, result, laws, pe):
    """A row of the table of points."""
    words = ", ".join(f"{key} {value}" for key, value in point[1].items())
    if "area" not in result:
        return [point[0], words, f"more than {LIMIT_S} s", "", "", "", ""]
    residual = laws.get(name_of(point))
    return [point[0], words, f"{result['area']:.0f}", str(result["flops"]),
            f"{result['area'] / pe:.3f}" if pe else "", f"{result['fo4']:.0f}",
            f"{100 * residual[1]:+.1f} %" if residual else ""]


def keep(points, results, laws, pe):
    """Writes docs/synthesis.csv. The area of a law is that of the logic alone for a selection."""
    names = [name.upper() for name in PARAMETERS]
    with open(KEPT, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["block", *(name.lower() for name in names), "area", "flops", "flop_area", "area_pe", "fo4",
                         "law_area", "residual"])
        for point in points:
            result, law = results[name_of(point)], laws.get(name_of(point))
            if "area" not in result:
                writer.writerow([point[0], *(point[1].get(name, "") for name in names)])
            else:
                writer.writerow([point[0], *(point[1].get(name, "") for name in names), f"{result['area']:.0f}",
                                 result["flops"], f"{FLOP_AREA:.0f}", f"{result['area'] / pe:.4f}",
                                 f"{result['fo4']:.1f}", f"{law[0]:.0f}" if law else "", f"{law[1]:.4f}" if law else ""])


def show(points, results, laws, pe):
    """Prints the table of points."""
    print("| block | parameters | area | flip-flops | PE | FO4 | law |\n|---|---|--:|--:|--:|--:|--:|")
    for point in points:
        print("| " + " | ".join(cells_of(point, results[name_of(point)], laws, pe)) + " |")


def kept_points():
    """Points of docs/synthesis.csv and their results."""
    with open(KEPT, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    points = [(row["block"], {name.upper(): int(row[name]) for name in row if name in PARAMETERS and row[name]})
              for row in rows]
    results = [{"area": float(row["area"]), "flops": int(row["flops"]), "fo4": float(row["fo4"])} if row["area"] else {}
               for row in rows]
    return points, {name_of(point): result for point, result in zip(points, results)}


def print_tables(points, results):
    """Prints the laws and the points, and gives the laws and the area of a PE."""
    laws, delays = laws_of(points, results)
    pe = results.get("pe-tuned0", {}).get("area")
    show(points, results, laws, pe)
    return laws, delays, pe


def refuse_far(laws, delays):
    """Fails if a point is not what its law says."""
    far = [f"{name}: {100 * law[1]:+.1f} %" for name, law in (laws | delays).items() if abs(law[1]) > 0.15]
    if far:
        sys.exit("further than 15 % from its law: " + ", ".join(far))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--block", choices=SOURCES, action="append")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/synthesis")
    options = parser.parse_args()
    if options.table:
        refuse_far(*print_tables(*kept_points())[:2])
        return
    missing = [tool for tool in ("yosys", "sta") if not shutil.which(tool)] + [str(LIBERTY)] * (not LIBERTY.exists())
    if missing:
        print("skipped: " + ", ".join(missing) + " is not installed")
        sys.exit(77)
    points = QUICK if options.quick else [point for point in POINTS if point[0] in (options.block or SOURCES)]
    with tempfile.TemporaryDirectory() as folder:
        fo4_ns = fan_out_of_4(folder)
        out = pathlib.Path(folder) if options.quick else options.out
        out.mkdir(parents=True, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            made = list(pool.map(lambda point: make(point, fo4_ns, out), points))
    results = {name_of(point): result for point, result in zip(points, made)}
    print(f"FO4 = {1000 * fo4_ns:.1f} ps; all points take {sum(result['seconds'] for result in made):.0f} s, one after the other.\n")
    if options.block:
        points, results = POINTS, kept_points()[1] | results
    laws, delays, pe = print_tables(points, results)
    if not options.quick:
        keep(points, results, laws, pe)
    refuse_far(laws, delays)


if __name__ == "__main__":
    main()
