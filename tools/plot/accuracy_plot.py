# SPDX-License-Identifier: Apache-2.0
"""The figures of filament-accuracy: error over time for every effect, and for whole frames."""
import dataclasses
import math

import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from style import BLUE, GREEN, GREY, ORANGE, PINK, RED, SKY, YELLOW, BadInput, field, finite, load_report

BACKEND_COLORS = {"vulkan": BLUE, "gles": ORANGE}
BACKEND_TITLES = {"vulkan": "Vulkan", "gles": "OpenGL ES"}
EFFECT_COLORS = (BLUE, ORANGE, GREEN, PINK, RED, SKY, YELLOW, "#332288", "#117733", "#882255", "#44aa99", "#999933")
SETTINGS_MARKERS = {"preset": "D", "budget": "s"}
FARTHEST = 1.9  # times the default: slower values are drawn at the edge of the image of whole frames, with their time
LEAST_SPAN = 0.16  # of the median: values that differ by less are drawn close together
LABEL_HEIGHT = 11  # pixels between labels at 100 dpi


@dataclasses.dataclass
class Point:
    label: str
    error: float
    total: float
    times: dict      # backend: (median, low, high), milliseconds
    ratios: dict     # backend: (median, low, high), to the standard value
    standard: bool


@dataclasses.dataclass
class Effect:
    name: str
    title: str
    cost: str
    frame: str
    linear: bool
    points: list


def read_estimates(value, key, interval_key, where):
    medians, intervals = field(value, key, dict, where), field(value, interval_key, dict, where)
    estimates = {}
    for backend in medians:
        bounds = field(intervals, backend, list, where)
        if len(bounds) != 2 or not all(isinstance(b, (int, float)) for b in bounds):
            raise BadInput(f"{where}: '{interval_key}' of {backend} is no pair of numbers")
        estimates[backend] = (finite(medians, backend, where), bounds[0], bounds[1])
    return estimates


def read_point(value, standard, where):
    name = field(value, "value", str, where)
    where = f"{where}, value '{name}'"
    return Point(name, finite(value, "ownError", where), finite(value, "totalError", where),
                 read_estimates(value, "milliseconds", "millisecondsInterval", where),
                 read_estimates(value, "ratio", "interval", where), name == standard)


def read_effect(item, where):
    name = field(item, "name", str, where)
    where = f"{where}, effect '{name}'"
    standard = field(item, "standard", str, where)
    points = [read_point(value, standard, where) for value in field(item, "values", list, where)]
    if not points:
        raise BadInput(f"{where}: no values")
    return Effect(name, field(item, "title", str, where), field(item, "cost", str, where), field(item, "frame", str, where),
                  bool(item.get("linear")), points)


def read(path):
    data = load_report(path, "filament-accuracy", "filament-accuracy")
    effects = [read_effect(item, str(path)) for item in field(data, "effects", list, str(path))]
    if not effects:
        raise BadInput(f"{path}: no effects in it: was everything skipped?")
    return effects, field(data, "frame", str, str(path))


# ------------------------------------------------------------------------------------------------------- pieces

def percent(value, _=None):
    if value <= 0:
        return "0"
    return f"{value * 100:.3g} %" if value >= 0.99e-6 else f"{value:.0e}"


def frontier(points):
    """Those that no other one beats in both, from the cheapest on. Points are (x, y)."""
    best, result = math.inf, []
    for x, y in sorted(points):
        if y < best:
            best = y
            result.append((x, y))
    return result


