"""What README and docs show is true: documents are valid, commands run as written, links lead somewhere."""

import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks(page):
    """(language, text, name): the name is the last `file.json` in backquotes before a JSON block, if there is one,
    `file.csv` before a CSV block and `file.asc` before a text block."""
    text = page.read_text()
    for match in BLOCK.finditer(text):
        kind = {"csv": "csv", "text": "asc"}.get(match.group(1), "json")
        names = re.findall(rf"`([\w-]+\.{kind})`", text[: match.start()].rsplit("```", 1)[-1])
        yield match.group(1), match.group(2), names[-1] if names else None


def write_tables(page, folder):
    """The files that the page's documents name."""
    for language, text, name in blocks(page):
        if name and (language in ("csv", "text") or language == "json" and not is_document(text)):
            (pathlib.Path(folder) / name).write_text(text)


def is_document(text):
    return re.search(r'"ifov"\s*:', text) is not None


def small(text):
    """With at most 24 pixels a side: what is in the images that commands make is not looked at."""
    return re.sub(r'("pixels": )\[(\d+), (\d+)\]', lambda m: f"{m[1]}[{min(24, int(m[2]))}, {min(24, int(m[3]))}]", text)


def commands_of(page):
    """The page's own commands that are quick to run."""
    return [line for language, text, _ in blocks(page) if language == "sh" for line in text.splitlines()
            if line.startswith("build/ifov ") and "examples/" not in line and " study " not in line]


class Docs(unittest.TestCase):
    def run_in(self, folder, command):
        return subprocess.run(command, cwd=folder, shell=True, capture_output=True, text=True, timeout=200, check=False)

    def test_documents_are_valid(self):
        checked = 0
        for page in PAGES:
            last = {name: text for _, text, name in blocks(page)}
            for language, text, name in blocks(page):
                if language != "json" or not is_document(text):
                    continue
                if name and text == last[name] and any(re.search(rf" (render|check) {re.escape(name)}( |$)", line) for line in commands_of(page)):
                    continue  # test_commands_run_as_written
                with self.subTest(page=page.relative_to(ROOT), text=text[:60]), tempfile.TemporaryDirectory() as folder:
                    write_tables(page, folder)
                    (pathlib.Path(folder) / "document.json").write_text(text)
                    result = self.run_in(folder, f"{PROGRAM} check document.json")
                    self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                    checked += 1
        self.assertGreater(checked, 1)

    def test_a_wrong_document_would_be_noticed(self):
        with tempfile.TemporaryDirectory() as folder:
            text = next(text for language, text, _ in blocks(ROOT / "README.md") if language == "json")
            (pathlib.Path(folder) / "document.json").write_text(text.replace('"radius"', '"radios"'))
            result = self.run_in(folder, f"{PROGRAM} check document.json")
            self.assertEqual(result.returncode, 1)
            self.assertIn("radius", result.stderr)

    def test_commands_run_as_written(self):
        for page in PAGES:
            page_blocks = list(blocks(page))
            commands = commands_of(page)
            if not commands:
                continue
            with tempfile.TemporaryDirectory() as folder:
                write_tables(page, folder)
                for language, text, name in page_blocks:
                    if language == "json" and name:
                        (pathlib.Path(folder) / name).write_text(small(text))
                for command in commands:
                    with self.subTest(page=page.relative_to(ROOT), command=command):
                        if command.startswith("build/ifov atmosphere") and re.search("--(plot|resolved)", command):
                            # A thousand bands of the air over a sensor's whole range take a minute, as in tests/cli/test_atmosphere.py.
                            command += " --set " + shlex.quote(
                                'sensor.channels=[{"name": "blue", "gaussian": {"center": "0.482 um", "fwhm": "20 nm"}}]')
                        if command == "build/ifov check suburb/quicklook.json":  # as it stands, tests/landscape/test_make.py checks it
                            command += "".join(f" --set 'sensor.channels[{k}].gaussian.fwhm=4 nm'" for k in range(4))
                        result = self.run_in(folder, command.replace("build/ifov", shlex.quote(PROGRAM), 1))
                        self.assertIn(result.returncode, (0, 5, 6) if "All pixels hold the same value" in result.stdout else (0, 5), result.stdout + result.stderr)

    def test_ten_lines_are_ten_lines(self):
        text = next(text for language, text, _ in blocks(ROOT / "README.md") if language == "json")
        self.assertEqual(len(text.splitlines()), 10)

    def test_products_of_the_readme_exist(self):
        page = ROOT / "README.md"
        text, name = next((text, name) for language, text, name in blocks(page) if language == "json")
        stem = name.removesuffix(".json")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / name).write_text(text)
            result = self.run_in(folder, f"{PROGRAM} render {name}")
            self.assertEqual(result.returncode, 0, result.stderr)
            files = set(re.findall(r"^\| .*?`(image_[\w.]+)`", page.read_text(), re.MULTILINE))
            self.assertGreater(len(files), 5)
            for file in files:
                self.assertTrue((pathlib.Path(folder) / f"{stem}.out" / file).exists(), file)

    def test_make_targets_exist(self):
        targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
        for page in PAGES:
            for language, text, _ in blocks(page):
                for line in text.splitlines() if language == "sh" else []:
                    for word in line.split("#")[0].split()[1:] if line.startswith("make") else []:
                        if re.fullmatch(r"[a-z]+", word):
                            self.assertIn(word, targets, f"{page.relative_to(ROOT)}: {line}")

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text()):
                if "://" not in target:
                    with self.subTest(page=page.relative_to(ROOT), target=target):
                        self.assertTrue((page.parent / target).exists())

    def test_examples_are_valid(self):
        documents = sorted((ROOT / "examples").rglob("*.json"))
        self.assertGreater(len(documents), 0)
        rendered = {name for file, pattern in (("docs/test_examples_render.py", r'self\.render\("(\w+)"'),
                                               ("session/test_instruments.py", r'"render", ROOT / "examples/(\w+)\.json"'))
                    for name in re.findall(pattern, (ROOT / "tests" / file).read_text())}
        for document in documents:
            if document.parent == ROOT / "examples" and document.stem in rendered:
                continue
            with self.subTest(document=document.relative_to(ROOT)):
                result = self.run_in(ROOT, f"{PROGRAM} check {document}")
                if "/shared/" in result.stderr and "no such file" in result.stderr:
                    self.skipTest("reference data not found: " + result.stderr.strip().splitlines()[0])
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_documents_that_a_script_fills_in_are_valid(self):
        data = pathlib.Path(os.environ.get("IFOV_TRUTH", ROOT / ".." / "shared" / "truth")).resolve()
        if not (data / "scenes" / "dem" / "dem_hd.tif").exists():
            self.skipTest(f"reference data not found: {data}/scenes/dem/dem_hd.tif")
        for templates in {path.parent for path in (ROOT / "examples").rglob("*.json.in")}:
            with tempfile.TemporaryDirectory() as folder:
                made = self.run_in(folder, f"/usr/bin/python3 {templates / 'make_scene.py'} {data} .")
                if "No module named" in made.stderr:
                    self.skipTest(made.stderr.strip().splitlines()[-1])
                self.assertEqual(made.returncode, 0, made.stderr)
                for template in sorted(templates.glob("*.json.in")):
                    with self.subTest(document=template.relative_to(ROOT)):
                        document = pathlib.Path(folder) / template.stem
                        document.write_text(template.read_text().replace("@DATA@", str(data)))
                        result = self.run_in(folder, f"{PROGRAM} check {document.name}")
                        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                        self.assertNotIn("warning", result.stderr)


if __name__ == "__main__":
    unittest.main()
