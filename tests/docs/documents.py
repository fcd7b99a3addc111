# SPDX-License-Identifier: Apache-2.0
"""documents.py PROGRAM [--slow] [--update] [--list] [--forms] [PAGE...]: tries the commands of README.md and docs/*.md.

docs/documents.md explains the conventions. Blocks of a page run one after the other in a folder of their own that
looks like the repository. Prints what fails as "page:line: reason"; with --update, shown output is written anew. With
--forms no command runs: only that commands and options within sentences exist, and that lines are wrapped.
"""

import argparse
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DIRECTIVE = re.compile(r"<!-- (slow|elsewhere|with|file|output of)\b:? ?(.*?) -->$")
TIMES = re.compile(r"^host .*| · host .*$")  # the machine that simulates differs
COMMAND_IN_TEXT = re.compile(r"`(?:build/release/sim/)?degs ([a-z]+)\b([^`]*)`")
WORKING_COPY = ("configs",)  # files that a page may add to
MOST_CHARACTERS = 120  # of a line outside of tables and fenced blocks
LIMIT_S = {False: 300, True: 3600}


class Block:
    """A fenced block, with the comments above it."""

    def __init__(self, page, line, kind, lines, directives):
        self.page, self.line, self.kind, self.lines, self.directives = page, line, kind, lines, directives

    def place(self, offset=0):
        return f"{self.page.relative_to(ROOT)}:{self.line + offset}"

    def filled(self, text):
        """`text` with the placeholders that `with` gives values to."""
        for pair in self.directives.get("with", "").split():
            name, value = pair.split("=", 1)
            text = re.sub(rf"(?<![\w$]){re.escape(name)}(?!\w)", value.replace("\\", r"\\"), text)
        return text


def blocks_of(page):
    """All fenced blocks of a page in their order."""
    found, directives, fence, shown = [], {}, None, None
    for number, line in enumerate(page.read_text().split("\n"), 1):
        opening = re.match(r"^( *)(```+)(\w*)$", line)
        if fence:
            if line.strip() == fence[1]:
                found.append(Block(page, fence[3], fence[2], body, directives))
                fence, directives = None, {}
            else:
                body.append(line[len(fence[0]):])
        elif opening:
            fence, body = (opening[1], opening[2], opening[3], number), []
        elif shown is not None and (line.strip() or not shown.lines):
            shown.lines += [line] if line.strip() else []
        elif (match := DIRECTIVE.match(line.strip())) and match[1] == "output of":
            shown = Block(page, number + 1, "output", [], {match[1]: match[2]})
            found.append(shown)
        elif match:
            directives[match[1]] = match[2]
        elif line.strip():
            directives = {}
        shown = None if shown and shown.lines and not line.strip() else shown
    return found


def steps_of(block):
    """(line, command, shown output or None) of a block; a block of `sh` is one command."""
    if block.kind == "sh":
        return [(1, "\n".join(block.lines), None)]
    if block.kind == "output":
        return [(0, block.directives["output of"], block.lines)]
    steps = []
    for offset, line in enumerate(block.lines, 1):
        if line.startswith("$ "):
            steps.append([offset, line[2:], []])
        elif steps and steps[-1][1].endswith("\\") and not steps[-1][2]:
            steps[-1][1] += "\n" + line
        elif steps:
            steps[-1][2].append(line)
    return steps


def comparable(lines):
    return [TIMES.sub("", line).rstrip() for line in "\n".join(lines).strip().split("\n")]


class Trial:
    """A folder in which the blocks of a page run, and the program."""

    def __init__(self, program, slow):
        self.temporary = tempfile.TemporaryDirectory(prefix="degs-pages-")
        self.folder = Path(self.temporary.name)
        self.slow = slow
        for child in ROOT.iterdir():
            if child.name in WORKING_COPY:
                shutil.copytree(child, self.folder / child.name)
            elif child.name not in ("build", "out", ".git"):
                (self.folder / child.name).symlink_to(child)
        (self.folder / "build/release/sim").mkdir(parents=True)
        (self.folder / "build/release/sim/degs").symlink_to(program)
        self.environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
                            "DEGS_CACHE": ""}
        scenes = Path(os.environ.get("DEGS_SCENES", ""))
        if slow and scenes.is_absolute():
            for scene in scenes.glob("*/scene.ply"):
                (self.folder / scene.parent.name).symlink_to(scene.parent)

    def run(self, command):
        """Exit code, output and errors of a shell command."""
        try:
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=self.folder, text=True,
                                  env=self.environment, stdin=subprocess.DEVNULL, capture_output=True,
                                  timeout=LIMIT_S[self.slow])
        except subprocess.TimeoutExpired as late:
            return 124, "", f"takes more than {late.timeout:.0f} s; quick commands need no `<!-- slow -->`"
        return done.returncode, done.stdout, done.stderr

    def close(self):
        self.temporary.cleanup()


