"""What pixels see, of cameras of every kind, as GDAL reads it: bands, names of classes, gaps, and values that fit together."""

import math
import os
import pathlib
import tempfile
import unittest

import scenes

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))

try:
    import numpy as np
    from osgeo import gdal

    gdal.UseExceptions()
except ImportError:
    gdal = None

BANDS = {"range": ["range"], "normal": ["east", "north", "up"], "slope": ["slope", "aspect"], "gsd": ["across", "along"], "time": ["time"],
         "sun_angles": ["sun zenith", "sun azimuth", "incidence"], "shadow": ["shadow"], "material_class": ["material class"],
         "dominant_material": ["dominant material"], "material_count": ["materials"], "object_class": ["object class"],
         "instance": ["instance"]}
CLASSES = {"material_class": ["nothing", "grass", "roof", "surroundings"], "dominant_material": ["nothing", "grass", "roof", "surroundings"],
           "object_class": ["nothing", "plane 0", "the dome; a (half) ball"]}
SUN = math.radians(65), math.radians(140)  # zenith, azimuth
BALL, RADIUS = (3.0, 2.0, 0.0), 2.0


def scene(camera, **more):
    made = scenes.document({"latitude": "49.4 deg", "longitude": "8.7 deg"}, camera, formats=["envi"], products=["location", *BANDS])
    made["scene"]["objects"][1]["name"] = "the dome, a {half} ball"
    made["light"]["sun"]["point"]["zenith"] = "65 deg"
    return {**made, **more}


CAMERAS = {
    "orthographic": scene({"orthographic": {"gsd": "0.5 m", "pixels": [24, 16]}}),
    "frame": scene({"frame": {"pixels": [24, 16], "focal_length": "50 mm", "pitch": "0.5 mm", "position": ["-9 m", "-12 m", "40 m"],
                              "look_at": ["0 m", "0 m", "0 m"]}}),
    "pushbroom": scene({"pushbroom": {"pixels": [24, 16], "focal_length": "1 m", "pitch": "1 mm", "line_period": "10 ms"}},
                       platform={"straight": {"frame": "scene", "position": ["0 m", "-4 m", "500 m"],
                                              "velocity": ["0 m/s", "50 m/s", "0 m/s"]}})}


