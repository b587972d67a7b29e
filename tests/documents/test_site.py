#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Opens the documentation site in Chromium without a screen: pages load without an error on the console, search finds what it
should, and nothing is wider than a phone.

  test_site.py SITE      exit status 77, and a line that says why, where there is no Chromium or it cannot start

The pages are shown in frames of one test page, each as wide as a phone: one start of the browser for all of them. The test page
lies in a copy of the site, and writes what it finds into its own text, which --dump-dom prints.
"""
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77
PHONE, DESKTOP = 390, 1200  # pixels
PAGES = ["index.html", "get-started.html", "concepts.html", "material-language.html", "quality.html", "options.html",
         "gltf.html", "accuracy.html", "tutorials/first-material.html", "repository/index.html"]
# (what is searched, the page that must be among the first results)
SEARCHES = [("refraction layers", "refraction.html"), ("KHR_materials_sheen", "gltf.html"), ("patina", "tutorials/first-material.html")]
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--allow-file-access-from-files", "--disable-web-security", "--disable-site-isolation-trials",
         "--enable-logging=stderr", "--v=0", "--hide-scrollbars", f"--window-size={DESKTOP},900"]

PAGE = """<!doctype html><meta charset="utf-8"><title>test</title><body><pre id="result"></pre><script>
const pages = %s, found = {};
function load(address, width, done) {
    return new Promise((ready) => {
        const frame = document.createElement("iframe");
        frame.style = `width:${width}px;height:800px;border:0`;
        frame.onload = async () => { ready(await done(frame)); frame.remove(); };
        frame.src = address;
        document.body.appendChild(frame);
    });
}
// the right edge of what nothing clips or scrolls
function widest(frame) {
    const body = frame.contentDocument.body, view = frame.contentWindow;
    const isBoxed = (element) => element !== body && (view.getComputedStyle(element).overflowX !== "visible" || isBoxed(element.parentElement));
    let right = 0;
    for (const element of body.querySelectorAll("*"))
        if (!isBoxed(element.parentElement)) right = Math.max(right, element.getBoundingClientRect().right);
    return Math.floor(right);
}
// results of a search appear when its scripts have been loaded: waits for that, not for a time
const results = (frame) => new Promise((ready) => {
    const look = () => {
        const list = frame.contentDocument.getElementById("mkdocs-search-results");
        const links = [...list.querySelectorAll("a")].map((a) => a.getAttribute("href"));
        if (links.length || /Nothing found|cannot load/.test(list.textContent)) ready(links);
        else setTimeout(look, 20);
    };
    look();
});
(async () => {
    for (const [address, kind, width] of pages) {
        found[address + "@" + width] = await load(address, width, async (frame) => kind === "search" ? await results(frame) : {
            title: frame.contentDocument.title,
            width: widest(frame),
            broken: [...frame.contentDocument.images].filter((image) => image.complete && !image.naturalWidth).map((image) => image.src),
        });
    }
    document.getElementById("result").textContent = "FOUND" + JSON.stringify(found) + "END";
})();
</script>"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def browse(browser, url, *more, timeout=150):
    """Exit status, what it prints, and its log. With an empty profile."""
    with tempfile.TemporaryDirectory() as profile:
        command = [browser, *FLAGS, f"--user-data-dir={profile}", *more, "--dump-dom", url]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
        except subprocess.TimeoutExpired:
            return None, "", f"no answer within {timeout} seconds"
        except OSError as error:
            return None, "", str(error)
        return done.returncode, done.stdout, done.stderr


def find_browser():
    """Chromium, if it starts and shows an empty page here; in some containers it does not."""
    browser = shutil.which("chromium")
    if not browser:
        skip("there is no chromium (scripts/packages-check.txt)")
    status, text, log = browse(browser, "data:text/html,<p>started</p>", timeout=90)
    if status != 0 or "started" not in text:
        skip(f"chromium cannot start here: {log.strip().splitlines()[-1] if log.strip() else 'no message'}")
    return browser


class Site(unittest.TestCase):
    """One start of the browser for all tests."""
    found, log = {}, ""

    def test_pages_have_titles_and_all_pictures(self):
        for page in PAGES:
            for width in (PHONE, DESKTOP):
                self.assertIn("filament_core" if page != "accuracy.html" else "accuracy", self.found[f"{page}@{width}"]["title"])
                self.assertEqual(self.found[f"{page}@{width}"]["broken"], [], page)

    def test_nothing_scrolls_sideways(self):
        for page in PAGES:
            for width in (PHONE, DESKTOP):
                self.assertLessEqual(self.found[f"{page}@{width}"]["width"], width, f"{page} in a window of {width} pixels")

    def test_search_finds_the_page(self):
        for words, page in SEARCHES:
            links = [link.split("#")[0] for link in self.found[address(words) + f"@{DESKTOP}"]]
            self.assertIn(f"./{page}", links[:12], words)

    def test_the_console_has_no_errors(self):
        errors = [line for line in self.log.splitlines() if re.search(r"CONSOLE.*(Error|Uncaught|Failed|error)", line)]
        self.assertEqual(errors, [])


def address(words):
    return f"search.html?q={words.replace(' ', '+')}"


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1], "index.html").exists():
        skip("there is no site: 'scripts/docs' has not made one")
    browser = find_browser()
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder, "site")
        shutil.copytree(sys.argv[1], site, ignore=shutil.ignore_patterns("api"))
        pages = [(page, "page", width) for page in PAGES for width in (PHONE, DESKTOP)]
        pages += [(address(words), "search", DESKTOP) for words, _ in SEARCHES]
        (site / "test.html").write_text(PAGE % json.dumps(pages), encoding="utf-8")
        status, text, Site.log = browse(browser, (site / "test.html").as_uri(), "--virtual-time-budget=600000")
    found = re.search('id="result">FOUND(.*?)END</pre>', text, re.DOTALL)
    if status is None or not found:
        sys.exit(f"chromium started, but did not show the pages: status {status}\n{Site.log[-2000:]}")
    Site.found = json.loads(html.unescape(found[1]))
    unittest.main(argv=sys.argv[:1])


if __name__ == "__main__":
    main()
