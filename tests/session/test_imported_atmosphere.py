"""Plains under imported runs: MODTRAN's own radiance comes back, and what is wrong is said at its place."""

import json
import math
import os
import re
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SOURCE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("IFOV_TRUTH", SOURCE / ".." / "shared" / "truth")).resolve() / "atmosphere"
PASADENA = DATA / "modtran6_isofit_pasadena"
THREE = PASADENA / "multi_AOT550-0.1000_H2OSTR-1.5000.chn"
GROUND_K = 292.625  # of these runs, from their log
TOLERANCE = 0.01


class Scene:
    """A Lambertian plain of one albedo, in the folder of a test."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def document(self, channels, imported, albedo=0.3, zenith_deg=51.99):
        return {
            "ifov": 1,
            "scene": {
                "materials": {"plain": {"reflectance": albedo, "temperature": f"{GROUND_K} K"}},
                "objects": [{"plane": {}, "material": "plain"}],
            },
            "light": {
                "sun": {"point": {"zenith": f"{zenith_deg} deg", "azimuth": "160 deg"}},
                "surroundings": {"reflectance": albedo},
            },
            "atmosphere": {"imported": imported},
            "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [1, 1]}}, "channels": channels},
            "sampling": {"grid": {"elements": [1, 1]}},
        }

    def run(self, command, document, *more):
        path = self.folder / "scene.json"
        path.write_text(json.dumps(document, indent=1))
        return subprocess.run([PROGRAM, command, path, *more], capture_output=True, text=True, timeout=200, check=False)

    def radiance(self, document):
        out = self.folder / "out"
        done = self.run("render", document, "--output", out)
        if done.returncode not in (0, 6):  # what a file leaves out is warned of
            raise AssertionError(done.stderr)
        return [v for (v,) in struct.iter_unpack("<f", (out / "image_radiance.img").read_bytes())]


def blocks(path):
    """Of a channel file: lists of (centre in nm, fwhm in nm, total radiance in W m-2 sr-1 um-1)."""
    found = []
    for line in path.read_text().splitlines():
        if "1ST SPECTRAL" in line:
            found.append([])
        if "FWHM:" not in line:
            continue
        number, fwhm = line.split(), line.split("FWHM:")[1].split()[0]
        found[-1].append((float(number[0]), float(fwhm), float(number[6]) * 1e4 / (float(number[8]) * 1e-3)))
    return found


def gaussians(block):
    return [{"gaussian": {"center": f"{nm} nm", "fwhm": f"{fwhm} nm"}} for nm, fwhm, _ in block]


def worst(radiance, block):
    return max(abs(value / stated - 1.0) for value, (_, _, stated) in zip(radiance, block))


@unittest.skipUnless(PASADENA.is_dir(), f"reference data not found: {PASADENA}")
class Pasadena(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.blocks = dict(zip((0.0, 0.1, 0.5), blocks(THREE)))
        cls.channels = gaussians(cls.blocks[0.0])
        cls.temporary = tempfile.TemporaryDirectory()
        cls.scene = Scene(cls.temporary.name)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def of_plain(self, albedo, files, change=lambda document: None):
        document = self.scene.document(self.channels, {"files": [str(file) for file in files]}, albedo)
        change(document)
        return worst(self.scene.radiance(document), self.blocks[albedo])

    def test_three_albedos_return_each_run(self):
        for albedo, block in self.blocks.items():
            with self.subTest(albedo=albedo):
                self.assertEqual(len(block), 425)
                self.assertLess(self.of_plain(albedo, [THREE]), TOLERANCE)

    def test_one_run_tells_the_others(self):
        """From MODTRAN's coefficients of reflection and its spherical albedo, which have seven decimals: where next to
        nothing of the ground is seen they say nothing, so channels count in which it gives a tenth of the light."""
        text = THREE.read_text()
        first = Path(self.temporary.name) / "dark.chn"
        first.write_text(text[: text.index("1ST SPECTRAL", text.index("1ST SPECTRAL") + 1)])
        document = self.scene.document(self.channels, {"files": [str(first)]}, 0.5)
        for value, dark, bright in zip(self.scene.radiance(document), self.blocks[0.0], self.blocks[0.5]):
            if bright[2] > 1.1 * dark[2] and bright[2] > 1e-2:
                self.assertLess(abs(value / bright[2] - 1.0), 0.02, bright)

    def test_faults_are_noticed(self):
        def black_surroundings(document):
            document["light"]["surroundings"]["reflectance"] = 0.0

        self.assertGreater(self.of_plain(0.5, [THREE], black_surroundings), 3 * TOLERANCE)
        self.assertGreater(self.of_plain(0.1, [PASADENA / "AOT550-0.0100_H2OSTR-2.0000.chn"]), 3 * TOLERANCE)

    def test_errors_have_a_place(self):
        cases = {
            "input file; expected its output": {"files": [str(PASADENA / "multi_LUT_AOT550-0.1000_H2OSTR-1.5000.json")]},
            "and 'albedos' says 0.5": {"files": [str(THREE)], "albedos": [0, 0.5, 0.1]},
            "'albedos' has 2 numbers and the files hold 3 runs": {"files": [str(THREE)], "albedos": [0, 0.5]},
            "the files hold 4 paths": {"files": [str(THREE), str(PASADENA / "AOT550-0.0100_H2OSTR-2.0000.chn")]},
        }
        for message, imported in cases.items():
            with self.subTest(message=message):
                done = self.scene.run("check", self.scene.document(self.channels[:3], imported))
                self.assertEqual(done.returncode, 1)
                self.assertIn(message, done.stderr)
                self.assertRegex(done.stderr, r"scene\.json:\d+:\d+: ")
        far = [{"gaussian": {"center": "3 um", "fwhm": "20 nm"}}]
        done = self.scene.run("check", self.scene.document(far, {"files": [str(THREE)]}))
        self.assertRegex(done.stderr, r"scene\.json:\d+:\d+: .*goes from 0.37686 to 2.50054 um, and channel '3 um' needs")

    def test_looking_up_is_refused(self):
        sky = DATA / "modtran_tape7_pyradi" / "tape7.MWIRSun"
        channel = [{"gaussian": {"center": "4 um", "fwhm": "20 nm"}}]
        done = self.scene.run("check", self.scene.document(channel, {"files": [str(sky)]}))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"scene\.json:\d+:\d+: .*(looks up|has no)")


LOWTRAN = DATA / "lowtran7" / "C_US76_noaerosol_nadir100km_thermal_T300.tape7.txt"


@unittest.skipUnless(LOWTRAN.is_file(), f"reference data not found: {LOWTRAN}")
class WarmGround(unittest.TestCase):
    """LOWTRAN7 from space down to black ground of 300 K: transmittance and path as a table, its total radiance again."""

    CHANNELS = ((4.8, 0.2), (8.7, 0.4), (9.6, 0.3), (10.9, 0.6), (12.5, 0.5))

    @staticmethod
    def planck(um, kelvin):
        return 1.191042972e8 / um**5 / math.expm1(14387.76877 / (um * kelvin))

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.scene = Scene(self.temporary.name)
        self.rows = []
        for line in LOWTRAN.read_text().splitlines():
            found = re.match(r" *(\d+)\. +(\d\.\d+) +(\d\.\d+E-\d+) ", line)
            if found and 500 < int(found[1]) < 3300:
                um = 1e4 / int(found[1])
                self.rows.append((um, float(found[2]), float(found[3]) * 1e8 / um**2))
        self.rows.sort()

    def tearDown(self):
        self.temporary.cleanup()

    def totals(self):
        """By channel, of the program's own column."""
        sums = []
        for centre, fwhm in self.CHANNELS:
            weights = [math.exp(-4 * math.log(2) * ((um - centre) / fwhm) ** 2) for um, _, _ in self.rows]
            steps = [self.rows[min(i + 1, len(self.rows) - 1)][0] - self.rows[max(i - 1, 0)][0] for i in range(len(self.rows))]
            shares = [w * d for w, d in zip(weights, steps)]
            sums.append(sum(s * row[2] for s, row in zip(shares, self.rows)) / sum(shares))
        return sums

    def radiance(self, ground_k):
        lines = ["wavelength_um,ground_sensor_transmittance,thermal_path_radiance"]
        lines += [f"{um:.8f},{t},{max(0.0, total - t * self.planck(um, 300.0)):.8g}" for um, t, total in self.rows]
        (self.scene.folder / "path.csv").write_text("\n".join(lines) + "\n")
        channels = [{"gaussian": {"center": f"{um} um", "fwhm": f"{fwhm} um"}} for um, fwhm in self.CHANNELS]
        document = self.scene.document(channels, {"files": ["path.csv"]}, albedo=0.0)
        document["scene"]["materials"]["plain"]["temperature"] = f"{ground_k} K"
        del document["light"]["sun"]
        return self.scene.radiance(document)

    def test_its_own_radiance_comes_back(self):
        self.assertGreaterEqual(len(self.rows), 500)
        far = max(abs(ours / theirs - 1.0) for ours, theirs in zip(self.radiance(300.0), self.totals()))
        self.assertLess(far, 0.004)
        # The planted fault: ground of another temperature.
        cold = max(abs(ours / theirs - 1.0) for ours, theirs in zip(self.radiance(295.0), self.totals()))
        self.assertGreater(cold, 0.03)


