# SPDX-License-Identifier: Apache-2.0
"""Holds the lists of CONTRIBUTING.md, "What a change touches", against the tree: each names an old feature, the words by which its files
are found, and those files. scripts/check_documents.py reports files that are missing in a list, and listed files without the words."""
import re

FOLDERS = ("filament_core", "backend", "framegraph", "jobsystem", "shaders", "toolkit", "tools", "python")
CODE = {".h", ".cpp", ".inl", ".glsl", ".mat"}
LIST = re.compile(r"^#### .*, `([^`]+)`: (\d+) files\n+((?:- .*\n(?:  .*\n)*)+)", re.MULTILINE)
ITEM = re.compile(r"^- `([^`]+)`", re.MULTILINE)


def check(root):
    page = root / "CONTRIBUTING.md"
    lists = LIST.findall(page.read_text(encoding="utf-8")) if page.exists() else []
    if not lists:
        return []
    texts = {str(path.relative_to(root)): path.read_text(encoding="utf-8", errors="replace")
             for folder in FOLDERS for path in (root / folder).rglob("*") if path.suffix in CODE}
    wrong = []
    for words, count, items in lists:
        listed, found = ITEM.findall(items), {name for name, text in texts.items() if re.search(words, text)}
        wrong += [f"CONTRIBUTING.md: `{words}`: {name} is not in its list" for name in sorted(found - set(listed))]
        wrong += [f"CONTRIBUTING.md: `{words}`: {name} does not name it" for name in listed if name not in found]
        if int(count) != len(listed):
            wrong.append(f"CONTRIBUTING.md: `{words}`: {len(listed)} files are listed, not {count}")
    return wrong
