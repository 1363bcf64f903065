"""`ifov temperature`: days of materials under weather, as a user meets them."""

import csv
import os
import pathlib
import re
import unittest

from program import Folder, run

ROOT = pathlib.Path(__file__).resolve().parents[2]
TRUTH = pathlib.Path(os.environ.get("IFOV_TRUTH", ROOT / ".." / "shared" / "truth"))
ALAMOSA = TRUTH / "weather" / "surfrad_alamosa_2016-01-01_forcing.csv"

GUIDE = (ROOT / "docs" / "guide" / "temperatures.md").read_text()
DAY = re.search(r"```json\n(.*?)```", GUIDE, re.DOTALL).group(1)
JUNE = re.search(r"```csv\n(.*?)```", GUIDE, re.DOTALL).group(1)
SIGMA = 5.670374419e-8


def soil(weather):
    return f"""{{"ifov": 1, "time": "2016-01-01T23:59:00Z",
 "scene": {{"origin": {{"latitude": "37.70 deg", "longitude": "-105.92 deg"}},
            "materials": {{"bare dry soil": {{"reflectance": {{"library": "soil, bare"}}}}}},
            "objects": [{{"plane": {{}}, "material": "bare dry soil"}}]}},
 "weather": {{"file": "{weather}", "date": "2016-01-01"}}, "temperatures": {{"repeat_first_day": true}},
 "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [2, 2]}}}}, "channels": [{{"name": "t", "monochromatic": {{"at": "10 um"}}}}]}}}}
"""


AFTERNOON = re.search(r"`afternoon.json`.*?```json\n(.*?)```", GUIDE, re.DOTALL).group(1)


