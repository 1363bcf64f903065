"""`ifov sensor`: what follows of a sensor."""

import json
import math
import re
import unittest

from program import Folder, run
from test_detector import C, H, K, changed, integral, mean_radiance, text


class Sensor(unittest.TestCase):
    def told(self, document, *arguments):
        with Folder(scene=document) as folder:
            done = run("sensor", "scene.json", *arguments, cwd=folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def number(self, out, pattern):
        found = re.search(pattern.replace("#", r"([0-9.e+-]+)"), out)
        self.assertIsNotNone(found, out)
        return float(found.group(1))

    def test_a_thermal_camera_by_hand(self):
        out = self.told(text())
        self.assertIn("120 x 100 pixels, GSD 1 m, swath 120 m, f/2\n", out)
        thermal = out[out.index("thermal:"):out.index("long:")]
        throughput = 225e-12 * math.pi * (1 - 0.09) / 16
        photons = throughput * 2e-4 * 0.8 * 1e-6 / (H * C) * integral(lambda um: um, 8, 9.5) * mean_radiance(8, 9.5, 300)
        self.assertAlmostEqual(self.number(thermal, "photons +#") / photons, 1, delta=1e-3)
        self.assertAlmostEqual(self.number(thermal, "electrons +#,") / photons / 0.7, 1, delta=1e-3)
        electrons = 0.7 * photons + self.number(thermal, "optics #,") + self.number(thermal, "current #")
        self.assertAlmostEqual(self.number(thermal, "filled +#") / (100 * electrons / 8e6), 1, delta=5e-3)
        noise = math.sqrt(electrons + 400**2 + (8e6 / 16333)**2 / 12)
        self.assertAlmostEqual(self.number(thermal, "SNR +#") / (0.7 * photons / noise), 1, delta=1e-3)
        nedl = mean_radiance(8, 9.5, 300) / (0.7 * photons / noise)
        self.assertAlmostEqual(self.number(thermal, "NEdL +#") / nedl, 1, delta=1e-3)
        slope = mean_radiance(8, 9.5, 300.5) - mean_radiance(8, 9.5, 299.5)
        self.assertAlmostEqual(self.number(thermal, "NEdT +# K at 300 K") / (nedl / slope), 1, delta=1e-3)
        self.assertIn("pixel 0.637, document's PSF 1.000", thermal)

    def test_what_differs_from_column_to_column(self):
        columns = 40
        document = {"ifov": 1, "scene": {"materials": {"ground": {"reflectance": 0.3}}, "objects": [{"plane": {}, "material": "ground"}]},
                    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [columns, 4]}},
                               "channels": [{"name": "a", "gaussian": {"center": "500 nm", "fwhm": "10 nm"}},
                                            {"name": "b", "gaussian": {"center": "900 nm", "fwhm": "12 nm"}}],
                               "smile": {"between": {"shortest": {"center": ["0 nm", "0 nm", "-2 nm"]},
                                                     "longest": {"center": ["0 nm", "1 nm"], "fwhm": ["0 nm", "0 nm", "0.5 nm"]}}},
                               "keystone": {"between": {"shortest": {"shift": ["0 px"]}, "longest": {"shift": ["0.25 px", "0.5 px"]}}}},
                    "sampling": {"single": {}}}
        out = self.told(json.dumps(document))
        last, middle = 1 - 1 / columns, 1 / columns  # the middles of columns, of -1 to 1
        a, b = out[out.index("a: "):out.index("b: ")], out[out.index("b: "):]
        self.assertAlmostEqual(self.number(a, "smile +# to"), 0.5 - 0.002 * last ** 2, delta=1e-6)
        self.assertAlmostEqual(self.number(a, "to # um, 0.01 to 0.01 um wide, by column"), 0.5 - 0.002 * middle ** 2, delta=1e-6)
        self.assertAlmostEqual(self.number(b, "smile +# to"), 0.9 - 0.001 * last, delta=1e-6)
        self.assertAlmostEqual(self.number(b, "to # um wide, by column"), 0.012 + 0.0005 * last ** 2, delta=1e-5)
        self.assertNotIn("keystone", a)
        self.assertAlmostEqual(self.number(b, "keystone +# to"), 0.25 - 0.5 * last, delta=1e-3)
        self.assertAlmostEqual(self.number(b, "to # pixels to the right"), 0.25 + 0.5 * last, delta=1e-3)
        self.assertNotIn("mosaic", out)
        del document["sensor"]["smile"], document["sensor"]["keystone"]
        self.assertNotRegex(self.told(json.dumps(document)), "smile|keystone")
        document["sensor"]["mosaic"] = [["a", "b"], ["b", "a"]]
        self.assertIn("\nmosaic (a, b), (b, a)\n", self.told(json.dumps(document)))

    def test_another_light(self):
        out = self.told(text(), "--set", 'sensor.detector.reference={"radiance": "20 W m-2 sr-1 um-1"}')
        self.assertIn("radiance     20 W m-2 sr-1 um-1\n", out)
        visible = text(sensor__channels=[{"name": "red", "top_hat": {"from": "0.6 um", "to": "0.7 um"}}],
                       sensor__optics__temperature=None, sensor__detector__dark_current=None,
                       sensor__detector__reference={"reflectance": 0.3, "sun_zenith": "60 deg"})
        radiance = self.number(self.told(visible), "radiance +# W")
        # Of the Sun some 1600 W m-2 um-1 there.
        self.assertAlmostEqual(radiance / (0.3 * 0.5 * 1585 / math.pi), 1, delta=0.02)

    def test_a_frame_camera_with_an_obscured_aperture(self):
        camera = {"frame": {"focal_length": "100 mm", "pitch": "10 um", "pixels": [64, 8], "position": ["0 m", "0 m", "1000 m"], "attitude": {}}}
        out = self.told(text(sensor__camera=camera, sensor__detector__pitch=None, sensor__optics={"aperture": "50 mm"},
                             sensor__channels=[{"name": "a", "gaussian": {"center": "5 um", "fwhm": "0.1 um"}}]))
        self.assertIn("64 x 8 pixels, GSD 0.1 m, swath 6.4 m, IFOV 100 urad, f/2\n", out)
        # A clear aperture: q = 5 um * 2 / 10 um = 1, s = 1/2.
        clear = 2 / math.pi * (math.acos(0.5) - 0.5 * math.sqrt(0.75))
        self.assertAlmostEqual(self.number(out, "diffraction #"), clear, delta=5e-4)

    def test_without_a_detector(self):
        out = self.told(text(sensor__optics=None, sensor__detector=None, sensor__channels=[
            {"name": "a", "top_hat": {"from": "10 um", "to": "11 um"}, "noise_temperature": "0.1 K"}, {"name": "b", "monochromatic": {"at": "0.5 um"}}]))
        self.assertIn("NEdT         0.1 K at 300 K\n", out)
        self.assertNotIn("electrons", out)

    def test_a_full_well_is_told(self):
        self.assertIn(" %, saturated\n", self.told(text(), "--set", 'sensor.detector.reference={"radiance": "2000 W m-2 sr-1 um-1"}'))
        self.assertNotIn("saturated", self.told(text()))

    def test_a_psf_wider_than_images_are_blurred(self):
        for psf, said in (('{"gaussian": {"sigma": "20 px"}}', "the PSF reaches 88 pixels from its middle"), ('{"gaussian": {"sigma": "12 px"}}', None)):
            with Folder(scene=text()) as folder:
                done = run("check", "scene.json", "--set", f"sensor.psf={psf}", cwd=folder)
            self.assertEqual(done.returncode, 1 if said else 0, done.stderr)
            if said:
                self.assertIn(said, done.stderr)
                self.assertIn("images are blurred within 64; expected a narrower one, or wider pixels", done.stderr)

    def test_mistakes_are_located(self):
        with Folder(scene=text(sensor__optics=None)) as folder:
            done = run("sensor", "scene.json", cwd=folder)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^scene\.json:\d+:\d+: a detector needs the sensor's 'optics'")


if __name__ == "__main__":
    unittest.main()
