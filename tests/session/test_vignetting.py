"""Vignetting: electrons, counts and noise off the middle of the field against cos^4 and a polynomial; radiance that is made of them stays even."""

import array
import json
import math
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy

PROGRAM = os.environ["IFOV_PROGRAM"]
WIDTH, HEIGHT, FOCAL_PX = 64, 48, 40.0


def document(vignetting, detector=None, camera=None, optics=None):
    """An even black plane of 300 K below a camera that sees 45 degrees to its corners."""
    camera = camera or {"frame": {"pixels": [WIDTH, HEIGHT], "focal_length": "1 mm", "pitch": "25 um", "position": ["0 m", "0 m", "1 km"],
                                  "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}}
    return {"ifov": 1, "scene": {"materials": {"black": {"reflectance": 0, "temperature": "300 K"}},
                                 "objects": [{"plane": {"height": "0 m"}, "material": "black"}]},
            "light": {"surroundings": {"reflectance": 0, "temperature": "1 K"}},
            "sensor": {"camera": camera, "channels": [{"name": "a", "top_hat": {"from": "9.5 um", "to": "10.5 um"}}],
                       "optics": {"f_number": 2, **(optics or {}), **({"vignetting": vignetting} if vignetting else {})},
                       "detector": {"integration_time": "0.2 ms", "quantum_efficiency": 0.7, "read_noise": "300 e-", "full_well": "100 Me-",
                                    "bits": 16, **(detector or {})}},
            "sampling": {"accuracy": {"error": "1 %"}}, "output": {"formats": ["envi"]}}


def light(polynomial=(), cos4=True):
    x, y = numpy.meshgrid(numpy.arange(WIDTH) + 0.5 - WIDTH / 2, numpy.arange(HEIGHT) + 0.5 - HEIGHT / 2)
    r = numpy.hypot(x, y)
    share = numpy.cos(numpy.arctan(r / FOCAL_PX)) ** 4 if cos4 else numpy.ones_like(r)
    s = r**2 / (WIDTH**2 + HEIGHT**2) * 4
    return share * (1 + sum(term * s ** (k + 1) for k, term in enumerate(polynomial)))


class Vignetting(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_ifov(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)

    def detected(self, described, seeds=range(1, 9)):
        """By quantity: realisations, rows, columns."""
        source, out = Path(self.folder.name) / "doc.json", Path(self.folder.name) / "run"
        source.write_text(json.dumps(described))
        done = self.run_ifov("render", source, "--output", out, "--restart")
        self.assertIn(done.returncode, (0, 6), done.stderr)
        found = {"electrons": [], "noisy": [], "counts": []}
        for seed in seeds:
            done = self.run_ifov("detect", out, "--quantity", "electrons,radiance,counts", "--seed", seed)
            self.assertEqual(done.returncode, 0, done.stderr)
            for name, values in found.items():
                (file,) = out.glob(f"*_{name}_{seed}.img")
                values.append(numpy.array(array.array("H" if name == "counts" else "f", file.read_bytes())).astype(float).reshape(HEIGHT, WIDTH))
        return {name: numpy.array(values) for name, values in found.items()}

    def test_electrons_fall_and_radiance_stays(self):
        found = self.detected(document({"cos4": True, "polynomial": [-0.2, 0.05]}))
        share = light((-0.2, 0.05))
        electrons = found["electrons"].mean(axis=0)
        def misfit(expected):
            middle = numpy.sum(electrons) / numpy.sum(expected)
            return numpy.mean((electrons - middle * expected) ** 2 / (middle * expected + 300**2) * 8)
        middle = numpy.sum(electrons) / numpy.sum(share)
        self.assertAlmostEqual(misfit(share), 1.0, delta=6 * math.sqrt(2 / electrons.size))
        # Planted faults: without the polynomial; cos^3.
        self.assertGreater(misfit(light()), 50.0)
        self.assertGreater(misfit(light((-0.2, 0.05), cos4=False) * light() ** 0.75), 50.0)
        self.assertAlmostEqual(numpy.mean(found["counts"][:, 0, 0]) / numpy.mean(found["counts"][:, HEIGHT // 2, WIDTH // 2]),
                               share[0, 0] / share[HEIGHT // 2, WIDTH // 2], delta=0.003)
        radiance = found["noisy"]
        corners, inner = radiance[:, :6, :6], radiance[:, HEIGHT // 2 - 3 : HEIGHT // 2 + 3, WIDTH // 2 - 3 : WIDTH // 2 + 3]
        self.assertLess(abs(corners.mean() / inner.mean() - 1), 5 * corners.std() / corners.mean() / math.sqrt(corners.size) * 1.5)
        # Noise of photons and reading over a share of the light.
        there = share[:6, :6].mean()
        gain = 1e8 / 65535
        grown = math.sqrt((middle * there + 300**2 + gain**2 / 12) / (middle + 300**2 + gain**2 / 12)) / there
        self.assertAlmostEqual(corners.std() / inner.std() / grown, 1.0, delta=0.2)
        self.assertGreater(grown, 1.8)

    def test_light_falls_by_a_table(self):
        # In millimetres of the image, whose corners lie at 1 mm.
        heights, shares = [0, 0.4, 0.7, 1.0], [1, 0.95, 0.6, 0.3]
        (Path(self.folder.name) / "light.csv").write_text("height_mm,share\n" + "".join(f"{h},{s}\n" for h, s in zip(heights, shares, strict=True)))
        found = self.detected(document({"table": {"file": "light.csv"}}))
        x, y = numpy.meshgrid(numpy.arange(WIDTH) + 0.5 - WIDTH / 2, numpy.arange(HEIGHT) + 0.5 - HEIGHT / 2)
        electrons = found["electrons"].mean(axis=0)
        def misfit(share):
            middle = numpy.sum(electrons) / numpy.sum(share)
            return numpy.mean((electrons - middle * share) ** 2 / (middle * share + 300**2) * 8)
        share = numpy.interp(0.025 * numpy.hypot(x, y), heights, shares)
        self.assertAlmostEqual(misfit(share), 1.0, delta=6 * math.sqrt(2 / electrons.size))
        self.assertGreater(misfit(numpy.interp(0.025 * numpy.hypot(x, y), heights, [1, 0.95, 0.63, 0.3])), 3.0)
        told = self.run_ifov("sensor", Path(self.folder.name) / "doc.json").stdout
        self.assertRegex(told, r"at corners +30 % of the light")

    def test_a_correction_evens_out_what_it_measured(self):
        correction = {"low": {"temperature": "280 K"}, "high": {"temperature": "320 K"}, "frames": 4096}
        found = self.detected(document({"cos4": True}, {"correction": correction}), range(1, 5))
        for name in ("electrons", "noisy"):
            values = found[name]
            corners, inner = values[:, :6, :6], values[:, HEIGHT // 2 - 3 : HEIGHT // 2 + 3, WIDTH // 2 - 3 : WIDTH // 2 + 3]
            self.assertLess(abs(corners.mean() / inner.mean() - 1), 0.001, name)

    def test_what_follows_is_told(self):
        source = Path(self.folder.name) / "doc.json"
        source.write_text(json.dumps(document({"cos4": True})))
        told = self.run_ifov("sensor", source).stdout
        found = re.search(r"at corners +([0-9.]+) % of the light, SNR ([0-9.e+]+), NEdT ([0-9.]+) K", told)
        middle = {name: float(re.search(name + r" +([0-9.e+-]+)", told)[1]) for name in ("electrons", "SNR", "NEdT")}
        self.assertEqual(float(found[1]), 25.0)
        gain = 1e8 / 65535
        noise = math.sqrt(0.25 * middle["electrons"] + 300**2 + gain**2 / 12)
        self.assertAlmostEqual(float(found[2]) / (0.25 * middle["electrons"] / noise), 1.0, delta=0.002)
        self.assertAlmostEqual(float(found[3]) / middle["NEdT"], middle["SNR"] / float(found[2]), delta=0.01)

    def test_what_the_guide_shows_is_checked(self):
        guide = (Path(__file__).parents[2] / "docs" / "guide" / "optics.md").read_text()
        shown = [json.loads("{" + text + "}") for text in re.findall(r"```json\n(.*?)```", guide, re.S)]
        optics = [one["optics"] for one in shown if "optics" in one]
        self.assertGreater(len(optics), 1)
        for one in optics:
            source = Path(self.folder.name) / "doc.json"
            source.write_text(json.dumps(document(None, optics=one)))
            done = self.run_ifov("check", source)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_bad_vignetting_is_told(self):
        for name, rows in (("light", "0,1\n0.5,0.8\n"), ("dim", "0,0.9\n2,0.8\n"), ("back", "0,1\n0.5,0.8\n0.2,0.7\n")):
            (Path(self.folder.name) / f"{name}.csv").write_text("height_mm,share\n" + rows)
        orthographic = {"orthographic": {"gsd": "1 m", "pixels": [8, 8]}}
        pitch = {"pitch": "25 um"}
        for described, text in (
            (document({"cos4": False}), "doc.json:1:.*vignetting of neither 'cos4', a 'polynomial' nor a 'table' darkens nothing: give one of them"),
            (document({"polynomial": [-0.1], "table": {"file": "light.csv"}}), "doc.json:1:.*light falls by a 'polynomial' or by a 'table', and this vignetting has both: leave one out"),
            (document({"table": {"file": "light.csv"}}), "light.csv:3: the table ends at 0.5 mm of the image, whose corners lie at 1 mm; expected rows up to there"),
            (document({"table": {"file": "dim.csv"}}), "dim.csv:2: found a share of 0.9 at a height of 0 mm; expected the middle first, 1 at 0 mm"),
            (document({"table": {"file": "back.csv"}}), "back.csv:4: found the height 0.2 mm after 0.5 mm; expected heights that increase"),
            (document({"polynomial": [-1.0]}), "doc.json:1:.*the polynomial leaves 0 of the light somewhere in the field; expected 0.01 at least"),
            (document({"polynomial": [0, 0, 0, 0]}), "doc.json:1:.*polynomial"),
            (document({"cos4": True}, pitch, orthographic),
             "doc.json:1:.*'cos4' takes the field angle, and nothing says the focal length: give 'focal_length', or a 'polynomial'")):
            source = Path(self.folder.name) / "doc.json"
            source.write_text(json.dumps(described))
            done = self.run_ifov("check", source)
            self.assertNotEqual(done.returncode, 0, text)
            self.assertRegex(done.stderr, text)


if __name__ == "__main__":
    unittest.main()
