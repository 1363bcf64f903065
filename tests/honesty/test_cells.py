"""Half-widths over maps of cells half a pixel wide: each pixel holds corners, in step with the lattice, and what they err adds up."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

PROGRAM = os.environ["IFOV_PROGRAM"]
PIXELS, GSD, CELLS = 16, 0.25, 8
WARM, COLD = 12.5, 7.6
MAP = """11111111
10010111
11111111
10011001
01111100
00011110
00010101
01011111"""
COLUMN, ROW = 4.5698, 3.43  # where the map lies under the image's upper left corner, in cells


def overlaps(first):
    """Of each pixel of a row with each cell of the map, which repeats."""
    shares = np.zeros((PIXELS, CELLS))
    for pixel in range(PIXELS):
        low, high = first + 2.0 * pixel, first + 2.0 * (pixel + 1)
        for cell in range(int(low), int(high) + 1):
            shares[pixel, cell % CELLS] += 0.5 * max(0.0, min(high, cell + 1) - max(low, cell))
    return shares


class Cells(unittest.TestCase):
    def test_half_widths_hold_over_corners_in_step_with_pixels(self):
        cells = np.array([[int(c) for c in line] for line in MAP.split()])
        cell_m, half_m = 0.5 * GSD, 0.5 * PIXELS * GSD
        exact = WARM + (COLD - WARM) * (overlaps(ROW) @ cells @ overlaps(COLUMN).T)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            cells.astype(np.uint8).tofile(folder / "map.img")
            (folder / "map.img.hdr").write_text("ENVI\nsamples = 8\nlines = 8\nbands = 1\ndata type = 1\ninterleave = bsq\nbyte order = 0\n")
            low_left = [f"{-half_m - COLUMN * cell_m} m", f"{half_m + (ROW - CELLS) * cell_m} m"]
            document = {
                "ifov": 1,
                "scene": {
                    "materials": {"warm": {"emissivity": 1.0, "temperature": "319.59 K"}, "cold": {"emissivity": 1.0, "temperature": "285.63 K"}},
                    "objects": [{"plane": {}, "material": {"map": {
                        "file": "map.img", "low_left": low_left, "size": [f"{CELLS * cell_m} m"] * 2, "tiling": "repeat",
                        "classes": {"0": "warm", "1": "cold"}}}}],
                },
                "light": {"sky": {"temperature": "215.3 K"}},
                "sensor": {"camera": {"orthographic": {"gsd": f"{GSD} m", "pixels": [PIXELS, PIXELS]}},
                           "channels": [{"name": "11 um", "top_hat": {"from": "10.5 um", "to": "11.5 um"}}]},
                "output": {"formats": ["envi"]},
            }
            held, farthest = [], 0.0
            for seed in (1, 2, 3, 4):
                document["seed"], document["sampling"] = seed, {"accuracy": {"error": "1 %"}}
                (folder / "cells.json").write_text(json.dumps(document))
                done = subprocess.run([PROGRAM, "render", "cells.json", "-o", f"out{seed}", "--no-cache", "--quiet"], cwd=folder,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                of = lambda what: np.fromfile(folder / f"out{seed}/image_{what}.img", np.float32).reshape(PIXELS, PIXELS)  # noqa: E731
                if not held:
                    # The two radiances, of pixels of one material: by the channel's response, not by what is tested here.
                    document["sampling"] = {"grid": {"elements": [1, 1]}}
                    (folder / "one.json").write_text(json.dumps(document))
                    subprocess.run([PROGRAM, "render", "one.json", "-o", "one", "--no-cache", "--quiet"], cwd=folder, check=True,
                                   capture_output=True)
                    seen = np.fromfile(folder / "one/image_radiance.img", np.float32)
                    self.assertEqual(len(np.unique(seen)), 2)
                    exact = seen.max() + (exact - WARM) / (COLD - WARM) * (seen.min() - seen.max())
                z = (of("radiance") - exact) / of("half_width")
                held.append(np.abs(z) <= 1.0)
                farthest = max(farthest, np.abs(z).max())
            held = np.array(held)
            self.assertGreater(held.mean(), 0.94)
            # The map is as wide as four pixels: of each of 16 kinds there are 64.
            kinds = [held[:, row::4, column::4].mean() for row in range(4) for column in range(4)]
            self.assertGreater(min(kinds), 0.7)
            self.assertLess(farthest, 2.5)


if __name__ == "__main__":
    unittest.main()
