"""Diffraction far smaller than an element (150 um at f/4): an edge's pixels converge, and hold what the modulation of optics and elements makes of it."""

import math
import unittest

from images import RenderedCase, np

SIZE, DISTANCE, ANGLE = 24, 0.3, math.radians(14)
NORMAL = math.cos(ANGLE), math.sin(ANGLE)


def document(**sensor):
    (nx, ny), far = NORMAL, 80
    corners = [(DISTANCE * nx - a * nx * far + b * ny * far, DISTANCE * ny - a * ny * far - b * nx * far) for a, b in ((1, -1), (1, 1), (0, 1), (0, -1))]
    return {"ifov": 1,
            "scene": {"materials": {"dark": {"reflectance": 0, "temperature": "2500 K"}, "light": {"reflectance": 0, "temperature": "3000 K"}},
                      "objects": [{"plane": {}, "material": "dark"}, {"polygon": {"vertices": [[f"{x} m", f"{y} m", "1 mm"] for x, y in corners]}, "material": "light"}]},
            "light": {"surroundings": {"reflectance": 0, "temperature": "2500 K"}},
            "sensor": {"camera": {"frame": {"pixels": [SIZE, SIZE], "focal_length": "100 mm", "pitch": "150 um", "position": ["0 m", "0 m", "666.6666667 m"], "attitude": {}}},
                       "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}], **sensor},
            "sampling": {"accuracy": {"error": "0.5 %"}}, "output": {"formats": ["envi"]}}


def edge(t, q):
    """Share of the light at a distance t within a half plane: of Airy's aperture (Goodman 2005, section 6.4) times the element's square, over frequencies."""
    f = (np.arange(200_000) + 0.5) * (1 / q if q > 0 else 200.0) / 200_000
    s = f * q
    optics = 2 / np.pi * (np.arccos(s) - s * np.sqrt(1 - s * s))
    weight = optics * np.sinc(f * NORMAL[0]) * np.sinc(f * NORMAL[1]) / f * (f[1] - f[0])
    return 0.5 + np.array([np.sum(weight * np.sin(2 * np.pi * f * one)) for one in t]) / np.pi


@unittest.skipIf(np is None, "NumPy not found")
class SmallDiffraction(RenderedCase):
    def test_edges_converge_to_what_modulation_says(self):
        q = 0.65e-6 * 4 / 150e-6
        found = self.rendered(document(psf={"airy": {"aperture": "25 mm"}}), SIZE, SIZE)
        planck = [1 / math.expm1(14387.768775 / (0.65 * kelvin)) for kelvin in (2500, 3000)]
        dark = found["radiance"].min()  # far from the edge, but for wings
        contrast = dark * (planck[1] / planck[0] - 1)
        i, j = np.meshgrid(np.arange(SIZE), np.arange(SIZE))
        inward = DISTANCE - (NORMAL[0] * (i + 0.5 - SIZE / 2) + NORMAL[1] * (SIZE / 2 - j - 0.5))
        near = np.abs(inward) < 3
        t = inward[near]
        base = dark - contrast * edge(np.array([inward.min()]), q)[0]
        truth, sharp = (base + contrast * edge(t, of) for of in (q, 0.0))
        off = np.abs(found["radiance"][near] - truth) / found["half_width"][near]
        self.assertGreater(off.size, 100)
        self.assertGreater(np.mean(off <= 1), 0.95)
        self.assertGreater(np.max(np.abs(sharp - truth) / found["half_width"][near]), 1.0, "planted: optics without blur")
        limit = 0.005 * found["radiance"]
        self.assertGreater(np.mean(found["half_width"] <= 1.0001 * limit), 0.998, "every edge was left unconverged: 4 % of the pixels")


if __name__ == "__main__":
    unittest.main()
