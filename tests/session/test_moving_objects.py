"""What moves, under frames that are exposed for a while, rolling shutters and scanners: edges where kinematics puts them, and intervals that hold
what a grid of thousands of paths a pixel finds, each path at its own time.

The full measure: test_moving_objects.py --full, of seven scenes and 12 seeds."""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from images import FULL_SCENES, PROGRAM, SCENES, image_of, np, run

KINDS = ("frame", "rolling", "scanned")
EXPOSURE_S, LINE_S, HEIGHT_M = 0.01, 0.01, 200.0
# Cells of grids along a pixel's side; of one grid the error at an edge along its cells is half of one.
GRIDS, FULL_GRIDS = (83, 97), (149, 171)


# ---- edges

PIXELS, GSD_M, CAR_M, CAR_AT_M = 24, 0.3, (1.7, 2.3), (0.13, -0.21)
FRAME = {"focal_length": "50 mm", "pitch": "50 um", "pixels": [PIXELS, PIXELS], "position": ["0 m", "0 m", "300 m"], "attitude": {}}


def car(camera, velocity_m_s, platform=None):
    """A hot plate on the cold ground, black both, so that a pixel is what it covers of it."""
    at = lambda signs: [f"{sign * side / 2} m" for sign, side in zip(signs, CAR_M)]
    document = {
        "ifov": 1,
        "scene": {"materials": {"road": {"reflectance": 0, "temperature": "290 K"}, "paint": {"reflectance": 0, "temperature": "450 K"}},
                  "objects": [{"plane": {}, "material": "road"},
                              {"name": "car", "box": {"low": at((-1, -1)) + ["0 m"], "high": at((1, 1)) + ["0.1 mm"]}, "material": "paint",
                               "motion": {"straight": {"frame": "scene", "position": [f"{x} m" for x in CAR_AT_M] + ["0 m"],
                                                       "velocity": [f"{v} m/s" for v in velocity_m_s] + ["0 m/s"]},
                                          "attitude": {"from": "north"}}}]},
        "light": {"sky": {"none": {}}},
        "sensor": {"camera": camera, "channels": [{"name": "thermal", "gaussian": {"center": "10 um", "fwhm": "0.2 um"}}]},
        "sampling": {"accuracy": {"error": "0.5 %"}}}
    if platform:
        document["platform"] = platform
    return document


def overlap(low, high, edges):
    """Of the pixels between rising edges, the part of each."""
    return np.clip(np.minimum(high, edges[1:]) - np.maximum(low, edges[:-1]), 0, None) / np.diff(edges)


def covered_by_frame(velocity_m_s, exposure_s, row_period_s, instants=801):
    edges = (np.arange(PIXELS + 1) - PIXELS / 2) * GSD_M
    covered = np.zeros((PIXELS, PIXELS))
    shares = ((np.arange(instants) + 0.5) / instants - 0.5 if exposure_s else np.zeros(1))[:, None]
    for row in range(PIXELS):
        t = (row + 0.5 - PIXELS / 2) * row_period_s + shares * exposure_s
        x, y = CAR_AT_M[0] + velocity_m_s[0] * t, -(CAR_AT_M[1] + velocity_m_s[1] * t)
        covered[row] = (overlap(x - CAR_M[0] / 2, x + CAR_M[0] / 2, edges) *
                        overlap(y - CAR_M[1] / 2, y + CAR_M[1] / 2, edges[row:row + 2])).mean(axis=0)
    return covered


def covered_by_scanner(velocity_m_s, speed_m_s, instants=2001):
    """Lines from south to north: the image's y grows to the north, its x to the left wing, which is west."""
    edges = (np.arange(PIXELS + 1) - PIXELS / 2) * GSD_M
    covered = np.zeros((PIXELS, PIXELS))
    period_s = GSD_M / speed_m_s
    shares = ((np.arange(instants) + 0.5) / instants)[:, None]
    for row in range(PIXELS):
        t = (row - PIXELS / 2 + shares) * period_s
        x, y = -(CAR_AT_M[0] + velocity_m_s[0] * t), CAR_AT_M[1] + velocity_m_s[1] * t
        over = abs(speed_m_s * t - y) <= CAR_M[1] / 2
        covered[row] = (over * overlap(x - CAR_M[0] / 2, x + CAR_M[0] / 2, edges)).mean(axis=0)
    return covered


