"""Arrays in place of files give what the files give."""

import pathlib
import unittest

import numpy as np
import scenes
import xarray

import ifov

ROOF = "v -3 -2 1\nv 3 -2 1\nv 3 2 2\nv -3 2 2\nf 1 2 3\nf 1 3 4\n"
VERTICES = [[-3, -2, 1], [3, -2, 1], [3, 2, 2], [-3, 2, 2]]
TRIANGLES = [[0, 1, 2], [0, 2, 3]]


class Assets(scenes.InFolder):
    def render(self, document, assets=None):
        return ifov.render(document, assets, progress=False)["radiance"].values

    def with_object(self, thing, **materials):
        document = scenes.small()
        document["scene"]["objects"][1] = thing
        document["scene"]["materials"].update(materials)
        return document

    def both(self, document, assets):
        """The same with files, and with assets, whose names have 'asset:' before them."""
        import json

        text = json.dumps(document)
        files = json.loads(text)
        for name in assets:
            self.assertIn(f'"{name}"', text)
            text = text.replace(f'"{name}"', f'"asset:{name}"')
        np.testing.assert_array_equal(self.render(json.loads(text), assets), self.render(files))

    def test_a_mesh(self):
        pathlib.Path("roof.obj").write_text(ROOF, encoding="utf-8")
        document = self.with_object({"mesh": {"file": "roof.obj"}, "material": "ball"})
        self.both(document, {"roof.obj": ifov.Mesh(VERTICES, TRIANGLES)})
        self.both(document, {"roof.obj": ROOF.encode()})

    def test_a_terrain(self):
        heights = np.fromfunction(lambda row, column: 0.3 * np.sin(row / 3.0) + 0.02 * column, (24, 32)).astype(np.float32)
        document = scenes.small()
        document["scene"]["objects"] = [{"terrain": {"file": "asset:dem"}, "material": "ground"}]
        place = (-8.0, 0.5, 0.0, 6.0, 0.0, -0.5)
        flat = self.render(document, {"dem": ifov.Raster(np.zeros((24, 32)), place)})
        made = self.render(document, {"dem": ifov.Raster(heights, place)})
        self.assertGreater(float(np.abs(made[0] - flat[0]).max()), 0.05 * float(flat[0].max()))
        x, y = -7.75 + 0.5 * np.arange(32), 5.75 - 0.5 * np.arange(24)
        array = xarray.DataArray(heights, {"y": y, "x": x}, ("y", "x"))
        np.testing.assert_array_equal(made, self.render(document, {"dem": array}))
        # Arrays in any order of memory.
        np.testing.assert_array_equal(made, self.render(document, {"dem": ifov.Raster(np.asfortranarray(heights), place)}))

    def test_a_spectrum(self):
        um, reflectance = [0.4, 0.6, 0.7, 14.0], [0.1, 0.5, 0.2, 0.05]
        rows = "".join(f"{a},{b}\n" for a, b in zip(um, reflectance, strict=True))
        pathlib.Path("paint.csv").write_text(rows, encoding="utf-8")
        document = scenes.small()
        document["scene"]["materials"]["ball"]["reflectance"] = {"csv": "paint.csv", "wavelength_unit": "um"}
        self.both(document, {"paint.csv": ifov.Spectrum(um, reflectance)})

    def test_errors_name_the_asset(self):
        document = self.with_object({"mesh": {"file": "asset:roof"}, "material": "ball"})
        for asset, words, kind in (
            (ifov.Mesh(VERTICES, [[0, 1, 9]]), "roof", ifov.DocumentError),
            (ifov.Mesh(VERTICES, [[0, 1, -1]]), "whole numbers from 0", TypeError),
            ("roof.obj", "expected ifov.Mesh", TypeError),
            (np.zeros(4), "expected ifov.Mesh", TypeError),
        ):
            with self.assertRaisesRegex(kind, words):
                self.render(document, {"roof": asset})
        with self.assertRaisesRegex(ifov.DocumentError, "roof"):
            self.render(document, {"rof": ifov.Mesh(VERTICES, TRIANGLES)})

    def test_check_knows_assets(self):
        document = self.with_object({"mesh": {"file": "asset:roof"}, "material": "ball"})
        self.assertFalse(ifov.check(document))
        told = ifov.check(document, {"roof": ifov.Mesh(VERTICES, TRIANGLES)})
        self.assertTrue(told, str(told))


if __name__ == "__main__":
    unittest.main()
