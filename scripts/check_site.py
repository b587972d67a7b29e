#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks a folder of HTML pages: every file and every place within a page that a link names exists.

  scripts/check_site.py DIR     prints page: what is wrong; exit status 1 if anything is

Links to other hosts are not followed. Nothing that a page loads may be on another host: the site works without a network.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

LOADED = {"script", "img", "link", "iframe", "source"}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.places, self.links = set(), []  # ids; (is loaded, target)
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if value and (name == "id" or (name == "name" and tag == "a")):
                self.places.add(value)
            if value and name in ("href", "src"):
                self.links.append((tag in LOADED, value))

    handle_startendtag = handle_starttag


def wrong_links(root, path, pages, with_api):
    for is_loaded, link in pages[path].links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme in ("http", "https") or parts.netloc:
            if is_loaded:
                yield f"loads {link} from another host"
            continue
        if parts.scheme:
            continue
        target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
        if not with_api and target.is_relative_to(root / "api"):
            continue
        if not target.exists():
            yield f"there is no {link}"
        elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].places:
            yield f"{target.name} has no place '{parts.fragment}' ({link})"


def check(root, with_api=True):
    """The errors, one line each, and the number of pages."""
    root = root.resolve()
    pages = {path: Page(path.read_text(encoding="utf-8", errors="replace")) for path in sorted(root.rglob("*.html"))}
    wrong = []
    for path in pages:
        # 404.html has addresses from the root of a server
        if path.name != "404.html":
            wrong += [f"{path.relative_to(root)}: {what}" for what in wrong_links(root, path, pages, with_api)]
    return wrong, len(pages)


def main():
    if len(sys.argv) != 2 or not re.match(r"[^-]", sys.argv[1]):
        sys.exit(__doc__)
    wrong, count = check(pathlib.Path(sys.argv[1]))
    for line in wrong:
        print(line)
    print(f"site: {count} pages, {len(wrong)} wrong")
    sys.exit(1 if wrong or not count else 0)


if __name__ == "__main__":
    main()
