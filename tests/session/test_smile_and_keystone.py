"""Responses that differ from detector column to detector column (smile) and places that differ by channel (keystone), against closed
forms: spectra of which means over Gaussian responses are known, and the share of an element that an edge covers."""

import functools
import json
import math
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).parent))
from flat_scenes import Rendered, across, document, half_plane, table
from images import SCENES, image_of

FWHM_PER_SIGMA = 2.3548200450309493


class Smile(Rendered):
    WIDTH = 24

    def channels(self):
        return [{"name": f"c{k}", "gaussian": {"center": f"{500 + 10 * k} nm", "fwhm": "10 nm"}} for k in range(3)]

    def test_a_ramp_is_read_where_each_column_has_its_centre(self):
        nm = numpy.array([400.0, 700.0])
        smile = {"polynomial": {"center": ["0.5 nm", "1 nm", "-3 nm", "0.7 nm"], "fwhm": ["0 nm", "0 nm", "0.8 nm"]}}
        seen = self.render(document([self.WIDTH, 2], self.channels(), table(nm, (nm - 400) / 300), smile=smile))["radiance"]
        u = across(self.WIDTH)
        for k in range(3):
            expected = (500 + 10 * k + 0.5 + u - 3 * u**2 + 0.7 * u**3 - 400) / 300
            self.assertLess(abs(seen[k] / expected - 1).max(), 2e-5)

    def line(self, um, depth, sigma_nm, smile, **more):
        """An absorption line about 510 nm: what Gaussian responses make of it, and what was seen."""
        nm = numpy.linspace(400, 620, 8801)
        spectrum = 0.9 - depth * numpy.exp(-0.5 * ((nm - 510) / sigma_nm) ** 2)
        seen = self.render(document([self.WIDTH, 2], self.channels(), table(nm, spectrum), smile=smile, **more))
        found = []
        for centre, fwhm in um:
            both = numpy.hypot(fwhm / FWHM_PER_SIGMA, sigma_nm)
            found.append(0.9 - depth * sigma_nm / both * numpy.exp(-0.5 * ((centre - 510) / both) ** 2))
        return numpy.array(found), seen

    def test_a_line_within_the_response(self):
        u = across(self.WIDTH)
        shift, wider = 2.5 * u**2 - 1.5 * u, 10 + 1.5 * u
        smile = {"polynomial": {"center": ["0 nm", "-1.5 nm", "2.5 nm"], "fwhm": ["0 nm", "1.5 nm"]}}
        columns = [(500 + 10 * k + shift, wider) for k in range(3)]
        for sigma in (0.5, 4.0):
            expected, seen = self.line(columns, 0.7, sigma, smile)
            # Responses are cut at 4 standard deviations, 6e-5 of them.
            self.assertLess(abs(seen["radiance"][:, 0] - expected).max(), 2.5e-4, sigma)
        # The planted faults: the shift alone, and the other way round.
        for fault in ([(500 + 10 * k + shift, 10 + 0 * u) for k in range(3)], [(500 + 10 * k - shift, wider) for k in range(3)]):
            self.assertGreater(abs(seen["radiance"][:, 0] - self.line(fault, 0.7, 4.0, smile)[0]).max(), 3e-3)

    def test_tables_and_wavelengths_between(self):
        u = across(self.WIDTH)
        centres = [[500 + 10 * k + (k - 1) * (1 + u[i]) for k in range(3)] for i in range(self.WIDTH)]
        widths = [[10 + k * u[i] ** 2 for k in range(3)] for i in range(self.WIDTH)]
        for name, rows in (("centres", centres), ("widths", widths)):
            (self.path / f"{name}.csv").write_text("c0,c1,c2\n" + "".join(",".join(f"{v:.9f}" for v in row) + "\n" for row in rows))
        tables = {"table": {"centers": "centres.csv", "fwhm": "widths.csv", "wavelength_unit": "nm"}}
        columns = [(numpy.array(centres)[:, k], numpy.array(widths)[:, k]) for k in range(3)]
        expected, seen = self.line(columns, 0.7, 2.0, tables)
        self.assertLess(abs(seen["radiance"][:, 0] - expected).max(), 2.5e-4)
        between = {"between": {"shortest": {"center": ["-1 nm", "-1 nm"], "fwhm": ["0 nm"]},
                               "longest": {"center": ["1 nm", "1 nm"], "fwhm": ["0 nm", "0 nm", "2 nm"]}}}
        _, other = self.line(columns, 0.7, 2.0, between)
        self.assertLess(abs(seen["radiance"] - other["radiance"]).max(), 3e-5)  # by other sums of as few responses
        # One column's numbers are those of a document that has them for all.
        i = 5
        alone = [{"name": f"c{k}", "gaussian": {"center": f"{centres[i][k]} nm", "fwhm": f"{widths[i][k]} nm"}} for k in range(3)]
        nm = numpy.linspace(400, 620, 8801)
        single = self.render(document([self.WIDTH, 2], alone, table(nm, 0.9 - 0.7 * numpy.exp(-0.5 * ((nm - 510) / 2.0) ** 2))))
        self.assertLess(abs(single["radiance"][:, 0, i] / seen["radiance"][:, 0, i] - 1).max(), 2e-5)

    def test_a_channels_own_goes_before_the_sensors(self):
        channels = self.channels()
        channels[1]["smile"] = {"polynomial": {"center": ["2 nm"]}}
        nm = numpy.array([400.0, 700.0])
        seen = self.render(document([8, 1], channels, table(nm, (nm - 400) / 300), smile={"polynomial": {"center": ["-1 nm"]}}))["radiance"]
        for k, centre in enumerate((499, 512, 519)):
            self.assertLess(abs(seen[k] / ((centre - 400) / 300) - 1).max(), 2e-5)

    def test_rectangles_are_told_within_what_is_left_out(self):
        """The mean over a rectangle that moves is known; sums of a few rectangles leave out what half-widths hold."""
        nm = numpy.linspace(400, 620, 8801)
        spectrum = 0.5 + 0.4 * numpy.tanh((nm - 505) / 0.8)
        channels = [{"name": "c", "top_hat": {"from": "500 nm", "to": "510 nm"}}]
        asked = {"accuracy": {"error": "1 %"}}
        seen = self.render(document([64, 1], channels, table(nm, spectrum), smile={"polynomial": {"center": ["0 nm", "0.9 nm"]}}, sampling=asked))
        integral = numpy.concatenate([[0], numpy.cumsum(0.5 * (spectrum[1:] + spectrum[:-1]) * numpy.diff(nm))])
        shift = 0.9 * across(64)
        expected = (numpy.interp(510 + shift, nm, integral) - numpy.interp(500 + shift, nm, integral)) / 10
        off = abs(seen["radiance"][0, 0] - expected)
        self.assertTrue((off <= seen["half_width"][0, 0] + 1e-6).all(), (off.max(), seen["half_width"].min()))
        self.assertLess(off.max(), 1e-3)

    def test_what_is_made_of_radiance_goes_by_the_columns_response(self):
        """A blackbody has its own temperature, and a white surface its reflectance, whatever the response."""
        channels = [{"name": "warm", "gaussian": {"center": "10 um", "fwhm": "0.6 um"}, "noise_temperature": "0.001 K"}]
        described = document([16, 2], channels, 0, output={"formats": ["envi"], "products": ["radiance", "brightness_temperature"]},
                             light={"surroundings": {"reflectance": 0, "temperature": "1 K"}}, smile={"polynomial": {"center": ["0 um", "0.4 um", "0.2 um"]}})
        described["scene"]["materials"]["ground"] = {"reflectance": 0, "temperature": "310 K"}
        seen = self.render(described)
        self.assertGreater(numpy.ptp(seen["radiance"]), 0.1)
        self.assertLess(abs(seen["brightness_temperature"] - 310).max(), 2e-3)
        done = self.run_program("detect", self.out, "--quantity", "kelvins")
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = numpy.fromfile(self.out / "image_kelvins_1.img", "f4")
        self.assertLess(abs(drawn - 310).max(), 6e-3)
        nm = numpy.array([400.0, 700.0])
        visible = self.channels()
        visible[0]["noise"] = "1e-6 W m-2 sr-1 um-1"
        described = document([16, 2], visible, 1.0, output={"formats": ["envi"], "products": ["radiance", "toa_reflectance"]},
                             light={"sun": {"disc": {"zenith": "0 deg", "azimuth": "0 deg"}}}, smile={"polynomial": {"center": ["0 nm", "4 nm"]}})
        seen = self.render(described)
        self.assertGreater(numpy.ptp(seen["radiance"][0]), 0.5)
        self.assertLess(abs(seen["toa_reflectance"] - 1).max(), 2e-4)
        self.assertEqual(self.run_program("detect", self.out, "--quantity", "toa_reflectance").returncode, 0)
        drawn = numpy.fromfile(self.out / "image_toa_reflectance_1.img", "f4")
        self.assertLess(abs(drawn - 1).max(), 2e-4)

    def test_products_tell_the_wavelengths_of_columns(self):
        keystone = {"between": {"shortest": {"shift": ["0 px", "-0.2 px"]}, "longest": {"shift": ["0 px", "0.2 px"]}}}
        self.render(document([self.WIDTH, 2], self.channels(), 0.5, output={"formats": ["envi", "netcdf"]},
                             smile={"polynomial": {"center": ["0 nm", "1 nm"], "fwhm": ["0.5 nm"]}}, keystone=keystone))
        header = (self.out / "image_wavelengths.img.hdr").read_text()
        self.assertIn(f"samples = {self.WIDTH}\nlines = 3\nbands = 3\n", header)
        told = numpy.fromfile(self.out / "image_wavelengths.img", "f8").reshape(3, 3, self.WIDTH)
        u = across(self.WIDTH)
        for k in range(3):
            self.assertLess(abs(told[0, k] - (0.5 + 0.01 * k + 1e-3 * u)).max(), 1e-12)
            self.assertLess(abs(told[1, k] - 0.0105).max(), 1e-12)
            self.assertLess(abs(told[2, k] - 0.2 * (k - 1) * u).max(), 1e-12)
        from scipy.io import netcdf_file
        with netcdf_file(self.out / "image_radiance.nc", mmap=False) as file:
            for name, values in (("wavelength_by_column", told[0]), ("fwhm_by_column", told[1]), ("shift_by_column", told[2])):
                self.assertTrue((file.variables[name].data == values).all(), name)
        record = json.loads((self.out / "image_run.json").read_text())
        self.assertIn("image_wavelengths.img", [file["name"] for file in record["files"]])

    def test_threads_and_tiles_make_no_difference(self):
        nm = numpy.linspace(400, 620, 23)
        described = document([40, 6], self.channels(), table(nm, 0.5 + 0.3 * numpy.sin(nm / 9)), half_plane(12), smile={"polynomial": {"center": ["0 nm", "2 nm"]}},
                             keystone={"polynomial": {"shift": ["0 px", "0.7 px"]}}, sampling={"accuracy": {"error": "2 %"}, "tile": 16})
        first = self.render(described, "--threads", "1")
        again = self.render(described, "--threads", "2")
        for product in ("radiance", "half_width"):
            self.assertTrue((first[product] == again[product]).all())

    def test_bad_input(self):
        plain = document([8, 1], self.channels(), 0.5)

        def with_smile(smile, **more):
            return self.refused({**plain, "sensor": {**plain["sensor"], "smile": smile, **more}})
        self.assertIn("smile takes channel 'c0' of 0.5 um, 0.01 um wide, to 0.53 um in column 1; expected 0.48 to 0.52 um",
                      with_smile({"polynomial": {"center": ["30 nm"]}}))
        self.assertIn("wide in column 1; expected 0.0025 to 0.04 um", with_smile({"polynomial": {"fwhm": ["-8 nm"]}}))
        single = with_smile({"polynomial": {"center": ["1 nm"]}}, channels=[{"monochromatic": {"at": "500 nm"}}])
        self.assertIn("channel '500 nm' is a single wavelength, and smile is of responses", single)
        self.assertRegex(single, r"bad\.json:\d+:\d+")
        self.assertIn("needs 'center', 'fwhm' or both", with_smile({"polynomial": {}}))
        (self.path / "t.csv").write_text("\n".join(["500, 510, 520"] * 7) + "\n")
        of_table = {"table": {"centers": "t.csv", "wavelength_unit": "nm"}}
        self.assertIn("found 7 lines of numbers; expected 8, one for each column of the image", with_smile(of_table))
        (self.path / "t.csv").write_text("\n".join(["500, 510"] * 8) + "\n")
        self.assertIn("t.csv:1: found 2 numbers; expected 3, one for each channel", with_smile(of_table))
        (self.path / "t.csv").write_text("\n".join(["500, 510, 520"] * 7 + ["500, 510, 0.52"]) + "\n")
        self.assertIn("t.csv:8:11: found 0.52 as 'centre (nm) of channel 'c2''; expected 500 to 540", with_smile(of_table))
        (self.path / "t.csv").write_text("\n".join(["500, 510, 520"] * 9) + "\n")
        self.assertIn("found more lines than the image has columns; expected 8", with_smile(of_table))
        sweep = {"whiskbroom": {"pixels": [8, 1], "elements": 1, "focal_length": "20 mm", "pitch": "0.2 mm", "sweep_angle": "20 deg", "period": "0.1 s", "sweep_time": "8 ms"}}
        flying = {**plain, "platform": {"straight": {"frame": "scene", "position": ["0 m", "0 m", "500 m"], "velocity": ["0 m/s", "60 m/s", "0 m/s"]}}}
        flying["sensor"] = {**plain["sensor"], "camera": sweep, "smile": {"polynomial": {"center": ["1 nm"]}}}
        self.assertIn("smile is of detector columns across the track, and those of the image of a whiskbroom camera are samples of its sweep", self.refused(flying))
        flying["sensor"] = {**plain["sensor"], "camera": sweep, "keystone": {"polynomial": {"shift": ["1 px"]}}}
        self.assertIn("keystone is of detector columns", self.refused(flying))


