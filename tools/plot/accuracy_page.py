# SPDX-License-Identifier: Apache-2.0
"""The page of filament-accuracy: error and time of every value, from the folder of its data.

In the folder: results.json, and *.fragment.html, finished sections whose images lie beside them. The page shows every effect as
a figure beside its table. A marker has the number of its row; pointing at one lights up the other. It needs no library, and no
measurement: only the data.
"""
import html
import math
import re

from style import BLUE, ORANGE, BadInput, field, finite, load_json

COLORS, TITLES = {"vulkan": BLUE, "gles": ORANGE}, {"vulkan": "Vulkan", "gles": "OpenGL ES"}
WIDTH, HEIGHT = 460, 250  # of a figure, in its own units
LEFT, RIGHT, TOP, BOTTOM = 58, 14, 14, 40
WHOLE = ("preset", "budget")  # these choose everything, not one value
COMMAND = "build/release/bin/filament-accuracy"

STYLE = """
body{font:15px/1.5 system-ui,sans-serif;margin:0 auto;max-width:78rem;padding:1rem;color:#222;background:#fff;overflow-wrap:anywhere}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:12.5px}
td,th{padding:.15rem .4rem;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap;overflow-wrap:normal}
td:first-child,th:first-child,td.name,th.name{text-align:left}
section{border-top:1px solid #bbb;margin-top:1.6rem}h2{margin:.8rem 0 .2rem}
code{background:#f3f3f3;padding:.1rem .3rem}pre{background:#f3f3f3;padding:.6rem;overflow-x:auto}img{max-width:100%;height:auto}
.small{color:#555;font-size:13px}.standard td{font-weight:bold}.wide{overflow-x:auto;max-width:100%;min-width:0}
.pair{display:grid;grid-template-columns:minmax(0,25rem) minmax(0,1fr);gap:1rem;align-items:start}
.pictures{display:flex;flex-wrap:wrap;gap:.4rem}.pictures figure{margin:0;flex:0 1 14rem}
svg{width:100%;height:auto}svg text{font:11px system-ui,sans-serif;fill:#555}svg .mark text{font-size:9px;font-weight:bold;fill:#fff}
.mark{cursor:pointer}.lit td{background:#fff3c4}.mark.lit rect{stroke:#222;stroke-width:2.5}nav{columns:16rem;font-size:13px}
@media(max-width:60rem){.pair{grid-template-columns:minmax(0,1fr)}}
"""

SCRIPT = """
for (const section of document.querySelectorAll("section")) {
    const parts = section.querySelectorAll("[data-row]");
    for (const part of parts) {
        const light = (on) => parts.forEach((one) => one.classList.toggle("lit", on && one.dataset.row === part.dataset.row));
        part.addEventListener("pointerenter", () => light(true));
        part.addEventListener("pointerleave", () => light(false));
    }
}
"""


def escaped(text):
    return html.escape(str(text))


def percent(value):
    if value == 0:
        return "0"
    return f"{value:.1e}" if value < 1e-5 else f"{value * 100:.3g} %"


# ------------------------------------------------------------------------------------------------------- figures

def scale(values, begin, end, floor=None):
    """A function from values to places, and its ticks: logarithmic where values differ by more than a factor of 4. Zero is at
    `floor`, below everything."""
    positive = [value for value in values if value > 0]
    if not positive:
        return (lambda value: floor if floor is not None else (begin + end) / 2), [0]
    low, high = min(positive), max(positive)
    if high / low <= 4:
        low, high = low - 0.1 * low, high + 0.1 * low
        if floor is not None:
            low = 0
        steps = [low + (high - low) * i / 3 for i in range(4)]
        return (lambda value: begin + (value - low) / (high - low) * (end - begin)), steps
    low, high = math.log(low / 1.3), math.log(high * 1.3)
    inner = begin + (end - begin) * 0.16 if floor is not None and len(positive) < len(values) else begin
    ticks = [math.exp(low + (high - low) * i / 3) for i in range(4)]
    place = lambda value: floor if value <= 0 and floor is not None else \
        inner + (math.log(max(value, 1e-300)) - low) / (high - low) * (end - inner)
    return place, ticks + ([0] if inner != begin else [])


