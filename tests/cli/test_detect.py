"""`ifov detect`: noise on the radiance of a finished run, as a user meets it."""

import math
import re
import struct
import unittest

from program import Folder, run

WIDTH, HEIGHT = 120, 100
WARM = f"""{{
  "ifov": 1,
  "scene": {{"materials": {{"ground": {{"emissivity": 1, "temperature": "300 K"}}}}, "objects": [{{"plane": {{}}, "material": "ground"}}]}},
  "sensor": {{
    "camera": {{"orthographic": {{"gsd": "1 m", "pixels": [{WIDTH}, {HEIGHT}]}}}},
    "channels": [
      {{"name": "thermal", "monochromatic": {{"at": "10 um"}}, "noise_temperature": "0.05 K"}},
      {{"name": "middle", "monochromatic": {{"at": "4 um"}}, "noise": "0.002 W m-2 sr-1 um-1"}},
      {{"name": "still", "monochromatic": {{"at": "9 um"}}}}
    ]
  }},
  "sampling": {{"single": {{}}}},
  "output": {{"formats": ["envi"]}}
}}
"""
NO_NOISE = "no channel tells the sensor's noise: give the sensor a 'detector', or channels 'noise' (NEdL), 'noise_temperature' (NEdT) or 'snr'"
NOISELESS = WARM.replace(', "noise_temperature": "0.05 K"', "").replace(', "noise": "0.002 W m-2 sr-1 um-1"', "")


def planck(um, kelvin):
    """W m-2 sr-1 um-1, by the constants of the SI."""
    h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23
    m = um * 1e-6
    return 1e-6 * 2 * h * c * c / m**5 / math.expm1(h * c / (m * k * kelvin))


def kelvin(um, radiance):
    h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23
    m = um * 1e-6
    return h * c / (m * k * math.log1p(1e-6 * 2 * h * c * c / (m**5 * radiance)))