def error_axis(axes, errors):
    """Logarithmic where errors differ by more than a factor of 4. Returns where an error of 0 is drawn."""
    positive = [e for e in errors if e > 0]
    if not positive:
        axes.set_ylim(-1, 1)
        axes.set_yticks([0])
        axes.set_yticklabels(["0"])
        return 0
    low, high = min(positive), max(positive)
    if high / low < 4 and len(positive) == len(errors):
        axes.set_ylim(0, high * 1.35)
        axes.yaxis.set_major_formatter(FuncFormatter(percent))
        return 0
    floor = low / 6
    axes.set_yscale("log")
    axes.set_ylim(floor / 1.8 if len(positive) < len(errors) else low / 2.2, high * 3)
    decades = math.log10(high / low)
    axes.yaxis.set_major_locator(LogLocator(subs=(1,) if decades > 2.5 else (1, 2, 5)))
    axes.yaxis.set_major_formatter(FuncFormatter(percent))
    axes.yaxis.set_minor_formatter(NullFormatter())
    if len(positive) < len(errors):
        axes.axhline(floor, color="#999999", linewidth=0.8, linestyle=(0, (2, 2)))
        axes.text(0.005, floor, " no error", transform=axes.get_yaxis_transform(), ha="left", va="bottom", fontsize=7,
                  color="#777777")
    return floor


def time_limits(axes, bounds):
    """Around all intervals, never narrower than LEAST_SPAN of their middle."""
    low, high = min(b[0] for b in bounds), max(b[1] for b in bounds)
    middle = (low + high) / 2
    half = max((high - low) / 2, LEAST_SPAN / 2 * middle) * 1.12
    axes.set_xlim(middle - half, middle + half)


def place_labels(axes, labels):
    """Placed above their points, on the side that has room, and moved up until none covers another.

    labels: (x, y, text, color, weight)."""
    scale = axes.figure.dpi / 100
    left, right = axes.transAxes.transform((0, 0))[0], axes.transAxes.transform((1, 1))[0]
    taken = []
    for x, y, text, color, weight in sorted(labels, key=lambda label: axes.transData.transform(label[:2])[1]):
        at_x, at_y = axes.transData.transform((x, y))
        width = 6.2 * scale * len(text)
        to_left = at_x + width > right and at_x - width > left
        begin = at_x - width if to_left else at_x
        label_y = at_y + 9 * scale
        while any(abs(label_y - other_y) < LABEL_HEIGHT * scale and begin < other_end and other_begin < begin + width
                  for other_y, other_begin, other_end in taken):
            label_y += LABEL_HEIGHT * scale * 0.25
        taken.append((label_y, begin, begin + width))
        moved = label_y - at_y > 18 * scale
        axes.annotate(text, (x, y), xytext=((-3 if to_left else 3), (label_y - at_y) * 72 / axes.figure.dpi),
                      textcoords="offset points", ha="right" if to_left else "left", va="center", fontsize=8, color=color,
                      fontweight=weight, annotation_clip=False, zorder=6,
                      arrowprops={"arrowstyle": "-", "color": "#aaaaaa", "linewidth": 0.6} if moved else None)


# ------------------------------------------------------------------------------------------------------- figures

def times_of(effect, backend):
    """Milliseconds with their interval, by value: the standard value's median times the ratios, which are more precise
    than medians on a shared machine."""
    unit = next((p.times[backend][0] for p in effect.points if p.standard and backend in p.times), None)
    return {p.label: tuple(unit * r for r in p.ratios[backend]) if unit else p.times[backend]
            for p in effect.points if backend in p.times}


def draw_panel(axes, effect, backend):
    times = times_of(effect, backend)
    points = [p for p in effect.points if p.label in times]
    zero = error_axis(axes, [p.error for p in effect.points])
    time_limits(axes, [times[p.label][1:] for p in points])
    height = {p.label: p.error if p.error > 0 else zero for p in points}
    edge = frontier([(times[p.label][0], height[p.label]) for p in points])
    axes.step([x for x, _ in edge], [y for _, y in edge], where="post", color="#bbbbbb", linewidth=1.2, zorder=1)
    color = BACKEND_COLORS.get(backend, GREEN)
    for point in points:
        median, low, high = times[point.label]
        axes.errorbar([median], [height[point.label]], xerr=[[max(median - low, 0)], [max(high - median, 0)]], fmt="o",
                      markersize=7 if point.standard else 5.5, color=color, ecolor="#777777", elinewidth=0.9, capsize=2.5,
                      markerfacecolor=color if point.standard else "white", markeredgewidth=1.4, zorder=3)
    axes.grid(True)
    axes.set_title(BACKEND_TITLES.get(backend, backend))
    what = {"frame": "a frame", "environment": "loading the environment", "model": "loading the model"}[effect.cost]
    axes.set_xlabel(f"milliseconds, {what}")
    axes.figure.canvas.draw()
    place_labels(axes, [(times[p.label][0], height[p.label], p.label, "#222222", "bold" if p.standard else "normal")
                        for p in points])


