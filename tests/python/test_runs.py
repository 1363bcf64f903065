"""Runs in folders: stopped, gone on with, shared, refined, and looked at meanwhile."""

import json
import pathlib
import time
import unittest

import numpy as np
import scenes

import ifov
from ifov import _tiles


class Stop(Exception):
    pass


class Runs(scenes.InFolder):
    def stopped(self, document, folder, tiles, **options):
        """A run that ends after some tiles."""

        def stop(progress):
            time.sleep(0.025)  # progress is told 50 times a second at most, and each of these tiles is to be
            if progress.pixels_done >= tiles * 64:
                raise Stop

        with self.assertRaises(Stop):
            ifov.run(document, folder, callback=stop, progress=False, threads=1, **options)

    def test_a_run_is_stopped_from_elsewhere(self):
        stop = pathlib.Path("out/run.part/stop")

        def ask(progress):
            if progress.pixels_done:
                stop.touch()

        with self.assertRaisesRegex(KeyboardInterrupt, "stopped on request"):
            ifov.run(scenes.endless(), "out", callback=ask, progress=False)
        self.assertFalse(stop.exists())
        self.assertFalse(ifov.status("out").complete)

    def test_products_are_the_programs(self):
        run = ifov.run(scenes.small(), "out", progress=False)
        self.assertEqual(run.outcome.exit_code, 0)
        self.assertTrue(run.outcome.converged)
        self.assertIn(pathlib.Path("out/image_radiance.img"), run.outcome.products)
        self.assertTrue(run.status().complete)
        pathlib.Path("document.json").write_text(ifov.load("out").attrs["document"], encoding="utf-8")
        self.program("render", "document.json", "--output", "again")
        for file in pathlib.Path("out").iterdir():
            if file.suffix in (".img", ".hdr", ".png"):
                self.assertEqual(file.read_bytes(), (pathlib.Path("again") / file.name).read_bytes(), file.name)
        with self.assertRaises(ifov.DocumentError):
            ifov.status("nowhere")

    def test_a_stopped_run_is_loaded_and_goes_on(self):
        for options in ({}, {"keep": True}):
            folder = f"out{len(options)}"
            self.stopped(scenes.small(), folder, 3, **options)
            state = ifov.status(folder)
            self.assertFalse(state.complete)
            self.assertGreaterEqual(state.tiles_done, 3)
            self.assertEqual(state.tiles_wanted, 6)
            tiles = [tile for file in pathlib.Path(folder, "run.part", "tiles").iterdir() for tile in _tiles._tiles_in(file)]
            self.assertEqual(any(tile.in_cubes for tile in tiles), not options)  # whose values are in the cubes, the rest compressed
            self.assertFalse(all(tile.in_cubes for tile in tiles))
            part = ifov.load(folder).load()  # its tiles go away with the run
            there = np.isfinite(part["radiance"].values).all(axis=0)
            self.assertEqual(int(there.sum()), state.pixels_done)
            self.assertIn(f"{state.pixels_done} of 280 pixels", part.attrs["reached"])
            with self.assertRaises(ifov.DocumentError):
                ifov.run(scenes.small(), folder, progress=False)  # nothing finished is thrown away unasked
            run = ifov.Run(scenes.small(), folder).resume(progress=False, **options)
            whole = run.load()
            self.assertTrue(np.isfinite(whole["radiance"].values).all())
            for name in part.data_vars:
                values, gap = part[name].values, {"reasons": 4}.get(name, 0)
                np.testing.assert_array_equal(values[..., there], whole[name].values[..., there], name)
                if values.dtype.kind == "f":
                    self.assertTrue(np.isnan(values[..., ~there]).all(), name)
                else:
                    self.assertTrue((values[..., ~there] == gap).all(), name)
            band = part["radiance"].isel(wavelength=1, x=slice(4, 9))
            np.testing.assert_array_equal(band, part["radiance"].values[1][:, 4:9])

    def test_what_loading_works_out_is_kept_as_the_program_keeps_it(self):
        air = {**scenes.small(), "atmosphere": {"profile": "mid-latitude summer"}}
        air["light"] = {"sun": {"disc": {"zenith": "40 deg", "azimuth": "180 deg"}}}
        air["sensor"]["channels"] = [{"name": "S", "series": {"gaussian": {"from": "0.4 um", "to": "0.7 um", "count": 12, "fwhm": "10 nm"}}}]
        ifov.run(air, "nothing", progress=False)
        self.assertEqual(list(pathlib.Path().glob("*.ifovcache")), [])
        pathlib.Path("scene.json").write_text(json.dumps(air))
        document = ifov.read("scene.json")
        ifov.run(document, "without", progress=False, scene_cache=False)
        self.assertEqual(list(pathlib.Path().glob("*.ifovcache")), [])
        ifov.run(document, "with", progress=False)
        self.assertEqual([found.name for found in pathlib.Path().glob("*.ifovcache")], ["scene.ifovcache"])
        self.assertEqual((pathlib.Path("with") / "image_radiance.img").read_bytes(), (pathlib.Path("without") / "image_radiance.img").read_bytes())

    def test_shares(self):
        folders = [f"share{number}" for number in (1, 2)]
        for number, folder in enumerate(folders, 1):
            ifov.run(scenes.small(), folder, share=(number, 2), progress=False)
        parts = [ifov.load(folder)["radiance"].values for folder in folders]
        outcome = ifov.merge(folders, "whole")
        self.assertEqual(outcome.exit_code, 0)
        whole = ifov.load("whole")["radiance"].values
        np.testing.assert_array_equal(np.where(np.isfinite(parts[0]), parts[0], parts[1]), whole)
        self.assertTrue((np.isfinite(parts[0]) != np.isfinite(parts[1])).all())
        with self.assertRaises(ifov.DocumentError):
            ifov.merge(folders[:1], "half")

    def test_refining(self):
        run = ifov.run(scenes.small(), "out", keep=True, progress=False)
        self.assertTrue(run.status().kept)
        before = run.load().load()
        run.refine("2 %", progress=False)
        after = run.load()
        self.assertIn("2 %", after.attrs["asked"])
        self.assertEqual(run.document["sampling"]["accuracy"]["error"], "2 %")
        worst = [float(one.ifov.relative_error().sel(wavelength=10.5, method="nearest").max()) for one in (before, after)]
        self.assertLess(worst[1], 0.021)
        self.assertLess(worst[1], worst[0])

    def test_a_forecast(self):
        told = ifov.forecast(scenes.small())
        self.assertGreater(told.rays, 0)
        self.assertEqual(told.shortages, [])
        self.assertFalse(any(self.folder.iterdir()))

    def test_noise(self):
        document = scenes.small()
        document["sensor"]["channels"][0]["noise"] = "1 W m-2 sr-1 um-1"
        ifov.run(document, "out", progress=False)
        first = ifov.detect("out", seed=7, count=2)
        self.assertEqual([file.name for file in first], ["image_noisy_7.img", "image_noisy_8.img"])
        loaded = ifov.load("out")
        noise = (loaded["noisy_7"] - loaded["radiance"]).isel(wavelength=0).values
        self.assertAlmostEqual(float(noise.std()), 1.0, delta=4 / np.sqrt(2 * noise.size))

    def test_a_detector(self):
        document = scenes.small()
        document["sensor"]["optics"] = {"f_number": 4}
        document["sensor"]["detector"] = {"pitch": "5 um", "integration_time": "1 ms", "quantum_efficiency": 0.7,
                                          "full_well": "1 Me-", "bits": 12, "gain": "250 e-/count"}
        ifov.run(document, "out", progress=False)
        made = ifov.detect("out", seed=3, quantities=["counts"])
        self.assertEqual([file.name for file in made], ["image_counts_3.img"])
        [electrons] = ifov.detect("out", seed=3, quantities=["electrons"])
        [twice] = ifov.detect("out", seed=3, quantities=["electrons"], set=["sensor.detector.integration_time=2 ms"], folder="twice")
        ratio = np.fromfile(twice, "<f4").mean() / np.fromfile(electrons, "<f4").mean()
        self.assertAlmostEqual(ratio, 2.0, delta=0.02)
        with self.assertRaisesRegex(ValueError, "found 'photons', expected 'radiance', 'kelvins', 'toa_reflectance', 'electrons' or 'counts'"):
            ifov.detect("out", quantities=["photons"])


if __name__ == "__main__":
    unittest.main()
