"""Datasets in memory, datasets of folders and what the program writes are the same."""

import json
import pathlib
import re
import unittest

import numpy as np
import scenes
import xarray

import ifov


class Images(scenes.InFolder):
    def assert_same(self, those, these, names):
        for name in names:
            self.assertEqual(those[name].dims, these[name].dims, name)
            self.assertEqual(those[name].dtype, these[name].dtype, name)
            self.assertEqual(those[name].values.tobytes(), these[name].values.tobytes(), name)

    def test_they_go_to_other_processes(self):
        import pickle

        ifov.run(scenes.small(), "out", progress=False)
        for dataset in (ifov.render(scenes.small(), progress=False), ifov.load("out")):
            sent = pickle.dumps(dataset)
            self.assertTrue(pickle.loads(sent).identical(dataset))
        # What is read when it is asked for is sent as where it lies.
        self.assertLess(len(sent), 40_000)

    def test_ten_lines_are_the_programs_products(self):
        document = scenes.ten_lines()
        pathlib.Path("dome.json").write_text(json.dumps(document), encoding="utf-8")
        self.program("render", "dome.json")
        made = ifov.render(document, progress=False)
        loaded = ifov.load("dome.out")
        self.assertEqual(set(made) - set(loaded), {"standard_error"})
        self.assertEqual(set(loaded) - set(made), set())
        self.assert_same(made, loaded, loaded.data_vars)
        for name in loaded.coords:
            self.assertTrue(made[name].equals(loaded[name]), name)
        # Against the bytes themselves, by lines as an ENVI cube of interleave "bil" has them.
        for name in ("radiance", "half_width"):
            cube = pathlib.Path(f"dome.out/image_{name}.img").read_bytes()
            self.assertEqual(made[name].transpose("y", "wavelength", "x").values.tobytes(), cube)
        self.assertEqual(made.attrs["reached"], loaded.attrs["reached"])
        self.assertEqual(made.attrs["asked"], loaded.attrs["asked"])

    def test_what_a_dataset_says(self):
        made = ifov.render(scenes.small(), progress=False)
        self.assertEqual(made["radiance"].dims, ("wavelength", "y", "x"))
        self.assertEqual(made["abundance"].dims, ("material", "y", "x"))
        self.assertEqual(made["samples"].dims, ("y", "x"))
        self.assertEqual(list(made["channel"].values), ["red", "T"])
        self.assertEqual(list(made["material"].values), ["ground", "ball", "surroundings"])
        self.assertAlmostEqual(float(made["wavelength"][0]), 0.65, 4)
        self.assertAlmostEqual(float(made["fwhm"][0]), 0.04, 4)
        # Middles of pixels, rows from the north, about the scene's origin.
        np.testing.assert_allclose(made["x"], (np.arange(20) - 9.5) * 0.3, atol=1e-12)
        np.testing.assert_allclose(made["y"], (6.5 - np.arange(14)) * 0.3, atol=1e-12)
        self.assertEqual(made["radiance"].attrs["units"], "W m-2 sr-1 um-1")
        self.assertEqual(made.attrs["seed"], 5)
        self.assertEqual(made.attrs["confidence"], 0.95)
        self.assertEqual(made.attrs["version"], ifov.version())
        self.assertEqual(json.loads(made.attrs["document"]), scenes.SMALL)
        self.assertTrue(bool(made["converged"].all()))
        np.testing.assert_allclose(made["abundance"].sum("material"), 1.0, atol=1e-5)
        # Half-widths are quantiles of standard errors.
        ratio = (made["half_width"] / made["standard_error"]).values
        ratio = ratio[np.isfinite(ratio)]
        self.assertGreater(ratio.min(), 1.5)
        self.assertLess(np.median(ratio), 20.0)

    def test_wavelengths_that_do_not_rise_leave_the_channel_as_dim(self):
        document = scenes.small()
        document["sensor"]["channels"].append({"name": "blue", "gaussian": {"center": "0.45 um", "fwhm": "40 nm"}})
        made = ifov.render(document, progress=False)
        self.assertEqual(made["radiance"].dims, ("channel", "y", "x"))
        self.assertEqual(made["wavelength"].dims, ("channel",))
        self.assertEqual(made["radiance"].sel(channel="blue").dims, ("y", "x"))

    def test_what_else_can_be_told(self):
        document = scenes.small(output={"products": ["all"]})
        ifov.run(document, "out", progress=False)
        loaded = ifov.load("out")
        made = ifov.render(document, quantities=["all"], progress=False)
        self.assert_same(made, loaded, loaded.data_vars)
        for name in ("easting", "northing", "height", "view_zenith", "abundance_half_width", "quality_class"):
            self.assertIn(name, loaded)
        self.assertEqual(loaded["material_class"].attrs["flag_meanings"].split()[0], "nothing")
        self.assertEqual(set(np.unique(loaded["object_class"])), {1, 2})
        np.testing.assert_allclose(made["normal_up"], np.cos(np.radians(made["slope"])), atol=1e-6)
        # What is named in the document comes without asking.
        self.assertIn("view_zenith", ifov.render(document, progress=False))
        with self.assertRaisesRegex(ifov.DocumentError, "did you mean 'abundance'"):
            ifov.render(document, quantities=["abundence"], progress=False)

    def test_polarization(self):
        document = scenes.small()
        document["sensor"]["stokes"] = True
        ifov.run(document, "out", progress=False)
        made = ifov.render(document, quantities=["all"], progress=False)
        loaded = ifov.load("out")
        self.assertEqual(made["stokes_vector"].dims, ("stokes", "wavelength", "y", "x"))
        self.assert_same(made, loaded, set(loaded) & set(made))
        np.testing.assert_array_equal(made["stokes_vector"][0], made["radiance"])

    def test_loading_is_lazy(self):
        ifov.run(scenes.small(), "out", progress=False)
        loaded = ifov.load("out")
        whole = ifov.load("out").load()
        pathlib.Path("out/image_radiance.img").rename("moved")
        with self.assertRaises(FileNotFoundError):
            loaded["radiance"].values  # noqa: B018
        pathlib.Path("moved").rename("out/image_radiance.img")
        part = loaded["radiance"].isel(wavelength=1, y=slice(2, 9, 3), x=[3, 7])
        np.testing.assert_array_equal(part, whole["radiance"].values[1][2:9:3][:, [3, 7]])

    def test_seeds_and_sampling_of_a_loaded_scene(self):
        scene = ifov.Scene(scenes.small())
        self.assertIn("2 objects", scene.description)
        self.assertEqual(scene.warnings, [])
        first, second = (scene.render(seed=seed, progress=False) for seed in (5, 6))
        self.assertEqual(second.attrs["seed"], 6)
        self.assertFalse(first["radiance"].equals(second["radiance"]))
        self.assert_same(first, ifov.render(scenes.small(), progress=False), first.data_vars)
        self.assert_same(second, ifov.render(scenes.small(seed=6), progress=False), second.data_vars)
        fine = scene.render(sampling={"accuracy": {"error": "1 %"}, "tile": 8}, progress=False)
        self.assertGreater(int(fine["samples"].sum()), int(first["samples"].sum()))
        self.assertIn("1 %", fine.attrs["asked"])

    def test_rays(self):
        scene = ifov.Scene(scenes.small())
        met = scene.cast([-2, 1, 10], [[0, 0, -3], [0, 0, 1]])
        self.assertEqual(list(met["hit"].values), [True, False])
        self.assertAlmostEqual(float(met["distance"][0]), 10 - 2.4, 9)
        self.assertEqual(str(met["material"].values[0]), "ball")
        self.assertEqual(list(met["object"].values), [1, -1])
        np.testing.assert_allclose(met["normal"][0], [0, 0, 1], atol=1e-6)
        with self.assertRaises(ifov.DocumentError):
            scene.cast([0, 0, 1], [0, 0, 0])

    def test_a_time_limit_leaves_gaps(self):
        made = ifov.render(scenes.endless(), time_limit=0.3, progress=False)
        gaps = np.isnan(made["radiance"].values[0])
        self.assertTrue(gaps.any())
        self.assertTrue(np.all(made["reasons"].values[gaps] == 4))
        self.assertFalse(made["converged"].values[gaps].any())


