"""Weather of a document: what `ifov check` says of it, and errors at their places."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SOURCE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("IFOV_TRUTH", SOURCE / ".." / "shared" / "truth")).resolve() / "weather"
TABLE = """time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction
2026-06-21T06:00:00Z,14.0,80,1.0,0.1
2026-06-21T07:00:00Z,18.0,70,2.0,0.3
"""


class Weather(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        (self.folder / "june.csv").write_text(TABLE)
        (self.folder / "words.csv").write_text("sunny, later rain\n")

    def tearDown(self):
        self.temporary.cleanup()

    def check(self, weather, time="2026-06-21T06:30:00Z"):
        document = {
            "ifov": 1,
            "scene": {"materials": {"grey": {"reflectance": 0.3}}, "objects": [{"plane": {}, "material": "grey"}]},
            "weather": weather,
            "light": {"sky": {"radiance": "50 W m-2 sr-1 um-1"}},
            "sensor": {
                "camera": {"orthographic": {"gsd": "1 m", "pixels": [1, 1]}},
                "channels": [{"monochromatic": {"at": "0.65 um"}}],
            },
        }
        if time:
            document["time"] = time
        path = self.folder / "scene.json"
        path.write_text(json.dumps(document, indent=1))
        return subprocess.run([PROGRAM, "check", path], capture_output=True, text=True, timeout=60, check=False)

    def test_air_at_the_time_of_the_document(self):
        said = self.check({"file": "june.csv"})
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("weather: air 16.0 degC, humidity 75 %, wind 1.5 m/s, cloud 20 % at 2026-06-21T06:30:00.000Z",
                      said.stdout)

    def test_values_in_the_document_hold_at_all_times(self):
        inline = {"air_temperature": "21 degC", "humidity": "55 %", "wind_speed": "18 km/h", "wind_direction": "270 deg"}
        for time in (None, "1999-01-01"):
            said = self.check(inline, time)
            self.assertIn("weather: air 21.0 degC, humidity 55 %, wind 5.0 m/s from 270 deg (at all times)", said.stdout)

    def test_without_a_time(self):
        self.assertIn("the document has no 'time'", self.check({"file": "june.csv"}, None).stdout)

    def test_errors_have_a_place(self):
        cases = (
            ({"file": "june.csv"}, "2026-06-22", "does not tell the air temperature at 2026-06-22T00:00:00.000Z; its values "
             "go from 2026-06-21T06:00:00.000Z to 2026-06-21T07:00:00.000Z"),
            ({"file": "july.csv"}, None, "july.csv"),
            ({"file": "words.csv"}, None, "words.csv:1: found no weather that is known here"),
            ({"file": "june.csv", "humidity": "50 %"}, None, "humidity"),
            ({"air_temperature": "21 degC", "humidity": "150 %"}, None, "150 %"),
            ({"air_temperature": "21"}, None, "air_temperature"),
        )
        for weather, time, message in cases:
            with self.subTest(weather=weather):
                said = self.check(weather, time)
                self.assertEqual(said.returncode, 1)
                self.assertRegex(said.stderr, r"scene\.json:\d+:\d+: ")
                self.assertIn(message, said.stderr)

    @unittest.skipUnless(DATA.is_dir(), f"reference data not found: {DATA}")
    def test_a_typical_year_holds_for_every_year(self):
        said = self.check({"file": str(DATA / "NLD_Amsterdam062400_IWEC.epw")}, "2026-06-21T11:30:00Z")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertRegex(said.stdout, r"weather: air \d+\.\d degC, humidity \d+ %, wind \d+\.\d m/s .*typical year")


if __name__ == "__main__":
    unittest.main()
