"""The folder of a series of times as one dataset."""

import json
import pathlib
import pickle
import sys
import unittest

import numpy as np
import scenes
import xarray

import ifov

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from test_times import JUNE, NIGHT, STREET  # noqa: E402

TIMES = ["2026-06-21T18:00", "2026-06-21T20:00", "2026-06-21T22:00"]


class Series(scenes.InFolder):
    def setUp(self):
        super().setUp()
        pathlib.Path("june.csv").write_text(JUNE, encoding="utf-8")
        pathlib.Path("scene.json").write_text(STREET, encoding="utf-8")
        self.program("render", "scene.json", "--times", NIGHT, "--output", "night")
        self.each = [ifov.load(pathlib.Path("night") / f"{time.replace(':', '')}Z") for time in TIMES]

    def test_times_are_a_dim(self):
        ds = ifov.load("night")
        self.assertEqual(ds.radiance.dims, ("time", "wavelength", "y", "x"))
        self.assertEqual(ds.abundance.dims, ("time", "material", "y", "x"))
        self.assertEqual([str(time)[:16] for time in ds.time.values], TIMES)
        self.assertEqual(ds.attrs["times_left"], 0)
        for name in self.each[0].data_vars:
            expected = np.stack([one[name].values for one in self.each])
            np.testing.assert_array_equal(ds[name].values, expected, err_msg=name)
            self.assertEqual(ds[name].dtype, self.each[0][name].dtype)
            self.assertEqual(ds[name].attrs.keys(), self.each[0][name].attrs.keys())
        for axis in ("x", "y", "wavelength", "material", "spatial_ref"):
            self.assertTrue(ds[axis].equals(self.each[0][axis]), axis)
        self.assertNotIn("acquisition_time", ds.attrs)
        self.assertEqual(ds.attrs["confidence"], self.each[0].attrs["confidence"])

    def test_what_is_chosen_is_what_is_read(self):
        ds = ifov.load("night/image_series.json")
        one = ds.sel(time="2026-06-21T20:00")
        np.testing.assert_array_equal(one.radiance.squeeze().values, self.each[1].radiance.squeeze().values)
        np.testing.assert_array_equal(ds.radiance[::-2, 0, 3, 2:9:3].values, [self.each[k].radiance[0, 3, 2:9:3].values for k in (2, 0)])
        np.testing.assert_array_equal(ds.radiance[-1].values, self.each[2].radiance.values)
        # Without a file of a time the others are read.
        pathlib.Path("night/2026-06-21T1800Z/image_radiance.img").unlink()
        np.testing.assert_array_equal(ds.isel(time=slice(1, None)).radiance.values, np.stack([one.radiance.values for one in self.each[1:]]))
        with self.assertRaises(FileNotFoundError):
            ds.radiance.values

    def test_what_is_often_done(self):
        ds = ifov.load("night")
        kelvin = ds.ifov.channel("thermal").ifov.brightness_temperature()
        self.assertEqual(kelvin.dims, ("time", "y", "x"))
        np.testing.assert_allclose(kelvin[2].values, self.each[2].ifov.channel("thermal").ifov.brightness_temperature().values)
        self.assertGreater(float(kelvin[0].mean()), float(kelvin[2].mean()))  # the evening cools
        curve = ds.ifov.spectrum(ds.x.values[4], ds.y.values[2]).radiance.squeeze().values
        np.testing.assert_array_equal(curve, [one.radiance[0, 2, 4].values for one in self.each])
        self.assertEqual(ds.ifov.rgb().dims, ("time", "y", "x", "rgb"))
        item = ds.ifov.to_stac()["properties"]
        self.assertEqual((item["datetime"], item["start_datetime"], item["end_datetime"]), (None, f"{TIMES[0]}:00Z", f"{TIMES[2]}:00Z"))
        self.assertEqual(ds.isel(time=1).ifov.to_stac()["properties"]["datetime"], f"{TIMES[1]}:00Z")
        with self.assertRaisesRegex(ValueError, "has dims"):
            ds.ifov.to_cog("day.tif")
        ds.ifov.to_netcdf("night.nc")
        with xarray.open_dataset("night.nc") as back:
            np.testing.assert_array_equal(back.radiance.values, ds.radiance.values)
            np.testing.assert_array_equal(back.time.values, ds.time.values)
        again = pickle.loads(pickle.dumps(ds))
        np.testing.assert_array_equal(again.radiance[1].values, self.each[1].radiance.values)

    def test_a_series_that_is_not_whole_and_others(self):
        pathlib.Path("night/2026-06-21T2000Z/image_run.json").unlink()
        ds = ifov.load("night")
        self.assertEqual([str(time)[:16] for time in ds.time.values], [TIMES[0], TIMES[2]])
        self.assertEqual(ds.attrs["times_left"], 1)
        for time in ("1800", "2200"):
            pathlib.Path(f"night/2026-06-21T{time}Z/image_run.json").unlink()
        with self.assertRaisesRegex(ifov.DocumentError, "none of its 3 times is made yet"):
            ifov.load("night")
        record = pathlib.Path("night/image_series.json")
        told = json.loads(record.read_text(encoding="utf-8"))
        told["times"][0]["folder"] = "../elsewhere"
        record.write_text(json.dumps(told), encoding="utf-8")
        with self.assertRaisesRegex(ifov.DocumentError, "'../elsewhere' is no folder beside it"):
            ifov.load("night")


if __name__ == "__main__":
    unittest.main()