def furthest(camera, platform, velocity_m_s, covered, moves=True):
    """How far a pixel's part of the car is from where it should be, and the sum along a row or column, that is where two edges are."""
    with tempfile.TemporaryDirectory() as scratch:
        document = car(camera, velocity_m_s if moves else (0, 0), platform)
        radiance, _ = image_of(document, pathlib.Path(scratch), document["sampling"])
    radiance = radiance.reshape(PIXELS, PIXELS)
    part = (radiance - radiance.min()) / (radiance.max() - radiance.min())
    return max(np.abs(part - covered).max(), np.abs((part - covered).sum(axis=0)).max(), np.abs((part - covered).sum(axis=1)).max())


def frame(exposure_s=0.0, row_period_s=0.0):
    return {"frame": {**FRAME, "exposure": f"{exposure_s} s", "row_period": f"{row_period_s} s"}}


def scanner(speed_m_s):
    """The middle of its image is at 0 s, straight above the middle."""
    period_s = GSD_M / speed_m_s
    return ({"pushbroom": {"pixels": [PIXELS, PIXELS], "focal_length": "50 mm", "pitch": "50 um", "line_period": f"{period_s!r} s",
                           "start": f"{-PIXELS / 2 * period_s!r} s"}},
            {"straight": {"frame": "scene", "position": ["0 m", "0 m", "300 m"], "velocity": ["0 m/s", f"{speed_m_s} m/s", "0 m/s"]}})


# ---- coverage

# By scene: where something of two pixels by three is at 0 s, and where it moves to, in pixels from the middle, and how high, in metres.
WAY = {"gable_roof": ((-1, -1), (0.8, 0.5), 6.2), "wall_foot": ((1, 1), (1, -0.2), 0.2), "alley": ((0, 1), (0.9, 0.4), 5.3), "street_canyon": ((-2, 0), (0.1, 1), 0.3)}


def moving(name, kind, moves=True):
    scene = json.loads(re.sub(r"^\s*//.*$", "", (SCENES / f"{name}.json").read_text(), flags=re.MULTILINE))
    above = scene["sensor"]["camera"]["orthographic"]
    gsd_m, (width, lines) = float(above["gsd"].split()[0]), above["pixels"]
    middle_m = [float(c.split()[0]) for c in above["center"]]
    where, ahead, height_m = WAY.get(name, ((0, 1), (0.9, 0.4), 0.4 * gsd_m))
    speed_m_s = 3.0 * gsd_m / EXPOSURE_S if moves else 0.0
    position = [f"{m + gsd_m * w} m" for m, w in zip(middle_m, where)] + [f"{height_m} m"]
    velocity = [f"{speed_m_s * a / math.hypot(*ahead)} m/s" for a in ahead] + ["0 m/s"]
    heading_deg = math.degrees(math.atan2(*ahead))
    scene["scene"]["materials"]["vehicle"] = {"reflectance": 0.75, "temperature": "310 K"}
    scene["scene"]["objects"].append({
        "name": "vehicle", "box": {"low": [f"{-1.0 * gsd_m} m", f"{-1.5 * gsd_m} m", "0 m"], "high": [f"{1.0 * gsd_m} m", f"{1.5 * gsd_m} m", f"{gsd_m} m"]},
        "material": "vehicle", "motion": {"straight": {"frame": "scene", "position": position, "velocity": velocity},
                                          "attitude": {"from": "north", "yaw": f"{heading_deg} deg"}}})
    step = gsd_m / HEIGHT_M
    if kind == "scanned":
        scene["sensor"]["camera"] = {"pushbroom": {"pixels": [width, lines], "field_of_view": f"{2e3 * math.atan(0.5 * width * step)} mrad",
                                                   "line_period": f"{LINE_S} s", "start": f"{-lines / 2 * LINE_S} s"}}
        scene["platform"] = {"straight": {"frame": "scene", "position": [f"{m} m" for m in middle_m] + [f"{HEIGHT_M} m"],
                                          "velocity": ["0 m/s", f"{gsd_m / LINE_S} m/s", "0 m/s"]}}
    else:
        scene["sensor"]["camera"] = {"frame": {
            "focal_length": "100 mm", "pitch": f"{100 * step} mm", "pixels": [width, lines], "position": [f"{m} m" for m in middle_m] + [f"{HEIGHT_M} m"],
            "attitude": {"yaw": above.get("rotation", "0 deg")}, "exposure": f"{EXPOSURE_S if kind == 'frame' else 0.3 * EXPOSURE_S} s",
            "row_period": "0 s" if kind == "frame" else f"{0.1 * EXPOSURE_S} s"}}
    return scene


