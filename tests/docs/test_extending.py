"""docs/developer/extending.md: each kind of thing has a page and a test that adds what it shows; files named are there."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/layering"))

from layering import table_rows  # noqa: E402

FOLDER = ROOT / "docs/developer"
PAGE = (FOLDER / "extending.md").read_text()


def pages(text):
    return [found.group(1) for row in table_rows(text, "to add") if (found := re.match(r"\[[^\]]*\]\((add_a_\w+)\.md\)", row[0]))]


class Extending(unittest.TestCase):
    def test_every_page_is_listed_and_tested(self):
        listed = pages(PAGE)
        self.assertEqual(sorted(listed), sorted(path.stem for path in FOLDER.glob("add_a_*.md")))
        for name in listed:
            with self.subTest(page=name):
                test = (ROOT / f"tests/docs/test_{name}.py").read_text()
                self.assertIn(f'"{name}.md"', test)
                self.assertIn("PageTest", test)

    def test_what_there_is_to_add_has_a_page(self):
        """What the tables of documents and commands list: each kind of them."""
        self.assertGreaterEqual(set(pages(PAGE)), {"add_a_bsdf_model", "add_a_shape", "add_a_camera", "add_a_quantity", "add_a_mesh_reader",
                                                  "add_a_sampler", "add_a_command", "add_a_study"})

    def test_files_named_are_there(self):
        rows = table_rows(PAGE, "to add")
        self.assertGreater(len(rows), 9)
        for row in rows:
            files = re.findall(r"`(src/[\w/]+\.(?:cpp|h))`", row[2])
            with self.subTest(row=row[0]):
                self.assertEqual(len(files), int(row[1]))
                self.assertEqual([file for file in files if not (ROOT / file).is_file()], [])


if __name__ == "__main__":
    unittest.main()
