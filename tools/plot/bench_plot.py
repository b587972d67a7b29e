# SPDX-License-Identifier: Apache-2.0
"""The figures of threading_bench: medians with quartile whiskers, latencies as distributions, growth as lines."""
import dataclasses
import re
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from style import BLUE, CONTENDER_COLORS, CONTENDER_LABELS, GREEN, ORANGE, PINK, RED, BadInput, field, finite, load_report

SERIES_COLORS = (BLUE, ORANGE, GREEN, PINK, RED)


@dataclasses.dataclass
class Series:
    name: str
    median: float
    first: float
    third: float
    samples: list
    note: str


@dataclasses.dataclass
class Workload:
    name: str
    title: str
    unit: str
    kind: str
    x: float
    series: dict
    ratios: dict   # ours / other, medians over the rounds
    targets: list  # (text, limit)


def read_series(item, where):
    name = field(item, "name", str, where)
    where = f"{where}, contender '{name}'"
    samples = item.get("samples", item.get("rounds", []))
    if not isinstance(samples, list) or not all(isinstance(v, (int, float)) for v in samples):
        raise BadInput(f"{where}: 'rounds' is no list of numbers")
    return Series(name, finite(item, "median", where), finite(item, "q1", where), finite(item, "q3", where), samples,
                  str(item.get("note", "")))


def read_workload(item, where):
    name = field(item, "name", str, where)
    where = f"{where}, workload '{name}'"
    series = [read_series(contender, where) for contender in field(item, "contenders", list, where)]
    targets = [(field(t, "text", str, where), finite(t, "limit", where)) for t in item.get("targets", [])]
    ratios = {other: finite(ratio, "median", where) for other, ratio in field(item, "ratios", dict, where).items()}
    return Workload(name, field(item, "title", str, where), field(item, "unit", str, where),
                    field(item, "kind", str, where), finite(item, "x", where), {s.name: s for s in series}, ratios,
                    targets)


def read(path):
    data = load_report(path, "threading_bench", "threading_bench --json")
    workloads = [read_workload(item, str(path)) for item in field(data, "workloads", list, str(path))]
    if not workloads:
        raise BadInput(f"{path}: no workloads in it: was everything filtered out?")
    return data, workloads


# ------------------------------------------------------------------------------------------------------- pieces

def plain(value, _=None):
    """10 000 as 10k, 0.5 as 0.5."""
    for limit, suffix in ((1e6, "M"), (1e3, "k")):
        if value >= limit:
            return f"{value / limit:g}{suffix}"
    return f"{value:g}"


def log_axis(axis):
    axis.set_major_locator(LogLocator(numticks=12))
    axis.set_major_formatter(FuncFormatter(plain))
    axis.set_minor_formatter(NullFormatter())


def color_of(name):
    return CONTENDER_COLORS.get(name, GREEN)


def label_of(name):
    return CONTENDER_LABELS.get(name, name)


def wrapped(title):
    """Lines of 16 letters at most; always broken at commas."""
    return "\n".join(line for part in title.split(", ") for line in textwrap.wrap(part, 16, break_long_words=False))


def contenders_of(workloads):
    """In the order of the colour table, so that every plot has the same order."""
    present = {name for workload in workloads for name in workload.series}
    return [name for name in CONTENDER_COLORS if name in present]


def bar_places(names, name, count):
    """Centres and width of the bars of a contender in `count` groups."""
    width = 0.84 / len(names)
    return np.arange(count) + (names.index(name) - (len(names) - 1) / 2) * width, width


def draw_bars(axes, workloads, names, title, y_label, scale=lambda workload: 1.0):
    """Groups of bars with quartile whiskers; a workload's figures are multiplied with its scale."""
    for name in names:
        places, width = bar_places(names, name, len(workloads))
        chosen = [(at, w, w.series[name], scale(w)) for at, w in zip(places, workloads) if name in w.series]
        if not chosen:
            continue
        at = [place for place, *_ in chosen]
        medians, firsts, thirds = (np.array([getattr(s, key) * factor for _, _, s, factor in chosen])
                                   for key in ("median", "first", "third"))
        bars = axes.bar(at, medians, width * 0.92, color=color_of(name), label=label_of(name), edgecolor="white",
                        linewidth=0.4)
        for bar, (_, _, series, _) in zip(bars, chosen):
            bar.set_hatch("///" if series.note else "")
        axes.errorbar(at, medians, yerr=[np.maximum(medians - firsts, 0), np.maximum(thirds - medians, 0)], fmt="none",
                      ecolor="#333333", elinewidth=0.8, capsize=1.6, capthick=0.8)
    axes.set_yscale("log")
    log_axis(axes.yaxis)
    axes.set_xticks(range(len(workloads)))
    axes.set_xticklabels([wrapped(w.title) for w in workloads], fontsize=7.5)
    axes.tick_params(axis="x", length=0)
    axes.grid(axis="y")
    axes.set_ylabel(y_label)
    axes.set_title(title)
    axes.legend(ncol=len(names), loc="lower right", bbox_to_anchor=(1.0, 1.0), columnspacing=1.2, handlelength=1.2)


