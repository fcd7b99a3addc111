#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bandwidth of the memories of configs/memory under reads, beside that of Ramulator 2.1.

    memory_reference.py run RAMULATOR    measures both; writes docs/memories.csv
    memory_reference.py table            Markdown table from docs/memories.csv

This is a script, and no declaration of scripts/tables, because the table stands on a foreign program: without it
measure.py could neither write the table nor check it.

RAMULATOR is a built copy of the public repository CMU-SAFARI/ramulator2 (2.1; its Python bindings are used). Both
simulators read 64 B at a time, from addresses in a row (`stream`) or at random, with a queue of 32 accesses per channel
that is always full, open pages and all-bank refresh. Ramulator has one channel, and gets the requests of one channel
after our address mapping. Where a file differs from the preset of Ramulator (docs/memories.md says why), `run` measures
ours with the preset's values as well. The program is DEGS_PROGRAM, or build/release/sim/degs."""
import argparse
import csv
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("DEGS_PROGRAM", ROOT / "build/release/sim/degs")
MEASURED = ROOT / "docs/memories.csv"
REQUESTS = 40000
GROUPS = 4  # of banks, unless a memory says otherwise
# File, standard, organisation and timing of Ramulator, controller, and what the file has otherwise.
MEMORIES = [
    ("lpddr5-6400x256", "LPDDR5", "LPDDR5_8Gb_x16", "LPDDR5_6400", "LPDDR5", {}),
    ("lpddr6-10667x96", "LPDDR6", "LPDDR6_16Gb_x12", "LPDDR6_10667_BL24", "LPDDR6", {}),
    ("ddr5-6400x128", "DDR5", "DDR5_16Gb_x8", "DDR5_6400AN", "GenericDDR", {"rrd": 16, "faw": 64, "wtr_s": 5}),
    ("gddr6-14000x256", "GDDR6", "GDDR6_8Gb_x16", "GDDR6_14000_1350mV_double", "GenericDDR", {}),
    ("hbm3-6400x1024", "HBM3", "HBM3_4Gb", "HBM3_6400Mbps", "HBM34", {"rfc_ab": 416}),
]
PATTERNS = ("stream", "random")


def ours(name, pattern, changes):
    """Share of the peak, in percent."""
    with tempfile.TemporaryDirectory() as folder:
        file = ROOT / f"configs/memory/{name}.yaml"
        if changes:
            timing = "".join(f"  {key}: {value}\n" for key, value in changes.items())
            changed = Path(folder) / f"{name}.yaml"
            changed.write_text(f"include: {file}\nname: {name}\ntiming:\n{timing}")
            file = changed
        subprocess.run([PROGRAM, "memory", file, "--pattern", pattern, "--no-curve", "--out", folder], check=True,
                       stdout=subprocess.DEVNULL)
        report = json.loads((Path(folder) / "memory.json").read_text())
        return 100 * report["bandwidth_fraction"]


def places(pattern, groups, banks, blocks, rows):
    """(group, bank, row, block of 64 B) of one channel, by the default mapping: column:2 group column bank row."""
    if pattern == "random":
        lot = random.Random(1)
        for _ in range(REQUESTS):
            yield lot.randrange(groups), lot.randrange(banks), lot.randrange(rows), lot.randrange(blocks)
        return
    for access in range(REQUESTS):
        low, rest = access % 4, access // 4
        group, rest = rest % groups, rest // groups
        high, rest = rest % (blocks // 4), rest // (blocks // 4)
        bank, row = rest % banks, rest // banks
        yield group, bank, row, 4 * high + low


def reference(ramulator, memory, pattern):
    """Share of the peak, in percent, of one channel of Ramulator."""
    _, standard, organisation, timing, controller, _ = memory
    dram = getattr(ramulator.dram, standard)(org_preset=organisation, timing_preset=timing)
    counts, times = dram.resolve()
    prefetch = type(dram).internal_prefetch_size
    burst_bytes = getattr(type(dram), "data_payload_bytes", None) or counts["channel_width"] * prefetch // 8
    pseudo = counts.get("pseudochannel", 1)
    bursts = 64 // burst_bytes
    blocks = counts["column"] // prefetch // bursts
    levels = list(type(dram).levels)
    with tempfile.NamedTemporaryFile("w", suffix=".trace") as trace:
        for group, bank, row, block in places(pattern, counts["bankgroup"], counts["bank"], blocks, counts["row"]):
            for channel in range(pseudo):
                for burst in range(bursts):
                    place = {"PseudoChannel": channel, "BankGroup": group, "Bank": bank, "Row": row,
                             "Column": (block * bursts + burst) * prefetch}
                    trace.write("R " + ",".join(str(place.get(level, 0)) for level in levels) + "\n")
        trace.flush()
        entries = 32 * bursts * pseudo
        control = getattr(ramulator.controller, controller)(
            dram=dram, scheduler=ramulator.scheduler.FRFCFSRowHit(), row_policy=ramulator.row_policy.Open(),
            addr_mapper=ramulator.addr_mapper.PassThroughAddrMapper(),
            refresh_manager=ramulator.refresh_manager.AllBank(), read_buffer_size=entries, write_buffer_size=entries)
        memory_system = ramulator.memory_system.GenericDRAM(
            clock_ratio=1, controllers=[control], channel_mapper=ramulator.channel_mapper.PassThroughChannelMapper())
        frontend = ramulator.frontend.ReadWriteTrace(clock_ratio=8, path=trace.name)
        simulation = ramulator.Simulation(frontend, memory_system)
        simulation.run()
    stats = simulation.stats["memory_system"]["controller"]
    ticks = getattr(type(dram), "tick_multiplier", 1)
    sent = REQUESTS * bursts * pseudo
    data = sent * times.get("nBL", times.get("nBL_min")) / pseudo
    return 100 * data / (stats["cycles"] / ticks)


def run(folder):
    sys.path.insert(0, str(Path(folder).resolve() / "python"))
    import ramulator
    rows = []
    for memory in MEMORIES:
        name, changes = memory[0], memory[-1]
        for pattern in PATTERNS:
            shipped = ours(name, pattern, {})
            same = ours(name, pattern, changes) if changes else shipped
            other = reference(ramulator, memory, pattern)
            rows.append({"memory": name, "pattern": pattern, "shipped": f"{shipped:.1f}", "as_preset": f"{same:.1f}",
                         "ramulator": f"{other:.1f}"})
            print(*rows[-1].values(), flush=True)
    with open(MEASURED, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def table():
    with open(MEASURED, newline="") as file:
        rows = {(row["memory"], row["pattern"]): row for row in csv.DictReader(file)}
    print("| file | " + " | ".join(f"{p}, shipped | {p}, as the preset | {p}, Ramulator" for p in PATTERNS) + " |")
    print("|---|" + "--:|" * 3 * len(PATTERNS))
    for name in dict.fromkeys(name for name, _ in rows):
        cells = [rows[name, p][column] for p in PATTERNS for column in ("shipped", "as_preset", "ramulator")]
        print(f"| `{name}` | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("run").add_argument("ramulator", metavar="RAMULATOR")
    commands.add_parser("table")
    arguments = parser.parse_args()
    run(arguments.ramulator) if arguments.command == "run" else table()


if __name__ == "__main__":
    main()
