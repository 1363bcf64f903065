"""`ifov make`: what it writes is whole, repeatable, valid and as the guide says."""

import hashlib
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))
KINDS = ("suburb", "forest", "desert", "harbour")


def run(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=280)


def hashes(folder):
    return {
        str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(folder.rglob("*")) if file.is_file() and file.suffix != ".ifovcache"
    }


def vertices(mesh):
    for line in mesh.read_text().splitlines():
        if line.startswith("v "):
            yield tuple(float(word) for word in line.split()[1:4])


class Make(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls._folder.name)
        cls.made = {kind: run("make", kind, "--size", "60m", "--seed", 7, kind, cwd=cls.path) for kind in KINDS}

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def test_every_document_is_valid(self):
        """A spectrometer's channels and the air of each document take most of the time: the spectrometer is looked at in a tenth of
        its channels in the suburb, whose materials are the most, and in fewer elsewhere, over the same range; elsewhere one document
        with its air, which is the same in all, and the others without."""
        airless = ["--set", "atmosphere=null", "--set", 'light.sky={"none": {}}']
        # Air is worked out in steps of 20 cm-1: of the visible channels but those of the suburb's quicklook narrow ones are looked at.
        narrow = [word for k in range(4) for word in ("--set", f"sensor.channels[{k}].gaussian.fwhm=4 nm")]
        for kind in KINDS:
            self.assertEqual((self.made[kind].returncode, self.made[kind].stderr), (0, ""))
            documents = sorted(set((self.path / kind).glob("*.json")) - {self.path / kind / "scene.json"})
            self.assertEqual(len(documents), 4)
            spectrometer, oblique = self.path / kind / "render_vswir.json", self.path / kind / "oblique.json"
            self.assertIn('"from": "0.4 um", "to": "2.5 um", "count": 210', spectrometer.read_text())
            documents.remove(spectrometer)
            documents.remove(oblique)
            count = 21 if kind == "suburb" else 7
            bare = [] if kind == "suburb" else airless
            for checked, options, says in ((documents[:1], [] if kind == "suburb" else narrow, " pixels, "),
                                           (documents[1:], bare, "60 x 60 pixels, 3 channels"),
                                           ([oblique], bare or narrow, "640 x 420 pixels, 4 channels"),
                                           ([spectrometer], [*bare, "--set", f"sensor.channels[0].series.gaussian.count={count}",
                                                             "--set", "sensor.channels[0].series.gaussian.fwhm=3 nm"],
                                            f"60 x 60 pixels, {count} channels")):
                with self.subTest(kind=kind, options=options):
                    done = run("check", *checked, *options, cwd=self.path)
                    # What the air's own computation leaves, and how narrow its bands may be, is said of some channels.
                    warnings = [line for line in done.stderr.splitlines()
                                if "the air's own numerical error" not in line and "the atmosphere's band model resolves" not in line]
                    self.assertEqual((done.returncode in (0, 6), warnings), (True, []))
                    self.assertIn(says, done.stdout)

    def test_same_seed_same_bytes_other_seed_other_scene(self):
        first = hashes(self.path / "suburb")
        self.assertEqual(run("make", "suburb", "--size", "0.06 km", "--seed", 7, "again", "-q", cwd=self.path).stdout, "")
        self.assertEqual(first, hashes(self.path / "again"))
        self.assertEqual(run("make", "suburb", "--size", "60m", "--seed", 8, "other", cwd=self.path).returncode, 0)
        other = hashes(self.path / "other")
        for name in ("scene.json", "meshes/ground.obj", "meshes/oak_1_leaves.ply", "maps/lawn_cover.tif"):
            self.assertNotEqual(first[name], other[name], name)

    def test_the_suburb_holds_what_it_should(self):
        text = (self.path / "suburb" / "scene.json").read_text()
        counts = {}
        for mesh in (self.path / "suburb/meshes").glob("*_leaves.ply"):
            header = mesh.read_bytes()[:1000].decode("latin-1")
            counts.setdefault(mesh.name.split("_")[0], []).append(int(re.search(r"element face (\d+)", header)[1]))
        trees = {species: n for species, n in counts.items() if species not in ("hedge", "shrub")}
        self.assertGreaterEqual(len(trees), 3)
        for species, leaves in trees.items():
            self.assertGreaterEqual(len(set(leaves)), 2, species)
        fewest, most = map(int, re.search(r"(\d+) to (\d+) leaves each", self.made["suburb"].stdout).groups())
        self.assertTrue(20000 <= fewest < most <= 100000, (fewest, most))
        for part in ("_gabled.obj", "_hipped.obj", '"tennis court"', '"car"', '"pole"', '"wires"', "hedge_1"):
            self.assertIn(part, text)
        self.assertGreaterEqual(text.count('"temperature"'), 12)
        self.assertGreaterEqual(text.count('"transmittance"'), 4)

    def test_nothing_is_below_the_ground(self):
        folder = self.path / "suburb"
        for mesh in sorted((folder / "meshes").glob("*.obj")):
            # Trunks and poles stand a little in the ground; a court's base reaches below its surface.
            self.assertGreater(min(v[2] for v in vertices(mesh)), -0.4, mesh.name)
        for name in ("ground.obj", "lawn.obj"):
            self.assertGreaterEqual(min(v[2] for v in vertices(folder / "meshes" / name)), 0.0)
        for rows in (folder / "instances").glob("*.csv"):
            for line in rows.read_text().splitlines()[1:]:
                self.assertEqual(float(line.split(",")[2]), 0.15)

    def test_a_folder_that_exists_stays(self):
        before = hashes(self.path / "desert")
        refused = run("make", "forest", "--size", "60m", "desert", cwd=self.path)
        self.assertEqual((refused.returncode, refused.stdout), (1, ""))
        self.assertEqual(
            refused.stderr,
            "ifov: the folder 'desert' exists; give another name, or --force to replace it with all that is in it\n",
        )
        self.assertEqual(before, hashes(self.path / "desert"))
        (self.path / "notes.txt").write_text("mine")
        refused = run("make", "desert", "notes.txt", cwd=self.path)
        self.assertIn("'notes.txt' exists and is not a folder", refused.stderr)
        for kind in ("harbour", "desert"):
            self.assertEqual(run("make", kind, "--size", "60m", "replaced", "--force", cwd=self.path).returncode, 0)
        self.assertIn("A desert of 60 m", (self.path / "replaced" / "quicklook.json").read_text())
        left = [name for name in os.listdir(self.path) if name.endswith((".part", ".old"))]
        self.assertEqual(left, [])

    def test_mistakes_are_explained(self):
        done = run("make", "suburbs", "x", cwd=self.path)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no scene 'suburbs' to be made; did you mean 'suburb'?", done.stderr)
        self.assertIn("'forest'", done.stderr)
        done = run("make", "suburb", "--size", "20m", "x", cwd=self.path)
        self.assertEqual(done.stderr, "ifov: a scene can be 60 m to 1000 m wide; --size asks for 20 m\n")
        done = run("make", "suburb", "--size", "big", "x", cwd=self.path)
        self.assertIn("--size is 'big', expected a length such as 200m (units: m, km", done.stderr)
        self.assertFalse((self.path / "x").exists())


if __name__ == "__main__":
    unittest.main()