def held(name, kind, seeds, grids=GRIDS, truth_moves=True, narrower=1.0):
    """Of so many images at 3 %: intervals that hold the mean of the grids, and all; then the same of pixels that show that it moves."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        grid = lambda scene, *all_cells: np.mean([image_of(scene, folder, {"grid": {"elements": [n, n]}}, 990 + n) for n in all_cells], axis=0)
        truth, still = grid(moving(name, kind), *grids), grid(moving(name, kind, False), 41)
        near = np.abs(truth - still) > 0.02 * truth
        counts = np.zeros(4, int)
        for seed in range(1, seeds + 1):
            found, half_width = image_of(moving(name, kind, truth_moves), folder, {"accuracy": {"error": "3 %"}}, seed)
            inside = np.abs(found - truth) <= narrower * half_width
            counts += inside.sum(), inside.size, inside[near].sum(), near.sum()
        return counts


@unittest.skipIf(np is None, "NumPy not found")
class MovingObjects(unittest.TestCase):
    LIMIT_PX = 0.02

    def test_edges_are_where_kinematics_puts_them(self):
        for exposure_s, row_period_s, velocity in ((0.01, 0, (30, 0)), (0.01, 0, (20, 13)), (0.002, 0.002, (30, 7)), (0.0, 0.003, (20, 5)),
                                                   (1e-4, 0.001, (0, 40))):
            with self.subTest(exposure_s=exposure_s, row_period_s=row_period_s):
                covered = covered_by_frame(velocity, exposure_s, row_period_s)
                self.assertLess(furthest(frame(exposure_s, row_period_s), None, velocity, covered), self.LIMIT_PX)

    def test_a_scanner_sees_each_line_at_its_time(self):
        for speed in (20.0, 60.0):
            with self.subTest(speed=speed):
                covered = covered_by_scanner((9, 4), speed)
                self.assertLess(furthest(*scanner(speed), (9, 4), covered), self.LIMIT_PX)

    def test_a_car_that_stands_still_is_noticed(self):
        covered = covered_by_frame((30, 0), 0.01, 0)
        self.assertGreater(furthest(frame(0.01), None, (30, 0), covered, moves=False), 10 * self.LIMIT_PX)

    def test_intervals_hold_what_they_say(self):
        for kind, names in (("frame", ("gable_roof", "wall_foot")), ("rolling", ("wall_foot",)), ("scanned", ("gable_roof",))):
            with self.subTest(kind):
                inside, count, near, of = np.sum([held(name, kind, 2) for name in names], axis=0)
                self.assertGreater(inside / count, 0.93)
                self.assertGreater(of, 20)
                self.assertGreater(near / of, 0.93)

    def test_light_of_a_small_hot_thing_that_moves_is_in_the_interval(self):
        """Scattered paths seldom meet it: by Lambert's law a black ball of radius r and radiance B adds rho B (r/d)^2 cos to the ground."""
        rho, radius, height, speed, exposure = 0.3, 0.08, 5.0, 20.0, 0.04
        planck = lambda kelvins: 1.191042972e8 / 3.95**5 / math.expm1(14387.76877 / 3.95 / kelvins)
        document = {
            "ifov": 1,
            "scene": {"materials": {"ground": {"reflectance": rho, "temperature": "300 K"}, "hot": {"reflectance": 0, "temperature": "1100 K"}},
                      "objects": [{"plane": {}, "material": "ground"},
                                  {"name": "flare", "sphere": {"center": ["0 m", "0 m", "0 m"], "radius": f"{radius} m"}, "material": "hot",
                                   "motion": {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{height} m"],
                                                           "velocity": [f"{speed} m/s", "0 m/s", "0 m/s"]}}}]},
            "light": {"sky": {"none": {}}},
            "sensor": {"camera": {"frame": {**FRAME, "pixels": [PIXELS // 2] * 2, "pitch": "100 um", "exposure": f"{exposure} s"}}, "channels": [{"name": "mid", "gaussian": {"center": "3.95 um", "fwhm": "0.02 um"}}]}}
        with tempfile.TemporaryDirectory() as folder:
            radiance, half_width = image_of(document, pathlib.Path(folder), {"accuracy": {"error": "2 %"}})
        x = (np.arange(PIXELS // 2) + 0.5 - PIXELS / 4) * 2 * GSD_M
        y = -x[:, None]
        truth = (1 - rho) * planck(300.0) + 0 * x + 0 * y
        times = (np.arange(200) + 0.5) / 200 * exposure - exposure / 2
        for time in times:
            squares = (x - speed * time) ** 2 + y**2 + height**2
            truth = truth + rho * planck(1100.0) * radius**2 * height / squares**1.5 / len(times)
        off = np.abs(radiance.reshape(truth.shape) - truth)
        # All but what the ball itself passes before.
        open_ground = np.abs(y + 0 * x) > 2 * GSD_M
        self.assertGreater(np.median(off[open_ground] / truth[open_ground]), 0.02, "what paths do not meet would matter")
        self.assertGreater(np.mean((off <= half_width.reshape(truth.shape))[open_ground]), 0.99)

    def test_maps_by_texture_coordinates_ride_along(self):
        for kind in ("frame", "rolling"):
            with self.subTest(kind):
                inside, near = mapped_off(kind)
                self.assertGreater(near, 40)
                self.assertGreater(inside / near, 0.93)

    def test_a_map_that_is_left_out_is_noticed(self):
        inside, near = mapped_off("frame", mapped=False, instants=101)
        self.assertLess(inside / near, 0.6)

    def test_an_object_that_stands_still_is_noticed(self):
        _, _, near, of = held("gable_roof", "frame", 1, (47,), truth_moves=False)
        self.assertLess(near / of, 0.6)


# ---- maps that ride along

MAP_K = [[300 + (37 * row + 61 * column) % 150 for column in range(4)] for row in range(3)]


def mapped_car(folder, camera, platform, motion, place=(0.0, 0.0), mapped=True):
    """A black car whose temperatures are a map on its texture coordinates, which moves, or stands at a place."""
    (folder / "kelvins.asc").write_text("ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + "\n".join(
        " ".join(str(k) for k in row) for row in MAP_K) + "\n")
    document = car(camera, (0, 0), platform)
    document["scene"]["materials"]["paint"]["temperature"] = {
        "map": {"file": "kelvins.asc", "unit": "K", "by": "texture coordinates"}} if mapped else "400 K"
    document["scene"]["objects"][1] = {"name": "car", "material": "paint", "box": {"low": ["-0.9 m", "-1.2 m", "0 m"], "high": ["0.9 m", "1.2 m", "0.1 mm"]},
                                       **({"motion": motion} if motion else {"transform": {"translate": [f"{x!r} m" for x in place] + ["0 m"]}})}
    return document


# Parts of a pixel's side, one centimetre of the ground each: borders of the car lie between them.
PARTS = 30


def swept(still, rows, instants_s, velocity_m_s):
    """Mean over instants of what these rows of pixels see of a still image in parts of pixels, moved as the car moves."""
    areas = np.zeros((still.shape[0] + 1,) * 2)
    areas[1:, 1:] = still.cumsum(axis=0).cumsum(axis=1) / PARTS**2
    corners = np.arange(still.shape[0] + 1)
    total = 0.0
    for t in instants_s:
        shift = np.array(velocity_m_s) * t / GSD_M * PARTS
        across = np.arange(PIXELS + 1) * PARTS - shift[0]
        down = np.arange(rows.start, rows.stop + 1) * PARTS + shift[1]
        by_row = np.stack([np.interp(across, corners, line) for line in areas])
        total = total + np.diff(np.diff(np.stack([np.interp(down, corners, column) for column in by_row.T], axis=1), axis=0), axis=1)
    return total / len(instants_s)


def mapped_off(kind, mapped=True, instants=401):
    """Of pixels that the car passes: how many intervals at 2 % hold what a still image says, moved on, and all."""
    velocity, exposure_s, start_m = (20.0, 8.0), 0.01, (0.2, -0.1)
    motion = {"straight": {"frame": "scene", "position": [f"{x} m" for x in start_m] + ["0 m"], "velocity": [f"{v} m/s" for v in velocity] + ["0 m/s"]}, "attitude": {"from": "north"}}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        fine = {"frame": {**FRAME, "pitch": f"{50 / PARTS!r} um", "pixels": [PIXELS * PARTS] * 2}}
        still = image_of(mapped_car(folder, fine, None, None, start_m), folder, {"grid": {"elements": [1, 1]}}).reshape(PIXELS * PARTS, -1)
        shares = (np.arange(instants) + 0.5) / instants - 0.5
        if kind == "frame":
            camera = frame(exposure_s)
            truth = swept(still, range(PIXELS), shares * exposure_s, velocity)
        else:
            camera = frame(0.0, exposure_s / 4)
            truth = np.concatenate([swept(still, range(row, row + 1), [(row + 0.5 - PIXELS / 2) * exposure_s / 4], velocity) for row in range(PIXELS)])
        near = truth > 1.02 * still.min()
        found, half_width = (a.reshape(truth.shape) for a in image_of(mapped_car(folder, camera, None, motion, mapped=mapped), folder, {"accuracy": {"error": "2 %"}}))
        return (np.abs(found - truth) <= half_width)[near].sum(), near.sum()


BOX = {"name": "car", "box": {"low": ["-1 m", "-1 m", "0 m"], "high": ["1 m", "1 m", "1 m"]}, "material": "paint"}
NORTH = {"straight": {"frame": "scene", "position": ["0 m", "0 m", "0 m"], "velocity": ["0 m/s", "9 m/s", "0 m/s"]}}
POINTS = lambda *times: {"way_points": {"frame": "scene", "points": [{"time": f"{t} s", "position": ["0 m", f"{30 * t} m", "0 m"]} for t in times]}}


def checked(change, exposure="10 ms"):
    """What `ifov check` says of a document with a car whose object, and all else, is changed."""
    document = {
        "ifov": 1,
        "scene": {"materials": {"road": {"reflectance": 0.1}, "paint": {"reflectance": 0.5}, "glass": {"reflectance": 0.05, "scattering": "mirror"}},
                  "objects": [{"plane": {}, "material": "road"}, {**BOX, "motion": NORTH}]},
        "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "160 deg"}}, "sky": {"radiance": "40 W m-2 sr-1 um-1"}},
        "sensor": {"camera": {"frame": {**FRAME, "exposure": exposure}}, "channels": [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}}]},
        "sampling": {"accuracy": {"error": "3 %"}}}
    change(document, document["scene"]["objects"][1])
    with tempfile.TemporaryDirectory() as scratch:
        (pathlib.Path(scratch) / "k.asc").write_text("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n300 400\n")
        (pathlib.Path(scratch) / "scene.json").write_text(json.dumps(document, indent=1))
        done = subprocess.run([PROGRAM, "check", "scene.json"], cwd=scratch, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class MovingDocuments(unittest.TestCase):
    def refused(self, text, change):
        code, said = checked(change)
        self.assertEqual(code, 1, said)
        self.assertIn(text, said)
        self.assertRegex(said, r"scene\.json:\d+:\d+: ")

    def test_check_says_what_moves_and_how_far(self):
        code, said = checked(lambda document, car: None)
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"moving: +'car' \(line \d+\): 9 m/s; while a pixel is exposed 0\.09 m \(0\.3 pixels\), while the image is taken 0\.09 m")

    def test_what_optics_show_at_another_time_is_told(self):
        """A car at 9 m/s under samples of 8 ms / 32 of a sweep and of pixels of 0.35 m: while a pixel is exposed, while a Gaussian of so many samples passes, and in a channel that is
        shifted. Rows of a rolling shutter are pictures of one time, and line scanners without optics hide nothing."""
        flown = {"straight": {"frame": "scene", "position": ["0 m", "0 m", "80 m"], "velocity": ["0 m/s", "10 m/s", "0 m/s"]}}
        whisk = {"whiskbroom": {"focal_length": "50 mm", "pitch": "0.2 mm", "pixels": [32, 40], "elements": 4, "element_width": "0 mm", "sweep_angle": "8 deg",
                                "period": "20 ms", "sweep_time": "8 ms"}}
        rolling = {"frame": {"focal_length": "50 mm", "pitch": "0.2 mm", "pixels": [32, 32], "row_period": "1 ms"}}
        line = {"pushbroom": {"focal_length": "50 mm", "pitch": "0.2 mm", "pixels": [32, 32], "line_period": "32 ms"}}

        def of(camera, sweeps=None, shift=None, psf=True):
            def change(document, car):
                document["platform"] = flown
                (model,), = [camera.values()]
                document["sensor"]["camera"] = {next(iter(camera)): {**model, **({"pixels": [32, 4 * sweeps]} if sweeps else {})}}
                if psf:
                    document["sensor"]["psf"] = {"gaussian": {"sigma": "2 px"}}
                if shift:
                    document["sensor"]["channels"].append({"name": "late", "shift": shift, "gaussian": {"center": "0.8 um", "fwhm": "40 nm"}})
            code, said = checked(change)
            self.assertIn(code, (0, 6), said)
            return said

        sample_m = 9.0 * 8e-3 / 32
        pixel_m = 80.0 * (math.radians(8.0) / 32 * 0.2 / 50) ** 0.5
        for sweeps in (5, 10):  # the middle of the image is within a sweep, or between two
            said = of(whisk, sweeps, ["3 px", "0 px"])
            (exposed_m, exposed_px), = re.findall(r"while a pixel is exposed ([0-9.e-]+) m \(([0-9.e-]+) pixels\)", said)
            self.assertAlmostEqual(float(exposed_m) / sample_m, 1.0, delta=0.02)
            self.assertAlmostEqual(float(exposed_px) * pixel_m / sample_m, 1.0, delta=0.05)
            samples_a_pitch = 0.2 / 50 / (math.radians(8.0) / 32)
            (spread_px,), (apart_px,) = re.findall(r"moves by ([0-9.e-]+) pixels while", said), re.findall(r"is up to ([0-9.e-]+) pixels from where", said)
            self.assertAlmostEqual(float(spread_px) / (2.0 * samples_a_pitch * sample_m / pixel_m), 1.0, delta=0.06)
            self.assertAlmostEqual(float(apart_px) / (3.0 * samples_a_pitch * sample_m / pixel_m), 1.0, delta=0.06)
        for still in (of(rolling), of(line, psf=False), of(whisk, 5, psf=False)):
            self.assertNotIn("pixels while what the sensor", still)
            self.assertNotIn("from where it should be", still)
        self.assertIn("pixels while what the sensor", of(line))

    def test_a_path_that_does_not_cover_the_exposure(self):
        self.refused("its path covers -0.002 to 0.003 s, and the image is exposed from -0.005 to 0.005 s: 0.003 s too late and 0.002 s too short",
                     lambda document, car: car.update(motion=POINTS(-0.002, 0.003)))
        self.refused("it ends 0.002 s too early", lambda document, car: car.update(motion=POINTS(-1, 0.003)))
        code, said = checked(lambda document, car: car.update(motion=POINTS(-0.005, 0, 0.005)))
        self.assertEqual(code, 0, said)

    def test_what_cannot_move(self):
        def instead(shape, **more):
            def change(document, car):
                del car["box"]
                car.update(shape, **more)
            return change

        self.refused("a plane has no end", instead({"plane": {"height": "1 m"}}))
        self.refused("nothing can move: all copies of it would", lambda document, car: document["scene"].update(periodic={"size": ["20 m", "20 m"]}))
        def by_place(document, car):
            document["scene"]["materials"]["paint"] = {"reflectance": 0, "temperature": {"map": {"file": "k.asc", "unit": "K", "low_left": ["-5 m", "-5 m"], "size": ["10 m", "10 m"]}}}
        self.refused("it has a map or texture (of classes, temperatures, reflectances) by x and y, which is tied to places of the scene", by_place)
        self.refused("it is smooth", lambda document, car: car.update(material="glass"))
        self.refused("'motion' and 'present' cannot stand together yet", lambda document, car: (
            document.update(time="2026-06-21T12:00Z"), car.update(present=[["2026-06-21T10:00Z", "2026-06-21T14:00Z"]])))
        self.refused("a part of a prototype cannot move by itself", lambda document, car: (
            document["scene"].update(prototypes={"pair": [dict(car)]}), car.pop("motion")))
        self.refused("yaw is counted from the track", lambda document, car: car.update(
            motion={"straight": {**NORTH["straight"], "velocity": ["0 m/s", "0 m/s", "3 m/s"]}}))
        self.refused("copies are placed at random on it", lambda document, car: (
            document["scene"].update(prototypes={"crate": [{**BOX, "name": "crate"}]}),
            document["scene"]["objects"].append({"random_placement": {"of": [{"prototype": "crate"}], "density": "0.1 m-2", "area": {"low": ["-1 m", "-1 m"], "high": ["1 m", "1 m"]}, "on": "car"}})))

    def test_mirrors_that_stand_still_are_no_hindrance(self):
        code, said = checked(lambda document, car: document["scene"]["objects"].append(
            {"sphere": {"center": ["9 m", "0 m", "1 m"], "radius": "1 m"}, "material": "glass"}))
        self.assertEqual(code, 0, said)

    def test_the_same_bytes_for_any_threads(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            document = car(frame(0.01, 0.001), (30, 7))
            document["light"]["sky"] = {"temperature": "250 K"}
            images = []
            for threads in ("1", "3"):
                done = run(document, folder, "--threads", threads)
                self.assertEqual(done.returncode, 0, done.stderr)
                images.append([(folder / f"out/image_{what}.img").read_bytes() for what in ("radiance", "half_width", "abundance")])
            self.assertEqual(*images)


if __name__ == "__main__":
    if "--full" in sys.argv:
        for kind in KINDS:
            every = np.zeros(4)
            for name in FULL_SCENES:
                counts = held(name, kind, 12, FULL_GRIDS)
                every += counts
                print(f"{kind:8s} {name:16s} {counts[0] / counts[1]:.4f} of {counts[1]}; where it moves {counts[2] / max(1, counts[3]):.4f} of {counts[3]}", flush=True)
            print(f"{kind:8s} {'all':16s} {every[0] / every[1]:.4f} of {int(every[1])}; where it moves {every[2] / every[3]:.4f} of {int(every[3])}", flush=True)
    else:
        unittest.main()
