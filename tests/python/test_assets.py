"""Arrays in place of files give what the files give."""

import json
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

        along = xarray.DataArray(reflectance, {"wavelength": um}, ("wavelength",))
        self.both(document, {"paint.csv": along})

    def test_a_channel_by_a_table(self):
        rows = "0.60,0\n0.64,1\n0.66,0.7\n0.70,0\n"
        pathlib.Path("response.csv").write_text(rows, encoding="utf-8")
        document = scenes.small()
        document["sensor"]["channels"][0] = {"name": "red", "tabulated": {"file": "response.csv", "wavelength_unit": "um"}}
        self.both(document, {"response.csv": ifov.Spectrum([0.6, 0.64, 0.66, 0.7], [0, 1, 0.7, 0])})

    def test_copies(self):
        pathlib.Path("trees.csv").write_text("-1,0.5,0.4,0,1\n1.2,-0.7,0.4,0,1.5\n", encoding="utf-8")
        document = self.with_object({"instances": {"of": "tree", "csv": "trees.csv"}})
        document["scene"]["prototypes"] = {"tree": [{"sphere": {"center": ["0 m"] * 3, "radius": "0.4 m"}, "material": "ball"}]}
        self.both(document, {"trees.csv": ifov.Copies([[-1, 0.5, 0.4], [1.2, -0.7, 0.4]], scale=[1, 1.5])})

    #: West, south and side of the cells of rasters that lie on the ground.
    PLACE = (-3.0, -2.0, 0.5)

    def grid(self, name, values):
        """A raster on the ground as a file, an ESRI ASCII grid, and as the asset that stands for it."""
        west, south, side = self.PLACE
        rows, columns = values.shape
        head = f"ncols {columns}\nnrows {rows}\nxllcorner {west}\nyllcorner {south}\ncellsize {side}\nNODATA_value -9999\n"
        text = head + "\n".join(" ".join(repr(float(v)) for v in row) for row in values) + "\n"
        pathlib.Path(name).write_text(text, encoding="ascii")
        return {name: ifov.Raster(values, (west, side, 0.0, south + side * rows, 0.0, -side), nodata=-9999)}

    def on_ground(self, ground, name, values, **materials):
        """With files and assets alike, and not as where the raster holds other numbers, nor as without one."""
        document = scenes.small()
        document["scene"]["materials"].update(materials)
        plain = self.render(document)
        if "objects" in ground:
            document["scene"]["objects"] = ground["objects"]
        else:
            document["scene"]["materials"]["ground"] = ground
        made = self.grid(name, values)
        self.both(document, made)
        text = json.loads(json.dumps(document).replace(f'"{name}"', f'"asset:{name}"'))
        first = self.render(text, made)
        # In one channel at least.
        self.assertGreater(float((np.abs(first - plain).max(axis=(1, 2)) / plain.max(axis=(1, 2))).max()), 0.02)
        other = {name: ifov.Raster(values[::-1, ::-1].copy(), made[name].geotransform, nodata=-9999)}
        self.assertFalse(np.array_equal(first, self.render(text, other)))

    def test_a_texture(self):
        values = np.fromfunction(lambda row, column: 40 * row + 7 * column, (8, 12))
        image = {"file": "lawn.asc", "from": "0.6 um", "to": "0.7 um"}
        ground = {"reflectance": [0.1, 0.3, 0.5, 0.7], "temperature": "20 degC", "texture": {"images": [image]}}
        self.on_ground(ground, "lawn.asc", values)
        # Of several bands, by texture coordinates, and as an array with no place.
        pair = np.stack([values.T, values.T[::-1]])
        image |= {"by": "texture coordinates", "band": 2}
        document = self.with_object({"polygon": {"vertices": [["-3 m", "-2 m", "1 m"], ["3 m", "-2 m", "1 m"], ["3 m", "2 m", "1 m"], ["-3 m", "2 m", "1 m"]]},
                                     "material": "ball"}, ball=ground)
        image["file"] = "asset:pair"
        second = self.render(document, {"pair": pair})
        image["band"] = 1
        np.testing.assert_array_equal(second, self.render(document, {"pair": pair[1]}))
        self.assertFalse(np.array_equal(second, self.render(document, {"pair": pair})))
        with self.assertRaisesRegex(ifov.DocumentError, "all cells of the image hold the same number"):
            self.render(document, {"pair": np.ones((4, 4))})

    def test_relief_temperatures_classes_and_holes(self):
        waves = np.fromfunction(lambda row, column: 0.2 * np.sin(row) + 0.1 * column, (8, 12))
        plain = {"reflectance": 0.3, "temperature": "20 degC"}
        self.on_ground(plain | {"relief": {"heights": {"file": "waves.asc", "unit": "1 m"}}}, "waves.asc", waves)
        self.on_ground(plain | {"temperature": {"map": {"file": "warm.asc", "unit": "K"}}}, "warm.asc", 300 + 20 * waves)
        chosen = {"map": {"file": "classes.asc", "classes": {"1": "ground", "2": "snow"}}}
        self.on_ground({"objects": [{"plane": {}, "material": chosen}]}, "classes.asc", 1.0 + (waves > waves.mean()), snow=plain | {"reflectance": 0.9})
        fence = {"polygon": {"vertices": [["-3 m", "-2 m", "1 m"], ["3 m", "-2 m", "1 m"], ["3 m", "2 m", "1 m"], ["-3 m", "2 m", "1 m"]]}, "material": "mesh"}
        self.on_ground({"objects": [{"plane": {}, "material": "ground"}, fence]}, "holes.asc", 255.0 * (waves > waves.mean()),
                       mesh=plain | {"reflectance": 0.8, "opacity": {"file": "holes.asc", "cutoff": 128}})

    def test_errors_name_the_asset(self):
        document = self.with_object({"mesh": {"file": "asset:roof"}, "material": "ball"})
        for asset, words, kind in (
            (ifov.Mesh(VERTICES, [[0, 1, 9]]), "roof", ifov.DocumentError),
            (ifov.Mesh(VERTICES, [[0, 1, -1]]), "whole numbers from 0", TypeError),
            ("roof.obj", "expected ifov.Mesh", TypeError),
            (np.zeros(4), "expected ifov.Mesh", TypeError),
            (ifov.Mesh([[0, 0], [1, 1]], TRIANGLES), r"assets\['roof'\]: vertices: found shape \(2, 2\); expected \(n, 3\)", TypeError),
            (ifov.Spectrum([[0.4, 0.5]], [1, 2]), r"'roof'\]: wavelength: found shape \(1, 2\); expected \(n,\)", TypeError),
            (ifov.Copies([0, 0, 0]), r"'roof'\]: positions: found shape \(3,\); expected \(n, 3\)", TypeError),
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
