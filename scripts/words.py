#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""words.py [--pages] [--check]: how long README.md and docs/*.md are, in words as `wc -w` counts them.

Prose is everything outside of tables, fenced blocks and parts that a program writes ("<!-- output of: ... -->").
--pages prints every page, --check fails if a number is above its ceiling in CEILINGS.
"""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CEILINGS = {"words": 90_600, "prose": 44_550, "longest page of prose": 1_930}


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
            words += 0 if stripped.startswith("|") else len(line.split())
    return words


def measure():
    """(page, words, words of prose) of every page."""
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    texts = [(page.relative_to(ROOT), page.read_text()) for page in pages]
    return [(page, len(text.split()), prose_words(text)) for page, text in texts]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pages", action="store_true", help="print every page, the longest first")
    parser.add_argument("--check", action="store_true", help="fail above a ceiling")
    options = parser.parse_args()
    pages = measure()
    if options.pages:
        for page, words, prose in sorted(pages, key=lambda entry: -entry[1]):
            print(f"{words:7d} words {prose:6d} prose  {page}")
    longest = max(pages, key=lambda entry: entry[2])
    values = {"words": sum(entry[1] for entry in pages), "prose": sum(entry[2] for entry in pages),
              "longest page of prose": longest[2]}
    too_many = False
    for name, value in values.items():
        above = options.check and value > CEILINGS[name]
        too_many = too_many or above
        print(f"{name}: {value}" + (f" ({longest[0]})" if name.startswith("longest") else "") +
              (f", at most {CEILINGS[name]} are allowed" if above else ""))
    return 1 if too_many else 0


if __name__ == "__main__":
    sys.exit(main())
