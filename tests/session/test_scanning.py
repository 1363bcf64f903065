"""Line scanners: images against one that parallel rays make, and against geometry that is worked out here."""

import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    np = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))

WIDTH, LINES, HEIGHT_M, STEP, PERIOD_S = 24, 32, 5e3, 1e-4, 0.01  # 0.5 m across
# Flat disks of one radiance on a plane of another: x, y, radius, metres.
DISKS = [(2.1, 3.3, 1.7), (-3.4, 8.2, 2.4), (1.2, 11.7, 0.6), (4.1, 14.9, 1.1), (-1.3, 21.0, 3.1), (0.4, 33.0, 2.9), (3.3, 41.3, 1.9)]
GROUND, DISK = 10.0, 30.0  # W m-2 sr-1 um-1 of white and grey under an even sky
ROLL_PERIOD_S = 0.11


def document(**changes):
    disks = [{"disk": {"center": [f"{x} m", f"{y} m", "1 mm"], "normal": [0, 0, 1], "radius": f"{r} m"}, "material": "bright"} for x, y, r in DISKS]
    return {"ifov": 1,
            "scene": {"materials": {"dark": {"reflectance": GROUND / 100}, "bright": {"reflectance": DISK / 100}},
                      "objects": [{"plane": {}, "material": "dark"}, *disks]},
            "light": {"sky": {"radiance": "100 W m-2 sr-1 um-1"}},
            "platform": {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{HEIGHT_M} m"],
                                      "velocity": ["0 m/s", "50 m/s", "0 m/s"]}},
            "sensor": {"camera": {"pushbroom": {"pixels": [WIDTH, LINES], "focal_length": "1 m", "pitch": f"{STEP} m",
                                                "line_period": f"{PERIOD_S} s"}},
                       "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
            "sampling": {"accuracy": {"error": "1 %", "confidence": 0.95}},
            "output": {"products": ["radiance", "half_width", "samples", "location"]}, **changes}


def expected(speed_m_s=50.0, roll_rad=0.0, late_s=0.0, cells=100, period_s=ROLL_PERIOD_S):
    """The image by the mean of cells x cells points a pixel, from the geometry of an aircraft that flies north: its left wing, where the
    image's x grows to, is in the west, and a right wing that is down turns its belly to the left."""
    image = np.zeros((LINES, WIDTH))
    at = (np.arange(cells) + 0.5) / cells
    for j in range(LINES):
        t = (j + at) * PERIOD_S + late_s
        roll = roll_rad * np.sin(2 * math.pi * t / period_s)
        north = speed_m_s * t
        for i in range(WIDTH):
            west = HEIGHT_M * np.tan(roll[:, None] + np.arctan((i + at - WIDTH / 2) * STEP)[None, :])
            covered = np.zeros((cells, cells), bool)
            for x, y, r in DISKS:
                covered |= (-west - x) ** 2 + (north[:, None] - y) ** 2 < r * r
            image[j, i] = GROUND + (DISK - GROUND) * covered.mean()
    return image


def expected_of_elements(speed_m_s, roll_rad, roll_period_s, length=1.0, exposure=1.0, stages=1, cells=20):
    """The same of elements so many pitches long, exposed for a share of the period in its middle, of stages a pitch apart, by cells points
    in each of across, time and length, those across shifted from one time and length to the next. Stage s is exposed s periods late and looks s pitches back."""
    at = (np.arange(cells) + 0.5) / cells
    late, ahead, stage = (a.ravel() for a in np.meshgrid(0.5 + exposure * (at - 0.5), length * (at - 0.5), np.arange(stages) - 0.5 * (stages - 1)))
    image = np.zeros((LINES, WIDTH))
    shift = np.arange(late.size) * (math.sqrt(5) - 1) / 2 % 1
    across = ((np.arange(WIDTH * cells)[None, :] + shift[:, None]) / cells - WIDTH / 2) * STEP
    for j in range(LINES):
        t = (j + late + stage) * PERIOD_S
        roll = roll_rad * np.sin(2 * math.pi * t / roll_period_s)
        west = HEIGHT_M * np.tan(roll[:, None] + np.arctan(across))
        north = (speed_m_s * t)[:, None] + HEIGHT_M * ((ahead - stage) * STEP)[:, None] / (np.cos(roll)[:, None] - across * np.sin(roll)[:, None])
        covered = np.zeros(west.shape, bool)
        for x, y, r in DISKS:
            covered |= (-west - x) ** 2 + (north - y) ** 2 < r * r
        image[j] = GROUND + (DISK - GROUND) * covered.mean(axis=0).reshape(WIDTH, cells).mean(axis=1)
    return image


