"""`ifov atmosphere --invert`: radiance becomes the reflectance that it was rendered of; what is said of cubes that cannot."""

import json
import re
import shutil
import struct
import unittest

from program import Folder, run

GROUND = 0.35
# Centres and full widths at half maximum, nm, of some bands: Landsat 8 OLI, Sentinel-2 MSI, two spectrometers.
SENSORS = {
    "oli": [(443, 16), (482, 60), (561, 57), (865, 28), (2201, 187)],
    "msi": [(443, 21), (665, 31), (945, 20), (2202, 175)],
    "enmap": [(420, 7), (680, 7), (1240, 11), (2100, 11)],
    "hyperspectral": [(404, 10), (531, 10), (1042, 10), (1552, 10)],
}

# The air of narrow channels takes less time, where it is not what is looked at.
NARROW = [(443, 4), (482, 4), (561, 5)]


def document(bands, ground=GROUND, extra=None, objects=None, pixels=(3, 2)):
    channels = [{"name": f"b{k + 1}", "gaussian": {"center": f"{c} nm", "fwhm": f"{w} nm"}} for k, (c, w) in enumerate(bands)]
    return json.dumps({
        "ifov": 1,
        "scene": {"materials": {"ground": {"reflectance": ground, "temperature": "288 K"},
                                "dark": {"reflectance": 0.1, "temperature": "288 K"}},
                  "objects": objects or [{"plane": {}, "material": "ground"}]},
        "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "150 deg"}}},
        "atmosphere": {"profile": "mid-latitude summer", "aerosol": {"type": "rural", "visibility": "30 km"}, "interval": "numerical"},
        "sensor": {"camera": {"orthographic": {"gsd": "10 m", "pixels": list(pixels)}}, "channels": channels + (extra or [])},
        "sampling": {"accuracy": {"error": "1 %", "channel": "b2"}},
        "output": {"folder": "out"}})


