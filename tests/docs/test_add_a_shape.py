"""docs/developer/add_a_shape.md is true: its shape, put beside the others, is read, described, met by rays and lit as it should be."""

import array
import json
import math
import unittest

from outside_tree import PageTest

SIDE, RADIUS, HEIGHT, ZENITH = 24, 5.0, 8.0, 50.0
# Its axis lies at (1, 0); a copy of it, half as large and turned on its side, stands elsewhere.
CONE = {"base": ["1 m", "0 m", "2 m"], "radius": f"{RADIUS} m", "height": f"{HEIGHT} m"}
DOCUMENT = {"ifov": 1, "scene": {"materials": {"soil": {"reflectance": 0.2}, "roof": {"reflectance": 0.5}},
                                 "objects": [{"plane": {}, "material": "soil"}, {"cone": CONE, "material": "roof"}]},
            "light": {"sun": {"point": {"zenith": f"{ZENITH} deg", "azimuth": "90 deg"}}},
            "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [SIDE, SIDE]}}, "channels": [{"name": "a", "monochromatic": {"at": "0.65 um"}}]},
            "sampling": {"grid": {"elements": [1, 1]}, "max_depth": 1}, "output": {"products": ["location"]}}


class AddAShape(PageTest):
    page, row = "add_a_shape.md", "shape"

    def rendered(self, document):
        (self.folder / "scene.json").write_text(json.dumps(document))
        result = self.run_it("render", "scene.json", "-o", "out", "-q", "--restart")
        self.assertIn(result.returncode, (0, 6), result.stderr)
        return [array.array(code, (self.folder / f"out/image_{name}.img").read_bytes()) for name, code in (("radiance", "f"), ("location", "d"))]

    def test_two_pairs_of_files_and_one_row(self):
        self.assertIn("An upright circular cone, without a floor.", self.run_it("schema", "--markdown").stdout)
        radiance, places = self.rendered(DOCUMENT)
        # Towards the Sun and up; the slope's normal leans out by atan(height / radius) and is its own below the Sun.
        sun = (math.sin(math.radians(ZENITH)), 0.0, math.cos(math.radians(ZENITH)))
        full = None
        lit = dark = 0
        for row in range(SIDE):
            for column in range(SIDE):
                x, y = (column + 0.5) * 0.5 - 6.0, 6.0 - (row + 0.5) * 0.5
                r = math.hypot(x - 1.0, y)
                z = places[(3 * row + 2) * SIDE + column]
                self.assertAlmostEqual(z, 2.0 + HEIGHT * (1.0 - r / RADIUS) if r < RADIUS else 0.0, 9)
                if r >= RADIUS:
                    continue
                leans = math.hypot(HEIGHT, RADIUS)
                normal = ((x - 1.0) / r * HEIGHT / leans, y / r * HEIGHT / leans, RADIUS / leans)
                cosine = sum(a * b for a, b in zip(normal, sun))
                value = radiance[row * SIDE + column]
                if cosine < 0.0:
                    dark += 1
                    self.assertEqual(value, 0.0, (x, y))
                else:
                    full = full or value / cosine
                    lit += 1
                    self.assertAlmostEqual(value / full, cosine, 5)
        self.assertGreater(lit, 100)
        self.assertGreater(dark, 20)

        # The same by copies of a prototype, which have transforms of their own.
        copied = json.loads(json.dumps(DOCUMENT))
        copied["scene"]["prototypes"] = {"hat": [{"cone": {**CONE, "base": ["0 m", "0 m", "0 m"]}, "material": "roof"}]}
        copied["scene"]["objects"][1] = {"instances": {"of": "hat", "at": [["1 m", "0 m", "2 m"]]}}
        again, places_again = self.rendered(copied)
        for a, b in zip(radiance, again):
            self.assertAlmostEqual(a, b, 5)
        for a, b in zip(places, places_again):
            self.assertAlmostEqual(a, b, 6)

        # In the accuracy sampler, as something that shines and as a mirror, it is met like any other.
        hot = json.loads(json.dumps(DOCUMENT))
        hot["scene"]["materials"] = {"soil": {"reflectance": 0.2, "temperature": "290 K"}, "roof": {"emissivity": 1, "temperature": "600 K"},
                                     "glass": {"reflectance": 0.9, "scattering": "mirror", "temperature": "290 K"}}
        hot["scene"]["objects"].append({"cone": {"base": ["-4 m", "0 m", "0 m"], "radius": "1 m", "height": "0.5 m"}, "material": "glass"})
        hot["sensor"]["channels"] = [{"name": "a", "monochromatic": {"at": "10 um"}}]
        hot["sensor"]["camera"]["orthographic"].update(gsd="2 m", pixels=[6, 6])
        hot["sampling"] = {"accuracy": {"error": "20 %"}}
        self.rendered(hot)
        hot["scene"]["objects"][1]["cone"]["height"] = "0 m"
        (self.folder / "scene.json").write_text(json.dumps(hot))
        self.assertIn("'scene.objects[1].cone.height' is the text \"0 m\", expected a length above 0 m", self.run_it("check", "scene.json").stderr)


if __name__ == "__main__":
    unittest.main()
