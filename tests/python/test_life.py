# SPDX-License-Identifier: Apache-2.0
"""Engines, threads, references and the end of the interpreter: exceptions, never a crash."""
import gc
import os
import signal
import sys
import threading
import time
import weakref

from support import BACKENDS, WINDMILL, fc, flat_view, np, quad, run_script, unittest, unlit

SCENE = """
def scene_of(engine):
    scene = fc.Scene(engine)
    material = engine.built_in_material("unlit").instance()
    material.set("baseColor", (1, 1, 1))
    scene.add_mesh(engine.sphere(), material)
    return scene
def view():
    view = fc.View((32, 32))
    view.look_at((0, 0, 2), (0, 0, 0))
    return view
"""


def threads():
    return len(os.listdir("/proc/self/task"))


def on_thread(work):
    """The exception of `work` on another thread, or its value."""
    found = []

    def run():
        try:
            found.append(work())
        except BaseException as error:  # whatever it is, the test looks at it
            found.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return found[0]


class Lives(unittest.TestCase):
    def test_hundreds_of_engines_leave_nothing(self):
        before = threads()
        for i in range(200):
            engine = fc.Engine("null", workers=i % 3)
            scene = fc.Scene(engine)
            scene.add_mesh(quad(engine), unlit(engine, (1, 1, 1)))
            fc.Renderer(engine)
            if i % 2:
                engine.close()
        del engine, scene
        gc.collect()
        self.assertEqual(threads(), before)

    def test_engines_of_both_apis_come_and_go(self):
        before = threads()
        for backend in BACKENDS * 3:
            engine = fc.Engine(backend)
            scene = fc.Scene(engine)
            scene.add_mesh(quad(engine), unlit(engine, (1, 1, 1)))
            picture = fc.Renderer(engine).render(scene, flat_view(8, 8), output="light")
            self.assertEqual(picture[..., 0].min(), 1)
        del engine, scene
        gc.collect()
        # drivers may keep threads of their own: a constant number, whatever the number of engines
        self.assertLess(threads() - before, 2 * len(os.sched_getaffinity(0)) + 8)

    def test_objects_keep_their_engine(self):
        def parts():
            engine = fc.Engine("gles")
            scene = fc.Scene(engine)
            scene.add_mesh(quad(engine), unlit(engine, (0.5, 0.5, 0.5)))
            return scene, fc.Renderer(engine)

        scene, renderer = parts()
        gc.collect()
        self.assertEqual(renderer.render(scene, flat_view(8, 8), output="light")[0, 0, 0], 0.5)

    def test_an_engine_ends_with_its_last_object(self):
        before = threads()
        engine = fc.Engine("null", workers=2)
        scene = fc.Scene(engine)
        copy = scene.add(engine.load_model(WINDMILL))
        del engine, scene
        self.assertGreater(threads(), before)
        self.assertTrue(copy.materials)
        del copy
        self.assertEqual(threads(), before)

    def test_cycles_are_collected(self):
        class Holder:
            pass

        holder = Holder()
        holder.engine, holder.self = fc.Engine("null", workers=1), holder
        ended = weakref.ref(holder)
        before = threads()
        del holder
        gc.collect()
        self.assertIsNone(ended())
        self.assertLess(threads(), before)

    def test_what_is_used_after_close_raises(self):
        engine = fc.Engine("null")
        scene, renderer, mesh = fc.Scene(engine), fc.Renderer(engine), quad(engine)
        instance = unlit(engine, (1, 1, 1))
        shape = scene.add_mesh(mesh, instance)
        sun = scene.add_sun((0, -1, 0))
        model = engine.load_model(WINDMILL)
        copy = scene.add(model)
        engine.close()
        engine.close()
        self.assertTrue(engine.closed)
        for use in (lambda: fc.Scene(engine), lambda: scene.bounds, lambda: renderer.render(scene, flat_view()),
                    lambda: instance.set("baseColor", (1, 1, 1)), shape.remove, sun.remove, lambda: model.name,
                    lambda: copy.materials, lambda: engine.sphere(), lambda: mesh.vertex_count, renderer.explain,
                    engine.take_errors, engine.use_on_this_thread, lambda: instance.parameters):
            self.assertRaises(fc.ClosedError, use)
        self.assertEqual(engine.device["backend"], "null")

    def test_a_with_block_closes_the_engine(self):
        with self.assertRaises(KeyError), fc.Engine("null") as engine:
            raise KeyError
        self.assertTrue(engine.closed)


