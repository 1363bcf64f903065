"""The figures of docs/: those that pages show exist and can be drawn, none lies about, and each says what drew it; the
figure of one path names classes and files that there are."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/layering"))

from layering import without_comments_and_strings  # noqa: E402

DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]
DRAWN = re.compile(r"<!-- drawn by (tools/figures/(\w+)\.py) -->")
LARGEST = 60_000  # bytes


def shown():
    """(page, file) of every figure."""
    return [(page, (page.parent / target).resolve()) for page in PAGES
            for target in re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", page.read_text()) if "://" not in target]


def files():
    return sorted(path for path in DOCS.rglob("*") if path.suffix in (".svg", ".png"))


def by_script():
    """The figures of tools/figures: those in folders of that name."""
    return [path for path in files() if path.parent.name == "figures"]


def texts(svg):
    """All that a figure says, piece by piece."""
    return ["".join(element.itertext()).strip() for element in xml.etree.ElementTree.fromstring(svg).iter()
            if element.tag.endswith("}text")]


def faults(svg, script_exists=lambda path: (ROOT / path).exists()):
    """What is wrong with the file of a figure that a script has made."""
    found = []
    try:
        root = xml.etree.ElementTree.fromstring(svg)
    except xml.etree.ElementTree.ParseError as error:
        return [str(error)]
    if not root.tag.endswith("}svg") or "viewBox" not in root.attrib:
        found.append("is no SVG with a viewBox")
    if len(svg.encode()) > LARGEST:
        found.append(f"has {len(svg.encode())} bytes, more than {LARGEST}")
    drawn = DRAWN.search(svg)
    if drawn is None or not script_exists(drawn.group(1)):
        found.append("does not say which script has drawn it")
    if len(texts(svg)) < 3:
        found.append("says nothing")
    width = float(root.attrib.get("viewBox", "0 0 0 0").split()[2])
    for element in root.iter():
        size = re.search(r"font:[^;]*?([\d.]+)px", element.attrib.get("style", ""))
        if size and float(size.group(1)) < 5:
            found.append(f"has letters of {size.group(1)} px on a width of {width:.0f}")
    return found


class Figures(unittest.TestCase):
    def test_those_that_pages_show_exist(self):
        self.assertGreater(len(shown()), 30)
        for page, file in shown():
            with self.subTest(page=page.relative_to(ROOT), figure=file.name):
                self.assertTrue(file.exists())

    def test_each_is_shown_somewhere(self):
        used = {file for _, file in shown()}
        self.assertEqual([str(path.relative_to(ROOT)) for path in files() if path not in used], [])

    def test_each_can_be_read(self):
        for path in files():
            with self.subTest(figure=path.relative_to(ROOT)):
                if path.suffix == ".svg":
                    self.assertTrue(xml.etree.ElementTree.parse(path).getroot().tag.endswith("}svg"))
                else:
                    self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_those_of_scripts_say_which_and_are_small(self):
        self.assertGreater(len(by_script()), 15)
        for path in by_script():
            with self.subTest(figure=path.relative_to(ROOT)):
                self.assertEqual(faults(path.read_text()), [])

    def test_pages_say_what_drew_them(self):
        """The caption behind a figure names its script."""
        for page in PAGES:
            for target, caption in re.findall(r"!\[[^\]]*\]\((figures/[^)]*)\)\n\n(.*?)(?:\n\n|\Z)", page.read_text(), re.DOTALL):
                with self.subTest(page=page.relative_to(ROOT), figure=target):
                    self.assertIn(DRAWN.search((page.parent / target).read_text()).group(1), caption)

    def test_each_script_draws_something(self):
        drawn = {DRAWN.search(path.read_text()).group(2) for path in by_script()}
        scripts = {path.stem for path in (ROOT / "tools/figures").glob("*.py")} - {"style", "data", "make_figures"}
        self.assertEqual(drawn, scripts)

    def test_faults_would_be_noticed(self):
        good = next(path for path in by_script() if path.name == "one_path.svg").read_text()
        self.assertEqual(faults(good), [])
        for bad in (good.replace("</svg>", ""), DRAWN.sub("", good), good.replace("one_path.py", "two_paths.py"), good + " " * LARGEST,
                    re.sub(r"<text.*?</text>", "", good, flags=re.DOTALL), good.replace("font: 8px", "font: 3px")):
            self.assertNotEqual(faults(bad), [])


class OnePath(unittest.TestCase):
    SAYS = texts((DOCS / "developer/figures/one_path.svg").read_text())
    CODE = {path: without_comments_and_strings(path.read_text()) for path in sorted((ROOT / "src").rglob("*.h"))}

    def missing(self, said):
        """Files and classes named that there are not."""
        found = []
        for text in said:
            for file in re.findall(r"[a-z_0-9/]+\.(?:h|cpp)\b", text):
                if not (ROOT / "src" / file).is_file():
                    found.append(file)
            for name in re.findall(r"\b[A-Z][a-z]+(?:[A-Z][a-z]+)+\b", text):
                if not any(re.search(rf"\b(?:class|struct) {name}\b", code) for code in self.CODE.values()):
                    found.append(name)
        return found

    def test_what_it_names_is_there(self):
        named = [text for text in self.SAYS if re.search(r"\.(?:h|cpp)$", text)]
        self.assertGreater(len(named), 12)
        self.assertEqual(self.missing(self.SAYS), [], "rename it in tools/figures/one_path.py and run that")

    def test_what_is_gone_would_be_noticed(self):
        self.assertEqual(self.missing(["render/no_such_file.h", "NoSuchClass  →  PathRecord"]), ["render/no_such_file.h", "NoSuchClass"])

    def test_the_page_fits_a_screen_and_names_what_there_is(self):
        page = (DOCS / "developer/one_path.md").read_text()
        self.assertLess(len(page.split("\n*Drawn by", 1)[1].splitlines()), 45)
        self.assertEqual(self.missing(re.findall(r"`([^`]*)`", page.replace("tools/figures/one_path.py", ""))), [])


class DrawnAgain(unittest.TestCase):
    """Scripts and the program of the build give what is in the tree."""

    DATA = pathlib.Path(os.environ.get("IFOV_BUILD", str(ROOT / "build"))) / "figure_data"

    def test_every_set_of_numbers_is_printed(self):
        sets = re.findall(r'\{"(\w+)", print_', (ROOT / "tools/figures/figure_data.cpp").read_text())
        self.assertGreater(len(sets), 8)
        for name in sets:
            with self.subTest(set=name):
                printed = subprocess.run([self.DATA, name], capture_output=True, text=True, check=True).stdout
                self.assertGreater(len(printed.splitlines()), 50)
                self.assertNotRegex(printed, r"\b(?:nan|inf)\b")
        self.assertEqual(subprocess.run([self.DATA, "nothing"], capture_output=True, check=False).returncode, 1)

    def test_scripts_draw_the_same_bytes(self):
        version = subprocess.run(["/usr/bin/python3", "-c", "import matplotlib; print(matplotlib.__version__)"], capture_output=True,
                                 text=True, check=False).stdout.strip()
        if not version.startswith("3.6."):
            self.skipTest(f"Matplotlib of Debian 12 (3.6) is not installed, but {version or 'none'}")
        with tempfile.TemporaryDirectory() as folder:
            made = subprocess.run(["/usr/bin/python3", str(ROOT / "tools/figures/make_figures.py")], capture_output=True, text=True, check=False,
                                  env={**os.environ, "FIGURES": folder, "FIGURE_DATA": str(self.DATA)})
            self.assertEqual(made.returncode, 0, made.stderr)
            drawn = sorted(path.relative_to(folder) for path in pathlib.Path(folder).rglob("*.svg"))
            self.assertEqual(drawn, [path.relative_to(DOCS) for path in by_script()])
            for path in drawn:
                with self.subTest(figure=path):
                    self.assertEqual((pathlib.Path(folder) / path).read_text(), (DOCS / path).read_text())


if __name__ == "__main__":
    unittest.main()
