"""Documents of the tests of the Python package."""

import copy
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["IFOV_PROGRAM"]


def ten_lines():
    """The document of the README."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return json.loads(re.search(r"```json\n(.*?)```", text, re.DOTALL).group(1))


#: A sphere on the ground under a black sky: loading takes no time and warns of nothing.
SMALL = {
    "ifov": 1,
    "seed": 5,
    "scene": {
        "materials": {
            "ground": {"reflectance": 0.3, "temperature": "20 degC"},
            "ball": {"reflectance": 0.6, "temperature": "35 degC"},
        },
        "objects": [
            {"plane": {}, "material": "ground"},
            {"sphere": {"center": ["-2 m", "1 m", "1 m"], "radius": "1.4 m"}, "material": "ball"},
        ],
    },
    "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
    "sensor": {
        "camera": {"orthographic": {"gsd": "0.3 m", "pixels": [20, 14]}},
        "channels": [
            {"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
            {"name": "T", "top_hat": {"from": "10 um", "to": "11 um"}},
        ],
    },
    "sampling": {"accuracy": {"error": "4 %"}, "tile": 8},
}


def small(**members):
    """A copy with other members at its root."""
    return copy.deepcopy(SMALL) | members


def endless():
    """Far more work than a test waits for."""
    document = small(sampling={"accuracy": {"error": "0.001 %"}, "tile": 8})
    document["sensor"]["camera"]["orthographic"]["pixels"] = [2000, 2000]
    return document


class InFolder(unittest.TestCase):
    """Each test works in a folder of its own."""

    def setUp(self):
        before = os.getcwd()
        folder = tempfile.mkdtemp(prefix="ifov_python_")
        self.addCleanup(shutil.rmtree, folder)
        self.addCleanup(os.chdir, before)
        os.chdir(folder)
        self.folder = pathlib.Path(folder)

    def program(self, *arguments):
        """What the program prints; it ends well, or not all pixels converged."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 5), done.stderr)
        return done.stdout