def mark(x, y, row, backend, title):
    color = COLORS.get(backend, "#555")
    corner = 8 if backend == "vulkan" else 2  # round for Vulkan, square for OpenGL ES
    return (f'<g class="mark" data-row="{row}"><title>{escaped(title)}</title><rect x="{x - 8:.1f}" y="{y - 8:.1f}" width="16" '
            f'height="16" rx="{corner}" fill="{color}" stroke="#fff"/><text x="{x:.1f}" y="{y + 3.2:.1f}" '
            f'text-anchor="middle">{row}</text></g>')


def figure(effect, values, backends):
    """Error over time, both APIs in one."""
    ratios = [value["ratio"][backend] for value in values for backend in backends]
    if not ratios:
        return ""
    to_x, x_ticks = scale(ratios, LEFT + 12, WIDTH - RIGHT - 12)
    to_y, y_ticks = scale([value["ownError"] for value in values], HEIGHT - BOTTOM - 10, TOP + 10, HEIGHT - BOTTOM - 10)
    parts = [f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escaped(effect["title"])}: error over time">']
    for tick in y_ticks:
        y = to_y(tick)
        parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#e4e4e4"/><text x="{LEFT - 5}" y="{y + 4:.1f}" '
                     f'text-anchor="end">{percent(tick)}</text>')
    for tick in x_ticks:
        x = to_x(tick)
        parts.append(f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#e4e4e4"/><text x="{x:.1f}" y="{HEIGHT - BOTTOM + 14}" '
                     f'text-anchor="middle">{tick:.3g}</text>')
    parts.append(f'<text x="{LEFT}" y="{HEIGHT - 6}">error over time, × {escaped(effect["standard"])}: round '
                 f'{TITLES["vulkan"]}, square {TITLES["gles"]}</text>')
    for row, value in reversed(list(enumerate(values, 1))):
        for backend in backends:
            title = (f'{value["value"]}: {percent(value["ownError"])}, × {value["ratio"][backend]:.3g} '
                     f'({value["milliseconds"][backend]:.4g} ms), {TITLES.get(backend, backend)}')
            parts.append(mark(to_x(value["ratio"][backend]), to_y(value["ownError"]), row, backend, title))
    return "".join(parts) + "</svg>"


WIDE, HIGH = 1000, 420
FARTHEST = 2.2  # times the default: what takes longer lies at the edge


def dot(x, y, backend, is_whole, name, title):
    """Of all effects, so without a number; it leads to its effect."""
    size = 7 if is_whole else 4
    corner = size if backend == "vulkan" else 1
    return (f'<a href="#{escaped(name)}"><rect x="{x - size:.1f}" y="{y - size:.1f}" width="{2 * size}" height="{2 * size}" rx="{corner}" '
            f'fill="{COLORS[backend]}" fill-opacity="{1 if is_whole else 0.6}" stroke="{"#222" if is_whole else "#fff"}">'
            f'<title>{escaped(title)}</title></rect></a>')