def try_block(block, trial, update):
    """Reasons why a block of commands is wrong; with `update`, the lines that it should have."""
    reasons, fresh = [], []
    for offset, command, shown in steps_of(block):
        code, output, errors = trial.run(block.filled(command))
        if code:
            reasons.append(f"{block.place(offset)}: exit code {code}: {(errors or output).strip()[-300:]}")
        elif shown is not None:
            got = output.rstrip("\n").split("\n")
            fresh += got if block.kind == "output" else ["$ " + command, *got]
            if not update and comparable(shown) != comparable(got):
                change = [line for line in difflib.unified_diff(comparable(shown), comparable(got), lineterm="", n=0)
                          if not line.startswith(("---", "+++", "@@"))]
                reasons.append(f"{block.place(offset)}: the page shows other output:\n  " + "\n  ".join(change[:8]))
    return reasons, "\n".join(fresh).split("\n") if fresh else None


def is_due(block, slow):
    """Whether this run tries the block."""
    tried = block.kind in ("sh", "console", "output") and "elsewhere" not in block.directives
    return tried and ("slow" in block.directives) == slow


def rewrite(block, lines):
    """Replaces the body of a block in its page."""
    text = block.page.read_text().split("\n")
    text[block.line:block.line + len(block.lines)] = lines
    block.page.write_text("\n".join(text))


def try_page(page, program, options):
    """Reasons why commands of a page are wrong, and the number of blocks tried."""
    blocks = blocks_of(page)
    due = [block for block in blocks if is_due(block, options.slow) and not options.forms]
    if not due or options.list:
        for block in due:
            print(f"{block.place()}: {' '.join(block.lines)[:100]}")
        return [], 0
    reasons, fresh, trial = [], [], Trial(program, options.slow)
    for block in blocks:
        if "file" in block.directives:
            file = trial.folder / block.directives["file"]
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("\n".join(block.lines) + "\n")
        if block in due:
            start = time.monotonic()
            found, lines = try_block(block, trial, options.update)
            reasons += found
            if lines and lines != block.lines and not found:
                fresh.append((block, lines))
            print(f"{block.place()}: {'FAILED' if found else 'good'}, {time.monotonic() - start:.1f} s", flush=True)
    trial.close()
    for block, lines in reversed(fresh if options.update else []):
        rewrite(block, lines)
    return reasons, len(due)


def helps(program):
    """The options of every command of the program, from its --help."""
    def text(*words):
        return subprocess.run([program, *words, "--help"], capture_output=True, text=True).stdout
    commands = re.findall(r"^  ([a-z]+) ", text().split("Commands:")[-1], re.MULTILINE)
    found = {}
    for command in commands:
        below = text(command)
        nested = re.findall(r"^  ([a-z]+) ", "".join(below.split("Commands:")[1:]), re.MULTILINE)
        found[command] = set(re.findall(r"--[a-z][a-z-]*", below + "".join(text(command, each) for each in nested)))
    return found


def mistakes_in_text(page, known):
    """Commands and options within sentences and tables that the program does not have."""
    for number, line in enumerate(page.read_text().split("\n"), 1):
        for command, rest in COMMAND_IN_TEXT.findall(line):
            place = f"{page.relative_to(ROOT)}:{number}"
            if command not in known:
                yield f"{place}: there is no command 'degs {command}'"
                continue
            for option in re.findall(r"(?<!\S)--[a-z][a-z-]*", rest):
                if option not in known[command]:
                    yield f"{place}: 'degs {command}' has no option {option}"


def missing_commands(page, known):
    """Commands of the program that the page, which lists them, does not name."""
    for command in sorted(set(known) - {"help"}):
        if f"`{command}`" not in page.read_text():
            yield f"{page.relative_to(ROOT)}:1: the list of commands has no `{command}`"


def mistakes_of_form(page):
    """Commands in indented blocks, which nobody would try, and prose that is not wrapped."""
    fence = False
    for number, line in enumerate(page.read_text().split("\n"), 1):
        fence ^= line.lstrip().startswith("```")
        if not fence and re.match(r"^ {4,}(\$ |(build/release/sim/)?degs [a-z])", line):
            yield f"{page.relative_to(ROOT)}:{number}: a command needs a fence (```sh)"
        if not fence and len(line) > MOST_CHARACTERS and not line.lstrip().startswith("|"):
            yield f"{page.relative_to(ROOT)}:{number}: {len(line)} characters, {MOST_CHARACTERS} are allowed"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=Path)
    parser.add_argument("pages", nargs="*", type=Path)
    for flag in ("slow", "update", "list", "forms"):
        parser.add_argument(f"--{flag}", action="store_true")
    options = parser.parse_intermixed_args()
    program = options.program.resolve()
    if not os.access(program, os.X_OK):
        sys.exit(f"{options.program} is not a program that can be run: build it first")
    if options.slow and not os.environ.get("DEGS_SCENES"):
        sys.exit("slow commands need the trained scenes: set DEGS_SCENES to their folder")
    pages = [page.resolve() for page in options.pages] or [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    known, tried = helps(program), 0
    reasons = [*missing_commands(ROOT / "README.md", known)] if ROOT / "README.md" in pages else []
    for page in pages:
        reasons += [*mistakes_in_text(page, known), *mistakes_of_form(page)]
        found, count = try_page(page, program, options)
        reasons, tried = reasons + found, tried + count
    for reason in reasons:
        print(reason)
    print(f"documents: {tried} blocks of commands tried, {len(reasons)} mistakes")
    sys.exit(1 if reasons else 0)


main()
