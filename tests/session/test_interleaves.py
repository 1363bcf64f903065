"""How values lie in the ENVI cubes of a run: the same values band by band, line by line and pixel by pixel, for whoever reads them, from one
process or from runs that go on, of shares and of ranks."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

from images import PROGRAM, np, run

try:
    from osgeo import gdal
except ImportError:
    gdal = None
try:
    import spectral
except ImportError:
    spectral = None

WIDTH, LINES, BANDS = 70, 41, 5
ORDERS = {"bil": ((LINES, BANDS, WIDTH), (1, 0, 2)), "bsq": ((BANDS, LINES, WIDTH), (0, 1, 2)), "bip": ((LINES, WIDTH, BANDS), (2, 0, 1))}


def document(interleave=None, **output):
    """Balls on a lawn, five thermal and reflective channels, a detector that makes counts."""
    made = {"ifov": 1, "seed": 3,
            "scene": {"materials": {"lawn": {"emissivity": 0.97, "temperature": "290 K"}, "ball": {"emissivity": 0.9, "temperature": "320 K"}},
                      "objects": [{"plane": {}, "material": "lawn"},
                                  {"sphere": {"center": ["2 m", "-1 m", "1 m"], "radius": "2 m"}, "material": "ball"}]},
            "light": {"sky": {"temperature": "250 K"}},
            "sensor": {"camera": {"orthographic": {"gsd": "0.2 m", "pixels": [WIDTH, LINES]}},
                       "optics": {"f_number": 2, "throughput": 0.8},
                       "detector": {"pitch": "15 um", "integration_time": "0.2 ms", "quantum_efficiency": 0.7, "read_noise": "400 e-",
                                    "one_over_f": 0.05, "full_well": "9 Me-", "bits": 14},
                       "channels": [{"series": {"gaussian": {"from": "8 um", "to": "12 um", "count": BANDS, "fwhm": "0.5 um"}}}]},
            "sampling": {"tile": 16, "grid": {"elements": [2, 2]}},
            "output": {"products": ["abundance", "location", "samples", "reasons", "quality"], **output}}
    if interleave:
        made["output"]["interleave"] = interleave
    return made


def header_of(cube):
    text = pathlib.Path(f"{cube}.hdr").read_text()
    return dict(line.split(" = ", 1) for line in text.splitlines() if " = " in line)


def cube_of(path, interleave, bands=BANDS, kind="<f4"):
    """[band, line, sample], by the formulas of the format's page."""
    shape, axes = ORDERS[interleave]
    shape = tuple(bands if n == BANDS else n for n in shape)
    return np.fromfile(path, kind).reshape(shape).transpose(axes)