@unittest.skipIf(gdal is None, "GDAL for Python not found")
class TruthProducts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        at = pathlib.Path(cls.scratch.name)
        cls.folders = {name: scenes.render(PROGRAM, document, at / name) for name, document in CAMERAS.items()}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def open(self, camera, name):
        return gdal.Open(str(self.folders[camera] / f"image_{name}.img"))

    def read(self, camera, name):
        return self.open(camera, name).ReadAsArray().astype(float)

    def test_bands_types_and_gaps(self):
        types = {"range": gdal.GDT_Float64, "time": gdal.GDT_Float64, "instance": gdal.GDT_UInt32, "material_count": gdal.GDT_UInt16,
                 **{name: gdal.GDT_UInt16 for name in CLASSES}}
        for camera in CAMERAS:
            for name, bands in BANDS.items():
                with self.subTest(camera=camera, product=name):
                    data = self.open(camera, name)
                    self.assertEqual([data.GetRasterBand(b + 1).GetDescription() for b in range(data.RasterCount)], bands)
                    band = data.GetRasterBand(1)
                    self.assertEqual(band.DataType, types.get(name, gdal.GDT_Float32))
                    real = band.DataType in (gdal.GDT_Float32, gdal.GDT_Float64)
                    self.assertEqual(band.GetNoDataValue() is not None and math.isnan(band.GetNoDataValue()), real)

    def test_classes_have_names_and_colours(self):
        for name, wanted in CLASSES.items():
            data = self.open("frame", name)
            band = data.GetRasterBand(1)
            self.assertEqual(band.GetCategoryNames(), wanted)
            colours = band.GetColorTable()
            self.assertEqual(colours.GetCount(), len(wanted))
            self.assertEqual(len({colours.GetColorEntry(k)[:3] for k in range(len(wanted))}), len(wanted))

    def test_range_and_place_and_ray_fit_together(self):
        self.assertTrue(np.isnan(self.read("orthographic", "range")).all())
        for camera, position in (("frame", lambda time: (-9.0, -12.0, 40.0)), ("pushbroom", lambda time: (0.0, -4.0 + 50.0 * time, 500.0))):
            place, time = self.read(camera, "location"), self.read(camera, "time")
            away = np.sqrt(sum((place[k] - position(time)[k]) ** 2 for k in range(3)))
            np.testing.assert_allclose(self.read(camera, "range"), away, rtol=1e-9)
        np.testing.assert_allclose(self.read("pushbroom", "time")[:, 5], (np.arange(16) + 0.5) * 0.01, atol=1e-12)
        self.assertEqual(np.abs(self.read("frame", "time")).max(), 0.0)

    def test_balls_normals_angles_and_shadows(self):
        towards = np.array([math.sin(SUN[0]) * math.sin(SUN[1]), math.sin(SUN[0]) * math.cos(SUN[1]), math.cos(SUN[0])])
        for camera in CAMERAS:
            with self.subTest(camera=camera):
                place = np.moveaxis(self.read(camera, "location"), 0, -1)
                from_ball = place - BALL
                on_ball = self.read(camera, "object_class") == 2
                self.assertGreater(on_ball.sum(), 10)
                np.testing.assert_array_equal(on_ball, place[..., 2] > 1e-9)
                np.testing.assert_array_equal(on_ball, self.read(camera, "material_class") == 2)
                np.testing.assert_array_equal(on_ball, self.read(camera, "instance") == 2)
                normal = np.where(on_ball[..., None], from_ball / RADIUS, [0.0, 0.0, 1.0])
                np.testing.assert_allclose(np.moveaxis(self.read(camera, "normal"), 0, -1), normal, atol=2e-6)
                np.testing.assert_allclose(self.read(camera, "slope")[0], np.degrees(np.arccos(normal[..., 2])), atol=1e-3)
                zenith, azimuth, incidence = self.read(camera, "sun_angles")
                np.testing.assert_allclose(zenith, 65.0, atol=1e-5)
                np.testing.assert_allclose(azimuth, 140.0, atol=1e-5)
                np.testing.assert_allclose(incidence, np.degrees(np.arccos(np.clip(normal @ towards, -1, 1))), atol=1e-3)
                passes = np.linalg.norm(np.cross(from_ball, towards), axis=-1)
                hidden = np.where(on_ball, normal @ towards < 0, (passes < RADIUS) & ((from_ball @ towards) < 0))
                np.testing.assert_array_equal(self.read(camera, "shadow"), hidden)
                self.assertGreater((hidden & ~on_ball).sum(), 3)

    def test_size_on_level_ground(self):
        ground = self.read("pushbroom", "object_class") == 1
        across, along = self.read("pushbroom", "gsd")
        np.testing.assert_allclose(across[ground], 0.5, atol=1e-5)
        np.testing.assert_allclose(along[ground], 0.5, atol=1e-5)
        ground = self.read("orthographic", "object_class") == 1
        np.testing.assert_allclose(self.read("orthographic", "gsd")[:, ground], 0.5, atol=1e-6)
        # Neighbours are as far apart as pixels are wide, where both are ground.
        place = self.read("frame", "location")
        steps = np.sqrt(((place[:, :, 2:] - place[:, :, :-2]) ** 2).sum(0)) / 2
        ground = self.read("frame", "object_class") == 1
        inner = ground[:, 2:] & ground[:, :-2] & ground[:, 1:-1]
        np.testing.assert_allclose(self.read("frame", "gsd")[0][:, 1:-1][inner], steps[inner], rtol=2e-4)

    def test_the_dominant_material_is_that_of_the_abundances(self):
        count = self.read("orthographic", "material_count")
        self.assertEqual(set(np.unique(count)), {1.0, 2.0})
        inside = count == 1
        np.testing.assert_array_equal(self.read("orthographic", "dominant_material")[inside],
                                      self.read("orthographic", "material_class")[inside])


if __name__ == "__main__":
    unittest.main()
