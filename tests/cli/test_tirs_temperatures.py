"""Blackbodies of 240 to 340 K through the responses of TIRS bands 10 and 11, and back to kelvins by the constants K1 and K2 that Landsat
products come with, and by the response itself. The table is printed."""

import math
import os
import pathlib
import re
import struct
import unittest

from program import Folder, run
from test_detector import planck

TRUTH = pathlib.Path(os.environ.get("IFOV_TRUTH", pathlib.Path(__file__).resolve().parents[3] / "shared/truth"))
RESPONSES = TRUTH / "sensors/rsr-acolite/L8_TIRS.txt"
MTL = TRUTH / "thermal_radiometry/landsat-mtl/LC81060712016134LGN00_MTL.txt"
TEMPERATURES = range(240, 341, 10)


def responses():
    bands = {}
    for line in RESPONSES.read_text().splitlines():
        words = line.split()
        if line.startswith(";;") and len(words) == 3 and words[1] == "BAND":
            rows = bands.setdefault(words[2], [])
        elif words and not line.startswith(";"):
            rows.append((1e-3 * float(words[0]), max(0.0, float(words[1]))))
    return bands


def radiance(response, kelvin):
    """Mean over the response, two points of Gauss in every step of the table."""
    total = weights = 0.0
    for (low, below), (high, above) in zip(response, response[1:]):
        for share in (0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3)):
            weight = (high - low) * (below + share * (above - below))
            total, weights = total + weight * planck(low + share * (high - low), kelvin), weights + weight
    return total / weights


def kelvin(response, value):
    low, high = 150.0, 500.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if radiance(response, middle) < value else (low, middle)
    return low


@unittest.skipUnless(RESPONSES.exists() and MTL.exists(), f"{RESPONSES} or {MTL} is absent")
class Tirs(unittest.TestCase):
    def rendered(self):
        """Radiances by band and temperature."""
        document = f"""{{"ifov": 1,
          "scene": {{"materials": {{"black": {{"emissivity": 1, "temperature": "300 K"}}}}, "objects": [{{"plane": {{}}, "material": "black"}}]}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "100 m", "pixels": [1, 1]}}}},
                     "channels": [{{"name": "10", "tabulated": {{"file": "{RESPONSES}", "wavelength_unit": "nm", "band": "10"}}}},
                                  {{"name": "11", "tabulated": {{"file": "{RESPONSES}", "wavelength_unit": "nm", "band": "11"}}}}]}},
          "sampling": {{"single": {{}}}}, "output": {{"formats": ["envi"]}}}}"""
        values = {}
        with Folder(tirs=document) as folder:
            for temperature in TEMPERATURES:
                done = run("render", "tirs.json", "--set", f"scene.materials.black.temperature={temperature} K", "-o", str(temperature), cwd=folder)
                self.assertIn(done.returncode, (0, 6), done.stderr)
                values[temperature] = struct.unpack("<2f", (folder / f"{temperature}/image_radiance.img").read_bytes())
        return {band: {t: value[k] for t, value in values.items()} for k, band in enumerate(("10", "11"))}

    def test_there_and_back(self):
        constants = dict(re.findall(r"(K[12]_CONSTANT_BAND_1[01]) = ([0-9.]+)", MTL.read_text()))
        seen, curves = self.rendered(), responses()
        print("\nband     T/K   L/(W m-2 sr-1 um-1)   by K1, K2/K   by response/K")
        for band in ("10", "11"):
            k1, k2 = (float(constants[f"K{n}_CONSTANT_BAND_{band}"]) for n in (1, 2))
            for temperature in TEMPERATURES:
                value = seen[band][temperature]
                by_constants = k2 / math.log(k1 / value + 1.0)
                by_response = kelvin(curves[band], value)
                print(f"{band:>4} {temperature:7} {value:21.5f} {by_constants:13.3f} {by_response:15.4f}")
                self.assertLess(abs(by_response - temperature), 1e-3)
                self.assertLess(abs(by_constants - temperature), LARGEST_K[band])
                self.assertGreater(abs(k2 * 1.001 / math.log(k1 / value + 1.0) - temperature), LARGEST_K[band])


# What the two constants are off over this range: they stand for one wavelength.
LARGEST_K = {"10": 0.15, "11": 0.15}

if __name__ == "__main__":
    unittest.main()
