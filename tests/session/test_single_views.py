"""Sensors of single views: areas towards directions, the hemisphere, points and rays, against closed forms, published view
factors, published reflectance factors of a canopy, and themselves."""

import csv
import json
import math
import os
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SOURCE = Path(__file__).resolve().parents[2]
TRUTH = Path(os.environ.get("IFOV_TRUTH", SOURCE / ".." / "shared" / "truth")).resolve()
SUN_ZENITH = math.radians(30.0)
CHANNELS = [{"name": "red", "monochromatic": {"at": "0.65 um"}}, {"name": "near, infrared", "monochromatic": {"at": "0.8 um"}}]
GAUSS_8 = [(0.5 + 0.5 * s * x, 0.5 * w) for x, w in ((0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
                                                   (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763))
           for s in (-1, 1)]


def document(sensor, objects=(), sky=None, sun=True, error="0.5 %", ground=0.3, seed=1):
    light = {"sky": {"none": {}} if sky is None else {"radiance": f"{sky} W m-2 sr-1 um-1"}}
    if sun:
        light["sun"] = {"point": {"zenith": "30 deg", "azimuth": "90 deg", "distance": "1 au", "spectrum": "1000 W m-2 um-1"}}
    plane = [{"plane": {}, "material": "ground"}] if ground is not None else []
    return {"ifov": 1, "seed": seed,
            "scene": {"materials": {"ground": {"reflectance": ground or 0.0}, "black": {"reflectance": 0.0}, "grey": {"reflectance": 0.6}},
                      "objects": plane + list(objects)},
            "light": light, "sensor": {**sensor, "channels": CHANNELS[-1:]}, "sampling": {"accuracy": {"error": error}},
            "output": {"formats": ["envi"]}}


def rectangle(corner, along, across, material):
    """By a corner and the sides from there."""
    corners = [[c + i * a + j * b for c, a, b in zip(corner, along, across)] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return {"polygon": {"vertices": [[f"{c!r} m" for c in at] for at in corners]}, "material": material}


def point(x, y, z, normal=(0, 0, 1)):
    return {"position": [f"{x!r} m", f"{y!r} m", f"{z!r} m"], "normal": list(normal)}


class SingleViews(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def run_program(self, described, *options, command="render"):
        path = self.folder / "scene.json"
        path.write_text(json.dumps(described))
        out = ["--output", self.folder / "out"] if command == "render" else []
        return subprocess.run([PROGRAM, command, path, *out, *options], check=False, capture_output=True, text=True, timeout=200)

    def rows(self, described, *options):
        done = self.run_program(described, *options)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        with (self.folder / "out" / "image_views.csv").open() as file:
            lines = [line for line in file if not line.startswith("#")]
        return [{key: value if key == "channel" else float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def test_lambertian_ground_has_one_reflectance_and_albedo(self):
        directions = [{"zenith": f"{z} deg", "azimuth": f"{a} deg"} for z in (-80, -40, 0, 20, 70) for a in (0, 130)]
        described = document({"distant": {"directions": directions, "size": ["10 m", "20 m"]}})
        described["sensor"]["channels"] = CHANNELS
        rows = self.rows(described)
        self.assertEqual(len(rows), 20)
        for row in rows:
            self.assertAlmostEqual(row["reflectance_factor"], 0.3, delta=1e-6)
            self.assertAlmostEqual(row["radiance"], 0.3 * 1000.0 * math.cos(SUN_ZENITH) / math.pi, delta=1e-3)
            self.assertEqual(row["converged"], 1)
        self.assertEqual({row["channel"] for row in rows}, {"red", "near, infrared"})
        done = self.run_program(document({"hemisphere": {"cells": 3, "size": ["10 m", "20 m"]}}, sky=50))
        self.assertIn("albedo of channel 'near, infrared': 0.3, half-width", done.stdout)

    def test_albedo_under_a_sky_of_rough_ground(self):
        """What an enclosed area sends back is at most what falls on it; of white walls on white ground it is all of it."""
        walls = [rectangle((x, -3, 0), (0, 6, 0), (0, 0, 2), "white") for x in (-2.5, -0.5, 1.5)]
        described = document({"hemisphere": {"cells": 5, "size": ["6 m", "6 m"]}}, walls, sky=100, sun=False, error="2 %")
        described["scene"]["materials"].update({"white": {"reflectance": 1.0}, "ground": {"reflectance": 1.0}})
        described["scene"]["periodic"] = {"size": ["6 m", "6 m"]}
        self.run_program(described)
        record = json.loads((self.folder / "out" / "image_run.json").read_text())
        note = next(note for note in record["notes"] if note.startswith("albedo"))
        value = float(note.split(": ")[1].split(",")[0])
        half_width = float(note.split("half-width ")[1].split(" ")[0])
        self.assertLess(half_width, 0.02)
        self.assertLess(abs(value - 1.0), max(half_width, 1e-6))

    def test_published_view_factors(self):
        """Means over one surface of what its points see of the other; the sky is what is left."""
        with (TRUTH / "analytic" / "analytic_cases.csv").open() as file:
            published = {row["id"]: float(row["expected"]) for row in csv.DictReader(file)}

        def of_disks(r1, r2, height):
            disk = {"disk": {"center": ["0 m", "0 m", f"{height} m"], "normal": [0, 0, 1], "radius": f"{r2} m"}, "material": "black"}
            return disk, [(point(r1 * math.sqrt(u), 0.0, 0.0), w) for u, w in GAUSS_8]

        cases = {"vf_disks_a": of_disks(1.0, 0.5, 0.75), "vf_disks_b": of_disks(0.2, 0.5, 0.5),
                 "vf_rect_1x2": (rectangle((0, 0, 0.5), (1, 0, 0), (0, 2, 0), "black"),
                                 [(point(0.5 * u, v, 0.0), wu * wv) for u, wu in GAUSS_8 for v, wv in GAUSS_8])}
        for name, (obstacle, points) in cases.items():
            rows = self.rows(document({"points": {"at": [at for at, _ in points]}}, [obstacle], sky=100, sun=False, ground=None, error="0.3 %"))
            seen = sum(w * (1.0 - row["sky_view"]) for row, (_, w) in zip(rows, points))
            lit = sum(w * (1.0 - row["irradiance"] / (100.0 * math.pi)) for row, (_, w) in zip(rows, points))
            self.assertAlmostEqual(seen, published[name], delta=5e-4, msg=name)
            self.assertAlmostEqual(lit, published[name], delta=1e-3, msg=name)

    def test_sky_view_of_an_image(self):
        """Below a disc, of which a point on its axis sees r^2 / (r^2 + h^2), and far from it."""
        disk = {"disk": {"center": ["0 m", "0 m", "0.5 m"], "normal": [0, 0, 1], "radius": "0.25 m"}, "material": "black"}
        camera = {"camera": {"orthographic": {"gsd": "0.01 m", "pixels": [1, 1], "height": "0.4 m"}}}
        for center, expected in (("0 m", 0.8), ("400 m", 1.0)):
            camera["camera"]["orthographic"]["center"] = [center, "0 m"]
            described = document(camera, [disk], sky=10)
            described["output"]["products"] = ["sky_view"]
            done = self.run_program(described, "--restart")
            self.assertIn(done.returncode, (0, 5, 6), done.stderr)
            value, half_width = struct.unpack("<2f", (self.folder / "out" / "image_sky_view.img").read_bytes())
            self.assertLess(abs(value - expected), half_width + 1e-6)
            self.assertLess(half_width, 0.0031)

    def test_points_in_the_sun_and_out_of_it(self):
        roof = rectangle((9, -1, 1), (2, 0, 0), (0, 2, 0), "black")
        shade = 10.0 - math.tan(SUN_ZENITH)  # of the roof's middle
        points = [point(0, 0, 0), point(0, 0, 5, (1, 0, 0)), point(0, 0, 5, (-1, 0, 0)), point(shade, 0, 0),
                  point(0, 0, 5, (math.sin(SUN_ZENITH), 0, math.cos(SUN_ZENITH)))]
        rows = self.rows(document({"points": {"at": points}}, [roof], ground=0.0))
        expected = [math.cos(SUN_ZENITH), math.sin(SUN_ZENITH), 0.0, 0.0, 1.0]
        for row, share in zip(rows, expected):
            self.assertLess(abs(row["irradiance"] - 1000.0 * share), max(row["half_width"], 1e-6))
            self.assertLess(row["half_width"], 0.005 * max(row["irradiance"], 1000.0 * share) + 1.0)

    def test_half_of_the_disc_behind_an_edge(self):
        """The Sun's middle just above, on and below a far edge: the share of a disc beyond a chord."""
        half_angle = 0.00465047  # of the Sun at 1 au, rad
        high = 100.0
        reach = high * math.tan(SUN_ZENITH)
        wall = rectangle((reach, -500, high), (500, 0, 0), (0, 1000, 0), "black")  # hides what lies beyond the edge
        scale = high / math.cos(SUN_ZENITH) ** 2
        shares = (-0.5, 0.0, 0.6)
        points = [point(-s * half_angle * scale, 0, 0) for s in shares]
        described = document({"points": {"at": points}}, [wall], ground=0.0)
        described["light"]["sun"] = {"disc": described["light"]["sun"]["point"]}
        rows = self.rows(described)
        for row, s in zip(rows, shares):
            free = 0.5 + (math.asin(s) + s * math.sqrt(1.0 - s * s)) / math.pi
            self.assertLess(abs(row["irradiance"] / (1000.0 * math.cos(SUN_ZENITH)) - free), 0.01)

    def test_sunlight_by_mirrors_and_panes_is_in_the_interval(self):
        def screen(material):
            described = document({"points": {"at": [point(0, 0, 0), point(-50, 0, 0, (-1, 0, 0))]}}, [rectangle((2, -3, 0), (0, 6, 0), (0, 0, 4), "screen")],
                                 ground=0.0)
            described["scene"]["materials"]["screen"] = material
            return described

        mirror = screen({"reflectance": 0.8, "scattering": "mirror"})
        mirror["light"]["sun"]["point"]["azimuth"] = "270 deg"
        both = 1000.0 * math.cos(SUN_ZENITH) * 1.8
        before, away = self.rows(mirror)
        self.assertLess(abs(before["irradiance"] - both), before["half_width"])
        self.assertEqual((before["converged"], away["converged"]), (0, 1))
        pane = self.rows(screen({"reflectance": 1.0, "scattering": {"slab": {"n": 1.5, "k": 0, "thickness": "5 mm"}}}))[0]
        self.assertGreater(pane["irradiance"] + pane["half_width"], 1000.0 * math.cos(SUN_ZENITH) * 0.95)
        self.assertEqual(pane["converged"], 0)

    def test_looking_at_the_sky_alone_is_no_warning(self):
        done = self.run_program(document({"points": {"at": [point(0, 0, 1)]}}, sky=10))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_rays(self):
        (self.folder / "rays.csv").write_text("# lines of sight\nx_m,y_m,z_m,dx,dy,dz\n0,0,5,0,0,-2\n1,2,5,1,0,-1\n0,0,5,1,0,1\n")
        rows = self.rows(document({"rays": {"file": "rays.csv"}}, sky=7))
        ground = 0.3 * (1000.0 * math.cos(SUN_ZENITH) / math.pi + 7.0)
        for row, radiance in zip(rows, (ground, ground, 7.0)):
            self.assertLess(abs(row["radiance"] - radiance), max(row["half_width"], 1e-5 * radiance))
        self.assertAlmostEqual(rows[1]["dx"], math.sqrt(0.5), delta=1e-9)

    def test_intervals_hold(self):
        """The same direction and the same point many times over, each with random numbers of its own, against one result at a
        far tighter accuracy."""
        boxes = [{"box": {"low": [f"{x - 0.7} m", f"{y - 0.5} m", "0 m"], "high": [f"{x + 0.7} m", f"{y + 0.5} m", f"{1 + 0.3 * k} m"]},
                  "material": "grey"} for k, (x, y) in enumerate(((-3, -2), (0, 2.5), (2.8, -2.2), (-2.5, 3), (3, 1.5)))]
        kinds = {"radiance": ({"distant": {"directions": [{"zenith": "40 deg", "azimuth": "200 deg"}], "size": ["10 m", "10 m"]}}, "directions"),
                 "irradiance": ({"points": {"at": [point(-1.2, 0.3, 0.0)]}}, "at")}
        held, narrow, count = 0, 0, 0
        for name, (sensor, key) in kinds.items():
            truth = self.rows(document(sensor, boxes, sky=120, error="0.3 %", seed=99))[0]
            views = next(iter(sensor.values()))
            views[key] = views[key] * 150
            for row in self.rows(document(sensor, boxes, sky=120, error="4 %")):
                off = abs(row[name] - truth[name])
                held += off <= row["half_width"]
                narrow += off <= 0.45 * row["half_width"]
                count += 1
        self.assertGreaterEqual(held / count, 0.93)
        self.assertLess(narrow / count, 0.93)  # the same test of intervals less than half as wide

    def test_same_bytes_with_any_threads_and_when_resumed(self):
        box = {"box": {"low": ["-1 m", "-1 m", "0 m"], "high": ["1 m", "1 m", "2 m"]}, "material": "grey"}
        described = document({"hemisphere": {"cells": 3, "size": ["8 m", "8 m"]}}, [box], sky=100, error="1 %")
        first = self.rows(described, "--threads", "1")
        self.assertEqual(self.rows(described, "--threads", "2"), first)
        done = self.run_program(described, "--time-limit", "1 s", "--restart")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(self.rows(described, "--resume"), first)
        for share in ("1/2", "2/2"):
            done = subprocess.run([PROGRAM, "render", self.folder / "scene.json", "--tiles", share], check=False, capture_output=True, text=True)
            self.assertIn(done.returncode, (0, 6), done.stderr)
        parts = sorted(path for path in self.folder.iterdir() if path.is_dir() and path.name != "out")
        done = subprocess.run([PROGRAM, "merge", *parts, "--output", self.folder / "merged"], check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "merged" / "image_views.csv").read_text(), (self.folder / "out" / "image_views.csv").read_text())
        status = subprocess.run([PROGRAM, "status", self.folder / "out"], capture_output=True, text=True, check=False)
        self.assertEqual(status.returncode, 0, status.stderr)

    def test_netcdf_holds_what_the_table_does(self):
        described = document({"points": {"at": [point(0, 0, 0), point(1, 2, 3, (0, 1, 0))]}}, sky=10)
        rows = self.rows(described)
        from osgeo import gdal  # pylint: disable=import-outside-toplevel

        gdal.UseExceptions()
        for name in ("irradiance", "half_width", "standard_error"):
            read = gdal.Open(f'NETCDF:"{self.folder / "out" / "image_views.nc"}":{name}').ReadAsArray().ravel().tolist()
            # GDAL takes the first dimension for lines from the bottom up.
            for value, found in zip(sorted(row[name] for row in rows), sorted(read)):
                self.assertAlmostEqual(value, found, delta=1e-5 * value)

    def test_messages(self):
        distant = {"directions": [{"zenith": "0 deg"}], "size": ["1 m", "1 m"]}
        cases = [
            ({"distant": {"directions": [{"zenith": "0 deg"}]}}, {},
             "the scene is not periodic, so that nothing says how large the area is: expected 'size', its extent from west to east and "
             "from south to north"),
            ({"distant": distant, "psf": {"gaussian": {"sigma": "1 px"}}}, {}, "'psf' is of the pixels of a picture, and 'distant' makes none"),
            ({"distant": distant, "rays": {"file": "r.csv"}}, {},
             "'rays' cannot stand beside 'distant': 'sensor' takes only one of 'camera', 'distant', 'hemisphere', 'points' or 'rays'"),
            ({}, {}, "'sensor' needs exactly one of 'camera', 'distant', 'hemisphere', 'points' or 'rays'"),
            ({"distant": distant}, {"sampling": {"accuracy": {"of": "image"}}},
             "\"of\": \"image\" is of the pixels of a picture together, and 'distant' makes none: each of its views has an error of its own"),
            ({"points": {"at": [point(0, 0, 0)]}}, {"atmosphere": {"profile": "tropical"}},
             "'points' begins within the scene and looks to all sides, and the air of an atmosphere is worked out along lines of sight "
             "from above: leave 'atmosphere' out, and give the light at the ground by 'light.sun' and 'light.sky'"),
            ({"distant": {**distant, "directions": [{"zenith": "10 deg"}, {"zenith": "85 deg"}]}}, {"atmosphere": {"profile": "tropical"}},
             "under a modelled atmosphere the light of an area is told up to 80 degrees from the vertical; view 1 of 'distant' is 85.0 "
             "degrees away"),
        ]
        for sensor, more, message in cases:
            described = {**document(sensor), **more}
            if "atmosphere" in more:
                described["light"] = {"sun": {"disc": {"zenith": "30 deg", "azimuth": "90 deg"}}}
                described["scene"]["origin"] = {"latitude": "50 deg", "longitude": "5 deg"}
                described["time"] = "2026-06-01T10:00:00Z"
            done = self.run_program(described, command="check")
            self.assertEqual(done.returncode, 1, message)
            self.assertRegex(done.stderr.splitlines()[0], r"scene\.json:1:\d+: ", message)
            self.assertIn(message, done.stderr.splitlines()[0])

    def test_messages_of_tables(self):
        heading = "view_zenith_deg,view_azimuth_deg\n"
        cases = [("", "angles.csv: found an empty file; expected a table of views"),
                 (heading, "angles.csv: found a heading without rows; expected one row at least"),
                 (heading + "95,0\n", "angles.csv:2:1: found 95 as 'view_zenith_deg'; expected -89 to 89"),
                 (heading + "5,north\n", "angles.csv:2:3: found 'north' as 'view_azimuth_deg'; expected a number"),
                 (heading + "5\n", "angles.csv:2: found 1 values; expected 2, as the heading has"),
                 ("view_zenith_deg\n5\n", "angles.csv:1: the table has no column 'view_azimuth_deg'"),
                 ("view_zenith,view_azimuth_deg\n5,1\n",
                  "angles.csv:1:1: found the heading 'view_zenith'; expected 'view_zenith_deg' or 'view_azimuth_deg'")]
        for text, message in cases:
            (self.folder / "angles.csv").write_text(text)
            done = self.run_program(document({"distant": {"file": "angles.csv", "size": ["1 m", "1 m"]}}), command="check")
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)

    @unittest.skipUnless((TRUTH / "rami" / "het01").is_dir(), f"reference data not found: {TRUTH}/rami/het01")
    def test_published_canopy_in_one_run(self):
        data = TRUTH / "rami" / "het01"
        subprocess.run([SOURCE / "examples" / "rami" / "make_scene.py", data, self.folder, "--one", "-61", "-1", "41"], check=True)
        with (data / "expected_brf.csv").open() as file:
            published = {float(row["view_zenith_deg"]): float(row["brf"]) for row in csv.DictReader(file)}
        described = json.loads((self.folder / "het01.json").read_text())
        described["sampling"]["accuracy"]["error"] = "2.5 %"
        for row in self.rows(described):
            expected = published[row["view_zenith_deg"]]
            self.assertLess(row["reflectance_half_width"], 0.025 * expected * 1.03)
            self.assertLess(abs(row["reflectance_factor"] - expected), row["reflectance_half_width"] + 0.01 * expected)


if __name__ == "__main__":
    unittest.main()
