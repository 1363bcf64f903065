"""Runs the built program; found where IFOV_PROGRAM says, else in build/."""

import json
import os
import pathlib
import resource
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))

DOME = """// A warm dome on cool ground, seen from above.
{
  "ifov": 1,
  "scene": {
    "materials": {
      "ground": {"emissivity": 1, "temperature": "20 degC"},
      "roof": {"emissivity": 1, "temperature": "40 degC"}
    },
    "objects": [
      {"plane": {}, "material": "ground"},
      {"name": "dome", "hemisphere": {"center": ["0 m", "0 m", "0 m"], "radius": "0.4 m"}, "material": "roof"}
    ]
  },
  "sensor": {
    "camera": {"orthographic": {"gsd": "1 m", "pixels": [3, 3]}},
    "channels": [{"name": "B", "monochromatic": {"at": "8.5 um"}}]
  },
  "sampling": {"accuracy": {"error": "0.1 K", "channel": "B"}},
  "output": {"formats": ["envi", "png"]}
}
"""

# Far more work than a test waits for.
LONG = (
    DOME.replace('"pixels": [3, 3]', '"pixels": [4000, 4000]')
    .replace('"gsd": "1 m"', '"gsd": "1 mm"')
    .replace('{"accuracy": {"error": "0.1 K", "channel": "B"}}', '{"grid": {"elements": [30, 30]}, "tile": 64}')
)


def run(*arguments, cwd=None):
    """The finished process, with its output as text."""
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=120)


def slowdown():
    """How many times its processor time a process takes now: 1 on an idle machine."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    run("schema")
    elapsed, after = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return max(1.0, elapsed / (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime))


class Folder:
    """A temporary folder with documents in it."""

    def __init__(self, **documents):
        self._folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self._folder.name)
        for name, text in documents.items():
            (self.path / f"{name}.json").write_text(text)

    def __enter__(self):
        return self.path

    def __exit__(self, *_):
        self._folder.cleanup()


def products(folder):
    """Every product's bytes; of the run record all but when it was made and the time it took."""
    content = {}
    for file in sorted(pathlib.Path(folder).iterdir()):
        content[file.name] = file.read_bytes() if file.is_file() else None
    record = json.loads(content["image_run.json"])
    record.pop("date")
    record["cost"].pop("elapsed_s")
    record["cost"].pop("threads")
    content["image_run.json"] = record
    return content


class WholeProducts:
    """For test cases with a finished run's products in `reference`, and the Folder that they came from in `_folder`."""

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__()

    def expect_whole(self, folder, whole=None):
        """That a folder holds these products, `reference` where none are given."""
        whole = whole or self.reference
        found = products(folder)
        self.assertEqual(sorted(found), sorted(whole))
        for name, content in whole.items():
            self.assertEqual(found[name], content, f"{folder}/{name}")