class Keystone(Rendered):
    WIDTH, HEIGHT = 33, 4

    def seen(self, edge, sampling, keystone, channels=3, **sensor):
        """An edge at a place of the image; light left of it."""
        listed = [{"name": f"c{k}", "gaussian": {"center": f"{500 + 10 * k} nm", "fwhm": "10 nm"}} for k in range(channels)]
        described = document([self.WIDTH, self.HEIGHT], listed, 1.0, half_plane(edge - self.WIDTH / 2), sampling=sampling, keystone=keystone, **sensor)
        return self.render(described)

    def covered(self, edge, shift):
        """Of elements that look aside, the share left of the edge."""
        left = numpy.arange(self.WIDTH) + shift
        return numpy.clip(edge - left, 0, 1)

    @staticmethod
    def place(row):
        """Of an edge with light left of it."""
        return row.sum()

    def test_edges_lie_where_each_channels_elements_look(self):
        u = across(self.WIDTH)
        keystone = {"between": {"shortest": {"shift": ["0.3 px", "1.7 px", "-0.4 px"]}, "longest": {"shift": ["-0.5 px", "0.6 px"]}}}
        ends = (0.3 + 1.7 * u - 0.4 * u**2, -0.5 + 0.6 * u)
        for edge in (5.3, 16.5, 29.85):
            for sampling, allowed in (({"accuracy": {"error": "0.5 %"}, "tile": 16}, 0.003), ({"grid": {"elements": [64, 1]}}, 0.02), ({"adaptive": {"sub_elements": [4, 4], "allowed_difference": "5 %"}}, None)):
                seen = self.seen(edge, sampling, keystone)["radiance"]
                for k in range(3):
                    shift = ends[0] + 0.5 * k * (ends[1] - ends[0])
                    expected = self.covered(edge, shift)
                    if allowed is not None:
                        self.assertLess(abs(seen[k] - expected).max(), allowed, (edge, sampling, k))
                    self.assertLess(abs(self.place(seen[k, 1]) - self.place(expected)), 0.01 if allowed == 0.003 else 0.15)

    def test_a_channels_edge_moves_by_its_keystone(self):
        """k pixels of keystone move the edge by k: to 0.01 pixel."""
        found = []
        for k in (0, 0.1, 0.5, 2):
            seen = self.seen(15.2, {"accuracy": {"error": "0.5 %"}}, {"polynomial": {"shift": [f"{k} px"]}}, channels=1)["radiance"]
            found.append(self.place(seen[0, 1]))
        for k, place in zip((0, 0.1, 0.5, 2), found):
            self.assertAlmostEqual(found[0] - place, k, delta=0.01)

    def test_single_rays_go_where_elements_look(self):
        u = across(self.WIDTH)
        seen = self.seen(14.3, {"single": {}}, {"polynomial": {"shift": ["0 px", "1.5 px"]}})["radiance"]
        expected = numpy.arange(self.WIDTH) + 0.5 + 1.5 * u < 14.3
        self.assertTrue(((seen[0, 0] > 0.5) == expected).all())

    def test_blurred_edges_and_whole_images(self):
        """Under a Gaussian PSF an edge is an error function; an image as a whole is off by no more than it says."""
        u = across(self.WIDTH)
        keystone = {"between": {"shortest": {"shift": ["0 px", "-1.2 px"]}, "longest": {"shift": ["0.4 px", "1.2 px"]}}}
        sigma, edge = 0.6, 17.35
        erf = numpy.vectorize(math.erf)

        def share(d):  # of the light left of an edge d right of an element's middle
            def below(x):
                return x * 0.5 * (1 + erf(x / sigma / math.sqrt(2))) + sigma / math.sqrt(2 * math.pi) * numpy.exp(-0.5 * (x / sigma) ** 2)
            return below(d + 0.5) - below(d - 0.5)
        for sampling, allowed in (({"accuracy": {"error": "0.5 %"}}, 0.004), ({"accuracy": {"error": "1 %", "of": "image"}}, 0.12)):
            seen = self.seen(edge, sampling, keystone, psf={"gaussian": {"sigma": f"{sigma} px"}})["radiance"]
            off = []
            for k, shift in enumerate((-1.2 * u, 0.2 + 0 * u, 0.4 + 1.2 * u)):
                expected = share(edge - numpy.arange(self.WIDTH) - 0.5 - shift)
                self.assertLess(abs(seen[k, 1:3] - expected).max(), allowed, sampling)
                off.append(seen[k] - expected)
            self.assertLess(numpy.sqrt(numpy.mean(numpy.square(off))), 0.01)

    def test_intervals_hold_at_edges_and_lines_within_tiles(self):
        """What edges cover is known: intervals of 95 % hold it, and not what a keystone the other way (the planted fault) would have covered."""
        held, other = [], []
        for seed in range(6):
            keystone = {"between": {"shortest": {"shift": ["0 px", f"{0.3 + 0.2 * seed} px"]}, "longest": {"shift": ["0 px", f"{-0.2 * seed} px"]}}}
            edge = 9.137 + 2.713 * seed
            u = across(self.WIDTH)
            seen = self.seen(edge, {"accuracy": {"error": "2 %"}, "tile": 16}, keystone)
            for k in range(3):
                shift = ((0.3 + 0.2 * seed) + 0.5 * k * (-0.2 * seed - 0.3 - 0.2 * seed)) * u
                off = abs(seen["radiance"][k] - self.covered(edge, shift))
                held.append(off <= seen["half_width"][k] + 1e-6)
                away = abs(seen["radiance"][k] - self.covered(edge, -shift))
                other.append((away <= seen["half_width"][k] + 1e-6) | (away == off))
        self.assertGreaterEqual(numpy.mean(held), 0.95)
        self.assertLess(numpy.mean(other), numpy.mean(held) - 0.005)


