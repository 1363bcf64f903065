"""`ifov atmosphere`: table, figure, spectrum, other geometry; and what is said where an atmosphere is wrong."""

import math
import re
import struct
import unittest

from program import Folder, run

AIR = '"profile": "mid-latitude summer", "water_vapour": "2.1 g/cm2"'
# Air is solved in steps of 20 cm-1: narrow channels take few.
YARD = """{
  "ifov": 1,
  "scene": {
    "materials": {"soil": {"reflectance": 0.2, "temperature": "300 K"}},
    "objects": [{"plane": {}, "material": "soil"}]
  },
  "light": {"sun": {"disc": {"zenith": "30 deg", "azimuth": "150 deg"}}},
  "atmosphere": {%s},
  "sensor": {
    "camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}},
    "channels": [
      {"name": "blue", "gaussian": {"center": "0.48 um", "fwhm": "4 nm"}},
      {"name": "red", "gaussian": {"center": "0.665 um", "fwhm": "4 nm"}},
      {"name": "thermal", "top_hat": {"from": "10.6 um", "to": "11.2 um"}}
    ]
  }
}
"""

# Channels that lie near each other: the whole spectrum between them takes no time.
NEAR = YARD.replace('"blue", "gaussian": {"center": "0.48 um", "fwhm": "4 nm"}', '"oxygen", "top_hat": {"from": "0.75 um", "to": "0.78 um"}').replace(
    ''',
      {"name": "thermal", "top_hat": {"from": "10.6 um", "to": "11.2 um"}}''', "").replace("0.665 um", "0.74 um")


def rows(text):
    """{channel: numbers of its row}, None where there is a dash."""
    found = {}
    for line in text.splitlines():
        words = line.split()
        if words and words[0] in ("blue", "red", "thermal") and words[0] not in found:
            found[words[0]] = [None if word == "-" else float(word) for word in words[1:]]
    return found


