"""What moves before mirrors, panes and gloss that stand still: intervals hold the mean over images in which it stands where it is at many
instants.

The full measure: test_moving_before_mirrors.py --full, of seven scenes and 8 seeds."""

import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

from images import SCENES, image_of, np

EXPOSURE_S, AWAY_M, INSTANTS = 0.01, 200.0, 24

# By scene, in metres: half the sides of a box, where it is in the middle of the exposure, and its way meanwhile.
VEHICLES = {
    "chrome_ball": ((0.25, 0.15, 0.05), (0.45, -0.1, 1.3), (0.7, 0.3, 0.0)),
    "mirror_hemisphere": ((0.8, 0.5, 0.1), (1.4, -0.6, 3.4), (2.2, 1.0, 0.0)),
    "mirror": ((0.7, 0.4, 0.9), (-5.0, -0.6, 2.4), (0.3, 2.0, 0.3)),
    "facade": ((1.0, 0.5, 1.0), (-1.0, -4.0, 1.0), (3.0, 0.2, 0.0)),
    "glass_front": ((0.5, 0.3, 0.5), (0.3, -0.9, 0.9), (2.0, 0.0, 0.0)),
    "wet_road": ((0.6, 0.4, 0.4), (-0.5, 0.3, 0.42), (2.2, 0.0, 0.0)),
    "glossy_car": ((0.5, 0.3, 0.1), (0.5, -0.7, 2.2), (1.3, 0.6, 0.0))}
SHORT = ("chrome_ball", "facade")


def seen(name, moves=True, share=None):
    """The scene under a frame; the vehicle moves along, or stands where it is at a share of its exposure from the middle."""
    scene = json.loads(re.sub(r"^\s*//.*$", "", (SCENES / f"{name}.json").read_text(), flags=re.MULTILINE))
    above = scene["sensor"]["camera"]["orthographic"]
    number = lambda text: float(text.split()[0])
    gsd_m, (width, lines) = number(above["gsd"]), above["pixels"]
    zenith, azimuth = (math.radians(number(above.get(f"view_{what}", "0 deg"))) for what in ("zenith", "azimuth"))
    # Off the pixels' rims: of a grid all cells along an edge err alike.
    target = [number(c) + off * gsd_m for c, off in zip(above["center"], (0.137, 0.071))] + [0.0]
    towards = (math.sin(zenith) * math.sin(azimuth), math.sin(zenith) * math.cos(azimuth), math.cos(zenith))
    rotation = math.radians(number(above.get("rotation", "0 deg")))
    up = [math.sin(rotation), math.cos(rotation), 0.0] if zenith == 0.0 else [0.0, 0.0, 1.0]
    scene["sensor"]["camera"] = {"frame": {
        "focal_length": "100 mm", "pitch": f"{100 * gsd_m / AWAY_M} mm", "pixels": [width, lines],
        "position": [f"{t + AWAY_M * d!r} m" for t, d in zip(target, towards)],
        "look_at": [f"{t} m" for t in target], "up": up, "exposure": f"{EXPOSURE_S} s"}}
    half, at, way = VEHICLES[name]
    scene["scene"]["materials"]["vehicle"] = {"reflectance": 0.6}
    box = {"name": "vehicle", "material": "vehicle", "box": {"low": [f"{-h} m" for h in half], "high": [f"{h} m" for h in half]}}
    if share is None:
        box["motion"] = {"straight": {"frame": "scene", "position": [f"{a} m" for a in at],
                                      "velocity": [f"{w / EXPOSURE_S if moves else 0.0} m/s" for w in way]}, "attitude": {"from": "north"}}
    else:
        box["transform"] = {"translate": [f"{a + share * w!r} m" for a, w in zip(at, way)]}
    scene["scene"]["objects"].append(box)
    return scene


