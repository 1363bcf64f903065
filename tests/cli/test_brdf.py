"""`ifov brdf`: models and materials, their numbers against closed forms, the figure, and what is said of mistakes."""

import csv
import io
import math
import os
import re
import struct
import unittest

from program import ROOT, Folder, run

FIELD = """{"ifov": 1, "scene": {
  "materials": {
    "plaster": {"reflectance": 0.6, "scattering": {"oren_nayar": {"slope": "25 deg"}}},
    "lawn": {"reflectance": {"library": "grass, lawn"}},
    "leaf": {"reflectance": {"library": "leaf, aspen"}, "transmittance": {"library": "leaf, aspen"}},
    "steel": {"emissivity": 0.1, "scattering": "mirror"},
    "many": {"reflectance": [0.1, 0.3, 0.5], "texture": {"images": [{"file": "no.tif", "low_left": ["0 m", "0 m"],
             "size": ["1 m", "1 m"], "from": "0.4 um", "to": "0.7 um"}]}},
    "bright": {"reflectance": 0.6, "scattering": {"rpv": {"k": 0.8, "asymmetry": -0.1}}}
  },
  "objects": [{"mesh": {"file": "no.obj"}, "material": "plaster"}, {"plane": {}, "material": "lawn"}]},
 "light": {"sky": {"radiance": "10 W m-2 sr-1 um-1"}},
 "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [2, 2]}},
  "channels": [{"name": "NIR", "monochromatic": {"at": "0.86 um"}}]}}"""


def oren_nayar(rho, sigma, light, view, cos_azimuth):
    """Oren and Nayar 1994, eqs. 27 to 30; angles in radians."""
    s2 = sigma * sigma
    alpha, beta = max(light, view), min(light, view)
    c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    c2 = 0.45 * s2 / (s2 + 0.09) * (math.sin(alpha) - (0 if cos_azimuth >= 0 else (2 * beta / math.pi) ** 3))
    c3 = 0.125 * s2 / (s2 + 0.09) * (4 * alpha * beta / math.pi**2) ** 2
    once = c1 + cos_azimuth * c2 * math.tan(beta) + (1 - abs(cos_azimuth)) * c3 * math.tan((alpha + beta) / 2)
    again = 0.17 * s2 / (s2 + 0.13) * (1 - cos_azimuth * (2 * beta / math.pi) ** 2)
    return rho / math.pi * (once + rho * again)


def oren_nayar_reflectance(rho, sigma, light, steps=400):
    """Directional-hemispherical, by the midpoint rule."""
    total = 0.0
    for i in range(steps):
        view = (i + 0.5) / steps * math.pi / 2
        across = sum(oren_nayar(rho, sigma, light, view, math.cos((k + 0.5) / 90 * math.pi)) for k in range(90)) / 90
        total += 2 * math.pi * across * math.sin(view) * math.cos(view) * math.pi / 2 / steps
    return total


def lobes(text):
    """{(light, view): BRDF}, degrees, of the first table."""
    lights = [float(x) for x in re.findall(r"([\d.]+) deg", re.search(r"light from(.*)\n", text).group(1))]
    found = {}
    for line in text.split("light from")[1].split("\n\n")[0].splitlines()[1:]:
        view, *values = map(float, line.split())
        found.update({(light, view): value for light, value in zip(lights, values)})
    return found


def shares(text):
    """{zenith: numbers}, of the second table."""
    return {float(words[0]): [float(w) for w in words[1:]]
            for words in (line.split() for line in text.split("zenith deg")[1].splitlines()[1:])}


