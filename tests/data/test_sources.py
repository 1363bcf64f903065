"""Every file that is compiled into the program says whose figures it holds and under which licence; every curve of the
library has sources that others may pass on."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "data"
FILES = sorted(path for path in DATA.rglob("*") if path.is_file())
MATERIALS = sorted((DATA / "materials").glob("*.txt"))

# What an origin's text may end in.
OPEN = (
    r"Licence: public domain \(work of the U\.S\. Government\)\.",
    r"Licence: CC0 1\.0 \([^()]*(\([^()]*\)[^()]*)*\)[^.]*\.",
    r"Licence: CC0 1\.0 \(.*\); reflectance computed here by Fresnel's equations at normal incidence\.",
    r"Licence: computed here, Apache-2\.0\.",
    r"Licence: a single published figure, cited\.",
)


def is_open(text):
    return any(re.search(f"{licence}$", text) for licence in OPEN)


def values(path, key):
    return [line.split(": ", 1)[1] for line in path.read_text().splitlines() if line.startswith(f"{key}: ")]


class Sources(unittest.TestCase):
    def test_every_file_names_source_and_licence(self):
        self.assertGreater(len(FILES), 10)
        for path in FILES:
            with self.subTest(file=path.relative_to(ROOT)):
                head = " ".join(path.read_text().splitlines()[:25])
                self.assertRegex(head, r"\b(19|20)\d\d\b", "no year of a publication")
                self.assertRegex(head, r"[Pp]ublic domain|Free to use with|Licence: ")
                self.assertRegex(head, r"Made by tools/make_\w+\.py|Written by hand from")

    def test_the_notice_names_every_file(self):
        notice = (ROOT / "NOTICE").read_text()
        for path in FILES:
            folder = path.relative_to(ROOT).parent
            name = path.relative_to(ROOT) if folder == pathlib.Path("data") else f"{folder}/*.txt"
            self.assertIn(str(name), notice)

    def test_every_origin_is_open_and_in_the_notice(self):
        notice = " ".join((ROOT / "NOTICE").read_text().split())
        for path in MATERIALS:
            for origin in values(path, "origin"):
                with self.subTest(file=path.name, origin=origin[:60]):
                    self.assertTrue(is_open(origin), origin)
                    cited = re.search(r"(Data Series 1035|\w[\w. ]* \d+ \(\d{4}\)|\(\d{4}\))", origin).group(0)
                    self.assertIn(cited, notice)

    def test_every_curve_has_sources_that_are_declared(self):
        for path in MATERIALS:
            keys = {origin.split()[0] for origin in values(path, "origin")}
            sources = values(path, "source")
            self.assertEqual(len(sources), len(values(path, "curve")), path.name)
            self.assertEqual({key for source in sources for key in source.split()}, keys, path.name)

    def test_what_is_not_open_would_be_noticed(self):
        for text in ("Licence: none stated; cite it.", "Licence: see the data set's page.", "Somebody (2019).",
                     "Licence: CC BY-NC 4.0."):
            self.assertFalse(is_open(text), text)

    def test_figures_of_the_closed_libraries_are_gone(self):
        for path in FILES:
            if path.parent.name == "sensors":  # ECOSTRESS is an instrument, too
                continue
            self.assertNotRegex(path.read_text(), r"(?i)ecostress|aster library|hymap|jhu|johns hopkins")


if __name__ == "__main__":
    unittest.main()
