#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the documents: every file that a .md or .html file links to or shows exists, every picture is used and small, every
source file names its licence, documents and comments avoid the phrases of scripts/banned_phrases.txt (scripts/wording.py), and headers
state the ranges of options as they are (scripts/option_ranges.py), and the lists of CONTRIBUTING.md name the files that a change touches
(scripts/checklists.py).

  scripts/check_documents.py [--root DIR]     prints file:line: what is wrong; exit status 1 if anything is

Pictures are the .png and .svg files below docs/. A .png with an alpha channel comes as a program wrote it: scripts/shrink_pictures leaves
pictures none that show nothing through, and 0.6 of their bytes. Links to other hosts are not followed; scripts/docs also follows those to places
within a page. The licence is an SPDX line among the first three; the inputs of fuzzers and the data of tests have none.
"""
import argparse
import html
import pathlib
import re
import subprocess
import sys
import urllib.parse

import checklists
import option_ranges
import wording

# [text](target) and ![text](target "title"); src="target" and href="target"
LINKS = {
    ".md": re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)|\b(?:src|href)=\"([^\"]*)\""),
    ".html": re.compile(r"\b(?:src|href)=\"([^\"]*)\"()"),
}
PICTURES = {".png", ".svg"}
PNG, ALPHA_AT, ALPHA = b"\x89PNG\r\n\x1a\n", 25, 4  # the bit of the colour type in the first chunk
LICENCE = "SPDX-License-Identifier: Apache-2.0"
# Files whose language has comments, and programs without a suffix; of templates, what they make.
LICENSED = {".cpp", ".h", ".inl", ".inc", ".c", ".glsl", ".mat", ".py", ".pyi", ".cmake", ".sh", ".js", ".css", ".yml", ".yaml", ".dox",
            ".pc", ".supp"}
LICENSED_NAMES = {"CMakeLists.txt", "Doxyfile", ".clang-format", ".clang-tidy", ".editorconfig", ".gitattributes", ".gitignore"}
INPUTS = "tests/fuzz/corpus/"


def without_code(text):
    """Markdown with its code blocks and code spans blanked; line numbers do not change."""
    blank = lambda found: re.sub(r"[^\n]", " ", found[0])
    return re.sub(r"^```.*?^```|`[^`\n]*`", blank, text, flags=re.DOTALL | re.MULTILINE)


def tracked(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "-z"], capture_output=True, text=True,
                            check=False)
    names = listed.stdout.split("\0") if listed.returncode == 0 else [str(p.relative_to(root)) for p in root.rglob("*")]
    return [root / name for name in sorted(filter(None, names)) if (root / name).is_file()]


def targets(document):
    """(line, path) of every file that the document names. A fragment is part of a page in the folder above, where its links begin; its
    pictures lie beside it."""
    text = document.read_text(encoding="utf-8")
    text = without_code(text) if document.suffix == ".md" else text
    for found in LINKS[document.suffix].finditer(text):
        target = urllib.parse.unquote(html.unescape(found[1] or found[2]).split("#")[0])
        if target and not re.match(r"[a-z]+:|{{", target):  # {{ }}: of a template
            above = document.name.endswith(".fragment.html") and found[0].startswith("href")
            yield text.count("\n", 0, found.start()) + 1, document.parent / ".." / target if above else document.parent / target


def has_alpha(picture):
    with picture.open("rb") as opened:
        head = opened.read(ALPHA_AT + 1)
    return head.startswith(PNG) and len(head) > ALPHA_AT and bool(head[ALPHA_AT] & ALPHA)


def needs_licence(name, head):
    path = pathlib.PurePosixPath(name)
    if name.startswith(INPUTS):
        return False
    suffix = path.with_suffix("").suffix if path.suffix == ".in" else path.suffix
    return suffix in LICENSED or path.name in LICENSED_NAMES or head.startswith(b"#!")


def without_licence(root, files):
    """Those that should name it and do not."""
    for file in files:
        with file.open("rb") as opened:
            head = b"".join(opened.readline() for _ in range(3))
        name = file.relative_to(root).as_posix()
        if needs_licence(name, head) and LICENCE.encode() not in head:
            yield f"{name}:1: names no licence: begin it with a comment '{LICENCE}'"


def check(root):
    """The errors, one line each, and the number of documents."""
    files = tracked(root)
    documents = [file for file in files if file.suffix in LINKS]
    wrong, shown = [], set()
    for document in documents:
        for line, target in targets(document):
            shown.add(target.resolve())
            if not target.exists():
                name = target.relative_to(document.parent) if target.is_relative_to(document.parent) else target
                wrong.append(f"{document.relative_to(root)}:{line}: there is no {name}")
    for file in files:
        if file.suffix not in PICTURES or file.relative_to(root).parts[0] != "docs":
            continue
        if file.resolve() not in shown:
            wrong.append(f"{file.relative_to(root)}:1: no document shows this picture")
        if has_alpha(file):
            wrong.append(f"{file.relative_to(root)}:1: is larger than it must be: run scripts/shrink_pictures")
    wrong += without_licence(root, files)
    wrong += [*wording.check(root, files), *option_ranges.check(root), *checklists.check(root)]
    return wrong, len(documents)


def main():
    parser = argparse.ArgumentParser(description="Checks the links, pictures and wording of the documents.")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1])
    root = parser.parse_args().root.resolve()
    wrong, count = check(root)
    for line in wrong:
        print(line)
    print(f"documents: {count} files, {len(wrong)} wrong")
    sys.exit(1 if wrong or not count else 0)


if __name__ == "__main__":
    main()
