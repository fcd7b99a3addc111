#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""programs.py SEED: writes a random C program without undefined behaviour to standard output.
programs.py --compare RUNNER FIRMWARE [--first SEED] [--count N]: compiles N such programs for the host and for rv32im,
runs the latter with RUNNER (tests/riscv/run_program.cpp), and fails if they write different words. FIRMWARE is the
folder with the start-up code. Exit code 77 if there is no cross compiler.

A program is some functions of 32-bit integers that call each other in one direction, with arithmetic of all operators,
loads and stores of 8, 16 and 32 bits, branches, loops and calls. main() emits a word after each of its calls and the
whole memory at the end. Shifts are by less than 32, divisors and signed dividends are odd, so that no quotient
overflows, sums are unsigned, conversions to signed are those of GCC, and an expression has no call beside a load,
because C leaves their order open.
"""
import argparse
import concurrent.futures
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

WORDS = 64  # of memory
UNSIGNED = ["({a} + {b})", "({a} - {b})", "({a} * {b})", "({a} & {b})", "({a} | {b})", "({a} ^ {b})",
            "({a} << ({b} & 31))", "({a} >> ({b} & 31))", "({a} / ({b} | 1))", "({a} % ({b} | 1))",
            "(uint32_t)({a} < {b})", "(uint32_t)({a} == {b})", "(uint32_t)((uint64_t){a} * {b} >> 32)",
            "(uint32_t)((uint64_t){a} * 0x9E3779B97F4A7C15u / ({b} | 1))"]
SIGNED = ["(uint32_t)(S({a}) >> ({b} & 31))", "(uint32_t)(S({a} | 1) / S({b} | 1))",
          "(uint32_t)(S({a} | 1) % S({b} | 1))", "(uint32_t)(S({a}) < S({b}))",
          "(uint32_t)((int64_t)S({a}) * S({b}) >> 32)", "(uint32_t)((int64_t)S({a}) * (int64_t)(uint64_t){b} >> 32)",
          "(uint32_t)(int8_t){a}", "(uint32_t)(int16_t){a}", "(uint32_t)-S({a} | 1)"]
EDGES = [0, 1, 2, 31, 0x7F, 0x80, 0xFF, 0x7FF, 0x800, 0xFFF, 0x7FFF, 0x8000, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF]


class Program:
    """Draws everything from one generator, so that a seed is a program."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.lines = []
        self.loops = 0

    def constant(self):
        value = self.random.choice(EDGES) if self.random.random() < 0.4 else self.random.getrandbits(32)
        return f"0x{value:X}u"

    def load(self, depth):
        kind, mask = self.random.choice([("w", WORDS - 1), ("h", 2 * WORDS - 1), ("b", 4 * WORDS - 1)])
        sign = "" if kind == "w" else self.random.choice(["", "s"])
        return f"(uint32_t)memory.{sign}{kind}[{self.expression(depth - 1)} & {mask}]"

    def expression(self, depth):
        if depth <= 0 or self.random.random() < 0.1:
            return self.constant() if self.random.random() < 0.3 else self.random.choice(self.names)
        kind = self.random.random()
        if kind < 0.2:
            return self.load(depth)
        if kind < 0.26:
            return f"({self.expression(depth - 1)} ? {self.expression(depth - 1)} : {self.expression(depth - 1)})"
        form = self.random.choice(SIGNED if kind < 0.62 else UNSIGNED)
        return form.format(a=self.expression(depth - 1), b=self.expression(depth - 1))

    def store(self, indent):
        kind, mask, cast = self.random.choice([("w", WORDS - 1, ""), ("h", 2 * WORDS - 1, "(uint16_t)"),
                                               ("b", 4 * WORDS - 1, "(uint8_t)")])
        self.lines.append(f"{indent}memory.{kind}[{self.expression(1)} & {mask}] = {cast}{self.expression(2)};")

    def statements(self, count, indent, nested):
        for _ in range(count):
            kind = self.random.random()
            if kind < 0.3:
                self.store(indent)
            elif kind < 0.45 and nested:
                self.lines.append(f"{indent}if ({self.expression(2)}) {{")
                self.statements(2, indent + "    ", nested - 1)
                self.lines.append(f"{indent}}} else {{")
                self.statements(1, indent + "    ", nested - 1)
                self.lines.append(f"{indent}}}")
            elif kind < 0.6 and nested:
                counter = f"i{self.loops}"
                self.loops += 1
                rounds = self.random.randint(1, 6)
                self.lines.append(f"{indent}for (uint32_t {counter} = 0; {counter} < {rounds}; ++{counter}) {{")
                callees, self.callees = self.callees, []  # calls in loops would multiply
                self.statements(2, indent + "    ", nested - 1)
                self.callees = callees
                self.lines.append(f"{indent}}}")
            elif kind < 0.7 and self.callees:
                arguments = ", ".join(self.expression(2) for _ in range(3))
                self.lines.append(f"{indent}{self.random.choice('abc')} = {self.random.choice(self.callees)}({arguments});")
            else:
                self.lines.append(f"{indent}{self.random.choice('abc')} = {self.expression(4)};")

    def text(self):
        self.lines = ["/* Written by tests/riscv/programs.py. */", '#include "world.h"', "#define S(x) ((int32_t)(x))",
                      "static union {", f"    uint32_t w[{WORDS}];", f"    uint16_t h[{2 * WORDS}];",
                      f"    int16_t sh[{2 * WORDS}];", f"    uint8_t b[{4 * WORDS}];", f"    int8_t sb[{4 * WORDS}];",
                      "} memory;"]
        functions = []
        for number in range(self.random.randint(3, 5)):
            self.names, self.callees = ["a", "b", "c"], functions[-2:]
            self.lines += [f"static __attribute__((noinline)) uint32_t f{number}(uint32_t a, uint32_t b, uint32_t c) {{"]
            self.statements(self.random.randint(3, 6), "    ", 2)
            self.lines += ["    return a ^ b ^ c;", "}"]
            functions.append(f"f{number}")
        self.lines += ["int main(void) {"]
        for _ in range(6):
            call = ", ".join(self.constant() for _ in range(3))
            self.lines += [f"    emit({self.random.choice(functions)}({call}));"]
        self.lines += [f"    for (int i = 0; i < {WORDS}; ++i) {{", "        emit(memory.w[i]);", "    }", "    return 0;",
                       "}"]
        return "\n".join(self.lines) + "\n"