class Threads(unittest.TestCase):
    def test_another_thread_gets_an_exception(self):
        with fc.Engine("null") as engine:
            scene, renderer = fc.Scene(engine), fc.Renderer(engine)
            for use in (lambda: fc.Scene(engine), lambda: scene.bounds, lambda: renderer.render(scene, flat_view()),
                        engine.close, engine.take_errors, lambda: engine.load_model(WINDMILL)):
                self.assertIsInstance(on_thread(use), fc.ThreadError)
            self.assertIsNone(scene.bounds)

    def test_an_engine_moves_to_another_thread(self):
        engine = fc.Engine("gles")
        scene, renderer = fc.Scene(engine), fc.Renderer(engine)
        scene.add_mesh(quad(engine), unlit(engine, (1, 1, 1)))

        def draw():
            engine.use_on_this_thread()
            return renderer.render(scene, flat_view(8, 8), output="light")

        self.assertEqual(on_thread(draw)[0, 0, 0], 1)
        self.assertRaises(fc.ThreadError, lambda: scene.bounds)
        engine.use_on_this_thread()
        self.assertIsNotNone(scene.bounds)
        engine.close()

    def test_what_is_dropped_elsewhere_is_destroyed_at_home(self):
        engine = fc.Engine("gles")
        scene, renderer = fc.Scene(engine), fc.Renderer(engine)
        dropped = [quad(engine), unlit(engine, (1, 1, 1)), engine.texture(np.zeros((4, 4, 4), np.uint8)),
                   fc.Scene(engine), fc.Renderer(engine), engine.load_model(WINDMILL)]
        on_thread(dropped.clear)
        renderer.render(scene, flat_view(8, 8))
        on_thread(lambda: globals().update(last=fc.Engine("null")))
        del globals()["last"]  # an engine that ends on another thread than its own
        engine.close()

    def test_other_threads_run_while_the_engine_draws(self):
        engine = fc.Engine("gles")
        scene, renderer = fc.Scene(engine), fc.Renderer(engine)
        ends, count = threading.Event(), [0]

        def work():
            while not ends.is_set():
                count[0] += 1
                time.sleep(0)

        other = threading.Thread(target=work)
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # threads change only where one gives the lock away
        try:
            other.start()
            for _ in range(1000):
                before = count[0]
                renderer.render(scene, flat_view(256, 256), frames=20)
                if count[0] > before:
                    break
            self.assertGreater(count[0], before)
        finally:
            sys.setswitchinterval(interval)
            ends.set()
            other.join()
            engine.close()

    def test_a_handler_of_a_signal_cannot_end_what_is_drawn(self):
        refused = []

        def ring(*_):
            for act in (engine.close, lambda: renderer.render(scene, flat_view(16, 8))):
                try:
                    act()
                except fc.ThreadError as error:
                    refused.append(str(error))
            raise KeyboardInterrupt

        engine = fc.Engine("null")
        self.addCleanup(engine.close)
        scene, renderer = fc.Scene(engine), fc.Renderer(engine)
        kept = signal.signal(signal.SIGALRM, ring)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.2)
            self.assertRaises(KeyboardInterrupt, renderer.render, scene, flat_view(8, 8), frames=1_000_000)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, kept)
        self.assertEqual(len(refused), 2, refused)
        self.assertIn("close it once", refused[0])
        self.assertIn("the renderer is at work", refused[1])
        self.assertFalse(engine.closed)

    def test_what_is_read_of_a_sequence_cannot_end_the_engine(self):
        class Ends:
            def __len__(self):
                return 3

            def __getitem__(self, index):
                engine.close()

        engine = fc.Engine("null")
        self.addCleanup(engine.close)
        instance = engine.built_in_material("lit").instance()
        self.assertRaises(fc.ThreadError, instance.set, "baseColor", Ends())
        self.assertFalse(engine.closed)

    def test_a_signal_ends_long_work(self):
        class Alarm(Exception):
            pass

        def ring(*_):
            raise Alarm

        engine = fc.Engine("null")
        scene, renderer = fc.Scene(engine), fc.Renderer(engine)
        kept = signal.signal(signal.SIGALRM, ring)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.2)
            self.assertRaises(Alarm, renderer.render, scene, flat_view(8, 8), frames=1_000_000)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, kept)
        self.assertIsNone(scene.bounds)


