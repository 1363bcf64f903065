"""Geolocation grids of images that no map information fits, as others read them: ENVI's lookup tables (GLT) and places of pixels (IGM)
against a search over all pixels, and GDAL's virtual raster, warped by GDAL, against the same scene seen straight from above."""

import json
import pathlib
import re
import tempfile
import unittest

from images import np, run

try:
    from osgeo import gdal, osr
    from scipy.spatial import cKDTree
except ImportError:
    gdal = None

WIDTH, LINES = 60, 70


def document(**more):
    """Level ground with a square roof mark on it, from an aircraft that rolls by degrees, somewhere in Delft."""
    scene = {"origin": {"latitude": "51.99 deg", "longitude": "4.37 deg"},
             "materials": {"ground": {"reflectance": 0.1}, "mark": {"reflectance": 0.6}},
             "objects": [{"plane": {}, "material": "ground"},
                         {"box": {"low": ["-9 m", "-6 m", "0 m"], "high": ["5 m", "7 m", "0.01 m"]}, "material": "mark"}]}
    described = {"ifov": 1, "scene": scene,
                 "light": {"sun": {"point": {"zenith": "20 deg", "azimuth": "180 deg"}}},
                 "platform": {"straight": {"frame": "scene", "position": ["-4 m", "-17 m", "100 m"], "velocity": ["9 m/s", "39 m/s", "0 m/s"]},
                              "jitter": {"falling": {"roll": "2 deg", "corner": "0.4 Hz", "slope": 6, "up_to": "6 Hz"}}},
                 "sensor": {"camera": {"pushbroom": {"pixels": [WIDTH, LINES], "focal_length": "20 mm", "pitch": "0.1 mm", "line_period": "12.5 ms"}},
                            "channels": [{"name": "red & <wide>", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}}]},
                 "sampling": {"grid": {"elements": [3, 3]}}, "output": {"formats": ["envi", "glt", "vrt"], "products": ["samples"]}}
    described.update(more)
    return described


