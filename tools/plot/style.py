# SPDX-License-Identifier: Apache-2.0
"""What the plots share: reading JSON with errors worth reading, colours, fonts."""
import json

# Colours that colour-blind readers can distinguish: Okabe and Ito 2008, "Color universal design".
BLUE, ORANGE, GREEN, PINK, GREY, SKY, RED, YELLOW = (
    "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#8c8c8c", "#56b4e9", "#d55e00", "#d9c82b")
CONTENDER_COLORS = {"ours": BLUE, "tbb": ORANGE, "openmp": GREEN, "eigen": SKY, "asio": YELLOW, "async": PINK, "serial": GREY,
                    "copy": GREY, "futex": GREY,
                    "ideal": "#222222", "fair": "#222222"}
CONTENDER_LABELS = {"ours": "ours", "tbb": "oneTBB", "openmp": "OpenMP", "eigen": "Eigen", "asio": "Boost.Asio",
                    "async": "std::async", "serial": "serial loop", "futex": "bare futex",
                    "ideal": "ideal", "fair": "fair share", "copy": "memcpy"}


class BadInput(Exception):
    """A file that cannot be drawn: one line, what, where, how to cure it."""


def apply_style():
    import matplotlib.pyplot as plt  # not every page has plots
    plt.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 10, "axes.titleweight": "bold",
        "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "#666666",
        "axes.axisbelow": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.8, "legend.frameon": False,
        "legend.fontsize": 8.5, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "figure.dpi": 120, "savefig.dpi": 120,
        "figure.facecolor": "white", "svg.fonttype": "none", "svg.hashsalt": "filament_core",
    })


def load_json(path):
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise BadInput(f"{path}: not UTF-8 text at byte {error.start}: is it a JSON file?") from error
    try:
        return json.loads(text)
    except (json.JSONDecodeError, RecursionError) as error:
        where = f"line {error.lineno}, column {error.colno}" if isinstance(error, json.JSONDecodeError) else "too deep"
        raise BadInput(f"{path}: no valid JSON ({where}): was it written to the end?") from error


def load_report(path, program, written_by):
    """The object that `program` wrote, in version 1 of its format. `written_by`: the command, for people."""
    data = load_json(path)
    if not isinstance(data, dict) or data.get("program") != program:
        raise BadInput(f"{path}: not written by {written_by}")
    if data.get("version") != 1:
        raise BadInput(f"{path}: version {data.get('version')} of the format; this program reads version 1")
    return data


def field(container, name, kinds, where):
    """container[name], which must be one of `kinds`."""
    value = container.get(name) if isinstance(container, dict) else None
    if not isinstance(value, kinds) or isinstance(value, bool):
        raise BadInput(f"{where}: '{name}' is missing or of the wrong type")
    return value


def finite(container, name, where):
    value = field(container, name, (int, float), where)
    if not -1e300 < value < 1e300:  # also false for NaN
        raise BadInput(f"{where}: '{name}' is not a finite number")
    return float(value)
