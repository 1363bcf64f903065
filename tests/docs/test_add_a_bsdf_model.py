"""docs/developer/add_a_bsdf_model.md is true: its model, put beside the others, is read, explained and rendered."""

import json
import re
import unittest

from outside_tree import ROOT, Page, PageTest

PAGE = Page("add_a_bsdf_model.md")
FOLDER = "materials/bsdf"
REGISTRY = "materials/bsdf_models.cpp"


class AddAModel(PageTest):
    row = "scattering model"

    def extend(self, tree):
        tree.write(f"{FOLDER}/minnaert.h", '#pragma once\n#include "materials/bsdf/bsdf_model.h"\nnamespace ifov::materials {\n'
                   + PAGE.code(f"src/{FOLDER}/minnaert.h") + "}\n")
        tree.write(f"{FOLDER}/minnaert.cpp", '#include "materials/bsdf/minnaert.h"\n#include <cmath>\n#include <numbers>\n'
                   "namespace ifov::materials {\n" + PAGE.code(f"src/{FOLDER}/minnaert.cpp") + "}\n")
        # The page shows the end of the list, after dots.
        shown = re.fullmatch(r"constexpr std::array kModels\{\.\.\., &(\w+)::kModel, (&\w+::kModel)\};\n", PAGE.code("src/" + REGISTRY))
        registry, rows = re.subn(rf"^(constexpr std::array kModels\{{.*?&{shown.group(1)}::kModel)(\}};\n)", rf"\1, {shown.group(2)}\2",
                                 (ROOT / "src" / REGISTRY).read_text(), flags=re.MULTILINE | re.DOTALL)
        self.assertEqual(rows, 1)
        tree.write(REGISTRY, '#include "materials/bsdf/minnaert.h"\n' + registry)

    def test_two_new_files_and_one_row(self):
        folder, run = self.folder, self.run_it
        page = run("schema", "--markdown").stdout
        self.assertIn("| `darkening` | number between 1 and 2, or [number by a map](#number-by-a-map) | `1` | exponent; 1 is Lambert's law |", page)
        document = {"ifov": 1, "scene": {"materials": {"dust": {"reflectance": 0.3, "scattering": {"minnaert": {"darkening": 1.5}}}},
                                         "objects": [{"plane": {}, "material": "dust"}]},
                    "light": {"sun": {"point": {"zenith": "60 deg", "azimuth": "90 deg"}}},
                    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [2, 2]}},
                               "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]}}

        def radiance(scattering):
            document["scene"]["materials"]["dust"]["scattering"] = scattering
            (folder / "scene.json").write_text(json.dumps(document))
            result = run("render", "scene.json", "-o", "out", "--restart", "-q")
            self.assertIn(result.returncode, (0, 6), result.stderr)
            cubes = list((folder / "out").glob("*_radiance.img"))
            return memoryview(cubes[0].read_bytes()).cast("f")[0]

        plain = radiance("lambertian")
        self.assertGreater(plain, 0.0)
        self.assertAlmostEqual(radiance({"minnaert": {"darkening": 1.0}}) / plain, 1.0, 6)
        self.assertAlmostEqual(radiance("minnaert") / plain, 1.0, 6)
        # The view is from above, the Sun 60 degrees off: cos(60 deg) to the power 0.5.
        self.assertAlmostEqual(radiance({"minnaert": {"darkening": 1.5}}) / plain, 0.5**0.5, 6)
        document["scene"]["materials"]["dust"]["scattering"] = {"minnaert": {"darkening": 3}}
        (folder / "scene.json").write_text(json.dumps(document))
        self.assertIn("minnaert.darkening' is the number 3, expected a number between 1 and 2", run("check", "scene.json").stderr)


if __name__ == "__main__":
    unittest.main()
