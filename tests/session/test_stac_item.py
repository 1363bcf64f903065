"""The STAC item that a run writes beside its products: by the rules of STAC 1.0.0 and of the extensions that it names, and what it says against
geometry worked out here, against GDAL, and against what Python makes of the same run."""

import copy
import datetime
import hashlib
import json
import math
import pathlib
import re
import tempfile
import unittest

from images import np, run

try:
    from osgeo import gdal, osr
except ImportError:
    gdal = None

EXTENSIONS = {"eo": "v1.1.0", "file": "v2.1.0", "processing": "v1.1.0", "projection": "v1.1.0", "view": "v1.0.0"}
WIDTH, LINES = 40, 50
LATITUDE, LONGITUDE = 51.99, 4.37


def document(camera, formats=("envi", "png", "html", "stac"), products=("half_width", "location"), **more):
    made = {"ifov": 1, "time": "2026-06-21T10:00:00Z",
            "scene": {"origin": {"latitude": f"{LATITUDE} deg", "longitude": f"{LONGITUDE} deg"},
                      "materials": {"ground": {"reflectance": 0.1}, "roof": {"reflectance": 0.6}},
                      "objects": [{"plane": {}, "material": "ground"},
                                  {"box": {"low": ["-9 m", "-6 m", "0 m"], "high": ["5 m", "7 m", "0.01 m"]}, "material": "roof"}]},
            "light": {"sun": {"disc": {}}},
            "sensor": {"camera": camera,
                       "channels": [{"name": "red", "top_hat": {"from": "0.65 um", "to": "0.7 um"}},
                                    {"name": "nir", "gaussian": {"center": "0.85 um", "fwhm": "60 nm"}}]},
            "sampling": {"accuracy": {"error": "20 %"}}, "output": {"formats": list(formats), "products": list(products)}}
    made.update(more)
    return made


SCANNER = {"pushbroom": {"pixels": [WIDTH, LINES], "focal_length": "20 mm", "pitch": "0.1 mm", "line_period": "12.5 ms"}}
FLIGHT = {"straight": {"frame": "scene", "position": ["-4 m", "-14 m", "100 m"], "velocity": ["9 m/s", "39 m/s", "0 m/s"]}}
FRAME = {"frame": {"focal_length": "20 mm", "pitch": "0.1 mm", "pixels": [WIDTH, 30], "position": ["0 m", "-100 m", "100 m"],
                   "look_at": ["0 m", "0 m", "0 m"], "up": [0, 0, 1]}}
MAP = {"orthographic": {"gsd": "0.5 m", "pixels": [WIDTH, 30]}}


