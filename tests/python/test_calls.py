"""Ctrl-C, callbacks, threads: what Python does while the library works."""

import gc
import os
import resource
import signal
import threading
import time
import unittest

import numpy as np
import scenes

import ifov


class Calls(unittest.TestCase):
    def test_ctrl_c(self):
        begun = threading.Event()
        sent = []

        def interrupt():
            begun.wait(60)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        scene = ifov.Scene(scenes.endless())
        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            scene.render(callback=lambda _: begun.set(), progress=False)
        waited = time.monotonic() - sent[0]
        thread.join()
        # Tenths of a second on an idle machine; here only that it does not wait for the image, which takes hours.
        self.assertLess(waited, 20)
        # What is loaded is as it was.
        self.assertEqual(scene.cast([0, 0, 1], [0, 0, -1])["hit"].values.tolist(), [True])

    def test_exceptions_of_callbacks_arrive_as_they_were(self):
        scene = ifov.Scene(scenes.endless())

        class Own(Exception):
            pass

        raised = Own("mine")

        def throw(_):
            raise raised

        for hook in ({"callback": throw}, {"on_tile": throw}):
            with self.assertRaises(Own) as caught:
                scene.render(progress=False, **hook)
            self.assertIs(caught.exception, raised)

    def test_progress(self):
        seen = []
        ifov.render(scenes.small(), callback=seen.append, progress=False)
        self.assertEqual(seen[-1].pixels_done, 20 * 14)
        self.assertEqual(seen[-1].pixels_total, 20 * 14)
        self.assertGreater(seen[-1].rays, 0)
        self.assertLessEqual(seen[-1].worst_error_ratio, 1.0)

    def test_tiles(self):
        covered = set()

        def note(tile):
            self.assertEqual(tile.radiance.shape, (2, tile.height, tile.width))
            self.assertEqual(tile.samples.shape, (tile.height, tile.width))
            self.assertTrue((tile.radiance > 0).any())
            covered.update((x, y) for x in range(tile.x, tile.x + tile.width) for y in range(tile.y, tile.y + tile.height))

        ifov.render(scenes.small(), on_tile=note, progress=False)
        self.assertEqual(len(covered), 20 * 14)

    def test_a_bar(self):
        try:
            import tqdm  # noqa: F401
        except ImportError:
            self.skipTest("tqdm is not installed")
        ifov.render(scenes.small(), progress=True)

    def test_other_threads_go_on(self):
        """The lock of the interpreter is free while the library works."""
        count = 0
        stop = threading.Event()

        def counting():
            nonlocal count
            while not stop.is_set():
                count += 1
                time.sleep(0.001)

        thread = threading.Thread(target=counting)
        thread.start()
        ifov.render(scenes.endless(), time_limit=0.4, progress=False)
        stop.set()
        thread.join()
        self.assertGreater(count, 10)

    def test_two_renders_at_once(self):
        alone = ifov.render(scenes.small(), progress=False)
        scene = ifov.Scene(scenes.small())
        found = []

        def work():
            found.append(scene.render(progress=False))

        threads = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 3)
        for one in found:
            self.assertEqual(one["radiance"].values.tobytes(), alone["radiance"].values.tobytes())

    def test_nothing_is_kept(self):
        """Of the arrays of 15 renders of 18 MB each, and of what callbacks held."""
        document = scenes.small(sampling={"single": {}})
        document["sensor"]["camera"]["orthographic"]["pixels"] = [640, 480]
        scene = ifov.Scene(document)

        class Held:
            alive = 0

            def __init__(self):
                Held.alive += 1

            def __del__(self):
                Held.alive -= 1

            def __call__(self, _):
                pass

        def render():
            scene.render(callback=Held(), on_tile=Held(), progress=False)

        for _ in range(3):
            render()
        gc.collect()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(15):
            render()
        gc.collect()
        self.assertEqual(Held.alive, 0)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 60_000)


class Arguments(unittest.TestCase):
    def test_texts(self):
        scene = ifov.Scene(scenes.small())
        for call, words in (
            (lambda: scene.render(time_limit=-1), "time_limit: found -1; expected seconds, 0 or more"),
            (lambda: ifov.run(scenes.small(), "nowhere", time_limit=float("nan")), "time_limit: found nan; expected seconds"),
            (lambda: scene.render(progress="maybe"), "progress: found 'maybe'; expected 'auto', True or False"),
            (lambda: scene.cast([0, 0], [0, 0, -1]), r"origins: found shape \(2,\); expected \(ray, 3\) or \(3,\)"),
            (lambda: scene.cast(np.zeros((2, 3)), np.ones((3, 3))), "found 2 origins and 3 directions; expected as many, or one of either"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                call()


class Processes(unittest.TestCase):
    def in_child(self, work):
        """What a forked process, which ends at once, answers with a number; None where it does not come to an end."""
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # what hangs is ended by it
            try:
                os._exit(work())
            except BaseException:
                import traceback

                traceback.print_exc()
            os._exit(99)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])

    def test_forked_processes_work(self):
        """With what was loaded before, and with what they load, on threads of their own; so does their parent afterwards."""
        scene = ifov.Scene(scenes.small())
        before = scene.render(progress=False)["radiance"].values.tobytes()

        def work():
            again = scene.render(progress=False, threads=2)["radiance"].values.tobytes() == before
            return 7 if again and render_small() == before else 8

        for _ in range(3):
            self.assertEqual(self.in_child(work), 7)
            self.assertEqual(scene.render(progress=False)["radiance"].values.tobytes(), before)

    def test_a_pool_of_forked_processes(self):
        import multiprocessing

        here = render_small()
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.starmap(render_small, [()] * 4), [here] * 4)

    def test_a_process_forked_from_work_says_that_it_cannot_go_on(self):
        """The threads that are at work stay behind in the parent, with all that they hold."""
        codes = []

        def look(_):
            if codes:
                return
            codes.append(None)

            def work():
                try:
                    ifov.Scene(scenes.small())
                except RuntimeError as error:
                    return 7 if "spawn" in str(error) else 8
                return 9

            codes[0] = self.in_child(work)

        ifov.render(scenes.small(), callback=look, progress=False)
        self.assertEqual(codes, [7])
        self.assertEqual(self.in_child(lambda: 7 if render_small() else 8), 7)

    def test_spawned_processes(self):
        import multiprocessing

        with multiprocessing.get_context("spawn").Pool(1) as pool:
            far = pool.apply(render_small)
        self.assertEqual(far, render_small())


def render_small():
    return ifov.render(scenes.small(), progress=False)["radiance"].values.tobytes()


if __name__ == "__main__":
    unittest.main()
