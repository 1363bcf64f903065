"""docs/developer/glossary.md: its names stand in the sources; those that were given up name nothing any more."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/layering"))

from layering import table_rows, without_comments_and_strings  # noqa: E402

PAGE = (ROOT / "docs/developer/glossary.md").read_text()
CODE = {path: without_comments_and_strings(path.read_text())
        for path in sorted((ROOT / "src").rglob("*")) if path.suffix in (".h", ".cpp")}


def names(cell):
    return re.findall(r"`([\w:]+)`", cell)


def uses(name, code):
    """Whether a source uses a name for something: as a type, or as an enumerator, function or variable of that name."""
    return [str(path) for path, text in code.items() if re.search(rf"\b{name}\b", text)]


class Glossary(unittest.TestCase):
    def test_names_stand_in_the_sources(self):
        rows = table_rows(PAGE, "term")
        self.assertGreater(len(rows), 25)
        for row in rows:
            for name in names(row[2]):
                self.assertTrue(uses(name, CODE), f"'{name}' of the glossary stands in no source")

    def test_what_was_given_up_is_gone(self):
        rows = table_rows(PAGE, "name")
        self.assertGreater(len(rows), 5)
        for row in rows:
            for name in names(row[0]):
                self.assertEqual(uses(name, CODE), [], f"'{name}' was given up")
            self.assertTrue(any(uses(name, CODE) for name in names(row[1])), row[1])

    def test_terms_are_in_order_and_once(self):
        terms = [row[0].lower().replace("'", "") for row in table_rows(PAGE, "term")]
        self.assertEqual(len(terms), len(set(terms)))
        self.assertEqual([t[0] for t in terms], sorted(t[0] for t in terms))

    def test_a_given_up_name_would_be_noticed(self):
        self.assertEqual(uses("Nap", {"a.cpp": "Nap nap;"}), ["a.cpp"])
        self.assertEqual(uses("Nap", {"a.cpp": "Napkin napkin;"}), [])


if __name__ == "__main__":
    unittest.main()
