"""Progress on a terminal, and stopping: a pseudo-terminal takes the user's place."""

import os
import pty
import re
import select
import signal
import subprocess
import time
import unittest

from program import DOME, LONG, PROGRAM, Folder, run, slowdown

# What is said by a run that stops by itself, and on a line of its own where it is ended because it took too long to.
STOPPED = "ifov: stopped on request; unfinished products carry the ending .part, and --resume goes on with what is finished"
GRACE_S = 0.4


class Terminal:
    """The program with its messages on a pseudo-terminal."""

    def __init__(self, folder, *arguments):
        try:
            self._screen, writer = pty.openpty()
        except OSError as error:
            raise unittest.SkipTest(f"this system gives no pseudo-terminal: {error}") from error
        self.process = subprocess.Popen(
            [PROGRAM, *arguments], cwd=folder, stdin=writer, stderr=writer, stdout=subprocess.PIPE
        )
        os.close(writer)
        self.text = ""

    def read(self, seconds, until=None):
        end = time.monotonic() + seconds
        while time.monotonic() < end and (until is None or until not in self.text):
            if not select.select([self._screen], [], [], 0.05)[0]:
                continue
            try:
                self.text += os.read(self._screen, 65536).decode()
            except OSError:  # the other end was closed
                break

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        os.close(self._screen)


def single_rays_in(channels):
    """The dome by one ray a pixel, in a series of Gaussian channels."""
    text = DOME.replace('"monochromatic": {"at": "8.5 um"}', f'"series": {{"gaussian": {channels}}}')
    return text.replace('"accuracy": {"error": "0.1 K", "channel": "B"}', '"single": {}')


class Interrupt(unittest.TestCase):
    def test_the_bar_tells_rate_and_time_left(self):
        with Folder(long=LONG) as folder:
            terminal = Terminal(folder, "render", "long.json")
            try:
                terminal.read(30, until="rays/s")
                self.assertRegex(terminal.text, r"\[[#-]{24}\] +\d+\.\d %  [\d:]+ left  [\d.]+ ?[kMG]? rays/s")
            finally:
                terminal.close()

    def test_the_bar_tells_how_far_the_accuracy_is(self):
        accuracy = '"sampling": {"accuracy": {"error": "0.01 K", "channel": "B"}}'
        text = re.sub(r'"sampling": \{.*\}', accuracy, LONG).replace('"1 mm"', '"0.2 mm"')  # the dome fills it
        with Folder(long=text) as folder:
            terminal = Terminal(folder, "render", "long.json")
            try:
                terminal.read(30, until="x limit")
                terminal.read(0.3)
                lines = terminal.text.split("\r\x1b[K")
                self.assertLess(max(map(len, lines)), 80)
                self.assertRegex(terminal.text, r"\[[#-]+\] +\d+\.\d %  [\d:]+ left  [\d.]+ ?[kMG]? rays/s  \d+\.\d % converged  worst \d+\.\d\d x limit")
            finally:
                terminal.close()

    def test_quiet_draws_no_bar(self):
        with Folder(long=LONG) as folder:
            terminal = Terminal(folder, "render", "long.json", "--quiet")
            try:
                terminal.read(2)
                self.assertEqual(terminal.text, "")
                self.assertIsNone(terminal.process.poll())
            finally:
                terminal.close()

    def test_without_a_terminal_there_is_no_bar(self):
        with Folder(long=LONG) as folder:
            process = subprocess.Popen(
                [PROGRAM, "render", "long.json"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            )
            time.sleep(2)
            begin = time.monotonic()
            process.send_signal(signal.SIGTERM)
            output, errors = process.communicate(timeout=20)
            was_ended = time.monotonic() - begin > GRACE_S
            self.assertEqual(process.returncode, 130)
            self.assertEqual(output, "")
            self.assertIn(errors, (f"{STOPPED}\n", f"\n{STOPPED}\n") if was_ended else (f"{STOPPED}\n",))

    def test_ctrl_c_stops_within_a_second_and_leaves_nothing_that_looks_complete(self):
        with Folder(long=LONG) as folder:
            terminal = Terminal(folder, "render", "long.json", "--log", "run.log")
            try:
                terminal.read(30, until="rays/s")
                slow = slowdown()
                begin = time.monotonic()
                terminal.process.send_signal(signal.SIGINT)
                self.assertEqual(terminal.process.wait(timeout=20), 130)
                elapsed = time.monotonic() - begin
                self.assertLess(elapsed, max(slow, slowdown()))
                terminal.read(1, until="finished\r\n")
                by_itself = terminal.text.endswith(f"\r\x1b[K{STOPPED}\r\n")
                self.assertTrue(by_itself or (elapsed > GRACE_S and terminal.text.endswith(f"\r\n{STOPPED}\r\n")),
                                terminal.text[-200:])
                left = os.listdir(folder / "long.out")
                self.assertEqual([name for name in left if not name.endswith(".part")], [])
                if by_itself:
                    self.assertIn("ended: stopped on request", (folder / "run.log").read_text())
            finally:
                terminal.close()

    def test_a_time_limit_ends_loading_as_well(self):
        air = single_rays_in('{"from": "0.4 um", "to": "2.5 um", "count": 400, "fwhm": "10 nm"}')
        air = air.replace('"sensor":', '"light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "120 deg"}}},\n'
                                       '"atmosphere": {"profile": "tropical"}, "sensor":')
        with Folder(air=air) as folder:
            slow = slowdown()
            begin = time.monotonic()
            done = run("render", "air.json", "--no-cache", "--time-limit", "0.4s", cwd=folder)
            elapsed = time.monotonic() - begin
            self.assertLess(elapsed, 0.4 + max(slow, slowdown()))
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("\nifov: the time limit came before the scene was loaded; nothing is rendered\n", done.stderr)
            self.assertEqual(os.listdir(folder), ["air.json"])

    def test_a_time_limit_ends_writing_as_well(self):
        large = single_rays_in('{"from": "8 um", "to": "12 um", "count": 60, "fwhm": "0.1 um"}')
        large = large.replace('[3, 3]', '[2048, 2048]').replace('["envi", "png"]', '["envi", "geotiff", "netcdf"]')
        with Folder(large=large) as folder:
            for limit in (2, 4, 8, 16):
                slow = slowdown()
                begin = time.monotonic()
                done = run("render", "large.json", "--no-cache", "--time-limit", f"{limit}s", cwd=folder)
                elapsed = time.monotonic() - begin
                if "before the scene was loaded" not in done.stderr:  # which a busy machine takes long for
                    break
            self.assertLess(elapsed, limit + max(slow, slowdown()))
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("\nifov: the time limit came before the products were whole; unfinished ones carry the ending .part, and "
                          "--resume goes on with what is finished\n", done.stderr)
            self.assertEqual([name for name in os.listdir(folder / "large.out") if ".part" not in name], [])

    def test_a_second_ctrl_c_ends_at_once(self):
        with Folder(long=LONG) as folder:
            terminal = Terminal(folder, "render", "long.json")
            try:
                terminal.read(30, until="rays/s")
                terminal.process.send_signal(signal.SIGINT)
                time.sleep(0.001)
                terminal.process.send_signal(signal.SIGINT)
                # Stopped by the first where that was quick enough, else killed by the second.
                self.assertIn(terminal.process.wait(timeout=20), (130, -signal.SIGINT))
            finally:
                terminal.close()


if __name__ == "__main__":
    unittest.main()