class Tables(unittest.TestCase):
    """The project's own table of a path."""

    RED = [{"monochromatic": {"at": "0.65 um"}}]
    ROWS = "0.6,0.8,10,0.05,0.7\n0.7,0.9,8,0.03,0.8\n"
    HEADING = "wavelength_um,ground_sensor_transmittance,solar_path_radiance,spherical_albedo,direct_sun_ground_transmittance"

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.scene = Scene(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def document(self, heading=HEADING, rows=ROWS, **more):
        (self.scene.folder / "path.csv").write_text(heading + "\n" + rows)
        return self.scene.document(self.RED, {"files": ["path.csv"], **more})

    def messages(self, document):
        return self.scene.run("check", document).stderr

    def test_what_is_absent_is_said(self):
        self.assertIn("does not tell the diffuse irradiance of the ground: the sky is black", self.messages(self.document()))
        for name, message in (
            ("ground_sensor_transmittance", "has no ground_sensor_transmittance; there are "),
            ("solar_path_radiance", "has no solar_path_radiance; there are "),
            ("direct_sun_ground_transmittance", "nothing tells the direct sunlight at the ground; add a run over ground"),
        ):
            names = self.HEADING.split(",")
            keep = [i for i, each in enumerate(names) if each != name]
            rows = "".join(",".join(row.split(",")[i] for i in keep) + "\n" for row in self.ROWS.splitlines())
            with self.subTest(absent=name):
                error = self.messages(self.document(",".join(names[i] for i in keep), rows))
                self.assertIn(message, error)
                self.assertRegex(error, r"scene\.json:\d+:\d+: ")

    def test_plain_is_lit_as_the_table_says(self):
        """L = path + view (sun cos + diffuse) / pi r / (1 - r S), by hand, with the sky's irradiance in the table."""
        document = self.document(self.HEADING + ",diffuse_irradiance,solar_irradiance",
                                 "0.6,0.8,10,0.05,0.7,150,1700\n0.7,0.8,8,0.05,0.7,150,1700\n")
        cosine = 0.6157982  # of 51.99 degrees
        reflected = 0.3 / (1.0 - 0.3 * 0.05) * 0.8 * (1700.0 * cosine * 0.7 + 150.0) / 3.14159265
        self.assertAlmostEqual(self.scene.radiance(document)[0], 9.0 + reflected, delta=1e-4 * reflected)
        del document["light"]["sun"]
        self.assertIn("holds direct sunlight, and the document has no Sun", self.messages(document))

    def test_polarizers_are_told_that_runs_know_no_polarization(self):
        """A note, not an error: half of the light passes whichever way the polarizer stands."""
        note = "polarization: sky and path of imported runs are taken to be unpolarized"
        document = self.document(self.HEADING + ",diffuse_irradiance,solar_irradiance",
                                 "0.6,0.8,10,0.05,0.7,150,1700\n0.7,0.8,8,0.05,0.7,150,1700\n")
        self.assertNotIn(note, self.scene.run("check", document).stdout)
        radiance = self.scene.radiance(document)[0]
        document["sensor"]["channels"] = [{**self.RED[0], "name": angle, "polarizer": {"angle": f"{angle} deg", "extinction": 1000}}
                                          for angle in ("0", "30")]
        checked = self.scene.run("check", document)
        self.assertIn(checked.returncode, (0, 6), checked.stderr)  # what the table leaves out is warned of
        self.assertIn(note, checked.stdout)
        for behind in self.scene.radiance(document):
            self.assertAlmostEqual(behind / radiance, 0.5 * (1.0 + 1e-3), delta=1e-5)
        self.assertIn(note, json.loads((self.scene.folder / "out" / "image_run.json").read_text())["notes"])
        document["sensor"].update(channels=self.RED, stokes=True)
        self.assertIn(note, self.scene.run("check", document).stdout)

    def test_sky_and_spectrum_are_the_runs_own(self):
        document = self.document(self.HEADING + ",diffuse_irradiance,solar_irradiance",
                                 "0.6,0.8,10,0.05,0.7,150,1700\n0.7,0.8,8,0.05,0.7,150,1700\n")
        document["light"]["sky"] = {"temperature": "270 K"}
        self.assertIn("the sky's irradiance follows from the imported runs: leave out 'sky'", self.messages(document))
        del document["light"]["sky"]
        document["light"]["sun"]["point"]["distance"] = "1 au"
        self.assertIn("leave out its 'spectrum' and 'distance'", self.messages(document))


class Uvspec(unittest.TestCase):
    """Three outputs of uvspec with radiance above the air and irradiance at the ground, made of known numbers."""

    DIRECT, DIFFUSE, ALBEDO, SEEN, PATH = 500.0, 150.0, 0.1, 0.7, 20.0

    def radiance(self, r):
        return self.PATH + self.SEEN * (self.DIRECT + self.DIFFUSE) / 3.14159265 * r / (1.0 - r * self.ALBEDO)

    def files(self, folder, zenith_deg):
        names = []
        for r in (0.0, 0.3, 0.6):
            diffuse = (self.DIRECT + self.DIFFUSE) / (1.0 - r * self.ALBEDO) - self.DIRECT
            block = ""
            for nm in (600, 700):
                block += f"{nm} {self.DIRECT} {diffuse} 0 0 0 0\n 0.0\n1.0 0 0\n"
                block += f"{nm} 1000 0 0 0 0 0\n 0.0\n1.0 0 {self.radiance(r)}\n"
            (folder / f"a{r}.out").write_text(block)
            (folder / f"a{r}.inp").write_text(f"source solar\nsza {zenith_deg}\numu 1\nphi 0\nzout 0 toa\n")
            names.append(f"a{r}")
        return {
            "files": [f"{name}.out" for name in names],
            "uvspec_inputs": [f"{name}.inp" for name in names],
            "albedos": [0, 0.3, 0.6],
        }

    def test_radiance_above_the_air_comes_back(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(folder)
            imported = self.files(scene.folder, 51.99)
            found = scene.radiance(scene.document(Tables.RED, imported, 0.45))[0]
            self.assertAlmostEqual(found / self.radiance(0.45), 1.0, delta=1e-4)
            error = scene.run("check", scene.document(Tables.RED, imported, 0.45, zenith_deg=40.0)).stderr
            self.assertIn("the Sun stands 52.0 deg from the zenith; expected 40.0 deg, as in the document", error)
            less = {name: value for name, value in imported.items() if name != "albedos"}
            self.assertIn("give 'albedos', one for each of the 3 runs",
                          scene.run("check", scene.document(Tables.RED, less)).stderr)
            imported["uvspec_inputs"].pop()
            self.assertIn("2 files for 3 outputs of uvspec", scene.run("check", scene.document(Tables.RED, imported)).stderr)
            # Inputs beside their outputs need no key.
            del imported["uvspec_inputs"]
            self.assertEqual(scene.run("check", scene.document(Tables.RED, imported, 0.45)).returncode, 6)  # it has no ground_sensor_transmittance
            (scene.folder / "a0.0.inp").unlink()
            self.assertIn("expected the input file of uvspec beside them, as a0.0.inp, or under 'uvspec_inputs'",
                          scene.run("check", scene.document(Tables.RED, imported, 0.45)).stderr)


if __name__ == "__main__":
    unittest.main()
