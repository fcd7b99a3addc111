# SPDX-License-Identifier: Apache-2.0
"""Hook of mkdocs.yml: links that work in the repository also work on the site.

README.md becomes the front page and CHANGELOG.md a page, and the groups of docs/pages.md become the navigation, so that
the pages are listed once. A link from a page to a file or folder outside docs/ leads,
on the site, to a generated page that shows the file or lists the folder. A link to something that does not exist is
left alone, so that `mkdocs build --strict` reports it.
"""

import os
import posixpath
import re
import tempfile
from pathlib import Path

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
FROM_REPOSITORY = {"README.md": "index.md", "CHANGELOG.md": "changelog.md"}
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")
CODE = re.compile(r"(^```.*?^```$|`[^`\n]+`)", re.MULTILINE | re.DOTALL)
PAGES = "docs/pages.md"
GROUP = re.compile(r"^\* \*\*(.+?)\*\*: (.*?)(?=^\* |^\S|\Z)", re.MULTILINE | re.DOTALL)
LEXERS = {".hpp": "cpp", ".cpp": "cpp", ".yaml": "yaml", ".sh": "bash", ".py": "python", ".txt": "cmake",
          ".cmake": "cmake"}

generated = tempfile.TemporaryDirectory(prefix="degs-site-")


def page_of(path):
    """The page of the site that shows the repository's `path`."""
    if path in FROM_REPOSITORY:
        return FROM_REPOSITORY[path]
    if path.startswith("docs/"):
        return path[len("docs/"):]
    return f"source/{path}{'/index' if (ROOT / path).is_dir() else ''}.md"


def target_of(link, page):
    """The repository path to which `link` leads from the repository's `page`, or None if it is not ours."""
    if "://" in link or link.startswith(("mailto:", "/")):
        return None
    path = posixpath.normpath(posixpath.join(posixpath.dirname(page), link))
    return path if not path.startswith("..") and (ROOT / path).exists() else None


def outside_code(change, text):
    """`text` with `change` applied to all of it but code."""
    return "".join(part if index % 2 else change(part) for index, part in enumerate(CODE.split(text)))


def linked_sources(page):
    """Repository paths outside of docs/ that `page` links."""
    found = set()

    def note(text):
        for match in LINK.finditer(text):
            path = target_of(match[2], page)
            if path and not path.startswith("docs/") and path not in FROM_REPOSITORY:
                found.add(path)
        return text

    outside_code(note, (ROOT / page).read_text())
    return found


def rewritten(text, page):
    """The Markdown of the repository's `page` with links that lead to pages of the site."""
    here = posixpath.dirname(page_of(page))

    def change(match):
        path = target_of(match[2], page)
        if path is None:
            return match[0]
        return match[1] + posixpath.relpath(page_of(path), here or ".") + (match[3] or "") + match[4]

    return outside_code(lambda part: LINK.sub(change, part), text)


def shown(path, sources):
    """The Markdown of a page that shows a file of the repository, or lists a folder."""
    where = ROOT / path
    if not where.is_dir():
        return f"# {where.name}\n\n`{path}`\n\n`````{LEXERS.get(where.suffix, 'text')}\n{where.read_text()}`````\n"
    lines = [f"# {path}/", ""]
    for name in sorted(os.listdir(where)):
        child = f"{path}/{name}"
        known = page_of(child) if child in sources else None
        lines.append(f"* [{name}]({posixpath.relpath(known, posixpath.dirname(page_of(path)))})" if known
                     else f"* {name}{'/' if (where / name).is_dir() else ''}")
    return "\n".join(lines) + "\n"


def add(files, config, page, text):
    """Adds a page that exists on the site only."""
    written = Path(generated.name) / page
    written.parent.mkdir(parents=True, exist_ok=True)
    written.write_text(text)
    files.append(File(page, generated.name, config["site_dir"], config["use_directory_urls"]))


def navigation(listed):
    """The entries of mkdocs.yml's `nav` that the list of pages `listed` says: groups of pages with their titles."""
    groups = []
    for name, text in GROUP.findall(listed):
        entries = []
        for link in re.finditer(r"\[([^\]]+)\]\(([^)\s#]+)\)", text):
            title = " ".join(link[1].split())
            entries.append({title[0].upper() + title[1:]: page_of(target_of(link[2], PAGES) or link[2])})
        groups.append({name: entries})
    return groups


def on_config(config):
    groups = navigation((ROOT / PAGES).read_text() if (ROOT / PAGES).exists() else "")
    if not groups:
        raise PluginError(f"{PAGES} needs groups of pages ('* **Group**: [page](page.md)')")
    (first, entries), = groups[0].items()
    config["nav"] = [{first: ["index.md", *entries]}, *groups[1:]]
    return config


def on_files(files, config):
    pages = [f"docs/{file.src_uri}" for file in files.documentation_pages()] + list(FROM_REPOSITORY)
    sources = set().union(*(linked_sources(page) for page in pages))
    for path in FROM_REPOSITORY:
        add(files, config, page_of(path), (ROOT / path).read_text())
    for path in sorted(sources):
        add(files, config, page_of(path), shown(path, sources))
    return files


def on_page_markdown(markdown, page, config, files):
    origin = {site: path for path, site in FROM_REPOSITORY.items()}.get(page.file.src_uri)
    if origin is None and not page.file.src_uri.startswith("source/"):
        origin = f"docs/{page.file.src_uri}"
    return rewritten(markdown, origin) if origin else markdown
