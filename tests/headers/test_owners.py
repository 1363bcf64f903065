"""Every header is included by a C++ test, or stands behind one that is: what a test includes is built upon it."""

import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What is tested by running the program alone, and where that is.
THROUGH_THE_PROGRAM = {
    "cli/": "tests/cli",
    "cluster/tile_client.h": "tests/cli/test_mpi.py",
    "landscape/": "tests/landscape/test_make.py",
    "session/surveys/atmosphere_summary.h": "tests/cli/test_atmosphere.py",
    "session/surveys/atmosphere_survey.h": "tests/cli/test_atmosphere.py",
    "session/preview.h": "tests/cli/test_preview.py",
    "viewer/": "tests/viewer/test_answers.py",
    "session/runs/": "tests/cli",
}


def included(file):
    return re.findall(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE)


def behind(root):
    """For each header of src/ and include/, the headers that it includes and that its sources include."""
    headers = {path.relative_to(root / top).as_posix(): path for top in ("src", "include")
               for path in (root / top).rglob("*.h")}
    upon = {name: {h for h in included(path) if h in headers} for name, path in headers.items()}
    for source in (root / "src").rglob("*.cpp"):
        what = [h for h in included(source) if h in headers]
        own = source.with_suffix(".h").relative_to(root / "src").as_posix()
        # A source without a header of its own name defines what headers of its room declare; one of the facade, public ones.
        room = own.split("/")[0]
        owners = {own} if own in headers else {h for include in what for h in (include, *upon[include])
                                               if h.startswith(room + "/")}
        for owner in owners | {h for h in what if h.startswith("ifov/") and room != "cli"}:
            upon[owner] |= set(what)
    return upon


def without_a_test(root):
    upon = behind(root)
    tests = [path for ending in ("*.cpp", "*.h") for path in (root / "tests").rglob(ending)]
    waiting = {header for test in tests for header in included(test) if header in upon}
    reached = set()
    while waiting:
        header = waiting.pop()
        reached.add(header)
        waiting |= upon[header] - reached
    return sorted(name for name in upon if name not in reached and not name.startswith(tuple(THROUGH_THE_PROGRAM)))


class Owners(unittest.TestCase):
    def test_every_header_is_behind_a_test(self):
        self.assertEqual(without_a_test(ROOT), [], "no test in C++ includes these headers or what is built upon them")

    def test_the_tests_of_the_program_are_there(self):
        for what, tests in THROUGH_THE_PROGRAM.items():
            self.assertTrue((ROOT / "src" / what).exists() and (ROOT / tests).exists(), what)

    def test_a_header_that_only_the_program_includes_is_caught(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {"src/math/seen.h": '', "src/math/seen.cpp": '#include "math/seen.h"\n#include "math/within.h"\n',
                               "src/math/within.h": '', "src/math/unseen.h": '', "include/ifov/a.h": '',
                               "src/cli/main.cpp": '#include "math/unseen.h"\n#include "ifov/a.h"\n',
                               "tests/math/test_seen.cpp": '#include "math/seen.h"\n#include "ifov/a.h"\n'}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            self.assertEqual(without_a_test(root), ["math/unseen.h"])


if __name__ == "__main__":
    unittest.main()