class Progress(unittest.TestCase):
    def test_says_what_it_is_of(self):
        with Folder(yard=YARD % (AIR + ', "interval": "numerical"')) as folder:
            done = run("render", "yard.json", "--log", "run.log", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = [line for line in (folder / "run.log").read_text().splitlines() if " progress: " in line]
            self.assertRegex(lines[0], r" progress: atmosphere  \[")
            self.assertNotIn("atmosphere", lines[-1])


class Table(unittest.TestCase):
    def test_a_row_for_each_channel(self):
        with Folder(yard=YARD % AIR) as folder:
            done = run("atmosphere", "yard.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("mid-latitude summer\n", done.stdout)
            self.assertIn("Water vapour 2.1 g/cm2", done.stdout)
            self.assertIn("Sun 30.0 deg from the zenith at azimuth 150.0 deg. Sensor 0.0 deg", done.stdout)
            self.assertLessEqual(max(map(len, done.stdout.splitlines())), 110)
            table = rows(done.stdout)
            wavelength, sun, sensor, solar, thermal, direct, diffuse, albedo, sky = table["blue"]
            self.assertEqual((wavelength, thermal, sky), (0.48, 0.0, None))
            # Beer: the sunbeam is 1 / cos 30 degrees as long as the line of sight.
            self.assertAlmostEqual(sun, sensor ** (1 / 0.8660), delta=0.002)
            self.assertTrue(20 < solar < 100 and 500 < direct < 1500 and 100 < diffuse < 700 and 0.1 < albedo < 0.3)
            self.assertLess(table["red"][3], solar)
            self.assertTrue(200 < table["thermal"][8] < 294)

    def test_says_that_it_is_not_of_single_columns(self):
        smile = (NEAR % AIR).replace('"camera":', '"smile": {"polynomial": {"center": ["1 nm"]}}, "camera":')
        with Folder(yard=smile, plain=NEAR % AIR) as folder:
            done, plain = run("atmosphere", "yard.json", cwd=folder), run("atmosphere", "plain.json", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (0, plain.stdout))
            self.assertIn("the sensor has a smile: what is told is of its channels' own responses, not of single columns'", done.stderr)
            self.assertEqual(plain.stderr, "")

    def test_what_correction_codes_ask_for(self):
        with Folder(yard=YARD % AIR) as folder:
            text = run("atmosphere", "yard.json", cwd=folder).stdout
        table = rows(text)
        below = rows(text[text.index("reflect."):])
        for name in ("blue", "red"):
            _, sun, sensor, solar, _, direct, diffuse, albedo, _ = table[name]
            path, down, down_scattered, up, up_scattered, s = below[name]
            above = direct / sun
            self.assertAlmostEqual(path, math.pi * solar / above, delta=2e-4)
            self.assertAlmostEqual(down, sun + diffuse / above, delta=2e-4)
            self.assertAlmostEqual(down - down_scattered, sun, delta=2e-4)
            self.assertAlmostEqual(up - up_scattered, sensor, delta=2e-4)
            self.assertAlmostEqual(s, albedo, delta=1e-4)
            # Reciprocity: nearly the same way down and up.
            self.assertAlmostEqual(down, up, delta=0.04)

    def test_another_geometry(self):
        with Folder(yard=YARD % AIR) as folder:
            usual = rows(run("atmosphere", "yard.json", cwd=folder).stdout)
            low = run("atmosphere", "yard.json", "--sun", "75,90", "--view", "40,270", "--altitude", "0.5", cwd=folder)
            self.assertEqual(low.returncode, 0, low.stderr)
            self.assertIn("Sun 75.0 deg from the zenith at azimuth 90.0 deg. Sensor 40.0 deg", low.stdout)
            self.assertIn("at 0.5 km.", low.stdout)
            self.assertLess(rows(low.stdout)["blue"][1], usual["blue"][1])
            self.assertGreater(rows(low.stdout)["thermal"][2], usual["thermal"][2])

    def test_the_night_is_dark_and_warm(self):
        with Folder(yard=YARD % AIR) as folder:
            night = run("atmosphere", "yard.json", "--sun", "none", cwd=folder)
            self.assertIn("No Sun.", night.stdout)
            self.assertEqual(rows(night.stdout)["blue"][1], None)
            day = rows(run("atmosphere", "yard.json", cwd=folder).stdout)
            self.assertEqual(rows(night.stdout)["thermal"][4], day["thermal"][4])

    def test_draws_a_figure(self):
        with Folder(yard=NEAR % AIR) as folder:
            done = run("atmosphere", "yard.json", "--plot", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, "yard.atmosphere.png  (figure, PNG)\n"))
            png = (folder / "yard.atmosphere.png").read_bytes()
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">I", png[16:20])[0], 2360)
            self.assertGreater(len(png), 100000)
            named = run("atmosphere", "yard.json", "--plot", "red.png", "--channel", "red", "--sun", "none", cwd=folder)
            self.assertEqual(named.returncode, 0, named.stderr)
            self.assertTrue((folder / "red.png").exists())

    def test_writes_the_spectrum(self):
        with Folder(yard=NEAR % AIR) as folder:
            done = run("atmosphere", "yard.json", "--csv", "air.csv", "--quiet", cwd=folder)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            lines = (folder / "air.csv").read_text().splitlines()
            comments = [line for line in lines if line.startswith("#")]
            self.assertIn("# means over 20 cm-1, over black ground", comments)
            head = lines[len(comments)].split(",")
            self.assertEqual(head[0], "wavelength_um")
            self.assertIn("solar_path_radiance", head)
            table = [list(map(float, line.split(","))) for line in lines[len(comments) + 1 :]]
            wavelength = [row[0] for row in table]
            self.assertEqual(wavelength, sorted(wavelength))
            self.assertTrue(0.7 < wavelength[0] < 0.738 and 0.78 < wavelength[-1] < 0.85)
            through = head.index("ground_sensor_transmittance")
            oxygen = min(row[through] for row in table if 0.755 < row[0] < 0.77)
            beside = max(row[through] for row in table if 0.745 < row[0] < 0.755)
            self.assertLess(oxygen, 0.6 * beside)


