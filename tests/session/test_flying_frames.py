"""Frame cameras on platforms: what they see is blurred by the way of an exposure and sheared from row to row, as kinematics says; and intervals hold
what many pictures of a camera that stands still, each at an instant, say together.

The full measure: test_flying_frames.py --full, of seven scenes and 12 seeds."""

import functools
import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

from images import FULL_SCENES, SCENES, image_of, np, run



# ---- edges: a hot plate on the cold ground, black both, so that a pixel is what it covers of it

PIXELS, GSD_M, CAR_M, CAR_AT_M, HIGH_M = 24, 0.3, (1.7, 2.3), (0.13, -0.21), 300.0
FRAME = {"focal_length": "50 mm", "pitch": "50 um", "pixels": [PIXELS, PIXELS]}


def plate(frame, platform):
    at = lambda signs: [f"{middle + sign * side / 2} m" for sign, side, middle in zip(signs, CAR_M, CAR_AT_M)]
    document = {
        "ifov": 1,
        "scene": {"materials": {"road": {"reflectance": 0, "temperature": "290 K"}, "paint": {"reflectance": 0, "temperature": "450 K"}},
                  "objects": [{"plane": {}, "material": "road"},
                              {"name": "car", "box": {"low": at((-1, -1)) + ["0 m"], "high": at((1, 1)) + ["0.1 mm"]}, "material": "paint"}]},
        "light": {"sky": {"none": {}}},
        "sensor": {"camera": {"frame": {**FRAME, **frame}}, "channels": [{"name": "thermal", "gaussian": {"center": "10 um", "fwhm": "0.2 um"}}]},
        "sampling": {"accuracy": {"error": "0.5 %"}}}
    if platform:
        document["platform"] = platform
    return document


def straight(velocity_m_s, position_m=(0, 0, HIGH_M), **attitude):
    return {"straight": {"frame": "scene", "position": [f"{x} m" for x in position_m], "velocity": [f"{v} m/s" for v in velocity_m_s]},
            "attitude": {"from": "north", **attitude}}


def overlap(low, high, edges):
    """Of the pixels between rising edges (along the last axis), the part of each."""
    return np.clip(np.minimum(high, edges[..., 1:]) - np.maximum(low, edges[..., :-1]), 0, None) / np.diff(edges)


def covered(velocity_m_s, exposure_s, row_period_s, instants=801):
    """The camera looks straight down with north above: what stands still runs against its way, and grows as it comes down."""
    parts = np.zeros((PIXELS, PIXELS))
    shares = ((np.arange(instants) + 0.5) / instants - 0.5 if exposure_s else np.zeros(1))[:, None]
    for row in range(PIXELS):
        t = (row + 0.5 - PIXELS / 2) * row_period_s + shares * exposure_s
        gsd_m = GSD_M * (HIGH_M + velocity_m_s[2] * t) / HIGH_M
        edges = (np.arange(PIXELS + 1) - PIXELS / 2) * gsd_m
        x, y = CAR_AT_M[0] - velocity_m_s[0] * t, -(CAR_AT_M[1] - velocity_m_s[1] * t)
        parts[row] = (overlap(x - CAR_M[0] / 2, x + CAR_M[0] / 2, edges) *
                      overlap(y - CAR_M[1] / 2, y + CAR_M[1] / 2, edges[:, row:row + 2])).mean(axis=0)
    return parts


def furthest(velocity_m_s, exposure_s, row_period_s, moves=True):
    """How far a pixel's part of the plate is from where it should be, and the sum along a row or column, that is where two edges are."""
    with tempfile.TemporaryDirectory() as scratch:
        document = plate({"exposure": f"{exposure_s} s", "row_period": f"{row_period_s} s"}, straight(velocity_m_s if moves else (0, 0, 0)))
        radiance, _ = image_of(document, pathlib.Path(scratch), document["sampling"])
    radiance = radiance.reshape(PIXELS, PIXELS)
    part = (radiance - radiance.min()) / (radiance.max() - radiance.min())
    off = part - covered(velocity_m_s, exposure_s, row_period_s)
    return max(np.abs(off).max(), np.abs(off.sum(axis=0)).max(), np.abs(off.sum(axis=1)).max())


# ---- coverage: the honesty scenes from a camera that flies, climbs, yaws and rolls; the truth is of a camera that stands still, at many instants

HEIGHT_M, EXPOSURE_S, ROW_S = 200.0, 0.01, 0.002
KINDS = {"exposed": (EXPOSURE_S, 0.0), "rolling": (0.0, ROW_S), "both": (0.4 * EXPOSURE_S, ROW_S)}


