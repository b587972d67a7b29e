# SPDX-License-Identifier: Apache-2.0
"""tools/plot draws its input, or refuses it with one line that says why."""
import contextlib
import io
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "tools" / "plot"
sys.path.insert(0, str(FOLDER))
sys.dont_write_bytecode = True

import accuracy_page  # noqa: E402
import jobs_plot  # noqa: E402
import plot  # noqa: E402


def contender(name, median, rounds=(1.0, 2.0, 3.0), **more):
    return {"name": name, "median": median, "q1": median * 0.9, "q3": median * 1.2, "p99": median * 2,
            "rounds": list(rounds), **more}


def workload(name, kind, contenders, x=0, targets=(), unit="ns/job"):
    return {"name": name, "title": f"the {name}, titled", "unit": unit, "kind": kind, "x": x, "contenders": contenders,
            "ratios": {"tbb": {"median": 0.5, "q1": 0.4, "q3": 0.6}}, "targets": list(targets)}


def bench():
    """A report with one workload of every kind."""
    everybody = [contender("ours", 20), contender("tbb", 40), contender("asio", 900),
                 contender("async", 2e4, note="64 of 1024 jobs, scaled"),
                 contender("serial", 1)]
    limit = {"text": "ours <= 25 ns/fork", "value": 20, "limit": 25, "met": True}
    frames = [contender("cpu 0w", 1), contender("cpu 1w", 1.1), contender("wall 0w", 1)]
    return {"program": "threading_bench", "version": 1, "threads": 2, "rounds": 3,
            "machine": {"cpu": "a core of wood", "kernel": "Linux", "load": "0.1", "commit": "abc1234"},
            "workloads": [
                workload("tree_64k", "jobs", everybody, targets=[limit]),
                workload("power_law", "uneven", everybody + [contender("ideal", 10)]),
                workload("wake_3ms", "wakeup", [contender("ours", 9, samples=[8, 9, 10]), contender("tbb", 12)], unit="us"),
                *[workload(f"scaling_loop_{w}w", "scaling", everybody, x=w) for w in range(3)],
                *[workload(f"scaling_tree_{w}w", "scaling", everybody, x=w) for w in range(3)],
                workload("frame_1k", "frames", frames, x=1000, unit="ms"),
                workload("frame_10k", "frames", frames, x=10000, unit="ms"),
                workload("record_draw", "commands", [contender("ours", 3), contender("copy", 2)]),
            ]}


def complete(tid, name, begin_us, duration_us, **args):
    return {"ph": "X", "pid": 1, "tid": tid, "cat": "job", "name": name, "ts": begin_us, "dur": duration_us, "args": args}


def trace():
    """Two frames on the app thread, jobs on a worker, the driver one frame behind."""
    names = {1: "app", 2: "worker 0", 3: "driver"}
    events = [{"ph": "M", "pid": 1, "tid": tid, "name": "thread_name", "args": {"name": name}}
              for tid, name in names.items()]
    for frame in range(2):
        at = 2000 * frame
        events += [complete(1, "prepare", at, 1500, frame=frame), complete(1, "cull", at + 100, 300, stolen=False),
                   complete(2, "cull", at + 120, 280, stolen=True), complete(3, "replay", at + 1600, 1800, frame=frame)]
    return {"traceEvents": events + [complete(2, "sort", 3000, 100, stolen=False)]}


def measured_value(name, error, milliseconds, ratio):
    both = lambda value: {"vulkan": value, "gles": value}  # noqa: E731
    return {"value": name, "ownError": error, "totalError": error / 2, "milliseconds": both(milliseconds),
            "millisecondsInterval": both([milliseconds * 0.9, milliseconds * 1.1]), "ratio": both(ratio),
            "interval": both([ratio * 0.97, ratio * 1.02])}


def accuracy():
    """An effect with an exact value, one of a load, one in which nothing differs, and presets."""
    effect = {"title": "an effect, titled", "cost": "frame", "frame": "frame", "linear": True, "standard": "table"}
    values = [measured_value("table", 0, 10, 1), measured_value("fit", 0.02, 9, 0.9), measured_value("none", 0.4, 8, 0.8)]
    same = [measured_value("table", 0, 10, 1), measured_value("fit", 0, 10, 1)]
    return {"program": "filament-accuracy", "version": 1, "frame": "frame",
            "effects": [{**effect, "name": "splitSum", "values": values},
                        {**effect, "name": "load", "cost": "environment", "values": values},
                        {**effect, "name": "same", "values": same},
                        {**effect, "name": "preset", "values": values}]}


