#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the include table of docs/architecture.md: includes point down, and every library has its room.

  scripts/check_includes.py [--root DIR]     prints file:line: rule for every broken rule; exit status 1 if any

A room is a folder; its headers are included from the repository root, so that the layer is visible at the include.
"""
import argparse
import pathlib
import re
import sys

# room: the rooms that it may include, besides itself. A room that is not listed here does not exist.
ROOMS = {
    "filament_core/include/filament": [],
    "filament_core/base": [],
    "filament_core/math": ["base"],
    "shaders/interface": ["math"],
    "shaders/lib": ["shaders/interface", "math"],
    "jobsystem": ["base"],
    "backend/api": ["base", "math"],
    "backend/stream": ["base", "math", "backend/api"],
    "backend/layers": ["base", "math", "backend/api", "backend/stream"],
    "backend/null": ["base", "math", "backend/api", "backend/stream"],
    "backend/vulkan": ["base", "math", "backend/api", "backend/stream"],
    "backend/gles": ["base", "math", "backend/api", "backend/stream"],
    "backend/create": ["base", "backend/api", "backend/stream", "backend/null", "backend/vulkan", "backend/gles"],
    "framegraph": ["base", "jobsystem", "backend/api", "backend/stream"],
    "shaders/package": ["base", "math", "backend/api", "shaders/interface"],
    "shaders/compiler": ["base", "math", "jobsystem", "backend/api", "shaders/package", "shaders/interface"],
    "filament_core/scene": ["base", "math", "backend/api", "shaders/package", "shaders/interface"],
    "filament_core/assets": ["base", "math", "scene", "jobsystem", "backend/api", "shaders/package",
                             "shaders/interface", "shaders/lib"],
    "filament_core/prepare": ["base", "math", "scene", "jobsystem", "backend/api", "shaders/interface"],
    "filament_core/passes": ["base", "math", "scene", "prepare", "framegraph", "jobsystem", "backend/api",
                             "backend/stream", "shaders/package", "shaders/interface"],
    "filament_core/engine": ["base", "math", "scene", "assets", "prepare", "passes", "framegraph", "jobsystem",
                             "backend/api", "backend/stream", "backend/layers", "backend/null", "backend/create",
                             "shaders/package", "shaders/interface", "shaders/lib"],
}
SHORT = {room.removeprefix("filament_core/"): room for room in ROOMS if room.startswith("filament_core/")}

# Above the rooms: any room, but a backend only through backend/create; a test may look inside the folder it mirrors.
USERS = ["tools", "tests", "bench"]
BEHIND_CREATE = ["backend/vulkan", "backend/gles"]

# The public interface: value types below every room, except for the headers whose objects are the engine's.
PUBLIC = "filament_core/include/filament"
PUBLIC_ENGINE = ["filament.h", "Animator.h", "Engine.h", "Environment.h", "Gltf.h", "Image.h", "Renderer.h", "Scene.h"]
PUBLIC_USERS = ["filament_core/engine", "tools", "samples", "tests", "bench"]

# library header: the rooms that may include it, and their tests. Everything else of a library's kind is free (the standard, POSIX, fmt).
LIBRARIES = {
    r"vulkan/|volk\.h": ["backend/vulkan"],
    r"EGL/|GLES\d?/|GLES2/|KHR/": ["backend/gles"],
    r"glslang/|SPIRV/|spirv-tools/|spirv_cross/|spirv_\w+\.hpp|spirv/": ["shaders/compiler", "tests"],
    r"tiny_gltf\.h|draco/|meshoptimizer\.h|stb_?image|stb/|tinyexr|png\.h|jpeglib\.h": ["filament_core/assets"],
    r"zlib\.h": ["shaders/package", "filament_core/assets"],
    r"nlohmann/": ["filament_core/assets", "tools", "tests", "bench"],
    r"concurrentqueue|blockingconcurrentqueue|hwloc": ["jobsystem"],
    r"CLI/": ["tools", "bench"],
    r"embree\d?/": ["tools"],
    r"gtest/|gmock/": ["tests"],
    r"benchmark/|oneapi/|tbb/|omp\.h": ["bench"],
}
GENERATED = re.compile(r"generated/")  # written by the build, not in the tree

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = {".h", ".cpp", ".inl"}
SKIPPED = {"build", "out", ".git"}


def room_of(path):
    """The room or user folder that a path from the repository root belongs to; None if it belongs to none."""
    matches = [r for r in list(ROOMS) + USERS + ["samples"] if path.startswith(r + "/")]
    return max(matches, key=len, default=None)


def mirrored(path):
    """tests/backend/vulkan/X.cpp mirrors backend/vulkan."""
    return path.split("/", 1)[1].rsplit("/", 1)[0] if "/" in path else ""


def quoted_rule(root, path, room, target):
    """Why `path` in `room` may not include "target"; None if it may."""
    if GENERATED.match(target):
        return None
    if target.startswith(".") or not (root / target).is_file():
        return f'"{target}" is not a path from the repository root'
    target_room = room_of(target)
    if target_room == PUBLIC:
        return "public headers are included as <filament/...>"
    if target_room == room:
        return None
    if room == "samples":
        return "samples see only the public headers <filament/...>"
    if target_room in (None, *USERS, "samples"):
        # users may share among themselves: tests a tool's library, benches the test scenes
        return None if room in USERS and target_room in USERS else f"{room} may not include {target_room or 'this'}"
    if room in USERS:
        if target_room in BEHIND_CREATE and mirrored(path) != target_room:
            return f"{target_room} is behind backend/create; only tests/{target_room} looks inside"
        return None
    allowed = [SHORT.get(name, name) for name in ROOMS[room]]
    if target_room not in allowed:
        return f"{room} may not include {target_room}: includes point down (docs/architecture.md)"
    return None


def public_rule(root, room, name):
    if not (root / PUBLIC / name).is_file():
        return f"<filament/{name}> does not exist"
    if room in PUBLIC_USERS or room == PUBLIC or name not in PUBLIC_ENGINE:
        return None
    return f"<filament/{name}> names the engine; {room} is below it"


def library_rule(path, room, target):
    for pattern, rooms in LIBRARIES.items():
        if re.match(pattern, target) and room not in rooms and not (room == "tests" and mirrored(path) in rooms):
            return f"<{target}> belongs to {', '.join(rooms)}"
    if room == PUBLIC and "/" in target and not target.startswith("glm/"):
        return f"public headers include only the standard library and GLM, not <{target}>"
    return None


def check_file(root, path):
    relative = path.relative_to(root).as_posix()
    room = room_of(relative)
    if room is None:
        yield 1, "this folder is no room of the include table"
        return
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quote, target = match.groups()
        if quote == '"':
            rule = quoted_rule(root, relative, room, target)
        elif target.startswith("filament/"):
            rule = public_rule(root, room, target.removeprefix("filament/"))
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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    root = parser.parse_args().root.resolve()
    files = broken = 0
    for path in source_files(root):
        files += 1
        for number, rule in check_file(root, path):
            broken += 1
            print(f"{path.relative_to(root)}:{number}: {rule}")
    print(f"include table: {files} files, {broken} broken rules")
    return 1 if broken or not files else 0


if __name__ == "__main__":
    sys.exit(main())