def faults_of(item):
    """What of an item is against item.json of STAC 1.0.0, GeoJSON, or the schemas of the extensions."""
    faults = []

    def need(holds, what):
        if not holds:
            faults.append(what)

    def is_number(value, low=-math.inf, high=math.inf):
        return isinstance(value, (int, float)) and not isinstance(value, bool) and low <= value <= high

    def is_time(value):
        return isinstance(value, str) and re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z", value) is not None

    for key in ("type", "stac_version", "id", "geometry", "properties", "links", "assets"):
        need(key in item, f"{key} is missing")
    need(item.get("type") == "Feature", "type")
    need(item.get("stac_version") == "1.0.0", "stac_version")
    need(isinstance(item.get("id"), str) and item["id"] != "", "id")
    need(isinstance(item.get("links"), list), "links")
    extensions = item.get("stac_extensions", [])
    need(len(set(extensions)) == len(extensions), "stac_extensions are named twice")
    for link in extensions:
        found = re.fullmatch(r"https://stac-extensions\.github\.io/(\w+)/(v[\d.]+)/schema\.json", link)
        need(found is not None and EXTENSIONS.get(found.group(1)) == found.group(2), f"stac_extensions: {link}")

    def ring(places):
        need(len(places) >= 4 and places[0] == places[-1], "a ring is not closed")
        need(all(len(place) == 2 and is_number(place[0], -180, 180) and is_number(place[1], -90, 90) for place in places), "places")
        need(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(places, places[1:])) > 0, "a ring is not counter-clockwise")

    geometry = item.get("geometry")
    if geometry is None:
        need("bbox" not in item, "bbox without geometry")
    else:
        need(geometry.get("type") in ("Polygon", "MultiPolygon"), "geometry.type")
        for polygon in [geometry["coordinates"]] if geometry["type"] == "Polygon" else geometry["coordinates"]:
            for places in polygon:
                ring(places)
        need(len(item.get("bbox", ())) == 4 and all(map(is_number, item["bbox"])) and item["bbox"][1] <= item["bbox"][3], "bbox")
    properties = item.get("properties", {})
    if properties.get("datetime", 0) is None:
        need(is_time(properties.get("start_datetime")) and is_time(properties.get("end_datetime")), "neither datetime nor its range")
    else:
        need(is_time(properties.get("datetime")), "datetime")
    need(("start_datetime" in properties) == ("end_datetime" in properties), "half of a range of times")
    for key in ("start_datetime", "end_datetime"):
        need(is_time(properties.get(key, "2000-01-01T00:00:00Z")), key)
    need(is_number(properties.get("gsd", 1)) and properties.get("gsd", 1) > 0, "gsd")
    prefixes = {"proj": "projection", "view": "view", "eo": "eo", "file": "file", "processing": "processing"}
    for key in [*properties, *(key for asset in item["assets"].values() for key in asset)]:
        prefix = key.partition(":")[0]
        if ":" in key and prefix in prefixes:
            need(any(f"/{prefixes[prefix]}/" in link for link in extensions), f"{key}: its extension is not named")
    if any("/projection/" in link for link in extensions):
        need(properties.get("proj:epsg", "") is None or isinstance(properties.get("proj:epsg"), int), "proj:epsg")
        need(len(properties["proj:shape"]) == 2 and all(isinstance(n, int) for n in properties["proj:shape"]), "proj:shape")
        need(len(properties.get("proj:transform", range(6))) == 6, "proj:transform")
        need(isinstance(properties.get("proj:wkt2", ""), str), "proj:wkt2")
    view = {"view:off_nadir": (0, 90), "view:incidence_angle": (0, 90), "view:azimuth": (0, 360), "view:sun_azimuth": (0, 360),
            "view:sun_elevation": (-90, 90)}
    if any("/view/" in link for link in extensions):
        need(any(key in properties for key in view), "the view extension without a field")
    for key, (low, high) in view.items():
        need(is_number(properties.get(key, low), low, high), key)
    software = properties.get("processing:software", {})
    need(isinstance(software, dict) and all(isinstance(version, str) for version in software.values()), "processing:software")
    for key, asset in item.get("assets", {}).items():
        need(isinstance(asset.get("href"), str) and asset["href"] != "", f"{key}: href")
        for field in ("title", "type", "description"):
            need(isinstance(asset.get(field, ""), str), f"{key}: {field}")
        need(all(isinstance(role, str) for role in asset.get("roles", [])), f"{key}: roles")
        need(re.fullmatch("[a-f0-9]+", asset.get("file:checksum", "0")) is not None, f"{key}: file:checksum")
        need(isinstance(asset.get("file:size", 0), int), f"{key}: file:size")
        for band in asset.get("eo:bands", [{"name": ""}]):
            need(isinstance(band.get("name"), str) and all(is_number(band.get(field, 1)) for field in ("center_wavelength", "full_width_half_max")),
                 f"{key}: eo:bands")
        need(asset.get("eo:bands", [0]) != [], f"{key}: no bands")
    return faults


