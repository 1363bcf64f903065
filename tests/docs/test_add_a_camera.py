"""docs/developer/add_a_camera.md is true: its camera, put beside the others, is read, described, previewed and renders its rays."""

import array
import json
import math
import unittest

from outside_tree import PageTest

SIDE, STEP, HEIGHT, RADIUS = 15, 12.0, 20.0, 12.0
DOCUMENT = {"ifov": 1, "scene": {"materials": {"soil": {"emissivity": 1, "temperature": "300 K"}, "hot": {"emissivity": 1, "temperature": "320 K"}},
                                 "objects": [{"plane": {"height": "-1 m"}, "material": "soil"},
                                             {"disk": {"center": ["5 m", "0 m", "0 m"], "normal": [0, 0, 1], "radius": f"{RADIUS} m"}, "material": "hot"}]},
            "sensor": {"camera": {"fisheye": {"pixels": [SIDE, SIDE], "pixel_angle": f"{STEP} deg", "position": ["0 m", "0 m", f"{HEIGHT} m"]}},
                       "channels": [{"name": "a", "monochromatic": {"at": "10 um"}}]},
            "sampling": {"grid": {"elements": [1, 1]}}, "output": {"products": ["location", "view_angles"]}}


class AddACamera(PageTest):
    page, row = "add_a_camera.md", "camera"

    def test_two_pairs_of_files_and_one_row(self):
        (self.folder / "scene.json").write_text(json.dumps(DOCUMENT))
        self.assertIn("| `pixel_angle` | angle above 0 deg | **required** | angle that a pixel covers |", self.run_it("schema", "--markdown").stdout)
        checked = self.run_it("check", "scene.json")
        self.assertIn("fisheye, 15 x 15 pixels of 12 deg, at x, y, z 0, 0, 20 m", checked.stdout, checked.stderr)
        result = self.run_it("render", "scene.json", "-o", "out", "-q")
        self.assertIn(result.returncode, (0, 6), result.stderr)
        read = lambda name, code: array.array(code, (self.folder / f"out/image_{name}.img").read_bytes())
        radiance, places, angles = read("radiance", "f"), read("location", "d"), read("view_angles", "f")
        hot, soil, sky = (sorted(set(radiance), reverse=True) + [0.0])[:3]
        self.assertEqual(sky, 0.0)
        seen = set()
        for row in range(SIDE):
            for column in range(SIDE):
                x, y = column - SIDE // 2, SIDE // 2 - row
                off = math.radians(STEP) * math.hypot(x, y)
                if off >= math.pi / 2:
                    expected = 0.0
                else:
                    scale = HEIGHT * math.tan(off) / (math.hypot(x, y) or 1.0)
                    expected = hot if math.hypot(x * scale - 5.0, y * scale) < RADIUS else soil
                    if expected == hot:
                        self.assertAlmostEqual(places[(3 * row) * SIDE + column], x * scale, 6)
                        self.assertAlmostEqual(places[(3 * row + 1) * SIDE + column], y * scale, 6)
                        self.assertAlmostEqual(angles[2 * row * SIDE + column], math.degrees(off), 4)
                self.assertEqual(radiance[row * SIDE + column], expected, (row, column))
                seen.add(expected)
        self.assertEqual(seen, {hot, soil, 0.0})
        record = json.loads((self.folder / "out/image_run.json").read_text())
        self.assertEqual(record["acquisition"]["camera"]["model"], "fisheye")
        preview = self.run_it("preview", "scene.json", "-o", "small.png", "--pixels", "32", "--seconds", "1", "-q")
        self.assertIn(preview.returncode, (0, 6), preview.stderr)

        airy = json.loads(json.dumps(DOCUMENT))
        airy["sensor"]["psf"] = {"airy": {"aperture": "1 cm", "wavelength": "10 um"}}
        for document, words in ((airy, "an Airy PSF needs a 'frame' camera"),
                                (json.loads(json.dumps(DOCUMENT).replace(f"{STEP} deg", "20 deg")), "scene.json:1:[0-9]+: the corners of the image are 212.1 degrees off the axis; expected less than 180")):
            (self.folder / "scene.json").write_text(json.dumps(document))
            result = self.run_it("check", "scene.json")
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, words)


if __name__ == "__main__":
    unittest.main()
