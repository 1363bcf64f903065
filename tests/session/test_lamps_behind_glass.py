"""Light of lamps that glass bends: it is found by chance alone, and a pixel that it may reach says so."""

import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

PROGRAM = os.environ.get("IFOV_PROGRAM", str(pathlib.Path(__file__).resolve().parents[2] / "build" / "ifov"))
INDEX, THICK_M, LOW_M, LAMP_M, RADIUS_M, RADIANCE, REFLECTANCE = 1.5, 0.5, 1.0, 5.0, 0.05, 1e5, 0.3
SKY = 1.0


def metres(*values):
    return [f"{value} m" for value in values]


def document(glass, look_x_m, mirror=False):
    """A camera under a block of glass looks at the ground; the lamp stands above the block."""
    objects = [{"plane": {}, "material": "ground"}]
    if glass:
        objects.append({"box": {"low": metres(-2, -2, LOW_M), "high": metres(2, 2, LOW_M + THICK_M)}, "material": "glass"})
    return {"ifov": 1, "scene": {"materials": {"ground": {"reflectance": REFLECTANCE},
                                               "glass": {"scattering": {"smooth": {"n": INDEX, "k": 0, "over": "medium"}}}},
                                 "objects": objects},
            "light": {"sky": {"radiance": f"{SKY} W m-2 sr-1 um-1"},
                      "sources": [{"sphere": {"at": metres(0, 0, LAMP_M), "radius": f"{RADIUS_M} m",
                                              "radiance": f"{RADIANCE} W m-2 sr-1 um-1"}}]},
            "sensor": {"camera": {"frame": {"focal_length": "50 mm", "pitch": "5 mm", "pixels": [6, 6],
                                            "position": metres(look_x_m, 0, 0.9), "look_at": metres(look_x_m, 0, 0), "up": [0, 1, 0]}},
                       "channels": [{"name": "red", "top_hat": {"from": "0.649 um", "to": "0.651 um"}}]},
            "sampling": {"accuracy": {"error": "2 %"}}}


def passed(sine):
    """Share of unpolarized light that goes on through both faces of a plate and what is reflected between them (Fresnel)."""
    cosine, within = math.sqrt(1 - sine * sine), math.sqrt(1 - (sine / INDEX) ** 2)
    faces = [((cosine - INDEX * within) / (cosine + INDEX * within)) ** 2, ((within - INDEX * cosine) / (within + INDEX * cosine)) ** 2]
    return sum((1 - r) / (1 + r) for r in faces) / 2


def lamp_through_plate(x_m):
    """Radiance of the ground, of the lamp's light alone: by Snell's law and the cone that falls on a ring of ground."""
    def reach(sine):
        return ((LAMP_M - THICK_M) * sine / math.sqrt(1 - sine * sine) + THICK_M * sine / INDEX / math.sqrt(1 - (sine / INDEX) ** 2))
    low, high = 0.0, 0.999
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if reach(middle) < x_m else (low, middle)
    sine, step = max(low, 1e-4), 1e-6
    slope = (reach(sine + step) - reach(sine - step)) / (2 * step)
    cosine = math.sqrt(1 - sine * sine)
    # d omega = 2 pi sin d theta = 2 pi sin d sin / cos falls on 2 pi x dx.
    irradiance = RADIANCE * math.pi * RADIUS_M**2 * passed(sine) * sine / cosine / (reach(sine) * slope)
    return REFLECTANCE * irradiance / math.pi


class LampsBehindGlass(unittest.TestCase):
    def render(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "scene.json").write_text(json.dumps(document(*arguments)))
            done = subprocess.run([PROGRAM, "render", "scene.json", "-o", "out", "--no-cache", "--set", "seed=1"], cwd=folder,
                                  capture_output=True, text=True, check=False)
            self.assertIn(done.returncode, (0, 4, 5, 6), done.stderr)
            radiance, half_width = (numpy.fromfile(folder / "out" / f"image_{name}.img", "<f4").reshape(6, 6) for name in ("radiance", "half_width"))
            reasons = (folder / "out" / "image_reasons.img").read_bytes()
            each = len(reasons) // 36
            sure = numpy.array([not any(reasons[k * each:(k + 1) * each]) for k in range(36)]).reshape(6, 6)
            return radiance, half_width, sure, done.stderr

    def test_what_glass_bends_is_said(self):
        radiance, half_width, sure, said = self.render(True, 0.0)
        truth = lamp_through_plate(0.1)
        self.assertGreater(truth, 1.0)
        self.assertFalse(sure.any())
        self.assertTrue((abs(radiance - truth) <= half_width + REFLECTANCE * SKY).all(), (radiance, half_width, truth))
        self.assertIn("pixels are marked that it may reach", said)

    def test_what_no_glass_reaches_is_sure(self):
        radiance, half_width, sure, _ = self.render(True, 60.0)
        self.assertTrue(sure.all())
        self.assertTrue((half_width < 0.03 * radiance).all())
        radiance, half_width, sure, _ = self.render(False, 0.0)
        self.assertTrue(sure.all())
        # The inverse square, at the foot of the lamp.
        expected = REFLECTANCE * (SKY + RADIANCE * RADIUS_M**2 / LAMP_M**2)
        self.assertTrue((abs(radiance - expected) < half_width + 1e-3 * expected).all())


if __name__ == "__main__":
    unittest.main()
