"""Clouds and twilight in documents: what they do to light, what is said of them, and what is refused."""

import json
import math
import re
import unittest

from program import Folder, run
from test_atmosphere import AIR, YARD, rows

CLEAR = AIR + ', "aerosol": {"type": "none"}'
CLOUD = CLEAR + ', "clouds": [%s]'
STRATUS = '{"kind": "water", "base": "1 km", "top": "1.6 km", "optical_depth": %g}'
# One channel alone: solving clouds takes a second for each.
CHANNELS = [line for line in YARD.splitlines() if '{"name": "' in line]
RED, THERMAL = (
    YARD.replace("\n".join(CHANNELS), CHANNELS[kept].rstrip(","))
    for kept in (1, 2)
)
SUN = '"zenith": "30 deg"'


def planck(um, kelvin):
    return 1.191042972e8 / um**5 / math.expm1(14387.7688 / (um * kelvin))


def looked_at(text, *options):
    with Folder(yard=text) as folder:
        done = run("atmosphere", "yard.json", *options, cwd=folder)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return done.stdout


class Light(unittest.TestCase):
    def test_goes_somewhere(self):
        """A thick cloud lets through K(mu) (4/3) / ((1 - g) t + 1.42) (King 1987), with g = 0.86 of droplets of 10 um; gases above
        take some per cent, of both alike."""
        clear = rows(looked_at(RED % CLEAR))
        thick, thinner = (rows(looked_at(RED % (CLOUD % (STRATUS % depth)))) for depth in (50, 25))
        self.assertAlmostEqual(thick["red"][6] / thinner["red"][6], (0.14 * 25 + 1.42) / (0.14 * 50 + 1.42), delta=0.01)
        above = clear["red"][5] / clear["red"][1]  # sunlight on level ground without air
        mu = math.cos(math.radians(30))
        through = 3 / 7 * (1 + 2 * mu) * (4 / 3) / (0.14 * 50 + 1.42)
        self.assertLess(thick["red"][5], 1e-12 * above)
        self.assertAlmostEqual(thick["red"][6] / above / through, 1.0, delta=0.1)
        self.assertAlmostEqual(thick["red"][7], 1 - 1 / (0.75 * 0.14 * 50 + 1.07), delta=0.02)

    def test_of_the_beam_is_what_its_depth_leaves(self):
        # At the wavelength by which depth is told.
        text = RED.replace("0.665 um", "0.55 um")
        self.assertNotEqual(text, RED)
        clear, thin = rows(looked_at(text % CLEAR)), rows(looked_at(text % (CLOUD % (STRATUS % 1))))
        self.assertAlmostEqual(-math.log(thin["red"][1] / clear["red"][1]) * math.cos(math.radians(30)), 1.0, delta=0.002)
        # Direct and diffuse together lose little: most of what is scattered goes on.
        self.assertGreater(thin["red"][5] + thin["red"][6], 0.85 * (clear["red"][5] + clear["red"][6]))

    def test_glows_as_its_near_side(self):
        """By night and seen from above all, a thick cloud is as warm as the air at its top, less what vapour above takes."""
        text = THERMAL % (CLOUD % '{"kind": "water", "base": "3 km", "top": "4 km", "optical_depth": 40}')
        thermal = rows(looked_at(text, "--sun", "none"))["thermal"]
        # 273.2 K at 4 km in mid-latitude summer, 279.2 K at 3 km.
        self.assertAlmostEqual(thermal[4] / planck(10.9, 273.2), 1.0, delta=0.02)
        self.assertGreater(thermal[8], 279.2 - 1.0)
        self.assertLess(thermal[2], 1e-6)

    def test_a_sensor_below_sees_no_cloud_between(self):
        low = rows(looked_at(RED % (CLOUD % (STRATUS % 20)), "--altitude", "0.5"))
        clear = rows(looked_at(RED % CLEAR, "--altitude", "0.5"))
        self.assertAlmostEqual(low["red"][2] / clear["red"][2], 1.0, delta=1e-3)
        self.assertGreater(low["red"][3], 0.0)
        self.assertLess(low["red"][3], clear["red"][3])

    def test_water_path_is_a_depth(self):
        text = looked_at(RED % (CLOUD % '{"kind": "water", "base": "1 km", "top": "2 km", "water_path": "0.1 kg/m2"}'))
        found = re.search(r"Cloud of water from 1 to 2 km, optical depth ([\d.]+) \(100 g/m2\), effective radius 10 um", text)
        self.assertAlmostEqual(float(found[1]), 15.8, delta=0.3)  # 3 W / (2 r), and a twentieth more by diffraction
        text = looked_at(RED % (CLOUD % '{"kind": "ice", "base": "9 km", "top": "10 km", "optical_depth": 0.5, "effective_radius": "40 um"}'))
        self.assertIn("Cloud of ice from 9 to 10 km, optical depth 0.5 (12", text)


