"""Images whose temperatures are solved: the same bytes on any threads, the product, and what is said of errors."""

import array
import json
import math
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]


def weather():
    rows = ["time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction,global_irradiance_w_m2"]
    for hour in range(25):
        height = 0.313 + 0.565 * math.cos(math.pi / 12 * (hour + 0.3 - 12))
        air = 18 - 5 * math.cos(math.pi / 12 * (hour - 3))
        rows.append(f"2026-06-{21 + hour // 24}T{hour % 24:02d}:00:00Z,{air:.2f},60,2.5,0,{max(0, 1000 * height - 30):.1f}")
    return "\n".join(rows) + "\n"


DOCUMENT = {
    "ifov": 1,
    "time": "2026-06-21T15:00:00Z",
    "weather": {"file": "june.csv"},
    "temperatures": {"spin_up": "1 d", "step": "15 min", "repeat_first_day": True},
    "scene": {
        "origin": {"latitude": "52 deg", "longitude": "5 deg"},
        "materials": {
            "road": {"reflectance": {"library": "asphalt, road, weathered"}, "temperature": "solved"},
            "wall": {"reflectance": {"library": "brick, red"}, "temperature": "solved"},
        },
        "objects": [
            {"plane": {}, "material": "road"},
            {"box": {"low": ["-0.5 m", "-0.5 m", "0 m"], "high": ["0.5 m", "0.5 m", "4 m"]}, "material": "wall"},
        ],
    },
    "light": {"sky": {"temperature": "255 K"}},
    "sensor": {
        "camera": {"orthographic": {"gsd": "0.5 m", "pixels": [24, 16]}},
        "channels": [{"name": "thermal", "top_hat": {"from": "10 um", "to": "12 um"}}],
    },
    "sampling": {"accuracy": {"error": "2 K"}, "tile": 8},
    "output": {"products": ["half_width", "temperature", "thermal_half_width"]},
}


class SolvedImage(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        (self.folder / "june.csv").write_text(weather())

    def tearDown(self):
        self.temporary.cleanup()

    def render(self, threads, document=DOCUMENT):
        (self.folder / "scene.json").write_text(json.dumps(document))
        out = self.folder / f"out{threads}"
        said = subprocess.run(
            [PROGRAM, "render", self.folder / "scene.json", "--threads", str(threads), "--output", out],
            capture_output=True, text=True, timeout=120, check=False)
        return said, out

    def test_the_same_bytes_and_a_shadow_that_moved_on(self):
        cubes = []
        for threads in (1, 2):
            said, out = self.render(threads)
            self.assertEqual(said.returncode, 0, said.stderr)
            cubes.append([(out / f"image_{name}.img").read_bytes() for name in ("radiance", "half_width", "temperature", "thermal_half_width")])
        self.assertEqual(cubes[0], cubes[1])
        run = json.loads((out / "image_run.json").read_text())
        self.assertTrue(any(re.search(r"at \d+ points that the camera sees, each solved in full", note) for note in run["notes"]))
        kelvin = array.array("f", cubes[0][2])
        known = sorted(value for value in kelvin if value > 250)
        self.assertGreater(known[-1] - known[0], 8)
        # What the temperatures may be off by is in the half-widths and beside them.
        half_width, thermal = array.array("f", cubes[0][1]), array.array("f", cubes[0][3])
        self.assertTrue(all(0 < part <= whole for part, whole in zip(thermal, half_width)))

    def test_what_the_camera_hardly_sees_is_measured_all_the_same(self):
        """A road that no ray of the survey meets had been off by 0 K at 0 points, and all pixels sure of it."""
        document = json.loads(json.dumps(DOCUMENT))
        document["scene"]["materials"]["road"]["temperature"] = "300 K"
        document["scene"]["objects"][1] = {"disk": {"center": ["0.3 m", "0.2 m", "1 cm"], "normal": [0, 0, 1], "radius": "1 cm"},
                                           "material": "wall"}
        said, out = self.render(1, document)
        self.assertEqual(said.returncode, 0, said.stderr)
        notes = "\n".join(json.loads((out / "image_run.json").read_text())["notes"])
        found = re.search(r"at 0 points that the camera sees, each solved in full by itself, and 8 more of materials that it hardly sees, "
                          r"off by ([\d.]+) K", notes)
        self.assertIsNotNone(found, notes)
        self.assertGreater(float(found[1]), 0.0)

    def test_weather_is_needed(self):
        said, _ = self.render(1, {key: value for key, value in DOCUMENT.items() if key != "weather"})
        self.assertEqual(said.returncode, 1, said.stderr)
        self.assertIn('a temperature that is solved needs "weather"', said.stderr)
        self.assertRegex(said.stderr, r"scene\.json:\d+:\d+: ")

    def test_another_sun_is_noticed(self):
        document = json.loads(json.dumps(DOCUMENT))
        document["light"]["sun"] = {"disc": {"zenith": "30 deg", "azimuth": "90 deg"}}
        said, _ = self.render(1, document)
        self.assertIn("from where it stood at the document's 'time'", said.stderr)


if __name__ == "__main__":
    unittest.main()
