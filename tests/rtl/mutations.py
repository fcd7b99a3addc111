#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mutations.py [--build FOLDER] [--only N ...]: can the comparisons of the RTL with the model miss an error?

Changes one place of the RTL at a time, makes the models of Verilator again and runs the tests of that block, of a bank
on one view per design. Every change must be found. Takes fifteen minutes on a processor; needs a release build with
tests and DEGS_SCENES.
"""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BANK, PACKING, TOP = "issue_bank.sv", "packing_unit.sv", "bank_top.sv"
NUMBERS, TABLES, SPAN, PE = "arithmetic.sv", "tables.sv", "span_unit.sv", "pe.sv"
# What is changed, where, from and to, and for which block.
MUTATIONS = [
    ("a domain is ready a cycle later", BANK, "cool_n[i] <= rel_n &&", "cool_n[i] < rel_n &&", "64"),
    ("the reuse distance is one longer", BANK, "/ WIDTH + REUSE;", "/ WIDTH + REUSE + 1;", "64"),
    ("the turn stays at the domain that issued", BANK, "cursor_n[slot] = pick % DOMAINS + 1 == DOMAINS ? 0 : pick % DOMAINS + 1;",
     "cursor_n[slot] = pick % DOMAINS;", "64"),
    ("the younger tile goes first", BANK, "          slot = oldest_n[s] + x;", "          slot = oldest_n[s] + SLOTS - 1 - x;", "64"),
    ("two packets may wait", BANK, "(total + WIDTH - 1) / WIDTH <= PACKETS", "(total + WIDTH - 1) / WIDTH <= 2", "64"),
    ("any number of packets is written", BANK, "(unwritten_n == 0 || unwritten_n + complete <= WRITES)", "1", "64"),
    ("a packet waits for none before it", BANK, "unwritten_n + complete <= WRITES", "0", "64"),
    ("an open packet goes a cycle early", BANK, "if (tasks_n != 0 && rel_n == 0)", "if (tasks_n != 0 && rel_n <= 1)", "64"),
    ("an ended region keeps its segments", BANK, "          if (&gone_n[i]) begin", "          if (0) begin", "64"),
    ("a segment of an ended region is queued", BANK, ": !(&gone_n[cut_n]);", ": 1;", "64"),
    ("a full queue keeps an ended segment", BANK, "if (go && full) stop = 1;", "if (full) stop = 1;", "64"),
    ("the last column of the image has ended", BANK, "+ j >= s_width[", "+ j + 1 >= s_width[", "x_64"),
    ("a context that comes back is not seen", BANK, "startable[s] + {2'b0, context_free[s*2 +: 2]};", "startable[s];", "64"),
    ("an open packet carries two ends", BANK, "if (tasks_n != 0 && carries_n) begin", "if (0) begin", "64"),
    ("a tile starts without a context", BANK, "x < startable_n[s] && ", "", "64"),
    ("one segment less is cut", BANK, "c < CUT; c++) begin\n      if (left_n", "c < CUT - 1; c++) begin\n      if (left_n", "64"),
    ("the first task of a packet is lost", PACKING, "l < tasks) lane", "l + 1 < tasks) lane", "64"),
    ("pixels of a segment are packed from the highest on", PACKING, "& i_mask[i];", "& i_mask[i/SEG*SEG+SEG-1-i%SEG];", "64"),
    ("tasks go to the first lanes of an open packet", PACKING, "near[0] = tasks[COUNT-1:0];", "near[0] = 0;", "64"),
    ("the tree of sums ends a level early", PACKING, "d < HALF; d = 2 * d", "2 * d < HALF; d = 2 * d", "64"),
    ("half of the pixels count nothing before them", PACKING, "i < HALF ? 0 : near[HALF-1]", "0", "64"),
    ("places are compared without carries", PACKING, "(a & b) | ((a | b) & ~sum)", "a & b", "64"),
    ("a segment that is issued when it is cut has the old tag", TOP, "if (c_valid[c] && c_entry[c*EB", "if (0 && c_entry[c*EB", "64"),
    ("the youngest head goes first", BANK, "- best) < 0)", "- best) > 0)", "x_64"),
    ("ended pixels are issued", BANK, "PIXELS ? mask_n[entry] & ~gone_n[pick]", "PIXELS ? mask_n[entry]", "x_64"),
    ("spans come from one stream first", BANK, "turn_n = turn_n + 1 == STREAMS ? 0 : turn_n + 1;", "turn_n = 0;", "x_64"),
    ("a chosen domain is chosen again", BANK, "(SELECT == 0 || !picked[i])", "1", "64_select"),
    ("a group leaves the one before that waits for room", BANK, "if (SELECT != 0 && chosen[0] == 0)", "if (SELECT != 0)", "64_select"),
    ("an ended region keeps its place in a group", BANK, "== i) chosen_n[g][k] = 0;", "== i && rst) chosen_n[g][k] = 0;", "64_select"),
    ("ties are rounded up", NUMBERS, "half & (finer | whole[0])}", "half}", "span_1"),
    ("ties of floats are rounded up", NUMBERS, "half & (finer | shifted[L-1-M])}", "half}", "pe_0"),
    ("subnormals are flushed", NUMBERS, "assign mantissa = {!subnormal, code[M-1:0]};",
     "assign mantissa = subnormal ? {W{1'b0}} : {1'b1, code[M-1:0]};", "pe_0"),
    ("a fixed sum wraps", NUMBERS, "| (mantissa != 0 && high >= VALUE) | rounded > MOST;", ";", "pe_1"),
    ("saturation is not symmetric", NUMBERS, "FORMAT[30] ? -magnitude :", "FORMAT[30] ? (over ? ~magnitude : -magnitude) :", "span_0"),
    ("a sum forgets what it shifts out", NUMBERS, "moved[0] | lost}", "moved[0]}", "pe_0"),
    ("infinity less infinity is infinite", NUMBERS, "(ai & bi & as != b_sign)", "1'b0", "pe_0"),
    ("zero times infinity is infinite", NUMBERS, "a_nan | b_nan | (a_infinite & b == 0)", "a_nan | b_nan", "span_0"),
    ("the last cell of the root is not the last", TABLES, "cell_now > 255 ? 8'd255 : ", "", "span_0"),
    ("the root's part is cut", TABLES, "whole + (rest > 3072 || (rest == 3072 && whole[0]))", "whole", "span_1"),
    ("log2(e) / 2 has 12 bits", TABLES, "24'd12102203", "24'd12103680", "pe_0"),
    ("alpha is not limited", TABLES, "above_3 || shifted > MOST ? MOST : shifted", "shifted", "pe_1"),
    ("a row with x = 1 misses", SPAN, "x_3 <= (TUNED", "x_3 < (TUNED", "span_1"),
    ("delta is 1 at half a pixel", NUMBERS, "x > y);", "x >= y);", "span_0"),
    ("delta is 0", SPAN, "n_6 | i_6 | beyond", "1'b0", "span_0"),
    ("the right end is cut a column early", SPAN, "$signed({1'b0, columns_8}) - 1", "$signed({1'b0, columns_8}) - 2", "span_0"),
    ("half pixels are rounded up", SPAN, "half & (finer | floor_centre[0])", "half", "span_1"),
    ("a cut does not lower the limit", SPAN, "(27'd134122994, cut_1,", "(27'd134122994, 21'd0,", "span_1"),
    ("T of a stopping pixel is a unit off", PE, "18'd27 : 16'h068e", "18'd27 : 16'h068f", "pe_0"),
    ("T of a stopping pixel is a unit off", PE, "18'd27 : 16'h068e", "18'd28 : 16'h068e", "pe_1"),
    ("the rule `after` refuses", PE, "(stops_after_10 | !stops)", "!stops", "pe_1"),
    ("the low half of n has five bits", PE, "n < 0 ? -{1'b0, magnitude[3:0]} : {1'b0, magnitude[3:0]}",
     "n < 0 ? -{1'b0, magnitude[3:0]} : magnitude[4:0]", "pe_0"),
    ("a pixel with T = 1 has T = 0", PE, "{live_8 & t_8 == 0, t_8}", "{1'b0, t_8}", "pe_1"),
    ("T is written back a stage early", PE, "t <= valid_10 & blends ? after_10 : before_10;",
     "t <= valid_10 & blends ? after : before_10;", "pe_1"),
]
X_64 = ["STREAMS=2", "SLOTS=1", "CONTEXTS=1", "DEPTH=48", "PIXELS=1", "OLDEST=1", "MESSAGES=8"]
# Top module, sources, parameters and tests of each block.
BLOCKS = {
    "64": ("bank_top", (TOP, BANK, PACKING), ["MESSAGES=8"], "Scenes/Bank64.*/0"),
    "64_select": ("bank_top", (TOP, BANK, PACKING), ["MESSAGES=8", "SELECT=2"], "Scenes/PipelinedBank64.*/0"),
    "x_64": ("bank_top", (TOP, BANK, PACKING), X_64, "Scenes/BankX64.*/0"),
    "span_0": ("span_unit", (NUMBERS, TABLES, SPAN), ["TUNED=0"], "SpanUnitRtl.*Paper*"),
    "span_1": ("span_unit", (NUMBERS, TABLES, SPAN), ["TUNED=1"], "SpanUnitRtl.Solves*Tuned*"),
    "pe_0": ("pe", (NUMBERS, TABLES, PE), ["TUNED=0"], "PeRtl.*Paper*"),
    "pe_1": ("pe", (NUMBERS, TABLES, PE), ["TUNED=1"], "PeRtl.*Tuned*"),
}
LIBRARIES = ["cost", "tlm", "splat", "stats", "config", "base"]


def run(command, **more):
    return subprocess.run(command, capture_output=True, text=True, **more)


def verilate(folder, block):
    """The library of the changed model."""
    top, sources, parameters, _ = BLOCKS[block]
    prefix = f"Vbank_{block}" if top == "bank_top" else f"V{block}"
    made = run(["verilator", "--cc", "--build", "-O3", "--x-assign", "fast", "--x-initial", "fast", "--unroll-count", "256",
                "--unroll-stmts", "100000", "-Wno-WIDTH", "--top-module", top, "--prefix", prefix,
                "--Mdir", str(folder / "model"), "-CFLAGS", "-O1", *(f"-G{one}" for one in parameters),
                *(str(folder / name) for name in sources)])
    if made.returncode != 0:
        sys.exit(f"mutations.py: Verilator refuses the change:\n{made.stderr[-2000:]}")
    return folder / "model" / f"{prefix}__ALL.a"


def try_mutation(build, number):
    """True if the tests find it."""
    what, name, old, new, block = MUTATIONS[number]
    folder = build / "mutations" / str(number)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for source in BLOCKS[block][1]:
        text = (HERE / source).read_text()
        if source == name:
            if text.count(old) != 1:
                sys.exit(f"mutations.py: '{old}' stands {text.count(old)} times in {source}, not once.")
            text = text.replace(old, new)
        (folder / source).write_text(text)
    library = verilate(folder, block)
    objects = sorted((build / "tests/CMakeFiles/degs_rtl_tests.dir").rglob("*.o"))
    # Models share objects, so that what is changed stands twice: the first one counts.
    linked = run(["g++", "-Wl,--allow-multiple-definition", *map(str, objects), str(library),
                  str(build / "tests/rtl/libdegs_rtl_models.a"),
                  *(str(build / f"libdegs_{one}.a") for one in LIBRARIES), "-lgmock", "-lgtest", "-lsystemc",
                  "-lyaml-cpp", "-ljemalloc", "-lpthread", "-latomic",
                  "-o", str(folder / "test")])
    if linked.returncode != 0:
        sys.exit(f"mutations.py: the test cannot be linked:\n{linked.stderr[-2000:]}")
    tested = run([str(folder / "test"), f"--gtest_filter={BLOCKS[block][3]}"])
    if "SKIPPED" in tested.stdout or "[ RUN " not in tested.stdout:
        sys.exit("mutations.py: the test did not run: " + tested.stdout[-500:])
    found = tested.returncode != 0
    first = next((line.strip() for line in tested.stdout.splitlines() if line.strip().startswith(("cycle ", "RTL:", "EXPECT"))), "")
    print(f"| {number + 1} | {what} | {block.replace('_', '-')} | {'found' if found else 'MISSED'} | {first} |", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--only", type=int, nargs="+", help="number of a change; all if none is named")
    options = parser.parse_args()
    print("| | change | block | | first difference |\n|--:|---|---|---|---|")
    numbers = [one - 1 for one in options.only] if options.only else range(len(MUTATIONS))
    missed = [number + 1 for number in numbers if not try_mutation(options.build, number)]
    if missed:
        sys.exit(f"mutations.py: changes that no test finds: {', '.join(map(str, missed))}.")


if __name__ == "__main__":
    main()
