"""Frame cameras that fly on orbits, on mounts and with a pose that is reported: where pixels look, against what is worked out here."""

import json
import math
import pathlib
import tempfile
import unittest

from images import np, run

PIXELS, STEP = 8, 2e-3  # pitch over focal length
FRAME = {"focal_length": "50 mm", "pitch": f"{50 * STEP} mm", "pixels": [PIXELS, PIXELS]}

# Vallado et al. (2006), SGP4-VER.TLE and tcppver.out: CBERS 2, 120 minutes after its epoch, TEME, km and km/s.
ELEMENTS = ("1 28057U 03049A   06177.78615833  .00000060  00000-0  35940-4 0  1836\n"
            "2 28057  98.4283 247.6961 0000884  88.1964 271.9322 14.35478080140550\n")
TIME, JULIAN_DAY = "2006-06-26T20:52:04.079709Z", 2453913.0 + (8 * 3600 + 52 * 60 + 4.079709) / 86400
POSITION_KM, VELOCITY_KM_S = (-1816.87920942, -1835.78762132, 6661.07926465), (2.325140071, 6.655669329, 2.463394512)


def document(frame, platform, **more):
    return {"ifov": 1, "scene": {"materials": {"lawn": {"reflectance": 0.2}}, "objects": [{"plane": {}, "material": "lawn"}], **more.pop("scene", {})},
            "light": {"sky": {"radiance": "40 W m-2 sr-1 um-1"}}, "platform": platform,
            "sensor": {"camera": {"frame": {**FRAME, **frame}}, "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
            "sampling": {"accuracy": {"error": "2 %"}}, "output": {"products": ["radiance", "location", "true_location"]}, **more}


def rendered(written):
    """Radiance as it is written, places and true places as [east or north][row][column], and the run's record."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "elements.tle").write_text(ELEMENTS)
        done = run(written, folder)
        if done.returncode not in (0, 6):
            raise RuntimeError(done.stderr)
        places = [np.fromfile(folder / f"out/image_{what}.img", "f8").reshape(PIXELS, 3, PIXELS).transpose(1, 0, 2)[:2] for what in ("location", "true_location")]
        return (folder / "out/image_radiance.img").read_bytes(), *places, json.loads((folder / "out/image_run.json").read_text())


def turned(yaw, pitch, roll):
    """Of a body's nose, right wing and belly, degrees: about the belly, then the right wing, then the nose."""
    (cy, sy), (cp, sp), (cr, sr) = ((math.cos(math.radians(a)), math.sin(math.radians(a))) for a in (yaw, pitch, roll))
    return (np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]) @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]) @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]]))


def transverse_mercator(latitude_deg, longitude_deg, origin_deg, scale=1.0, ellipsoid=(6378137.0, 1 / 298.257223563)):
    """Easting and northing by Krueger's series (1912) to the fourth order: within 1 mm."""
    a, f = ellipsoid
    n, e = f / (2 - f), math.sqrt(f * (2 - f))
    radius = a / (1 + n) * (1 + n * n / 4 + n ** 4 / 64)
    terms = (n / 2 - 2 * n ** 2 / 3 + 5 * n ** 3 / 16 + 41 * n ** 4 / 180, 13 * n ** 2 / 48 - 3 * n ** 3 / 5 + 557 * n ** 4 / 1440,
             61 * n ** 3 / 240 - 103 * n ** 4 / 140, 49561 * n ** 4 / 161280)

    def plane(latitude, away):
        t = math.sinh(math.atanh(math.sin(latitude)) - e * math.atanh(e * math.sin(latitude)))
        xi, eta = math.atan2(t, math.cos(away)), math.asinh(math.sin(away) / math.hypot(t, math.cos(away)))
        return (eta + sum(c * math.cos(2 * k * xi) * math.sinh(2 * k * eta) for k, c in enumerate(terms, 1)),
                xi + sum(c * math.sin(2 * k * xi) * math.cosh(2 * k * eta) for k, c in enumerate(terms, 1)))

    latitude, longitude, south, west = map(math.radians, (latitude_deg, longitude_deg, *origin_deg))
    (x, y), (_, zero) = plane(latitude, longitude - west), plane(south, 0.0)
    return scale * radius * x, scale * radius * (y - zero)