class Flags(scenes.InFolder):
    def test_are_those_of_the_headers(self):
        ifov.run(scenes.small(), "out", progress=False)
        loaded = ifov.load("out")
        header = pathlib.Path("out/image_reasons.img.hdr").read_text(encoding="utf-8")
        bits = re.search(r"reason bits = \{(.*?)\}", header, re.DOTALL).group(1).split(",")
        attributes = loaded["reasons"].attrs
        names = zip(attributes["flag_masks"], attributes["flag_meanings"].split(), strict=True)
        self.assertEqual([f"{mask} {name}" for mask, name in names], [bit.strip().replace(" ", "_").replace("_", " ", 1) for bit in bits])
        classes = re.search(
            r"class names = \{(.*?)\}", pathlib.Path("out/image_quality_class.img.hdr").read_text(encoding="utf-8"), re.DOTALL
        )
        self.assertEqual(
            loaded["quality_class"].attrs["flag_meanings"].split(),
            [name.strip().replace(" ", "_") for name in classes.group(1).split(",")],
        )


class Loading(scenes.InFolder):
    def test_errors_say_what_is_missing(self):
        with self.assertRaisesRegex(FileNotFoundError, "nowhere"):
            ifov.load("nowhere")
        pathlib.Path("empty").mkdir()
        with self.assertRaisesRegex(ifov.DocumentError, "neither NAME_run.json nor run.part"):
            ifov.load("empty")

    def test_datasets_opened_by_others_have_the_accessor(self):
        made = ifov.render(scenes.small(), progress=False)
        made.ifov.to_netcdf("image.nc")
        self.assertEqual(xarray.open_dataset("image.nc").ifov.rgb().dims, ("y", "x", "rgb"))


if __name__ == "__main__":
    unittest.main()
