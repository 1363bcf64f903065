"""PSFs of a pupil with vanes, defocus and a wavefront: images against the pupil's own overlap, counted on a grid by numpy alone, which
other wavefronts are not."""

import json
import math
import subprocess
import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).parent))
import test_channel_footprints as channel_footprints  # noqa: E402

Q = 1e-6 * 0.1 / (10e-3 * channel_footprints.PX)  # at 1 um, aperture 10 mm: one pixel


def overlap_mtf(q, frequencies, wavefront, is_open=lambda x, y: numpy.hypot(x, y) <= 1.0):
    """Along x; `wavefront` in wavelengths over the unit disc."""
    n = 400
    at = ((numpy.arange(n) + 0.5) / n * 2.0 - 1.0) * 1.05
    x, y = numpy.meshgrid(at, at)

    def pupil(shift):
        return is_open(x - shift, y) * numpy.exp(2j * math.pi * wavefront(x - shift, y))

    whole = (abs(pupil(0.0)) ** 2).sum()
    return numpy.array([abs((pupil(q * f) * numpy.conj(pupil(-q * f))).sum()) / whole for f in frequencies])


def defocus(waves):
    return lambda x, y: waves * math.sqrt(3.0) * (2.0 * (x * x + y * y) - 1.0)


def coma_to_the_right(waves):  # Noll's 8
    return lambda x, y: waves * math.sqrt(8.0) * (3.0 * (x * x + y * y) - 2.0) * x


