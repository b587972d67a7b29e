# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python module share."""
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True

import numpy as np  # noqa: E402

import filament_core as fc  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
WINDMILL = ROOT / "samples/animated_gltf/windmill.gltf"
BACKENDS = ("vulkan", "gles")
QUAD = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)  # 2 x 2 metres, faces +z
QUAD_TRIANGLES = [[0, 1, 2], [0, 2, 3]]
QUAD_UV = [[0, 0], [1, 0], [1, 1], [0, 1]]

__all__ = ["BACKENDS", "QUAD", "QUAD_TRIANGLES", "QUAD_UV", "ROOT", "WINDMILL", "fc", "flat_view", "np", "placed", "quad",
           "run_script", "unittest", "unlit"]


def flat_view(width=64, height=64, metres=2.0):
    """Looks down -z from z = 5 without perspective; `metres` from top to bottom, and display values without a curve."""
    view = fc.View((width, height))
    view.look_at((0, 0, 5), (0, 0, 0))
    view.orthographic(metres, far=100)
    view["toneMapper"] = "linear"
    return view


def quad(engine, **more):
    return engine.mesh(QUAD, QUAD_TRIANGLES, uv=QUAD_UV, **more)


def unlit(engine, color):
    instance = engine.built_in_material("unlit").instance()
    instance.set("baseColor", color)
    return instance


def placed(x=0.0, y=0.0, z=0.0, scale=1.0):
    """A transform: scaled, then moved."""
    matrix = np.diag([scale, scale, scale, 1.0])
    matrix[:3, 3] = x, y, z
    return matrix


def run_script(text, seconds=120):
    """Runs a program of Python that finds the module as this one does; returns its exit status and output."""
    folder = pathlib.Path(fc.__file__).resolve().parents[1]
    start = f"import sys; sys.path.insert(0, {str(folder)!r}); import filament_core as fc, gc, os, threading, time\n"
    done = subprocess.run([sys.executable, "-c", start + text], capture_output=True, text=True, timeout=seconds, check=False)
    return done.returncode, done.stdout + done.stderr
