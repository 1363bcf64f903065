"""Amounts of gases of a document's own: what they do, what is said of them, and what is said where they are wrong."""

import unittest

from program import Folder, run
from test_atmosphere import AIR, YARD, rows

GASES = '"profile": "mid-latitude summer", "gases": {%s}'


def looked_at(air):
    with Folder(yard=YARD % air) as folder:
        return run("atmosphere", "yard.json", cwd=folder)


class Told(unittest.TestCase):
    def test_what_is_asked_for_is_there(self):
        done = looked_at(GASES % '"h2o": {"column": "1.4 g/cm2"}, "o3": {"column": "280 DU"}, "co2": {"mixing_ratio": "560 ppm"}, "no2": "off", "n2": "off"')
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("Water vapour 1.4 g/cm2, ozone 280 DU, CO2 560 ppm.\nGases of the document's own: H2O, CO2, O3; left out: NO2, N2.\n", done.stdout)

    def test_without_ozone_red_is_brighter(self):
        with_ozone = rows(looked_at(GASES % '"o3": {"column": "0.3 atm-cm"}').stdout)["red"]
        without = rows(looked_at(GASES % '"o3": "off"').stdout)["red"]
        # Chappuis's bands take some 0.015 of a vertical beam at 0.665 um.
        self.assertTrue(1.01 < without[2] / with_ozone[2] < 1.04)

    def test_what_a_profile_leaves_open_is_said(self):
        sonde = '{"altitude": "1 km", "mixing_ratio": "40 ppb"}, {"altitude": "30 km", "mixing_ratio": "6 ppm"}'
        done = looked_at(GASES % f'"o3": {{"levels": [{sonde}]}}')
        self.assertEqual(done.returncode, 0)
        self.assertIn("warning: atmosphere: the profile of O3 begins at 1 km, above the ground at 0 km: its lowest value, 0.04 ppm, holds below\n", done.stderr)
        self.assertRegex(done.stderr, r"the profile of O3 ends at 30 km: above it the model atmosphere's goes on, \d+\.\d % of the column\n")


class Errors(unittest.TestCase):
    def refused(self, gases, *words, air=GASES):
        done = looked_at(air % gases)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"yard\.json:\d+:\d+: ")
        for word in words:
            self.assertIn(word, done.stderr)

    def test_unknown_gas(self):
        self.refused('"hcl": "off"', "'hcl'", "'h2o', 'co2', 'o3', 'n2o', 'co', 'ch4', 'o2', 'nh3', 'no', 'no2', 'so2' and 'n2'")
        self.refused('"o33": "off"', "'o33'", "did you mean 'o3'")

    def test_amounts(self):
        self.refused('"o3": {"column": "-3 DU"}', "-3 DU", "at least 0")
        self.refused('"o3": {"column": "3 ppm"}', "3 ppm", "DU")
        self.refused('"o3": "of"', "is the text \"of\", expected 'off'; did you mean 'off'?")
        self.refused('"no2": {}', "nothing is said of this gas: expected 'mixing_ratio', 'column' or 'levels', or \"off\" in place of all")
        self.refused('"no2": {"column": "1 DU", "mixing_ratio": "1 ppb"}', "mixing_ratio", "column")
        self.refused('"co2": {"mixing_ratio": "1500000 ppm"}', "1500000 ppm", "between 0 and 1000000 ppm")

    def test_heights(self):
        level = '{"altitude": "%s", "mixing_ratio": "1 ppm"}'
        two = '"co": {"levels": [%s, %s]}'
        self.refused(two % (level % "2 km", level % "1 km"), "the altitudes of a profile must rise: 1 km follows 2 km")
        self.refused(two % (level % "0 km", level % "120 km"), "a level at 120 km is above the air, which ends at 100 km")
        self.refused(two % (level % "-2 km", level % "-1 km"), "the profile of CO reaches from -2 to -1 km, and the air from 0 to 100 km")
        self.refused('"co": {"mixing_ratio": "1 ppm", "levels": [%s, %s]}' % (level % "0 km", level % "1 km"),
                     "'mixing_ratio' scales the model's profile, and 'levels' take its place: leave one out")

    def test_two_keys_of_one_gas(self):
        self.refused('"h2o": {"column": "1 g/cm2"}', "'h2o' of 'gases' and the atmosphere's 'water_vapour' are of the same gas: leave one out",
                     air=AIR + ', "gases": {%s}')


if __name__ == "__main__":
    unittest.main()