class StacItem(unittest.TestCase):
    def item_of(self, described, folder):
        done = run(described, folder)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        item = json.loads((folder / "out" / "image_stac.json").read_text(encoding="utf-8"))
        self.assertEqual(faults_of(item), [])
        self.expect_files(item, folder / "out")
        return item

    def expect_files(self, item, out):
        """Every product is an asset, with its size and sum, and nothing else is."""
        links = {asset["href"].removeprefix("./") for asset in item["assets"].values()}
        self.assertEqual(links | {"image_stac.json"}, {path.name for path in out.iterdir()})
        for key, asset in item["assets"].items():
            content = (out / asset["href"]).read_bytes()
            if key != "run" and not key.endswith("_header"):
                self.assertEqual(asset["file:size"], len(content))
                self.assertEqual(asset["file:checksum"], "1220" + hashlib.sha256(content).hexdigest())
        self.assertEqual([band["name"] for band in item["assets"]["radiance"]["eo:bands"]], ["red", "nir"])
        # 0.7 - 0.65 is 0.04999999999999993 in doubles.
        self.assertEqual(item["assets"]["radiance"]["eo:bands"][0], {"name": "red", "center_wavelength": 0.675, "full_width_half_max": 0.05})
        self.assertEqual(item["assets"]["radiance"]["eo:bands"][1], {"name": "nir", "center_wavelength": 0.85, "full_width_half_max": 0.06})
        self.assertNotIn("eo:bands", item["assets"]["location"])
        self.assertEqual(item["assets"]["half_width"]["roles"], ["data", "uncertainty"])
        listed = json.loads((out / "image_run.json").read_text(encoding="utf-8"))["files"]
        self.assertIn("image_stac.json", [file["name"] for file in listed])

    def metres(self, places):
        """Of longitudes and latitudes, east and north of the scene's origin, by WGS 84's radii of curvature there."""
        a, e2, phi = 6378137.0, 0.00669437999014, math.radians(LATITUDE)
        w = math.sqrt(1 - e2 * math.sin(phi) ** 2)
        return [(math.radians(x - LONGITUDE) * a / w * math.cos(phi), math.radians(y - LATITUDE) * a * (1 - e2) / w**3) for x, y in places]

    @staticmethod
    def area(places):
        return 0.5 * sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(places, places[1:] + places[:1]))

    def test_a_scanner(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            item = self.item_of(document(SCANNER, platform=FLIGHT), folder)
            properties = item["properties"]
            # Lines are 12.5 ms apart, the first one's middle half of that after the document's time.
            self.assertEqual(properties["start_datetime"], "2026-06-21T10:00:00.006Z")
            self.assertEqual(properties["end_datetime"], "2026-06-21T10:00:00.619Z")
            self.assertIn(properties["datetime"], ("2026-06-21T10:00:00.312Z", "2026-06-21T10:00:00.313Z"))
            self.assertIsNone(properties["proj:epsg"])
            self.assertEqual(properties["proj:shape"], [LINES, WIDTH])
            self.assertNotIn("proj:transform", properties)
            self.assertLess(properties["view:off_nadir"], 0.01)
            self.assertAlmostEqual(properties["gsd"], 0.5, 2)
            # Delft at the solstice: the Sun's declination is 23.43 deg, and at 10 h UTC and 4.37 deg east, with an equation of time of
            # -1.8 min, it stands 26.1 deg before the meridian.
            latitude, declination, hour = (math.radians(angle) for angle in (LATITUDE, 23.43, 26.1))
            high = math.sin(latitude) * math.sin(declination) + math.cos(latitude) * math.cos(declination) * math.cos(hour)
            self.assertAlmostEqual(properties["view:sun_elevation"], math.degrees(math.asin(high)), delta=0.1)
            # The outline goes around the middles of pixels: 39 x 0.5 m across a track of 49 lines, (9, 39) m/s x 12.5 ms apart.
            places = self.metres(item["geometry"]["coordinates"][0][:-1])
            self.assertAlmostEqual(self.area(places), 39 * 0.5 * 49 * math.hypot(9, 39) * 0.0125, delta=0.5)
            self.assertAlmostEqual(sum(x for x, _ in places) / len(places), -4 + 9 * 0.3125, delta=0.3)
            self.assertAlmostEqual(sum(y for _, y in places) / len(places), -14 + 39 * 0.3125, delta=0.3)
            west, south, east, north = item["bbox"]
            self.assertTrue(all(west <= x <= east and south <= y <= north for x, y in item["geometry"]["coordinates"][0]))
            self.assertEqual(item["id"], "scene_out")
            self.expect_python_to_agree(item, folder / "out")

    def expect_python_to_agree(self, item, out):
        try:
            import ifov
        except ImportError:
            return
        mine = ifov.load(out).ifov.to_stac(assets={"radiance": "./image_radiance.img", "location": "./image_location.img"})
        self.assertEqual(faults_of(mine), [])
        self.assertEqual(mine["properties"].keys(), item["properties"].keys())
        for key, value in item["properties"].items():
            if isinstance(value, float):
                self.assertAlmostEqual(mine["properties"][key], value, 9, key)
            else:
                self.assertEqual(mine["properties"][key], value, key)
        for key in ("radiance", "location"):
            self.assertEqual({**mine["assets"][key], "title": ""},
                             {**{field: value for field, value in item["assets"][key].items() if not field.startswith("file:")}, "title": ""})

    def test_a_frame_that_looks_aslant(self):
        with tempfile.TemporaryDirectory() as scratch:
            item = self.item_of(document(FRAME), pathlib.Path(scratch))
        properties = item["properties"]
        self.assertEqual(properties["datetime"], "2026-06-21T10:00:00.000Z")
        self.assertNotIn("start_datetime", properties)
        self.assertAlmostEqual(properties["view:off_nadir"], 45, delta=0.002)  # 100 m are 0.0009 deg around the Earth
        self.assertAlmostEqual(properties["view:incidence_angle"], 45, 6)
        self.assertAlmostEqual(properties["view:azimuth"], 180, 6)  # the camera stands to the south
        # Rays of the outermost pixels' middles, 19.5 and 14.5 pixels of 0.1 mm from the axis of 20 mm, to the ground 100 m below.
        corners = []
        for x, y in ((-19.5, -14.5), (19.5, -14.5), (19.5, 14.5), (-19.5, 14.5)):
            right, down = x * 0.1 / 20, y * 0.1 / 20
            north, fall = (1 + down * -1) / math.sqrt(2), (1 + down) / math.sqrt(2)
            corners.append((right / fall * 100, -100 + north / fall * 100))
        self.assertAlmostEqual(abs(self.area(corners)), self.area(self.metres(item["geometry"]["coordinates"][0][:-1])), delta=1.0)

    @unittest.skipIf(gdal is None, "GDAL is missing")
    def test_a_map(self):
        gdal.UseExceptions()
        described = document(MAP)
        described["light"] = {"sun": {"disc": {"zenith": "35 deg", "azimuth": "135 deg"}}}
        described["scene"]["origin"] = {"crs": "EPSG:32631", "easting": "594000 m", "northing": "5760000 m", "height": "0 m"}
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            item = self.item_of(described, folder)
            image = gdal.Open(str(folder / "out" / "image_radiance.img"))
            g = image.GetGeoTransform()
            self.expect_python_to_agree(item, folder / "out")
        properties = item["properties"]
        self.assertEqual(properties["proj:epsg"], 32631)
        self.assertEqual(properties["proj:transform"], [g[1], g[2], g[0], g[4], g[5], g[3]])
        self.assertEqual(properties["proj:shape"], [30, WIDTH])
        system, degrees = osr.SpatialReference(), osr.SpatialReference()
        system.ImportFromEPSG(32631), degrees.ImportFromEPSG(4326)
        for each in (system, degrees):
            each.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        to_degrees = osr.CoordinateTransformation(system, degrees)
        corners = [to_degrees.TransformPoint(g[0] + c * g[1], g[3] + r * g[5])[:2] for c, r in ((0, 0), (0, 30), (WIDTH, 30), (WIDTH, 0))]
        ring = item["geometry"]["coordinates"][0]
        self.assertEqual(len(ring), 5)
        for corner in corners:
            self.assertLess(min(math.dist(corner, place) for place in ring), 1e-9)
        self.assertAlmostEqual(properties["gsd"], 0.5)

    def test_without_a_place_or_a_time(self):
        described = document(MAP, ("envi", "stac"))
        del described["time"], described["scene"]["origin"]
        described["light"] = {"sky": {"radiance": "40 W m-2 sr-1 um-1"}}
        with tempfile.TemporaryDirectory() as scratch:
            item = self.item_of(described, pathlib.Path(scratch))
            made = json.loads((pathlib.Path(scratch) / "out" / "image_run.json").read_text())["date"]
        self.assertIsNone(item["geometry"])
        self.assertEqual(item["properties"]["datetime"], made)
        self.assertEqual(item["properties"]["view:off_nadir"], 0)
        self.assertNotIn("view:sun_azimuth", item["properties"])
        self.assertLess(abs(datetime.datetime.fromisoformat(made.replace("Z", "+00:00")) - datetime.datetime.now(datetime.timezone.utc)),
                        datetime.timedelta(minutes=10))

    def test_planted_faults_are_found(self):
        with tempfile.TemporaryDirectory() as scratch:
            item = self.item_of(document(MAP, ("envi", "stac")), pathlib.Path(scratch))
        for spoil in (lambda i: i.pop("bbox"), lambda i: i.pop("links"), lambda i: i["properties"].update(datetime="2026-06-21"),
                      lambda i: i["properties"].update({"view:off_nadir": -1}), lambda i: i["geometry"]["coordinates"][0].reverse(),
                      lambda i: i["geometry"]["coordinates"][0].pop(), lambda i: i["properties"].pop("proj:epsg"),
                      lambda i: i["assets"]["radiance"].pop("href"), lambda i: i["assets"]["radiance"]["eo:bands"].clear(),
                      lambda i: i["stac_extensions"].pop(), lambda i: i.update(stac_version="1.0")):
            spoiled = copy.deepcopy(item)
            spoil(spoiled)
            self.assertNotEqual(faults_of(spoiled), [])


if __name__ == "__main__":
    unittest.main()