def draw_absolute_limits(axes, workloads, names):
    """A tick over "ours" where a target is given in the workload's own unit."""
    if "ours" not in names:
        return
    places, width = bar_places(names, "ours", len(workloads))
    for at, workload in zip(places, workloads):
        for text, limit in workload.targets:
            if re.match(r"ours <=", text):
                axes.plot([at - width * 0.7, at + width * 0.7], [limit, limit], color=RED, linewidth=2,
                          solid_capstyle="butt", zorder=5)


# ------------------------------------------------------------------------------------------------------- panels

def job_panel(figure, cell, workloads):
    axes = figure.add_subplot(cell)
    names = contenders_of(workloads)
    draw_bars(axes, workloads, names, "Cost of a job, a fork, a link, an item", "ns; µs for a loop of 8192")
    draw_absolute_limits(axes, workloads, names)
    axes.set_ylim(top=axes.get_ylim()[1] * 4)
    for x, workload in enumerate(workloads):
        if "tbb" in workload.ratios:
            axes.text(x, 0.985, f"{workload.ratios['tbb']:.2f} × oneTBB", transform=axes.get_xaxis_transform(), ha="center",
                      va="top", fontsize=8, color=BLUE, fontweight="bold")
    axes.annotate("red: target   hatched: scaled down, per item   blue: ours / oneTBB, median over the rounds",
                  (0.0, -0.2), xycoords="axes fraction", fontsize=7.5, color="#666666")


def uneven_panel(figure, cell, workloads):
    axes = figure.add_subplot(cell)

    def over_ideal(workload):
        ideal = workload.series.get("ideal") or workload.series.get("fair")
        return 1 / ideal.median if ideal and ideal.median > 0 else 1.0
    names = [name for name in contenders_of(workloads) if name not in ("ideal", "fair")]
    draw_bars(axes, workloads, names, "Uneven work", "× ideal or fair share", over_ideal)
    axes.axhline(1, color="#222222", linewidth=1)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))


def command_panel(figure, cell, workloads):
    axes = figure.add_subplot(cell)
    names = contenders_of(workloads)
    draw_bars(axes, workloads, names, "Commands", "ns a draw")
    axes.set_yscale("linear")
    axes.yaxis.set_minor_locator(plt.NullLocator())
    draw_absolute_limits(axes, workloads, names)
    axes.set_ylim(bottom=0)
    axes.set_xlim(-0.6, len(workloads) - 0.4)


def wakeup_panels(figure, cell, workloads):
    grid = cell.subgridspec(1, len(workloads), wspace=0.12)
    first = None
    for i, workload in enumerate(workloads):
        axes = figure.add_subplot(grid[i], sharey=first, sharex=first)
        first = first or axes
        for name in contenders_of([workload]):
            values = np.sort(np.array(workload.series[name].samples, dtype=float))
            values = np.maximum(values, 1e-2)
            axes.step(values, np.arange(1, len(values) + 1) / len(values) * 100, where="post", color=color_of(name),
                      label=label_of(name), linewidth=1.6 if name == "ours" else 1.1)
        for text, limit in workload.targets:
            if "/" in text:
                continue  # a ratio has no place on an axis of microseconds
            axes.plot([limit], [99 if "p99" in text else 50], marker="<", color=RED, markersize=7, clip_on=False, zorder=5)
        axes.set_xscale("log")
        log_axis(axes.xaxis)
        axes.grid()
        axes.set_ylim(0, 100)
        axes.set_title(workload.title.capitalize(), fontsize=9)
        axes.set_xlabel("µs until another thread runs the job")
        if i == 0:
            axes.set_ylabel("% of wake-ups")
            axes.legend(loc="lower right")
        else:
            plt.setp(axes.get_yticklabels(), visible=False)


def scaling_panel(figure, cell, workloads, title, as_speedup):
    axes = figure.add_subplot(cell)
    workloads = sorted(workloads, key=lambda w: w.x)
    threads = np.array([w.x + 1 for w in workloads])
    for name in contenders_of(workloads):
        if as_speedup and name == "serial":
            continue
        chosen = [(t, w) for t, w in zip(threads, workloads) if name in w.series]
        at = np.array([t for t, _ in chosen])
        series = [w.series[name] for _, w in chosen]
        medians, firsts, thirds = (np.array([getattr(s, k) for s in series]) for k in ("median", "first", "third"))
        if as_speedup:
            serial = np.array([w.series["serial"].median for _, w in chosen])
            medians, firsts, thirds = serial / medians, serial / thirds, serial / firsts
        axes.plot(at, medians, marker="o", markersize=4, color=color_of(name), label=label_of(name))
        axes.fill_between(at, firsts, thirds, color=color_of(name), alpha=0.15, linewidth=0)
    axes.set_xticks(threads)
    axes.grid()
    axes.set_xlabel("threads, with the caller")
    axes.set_title(title)
    if as_speedup:
        axes.set_ylabel("speed-up over the serial loop")
        axes.set_ylim(bottom=0)
    else:
        axes.set_ylabel(workloads[0].unit)
        axes.set_yscale("log")
        log_axis(axes.yaxis)
    axes.legend(loc="best")