class Plot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_plot(self, command, content, *more, output="out.png"):
        """Exit status and output. `content` is written as it is if it is bytes, else as JSON; None: no file."""
        source = self.folder / "input.json"
        if content is not None:
            source.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        with contextlib.redirect_stderr(io.StringIO()) as said:
            try:
                status = plot.main([command, str(source), "-o", str(self.folder / output), *more])
            except SystemExit as end:  # argparse
                status = end.code
        return status, said.getvalue()

    def drawn(self, command, content, *more, output="out.png"):
        self.assertEqual(self.run_plot(command, content, *more, output=output), (0, ""))
        return (self.folder / output).read_bytes()

    def texts(self, command, content, *more):
        """All text of the image."""
        root = xml.etree.ElementTree.fromstring(self.drawn(command, content, *more, output="out.svg"))
        return " ".join("".join(node.itertext()) for node in root.iter("{http://www.w3.org/2000/svg}text"))

    def assert_refused(self, command, content, words, *more):
        status, said = self.run_plot(command, content, *more)
        self.assertEqual(status, 2, said)
        self.assertTrue(said.splitlines()[-1].startswith("plot.py"), said)
        self.assertIn(words, said)
        self.assertFalse((self.folder / "out.png").exists())


class Pictures(Plot):
    def assert_png(self, data, least_width, least_height):
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", data[16:24])
        self.assertTrue(least_width <= width <= 4000 and least_height <= height <= 6000, (width, height))
        self.assertGreater(len(data), 10_000, "too small to hold more than an empty page")

    def test_bench_draws_every_kind_of_workload(self):
        self.assert_png(self.drawn("bench", bench()), 1000, 1000)
        texts = self.texts("bench", bench())
        for words in ("ours", "oneTBB", "Boost.Asio", "std::async", "serial loop", "Fork-join tree", "Frames on the null backend",
                      "Commands", "Uneven work", "0.50 × oneTBB", "a core of wood", "abc1234", "power_law"):
            self.assertIn(words, texts)

    def test_bench_draws_a_report_of_one_workload(self):
        for item in bench()["workloads"]:
            with self.subTest(item["name"]):
                self.assert_png(self.drawn("bench", {**bench(), "workloads": [item]}), 1000, 300)

    def test_scaling_draws_only_what_grows(self):
        self.assert_png(self.drawn("scaling", bench()), 1000, 300)
        texts = self.texts("scaling", bench())
        self.assertIn("threads, with the caller", texts)
        self.assertIn("visible renderables", texts)
        self.assertNotIn("Uneven work", texts)

    def test_jobs_names_threads_jobs_and_frames(self):
        self.assert_png(self.drawn("jobs", trace()), 1000, 200)
        texts = self.texts("jobs", trace(), "--title", "Two frames")
        for words in ("app", "worker 0", "driver", "prepare", "cull", "replay", "frame 0", "frame 1", "stolen", "Two frames"):
            self.assertIn(words, texts)

    def test_jobs_shows_only_the_time_asked_for(self):
        texts = self.texts("jobs", trace(), "--from", "0", "--to", "1")
        self.assertIn("frame 0", texts)
        for absent in ("frame 1", "sort", "replay"):
            self.assertNotIn(absent, texts)

    def test_jobs_reads_a_bare_list_of_events(self):
        self.assert_png(self.drawn("jobs", trace()["traceEvents"]), 1000, 200)

    def test_jobs_draws_many_jobs_of_many_names(self):
        events = [complete(i % 7, f"job {i % 40}", 3 * i, 2) for i in range(8000)]
        self.assert_png(self.drawn("jobs", {"traceEvents": events}), 1000, 200)
        self.assertIn("25 others", self.texts("jobs", {"traceEvents": events}))


def materials():
    both = {"ms": 9, "ratio": 1.5, "low": 1.4, "high": 1.6}
    return {"kind": "materials", "rows": [{"name": "clear coat", "reference": "2 to 3", "vulkan": both, "gles": both}]}


class MaterialPictures(Plot):
    def test_terms_backends_ratios_and_the_reference_are_named(self):
        texts = self.texts("materials", materials())
        for words in ("clear coat", "Vulkan", "OpenGL ES", "1.50", "reference text"):
            self.assertIn(words, texts)

    def test_what_cannot_be_drawn_is_refused(self):
        self.assert_refused("materials", bench(), "is not a file of material_bench")
        self.assert_refused("materials", {**materials(), "rows": []}, "has no rows")
        broken = materials()
        del broken["rows"][0]["gles"]
        self.assert_refused("materials", broken, "row 0: 'gles'")