class Detect(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(warm=WARM, noiseless=NOISELESS, other=WARM.replace("0.05 K", "0.5 K"))
        cls.folder = cls._folder.__enter__()
        done = run("render", "warm.json", cwd=cls.folder)
        assert done.returncode in (0, 6), done.stderr
        run("render", "noiseless.json", cwd=cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__()

    def detect(self, *arguments):
        return run("detect", *arguments, cwd=self.folder)

    def band(self, name, band):
        values = (self.folder / name).read_bytes()
        rows = [struct.unpack_from(f"<{WIDTH}f", values, 4 * WIDTH * (3 * line + band)) for line in range(HEIGHT)]
        return [value for row in rows for value in row]

    def spread(self, values):
        mean = sum(values) / len(values)
        return math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))

    def test_a_warm_plane_shows_the_temperature_difference_that_was_told(self):
        done = self.detect("warm.out", "--seed", 7)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("still            tells no noise, and gets none\nwarm.out/image_noisy_7.img\n", done.stdout)
        temperatures = [kelvin(10.0, value) for value in self.band("warm.out/image_noisy_7.img", 0)]
        tolerance = 3 / math.sqrt(2 * len(temperatures))
        self.assertLess(abs(self.spread(temperatures) / 0.05 - 1), tolerance)
        self.assertLess(abs(sum(temperatures) / len(temperatures) - 300), 4 * 0.05 / math.sqrt(len(temperatures)))
        self.assertLess(abs(self.spread(self.band("warm.out/image_noisy_7.img", 1)) / 0.002 - 1), tolerance)
        self.assertEqual(self.band("warm.out/image_noisy_7.img", 2), self.band("warm.out/image_radiance.img", 2))

    def test_kelvins_are_those_of_the_radiance(self):
        done = self.detect("warm.out", "--seed", 3, "--quantity", "kelvins,radiance")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("data units = K", (self.folder / "warm.out/image_kelvins_3.img.hdr").read_text())
        for band, um in enumerate((10.0, 4.0, 9.0)):
            radiance, told = (self.band(f"warm.out/image_{what}_3.img", band) for what in ("noisy", "kelvins"))
            self.assertLess(max(abs(kelvin(um, l) - k) for l, k in zip(radiance, told)), 5e-4)
            # Planted fault: 0.1 % of radiance.
            self.assertGreater(max(abs(kelvin(um, 1.001 * l) - k) for l, k in zip(radiance, told)), 5e-3)

    def test_another_document_tells_another_noise(self):
        done = self.detect("warm.out/image_run.json", "--document", "other.json", "-o", "other")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        temperatures = [kelvin(10.0, value) for value in self.band("other/image_noisy_1.img", 0)]
        self.assertLess(abs(self.spread(temperatures) / 0.5 - 1), 3 / math.sqrt(2 * len(temperatures)))

    def test_the_record_tells_the_noise_wherever_it_lies(self):
        """Neither the document's files nor what was set on the command line are looked for again."""
        (self.folder / "nedl.csv").write_text("um,nedl\n3,0.002\n12,0.002\n")
        spectrum = '"noise": {"csv": "nedl.csv", "wavelength_unit": "um", "unit": "W m-2 sr-1 um-1"}'
        (self.folder / "filed.json").write_text(WARM.replace('"noise": "0.002 W m-2 sr-1 um-1"', spectrum))
        done = run("render", "filed.json", "--set", "sensor.channels[2].noise_temperature=0.1 K", cwd=self.folder)
        self.assertIn(done.returncode, (0, 6), done.stderr)
        (self.folder / "nedl.csv").unlink()
        done = run("detect", self.folder / "filed.out", cwd="/")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertLess(abs(self.spread(self.band("filed.out/image_noisy_1.img", 1)) / 0.002 - 1), 0.03)
        temperatures = [kelvin(9.0, value) for value in self.band("filed.out/image_noisy_1.img", 2)]
        self.assertLess(abs(self.spread(temperatures) / 0.1 - 1), 0.03)

    def test_bytes_depend_on_the_seed_alone(self):
        self.assertEqual(self.detect("warm.out", "-o", "one", "-j", 1, "--seed", 3, "--count", 2, "-q").stdout, "")
        self.detect("warm.out", "-o", "seven", "-j", 7, "--seed", 4, "-q")
        third, fourth = ((self.folder / f"one/image_noisy_{seed}.img").read_bytes() for seed in (3, 4))
        self.assertEqual(fourth, (self.folder / "seven/image_noisy_4.img").read_bytes())
        self.assertNotEqual(third, fourth)
        header = (self.folder / "one/image_noisy_3.img.hdr").read_text()
        slope = 0.05 * (planck(10.0, 300.005) - planck(10.0, 299.995)) / 0.01
        told = re.search(r"noise standard deviation = \{([^}]*)\}", header).group(1).split(", ")
        self.assertAlmostEqual(float(told[0]) / slope, 1, places=4)
        self.assertEqual(told[1:], ["0.002", "0"])
        self.assertIn("wavelength = {10, 4, 9}", header)
        info = run("info", "one/image_noisy_3.img", cwd=self.folder)
        self.assertEqual((info.returncode, info.stderr), (0, ""))
        self.assertIn("image_radiance.img with the sensor's noise drawn by ifov detect, seed 3", info.stdout)

    def test_mistakes(self):
        for arguments, text in (
            (["warm.json"], "expected a folder of products or a run record (NAME_run.json); found 'warm.json'"),
            (["nothing"], "there is no 'nothing'"),
            (["noiseless.out"], "noiseless.out/image_run.json: " + NO_NOISE + "; or name another document whose channels do"),
            (["warm.out", "--document", "noiseless.json"],
             "noiseless.json:7:7: " + NO_NOISE),
            (["warm.out", "--document", "shifted.json"],
             "warm.out/image_radiance.img: band 1 is at 10 um, channel 'thermal' of shifted.json at 10.1 um; expected the same channels in the same order (within 0.001 um)"),
            (["warm.out", "--document", "fewer.json"],
             "warm.out/image_radiance.img: 3 bands, but the sensor of fewer.json has 2 channels"),
        ):
            (self.folder / "shifted.json").write_text(WARM.replace("10 um", "10.1 um"))
            (self.folder / "fewer.json").write_text(re.sub(r',\n\s*\{"name": "still".*\n', "\n", WARM))
            with self.subTest(arguments):
                done = self.detect(*arguments, "-o", "mistaken")
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(text, done.stderr)
                self.assertFalse((self.folder / "mistaken").exists())


if __name__ == "__main__":
    unittest.main()
