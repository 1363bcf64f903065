"""What a Gaussian PSF brings from something that outshines the scene, beyond the image and across the borders of tiles, where it falls to
1e-7 of a pixel's energy: against the square's closed form, and kelvins by whole pixels where it was left out."""

import array
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SIDE, SIGMA, WIDE = 16, 0.456, 0.675


def radiance(kelvins, from_um=3.5, to_um=4.1, steps=600):
    """Simpson's rule over Planck's law."""
    step = (to_um - from_um) / steps
    values = [1.191042972e8 / um**5 / (math.exp(14387.76877 / (um * kelvins)) - 1.0) for um in (from_um + k * step for k in range(steps + 1))]
    return (values[0] + values[-1] + 4.0 * sum(values[1::2]) + 2.0 * sum(values[2:-1:2])) / (3.0 * steps)


def share(low, high, pixel):
    """Of the response of the pixel [pixel, pixel + 1] blurred by the Gaussian, along one axis."""
    def integral(x):
        z = x / SIGMA
        return 0.5 * x * (1.0 + math.erf(z / math.sqrt(2.0))) + SIGMA * math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)
    return sum(sign * (integral(at - pixel) - integral(at - pixel - 1.0)) for sign, at in ((1, high), (-1, low)))


class GaussianTails(unittest.TestCase):
    def render(self, column, row, kelvins, error, tile):
        """A hot square whose upper left corner lies there, in pixels: radiance and half-width."""
        x, y = column - SIDE / 2, SIDE / 2 - row
        corners = [[f"{x + i * WIDE} m", f"{y - j * WIDE} m", "1 mm"] for i, j in ((0, 1), (1, 1), (1, 0), (0, 0))]
        document = {"ifov": 1, "scene": {"materials": {"ground": {"emissivity": 1.0, "temperature": "280 K"},
                                                       "hot": {"emissivity": 1.0, "temperature": f"{kelvins} K"}},
                                         "objects": [{"plane": {}, "material": "ground"}, {"polygon": {"vertices": corners}, "material": "hot"}]},
                    "light": {"sky": {"temperature": "200 K"}},
                    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [SIDE, SIDE], "center": ["0 m", "0 m"]}},
                               "channels": [{"name": "mir", "top_hat": {"from": "3.5 um", "to": "4.1 um"}}], "psf": {"gaussian": {"sigma": f"{SIGMA} px"}}},
                    "sampling": {"accuracy": {"error": error}, "tile": tile}, "output": {"formats": ["envi"]}}
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "scene.json").write_text(json.dumps(document))
            done = subprocess.run([PROGRAM, "render", "scene.json", "-o", "out", "-q"], cwd=folder, capture_output=True, text=True, check=False)
            self.assertIn(done.returncode, (0, 5, 6), done.stderr)
            read = []
            for name in ("radiance", "half_width"):
                values = array.array("f")
                values.frombytes((Path(folder) / "out" / f"image_{name}.img").read_bytes())
                read.append(values)
        return read

    def judge(self, column, row, kelvins, error, tile):
        """Values, those outside their interval, the farthest in half-widths, and what the square brings at most to a pixel that it does not touch."""
        ground, hot = radiance(280.0), radiance(kelvins)
        found, widths = self.render(column, row, kelvins, error, tile)
        outside, farthest, most = 0, 0.0, 0.0
        for k, (value, width) in enumerate(zip(found, widths)):
            x, y = k % SIDE, k // SIDE
            of_square = share(column, column + WIDE, x) * share(row, row + WIDE, y)
            if of_square < 1e-4:
                most = max(most, of_square * (hot / ground - 1.0))
            truth = ground + (hot - ground) * of_square
            off = max(0.0, abs(value - truth) - 2e-5 * truth)  # nodes
            outside += off > width
            farthest = max(farthest, off / (width + 1e-9 * truth))
        return len(found), outside, farthest, most

    def test_beyond_the_image(self):
        brought = 0.0
        for column, error in ((-1.5, "2 %"), (-2.3, "2 %"), (-2.3, "0.2 %"), (-3.0, "0.2 %"), (-3.6, "0.2 %")):
            count, outside, farthest, most = self.judge(column, 8.3, 931.0, error, 64)
            self.assertLessEqual(outside, 0.05 * count, (column, error))
            self.assertLess(farthest, 2.0, (column, error))
            brought = max(brought, most)
        self.assertGreater(brought, 0.05)

    def test_across_borders_of_tiles(self):
        for column, row in ((9.3, 4.2), (10.1, 9.7)):
            count, outside, farthest, _ = self.judge(column, row, 931.0, "0.2 %", 8)
            self.assertLessEqual(outside, 0.05 * count, (column, row))
            self.assertLess(farthest, 2.0, (column, row))

    def test_a_square_that_hardly_shines(self):
        """Not worth a wider footprint: it stands in the interval."""
        count, outside, farthest, _ = self.judge(-2.3, 8.3, 330.0, "0.01 %", 64)
        self.assertLessEqual(outside, 0.05 * count)
        self.assertLess(farthest, 2.0)


if __name__ == "__main__":
    unittest.main()