def draw_effect(effect):
    backends = [b for b in BACKEND_COLORS if any(b in p.times for p in effect.points)]
    figure, panels = plt.subplots(1, max(1, len(backends)), figsize=(10, 3.3), sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.085, right=0.985, bottom=0.16, top=0.9, wspace=0.06)
    for axes, backend in zip(panels[0], backends):
        draw_panel(axes, effect, backend)
    panels[0][0].set_ylabel("error, RMS")
    return figure


def draw_frames(effects, frame):
    """Every value of every effect alone, and the presets: time against the default, error against the best of all."""
    shown = [e for e in effects if e.cost == "frame" and e.linear and e.frame == frame]
    if not shown:
        return None
    backends = [b for b in BACKEND_COLORS if any(b in p.ratios for e in shown for p in e.points)]
    figure, panels = plt.subplots(1, len(backends), figsize=(10, 6), sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.085, right=0.985, bottom=0.15, top=0.945, wspace=0.06)
    everything = [p for e in shown for p in e.points]
    for axes, backend in zip(panels[0], backends):
        zero = error_axis(axes, [p.total for p in everything])
        near = [p.ratios[backend] for p in everything if backend in p.ratios and p.ratios[backend][0] < FARTHEST]
        time_limits(axes, [(max(low, 0.5), min(high, FARTHEST)) for _, low, high in near] or [(1, 1)])
        right = axes.get_xlim()[1]
        places = {id(p): (p.ratios[backend][0], p.total if p.total > 0 else zero) for p in everything if backend in p.ratios}
        edge = frontier(list(places.values()))
        labels = []
        for i, effect in enumerate(shown):
            is_setting = effect.name in SETTINGS_MARKERS  # of everything, not one value alone
            color = "#222222" if is_setting else EFFECT_COLORS[i % len(EFFECT_COLORS)]
            for point in effect.points:
                if backend not in point.ratios:
                    continue
                _, low, high = point.ratios[backend]
                median, y = places[id(point)]
                x = min(median, right)
                axes.errorbar([x], [y], xerr=[[max(median - low, 0)], [max(high - median, 0)]], fmt="none",
                              ecolor="#cccccc", elinewidth=0.8, zorder=1)
                marker = ">" if median > right else SETTINGS_MARKERS.get(effect.name, "o")
                axes.plot([x], [y], marker=marker, markersize=7 if is_setting else 4.5, color=color, linestyle="none",
                          zorder=4 if is_setting else 3, clip_on=False)
                if is_setting or (median, y) in edge:
                    name = f"{effect.name} {point.label}" if is_setting else f"{effect.name}: {point.label.split('=')[-1]}"
                    labels.append((x, y, name if median <= right else f"{name}, {median:.2g} ×", color,
                                   "bold" if is_setting else "normal"))
        axes.step([x for x, _ in edge], [y for _, y in edge], where="post", color=GREY, linewidth=1.2, zorder=2)
        axes.grid(True)
        axes.set_title(BACKEND_TITLES.get(backend, backend))
        axes.set_xlabel("time of the frame, × default")
        figure.canvas.draw()
        place_labels(axes, labels)
    panels[0][0].set_ylabel("error of the frame, RMS")
    figure.text(0.085, 0.03, "Diamonds: presets. Squares: budgets. Dots: one value of one effect alone. Grey line: what nothing beats in both; "
                "dots have names there.", fontsize=8, color="#666666")
    return figure


def draw_all(path):
    """(name, figure), one after the other."""
    effects, frame = read(path)
    for effect in effects:
        yield effect.name, draw_effect(effect)
    frames = draw_frames(effects, frame)
    if frames:
        yield "frames", frames
