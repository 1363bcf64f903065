"""Products as others read them: GDAL, rasterio, rioxarray, SPy and QGIS find values, wavelengths, units, places and colours.

GDAL and QGIS are Debian's. The others live in a virtual environment beside the build, made here where pip can."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import scenes

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))
BUILD = pathlib.Path(os.environ.get("IFOV_BUILD", ROOT / "build"))
SEE = pathlib.Path(__file__).with_name("see.py")
PACKAGES = ["rasterio==1.4.*", "rioxarray==0.19.*", "netCDF4==1.7.*", "spectral==0.25.*"]

try:
    from osgeo import gdal, osr

    gdal.UseExceptions()
except ImportError:
    gdal = None

MAP_ORIGIN = {"easting": "477000 m", "northing": "5474000 m", "crs": "EPSG:25832"}
PLACE = {"latitude": "49.4 deg", "longitude": "8.7 deg"}
NADIR = {"orthographic": {"gsd": "0.5 m", "pixels": [scenes.WIDTH, scenes.HEIGHT]}}
TURNED = {"orthographic": {"gsd": "0.5 m", "pixels": [scenes.WIDTH, scenes.HEIGHT], "rotation": "30 deg"}}
FRAME = {"frame": {"pixels": [scenes.WIDTH, scenes.HEIGHT], "focal_length": "50 mm", "pitch": "0.25 mm",
                   "position": ["476990 m", "5473980 m", "60 m"], "look_at": ["477000 m", "5474000 m", "0 m"]}}


class Venv:
    """Python with the readers that are not Debian's; `reason` says why there is none."""

    python, reason, asked = None, "", False

    @classmethod
    def find(cls):
        if cls.asked:
            return
        cls.asked = True
        folder = BUILD / "readers"
        python, done = folder / "bin" / "python", folder / "complete"
        if not done.exists():
            try:
                subprocess.run([sys.executable, "-m", "venv", folder], check=True, capture_output=True, timeout=60)
                subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *PACKAGES],
                               check=True, capture_output=True, timeout=200)
                done.touch()
            except (subprocess.SubprocessError, OSError) as error:
                words = (getattr(error, "stderr", b"") or b"").decode(errors="replace").strip().splitlines()
                cls.reason = f"the readers cannot be installed: {words[-1] if words else error}"
                return
        cls.python = python


def see(python, reader, *arguments):
    done = subprocess.run([python, SEE, reader, *map(str, arguments)], capture_output=True, text=True, timeout=100, check=False,
                          env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    if done.returncode == 77:
        raise unittest.SkipTest(done.stdout.strip())
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)
    return json.loads(done.stdout.splitlines()[-1])


