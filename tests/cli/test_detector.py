"""Detectors in documents: what `ifov detect` makes of their electrons, and what is wrong with those that cannot be."""

import json
import math
import re
import struct
import unittest

from program import Folder, run

WIDTH, HEIGHT = 120, 100
DOCUMENT = {
    "ifov": 1,
    "scene": {"materials": {"ground": {"emissivity": 1, "temperature": "300 K"}}, "objects": [{"plane": {}, "material": "ground"}]},
    "sensor": {
        "camera": {"orthographic": {"gsd": "1 m", "pixels": [WIDTH, HEIGHT]}},
        "optics": {"f_number": 2, "obscuration": 0.3, "throughput": 0.8, "temperature": "280 K"},
        "detector": {"pitch": "15 um", "integration_time": "0.2 ms", "quantum_efficiency": 0.7, "dark_current": "1e9 e-/s",
                     "read_noise": "400 e-", "full_well": "8e6 e-", "bits": 14, "offset": 50},
        "channels": [{"name": "thermal", "top_hat": {"from": "8 um", "to": "9.5 um"}},
                     {"name": "long", "top_hat": {"from": "10 um", "to": "11 um"},
                      "detector": {"integration_time": "0.1 ms", "read_noise": "900 e-"}}]},
    "sampling": {"single": {}},
    "output": {"formats": ["envi"]},
}
H, C, K = 6.62607015e-34, 299792458.0, 1.380649e-23


def planck(um, kelvin):
    """W m-2 sr-1 um-1."""
    m = um * 1e-6
    return 1e-6 * 2 * H * C * C / m**5 / math.expm1(H * C / (m * K * kelvin))


def integral(function, low, high, steps=2000):
    """By Simpson's rule."""
    h = (high - low) / steps
    return h / 3 * sum((1 if i in (0, steps) else 4 if i % 2 else 2) * function(low + i * h) for i in range(steps + 1))


def mean_radiance(low, high, kelvin):
    return integral(lambda um: planck(um, kelvin), low, high) / (high - low)


def changed(**changes):
    """The document with the values of dotted keys replaced (None: taken away)."""
    document = json.loads(json.dumps(DOCUMENT))
    for key, value in changes.items():
        *path, last = key.split("__")
        node = document
        for step in path:
            node = node[int(step)] if step.isdigit() else node.setdefault(step, {})
        if isinstance(node, list):
            node[int(last)] = value
        elif value is None:
            node.pop(last, None)
        else:
            node[last] = value
    return document


def text(**changes):
    return json.dumps(changed(**changes), indent=1)


