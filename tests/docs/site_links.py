# SPDX-License-Identifier: Apache-2.0
"""site_links.py SITE DOCS: checks the links of the built site; prints each mistake as "page: reason".

Every relative link must lead to a file and its anchor to an element there, no script, style sheet or image may come
from another host, the navigation of the front page must reach every page of DOCS, which docs/pages.md lists.
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src"}


class Page(HTMLParser):
    """Links, anchors and loaded resources of one HTML file."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loaded, self.navigation = set(), [], [], set()
        self.open_navigations = 0
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if values.get("id"):
            self.anchors.add(values["id"])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
            if self.open_navigations:
                self.navigation.add(urlsplit(values["href"]).path)
        self.open_navigations += tag == "nav"
        if values.get(LOADED.get(tag)) and values.get("rel") != "canonical":
            self.loaded.append(values[LOADED[tag]])

    def handle_endtag(self, tag):
        self.open_navigations -= tag == "nav"


def problems(site, pages):
    for path, page in pages.items():
        name = path.relative_to(site)
        for link in page.links + page.loaded:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loaded and parts.scheme != "data":
                    yield f"{name}: loads {link} from another host"
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                yield f"{name}: {link} leads nowhere"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                yield f"{name}: {link} names an anchor that does not exist"


def unreached(docs, front):
    for page in sorted(docs.glob("*.md")):
        if f"{page.stem}.html" not in front.navigation:
            yield f"{page.name}: the navigation does not reach it; docs/pages.md lists the pages"


def main():
    site, docs = (Path(argument).resolve() for argument in sys.argv[1:3])
    # The error page has absolute links for servers.
    pages = {path: Page(path) for path in sorted(site.rglob("*.html")) if path.name != "404.html"}
    found = list(problems(site, pages)) + list(unreached(docs, pages[site / "index.html"]))
    for mistake in found:
        print(mistake)
    links = sum(len(page.links) for page in pages.values())
    print(f"site: {len(found)} mistakes" if found else f"site: all {links} links of {len(pages)} pages lead somewhere")
    sys.exit(1 if found else 0)


main()