class Products(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        at = pathlib.Path(cls.scratch.name)
        thermal = scenes.document({**PLACE, "height": "100 m"}, NADIR, scenes.THERMAL)
        cls.folders = {"map": scenes.render(PROGRAM, scenes.document(MAP_ORIGIN, NADIR), at / "map"),
                       "turned": scenes.render(PROGRAM, scenes.document(PLACE, TURNED), at / "turned"),
                       "frame": scenes.render(PROGRAM, scenes.document(MAP_ORIGIN, FRAME), at / "frame"),
                       "thermal": scenes.render(PROGRAM, thermal, at / "thermal")}
        cls.bands = {"map": 4, "turned": 4, "frame": 4, "thermal": 1}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def transform(self, run):
        if run == "map":
            return [476994.0, 0.5, 0.0, 5474004.0, 0.0, -0.5]
        c, s = 0.5 * math.cos(math.radians(30.0)), 0.5 * math.sin(math.radians(30.0))
        return [-12 * c + 8 * s, c, -s, 12 * s + 8 * c, -s, -c]

    def assert_numbers(self, found, wanted, tolerance=1e-6):
        self.assertEqual(len(found), len(wanted))
        for one, other in zip(found, wanted):
            self.assertAlmostEqual(float(one), float(other), delta=tolerance * max(1.0, abs(other)))

    def assert_values(self, found, run, name="radiance"):
        wanted = scenes.plane(self.folders[run] / f"image_{name}.img", self.bands[run])
        self.assertEqual(len(found), len(wanted))
        for band, other in zip(found, wanted):
            for line, right in zip(band, other):
                self.assert_numbers(line, right, 1e-6)

    def venv(self):
        Venv.find()
        if Venv.python is None:
            self.skipTest(Venv.reason)
        return Venv.python


@unittest.skipIf(gdal is None, "GDAL for Python not found")
class InGdal(Products):
    def test_places_and_systems(self):
        for run in ("map", "turned"):
            for ending in ("img", "tif", "nc"):
                with self.subTest(run=run, file=ending):
                    path = str(self.folders[run] / f"image_radiance.{ending}")
                    data = gdal.Open(f'NETCDF:"{path}":radiance' if ending == "nc" else path)
                    self.assert_numbers(data.GetGeoTransform(), self.transform(run))
                    system = data.GetSpatialRef()
                    if run == "map":
                        self.assertEqual(system.GetAuthorityCode(None), "25832")
                        continue
                    degrees = osr.SpatialReference()
                    degrees.ImportFromEPSG(4326)
                    degrees.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
                    system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
                    place = osr.CoordinateTransformation(system, degrees).TransformPoint(0.0, 0.0)
                    self.assert_numbers(place[:2], [8.7, 49.4], 1e-9)

    def test_a_frame_image_is_not_laid_on_the_map_as_if_it_were_flat(self):
        for ending in ("img", "tif"):
            data = gdal.Open(str(self.folders["frame"] / f"image_radiance.{ending}"))
            self.assertIsNone(data.GetGeoTransform(can_return_null=True))
        corners = gdal.Open(str(self.folders["frame"] / "image_radiance.img")).GetGCPs()
        taken = json.loads((self.folders["frame"] / "image_run.json").read_text())["acquisition"]["footprint"]
        self.assertEqual([(c.GCPPixel, c.GCPLine) for c in corners],
                         [(0, 0), (scenes.WIDTH, 0), (scenes.WIDTH, scenes.HEIGHT), (0, scenes.HEIGHT)])
        for corner, place in zip(corners, taken):
            self.assert_numbers([corner.GCPX, corner.GCPY], [place["longitude_deg"], place["latitude_deg"]], 1e-8)
        places = gdal.Open(str(self.folders["frame"] / "image_location.img"))
        self.assertEqual([places.GetRasterBand(b).GetDescription() for b in (1, 2, 3)], ["easting", "northing", "height"])
        self.assertEqual(places.GetRasterBand(1).DataType, gdal.GDT_Float64)
        east, north, height = places.ReadAsArray()
        zenith, azimuth = gdal.Open(str(self.folders["frame"] / "image_view_angles.img")).ReadAsArray()
        for y in range(scenes.HEIGHT):
            for x in range(scenes.WIDTH):
                self.assertGreaterEqual(height[y][x], -1e-6)
                away = (476990.0 - east[y][x], 5473980.0 - north[y][x])
                self.assertAlmostEqual(math.radians(zenith[y][x]), math.atan2(math.hypot(*away), 60.0 - height[y][x]), places=5)
                self.assertAlmostEqual(math.radians(azimuth[y][x]), math.atan2(*away) % (2 * math.pi), places=5)
        middle = [float(v[scenes.HEIGHT // 2 - 1:scenes.HEIGHT // 2 + 1, scenes.WIDTH // 2 - 1:scenes.WIDTH // 2 + 1].mean())
                  for v in (east, north)]
        self.assertLess(math.hypot(middle[0] - 477000.0, middle[1] - 5474000.0), 0.2)

    def test_wavelengths_colours_units_and_gaps(self):
        for ending in ("img", "tif"):
            data = gdal.Open(str(self.folders["map"] / f"image_radiance.{ending}"))
            for b, (name, um, _) in enumerate(scenes.CHANNELS):
                band = data.GetRasterBand(b + 1)
                self.assertAlmostEqual(float(band.GetMetadataItem("wavelength")), um, places=9)
                self.assertEqual(band.GetMetadataItem("wavelength_units"), "Micrometers")
                self.assertTrue(band.GetDescription().startswith(name))
                self.assertTrue(math.isnan(band.GetNoDataValue()))
            colours = [gdal.GetColorInterpretationName(data.GetRasterBand(b + 1).GetColorInterpretation()) for b in range(3)]
            self.assertEqual(colours, ["Blue", "Green", "Red"], ending)
        self.assertEqual(data.GetRasterBand(1).GetUnitType(), "W m-2 sr-1 um-1")
        self.assertEqual(data.GetMetadataItem("acquisition_time"), "2024-06-21T10:30:00.000Z")
        header = gdal.Open(str(self.folders["map"] / "image_radiance.img")).GetMetadata("ENVI")
        self.assertEqual(header["acquisition_time"], "2024-06-21T10:30:00.000Z")
        self.assertAlmostEqual(float(header["sun_elevation"]), 55.0, places=4)
        self.assertAlmostEqual(float(header["sun_azimuth"]), 140.0, places=4)

    def test_the_geotiff_is_cloud_optimized(self):
        try:
            from osgeo_utils.samples import validate_cloud_optimized_geotiff as check
        except ImportError as error:
            self.skipTest(str(error))
        large = {"orthographic": {"gsd": "0.05 m", "pixels": [700, 600]}}
        scene = scenes.document(MAP_ORIGIN, large, formats=["envi", "geotiff"], products=["radiance"])
        scene["sampling"] = {"single": {}, "max_depth": 1}
        with tempfile.TemporaryDirectory() as folder:
            out = scenes.render(PROGRAM, scene, folder)
            for path in (out / "image_radiance.tif", self.folders["thermal"] / "image_radiance.tif"):
                warnings, errors, _ = check.validate(str(path), full_check=True)
                self.assertEqual((warnings, errors), ([], []))
            data = gdal.Open(str(out / "image_radiance.tif"))
            self.assertGreater(data.GetRasterBand(1).GetOverviewCount(), 0)
            self.assertEqual(sorted(p.name for p in out.iterdir() if "tif" in p.name), ["image_radiance.tif"])


class InOthers(Products):
    def test_rasterio(self):
        for run in ("map", "thermal"):
            for ending in ("img", "tif"):
                seen = see(self.venv(), "rasterio", self.folders[run] / f"image_radiance.{ending}")
                self.assert_values(seen["values"], run)
                self.assertEqual(seen["nodata"], "nan")
                if run == "map":
                    self.assertEqual(seen["epsg"], 25832)
                    self.assert_numbers(seen["transform"], self.transform(run))
                    self.assertEqual(seen["colours"][:3], ["blue", "green", "red"])
                    self.assert_numbers(seen["wavelengths"], [um for _, um, _ in scenes.CHANNELS])
                else:
                    self.assertIn("Transverse_Mercator", seen["wkt"].replace(" ", "_"))

    def test_rioxarray(self):
        for variable in ("radiance", "half_width"):
            seen = see(self.venv(), "rioxarray", self.folders["map"] / "image_radiance.nc", variable)
            self.assert_values(seen["values"], "map", variable)
        self.assertEqual((seen["dims"], seen["epsg"]), (["wavelength", "y", "x"], 25832))
        self.assert_numbers(seen["transform"], self.transform("map"))
        self.assert_numbers(seen["wavelengths"], [um for _, um, _ in scenes.CHANNELS])
        self.assertEqual((seen["wavelength_units"], seen["units"], seen["nodata"]), ("um", "W m-2 sr-1 um-1", "nan"))
        self.assertEqual(seen["names"], [name for name, _, _ in scenes.CHANNELS])
        self.assertEqual(seen["conventions"], "CF-1.8")
        self.assertEqual(see(self.venv(), "rioxarray", self.folders["map"] / "image_radiance.nc", "radiance")["ancillary"], "half_width")

    def test_spy(self):
        for run, channels in (("map", scenes.CHANNELS), ("frame", scenes.CHANNELS), ("thermal", scenes.THERMAL)):
            seen = see(self.venv(), "spy", self.folders[run] / "image_radiance.img")
            self.assert_values(seen["values"], run)
            self.assert_numbers(seen["wavelengths"], [um for _, um, _ in channels])
            self.assert_numbers(seen["fwhm"], [fwhm for _, _, fwhm in channels])
            self.assertEqual(seen["units"], "Micrometers")
        self.assertEqual(seen["header"]["data ignore value"], "nan")
        self.assertIn("Wavelength", seen["header"]["z plot titles"][0])

    def test_qgis(self):
        for ending in ("img", "tif"):
            seen = see("/usr/bin/python3", "qgis", self.folders["map"] / f"image_radiance.{ending}")
            self.assertTrue(seen["valid"])
            self.assertEqual((seen["crs"], seen["shape"]), ("EPSG:25832", [4, scenes.HEIGHT, scenes.WIDTH]))
            self.assert_numbers(seen["extent"], [476994.0, 5473996.0, 477006.0, 5474004.0])
            self.assertEqual((seen["renderer"], seen["colours"], seen["nodata"]), ("multibandcolor", [3, 2, 1], "nan"))
            values = scenes.plane(self.folders["map"] / "image_radiance.img", 4)
            for (low, high), band in zip(seen["stretch"], (2, 1, 0)):
                brightest = max(max(line) for line in values[band])
                self.assertTrue(0.0 <= low < high <= 1.5 * brightest and high > 0.2 * brightest, (seen["stretch"], brightest))
        seen = see("/usr/bin/python3", "qgis", self.folders["thermal"] / "image_radiance.img")
        self.assertEqual((seen["renderer"], len(seen["stretch"])), ("singlebandgray", 1))


class Records(Products):
    def test_the_run_record_says_when_where_and_in_which_light(self):
        record = json.loads((self.folders["frame"] / "image_run.json").read_text())
        self.assertRegex(record["date"], r"^20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        taken = record["acquisition"]
        self.assertEqual(taken["time"], "2024-06-21T10:30:00.000Z")
        self.assert_numbers([taken["sun"]["zenith_deg"], taken["sun"]["azimuth_deg"]], [35.0, 140.0])
        self.assert_numbers(taken["camera"]["position_m"], [476990.0, 5473980.0, 60.0])
        forward = [10.0, 20.0, -60.0]
        self.assert_numbers(taken["camera"]["forward"], [v / math.hypot(*forward) for v in forward])
        self.assertEqual(len(taken["footprint"]), 4)
        for corner in taken["footprint"]:
            self.assertAlmostEqual(corner["latitude_deg"], 49.42, delta=0.01)
        record = json.loads((self.folders["map"] / "image_run.json").read_text())
        self.assertEqual(record["image"]["map"]["system"]["epsg"], 25832)
        corners = [corner["map_m"] for corner in record["acquisition"]["footprint"]]
        self.assert_numbers(corners[0][:2], [476994.0, 5474004.0])
        self.assert_numbers(corners[2][:2], [477006.0, 5473996.0])


if __name__ == "__main__":
    unittest.main()