def frame_panel(figure, cell, workloads):
    """CPU milliseconds over renderables; straight lines of slope 1 are linear growth."""
    axes = figure.add_subplot(cell)
    for mixed in (False, True):
        chosen = sorted((w for w in workloads if w.name.endswith("_mixed") == mixed), key=lambda w: w.x)
        if not chosen:
            continue
        at = np.array([w.x for w in chosen])
        for i, name in enumerate(n for n in chosen[0].series if n.startswith("cpu ")):
            series = [w.series[name] for w in chosen if name in w.series]
            if len(series) != len(chosen):
                continue
            color = SERIES_COLORS[i % len(SERIES_COLORS)]
            workers = name.removeprefix("cpu ").removesuffix("w")
            axes.plot(at, [s.median for s in series], color=color, marker="s" if mixed else "o", markersize=4,
                      linestyle="--" if mixed else "-",
                      label=f"{workers} worker{'' if workers == '1' else 's'}, {64 if mixed else 1} material{'s' if mixed else ''}")
            axes.fill_between(at, [s.first for s in series], [s.third for s in series], color=color, alpha=0.15, linewidth=0)
        for workload in chosen:
            for _, limit in workload.targets:
                axes.plot([workload.x], [limit], marker="_", color=RED, markersize=14, markeredgewidth=2, zorder=5)
    axes.set_xscale("log")
    axes.set_yscale("log")
    log_axis(axes.xaxis)
    log_axis(axes.yaxis)
    axes.grid()
    axes.set_xlabel("visible renderables")
    axes.set_ylabel("CPU ms a frame, app + workers")
    axes.set_title("Frames on the null backend")
    axes.legend(loc="upper left", fontsize=7.5)


# ------------------------------------------------------------------------------------------------------ figures

def chosen_panel(workloads, kinds, panel):
    """(function that draws into a cell) if there are workloads of these kinds."""
    chosen = [w for w in workloads if w.kind in kinds]
    return [lambda figure, cell: panel(figure, cell, chosen)] if chosen else []


def scaling_panels(workloads):
    panels = []
    for name, title, as_speedup in (("scaling_loop", "parallel-for of 20 ns items", True),
                                    ("scaling_tree", "Fork-join tree", False)):
        chosen = [w for w in workloads if w.name.startswith(name)]
        if chosen:
            panels.append(lambda f, c, chosen=chosen, title=title, s=as_speedup: scaling_panel(f, c, chosen, title, s))
    return panels + chosen_panel(workloads, ("frames",), frame_panel)


def rows_of(workloads, only_scaling):
    """(height, panels, their widths) for each row that has something to show."""
    rows = []
    if not only_scaling:
        rows.append((3.4, chosen_panel(workloads, ("jobs",), job_panel), (1,)))
        rows.append((3.0, chosen_panel(workloads, ("wakeup",), wakeup_panels), (1,)))
        rows.append((3.0, chosen_panel(workloads, ("uneven",), uneven_panel) +
                     chosen_panel(workloads, ("commands",), command_panel), (2, 1)))
    rows.append((3.6, scaling_panels(workloads), (1, 1, 1)))
    return [row for row in rows if row[1]]


def draw_row(figure, cell, panels, widths):
    grid = cell.subgridspec(1, len(panels), width_ratios=widths[:len(panels)], wspace=0.2)
    for i, panel in enumerate(panels):
        panel(figure, grid[i])


def caption(data):
    machine = data.get("machine", {})
    parts = [str(machine[key]) for key in ("cpu", "kernel") if key in machine]
    parts.append(f"{data.get('threads', '?')} threads, {data.get('rounds', '?')} rounds, load {machine.get('load', '?')}")
    parts.append(f"commit {machine.get('commit', '?')}")
    return "   ·   ".join(parts)


def draw(path, title, only_scaling=False):
    data, workloads = read(path)
    rows = rows_of(workloads, only_scaling)
    if not rows:
        raise BadInput(f"{path}: nothing that this plot shows: its workloads are {', '.join(w.name for w in workloads[:8])}")
    heights = [height for height, *_ in rows]
    gap = 1.0
    total = sum(heights) + gap * (len(rows) - 1) + 1.65
    figure = plt.figure(figsize=(13, total))
    grid = figure.add_gridspec(len(rows), 1, height_ratios=heights, left=0.06, right=0.985, top=1 - 0.85 / total,
                               bottom=0.8 / total, hspace=gap / (sum(heights) / len(heights)))
    for i, (_, panels, widths) in enumerate(rows):
        draw_row(figure, grid[i], panels, widths)
    figure.suptitle(title or "Threading benchmarks: medians and quartiles, measured in turns", x=0.06, ha="left",
                    y=1 - 0.18 / total, fontsize=13, fontweight="bold", va="top")
    figure.text(0.06, 0.12 / total, caption(data), fontsize=7.5, color="#666666")
    return figure
