"""ds.ifov: pictures, spectra, temperatures, and files of other programs' formats."""

import json
import unittest
import warnings

import numpy as np
import scenes
import xarray

import ifov
from ifov import _ifov


class Values(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.image = ifov.render(scenes.small(), progress=False)

    def test_planck_is_the_librarys(self):
        um = np.array([0.3, 0.65, 4.0, 10.5, 50.0])[:, None]
        kelvin = np.array([-1.0, 0.0, 3.0, 250.0, 300.0, 6000.0])
        ours = ifov.radiometry.planck(um, kelvin)
        theirs = np.array([[_ifov.planck_radiance(float(w), float(t)) for t in kelvin] for w in um[:, 0]])
        np.testing.assert_allclose(ours, theirs, rtol=1e-13)
        np.testing.assert_allclose(
            ifov.radiometry.brightness_temperature(um, ours)[:, 3:], np.broadcast_to(kelvin[3:], (5, 3)), rtol=1e-12
        )
        self.assertAlmostEqual(ifov.radiometry.planck(10.0, 300.0), 9.924, 3)
        self.assertEqual(ifov.radiometry.brightness_temperature(10.0, 0.0), 0.0)
        self.assertTrue(np.isnan(ifov.radiometry.planck(10.0, np.nan)))

    def test_brightness_temperature(self):
        kelvin = self.image.ifov.brightness_temperature()
        self.assertEqual(kelvin.dims, ("wavelength", "y", "x"))
        self.assertEqual(kelvin.attrs["units"], "K")
        np.testing.assert_allclose(
            ifov.radiometry.planck(self.image["wavelength"].values[:, None, None], kelvin), self.image["radiance"], rtol=1e-6
        )
        # Ground of 20 degC that reflects 0.3 of a black sky, of the ball and of the Sun, within the accuracy of 4 %.
        pure = self.image["abundance"].sel(material="ground") == 1
        wanted = ifov.radiometry.brightness_temperature(10.5, 0.7 * ifov.radiometry.planck(10.5, 293.15))
        self.assertAlmostEqual(float(kelvin[1].where(pure).median()), float(wanted), delta=2.5)

    def test_half_width_of_a_temperature(self):
        """Where radiance is a half-width higher or lower, the temperature is by the half-width in kelvin, to the curvature of Planck's law."""
        thermal = self.image.ifov.channel("T")
        kelvin, half = thermal.ifov.brightness_temperature(), thermal.ifov.brightness_temperature_half_width()
        self.assertEqual((half.dims, half.attrs["units"]), (("y", "x"), "K"))
        for sign in (-1, 1):
            moved = thermal.assign(radiance=thermal["radiance"] + sign * thermal["half_width"]).ifov.brightness_temperature()
            np.testing.assert_allclose(moved - kelvin, sign * half, rtol=0.05, atol=1e-4)
        np.testing.assert_allclose(
            ifov.radiometry.planck_slope(10.5, 290.0),
            (ifov.radiometry.planck(10.5, 290.01) - ifov.radiometry.planck(10.5, 289.99)) / 0.02,
            rtol=1e-7,
        )
        np.testing.assert_array_equal(ifov.radiometry.planck_slope(0.4, [-1.0, 0.0, 1.0, np.nan]), [0, 0, 0, np.nan])

    def test_one_channel(self):
        red = self.image.ifov.channel("red")
        np.testing.assert_array_equal(red["radiance"], self.image["radiance"][0])
        self.assertEqual(float(red["wavelength"]), float(self.image["wavelength"][0]))
        with self.assertRaisesRegex(KeyError, "found 'rde'; expected one of 'red', 'T'"):
            self.image.ifov.channel("rde")
        with self.assertRaisesRegex(ValueError, "of one channel alone"):
            red.ifov.rgb()

    def test_relative_error(self):
        error = self.image.ifov.relative_error()
        self.assertLessEqual(float(error.sel(wavelength=10.5, method="nearest").max()), 0.041)
        with self.assertRaises(KeyError):
            self.image.drop_vars("half_width").ifov.relative_error()

    def test_a_picture(self):
        picture = self.image.ifov.rgb()
        self.assertEqual(picture.dims, ("y", "x", "rgb"))
        self.assertEqual((float(picture.min()), float(picture.max())), (0.0, 1.0))
        self.assertIn("red, red, red", picture.attrs["long_name"])

    def test_a_spectrum(self):
        one = self.image.ifov.spectrum(-2.0, 1.0)
        self.assertEqual(one["radiance"].dims, ("wavelength",))
        self.assertLess(abs(float(one["x"]) + 2.0), 0.16)
        self.assertLess(abs(float(one["y"]) - 1.0), 0.16)
        self.assertEqual(float(one["abundance"].sel(material="ball")), 1.0)
        with self.assertRaises(IndexError):
            self.image.ifov.spectrum(4.0, 0.0)
        bare = self.image.drop_vars(["x", "y"]).ifov.spectrum(3, 2)
        np.testing.assert_array_equal(bare["radiance"], self.image["radiance"][:, 2, 3])

    def test_units_are_read_by_pint(self):
        try:
            import pint
        except ImportError:
            self.skipTest("pint is not installed")
        # As the registries for CF conventions do it: "m-2" is a power.
        import re

        units = pint.UnitRegistry(preprocessors=[lambda text: re.sub(r"(?<=[A-Za-z])(-?\d+)(?![A-Za-z])", r"**\1", text)])
        for variable in self.image.variables.values():
            if "units" in variable.attrs and variable.attrs["units"] != "1":
                units.Unit(variable.attrs["units"])
        self.assertTrue(units.Unit(self.image["radiance"].attrs["units"]).is_compatible_with("W / m**3 / sr"))

    def test_units_are_read_by_the_registry_of_cf_xarray(self):
        try:
            from cf_xarray.units import units
        except ImportError:
            self.skipTest("cf_xarray is not installed")
        image = ifov.render(scenes.small(), quantities=["all"], progress=False)
        air = ifov.atmosphere(scenes.small(atmosphere={"profile": "mid-latitude summer"}))
        for variable in [*image.variables.values(), *air.variables.values()]:
            if "units" in variable.attrs:
                units.parse_units(variable.attrs["units"])
        self.assertEqual(units.parse_units(image["radiance"].attrs["units"]), units.watt / units.meter**2 / units.steradian / units.micrometer)
        self.assertEqual(units.parse_units(image["view_zenith"].attrs["units"]), units.degree)


class Files(scenes.InFolder):
    def image(self, **origin):
        document = scenes.small(time="2026-06-21T10:00:00Z")
        if origin:
            document["scene"]["origin"] = origin
        return ifov.render(document, quantities=["all"], progress=False)

    def test_netcdf(self):
        image = self.image()
        try:
            image.ifov.to_netcdf("image.nc")
        except ValueError as error:
            self.skipTest(str(error))
        back = xarray.open_dataset("image.nc", decode_coords="all")
        for name in image.data_vars:
            np.testing.assert_array_equal(back[name].values, image[name].values, name)
        self.assertEqual(back.attrs["seed"], 5)
        self.assertEqual(back["radiance"].encoding["grid_mapping"], "spatial_ref")

    def test_zarr(self):
        try:
            import zarr  # noqa: F401
        except ImportError:
            self.skipTest("zarr is not installed")
        image = self.image()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            image.ifov.to_zarr("image.zarr")
        back = xarray.open_zarr("image.zarr", chunks=None)
        np.testing.assert_array_equal(back["radiance"].values, image["radiance"].values)
        self.assertEqual(list(back["channel"].values), ["red", "T"])

    def test_a_cog(self):
        try:
            import rasterio
        except ImportError:
            self.skipTest("rasterio is not installed")
        image = self.image(crs="EPSG:32633", easting="500000 m", northing="5300000 m", height="0 m")
        image.ifov.to_cog("image.tif")
        with rasterio.open("image.tif") as file:
            self.assertEqual(file.crs.to_epsg(), 32633)
            np.testing.assert_array_equal(file.read(), image["radiance"].values)
            self.assertEqual(file.descriptions, ("red", "T"))
            self.assertAlmostEqual(float(file.tags(1)["wavelength"]), 0.65, 4)
            # The middle of the upper left pixel.
            np.testing.assert_allclose(file.xy(0, 0), (float(image["x"][0]), float(image["y"][0])), atol=1e-6)
        image.ifov.to_cog("converged.tif", "converged")
        with rasterio.open("converged.tif") as file:
            np.testing.assert_array_equal(file.read(1), image["converged"].values)

    def test_a_stac_item(self):
        item = self.image(crs="EPSG:32633", easting="500000 m", northing="5300000 m", height="0 m").ifov.to_stac(
            "item.json", {"radiance": "image_radiance.img"}
        )
        self.assertEqual(json.loads((self.folder / "item.json").read_text(encoding="utf-8")), item)
        self.assertEqual(item["properties"]["datetime"], "2026-06-21T10:00:00Z")
        self.assertEqual(item["properties"]["proj:epsg"], 32633)
        self.assertEqual(item["assets"]["radiance"]["eo:bands"][0]["name"], "red")
        try:
            import rasterio  # noqa: F401
        except ImportError:
            return
        west, south, east, north = item["bbox"]
        self.assertTrue(14.99 < west < 15 < east < 15.01 and 47.8 < south < north < 47.9, item["bbox"])
        self.assertIsNone(self.image().ifov.to_stac()["geometry"])


if __name__ == "__main__":
    unittest.main()