def honest_scene(name):
    """A scene of benchmarks/honesty through a spectrometer."""
    scene = json.loads(re.sub(r"^\s*//.*$", "", (SCENES / f"{name}.json").read_text(), flags=re.MULTILINE))
    scene["sensor"]["channels"] = [{"name": f"c{nm}", "gaussian": {"center": f"{nm} nm", "fwhm": "30 nm"}} for nm in (500, 600, 700)]
    scene["sensor"]["smile"] = {"polynomial": {"center": ["0 nm", "2 nm", "-6 nm"], "fwhm": ["0 nm", "0 nm", "2 nm"]}}
    scene["sensor"]["keystone"] = {"between": {"shortest": {"shift": ["0.1 px", "-0.8 px"]}, "longest": {"shift": ["0 px", "0.6 px"]}}}
    return scene


class Coverage(unittest.TestCase):
    """Intervals of scenes whose truth grids of thousands of paths a pixel find."""

    @staticmethod
    @functools.cache
    def images(name, seeds, grids=(83, 97)):
        """The truth, and images with their half-widths."""
        with tempfile.TemporaryDirectory() as scratch:
            folder, scene = Path(scratch), honest_scene(name)
            truth = numpy.mean([image_of(scene, folder, {"grid": {"elements": [cells, cells]}}, 990 + cells) for cells in grids], axis=0)
            return truth, [image_of(scene, folder, {"accuracy": {"error": "2 %"}}, seed) for seed in range(1, seeds + 1)]

    def held(self, name, seeds, narrower=1.0):
        truth, images = self.images(name, seeds)
        inside = sum((numpy.abs(found - truth) <= narrower * half_width).sum() for found, half_width in images)
        return inside, seeds * truth.size

    def test_intervals_hold_what_they_say(self):
        shares = numpy.array([self.held(name, 2) for name in ("gable_roof", "wall_foot")]).sum(axis=0)
        self.assertGreater(shares[0] / shares[1], 0.93, shares)
        self.assertLess(shares[0] / shares[1], 0.9999, shares)

    def test_intervals_too_narrow_are_noticed(self):
        inside, count = self.held("gable_roof", 2, narrower=0.3)
        self.assertLess(inside / count, 0.93)