class Flight:
    """Over one of the scenes, with the speed of three pixels an exposure."""

    def __init__(self, name, kind, moves=True):
        self.scene = json.loads(re.sub(r"^\s*//.*$", "", (SCENES / f"{name}.json").read_text(), flags=re.MULTILINE))
        above = self.scene["sensor"]["camera"]["orthographic"]
        self.gsd_m, self.size = float(above["gsd"].split()[0]), above["pixels"]
        self.middle_m = [float(c.split()[0]) for c in above["center"]]
        self.turned_deg = float(str(above.get("rotation", "0 deg")).split()[0])
        self.kind, self.moves = kind, moves
        self.exposure_s, self.row_s = KINDS[kind]

    def pose(self, time_s):
        """x, y, z; yaw, pitch and roll in degrees, the last two of which move the picture by about a pixel an exposure."""
        t = time_s / EXPOSURE_S if self.moves else 0.0
        turn_deg = math.degrees(self.gsd_m / HEIGHT_M)
        return (self.middle_m[0] + 2.4 * self.gsd_m * t, self.middle_m[1] - 1.1 * self.gsd_m * t, HEIGHT_M + 0.2 * self.gsd_m * t,
                self.turned_deg + 0.5 * t, 0.6 * turn_deg * math.sin(1.1 * t), -1.2 * turn_deg * math.sin(0.7 * t + 0.2))

    def document(self, folder):
        step = self.gsd_m / HEIGHT_M
        half_s = 0.5 * (self.exposure_s + self.row_s * self.size[1])
        times = np.linspace(-half_s, half_s, 401)
        (folder / "flight.csv").write_text("time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n" + "".join(
            ",".join(f"{v!r}" for v in (float(t), *map(float, self.pose(t)))) + "\n" for t in times))
        frame = {"focal_length": "100 mm", "pitch": f"{100 * step} mm", "pixels": self.size, "exposure": f"{self.exposure_s} s", "row_period": f"{self.row_s} s"}
        return {**self.scene, "platform": {"table": {"frame": "scene", "file": "flight.csv"}}, "sensor": {**self.scene["sensor"], "camera": {"frame": frame}}}

    def still(self, time_s):
        x, y, z, yaw, pitch, roll = self.pose(time_s)
        frame = {"focal_length": "100 mm", "pitch": f"{100 * self.gsd_m / HEIGHT_M} mm", "pixels": self.size, "position": [f"{x!r} m", f"{y!r} m", f"{z!r} m"],
                 "attitude": {"yaw": f"{yaw!r} deg", "pitch": f"{pitch!r} deg", "roll": f"{roll!r} deg"}}
        return {**self.scene, "sensor": {**self.scene["sensor"], "camera": {"frame": frame}}}

    def shape(self):
        """As products are, interleaved by line."""
        return self.size[1], len(self.scene["sensor"]["channels"]), self.size[0]

    def truth(self, folder, instants, cells):
        """Grids that differ from instant to instant: of one the error at an edge along its cells is half of one."""
        taken = 0
        def grid(time_s):
            nonlocal taken
            taken += 1
            n = cells + taken % 7
            flat = image_of(self.still(time_s), folder, {"grid": {"elements": [n, n]}}, 900 + taken)
            return flat.reshape(self.shape())
        shares = (np.arange(instants) + 0.5) / instants - 0.5 if self.exposure_s else np.zeros(1)
        if not self.row_s:
            return np.mean([grid(share * self.exposure_s) for share in shares], axis=0)
        rows = []
        for row in range(self.size[1]):
            middle_s = (row + 0.5 - 0.5 * self.size[1]) * self.row_s
            rows.append(np.mean([grid(middle_s + share * self.exposure_s)[row] for share in shares], axis=0))
        return np.stack(rows)


@functools.cache
def truth_of(name, kind, instants, cells, moves=True):
    with tempfile.TemporaryDirectory() as scratch:
        return Flight(name, kind, moves).truth(pathlib.Path(scratch), instants, cells)


def held(name, kind, seeds, instants, cells, truth_moves=True):
    """Of so many images at 3 %: intervals that hold the truth, and all; then the same of pixels that show that it moves."""
    truth, still = truth_of(name, kind, instants, cells), truth_of(name, kind, 1, 31, False)
    near = np.abs(truth - still) > 0.05 * truth
    flight = Flight(name, kind, truth_moves)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        counts = np.zeros(4, int)
        for seed in range(1, seeds + 1):
            found, half_width = (a.reshape(truth.shape) for a in image_of(flight.document(folder), folder, {"accuracy": {"error": "3 %"}}, seed))
            inside = np.abs(found - truth) <= half_width
            counts += inside.sum(), inside.size, inside[near].sum(), near.sum()
        return counts


