# SPDX-License-Identifier: Apache-2.0
"""facts.py [ROOT]: compares what README.md and docs/*.md say about the repository with the repository.

Prints each mistake as "page:line: reason". Such sentences were true once: a number of tests or accelerators, a list of
accelerators that lacks the newest, a list of folders, a path. A list that rightly lacks an accelerator says why in a
comment above its paragraph: <!-- without ORANGE: WHY -->.
"""

import re
import sys
from pathlib import Path

WORDS = "three|four|five|six|seven|eight|nine|ten|eleven|twelve"
COUNTED = re.compile(rf"\b({WORDS}|\d[\d ]*) ((other |published |shipped )*(accelerators|baselines|commands|tests|pages)|"
                     r"shipped designs)\b|\ball \d+ designs\b", re.IGNORECASE)
DENIED = r"\b({names}|(energy|power|area)( and (power|area))?) (is|are) not modelled"
COMMENT = re.compile(r"<!-- without (.+?): .+ -->")
PATH = re.compile(r"(?<!test[ \n])`((?:src|sim|tests|configs|scripts|docs|examples|driver|cmake)/[\w./*-]*)`")
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s]*)\)")
NO_SENTENCE = re.compile(r"Sources?:|```|[|#]|[-*] |\d+\. ")


def paragraphs(page):
    """(line number, text, names that a comment above excuses) of each paragraph outside of fenced blocks."""
    fence, start, lines, excused = False, 1, [], set()
    for number, line in enumerate([*page.read_text().split("\n"), ""], 1):
        fence ^= line.lstrip().startswith("```")
        comment = COMMENT.match(line.strip())
        if comment:
            excused = set(re.split(r", | and ", comment[1]))
        elif line.strip() and not fence and not line.lstrip().startswith("```"):
            start = start if lines else number
            lines.append(line)
            continue
        if lines and not comment:
            yield start, "\n".join(lines), excused
            excused = set()
        lines = [] if not comment else lines


def place(text, position, start):
    return start + text.count("\n", 0, position)


def stale_lists(text, names):
    """(position, missing names) of lists of at least three of `names`, such as "A, B and C", that lack one."""
    one = "|".join(names)
    run = re.compile(rf"\b(?:{one})\b(?:(?:,\s+and|,|\s+and|\s+or)\s+(?:{one})\b){{2,}}")
    plain = LINK.sub(lambda link: link[1] + "\n" * link[0].count("\n"), text)
    for found in run.finditer(plain):
        missing = [name for name in names if not re.search(rf"\b{name}\b", found[0])]
        if missing:
            yield plain.count("\n", 0, found.start()), missing


def mistakes_of_text(root, page, names):
    for start, text, excused in paragraphs(page):
        for found in COUNTED.finditer(text):
            yield place(text, found.start(), start), f"a number that nobody counts again: '{' '.join(found[0].split())}'"
        for line, missing in stale_lists(text, names):
            if set(missing) - excused:
                yield start + line, f"a list of accelerators without {', '.join(missing)}"
        for found in re.finditer(DENIED.format(names="|".join(names)), text, re.IGNORECASE):
            yield place(text, found.start(), start), f"it is modelled: '{found[0]}'"
        for found in PATH.finditer(text):
            if not any(root.glob(found[1].rstrip("/"))):
                yield place(text, found.start(), start), f"there is no {found[1]}"


def mistakes_of_opening(page):
    """A page of docs begins with a sentence, which says what its reader finds there."""
    for number, line in enumerate(page.read_text().split("\n")[1:], 2):
        if line.strip() and not line.startswith("<!--"):
            if page.suffix == ".md" and page.parent.name == "docs" and NO_SENTENCE.match(line):
                yield number, f"a page begins with a sentence that says what it answers: '{line[:40]}'"
            return


def mistakes_of_links(root, page, baselines):
    """A page that links the same file of several accelerators links that of all which have it."""
    linked = {}
    for found in re.finditer(r"src/baselines/(\w+)/(\w+\.[ch]pp)\b", page.read_text()):
        linked.setdefault(found[2], set()).add(found[1])
    for file, folders in linked.items():
        missing = {name for name in baselines if (root / "src/baselines" / name / file).exists()} - folders
        if len(folders) > 1 and missing:
            yield 1, f"links {file} of {', '.join(sorted(folders))}, but not of {', '.join(sorted(missing))}"


def mistakes_of_lists(root):
    """Lists that must name every folder or accelerator there is."""
    folders = lambda where: sorted(child.name for child in (root / where).glob("*") if child.is_dir())
    architecture = root / "docs/architecture.md"
    for name in folders("."):
        if not name.startswith((".", "build", "out")) and name != "src" and f"`{name}`" not in architecture.read_text():
            yield architecture, f"the table of rooms has no `{name}`"
    for name in [*folders("src"), *(f"modules/{name}" for name in folders("src/modules"))]:
        if f"`src/{name}" not in architecture.read_text():
            yield architecture, f"the table of rooms has no `src/{name}`"
    for name in folders("sim"):
        if f"`{name}`" not in architecture.read_text():
            yield architecture, f"the table of rooms has no `{name}` of sim"
    for name in folders("src/baselines"):
        if f"degs config {name} --keys own" not in (root / "docs/keys.md").read_text():
            yield root / "docs/keys.md", f"there is no table of {name}"
    for name in folders("src"):
        if not (root / "tests" / name).is_dir():
            yield architecture, f"tests has no folder for src/{name}"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    baselines = sorted(child.name for child in (root / "src/baselines").iterdir() if child.is_dir())
    shown = (root / "README.md").read_text()
    names = [re.search(rf"\b{name}\b", shown, re.IGNORECASE)[0] for name in baselines]
    mistakes = [f"{page.relative_to(root)}:1: {reason}" for page, reason in mistakes_of_lists(root)]
    pages = [root / "README.md", *sorted((root / "docs").glob("*.md")), *sorted((root / "docs").glob("*.csv"))]
    for page in pages:
        for line, reason in [*mistakes_of_text(root, page, names), *mistakes_of_opening(page),
                             *mistakes_of_links(root, page, baselines)]:
            mistakes.append(f"{page.relative_to(root)}:{line}: {reason}")
    for mistake in mistakes:
        print(mistake)
    print(f"facts: {len(pages)} pages, {len(mistakes)} mistakes")
    sys.exit(1 if mistakes else 0)


main()