@unittest.skipIf(np is None or gdal is None, "numpy, scipy or GDAL is missing")
class GeolocationGrids(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        gdal.UseExceptions()
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        done = run(document(), cls.folder)
        if done.returncode not in (0, 6):
            raise RuntimeError(done.stderr)
        cls.out = cls.folder / "out"
        cls.location = gdal.Open(str(cls.out / "image_location.img")).ReadAsArray()
        cls.table = gdal.Open(str(cls.out / "image_glt.img"))

    @classmethod
    def tearDownClass(cls):
        cls.table = None
        cls.scratch.cleanup()

    def cells(self):
        """Middles of the table's cells on the map, as GDAL says."""
        g = self.table.GetGeoTransform()
        self.assertEqual((g[2], g[4], g[1]), (0.0, 0.0, -g[5]))
        y, x = np.mgrid[: self.table.RasterYSize, : self.table.RasterXSize] + 0.5
        return g[0] + x * g[1], g[3] + y * g[5], g[1]

    def test_places_name_their_system(self):
        header = (self.out / "image_location.img.hdr").read_text()
        system, table = osr.SpatialReference(), osr.SpatialReference(self.table.GetProjection())
        system.ImportFromESRI([re.search(r"coordinate system string = \{(.*)\}", header).group(1)])
        for of in (system, table):
            self.assertTrue(of.IsProjected())
            self.assertAlmostEqual(of.GetProjParm("central_meridian"), 4.37, places=9)
            self.assertAlmostEqual(of.GetProjParm("latitude_of_origin"), 51.99, places=9)
        self.assertEqual(self.location.shape, (3, LINES, WIDTH))

    def test_cells_have_the_pixels_that_lie_in_them(self):
        x, y, cell = self.cells()
        sample, line = self.table.ReadAsArray()
        own = sample > 0
        self.assertTrue(((line > 0) == own).all() and ((line < 0) == (sample < 0)).all())
        self.assertGreater(own.sum(), 0.5 * own.size * (WIDTH * LINES / own.size))
        at_x, at_y = self.location[0][line[own] - 1, sample[own] - 1], self.location[1][line[own] - 1, sample[own] - 1]
        self.assertLessEqual(np.abs(at_x - x[own]).max(), 0.5 * cell + 1e-6)
        self.assertLessEqual(np.abs(at_y - y[own]).max(), 0.5 * cell + 1e-6)
        # Every pixel's middle lies in a cell that has one, and of several the nearest to the cell's middle.
        g = self.table.GetGeoTransform()
        column = np.floor((self.location[0] - g[0]) / cell).astype(int)
        row = np.floor((g[3] - self.location[1]) / cell).astype(int)
        self.assertTrue(own[row, column].all())
        off = np.hypot(self.location[0] - x[row, column], self.location[1] - y[row, column])
        chosen = np.hypot(at_x - x[own], at_y - y[own])
        best = np.full(own.shape, np.inf)
        np.minimum.at(best, (row, column), off)
        np.testing.assert_allclose(chosen, best[own], atol=1e-9)

    def test_gaps_have_the_nearest_pixel(self):
        x, y, cell = self.cells()
        sample, line = self.table.ReadAsArray()
        filled = sample < 0
        self.assertGreater(filled.sum(), 50)
        tree = cKDTree(np.stack([self.location[0].ravel(), self.location[1].ravel()], 1))
        nearest, index = tree.query(np.stack([x[filled], y[filled]], 1))
        found = (-line[filled] - 1) * WIDTH - sample[filled] - 1
        self.assertGreater((index == found).mean(), 0.98)
        distance = np.hypot(self.location[0].ravel()[found] - x[filled], self.location[1].ravel()[found] - y[filled])
        self.assertLess((distance - nearest).max(), 0.25 * cell)
        # Nothing is left out within the swath, and nothing is added beyond it.
        nearest, _ = tree.query(np.stack([x.ravel(), y.ravel()], 1))
        empty = (sample == 0).ravel()
        self.assertGreater(nearest[empty].min(), 0.3 * cell)
        self.assertGreater(empty.sum(), 100)

    def test_both_ways_show_the_scene_where_it_lies(self):
        """The mark's edges on the map, by the lookup table and by GDAL's warp, against where the document has them."""
        radiance = gdal.Open(str(self.out / "image_radiance.img")).ReadAsArray()
        x, y, cell = self.cells()
        sample, line = np.abs(self.table.ReadAsArray())
        orthorectified = np.where(sample > 0, radiance[line - 1, sample - 1], np.nan)
        warped = gdal.Warp("", str(self.out / "image_radiance.vrt"), format="MEM", geoloc=True, xRes=cell, yRes=cell,
                           outputBounds=(x.min() - cell / 2, y.min() - cell / 2, x.max() + cell / 2, y.max() + cell / 2), dstNodata=float("nan"))
        self.assertEqual(warped.RasterXSize, x.shape[1])
        self.assertTrue(osr.SpatialReference(warped.GetProjection()).IsProjected())
        middle = 0.5 * (np.nanmin(radiance) + np.nanmax(radiance))
        for image in (orthorectified, warped.ReadAsArray()):
            seen = np.isfinite(image)
            self.assertGreater(seen.sum(), 0.6 * image.size)
            inside = (np.abs(x + 2.0) < 7.0 - cell) & (np.abs(y - 0.5) < 6.5 - cell)
            outside = (np.abs(x + 2.0) > 7.0 + cell) | (np.abs(y - 0.5) > 6.5 + cell)
            self.assertGreater((image[inside] > middle).mean(), 0.995)
            self.assertGreater((image[outside & seen] < middle).mean(), 0.995)
            self.assertAlmostEqual((image > middle).sum() * cell * cell / (14.0 * 13.0), 1.0, delta=0.06)
        # The image itself, put onto the map as if the aircraft had flown level, does not.
        g = np.linspace(-15.0, 15.0, WIDTH)
        self.assertGreater(np.abs(self.location[0] - self.location[0].mean(axis=1, keepdims=True) - g).max(), 0.0)
        self.assertGreater(np.ptp(self.location[0].mean(axis=1) - np.linspace(*self.location[0].mean(axis=1)[[0, -1]], LINES)), 2.0 * cell)

    def test_the_virtual_raster_names_channels(self):
        image = gdal.Open(str(self.out / "image_radiance.vrt"))
        self.assertEqual(image.GetRasterBand(1).GetDescription(), "red & <wide>")
        self.assertEqual(image.GetMetadata("GEOLOCATION")["GEOREFERENCING_CONVENTION"], "PIXEL_CENTER")
        np.testing.assert_array_equal(image.ReadAsArray(), gdal.Open(str(self.out / "image_radiance.img")).ReadAsArray())

    def test_the_record_and_the_next_run(self):
        files = {file["name"] for file in json.loads((self.out / "image_run.json").read_text())["files"]}
        self.assertLessEqual({"image_glt.img", "image_radiance.vrt", "image_location.img"}, files)
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            self.assertIn(run(document(), folder).returncode, (0, 6))
            self.assertTrue((folder / "out/image_glt.img.hdr").exists())
            self.assertIn(run(document(output={"formats": ["envi"], "products": ["samples"]}), folder).returncode, (0, 6))
            left = {path.name for path in (folder / "out").iterdir()}
            self.assertFalse(left & {"image_glt.img", "image_glt.img.hdr", "image_radiance.vrt", "image_location.img"}, left)


if __name__ == "__main__":
    unittest.main()
