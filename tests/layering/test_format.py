"""Every C++ file is laid out as clang-format lays it out, by the file .clang-format."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Another version lays some lines out differently; this one is Debian 12's.
PROGRAM = "clang-format-14"
FOLDERS = ("benchmarks", "examples", "include", "src", "tests", "tools")


def unformatted(files):
    """Lines of clang-format's complaints."""
    run = subprocess.run([PROGRAM, "--style=file", "--dry-run", "-Werror", *files], capture_output=True, text=True)
    return [line for line in run.stderr.splitlines() if "error:" in line]


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