CORE = ["riscv64-unknown-elf-gcc", "-march=rv32im", "-mabi=ilp32", "-ffreestanding", "-nostdlib"]
LEVELS = ["-O0", "-O1", "-O2", "-Os"]


def run(command, **options):
    return subprocess.run(command, check=True, timeout=60, **options)


def words(seed, folder, runner, link):
    """What the program of `seed` emits on the host and on the core, whose compiler links with `link`."""
    source = folder / f"{seed}.c"
    source.write_text(Program(seed).text())
    common = ["-std=c11", "-w", "-I", pathlib.Path(__file__).parent, source]
    host, core = folder / f"{seed}.host", folder / f"{seed}.core"
    run(["gcc", "-O1", *common, "-o", host])
    run([*CORE, LEVELS[seed % len(LEVELS)], *common, *link, "-o", core])
    return [run(command, capture_output=True, text=True).stdout for command in ([host], [runner, core])]


def compare(runner, firmware, first, count):
    start, emitted = time.monotonic(), 0
    with tempfile.TemporaryDirectory() as name:
        folder, firmware = pathlib.Path(name), pathlib.Path(firmware).resolve()
        link = ["-T", firmware / "link.ld", folder / "start.o", folder / "memory.o", "-lgcc"]
        run([*CORE, "-O2", "-c", firmware / "start.S", firmware / "memory.c"], cwd=folder)
        seeds = range(first, first + count)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for seed, (host, core) in zip(seeds, pool.map(lambda seed: words(seed, folder, runner, link), seeds)):
                if host != core or not host:
                    sys.exit(f"program {seed}: the host emits\n{host}and the core emits\n{core}")
                emitted += host.count("\n")
    print(f"{count} programs emit the same {emitted} words on the host and on the core, in "
          f"{time.monotonic() - start:.1f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seed", type=int, nargs="?")
    parser.add_argument("--compare", nargs=2, metavar=("RUNNER", "FIRMWARE"))
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=30)
    arguments = parser.parse_args()
    if not arguments.compare:
        sys.stdout.write(Program(arguments.seed or 1).text())
    elif not shutil.which("riscv64-unknown-elf-gcc"):
        print("skipped: there is no riscv64-unknown-elf-gcc (scripts/install.sh --tests installs it)")
        sys.exit(77)
    else:
        compare(*arguments.compare, arguments.first, arguments.count)


if __name__ == "__main__":
    main()
