"""Reflectance at the sensor and brightness temperature as products, with their half-widths, against closed forms: white planes under
a Sun of a known spectrum, black ones of a known temperature, and Planck's law integrated and inverted here."""

import json
import math
import pathlib
import subprocess
import tempfile
import unittest

from images import PROGRAM, np, run

WORDS = ["half_width", "toa_reflectance", "toa_reflectance_half_width", "brightness_temperature", "brightness_temperature_half_width"]
CHANNELS = [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
            {"name": "thermal", "top_hat": {"from": "10 um", "to": "12 um"}}]
ZENITH = math.radians(40.0)


def document(reflectance=0.25, kelvin=305.0, sun=True, **more):
    """A plane and a sphere on it; sunlight rises linearly with wavelength, so that a Gaussian channel has what its middle has."""
    scene = {"materials": {"plane": {"reflectance": reflectance, "temperature": f"{kelvin} K"},
                           "ball": {"reflectance": 0.8, "temperature": "330 K"}},
             "objects": [{"plane": {}, "material": "plane"},
                         {"hemisphere": {"center": ["0 m", "0 m", "0 m"], "radius": "2 m"}, "material": "ball"}]}
    described = {"ifov": 1, "scene": scene,
                 "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [12, 8]}}, "channels": CHANNELS},
                 "sampling": {"accuracy": {"error": "3 %"}, "tile": 8}, "output": {"formats": ["envi"], "products": WORDS}}
    if sun:
        described["light"] = {"sun": {"point": {
            "zenith": "40 deg", "azimuth": "135 deg", "distance": "1.25 au",
            "spectrum": {"table": {"wavelength": ["0.2 um", "20.2 um"], "values": ["1000 W m-2 um-1", "3000 W m-2 um-1"]}}}}}
    described.update(more)
    return described


def planck(um, kelvin):
    first, second = 1.191042972e8, 14387.76877
    return first / um**5 / np.expm1(second / (um * kelvin))


def kelvin_of(radiance):
    """Of the thermal channel, by bisection over the mean of Planck's law over it."""
    um = np.linspace(10.0, 12.0, 4001)
    mean = lambda kelvin: np.trapz(planck(um, kelvin), um) / 2.0
    low, high = 1.0, 2000.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean(middle) < radiance else (low, middle)
    return low


