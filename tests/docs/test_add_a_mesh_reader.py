"""docs/developer/add_a_mesh_reader.md is true: its reader, put beside the others, is told of, reads, and says what is wrong."""

import json
import unittest

from outside_tree import PageTest

DOCUMENT = {"ifov": 1, "scene": {"materials": {"soil": {"reflectance": 0.3}, "sheet": {"reflectance": 0.6}},
                                 "objects": [{"plane": {}, "material": "soil"}, {"mesh": {"file": "roof.off", "unit": "cm"}, "material": "sheet"}]},
            "light": {"sun": {"point": {"zenith": "0 deg", "azimuth": "0 deg"}}},
            "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}},
                       "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
            "sampling": {"grid": {"elements": [8, 8]}, "max_depth": 1}}
ROOF = "OFF\n4 2 0\n-100 -200 50  0 -200 50\n0 200 50  -100 200 50 # four corners\n3 0 1 2\n3 0 2 3\n"


class AddAMeshReader(PageTest):
    page, row = "add_a_mesh_reader.md", "mesh reader"

    def test_a_pair_of_files_and_one_row(self):
        (self.folder / "scene.json").write_text(json.dumps(DOCUMENT))
        (self.folder / "roof.off").write_text(ROOF)
        result = self.run_it("render", "scene.json", "-o", "out", "-q")
        self.assertIn(result.returncode, (0, 6), result.stderr)
        values = memoryview((self.folder / "out/image_radiance.img").read_bytes()).cast("f").tolist()
        for column, brightness in enumerate((0.3, 0.6, 0.3, 0.3)):
            for row in range(4):
                self.assertAlmostEqual(values[4 * row + column] / values[0], brightness / 0.3, 5, (column, row))

        def error_of(text, name="roof.off"):
            (self.folder / "roof.off").rename(self.folder / name)
            (self.folder / name).write_text(text)
            (self.folder / "scene.json").write_text(json.dumps(DOCUMENT).replace("roof.off", name))
            result = self.run_it("check", "scene.json")
            (self.folder / name).rename(self.folder / "roof.off")
            self.assertEqual(result.returncode, 1)
            return result.stderr

        self.assertRegex(error_of(ROOF.replace("0 200 50", "0 2oo 50")), r"roof\.off:4:3: found '2oo', expected a coordinate")
        self.assertRegex(error_of(ROOF.replace("3 0 2 3", "3 0 2 4")), r"roof\.off:6:1: found 4, expected the number of a vertex")
        self.assertRegex(error_of(ROOF, "roof.of"), r"cannot tell the format of the mesh '.*roof\.of' by its extension; "
                         r"expected '\.obj', '\.ply', '\.gltf', '\.glb' or '\.off'")


if __name__ == "__main__":
    unittest.main()