# ---- small hot things, smeared

def balls(velocity_m_s, radius_m, kelvin, seeds, pilot_rays=True):
    """Of three black balls on the black road: pixels that they light by 0.1 % or more, and how many intervals hold them. The truth is the overlap of discs with
    pixels along their way."""
    exposure_s, places = 0.01, [(-0.3, 0.13 + 1.07 * k) for k in range(3)]
    document = plate({"exposure": f"{exposure_s} s"}, straight(velocity_m_s))
    document["scene"]["objects"][1:] = [
        {"sphere": {"center": [f"{x} m", f"{y} m", f"{radius_m} m"], "radius": f"{radius_m} m"}, "material": "paint"} for x, y in places]
    document["scene"]["materials"]["paint"]["temperature"] = f"{kelvin} K"
    planck = lambda k: 1.191042972e8 / 10**5 / math.expm1(14387.76877 / 10 / k)
    side = (np.arange(12) + 0.5) / 6 - 1
    parts = [(a * radius_m, b * radius_m) for a in side for b in side if a * a + b * b < 1]
    shares = ((np.arange(4001) + 0.5) / 4001 - 0.5) * exposure_s
    seen = np.zeros((PIXELS, PIXELS))
    for x, y in places:
        for dx, dy in parts:
            columns = (x + dx - velocity_m_s[0] * shares) / GSD_M + PIXELS / 2
            rows = PIXELS / 2 - (y + dy - velocity_m_s[1] * shares) / GSD_M
            seen += np.histogram2d(rows, columns, bins=[np.arange(PIXELS + 1)] * 2)[0] / len(shares) / len(parts)
    truth = planck(290) + (planck(kelvin) - planck(290)) * math.pi * radius_m**2 / GSD_M**2 * seen
    near = truth > 1.001 * planck(290)
    held_there = 0
    with tempfile.TemporaryDirectory() as scratch:
        for seed in range(1, seeds + 1):
            found, half_width = image_of(document, pathlib.Path(scratch), {"accuracy": {"error": "2 %", "pilot_rays": pilot_rays}}, seed)
            held_there += (np.abs(found.reshape(truth.shape) - truth) <= half_width.reshape(truth.shape))[near].sum()
    return held_there, seeds * near.sum()


@unittest.skipIf(np is None, "NumPy not found")
class FlyingFrames(unittest.TestCase):
    LIMIT_PX = 0.02
    # Instants, an eighth of a pixel apart, and cells along a pixel's side: no fewer paths a pixel than 24 x 13 x 13.
    TRUTH = {"exposed": (24, 13), "rolling": (1, 61)}

    def test_edges_are_where_kinematics_puts_them(self):
        for exposure_s, row_period_s, velocity in ((0.01, 0, (30, 0, 0)), (0.01, 0, (-20, 13, 0)), (0.0, 0.003, (20, 5, 0)), (0.002, 0.002, (30, -7, 0)),
                                                   (0.02, 0.0, (3, 4, -900)), (0.0, 0.003, (8, -60, 400))):
            with self.subTest(exposure_s=exposure_s, row_period_s=row_period_s):
                self.assertLess(furthest(velocity, exposure_s, row_period_s), self.LIMIT_PX)

    def test_a_camera_that_stands_still_is_noticed(self):
        for exposure_s, row_period_s in ((0.01, 0), (0, 0.003)):
            self.assertGreater(furthest((30, 0, 0), exposure_s, row_period_s, moves=False), 10 * self.LIMIT_PX)

    def test_without_exposure_it_is_a_still_image(self):
        """The same as of a camera that stands where the platform is."""
        turned = {"yaw": "31 deg", "pitch": "0.2 deg", "roll": "-0.3 deg"}
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            flies, stands = plate({}, straight((40, 9, 3), **turned)), plate({"position": ["0 m", "0 m", f"{HIGH_M} m"], "attitude": turned}, None)
            images = [image_of(document, folder, document["sampling"]) for document in (flies, stands)]
        for flown, still in zip(*images):
            self.assertLess(np.abs(flown - still).max() / still.max(), 1e-6)

    def test_intervals_hold_what_they_say(self):
        for kind, names in (("exposed", ("gable_roof", "wall_foot")), ("exposed", ("mirror", "glass_front")), ("rolling", ("gable_roof",))):
            with self.subTest(kind, names=names):
                inside, count, near, of = np.sum([held(name, kind, 2, *self.TRUTH[kind]) for name in names], axis=0)
                self.assertGreater(inside / count, 0.93)
                self.assertGreater(of, 20)
                self.assertGreater(near / of, 0.93)

    def test_small_hot_things_are_smeared(self):
        inside, count = np.sum([balls((150, 20, 0), 0.02, 3000, 3), balls((150, 33, 0), 0.005, 3000, 3), balls((-40, 60, 0), 0.02, 1000, 3)], axis=0)
        self.assertGreater(inside / count, 0.93)

    def test_small_things_that_are_not_sought_are_noticed(self):
        inside, count = balls((150, 20, 0), 0.02, 3000, 2, pilot_rays=False)
        self.assertLess(inside / count, 0.5)

    def test_a_flight_that_is_not_told_is_noticed(self):
        for kind in ("exposed", "rolling"):
            _, _, near, of = held("gable_roof", kind, 1, *self.TRUTH[kind], truth_moves=False)
            self.assertLess(near / of, 0.6)


