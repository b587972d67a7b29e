#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What filament-render --save-gltf writes has no errors by Khronos' glTF validator. Exit status 77: no Node.js, or no
gltf-validator in build/node (scripts/setup --check)."""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs'), path = require('path');
const file = process.argv[1], read = name => new Uint8Array(fs.readFileSync(name));
const external = uri => Promise.resolve(read(path.join(path.dirname(file), decodeURIComponent(uri))));
validator.validateBytes(read(file), { uri: path.basename(file), externalResourceFunction: external })
    .then(report => console.log(JSON.stringify(report)), error => { console.error(error); process.exit(1); });
"""
# Those of a scene of the program, and models with extensions, which are skipped where they are missing.
SCENE = {"points": [{"at": [0, 2, 2], "candela": 100, "castsShadows": False}], "suns": [{"direction": [-1, -2, -1]}],
         "spots": [{"at": [1, 3, 0], "direction": [0, -1, 0], "candela": 50}], "rects": [{"at": [0, 4, 0], "nits": 100}],
         "copies": [{"at": [1e7, 0.001, 0], "degrees": [10, 20, 30]}, {"fit": True}], "view": {"size": [16, 16]},
         "camera": {"eye": [0, 1, 4]}}
MODELS = ["Box-Draco/Box.gltf", "BoxMeshopt/BoxMeshopt.glb", "AnimatedMorphCube/AnimatedMorphCube.glb",
          "RiggedFigure/RiggedFigure.glb", "LightsPunctualLamp/LightsPunctualLamp.gltf"]


def errors_of(node, modules, file):
    done = subprocess.run([node, "-e", VALIDATE, file], env={**os.environ, "NODE_PATH": str(modules)}, check=True,
                          capture_output=True, text=True)
    report = json.loads(done.stdout)
    return [f"{m['pointer']}: {m['message']}" for m in report["issues"]["messages"] if m["severity"] == 0]


def main():
    parser = argparse.ArgumentParser()
    for name in ("root", "program", "work"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    node, modules = shutil.which("node"), options.root / "build/node/node_modules"
    if not node or not (modules / "gltf-validator").is_dir():
        print("no node, or no gltf-validator: scripts/setup --check")
        sys.exit(77)
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    windmill = options.root / "samples/animated_gltf/windmill.gltf"
    scene = options.work / "scene.json"
    scene.write_text(json.dumps({**SCENE, "model": str(windmill)}))
    assets = os.environ.get("FILAMENT_ASSET_DIR", "")
    models = [pathlib.Path(assets) / "models" / name for name in MODELS if assets]
    failed = False
    for source in [scene, windmill, *filter(pathlib.Path.exists, models)]:
        for ending in ("glb", "gltf"):
            file = options.work / f"{source.stem}.saved.{ending}"
            size = [] if source.suffix == ".json" else ["--size", "16x16"]
            subprocess.run([options.program, source, *size, "--backend", "gles", "--out", options.work, "--save-gltf", file],
                           check=True, stdout=subprocess.DEVNULL)
            errors = errors_of(node, modules, file)
            print(f"{file.name}: {len(errors)} errors", *errors, sep="\n  ")
            failed |= bool(errors)
    sys.exit(failed)


main()