def cube(path, bands, pixels=6):
    """[band][pixel] of a BIL cube of 3 x 2 pixels."""
    values = struct.unpack(f"<{bands * pixels}f", path.read_bytes())
    return [[values[(y * bands + b) * 3 + x] for y in range(pixels // 3) for x in range(3)] for b in range(bands)]


class RoundTrip(unittest.TestCase):
    def closes(self, sensor):
        bands = SENSORS[sensor]
        with Folder(air=document(bands)) as folder:
            done = run("render", "air.json", "--quiet", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            done = run("atmosphere", "air.json", "--invert", "out", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("image_reflectance.img  (surface reflectance, ENVI)", done.stdout)
            found = cube(folder / "out/image_reflectance.img", len(bands))
            wide = cube(folder / "out/image_reflectance_half_width.img", len(bands))
            header = (folder / "out/image_reflectance.img.hdr").read_text()
        self.assertIn("ifov interval = {intervals hold the error of the air's numbers, not of its model", header)
        self.assertIn("data units = 1\n", header)
        for (centre, _), values, widths in zip(bands, found, wide):
            for value, width in zip(values, widths):
                self.assertTrue(0 < width < 1, (centre, width))
                self.assertLess(abs(value - GROUND), 0.002, f"{sensor} at {centre} nm: {value} +- {width}")

    def test_oli(self):
        self.closes("oli")

    def test_msi(self):
        self.closes("msi")

    def test_enmap(self):
        self.closes("enmap")

    def test_hyperspectral(self):
        self.closes("hyperspectral")

    def test_other_air_does_not_close(self):
        bands = NARROW
        with Folder(air=document(bands), other=document(bands).replace("30 km", "10 km")) as folder:
            run("render", "air.json", "--quiet", cwd=folder)
            done = run("atmosphere", "other.json", "--invert", "out", "--to", "other", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = cube(folder / "other_reflectance.img", len(bands))
        self.assertGreater(abs(found[0][0] - GROUND), 0.002)


class Intervals(unittest.TestCase):
    def test_hold_the_model_unless_the_document_says_otherwise(self):
        bands = NARROW
        plain = document(bands)
        with Folder(air=plain, model=plain.replace(', "interval": "numerical"', "")) as folder:
            run("render", "air.json", "--quiet", cwd=folder)
            for name in ("air", "model"):
                done = run("atmosphere", f"{name}.json", "--invert", "out", "--to", name, "--quiet", cwd=folder)
                self.assertIn(done.returncode, (0, 6), done.stderr)
            air, model = (cube(folder / f"{name}_reflectance_half_width.img", len(bands)) for name in ("air", "model"))
            # Of a cube that says nothing of its error it is the air's alone.
            (folder / "out/image_half_width.img").unlink()
            run("atmosphere", "air.json", "--invert", "out", "--to", "alone", "--quiet", cwd=folder)
            alone = cube(folder / "alone_reflectance_half_width.img", len(bands))
        for b in range(len(bands)):
            self.assertGreater(model[b][0], 2 * air[b][0])
            self.assertTrue(0 < alone[b][0] < 1.001 * air[b][0])

    def test_hold_what_the_samples_err_by(self):
        """Ground that is not uniform: every pixel between its darkest and its brightest, within its interval."""
        bands = NARROW
        objects = [{"plane": {}, "material": "ground"},
                   {"box": {"low": ["-10 m", "-10 m", "0 m"], "high": ["0 m", "0 m", "1 mm"]}, "material": "dark"}]
        with Folder(air=document(bands, objects=objects)) as folder:
            run("render", "air.json", "--quiet", cwd=folder)
            done = run("atmosphere", "air.json", "--invert", "out", "--quiet", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = cube(folder / "out/image_reflectance.img", len(bands))
            wide = cube(folder / "out/image_reflectance_half_width.img", len(bands))
        for values, widths in zip(found, wide):
            self.assertLess(min(values), 0.3)
            for value, width in zip(values, widths):
                self.assertTrue(0.1 - width < value < GROUND + 0.01 + width, (value, width))


class WhatIsSaid(unittest.TestCase):
    BANDS = NARROW

    @classmethod
    def setUpClass(cls):
        cls.made = Folder(air=document(cls.BANDS))
        done = run("render", "air.json", "--quiet", cwd=cls.made.path)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.made.__exit__()

    def rendered(self, folder):
        """The same document is rendered once, and its air kept."""
        if (folder / "air.json").read_text() == (self.made.path / "air.json").read_text():
            shutil.copytree(self.made.path, folder, dirs_exist_ok=True)
            return
        done = run("render", "air.json", "--quiet", cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def refused(self, header_change, expected, text=None):
        with Folder(air=text or document(self.BANDS)) as folder:
            self.rendered(folder)
            header = folder / "out/image_radiance.img.hdr"
            header.write_text(header_change(header.read_text()))
            done = run("atmosphere", "air.json", "--invert", "out/image_radiance.img", cwd=folder)
            self.assertNotIn(done.returncode, (0, 6))
            self.assertIn(expected, done.stderr)
            self.assertFalse((folder / "out/image_reflectance.img").exists())

    def test_no_wavelengths(self):
        self.refused(lambda text: re.sub(r"(?s)\nwavelength = \{.*?\}", "", text),
                     "out/image_radiance.img: its header has no wavelengths (field 'wavelength'): expected one for each of the 3 bands")

    def test_other_channels(self):
        self.refused(lambda text: text.replace("0.561", "0.58"), "band 3 is at 0.58 um, channel 'b3' of air.json at 0.561 um")

    def test_no_radiance(self):
        self.refused(lambda text: text.replace("data units = W m-2 sr-1 um-1", "data units = 1"), "its values are in '1': expected W m-2 sr-1 um-1")

    def test_a_thermal_channel_alone(self):
        thermal = '[{"name": "b2", "top_hat": {"from": "10 um", "to": "11 um"}}, {"name": "b4", "top_hat": {"from": "11 um", "to": "12 um"}}]'
        text = json.loads(document(self.BANDS))
        text["sensor"]["channels"] = json.loads(thermal)
        self.refused(lambda text: text, "no channel of air.json sees sunlight that ground reflects, apart from what it emits",
                     json.dumps(text))

    def test_a_thermal_channel_beside_others(self):
        extra = [{"name": "warm", "top_hat": {"from": "10 um", "to": "11 um"}}]
        with Folder(air=document(self.BANDS, extra=extra)) as folder:
            self.rendered(folder)
            done = run("atmosphere", "air.json", "--invert", "out", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("No reflectance (not a number) of 'warm'", done.stdout)
            found = cube(folder / "out/image_reflectance.img", 4)
        self.assertNotEqual(found[3][0], found[3][0])
        self.assertAlmostEqual(found[1][0], GROUND, delta=0.002)

    def test_darker_than_the_path(self):
        with Folder(air=document(self.BANDS)) as folder:
            self.rendered(folder)
            image = folder / "out/image_radiance.img"
            data = bytearray(image.read_bytes())
            data[12:16] = struct.pack("<f", 1.0)  # the first pixel in the second band
            image.write_bytes(data)
            done = run("atmosphere", "air.json", "--invert", "out", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("1 of 18 values are darker than the path alone, most in 'b2': their reflectance is negative, and kept.", done.stdout)
            self.assertLess(cube(folder / "out/image_reflectance.img", 3)[1][0], 0.0)


if __name__ == "__main__":
    unittest.main()
