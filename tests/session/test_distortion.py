"""Lens distortion in images: places of small things against OpenCV's equations, intervals against grids, and what is said of it."""

import json
import unittest
from pathlib import Path

import numpy

from images import RenderedCase

WIDTH, HEIGHT, F = 96, 72, 100.0  # focal length in pixels
TERMS = {"k1": -0.3, "k2": 0.12, "p1": 0.01, "p2": -0.006}


def document(objects, sampling, distortion=TERMS, seed=1, coarser=1, **sensor):
    camera = {"frame": {"pixels": [WIDTH // coarser, HEIGHT // coarser], "focal_length": "1 mm", "pitch": f"{10 * coarser} um", "position": ["0 m", "0 m", "1 km"],
                        "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0], **({"distortion": distortion} if distortion else {})}}
    return {"ifov": 1, "seed": seed,
            "scene": {"materials": {"dark": {"reflectance": 0, "temperature": "1500 K"}, "light": {"reflectance": 0, "temperature": "3000 K"}},
                      "objects": [{"plane": {"height": "0 m"}, "material": "dark"}, *objects]},
            "light": {"surroundings": {"reflectance": 0, "temperature": "1 K"}},
            "sensor": {"camera": camera, "channels": [{"name": "a", "monochromatic": {"at": "1 um"}}], **sensor},
            "sampling": sampling, "output": {"formats": ["envi"]}}


def flat(*corners):
    return {"polygon": {"vertices": [[f"{x} m", f"{y} m", "1 mm"] for x, y in corners]}, "material": "light"}


def image_of(x, y, k1=0.0, k2=0.0, k3=0.0, p1=0.0, p2=0.0):
    """Column and row, from the upper left corner, as OpenCV documents its camera model; x to the right and y down, in focal lengths."""
    r2 = x * x + y * y
    radial = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
    return (F * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + WIDTH / 2,
            F * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + HEIGHT / 2)


class LensDistortion(RenderedCase):
    def render(self, described):
        return self.rendered(described, *reversed(described["sensor"]["camera"]["frame"]["pixels"]))

    def table(self, text):
        path = Path(self.folder.name) / "lens.csv"
        path.write_text(text)
        return {"table": {"file": path.name}}

    def flown(self, described, **more):
        """The same from a platform that hovers there, heading north."""
        camera = described["sensor"]["camera"]["frame"]
        for key in ("position", "look_at", "up"):
            del camera[key]
        camera |= more
        return {**described, "platform": {"fixed": {"frame": "scene", "position": ["0 m", "0 m", "1 km"]}, "attitude": {"from": "north"}}}

    def test_a_table_and_a_platform_show_the_same(self):
        things = [flat((-310, -190), (140, -230), (90, 170), (-280, 215)), flat((210, -330), (420, -310), (400, 290), (260, 300))]
        centred, accuracy = {"k1": -0.3, "k2": 0.12}, {"accuracy": {"error": "2 %"}}
        plain = self.render(document(things, accuracy, centred, coarser=2))
        rows = "".join(f"{r:.4f},{r * (1 - 0.3 * r * r + 0.12 * r**4):.12g}\n" for r in numpy.linspace(0.02, 0.8, 40))
        tabled = document(things, accuracy, self.table("radius_mm,displaced_mm\n" + rows), coarser=2)
        for described in (tabled, self.flown(document(things, accuracy, centred, coarser=2)), self.flown(document(things, accuracy, centred, coarser=2), row_period="1 ms")):
            found = self.render(described)
            self.assertGreater(numpy.mean(numpy.abs(found["radiance"] - plain["radiance"]) <= found["half_width"] + plain["half_width"]), 0.99)
        straight = self.render(self.flown(document(things, accuracy, None, coarser=2)))
        self.assertLess(numpy.mean(numpy.abs(straight["radiance"] - plain["radiance"]) <= straight["half_width"] + plain["half_width"]), 0.95)

    def test_points_appear_where_opencv_has_them(self):
        places = [(x, y) for x in (-0.42, -0.21, 0.0, 0.21, 0.42) for y in (-0.3, -0.15, 0.0, 0.15, 0.3)]
        half = 4.0  # m; a pixel of the middle sees 10 m
        squares = [flat(*((1000 * x + a * half, -1000 * y + b * half) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))) for x, y in places]
        radiance = self.render(document(squares, {"accuracy": {"error": "1 %"}}, psf={"gaussian": {"sigma": "0.7 px"}}))["radiance"]
        light = radiance - numpy.median(radiance)
        for x, y in places:
            u, v = image_of(x, y, **TERMS)
            i, j = int(u), int(v)
            rows, columns = numpy.mgrid[j - 4 : j + 5, i - 4 : i + 5]
            near = light[rows, columns]
            found = numpy.sum(near * (columns + 0.5)) / near.sum(), numpy.sum(near * (rows + 0.5)) / near.sum()
            self.assertLess(max(abs(found[0] - u), abs(found[1] - v)), 0.02, (x, y))
        # Planted faults: no distortion; tangential terms the other way.
        for terms in ({}, {**TERMS, "p1": -0.01, "p2": 0.006}):
            u, v = image_of(*places[-1], **terms)
            self.assertGreater(max(abs(found[0] - u), abs(found[1] - v)), 0.1)

    def test_intervals_hold_what_grids_find(self):
        things = [flat((-310, -190), (140, -230), (90, 170), (-280, 215)), flat((210, -330), (420, -310), (400, 290), (260, 300)),
                  flat((-520, 60), (-430, -40), (-350, 320))]
        coarse, fine = (self.render(document(things, {"grid": {"elements": [n, n]}}, coarser=2))["radiance"] for n in (20, 40))
        for seed in (1, 2):
            found = self.render(document(things, {"accuracy": {"error": "2 %"}}, seed=seed, coarser=2))
            within = found["half_width"] + numpy.abs(coarse - fine)
            edges = (fine > fine.min() * 1.001) & (fine < fine.max() * 0.999)
            self.assertGreater(edges.sum(), 100)
            self.assertGreater(numpy.mean((numpy.abs(found["radiance"] - fine) <= within)[edges]), 0.93)
        plain = self.render(document(things, {"accuracy": {"error": "2 %"}}, distortion=None, coarser=2))
        self.assertLess(numpy.mean((numpy.abs(plain["radiance"] - fine) <= plain["half_width"])[edges]), 0.5)

    def test_what_is_said_of_it(self):
        check = self.run_ifov("check", document([], {"accuracy": {"error": "1 %"}})).stdout
        u, v = image_of(0.48, 0.36, **TERMS)
        moved = numpy.hypot(u - WIDTH / 2, v - HEIGHT / 2) - numpy.hypot(WIDTH / 2, HEIGHT / 2)
        self.assertIn(f"lens distortion by {moved:.3g} px at the lower right corner", check)
        guide = (Path(__file__).parents[2] / "docs" / "guide" / "optics.md").read_text()
        described = document([], {"accuracy": {"error": "1 %"}})
        described["sensor"]["camera"] = json.loads("{" + guide.split("## Distortion")[1].split("```json\n")[1].split("```")[0] + "}")
        self.assertEqual(self.run_ifov("check", described).returncode, 0)
        for distortion, texts in (({"k1": -3}, ("doc.json:1:", "the lens distortion folds back within the frame: no direction has its image at pixel ")),
                                  ({"k4": 1}, ("unknown key 'k4' in 'sensor.camera.frame.distortion'",))):
            done = self.run_ifov("check", document([], {"accuracy": {"error": "1 %"}}, distortion))
            self.assertNotEqual(done.returncode, 0)
            for text in texts:
                self.assertIn(text, done.stderr)
        for text, says in (("radius_mm,displaced_mm\n0,0\n0.3,0.29\n0.2,0.3\n", "csv:4: found 0.2 mm that appear at 0.3 mm after 0.3 mm at 0.29 mm; expected both to increase from the axis on"),
                           ("radius_mm,displaced_mm\n0.3,0.29\n", "csv:2: the table ends at 0.29 mm of the image, whose corners lie at 0.6 mm; expected rows up to there"),
                           ("radius_mm,displaced\n0.3,0.29\n", "csv:1:11: found the heading 'displaced'; expected 'radius_mm' or 'displaced_mm'"),
                           ("radius_mm\n0.3\n", "the table has no column 'displaced_mm'")):
            done = self.run_ifov("check", document([], {"accuracy": {"error": "1 %"}}, self.table(text)))
            self.assertIn(says, done.stderr)
            self.assertIn("doc.json:1:", done.stderr)
        both = {**self.table("radius_mm,displaced_mm\n1,1\n"), "k1": 0.1}
        self.assertIn("a lens is distorted by terms or by a 'table', and this one has both: leave one out",
                      self.run_ifov("check", document([], {"accuracy": {"error": "1 %"}}, both)).stderr)


if __name__ == "__main__":
    unittest.main()
