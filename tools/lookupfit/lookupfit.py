#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Fits the look-ups of the environment that replace a specular lobe: the numbers in shaders/lib/look_ups.glsl.

  tools/lookupfit/lookupfit.py            prints the numbers of one, two and three look-ups, and their errors
  tools/lookupfit/lookupfit.py FILE.hdr ...   also judges them by these panoramas (Radiance, 2:1), which the fit does not see

A lobe is D V n.l of shaders/lib/brdf.glsl over its integral; a look-up is a texel of a pre-filtered cube: the round lobe D n.l of a view
along the normal. A look-up lies in the plane of view and normal, at mix(normal, mirrored view, turn), and has a roughness; all of them
count alike. Turn and roughness are cubic polynomials of perceptual roughness and n.v, such that rougher and smoother lobes of one shape have
one solution as they narrow: turn = 1 + roughness^2 P, roughness' = roughness Q.

Their numbers are multiples of 1/16, which packages store in fewer bytes: the errors grow by a hundredth of themselves. They minimise the
squared relative difference of radiance over random lamps in a dim sky (Levenberg 1944 and Marquardt 1963).
Takes two minutes. Needs numpy (Debian: python3-numpy).
"""
import sys

import numpy as np

DIRECTIONS = 24000  # of the sphere
ROUGHNESS = np.array([0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0])
COSINES = np.array([0.03, 0.08, 0.15, 0.25, 0.35, 0.5, 0.65, 0.8, 0.93, 1.0])
ANGLES = np.linspace(-1.0, 1.57, 130)  # of look-ups, from the normal towards the mirrored view
WIDTHS = np.linspace(0.08, 1.0, 36)  # their roughnesses
DEGREE = 3
KEEP = 1e-3  # weight that holds the numbers small
STARTS = {1: ([0], [0.95]), 2: ([0.45, -0.45], [0.8, 1.0]), 3: ([0.6, 0, -0.6], [0.7, 0.9, 1.0])}


def sphere(count):
    """Directions of equal areas: a spiral of golden angles."""
    index = np.arange(count) + 0.5
    z, turn = 1 - 2 * index / count, np.pi * (1 + 5**0.5) * index
    sine = np.sqrt(1 - z * z)
    return np.stack([sine * np.cos(turn), sine * np.sin(turn), z], 1)


def unit(vector):
    return vector / np.linalg.norm(vector)


def distribution(noh, alpha):
    """GGX: Walter et al. 2007, up to a constant."""
    return 1 / (noh * noh * (alpha * alpha - 1) + 1) ** 2


def lobe(light, nov, roughness):
    alpha2, nol, view = roughness**4, light[:, 2], np.array([np.sqrt(1 - nov * nov), 0, nov])
    half = light + view
    half /= np.linalg.norm(half, axis=1)[:, None]
    up = np.maximum(nol, 0)
    visibility = 1 / (up * np.sqrt(nov * nov * (1 - alpha2) + alpha2) + nov * np.sqrt(up * up * (1 - alpha2) + alpha2))
    weights = distribution(half[:, 2], roughness**2) * visibility * up
    return weights / weights.sum()


def look_up(light, angle, roughness):
    cosine = np.maximum(light @ np.array([-np.sin(angle), 0, np.cos(angle)]), 0)
    weights = distribution(np.sqrt((1 + cosine) / 2), roughness**2) * cosine
    return weights / weights.sum()


def lamps(light, count, random):
    """Skies with two to six round lamps, from a degree to half of the sky."""
    skies = np.full((count, len(light)), 0.15)
    for sky in skies:
        for _ in range(random.integers(2, 7)):
            size = 10 ** random.uniform(-1.6, -0.3)
            sky += random.uniform(0.12, 0.4) / size**2 * np.exp((light @ unit(random.normal(size=3)) - 1) / size**2)
    return skies / skies.mean(1, keepdims=True)


def read_panorama(path, height=128):
    with open(path, "rb") as file:
        while file.readline() != b"\n":
            pass
        size = file.readline().split()
        rows, columns = int(size[1]), int(size[3])
        data, texels, at = file.read(), np.zeros((rows, columns, 4), np.uint8), 0
    for row in texels:
        at += 4
        for channel in range(4):
            x = 0
            while x < columns:
                count = data[at]
                run = count > 128
                count -= 128 if run else 0
                row[x:x + count, channel] = data[at + 1] if run else np.frombuffer(data[at + 1:at + 1 + count], np.uint8)
                at, x = at + (2 if run else 1 + count), x + count
    scale = np.where(texels[..., 3] > 0, np.exp2(texels[..., 3].astype(float) - 136), 0)
    mean = (texels[..., :3] * scale[..., None]).mean(-1)
    return mean.reshape(height, rows // height, 2 * height, columns // (2 * height)).mean((1, 3))


def turned(panorama, light, count, random):
    """The panorama as seen after random turns."""
    height, skies = len(panorama), []
    for _ in range(count):
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
        d = light @ turn
        row = np.clip(np.arccos(np.clip(d[:, 1], -1, 1)) / np.pi * height, 0, height - 1).astype(int)
        column = ((0.5 - np.arctan2(d[:, 0], d[:, 2]) / (2 * np.pi)) * 2 * height).astype(int) % (2 * height)
        sky = panorama[row, column]
        skies.append(sky / sky.mean())
    return np.array(skies)


class Skies:
    """Radiance of skies through all look-ups and through all lobes."""

    def __init__(self, light, skies):
        self.looks = np.array([[skies @ look_up(light, angle, width) for width in WIDTHS] for angle in ANGLES])
        self.exact = np.array([[skies @ lobe(light, nov, roughness) for nov in COSINES] for roughness in ROUGHNESS])
        self.norm = np.sqrt((self.exact**2).mean(-1, keepdims=True))

    def at(self, angle, width):
        """Interpolated between the look-ups."""
        def cell(values, grid):
            place = np.clip((values - grid[0]) / (grid[1] - grid[0]), 0, len(grid) - 1.001)
            return place.astype(int), (place - place.astype(int))[..., None]
        (i, u), (j, v) = cell(angle, ANGLES), cell(width, WIDTHS)
        looks = self.looks
        return (looks[i, j] * (1 - v) + looks[i, j + 1] * v) * (1 - u) + (looks[i + 1, j] * (1 - v) + looks[i + 1, j + 1] * v) * u

    def difference(self, look_ups):
        mean = sum(self.at(angle, width) for angle, width in look_ups) / len(look_ups)
        return (mean - self.exact) / self.norm

    def error(self, look_ups):
        """Relative root mean square, of each lobe."""
        return np.sqrt((self.difference(look_ups) ** 2).mean(-1))


R, C = np.meshgrid(ROUGHNESS, COSINES, indexing="ij")
BASIS = np.stack([R**i * C**j for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i)], -1)


def angle_of(turn):
    return np.arctan2(np.sqrt(1 - C * C) * turn, C * turn + 1 - turn)


def look_ups_of(numbers):
    return [(angle_of(1 + R * R * (BASIS @ turn)), np.clip(R * (BASIS @ width), 0, 1)) for turn, width in numbers]


def dominant():
    """The single look-up of Lagarde and de Rousiers 2014."""
    smooth = 1 - R * R
    return smooth * (np.sqrt(smooth) + R * R)


def start(count):
    def fitted(values):
        return np.linalg.lstsq(BASIS.reshape(-1, BASIS.shape[-1]), values.ravel(), rcond=None)[0]
    offsets, widths = STARTS[count]
    return np.array([[fitted((np.clip(dominant() + offset * R, -0.5, 1.3) - 1) / (R * R)), fitted(np.full(R.shape, width))]
                     for offset, width in zip(offsets, widths)])


def fit(skies, count, steps=60):
    """Levenberg and Marquardt, with derivatives by differences."""
    numbers = start(count)

    def residuals(values):
        own = skies.difference(look_ups_of(values.reshape(numbers.shape))).ravel() / np.sqrt(skies.exact.shape[-1])
        return np.concatenate([own, KEEP * values])
    values, damping = numbers.ravel(), 1e-2
    now = residuals(values)
    for _ in range(steps):
        slopes = np.array([(residuals(values + step) - now) / 1e-5 for step in 1e-5 * np.eye(len(values))])
        square, pull = slopes @ slopes.T, slopes @ now
        while damping < 1e8:
            tried = values - np.linalg.solve(square + damping * np.diag(np.diag(square)), pull)
            then = residuals(tried)
            if then @ then < now @ now:
                values, now, damping = tried, then, damping / 3
                break
            damping *= 4
    return values.reshape(numbers.shape)


def written(values):
    return ", ".join(f"{round(value * 16) / 16}f" for value in values)


def main():
    random, light = np.random.default_rng(7), sphere(DIRECTIONS)
    skies = Skies(light, lamps(light, 400, random))
    judges = {path: Skies(light, turned(read_panorama(path), light, 60, random)) for path in sys.argv[1:]}
    shown = {"lamps": skies, **judges}
    once = [(angle_of(dominant()), R)]
    print("dominant:", {name: round(each.error(once).mean(), 3) for name, each in shown.items()})
    for count in (1, 2, 3):
        numbers = fit(skies, count)
        print(f"{count}:", {name: round(each.error(look_ups_of(numbers)).mean(), 3) for name, each in shown.items()}, flush=True)
        for index, (turn, width) in enumerate(numbers):
            print(f"  {index} turn     ", written(turn))
            print(f"  {index} roughness", written(width), flush=True)


if __name__ == "__main__":
    main()
