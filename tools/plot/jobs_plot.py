# SPDX-License-Identifier: Apache-2.0
"""A timeline: one row a thread, a bar a job, a line where a frame begins. Reads the Chrome trace-event format."""
import dataclasses

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch

from style import BadInput, field, finite, load_json

# Names in the legend, longest total first; the rest share one colour.
PALETTE = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#8b6fc6", "#b8a100", "#4a7a5c", "#a0522d",
           "#6b8cae", "#d98880", "#3d9970", "#7f7f00", "#b565a7")
OTHERS = "#b5b5b5"
RASTERIZE_ABOVE = 5000  # bars; more would make a vector file that no viewer opens


@dataclasses.dataclass
class Event:
    name: str
    begin: float  # milliseconds
    end: float
    depth: int = 0
    holds: bool = False  # others, inside of it
    frame: int = -1
    stolen: bool = False


@dataclasses.dataclass
class Track:
    name: str
    order: float
    events: list


def events_of(data, path):
    """The list of events: the file is it, or holds it."""
    events = data if isinstance(data, list) else data.get("traceEvents") if isinstance(data, dict) else None
    if not isinstance(events, list):
        raise BadInput(f"{path}: no Chrome trace: neither a list nor an object with 'traceEvents'")
    for number, event in enumerate(events):
        if not isinstance(event, dict):
            raise BadInput(f"{path}: event {number} is no object")
    return events


def arguments_of(event):
    arguments = event.get("args")
    return arguments if isinstance(arguments, dict) else {}


def read_complete(event, where):
    begin = finite(event, "ts", where) / 1000
    duration = finite(event, "dur", where) / 1000
    if duration < 0:
        raise BadInput(f"{where}: 'dur' is negative")
    arguments = arguments_of(event)
    frame = arguments.get("frame", -1)
    return Event(field(event, "name", str, where), begin, begin + duration,
                 frame=frame if isinstance(frame, int) else -1, stolen=arguments.get("stolen") is True)


def read_tracks(path):
    tracks = {}
    for number, event in enumerate(events_of(load_json(path), path)):
        where = f"{path}: event {number}"
        phase = event.get("ph")
        key = (str(event.get("pid", 0)), str(event.get("tid", 0)))
        if phase == "M":
            track = tracks.setdefault(key, Track(f"thread {key[1]}", len(tracks), []))
            if event.get("name") == "thread_name":
                track.name = str(arguments_of(event).get("name", track.name))
            elif event.get("name") == "thread_sort_index":
                track.order = finite(arguments_of(event), "sort_index", where)
        elif phase == "X":
            tracks.setdefault(key, Track(f"thread {key[1]}", len(tracks), [])).events.append(read_complete(event, where))
    with_events = [track for track in tracks.values() if track.events]
    if not with_events:
        raise BadInput(f"{path}: no complete events (\"ph\":\"X\") in it: was anything recorded?")
    return sorted(with_events, key=lambda track: track.order)


def assign_depths(events):
    """How many events of the same thread contain each one."""
    events.sort(key=lambda e: (e.begin, -e.end))
    around = []
    for event in events:
        while around and around[-1].end <= event.begin:
            around.pop()
        event.depth = len(around)
        if around:
            around[-1].holds = True
        around.append(event)


def cut_to(tracks, begin, end, path):
    """What happens in [begin, end] milliseconds after the first event; times then start at the first event."""
    origin = min(event.begin for track in tracks for event in track.events)
    last = max(event.end for track in tracks for event in track.events) - origin
    begin = 0.0 if begin is None else begin
    end = last if end is None else end
    if begin >= end:
        raise BadInput(f"{path}: --from {begin:g} is not before --to {end:g}; the trace ends at {last:g} ms")
    for track in tracks:
        for event in track.events:
            event.begin -= origin
            event.end -= origin
        track.events = [e for e in track.events if e.end >= begin and e.begin <= end]
    if not any(track.events for track in tracks):
        raise BadInput(f"{path}: nothing happens between {begin:g} and {end:g} ms; the trace ends at {last:g} ms")
    return begin, end


def total_by_name(tracks):
    totals = {}
    for track in tracks:
        for event in track.events:
            totals[event.name] = totals.get(event.name, 0) + event.end - event.begin
    return totals


def colors_by_name(totals):
    """The longest in total first. Of the whole trace, so that a name keeps its colour in every part of it."""
    ordered = sorted(totals, key=lambda name: (-totals[name], name))
    return {name: PALETTE[i] if i < len(PALETTE) else OTHERS for i, name in enumerate(ordered)}


