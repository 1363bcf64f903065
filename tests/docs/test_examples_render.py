"""Examples of surfaces, rendered small: what their pages say of them is to be seen."""

import array
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("IFOV_PROGRAM", "ifov")
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
TYPES = {"4": "f", "5": "d"}


def band(path, index, bands):
    """One band of an ENVI cube that is interleaved by line, as lists of a line each."""
    header = path.with_suffix(".img.hdr").read_text()
    key = {name: re.search(rf"^{name}\s*=\s*(\S+)", header, re.MULTILINE).group(1)
           for name in ("samples", "lines", "bands", "data type", "interleave")}
    assert key["interleave"] == "bil" and int(key["bands"]) == bands, key
    values = array.array(TYPES[key["data type"]])
    values.frombytes(path.read_bytes())
    width, lines = int(key["samples"]), int(key["lines"])
    return [values[(line * bands + index) * width:(line * bands + index + 1) * width].tolist() for line in range(lines)]


class ExamplesOfSurfaces(unittest.TestCase):
    def render(self, name, pixels, pitch, *more):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        settings = [f"sensor.camera.frame.pixels={pixels}", f"sensor.camera.frame.pitch={pitch}",
                    "sampling.accuracy=null", 'sampling.grid={"elements": [4, 4]}', 'output.formats=["envi"]', *more]
        command = [PROGRAM, "render", str(EXAMPLES / f"{name}.json"), "-o", folder.name + "/out"]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return pathlib.Path(folder.name) / "out"

    def test_dark_lacquer_polarizes_and_the_lawn_does_not(self):
        out = self.render("car_park", [28, 14], "0.9 mm")
        near_infrared = band(out / "image_dolp.img", 2, 3)
        self.assertTrue(0.25 < max(map(max, near_infrared)) < 0.7, near_infrared)
        self.assertLess(near_infrared[0][14], 0.02)

    def test_wind_spreads_the_glint(self):
        at_centre = {}
        for wind in (3, 13):
            out = self.render("lake", [18, 10], "2.5 mm", f"scene.materials.lake.scattering.sea.wind={wind}")
            red = band(out / "image_radiance.img", 2, 4)
            at_centre[wind] = red[5][9]
            self.assertGreater(red[5][9], red[5][3])
        self.assertGreater(at_centre[3], 2.0 * at_centre[13])

    def test_coated_panes_mirror_the_cold_sky(self):
        out = self.render("glass_tower", [30, 40], "1.04 mm")
        at_10_um = band(out / "image_radiance.img", 2, 4)
        # The upper part of the south face: bare panes on the left, coated ones on the right.
        bare, coated = at_10_um[14][14], at_10_um[14][18]
        self.assertLess(coated, 0.97 * bare)


class ExamplesOfTemperatures(unittest.TestCase):
    def materials(self, name, *more):
        done = subprocess.run([PROGRAM, "temperature", str(EXAMPLES / f"{name}.json"), "--materials", *more],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows, material = {}, None
        for line in done.stdout.splitlines():
            if re.match(r"[a-z]", line):
                material = line
            elif match := re.match(r"  (\d\d:\d\d) +(\S+) +(\S+) .*\|.* (\S+)$", line):
                hour, *numbers = match.groups()
                rows[material, hour] = [float(number) for number in numbers]  # air, sunlit, into the solid
        return rows

    def test_leaves_are_as_the_air_and_the_lawn_is_cooler_than_asphalt(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [PROGRAM, "render", str(EXAMPLES / "street_of_trees.json"), "-o", folder, "--set",
                 "sensor.camera.orthographic.gsd=0.8 m", "--set", "sensor.camera.orthographic.pixels=[20, 15]", "--set",
                 "sampling.accuracy=null", "--set", 'sampling.grid={"elements": [1, 1]}', "--set", 'output.formats=["envi"]',
                 "--set", "temperatures.step=15 min"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            kelvins = [row[:] for row in band(pathlib.Path(folder) / "image_temperature.img", 0, 2)]
        asphalt, crown, lawn = kelvins[11][10], sorted(kelvins[4][8:12])[1], kelvins[14][10]
        self.assertLess(abs(crown - 273.15 - 22.1), 4.0, kelvins[4])
        self.assertLess(lawn, asphalt - 10.0)
        rows = self.materials("street_of_trees", "--only", "leaf", "--height", "5")
        air, level, _ = rows["leaf", "12:00"]  # in full Sun
        self.assertTrue(2.0 < level - air < 4.5, rows)

    def test_insulation_keeps_heat_in(self):
        if not (EXAMPLES / "../../shared/truth/weather").is_dir():
            self.skipTest("reference data not found")
        rows = self.materials("delft/february")
        lost = [-rows[f"roof, {cm}", "06:00"][2] for cm in ("none", "4 cm", "8 cm", "16 cm")]
        outside = [rows[f"roof, {cm}", "06:00"][1] for cm in ("none", "4 cm", "8 cm", "16 cm")]
        self.assertEqual(lost, sorted(lost, reverse=True))
        self.assertEqual(outside, sorted(outside, reverse=True))
        self.assertGreater(lost[0], 3.0 * lost[1])


if __name__ == "__main__":
    unittest.main()
