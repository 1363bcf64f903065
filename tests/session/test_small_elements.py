"""Elements that fill a part of their pixel, or lines of a part of their period: few of a pixel's values weigh, and what those have not met joins the interval. Rows of a
rolling shutter that flies: each is a tile by itself, in which a few hundred values that agree are not all there is."""

import pathlib
import tempfile
import unittest

from images import image_of, np

PIXELS, HEIGHT_M, GSD_M = 14, 200.0, 0.5
# Dark boxes under a sky that outshines them: of paths from the ground about one in ten meets one.
BOXES = (((0.68, -1.40, 81), (0.54, 1.42, 0.71)), ((-2.52, 0.33, 86), (1.31, 0.27, 0.79)), ((-0.46, -1.99, 70), (0.29, 0.44, 1.75)), ((-0.70, 1.48, 80), (0.38, 0.72, 1.36)))


def document(camera, fill_factor, platform=None):
    metres = lambda *lengths: [f"{length} m" for length in lengths]
    boxes = [{"box": {"low": metres(-w / 2, -l / 2, 0), "high": metres(w / 2, l / 2, h)}, "material": "box",
              "transform": {"rotate": {"angle": f"{turn} deg"}, "translate": metres(x, y, 0)}} for (x, y, turn), (w, l, h) in BOXES]
    return {
        "ifov": 1,
        "scene": {"materials": {"ground": {"reflectance": 0.12, "temperature": "295 K"}, "box": {"reflectance": 0.03, "temperature": "330 K"}},
                  "objects": [{"plane": {}, "material": "ground"}, *boxes]},
        "light": {"sky": {"radiance": "40 W m-2 sr-1 um-1"}, "surroundings": {"reflectance": 0.12, "temperature": "295 K"}},
        "sensor": {"camera": camera, "fill_factor": fill_factor, "channels": [{"name": "thermal", "gaussian": {"center": "10 um", "fwhm": "0.2 um"}}]},
        **({"platform": platform} if platform else {})}


def frame():
    return {"frame": {"focal_length": "100 mm", "pitch": "0.25 mm", "pixels": [PIXELS] * 2, "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "attitude": {}}}, None


def short_lines():
    period_s = 0.01
    return ({"pushbroom": {"focal_length": "100 mm", "pitch": "0.25 mm", "pixels": [PIXELS] * 2, "line_period": f"{period_s} s", "start": f"{-PIXELS / 2 * period_s} s",
                           "exposure": f"{0.25 * period_s} s"}},
            {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "velocity": ["0 m/s", f"{GSD_M / period_s} m/s", "0 m/s"]}})


def flying_rows():
    return ({"frame": {"focal_length": "100 mm", "pitch": "0.25 mm", "pixels": [PIXELS] * 2, "row_period": "1 ms"}},
            {"straight": {"frame": "scene", "position": ["2.5 m", "1 m", f"{HEIGHT_M} m"], "velocity": ["37 m/s", "-26 m/s", "-23 m/s"]}, "attitude": {"from": "north", "yaw": "7 deg"}})


@unittest.skipIf(np is None, "NumPy not found")
class SmallElements(unittest.TestCase):
    def test_intervals_hold(self):
        for camera, fill_factor, narrower in ((frame, 0.25, 0.5), (short_lines, 1.0, 0.5), (flying_rows, 1.0, 0.25)):
            with self.subTest(camera.__name__), tempfile.TemporaryDirectory() as scratch:
                folder, (described, platform) = pathlib.Path(scratch), camera()
                scene = document(described, fill_factor, platform)
                truth = image_of(scene, folder, {"grid": {"elements": [121, 121]}}, 77)
                off = []
                for seed in range(1, 6):
                    found, half = image_of(scene, folder, {"accuracy": {"error": "2 %"}}, seed)
                    off.append(np.abs(found - truth) / np.maximum(half, 1e-9))
                off = np.concatenate(off)
                self.assertGreater(np.mean(off <= 1), 0.96)
                self.assertLess(np.mean(off > 2), 0.005)
                self.assertLess(np.mean(off <= narrower), 0.93, "intervals so much narrower would be noticed")


if __name__ == "__main__":
    unittest.main()
