# SPDX-License-Identifier: Apache-2.0
"""The figure of material_bench: what each term costs beside the standard model, both APIs, with the reference text's figures."""
import re

import matplotlib.pyplot as plt
import numpy as np

from style import BLUE, ORANGE, RED, BadInput, field, finite, load_json

BACKENDS = (("vulkan", "Vulkan", BLUE), ("gles", "OpenGL ES", ORANGE))


def draw_reference(axes, y, text):
    """A span of ratios that the reference text gives, as a red mark."""
    numbers = [float(word) for word in re.findall(r"\d+(?:\.\d+)?", text)]
    if not numbers:
        return
    axes.plot([min(numbers), max(numbers)], [y, y], color=RED, linewidth=2, marker="|", markersize=11, zorder=5,
              solid_capstyle="butt")


def draw(path, title):
    report = load_json(path)
    if not isinstance(report, dict) or report.get("kind") != "materials":
        raise BadInput(f"{path}: is not a file of material_bench --json")
    rows = field(report, "rows", list, str(path))
    if not rows:
        raise BadInput(f"{path}: has no rows")
    figure, axes = plt.subplots(figsize=(8, 0.42 * len(rows) + 1.4))
    places = np.arange(len(rows))
    for offset, (key, name, color) in zip((-0.2, 0.2), BACKENDS):
        ratios, lows, highs = [], [], []
        for i, row in enumerate(rows):
            where = f"{path}: row {i}"
            figures = field(row, key, dict, where)
            ratios.append(finite(figures, "ratio", where))
            lows.append(finite(figures, "low", where))
            highs.append(finite(figures, "high", where))
        ratios, lows, highs = (np.array(values) for values in (ratios, lows, highs))
        axes.barh(places + offset, ratios, 0.38, color=color, label=name)
        axes.errorbar(ratios, places + offset, xerr=[np.maximum(ratios - lows, 0), np.maximum(highs - ratios, 0)],
                      fmt="none", ecolor="#333333", elinewidth=0.8, capsize=1.6)
        for place, ratio in zip(places, ratios):
            axes.text(ratio + 0.02, place + offset, f" {ratio:.2f}", va="center", fontsize=7.5)
    for place, row in zip(places, rows):
        draw_reference(axes, place, str(row.get("reference", "")))
    axes.plot([], [], color=RED, linewidth=2, marker="|", label="reference text")
    axes.axvline(1, color="#222222", linewidth=0.8)
    axes.set_yticks(places)
    axes.set_yticklabels([str(row.get("name", "")) for row in rows])
    axes.invert_yaxis()
    axes.set_xlim(left=0)
    axes.grid(axis="x")
    axes.set_xlabel("time of a full screen, x the standard model")
    axes.set_title(title or "What a material's terms cost")
    axes.legend(loc="upper right")
    figure.tight_layout()
    return figure
