#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""folders.py [ROOT] [--print]: which folder below include, src and sim may include which. tests/house/folders.txt of ROOT lists
the allowed arrows, `FOLDER: FOLDER ...` with further lines indented, and every arrow leads to a folder above, so that
no folders include each other in a circle. Prints each violation as "file:line: reason"; exit code 1 if there are any.
--print: prints the list as the sources have it, in an order from below, instead."""
import pathlib
import re
import sys
import textwrap

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]')
LIST = "tests/house/folders.txt"


def sources(root):
    """Paths of all sources below include, src and sim, relative to `root`."""
    kinds = (".hpp", ".cpp", ".inc", ".in")
    return [path.relative_to(root) for room in ("include", "src", "sim") for path in sorted((root / room).rglob("*"))
            if path.suffix in kinds and path.is_file()]


def arrows(root):
    """(including file, line number, its folder, included folder) of every include that leaves its folder."""
    files = sources(root)
    known = {str(path): str(path.parent) for path in files}
    for path in files:
        for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1):
            found = INCLUDE.match(line)
            if not found:
                continue
            target = known.get("include/" + found[1]) or known.get("src/" + found[1]) or known.get(found[1])
            if target and target != str(path.parent):
                yield str(path), number, str(path.parent), target


def read_list(path):
    """{folder: (line number, [allowed folders])} in the order of the file."""
    allowed, folder = {}, ""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        text = line.split("#")[0].strip()
        if text and line[0].isspace():
            allowed[folder][1].extend(text.split())
        elif text:
            folder, targets = text.split(":", 1)
            allowed[folder] = (number, targets.split())
    return allowed


def violations(root):
    """Sentences on all that is against the list, and on lines of the list that no source needs."""
    allowed = read_list(root / LIST)
    used = {str(path.parent): set() for path in sources(root)}
    for folder in used:
        if folder not in allowed:
            yield f"{folder}:1: {LIST} has no line for this folder"
    for path, number, folder, target in arrows(root):
        used[folder].add(target)
        if folder in allowed and target not in allowed[folder][1]:
            yield f"{path}:{number}: {folder} may not include {target}; {LIST} lists what it may"
    seen = set()
    for folder, (number, targets) in allowed.items():
        for target in targets:
            if target not in seen:
                yield f"{LIST}:{number}: {folder} includes {target}, which has no line above"
            if target not in used.get(folder, ()):
                yield f"{LIST}:{number}: no file of {folder} includes {target}"
        seen.add(folder)


def print_list(root):
    """The list that the sources need: a folder comes as soon as all that it includes have come."""
    needs = {str(path.parent): set() for path in sources(root)}
    for _, _, folder, target in arrows(root):
        needs[folder].add(target)
    done = []
    while len(done) < len(needs):
        ready = sorted(f for f in needs if f not in done and needs[f] <= set(done))
        if not ready:
            print("folders in a circle:", *sorted(set(needs) - set(done)), file=sys.stderr)
            return 1
        for folder in ready:
            print(textwrap.fill(f"{folder}: {' '.join(sorted(needs[folder]))}".rstrip(), 120, subsequent_indent="    ",
                                break_on_hyphens=False))
        done += ready
    return 0


def main():
    """Checks, or prints the list."""
    options = [word for word in sys.argv[1:] if word != "--print"]
    root = pathlib.Path(options[0] if options else pathlib.Path(__file__).parents[2]).resolve()
    if len(options) < len(sys.argv) - 1:
        return print_list(root)
    found = list(violations(root))
    print("\n".join(found + [f"house folders: {len(found) or 'no'} violation(s)"]))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
