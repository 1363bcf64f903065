"""The Sun's disc in the picture, itself and in flat mirrors, smaller than a pixel: against the area of a cone's image."""

import json
import math
import os
import random
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
HALF_ANGLE_DEG = 0.25
IRRADIANCE = 1000.0
RADIANCE = IRRADIANCE / (math.pi * math.sin(math.radians(HALF_ANGLE_DEG)) ** 2)
SKY = 20.0
FOCAL_MM = 50.0


def share_of_pixel(zenith_deg, pitch_mm):
    """Of the image of a cone of the Sun's half-angle, an ellipse, by the angle of its axis from the camera's."""
    a, t = math.radians(HALF_ANGLE_DEG), math.radians(zenith_deg)
    below = math.cos(t) ** 2 - math.sin(a) ** 2
    return math.pi * FOCAL_MM**2 * math.sin(a) ** 2 * math.cos(a) / below**1.5 / pitch_mm**2


class SunInView(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def pixel(self, objects, zenith_deg, azimuth_deg, look_at, pitch_mm, seed=1, psf=None):
        """Radiance, half-width and whether it is converged, of one pixel 10 m above the origin, at 1 %."""
        described = {
            "ifov": 1, "seed": seed,
            "scene": {"materials": {"ground": {"reflectance": 0.0}, "mirror": {"reflectance": 0.9, "scattering": "mirror"},
                                    "matt": {"reflectance": 0.1}, "water": {"scattering": {"smooth": {"n": 1.33, "k": 0}}}},
                      "objects": [{"plane": {}, "material": "ground"}, *objects]},
            "light": {"sun": {"disc": {"zenith": f"{zenith_deg} deg", "azimuth": f"{azimuth_deg} deg", "distance": "1 au",
                                       "diameter": f"{2.0 * HALF_ANGLE_DEG} deg", "spectrum": f"{IRRADIANCE} W m-2 um-1"}},
                      "sky": {"radiance": f"{SKY} W m-2 sr-1 um-1"}},
            "sensor": {"camera": {"frame": {"focal_length": f"{FOCAL_MM} mm", "pitch": f"{pitch_mm} mm", "pixels": [1, 1],
                                            "position": ["0 m", "0 m", "10 m"], "look_at": ["0 m", "0 m", look_at], "up": [0, 1, 0]}},
                       "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}], **({"psf": psf} if psf else {})},
            "sampling": {"accuracy": {"error": "1 %"}}, "output": {"formats": ["envi"]}}
        path = self.folder / "scene.json"
        path.write_text(json.dumps(described))
        run = subprocess.run([PROGRAM, "render", path, "--output", self.folder / "out", "--no-state"], check=False, capture_output=True,
                             text=True, timeout=100)
        self.assertIn(run.returncode, (0, 5, 6), run.stderr)

        def first(name):
            return struct.unpack("<f", (self.folder / "out" / f"image_{name}.img").read_bytes()[:4])[0]

        return first("radiance"), first("half_width"), first("quality") > 0.0

    def hold(self, objects, reflectance, look_at, most_deg, pitch_mm):
        chance = random.Random(5)
        held = 0
        for seed in range(8):
            zenith = most_deg * math.sqrt(chance.random())
            value, half, converged = self.pixel(objects, zenith, 360.0 * chance.random(), look_at, pitch_mm, seed)
            share = share_of_pixel(zenith, pitch_mm)
            truth = reflectance * (RADIANCE * share + SKY * (1.0 - share))
            self.assertTrue(converged)
            self.assertLess(abs(value - truth), 0.01 * truth)
            held += abs(value - truth) <= half
        self.assertGreaterEqual(held, 7)

    def test_the_sun_itself(self):
        self.hold([], 1.0, "20 m", 2.0, 5.0)

    def test_in_a_mirror_of_triangles(self):
        side = [[f"{a} m", f"{b} m", "0.5 m"] for a, b in ((-4, -4), (4, -4), (4, 4), (-4, 4))]
        self.hold([{"polygon": {"vertices": side}, "material": "mirror"}], 0.9, "0 m", 2.0, 5.0)

    def test_in_a_flat_mirror(self):
        self.hold([{"disk": {"center": ["0 m", "0 m", "0.5 m"], "normal": [0, 0, 1], "radius": "4 m"}, "material": "mirror"}],
                  0.9, "0 m", 2.0, 5.0)

    def test_on_still_water(self):
        self.hold([{"plane": {"height": "0.5 m"}, "material": "water"}], (0.33 / 2.33) ** 2, "0 m", 2.0, 5.0)

    def test_in_three_mirrors_in_turn(self):
        def mirror(centre, one, other):
            corners = [[c + 1.8 * (a * u + b * v) for c, u, v in zip(centre, one, other)] for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            return {"polygon": {"vertices": [[f"{x} m" for x in corner] for corner in corners]}, "material": "mirror"}

        h = math.sqrt(0.5)
        # Down, along x, along y, up.
        mirrors = [mirror((0, 0, 4), (0, 1, 0), (h, 0, -h)), mirror((6, 0, 4), (0, 0, 1), (h, h, 0)), mirror((6, 6, 4), (1, 0, 0), (0, h, h))]
        self.hold(mirrors, 0.9**3, "0 m", 2.0, 5.0)
        disks = [{"disk": {"center": [f"{c} m" for c in centre], "normal": normal, "radius": "1.9 m"}, "material": "mirror"}
                 for centre, normal in (((0, 0, 4), (1, 0, 1)), ((6, 0, 4), (-1, 1, 0)), ((6, 6, 4), (0, -1, 1)))]
        self.hold(disks, 0.9**3, "0 m", 2.0, 5.0)

    def test_what_stands_before_it_hides_it(self):
        roof = {"disk": {"center": ["0 m", "0 m", "15 m"], "normal": [0, 0, 1], "radius": "3 m"}, "material": "matt"}
        value, half, converged = self.pixel([roof], 1.0, 0.0, "20 m", 5.0)
        self.assertTrue(converged)
        self.assertLess(value, 1.0)  # light of the black ground below it


if __name__ == "__main__":
    unittest.main()
