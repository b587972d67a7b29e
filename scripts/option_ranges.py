# SPDX-License-Identifier: Apache-2.0
"""Holds the ranges in the comments of public headers against those of the options, which docs/options.md lists: that page is written from
the options themselves (filament-tables). scripts/check_documents.py reports what differs."""
import pathlib
import re

INCLUDE = "filament_core/include/filament_core/"
HEADERS = ("DisplayTransform", "Effects", "Light", "LoadOptions", "Quality", "SectionPlanes", "View")
ROW = re.compile(r"^\| `([\w.]+)` \| ([^|]*) \|", re.MULTILINE)
BETWEEN = re.compile(r"from (-?[\d.]+) to (-?[\d.]+)")
STRUCT = re.compile(r"^struct (\w+) \{\n(.*?)^\};", re.MULTILINE | re.DOTALL)
# A declaration with the comment before it, the comment behind it, and the lines on which that continues.
MEMBER = re.compile(r"((?:^    ///(?!<).*\n)*)^    (?!friend|///)[\w:<>]+ ([^;]*);[ ]*(///<.*(?:\n {8,}///<.*)*)?", re.MULTILINE)
GROUPS = {"EnvironmentLoadOptions": "environment", "GltfLoadOptions": "model", "LevelsOfDetail": "lod", "SectionPlanes": "section", "SunLight": "sun"}  # of options; others are called as their struct
MASK = ".lightChannels"  # all values of its type
RANGE = re.compile(r"\[(-?[\d.e' -]+), (-?[\d.e' -]+)\]")


def number(text):
    return float(re.sub(r"[ ']", "", text))


def options(page):
    """{name: (least, most)} of every option that is a number."""
    found = {}
    for name, values in ROW.findall(page):
        between = BETWEEN.search(values)
        listed = re.fullmatch(r"(\d+)(?:, \d+)*(?: or (\d+))", values)
        if between or listed:
            found[name] = tuple(map(float, (between or listed).groups()))
    return found


def stated(header):
    """(line, struct, member, (least, most)) of every range in a header."""
    for struct in STRUCT.finditer(header):
        for member in MEMBER.finditer(struct[2]):
            bounds = RANGE.search((member[1] or "") + (member[3] or ""))
            line = header.count("\n", 0, struct.start(2) + member.start(2)) + 1
            for name in re.findall(r"(\w+)(?:\s*\{[^}]*\}|\s*=\s*[^,]+)?(?:,|$)", member[2]):
                if bounds:
                    yield line, struct[1], name, tuple(map(number, bounds.groups()))


def check(root):
    page = root / "docs/options.md"
    if not page.exists():
        return []
    known, wrong, seen = options(page.read_text(encoding="utf-8")), [], set()
    for path in filter(pathlib.Path.exists, (root / INCLUDE / f"{name}.h" for name in HEADERS)):
        for line, struct, member, bounds in stated(path.read_text(encoding="utf-8")):
            group = GROUPS.get(struct, struct[0].lower() + struct[1:])
            option = next((o for o in (f"{group}.{member}", member) if o in known), None)
            seen.add(option)
            if option and known[option] != bounds:
                wrong.append(f"{path.relative_to(root)}:{line}: {member} is in {list(bounds)} here and in {list(known[option])} in docs/options.md")
    return wrong + [f"docs/options.md: {name}: no header states its range {list(known[name])}" for name in known
                    if name not in seen and not name.endswith(MASK)]
