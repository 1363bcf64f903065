"""STAC items of loaded runs against those that the runs wrote, and cubes however their values lie, also of runs that are not finished."""

import json
import pathlib
import tempfile
import types
import unittest

import numpy as np
import scenes

import ifov
from ifov import _tiles


def scanned(**output):
    """Ground in Delft under a line scanner that rolls."""
    document = scenes.small(output={"formats": ["envi", "stac"], "products": ["half_width", "location"], **output})
    document["time"] = "2026-06-21T10:00:00Z"
    document["scene"]["origin"] = {"latitude": "51.99 deg", "longitude": "4.37 deg"}
    document["platform"] = {
        "straight": {"frame": "scene", "position": ["0 m", "-2 m", "100 m"], "velocity": ["0 m/s", "40 m/s", "0 m/s"]},
        "attitude": {"roll": "8 deg"},
    }
    document["sensor"]["camera"] = {
        "pushbroom": {"pixels": [24, 20], "focal_length": "20 mm", "pitch": "0.1 mm", "line_period": "12.5 ms"}
    }
    return document


class Catalogue(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_items_say_the_same(self):
        ifov.run(scanned(), self.folder / "out", progress=False)
        theirs = json.loads((self.folder / "out" / "image_stac.json").read_text(encoding="utf-8"))
        assets = {"radiance": "./image_radiance.img", "location": "./image_location.img"}
        ours = ifov.load(self.folder / "out").ifov.to_stac(assets=assets)
        self.assertEqual(ours["properties"].keys(), theirs["properties"].keys())
        for key, value in theirs["properties"].items():
            if isinstance(value, float):
                self.assertAlmostEqual(ours["properties"][key], value, 9, key)
            elif key != "title":
                self.assertEqual(ours["properties"][key], value, key)
        self.assertGreater(theirs["properties"]["view:off_nadir"], 7.9)
        for key in assets:
            own = {field: value for field, value in ours["assets"][key].items() if field != "title"}
            self.assertEqual(own, {field: value for field, value in theirs["assets"][key].items() if field in own})
        try:
            import rasterio  # noqa: F401
        except ImportError:
            return
        (mine,), (others,) = ours["geometry"]["coordinates"], theirs["geometry"]["coordinates"]
        np.testing.assert_allclose(mine, others, atol=1e-10)
        np.testing.assert_allclose(ours["bbox"], theirs["bbox"], atol=1e-10)

    def test_values_are_the_same_however_they_lie(self):
        ifov.run(scanned(), self.folder / "bil", progress=False)
        expected = ifov.load(self.folder / "bil").load()
        for interleave in ("bsq", "bip"):
            ifov.run(scanned(interleave=interleave), self.folder / interleave, progress=False)
            found = ifov.load(self.folder / interleave)
            for name in ("radiance", "half_width", "easting", "height"):
                np.testing.assert_array_equal(found[name].values, expected[name].values, f"{interleave} {name}")

    def test_of_unfinished_runs_too(self):
        """Values of finished lines are in the cubes alone."""
        values = np.arange(2 * 5 * 7, dtype="<f4").reshape(2, 5, 7)  # [band, row, column]
        tile = types.SimpleNamespace(in_cubes=True, place=(slice(1, 4), slice(2, 6)))
        for interleave, axes in (("bil", (1, 0, 2)), ("bsq", (0, 1, 2)), ("bip", (1, 2, 0))):
            path = self.folder / f"{interleave}.img.part"
            path.write_bytes(values.transpose(axes).tobytes())
            found = _tiles._Values("mean", [tile], [path], (2, 5, 7), interleave)[:, :, :]
            np.testing.assert_array_equal(found[(slice(None), *tile.place)], values[(slice(None), *tile.place)], interleave)
            self.assertTrue(np.isnan(found[:, 0]).all())


if __name__ == "__main__":
    unittest.main()
