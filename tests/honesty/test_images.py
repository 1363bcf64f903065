"""Errors of an image as a whole, audited, against a plain path tracer (docs/developer/benchmarks.md)."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("IFOV_BUILD", str(ROOT / "build"))) / "bench_honesty"


@unittest.skipUnless(PROGRAM.exists(), "bench_honesty is not built (IFOV_BENCHMARKS)")
class Images(unittest.TestCase):
    def rows(self, only, seeds):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "figures.json"
            result = subprocess.run(
                [PROGRAM, "--images", "--only", only, "--seeds", str(seeds), "--work", folder, "--output", output],
                capture_output=True, text=True, timeout=280,
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            return json.loads(output.read_text()), result.stdout

    def test_audited_half_widths_hold(self):
        rows, told = self.rows("street_canyon", 4)
        self.assertTrue(rows["image_street_canyon"]["ok"], told)
        self.assertGreater(rows["image_street_canyon_stated"]["value"], 0.8, told)

    def test_an_audit_sees_through_what_samples_believe(self):
        rows, told = self.rows("fault", 3)
        self.assertTrue(rows["image_fault_pooled_too_much"]["ok"], told)


if __name__ == "__main__":
    unittest.main()
