"""The examples of docs/guide/python.md run as written, one after another; the reference is that of the docstrings; all pages make a site."""

import importlib.util
import pathlib
import re
import subprocess
import sys
import unittest

import scenes

GUIDE = scenes.ROOT / "docs" / "guide" / "python.md"


class Guide(scenes.InFolder):
    def run_parts(self, name, parts):
        names = {}
        for number, part in enumerate(parts, 1):
            try:
                exec(compile(part, f"{name}, part {number}", "exec"), names)  # noqa: S102
            except Exception as error:
                raise AssertionError(f"{name}, part {number}:\n{part}") from error
        return names

    def test_examples(self):
        parts = re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertGreater(len(parts), 7)
        names = self.run_parts("python.md", parts)
        self.assertEqual(names["picture"].dims, ("y", "x", "rgb"))
        self.assertTrue(pathlib.Path("out/image_run.json").exists())


class Reference(unittest.TestCase):
    def test_is_what_the_docstrings_say(self):
        subprocess.run([sys.executable, scenes.ROOT / "tools/make_python_reference.py", "--check"], check=True)

    def test_everything_has_a_docstring(self):
        text = (scenes.ROOT / "docs/guide/python_reference.md").read_text(encoding="utf-8")
        for heading, below in re.findall(r"^#{3,4} (.+)\n+(?:```python\n[^`]*```\n+)?(.*)$", text, re.MULTILINE):
            self.assertFalse(below.startswith("#") or not below, heading)
        for name in ("ifov.render()", "ifov.Scene.cast()", "Dataset.ifov.to_zarr()", "ifov.sampling.integrate()"):
            self.assertRegex(text, rf"(?m)^#+ {re.escape(name)}$")


class Site(scenes.InFolder):
    def test_is_made_of_all_pages(self):
        if importlib.util.find_spec("mkdocs") is None:
            self.skipTest("mkdocs is not installed")
        command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--config-file", scenes.ROOT / "mkdocs.yml", "--site-dir", self.folder / "site"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        pages = {page.relative_to(scenes.ROOT / "docs").with_suffix(".html") for page in (scenes.ROOT / "docs").rglob("*.md")}
        self.assertEqual({page for page in pages if not (self.folder / "site" / page).exists()}, set())
        self.assertIn("ifov.render", (self.folder / "site/guide/python_reference.html").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
