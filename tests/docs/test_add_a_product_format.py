"""docs/developer/add_a_product_format.md is true: its format, put beside the others, is asked for, written, recorded and kept."""

import array
import csv
import json
import unittest

from outside_tree import PageTest

DOCUMENT = {"ifov": 1, "scene": {"materials": {"soil": {"reflectance": 0.3, "temperature": "300 K"}, "roof": {"emissivity": 1, "temperature": "320 K"}},
                                 "objects": [{"plane": {}, "material": "soil"},
                                             {"box": {"low": ["-2 m", "-1 m", "0 m"], "high": ["1 m", "2 m", "1 m"]}, "material": "roof"}]},
            "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [7, 5]}},
                       "channels": [{"name": "a", "monochromatic": {"at": "10 um"}}, {"name": "b", "monochromatic": {"at": "11 um"}}]},
            "sampling": {"grid": {"elements": [2, 2]}, "tile": 3}, "output": {"formats": ["csv"]}}


class AddAProductFormat(PageTest):
    page, row = "add_a_product_format.md", "product format"

    def test_a_pair_of_files_and_one_row(self):
        out = self.folder / "out"
        (self.folder / "scene.json").write_text(json.dumps(DOCUMENT))
        self.assertIn('list of 1 to 10: `"envi"`, `"geotiff"`, `"netcdf"`, `"glt"`, `"vrt"`, `"demosaiced"`, `"csv"`, `"png"`, `"html"`, `"stac"`', self.run_it("schema", "--markdown").stdout)
        result = self.run_it("render", "scene.json", "-o", "out", "-q")
        self.assertIn(result.returncode, (0, 6), result.stderr)
        self.assertFalse((out / "image_report.html").exists())
        with open(out / "image_radiance.csv") as file:
            head, *rows = csv.reader(file)
        self.assertEqual(head, ["column", "row", "a", "b"])
        cube = array.array("f", (out / "image_radiance.img").read_bytes())  # by lines, in each the bands
        self.assertEqual(len(rows), 7 * 5)
        self.assertGreater(len(set(cube)), 3)
        for k, (column, line, *values) in enumerate(rows):
            self.assertEqual((int(column), int(line)), (k % 7, k // 7))
            for band, value in enumerate(values):
                self.assertAlmostEqual(float(value) / cube[(2 * (k // 7) + band) * 7 + k % 7], 1.0, 6)
        files = {entry["name"]: entry for entry in json.loads((out / "image_run.json").read_text())["files"]}
        self.assertEqual(files["image_radiance.csv"]["what"], "radiance, CSV")
        self.assertEqual(files["image_radiance.csv"]["bytes"], (out / "image_radiance.csv").stat().st_size)

        # The shares of a run know what was asked for, and a run that does not ask for it leaves none behind.
        for share in ("1/2", "2/2"):
            self.assertIn(self.run_it("render", "scene.json", "-o", "part" + share[0], "--tiles", share, "-q").returncode, (0, 6))
        self.assertIn(self.run_it("merge", "part1", "part2", "-o", "whole").returncode, (0, 6))
        self.assertEqual((self.folder / "whole/image_radiance.csv").read_bytes(), (out / "image_radiance.csv").read_bytes())
        again = self.run_it("render", "scene.json", "-o", "out", "-q", "--restart", "--set", 'output.formats=["png"]')
        self.assertIn(again.returncode, (0, 6), again.stderr)
        self.assertFalse((out / "image_radiance.csv").exists())


if __name__ == "__main__":
    unittest.main()