def scale():
    points = [{"count": count, "minimumMs": count * 1e-5, "medianMs": count * 2e-5, "sceneBytes": 200 * count, "frameBytes": 9}
              for count in (1000, 10000)]
    return {"kind": "scale", "series": [{"name": name, "counted": counted, "points": points}
                                        for name, counted in (("static", "renderables"), ("lamps", "lights"))]}


class ScalePictures(Plot):
    def test_series_and_what_they_count_are_named(self):
        texts = self.texts("scale", scale())
        for words in ("static", "renderables", "lamps", "lights", "linear", "megabytes"):
            self.assertIn(words, texts)

    def test_what_cannot_be_drawn_is_refused(self):
        self.assert_refused("scale", bench(), "is not a file of scale_bench")
        self.assert_refused("scale", {**scale(), "series": []}, "has no series")
        broken = scale()
        broken["series"][0]["points"][1]["minimumMs"] = 0
        self.assert_refused("scale", broken, "static: point 1: counts, times and bytes are above 0")
        broken["series"][0]["points"] = []
        self.assert_refused("scale", broken, "static: has no points")


class AccuracyPictures(Plot):
    def test_every_effect_and_the_whole_frames_are_drawn(self):
        self.assertEqual(self.run_plot("accuracy", accuracy(), output="plots"), (0, ""))
        names = {path.name for path in (self.folder / "plots").iterdir()}
        self.assertEqual(names, {"splitSum.svg", "load.svg", "same.svg", "preset.svg", "frames.svg"})

    def test_a_picture_names_values_backends_and_units(self):
        self.run_plot("accuracy", accuracy(), output="plots")
        def texts(name):
            root = xml.etree.ElementTree.parse(self.folder / "plots" / name)
            return " ".join("".join(node.itertext()) for node in root.iter("{http://www.w3.org/2000/svg}text"))
        for words in ("table", "fit", "none", "Vulkan", "OpenGL ES", "milliseconds, a frame", "error, RMS", "no error"):
            self.assertIn(words, texts("splitSum.svg"))
        self.assertIn("loading the environment", texts("load.svg"))
        self.assertIn("splitSum: none", texts("frames.svg"))

    def test_the_same_figures_give_the_same_bytes(self):
        for folder in ("a", "b"):
            self.run_plot("accuracy", accuracy(), output=folder)
        self.assertEqual((self.folder / "a" / "frames.svg").read_bytes(), (self.folder / "b" / "frames.svg").read_bytes())

    def test_what_cannot_be_drawn_is_refused(self):
        self.assert_refused("accuracy", bench(), "not written by filament-accuracy")
        self.assert_refused("accuracy", {**accuracy(), "effects": []}, "no effects")
        self.assert_refused("accuracy", {**accuracy(), "version": 2}, "version 2")
        broken = accuracy()
        broken["effects"][0]["values"][1]["ownError"] = None
        self.assert_refused("accuracy", broken, "value 'fit': 'ownError'")


