"""`ifov study atmosphere` without reference data says what it could not measure; the committed page is such a page."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("IFOV_PROGRAM", "ifov")
PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "validation" / "atmosphere.md"


def headings(text):
    return re.findall(r"^## (.*)$", text, re.MULTILINE)


class AtmospherePage(unittest.TestCase):
    def test_without_reference_data(self):
        with tempfile.TemporaryDirectory() as folder:
            environment = {key: value for key, value in os.environ.items() if key != "IFOV_TRUTH"}
            subprocess.run(
                [PROGRAM, "study", "atmosphere", "--trials", "10", "--output", folder, "--reference", folder],
                env=environment, stdout=subprocess.DEVNULL, check=False,
            )
            figures = json.loads((pathlib.Path(folder) / "figures.json").read_text())
            self.assertIsNone(figures["rfmip_longwave"]["value"])
            self.assertIsNone(figures["rfmip_longwave"]["ok"])
            self.assertIn("not measured: no atmosphere/rrtmgp_rfmip", figures["rfmip_longwave"]["meaning"])
            for name in ("terms_8", "white_ground", "nodes_vswir", "nodes_1380nm", "enclosure_10um", "sun_sweep"):
                self.assertTrue(figures[name]["ok"], name)
            made = (pathlib.Path(folder) / "page" / "atmosphere.md").read_text()
            self.assertEqual(headings(made), headings(PAGE.read_text()))

    def test_the_page_has_its_plots(self):
        plots = re.findall(r"!\[[^]]+\]\(([^)]+)\)", PAGE.read_text())
        self.assertGreater(len(plots), 8)
        for plot in plots:
            self.assertTrue((PAGE.parent / plot).exists(), plot)
        self.assertEqual(sorted(plots), sorted(path.name for path in PAGE.parent.glob("atmosphere_*.svg")))


if __name__ == "__main__":
    unittest.main()
