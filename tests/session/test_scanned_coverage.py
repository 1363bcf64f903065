"""Intervals of images that are scanned, from a platform that shakes too, and swept: how many hold what a grid of thousands of paths a pixel finds.

The scenes are those of benchmarks/honesty. The full measure: test_scanned_coverage.py --full, of eight scenes and 12 seeds."""

import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

from images import SCENES, image_of, np

KINDS = ("scanned", "shaken", "swept")
HEIGHT_M, LINE_S, ELEMENTS = 200.0, 0.01, 4
# Cells of grids along a pixel's side; of one grid the error at an edge along its cells is half of one.
GRIDS, FULL_GRIDS = (83, 97), (149, 171)


def shaking_path(x_m, y_m, speed_m_s, amplitude_rad):
    """Roll, pitch and yaw as sums of eight waves of 5 to 40 Hz, 20 rows in the fastest."""
    draw = np.random.default_rng(7)
    frequency, phase = draw.uniform(5, 40, (3, 8)), draw.uniform(0, 2 * math.pi, (3, 8))
    size = np.array([amplitude_rad, 0.2 * amplitude_rad, amplitude_rad]) * math.sqrt(2 / 8)
    rows = ["time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg"]
    for k in range(-300, 600):
        t = k * 1.25e-3
        roll, pitch, yaw = np.degrees(size * np.sin(2 * math.pi * frequency * t + phase).sum(axis=1))
        rows.append(f"{t:.6f},{x_m},{y_m + speed_m_s * t:.9f},{HEIGHT_M},{yaw:.10f},{pitch:.10f},{roll:.10f}")
    return "\n".join(rows) + "\n"


def document(name, kind, folder):
    """The scene from a platform that flies north over it, with pixels as large on the ground as its own camera's."""
    scene = json.loads(re.sub(r"^\s*//.*$", "", (SCENES / f"{name}.json").read_text(), flags=re.MULTILINE))
    above = scene["sensor"]["camera"]["orthographic"]
    gsd_m, (width, lines) = float(above["gsd"].split()[0]), above["pixels"]
    x_m, middle_m = (float(c.split()[0]) for c in above["center"])
    y_m, speed_m_s, step = middle_m - lines * gsd_m / 2, gsd_m / LINE_S, gsd_m / HEIGHT_M
    scene["platform"] = {"straight": {"frame": "scene", "position": [f"{x_m} m", f"{y_m} m", f"{HEIGHT_M} m"],
                                      "velocity": ["0 m/s", f"{speed_m_s} m/s", "0 m/s"]}}
    if kind != "scanned":
        (folder / "path.csv").write_text(shaking_path(x_m, y_m, speed_m_s, 0.4 * step))
        scene["platform"] = {"table": {"frame": "scene", "file": "path.csv"}}
    if kind == "swept":  # sweeps that overlap by a fifth
        scan = {"pixels": [width, lines], "elements": ELEMENTS, "element_angle": f"{1e3 * step} mrad", "sweep_angle": f"{1e3 * width * step} mrad",
                "period": f"{0.8 * ELEMENTS * LINE_S} s", "sweep_time": "20 ms"}
        scene["sensor"]["camera"] = {"whiskbroom": scan}
    else:
        scene["sensor"]["camera"] = {"pushbroom": {"pixels": [width, lines], "field_of_view": f"{2e3 * math.atan(0.5 * width * step)} mrad",
                                                   "line_period": f"{LINE_S} s"}}
    return scene


def held(name, kind, seeds, grids=GRIDS, narrower=1.0):
    """Of so many images at 3 %: intervals that hold the mean of the grids, and all."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        scene = document(name, kind, folder)
        truth = np.mean([image_of(scene, folder, {"grid": {"elements": [cells, cells]}}, 990 + cells) for cells in grids], axis=0)
        count = inside = 0
        for seed in range(1, seeds + 1):
            found, half_width = image_of(scene, folder, {"accuracy": {"error": "3 %"}}, seed)
            inside += (np.abs(found - truth) <= narrower * half_width).sum()
            count += truth.size
        return inside, count


@unittest.skipIf(np is None, "NumPy not found")
class ScannedCoverage(unittest.TestCase):
    def test_intervals_hold_what_they_say(self):
        for kind in KINDS:
            with self.subTest(kind):
                shares = np.array([held(name, kind, 2) for name in ("gable_roof", "wall_foot")]).sum(axis=0)
                self.assertGreater(shares[0] / shares[1], 0.93)

    def test_intervals_too_narrow_are_noticed(self):
        inside, count = held("gable_roof", "shaken", 2, narrower=0.4)
        self.assertLess(inside / count, 0.93)


if __name__ == "__main__":
    if "--full" in sys.argv:
        for kind in KINDS:
            every = np.zeros(2)
            for name in ("panel_boxes", "container_yard", "gable_roof", "wall_foot", "penumbra", "slab_gaps", "alley", "street_canyon"):
                inside, count = held(name, kind, 12, FULL_GRIDS)
                every += inside, count
                print(f"{kind:8s} {name:16s} {inside / count:.4f} of {count}", flush=True)
            print(f"{kind:8s} {'all':16s} {every[0] / every[1]:.4f} of {int(every[1])}", flush=True)
    else:
        unittest.main()