class LongwaveOfTheDocumentsAir(unittest.TestCase):
    """Where nothing measured it, long-wave of the sky is that of the document's atmosphere, and that is said."""

    def test_stands_in_before_prata(self):
        told = {}
        air = ' "atmosphere": {"profile": "mid-latitude summer"},\n "weather"'
        with Folder(prata=DAY, air=DAY.replace(' "weather"', air), dry=DAY.replace(
                ' "weather"', air.replace('summer"', 'summer", "water_vapour": "0.3 g/cm2"'))) as folder:
            (pathlib.Path(folder) / "june.csv").write_text(JUNE)
            for name in ("prata", "air", "dry"):
                told[name] = run("temperature", f"{name}.json", "--only", "road", cwd=folder).stdout
                done = run("temperature", f"{name}.json", "--only", "road", "--csv", f"{name}.csv", cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                found = [row for row in rows_of(pathlib.Path(folder) / f"{name}.csv") if row["light"] == "sunlit"]
                told[name, "sky"] = sum(float(row["sky_longwave_w_m2"]) for row in found) / len(found)
        self.assertIn("long-wave of the sky: by Prata (1996), cloud by Crawford and Duchon (1999)", told["prata"])
        self.assertRegex(told["air"], r"long-wave of the sky: by the document's atmosphere, \d\.\d+ of Prata \(1996\) at its own "
                                      r"ground, as it changes with the air by Prata, cloud by Crawford and Duchon \(1999\)")
        # A summer's air is within a few percent of Prata, which was made of such; ten times less water above the same ground is not.
        self.assertAlmostEqual(told["air", "sky"] / told["prata", "sky"], 1.0, delta=0.06)
        self.assertNotAlmostEqual(told["air", "sky"], told["prata", "sky"], delta=0.1)
        self.assertNotEqual(told["dry", "sky"], told["air", "sky"])


def rows_of(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


class Guide(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(day=DAY)
        cls.folder = cls._folder.__enter__()
        (pathlib.Path(cls.folder) / "june.csv").write_text(JUNE)

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__(None, None, None)

    def temperature(self, *arguments):
        return run("temperature", "day.json", *arguments, cwd=self.folder)

    def test_csv_has_every_step_and_its_fluxes_sum_to_nothing(self):
        done = self.temperature("--materials", "--csv", "day.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = rows_of(pathlib.Path(self.folder) / "day.csv")
        self.assertEqual(len(rows), 4 * 2 * 289)
        for row in rows[::37]:
            fluxes = [float(value) for key, value in row.items() if key.endswith("_w_m2")]
            self.assertAlmostEqual(sum(fluxes), 0.0, delta=0.01)

    def test_the_road_is_warmer_than_the_lawn_and_metal_follows_the_air(self):
        self.temperature("--materials", "--csv", "order.csv")
        rows = rows_of(pathlib.Path(self.folder) / "order.csv")
        at = {(row["material"], row["light"], row["time"][11:16]): float(row["surface_k"]) for row in rows}
        air = {row["time"][11:16]: float(row["air_k"]) for row in rows}
        self.assertGreater(at["road", "sunlit", "13:00"], at["lawn", "sunlit", "13:00"] + 8.0)
        self.assertGreater(at["road", "sunlit", "23:00"], at["lawn", "sunlit", "23:00"])
        self.assertLess(at["hood", "sunlit", "23:00"], at["road", "sunlit", "23:00"] - 5.0)
        self.assertLess(abs(at["lawn", "shaded", "13:00"] - air["13:00"]), 5.0)

    def test_crossovers_of_dawn_and_dusk(self):
        done = self.temperature("--materials")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = re.findall(r"(\d\d):\d\d  '(\w+)' becomes warmer than '(\w+)'", done.stdout)
        # Thin metal overtakes the heavy road in the morning, and falls below it in the evening.
        self.assertIn(("hood", "road"), [(a, b) for hour, a, b in found if 3 <= int(hour) <= 9], found)
        self.assertIn(("road", "hood"), [(a, b) for hour, a, b in found if 12 <= int(hour) <= 20], found)

    def test_figure_is_a_picture(self):
        done = self.temperature("--only", "roof", "--slope", "35", "--plot", "roof.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((pathlib.Path(self.folder) / "roof.png").read_bytes()[1:4], b"PNG")

    def test_a_slope_to_the_south_is_warmer_than_one_to_the_north(self):
        peaks = []
        for azimuth in ("180", "0"):
            self.temperature("--only", "roof", "--slope", "60", "--azimuth", azimuth, "--csv", "slope.csv")
            peaks.append(max(float(row["surface_k"]) for row in rows_of(pathlib.Path(self.folder) / "slope.csv")))
        self.assertGreater(peaks[0], peaks[1] + 5.0)

    def test_what_is_missing_is_named(self):
        for setting, message in [
            ("time=null", 'day.json: surface temperatures need a "time": the 24 hours before it are shown'),
            ("weather=null", 'day.json: surface temperatures need "weather"'),
            ("temperatures=null", 'it reaches back'),
            ("scene.origin=null", "surface temperatures need a place"),
            ("temperatures.step=3 ms", 'expected a duration between 0.5 and 60 min, such as "1 min"'),
            ("temperatures.spin_up=-1 d", 'expected a duration between 0 and 60 d, such as "1 d"'),
        ]:
            with self.subTest(setting=setting):
                done = self.temperature("--materials", "--set", setting)
                self.assertEqual(done.returncode, 1)
                if setting == "temperatures=null":
                    self.assertIn('"repeat_first_day": true takes its first 24 hours', done.stderr)
                    self.assertIn("day.json:", done.stderr)
                else:
                    self.assertIn(message, done.stderr)
        done = self.temperature("--only", "raod")
        self.assertIn("did you mean 'road'?", done.stderr)
        done = self.temperature("--only", "lawn", "--set", "scene.materials.lawn.reflectance=0.2")
        self.assertIn('\'lawn\' has neither "thermal" nor a reflectance of the library', done.stderr)
        self.assertEqual(self.temperature().returncode, 1)

    def test_local_time_taken_for_utc_is_an_error(self):
        local = re.sub(r"T(\d\d):00:00Z", r"T\1:00:00-03:00", JUNE)
        (pathlib.Path(self.folder) / "local.csv").write_text(local)
        done = self.temperature("--materials", "--set", "weather.file=local.csv", "--set", "time=2026-06-22T02:00:00Z")
        self.assertEqual(done.returncode, 1)
        # Rows an hour apart tell the middle of the light to a quarter of an hour.
        minutes, hours = re.search(r"has its noon (\d+) minutes after the Sun at this place.* times ([\d.]+) h earlier would make noon noon",
                                   done.stderr).groups()
        self.assertAlmostEqual(int(minutes), 180, delta=15)
        self.assertAlmostEqual(float(hours), int(minutes) / 60, delta=0.051)


@unittest.skipUnless(ALAMOSA.exists(), f"reference data not found: {ALAMOSA}")
class MeasuredDay(unittest.TestCase):
    """The measured forcing of one day over bare soil. What the soil sent up was left out of the file: these are the bounds that physics sets."""

    def solve(self, weather=ALAMOSA, *settings):
        with Folder(soil=soil(weather)) as folder:
            done = run("temperature", "soil.json", "--materials", "--csv", "soil.csv", *settings, cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = rows_of(pathlib.Path(folder) / "soil.csv")
        return [row for row in rows if row["light"] == "sunlit"]

    def test_hourly_skin_temperature_is_printed_with_its_fluxes(self):
        with Folder(soil=soil(ALAMOSA)) as folder:
            done = run("temperature", "soil.json", "--materials", cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        hours = re.findall(r"^  (\d\d):59 +(-?[\d.]+) +(-?[\d.]+) +(-?[\d.]+) \|", done.stdout, re.MULTILINE)
        self.assertEqual(len(hours), 25)
        self.assertIn("long-wave of the sky: measured", done.stdout)
        lost = float(re.search(r"not accounted for: ([-\d.e+]+) of", done.stdout).group(1))
        self.assertLess(abs(lost), 1e-6)

    def test_colder_than_the_air_by_night_and_warmer_by_day(self):
        rows = self.solve()
        excess = {row["time"][11:16]: float(row["surface_k"]) - float(row["air_k"]) for row in rows}
        self.assertLess(excess["11:59"], -1.0)
        self.assertGreater(excess["18:59"], 8.0)
        self.assertLess(excess["18:59"], 35.0)

    def test_a_sky_as_warm_as_the_air_would_be_noticed(self):
        warm = []
        for line in ALAMOSA.read_text().splitlines():
            fields = line.split(",")
            if fields[0].isdigit():
                fields[4] = f"{SIGMA * (float(fields[5]) + 273.15) ** 4:.1f}"
            warm.append(",".join(fields))
        with Folder(unused="{}") as folder:
            path = pathlib.Path(folder) / "warm.csv"
            path.write_text("\n".join(warm) + "\n")
            faulty = self.solve(path)
        night = [float(b["surface_k"]) - float(a["surface_k"]) for a, b in zip(self.solve(), faulty)]
        self.assertGreater(sum(night) / len(night), 5.0)

    def test_the_wrong_hour_would_be_noticed(self):
        shifted = []
        for line in ALAMOSA.read_text().splitlines():
            fields = line.split(",")
            if fields[0].isdigit():
                fields[0] = str((int(fields[0]) - 7) % 24)
            shifted.append(fields)
        head, body = [f for f in shifted if not f[0].isdigit()], [f for f in shifted if f[0].isdigit()]
        body.sort(key=lambda f: (int(f[0]), int(f[1])))
        with Folder(soil=soil("local.csv")) as folder:
            (pathlib.Path(folder) / "local.csv").write_text("\n".join(",".join(f) for f in head + body) + "\n")
            done = run("temperature", "soil.json", "--materials", cwd=folder)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"its noon 4[12]\d minutes before the Sun")
        self.assertIn("times 7.0 h later would make noon noon", done.stderr)



class Point(unittest.TestCase):
    """The guide's pillar on a road, 52 N, 4.4 E: the Sun stands in the south at 11:44 UTC, 61.4 degrees high."""

    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(afternoon=AFTERNOON)
        cls.folder = pathlib.Path(cls._folder.__enter__())
        (cls.folder / "june.csv").write_text(JUNE)

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__(None, None, None)

    def point(self, *arguments):
        done = run("temperature", "afternoon.json", *arguments, "--csv", "point.csv", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = rows_of(self.folder / "point.csv")
        return {light: {row["time"][11:16]: row for row in rows if row["light"] == light} for light in ("here", "sunlit", "shaded")}

    def refused(self, *arguments):
        done = run("temperature", "afternoon.json", *arguments, cwd=self.folder)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stderr

    def test_the_shadow_is_there_when_the_sun_stands_behind_the_pillar(self):
        day = self.point("--at", "0", "2")
        self.assertEqual(float(day["here"]["11:45"]["sun_w_m2"]), 0.0)
        self.assertGreater(float(day["here"]["08:00"]["sun_w_m2"]), 100.0)
        self.assertAlmostEqual(float(day["here"]["08:00"]["sun_w_m2"]), float(day["sunlit"]["08:00"]["sun_w_m2"]), delta=0.1)
        for row in list(day["here"].values())[::23]:
            fluxes = [float(value) for key, value in row.items() if key.endswith("_w_m2")]
            self.assertAlmostEqual(sum(fluxes), 0.0, delta=0.01)
        # Beyond the shadow's length, 8 m / tan 61.4 deg = 4.4 m from the pillar's north side.
        self.assertGreater(float(self.point("--at", "0", "5.1")["here"]["11:45"]["sun_w_m2"]), 100.0)

    def test_far_away_it_is_the_open_surface(self):
        day = self.point("--at", "-300", "0")
        for time in ("03:00", "11:00", "15:00"):
            self.assertAlmostEqual(float(day["here"][time]["surface_k"]), float(day["sunlit"][time]["surface_k"]), delta=0.02)

    def test_walls_and_objects(self):
        done = run("temperature", "afternoon.json", "--at", "0", "-20", "1.5", "--along", "0", "1", "0", cwd=self.folder)
        self.assertIn("slopes by 90.0 deg and faces 180 deg from north, in the wind of 2 m or lower above open terrain", done.stdout)
        named = run("temperature", "afternoon.json", "--set", "scene.objects[1].name=pillar", "--object", "pillar", cwd=self.folder)
        self.assertIn("the point (0.00, 0.00, 8.00) m of 'pillar'", named.stdout)
        self.assertRegex(named.stdout, r"images, which know it by its class, have [\d.]+ degC, and state \+-[\d.]+ K")

    def test_what_is_not_there(self):
        self.assertIn("no surface is met from (0.00, 0.00, -5.00) m along (0, 0, -1)", self.refused("--at", "0", "0", "-5"))
        self.assertIn("no object is named 'tower'", self.refused("--object", "tower"))
        self.assertIn("--along wants to know from where", self.refused("--at", "0", "0", "--along", "0", "1", "0"))
        self.assertIn("not of both", self.refused("--at", "0", "0", "--materials"))
        self.assertIn(
            "has no temperature that is solved",
            self.refused("--at", "9", "9", "--set", 'scene.materials.road={"reflectance": 0.1, "temperature": "20 degC"}'),
        )


if __name__ == "__main__":
    unittest.main()