class Models(unittest.TestCase):
    def test_a_factor_is_one_where_none_is_given(self):
        pane = ("brdf", "slab", "--set", "n=1.5", "--set", "k=0", "--set", "thickness=4 mm")
        done = run(*pane)
        self.assertIn("\n  reflectance 1, ", done.stdout)
        reflectance, transmittance, emissivity = shares(done.stdout)[0]
        self.assertAlmostEqual(reflectance, 2 * 0.04 / 1.04, 4)  # both faces: 2 R / (1 + R)
        self.assertAlmostEqual(transmittance, 0.96 / 1.04, 4)
        self.assertAlmostEqual(emissivity, 0, 4)
        soiled = shares(run(*pane, "--reflectance", "0.3").stdout)[0]
        self.assertAlmostEqual(soiled[0], 0.3 * reflectance, 4)
        self.assertIn("\n  reflectance 0.3", run("brdf", "lambertian").stdout)

    def test_a_model_alone_is_shown_at_a_usual_wavelength(self):
        with Folder() as folder:
            sea = ("brdf", "sea", "--set", "wind=5")
            self.assertEqual(run(*sea).stdout, run(*sea, "--at", "0.55um").stdout)
            self.assertTrue(run(*sea).stdout.startswith("sea, 0.55 um\n"))
            self.assertNotEqual(run(*sea).stdout, run(*sea, "--at", "2um").stdout)
            self.assertEqual(run(*sea, "--plot", "sea.png", cwd=folder).returncode, 0)
            beyond = run("brdf", "lambertian", "--reflectance", '{"table": {"wavelength": ["8 um", "12 um"], "values": [0.1, 0.2]}}')
            self.assertIn("0.55 um is outside its spectra, which reach from 8 to 12 um", beyond.stderr)

    def test_lists_them_with_their_parameters(self):
        done = run("brdf", "--list")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 110)
        words = re.search(r"## scattering\n(.*?)\n## ", run("schema", "--markdown").stdout, re.DOTALL).group(1)
        with_parameters = re.findall(r"^\| `(\w+)` \|", words, re.MULTILINE)
        listed = re.findall(r"^(\w+)  ", done.stdout, re.MULTILINE)
        self.assertGreaterEqual(len(with_parameters), 3)
        self.assertEqual([key for key in listed if key in with_parameters], with_parameters)
        self.assertIn("mirror", listed)
        flat = re.sub(r"\s+", " ", done.stdout)
        self.assertIn("slope angle between 0 and 60 deg, or angle by a map, required: standard deviation of the facets' slope", flat)
        self.assertIn('hot_spot angle between 0 and 10 deg, or angle by a map, default "0 deg": half width', flat)
        self.assertRegex(flat, r"rho_c number between 0 and 1,[^:]* optional: the lower")

    def test_the_guide_has_them_as_they_are(self):
        tables = run("brdf", "--list", "--markdown").stdout
        self.assertGreater(len(tables.splitlines()), 10)
        self.assertIn(tables, (ROOT / "docs/guide/surfaces.md").read_text(),
                      "put what `ifov brdf --list --markdown` says into docs/guide/surfaces.md")

    def test_every_model_of_the_guide_is_in_the_theory(self):
        theory = (ROOT / "docs/theory/surfaces.md").read_text()
        for key in re.findall(r"^(\w+)  ", run("brdf", "--list").stdout, re.MULTILINE):
            self.assertIn(f"**`{key}`**", theory)

    def test_lambertian(self):
        done = run("brdf", "lambertian", "--reflectance", "0.42")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("lambertian\n  reflectance 0.42\n"), done.stdout)
        table = lobes(done.stdout)
        self.assertEqual({light for light, _ in table}, {0, 30, 60})
        self.assertEqual({view for _, view in table}, {15.0 * k for k in range(-5, 6)})
        for value in table.values():
            self.assertAlmostEqual(value, 0.42 / math.pi, 5)
        for reflectance, emissivity in shares(done.stdout).values():
            self.assertEqual((reflectance, emissivity), (0.42, 0.58))

    def test_oren_nayar(self):
        done = run("brdf", "oren_nayar", "--set", "slope=20 deg", "--reflectance", "0.6", "--light", "10,50")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("\n  reflectance 0.6, slope 20 deg\n", done.stdout)
        table = lobes(done.stdout)
        self.assertEqual(len(table), 22)
        for (light, view), value in table.items():
            cos_azimuth = 0.0 if view == 0 else math.copysign(1, view)  # above 0: on the side of the light
            expected = oren_nayar(0.6, math.radians(20), math.radians(light), math.radians(abs(view)), cos_azimuth)
            self.assertAlmostEqual(value / expected, 1, 4)
        for zenith, (reflectance, emissivity) in shares(done.stdout).items():
            self.assertAlmostEqual(reflectance, oren_nayar_reflectance(0.6, math.radians(20), math.radians(zenith)), 3)
            self.assertAlmostEqual(reflectance + emissivity, 1, 4)

    def test_numbers(self):
        with Folder() as folder:
            done = run("brdf", "oren_nayar", "--set", "slope=20 deg", "--csv", "out.csv", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (0, ""))
            self.assertEqual(done.stderr, "out.csv  (numbers of 'oren_nayar')\n")
            lines = [line for line in (folder / "out.csv").read_text().splitlines() if line[0] != "#"]
            rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
        lobe = [row for row in rows if row["quantity"] == "brdf" and row["light_zenith_deg"] == "60"]
        self.assertGreater(len(lobe), 179)
        views = [float(row["view_zenith_deg"]) for row in lobe]
        self.assertEqual(views, sorted(set(views)))
        self.assertLess(min(abs(view - 60) for view in views if view != 60), 0.02)
        for row in lobe:
            view = float(row["view_zenith_deg"])
            expected = oren_nayar(0.3, math.radians(20), math.radians(60), math.radians(abs(view)), math.copysign(1, view))
            if view != 0:
                self.assertAlmostEqual(float(row["value"]) / expected, 1, 5)
        by_angle = {q: [float(r["value"]) for r in rows if r["quantity"] == q] for q in ("reflectance", "emissivity")}
        self.assertEqual(len(by_angle["reflectance"]), 36)
        for reflectance, emissivity in zip(*by_angle.values()):
            self.assertAlmostEqual(reflectance + emissivity, 1, 6)

    def test_a_mirror_has_no_brdf(self):
        with Folder() as folder:
            done = run("brdf", "mirror", "--reflectance", "0.9", "--plot", "mirror.png", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (0, ""))
            self.assertIn("'mirror' sends all light in one direction: there is no BRDF to draw, and the figure shows its reflectance",
                          done.stderr)
            self.assertEqual((folder / "mirror.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        done = run("brdf", "mirror", "--reflectance", "0.9")
        self.assertIn("there is no BRDF to draw, and this is its reflectance", done.stdout)
        self.assertNotIn("principal", done.stdout)
        self.assertEqual(set(map(tuple, shares(done.stdout).values())), {(0.9, 0.1)})


class Materials(unittest.TestCase):
    def setUp(self):
        self.folder = Folder(field=FIELD)

    def tearDown(self):
        self.folder.__exit__()

    def brdf(self, *arguments):
        return run("brdf", "field.json", *arguments, cwd=self.folder.path)

    def test_is_the_same_as_the_model(self):
        """Neither the mesh nor the texture's image, which are not there, is read."""
        done = self.brdf("plaster")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        model = run("brdf", "oren_nayar", "--set", "slope=25 deg", "--reflectance", "0.6").stdout
        self.assertEqual(done.stdout.split("\n", 1), ["plaster: oren_nayar", model.split("\n", 1)[1]])

    def test_values_of_the_command_line_replace_those_of_the_document(self):
        done = self.brdf("plaster", "--set", "scene.materials.plaster.scattering.oren_nayar.slope=0 deg")
        self.assertEqual(set(lobes(done.stdout).values()), {0.19099})  # 0.6 / pi

    def test_spectra_and_wavelengths(self):
        done = self.brdf("leaf", "--at", "860 nm")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("leaf: lambertian, 0.86 um\n"), done.stdout)
        reflectance, transmittance, emissivity = shares(done.stdout)[0]
        self.assertGreater(min(reflectance, transmittance), 0.4)
        self.assertAlmostEqual(reflectance + transmittance + emissivity, 1, 4)
        self.assertAlmostEqual(lobes(done.stdout)[(30, -45)], reflectance / math.pi, 4)
        self.assertIn("what it transmits leaves the other side as Lambert's law says", done.stdout)
        self.assertLess(shares(self.brdf("leaf", "--at", "0.68um").stdout)[0][0], 0.1)
        self.assertAlmostEqual(shares(self.brdf("steel").stdout)[0][0], 0.9, 5)

    def test_one_of_several_curves(self):
        self.assertEqual(shares(self.brdf("many", "--curve", 3).stdout)[0], [0.5, 0.5])
        self.assertIn("curve 3 of 3; its texture is left out", self.brdf("many", "--curve", 3).stdout)
        self.assertRegex(self.brdf("many", "--curve", 4).stderr, r"^field\.json:\d+:\d+: 'many' has no curve 4; it has 1 to 3\n")

    def test_figure(self):
        sizes = {}
        for name, *more in (("plaster",), ("lawn", "--at", "0.55um"), ("steel",)):
            done = self.brdf(name, "--plot", f"{name}.png", *more)
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
            self.assertIn(f"{name}.png  (figure of '{name}', PNG)\n", done.stderr)
            png = (self.folder.path / f"{name}.png").read_bytes()
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
            sizes[name] = struct.unpack(">II", png[16:24])
        self.assertEqual(sizes["plaster"], sizes["lawn"])
        self.assertLess(sizes["steel"][1], sizes["lawn"][1] / 2)
        self.assertEqual(self.brdf("lawn", "--at", "0.55um", "--plot", "q.png", "--quiet").stderr, "")
        self.assertIn("q.png", os.listdir(self.folder.path))
        done = self.brdf("plaster", "--plot", "no/such/folder/a.png")
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_mistakes(self):
        choices = "There are 'plaster', 'lawn', 'leaf', 'steel', 'many' and 'bright'\n"
        for arguments, words in (
            (("field.json",), "which material of field.json? " + choices),
            (("field.json", "plastr"), "field.json: there is no material 'plastr'; did you mean 'plaster'? " + choices),
            (("field.json", "lawn"), "material 'lawn': its spectra reach from 0.35 to 14 um; say at which wavelength, such as --at 0.55um"),
            (("field.json", "lawn", "--at", "20um"), "material 'lawn': 20 um is outside its spectra, which reach from 0.35 to 14 um"),
            (("field.json", "bright"), "of light that comes 89 deg from the normal it sends back 1.638 times as much"),
            (("field.json", "lawn", "--at", "0.55"), "'0.55' is no wavelength; expected one with its unit, such as 0.55 um (units: um, nm)"),
            (("field.json", "lawn", "--at", "-1 um"), "'-1 um' is no wavelength"),
            (("field.json", "plaster", "--light", "30,95"), "--light is '30,95', expected zenith angles from 0 to 89 degrees, such as 0,30,60"),
            (("field.json", "plaster", "--light", "1,2,3,4,5,6,7"), "--light has 7 angles; at most 6 are shown"),
            (("field.json", "plaster", "--reflectance", "0.3"), "--reflectance is of a model; a material has its own"),
            (("lambertan",), "there is no scattering model 'lambertan'; did you mean 'lambertian'? There are 'lambertian', 'mirror', 'oren_nayar'"),
            (("oren_nayar",), "'oren_nayar' needs its parameters:\n  --set slope=...  angle between 0 and 60 deg, or angle by a map: standard deviation"),
            (("oren_nayar", "--set", "slope=20"), "slope' is the number 20 without a unit, expected an angle between 0 and 60 deg"),
            (("oren_nayar", "--set", "slope=20 deg", "--set", "slop=1"), "unknown key 'slop' in 'scene.materials.oren_nayar.scattering.oren_nayar'; did you mean 'slope'?"),
            (("oren_nayar", "--set", "slope"), "--set slope: there is no '='"),
            (("mirror", "--set", "slope=1"), "--set slope=1: 'mirror' has no parameters"),
            (("lambertian", "--reflectance", "1.3"), "reflectance' is the number 1.3, expected a number between 0 and 1"),
            (("lambertian", "--reflectance", '{"library": "grsas, lawn"}'), "did you mean 'grass, lawn'?"),
            ((), "brdf wants a model, or a document and a material; --list names the models"),
            (("--markdown",), "--markdown requires --list"),
        ):
            with self.subTest(arguments=arguments):
                done = run("brdf", *arguments, cwd=self.folder.path)
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertIn(words, done.stderr)
        located = self.brdf("lawn", "--at", "20um").stderr
        self.assertRegex(located, r"^field\.json:4:\d+: material 'lawn'")


if __name__ == "__main__":
    unittest.main()
