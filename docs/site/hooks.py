# SPDX-License-Identifier: Apache-2.0
"""Hooks of MkDocs: anchors as GitHub makes them, and a search index that is a script."""
import json
import pathlib
import re
import shutil


def github_anchor(title, _separator="-"):
    """ "A & b (c)" -> "a--b-c": as links between documents name headings."""
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


def on_config(config):
    config["mdx_configs"].setdefault("toc", {})["slugify"] = github_anchor
    return config


def on_post_build(config):
    folder = pathlib.Path(config["site_dir"], "search")
    pages = json.loads((folder / "search_index.json").read_text(encoding="utf-8"))["docs"]
    # pages of source text are found through the pages that link them
    pages = [page for page in pages if not re.search(r"^repository/.*\.\w+\.html", page["location"])]
    (folder / "search_index.js").write_text("window.searchPages = " + json.dumps(pages) + ";\n", encoding="utf-8")
    (folder / "search_index.json").unlink()
    (folder / "worker.js").unlink()
    shutil.copy(pathlib.Path(__file__).with_name("search.js"), folder / "main.js")