def seen(position_m, heading_deg, body_from_camera=np.eye(3), lever_m=(0, 0, 0), rows_m=None):
    """Where the middles of pixels meet level ground, of a body that flies level; `rows_m`: by row, how far it is from there along its nose."""
    h = math.radians(heading_deg)
    enu_from_body = np.array([[math.sin(h), math.cos(h), 0], [math.cos(h), -math.sin(h), 0], [0, 0, -1]])
    places = np.zeros((2, PIXELS, PIXELS))
    for row in range(PIXELS):
        along = rows_m[row] if rows_m is not None else 0.0
        origin = np.array(position_m) + enu_from_body @ (np.array(lever_m) + [along, 0, 0])
        for column in range(PIXELS):
            camera = np.array([-(row + 0.5 - PIXELS / 2) * STEP, (column + 0.5 - PIXELS / 2) * STEP, 1.0])
            ray = enu_from_body @ body_from_camera @ camera
            places[:, row, column] = (origin - origin[2] / ray[2] * ray)[:2]
    return places


def over_the_earth(position_km=POSITION_KM, velocity_km_s=VELOCITY_KM_S, after_s=0.0):
    """Latitude, longitude and height by WGS 84, metres and degrees, and the heading over the ground, degrees: by mean sidereal time of 1982."""
    t = (JULIAN_DAY - 2451545.0 + after_s / 86400) / 36525
    seconds = 67310.54841 + (876600 * 3600 + 8640184.812866) * t + 0.093104 * t * t - 6.2e-6 * t**3
    g = math.radians((seconds / 240) % 360)
    turn = np.array([[math.cos(g), math.sin(g), 0], [-math.sin(g), math.cos(g), 0], [0, 0, 1]])
    r, v = turn @ position_km * 1e3, turn @ velocity_km_s * 1e3
    v = v - np.cross([0, 0, 7.29211514670698e-5], r)
    a, e2 = 6378137.0, 6.69437999014e-3
    longitude, p, latitude = math.atan2(r[1], r[0]), math.hypot(r[0], r[1]), math.atan2(r[2], math.hypot(r[0], r[1]))
    for _ in range(20):
        n = a / math.sqrt(1 - e2 * math.sin(latitude)**2)
        latitude = math.atan2(r[2] + e2 * n * math.sin(latitude), p)
    height = p * math.cos(latitude) + r[2] * math.sin(latitude) - a * math.sqrt(1 - e2 * math.sin(latitude)**2)
    east = [-math.sin(longitude), math.cos(longitude), 0]
    north = [-math.sin(latitude) * math.cos(longitude), -math.sin(latitude) * math.sin(longitude), math.cos(latitude)]
    return math.degrees(latitude), math.degrees(longitude), height, math.degrees(math.atan2(v @ east, v @ north)), math.hypot(v @ east, v @ north)


def fallen(seconds, j3=-2.5324105e-6):
    """TEME position and velocity (km, km/s) so long after POSITION_KM, by SciPy: the slope, taken by differences, of the potential of a mass and its zonal harmonics."""
    from scipy.integrate import solve_ivp

    def potential(r):
        away = np.linalg.norm(r)
        u, q = r[2] / away, 6378.1363 / away
        return 398600.4415 / away * -(1.0826261739e-3 * q**2 * (3 * u * u - 1) / 2 + j3 * q**3 * (5 * u**3 - 3 * u) / 2
                                      - 1.6198976e-6 * q**4 * (35 * u**4 - 30 * u * u + 3) / 8)

    def slope(_, state):
        r, h = state[:3], 0.5
        bent = [(8 * (potential(r + h * e) - potential(r - h * e)) - potential(r + 2 * h * e) + potential(r - 2 * h * e)) / (12 * h) for e in np.eye(3)]
        return [*state[3:], *(-398600.4415 * r / np.linalg.norm(r)**3 + bent)]

    state = solve_ivp(slope, (0, seconds), (*POSITION_KM, *VELOCITY_KM_S), "DOP853", rtol=1e-11, atol=1e-9).y[:, -1]
    return state[:3], state[3:]


