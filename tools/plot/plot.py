#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the results of the benchmarks and the tracers.

  plot.py bench   FILE.json  -o OUT   all figures of threading_bench --json: costs, wake-ups, scaling, frames
  plot.py scaling FILE.json  -o OUT   only their growth with workers and renderables
  plot.py contention FILE.json -o OUT  counts by job over workers: threading_bench --contention --json
  plot.py jobs    TRACE.json -o OUT   timeline of the threads: a Chrome trace-event file from --trace-jobs
  plot.py materials FILE.json -o OUT  cost of the terms of a material: material_bench --json
  plot.py scale FILE.json -o OUT      time and memory over counts: scale_bench --json
  plot.py accuracy FILE.json -o DIR   results.json of filament-accuracy: one image per effect, and frames; --format
  plot.py accuracy-page DIR -o OUT.html   the page of such results: DIR has results.json and *.fragment.html, and lies beside OUT

OUT ends in .png, .svg or .pdf. A file that cannot be drawn is refused with one line on standard error and exit status 2.
Needs matplotlib (Debian: python3-matplotlib, which belongs to /usr/bin/python3).
"""
import argparse
import pathlib
import sys

try:
    import matplotlib
except ImportError:
    sys.exit("plot.py: error: this Python has no matplotlib: install python3-matplotlib and use /usr/bin/python3")
matplotlib.use("Agg")  # no display
import matplotlib.pyplot as plt

import accuracy_page
import accuracy_plot
import bench_plot
import contention_plot
import jobs_plot
import materials_plot
import scale_plot
from style import BadInput, apply_style

FORMATS = (".png", ".svg", ".pdf")


def output_path(text):
    path = pathlib.Path(text)
    if path.suffix.lower() not in FORMATS:
        raise argparse.ArgumentTypeError(f"'{text}' must end in one of {', '.join(FORMATS)}")
    return path


def milliseconds(text):
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no number of milliseconds") from None
    if not 0 <= value < 1e9:
        raise argparse.ArgumentTypeError(f"'{text}' is not between 0 and 1e9 milliseconds")
    return value


def parse_arguments(words):
    parser = argparse.ArgumentParser(prog="plot.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, help_text in (("bench", "all figures of threading_bench"), ("scaling", "scaling figures only"),
                            ("jobs", "a timeline of jobs"), ("materials", "what the terms of a material cost"),
                            ("scale", "time and memory over counts"),
                            ("contention", "counts by job over workers")):
        command = commands.add_parser(name, help=help_text)
        command.add_argument("input", type=pathlib.Path, metavar="FILE.json")
        command.add_argument("-o", "--output", type=output_path, required=True, metavar="OUT")
        command.add_argument("--title", default=None, help="over the picture")
        if name == "jobs":
            command.add_argument("--from", dest="begin", type=milliseconds, default=None, metavar="MS",
                                 help="first millisecond to show")
            command.add_argument("--to", dest="end", type=milliseconds, default=None, metavar="MS",
                                 help="last millisecond to show")
    accuracy = commands.add_parser("accuracy", help="error over time of every effect")
    accuracy.add_argument("input", type=pathlib.Path, metavar="FILE.json")
    accuracy.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="DIR")
    accuracy.add_argument("--format", choices=[suffix[1:] for suffix in FORMATS], default="svg")
    page = commands.add_parser("accuracy-page", help="error and time of every effect, as a page")
    page.add_argument("input", type=pathlib.Path, metavar="DIR")
    page.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="OUT.html")
    return parser.parse_args(words)


def save(figure, path):
    # no date, so that the same figures give the same bytes
    figure.savefig(path, metadata={"Date": None} if path.suffix.lower() == ".svg" else None)
    plt.close(figure)


def draw_folder(arguments):
    for name, figure in accuracy_plot.draw_all(arguments.input):
        arguments.output.mkdir(parents=True, exist_ok=True)
        save(figure, arguments.output / f"{name}.{arguments.format}")


def draw(arguments):
    if arguments.command == "jobs":
        return jobs_plot.draw(arguments.input, arguments.begin, arguments.end, arguments.title)
    if arguments.command == "materials":
        return materials_plot.draw(arguments.input, arguments.title)
    if arguments.command == "scale":
        return scale_plot.draw(arguments.input, arguments.title)
    if arguments.command == "contention":
        return contention_plot.draw(arguments.input, arguments.title)
    return bench_plot.draw(arguments.input, arguments.title, only_scaling=arguments.command == "scaling")


def main(words):
    arguments = parse_arguments(words)
    try:
        with matplotlib.rc_context():
            apply_style()
            if arguments.command == "accuracy":
                draw_folder(arguments)
            elif arguments.command == "accuracy-page":
                arguments.output.write_text(accuracy_page.page(arguments.input), encoding="utf-8")
            else:
                save(draw(arguments), arguments.output)
    except BadInput as error:
        print(f"plot.py: error: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"plot.py: error: {arguments.output} cannot be written: {error.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