@unittest.skipIf(np is None, "numpy is missing")
class ConvertedRadiance(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def rendered(self, described, *more, out="out", codes=(0, 5, 6)):
        done = run(described, self.folder, *more)
        self.assertIn(done.returncode, codes, done.stderr)
        return {word: self.cube(word, out) for word in ["radiance", *WORDS] if (self.folder / out / f"image_{word}.img").exists()}, done

    def cube(self, word, out="out"):
        return np.fromfile(self.folder / out / f"image_{word}.img", "<f4").reshape(8, 2, 12).astype(float)

    def test_reflectance_is_over_sunlight_above_the_air(self):
        found, _ = self.rendered(document())
        sunlight = (1000.0 + (0.65 - 0.2) * 100.0) / 1.25**2 * math.cos(ZENITH)
        np.testing.assert_allclose(found["toa_reflectance"][:, 0], math.pi * found["radiance"][:, 0] / sunlight, rtol=1e-5)
        np.testing.assert_allclose(found["toa_reflectance_half_width"][:, 0], math.pi * found["half_width"][:, 0] / sunlight, rtol=1e-5)
        self.assertGreater(found["toa_reflectance_half_width"].max(), 0.0)
        record = json.loads((self.folder / "out/image_run.json").read_text())
        self.assertAlmostEqual(record["channels"][0]["toa_irradiance"], sunlight, delta=1e-3 * sunlight / 100)
        header = (self.folder / "out/image_toa_reflectance.img.hdr").read_text()
        self.assertIn("z plot titles = {Wavelength (Micrometers), Reflectance at the sensor (1)}", header)
        self.assertIn("toa irradiance (W m-2 um-1) = {", header)
        # Open ground alone has its own reflectance: it is not dimmed by distance or zenith.
        bare = document()
        del bare["scene"]["objects"][1]
        found, _ = self.rendered(bare)
        np.testing.assert_allclose(found["toa_reflectance"][:, 0], 0.25, rtol=2e-6)

    def test_temperature_is_by_the_response(self):
        found, _ = self.rendered(document(reflectance=0.0, kelvin=305.0, sun=False, output={"formats": ["envi"], "products": WORDS[:1] + WORDS[3:]}))
        kelvin, half = found["brightness_temperature"][:, 1], found["brightness_temperature_half_width"][:, 1]
        self.assertAlmostEqual(kelvin[7, 11], 305.0, delta=2e-3)
        radiance, reach = found["radiance"][:, 1], found["half_width"][:, 1]
        for place in ((0, 0), (3, 5), (4, 4), (3, 3), (7, 11)):
            expected = kelvin_of(radiance[place])
            self.assertAlmostEqual(kelvin[place], expected, delta=2e-3)
            widest = max(kelvin_of(radiance[place] + reach[place]) - expected, expected - kelvin_of(radiance[place] - reach[place]))
            self.assertAlmostEqual(half[place], widest, delta=2e-3)
        self.assertGreater(half.max(), 0.01)

    def test_products_of_shares_and_of_runs_that_go_on_are_the_same(self):
        whole, _ = self.rendered(document())
        for share in ("1/2", "2/2"):
            done = subprocess.run([PROGRAM, "render", "scene.json", "--tiles", share, "-o", "share" + share[0]], cwd=self.folder,
                                  capture_output=True, text=True, check=False)
            self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        done = subprocess.run([PROGRAM, "merge", "share1", "share2", "-o", "merged"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        for word in WORDS:
            np.testing.assert_array_equal(self.cube(word, "merged"), whole[word], word)

    def test_noise_is_drawn_as_reflectance(self):
        noisy = document()
        noisy["sensor"] = {**noisy["sensor"], "channels": [{**channel, "noise": "0.5 W m-2 sr-1 um-1"} for channel in CHANNELS]}
        self.rendered(noisy)
        drawn = lambda folder: subprocess.run([PROGRAM, "detect", folder, "--seed", "5", "--quantity", "radiance,toa_reflectance"],
                                              cwd=self.folder, capture_output=True, text=True, check=False)
        done = drawn("out")
        self.assertEqual(done.returncode, 0, done.stderr)
        sunlight = (1000.0 + (0.65 - 0.2) * 100.0) / 1.25**2 * math.cos(ZENITH)
        np.testing.assert_allclose(self.cube("toa_reflectance_5")[:, 0], math.pi * self.cube("noisy_5")[:, 0] / sunlight, rtol=1e-5)
        self.assertIn("data units = 1", (self.folder / "out/image_toa_reflectance_5.img.hdr").read_text())
        noisy["light"]["sun"]["point"]["zenith"] = "95 deg"
        self.rendered({**noisy, "output": {"products": ["samples"]}}, "--set", "output.name=image", out="out")
        done = drawn("out")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the run tells no sunlight above the air in channel 'red', which reflectance at the sensor is over: ask for radiance",
                      done.stderr)

    def test_no_sun_no_reflectance(self):
        night = document()
        night["light"]["sun"]["point"]["zenith"] = "95 deg"
        found, done = self.rendered(night)
        self.assertNotIn("toa_reflectance", found)
        self.assertIn("brightness_temperature", found)
        self.assertIn("there will be no 'toa_reflectance' and 'toa_reflectance_half_width': the Sun is below the horizon", done.stderr)
        found, done = self.rendered({**night, "output": {"formats": ["envi"], "products": ["all"]}})
        self.assertNotIn("toa_reflectance", found)
        self.assertNotIn("there will be no", done.stderr)

    def test_what_it_takes_is_told(self):
        _, done = self.rendered(document(sun=False), codes=(1,))
        self.assertIn("output.products has 'toa_reflectance' and 'toa_reflectance_half_width': that takes sunlight above the air, and "
                      "light.sun is not given", done.stderr)
        self.assertRegex(done.stderr, r"scene\.json:\d+:\d+")
        _, done = self.rendered(document(atmosphere={"uniform": {"direct": "900 W m-2 um-1", "diffuse": "100 W m-2 um-1"}}), codes=(1,))
        self.assertIn("that takes sunlight above the air, and atmosphere.uniform tells of sunlight at the ground alone", done.stderr)


if __name__ == "__main__":
    unittest.main()