class PupilPsf(unittest.TestCase):
    setUp = channel_footprints.ChannelFootprints.setUp
    render = channel_footprints.ChannelFootprints.render
    refused = channel_footprints.ChannelFootprints.refused

    def document(self, chosen, size=(96, 48), sampling=None, **pupil):
        return channel_footprints.document([channel_footprints.half_plane(5)], chosen, sampling or {"accuracy": {"error": "0.5 %"}, "tile": 32},
                                           list(size), psf={"pupil": {"aperture": "10 mm", **pupil}}, fill_factor=0.25)

    def described(self, document):
        source = Path(self.folder.name) / "sensor.json"
        source.write_text(json.dumps(document))
        done = subprocess.run([channel_footprints.PROGRAM, "sensor", str(source)], capture_output=True, text=True, check=True)
        return done.stdout

    def test_edges_have_the_modulation_of_the_wavefront_at_each_wavelength(self):
        f = numpy.linspace(0.02, 0.5, 49)
        seen = self.render(self.document(channel_footprints.channels(0.6, 1.0), zernike=[{"noll": 4, "rms": "80 nm"}, {"noll": 8, "rms": "60 nm"}]))
        for b, um in enumerate((0.6, 1.0)):
            def wavefront(x, y, scale=1.0, um=um):
                return scale * (defocus(0.08 / um)(x, y) + coma_to_the_right(0.06 / um)(x, y))
            found = channel_footprints.ChannelFootprints.mtf(seen["radiance"][b], 5, f)
            apart = abs(found - overlap_mtf(Q * um, f, wavefront) * numpy.sinc(0.5 * f)).max()
            self.assertLess(apart, 0.01, um)
            # The planted fault: a wavefront of half the height.
            other = abs(found - overlap_mtf(Q * um, f, lambda x, y: wavefront(x, y, 0.5)) * numpy.sinc(0.5 * f)).max()
            self.assertGreater(other, 0.05, um)

    def test_without_a_wavefront_the_image_is_the_airy_patterns(self):
        chosen = channel_footprints.channels(1.0)
        own = self.document(chosen, (40, 24), {"accuracy": {"error": "1 %"}, "tile": 16}, obscuration=0.3)
        airy = json.loads(json.dumps(own))
        airy["sensor"]["psf"] = {"airy": {"aperture": "10 mm", "obscuration": 0.3}}
        a, b = self.render(own), self.render(airy)
        held = abs(a["radiance"] - b["radiance"]) <= numpy.hypot(a["half_width"], b["half_width"])
        self.assertGreater(held.mean(), 0.97)
        airy["sensor"]["psf"]["airy"]["aperture"] = "8 mm"  # the planted fault
        c = self.render(airy)
        mixed = (a["radiance"] > 0.1 * a["radiance"].max()) & (a["radiance"] < 0.9 * a["radiance"].max())
        self.assertLess((abs(a["radiance"] - c["radiance"]) <= numpy.hypot(a["half_width"], c["half_width"]))[mixed].mean(), 0.7)

    def test_a_point_goes_where_the_wavefront_leans(self):
        """Noll's 2 to the right by 4 q for each wave, 3 down."""
        spot = channel_footprints.polygon((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1))
        for zernike, right, down in (([{"noll": 2, "waves": 0.5}], 2, 0), ([{"noll": 3, "waves": 0.25}], 0, 1)):
            described = channel_footprints.document([spot], channel_footprints.channels(1.0), {"grid": {"elements": [48, 48]}}, [13, 13],
                                                    psf={"pupil": {"aperture": "10 mm", "zernike": zernike}})
            seen = self.render(described)["radiance"][0]
            row, column = numpy.unravel_index(seen.argmax(), seen.shape)
            self.assertEqual((row - 6, column - 6), (down, right))

    def test_every_sampler_takes_it(self):
        pupil = {"zernike": [{"noll": 8, "waves": 0.1}], "spiders": {"count": 4, "width": 0.03, "angle": "45 deg"}, "obscuration": 0.2}
        chosen = channel_footprints.channels(0.8, 1.0)
        truth = self.render(self.document(chosen, (24, 16), {"grid": {"elements": [24, 24]}}, **pupil))["radiance"]
        bright = truth.max()
        for sampling, allowed in (({"adaptive": {"sub_elements": [6, 6], "allowed_difference": "2 %", "max_samples": 144}}, 0.03),
                                  ({"accuracy": {"error": "1 %"}, "tile": 16}, 0.03), ({"accuracy": {"error": "2 %", "of": "image"}}, 0.3)):
            seen = self.render(self.document(chosen, (24, 16), sampling, **pupil))["radiance"]
            self.assertLess(abs((seen - truth) / bright)[:, 2:-2, 8:-8].max(), allowed, sampling)

    def test_the_sensors_description_has_its_modulation(self):
        document = self.document(channel_footprints.channels(0.6, 1.0), defocus="150 um")
        # At the rim 150 um / 8 / 10^2.
        expected = [overlap_mtf(Q * um, [0.5], lambda x, y, um=um: 0.1875 / um * (x * x + y * y))[0] for um in (0.6, 1.0)]
        told = self.described(document)
        for value in expected:
            self.assertTrue(any(f"{value + d:.3f}" in told or f"{value + d:.2f}" in told for d in (0.0, 1e-3, -1e-3)), f"{value} in {told}")

    def test_what_is_wrong_is_said_where_it_stands(self):
        for pupil, words in (({"zernike": [{"noll": 1, "rms": "10 nm"}]}, "noll"),
                             ({"zernike": [{"noll": 4, "rms": "10 nm", "waves": 0.1}]}, "waves"),
                             ({"zernike": [{"noll": 4, "rms": "10 nm"}, {"noll": 4, "waves": 0.1}]}, "polynomial 4 twice"),
                             ({"zernike": [{"noll": 4, "rms": "40 um"}]}, "the wavefront changes by"),
                             ({"spiders": {"count": 4, "width": 0.7}}, "width"),
                             ({"spiders": {"count": 0, "width": 0.1}}, "count")):
            said = self.refused(self.document(channel_footprints.channels(1.0), **pupil))
            self.assertIn(words, said)
            self.assertRegex(said, r"bad\.json:\d+:\d+: ")


if __name__ == "__main__":
    unittest.main()
