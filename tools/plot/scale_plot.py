# SPDX-License-Identifier: Apache-2.0
"""The figure of scale_bench: time and memory of a frame over what a scene holds, with a line of slope 1 beside them."""
import matplotlib.pyplot as plt

from style import BLUE, GREEN, GREY, ORANGE, PINK, RED, SKY, BadInput, field, finite, load_json

COLORS = (BLUE, ORANGE, GREEN, PINK, RED, SKY)


def points_of(series, path, name):
    points = field(series, "points", list, f"{path}: {name}")
    if not points:
        raise BadInput(f"{path}: {name}: has no points")
    rows = []
    for i, point in enumerate(points):
        where = f"{path}: {name}: point {i}"
        count, least, median = (finite(point, key, where) for key in ("count", "minimumMs", "medianMs"))
        size = finite(point, "sceneBytes", where) + finite(point, "frameBytes", where)
        if count <= 0 or least <= 0 or size <= 0:
            raise BadInput(f"{where}: counts, times and bytes are above 0")
        rows.append((count, least, median, size))
    return rows


def draw_slope(axes, lines):
    """Linear growth up to the least of the last points, over the last thirtieth of its counts."""
    counts, values = min(lines, key=lambda line: line[1][-1])
    ends = [max(counts[0], counts[-1] / 30), counts[-1]]
    axes.plot(ends, [values[-1] * count / counts[-1] for count in ends], color=GREY, linewidth=1, linestyle=":", label="linear")


def draw(path, title):
    report = load_json(path)
    if not isinstance(report, dict) or report.get("kind") != "scale":
        raise BadInput(f"{path}: is not a file of scale_bench --json")
    panels = {}
    for i, series in enumerate(field(report, "series", list, str(path))):
        name = field(series, "name", str, f"{path}: series {i}")
        panels.setdefault(field(series, "counted", str, f"{path}: {name}"), []).append((name, points_of(series, path, name)))
    if not panels:
        raise BadInput(f"{path}: has no series")
    figure, grid = plt.subplots(2, len(panels), figsize=(3.4 * len(panels), 6.4), squeeze=False)
    for column, (counted, all_series) in enumerate(panels.items()):
        times, sizes = grid[0][column], grid[1][column]
        time_lines, size_lines = [], []
        for color, (name, rows) in zip(COLORS * len(all_series), all_series):
            counts, least, median, size = zip(*rows)
            times.plot(counts, least, color=color, marker="o", markersize=3, linewidth=1.2, label=name)
            times.fill_between(counts, least, median, color=color, alpha=0.2, linewidth=0)
            sizes.plot(counts, [value / 1e6 for value in size], color=color, marker="o", markersize=3, linewidth=1.2)
            time_lines.append((counts, least))
            size_lines.append((counts, [value / 1e6 for value in size]))
        draw_slope(times, time_lines)
        draw_slope(sizes, size_lines)
        for axes in (times, sizes):
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.grid(which="major")
            axes.tick_params(axis="x", which="minor", labelsize=5.5)  # labels of less than a decade
        times.set_title(counted)
        times.legend(fontsize=6.5)
        sizes.set_xlabel(counted)
    grid[0][0].set_ylabel("milliseconds of a frame: minimum to median")
    grid[1][0].set_ylabel("megabytes of scene and frames")
    if title:
        figure.suptitle(title)
    figure.tight_layout()
    return figure