def draw_track(axes, row, track, colors, span, rasterized):
    """Nested events are drawn inside the ones that contain them, a little lower in height."""
    height = 0.8
    smallest = span * 3e-4  # a bar that is there at all can be seen
    edged = span * 2e-3  # narrower ones would be all edge
    polygons, faces, edges, widths = [], [], [], []
    for event in sorted(track.events, key=lambda e: e.depth):
        inset = height * 0.5 * (1 - 0.72 ** event.depth)
        low, high = row - height / 2 + inset, row + height / 2 - inset
        end = max(event.end, event.begin + smallest)
        polygons.append([(event.begin, low), (event.begin, high), (end, high), (end, low)])
        faces.append(colors[event.name])
        edges.append("#222222" if event.stolen else "white")
        widths.append(0.5 if end - event.begin > edged else 0)
    axes.add_collection(PolyCollection(polygons, facecolors=faces, edgecolors=edges, linewidths=widths,
                                       rasterized=rasterized))


def label_spans(axes, row, track, begin, end):
    """The names of bars that are wide enough for them and hold no others."""
    width = end - begin
    for event in track.events:
        low, high = max(event.begin, begin), min(event.end, end)
        text = event.name if event.frame < 0 else f"{event.name} {event.frame}"
        if not event.holds and (high - low) / width > 0.0075 * len(text):
            axes.text((low + high) / 2, row, text, ha="center", va="center", fontsize=7, color="white", clip_on=True)


def frame_starts(tracks):
    """When the first event of every numbered frame begins."""
    starts = {}
    for track in tracks:
        for event in track.events:
            if event.frame >= 0:
                starts[event.frame] = min(starts.get(event.frame, event.begin), event.begin)
    return sorted((begin, frame) for frame, begin in starts.items())


def draw_frames(axes, tracks, begin, end):
    starts = [(at, frame) for at, frame in frame_starts(tracks) if begin <= at <= end]
    every = max(1, -(-len(starts) // 24))  # labels that fit
    for i, (at, frame) in enumerate(starts):
        axes.axvline(at, color="#444444", linewidth=0.9, linestyle=(0, (4, 2)), zorder=0.5)
        if i % every == 0:
            axes.text(at, -0.62, f" frame {frame}", fontsize=7.5, color="#444444", va="bottom", ha="left", clip_on=False)


def legend(axes, colors, totals, tracks):
    """What is shown, longest in total first."""
    named = sorted((n for n in totals if colors[n] != OTHERS), key=lambda name: -totals[name])
    handles = [Patch(facecolor=colors[name], label=f"{name}  {totals[name]:.3g} ms") for name in named]
    others = [name for name in totals if colors[name] == OTHERS]
    if others:
        handles.append(Patch(facecolor=OTHERS, label=f"{len(others)} others  {sum(totals[n] for n in others):.3g} ms"))
    if any(event.stolen for track in tracks for event in track.events):
        handles.append(Patch(facecolor="white", edgecolor="#222222", label="dark edge: stolen"))
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.005, 1.0), borderaxespad=0, handlelength=1.2)


def busy_share(track, begin, end):
    """Part of the time that the thread runs something; nested events count once."""
    outer = [(max(e.begin, begin), min(e.end, end)) for e in track.events if e.depth == 0]
    return float(np.clip(sum(b - a for a, b in outer) / (end - begin), 0, 1))


def draw(path, begin, end, title):
    tracks = read_tracks(path)
    colors = colors_by_name(total_by_name(tracks))
    begin, end = cut_to(tracks, begin, end, path)
    for track in tracks:
        assign_depths(track.events)
    totals = total_by_name(tracks)
    rows = max(len(tracks), min(len(totals) + 1, len(PALETTE) + 2) * 0.3)
    total = 0.62 * rows + 1.25
    figure = plt.figure(figsize=(14, total))
    axes = figure.add_axes([0.1, 0.55 / total, 0.75, 1 - 1.25 / total])
    rasterized = sum(len(track.events) for track in tracks) > RASTERIZE_ABOVE
    for row, track in enumerate(tracks):
        draw_track(axes, row, track, colors, end - begin, rasterized)
        label_spans(axes, row, track, begin, end)
    draw_frames(axes, tracks, begin, end)
    axes.set_xlim(begin, end)
    axes.set_ylim(len(tracks) - 0.4, -0.6)
    axes.set_yticks(range(len(tracks)))
    axes.set_yticklabels([f"{t.name}\n{busy_share(t, begin, end):.0%} busy" for t in tracks])
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("ms")
    axes.grid(axis="x")
    legend(axes, colors, totals, tracks)
    figure.suptitle(title or f"Jobs of {path.name}", x=0.1, ha="left", y=1 - 0.16 / total, va="top", fontsize=12,
                    fontweight="bold")
    return figure
