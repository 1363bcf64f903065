"""Channels with footprints of their own: diffraction by wavelength, covered apertures, bands that are shifted; against transforms of
apertures (O'Neill 1956) and closed forms, which footprints of other channels are not."""

import array
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy

PROGRAM = os.environ["IFOV_PROGRAM"]
PX = 1e-5  # pitch, m
SIGMA = 0.5


def planck(kelvin):
    """At 1 um, W m-2 sr-1 um-1."""
    return 1.191042972e8 / math.expm1(14387.76877 / kelvin)


def channels(*microns, **more):
    return [{"name": f"c{k}", "monochromatic": {"at": f"{um} um"}, **{key: value[k] for key, value in more.items() if value[k] is not None}}
            for k, um in enumerate(microns)]


def document(objects, chosen, sampling, size, seed=1, **sensor):
    """A camera 10 km above a plane, a pixel of which sees a square metre: so narrow that it is one of parallel rays."""
    camera = {"frame": {"pixels": size, "focal_length": "100 mm", "pitch": "10 um", "position": ["0 m", "0 m", "10 km"],
                        "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}}
    return {"ifov": 1, "seed": seed, "scene": {"materials": {"dark": {"reflectance": 0, "temperature": "1 K"},
                                                  "light": {"reflectance": 0, "temperature": "3000 K"}},
                                   "objects": [{"plane": {"height": "0 m"}, "material": "dark"}, *objects]},
            "light": {"surroundings": {"reflectance": 0, "temperature": "1 K"}},
            "sensor": {"camera": camera, "channels": chosen, **sensor}, "sampling": sampling, "output": {"formats": ["envi"]}}


def polygon(*corners):
    return {"polygon": {"vertices": [[f"{x} m", f"{y} m", "1 mm"] for x, y in corners]}, "material": "light"}


def half_plane(degrees, far=600.0):
    """Light right of a line through the middle, turned from the columns."""
    t = math.tan(math.radians(degrees))
    return polygon((-far * t, -far), (2 * far, -far), (2 * far, far), (far * t, far))


class ChannelFootprints(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def render(self, described, *options):
        """By product: bands, rows, columns."""
        name = Path(self.folder.name) / f"run{len(list(Path(self.folder.name).iterdir()))}"
        source = Path(str(name) + ".json")
        source.write_text(json.dumps(described))
        done = subprocess.run([PROGRAM, "render", str(source), "--output", str(name), *options], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)  # beside 0: intervals are wider than asked, or there are none
        self.out = name
        (model,) = described["sensor"]["camera"].values()
        columns, rows = model["pixels"]
        read = {}
        for product in ("radiance", "half_width"):
            file = name / f"image_{product}.img"
            if file.exists():
                values = numpy.array(array.array("f", file.read_bytes())).astype(float)
                header = Path(f"{file}.hdr").read_text()
                self.assertIn("interleave = bil", header)
                read[product] = values.reshape(rows, -1, columns).transpose(1, 0, 2)
        return read

    def refused(self, described):
        source = Path(self.folder.name) / "bad.json"
        source.write_text(json.dumps(described))
        done = subprocess.run([PROGRAM, "check", str(source)], capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        return done.stderr

    @staticmethod
    def mtf(image, degrees, frequencies):
        """Of a slanted edge by ISO 12233: the derivative of pixels sorted by their distance from the edge, transformed."""
        rows, columns = image.shape
        y, x = numpy.mgrid[0:rows, 0:columns] + 0.5
        a = math.radians(degrees)
        distance = ((x - columns / 2) * math.cos(a) - (rows / 2 - y) * math.sin(a)).ravel()
        step, reach = 0.125, columns / 2 - 4
        bins = numpy.floor((distance + reach) / step).astype(int)
        count = int(2 * reach / step)
        inside = (bins >= 0) & (bins < count)
        number = numpy.bincount(bins[inside], minlength=count)
        edge = numpy.bincount(bins[inside], image.ravel()[inside], minlength=count) / number
        where = numpy.bincount(bins[inside], distance[inside], minlength=count) / number
        line, middle = numpy.diff(edge), 0.5 * (where[1:] + where[:-1])
        found = []
        for f in frequencies:
            # Of the difference of means a step apart.
            blur = numpy.sinc(f * step) ** 2
            found.append(abs(numpy.sum(line * numpy.exp(-2j * math.pi * f * middle))) / line.sum() / blur)
        return numpy.array(found)

    @staticmethod
    def disc_mtf(q, f, obscuration=0.0):
        """As common area of apertures that are shifted, counted on a grid: nothing of the program's."""
        n = 1500
        at = (numpy.arange(n) + 0.5) / n * 2.0 - 1.0
        x, y = numpy.meshgrid(at, at)
        def open_at(dx):
            r = numpy.hypot(x - dx, y)
            return (r <= 0.5) & (r >= 0.5 * obscuration)
        whole = open_at(0.0).sum()
        return numpy.array([(open_at(0.5 * q * one) & open_at(-0.5 * q * one)).sum() / whole for one in f])

    @staticmethod
    def at_half(modulation, frequencies):
        k = int(numpy.argmax(modulation < 0.5))
        slope = (modulation[k - 1] - modulation[k]) / (frequencies[k] - frequencies[k - 1])
        return frequencies[k - 1] + (modulation[k - 1] - 0.5) / slope

    def test_diffraction_goes_by_each_channels_wavelength(self):
        f, found = numpy.linspace(0.02, 0.9, 89), []
        below = f <= 0.5
        accurate = {"accuracy": {"error": "0.5 %"}, "tile": 32}
        q = [um * 1e-6 * 0.1 / (7.3333e-3 * PX) for um in (0.45, 2.2)]
        for wavelength in ({}, {"wavelength": "1 um"}):  # the other is the planted fault: one footprint for both
            seen = self.render(document([half_plane(5)], channels(0.45, 2.2), accurate, [96, 48],
                                        psf={"airy": {"aperture": "7.3333 mm", **wavelength}}, fill_factor=0.25))["radiance"]
            modulation = [self.mtf(seen[b], 5, f) for b in (0, 1)]
            apart = [abs(m[below] - self.disc_mtf(q[b], f[below]) * numpy.sinc(0.5 * f[below])).max() for b, m in enumerate(modulation)]
            halves = [self.at_half(m / numpy.sinc(0.5 * f), f) for m in modulation]
            found.append((halves[0] / halves[1], max(apart)))
        self.assertAlmostEqual(found[0][0] / (2.2 / 0.45), 1.0, delta=0.01)
        self.assertLess(found[0][1], 0.01)
        self.assertLess(found[1][0], 1.1)
        self.assertGreater(found[1][1], 0.1)

    SHIFTS = [(0, 0), (0.4, 0), (-0.7, 0.3), (1.6, -1.1), (0, 0.9), (-2.2, 0)]

    def shifted(self, sampling, seed=1, size=(20, 14)):
        chosen = channels(*[10.0 + 0.1 * k for k in range(6)], shift=[[f"{x} px", f"{y} px"] for x, y in self.SHIFTS])
        return document([half_plane(17)], chosen, sampling, list(size), seed, psf={"gaussian": {"sigma": f"{SIGMA} px"}})

    def expected(self, size, shift):
        """Share of light: a Gaussian's distribution at the distance from the edge, over the pixel's square."""
        columns, rows = size
        a, n = math.radians(17), 24
        at = (numpy.arange(n) + 0.5) / n
        x = (numpy.arange(columns)[:, None] + at[None, :]).ravel() - columns / 2 + shift[0]
        y = rows / 2 - (numpy.arange(rows)[:, None] + at[None, :]).ravel() - shift[1]
        d = x[None, :] * math.cos(a) - y[:, None] * math.sin(a)
        share = 0.5 * (1.0 + numpy.vectorize(math.erf)(d / (SIGMA * math.sqrt(2.0))))
        return share.reshape(rows, n, columns, n).mean(axis=(1, 3))

    def test_intervals_hold_by_channel_and_not_about_another_footprint(self):
        size, held, wrong = (20, 14), numpy.zeros(6), numpy.zeros(6)
        # The same tables of footprints at 2304 points a pixel: closed forms are 0.002 from the tables.
        truth = self.render(self.shifted({"grid": {"elements": [48, 48]}}))["radiance"]
        for seed in range(1, 9):
            seen = self.render(self.shifted({"accuracy": {"error": "1 %"}, "tile": 16}, seed))
            for b, shift in enumerate(self.SHIFTS):
                bright = seen["radiance"][b].max()
                share = self.expected(size, shift)
                mixed = (share > 0.1) & (share < 0.99)
                near = abs(seen["radiance"][b] - truth[b]) <= seen["half_width"][b]
                other = abs(seen["radiance"][b] - bright * self.expected(size, self.SHIFTS[b - 1])) <= seen["half_width"][b]
                held[b] += near[mixed].mean() / 8
                wrong[b] += other[mixed].mean() / 8
        self.assertGreater(held.min(), 0.93)
        self.assertLess(wrong.max(), 0.6)

    @staticmethod
    def blurred_edge(side, sigma, degrees):
        """Shares of light in the pixels of a square image, by the distribution of a Gaussian."""
        n, a = 120, math.radians(degrees)
        at = ((numpy.arange(side)[:, None] + (numpy.arange(n) + 0.5) / n).ravel() - side / 2)
        d = at[None, :] * math.cos(a) + at[:, None] * math.sin(a)
        return (0.5 * (1.0 + numpy.vectorize(math.erf)(d / (sigma * math.sqrt(2.0))))).reshape(side, n, side, n).mean(axis=(1, 3))

    def test_edges_and_points_under_narrow_and_wide_footprints(self):
        """Closed forms at accuracies that show how footprints are tabulated and integrated."""
        camera = {"orthographic": {"gsd": "1 m", "pixels": [11, 11]}}
        for sigma in (0.04, 0.5):
            described = document([half_plane(17)], channels(10.0), {"accuracy": {"error": "1 W m-2 sr-1 um-1"}}, [11, 11],
                                 psf={"gaussian": {"sigma": f"{sigma} px"}})
            described["sensor"]["camera"] = camera
            described["scene"]["materials"]["light"]["temperature"] = "1000 K"
            bright = 1.191042972e8 / 10.0**5 / (math.exp(1.43877688) - 1.0)
            described["sampling"]["accuracy"]["error"] = f"{3e-4 * bright} W m-2 sr-1 um-1"
            seen = self.render(described)
            share, half = seen["radiance"][0] / bright, seen["half_width"][0] / bright
            for of, held in ((sigma, True), (sigma + 0.03, False)):  # the other is the planted fault
                true = self.blurred_edge(11, of, 17)
                mixed = (true > 0.003) & (true < 0.997)
                within = (abs(share - true) <= half)[mixed].mean()
                (self.assertGreaterEqual if held else self.assertLess)(within, 0.93 if held else 0.7, f"sigma {sigma}, {of}")
        # A disc about a corner that four pixels and four cells of the lattice share.
        disc = {"disk": {"center": ["0.5 m", "-0.5 m", "1 mm"], "normal": [0, 0, 1], "radius": "2 cm"}, "material": "light"}
        described["scene"]["objects"][1] = disc
        described["sensor"]["psf"] = {"gaussian": {"sigma": "0.15 px"}}
        whole = bright * math.pi * 0.02**2
        described["sampling"]["accuracy"]["error"] = f"{2e-3 * whole} W m-2 sr-1 um-1"
        described["scene"]["materials"]["dark"]["temperature"] = "150 K"  # at 1 K nothing that rays meet by chance would shine
        seen = self.render(described)["radiance"][0]
        share = (seen - seen[0, 0]) / whole
        for y in (5, 6):
            for x in (5, 6):
                self.assertAlmostEqual(share[y, x], 0.25, delta=0.003)

    def test_a_tiny_hot_target_reaches_pixels_beyond_the_footprint(self):
        """3 cm in a pixel's metre: what paths of the wings' cells miss, against the pattern's own intensity (O'Neill 1956) over the pixel."""
        steps = (numpy.arange(32) + 0.5) / 32 - 0.5
        at, side, q = (28.3, 12.2), 0.03, 1.0

        def first_bessel(v):
            turn = (numpy.arange(400) + 0.5) * math.pi / 400
            return sum(numpy.cos(t - v * math.sin(t)) for t in turn) / 400

        def share(x, y, covered):
            r = numpy.hypot(x - at[0] + 0.5 + steps[:, None], y - at[1] + 0.5 + steps)
            v = math.pi * r / q
            amplitude = 2 * first_bessel(v) / v
            if covered > 0:
                amplitude = amplitude - covered**2 * 2 * first_bessel(covered * v) / (covered * v)
            return math.pi / (4 * q * q) * (amplitude**2).mean() / (1 - covered**2)

        columns = [x for x in range(10, 68) if abs(x - 28) >= 8]
        expected = {covered: numpy.array([share(x, 12, covered) for x in columns]) for covered in (0.0, 0.35)}
        for covered, other in ((0.0, 0.35), (0.35, 0.0)):
            target = polygon(*((at[0] - 48 + i * side, 12 - at[1] + j * side) for i, j in ((-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5))))
            described = document([target], channels(1.0), {"accuracy": {"error": "0.9 %"}, "tile": 32}, (96, 24),
                                 psf={"airy": {"aperture": "10 mm", **({"obscuration": covered} if covered else {})}})
            for material in (described["scene"]["materials"]["dark"], described["light"]["surroundings"]):
                material["temperature"] = "900 K"
            seen = self.render(described)
            ground = planck(900.0)
            light = (planck(3000.0) - ground) * side**2
            found = (seen["radiance"][0][12, columns] - seen["radiance"][0][0, 95]) / light
            half_width = seen["half_width"][0][12, columns] / light
            held = abs(found - expected[covered]) <= half_width + 1e-7
            self.assertGreaterEqual(held.mean(), 0.93)
            self.assertLess(half_width[0], 3e-4)
            near = [abs(x - 28) < 20 for x in columns]
            self.assertLess(abs((found - expected[covered])[near]).sum(), 0.1 * expected[covered][near].sum())
            # Planted faults: another aperture's, and none, as where paths of the cells miss the target.
            self.assertGreater(abs(found - expected[other])[near].sum(), 0.15 * expected[other][near].sum())
            self.assertLess((expected[covered] <= half_width)[near].mean(), 0.5)

    def test_every_sampler_takes_each_channel_from_its_own_place(self):
        size = (20, 14)
        for sampling, allowed in (({"grid": {"elements": [12, 12]}}, 0.01), ({"single": {}}, 0.6),
                                  ({"adaptive": {"sub_elements": [6, 6], "allowed_difference": "2 %", "max_samples": 144}}, 0.05),
                                  ({"accuracy": {"error": "2 %", "of": "image"}}, 0.3)):
            seen = self.render(self.shifted(sampling, size=size))["radiance"]
            for b, shift in enumerate(self.SHIFTS):
                share = seen[b] / seen[b].max()
                off = share - self.expected(size, shift)
                self.assertLess(abs(off).max(), allowed, f"{sampling}, channel {b}")
                self.assertLess(abs(off.mean()), 0.01, f"{sampling}, channel {b}")

    def test_small_shifts_of_small_elements(self):
        """Footprints that stay within the pixel share no samples with others: a grid wrote the pixels of every other column, twice over."""
        for shift in (0.14, 0.02):
            chosen = channels(1.0, 1.0, shift=[None, [f"{shift} px", f"{-shift} px"]])
            read = self.render(document([half_plane(0)], chosen, {"grid": {"elements": [12, 12]}}, [6, 4], fill_factor=0.5))["radiance"]
            read = read / planck(3000)
            light = numpy.array([0, 0, 0, 1, 1, 1.0])
            self.assertLess(abs(read - light).max(), 1e-6)

    def test_bytes_do_not_depend_on_threads(self):
        first = None
        for threads in ("1", "2", "7"):
            self.render(self.shifted({"accuracy": {"error": "1 %"}, "tile": 8}), "--threads", threads)
            bytes_ = (self.out / "image_radiance.img").read_bytes()
            first = first or bytes_
            self.assertEqual(first, bytes_)


if __name__ == "__main__":
    unittest.main()
