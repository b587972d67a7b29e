# SPDX-License-Identifier: Apache-2.0
"""The figure of threading_bench --contention: what threads do to each other, by job, over the number of workers."""
import matplotlib.pyplot as plt

from style import BLUE, GREEN, GREY, ORANGE, PINK, RED, SKY, BadInput, field, finite, load_json

COLORS = (BLUE, ORANGE, GREEN, PINK, RED, SKY, "#000000", GREY)


def draw(path, title):
    report = load_json(path)
    if not isinstance(report, dict) or "contention" not in report:
        raise BadInput(f"{path}: is not a file of threading_bench --contention --json")
    panels = {}
    for i, row in enumerate(field(report, "contention", list, str(path))):
        where = f"{path}: row {i}"
        workers, jobs = finite(row, "workers", where), finite(row, "jobs", where)
        if workers <= 0 or jobs <= 0:
            raise BadInput(f"{where}: workers and jobs are above 0")
        lines = panels.setdefault(field(row, "work", str, where), {})
        counts = field(row, "counts", dict, where)
        for kind in counts:
            lines.setdefault(kind, []).append((workers, finite(counts, kind, where) / jobs))
    if not panels:
        raise BadInput(f"{path}: has no rows")
    figure, grid = plt.subplots(1, len(panels), figsize=(3.4 * len(panels), 3.6), squeeze=False, sharey=True)
    for axes, (work, lines) in zip(grid[0], panels.items()):
        for color, (kind, points) in zip(COLORS, lines.items()):
            seen = [(workers, count) for workers, count in points if count > 0]
            axes.plot(*zip(*seen) if seen else ([], []), color=color, marker="o", markersize=3, linewidth=1.2, label=kind)
        axes.set_xscale("log", base=2)
        axes.set_yscale("log")
        axes.grid(which="major")
        axes.set_title(work)
        axes.set_xlabel("workers")
    grid[0][0].set_ylabel("by job")
    grid[0][-1].legend(fontsize=6.5)
    if title:
        figure.suptitle(title)
    figure.tight_layout()
    return figure
