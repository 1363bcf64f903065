"""Cameras in gimbals and on mounts that move: what is tracked stands still in the image and all else is blurred as kinematics says; places of pixels know how the
camera stood; and what cannot be reached is told."""

import json
import pathlib
import tempfile
import unittest

from images import image_of, np, run
from test_flying_frames import CAR_AT_M, PIXELS, covered, plate, straight

CAR_M_S, EXPOSURE_S = (30, -14, 0), 0.01


def tracked(moves, tracks, error="1 %"):
    """How far pixels' parts of a plate are from where they should be, of one that moves or stands still under a camera that follows a point of it, or something else
    that moves as fast. The platform itself goes elsewhere."""
    document = plate({"exposure": f"{EXPOSURE_S} s"}, straight((-25, 45, 0), (0, 0, 300)))
    car = document["scene"]["objects"][1]
    way = {"straight": {"frame": "scene", "position": ["0 m"] * 3, "velocity": [f"{v} m/s" for v in CAR_M_S]}, "attitude": {"from": "north"}}
    if moves:
        car["motion"] = way
    else:
        hidden = {"name": "mole", "sphere": {"center": ["0 m", "0 m", "-9 m"], "radius": "1 m"}, "material": "road", "motion": way}
        document["scene"]["objects"].append(hidden)
    document["platform"]["mount"] = [{"lever_arm": ["0.2 m", "0 m", "0 m"]}, {"gimbal": {"object": "car" if moves else "mole"}}] if tracks else {}
    with tempfile.TemporaryDirectory() as scratch:
        radiance, _ = image_of(document, pathlib.Path(scratch), {"accuracy": {"error": error}})
    radiance = radiance.reshape(PIXELS, PIXELS)
    part = (radiance - radiance.min()) / (radiance.max() - radiance.min())
    off = part - (covered((0, 0, 0), 0, 0) if moves else covered(CAR_M_S, EXPOSURE_S, 0))
    return max(np.abs(off).max(), np.abs(off.sum(axis=0)).max(), np.abs(off.sum(axis=1)).max())


def oblique(mount, **more):
    """Of a platform whose ground is flat and black."""
    document = plate({"pixels": [15, 15]}, {**straight((20, 60, 1), (-180, -70, 240), yaw="20 deg", roll="4 deg"), "mount": mount, **more})
    document["scene"]["objects"] = document["scene"]["objects"][:1]
    document["output"] = {"products": ["radiance", "location", "true_location"]}
    document["sampling"] = {"grid": {"elements": [1, 1]}}
    return document


def middle_of(document, quantity="location"):
    """What the middle pixel sees."""
    with tempfile.TemporaryDirectory() as scratch:
        done = run(document, pathlib.Path(scratch))
        if done.returncode not in (0, 5, 6):
            raise RuntimeError(done.stderr)
        cube = np.fromfile(pathlib.Path(scratch) / f"out/image_{quantity}.img", "f8").reshape(15, 3, 15)
    return cube[7, :, 7]


@unittest.skipIf(np is None, "NumPy not found")
class Gimbals(unittest.TestCase):
    LIMIT_PX = 0.02
    POINT = (37.0, 52.0, 0.0)

    def test_what_is_tracked_stands_still(self):
        self.assertLess(tracked(moves=True, tracks=True), self.LIMIT_PX)

    def test_what_stands_still_is_blurred_by_what_is_tracked(self):
        self.assertLess(tracked(moves=False, tracks=True), self.LIMIT_PX)

    def test_a_gimbal_that_is_not_there_is_noticed(self):
        self.assertGreater(tracked(moves=True, tracks=False, error="5 %"), 10 * self.LIMIT_PX)

    def test_places_are_those_of_the_point(self):
        point = {"point": {"frame": "scene", "position": [f"{x} m" for x in self.POINT]}}
        bias = np.array([2.0, -3.0, 0.0])
        for axes in ("pitch roll", "pan tilt"):
            with self.subTest(axes):
                biased = oblique([{"roll": "10 deg"}, {"lever_arm": ["1 m", "0 m", "2 m"], "gimbal": {**point, "axes": axes}}],
                                 jitter={"white": {"roll": "0.5 deg", "pitch": "0.5 deg", "up_to": "30 Hz"}},
                                 reported={"position_bias": [f"{x} m" for x in bias]})
                for quantity, moved in (("true_location", 0 * bias), ("location", bias)):
                    self.assertLess(np.abs(middle_of(biased, quantity) - self.POINT - moved).max(), 0.003)  # 0.01 pixel

    def test_places_of_other_frames(self):
        """The scene's origin as a point of the Earth."""
        for point in ({"frame": "geodetic", "longitude": "4.36 deg", "latitude": "52 deg", "height": "43 m"},
                      {"frame": "ecef", "position": ["3923599.3603 m", "299149.2578 m", "5002837.2299 m"]}):
            document = oblique({"gimbal": {"point": point}})
            document["scene"]["origin"] = {"latitude": "52 deg", "longitude": "4.36 deg", "height": "43 m"}
            self.assertLess(np.abs(middle_of(document)).max(), 0.003)

    def test_steps_and_tables_look_where_they_say(self):
        """Both to the right wing by atan(0.5) while it heads north, level: half of the height away."""
        degrees = "-26.56505117707799"
        with tempfile.TemporaryDirectory() as scratch:
            table = pathlib.Path(scratch) / "turns.csv"
            table.write_text(f"time_s,yaw_deg,pitch_deg,roll_deg\n-1,0,0,{degrees}\n1,0,0,{degrees}\n")
            for turned in ({"table": {"file": str(table)}},
                           {"step_stare": {"first": {"roll": "0 deg"}, "step": {"roll": f"{degrees} deg"}, "steps": 4, "period": "2 s", "start": "-3 s"}}):
                document = oblique(turned)
                document["platform"]["attitude"] = {"from": "north"}
                self.assertLess(np.abs(middle_of(document) - (-180 + 120, -70, 0)).max(), 0.003)


