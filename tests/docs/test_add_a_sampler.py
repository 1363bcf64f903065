"""docs/developer/add_a_sampler.md is true: its sampler, put beside the others, is read, and its values lie within its intervals."""

import array
import json
import unittest

from outside_tree import PageTest

SIDE = 12
DOCUMENT = {"ifov": 1, "scene": {"materials": {"soil": {"emissivity": 1, "temperature": "300 K"}, "hot": {"emissivity": 1, "temperature": "320 K"}},
                                 "objects": [{"plane": {}, "material": "soil"},
                                             {"box": {"low": ["-3.3 m", "-9 m", "0 m"], "high": ["2.4 m", "9 m", "1 m"]}, "material": "hot"}]},
            "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [SIDE, SIDE]}}, "channels": [{"name": "a", "monochromatic": {"at": "10 um"}}]},
            "sampling": {"random": {"samples": 64}, "tile": 5}, "output": {"products": ["half_width", "samples"]}}


class AddASampler(PageTest):
    page, row = "add_a_sampler.md", "sampler"

    def rendered(self, document, *arguments):
        (self.folder / "scene.json").write_text(json.dumps(document))
        result = self.run_it("render", "scene.json", "-o", "out", "-q", "--restart", *arguments)
        self.assertIn(result.returncode, (0, 6), result.stderr)
        return [array.array(code, (self.folder / f"out/image_{name}.img").read_bytes()) for name, code in (("radiance", "f"), ("half_width", "f"), ("samples", "I"))]

    def test_two_pairs_of_files_and_one_row(self):
        self.assertIn("| `samples` | integer, 2 to 100000 | **required** | points in each pixel |", self.run_it("schema", "--markdown").stdout)
        values, widths, samples = self.rendered(DOCUMENT, "-j", "1")
        self.assertEqual(set(samples[:SIDE]), {64})  # by lines, in each the bands
        self.assertEqual(self.rendered(DOCUMENT, "-j", "2")[0], values)
        soil, hot = min(values), max(values)
        self.assertEqual(json.loads((self.folder / "out/image_run.json").read_text())["sampler"], "random, 64 samples")

        def share_of(x):  # of the hot box in the pixel that begins at x
            return max(0.0, min(x + 1.0, 2.4) - max(x, -3.3))

        mixed = 0
        for row in range(SIDE):
            for column in range(SIDE):
                share = share_of(column - SIDE / 2)
                value, width = values[row * SIDE + column], widths[row * SIDE + column]
                error = abs((value - soil) / (hot - soil) - share)
                if 0.0 < share < 1.0:
                    mixed += 1
                    self.assertGreater(width, 0.0)
                    self.assertLess(error, 0.1)
                    self.assertLess(error * (hot - soil), 1.5 * width)
                else:
                    self.assertLess(error, 1e-6)
        self.assertEqual(mixed, 2 * SIDE)

        # Under an optical blur the points weigh as the footprint says: the border is as wide as it is.
        blurred = json.loads(json.dumps(DOCUMENT))
        blurred["sensor"]["psf"] = {"gaussian": {"sigma": "0.8 px"}}
        blurred["sampling"]["random"]["samples"] = 2048
        soft = self.rendered(blurred)[0]
        blurred["sampling"] = {"grid": {"elements": [16, 16]}}
        for a, b in zip(soft, self.rendered(blurred)[0]):
            self.assertLess(abs(a - b), 0.03 * (hot - soil))  # a standard error of some 300 points that count is as large

        blurred["sampling"] = {"random": {"samples": 1}}
        (self.folder / "scene.json").write_text(json.dumps(blurred))
        self.assertIn("'sampling.random.samples' is the number 1, expected an integer between 2 and 100000", self.run_it("check", "scene.json").stderr)


if __name__ == "__main__":
    unittest.main()
