#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plots what choices of quality cost and what they bring: error over device time.

  PYTHONPATH=build/release/python /usr/bin/python3 python/examples/error_over_time.py [--backend gles] [--out FILE.png]

Each cell below is a step, as in a notebook. The reference images are means of the engine's images: edges by drawing 16
samples a pixel, penumbras by averaging hard shadows of many suns within one disc.
"""
# %% Set-up
import argparse
import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import filament_core as fc  # noqa: E402

SUN_DEGREES = 3.0  # radius of its disc: large, so that penumbras show
DIRECTION = np.array([-1.0, -1.6, -0.8]) / np.linalg.norm([1.0, 1.6, 0.8])
SHADOWS = ("off", "hard", "pcf2", "pcf3", "pcf5", "poisson", "pcss", "vsm", "evsm")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--backend", default="gles", help="vulkan or gles: the errors are the same, the times are not")
    parser.add_argument("--size", type=int, nargs=2, default=(320, 180), metavar=("W", "H"))
    parser.add_argument("--suns", type=int, default=64, help="pictures that the true penumbra is the mean of")
    parser.add_argument("--frames", type=int, default=32, help="frames that temporal anti-aliasing gathers")
    parser.add_argument("--out", default="error_over_time.png")
    return parser.parse_args()


# %% A scene: balls on a plane, under a sun
def scene_of(engine, direction=DIRECTION):
    scene = fc.Scene(engine)
    for index, color in enumerate([(0.8, 0.2, 0.1), (0.2, 0.6, 0.3), (0.2, 0.3, 0.8)]):
        material = engine.built_in_material("lit").instance()
        material.set("baseColor", color)
        matrix = np.eye(4)
        matrix[:3, 3] = index - 1.0, 0.3 + 0.25 * index, 0.4 * index
        scene.add_mesh(engine.sphere(0.3), material, transform=matrix)
    ground = engine.built_in_material("lit").instance()
    ground.set("baseColor", (0.7, 0.7, 0.7))
    scene.add_mesh(engine.plane(20, 20), ground)
    scene.add_sun(direction, 80_000, angular_radius_degrees=SUN_DEGREES)
    scene.add_point_light((-2, 3, 3), 30_000, casts_shadows=False)
    return scene


def view_of(size):
    view = fc.View(size)
    view.look_at((0.5, 1.7, 3.2), (0, 0.4, 0), fov_degrees=40)
    view.clear_color = 0.1, 0.15, 0.25, 1
    return view


# %% Measuring: the image after so many frames, and the median device time of a frame
def measured(engine, scene, view, frames=1, timed=7):
    renderer = fc.Renderer(engine, pass_timers=True)
    picture = renderer.render(scene, view, output="light", frames=frames)
    renderer.take_timings()  # the first frames compile
    renderer.render(scene, view, output="light", frames=timed)
    engine.wait_idle()
    times = [frame["gpu_milliseconds"] for frame in renderer.take_timings()]
    return picture, statistics.median(times) if times else float("nan")


# %% The truth of edges: 4 x 4 pixels for each one
def true_edges(engine, scene, size):
    fine = fc.Renderer(engine).render(scene, view_of((size[0] * 4, size[1] * 4)), output="light")
    return fine.reshape(size[1], 4, size[0], 4, 4).mean(axis=(1, 3), dtype=np.float64).astype(np.float32)


# %% The truth of penumbras: the mean over the disc of the sun (a Fibonacci spiral)
def true_penumbra(engine, size, suns):
    view = view_of(size)
    view["shadows"] = "hard"
    view["shadowMapSize"] = 4096
    side = np.cross(DIRECTION, [0, 1, 0]) / np.linalg.norm(np.cross(DIRECTION, [0, 1, 0]))
    up = np.cross(side, DIRECTION)
    total = np.zeros((size[1], size[0], 4))
    for index in range(suns):
        radius = np.tan(np.radians(SUN_DEGREES)) * np.sqrt((index + 0.5) / suns)
        angle = index * np.pi * (3 - 5 ** 0.5)
        toward = DIRECTION + radius * (np.cos(angle) * side + np.sin(angle) * up)
        total += fc.Renderer(engine).render(scene_of(engine, toward), view, output="light")
    return (total / suns).astype(np.float32)


# %% Two plots
def plot_edges(axes, engine, size, frames):
    scene = scene_of(engine)
    truth = true_edges(engine, scene, size)
    for name, options in {"off": {}, "fxaa": {"antiAliasing": "fxaa"}, "4 samples": {"samples": 4}}.items():
        view = view_of(size)
        for option, value in options.items():
            view[option] = value
        picture, time = measured(engine, scene, view)
        axes.plot(time, fc.compare(truth, picture).relative_rms, "o", label=name)
    view = view_of(size)
    view["antiAliasing"] = "taa"
    counts = [2 ** i for i in range(frames.bit_length())]
    time = measured(engine, scene, view)[1]
    errors = [fc.compare(truth, fc.Renderer(engine).render(scene, view, output="light", frames=count)).relative_rms
              for count in counts]
    axes.plot(np.array(counts) * time, errors, ".-", label=f"taa, 1 to {counts[-1]} frames")
    axes.set(title="edges, against 16 samples a pixel", xlabel="device time until the picture, ms", xscale="log",
             ylabel="relative error (RMS)", ylim=(0, None))


def plot_shadows(axes, engine, size, suns):
    scene = scene_of(engine)
    truth = true_penumbra(engine, size, suns)
    for name in SHADOWS:
        view = view_of(size)
        view["shadows"] = name
        picture, time = measured(engine, scene, view)
        axes.plot(time, fc.compare(truth, picture).relative_rms, "o", label=name)
    axes.set(title=f"shadows, against the mean of {suns} suns", xlabel="device time of a frame, ms",
             ylabel="relative error (RMS)", ylim=(0, None))


def main():
    options = arguments()
    size = tuple(options.size)
    with fc.Engine(options.backend) as engine:
        figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5))
        plot_edges(left, engine, size, options.frames)
        left.legend()
        plot_shadows(right, engine, size, options.suns)
        right.legend()
        figure.suptitle(f"{engine.device['device']}, {size[0]} x {size[1]}", fontsize=9)
        figure.tight_layout()
        figure.savefig(options.out, dpi=120)
    print(options.out)


if __name__ == "__main__":
    main()