def mistaken(change, files=()):
    document = plate({"exposure": "10 ms"}, straight((0, 60, 0), (0, -200, 300)))
    document["scene"]["objects"].append({"name": "boat", "box": {"low": ["20 m", "0 m", "0 m"], "high": ["30 m", "5 m", "2 m"]}, "material": "paint",
                                         "motion": {"straight": {"frame": "scene", "position": ["0 m", "0 m", "0 m"], "velocity": ["5 m/s", "0 m/s", "0 m/s"]}}})
    document["platform"]["mount"] = {"gimbal": {"object": "boat"}}
    change(document["platform"])
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in files:
            (pathlib.Path(scratch) / name).write_text(text)
        done = run(document, pathlib.Path(scratch), command="check")
        lines = (pathlib.Path(scratch) / "scene.json").read_text().splitlines()
    return done, lines


class MistakenMounts(unittest.TestCase):
    def told(self, change, what, files=(), at=None):
        done, lines = mistaken(change, files)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(what, done.stderr)
        if at is not None:
            line = next(k for k, text in enumerate(lines, 1) if at in text)
            self.assertIn(f"scene.json:{line}:", done.stderr)

    def gimbal(self, **keys):
        return lambda platform: platform["mount"]["gimbal"].update(keys)

    def test_a_good_one_is_none(self):
        done, _ = mistaken(lambda platform: None)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_targets(self):
        self.told(self.gimbal(object="bot"), "there is no object 'bot'; did you mean 'boat'?; expected an object that moves ('boat'), or a 'point'", at='"bot"')
        self.told(self.gimbal(object="car"), "'car' does not move; expected an object that moves ('boat'), or a 'point'", at='"object": "car"')
        def point(platform, **keys):
            platform["mount"]["gimbal"] = {"point": keys}
        self.told(lambda p: point(p, frame="geodetic", longitude="4 deg", latitude="52 deg"), "a point about the Earth needs the place of the scene", at='"gimbal"')
        self.told(lambda p: point(p, frame="geodetic", position=["0 m"] * 3), "a geodetic point is told by 'longitude', 'latitude' and 'height'", at='"frame": "geodetic"')
        self.told(lambda p: point(p, frame="scene"), "a point in this frame is told by its 'position' alone")
        self.told(lambda p: point(p, position=["0 m"] * 3), "frame")

    def test_limits(self):
        self.told(self.gimbal(pitch=["-10 deg", "30 deg"]), "the gimbal cannot look at 'boat': that needs a pitch of 33.73 deg, and it reaches -10 to 30 deg", at='"gimbal"')
        self.told(self.gimbal(pitch=["30 deg", "-10 deg"]), "found limits that do not increase", at='"pitch": [')
        self.told(self.gimbal(yaw=["-10 deg", "30 deg"]), "expected limits of 'pitch' and 'roll'", at='"yaw": [')
        # 60 m/s, 200.3 m before it and 300 m above: v h / r^2.
        self.told(self.gimbal(rate="7 deg/s"), "its pitch would turn by 7.926 deg/s, and it turns by at most 7 deg/s", at='"gimbal"')
        done, _ = mistaken(self.gimbal(pitch=["-10 deg", "30 deg"], at_limits="stop"))
        self.assertEqual(done.returncode, 0, done.stderr)
        # The boat is 200 m ahead, and to the east as its path has it; 10 ms of flight are nothing.
        self.assertRegex(done.stderr + done.stdout, r"mount: +gimbal towards 'boat', pitch 30 deg, roll -?[0-9.]+( to -?[0-9.]+)? deg; its pitch is at a limit all the time")

    def test_other_mounts(self):
        def mount(**keys):
            return lambda platform: platform.update(mount=keys)
        steps = {"first": {}, "step": {"roll": "1 deg"}, "steps": 3, "period": "1 s", "slew": "2 s"}
        self.told(mount(step_stare=steps), "leaves no time to stare: expected less than the period of 1 s", at='"slew"')
        self.told(mount(table={"file": "t.csv"}), "found the heading 'x_m'; expected 'time_s'", [("t.csv", "time_s,x_m\n0,1\n")], at='"file"')
        self.told(mount(table={"file": "none.csv"}), "none.csv", at='"file"')
        self.told(mount(table={"file": "t.csv"}), "the mount's table covers 0 to 1 s, and the image is exposed from -0.005 to 0.005 s",
                  [("t.csv", "time_s,yaw_deg,pitch_deg,roll_deg\n0,0,0,0\n1,0,0,0\n")], at='"file"')
        self.told(lambda p: p.update(reported={"mount": [{}, {}]}), "'reported' tells of 2 mounts, and there is one", at='"platform"')


if __name__ == "__main__":
    unittest.main()