def checked(change, command="check"):
    """What `ifov check` says of a document that is changed."""
    document = plate({"exposure": "10 ms"}, straight((30, 0, 0)))
    change(document, document["sensor"]["camera"]["frame"])
    with tempfile.TemporaryDirectory() as scratch:
        done = run(document, pathlib.Path(scratch), command=command)
    return done.returncode, done.stdout + done.stderr


class FlyingDocuments(unittest.TestCase):
    def refused(self, text, change):
        code, said = checked(change)
        self.assertEqual(code, 1, said)
        self.assertIn(text, said)
        self.assertRegex(said, r"scene\.json:\d+:\d+: ")

    def test_check_and_sensor_say_how_far_the_picture_moves(self):
        rolling = lambda document, frame: frame.update(row_period="1 ms")
        self.assertRegex(checked(rolling)[1], r"flight: +while a pixel is exposed the picture of the ground moves by 1 pixels, from row to row by 0\.1\n")
        self.assertIn("smear 1 pixels, 0.1 pixels from row to row", checked(rolling, "sensor")[1])
        self.assertNotIn("flight:", checked(lambda document, frame: frame.update(exposure="0 s"))[1])

    def test_what_cannot_be(self):
        self.refused("the platform's path covers -0.002 to 0.003 s, and the image is exposed from -0.005 to 0.005 s: 0.003 s too late and 0.002 s too short",
                     lambda document, frame: document.update(platform={"way_points": {"frame": "scene", "points": [
                         {"time": f"{t} s", "position": [f"{9 * t} m", "0 m", "300 m"]} for t in (-0.002, 0.003)]}}))
        self.refused("expected its 'position', or a 'platform' beside the 'sensor'", lambda document, frame: document.pop("platform"))
        stands = {"position": ["0 m", "0 m", "300 m"], "attitude": {}}
        self.refused("the frame camera has a 'position' of its own, at which it stands", lambda document, frame: frame.update(stands))
        self.refused("with a 'position' needs exactly one of 'look_at' or 'attitude'", lambda document, frame: frame.update(position=stands["position"]))
        self.refused("'attitude' needs the key 'position' beside it", lambda document, frame: frame.update(attitude={}))
        self.refused("with a 'position' needs exactly one of 'look_at' or 'attitude'", lambda document, frame: frame.update(stands, look_at=["0 m", "0 m", "0 m"]))
        self.refused("each row of a frame camera is one of its own", lambda document, frame: (
            frame.update(row_period="1 ms"), document.update(sampling={"accuracy": {"error": "1 %", "of": "image"}})))

    def test_the_same_bytes_for_any_threads(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            document = plate({"exposure": "4 ms", "row_period": "1 ms"}, {**straight((30, 7, 0)), "jitter": {"white": {"roll": "0.5 mrad", "up_to": "200 Hz"}}})
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
                counts = held(name, kind, 12, *{"exposed": (96, 19), "rolling": (1, 131), "both": (16, 41)}[kind])
                every += counts
                print(f"{kind:8s} {name:16s} {counts[0] / counts[1]:.4f} of {counts[1]}; where it moves {counts[2] / max(1, counts[3]):.4f} of {counts[3]}", flush=True)
            print(f"{kind:8s} {'all':16s} {every[0] / every[1]:.4f} of {int(every[1])}; where it moves {every[2] / every[3]:.4f} of {int(every[3])}", flush=True)
    else:
        unittest.main()
