#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""words.py [--pages]: how long README.md and docs/*.md are.

A word has a letter or a digit; `wc -w` also counts the bars and rules of tables, a sixth of what it finds.
Prose is everything outside of tables, fenced blocks and parts that a program writes ("<!-- output of: ... -->").
--pages prints every page.
"""

import argparse
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def count_words(text):
    return sum(any(c.isalnum() for c in word) for word in text.split())


def prose_words(text):
    """Words of a page that are neither in a table or a fenced block nor written by a program."""
    words, fence, generated, seen = 0, "", False, False
    for line in text.split("\n"):
        stripped = line.strip()
        if fence:
            fence = "" if stripped == fence else fence
        elif stripped.startswith("```"):
            fence = stripped[:len(stripped) - len(stripped.lstrip("`"))]
        elif stripped.startswith("<!-- "):
            generated, seen = generated or stripped.startswith("<!-- output of:"), False
        elif generated and (stripped or not seen):
            seen = seen or bool(stripped)
        else:
            generated = False
            words += 0 if stripped.startswith("|") else count_words(line)
    return words


def measure():
    """(page, words, words of prose) of every page."""
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    texts = [(page.relative_to(ROOT), page.read_text()) for page in pages]
    return [(page, count_words(text), prose_words(text)) for page, text in texts]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pages", action="store_true", help="print every page, the longest first")
    options = parser.parse_args()
    pages = measure()
    if options.pages:
        for page, words, prose in sorted(pages, key=lambda entry: -entry[1]):
            print(f"{words:7d} words {prose:6d} prose  {page}")
    longest = max(pages, key=lambda entry: entry[2])
    values = {"words": sum(entry[1] for entry in pages), "prose": sum(entry[2] for entry in pages),
              "longest page of prose": longest[2]}
    for name, value in values.items():
        print(f"{name}: {value}" + (f" ({longest[0]})" if name.startswith("longest") else ""))


if __name__ == "__main__":
    main()