@unittest.skipIf(np is None, "NumPy not found")
class Scanning(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def render(self, scene, name="scan", *options):
        (self.folder / f"{name}.json").write_text(json.dumps(scene))
        result = subprocess.run([PROGRAM, "render", f"{name}.json", "--output", name, *options], cwd=self.folder, text=True,
                                capture_output=True, timeout=200, check=False)
        self.assertIn(result.returncode, (0, 5, 6), result.stdout + result.stderr)
        return self.folder / name

    def cube(self, folder, quantity, kind="f4", bands=1):
        size = scene_size(folder)
        values = np.fromfile(folder / f"image_{quantity}.img", kind)
        lines, columns = size  # interleaved by line
        return values.reshape(lines, -1, columns)[:, :bands].transpose(1, 0, 2).squeeze().astype(float)

    def wobbling(self, speed_m_s=50.0, roll_rad=1e-3, period_s=ROLL_PERIOD_S):
        """A table of 20 rows a turn."""
        rows = ["time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg"]
        for k in range(-max(20, round(2.2 / period_s)), max(60, round(9.9 / period_s))):
            t = k * period_s / 20
            roll = math.degrees(roll_rad * math.sin(2 * math.pi * t / period_s))
            rows.append(f"{t:.9f},0,{speed_m_s * t:.9f},{HEIGHT_M},0,0,{roll:.12f}")
        (self.folder / "path.csv").write_text("\n".join(rows) + "\n")
        return {"table": {"frame": "scene", "file": "path.csv"}}

    def misses(self, folder, truth):
        """Shares of pixels, of all and of those that hold an edge, whose interval does not hold the truth; the reference's own error, of
        borders among 100 x 100 cells, is 20 * 1e-3 of the disk's contrast at most and mostly a tenth of that."""
        off = np.abs(self.cube(folder, "radiance") - truth)
        outside = off > self.cube(folder, "half_width") + 2e-4 * DISK
        edges = (truth > GROUND + 1e-6) & (truth < DISK - 1e-6)
        return outside.mean(), outside[edges].mean()

    def test_at_the_speed_of_its_lines_it_is_the_image_of_parallel_rays(self):
        still = document()
        del still["platform"]
        still["sensor"]["camera"] = {"orthographic": {"gsd": "0.5 m", "pixels": [WIDTH, LINES], "rotation": "180 deg",
                                                      "center": ["0 m", f"{LINES / 4} m"]}}
        scanned, parallel = self.render(document()), self.render(still, "still")
        half = np.hypot(self.cube(scanned, "half_width"), self.cube(parallel, "half_width"))
        off = np.abs(self.cube(scanned, "radiance") - self.cube(parallel, "radiance"))
        self.assertLess((off > half + 1e-5).mean(), 0.03)
        samples = [self.cube(folder, "samples", "u4").sum() for folder in (scanned, parallel)]
        self.assertAlmostEqual(samples[0] / samples[1], 1.0, delta=0.1)

    def test_at_any_speed_and_rolling_it_is_what_geometry_says(self):
        for speed, roll in ((50.0, 0.0), (25.0, 0.0), (150.0, 0.0), (50.0, 1e-3), (150.0, 1e-3)):
            with self.subTest(speed=speed, roll=roll):
                folder = self.render(document(platform=self.wobbling(speed, roll)), f"scan{speed:g}_{roll:g}")
                every, of_edges = self.misses(folder, expected(speed, roll))
                self.assertLess(every, 0.03)
                self.assertLess(of_edges, 0.07)

    def long(self, **keys):
        scene = document()
        scene["sensor"]["camera"]["pushbroom"].update(keys)
        return scene

    def test_elements_have_a_length_and_an_exposure(self):
        cases = {"length": (dict(element_length="0.1 mm"), dict(), 50.0),
                 "brief": (dict(element_length="0.12 mm", exposure="3 ms"), dict(length=1.2, exposure=0.3), 50.0),
                 "stages": (dict(element_length="0.1 mm", stages=4), dict(stages=4, cells=14), 51.0)}
        for name, (keys, how, speed) in cases.items():
            with self.subTest(name):
                scene = self.long(**keys)
                scene["platform"]["straight"]["velocity"][1] = f"{speed} m/s"
                folder = self.render(scene, name)
                every, of_edges = self.misses(folder, expected_of_elements(speed, 0.0, 1.0, **how))
                self.assertLess(every, 0.03)
                self.assertLess(of_edges, 0.07)
                self.assertGreater(self.misses(folder, expected(speed))[1], 0.3)  # as if they had no length

    def test_elements_of_a_length_that_roll(self):
        """1 mrad that turns slowly enough, by 0.0095 pixels a line; and by 5.7 pixels a line, which is refused and not sure and wrong."""
        slow_s = 2 * math.pi * 10 / 0.0095 * PERIOD_S
        scene = dict(self.long(element_length="0.1 mm"), platform=self.wobbling(50.0, 1e-3, slow_s))
        every, of_edges = self.misses(self.render(scene, "slow"), expected_of_elements(50.0, 1e-3, slow_s))
        self.assertLess(every, 0.03)
        self.assertLess(of_edges, 0.07)
        (self.folder / "fast.json").write_text(json.dumps(dict(scene, platform=self.wobbling(50.0, 1e-3))))
        refused = subprocess.run([PROGRAM, "render", "fast.json"], cwd=self.folder, text=True, capture_output=True, timeout=200, check=False)
        self.assertNotIn(refused.returncode, (0, 6))
        self.assertRegex(refused.stderr, r"fast\.json:1:\d+: what elements 1 pitches long, all stages together, see is 2\.\d+ pixels off .*"
                                         r"rolls or yaws by 5\.\d+ pixels while it moves on by a pitch; expected 0\.005 pixels at most, which 0\.00\d+ "
                                         r"pitches have: a shorter 'element_length', fewer 'stages', or neither")

    def test_fast_jitter_within_a_line(self):
        """Five turns in a line, of 0.3 and of 3 pixels."""
        for roll in (3e-5, 3e-4):
            with self.subTest(roll=roll):
                folder = self.render(document(platform=self.wobbling(50.0, roll, 0.2 * PERIOD_S)), f"fast{roll:g}")
                every, of_edges = self.misses(folder, expected(50.0, roll, period_s=0.2 * PERIOD_S))
                self.assertLess(every, 0.03)
                self.assertLess(of_edges, 0.07)

    def test_planted_faults_are_noticed(self):
        folder = self.render(document(platform=self.wobbling(50.0, 1e-3)))
        self.assertLess(self.misses(folder, expected(50.0, 1e-3))[1], 0.07)
        for fault in (expected(50.0, 1.01e-3), expected(50.0, 1e-3, late_s=0.05 * PERIOD_S), expected(50.5, 1e-3)):
            self.assertGreater(self.misses(folder, fault)[1], 0.15)

    def test_places_of_pixels_are_those_of_its_rays(self):
        folder = self.render(document(platform=self.wobbling(50.0, 1e-3)))
        places = self.cube(folder, "location", "f8", 3)
        t = (np.arange(LINES) + 0.5) * PERIOD_S
        roll = 1e-3 * np.sin(2 * math.pi * t / ROLL_PERIOD_S)
        west = HEIGHT_M * np.tan(roll[:, None] + np.arctan((np.arange(WIDTH) + 0.5 - WIDTH / 2) * STEP)[None, :])
        pixel_m = 0.5
        off = np.hypot(places[0] + west, places[1] - 50.0 * t[:, None]) / pixel_m
        self.assertLess(off.max(), 0.01)
        planted = np.hypot(places[0] + west, places[1] - 50.0 * (t[:, None] + 0.02 * PERIOD_S)) / pixel_m
        self.assertGreater(planted.max(), 0.01)

    def test_places_follow_from_the_reported_pose_and_light_from_the_true_one(self):
        platform = dict(document()["platform"], mount={"lever_arm": ["1 m", "0 m", "2 m"], "roll": "0.02 deg"})
        told = dict(platform, reported={"position_bias": ["0.7 m", "0 m", "0 m"], "attitude_bias": {"roll": "0.002 deg"},
                                        "mount": {"lever_arm": ["1 m", "0 m", "2 m"]}})
        output = {"products": ["radiance", "location", "true_location"]}
        known, reported = (self.render(document(platform=p, output=output), name) for p, name in ((platform, "known"), (told, "told")))
        self.assertEqual((known / "image_radiance.img").read_bytes(), (reported / "image_radiance.img").read_bytes())
        for quantity in ("location", "true_location"):
            self.assertEqual((known / f"image_{quantity}.img").read_bytes(), (reported / "image_true_location.img").read_bytes())
        t = (np.arange(LINES) + 0.5)[:, None] * PERIOD_S
        at = np.arctan((np.arange(WIDTH) + 0.5 - WIDTH / 2) * STEP)[None, :]

        def off(folder, quantity, roll_deg, east_m):
            """Pixels between places and those of a flight to the north whose camera is 1 m ahead and 2 m below."""
            places, roll = self.cube(folder, quantity, "f8", 3), math.radians(roll_deg)
            west = (HEIGHT_M - 2 * math.cos(roll)) * np.tan(math.radians(roll_deg) + at) - east_m
            return np.hypot(places[0] + west, places[1] - (50.0 * t + 1.0)).max() / 0.5

        self.assertLess(off(known, "location", 0.02, 0.0), 0.01)
        # The lever arm turns with the biased attitude, by 7 um here.
        self.assertLess(off(reported, "location", 0.002, 0.7), 0.01)
        self.assertGreater(off(reported, "location", 0.02, 0.0), 1.0)
        self.assertGreater(off(reported, "location", 0.002, 0.72), 0.01)
        line = json.loads((reported / "image_run.json").read_text())["acquisition"]["camera"]["lines"][3]
        arm_m = 2 * (math.sin(math.radians(0.002)) - math.sin(0))  # turned with the reported attitude
        self.assertAlmostEqual(line["position_m"][0] - line["true"]["position_m"][0], 0.7 - arm_m, places=9)
        self.assertAlmostEqual(line["true"]["forward"][0], -math.sin(math.radians(0.02)), places=9)
        self.assertNotIn("true", json.loads((known / "image_run.json").read_text())["acquisition"]["camera"]["lines"][3])

    def test_jitter_is_the_same_for_all_tiles_and_threads(self):
        jitter = {"white": {"roll": "0.2 mrad", "pitch": "0.005 mrad", "up_to": "30 Hz"}}
        shaking = document(platform=dict(document()["platform"], jitter=jitter, reported={}),
                           output={"products": ["radiance", "location", "true_location"]})
        whole = self.render(shaking)
        again = self.render(dict(shaking, seed=1), "again", "--threads", "1")
        for quantity in ("radiance", "true_location"):
            self.assertEqual((whole / f"image_{quantity}.img").read_bytes(), (again / f"image_{quantity}.img").read_bytes())
        shift = (self.cube(whole, "true_location", "f8", 3) - self.cube(whole, "location", "f8", 3)) / 0.5
        self.assertGreater(np.abs(shift[0]).max(), 0.5)  # 0.2 mrad are 2 pixels
        self.assertLess(np.ptp(shift[0], axis=1).max(), 1e-3)  # a roll shifts a line as a whole
        # Half of the lines, begun later: the same shake at the same times.
        later = json.loads(json.dumps(shaking))
        later["sensor"]["camera"]["pushbroom"].update(pixels=[WIDTH, LINES // 2], start=f"{LINES // 2 * PERIOD_S} s")
        half = self.cube(self.render(later, "later"), "true_location", "f8", 3)
        self.assertLess(np.abs(half - self.cube(whole, "true_location", "f8", 3)[:, LINES // 2:]).max(), 1e-6)
        other = self.cube(self.render(dict(shaking, seed=2), "other"), "true_location", "f8", 3)
        self.assertGreater(np.abs(other - self.cube(whole, "true_location", "f8", 3)).max(), 0.05)

    def test_the_record_tells_where_the_camera_was(self):
        record = json.loads((self.render(document()) / "image_run.json").read_text())
        camera = record["acquisition"]["camera"]
        self.assertEqual(camera["model"], "pushbroom")
        self.assertAlmostEqual(camera["position_m"][1], 50.0 * PERIOD_S * LINES / 2, places=9)
        self.assertEqual([round(v, 12) for v in camera["right"]], [-1, 0, 0])
        self.assertEqual([line["line"] for line in camera["lines"]], [j + 0.5 for j in range(LINES)])
        for line in camera["lines"]:
            self.assertAlmostEqual(line["time_s"], line["line"] * PERIOD_S, places=12)
            self.assertAlmostEqual(line["position_m"][1], 50.0 * line["time_s"], places=9)


def scene_size(folder):
    header = dict(line.split("=", 1) for line in (folder / "image_radiance.img.hdr").read_text().splitlines() if "=" in line)
    header = {key.strip(): value.strip() for key, value in header.items()}
    return int(header["lines"]), int(header["samples"])


if __name__ == "__main__":
    unittest.main()
