"""Haze of a document's own: what `ifov check` and `ifov atmosphere` say of it, and what is said where it is wrong."""

import math
import re
import unittest

from program import Folder, run
from test_atmosphere import AIR, YARD, rows

OWN = '"optical_depth": 0.3, "angstrom": 1.3, "single_scattering_albedo": 0.9'
HAZE = AIR + ', "aerosol": {%s}'


RETRIEVAL = (
    "AERONET Version 3;\nSite,Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_Extinction-Total[440nm],AOD_Extinction-Total[675nm],AOD_Extinction-Total[870nm],"
    "Single_Scattering_Albedo[440nm],Single_Scattering_Albedo[675nm],Single_Scattering_Albedo[870nm],Asymmetry_Factor-Total[440nm],"
    "Asymmetry_Factor-Total[675nm],Asymmetry_Factor-Total[870nm]\n"
    "ARM_SGP,15:08:2019,13:02:10,{0[0]},{0[1]},{0[2]},0.9,0.9,0.9,0.65,0.65,0.65\n"
).format([0.3 * (nm / 550) ** -1.3 for nm in (440, 675, 870)])


class Looked(unittest.TestCase):
    def looked_at(self, haze, **files):
        with Folder(yard=YARD % (HAZE % haze)) as folder:
            for name, text in files.items():
                (folder / f"{name}.all").write_text(text)
            return run("atmosphere", "yard.json", cwd=folder)

    def same(self, one, other):
        self.assertEqual((one.returncode, other.returncode), (0, 0), one.stderr + other.stderr)
        for channel in ("blue", "red"):
            for a, b in zip(rows(one.stdout)[channel], rows(other.stdout)[channel]):
                if a:
                    self.assertAlmostEqual(b / a, 1.0, delta=1e-3)


class MoreThanNumbers(Looked):
    def test_a_retrieval_is_the_haze_of_its_numbers(self):
        numbers = self.looked_at(OWN + ', "asymmetry": 0.65')
        retrieval = self.looked_at('"aeronet": {"file": "sgp.all"}', sgp=RETRIEVAL)
        self.same(numbers, retrieval)
        self.assertIn("Haze of the document's own: a retrieval of AERONET, from the ground to the end of the air, falling to 1/e over 2 km. "
                      "Aerosol in all: 0.307 at 0.55 um.", retrieval.stdout)

    def test_halves_are_a_whole(self):
        whole = self.looked_at(OWN + ', "asymmetry": 0.65, "top": "2 km"')
        half = "{%s}" % (OWN.replace("0.3", "0.15") + ', "asymmetry": 0.65, "top": "2 km"')
        mixed = self.looked_at(f'"mixture": [{half}, {half}]')
        self.same(whole, mixed)
        self.assertIn("optical depth 0.15 at 0.55 um, from the ground to 2 km; optical depth 0.15 at 0.55 um, from the ground to 2 km.", mixed.stdout)
        table = self.looked_at(OWN + ', "asymmetry": 0.65, "heights": [{"altitude": "0 m", "density": 5}, {"altitude": "2 km", "density": 5}]')
        self.same(whole, table)

    def test_what_is_said_where_it_is_wrong(self):
        height = '{"altitude": "%s", "density": 1}'
        two = OWN + ', "asymmetry": 0.65, "heights": [%s, %s]'
        for haze, message in (
            ('"aeronet": {"file": "sgp.all"}, "angstrom": 1', "'angstrom' needs the key 'optical_depth' beside it"),
            ('"mixture": [{"aeronet": {"file": "sgp.all"}, "angstrom": 1}]', "'angstrom' follows from the file of 'aeronet': leave one out"),
            ('"aeronet": {"file": "sgp.all", "time": "2019-08-16T00:00:00Z"}', "sgp.all:2: found no retrieval of 2019-08-16T00:00:00Z; the file has 1 from 2019-08-15T13:02:10Z"),
            ('"aeronet": {"file": "sgp.all"}, "type": "urban"', "'type' is of the tables' haze, and 'aeronet' of haze of one's own: leave one out"),
            ('"top": "2 km"', "'top' needs 'optical_depth' or 'aeronet' beside it"),
            ('"mixture": [{%s, "asymmetry": 0.6}], "top": "2 km"' % OWN, "'top' is of one part of the 'mixture': say it there"),
            ('"mixture": [{"optical_depth": 0.2}]', "'optical_depth' needs 'angstrom'"),
            ('"mixture": [{"asymmetry": 0.2}]', "needs exactly one of 'optical_depth'"),
            (two % (height % "2 km", height % "1 km"), "the altitudes of haze must rise: 1 km follows 2 km"),
            (two % (height % "2 km", height % "120 km"), "the haze reaches to 120 km, above the air, which ends at 100 km"),
            (two % (height % "-1 km", height % "2 km"), "the haze begins at -1 km, inside the ground, which is at 0 km"),
            (two % (height % "0 km", height % "2 km") + ', "base": "0 km"', "'base' and 'heights' both say where the haze is: leave one out"),
        ):
            done = self.looked_at(haze, sgp=RETRIEVAL)
            self.assertEqual((done.returncode, done.stdout), (1, ""), haze)
            self.assertIn(message, done.stderr)
            self.assertIn("yard.json:", done.stderr + "yard.json:" * haze.startswith('"aeronet": {"file": "sgp.all", "time"'))


