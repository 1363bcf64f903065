"""Frames that are exposed while they fly over curved mirrors and polish: intervals hold the mean over still images from where the camera is at
many instants, glints, highlights and images of hot things in mirrors among them.

The full measure: test_flown_mirrors.py --full."""

import functools
import pathlib
import sys
import tempfile
import unittest

from images import image_of, np
from test_flying_frames import Flight, held

FULL = ("chrome_ball", "mirror_hemisphere", "mirror", "glass_front", "wet_road", "glossy_car")


def flare(moves=True):
    """A small hot ball whose image a mirror ball shows."""
    flight = Flight("chrome_ball", "exposed", moves)
    black = lambda kelvins: {"reflectance": 0, "temperature": f"{kelvins} K"}
    flight.scene = {
        **flight.scene,
        "scene": {"materials": {"ground": black(300), "hot": black(1000), "ball": {"reflectance": 0.9, "scattering": "mirror", "temperature": "300 K"}},
                  "objects": [{"plane": {}, "material": "ground"}, {"sphere": {"center": ["0.2 m", "0.1 m", "0.41 m"], "radius": "0.4 m"}, "material": "ball"},
                              {"sphere": {"center": ["1.1 m", "-0.7 m", "1.1 m"], "radius": "0.03 m"}, "material": "hot"}]},
        "light": {"sky": {"temperature": "300 K"}},
        "sensor": {**flight.scene["sensor"], "channels": [{"name": "mid", "gaussian": {"center": "3.95 um", "fwhm": "0.02 um"}}]}}
    return flight


@functools.cache
def flare_truth(instants=48):
    shares = (np.arange(instants) + 0.5) / instants - 0.5
    still = flare()
    with tempfile.TemporaryDirectory() as scratch:
        return np.mean([image_of(still.still(share * still.exposure_s), pathlib.Path(scratch), {"accuracy": {"error": "2 %"}}, 50 + k)[0]
                        for k, share in enumerate(shares)], axis=0)


def flare_held(moves=True):
    """Of pixels that show it: intervals at 3 % of two images that hold the mean over instants, and all."""
    truth = flare_truth()
    near = truth > 1.05 * truth.min()
    inside = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for seed in (1, 2):
            found, half_width = image_of(flare(moves).document(folder), folder, {"accuracy": {"error": "3 %"}}, seed)
            inside += (np.abs(found - truth) <= half_width)[near].sum()
        return inside, 2 * near.sum()


@unittest.skipIf(np is None, "NumPy not found")
class FlownMirrors(unittest.TestCase):
    def test_intervals_hold_glints(self):
        inside, count, near, of = held("chrome_ball", "exposed", 2, 48, 9)
        self.assertGreater(inside / count, 0.93)
        self.assertGreater(of, 20)
        self.assertGreater(near / of, 0.9)

    def test_a_flight_that_is_not_told_is_noticed(self):
        _, _, near, of = held("chrome_ball", "exposed", 1, 48, 9, truth_moves=False)
        self.assertLess(near / of, 0.6)

    def test_intervals_hold_images_of_a_hot_thing(self):
        inside, count = flare_held()
        self.assertGreater(count, 20)
        self.assertGreater(inside / count, 0.93)
        inside, count = flare_held(moves=False)
        self.assertLess(inside / count, 0.6)


if __name__ == "__main__":
    if "--full" in sys.argv:
        for name in FULL:
            counts = held(name, "exposed", 8, 96, 17)
            print(f"{name:18s} {counts[0] / counts[1]:.4f} of {counts[1]}; where it moves {counts[2] / max(1, counts[3]):.4f} of {counts[3]}", flush=True)
    else:
        unittest.main()
