"""Georeferences as GDAL has them: class maps and terrain whose pixels are areas, and the same as points."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

try:
    import numpy as np
    from osgeo import gdal, osr

    gdal.UseExceptions()
except ImportError:
    gdal = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))
WEST_M, NORTH_M, CELL_M = 477000.0, 5474000.0, 10.0


@unittest.skipIf(gdal is None, "GDAL for Python not found")
class Georeference(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def write(self, name, values, point):
        rows, columns = values.shape
        raster = gdal.GetDriverByName("GTiff").Create(str(self.folder / name), columns, rows, 1, gdal.GDT_Float32)
        if point:
            raster.SetMetadataItem("AREA_OR_POINT", "Point")
        raster.SetGeoTransform([WEST_M, CELL_M, 0.0, NORTH_M, 0.0, -CELL_M])
        reference = osr.SpatialReference()
        reference.ImportFromEPSG(25832)
        raster.SetProjection(reference.ExportToWkt())
        raster.GetRasterBand(1).WriteArray(values)
        raster = None
        return gdal.Open(str(self.folder / name)).GetGeoTransform()

    def abundance(self, material, terrain=None, center=(WEST_M + 20, NORTH_M - 10)):
        scene = {"ifov": 1,
                 "scene": {"origin": {"easting": f"{WEST_M} m", "northing": f"{NORTH_M} m", "crs": "EPSG:25832"},
                           "materials": {"one": {"reflectance": 0.2}, "two": {"reflectance": 0.5}},
                           "objects": [{**(terrain or {"plane": {}}), "material": material}]},
                 "light": {"sky": {"radiance": "50 W m-2 sr-1 um-1"}},
                 "sensor": {"camera": {"orthographic": {"gsd": "5 m", "pixels": [8, 4]}},
                            "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
                 "sampling": {"grid": {"elements": [2, 2]}, "max_depth": 1}}
        if center:
            scene["sensor"]["camera"]["orthographic"]["center"] = [f"{metres} m" for metres in center]
        (self.folder / "scene.json").write_text(json.dumps(scene))
        result = subprocess.run([PROGRAM, "render", "scene.json", "--output", "out"], cwd=self.folder, text=True,
                                capture_output=True, timeout=200, check=False)
        self.assertIn(result.returncode, (0, 6), result.stdout + result.stderr)
        return gdal.Open(str(self.folder / "out" / "image_abundance.img")).ReadAsArray()

    def test_cells_lie_where_gdal_says(self):
        classes = np.array([[1, 2, 2, 1], [2, 1, 1, 2]], dtype=np.float32)
        for point in (False, True):
            with self.subTest(point=point):
                self.assertEqual(self.write("classes.tif", classes, point)[:2], (WEST_M, CELL_M))
                found = self.abundance({"map": {"file": "classes.tif", "classes": {"1": "one", "2": "two"}}})
                expected = np.kron(classes == 2, np.ones((2, 2)))
                np.testing.assert_array_equal(found[1], expected)
                np.testing.assert_array_equal(found[0], 1.0 - expected)

    def test_an_image_without_a_centre_lies_about_the_origin(self):
        classes = np.array([[1, 2, 2, 1], [2, 1, 1, 2]], dtype=np.float32)
        self.write("classes.tif", classes, False)
        found = self.abundance({"map": {"file": "classes.tif", "classes": {"1": "one", "2": "two"}}},
                               center=None)
        image = gdal.Open(str(self.folder / "out" / "image_abundance.img"))
        self.assertEqual(image.GetGeoTransform(), (WEST_M - 20, 5.0, 0.0, NORTH_M + 10, 0.0, -5.0))
        np.testing.assert_array_equal(found[1, 2:, 4:], np.kron(classes == 2, np.ones((2, 2)))[:2, :4])

    def test_a_terrain_ends_at_the_middles_of_its_outermost_cells(self):
        for point in (False, True):
            with self.subTest(point=point):
                self.write("dem.tif", np.full((2, 4), 7.0, dtype=np.float32), point)
                covered = self.abundance("one", {"terrain": {"file": "dem.tif"}})[0]
                expected = np.zeros((4, 8))
                expected[1:3, 1:7] = 1.0
                np.testing.assert_array_equal(covered, expected)


if __name__ == "__main__":
    unittest.main()