class Kinds(Looked):
    """Optics of one of the types, by its name."""

    def test_are_those_of_the_type(self):
        told = self.looked_at('"optical_depth": 0.3, "kind": "biomass burning", "top": "2 km"')
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertIn("Haze of the document's own: biomass burning, optical depth 0.3 at 0.55 um, from the ground to 2 km.", told.stdout)
        mixed = self.looked_at('"mixture": [{"optical_depth": 0.1, "kind": "biomass burning", "top": "2 km"}, '
                               '{"optical_depth": 0.2, "kind": "biomass burning", "humidity": "10 %", "top": "2 km"}]')
        self.same(told, mixed)
        other = self.looked_at('"optical_depth": 0.3, "kind": "savanna burning", "top": "2 km"')
        self.assertNotAlmostEqual(rows(other.stdout)["blue"][0], 0.0)
        self.assertGreater(
            max(abs(b / a - 1.0) for a, b in zip(rows(told.stdout)["red"], rows(other.stdout)["red"]) if a), 0.01, "the other smoke is the same"
        )

    def test_types_are_known(self):
        for kind in ("desert", "continental clean", "continental average", "continental polluted", "biomass burning", "savanna burning"):
            done = self.looked_at('"type": "%s", "aot550": 0.2' % kind)
            self.assertEqual((done.returncode, done.stderr), (0, ""), kind)
            self.assertIn(f"Aerosol: {kind}, visibility", done.stdout)

    def test_what_is_said_where_it_is_wrong(self):
        for haze, message in (
            ('"type": "desrt"', "'desert'"),
            ('"type": "continental"', "'continental clean', 'continental average', 'continental polluted', 'desert', 'biomass burning' or 'savanna burning'"),
            ('"optical_depth": 0.3, "kind": "smoke"', "'biomass burning'"),
            ('"optical_depth": 0.3, "kind": "desert", "angstrom": 1', "'angstrom' follows from the 'kind', 'desert': leave one out"),
            ('"optical_depth": 0.3, "kind": "desert", "asymmetry": 0.7', "cannot stand beside"),
            ('"optical_depth": 0.3, "kind": "desert", "humidity": "120 %"', "120 %"),
            ('"optical_depth": 0.3, "angstrom": 1, "single_scattering_albedo": 0.9, "asymmetry": 0.7, "humidity": "50 %"', "'humidity' needs the key 'kind' beside it"),
            ('"kind": "desert"', "'kind' needs the key 'optical_depth' beside it"),
        ):
            done = self.looked_at(haze)
            self.assertEqual((done.returncode, done.stdout), (1, ""), haze)
            self.assertIn(message, done.stderr)
            self.assertIn("yard.json:", done.stderr)


