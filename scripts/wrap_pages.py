#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""wrap_pages.py [--check] [PAGE...]: fills the paragraphs and list items of Markdown pages to lines
of at most 120 characters, so that nobody wraps them by hand. Without a page, README.md, CHANGELOG.md
and docs/*.md. Tables, headings, fences, indented blocks and comments stay as they are, and what
stands between backquotes stays on one line. With --check nothing is written; pages that would change
are named, and the exit code is 1.
"""
import argparse
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WIDTH = 120
ITEM = re.compile(r"^( *)([*+-]|\d+[.)]) +")
VERBATIM = re.compile(r"^(\||#|<|>|\s*$|\s*\[[^\]]+\]: |-{3,}$|\*{3,}$| {4,}\S)")
CODE = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)")
GLUE = "\0"


def filled(paragraph, first, rest):
    """The lines of a paragraph, of which the first begins with `first` and the others with `rest`."""
    text = CODE.sub(lambda code: code[0].replace(" ", GLUE), " ".join(line.strip() for line in paragraph))
    # A line must not begin with what would make it a list item, a heading or a quotation.
    text = re.sub(r" (?=([*+>-]|#+|\d+[.)])( |$))", GLUE, text)
    lines = textwrap.wrap(text, WIDTH, initial_indent=first, subsequent_indent=rest, break_long_words=False,
                          break_on_hyphens=False)
    return [line.replace(GLUE, " ") for line in lines]


def wrapped(text):
    """The page with its paragraphs filled."""
    lines, fence, comment = [], False, False
    paragraph, first, rest = [], "", ""

    def end():
        nonlocal paragraph, first, rest
        lines.extend(filled(paragraph, first, rest) if paragraph else [])
        paragraph, first, rest = [], "", ""

    for line in text.split("\n"):
        item = ITEM.match(line)
        fences = line.lstrip().startswith("```")
        if fence or fences or comment or "<!--" in line:
            end()
            lines.append(line)
            comment = (comment or "<!--" in line) and "-->" not in line
            fence ^= fences and not comment
        elif item:
            end()
            first, rest = item[0], " " * len(item[0])
            paragraph = [line[len(item[0]):]]
        elif VERBATIM.match(line) and not (rest and paragraph and line.startswith(rest) and line.strip()):
            end()
            lines.append(line)
        else:
            if not paragraph:
                first = rest = line[:len(line) - len(line.lstrip())]
            paragraph.append(line)
            if line.endswith(("  ", "\\")):
                end()
    end()
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", type=Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    pages = options.pages or [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]
    changed = 0
    for page in pages:
        before = page.read_text()
        after = wrapped(before)
        if after == before:
            continue
        changed += 1
        if options.check:
            print(f"{page}: scripts/wrap_pages.py would wrap it")
        else:
            page.write_text(after)
    sys.exit(1 if options.check and changed else 0)


main()