def summary(path):
    """{channel: {column: value}} of a table of --summary."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    head = lines[0].split(",")
    return {row[0]: dict(zip(head[1:], map(float, row[1:]))) for row in (line.split(",") for line in lines[1:])}


class Summary(unittest.TestCase):
    def test_light_over_other_ground_follows_from_the_columns(self):
        with Folder(yard=YARD % AIR) as folder:
            found = {}
            for ground in ("0", "0.2", "0.7"):
                done = run("atmosphere", "yard.json", "--view", "30,60", "--ground", ground, "--summary", "air.csv", cwd=folder)
                self.assertEqual((done.returncode, done.stderr), (0, "air.csv  (summary, 3 channels)\n"))
                self.assertIn(f"Over ground of reflectance {ground}:\n", done.stdout)
                self.assertLessEqual(max(map(len, done.stdout.splitlines())), 110)
                found[float(ground)] = summary(folder / "air.csv")
            comments = (folder / "air.csv").read_text()
            self.assertIn("# path_reflectance [1]: of the path's sunlight over black ground, pi L / (E cos)\n", comments)
            self.assertIn("over level, uniform ground of reflectance 0.7 that emits nothing\n", comments)
        for name in ("blue", "red"):
            dark = found[0.0][name]
            above = dark["solar_irradiance"] * math.cos(math.radians(30))
            down = dark["direct_transmittance_down"] + dark["diffuse_transmittance_down"]
            up = dark["direct_transmittance_up"] + dark["diffuse_transmittance_up"]
            self.assertEqual(dark["ground_up"], 0)
            self.assertAlmostEqual(dark["ground_direct"] / above, dark["direct_transmittance_down"], delta=1e-5)
            # All sunlight that does not go up again is absorbed, by the ground and on the way.
            self.assertLess(dark["sensor_up"] + dark["ground_direct"] + dark["ground_diffuse"], above)
            for ground in (0.2, 0.7):
                there = found[ground][name]
                seen = dark["path_reflectance"] + down * up * ground / (1 - ground * dark["spherical_albedo"])
                # One number for each channel knows nothing of what absorbs within it: 6S's equation is off by that.
                self.assertAlmostEqual(math.pi * there["radiance"] / above, seen, delta=0.005)
                self.assertAlmostEqual(there["ground_up"], ground * (there["ground_direct"] + there["ground_diffuse"]), delta=1e-3 * above)
                self.assertAlmostEqual(there["u"], dark["path_u"], delta=1e-6 * above)
                self.assertGreater(there["sensor_up"], dark["sensor_up"])
            self.assertGreater(abs(dark["path_u"]), 1e-3 * dark["solar_path_radiance"])

    def test_a_material_may_be_the_ground(self):
        """Lambertian through its spectrum; by a BRDF that is Lambert's, as its reflectance; the sea polarizes what the sensor sees."""
        materials = """"even": {"reflectance": 0.2, "scattering": {"rpv": {"k": 1, "asymmetry": 0, "rho_c": 1}}},
                       "sea": {"reflectance": 0.01, "scattering": {"sea": {"wind": 7, "wind_from": "30 deg"}}},
                       "bright": {"reflectance": 0.9, "scattering": {"rpv": {"k": 0.4, "asymmetry": -0.1}}},
                       "mirror": {"reflectance": 0.9, "scattering": "mirror"},
                       "leaf": {"reflectance": 0.3, "transmittance": 0.3}, "soil":"""
        with Folder(yard=YARD.replace('"soil":', materials, 1) % AIR) as folder:
            found = {}
            for ground in ("0.2", "soil", "even", "sea"):
                done = run("atmosphere", "yard.json", "--view", "30,60", "--ground", ground, "--summary", "air.csv", cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                found[ground] = summary(folder / "air.csv")["blue"]
            self.assertIn("Over ground 'sea' by its BRDF:\n", done.stdout)
            for name, value in found["0.2"].items():
                self.assertAlmostEqual(found["soil"][name], value, delta=1e-6 * (1 + abs(value)), msg=name)
                # Nodes are those of a spectrum that is not constant.
                self.assertAlmostEqual(found["even"][name], value, delta=2e-3 * max(1, abs(value)), msg=name)
            # The glint, seen near Brewster's angle, swings level.
            done = run("atmosphere", "yard.json", "--view", "45,330", "--ground", "sea", "--summary", "air.csv", cwd=folder)
            glint = summary(folder / "air.csv")["red"]
            self.assertLess(glint["q"], -0.3 * glint["radiance"])
            for ground, message in (
                ("seas", "the ground 'seas' is neither a reflectance nor 'surroundings' nor a material of the document; did you mean 'sea'? "
                         "Its materials are 'even', 'sea', 'bright', 'mirror', 'leaf' and 'soil'\n"),
                ("mirror", "the material 'mirror' sends all light in one direction: it is no ground for the air; expected a model that "
                           "spreads light, such as 'sea', 'rpv' or 'ross_li'\n"),
                ("leaf", "the material 'leaf' lets light through: it is no ground for the air; expected an opaque one\n"),
                ("surroundings", "'surroundings' were asked for as the ground, and 'light' has none"),
            ):
                done = run("atmosphere", "yard.json", "--ground", ground, cwd=folder)
                self.assertEqual(done.returncode, 1)
                self.assertIn(message, done.stderr)
            done = run("atmosphere", "yard.json", "--ground", "bright", cwd=folder)
            self.assertRegex(done.stderr, r"^yard.json:6:34: material 'bright': of light that comes 89 deg from the normal it sends back [0-9.]+ "
                                          r"times as much; its parameters belong to no passive surface\n")

    def test_netcdf_holds_the_same(self):
        try:
            import scipy.io
        except ImportError:
            self.skipTest("scipy, which reads NetCDF, is not there")
        with Folder(yard=NEAR % AIR) as folder:
            run("atmosphere", "yard.json", "--summary", "air.csv", cwd=folder)
            done = run("atmosphere", "yard.json", "--summary", "air.nc", "--quiet", cwd=folder)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            table = summary(folder / "air.csv")
            file = scipy.io.netcdf_file(folder / "air.nc", mmap=False)
            names = [row.tobytes().rstrip(b"\0").decode() for row in file.variables["name"][:]]
            self.assertEqual(names, list(table))
            for column in table["red"]:
                for name, value in zip(names, file.variables[column][:]):
                    self.assertAlmostEqual(value, table[name][column], delta=1e-6 * abs(value))
            self.assertEqual(file.variables["sensor_up"].units, b"W m-2 um-1")
            self.assertIn(b"of reflectance 0 that emits nothing", file.comment)
            steps = run("atmosphere", "yard.json", "--summary", "steps.csv", "--resolved", cwd=folder)
            self.assertRegex(steps.stderr, r"^steps.csv  \(summary, \d+ steps of 20 cm-1\)\n$")
            self.assertGreater(len(summary(folder / "steps.csv")), 80)

    def test_by_night_shares_of_sunlight_are_left_out(self):
        with Folder(yard=YARD % AIR) as folder:
            run("atmosphere", "yard.json", "--sun", "none", "--summary", "air.csv", cwd=folder)
            table = summary(folder / "air.csv")
        self.assertNotIn("path_reflectance", table["thermal"])
        self.assertGreater(table["thermal"]["sensor_up"], table["thermal"]["ground_diffuse"] * 0.5)

    def test_mistakes(self):
        with Folder(yard=YARD % AIR) as folder:
            for arguments, message in (
                (("--ground", "1.2"), "ifov: --ground is 1.2, expected a reflectance of 0 to 1\n"),
                (("--summary", "air.txt"), "ifov: --summary is 'air.txt', expected a name that ends in .csv or .nc\n"),
            ):
                done = run("atmosphere", "yard.json", *arguments, cwd=folder)
                self.assertEqual((done.returncode, done.stderr), (1, message))


class Sky(unittest.TestCase):
    """--sky: the sky by direction with its polarization."""

    CLEAR = AIR + ', "aerosol": {"type": "none"}'

    def table(self, *arguments):
        with Folder(yard=YARD % self.CLEAR) as folder:
            done = run("atmosphere", "yard.json", "--sky", "sky.csv", *arguments, cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = [line for line in (folder / "sky.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(lines[0], "zenith_deg,azimuth_deg,radiance,q,u,polarization,polarization_angle_deg")
        return done, [list(map(float, line.split(","))) for line in lines[1:]]

    def test_light_swings_across_the_plane_of_scattering(self):
        done, table = self.table("--sun", "60,150", "--channel", "red")
        self.assertIn("sky.csv  (sky of 'red' at 0.665 um)", done.stderr)
        self.assertEqual(len({(row[0], row[1]) for row in table}), len(table))
        self.assertTrue(all(0 <= row[1] < 360 for row in table))
        radians = math.radians

        def towards(zenith, azimuth):
            return (math.sin(zenith) * math.sin(azimuth), math.sin(zenith) * math.cos(azimuth), math.cos(zenith))

        def cross(a, b):
            return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

        def dot(a, b):
            return sum(x * y for x, y in zip(a, b))

        sun = towards(radians(60), radians(150))
        checked = 0
        for zenith, azimuth, radiance, q, u, degree, angle in table:
            here = towards(radians(zenith), radians(azimuth))
            # Near 90 degrees from the Sun light scattered once rules: it swings across the plane of Sun and sight.
            if degree < 0.6 or not 10 <= zenith <= 80:
                continue
            self.assertAlmostEqual(math.hypot(q, u) / radiance, degree, delta=1e-4)
            up = towards(radians(zenith - 90), radians(azimuth))
            left = cross(up, here)
            swing = [math.cos(radians(angle)) * a + math.sin(radians(angle)) * b for a, b in zip(up, left)]
            across = cross(sun, here)
            along = abs(dot(swing, across)) / math.sqrt(dot(across, across))
            self.assertGreater(along, math.cos(radians(3)), f"zenith {zenith}, azimuth {azimuth}")
            checked += 1
        self.assertGreater(checked, 200)

    def test_names_the_neutral_points(self):
        low, _ = self.table("--sun", "75,150", "--channel", "blue")
        # Below a Sun 15 degrees high Brewster's point is at the horizon; the others stand 10 to 25 degrees away.
        self.assertRegex(low.stdout, r"The sky at 0\.48 um \(blue\) is unpolarized.* above the Sun \(Babinet\)")
        for name in (r"above the Sun \(Babinet\)", r"above the point opposite \(Arago\)"):
            degrees = int(re.search(r"(\d+) deg " + name, low.stdout).group(1))
            self.assertTrue(10 <= degrees <= 28, low.stdout)
        high, _ = self.table("--sun", "40,150", "--channel", "blue")
        self.assertIn("below the Sun (Brewster)", high.stdout)
        self.assertNotIn("Arago", high.stdout)


class Moon(unittest.TestCase):
    """Moonlight is sunlight, dimmed, from where the Moon stands; where the Sun shines it counts for nothing."""

    MOON = '"light": {"moon": {"zenith": "30 deg", "azimuth": "150 deg", "phase_angle": "%s"}'
    SUN = '"light": {"sun": {"disc": {"zenith": "30 deg", "azimuth": "150 deg"}}'

    def rows(self, text):
        with Folder(yard=text % AIR) as folder:
            done = run("atmosphere", "yard.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return done.stdout, rows(done.stdout)

    def test_full_moon_is_a_dim_sun(self):
        said, moon = self.rows(YARD.replace(self.SUN, self.MOON % "0 deg"))
        self.assertIn("Moon 30.0 deg from the zenith at azimuth 150.0 deg.", said)
        self.assertRegex(said, r"channel +um +Moon +sensor")
        _, sun = self.rows(YARD)
        for channel in ("blue", "red"):
            self.assertEqual(moon[channel][1], sun[channel][1])
            for column in (3, 5, 6):  # path, direct, diffuse: all of them linear in the light above
                self.assertAlmostEqual(sun[channel][column] / moon[channel][column] / 401800, 1, delta=0.01)
        self.assertEqual(moon["thermal"][4], sun["thermal"][4])

    def test_its_phase_dims_it(self):
        # Allen (1976): V = -12.73 + 0.026 g + 4e-9 g^4, 2.6 magnitudes less at first quarter.
        _, full = self.rows(YARD.replace(self.SUN, self.MOON % "0 deg"))
        _, half = self.rows(YARD.replace(self.SUN, self.MOON % "90 deg"))
        self.assertAlmostEqual(full["red"][5] / half["red"][5], 10 ** (0.4 * (0.026 * 90 + 4e-9 * 90**4)), delta=0.05)

    def test_the_sun_outshines_it(self):
        both = YARD.replace(self.SUN, self.SUN + "," + (self.MOON % "0 deg")[len('"light": {') :])
        self.assertEqual(self.rows(both)[1], self.rows(YARD)[1])

    def test_time_and_place_put_it_there(self):
        # Full moon at local midnight south of Hawaii: opposite to the Sun, as far north as that stands south.
        night = YARD.replace('"ifov": 1,', '"ifov": 1, "time": "2026-01-03T10:03:00Z",').replace(
            '"scene": {', '"scene": {"origin": {"latitude": "20 deg", "longitude": "-151 deg"},'
        )
        said, moon = self.rows(night.replace(self.SUN, '"light": {"sun": {"disc": {}}, "moon": {}'))
        zenith = float(re.search(r"Moon ([\d.]+) deg from the zenith", said).group(1))
        self.assertLess(zenith, 15, said)
        self.assertTrue(0.001 < moon["red"][5] < 0.01)
        with Folder(yard=night.replace(self.SUN, '"light": {"sun": {"disc": {}}, "moon": {}') % AIR) as folder:
            self.assertIn("light: moon, sky", run("check", "yard.json", cwd=folder).stdout)
            self.assertIn(run("render", "yard.json", "--quiet", cwd=folder).returncode, (0, 5, 6))  # 6: with warnings

    def test_what_is_missing_is_said(self):
        for text, words in (
            (self.MOON % "0 deg", None),
            ('"light": {"moon": {}', "the Moon has no direction: give 'zenith' and 'azimuth', or"),
            ('"light": {"moon": {"zenith": "30 deg", "azimuth": "0 deg"}', "the Moon has no phase: give 'phase_angle'"),
        ):
            with Folder(yard=YARD.replace(self.SUN, text) % (AIR + ', "interval": "numerical"')) as folder:
                done = run("check", "yard.json", cwd=folder)
                self.assertEqual(done.returncode, 0 if words is None else 1, done.stderr)
                self.assertIn(words or "", done.stderr)
        plain = '"simple": {"sky_temperature": "250 K"}'
        with Folder(yard=YARD.replace(self.SUN, self.MOON % "0 deg") % plain) as folder:
            self.assertIn(
                "the atmosphere's 'simple' says what light the Sun gives, not the Moon: leave out 'moon', or name a",
                run("check", "yard.json", cwd=folder).stderr,
            )


class Errors(unittest.TestCase):
    def refused(self, air, words, place, *arguments, text=YARD, command="check"):
        with Folder(yard=text % air) as folder:
            done = run(command, "yard.json", *arguments, cwd=folder)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertIn(words, done.stderr)
            if place is not None:
                line, column = map(int, re.match(r"yard\.json:(\d+):(\d+): ", done.stderr).groups())
                source = (text % air).splitlines()[line - 1]
                self.assertTrue(source[column - 1 :].startswith(place), f"{place} is not at {line}:{column}: {source}")

    def test_unknown_names(self):
        self.refused('"profile": "mid-latitude sumer"', "did you mean 'mid-latitude summer'?", '"mid-latitude sumer"')
        self.refused(
            AIR + ', "aerosol": {"type": "rurul"}',
            "is the text \"rurul\", expected 'none', 'rural', 'urban', 'maritime'",
            '"rurul"',
        )

    def test_one_measure_of_aerosol(self):
        self.refused(
            AIR + ', "aerosol": {"visibility": "23 km", "aot550": 0.1}',
            "'aot550' cannot stand beside 'visibility'",
            '"aot550"',
        )

    def test_levels(self):
        level = '{"altitude": "%s", "pressure": "%s", "temperature": "280 K"}'
        levels = ', "levels": [%s,\n %s]'
        self.refused(
            AIR + levels % (level % ("2000 m", "800 hPa"), level % ("1000 m", "700 hPa")),
            "the altitudes of a profile must rise: 1 km follows 2 km",
            '"1000 m"',
        )
        self.refused(
            AIR + levels % (level % ("0 m", "800 hPa"), level % ("1000 m", "900 hPa")),
            "the pressures of a profile must fall: 900 hPa follows 800 hPa",
            '"900 hPa"',
        )

    def test_the_sky_is_the_atmospheres(self):
        sky = YARD.replace('"light": {', '"light": {"sky": {"temperature": "250 K"}, ')
        self.refused(AIR, "the sky follows from the atmosphere's 'profile'", '{"temperature"', text=sky)
        self.refused(
            '"simple": {"sky_temperature": "250 K"}', "leave out 'sky', or 'simple'", '{"temperature"', text=sky
        )

    def test_geometry(self):
        flat = YARD.replace('"gsd": "1 m"', '"gsd": "1 m", "view_zenith": "85 deg"')
        self.refused(AIR, "at most 80 degrees from the nadir; the middle of its image looks 85.0 degrees away",
                     '{"orthographic"', text=flat)
        self.refused(
            AIR + ', "ground_altitude": "2 km", "sensor_altitude": "1 km"',
            "the sensor stands at 1 km, not above the ground at 2 km",
            '"1 km"',
        )
        self.refused(AIR + ', "ground_altitude": "7 km"', "ground at 7 km: expected below 6 km", "{")

    def test_a_channel_beyond_the_tables(self):
        far = YARD.replace('"center": "0.48 um"', '"center": "0.19 um"')
        for command in ("check", "atmosphere"):
            self.refused(AIR, "the channel 'blue' reaches from ", '{"name": "blue"', text=far, command=command)
        self.refused(AIR, " um, and the modelled atmosphere from 0.2 to 50 um", None, text=far)

    def test_keys_of_a_profile_need_one(self):
        self.refused('"water_vapour": "2 g/cm2"', "'water_vapour' needs the key 'profile' beside it", "{")
        self.refused(
            '"tabulated": {"transmittance": 0.8}, ' + AIR, "'profile' cannot stand beside 'tabulated'", '"profile"'
        )

    def test_the_command(self):
        self.refused('"tabulated": {"transmittance": 0.8}',
                     "there is no modelled atmosphere to look at: 'atmosphere' has no 'profile'", "{",
                     command="atmosphere")
        self.refused(AIR, "ifov: --sun is 'noon', expected ZENITH,AZIMUTH in degrees, such as 30,135", None,
                     "--sun", "noon", command="atmosphere")
        self.refused(AIR, "ifov: --view has a zenith angle of 85 degrees, expected 0 to 80", None,
                     "--view", "85,0", command="atmosphere")
        self.refused(AIR, "the sensor has no channel 'blu'; did you mean 'blue'? Channels: 'blue', 'red' and 'thermal'",
                     None, "--plot", "a.png", "--channel", "blu", command="atmosphere")
        self.refused(AIR, "the sensor stands at -1 km, not above the ground at 0 km", None, "--altitude", "-1",
                     command="atmosphere")


class PlainAtmospheres(unittest.TestCase):
    """The simpler atmospheres light a Lambertian plane as their definitions say."""

    def radiance(self, air):
        with Folder(yard=YARD % air) as folder:
            done = run("render", "yard.json", "--quiet", cwd=folder)
            self.assertEqual(done.returncode, 6, done.stderr)  # a plain has one value
            raw = (folder / "yard.out" / "image_radiance.img").read_bytes()
            pixels = struct.unpack(f"<{len(raw) // 4}f", raw)
            # Lines one behind the other, in each the channels: 4 pixels of blue, of red, of thermal.
            return [sum(pixels[12 * line + 4 * c + k] for line in range(4) for k in range(4)) / 16 for c in range(3)]

    def test_uniform(self):
        blue, red, _ = self.radiance('"uniform": {"direct": "900 W m-2 um-1", "diffuse": "100 W m-2 um-1"}')
        expected = 0.2 / 3.14159265 * (900 * 0.8660254 + 100)
        self.assertAlmostEqual(blue / expected, 1.0, delta=0.01)
        self.assertAlmostEqual(red / expected, 1.0, delta=0.01)

    def test_simple(self):
        blue, red, thermal = self.radiance('"simple": {"sky_temperature": "250 K"}')
        # Planck's law at 5800 K, scaled to 1000 W m-2: 1362.9 and 1139.9 W m-2 um-1.
        for value, wavelength in ((blue, 0.48), (red, 0.665)):
            planck = 1.191042972e8 / wavelength**5 / (2.718281828 ** (14387.769 / (wavelength * 5800)) - 1)
            sun = planck * 3.14159265 * 1000 / (5.670374419e-8 * 5800**4)
            self.assertAlmostEqual(value / (0.2 / 3.14159265 * sun * 0.8660254), 1.0, delta=0.01)
        planck = lambda t: 1.191042972e8 / 10.9**5 / (2.718281828 ** (14387.769 / (10.9 * t)) - 1)
        self.assertAlmostEqual(thermal / (0.8 * planck(300) + 0.2 * planck(250)), 1.0, delta=0.01)

    def test_four_curves(self):
        blue, _, _ = self.radiance(
            '"four_curve": {"direct": "900 W m-2 um-1", "diffuse": "100 W m-2 um-1", "transmittance": 0.9,'
            ' "path_radiance": "2 W m-2 sr-1 um-1", "length": "1 km", "distance": "3 km"}'
        )
        ground = 0.2 / 3.14159265 * (900 * 0.8660254 + 100)
        self.assertAlmostEqual(blue / (0.9**3 * ground + 6), 1.0, delta=0.01)


if __name__ == "__main__":
    unittest.main()
