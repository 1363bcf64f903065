"""docs/developer/add_a_study.md is true: its study, put beside the others, is listed, run, and says the same for the same seed."""

import json
import unittest

from outside_tree import PageTest


class AddAStudy(PageTest):
    page, row = "add_a_study.md", "study"

    def test_a_pair_of_files_and_one_row(self):
        self.assertIn("counting    points in a circle, against pi", self.run_it("study", "--help").stdout)
        result = self.run_it("study", "counting", "--trials", "4000", "-o", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("share_inside  ", result.stdout)
        figures = json.loads((self.folder / "out/figures.json").read_text())
        text = json.dumps(figures)
        self.assertIn("share_inside", text)
        again = self.run_it("study", "counting", "--trials", "4000", "-o", "again")
        self.assertEqual(again.stdout.replace("again/", "out/"), result.stdout)
        self.assertNotEqual(self.run_it("study", "counting", "--trials", "4000", "--seed", "2", "-o", "again").stdout.replace("again/", "out/"), result.stdout)
        misspelt = self.run_it("study", "countin")
        self.assertEqual(misspelt.returncode, 1)
        self.assertIn("there is no study 'countin'; did you mean 'counting'?", misspelt.stderr)
        self.assertEqual(self.run_it("study", "counting", "--scene", "a.json").returncode, 1)


if __name__ == "__main__":
    unittest.main()
