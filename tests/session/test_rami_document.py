"""HET01 of RAMI by way of the documents that examples/rami/make_scene.py writes, at two angles and a coarse accuracy (the
benchmark `rami` takes all at 0.2 %); leaves with reflectance and transmittance swapped must miss."""

import csv
import json
import math
import os
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SOURCE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("IFOV_TRUTH", SOURCE / ".." / "shared" / "truth")).resolve() / "rami" / "het01"
SCALE = math.pi / math.cos(math.radians(20.0))


@unittest.skipUnless(DATA.is_dir(), f"reference data not found: {DATA}")
class RamiDocuments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        make = SOURCE / "examples" / "rami" / "make_scene.py"
        subprocess.run([make, DATA, cls.folder.name, "-61", "-21", "61"], check=True)
        with (DATA / "expected_brf.csv").open() as file:
            cls.published = {float(row["view_zenith_deg"]): float(row["brf"]) for row in csv.DictReader(file)}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def deviation(self, angle, change=lambda document: None):
        """Of the reflectance factor from the published one, relative, and its standard error."""
        document = json.loads((Path(self.folder.name) / f"het01_{angle:+03.0f}.json").read_text())
        document["sampling"]["accuracy"]["error"] = "6 %"
        change(document)
        path = Path(self.folder.name) / "scene.json"
        path.write_text(json.dumps(document))
        out = Path(self.folder.name) / "out"
        done = subprocess.run([PROGRAM, "render", path, "--output", out], check=False, capture_output=True, timeout=200)
        assert done.returncode in (0, 5, 6), done.stderr
        radiance, error = ([v for (v,) in struct.iter_unpack("<f", (out / f"image_{name}.img").read_bytes())]
                           for name in ("radiance", "standard_error"))
        mean = sum(radiance) / len(radiance)
        return SCALE * mean / self.published[angle] - 1.0, math.hypot(*error) / len(error) / mean

    def test_published_reflectance_factors(self):
        for angle in (-21.0, 61.0):
            deviation, error = self.deviation(angle)
            self.assertLess(error, 0.0041)
            self.assertLess(abs(deviation), 0.01)

    def test_swapped_reflectance_and_transmittance_miss(self):
        def swap(document):
            leaf = document["scene"]["materials"]["leaf"]
            leaf["reflectance"], leaf["transmittance"] = leaf["transmittance"], leaf["reflectance"]

        deviation, error = self.deviation(-61.0, swap)
        self.assertGreater(abs(deviation), 0.01 + 4.0 * error)


if __name__ == "__main__":
    unittest.main()
