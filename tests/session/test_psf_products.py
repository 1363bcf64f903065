"""PSFs of several parts: diffraction, Gaussians, carrier diffusion and crosstalk, convolved; against closed forms of their modulations."""

import json
import math
import re
import unittest
from pathlib import Path

import numpy

from images import RenderedCase

DIFFUSION = {"diffusion": {"field_free": "3 um"}}
CROSSTALK = {"crosstalk": {"share": "2 %", "corner": "0.5 %"}}


def document(psf, sampling=None, seed=1, **sensor):
    """Pixels of a square metre, 10 um apart, of warm boxes on cold ground."""
    camera = {"frame": {"pixels": [16, 12], "focal_length": "100 mm", "pitch": "10 um", "position": ["0 m", "0 m", "10 km"],
                        "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}}
    boxes = [{"box": {"low": ["-3.317 m", "-2.841 m", "0 m"], "high": ["1.043 m", "1.422 m", "1 mm"]}, "material": "warm"},
             {"box": {"low": ["2.113 m", "-1.237 m", "0 m"], "high": ["2.618 m", "3.929 m", "1 mm"]}, "material": "warm"}]
    return {"ifov": 1, "seed": seed,
            "scene": {"materials": {"cold": {"reflectance": 0, "temperature": "2000 K"}, "warm": {"reflectance": 0, "temperature": "3000 K"}},
                      "objects": [{"plane": {"height": "0 m"}, "material": "cold"}, *boxes]},
            "light": {"surroundings": {"reflectance": 0, "temperature": "1 K"}},
            "sensor": {"camera": camera, "channels": [{"name": "a", "monochromatic": {"at": "0.6 um"}},
                                                      {"name": "b", "monochromatic": {"at": "0.9 um"}}], "psf": psf, **sensor},
            "sampling": sampling or {"accuracy": {"error": "2 %"}}, "output": {"formats": ["envi"]}}


def planck(um, kelvin):
    return 1.191042972e8 / um**5 / math.expm1(14387.76877 / (um * kelvin))


def expected(sigma, field_free):
    """Share of light from the boxes: what a grid of a sixteenth of a pixel has of them, times the modulation of all that blurs it."""
    fine, side = 16, 64
    def covered(low, high):
        at = numpy.arange(side * fine) / fine - side / 2
        return numpy.clip(numpy.minimum(high, at + 1 / fine) - numpy.maximum(low, at), 0, None) * fine
    boxes = sum(numpy.outer(covered(-high, -low), covered(left, right))
                for left, right, low, high in ((-3.317, 1.043, -2.841, 1.422), (2.113, 2.618, -1.237, 3.929)))
    f = numpy.fft.fftfreq(side * fine, 1 / fine)
    u, v = numpy.meshgrid(f, f)
    r = numpy.hypot(u, v)
    passed = (1 - 4 * 0.02 - 4 * 0.005 + 2 * 0.02 * (numpy.cos(2 * math.pi * u) + numpy.cos(2 * math.pi * v)) +
              4 * 0.005 * numpy.cos(2 * math.pi * u) * numpy.cos(2 * math.pi * v))
    modulation = (numpy.exp(-2 * (math.pi * sigma * r) ** 2) / numpy.cosh(2 * math.pi * field_free * r) * passed *
                  numpy.sinc(u) * numpy.sinc(v) / (numpy.sinc(u / fine) * numpy.sinc(v / fine)))
    # Middles of pixels lie half a cell beside middles of cells.
    moved = numpy.exp(-1j * math.pi * (u + v) / fine)
    image = numpy.fft.ifft2(numpy.fft.fft2(boxes) * modulation * moved).real
    first_y, first_x = (side // 2 - 6) * fine + fine // 2, (side // 2 - 8) * fine + fine // 2
    return image[first_y : first_y + 12 * fine : fine, first_x : first_x + 16 * fine : fine]


class PsfProducts(RenderedCase):
    def refused(self, psf, *texts, **sensor):
        done = self.run_ifov("check", document(psf, **sensor))
        self.assertNotEqual(done.returncode, 0)
        for text in texts:
            self.assertIn(text, done.stderr)

    def mtf(self, psf, **sensor):
        done = self.run_ifov("sensor", document(psf, **sensor))
        self.assertEqual(done.returncode, 0, done.stderr)
        return [float(found) for found in re.findall(r"document's PSF ([0-9.]+)", done.stdout)]

    def test_modulation_of_channels_is_the_product_of_their_parts(self):
        absorption = {"table": {"wavelength": ["0.5 um", "1 um"], "values": [1.1, 0.1]}}
        front = {"diffusion": {"depletion": "4 um", "length": "12 um", "absorption": absorption}}
        found = self.mtf([{"airy": {"aperture": "20 mm"}}, {"gaussian": {"sigma": "0.3 px"}}, DIFFUSION, front, CROSSTALK])
        for um, told in zip((0.6, 0.9), found):
            s = um * 5.0 / 10.0 * 0.5
            optics = 2 / math.pi * (math.acos(s) - s * math.sqrt(1 - s * s)) * math.exp(-2 * (math.pi * 0.3 * 0.5) ** 2)
            a = 1.1 - (um - 0.5) / 0.5  # per um
            spread = [1 - math.exp(-a * 4) / (1 + a / math.sqrt(1 / 144 + (2 * math.pi * f / 10) ** 2)) for f in (0.5, 0.0)]
            carriers = spread[0] / spread[1] / math.cosh(2 * math.pi * 0.3 * 0.5)
            passed = 1 - (2 * 0.02 + 4 * 0.005) * 2
            self.assertAlmostEqual(told, optics * carriers * passed, delta=6e-4)
        # Planted fault: light of both channels that goes as deep.
        self.assertGreater(self.mtf([front])[0] - self.mtf([front])[1], 0.05)

    def test_gaussians_in_a_row_are_one(self):
        one = self.rendered(document({"gaussian": {"sigma": "0.5 px"}}))
        two = self.rendered(document([{"gaussian": {"sigma": "0.3 px"}}, {"none": {}}, {"gaussian": {"sigma": "0.4 px"}}]))
        self.assertTrue(numpy.allclose(one["radiance"], two["radiance"], rtol=1e-5))

    def test_intervals_hold_the_convolution_of_the_parts(self):
        psf = [{"gaussian": {"sigma": "0.3 px"}}, DIFFUSION, CROSSTALK]
        truth, other = expected(0.3, 0.3), expected(0.3, 0.0)
        for seed in (1, 2):
            found = self.rendered(document(psf, {"accuracy": {"error": "1 %"}}, seed))
            radiance, half_width = (found[product].reshape(12, 2, 16) for product in ("radiance", "half_width"))
            for channel, um in enumerate((0.6, 0.9)):
                cold, warm = planck(um, 2000), planck(um, 3000)
                share = (radiance[:, channel] - cold) / (warm - cold)
                within = half_width[:, channel] / (warm - cold)
                self.assertGreater(numpy.mean(numpy.abs(share - truth) <= within), 0.94)
                self.assertLess(numpy.mean(numpy.abs(share - other) <= within), 0.9)

    def test_an_even_scene_stays_as_it_is(self):
        described = document([{"airy": {"aperture": "20 mm"}}, {"gaussian": {"sigma": "0.3 px"}}, DIFFUSION, CROSSTALK])
        described["scene"]["objects"] = described["scene"]["objects"][:1]
        radiance = self.rendered(described)["radiance"]
        for band in radiance.reshape(12, 2, 16).transpose(1, 0, 2):
            self.assertLess(band.max() / band.min() - 1.0, 1e-6)

    def test_what_the_guide_shows_is_checked(self):
        guide = (Path(__file__).parents[2] / "docs" / "guide" / "optics.md").read_text()
        shown = [json.loads("{" + text + "}") for text in re.findall(r"```json\n(.*?)```", guide, re.S)]
        parts = [one["psf"] for one in shown if "psf" in one]
        self.assertEqual(len(parts), 2)
        for psf in parts:
            done = self.run_ifov("check", document(psf, optics={"aperture": "20 mm"}))
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_bad_parts_are_told(self):
        airy, pupil = {"airy": {"aperture": "20 mm"}}, {"pupil": {"aperture": "20 mm"}}
        self.refused([airy, pupil], "doc.json:1:", "the PSF is diffracted 2 times, and light passes one aperture: give one of 'airy' and 'pupil', once")
        self.refused([CROSSTALK, CROSSTALK], "the PSF has crosstalk 2 times: give it once")
        self.refused({"crosstalk": {"share": "11 %"}}, "crosstalk.share", "between 0 and 0.1")
        self.refused([], "sensor.psf")
        self.refused({"diffusion": {"field_free": "3 um", "depletion": "2 um"}}, "field_free", "depletion")
        self.refused({"diffusion": {"depletion": "2 um", "absorption": 0.1}},
                     "light from the front takes the diffusion length of what lies behind the depletion: give 'length'")
        self.refused({"diffusion": {"depletion": "2 um", "length": "9 um"}},
                     "light from the front takes how deep it goes: give 'absorption', the coefficient in 1/um")
        self.refused({"diffusion": {"depletion": "2 um", "length": "9 um", "absorption": 0}},
                     "the absorption coefficient is 0 /um at 0.6 um: expected more than 0, or no light becomes carriers there")
        self.refused({"diffusion": {"field_free": "150 um"}}, "the PSF reaches", "pixels from its middle, and images are blurred within 64")
        self.refused([{"gaussian": {"sigma": "14 px"}}, {"diffusion": {"field_free": "70 um"}}], "images are blurred within 64")
        described = document(DIFFUSION)
        described["sensor"]["camera"] = {"orthographic": {"pixels": [4, 4], "gsd": "1 m", "center": ["0 m", "0 m"]}}
        done = self.run_ifov("check", described)
        self.assertIn("carrier diffusion needs a 'frame' camera, whose pitch gives its size in pixels, or 'detector.pitch'", done.stderr)


if __name__ == "__main__":
    unittest.main()
