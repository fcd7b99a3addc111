#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mutations.py [--build FOLDER] [--only N ...]: can the comparison of the bank's RTL with the model miss an error?

Changes one place of the RTL at a time, makes the models of Verilator again and runs rtl/bank_test on one view per
design. Every change must be found. Takes ten minutes on a processor; needs a release build with tests and DEGS_SCENES.
"""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BANK, PACKING, TOP = "issue_bank.sv", "packing_unit.sv", "bank_top.sv"
# What is changed, where, from and to, and for which bank.
MUTATIONS = [
    ("a domain is ready a cycle later", BANK, "cool_n[i] <= rel_n)", "cool_n[i] < rel_n)", "64"),
    ("the reuse distance is one longer", BANK, "/ WIDTH + REUSE;", "/ WIDTH + REUSE + 1;", "64"),
    ("the turn stays at the domain that issued", BANK, "cursor_n[slot] = pick % DOMAINS + 1 == DOMAINS ? 0 : pick % DOMAINS + 1;",
     "cursor_n[slot] = pick % DOMAINS;", "64"),
    ("the younger tile goes first", BANK, "            slot = oldest_n[s] + x;", "            slot = oldest_n[s] + SLOTS - 1 - x;", "64"),
    ("two packets may wait", BANK, "(total + WIDTH - 1) / WIDTH <= PACKETS", "(total + WIDTH - 1) / WIDTH <= 2", "64"),
    ("any number of packets is written", BANK, "(unwritten_n == 0 || unwritten_n + complete <= WRITES)", "1", "64"),
    ("a packet waits for none before it", BANK, "unwritten_n + complete <= WRITES", "0", "64"),
    ("an open packet goes a cycle early", BANK, "if (tasks_n != 0 && rel_n == 0)", "if (tasks_n != 0 && rel_n <= 1)", "64"),
    ("an ended region keeps its segments", BANK, "          if (&gone_n[i]) begin", "          if (0) begin", "64"),
    ("a segment of an ended region is queued", BANK, ": !(&gone_n[cut_n]);", ": 1;", "64"),
    ("a full queue keeps an ended segment", BANK, "if (go && full) stop = 1;", "if (full) stop = 1;", "64"),
    ("a column outside of the image lives", BANK, "+ j >= s_width[", "+ j > s_width[", "64"),
    ("a context that comes back is not seen", BANK, "startable[s] + {2'b0, context_free[s*2 +: 2]};", "startable[s];", "64"),
    ("an open packet carries two ends", BANK, "if (tasks_n != 0 && carries_n) begin", "if (0) begin", "64"),
    ("a tile starts without a context", BANK, "x < startable_n[s] && ", "", "64"),
    ("one segment less is cut", BANK, "c < CUT; c++) begin\n      if (left_n", "c < CUT - 1; c++) begin\n      if (left_n", "64"),
    ("the first task of a packet is lost", PACKING, "l < tasks) lane", "l + 1 < tasks) lane", "64"),
    ("pixels of a segment are packed from the highest on", PACKING, "i_mask[k*SEG+j])", "i_mask[k*SEG+SEG-1-j])", "64"),
    ("a segment that is issued when it is cut has the old tag", TOP, "if (c_valid[c] && c_entry[c*EB", "if (0 && c_entry[c*EB", "64"),
    ("the youngest head goes first", BANK, "- best) < 0)", "- best) > 0)", "x_64"),
    ("ended pixels are issued", BANK, "PIXELS ? mask_n[entry] & ~gone_n[pick]", "PIXELS ? mask_n[entry]", "x_64"),
    ("spans come from one stream first", BANK, "turn_n = turn_n + 1 == STREAMS ? 0 : turn_n + 1;", "turn_n = 0;", "x_64"),
]
X_64 = ["STREAMS=3", "SLOTS=1", "CONTEXTS=1", "DOMAINS=16", "DEPTH=96", "CUT=4", "SPANS=4", "ISSUE=4", "WIDTH=16",
        "PIXELS=1", "OLDEST=1", "MESSAGES=16"]
PARAMETERS = {"64": ["MESSAGES=8"], "x_64": X_64}
TESTS = {"64": "Scenes/Bank64.*/0", "x_64": "Scenes/BankX64.*/0"}


def run(command, **more):
    return subprocess.run(command, capture_output=True, text=True, **more)


def verilate(folder, bank):
    """The library of the changed model."""
    made = run(["verilator", "--cc", "--build", "-O3", "--x-assign", "fast", "--x-initial", "fast", "--unroll-count", "256",
                "--unroll-stmts", "100000", "-Wno-WIDTH", "--top-module", "bank_top", "--prefix", f"Vbank_{bank}",
                "--Mdir", str(folder / "model"), "-CFLAGS", "-O1", *(f"-G{one}" for one in PARAMETERS[bank]),
                *(str(folder / name) for name in (TOP, BANK, PACKING))])
    if made.returncode != 0:
        sys.exit(f"mutations.py: Verilator refuses the change:\n{made.stderr[-2000:]}")
    return folder / "model" / f"Vbank_{bank}__ALL.a"


def try_mutation(build, number):
    """True if the tests find it."""
    what, name, old, new, bank = MUTATIONS[number]
    folder = build / "mutations" / str(number)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for source in (BANK, PACKING, TOP):
        text = (HERE / source).read_text()
        if source == name:
            if text.count(old) != 1:
                sys.exit(f"mutations.py: '{old}' stands {text.count(old)} times in {source}, not once.")
            text = text.replace(old, new)
        (folder / source).write_text(text)
    library = verilate(folder, bank)
    objects = sorted((build / "tests/CMakeFiles/degs_rtl_tests.dir").rglob("*.o"))
    linked = run(["g++", *map(str, objects), str(library), str(build / "tests/rtl/libdegs_rtl_models.a"),
                  str(build / "libdegs_tlm.a"), str(build / "libdegs_stats.a"), str(build / "libdegs_config.a"),
                  str(build / "libdegs_base.a"), "-lgmock", "-lgtest", "-lsystemc", "-lyaml-cpp", "-lpthread", "-latomic",
                  "-o", str(folder / "test")])
    if linked.returncode != 0:
        sys.exit(f"mutations.py: the test cannot be linked:\n{linked.stderr[-2000:]}")
    tested = run([str(folder / "test"), f"--gtest_filter={TESTS[bank]}"])
    if "SKIPPED" in tested.stdout or "[ RUN " not in tested.stdout:
        sys.exit("mutations.py: the test did not run: " + tested.stdout[-500:])
    found = tested.returncode != 0
    first = next((line.strip() for line in tested.stdout.splitlines() if line.strip().startswith("cycle ")), "")
    print(f"| {number + 1} | {what} | {bank.replace('_', '-')} | {'found' if found else 'MISSED'} | {first} |", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--only", type=int, action="append", help="number of a change; all if none is named")
    options = parser.parse_args()
    print("| | change | bank | | first difference |\n|--:|---|---|---|---|")
    numbers = [one - 1 for one in options.only] if options.only else range(len(MUTATIONS))
    missed = [number + 1 for number in numbers if not try_mutation(options.build, number)]
    if missed:
        sys.exit(f"mutations.py: changes that no test finds: {', '.join(map(str, missed))}.")


if __name__ == "__main__":
    main()
