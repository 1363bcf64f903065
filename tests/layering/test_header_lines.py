"""A source includes little of the project: what it does not need, it does not wait for."""

import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

from header_lines import HeaderLines, quantile  # noqa: E402

# Lines of the project's headers that a source reaches: nine of ten, and any.
MOST_OF_NINE_IN_TEN = 2000
MOST = 3500

ADVICE = ("Declare what a header only names, put a description apart from what works it out, hand on the part of the "
          "document that is needed.")


def message(reached, bound):
    beyond = [one for one in reached if one.lines > bound]
    return "\n".join([f"{len(beyond)} of {len(reached)} sources reach more than {bound} lines of headers:",
                      *(f"  {one}" for one in beyond[:20]), ADVICE])


class SourceTree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.reached = HeaderLines([ROOT / "src", ROOT / "include"]).of_sources(ROOT / "src")

    def test_sources_are_found(self):
        self.assertGreater(len(self.reached), 500)
        self.assertGreater(quantile(self.reached, 0.5), 100)

    def test_nine_sources_in_ten_reach_little(self):
        self.assertLessEqual(quantile(self.reached, 0.9), MOST_OF_NINE_IN_TEN, message(self.reached, MOST_OF_NINE_IN_TEN))

    def test_no_source_reaches_a_lot(self):
        self.assertLessEqual(self.reached[0].lines, MOST, message(self.reached, MOST))


class PlantedLines(unittest.TestCase):
    def test_lines_are_counted_once_and_told_by_include(self):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in {"src/a/a.h": '#include "a/shared.h"\n#include <vector>\n',
                               "src/a/b.h": '#pragma once\n  #  include "a/shared.h"\n\n',
                               "src/a/shared.h": '#include "p/public.h"\n' + "\n" * 9,
                               "include/p/public.h": '#include "a/a.h"\n// #include "a/none.h"\n' + "\n" * 18,
                               "src/a/x.cpp": '#include "a/a.h"\n#include "a/b.h"\n#include "outside.h"\n' + "\n" * 50,
                               "src/a/y.cpp": "int y;\n"}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            reached = HeaderLines([root / "src", root / "include"]).of_sources(root / "src")
            self.assertEqual([(one.source, one.lines) for one in reached], [("a/x.cpp", 2 + 3 + 10 + 20), ("a/y.cpp", 0)])
            self.assertEqual(reached[0].direct, {"a/a.h": 0, "a/b.h": 3})
            self.assertIn("a/x.cpp: 35, of which 3 by a/b.h alone, 0 by a/a.h alone", message(reached, 30))
            self.assertEqual([quantile(reached, share) for share in (0.0, 0.4, 0.5, 1.0)], [0, 0, 35, 35])


if __name__ == "__main__":
    unittest.main()
