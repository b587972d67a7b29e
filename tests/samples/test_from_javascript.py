#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""samples/from_javascript draws what samples/from_c draws, on both APIs. Exit status 77: no Node.js, or no koffi in
build/node (scripts/setup --check)."""
import argparse
import pathlib
import shutil
import subprocess
import sys


def main():
    parser = argparse.ArgumentParser()
    for name in ("root", "library", "imgdiff", "work"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    node, modules = shutil.which("node"), options.root / "build/node/node_modules"
    if not node or not (modules / "koffi").is_dir():
        print("no node, or no koffi: scripts/setup --check")
        sys.exit(77)
    shutil.rmtree(options.work, ignore_errors=True)
    shutil.copytree(options.root / "samples/from_javascript", options.work)
    (options.work / "node_modules").symlink_to(modules)
    program = [node, "main.mjs", options.root / "c_interface/include/filament_core.h", options.library]
    model = options.root / "samples/animated_gltf/windmill.gltf"
    for api in ("vulkan", "gles"):
        subprocess.run([*program, model, api, f"{api}.png"], cwd=options.work, check=True)
        subprocess.run([options.imgdiff, options.root / "docs/images/samples/from_c.png", f"{api}.png"], cwd=options.work, check=True)
    failed = subprocess.run([*program, "no/such.glb"], cwd=options.work, capture_output=True, text=True)
    assert failed.returncode != 0 and "no file 'no/such.glb'" in failed.stderr, failed.stderr


main()
