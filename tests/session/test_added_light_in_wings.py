"""Under an Airy PSF, light that paths leave out (a glint, images in mirrors), and light of maps that paths hardly meet: far from its place
it falls as q / (pi^3 r^3), and all of it together is what there is."""

import array
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SIDE, MIDDLE = 61, 30
NARROW = {"gaussian": {"sigma": "0.5 px"}}
# 0.605 um over 60.5 mm, at 10 um a pixel and 1 m of focal length: q = 1 pixel.
AIRY = {"airy": {"aperture": "60.5 mm", "wavelength": "0.605 um"}}
MIRROR = {"reflectance": 1.0, "scattering": "mirror", "temperature": "280 K"}
GROUND = {"reflectance": 0.0, "temperature": "280 K"}


def planck(um, kelvins):
    return 1.191042972e8 / um**5 / (math.exp(14387.76877 / um / kelvins) - 1.0)


HOT = planck(3.95, 1200.0) - planck(3.95, 280.0)


def annulus(image, radius):
    found = [image[y * SIDE + x] for y in range(SIDE) for x in range(SIDE)
             if abs(math.hypot(x - MIDDLE, y - MIDDLE) - radius) < 1.0]
    return sum(found) / len(found)


def expected(radius):
    """Of light in the middle, of q = 1."""
    found = [1.0 / (math.pi * math.hypot(x - MIDDLE, y - MIDDLE)) ** 3 for y in range(SIDE) for x in range(SIDE)
             if abs(math.hypot(x - MIDDLE, y - MIDDLE) - radius) < 1.0]
    return sum(found) / len(found)


class AddedLightInWings(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def render(self, materials, objects, psf, channel, light=None, error="1 %"):
        document = {"ifov": 1, "scene": {"materials": materials, "objects": objects}, "light": light or {},
                    "sensor": {"camera": {"frame": {"focal_length": "1 m", "pitch": "10 um", "pixels": [SIDE, SIDE],
                                                    "position": ["0 m", "0 m", "100 km"], "look_at": ["0 m", "0 m", "0 m"]}},
                               "channels": [{"name": "one", "top_hat": {"from": f"{channel[0]} um", "to": f"{channel[1]} um"}}], "psf": psf},
                    "sampling": {"accuracy": {"error": error}}, "output": {"formats": ["envi"]}}
        (self.path / "scene.json").write_text(json.dumps(document))
        out = self.path / f"out{len(list(self.path.iterdir()))}"
        done = subprocess.run([PROGRAM, "render", str(self.path / "scene.json"), "-o", str(out), "-q"], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        read = []
        for name in ("radiance", "half_width"):
            values = array.array("f")
            values.frombytes((out / f"image_{name}.img").read_bytes())
            self.assertEqual(len(values), SIDE * SIDE)
            read.append(values)
        return read

    def compare(self, energy, background, radiance, half_width, share=0.2):
        for radius in (8.0, 13.0, 20.0, 28.0):
            light = energy * expected(radius)
            off = annulus(radiance, radius) - background - light
            # Rings in the pattern, which pixels smooth, leave some per cent of its asymptote.
            self.assertLess(abs(off), 0.04 * light + min(annulus(half_width, radius), 0.2 * light) + 1e-3 * background, radius)
            # And it is no wide interval that holds it.
            self.assertLess(annulus(half_width, radius), share * light + 0.006 * background, radius)
        whole = sum(radiance) - background * SIDE * SIDE
        # 1 - E at half the side, 2 / (pi^2 r), is beyond the picture.
        self.assertAlmostEqual(whole / energy, 1.0 - 2.0 / (math.pi**2 * 33.0), delta=0.004)

    def test_a_glint(self):
        ball = {"sphere": {"center": ["0.1 m", "0.2 m", "0.1 m"], "radius": "0.1 m"}, "material": "mirror"}
        about = ({"mirror": MIRROR}, [ball], (0.6, 0.61), {"sun": {"disc": {"zenith": "40 deg", "azimuth": "90 deg"}}})
        narrow, _ = self.render(about[0], about[1], NARROW, about[2], about[3])
        radiance, half_width = self.render(about[0], about[1], AIRY, about[2], about[3])
        # Where all is black, intervals are as wide as what is counted as nothing.
        self.compare(sum(narrow), 0.0, radiance, half_width, share=math.inf)

    def test_images_of_a_hot_ball_in_a_flat_mirror(self):
        for radius, error in ((0.1, "1.5 %"), (0.7, "3 %")):  # found beside the paths, and left to them
            with self.subTest(radius=radius):
                mirror = {"polygon": {"vertices": [["-1 m", "-1 m", "2 m"], ["1 m", "-1 m", "0 m"], ["1 m", "1 m", "0 m"], ["-1 m", "1 m", "2 m"]]},
                          "material": "mirror"}
                ball = {"sphere": {"center": ["6 m", "0.13 m", "1.21 m"], "radius": f"{radius} m"}, "material": "hot"}
                roof = {"box": {"low": ["4 m", "-2 m", "2.5 m"], "high": ["8 m", "2 m", "2.6 m"]}, "material": "ground"}
                materials = {"mirror": MIRROR, "ground": GROUND, "hot": {"reflectance": 0.0, "temperature": "1200 K"}}
                radiance, half_width = self.render(materials, [{"plane": {}, "material": "ground"}, mirror, ball, roof], AIRY, (3.94, 3.96), error=error)
                self.compare(HOT * math.pi * radius**2, planck(3.95, 280.0), radiance, half_width, share=0.6)

    def test_a_hot_cell_of_a_map(self):
        rows = [["280"] * 240 for _ in range(240)]
        rows[119][120] = "1200"
        text = "ncols 240\nnrows 240\nxllcorner -60\nyllcorner -60\ncellsize 0.5\n"
        (self.path / "kelvins.asc").write_text(text + "\n".join(" ".join(row) for row in rows) + "\n")
        materials = {"ground": {"emissivity": 1, "temperature": {"map": {"file": "kelvins.asc", "unit": "K"}}}}
        radiance, half_width = self.render(materials, [{"plane": {}, "material": "ground"}], AIRY, (3.94, 3.96))
        # Kelvins are bilinear between the middles of cells.
        steps, energy = 400, 0.0
        tent = [1.0 - (k + 0.5) / steps for k in range(steps)]
        for a in tent:
            energy += sum(planck(3.95, 280.0 + 920.0 * a * b) - planck(3.95, 280.0) for b in tent)
        energy *= 4.0 * 0.25 / steps**2
        self.compare(energy, planck(3.95, 280.0), radiance, half_width, share=0.6)


if __name__ == "__main__":
    unittest.main()