@unittest.skipIf(np is None, "NumPy not found")
class FlownPoses(unittest.TestCase):
    MOST_PX = 0.01

    def test_from_an_orbit(self):
        latitude, longitude, height, heading, speed = over_the_earth()
        scene = {"origin": {"latitude": f"{latitude!r} deg", "longitude": f"{longitude!r} deg"}}
        # 1 m of the ground a pixel, so that it need not bend.
        narrow = {"pitch": f"{50 / height!r} mm"}
        platform = {"orbit": {"frame": "teme", "file": "elements.tle"}}
        expected = seen((0, 0, 1.0 / STEP), heading)
        for frame in ({}, {"exposure": "0.1 ms"}):
            _, places, true, record = rendered(document({**narrow, **frame}, platform, scene=scene, time=TIME))
            self.assertLess(np.abs(places - expected).max(), 0.05)
            self.assertTrue(np.array_equal(places, true))
            camera = record["acquisition"]["camera"]
            at = camera.get("position_m") or camera["lines"][0]["position_m"]
            self.assertLess(np.abs(np.array(at) - [0, 0, height]).max(), 0.05)
        # Planted faults: two hundredths of a millisecond, or the inertial heading.
        self.assertGreater(np.abs(places - seen((0, speed * 2e-5, 1.0 / STEP), heading)).max(), 0.1)
        self.assertGreater(np.abs(places - seen((0, 0, 1.0 / STEP), heading + 3.0)).max(), 0.1)
        # A rolling shutter: each row from where the satellite then is.
        _, places, _, _ = rendered(document({**narrow, "row_period": "0.2 ms"}, platform, scene=scene, time=TIME))
        rows_m = [(row + 0.5 - PIXELS / 2) * 2e-4 * speed * 6371e3 / (6371e3 + height) for row in range(PIXELS)]
        self.assertLess(np.abs(places - seen((0, 0, 1.0 / STEP), heading, rows_m=rows_m)).max(), 0.1)

    def test_from_a_state(self):
        try:
            import scipy  # noqa: F401
        except ImportError:
            self.skipTest("SciPy not found")
        before_s = 1500
        text = lambda vector, unit: [f"{c!r} {unit}" for c in vector]
        state = {"frame": "teme", "position": text(POSITION_KM, "km"), "velocity": text(VELOCITY_KM_S, "km/s"), "epoch": TIME}

        def off_m(when, seconds, state=state, **fault):
            latitude, longitude, height, heading, _ = over_the_earth(*(np.array(c) for c in fallen(seconds, **fault)), seconds)
            scene = {"origin": {"latitude": f"{latitude!r} deg", "longitude": f"{longitude!r} deg"}}
            _, places, _, _ = rendered(document({"pitch": f"{50 / height!r} mm"}, {"orbit": {"state": state}}, scene=scene, time=when))
            return np.abs(places - seen((0, 0, 1.0 / STEP), heading)).max()

        later, earlier = "2006-06-26T21:17:04.079709Z", "2006-06-26T20:27:04.079709Z"
        # TEME, which is kept here, turns by 0.1 arc seconds a day with the nutation: 6 cm in this time.
        self.assertLess(off_m(later, before_s), 0.15)
        self.assertLess(off_m(earlier, -before_s), 0.15)
        self.assertGreater(off_m(later, before_s, j3=2.5324105e-6), 1.0)

    def test_mistaken_elements_are_located(self):
        platform, scene = {"orbit": {"frame": "teme", "file": "elements.tle"}}, {"origin": {"latitude": "70 deg", "longitude": "9 deg"}}
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            for wrong, line in ((ELEMENTS.replace("0  1836", "0  1837"), 1), (ELEMENTS.replace("140550\n", "140551\n"), 2)):
                (folder / "elements.tle").write_text(wrong)
                done = run(document({}, platform, scene=scene, time=TIME), folder, command="check")
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, rf"^scene\.json:\d+:\d+: elements\.tle:{line}: line {line} of the two-line elements ends with the checksum")

    def test_on_a_mount(self):
        mount = {"lever_arm": ["1.5 m", "-0.4 m", "2 m"], "yaw": "5 deg", "pitch": "-3 deg", "roll": "2 deg"}
        platform = {"straight": {"frame": "scene", "position": ["3 m", "1 m", "100 m"], "velocity": ["0 m/s", "40 m/s", "0 m/s"]}, "mount": mount}
        expected = lambda *angles, rows=None: seen((3, 1, 100), 0, turned(*angles), (1.5, -0.4, 2), rows)
        _, places, _, _ = rendered(document({"exposure": "5 ms"}, platform))
        self.assertLess(np.abs(places - expected(5, -3, 2)).max(), 1e-9 * 100)
        self.assertGreater(np.abs(places - expected(-5, -3, 2)).max(), self.MOST_PX * 100 * STEP)
        _, places, _, _ = rendered(document({"row_period": "2 ms"}, platform))
        rows = [(row + 0.5 - PIXELS / 2) * 2e-3 * 40 for row in range(PIXELS)]
        self.assertLess(np.abs(places - expected(5, -3, 2, rows=rows)).max(), 1e-9 * 100)

    def test_on_maps(self):
        """Of zone 31 of UTM, in scenes on that map, on that of the zone beside it, and about a place alone."""
        # IOGP Guidance Note 7-2, example of the transverse Mercator projection: OSGB 1936, 50 deg 30' N, 0 deg 30' E.
        east, north = transverse_mercator(50.5, 0.5, (49.0, -2.0), 0.9996012717, (6377563.396, 1 / 299.32496))
        self.assertAlmostEqual(east + 400000, 577274.99, delta=0.02)
        self.assertAlmostEqual(north - 100000, 69740.50, delta=0.02)

        utm = lambda zone, latitude, longitude: np.add(transverse_mercator(latitude, longitude, (0, 6 * zone - 183), 0.9996), (500000, 0))
        place, origin = (52.003, 5.994), (52.0, 6.0)
        east, north = utm(31, *place)
        path = lambda **more: {"fixed": {"frame": "map", "position": [f"{east:.4f} m", f"{north:.4f} m", "130 m"], **more}}
        points = {"way_points": {"frame": "map", "crs": "EPSG:32631", "points": [
            {"time": f"{t} s", "position": [f"{east:.4f} m", f"{north + 10 * t:.4f} m", "130 m"]} for t in (-1, 1)]}, "attitude": {"from": "north"}}
        written = {"latitude": f"{origin[0]} deg", "longitude": f"{origin[1]} deg", "height": "30 m"}
        on_map = {"crs": "EPSG:32631", **dict(zip(("easting", "northing"), (f"{c:.4f} m" for c in utm(31, *origin))))}
        local = (*transverse_mercator(*place, origin), 100.0)
        most_m = 2e-3  # a digit of coordinates, and the series
        for platform, scene, expected in ((path(), {**written, "crs": "EPSG:32631"}, (*utm(31, *place), 100)), (path(), on_map, (*utm(31, *place), 130)),
                                          (path(crs="EPSG:32631"), {**written, "crs": "EPSG:32632"}, (*utm(32, *place), 100)),
                                          (path(crs="EPSG:32631"), written, local), (points, written, local)):
            with self.subTest(scene=scene):
                _, places, _, _ = rendered(document({}, platform, scene={"origin": scene}))
                self.assertLess(np.abs(places - seen(expected, 0)).max(), most_m)
        # Another zone's coordinates are far away.
        self.assertGreater(np.abs(np.subtract(utm(31, *place), utm(32, *place))).max(), 1e5)
        with tempfile.TemporaryDirectory() as scratch:
            for crs, said in (("EPSG:4326", "'WGS 84' is no map projection, whose coordinates are lengths; longitudes and latitudes are of the frame \"geodetic\""),
                              ("EPSG:1", "'EPSG:1' is no coordinate reference system that PROJ knows")):
                done = run(document({}, path(crs=crs), scene={"origin": written}), pathlib.Path(scratch), command="check")
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, rf"^scene\.json:\d+:\d+: {said}")
                line, column = map(int, done.stderr.split(":")[1:3])
                self.assertTrue((pathlib.Path(scratch) / "scene.json").read_text().splitlines()[line - 1][column - 1:].startswith(f'"{crs}"'))

    def test_places_are_of_the_reported_pose_and_light_of_the_true_one(self):
        platform = {"straight": {"frame": "scene", "position": ["0 m", "0 m", "100 m"], "velocity": ["0 m/s", "40 m/s", "0 m/s"]},
                    "mount": {"lever_arm": ["1 m", "0 m", "2 m"], "roll": "0.5 deg"}}
        told = dict(platform, reported={"position_bias": ["0.7 m", "0 m", "0 m"], "mount": {"lever_arm": ["1 m", "0 m", "2 m"], "roll": "0.4 deg"}})
        for frame in ({}, {"exposure": "5 ms"}, {"row_period": "1 ms"}):
            rows = [(row + 0.5 - PIXELS / 2) * 1e-3 * 40 if "row_period" in frame else 0.0 for row in range(PIXELS)]
            known, reported = (rendered(document(frame, p)) for p in (platform, told))
            self.assertEqual(known[0], reported[0])
            self.assertTrue(np.array_equal(known[2], reported[2]))
            true = seen((0, 0, 100), 0, turned(0, 0, 0.5), (1, 0, 2), rows)
            self.assertLess(np.abs(reported[2] - true).max(), 1e-7)
            self.assertLess(np.abs(reported[1] - seen((0.7, 0, 100), 0, turned(0, 0, 0.4), (1, 0, 2), rows)).max(), 1e-7)
            self.assertGreater(np.abs(reported[1] - true).max(), self.MOST_PX * 100 * STEP)
            camera = reported[3]["acquisition"]["camera"]
            line = camera["lines"][len(camera["lines"]) // 2] if camera.get("lines") else camera
            self.assertAlmostEqual(line["position_m"][0], 0.7, places=2)


if __name__ == "__main__":
    unittest.main()