class Twilight(unittest.TestCase):
    def test_light_falls_without_a_step(self):
        """20 W m-2 um-1 at 89.5 degrees, and no longer nothing at 90."""
        found = []
        for zenith in (89.0, 89.9, 90.0, 91.0, 94.0, 96.0):
            found.append(rows(looked_at(RED % CLEAR, "--sun", f"{zenith},150"))["red"])
        light = [row[5] + row[6] for row in found]
        self.assertEqual([row[5] > 0 for row in found], [True, True, False, False, False, False])
        for before, after in zip(light, light[1:]):
            self.assertLess(after, before)
            self.assertGreater(after, before / 40)
        self.assertAlmostEqual(light[2] / light[1], 1.0, delta=0.15)
        self.assertGreater(found[3][3], 0.0)

    def test_moon_waits(self):
        moon = ', "moon": {"zenith": "40 deg", "azimuth": "90 deg", "phase_angle": "20 deg"}'
        text = (RED % CLEAR).replace(SUN, '"zenith": "93 deg"').replace('"150 deg"}}', '"150 deg"}}' + moon)
        with Folder(yard=text) as folder:
            done = run("check", "yard.json", cwd=folder)
        self.assertIn("the Moon is left out: the Sun stands 3.0 deg below the horizon, and its twilight is brighter", done.stderr)

    def test_renders_and_ends_at_6_degrees(self):
        sun = (RED % (CLEAR + ', "interval": "numerical"')).rstrip()[:-1] + ', "sampling": {"accuracy": {"error": "15 %"}}}'
        with Folder(dusk=sun.replace(SUN, '"zenith": "93 deg"'), late=sun.replace(SUN, '"zenith": "96.5 deg"')) as folder:
            done = run("render", "dusk.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr.count("warning")), (0, 0), done.stderr)
            late = run("check", "late.json", cwd=folder)
        self.assertEqual(late.returncode, 1)
        self.assertIn("between 0 and 96 deg", late.stderr)


class Said(unittest.TestCase):
    def test_by_check(self):
        with Folder(yard=THERMAL % (CLOUD % (STRATUS % 10))) as folder:
            done = run("check", "yard.json", cwd=folder)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertIn("cloud: water from 1 to 1.6 km, optical depth 10 (63", done.stdout)
        self.assertRegex(done.stdout, r"error of the model of the air and of what clouds consist of: \S+ to \S+ % of a grey "
                                      r"surface's radiance, most in '\w+'; intervals hold it")
        self.assertIn("no figure is stated for edges, holes and amounts that are not as written", done.stdout)
        with Folder(yard=THERMAL % CLEAR) as folder:
            done = run("check", "yard.json", cwd=folder)
        self.assertNotIn("what clouds consist of", done.stdout)

    def test_what_is_not_known_with_the_model(self):
        words = "not how far level and uniform clouds are from real ones"
        for interval, warned in (("", True), (', "interval": "with model"', True), (', "interval": "numerical"', False)):
            with Folder(yard=RED % (CLOUD % (STRATUS % 10) + interval)) as folder:
                done = run("check", "yard.json", cwd=folder)
            self.assertEqual(words in done.stderr, warned, interval + done.stderr)
        self.assertIn("; intervals do not hold it", done.stdout)

    def test_headers_say_what_intervals_do_not_hold(self):
        """They once said that they hold the error of the model, whatever clouds there were."""
        unknown = "intervals hold the error of the air's numbers and of its model, of clouds that of their particles: how far level clouds are from " \
                  "real ones is not known"
        for air, known in ((CLOUD % (STRATUS % 10), False), (CLEAR, True)):
            text = (RED % air).rstrip()[:-1] + ', "sampling": {"accuracy": {"error": "30 %"}}, "output": {"folder": "out"}}'
            with Folder(yard=text) as folder:
                done = run("render", "yard.json", "-o", "out", cwd=folder)
                self.assertIn(done.returncode, (0, 5, 6), done.stderr)
                header = (folder / "out/image_half_width.img.hdr").read_text()
                record = json.loads((folder / "out/image_run.json").read_text())["channels"][0]["air_half_width"]["model"]
            self.assertEqual(unknown in header, not known, header)
            self.assertEqual(unknown[1:] in done.stdout + done.stderr, not known, done.stdout)
            self.assertEqual((record["in_interval"], record["under_clouds"], record["found_with_bands_alone"]), (True, not known, False))

    def test_droplets_and_crystals_where_they_cannot_be(self):
        wrong = '{"kind": "water", "base": "9 km", "top": "11 km", "optical_depth": 1}, {"kind": "ice", "base": "1 km", "top": "2 km", "optical_depth": 1}'
        with Folder(yard=RED % (CLOUD % wrong)) as folder:
            done = run("check", "yard.json", cwd=folder)
        self.assertIn("the cloud of water between 9 and 11 km has air down to 228.8 K", done.stderr)
        self.assertIn("where droplets freeze (235 K)", done.stderr)
        self.assertIn("the cloud of ice between 1 and 2 km has air up to 289.7 K", done.stderr)

    def refused(self, clouds, words, place, more=""):
        text = YARD % (CLOUD % clouds + more)
        with Folder(yard=text) as folder:
            done = run("check", "yard.json", cwd=folder)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(words, done.stderr)
        line, column = map(int, re.match(r"yard\.json:(\d+):(\d+): ", done.stderr).groups())
        source = text.splitlines()[line - 1]
        self.assertTrue(source[column - 1 :].startswith(place), f"{place} is not at {line}:{column}: {source}")

    def test_refused(self):
        cloud = '{"kind": "%s", "base": "%s", "top": "%s", %s}'
        depth = '"optical_depth": 1'
        self.refused(cloud % ("water", "1 km", "120 km", depth), "the cloud reaches to 120 km, above the air, which ends at 100 km", '"120 km"')
        self.refused(cloud % ("water", "3 km", "2 km", depth), "the cloud ends at 2 km, not above its base at 3 km", '"2 km"')
        self.refused(
            cloud % ("water", "1 km", "2 km", depth),
            "the cloud of water begins at 1 km, inside the ground, which is at 1.5 km",
            '{"kind"',
            ', "ground_altitude": "1.5 km"',
        )
        self.refused(cloud % ("water", "1 km", "2 km", '"optical_depth": 120'), "between 0 and 100", "120")
        self.refused(
            cloud % ("water", "1 km", "2 km", '"water_path": "2 kg/m2"'),
            "(2000 g/m2 at an effective radius of 10 um): expected 100 or less",
            '{"kind"',
        )
        self.refused(cloud % ("snow", "1 km", "2 km", depth), "snow", '"snow"')
        self.refused('{"kind": "water", "base": "1 km", "top": "2 km"}', "optical_depth", '{"kind"')


if __name__ == "__main__":
    unittest.main()