class Guide(Rendered):
    def test_examples_of_the_guide(self):
        guide = (Path(__file__).parents[2] / "docs" / "guide" / "spectrometers.md").read_text()
        spectrometer, keystone, mosaic = [json.loads("{" + text + "}") for text in re.findall(r"```json\n(.*?)```", guide, re.S)]
        base = document([8, 8], [], 0.5)
        platform = {"straight": {"frame": "scene", "position": ["0 m", "0 m", "300 m"], "velocity": ["0 m/s", "30 m/s", "0 m/s"]}}
        for described in ({**base, "platform": platform, "sensor": {**spectrometer["sensor"], **keystone}}, {**base, **mosaic}):
            source = self.path / "guide.json"
            source.write_text(json.dumps(described))
            done = self.run_program("check", source)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.said = done.stdout + done.stderr
            if "mosaic" not in described["sensor"]:
                self.assertRegex(self.said, r"smile: centres lie off by -1\.\d+ to 0\.\d+ nm and widths by 0 to 0\.\d+ nm from column to column; paths carry \d+ responses of 61 channels")
                self.assertRegex(self.said, r"keystone: elements look -0\.0995 to 0\.0995 px to the right of where they stand, and channels of a column up to 0\.199 px apart")

    def test_optics_without_a_detector_are_spoken_of(self):
        channels = [{"gaussian": {"center": "500 nm", "fwhm": "10 nm"}}]
        frame = {"frame": {"pixels": [8, 8], "focal_length": "100 mm", "pitch": "10 um", "position": ["0 m", "0 m", "1 km"], "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}}
        optics = {"aperture": "25 mm", "focal_length": "100 mm"}
        detector = {"pitch": "10 um", "quantum_efficiency": 0.5, "integration_time": "2 ms", "read_noise": "3 e-", "full_well": "30000 e-"}
        for more, says in (({}, "optics: nothing follows from them without a 'detector'"),
                           ({"psf": {"airy": {}}}, "optics: without a 'detector' they tell the 'psf' its aperture and focal ratio, and nothing else"),
                           ({"detector": detector}, None)):
            described = document([8, 8], channels, 0.5, optics=optics, **more)
            described["sensor"]["camera"] = frame
            source = self.path / "optics.json"
            source.write_text(json.dumps(described))
            done = self.run_program("check", source)
            self.assertEqual(done.returncode, 0, done.stderr)
            if says is None:
                self.assertNotIn("optics:", done.stdout)
            else:
                self.assertIn(says, done.stdout)


if __name__ == "__main__":
    unittest.main()
