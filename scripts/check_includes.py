#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that includes point down, that libraries are included only in their rooms, that rooms leave the C library's elementary
functions to base/math/Elementary.h, and that docs/architecture.md shows this table.

  scripts/check_includes.py [--root DIR]     prints file:line: rule for every broken rule; exit status 1 if any
  scripts/check_includes.py --write          writes the table into docs/architecture.md

A room is a folder; its headers are included from the repository root, so that the layer is visible at the include.
"""
import argparse
import pathlib
import re
import sys
import textwrap

# Bottom up; room: the rooms that it may include, besides itself. A folder that is not listed is not a room.
ROOMS = {
    "base": [],
    "base/math": ["base"],
    "jobsystem": ["base"],
    "backend/api": ["base", "base/math"],
    "backend/stream": ["base", "base/math", "backend/api"],
    "backend/layers": ["base", "base/math", "backend/api", "backend/stream"],
    "backend/null": ["base", "base/math", "backend/api", "backend/stream"],
    "backend/vulkan": ["base", "base/math", "backend/api", "backend/stream"],
    "backend/gles": ["base", "base/math", "backend/api", "backend/stream"],
    "backend/create": ["base", "backend/api", "backend/stream", "backend/null", "backend/vulkan", "backend/gles"],
    "framegraph": ["base", "jobsystem", "backend/api", "backend/stream"],
    "shaders/interface": ["base/math"],
    "shaders/lib": ["base", "base/math", "shaders/interface"],
    "shaders/package": ["base", "base/math", "backend/api", "shaders/interface"],
    "shaders/compiler": ["base", "base/math", "jobsystem", "backend/api", "shaders/interface", "shaders/package"],
    "filament_core/include": ["base", "shaders/package"],
    "filament_core/values": ["base", "base/math", "filament_core/include"],
    "filament_core/scene": ["base", "base/math", "backend/api", "shaders/interface", "shaders/package",
                            "filament_core/include"],
    "filament_core/assets/files": ["base"],
    "filament_core/scenefile": ["base", "base/math", "filament_core/include", "filament_core/assets/files"],
    "filament_core/assets/blocks": ["base", "base/math"],
    "filament_core/assets/image": ["base", "base/math", "jobsystem", "backend/api", "shaders/lib", "filament_core/include",
                                   "filament_core/assets/files", "filament_core/assets/blocks"],
    "filament_core/assets/environment": ["base", "base/math", "jobsystem", "backend/api", "shaders/lib", "filament_core/include",
                                         "filament_core/assets/files", "filament_core/assets/image"],
    "filament_core/assets/tables": ["base", "base/math", "jobsystem", "backend/api", "shaders/lib", "filament_core/include",
                                    "filament_core/values", "filament_core/assets/files", "filament_core/assets/image"],
    "filament_core/assets/geometry": ["base", "base/math", "filament_core/include", "filament_core/assets/files"],
    "filament_core/assets/meshfiles": ["base", "filament_core/include", "filament_core/assets/files"],
    "filament_core/assets/gltf": ["base", "base/math", "jobsystem", "backend/api", "shaders/interface",
                                  "shaders/package", "filament_core/include", "filament_core/scene",
                                  "filament_core/assets/files", "filament_core/assets/image",
                                  "filament_core/assets/environment", "filament_core/assets/tables",
                                  "filament_core/assets/geometry", "filament_core/assets/meshfiles"],
    "filament_core/prepare": ["base", "base/math", "jobsystem", "backend/api", "shaders/interface", "shaders/lib",
                              "filament_core/include", "filament_core/values", "filament_core/scene"],
    "filament_core/passes": ["base", "base/math", "jobsystem", "backend/api", "backend/stream", "framegraph",
                             "shaders/interface", "shaders/package", "filament_core/include", "filament_core/values",
                             "filament_core/scene", "filament_core/prepare"],
    "filament_core/engine": ["base", "base/math", "jobsystem", "backend/api", "backend/stream", "backend/layers",
                             "backend/null", "backend/create", "framegraph", "shaders/interface", "shaders/lib",
                             "shaders/package", "filament_core/include", "filament_core/scene",
                             "filament_core/assets/files", "filament_core/assets/image",
                             "filament_core/assets/environment", "filament_core/assets/tables",
                             "filament_core/assets/geometry", "filament_core/assets/gltf", "filament_core/prepare",
                             "filament_core/passes"],
    "filament_core/scenebuild": ["base", "base/math", "filament_core/include", "filament_core/assets/files"],
}

# Above the rooms: these may include any room, but backends only through backend/create; a test may include the folder that it
# mirrors.
USERS = ["toolkit", "tools", "python", "c_interface", "tests", "bench"]

# What programs share, bottom up; folder: the ones of this table that it may include, besides itself.
TOOLKIT = {
    "toolkit/paths": [],
    "toolkit/packages": [],
    "toolkit/showcase": [],
    "toolkit/interiors": ["toolkit/showcase"],
    "toolkit/machine": [],
    "toolkit/json": [],
    "toolkit/pictures": [],
    "toolkit/mutations": [],
    "toolkit/program": ["toolkit/showcase"],
    "toolkit/materials": ["toolkit/packages", "toolkit/paths", "toolkit/showcase"],
    "toolkit/record": ["toolkit/machine", "toolkit/json", "toolkit/pictures"],
    "toolkit/scenes": ["toolkit/showcase", "toolkit/materials", "toolkit/json"],
    "tools/reference": ["toolkit/program", "toolkit/machine", "toolkit/json"],  # the path tracer, and a program around it
    # bakes, and a program around them
    "tools/bake": ["toolkit/program", "toolkit/machine", "toolkit/json", "toolkit/pictures", "toolkit/scenes",
                   "tools/reference"],
}
# Folders of programs. Each may include all of the toolkit, but no other program: what two of them need belongs to the toolkit.
PROGRAMS = ["tools/accuracy", "tools/cmgen", "tools/conformance", "tools/filament-render", "tools/imgdiff",
            "tools/ltcfit", "tools/matc", "tools/matinfo", "tools/numerics", "tools/replay", "tools/server",
            "tools/tables", "tools/view"]
BEHIND_CREATE = ["backend/vulkan", "backend/gles"]

# A public header lies in the lowest room that uses it; users see one folder, <filament_core/...>.
PUBLIC = ["base/include/filament_core", "shaders/package/include/filament_core", "filament_core/include/filament_core"]
# Public headers whose objects are the engine's; the rest are value types.
PUBLIC_ENGINE = ["filament_core.h", "Animator.h", "BuildScene.h", "BuiltInMaterials.h", "Engine.h", "Environment.h", "Gltf.h", "Image.h",
                 "Renderer.h", "Scene.h"]
PUBLIC_ENGINE_USERS = ["filament_core/include", "filament_core/engine", "filament_core/scenebuild", "toolkit", "tools", "python",
                       "c_interface", "samples", "tests", "bench"]

TABLE_BEGIN, TABLE_END = "<!-- scripts/check_includes.py --write -->\n```\n", "```\n"

# library header: the rooms that may include it, with their tests. All other library headers are allowed (the standard, POSIX,
# fmt).
LIBRARIES = {
    r"vulkan/|volk\.h": ["backend/vulkan"],
    r"EGL/|GLES\d?/|GLES2/|KHR/": ["backend/gles"],
    r"glslang/|SPIRV/|spirv-tools/|spirv_cross/|spirv_\w+\.hpp|spirv/": ["shaders/compiler", "filament_core/engine", "tests"],
    r"draco/": ["filament_core/assets/gltf"],
    r"meshoptimizer\.h": ["filament_core/assets/geometry"],
    r"stb_?image|stb/|png\.h|jpeglib\.h|webp/|avif/": ["filament_core/assets/image", "filament_core/assets/gltf"],
    r"zlib\.h": ["filament_core/assets/image", "filament_core/assets/gltf"],
    r"zstd(_errors)?\.h": ["shaders/package", "filament_core/assets/image"],
    r"nlohmann/": ["filament_core/assets/files", "filament_core/scenefile", "filament_core/assets/gltf", "filament_core/assets/tables", "toolkit", "tools",
                   "tests", "bench"],
    r"concurrentqueue|blockingconcurrentqueue|hwloc": ["jobsystem"],
    r"httplib\.h": ["tools"],
    r"CLI/": ["tools", "toolkit"],
    r"embree\d?/": ["tools", "toolkit"],
    r"imgui": ["tools", "tests"],
    r"pybind11/|numpy/|Python\.h": ["python"],
    r"gtest/|gmock/": ["tests"],
    r"benchmark/|oneapi/|tbb/|omp\.h|Eigen/|boost/": ["bench"],
}
GENERATED = re.compile(r"generated/")  # written by the build, not part of the tree

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
# Their last bits depend on the release of the C library and on the CPU; tests and tools may compare with them.
ELEMENTARY = re.compile(r"\b(?:std|glm)::(?:a?(?:sin|cos|tan)h?|atan2|exp(?:2|m1)?|log(?:2|10|1p)?|pow|cbrt|hypot)\(")
SOURCES = {".h", ".cpp", ".inl"}
SKIPPED = {"build", "out", ".git"}


def room_of(path):
    """The room or user folder that a path from the repository root belongs to; None if it belongs to none."""
    matches = [r for r in [*ROOMS, *USERS, *TOOLKIT, *PROGRAMS, "samples"] if path.startswith(r + "/")]
    return max(matches, key=len, default=None)


def user_of(room):
    """tools/view belongs to tools; a room of the engine to itself."""
    return room.split("/")[0] if room in TOOLKIT or room in PROGRAMS else room


def mirrored(path):
    """tests/backend/vulkan/X.cpp mirrors backend/vulkan."""
    return path.split("/", 1)[1].rsplit("/", 1)[0] if "/" in path else ""


def is_public(path):
    return any(path.startswith(folder + "/") for folder in PUBLIC)


def may_see(room, target_room):
    return room == target_room or user_of(room) in USERS or target_room in ROOMS[room]


def user_rule(room, target_room):
    """Why a file above the rooms may not include one of another folder there; None if it may."""
    if target_room in PROGRAMS and room != "tests":
        return f"{room} may not include the program {target_room}: what both need belongs to the toolkit"
    if room in TOOLKIT and target_room not in TOOLKIT[room]:
        return f"{room} may not include {target_room}: includes point down in the table of the toolkit"
    return None


def quoted_rule(root, path, room, target):
    """Why `path` in `room` may not include "target"; None if it may."""
    if GENERATED.match(target):
        return None
    if target.startswith(".") or not (root / target).is_file():
        return f'"{target}" is not a path from the repository root'
    target_room = room_of(target)
    if is_public(path):
        return f'public headers include only the standard library, GLM and <filament_core/...>, not "{target}"'
    if is_public(target):
        return "public headers are included as <filament_core/...>"
    if target_room == room:
        return None
    if room == "samples":
        return "samples see only the public headers <filament_core/...>"
    if target_room is None or user_of(target_room) in (*USERS, "samples"):
        # users may include each other: tests use the tools' libraries, benches use the test scenes
        if user_of(room) not in USERS or target_room in (None, "samples"):
            return f"{room} may not include {target_room or 'this'}"
        return user_rule(room, target_room)
    if user_of(room) in USERS:
        if target_room in BEHIND_CREATE and mirrored(path) != target_room:
            return f"{target_room} is behind backend/create; only tests/{target_room} looks inside"
        return None
    if not may_see(room, target_room):
        return f"{room} may not include {target_room}: includes point down (docs/architecture.md)"
    return None


def public_rule(root, room, name):
    owners = [room_of(f"{folder}/{name}") for folder in PUBLIC if (root / folder / name).is_file()]
    if len(owners) != 1:
        return f"<filament_core/{name}> " + ("does not exist" if not owners else f"exists {len(owners)} times")
    if name in PUBLIC_ENGINE and user_of(room) not in PUBLIC_ENGINE_USERS:
        return f"<filament_core/{name}> names the engine; {room} is below it"
    if room != "samples" and not may_see(room, owners[0]):
        return f"<filament_core/{name}> belongs to {owners[0]}, which {room} may not include"
    return None


def library_rule(path, room, target):
    for pattern, rooms in LIBRARIES.items():
        if re.match(pattern, target) and user_of(room) not in rooms and not (room == "tests" and mirrored(path) in rooms):
            return f"<{target}> belongs to {', '.join(rooms)}"
    if is_public(path) and "/" in target and not target.startswith("glm/"):
        return f"public headers include only the standard library and GLM, not <{target}>"
    return None


def check_file(root, path):
    relative = path.relative_to(root).as_posix()
    room = room_of(relative)
    if room in (None, "toolkit", "tools"):
        yield 1, "this folder is no room of the include table"
        return
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            found = room in ROOMS and ELEMENTARY.search(line)
            if found:
                yield number, f"{found[0]}) differs from machine to machine: call base/math/Elementary.h"
            continue
        quote, target = match.groups()
        if quote == '"':
            rule = quoted_rule(root, relative, room, target)
        elif target.startswith("filament_core/"):
            rule = public_rule(root, room, target.removeprefix("filament_core/"))
        else:
            rule = library_rule(relative, room, target)
        if rule:
            yield number, rule


def source_files(root):
    for top in sorted(root.iterdir()):
        if top.name in SKIPPED or not top.is_dir():
            continue
        for path in sorted(top.rglob("*")):
            relative = path.relative_to(root).as_posix()
            if path.suffix in SOURCES and not relative.startswith("tests/scripts/"):
                yield path


def check_order():
    """No arrow of the tables points up: each room lists only rooms that precede it."""
    seen = set()
    for room, below in [*ROOMS.items(), *TOOLKIT.items()]:
        for name in below:
            if name not in seen:
                yield f"{room} lists {name}, which is not below it"
        seen.add(room)


def table():
    """Bottom up, one room per line; the sub-rooms of assets are combined if a room may include all of them."""
    width = max(map(len, ROOMS)) + 1
    lines = []
    for room, below in [*ROOMS.items(), *((room, ["any room", *below]) for room, below in TOOLKIT.items())]:
        text, line = [], " ".join(below)
        while len(line) > 118 - width:
            cut = line.rindex(" ", 0, 118 - width)
            text.append(line[:cut])
            line = line[cut + 1:]
        text.append(line)
        lines += [f"{room if i == 0 else '':{width}}{':' if i == 0 else ' '} {part}".rstrip() for i, part in enumerate(text)]
    programs = textwrap.wrap(" ".join(name.removeprefix("tools/") for name in PROGRAMS), 118 - width - len("(of tools) "))
    lines += [f"{'' if i else 'programs':{width}}{' ' if i else ':'} {'' if i else '(of tools) '}{part}" for i, part in enumerate(programs)]
    lines.append(f"{'':{width}}  any room, a backend only through backend/create; all of the toolkit; no other program")
    lines.append(f"{'python bench':{width}}: as programs")
    lines.append(f"{'tests':{width}}: as programs, and any program; also the folder that it mirrors")
    lines.append(f"{'samples c_interface':{width}}: the public headers")
    return "\n".join(lines) + "\n"


def split_document(text):
    """The text before the table, the table, and the text after it; None if the document has no place for one."""
    begin = text.find(TABLE_BEGIN)
    end = text.find(TABLE_END, begin + len(TABLE_BEGIN))
    if begin < 0 or end < 0:
        return None
    begin += len(TABLE_BEGIN)
    return text[:begin], text[begin:end], text[end:]


def check_document(root):
    document = root / "docs/architecture.md"
    if not document.is_file():
        return
    parts = split_document(document.read_text(encoding="utf-8"))
    if parts is None:
        yield "docs/architecture.md: has no include table"
    elif parts[1] != table():
        yield "docs/architecture.md: its include table is not this script's: run scripts/check_includes.py --write"


def write_document(root):
    document = root / "docs/architecture.md"
    before, _, after = split_document(document.read_text(encoding="utf-8"))
    document.write_text(before + table() + after, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--write", action="store_true", help="write the table into docs/architecture.md")
    options = parser.parse_args()
    root = options.root.resolve()
    if options.write:
        write_document(root)
    broken = [*check_order(), *check_document(root)]
    files = 0
    for path in source_files(root):
        files += 1
        broken += [f"{path.relative_to(root)}:{number}: {rule}" for number, rule in check_file(root, path)]
    for line in broken:
        print(line)
    print(f"include table: {files} files, {len(broken)} broken rules")
    return 1 if broken or not files else 0


if __name__ == "__main__":
    sys.exit(main())
