"""docs/developer/add_a_command.md is true: its command, put beside the others, is listed, explained and carried out."""

import json
import unittest

from outside_tree import PageTest


class AddACommand(PageTest):
    page, row = "add_a_command.md", "command"

    def test_a_pair_of_files_and_one_row(self):
        box = {"box": {"low": ["0 m", "0 m", "0 m"], "high": ["1 m", "1 m", "1 m"]}, "material": "brick"}
        document = {"ifov": 1, "scene": {"materials": {"soil": {"reflectance": 0.3}, "brick": {"reflectance": 0.2}},
                                         "objects": [{"plane": {}, "material": "soil"}, box, box]},
                    "light": {"sun": {"point": {"zenith": "30 deg", "azimuth": "140 deg"}}},
                    "atmosphere": {"uniform": {"direct": "1200 W m-2 um-1", "diffuse": "150 W m-2 um-1"}},
                    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [2, 2]}},
                               "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]}}
        (self.folder / "scene.json").write_text(json.dumps(document))
        result = self.run_it("count", "scene.json")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "4 pixels, 1 channels\n", ""))

        names = [line.split()[0] for line in self.run_it("--help").stdout.partition("Subcommands:")[2].splitlines() if line.strip()]
        self.assertEqual(names[:3], ["count", "render", "check"])
        self.assertIn("Count the pixels and channels of an image", self.run_it("--help").stdout)
        self.assertIn("ifov count scene.json", self.run_it("count", "--help").stdout)

        misspelt = self.run_it("cuont", "scene.json")
        self.assertEqual(misspelt.returncode, 1)
        self.assertIn("ifov: there is no command 'cuont'; did you mean 'count'?", misspelt.stderr)
        (self.folder / "wrong.json").write_text(json.dumps(document).replace('"gsd"', '"gds"'))
        wrong = self.run_it("count", "wrong.json")
        self.assertEqual(wrong.returncode, 1)
        self.assertRegex(wrong.stderr, r"^wrong\.json:1:\d+: unknown key 'gds'")
        (self.folder / "below").mkdir()
        self.assertIn("--inputs-below", self.run_it("count", "scene.json", "--inputs-below", "below").stderr)


if __name__ == "__main__":
    unittest.main()
