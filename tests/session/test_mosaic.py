"""Mosaics of colour filters: what each element has through its own filter, channels taken apart, and bilinear demosaicing."""

import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).parent))
from flat_scenes import Rendered, document, half_plane, table

SIZE = [14, 10]
BAYER = [["red", "green"], ["green", "blue"]]
LEVEL = {"red": 0.6, "green": 0.4, "blue": 0.2}


def channels(**more):
    return [{"name": name, "top_hat": {"from": f"{at - 10} nm", "to": f"{at + 10} nm"}, **more}
            for name, at in (("red", 650), ("green", 550), ("blue", 450))]


GROUND = table([430, 475, 525, 575, 625, 675], [0.2, 0.2, 0.4, 0.4, 0.6, 0.6])
GRID = {"grid": {"elements": [4, 4]}}


def pattern_of(mosaic, names=("red", "green", "blue")):
    """Channel of each element."""
    pattern = numpy.array([[names.index(name) for name in row] for row in mosaic])
    return numpy.tile(pattern, (-(-SIZE[1] // pattern.shape[0]), -(-SIZE[0] // pattern.shape[1])))[: SIZE[1], : SIZE[0]]


class Mosaics(Rendered):
    def shape(self, values, bands):
        return values.reshape(SIZE[1], bands, SIZE[0]).transpose(1, 0, 2)

    def test_each_element_has_its_own_channel(self):
        for mosaic in (BAYER, [["blue", "red", "green"], ["green", "blue", "red"], ["red", "green", "blue"]], [["green", "green", "red", "blue"]]):
            products = ["radiance", "half_width", "mosaic", "mosaic_half_width", "mosaic_channels"]
            seen = self.render(document(SIZE, channels(), GROUND, half_plane(1.3), mosaic=mosaic, sampling={"accuracy": {"error": "1 %"}, "tile": 16},
                                        output={"formats": ["envi"], "products": products}))
            own = pattern_of(mosaic)
            picked = numpy.take_along_axis(seen["radiance"], own[None], 0)[0]
            self.assertTrue((seen["mosaic"][0] == picked).all())
            self.assertTrue((seen["mosaic_half_width"][0] == numpy.take_along_axis(seen["half_width"], own[None], 0)[0]).all())
            for k, name in enumerate(("red", "green", "blue")):
                apart = seen["mosaic_channels"][k]
                self.assertTrue((numpy.isnan(apart) == (own != k)).all())
                self.assertTrue((apart[own == k] == seen["radiance"][k][own == k]).all())
                self.assertAlmostEqual(picked[:, :6][own[:, :6] == k].max(), LEVEL[name], delta=1e-5)
            header = (self.out / "image_mosaic.img.hdr").read_text()
            self.assertIn("mosaic pattern = {" + ", ".join("(" + ", ".join(row) + ")" for row in mosaic) + "}", header)
            self.assertIn("bands = 1\n", header)

    def test_usual_products_have_it(self):
        self.render(document(SIZE, channels(), GROUND, mosaic=BAYER, sampling={"accuracy": {"error": "1 %"}}))
        self.assertTrue((self.out / "image_mosaic.img").exists() and (self.out / "image_mosaic_half_width.img").exists())

    def test_bilinear_demosaicing(self):
        """Of a ramp it is exact inside; of Bayer's pattern it is the mean of the two or four neighbours, and own values stay."""
        ramp = {"polygon": {"vertices": [["-7 m", "-5 m", "1 mm"], ["7 m", "-5 m", "1 mm"], ["7 m", "5 m", "1 mm"]]}, "material": "dark"}
        described = document(SIZE, channels(), GROUND, ramp, mosaic=BAYER, sampling=GRID, output={"formats": ["envi", "demosaiced"], "products": ["radiance", "mosaic"]})
        seen = self.render(described)
        raw, own = seen["mosaic"][0], pattern_of(BAYER)
        made = self.shape(numpy.fromfile(self.out / "image_demosaiced.img", "f4").astype(float), 3)
        header = (self.out / "image_demosaiced.img.hdr").read_text()
        self.assertIn("bilinear between the elements of a mosaic", header)
        for y in range(1, SIZE[1] - 1):
            for x in range(1, SIZE[0] - 1):
                for k in range(3):
                    if own[y, x] == k:
                        expected = raw[y, x]
                    else:
                        window = raw[y - 1:y + 2, x - 1:x + 2]
                        near = own[y - 1:y + 2, x - 1:x + 2] == k
                        cross = numpy.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]], bool)
                        expected = window[near & cross].mean() if (near & cross).any() else window[near].mean()
                    self.assertAlmostEqual(made[k, y, x], expected, delta=1e-6)
        self.assertTrue(numpy.isfinite(made).all())

    def test_counts_of_the_raw_mosaic(self):
        detector = {"pitch": "5 um", "quantum_efficiency": 0.5, "integration_time": "2 ms", "full_well": "20000 e-", "bits": 12, "read_noise": "3 e-"}
        described = document(SIZE, channels(), GROUND, half_plane(1.3), mosaic=BAYER, sampling=GRID, detector=detector,
                             optics={"f_number": 4, "focal_length": "20 mm"}, light={"sky": {"radiance": "100 W m-2 sr-1 um-1"}})
        self.render(described)
        done = self.run_program("detect", self.out, "--mosaic", "--quantity", "counts,radiance", "--seed", "5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.run_program("detect", self.out, "--quantity", "counts,radiance", "--seed", "5").returncode, 0)
        own = pattern_of(BAYER)
        for word, kind in (("counts", "u2"), ("noisy", "f4")):
            raw = numpy.fromfile(self.out / f"image_mosaic_{word}_5.img", kind).reshape(SIZE[1], SIZE[0])
            whole = self.shape(numpy.fromfile(self.out / f"image_{word}_5.img", kind), 3)
            self.assertTrue((raw == numpy.take_along_axis(whole, own[None], 0)[0]).all(), word)
            self.assertGreater(len(numpy.unique(raw)), 20)
            header = (self.out / f"image_mosaic_{word}_5.img.hdr").read_text()
            self.assertIn("bands = 1\n", header)
            self.assertIn("mosaic pattern = {(red, green), (green, blue)}", header)
        counts = (self.out / "image_mosaic_counts_5.img.hdr").read_text()
        self.assertEqual(len(counts.split("channel data gain values = {")[1].split("}")[0].split(",")), 3)
        plain = document(SIZE, channels(), GROUND, sampling=GRID, detector=detector, optics={"f_number": 4, "focal_length": "20 mm"})
        self.render(plain)
        refused = self.run_program("detect", self.out, "--mosaic")
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn('the run\'s sensor has no "mosaic": every element sees all channels', refused.stderr)

    def test_bad_input(self):
        wrong = self.refused(document(SIZE, channels(), GROUND, mosaic=[["red", "green"], ["green", "blu"]]))
        self.assertIn("there is no channel 'blu'; did you mean 'blue'? (declared: red, green and blue)", wrong.replace("'red', 'green' and 'blue'", "red, green and blue"))
        self.assertRegex(wrong, r"bad\.json:\d+:\d+")
        self.assertIn("row 2 of the mosaic has 1 channels; expected 2, as the first has",
                      self.refused(document(SIZE, channels(), GROUND, mosaic=[["red", "green"], ["blue"]])))
        scanner = document(SIZE, channels(), GROUND, mosaic=BAYER)
        scanner["platform"] = {"straight": {"frame": "scene", "position": ["0 m", "0 m", "500 m"], "velocity": ["0 m/s", "60 m/s", "0 m/s"]}}
        scanner["sensor"]["camera"] = {"pushbroom": {"pixels": SIZE, "focal_length": "20 mm", "pitch": "20 um", "line_period": "8 ms"}}
        self.assertIn("a mosaic is of the elements of a frame, and a pushbroom camera makes its image of lines", self.refused(scanner))
        for output, says in (({"products": ["radiance", "mosaic"]}, 'output.products has'), ({"formats": ["demosaiced"]}, "output.formats has 'demosaiced'")):
            self.assertRegex(self.refused(document(SIZE, channels(), GROUND, output=output)), says + '.*that takes a sensor with a "mosaic"')


if __name__ == "__main__":
    unittest.main()