def whole_frames(data):
    """Every value of every effect that the scene of whole frames shows: what it changes of the image, and of its time."""
    points = [(effect, value, backend) for effect in data["effects"] for value in effect["values"] for backend in COLORS
              if effect["cost"] == "frame" and effect.get("linear") and effect["frame"] == data["frame"]
              and backend in value.get("ratio", {}) and finite(value, "totalError", effect["name"]) > 0]
    if not points:
        return ""
    times = [min(value["ratio"][backend], FARTHEST) for _, value, backend in points]
    to_x = lambda time: LEFT + 12 + (time - min(times)) / max(max(times) - min(times), 1e-9) * (WIDE - LEFT - RIGHT - 24)
    most = 1.05 * max(value["totalError"] for _, value, _ in points)
    to_y = lambda error: HIGH - BOTTOM - error / most * (HIGH - BOTTOM - TOP)
    parts = [f'<svg viewBox="0 0 {WIDE} {HIGH}" role="img" aria-label="error of the whole frame over its time, all values">']
    for i in range(5):
        y = to_y(most * i / 4)
        parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDE - RIGHT}" stroke="#e4e4e4"/><text x="{LEFT - 5}" y="{y + 4:.1f}" '
                     f'text-anchor="end">{percent(most * i / 4)}</text>')
    for i in range(6):
        time = min(times) + (max(times) - min(times)) * i / 5
        x = to_x(time)
        parts.append(f'<path d="M{x:.1f} {TOP}V{HIGH - BOTTOM}" stroke="#e4e4e4"/><text x="{x:.1f}" y="{HIGH - BOTTOM + 14}" '
                     f'text-anchor="middle">{time:.2f}</text>')
    for (effect, value, backend), time in sorted(zip(points, times), key=lambda one: one[0][0]["name"] in WHOLE):
        title = (f'{effect["title"]}: {value["value"]}, {percent(value["totalError"])}, × {value["ratio"][backend]:.3g}, {TITLES[backend]}')
        parts.append(dot(to_x(time), to_y(value["totalError"]), backend, effect["name"] in WHOLE, effect["name"], title))
    return ('<section id="whole-frames"><h2>Whole frames</h2><p>The error of the whole frame against the best value of every effect, over '
            'its time in that of the default: each value of each effect alone. Large markers are presets and budgets. Point at a marker for '
            f'its name; a click leads to it. What takes more than {FARTHEST} times as long lies at the right edge.</p>' + "".join(parts)
            + f'<text x="{LEFT}" y="{HIGH - 6}">error over time, × the default: round {TITLES["vulkan"]}, square {TITLES["gles"]}'
            + "</text></svg></section>")


# -------------------------------------------------------------------------------------------------------- tables

def table(effect, values, backends):
    has_flip = any("ownFlip" in value for value in values)
    heads = ["", "value", "error, RMS", "largest"] + (["FLIP"] if has_flip else []) + ["whole frame"]
    for backend in backends:
        heads += [TITLES.get(backend, backend), "×"]
    lines = ["<table><tr>" + "".join(f'<th{" class=name" if head == "value" else ""}>{escaped(head)}</th>' for head in heads) + "</tr>"]
    for row, value in enumerate(values, 1):
        kind = ' class="standard"' if value["value"] == effect["standard"] else ""
        cells = [f"<td>{row}</td>", f'<td class="name" title="{escaped(" ".join(value["set"]))}">{escaped(value["value"])}</td>',
                 f"<td>{percent(value['ownError'])}</td>", f"<td>{percent(value['ownMax'])}</td>"]
        if has_flip:
            cells.append(f"<td>{value.get('ownFlip', 0):.4f}</td>")
        cells.append(f"<td>{percent(value['error'])}</td>")
        for backend in backends:
            low, high = value["millisecondsInterval"][backend]
            cells.append(f'<td title="95 % interval {low:.4g} to {high:.4g} ms">{value["milliseconds"][backend]:.4g} ms</td>')
            low, high = value["interval"][backend]
            cells.append(f'<td title="95 % interval {low:.3f} to {high:.3f}">{value["ratio"][backend]:.3f}</td>')
        lines.append(f'<tr{kind} data-row="{row}">' + "".join(cells) + "</tr>")
    return '<div class="wide">' + "".join(lines) + "</table></div>"


