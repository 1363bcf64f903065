"""A preview: a picture in seconds, with what is said of the scene."""

import os
import pty
import re
import struct
import subprocess
import unittest

from program import DOME, PROGRAM, Folder, run


def size_of(png):
    return struct.unpack(">II", png.read_bytes()[16:24])


class Preview(unittest.TestCase):
    def test_a_picture_stands_beside_the_document(self):
        with Folder(dome=DOME) as folder:
            done = run("preview", "dome.json", "--seconds", "0.2", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("in view:", done.stdout)
            self.assertRegex(done.stdout, r"A preview: [\d to]+ paths? at each pixel\. It promises no accuracy\.")
            self.assertGreater(size_of(folder / "dome.preview.png")[0], 100)
            self.assertFalse((folder / "dome.out").exists())
            self.assertNotIn("\x1b", done.stdout)

    def test_what_it_leaves_out_is_said(self):
        with Folder(dome=DOME) as folder:
            for more, words in (([], ""), (['sensor.keystone={"polynomial": {"shift": ["0.1 px"]}}'], " The sensor's keystone is left out."),
                                (['sensor.keystone={"polynomial": {"shift": ["0.1 px"]}}', 'sensor.smile={"polynomial": {"center": ["1 nm"], "fwhm": ["0 nm"]}}'],
                                 " The sensor's smile and keystone are left out.")):
                done = run("preview", "dome.json", "--seconds", "0.1", *(part for one in more for part in ("--set", one)), cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"It promises no accuracy.{words}\n", done.stdout)

    def test_an_image_of_any_size_is_small(self):
        huge = DOME.replace('"pixels": [3, 3]', '"pixels": [40000, 20000]').replace('"gsd": "1 m"', '"gsd": "0.1 mm"')
        with Folder(huge=huge) as folder:
            done = run("render", "huge.json", "--quick", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("256 x 128 pixels", done.stdout)

    def test_it_warns_as_check_does(self):
        with Folder(dome=DOME.replace('"20 degC"', '"20 K"')) as folder:
            checked, shown = run("check", "dome.json", cwd=folder), run("preview", "dome.json", "--seconds", 0.2, cwd=folder)
            self.assertEqual((shown.returncode, shown.stderr), (6, checked.stderr))
            self.assertIn("degC", shown.stderr)
            strict = run("preview", "dome.json", "--strict", "-o", "strict.png", cwd=folder)
            self.assertEqual(strict.returncode, 1)
            self.assertFalse((folder / "strict.png").exists())

    def test_a_terminal_of_colours_shows_it(self):
        for depth, pattern in (("truecolor", r"\x1b\[38;2;\d+;\d+;\d+m"), ("", r"\x1b\[38;5;\d+m")):
            with self.subTest(depth), Folder(dome=DOME) as folder:
                try:
                    screen, writer = pty.openpty()
                except OSError as error:
                    self.skipTest(f"this system gives no pseudo-terminal: {error}")
                with open(screen, "rb", buffering=0) as reading:
                    process = subprocess.Popen(
                        [PROGRAM, "preview", "dome.json", "--seconds", "0.2"], cwd=folder, stdout=writer,
                        env={**os.environ, "TERM": "xterm-256color", "COLORTERM": depth, "NO_COLOR": ""})
                    os.close(writer)
                    text = b""
                    try:
                        while chunk := reading.read(65536):
                            text += chunk
                    except OSError:  # the other end was closed
                        pass
                    self.assertEqual(process.wait(30), 0)
                rows = [line for line in text.decode().splitlines() if "\u2580" in line]
                self.assertEqual(len(rows), 2)  # three rows of pixels, two to a line
                self.assertEqual(len(re.findall(pattern, rows[0])), 3)


if __name__ == "__main__":
    unittest.main()
