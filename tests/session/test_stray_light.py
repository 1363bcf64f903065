"""Stray light: a halo about all that shines, against its closed form across an edge and as a modulation."""

import math
import re
import unittest
from pathlib import Path

import numpy

from images import RenderedCase

WIDTH, HEIGHT = 32, 6


def document(stray, objects=True, seed=1, **sensor):
    """Light right of a line, 0.3 px right of the middle, and darkness left of it."""
    camera = {"frame": {"pixels": [WIDTH, HEIGHT], "focal_length": "100 mm", "pitch": "10 um", "position": ["0 m", "0 m", "10 km"],
                        "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}}
    light = {"polygon": {"vertices": [[f"{x} m", f"{y} m", "1 mm"] for x, y in ((0.3, -4000), (4000, -4000), (4000, 4000), (0.3, 4000))]},
             "material": "light"}
    return {"ifov": 1, "seed": seed,
            "scene": {"materials": {"dark": {"reflectance": 0, "temperature": "1500 K"}, "light": {"reflectance": 0, "temperature": "3000 K"}},
                      "objects": [{"plane": {"height": "0 m"}, "material": "dark"}] + ([light] if objects else [])},
            "light": {"surroundings": {"reflectance": 0, "temperature": "1 K"}},
            "sensor": {"camera": camera, "channels": [{"name": "a", "monochromatic": {"at": "1 um"}}], "optics": {"stray_light": stray}, **sensor},
            "sampling": {"accuracy": {"error": "1 %"}}, "output": {"formats": ["envi"]}}


def planck(kelvin):
    return 1.191042972e8 / math.expm1(14387.76877 / kelvin)


class StrayLight(RenderedCase):
    def render(self, described):
        return self.rendered(described, HEIGHT, WIDTH).values()

    def test_beside_an_edge_light_falls_as_the_halo_says(self):
        share, radius = 0.04, 20.0
        def expected(share, radius):
            x = numpy.arange(WIDTH) + 0.5 - WIDTH / 2 - 0.3
            halo = 0.5 + numpy.arctan(x / (radius / math.sqrt(3))) / math.pi  # straight over a pixel
            return (1 - share) * numpy.clip(x + 0.5, 0, 1) + share * halo
        for seed in (1, 2):
            radiance, half_width = self.render(document({"share": share, "radius": f"{radius} px"}, seed=seed))
            dark, light = planck(1500), planck(3000)
            found, within = (radiance - dark) / (light - dark), half_width / (light - dark)
            self.assertGreater(numpy.mean(numpy.abs(found - expected(share, radius)) <= within), 0.94)
            self.assertLess(numpy.abs(found - expected(share, radius)).max(), 0.004)
            for other in (expected(share, 30.0), expected(0.06, radius), expected(0.0, radius)):
                self.assertLess(numpy.mean(numpy.abs(found - other) <= within), 0.6)

    def test_a_veil_is_as_bright_as_what_is_known_and_says_so(self):
        # Nine tenths of the halo come from further away than is looked: what is told holds the truth all the same.
        radiance, half_width = self.render(document({"share": 0.04, "radius": "2000 px"}))
        dark, light = planck(1500), planck(3000)
        found, within = (radiance - dark) / (light - dark), half_width / (light - dark)
        self.assertTrue((numpy.abs(found[:, : WIDTH // 2] - 0.02) <= within[:, : WIDTH // 2]).all())
        self.assertTrue((within > 0.01).all())

    def test_an_even_scene_stays_as_it_is(self):
        plain = document({"share": 0.04, "radius": "20 px"}, objects=False)
        radiance, _ = self.render(plain)
        self.assertLess(numpy.abs(radiance / planck(1500) - 1.0).max(), 1e-6)
        blurred = document({"share": 0.04, "radius": "20 px"}, objects=False,
                           psf=[{"gaussian": {"sigma": "0.4 px"}}, {"crosstalk": {"share": "1 %"}}])
        radiance, _ = self.render(blurred)
        self.assertLess(numpy.abs(radiance / planck(1500) - 1.0).max(), 1e-6)

    def test_modulation_and_what_is_said_of_it(self):
        stray = {"share": 0.3, "radius": "2 px"}
        told = self.run_ifov("sensor", document(stray, psf={"gaussian": {"sigma": "0.4 px"}})).stdout
        mtf = float(re.search(r"document's PSF ([0-9.]+)", told)[1])
        self.assertAlmostEqual(mtf, 0.7 * math.exp(-2 * (math.pi * 0.4 * 0.5) ** 2) + 0.3 * math.exp(-math.pi * 2 / math.sqrt(3)), delta=6e-4)
        check = self.run_ifov("check", document({"share": "4 %", "radius": "20 px"})).stdout
        self.assertIn("stray light: 4 % of the light falls in a halo, half of it within 20 px; 0.359 % come from more than 128 px away", check)

    def test_bad_halos_are_told(self):
        for stray, texts in (({"share": 0.6, "radius": "20 px"}, ("doc.json:1:", "share' is the number 0.6", "between 0 and 0.5")),
                             ({"share": 0.1, "radius": "1 px"}, ("radius' is the text", "between 2 and 10000 px")),
                             ({"share": 0.1}, ("stray_light' lacks the key 'radius'",))):
            done = self.run_ifov("check", document(stray))
            self.assertNotEqual(done.returncode, 0)
            for text in texts:
                self.assertIn(text, done.stderr)


if __name__ == "__main__":
    unittest.main()