def section(effect):
    values = effect["values"]
    backends = [backend for backend in COLORS if values and backend in values[0].get("ratio", {})]
    reference = effect["reference"]
    if effect["referenceError"] > 0:
        reference += f" (standard error {percent(effect['referenceError'])})"
    time = ("the device's, for a whole frame of" if effect["cost"] == "frame" else f"to load the {effect['cost']} from its file, of")
    scene = f"Scene: <code>{escaped(effect['scene'])}</code>. " if effect["scene"] else ""
    return (f'<section id="{escaped(effect["name"])}"><h2>{escaped(effect["title"])}</h2><p>{escaped(effect["question"])}</p>'
            f'<div class="pair">{figure(effect, values, backends)}{table(effect, values, backends)}</div>'
            f'<p class="small">Reference: {escaped(reference)}. {scene}Time: {time} <code>{escaped(effect["frame"])}</code>. '
            f'Whole frame: <code>{escaped(effect["frame"])}</code> against {escaped(effect["best"])}.<br>'
            f'<code>{escaped(effect["command"])}</code></p></section>')


def ratios(value):
    """Those whose interval does not include 1."""
    sure = [f"× {value['ratio'][backend]:.2f} {TITLES[backend]}" for backend in COLORS if backend in value.get("ratio", {})
            and not value["interval"][backend][0] <= 1 <= value["interval"][backend][1]]
    return ", ".join(sure) or "no measurable difference"


def glance(effects):
    lines = ["<section><h2>At a glance</h2><div class=wide><table><tr><th>effect</th><th class=name>standard</th><th>error</th>"
             "<th class=name>most exact</th><th>error</th><th class=name>time of the most exact</th></tr>"]
    for effect in effects:
        standard = next(value for value in effect["values"] if value["value"] == effect["standard"])
        best = min(effect["values"], key=lambda value: value["ownError"])
        row = (f'<td><a href="#{escaped(effect["name"])}">{escaped(effect["title"])}</a></td><td class=name>'
               f'{escaped(standard["value"])}</td><td>{percent(standard["ownError"])}</td>')
        row += ("<td class=name colspan=3>no value is more exact</td>" if best is standard else
                f'<td class=name>{escaped(best["value"])}</td><td>{percent(best["ownError"])}</td><td class=name>{ratios(best)}</td>')
        lines.append(f"<tr>{row}</tr>")
    return "".join(lines) + "</table></div></section>"


def introduction(data, sections):
    drivers = "".join(f"<li>{escaped(TITLES.get(backend, backend))}: {escaped(driver)}</li>"
                      for backend, driver in data["driver"].items())
    notes = "".join(f" {escaped(note)}" for note in data.get("notes", []))
    links = "".join(f'<div><a href="#{name}">{title}</a></div>' for name, title in sections)
    return f"""<h1>What accuracy costs</h1><p>Measures every approximation of the engine that has an alternative: the error of each
value against its effect's reference, and its cost. {len(data["effects"])} effects. Commit {escaped(data["commit"])}, {escaped(data["date"])},
on {escaped(data["machine"])}.{notes}</p><ul>{drivers}</ul><p>To measure everything anew:</p><pre>{COMMAND} --compare --out out/accuracy &amp;&amp;
{COMMAND} --out out/accuracy --page docs/accuracy.html</pre><p>Every section names the command that measures it alone.</p>
<p><b>Error</b> of a pixel: the difference to the reference over the brighter of both plus 1 % of the reference's mean; RMS and largest
over all pixels that show something. FLIP (Andersson et al. 2020) is what a viewer sees when flipping between the pictures: 0 nothing, 1
everything. <b>Whole frame</b>: RMS of the scene <code>{escaped(data["frame"])}</code> against the best value of the effect. <b>Time</b>:
medians of {data["rounds"]} turns at {data["size"][0]} x {data["size"][1]}, all values of an effect in turns; the ratio to the standard value
(bold) is taken turn by turn, its 95 % interval by bootstrap (point at a number to see it). Errors are those of the first backend; if the
second one does not draw the same bits, <a href="quality.md">quality.md</a> says so.</p><p>In the figures, a marker has the number of its row:
lower is more exact, farther left is faster.</p><nav>{links}</nav>
"""


