"""City models: what the log of a render says of them against an independent reading with json and numpy; broken meshes."""

import json
import os
import re
import subprocess
import tarfile
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROGRAM = os.environ["IFOV_PROGRAM"]
SOURCE = Path(__file__).resolve().parents[2]
TRUTH = Path(os.environ.get("IFOV_TRUTH", SOURCE / ".." / "shared" / "truth")).resolve()

DOCUMENT = {
    "ifov": 1,
    "scene": {"materials": {"a": {"reflectance": 0.3}}},
    "light": {"sky": {"radiance": "10 W m-2 sr-1 um-1"}},
    "sensor": {
        "camera": {"orthographic": {"gsd": "10 m", "pixels": [2, 2]}},
        "channels": [{"gaussian": {"center": "0.55 um", "fwhm": "20 nm"}}],
    },
    "sampling": {"single": {}},
}


def render(objects, folder, origin=None):
    document = json.loads(json.dumps(DOCUMENT))
    document["scene"]["objects"] = objects
    if origin:
        document["scene"]["origin"] = origin
    path = Path(folder) / "scene.json"
    path.write_text(json.dumps(document))
    log = Path(folder) / "log.txt"
    command = [PROGRAM, "render", str(path), "--output", str(Path(folder) / "out"), "--log", str(log)]
    run = subprocess.run(command, capture_output=True, text=True, timeout=200)
    run.log = log.read_text() if log.exists() else ""
    return run


def surfaces_of(boundaries):
    """All surfaces below nested boundaries: lists of rings."""
    if boundaries and isinstance(boundaries[0][0], int):
        yield boundaries
    else:
        for item in boundaries:
            yield from surfaces_of(item)


def read_independently(path):
    city = json.loads(path.read_text())
    vertices = np.array(city["vertices"]) * city["transform"]["scale"] + city["transform"]["translate"]
    used, roots, surfaces = set(), set(), 0
    for name, item in city["CityObjects"].items():
        geometries = item.get("geometry", [])
        if not geometries:
            continue
        finest = max(str(g["lod"]) for g in geometries)
        while item.get("parents"):
            name = item["parents"][0]
            item = city["CityObjects"][name]
        roots.add(name)
        for geometry in geometries:
            if str(geometry["lod"]) == finest:
                for rings in surfaces_of(geometry["boundaries"]):
                    surfaces += 1
                    used.update(corner for ring in rings for corner in ring)
    corners = vertices[sorted(used)]
    return len(roots), surfaces, corners.min(axis=0), corners.max(axis=0)


class CityModels(unittest.TestCase):
    def test_counts_and_bounds(self):
        folder = TRUTH / "scenes" / "buildings-cityjson"
        if not folder.exists():
            self.skipTest(f"reference data not found: {folder}")
        for name in ["delft.json", "zurich_subset_lod2.json", "multi_lod.json", "DH_01_subs.city.json"]:
            with self.subTest(name), tempfile.TemporaryDirectory() as scratch:
                objects, surfaces, low, high = read_independently(folder / name)
                origin = {"easting": f"{low[0]} m", "northing": f"{low[1]} m"}
                run = render([{"city": {"file": str(folder / name)}, "material": "a"}], scratch, origin)
                self.assertIn(run.returncode, (0, 6), run.stderr)
                text = run.log
                found = re.search(
                    r"(\d+) objects \(\d+ buildings\), (\d+) surfaces in \d+ triangles, east (\S+) to (\S+), "
                    r"north (\S+) to (\S+), height (\S+) to (\S+) m",
                    text,
                )
                self.assertIsNotNone(found, text)
                self.assertEqual(int(found[1]), objects)
                self.assertEqual(int(found[2]), surfaces)
                bounds = [float(found[k]) for k in range(3, 9)]
                expected = [low[0], high[0], low[1], high[1], low[2], high[2]]
                np.testing.assert_allclose(bounds, expected, atol=6e-4)
                self.assertIn(f"scene: {objects} objects", text)

    def test_far_from_the_origin_is_said(self):
        file = TRUTH / "scenes" / "buildings-cityjson" / "delft_1b.json"
        if not file.exists():
            self.skipTest(f"reference data not found: {file}")
        with tempfile.TemporaryDirectory() as scratch:
            run = render([{"city": {"file": str(file)}, "material": "a"}], scratch)
            self.assertIn("km from the scene's origin; state its easting and northing as 'origin'", run.log)

    def test_materials_by_rule(self):
        file = TRUTH / "scenes" / "buildings-cityjson" / "delft_1b.json"
        if not file.exists():
            self.skipTest(f"reference data not found: {file}")
        with tempfile.TemporaryDirectory() as scratch:
            good = {"city": {"file": str(file)}, "material": {"slots": {"RoofSurface": "a", "other": "a"}}}
            self.assertIn(render([good], scratch).returncode, (0, 6))
            # This building stands on the ground without a floor: it has roofs and walls alone.
            bad = {"city": {"file": str(file)}, "material": {"slots": {"RoofSurface": "a", "GroundSurface": "a"}}}
            run = render([bad], scratch)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertRegex(run.stderr, r"scene.json:\d+:\d+: no material for the surfaces 'WallSurface' of the Building '.*'; "
                             "give one for 'WallSurface', 'Building' or 'other'")

    def test_meshes_that_once_broke_a_reader(self):
        archive = TRUTH / "malformed" / "tinyobj" / "afl.tar.gz"
        if not archive.exists():
            self.skipTest(f"reference data not found: {archive}")
        with tempfile.TemporaryDirectory() as scratch, tarfile.open(archive) as files:
            count = 0
            for member in files.getmembers():
                if not member.isfile():
                    continue
                count += 1
                (Path(scratch) / "a.obj").write_bytes(files.extractfile(member).read())
                run = render([{"mesh": {"file": "a.obj"}, "material": {"slots": {"": "a"}}}], scratch)
                with self.subTest(member.name):
                    self.assertIn(run.returncode, (0, 1, 5, 6), run.stderr)
            self.assertGreater(count, 5)


if __name__ == "__main__":
    unittest.main()