class Told(unittest.TestCase):
    def test_by_the_table(self):
        with Folder(yard=YARD % (HAZE % (OWN + ', "asymmetry": 0.65, "top": "2 km"'))) as folder:
            done = run("atmosphere", "yard.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn(
                "Haze of the document's own: optical depth 0.3 at 0.55 um, from the ground to 2 km. "
                "Aerosol in all: 0.307 at 0.55 um.",
                done.stdout,
            )

    def test_by_check(self):
        with Folder(yard=YARD % (HAZE % (OWN + ', "asymmetry": 0.65, "wavelength": "0.44 um"') + ', "interval": "numerical"')) as folder:
            done = run("check", "yard.json", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(
                "haze: the document's own, optical depth 0.3 at 0.44 um, from the ground to the end of the air, falling to 1/e "
                "over 2 km; light that it scatters is not polarized, and the error of the model of the air is that of gases and of haze of the "
                "tables: how far this haze is from the air it does not know",
                done.stdout,
            )

    def test_takes_what_it_should_of_the_beam(self):
        with Folder(yard=YARD % (HAZE % (OWN + ', "asymmetry": 0.65')), clear=YARD % (HAZE % '"type": "none"')) as folder:
            hazy = rows(run("atmosphere", "yard.json", cwd=folder).stdout)
            clear = rows(run("atmosphere", "clear.json", cwd=folder).stdout)
        # Depth 0.307 (with the stratosphere's) down at 30 degrees: to e^-0.309/cos 30 at 0.55 um, here at 0.665.
        expected = math.exp(-0.3 * (0.665 / 0.55) ** -1.3 / math.cos(math.radians(30)))
        self.assertAlmostEqual(hazy["red"][1] / clear["red"][1] / expected, 1.0, delta=0.015)

    def test_of_a_table_as_of_its_asymmetry(self):
        """A table of Henyey and Greenstein's function scatters as the asymmetry does."""
        g = 0.65
        table = "angle_deg, 0.55\n" + "".join(
            f"{d}, {(1 - g * g) / (1 + g * g - 2 * g * math.cos(math.radians(d))) ** 1.5:.6g}\n" for d in range(0, 181, 2)
        )
        with Folder(
            one=YARD % (HAZE % (OWN + ', "asymmetry": 0.65')), other=YARD % (HAZE % (OWN + ', "phase_function": "p.csv"'))
        ) as folder:
            (folder / "p.csv").write_text(table)
            one, other = (rows(run("atmosphere", name, cwd=folder).stdout) for name in ("one.json", "other.json"))
        for channel in ("blue", "red"):
            for a, b in zip(one[channel], other[channel]):
                if a:
                    self.assertAlmostEqual(b / a, 1.0, delta=1e-3)


    def test_of_spheres(self):
        """Droplets of 10 um take alike of blue and red, some more of the thermal; fine haze takes much more of blue."""
        water = '"optical_depth": 1, "base": "1 km", "top": "2 km", "mie": {"effective_radius": "10 um", "index": "water"}'
        fine = '"optical_depth": 1, "top": "2 km", "mie": {"radius": "0.05 um", "sigma": 1.6, "index": [1.45, 0]}'
        with Folder(clear=YARD % (HAZE % '"type": "none"'), water=YARD % (HAZE % water), fine=YARD % (HAZE % fine)) as folder:
            clear, water, fine = (run("atmosphere", f"{name}.json", cwd=folder) for name in ("clear", "water", "fine"))
        self.assertIn("spheres, optical depth 1 at 0.55 um, from 1 km to 2 km", water.stdout)
        clear, water, fine = (rows(done.stdout) for done in (clear, water, fine))
        depth = lambda hazy, channel: -math.log(hazy[channel][1] / clear[channel][1]) * math.cos(math.radians(30))
        self.assertAlmostEqual(depth(water, "red"), 1.0, delta=0.03)
        self.assertAlmostEqual(depth(water, "blue"), 1.0, delta=0.03)
        self.assertAlmostEqual(depth(water, "thermal"), 1.0, delta=0.2)
        self.assertGreater(depth(fine, "blue"), 1.5 * depth(fine, "red"))
        self.assertLess(depth(fine, "thermal"), 0.01)
        # The cloud glows: its sky is warmer than that of clear air.
        self.assertGreater(water["thermal"][8], clear["thermal"][8] + 20)


class Errors(unittest.TestCase):
    def refused(self, aerosol, words, place, files=None, more=""):
        text = YARD % (HAZE % aerosol + more)
        with Folder(yard=text) as folder:
            for name, content in (files or {}).items():
                (folder / name).write_text(content)
            done = run("check", "yard.json", cwd=folder)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(words, done.stderr)
        line, column = map(int, re.match(r"yard\.json:(\d+):(\d+): ", done.stderr).groups())
        source = text.splitlines()[line - 1]
        self.assertTrue(source[column - 1 :].startswith(place), f"{place} is not at {line}:{column}: {source}")

    def test_two_measures(self):
        self.refused(OWN + ', "asymmetry": 0.6, "visibility": "23 km"', "cannot stand beside", '"')
        self.refused(OWN + ', "asymmetry": 0.6, "aot550": 0.2', "cannot stand beside", '"')

    def test_albedo_beyond_1(self):
        self.refused('"optical_depth": 0.3, "angstrom": 1, "asymmetry": 0.6, "single_scattering_albedo": 1.02', "1.02", "1.02")
        self.refused(
            '"optical_depth": 0.3, "angstrom": 1, "asymmetry": 0.6, "single_scattering_albedo": {"csv": "a.csv", "wavelength_unit": "um"}',
            "a single-scattering albedo of 1.02 at 0.7 um: expected 0 to 1",
            '{"csv"',
            {"a.csv": "0.3,0.9\n0.7,1.02\n12,0.5\n"},
        )

    def test_integral_of_a_table(self):
        self.refused(
            OWN + ', "phase_function": "p.csv"',
            "the phase function of 0.55 um integrates to 13.82 over the sphere, 10 % more than 4 pi",
            '"p.csv"',
            {"p.csv": "angle 0.55\n0 1.1\n60 1.1\n120 1.1\n180 1.1\n"},
        )

    def test_where_it_is(self):
        own = OWN + ', "asymmetry": 0.6'
        self.refused(own + ', "top": "120 km"', "the haze reaches to 120 km, above the air, which ends at 100 km", '"120 km"')
        self.refused(own + ', "top": "2 km", "base": "3 km"', "the haze begins at 3 km, not below its top at 2 km", '"3 km"')
        self.refused(
            own + ', "base": "1 km"',
            "the haze begins at 1 km, inside the ground, which is at 1.5 km",
            '{"optical_depth"',
            more=', "ground_altitude": "1.5 km"',
        )

    def test_what_it_needs(self):
        self.refused('"optical_depth": 0.3', "'optical_depth' needs 'angstrom'", "0.3")
        self.refused('"optical_depth": 0.3, "angstrom": 1', "'optical_depth' needs 'single_scattering_albedo'", "0.3")
        self.refused(OWN, "'optical_depth' needs 'asymmetry', 'phase_function', 'mie' or 'kind'", "0.3")
        self.refused(OWN + ', "asymmetry": 0.6, "type": "rural"', "'type' is of the tables' haze, and 'optical_depth' of haze of one's own: leave one out, or name the type by 'kind'", '"type"')
        self.refused('"asymmetry": 0.6', "'asymmetry' needs the key 'optical_depth' beside it", '{"asymmetry"')

    def test_spheres(self):
        spheres = '"optical_depth": 0.3, "mie": {%s}'
        self.refused(spheres % '"effective_radius": "10 um", "index": "watr"', "there is no refractive index of 'watr'; there are", '"watr"')
        self.refused(spheres % '"radius": "1 um", "index": "water"', "'radius' needs 'sigma'", '"1 um"')
        self.refused(spheres % '"radius": "1 um", "sigma": 2, "effective_radius": "2 um", "index": "water"', "cannot stand beside", '"')
        self.refused(
            spheres % '"radius": "50 um", "sigma": 2, "index": [1.4, 0]', "spheres of up to 3.9e+03 um: expected 1.59e+03 um or less", '{"radius"'
        )
        self.refused(
            spheres % '"radius": "0.1 um", "sigma": 2, "index": [1.4, 0]' + ', "angstrom": 1',
            "'angstrom' follows from the spheres of 'mie': leave one out",
            '"angstrom"',
        )


if __name__ == "__main__":
    unittest.main()
