"""Solved temperatures of scenes by chance against full solutions of their points (docs/developer/benchmarks.md)."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("IFOV_BUILD", str(ROOT / "build"))) / "bench_thermal"
SHORT = ["--points", "8", "--rays", "12", "--draws", "1600", "--threads", "1"]


def run(*arguments):
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "figures.json"
        result = subprocess.run(
            [PROGRAM, "--work", folder, "--output", output, *SHORT, *map(str, arguments)], capture_output=True, text=True, timeout=280
        )
        return result, json.loads(output.read_text())


@unittest.skipUnless(PROGRAM.exists(), "bench_thermal is not built (IFOV_BENCHMARKS)")
class WildThermal(unittest.TestCase):
    def test_half_widths_hold_and_those_that_claim_too_much_do_not(self):
        for scenes, seed in ((4, 312), (2, 318)):
            result, figures = run("--wild", scenes, "--first-seed", seed)
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertEqual(figures["thermal_points"]["value"], 8 * scenes)
            for name, row in figures.items():
                self.assertTrue(row["ok"], f"{name}: {row} {result.stdout}")
        # The second are off by more than chance is.
        result, figures = run("--wild", 2, "--first-seed", 318, "--boast", "0.01")
        self.assertFalse(figures["thermal_covered"]["ok"], result.stdout)


if __name__ == "__main__":
    unittest.main()