class Detector(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(warm=text())
        cls.folder = cls._folder.__enter__()
        done = run("render", "warm.json", cwd=cls.folder)
        assert done.returncode in (0, 6), done.stderr  # 6: all pixels hold the same value
        cls.record = json.loads((cls.folder / "warm.out/image_run.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__()

    def detect(self, *arguments):
        done = run("detect", *arguments, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def band(self, name, band, code="f", bands=2):
        values = (self.folder / name).read_bytes()
        size = struct.calcsize(code) * WIDTH
        rows = [struct.unpack_from(f"<{WIDTH}{code}", values, size * (bands * line + band)) for line in range(HEIGHT)]
        return [value for row in rows for value in row]

    def mean_and_spread(self, values):
        mean = sum(values) / len(values)
        return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))

    def expected(self, low, high, seconds, read, kelvin=300.0):
        """Electrons of the scene, of warm optics and of dark current; electrons per radiance; noise as a radiance."""
        throughput = 225e-12 * math.pi * (1 - 0.09) / 16
        per_joule = 1e-6 / (H * C)
        per_radiance = throughput * seconds * 0.8 * 0.7 * per_joule * integral(lambda um: um, low, high)
        warm = throughput * seconds * 0.2 * 0.7 * per_joule * integral(lambda um: um * planck(um, 280.0), low, high)
        scene = per_radiance * mean_radiance(low, high, kelvin)
        gain = 8e6 / (2**14 - 1 - 50)
        noise = math.sqrt(scene + warm + 1e9 * seconds + read**2 + gain**2 / 12)
        return scene, warm, 1e9 * seconds, per_radiance, noise / per_radiance

    def test_the_record_holds_what_the_formulas_say(self):
        for channel, (low, high, seconds, read) in zip(self.record["channels"], ((8, 9.5, 2e-4, 400), (10, 11, 1e-4, 900))):
            _, warm, dark, per_radiance, noise = self.expected(low, high, seconds, read)
            self.assertAlmostEqual(channel["detector"]["electrons_per_radiance"] / per_radiance, 1, places=6)
            self.assertAlmostEqual(channel["detector"]["background"] / warm, 1, places=6)
            self.assertAlmostEqual(channel["detector"]["dark"] / dark, 1, places=9)
            self.assertAlmostEqual(channel["noise"] / noise, 1, places=6)
            self.assertEqual(channel["detector"]["read_noise"], read)

    def test_a_warm_plane_shows_its_noise_as_a_temperature(self):
        out = self.detect("warm.out", "--seed", 7)
        self.assertRegex(out, r"thermal +noise [0-9.]+ W m-2 sr-1 um-1 at the detector's reference\n")
        for band, (low, high, seconds, read) in enumerate(((8, 9.5, 2e-4, 400), (10, 11, 1e-4, 900))):
            noise = self.expected(low, high, seconds, read)[4]
            slope = (mean_radiance(low, high, 300.5) - mean_radiance(low, high, 299.5))
            values = self.band("warm.out/image_noisy_7.img", band)
            mean, spread = self.mean_and_spread(values)
            tolerance = 3 / math.sqrt(2 * len(values))
            self.assertLess(abs(spread / slope / (noise / slope) - 1), tolerance)
            self.assertGreater(abs(spread / (1.05 * noise) - 1), tolerance, "5 % more would not be seen")
            self.assertLess(abs(mean - mean_radiance(low, high, 300.0)), 4 * noise / math.sqrt(len(values)) + 1e-5 * mean)

    def test_electrons_and_counts_are_those_of_the_radiance(self):
        self.detect("warm.out", "--quantity", "electrons,counts,radiance", "-o", "all")
        scene, warm, dark, per_radiance, noise = self.expected(8, 9.5, 2e-4, 400)
        electrons, counts = self.band("all/image_electrons_1.img", 0), self.band("all/image_counts_1.img", 0, "H")
        mean, spread = self.mean_and_spread(electrons)
        self.assertLess(abs(mean - scene - warm - dark), 4 * spread / math.sqrt(len(electrons)) + 1e-5 * mean)
        gain = 8e6 / (2**14 - 1 - 50)
        for electron, count in zip(electrons[:200], counts):
            self.assertLessEqual(abs(50 + electron / gain - count), 0.501)
        header = (self.folder / "all/image_counts_1.img.hdr").read_text()
        self.assertIn("data type = 12\n", header)
        self.assertIn("data units = counts\n", header)
        told = [[float(value) for value in re.search(rf"data {what} values = {{(.*)}}", header).group(1).split(", ")]
                for what in ("gain", "offset")]
        for value, count in zip(self.band("all/image_noisy_1.img", 0), counts):
            self.assertAlmostEqual(told[0][0] * count + told[1][0], value, places=5)
        info = run("info", "all/image_counts_1.img", cwd=self.folder)
        self.assertEqual((info.returncode, info.stderr), (0, ""))

    def test_bytes_are_the_same_for_any_threads(self):
        """Patterns, faults and 1/f noise, too."""
        settings = {"prnu": "1 %", "dsnu": "50 e-", "column_offset": "100 e-", "row_gain": "0.1 %", "one_over_f": "0.1", "dead": "1 %"}
        sets = [word for key, value in settings.items() for word in ("--set", f"sensor.detector.{key}={value}")]
        for threads in (1, 7):
            self.detect("warm.out", "-o", f"threads{threads}", "-j", threads, *sets, "--quantity", "radiance,counts", "--count", 2)
        for name in ("noisy_1", "noisy_2", "counts_1", "counts_2"):
            one, seven = ((self.folder / f"threads{n}/image_{name}.img").read_bytes() for n in (1, 7))
            self.assertEqual(one, seven)
        self.assertNotEqual((self.folder / "threads1/image_noisy_1.img").read_bytes(), (self.folder / "threads1/image_noisy_2.img").read_bytes())

    def test_settings_in_place_of_those_of_the_run(self):
        self.detect("warm.out", "-o", "short", "--set", "sensor.detector.integration_time=0.05 ms")
        noise = self.expected(8, 9.5, 0.5e-4, 400)[4]
        values = self.band("short/image_noisy_1.img", 0)
        self.assertLess(abs(self.mean_and_spread(values)[1] / noise - 1), 3 / math.sqrt(2 * len(values)))

    def test_what_is_saturated_is_told(self):
        out = self.detect("warm.out", "-o", "full", "--set", "sensor.detector.integration_time=0.8 ms")
        self.assertIn("thermal          noise", out)
        self.assertRegex(out, r"thermal .*; 100 % of pixels are saturated\n")
        self.assertNotIn("saturated", [line for line in out.splitlines() if line.startswith("long")][0])

    def test_errors_in_shares_of_the_noise_take_the_detectors(self):
        (self.folder / "share.json").write_text(text(sampling={"accuracy": {"error": "0.5 noise"}}))
        done = run("render", "share.json", cwd=self.folder)
        self.assertIn(done.returncode, (0, 6), done.stderr)
        record = json.loads((self.folder / "share.out/image_run.json").read_text())
        self.assertEqual(record["accuracy"]["pixels_converged"], WIDTH * HEIGHT)
        self.assertIn("0.5 of the sensor's noise", record["accuracy"]["asked"])

    def test_a_ratio_is_a_noise(self):
        (self.folder / "ratio.json").write_text(text(
            sensor__optics=None, sensor__detector=None,
            sensor__channels=[{"name": "a", "top_hat": {"from": "8 um", "to": "9 um"},
                               "snr": {"ratio": 400, "radiance": "8 W m-2 sr-1 um-1"}}]))
        self.assertIn(run("render", "ratio.json", cwd=self.folder).returncode, (0, 6))
        self.assertIn("a                noise 0.02 W m-2 sr-1 um-1\n", self.detect("ratio.out"))

    def test_mistakes(self):
        camera = {"frame": {"focal_length": "50 mm", "pitch": "12 um", "pixels": [8, 8], "position": ["0 m", "0 m", "100 m"],
                            "attitude": {}}}
        detector, optics = "sensor__detector__", "sensor__optics__"
        for changes, said in (
            ({"sensor__channels__0__noise_temperature": "0.1 K"},
             "channel 'thermal' states its noise by 'noise_temperature', and its noise also follows from the 'detector': leave one of the two out"),
            ({"sensor__channels__0": {"name": "line", "monochromatic": {"at": "9 um"}}},
             "channel 'line' is a single wavelength, through which no light falls on a detector: give it a width"),
            ({"sensor__optics": None}, "a detector needs the sensor's 'optics', which say how much light falls on it"),
            ({detector + "pitch": None}, "the detector has no pitch: give it 'pitch'"),
            ({detector + "integration_time": None}, "the detector has no integration time: give it 'integration_time'"),
            ({detector + "quantum_efficiency": None}, "the detector has no quantum efficiency: give it 'quantum_efficiency'"),
            ({optics + "f_number": None}, "the optics do not say how fast they are: give 'f_number', or 'aperture' and 'focal_length'"),
            ({optics + "aperture": "25 mm", optics + "focal_length": "60 mm"},
             "optics.f_number is 2, and focal length and aperture make 2.4: leave one of the three out"),
            ({"sensor__camera": camera}, "detector.pitch is 15 um, and the camera's pitch 12 um: leave it out"),
            ({"sensor__camera": camera, detector + "pitch": None, optics + "focal_length": "60 mm"},
             "optics.focal_length is 60 mm, and the camera's 50 mm: leave it out"),
            ({"sensor__camera": camera, detector + "pitch": None, optics + "aperture": "20 mm"},
             "optics.f_number is 2, and the camera's focal length and the aperture make 2.5: leave one of them out"),
            ({detector + "bits": None}, "'gain' and 'offset' are of counts, and the detector makes none: give it 'bits'"),
            ({detector + "bits": None, detector + "offset": None, detector + "full_well": None},
             "the detector of channel 'thermal' is never saturated: give it 'full_well', or 'bits' and 'gain'"),
            ({detector + "bits": 4}, "4 bits hold counts up to 15, and the offset is 50 counts: give more bits, or less offset"),
            ({detector + "full_well": None}, "give 'gain', or a 'full_well' that the largest count stands for"),
            ({detector + "gain": "100 e-/count"},
             "14 bits hold counts up to 16383, and a full well of 8e+06 e- makes 80050 at 100 e-/count and an offset of 50: give more "
             "bits, a gain of 489.8 e-/count or more, or a full_well of 1.633e+06 e- or less"),
            ({detector + "dark_current": "1e11 e-/s"}, "the detector of channel 'thermal' is always saturated: without any light from the scene, dark current makes 2e+07 electrons"),
            ({detector + "full_well": None, detector + "gain": "500 e-/count", detector + "nonlinearity": "1 %"},
             "'nonlinearity' is what is missing at the full well: give the detector 'full_well'"),
            ({detector + "dead": 0.7, detector + "hot": {"share": 0.7, "dark_current": "1 nA"}}, "more elements are dead or hot than there are"),
            ({detector + "quantum_efficiency": {"table": {"wavelength": ["1 um", "5 um"], "values": [0.5, 0.5]}}}, "quantum efficiency"),
            ({optics + "throughput": 0}, "no light of channel 'thermal' becomes an electron: throughput or quantum efficiency are 0 there"),
            ({detector + "one_over_f": 0.1, detector + "read_noise": None}, "one_over_f"),
        ):
            with self.subTest(said):
                (self.folder / "mistaken.json").write_text(text(**changes))
                done = run("check", "mistaken.json", cwd=self.folder)
                self.assertEqual(done.returncode, 1)
                self.assertIn(said, done.stderr)
                self.assertRegex(done.stderr, r"^mistaken\.json:\d+:\d+: ")

    def test_mistaken_quantities(self):
        (self.folder / "plain.json").write_text(text(
            sensor__optics=None, sensor__detector=None,
            sensor__channels=[{"name": "a", "top_hat": {"from": "8 um", "to": "9 um"}, "noise_temperature": "0.1 K"}]))
        run("render", "plain.json", cwd=self.folder)
        for arguments, said in (
            (["plain.out", "--quantity", "electrons"],
             "plain.out/image_run.json: channel 'a' has no 'detector' that makes electrons: ask for radiance"),
            (["warm.out", "--quantity", "counts", "--set", "sensor.detector.bits=null", "--set", "sensor.detector.offset=null"],
             "the detector of channel 'thermal' makes no counts: give it 'bits', or ask for electrons"),
            (["warm.out", "--quantity", "volts"], "volts"),
        ):
            with self.subTest(said):
                done = run("detect", *arguments, "-o", "mistaken", cwd=self.folder)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
