"""data/atmosphere is what tools/make_atmosphere.py makes of the LOWTRAN7 tables."""

import importlib.util
import math
import os
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLES = pathlib.Path(os.environ.get("IFOV_TRUTH", ROOT.parent / "shared" / "truth")) / "atmosphere" / "lowtran7"
DATA = ROOT / "data" / "atmosphere"


def tool():
    spec = importlib.util.spec_from_file_location("make_atmosphere", ROOT / "tools" / "make_atmosphere.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@unittest.skipUnless(TABLES.exists(), f"reference data not found: {TABLES}")
class Tables(unittest.TestCase):
    def made(self, make):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "table.txt"
            module = tool()
            module.write(file, [], getattr(module, make)(TABLES))
            return [line for line in file.read_text().splitlines() if not line.startswith("#")]

    def test_files_are_what_the_tool_makes(self):
        for make, name in (("bands", "gas_bands"), ("continua", "continua"), ("profiles", "profiles"), ("aerosols", "aerosols"),
                           ("phase_functions", "phase_functions")):
            with self.subTest(name):
                kept = [line for line in (DATA / f"{name}.txt").read_text().splitlines() if not line.startswith("#")]
                self.assertEqual(self.made(make), kept)

    def test_terms_of_one_exponent(self):
        largest, k, w = tool().absorption_terms(0.6033, 3)
        lines = (DATA / "absorption_terms.txt").read_text().splitlines()
        kept = [float(x) for x in lines[next(i for i, line in enumerate(lines) if line.startswith("@terms 0.6033 3")) + 1].split()]
        self.assertLess(largest, 0.0094)
        # The search ends elsewhere on another processor's arithmetic: what counts is how near the terms come.
        points = [10 ** (-7 + j / 50) for j in range(501)]
        sums = [sum(w_j * math.exp(-k_j * x) for k_j, w_j in zip(kept[::2], kept[1::2])) for x in points]
        worst = max(abs(s - math.exp(-(x**0.6033))) for s, x in zip(sums, points))
        self.assertLess(abs(worst / largest - 1.0), 0.02)
        self.assertAlmostEqual(sum(kept[1::2]), 1.0, places=5)
        self.assertEqual(len(k), len(w))


if __name__ == "__main__":
    unittest.main()
