"""The image of a point is the kernel, the right way up, under every way of sampling."""

import array
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SIDE = 9
KERNEL = [[0, 0, 0], [0, 4, 3], [1, 0, 2]]
SAMPLERS = {"grid": {"grid": {"elements": [20, 20]}}, "pixel": {"accuracy": {"error": "2 %"}},
            "image": {"accuracy": {"error": "2 %", "of": "image"}}}


# Samples are as wide as a pixel: of a box of 0.6 pixels about its middle, a sample's light falls on its own pixel to so much along each axis.
STAYS = 1 - 0.6 / 4


def expected(row, column):
    """Share of a point's light."""
    def spread(k, of):
        return STAYS if k == of else (1 - STAYS) / 2 if abs(k - of) == 1 else 0.0
    return sum(KERNEL[j][i] / 10 * spread(row, j) * spread(column, i) for j in range(3) for i in range(3))


class KernelPsf(unittest.TestCase):
    def test_a_point_is_seen_as_the_kernel(self):
        for name, sampling in SAMPLERS.items():
            with self.subTest(sampler=name), tempfile.TemporaryDirectory() as folder:
                path = Path(folder)
                rows = "\n".join(" ".join(str(value) for value in row) for row in KERNEL)
                (path / "kernel.asc").write_text(f"ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n{rows}\n")
                point = {"box": {"low": ["-0.3 m", "-0.3 m", "0 m"], "high": ["0.3 m", "0.3 m", "1 cm"]}, "material": "hot"}
                document = {
                    "ifov": 1,
                    "scene": {"materials": {"ground": {"emissivity": 1, "temperature": "200 K"}, "hot": {"emissivity": 1, "temperature": "500 K"}},
                              "objects": [{"plane": {}, "material": "ground"}, point]},
                    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [SIDE, SIDE]}},
                               "channels": [{"name": "one", "top_hat": {"from": "9 um", "to": "10 um"}}],
                               "psf": {"kernel": {"file": "kernel.asc", "samples_per_pixel": 1}}},
                    "sampling": sampling, "output": {"formats": ["envi"]}}
                (path / "scene.json").write_text(json.dumps(document))
                done = subprocess.run([PROGRAM, "render", str(path / "scene.json"), "-o", str(path / "out"), "-q"],
                                      capture_output=True, text=True, check=False)
                self.assertIn(done.returncode, (0, 5, 6), done.stderr)
                values = array.array("f")
                values.frombytes((path / "out/image_radiance.img").read_bytes())
                darkest, middle = min(values), SIDE // 2
                light = [value - darkest for value in values]
                whole = sum(light)
                upside_down = 0.0
                for row in range(3):
                    for column in range(3):
                        seen = light[(middle + row - 1) * SIDE + middle + column - 1] / whole
                        self.assertAlmostEqual(seen, expected(row, column), delta=0.02, msg=f"{name}, row {row}, column {column}")
                        turned = expected(2 - row, 2 - column)
                        upside_down = max(upside_down, abs(seen - turned))
                self.assertGreater(upside_down, 0.1)


if __name__ == "__main__":
    unittest.main()
