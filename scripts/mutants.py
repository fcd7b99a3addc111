#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mutants.py: small mistakes, put into a copy of the sources on purpose; the tests must notice each (docs/mutants.md).

    mutants.py --check                  every entry of tests/mutants/*.yaml applies, and there are enough of them
    mutants.py list [NAME ...]          names, files and what is wrong
    mutants.py run [NAME ...]           builds a copy with all of them and tests one after the other
    mutants.py count                    how many there are by folder, and what became of them by docs/mutants.csv

NAME is a mutant (dram/tfaw-window-holds-three-acts), a table (dram) or a pattern (sim*/*energy*).

`run` patches all mutants into one copy; the environment variable DEGS_MUTANT=NAME selects one at run time, in child
processes, too. Tests run with ctest, nearest first, up to the first that fails; one that takes longer than its limit
has failed. Finished rows of docs/mutants.csv whose entry is the same are kept, so that a run can be continued."""
import argparse
import concurrent.futures
import csv
import dataclasses
import fnmatch
import hashlib
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
LEAST = {"sim": 40}  # mutants of a room; LEAST_OTHER of one of src
LEAST_OTHER = 3
LEAST_ALL = 120
# These look at the sources, at packages or at the clock instead of what the program does.
NO_TESTS = r"^(house|style|packaging|bench)/|^docs/(site|facts|width|words|self_test)|_NOT_BUILT$"
NO_LABELS = {"all", "lint"}  # "all": outside of the core suite
COLUMNS = ["table", "what", "file", "verdict", "killed_by", "seconds", "entry"]
HEADER = """// Selects the mutant whose name DEGS_MUTANT has.
#pragma once
#include <cstdint>
#include <cstdlib>
inline std::uint64_t degs_mutant_hash(const char* name) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (; name != nullptr && *name != 0; ++name) {
        hash = (hash ^ static_cast<unsigned char>(*name)) * 0x100000001b3U;
    }
    return hash;
}
inline const std::uint64_t degs_mutant_selected = degs_mutant_hash(std::getenv("DEGS_MUTANT"));
inline bool degs_mutant(std::uint64_t hash) { return hash == degs_mutant_selected; }
"""


class Refused(Exception):
    """Why a table or a run is not accepted."""


@dataclasses.dataclass(frozen=True)
class Mutant:
    table: str
    file: str
    what: str
    before: str
    after: str
    equivalent: str

    @property
    def name(self):
        return f"{self.table}/{re.sub('[^a-z0-9]+', '-', self.what.lower()).strip('-')}"

    @property
    def room(self):
        return room_of(self.table)

    @property
    def condition(self):
        value = 0xcbf29ce484222325
        for byte in self.name.encode():
            value = (value ^ byte) * 0x100000001b3 % 2**64
        return f"::degs_mutant({value:#x}U)"

    @property
    def digest(self):
        fields = "\0".join((self.name, self.file, self.before, self.after, self.equivalent))
        return hashlib.sha256(fields.encode()).hexdigest()[:10]


def room_of(table):
    """sim.yaml and sim-*.yaml are tables of one room."""
    return table.split("-")[0]


def read_tables(root):
    """All mutants, in the order of the tables, and a message for each entry that is not well formed."""
    mutants, wrong, names = [], [], set()
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    for path in sorted((root / "tests/mutants").glob("*.yaml")):
        try:
            entries = yaml.load(path.read_text(encoding="utf-8"), loader) or []
        except yaml.YAMLError as error:
            raise Refused(f"tests/mutants/{path.name}: {error}") from error
        for entry in entries:
            words = {key: entry.get(key, "") for key in ("file", "what", "from", "to", "equivalent")}
            mutant = Mutant(path.stem, *words.values())
            reason = malformed(mutant, set(entry) - set(words))
            if not reason and mutant.name in names:
                reason = "another entry has this name"
            names.add(mutant.name)
            if reason:
                wrong.append(f"tests/mutants/{path.name}: {mutant.name}: {reason}")
            else:
                mutants.append(mutant)
    return mutants, wrong


def malformed(mutant, unknown):
    if unknown:
        return f"unknown key {min(unknown)}"
    if not all((mutant.file, mutant.what, mutant.before, mutant.after)):
        return "it needs file, what, from and to"
    folder = "sim/" if mutant.room == "sim" else f"src/{mutant.room}/"
    if not mutant.file.startswith(folder) or not mutant.file.endswith(".cpp"):
        return f"{mutant.file} is not a .cpp file of {folder}"
    if "$" not in mutant.after:
        return "there is no $ in `to`"
    return ""


def places(root, mutants):
    """The mutants of each file with the place where they apply, and a message for each that does not."""
    found, wrong, texts = {}, [], {}
    for mutant in mutants:
        path = root / mutant.file
        if mutant.file not in texts:
            texts[mutant.file] = path.read_text(encoding="utf-8") if path.exists() else None
        text = texts[mutant.file]
        times = text.count(mutant.before) if text is not None else 0
        if text is None:
            reason = f"there is no {mutant.file}"
        elif times != 1:
            reason = f"`from` occurs {times} times in {mutant.file}"
        else:
            start = text.index(mutant.before)
            others = found.setdefault(mutant.file, [])
            hit = [other for at, other in others
                   if at < start + len(mutant.before) and start < at + len(other.before)]
            others.append((start, mutant))
            if not hit:
                continue
            reason = f"it overlaps with {hit[0].name}"
        wrong.append(f"tests/mutants/{mutant.table}.yaml: {mutant.name}: {reason}")
    return found, wrong


def checked(root):
    mutants, wrong = read_tables(root)
    found, stale = places(root, mutants)
    if wrong + stale:
        raise Refused("\n".join(wrong + stale))
    return mutants, found


def patched(text, entries):
    """The text with its mutants and the include of the header that selects one."""
    for start, mutant in sorted(entries, key=lambda entry: -entry[0]):
        after = mutant.after.replace("$", mutant.condition)
        text = text[:start] + after + text[start + len(mutant.before):]
    include = re.search(r"^#include", text, re.MULTILINE)
    return text[:include.start()] + '#include "degs_mutants.hpp"\n' + text[include.start():]


def check(root):
    mutants, _ = checked(root)
    rooms = {path.name for path in (root / "src").iterdir() if path.is_dir()} | {"sim"}
    few = []
    for room in sorted(rooms):
        count, least = sum(mutant.room == room for mutant in mutants), LEAST.get(room, LEAST_OTHER)
        if count < least:
            few.append(f"tests/mutants/{room}.yaml: {count} mutants of {room}, which needs {least}")
    if len(mutants) < LEAST_ALL:
        few.append(f"tests/mutants: {len(mutants)} mutants, of which there must be {LEAST_ALL}")
    if few:
        raise Refused("\n".join(few))
    print(f"{len(mutants)} mutants apply")


def chosen(mutants, names):
    if not names:
        return mutants
    picked = [mutant for mutant in mutants
              if any(name == mutant.table or fnmatch.fnmatchcase(mutant.name, name) for name in names)]
    for name in names:
        if not any(name == mutant.table or fnmatch.fnmatchcase(mutant.name, name) for mutant in picked):
            raise Refused(f"no mutant and no table is named {name}")
    return picked


def write_if_new(path, data):
    """What did not change keeps its time, so that nothing is built again for it."""
    if not path.exists() or path.read_bytes() != data:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def copy_tree(root, tree, found):
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root,
                            capture_output=True, text=True, check=True).stdout.split("\0")
    files = {name for name in listed if name and (root / name).is_file()}
    for name in sorted(files):
        data = (root / name).read_bytes()
        if name in found:
            data = patched(data.decode(), found[name]).encode()
        write_if_new(tree / name, data)
        shutil.copymode(root / name, tree / name)
    write_if_new(tree / "src/degs_mutants.hpp", HEADER.encode())
    for path in tree.rglob("*"):
        name = str(path.relative_to(tree))
        if path.is_file() and not name.startswith("build/") and name not in files | {"src/degs_mutants.hpp"}:
            path.unlink()


def build(tree, scenes, rooms, jobs):
    subprocess.run(["cmake", "--preset", "release", "-DDEGS_BUILD_TESTS=ON", "-DDEGS_WARNINGS_AS_ERRORS=OFF",
                    f"-DDEGS_SCENES={scenes}"], cwd=tree, check=True, stdout=subprocess.DEVNULL)
    targets = [word for room in rooms for word in ("--target", f"degs_{room}_tests")]
    subprocess.run(["cmake", "--build", "build/release", "-j", str(jobs), *targets], cwd=tree, check=True)


def failed_test(output):
    """Name and verdict of the first test that fails by what ctest prints; one that is skipped has not failed."""
    return re.search(r"Test +#\d+: (.+?) +\.*\*\*\*(Not Run|(?!Skipped)\w+)", output)


class Tests:
    """The core suite of a build, for one ctest at a time in each of some folders."""

    def __init__(self, tree, rooms, limit):
        self.tree, self.build, self.suites, self.seconds = tree, tree / "build/release", {}, {}
        command = ["ctest", "--test-dir", self.build, "--show-only=json-v1"]
        listed = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        self.numbers, self.limits = {}, {}
        for number, test in enumerate(listed["tests"], 1):
            properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
            program = Path(test.get("command", [""])[0]).name
            if (re.search(NO_TESTS, test["name"]) or (rooms and program not in {f"degs_{room}_tests" for room in rooms})
                    or set(properties.get("LABELS", [])) & NO_LABELS):
                continue
            self.numbers[test["name"]] = number
            self.limits[test["name"]] = min(limit, properties.get("TIMEOUT", limit))

    def suites_of(self, folder):
        """Suites of the sources of a folder of tests."""
        if folder not in self.suites:
            self.suites[folder] = {match[1] for file in folder.glob("*_test.cpp")
                                   for match in re.finditer(r"^TEST(?:_[FP])?\((\w+),", file.read_text(), re.MULTILINE)}
        return self.suites[folder]

    def groups(self, mutant):
        """Names of tests, nearest first: of the block, of its folder, of its room, others."""
        stem = Path(mutant.file).stem.replace("_", "")
        near = {stem, stem.replace("unit", ""), *Path(mutant.file).stem.split("_")}
        near = {word for word in near if len(word) > 3}
        place = Path(mutant.file).parent
        suites = self.suites_of(self.tree / "tests" / (place if mutant.room == "sim" else place.relative_to("src")))
        groups = [[], [], [], []]
        for name in self.numbers:
            own = name.split("/")[0] == mutant.room
            alike = any(word in name.lower().replace("_", "") for word in near)
            beside = name.split("/")[-1] in suites
            groups[0 if own and alike else 1 if own and beside else 2 if own else 3].append(name)
        return [part for group in groups for part in self.parts(group)]

    def parts(self, group):
        """Cheap tests first, in parts that may take as long as those before them: ctest has an order of its own."""
        parts, spent = [[]], 1.0
        for name in sorted(group, key=lambda name: self.seconds.get(name, 0)):
            if sum(self.seconds.get(other, 0) for other in parts[-1]) > spent:
                spent += sum(self.seconds.get(other, 0) for other in parts[-1])
                parts.append([])
            parts[-1].append(name)
        return [part for part in parts if part]

    def read_seconds(self, folder):
        """What tests took in a run in this folder."""
        lines = (folder / "Testing/Temporary/CTestCostData.txt").read_text(encoding="utf-8").splitlines()
        self.seconds = {words[0]: float(words[2]) for words in map(str.split, lines) if len(words) == 3}

    def run(self, folder, names, mutant="", jobs=1):
        """The first test that fails and how, or None. The folder gives a ctest its own logs and limits."""
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "tmp").mkdir(exist_ok=True)
        limits = "".join(f"set_tests_properties([==[{name}]==] PROPERTIES TIMEOUT {self.limits[name]})\n"
                         for name in names)
        (folder / "CTestTestfile.cmake").write_text(f'subdirs("{self.build}")\n{limits}', encoding="utf-8")
        first, *others = (str(self.numbers[name]) for name in names)
        (folder / "numbers").write_text(",".join((first, first, "1", *others)) + "\n", encoding="utf-8")
        environment = dict(os.environ, DEGS_MUTANT=mutant, TMPDIR=str(folder / "tmp"), TEST_TMPDIR=str(folder / "tmp"),
                           GTEST_FAIL_FAST="1")
        command = ["ctest", "--test-dir", folder, "-I", folder / "numbers", "--stop-on-failure", f"-j{jobs}",
                   "--no-tests=error"]
        done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
        failed = failed_test(done.stdout)
        if failed and failed[2] == "Not Run":
            raise Refused(f"{failed[1]} was not built")
        if not failed and done.returncode != 0:
            raise Refused(f"ctest failed with {mutant or 'no mutant'}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        shutil.rmtree(folder / "tmp", ignore_errors=True)
        return failed and failed[1] + (" (time)" if failed[2].startswith("Timeout") else "")


def killer(tests, folder, mutant, most):
    """Whether all is said, after `most` seconds at most; the test that notices a mutant, or None; the seconds taken."""
    began = time.monotonic()
    for names in tests.groups(mutant):
        if time.monotonic() - began > most:
            return False, None, most
        test = tests.run(folder, names, mutant.name)
        if test:
            return True, test, time.monotonic() - began
    return True, None, time.monotonic() - began


def read_rows(path):
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        return {row["entry"]: row for row in csv.DictReader(file)}


def write_rows(path, mutants, rows):
    """In the order of the tables; rows of entries that are gone or changed are dropped."""
    part = path.with_suffix(".part")
    with part.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[mutant.digest] for mutant in mutants if mutant.digest in rows)
    part.replace(path)


def row_of(mutant, test, seconds):
    verdict = "killed" if test else "equivalent" if mutant.equivalent else "survives"
    return dict(zip(COLUMNS, (mutant.table, mutant.what, mutant.file, verdict, test or "", f"{seconds:.0f}",
                              mutant.digest)))


def pass_without(tests, folder, jobs):
    """All tests must pass without a mutant; once is enough for a copy."""
    files = sorted(path for path in tests.tree.rglob("*")
                   if path.is_file() and tests.build.parent not in path.parents)
    state = hashlib.sha256(" ".join(tests.numbers).encode())
    for path in files:
        state.update(str(path.relative_to(tests.tree)).encode() + b"\0" + path.read_bytes())
    passed = folder / "passed"
    if not passed.exists() or passed.read_text(encoding="utf-8") != state.hexdigest():
        print("first without a mutant", flush=True)
        failed = tests.run(folder, list(tests.numbers), jobs=jobs)
        if failed:
            raise Refused(f"{failed} fails with no mutant selected")
        passed.write_text(state.hexdigest(), encoding="utf-8")
    tests.read_seconds(folder)


def run(root, options):
    mutants, found = checked(root)
    results = Path(options.results or root / "docs/mutants.csv")
    rows = read_rows(results)
    todo = [mutant for mutant in chosen(mutants, options.names) if options.again or mutant.digest not in rows]
    folder = Path(options.build or root / "build/mutants").resolve()
    scenes = os.environ.get("DEGS_SCENES") or root.parent / "shared/scenes"
    copy_tree(root, folder / "tree", found)
    build(folder / "tree", scenes, options.rooms, options.jobs)
    tests = Tests(folder / "tree", options.rooms, options.limit)
    print(f"{len(todo)} mutants, {len(tests.numbers)} tests", flush=True)
    pass_without(tests, folder / "none", options.jobs)
    free = queue.SimpleQueue()
    for job in range(options.jobs):
        free.put(folder / f"job{job}")

    def work(mutant):
        place = free.get()
        try:
            return mutant, *killer(tests, place, mutant, options.most)
        finally:
            free.put(place)

    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(work, mutant) for mutant in todo]):
            mutant, decided, test, seconds = done.result()
            if not decided:
                print(f"later      {mutant.name}", flush=True)
                continue
            rows[mutant.digest] = row_of(mutant, test, seconds)
            write_rows(results, mutants, rows)
            verdict = rows[mutant.digest]["verdict"]
            wrong += verdict == "survives" or (bool(mutant.equivalent) and verdict == "killed")
            print(f"{verdict:10} {mutant.name}  {test or ''} {seconds:.0f} s", flush=True)
    if wrong:
        raise Refused(f"{wrong} mutants survive, or are killed though their entry says that they are equivalent")


def count(root):
    mutants, _ = checked(root)
    rows = read_rows(root / "docs/mutants.csv")
    print("| folder | mutants | killed | equivalent | survive | not tried |\n|---|---:|---:|---:|---:|---:|")
    for room in [*sorted({mutant.room for mutant in mutants}), "all"]:
        verdicts = [rows[mutant.digest]["verdict"] if mutant.digest in rows else "" for mutant in mutants
                    if room in ("all", mutant.room)]
        numbers = (len(verdicts), *(verdicts.count(word) for word in ("killed", "equivalent", "survives", "")))
        print(f"| {room} | {' | '.join(map(str, numbers))} |")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", nargs="?", choices=("list", "run", "count"))
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--check", action="store_true", help="of the tables alone; builds nothing")
    parser.add_argument("--root", default=ROOT, type=Path, help="the repository (for tests of this script)")
    parser.add_argument("--build", help="folder of the copy (default: build/mutants)")
    parser.add_argument("--jobs", type=int, default=2, help="processes of the build and of the tests (default: 2)")
    parser.add_argument("--limit", type=int, default=120, help="seconds of a test (default: 120)")
    parser.add_argument("--most", type=float, default=float("inf"), metavar="SECONDS",
                        help="leave a mutant that lives longer for another run")
    parser.add_argument("--rooms", nargs="+", default=[], help="build and run the test programs of these folders alone")
    parser.add_argument("--results", help="table of the results (default: docs/mutants.csv)")
    parser.add_argument("--again", action="store_true", help="also what has a row")
    options = parser.parse_intermixed_args(arguments)
    try:
        if options.check:
            check(options.root)
        elif options.command == "list":
            for mutant in chosen(checked(options.root)[0], options.names):
                print(f"{mutant.name}  {mutant.file}: {mutant.what}")
        elif options.command == "run":
            run(options.root, options)
        elif options.command == "count":
            count(options.root)
        else:
            parser.error("nothing to do")
    except Refused as reason:
        sys.exit(str(reason))


if __name__ == "__main__":
    main()
