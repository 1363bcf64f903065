"""Images of flat scenes in which each level surface sends its reflectance: documents, and the program run on them."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy

PROGRAM = os.environ["IFOV_PROGRAM"]


def across(width):
    """Where the middles of columns lie."""
    return (2 * numpy.arange(width) + 1) / width - 1


def table(wavelength_nm, values):
    return {"table": {"wavelength": [f"{w:.6f} nm" for w in wavelength_nm], "values": [float(v) for v in values]}}


def orthographic(size):
    return {"orthographic": {"gsd": "1 m", "pixels": size, "center": ["0 m", "0 m"]}}


def document(size, channels, spectrum, *objects, sampling=None, output=None, light=None, **sensor):
    """White light from all over the sky: a level surface sends its reflectance."""
    return {"ifov": 1, "seed": 1,
            "scene": {"materials": {"ground": {"reflectance": spectrum}, "dark": {"reflectance": 0}},
                      "objects": [{"plane": {"height": "0 m"}, "material": "ground"}, *objects]},
            "light": light or {"sky": {"radiance": "1 W m-2 sr-1 um-1"}},
            "sensor": {"camera": orthographic(size), "channels": channels, **sensor},
            "sampling": sampling or {"grid": {"elements": [1, 1]}}, "output": output or {"formats": ["envi"]}}


class Rendered(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.path)

    def render(self, described, *options):
        """By product: bands, rows, columns."""
        name = self.path / f"run{len(list(self.path.iterdir()))}"
        source = Path(f"{name}.json")
        source.write_text(json.dumps(described))
        done = self.run_program("render", source, "--output", name, *options)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        self.out, self.said = name, done.stderr
        (model,) = described["sensor"]["camera"].values()
        columns, rows = model["pixels"]
        read = {}
        for file in name.glob("image_*.img"):
            product = file.stem[len("image_"):]
            if product not in ("wavelengths", "demosaiced"):
                if "data type = 4" not in Path(f"{file}.hdr").read_text():
                    continue
                read[product] = numpy.fromfile(file, "f4").astype(float).reshape(rows, -1, columns).transpose(1, 0, 2)
        return read

    def refused(self, described, *options):
        source = self.path / "bad.json"
        source.write_text(json.dumps(described, indent=1))
        done = self.run_program("check", source, *options)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        return done.stderr


def half_plane(x_m):
    """Dark right of x."""
    return {"polygon": {"vertices": [[f"{x} m", f"{y} m", "1 mm"] for x, y in ((x_m, -900), (900, -900), (900, 900), (x_m, 900))]}, "material": "dark"}