class Refusals(Plot):
    def test_a_file_that_is_not_there(self):
        for command in ("bench", "scaling", "jobs"):
            self.assert_refused(command, None, "No such file")

    def test_a_file_that_ends_too_soon(self):
        whole = json.dumps(trace()).encode()
        self.assert_refused("jobs", whole[:len(whole) // 2], "no valid JSON (line 1")
        self.assert_refused("bench", b"", "no valid JSON")

    def test_a_file_that_is_no_text(self):
        self.assert_refused("jobs", b"\x89PNG\xff\xfe", "not UTF-8")

    def test_the_json_of_another_program(self):
        self.assert_refused("bench", trace(), "not written by threading_bench")
        self.assert_refused("jobs", bench(), "no Chrome trace")
        self.assert_refused("bench", {**bench(), "version": 2}, "version 2")

    def test_a_report_without_workloads(self):
        self.assert_refused("bench", {**bench(), "workloads": []}, "no workloads")
        self.assert_refused("scaling", {**bench(), "workloads": bench()["workloads"][:2]}, "nothing that this plot shows")

    def test_a_figure_that_is_missing_or_no_number(self):
        for value in (None, "fast", float("nan"), True):
            report = bench()
            report["workloads"][0]["contenders"][1]["median"] = value
            with self.subTest(value=value):
                self.assert_refused("bench", report, "contender 'tbb': 'median'")

    def test_a_trace_without_events(self):
        self.assert_refused("jobs", {"traceEvents": []}, "no complete events")

    def test_an_event_that_is_broken(self):
        for event, words in ((7, "event 0 is no object"), (complete(1, "cull", 0, -5), "'dur' is negative"),
                             (complete(1, "cull", "now", 5), "'ts' is missing"), (complete(1, None, 0, 5), "'name' is missing")):
            with self.subTest(words):
                self.assert_refused("jobs", {"traceEvents": [event]}, words)

    def test_a_window_in_which_nothing_happens(self):
        self.assert_refused("jobs", trace(), "the trace ends at 5.4 ms", "--from", "9")
        self.assert_refused("jobs", trace(), "is not before", "--from", "2", "--to", "1")
        self.assert_refused("jobs", trace(), "no number of milliseconds", "--from", "soon")

    def test_an_output_of_an_unknown_kind(self):
        status, said = self.run_plot("jobs", trace(), output="out.bmp")
        self.assertEqual(status, 2)
        self.assertIn("must end in one of .png", said)

    def test_an_output_that_cannot_be_written(self):
        status, said = self.run_plot("jobs", trace(), output="missing/out.png")
        self.assertEqual(status, 2)
        self.assertIn("cannot be written", said)


class Program(Plot):
    def test_the_program_draws_and_refuses_by_its_exit_status(self):
        (self.folder / "trace.json").write_text(json.dumps(trace()), encoding="utf-8")
        for source, status, output in (("trace.json", 0, "a.png"), ("absent.json", 2, "b.png")):
            done = subprocess.run([sys.executable, "-B", FOLDER / "plot.py", "jobs", source, "-o", output],
                                  cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertEqual((self.folder / output).exists(), status == 0)
            self.assertNotIn("Traceback", done.stderr)


class Nesting(unittest.TestCase):
    def test_an_event_is_as_deep_as_the_number_of_events_around_it(self):
        events = [jobs_plot.Event("inner", 2, 3), jobs_plot.Event("outer", 0, 10), jobs_plot.Event("middle", 1, 5),
                  jobs_plot.Event("after", 5, 6), jobs_plot.Event("next", 10, 11)]
        jobs_plot.assign_depths(events)
        self.assertEqual({e.name: e.depth for e in events}, {"outer": 0, "middle": 1, "inner": 2, "after": 1, "next": 0})
        self.assertEqual({e.name for e in events if e.holds}, {"outer", "middle"})

    def test_a_frame_begins_with_its_first_event_on_any_thread(self):
        driver = jobs_plot.Track("driver", 0, [jobs_plot.Event("replay", 4, 5, frame=1)])
        app = jobs_plot.Track("app", 1, [jobs_plot.Event("prepare", 3, 4, frame=2), jobs_plot.Event("prepare", 1, 2, frame=1),
                                         jobs_plot.Event("job", 0, 1)])
        self.assertEqual(jobs_plot.frame_starts([driver, app]), [(1, 1), (3, 2)])


class AccuracyPage(unittest.TestCase):
    """The page of the accuracy data."""

    def folder(self, data, **fragments):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "page"
        folder.mkdir()
        (folder / "results.json").write_text(json.dumps(data), encoding="utf-8")
        for name, text in fragments.items():
            (folder / f"{name}.fragment.html").write_text(text, encoding="utf-8")
        return folder

    @staticmethod
    def data():
        value = {"set": ["a=1"], "ownMax": 0.5, "ownFlip": 0.1, "error": 0.2, "milliseconds": {"vulkan": 10, "gles": 12},
                 "millisecondsInterval": {"vulkan": [9, 11], "gles": [11, 13]},
                 "ratio": {"vulkan": 1, "gles": 1}, "interval": {"vulkan": [1, 1], "gles": [1, 1]}}
        slow = {**value, "ratio": {"vulkan": 5, "gles": 2}, "interval": {"vulkan": [4, 6], "gles": [0.5, 3]}}
        return {"program": "filament-accuracy", "version": 1, "machine": "m", "driver": {"vulkan": "d"}, "commit": "c",
                "date": "2026-01-01", "frame": "frame", "size": [4, 3], "rounds": 2, "skipped": [], "effects": [
                    {"name": "e", "title": "An <effect>", "question": "?", "reference": "r", "referenceError": 0, "scene": "s",
                     "command": "run", "cost": "frame", "frame": "frame", "standard": "plain", "best": "fine",
                     "values": [{**value, "value": "plain", "ownError": 0.25}, {**slow, "value": "fine", "ownError": 0}]}]}

    def test_every_value_is_a_row_and_a_marker_of_each_api(self):
        html = accuracy_page.page(self.folder(self.data()))
        self.assertEqual(html.count('<tr class="standard" data-row="1"'), 1)
        for row in ("1", "2"):
            self.assertEqual(html.count(f'<g class="mark" data-row="{row}"'), 2)
        self.assertIn("An &lt;effect&gt;", html)
        self.assertIn("fine: 0, × 5 (10 ms), Vulkan", html)
        self.assertIn("× 5.00 Vulkan</td>", html)  # whose interval does not include 1, unlike the other's

    def test_markers_stay_in_the_figure(self):
        html = accuracy_page.page(self.folder(self.data()))
        for x, y in re.findall(r'<rect x="([^"]+)" y="([^"]+)"', html):
            self.assertTrue(accuracy_page.LEFT <= float(x) <= accuracy_page.WIDTH - 16, x)
            self.assertTrue(0 <= float(y) <= accuracy_page.HEIGHT - accuracy_page.BOTTOM, y)

    def test_whole_frames_show_every_value_of_the_scene(self):
        data = self.data()
        self.assertNotIn("Whole frames", accuracy_page.page(self.folder(data)), "no effect is linear")
        effect = data["effects"][0]
        effect["linear"] = True
        for value, error in zip(effect["values"], (0.25, 0.1)):
            value["totalError"] = error
        data["effects"].append({**effect, "name": "preset", "title": "Presets"})
        data["effects"].append({**effect, "name": "other", "title": "Elsewhere", "frame": "another"})
        html = accuracy_page.page(self.folder(data))
        figure = html[html.index('id="whole-frames"'):html.index("</svg>", html.index('id="whole-frames"'))]
        self.assertEqual(figure.count('<a href="#e">'), 4)
        self.assertEqual(figure.count('<a href="#preset">'), 4)
        self.assertNotIn("Elsewhere", figure)
        self.assertIn("<title>An &lt;effect&gt;: fine, 10 %, × 5, Vulkan</title>", figure)
        places = [(float(x), float(y)) for x, y in re.findall(r'<rect x="([^"]+)" y="([^"]+)"', figure)]
        self.assertEqual(len(places), 8)
        for x, y in places:
            self.assertTrue(accuracy_page.LEFT <= x <= accuracy_page.WIDE - accuracy_page.RIGHT, x)
            self.assertTrue(0 <= y <= accuracy_page.HIGH - accuracy_page.BOTTOM, y)
        self.assertEqual(len({x for x, _ in places}), 6, "1, 2 and 5 times the default, in two sizes of markers")
        effect["values"][0]["totalError"] = float("nan")
        with self.assertRaisesRegex(accuracy_page.BadInput, "'totalError' is not a finite number"):
            accuracy_page.page(self.folder(data))

    def test_fragments_have_their_pictures_beside_their_tables(self):
        text = '<section id="f"><h2>F</h2><figure><img src="a.png"></figure><table><tr></tr></table></section>'
        html = accuracy_page.page(self.folder(self.data(), one=text))
        self.assertIn('<div class="pictures"><figure><img src="page/a.png"></figure></div><div class="wide"><table>', html)
        self.assertIn('<a href="#f">F</a>', html)

    def test_other_data_are_refused(self):
        for wrong in ({}, {**self.data(), "version": 2}):
            with self.assertRaisesRegex(accuracy_page.BadInput, "not version 1"):
                accuracy_page.page(self.folder(wrong))
        wrong = self.data()
        wrong["effects"][0]["standard"] = "none"
        with self.assertRaisesRegex(accuracy_page.BadInput, "'none' is not among its values"):
            accuracy_page.page(self.folder(wrong))

    def test_the_committed_data_make_a_page_with_all_its_pictures(self):
        docs = FOLDER.parents[1] / "docs"
        text = accuracy_page.page(docs / "accuracy")
        shown = set(re.findall(r'src="([^"]+)"', text))
        self.assertEqual(shown, {f"accuracy/{path.name}" for path in (docs / "accuracy").glob("*.png")})
        names = [effect["name"] for effect in json.loads((docs / "accuracy/results.json").read_text(encoding="utf-8"))["effects"]]
        self.assertEqual(re.findall(r'<section id="(\w+)"', text), names)
        for link in re.findall(r'href="([^"#]+)', text):
            self.assertTrue((docs / link).exists(), link)


if __name__ == "__main__":
    unittest.main()