HOW_TO_ADD = f"""<section><h2>Adding an effect</h2><p>An object in <code>tools/accuracy/effects.json</code>:</p><pre>{{
  "name": "specularVisibility", "title": "Masking of microfacets", "choice": "specularVisibility",
  "question": "What do square roots in the visibility term buy?",
  "scene": "sun-chart",
  "reference": {{ "kind": "traced", "set": ["specularVisibility=correlated"] }}
}}</pre><p><code>values</code> chooses among the values of the choice, or lists several settings each
(<code>"diffuseIrradiance=sphericalHarmonics shBands=2"</code>); <code>standard</code> and <code>best</code> name values (the first one
unless told otherwise); <code>base</code> are settings of all values, in the scene and in the timed frame; <code>frame</code> names the frame, in which the
values must differ (the showcase unless told otherwise); <code>cost</code> is <code>frame</code>, <code>environment</code> or <code>model</code>. References: <code>setting</code> (the engine with <code>set</code>), <code>scene</code>, <code>supersampled</code>
(<code>factor</code>), <code>traced</code> (<code>samples</code>), <code>otherBackend</code>, <code>furnace</code>, <code>integral</code>. Scenes
are files as in <a href="conformance.md">conformance.md</a>.</p></section>"""


def fragment(text, folder):
    """A finished section: its images beside their table, what is wide in a box that scrolls."""
    text = re.sub(r'src="(?![a-z]+:)', f'src="{folder}/', text)
    text = re.sub(r' style="[^"]*"', "", text)
    text = re.sub(r"((?:<figure.*?</figure>)+)(<table.*?</table>)",
                  r'<div class="pair"><div class="pictures">\1</div><div class="wide">\2</div></div>', text, flags=re.DOTALL)
    return re.sub(r'(?<!<div class="wide">)(<table.*?</table>)', r'<div class="wide">\1</div>', text, flags=re.DOTALL)


def check(data, path):
    """Refuses what the page would show wrongly."""
    if not isinstance(data, dict) or data.get("program") != "filament-accuracy" or data.get("version") != 1:
        raise BadInput(f"{path}: not version 1 of what filament-accuracy writes")
    for effect in field(data, "effects", list, str(path)):
        where = f"{path}, effect '{field(effect, 'name', str, str(path))}'"
        values = field(effect, "values", list, where)
        for value in values:
            for key in ("ownError", "ownMax", "error"):
                finite(value, key, where)
        if field(effect, "standard", str, where) not in [field(value, "value", str, where) for value in values]:
            raise BadInput(f"{where}: the standard value '{effect['standard']}' is not among its values")


def page(folder):
    """The text of the page that lies beside the folder."""
    path = folder / "results.json"
    data = load_json(path)
    check(data, path)
    fragments = [fragment(file.read_text(encoding="utf-8").strip(), folder.name) for file in sorted(folder.glob("*.fragment.html"))]
    links = [(escaped(effect["name"]), escaped(effect["title"])) for effect in data["effects"]]
    for text in fragments:
        if found := re.search(r'<section id="([^"]+)"><h2>(.*?)</h2>', text):
            links.append((found[1], found[2]))
    skipped = "".join(f"<li>{escaped(one['name'])}: needs {escaped(one['reason'])}</li>" for one in data.get("skipped", []))
    return ('<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, '
            f'initial-scale=1"><title>What accuracy costs</title><style>{STYLE}</style></head><body>\n'
            + introduction(data, links) + glance(data["effects"]) + whole_frames(data) + "\n".join(section(effect) for effect in data["effects"])
            + "\n".join(fragments) + (f"<section><h2>Not measured</h2><ul>{skipped}</ul></section>" if skipped else "")
            + HOW_TO_ADD + f"<script>{SCRIPT}</script></body></html>\n")