class Exits(unittest.TestCase):
    """The interpreter ends with status 0 and without a word."""

    def ends_well(self, script):
        status, output = run_script(SCENE + script)
        self.assertEqual((status, output), (0, ""))

    def test_with_engines_in_globals(self):
        for backend in BACKENDS:
            self.ends_well(f"engine = fc.Engine({backend!r}); scene = scene_of(engine); renderer = fc.Renderer(engine)\n"
                           "renderer.render(scene, view())\n")

    def test_with_objects_that_nobody_frees(self):
        self.ends_well("gc.disable()\nclass Cycle: pass\ncycle = Cycle(); cycle.self = cycle\n"
                       "cycle.engine = fc.Engine('gles'); cycle.scene = scene_of(cycle.engine)\ndel cycle\n"
                       "import builtins; builtins.kept = fc.Scene(fc.Engine('null'))\n")

    def test_while_a_daemon_thread_draws(self):
        self.ends_well("drawn = threading.Event()\ndef work():\n"
                       "    engine = fc.Engine('gles'); scene = scene_of(engine); renderer = fc.Renderer(engine)\n"
                       "    while True:\n"
                       "        try: renderer.render(scene, view())\n"
                       "        except fc.ClosedError: return\n"
                       "        drawn.set()\n"
                       "threading.Thread(target=work, daemon=True).start()\ndrawn.wait()\n")

    def test_while_a_daemon_thread_draws_without_end(self):
        self.ends_well("begins = threading.Event()\ndef work():\n"
                       "    engine = fc.Engine('gles'); scene = scene_of(engine); renderer = fc.Renderer(engine)\n"
                       "    renderer.render(scene, view()); begins.set()\n"
                       "    try: renderer.render(scene, view(), frames=1_000_000)\n    except fc.ClosedError: pass\n"
                       "threading.Thread(target=work, daemon=True).start()\nbegins.wait(); time.sleep(0.01)\n")

    def test_with_engines_of_several_threads(self):
        self.ends_well("kept = []\ndef work(): kept.append(fc.Engine('gles')); kept.append(scene_of(kept[-1]))\n"
                       "thread = threading.Thread(target=work); thread.start(); thread.join()\n")

    def test_with_an_engine_made_too_late(self):
        self.ends_well("import atexit\ndef late():\n"
                       "    try: fc.Engine('null')\n    except fc.ClosedError: pass\n    else: print('made')\n"
                       "atexit.register(late)\nfc.Engine('null').close()\n")

    def test_after_fork(self):
        self.ends_well("engine = fc.Engine('gles'); scene = scene_of(engine); renderer = fc.Renderer(engine)\n"
                       "renderer.render(scene, view())\nchild = os.fork()\n"
                       "if child == 0:\n"
                       "    try: renderer.render(scene, view()); os._exit(1)\n"
                       "    except fc.InvalidArgumentError as error: assert 'fork' in str(error)\n"
                       "    del renderer, scene, engine\n    gc.collect()\n    sys.exit(0)\n"
                       "assert os.waitpid(child, 0)[1] == 0\nrenderer.render(scene, view())\n")


if __name__ == "__main__":
    unittest.main()