@unittest.skipIf(np is None, "numpy is missing")
class Interleaves(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.out = {}
        for interleave in (None, *ORDERS):
            folder = pathlib.Path(cls.scratch.name, str(interleave))
            folder.mkdir()
            done = run(document(interleave), folder)
            if done.returncode not in (0, 6):
                raise RuntimeError(done.stderr)
            cls.out[interleave] = folder / "out"

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def command(self, *arguments, cwd):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        return done.stdout

    def test_values_lie_as_the_header_says(self):
        plain = self.out[None] / "image_radiance.img"
        self.assertEqual(plain.read_bytes(), (self.out["bil"] / plain.name).read_bytes())
        expected = cube_of(plain, "bil")
        self.assertGreater(expected.std(), 0.1)
        for interleave in ORDERS:
            out = self.out[interleave]
            for name, kind in (("radiance", "<f4"), ("abundance", "<f4"), ("location", "<f8"), ("samples", "<u4"), ("reasons", "<u2")):
                path = out / f"image_{name}.img"
                self.assertEqual(header_of(path)["interleave"], interleave)
                bands = int(header_of(path)["bands"])
                np.testing.assert_array_equal(cube_of(path, interleave, bands, kind), cube_of(self.out["bil"] / path.name, "bil", bands, kind), name)
            record = json.loads((out / "image_run.json").read_text())
            self.assertEqual(record["image"]["interleave"], interleave)
            said = [file["what"] for file in record["files"] if file["name"] == "image_radiance.img"]
            self.assertEqual(said, ["radiance, 5 channels, ENVI" + ("" if interleave == "bil" else f" ({interleave})")])
        for interleave in ("bsq", "bip"):
            self.assertNotEqual((self.out[interleave] / plain.name).read_bytes(), plain.read_bytes())

    @unittest.skipIf(gdal is None, "GDAL is missing")
    def test_gdal_reads_them(self):
        gdal.UseExceptions()
        expected = cube_of(self.out["bil"] / "image_radiance.img", "bil")
        for interleave, word in (("bil", "LINE"), ("bsq", "BAND"), ("bip", "PIXEL")):
            image = gdal.Open(str(self.out[interleave] / "image_radiance.img"))
            self.assertEqual(image.GetMetadataItem("INTERLEAVE", "IMAGE_STRUCTURE"), word)
            np.testing.assert_array_equal(image.ReadAsArray(), expected)
            self.assertEqual(image.GetRasterBand(2).GetMetadataItem("wavelength_units"), "Micrometers")

    @unittest.skipIf(spectral is None, "SPy is missing")
    def test_spy_reads_them(self):
        expected = cube_of(self.out["bil"] / "image_radiance.img", "bil")
        for interleave in ORDERS:
            cube = spectral.open_image(str(self.out[interleave] / "image_radiance.img.hdr"))
            np.testing.assert_array_equal(np.asarray(cube.load()), expected.transpose(1, 2, 0))

    def test_commands_read_what_they_are_given(self):
        """What they say, and what they draw, is the same but for how it lies."""
        region = {interleave: self.command("info", "out", "--region", "10,5,40,30", cwd=self.out[interleave].parent) for interleave in ORDERS}
        self.assertEqual(len(set(region.values())), 1, region)
        for interleave, words in (("bsq", "band sequential"), ("bip", "band interleaved by pixel")):
            self.assertIn(words, self.command("info", "out/image_radiance.img", cwd=self.out[interleave].parent))
        drawn = {}
        for interleave in ORDERS:
            self.command("detect", "out", "--seed", 4, "--quantity", "radiance,counts", cwd=self.out[interleave].parent)
            for name, kind in (("noisy", "<f4"), ("counts", "<u2")):
                path = self.out[interleave] / f"image_{name}_4.img"
                self.assertEqual(header_of(path)["interleave"], interleave)
                drawn[name, interleave] = cube_of(path, interleave, kind=kind)
                np.testing.assert_array_equal(drawn[name, interleave], drawn[name, "bil"])

    def test_runs_that_go_on_and_shares_leave_the_same_bytes(self):
        for interleave in ("bsq", "bip"):
            folder = pathlib.Path(self.scratch.name, f"on_{interleave}")
            folder.mkdir()
            (folder / "scene.json").write_text(json.dumps(document(interleave), indent=1))
            for share in (1, 2):
                self.command("render", "scene.json", "-o", f"s{share}", "--tiles", f"{share}/2", cwd=folder)
            self.command("merge", "s1", "s2", "-o", "merged", cwd=folder)
            killed = subprocess.Popen([PROGRAM, "render", "scene.json", "-o", "stopped", "-j", "1", "--set", "sampling.grid.elements=[12, 12]"],
                                      cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while killed.poll() is None and not list(folder.glob("stopped/run.part/tiles/*.tiles")):
                time.sleep(0.005)
            killed.kill()
            killed.wait()
            again = ("render", "scene.json", "--set", "sampling.grid.elements=[12, 12]")
            self.command(*again, "-o", "stopped", "--resume", cwd=folder)
            self.command(*again, "-o", "at_once", cwd=folder)
            for out, other in (("merged", self.out[interleave]), ("stopped", folder / "at_once")):
                for name in ("radiance", "abundance", "location", "samples"):
                    self.assertEqual((folder / out / f"image_{name}.img").read_bytes(), (other / f"image_{name}.img").read_bytes(),
                                     f"{interleave} {out} {name}")

    @unittest.skipIf(shutil.which("mpirun") is None, "mpirun is missing")
    def test_ranks_leave_the_same_bytes(self):
        if "built without MPI" in subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=False).stdout:
            self.skipTest("built without MPI")
        folder = self.out["bip"].parent
        more = os.environ | {"HWLOC_HIDE_ERRORS": "2", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
        done = subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "3", PROGRAM, "render", "scene.json", "-o", "ranks"],
                              cwd=folder, capture_output=True, text=True, check=False, env=more)
        self.assertIn(done.returncode, (0, 6), done.stderr)
        for name in ("radiance", "location"):
            self.assertEqual((folder / "ranks" / f"image_{name}.img").read_bytes(), (self.out["bip"] / f"image_{name}.img").read_bytes())

    def test_another_word_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(document("pib"), pathlib.Path(folder))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"scene\.json:\d+:\d+: 'output\.interleave' is the text \"pib\", expected 'bil', 'bsq' or 'bip'\n")


if __name__ == "__main__":
    unittest.main()
