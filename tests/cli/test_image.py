"""An image that is sampled as a whole, pooled and audited: the same bytes whoever takes its tiles."""

import signal
import subprocess
import unittest

from program import PROGRAM, Folder, WholeProducts, products, run
from test_mpi import HAS_MPI, MPIRUN, mpirun
from test_runs import wait_for_tiles

# Tiles of 9 pixels cut blocks of 8; sky and other surfaces light the ground, so that there is something to pool.
SCENE = """{
  "ifov": 1,
  "seed": 5,
  "scene": {
    "materials": {
      "ground": {"reflectance": 0.3, "temperature": "20 degC"},
      "ball": {"reflectance": 0.6, "temperature": "35 degC"}
    },
    "objects": [
      {"plane": {}, "material": "ground"},
      {"sphere": {"center": ["-3 m", "2 m", "1 m"], "radius": "2.3 m"}, "material": "ball"},
      {"sphere": {"center": ["4 m", "-3 m", "1 m"], "radius": "1.7 m"}, "material": "ball"}
    ]
  },
  "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"radiance": {"table": {"wavelength": ["0.3 um", "1 um", "3 um"], "values": ["30 W m-2 sr-1 um-1", "30 W m-2 sr-1 um-1", "0 W m-2 sr-1 um-1"]}, "outside": "extend"}}},
  "sensor": {
    "camera": {"orthographic": {"gsd": "0.5 m", "pixels": [30, 26]}},
    "channels": [
      {"name": "red", "monochromatic": {"at": "0.65 um"}},
      {"name": "T", "monochromatic": {"at": "10 um"}}
    ]
  },
  "sampling": {"accuracy": {"error": "0.7 %", "of": "image", "pooling": true, "audit": 20}, "tile": 9},
  "output": {"formats": ["envi"]}
}
"""


class Image(WholeProducts, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(scene=SCENE)
        done = run("render", "scene.json", "-j", 1, "--no-state", cwd=cls._folder.path)
        assert done.returncode == 0, done.stderr
        cls.reference = products(cls._folder.path / "scene.out")

    def test_any_number_of_threads(self):
        with Folder(scene=SCENE) as folder:
            done = run("render", "scene.json", "-j", 2, "--no-state", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.expect_whole(folder / "scene.out")

    def test_other_random_numbers_are_told_apart(self):
        with Folder(scene=SCENE.replace('"seed": 5', '"seed": 6')) as folder:
            self.assertEqual(run("render", "scene.json", "-j", 2, "--no-state", cwd=folder).returncode, 0)
            with self.assertRaises(AssertionError):
                self.expect_whole(folder / "scene.out")

    def test_shares_that_are_merged(self):
        with Folder(scene=SCENE) as folder:
            for share in (1, 2):
                done = run("render", "scene.json", "-j", 2, "--tiles", f"{share}/2", cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
            done = run("merge", "scene.out.1-of-2", "scene.out.2-of-2", "--output", "scene.out", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.expect_whole(folder / "scene.out")

    def test_a_run_that_was_killed_and_resumed(self):
        with Folder(scene=SCENE) as folder:
            first = subprocess.Popen([PROGRAM, "render", "scene.json", "-j", "1"], cwd=folder, stdout=subprocess.DEVNULL,
                                     stderr=subprocess.DEVNULL)
            wait_for_tiles(folder / "scene.out")
            first.send_signal(signal.SIGKILL)
            first.wait()
            done = run("render", "scene.json", "-j", 2, "--resume", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.expect_whole(folder / "scene.out")

    @unittest.skipUnless(MPIRUN, "mpirun is not installed (Debian: openmpi-bin)")
    @unittest.skipUnless(HAS_MPI, "ifov was built without MPI")
    def test_two_ranks(self):
        with Folder(scene=SCENE) as folder:
            done = mpirun(2, "render", "scene.json", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.expect_whole(folder / "scene.out")


if __name__ == "__main__":
    unittest.main()
