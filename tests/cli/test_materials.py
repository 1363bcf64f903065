"""`ifov materials`: the list, searches, one material, its figure and its table, and names that are not known."""

import json
import os
import re
import struct
import unittest

from program import Folder, run


class Materials(unittest.TestCase):
    def test_lists_all_by_group(self):
        done = run("materials")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        groups = re.findall(r"^(\w+)$", done.stdout, re.MULTILINE)
        self.assertEqual(groups, ["vegetation", "soil", "water", "construction", "roof", "metal"])
        self.assertGreaterEqual(len(re.findall(r"^  \S.*  \d+ curves?", done.stdout, re.MULTILINE)), 40)
        self.assertRegex(done.stdout, r"\n  leaf, aspen +2 curves, with transmittance\n")

    def test_searches_by_words_in_any_order(self):
        done = run("materials", "lawn")
        self.assertEqual(
            done.stdout,
            "vegetation\n  grass, lawn          2 curves\n  grass, lawn, sparse  1 curve\n"
            "  grass, blades, pile  2 curves\n",
        )
        self.assertEqual(run("materials", "tennis paving").stdout, run("materials", "brick, paving").stdout)

    def test_describes_one(self):
        done = run("materials", "Leaf, Aspen")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for words in (
            "leaf, aspen\n",
            "0.35 to 14 um, 591 wavelengths, 2 curves",
            "sample:  USGS splib07a 20901: Aspen_Leaf-A DW92-2",
            "mean transmittance",
            "transmittance by PROSPECT-D",
            "source:  R. F. Kokaly et al.",
            "source:  PROSPECT-D",
            "Licence: public domain",
            'in a document: "reflectance": {"library": "leaf, aspen"}',
        ):
            self.assertIn(words, done.stdout)
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 110)

    def test_says_how_each_is_best_scattered(self):
        """And one document of all that is proposed is good; nothing narrow outshines it but for warnings."""
        names = re.findall(r"^  (\S.*?)  +\d+ curves?", run("materials").stdout, re.MULTILINE)
        models = set(re.findall(r"^(\w+) ", run("brdf", "--list").stdout, re.MULTILINE))
        materials = {}
        for name in names:
            text = run("materials", name, "--curve", 1).stdout
            self.assertIn(re.search(r"best with '(\w+)': ", text).group(1), models)
            proposed = re.search(r'such as "scattering": (.*?)(, and no reflectance)?$', text, re.MULTILINE)
            if proposed is None:
                self.assertRegex(text, "best with '(ross_li|sea)'", name)
                continue
            material = {"scattering": json.loads(proposed.group(1))}
            materials[name] = material if proposed.group(2) else {**material, "reflectance": {"library": name}}
        boxes = [{"box": {"low": [f"{3 * k} m", "0 m", "0 m"], "high": [f"{3 * k + 1} m", "1 m", "1 m"]}, "material": name}
                 for k, name in enumerate(materials)]
        document = {"ifov": 1, "scene": {"materials": materials, "objects": boxes}, "light": {"sky": {"radiance": "20 W m-2 sr-1 um-1"}},
                    "sensor": {"camera": {"orthographic": {"gsd": "50 m", "pixels": [8, 2], "center": ["120 m", "0 m"]}},
                               "channels": [{"name": "green", "monochromatic": {"at": "0.55 um"}}]}}
        with Folder() as folder:
            (folder / "all.json").write_text(json.dumps(document))
            done = run("check", "all.json", cwd=folder)
        self.assertIn(done.returncode, (0, 6), done.stderr)
        self.assertNotIn("error", done.stderr)

    def test_says_what_was_not_measured(self):
        done = run("materials", "asphalt, street", "--curve", 3)
        self.assertEqual(done.returncode, 0)
        self.assertIn("3. GDS376", done.stdout)
        self.assertNotIn("4. A008", done.stdout)
        self.assertIn("measured 0.35 to 2.5 um", done.stdout)
        self.assertRegex(done.stdout, "not measured: +2.5 to 8.00. um: straight line")
        self.assertRegex(done.stdout, "not measured: +8.00. to 14 um: from SLUM A006")
        self.assertIn('{"library": "asphalt, street", "curve": 3}', done.stdout)

    def test_lists_refractive_indices(self):
        done = run("materials", "--indices")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"\n  copper +0.2066 to 24.8 um\n    metal\n    source: H.-J. Hagemann")
        table = re.findall(r"^  (\S.*?)  +[\d.]+ to [\d.]+ um$", done.stdout, re.MULTILINE)
        self.assertEqual(len(table), 26)
        self.assertEqual(done.stdout.count("    source: "), 26)
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 110)
        mixed = run("materials", "--indices", "asphalt")
        self.assertEqual(mixed.returncode, 1)
        self.assertIn("--indices lists all refractive indices and stands alone", mixed.stderr)

    def test_draws_a_figure(self):
        with Folder() as folder:
            done = run("materials", "tree crown, broadleaf", "--plot", "crowns.png", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (0, ""))
            self.assertEqual(done.stderr, "crowns.png  (figure of 'tree crown, broadleaf', PNG)\n")
            self.assertEqual(os.listdir(folder), ["crowns.png"])
            png = (folder / "crowns.png").read_bytes()
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
            all_curves = struct.unpack(">II", png[16:24])
            run("materials", "tree crown, broadleaf", "--curve", "young, 30% shade", "--plot", "one.png", cwd=folder)
            one_curve = struct.unpack(">II", (folder / "one.png").read_bytes()[16:24])
            self.assertEqual(all_curves[0], one_curve[0])
            self.assertGreater(all_curves[1], one_curve[1])  # a line of the legend for each curve
            done = run("materials", "ice", "--plot", "no/such/folder/ice.png", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("no/such/folder/ice.png", done.stderr)

    def test_prints_a_table_that_a_document_reads(self):
        done = run("materials", "leaf, aspen", "--curve", 1, "--csv")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
        self.assertEqual(lines[0], "wavelength_um,reflectance_1,transmittance_1")
        rows = [[float(number) for number in line.split(",")] for line in lines[1:]]
        self.assertEqual((len(rows), rows[0][0], rows[-1][0]), (591, 0.35, 14.0))
        for _, reflectance, transmittance in rows:
            self.assertLessEqual(reflectance + transmittance, 1.0001)
        leaf = """{"ifov": 1, "scene": {
  "materials": {"leaf": {"reflectance": {"csv": "aspen.csv", "wavelength_unit": "um"}}},
  "objects": [{"plane": {}, "material": "leaf"}]}, "light": {"sky": {"radiance": "10 W m-2 sr-1 um-1"}},
 "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [2, 2]}},
  "channels": [{"name": "NIR", "monochromatic": {"at": "0.86 um"}}]},
 "sampling": {"grid": {"elements": [1, 1]}}}"""
        with Folder(leaf=leaf) as folder:
            (folder / "aspen.csv").write_text(done.stdout)
            checked = run("check", "leaf.json", cwd=folder)
            self.assertEqual((checked.returncode, checked.stderr), (0, ""))

    def test_names_that_are_not_known(self):
        for arguments, words in (
            (("grsas, lawn",), "the library has no material 'grsas, lawn'; did you mean 'grass, lawn'?"),
            (("wood, pine, weathered",), "'wood, pine, weathered' is in the library no more, for its figures have no open "
             "licence; nearest to it is 'wood, cedar shake'"),
            (("unobtainium",), "the library has no material 'unobtainium'; 'ifov materials' lists them all"),
            (("brick, red", "--curve", "5"), "the material 'brick, red' has no curve 5; it has 1 to 4"),
            (("brick, red", "--curve", "Berlin"), "the material 'brick, red' has no curve 'Berlin'. It has"),
            (("lawn", "--csv"), "--plot, --csv and --curve want one material; 'lawn' finds 3: 'grass, lawn',"),
        ):
            done = run("materials", *arguments)
            self.assertEqual((done.returncode, done.stdout), (1, ""), arguments)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