def truth_of(name, folder, instants, cells):
    """The mean over instants, and of the same where it stands in the middle."""
    shares = (np.arange(instants) + 0.5) / instants - 0.5
    still = lambda share, k: image_of(seen(name, share=share), folder, {"grid": {"elements": [cells + k % 7, cells + k % 7]}}, 700 + k)
    moving = np.mean([still(share, k) for k, share in enumerate(shares)], axis=0)
    return moving, np.mean([still(0.0, k) for k in range(max(2, instants // 5))], axis=0)


def held(name, seeds, instants=INSTANTS, cells=17, moves=True):
    """Of so many images at 3 %: intervals that hold the truth, and all; then the same of pixels that show that it moves."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        truth, still = truth_of(name, folder, instants, cells)
        near = np.abs(truth - still) > 0.02 * truth
        counts, worst = np.zeros(4, int), 0.0
        for seed in range(1, seeds + 1):
            found, half_width = image_of(seen(name, moves), folder, {"accuracy": {"error": "3 %"}}, seed)
            inside = np.abs(found - truth) <= half_width
            counts += inside.sum(), inside.size, inside[near].sum(), near.sum()
            worst = max(worst, (np.abs(found - truth) / half_width).max())
        return counts, worst


@unittest.skipIf(np is None, "NumPy not found")
class MovingBeforeMirrors(unittest.TestCase):
    def test_intervals_hold_what_they_say(self):
        for name in SHORT:
            with self.subTest(name):
                (inside, count, near, of), _ = held(name, 2)
                self.assertGreater(inside / count, 0.93)
                self.assertGreater(of, 10)
                self.assertGreater(near / of, 0.93)

    def test_what_stands_still_is_noticed(self):
        (_, _, near, of), _ = held("facade", 1, instants=12, moves=False)
        self.assertLess(near / of, 0.6)

    def test_images_of_a_small_hot_thing_are_in_the_interval(self):
        """Paths seldom meet them in a ball that mirrors: the mean over instants at which they are sought by its shape."""
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            shares = (np.arange(24) + 0.5) / 24 - 0.5
            truth = np.mean([image_of(flare(share), folder, {"accuracy": {"error": "1 %"}}, 50)[0] for share in shares], axis=0)
            without = image_of(flare(0.0, hot=False), folder, {"accuracy": {"error": "1 %"}}, 50)[0]
            found, half_width = image_of(flare(), folder, {"accuracy": {"error": "3 %"}})
        shown = np.abs(truth - without) > 0.03 * without
        self.assertGreater(shown.sum(), 3, "its image matters")
        self.assertGreater(np.mean(np.abs(found - truth) <= half_width), 0.97)
        self.assertGreater(np.mean((np.abs(found - truth) <= half_width)[shown]), 0.93)
        self.assertTrue(np.all((half_width > 0.05 * found)[shown]), "what paths may not have met is told")


def flare(share=None, hot=True):
    """A ball that mirrors, past which something small flies that is 3.3 times as hot; not beneath the camera, whose view it would cross."""
    kelvins, speed, exposure = 1000.0, 300.0, 0.01
    small = {"name": "flare", "material": "hot" if hot else "cold", "sphere": {"center": ["0 m", "0 m", "0 m"], "radius": "0.006 m"}}
    if share is None:
        small["motion"] = {"straight": {"frame": "scene", "position": ["2.2 m", "-0.4 m", "2.4 m"], "velocity": ["0 m/s", f"{speed} m/s", "0 m/s"]}, "attitude": {"from": "north"}}
    else:
        small["transform"] = {"translate": ["2.2 m", f"{-0.4 + share * exposure * speed!r} m", "2.4 m"]}
    return {
        "ifov": 1,
        "scene": {"materials": {"ground": {"reflectance": 0, "temperature": "300 K"}, "hot": {"reflectance": 0, "temperature": f"{kelvins} K"},
                                "cold": {"reflectance": 0, "temperature": "300 K"}, "ball": {"reflectance": 0.9, "scattering": "mirror", "temperature": "300 K"}},
                  "objects": [{"plane": {}, "material": "ground"}, {"sphere": {"center": ["0 m", "0 m", "1 m"], "radius": "1 m"}, "material": "ball"}, small]},
        "light": {"sky": {"temperature": "300 K"}},
        "sensor": {"camera": {"frame": {"focal_length": "50 mm", "pitch": "50 um", "pixels": [16, 16], "position": ["0 m", "0 m", "200 m"], "attitude": {},
                                        "exposure": f"{exposure} s" if share is None else "0 s"}},
                   "channels": [{"name": "mid", "gaussian": {"center": "3.95 um", "fwhm": "0.02 um"}}]}}


if __name__ == "__main__":
    if "--full" in sys.argv:
        for name in VEHICLES:
            counts, worst = held(name, 8, 120, 31)
            print(f"{name:18s} {counts[0] / counts[1]:.4f} of {counts[1]}; where it moves {counts[2] / max(1, counts[3]):.4f} of {counts[3]}; worst {worst:.2f}", flush=True)
    else:
        unittest.main()
