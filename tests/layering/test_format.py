"""Every C++ file is laid out as clang-format lays it out, by the file .clang-format; no text holds what a merge left."""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Another version lays some lines out differently; this one is Debian 12's.
PROGRAM = "clang-format-14"
FOLDERS = ("benchmarks", "examples", "include", "python", "src", "tests", "tools")


def unformatted(files):
    """Lines of clang-format's complaints."""
    run = subprocess.run([PROGRAM, "--style=file", "--dry-run", "-Werror", *files], capture_output=True, text=True)
    return [line for line in run.stderr.splitlines() if "error:" in line]


def marks_of_a_merge(text):
    return re.findall(r"^(?:<{7}|>{7}) .*$", text, re.MULTILINE)


class Merges(unittest.TestCase):
    def test_left_nothing(self):
        files = [path for folder in (*FOLDERS, "cmake", "data", "docs") for path in (ROOT / folder).rglob("*")
                 if path.suffix in {".cpp", ".h", ".py", ".md", ".txt", ".json", ".cmake", ".csv", ".sh", ".in"}]
        self.assertGreater(len(files), 1000)
        for path in files:
            self.assertEqual(marks_of_a_merge(path.read_text(errors="replace")), [], path)

    def test_is_noticed(self):
        self.assertEqual(len(marks_of_a_merge("a\n" + "<" * 7 + " HEAD\nb\n=======\nc\n" + ">" * 7 + " other\n")), 2)


@unittest.skipUnless(shutil.which(PROGRAM), f"{PROGRAM} is not installed")
class Format(unittest.TestCase):
    def test_every_file(self):
        files = sorted(str(path) for folder in FOLDERS for ending in ("*.cpp", "*.h")
                       for path in (ROOT / folder).rglob(ending))
        self.assertGreater(len(files), 1000)
        wrong = [line for k in range(0, len(files), 200) for line in unformatted(files[k:k + 200])]
        self.assertEqual(wrong, [], f"{PROGRAM} -i FILE lays it out")

    def test_is_noticed(self):
        with tempfile.TemporaryDirectory() as folder:
            style = pathlib.Path(folder, ".clang-format")
            style.write_text((ROOT / ".clang-format").read_text())
            source = pathlib.Path(folder, "a.cpp")
            source.write_text("int  twice( int x ){return 2*x;}\n")
            self.assertTrue(unformatted([str(source)]))
            source.write_text("int twice(int x) { return 2 * x; }\n")
            self.assertEqual(unformatted([str(source)]), [])


if __name__ == "__main__":
    unittest.main()
