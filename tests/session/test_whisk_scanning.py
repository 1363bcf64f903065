"""Scanners that sweep a few elements across the track: images against the mean of many points, from geometry that is worked out here."""

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

SAMPLES, ELEMENTS, SWEEPS = 30, 6, 5
HEIGHT_M, SPEED_M_S, STEP, PERIOD_S, SWEEP_S = 1000.0, 50.0, 1e-3, 0.12, 0.05
ANGLE = math.radians(2.0)  # of a sweep, about 40 degrees to the left: sweeps overlap by a third
ROLL = math.radians(40.0)
GROUND, DISK = 10.0, 30.0  # W m-2 sr-1 um-1


def seen(x, y, sweep, t, roll=ROLL, cone=None):
    """East and north on z = 0 of the place (x, y) of a sweep's picture at a time; a platform that flies north, banked to look to the west."""
    turn = (x - SAMPLES / 2) / SAMPLES * ANGLE
    ahead = (y - ELEMENTS / 2) * STEP
    if cone is None:
        # Towards the west by the roll and the turn; elements ahead along the flight.
        west, north, down = np.sin(roll + turn), ahead, np.cos(roll + turn)
    else:
        s, c = math.sin(cone), math.cos(cone)
        along, below = s + ahead * c, c - ahead * s
        west, north, down = along * np.sin(turn), along * np.cos(turn), below + 0 * turn
    return -HEIGHT_M * west / down, SPEED_M_S * t + HEIGHT_M * north / down


def times(sweep, x, both_ways=False, late_s=0.0, sweep_s=SWEEP_S):
    back = both_ways and sweep % 2 == 1
    return sweep * PERIOD_S + late_s + sweep_s * ((SAMPLES - x) if back else x) / SAMPLES


def expected(disks, cells=40, both_ways=False, late_s=0.0, width=0.0, exposure=1.0, sweep_s=SWEEP_S, **how):
    """The mean of cells x cells points a pixel; of elements so many pitches wide, each point's place beside its middle is shifted as well."""
    at = (np.arange(cells) + 0.5) / cells
    image = np.zeros((SWEEPS * ELEMENTS, SAMPLES))
    per_pitch = STEP / (ANGLE / SAMPLES)
    beside = (np.arange(cells * cells) * (math.sqrt(5) - 1) / 2 % 1 - 0.5).reshape(cells, cells) * width * per_pitch
    for k in range(SWEEPS):
        for j in range(ELEMENTS):
            for i in range(SAMPLES):
                x = i + 0.5 + exposure * (at[None, :] - 0.5)
                east, north = seen(x + beside, j + at[:, None], k, times(k, x, both_ways, late_s, sweep_s), **how)
                covered = np.zeros((cells, cells), bool)
                for x_m, y_m, r in disks:
                    covered |= (east - x_m) ** 2 + (north - y_m) ** 2 < r * r
                image[k * ELEMENTS + j, i] = GROUND + (DISK - GROUND) * covered.mean()
    return image


def document(disks, camera="whiskbroom", roll="40 deg", output=("radiance", "half_width"), **keys):
    objects = [{"disk": {"center": [f"{x} m", f"{y} m", "1 mm"], "normal": [0, 0, 1], "radius": f"{r} m"}, "material": "bright"} for x, y, r in disks]
    scan = {"pixels": [SAMPLES, SWEEPS * ELEMENTS], "elements": ELEMENTS, "focal_length": "0.1 m", "pitch": "0.1 mm", "sweep_angle": "2 deg",
            "period": f"{PERIOD_S} s", "sweep_time": f"{SWEEP_S} s", **keys}
    platform = {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "velocity": ["0 m/s", f"{SPEED_M_S} m/s", "0 m/s"]}}
    if roll:
        platform["mount"] = {"roll": roll}
    return {"ifov": 1,
            "scene": {"materials": {"dark": {"reflectance": GROUND / 100}, "bright": {"reflectance": DISK / 100}},
                      "objects": [{"plane": {}, "material": "dark"}, *objects]},
            "light": {"sky": {"radiance": "100 W m-2 sr-1 um-1"}},
            "platform": platform,
            "sensor": {"camera": {camera: scan}, "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
            "sampling": {"accuracy": {"error": "1 %", "confidence": 0.95}},
            "output": {"products": list(output)}}


WEST_M = HEIGHT_M * math.tan(ROLL)
# Within sweeps, across their overlaps, beside the image's rims and thinner than a pixel.
DISKS = [(-WEST_M, 9.0, 4.0), (-WEST_M + 17.0, 17.0, 3.0), (-WEST_M - 20.0, 12.0, 2.2), (-WEST_M + 8.0, 24.0, 1.0), (-WEST_M - 9.0, 3.0, 5.0),
         (-WEST_M + 27.0, 1.0, 6.0), (-WEST_M + 3.0, 28.0, 0.4)]
CONE = math.radians(50.0)
AHEAD_M = HEIGHT_M * math.tan(CONE)
CONE_DISKS = [(0.0, AHEAD_M + 9.0, 4.0), (13.0, AHEAD_M + 17.0, 3.0), (-15.0, AHEAD_M + 12.0, 2.2), (6.0, AHEAD_M + 24.0, 1.0), (19.0, AHEAD_M + 1.0, 6.0)]


@unittest.skipIf(np is None, "NumPy not found")
class WhiskScanning(unittest.TestCase):
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

    def refused(self, scene):
        (self.folder / "bad.json").write_text(json.dumps(scene, indent=1))
        result = subprocess.run([PROGRAM, "check", "bad.json"], cwd=self.folder, text=True, capture_output=True, timeout=200, check=False)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        return result.stderr

    def cube(self, folder, quantity, kind="f4", bands=1):
        values = np.fromfile(folder / f"image_{quantity}.img", kind)
        return values.reshape(SWEEPS * ELEMENTS, bands, SAMPLES).transpose(1, 0, 2).squeeze().astype(float)

    def misses(self, folder, truth):
        """Shares of pixels, of all and of those that hold an edge, whose interval does not hold the truth, but for the reference's own error."""
        off = np.abs(self.cube(folder, "radiance") - truth)
        outside = off > self.cube(folder, "half_width") + 2e-3 * DISK
        edges = (truth > GROUND + 1e-6) & (truth < DISK - 1e-6)
        self.assertGreater(edges.sum(), 80)
        return outside.mean(), outside[edges].mean()

    def assert_is(self, folder, truth):
        every, of_edges = self.misses(folder, truth)
        self.assertLess(every, 0.03)
        self.assertLess(of_edges, 0.07)

    def test_sweeps_that_overlap_are_what_geometry_says(self):
        folder = self.render(document(DISKS))
        truth = expected(DISKS)
        self.assert_is(folder, truth)
        # What the last line of a sweep sees, the first of the next sees again.
        self.assertLess(abs(truth[ELEMENTS - 1] - truth[ELEMENTS + 1]).max(), 12.0)
        for fault in (expected(DISKS, late_s=0.05 * PERIOD_S), expected(DISKS, roll=ROLL + 0.2 * ANGLE / SAMPLES), expected(DISKS, both_ways=True)):
            self.assertGreater(self.misses(folder, fault)[1], 0.1)

    def test_both_ways(self):
        self.assert_is(self.render(document(DISKS, both_ways=True)), expected(DISKS, both_ways=True))

    def test_elements_have_a_width(self):
        scene = document(DISKS, element_width="0.1 mm", exposure_share=0.8, sweep_time="5 ms")
        folder = self.render(scene)
        self.assert_is(folder, expected(DISKS, width=1.0, exposure=0.8, sweep_s=0.005))
        for fault in (dict(), dict(width=1.0), dict(width=0.9, exposure=0.8)):
            self.assertGreater(self.misses(folder, expected(DISKS, sweep_s=0.005, **fault))[1], 0.1)
        # Within a sample of so slow a sweep the platform moves on.
        scene["sensor"]["camera"]["whiskbroom"]["sweep_time"] = f"{SWEEP_S} s"
        self.assertRegex(self.refused(scene), r"bad\.json:\d+:\d+: what elements 1 pitches wide see is 0\.028 pixels off from what is known of their samples")

    def test_one_fast_sweep_is_the_image_of_a_frame(self):
        """With diffraction's wings, a hot ball smaller than a pixel, a mirror ball with the Sun's glint, boxes and their shadows; x grows to the west, y to the north."""
        n = 24
        scene = {"ifov": 1,
                 "scene": {"materials": {"dark": {"reflectance": 0.1}, "roof": {"reflectance": 0.5}, "chrome": {"reflectance": 0.8, "scattering": "mirror"},
                                         "hot": {"emissivity": 1, "temperature": "1500 K"}},
                           "objects": [{"plane": {}, "material": "dark"},
                                       {"box": {"low": ["-7 m", "-8 m", "0 m"], "high": ["3.3 m", "-2.2 m", "4 m"]}, "material": "roof"},
                                       {"sphere": {"center": ["6.2 m", "7.1 m", "0.5 m"], "radius": "0.1 m"}, "material": "hot"},
                                       {"sphere": {"center": ["-5.4 m", "6.3 m", "1 m"], "radius": "1 m"}, "material": "chrome"}]},
                 "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "160 deg"}}, "sky": {"radiance": "20 W m-2 sr-1 um-1"}},
                 "sensor": {"camera": {"frame": {"focal_length": "0.1 m", "pitch": "0.1 mm", "pixels": [n, n], "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "attitude": {"yaw": "180 deg"}}},
                            "psf": {"airy": {"aperture": "2.2 mm", "wavelength": "2.2 um"}},
                            "channels": [{"name": "swir", "monochromatic": {"at": "2.2 um"}}]},
                 "sampling": {"accuracy": {"error": "2 %"}}, "output": {"products": ["radiance", "half_width"]}}
        framed = self.render(scene, "framed")
        angle = n * STEP  # on the ground the sweep's ends lie 0.0006 pixels off the frame's
        scan = {"pixels": [n, n], "elements": n, "focal_length": "0.1 m", "pitch": "0.1 mm", "sweep_angle": f"{1e3 * angle} mrad", "period": "1 us"}
        moving = json.loads(json.dumps(scene))
        moving["sensor"]["camera"] = {"whiskbroom": scan}
        moving["platform"] = {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "velocity": ["0 m/s", "50 m/s", "0 m/s"]}}
        swept = self.render(moving, "swept")
        read = lambda folder, what: np.fromfile(folder / f"image_{what}.img", "f4").astype(float)
        off, half = np.abs(read(swept, "radiance") - read(framed, "radiance")), np.hypot(read(swept, "half_width"), read(framed, "half_width"))
        self.assertLess((off > half).mean(), 0.03)
        self.assertGreater(read(framed, "radiance").max(), 20.0 * np.median(read(framed, "radiance")))
        shifted = read(framed, "radiance").reshape(n, n)[:, ::-1].ravel()
        self.assertGreater((np.abs(read(swept, "radiance") - shifted) > half).mean(), 0.2)

    def test_modulation_is_told(self):
        """sinc of the exposure times sinc of the width, at half a cycle a sample."""
        scene = document(DISKS, element_width="0.05 mm", exposure_share=0.8, sweep_time="5 ms")
        (self.folder / "scene.json").write_text(json.dumps(scene))
        told = subprocess.run([PROGRAM, "sensor", "scene.json"], cwd=self.folder, text=True, capture_output=True, timeout=200, check=True).stdout
        sinc = lambda x: math.sin(math.pi * x) / (math.pi * x)
        width = 0.5 * STEP / (ANGLE / SAMPLES)
        self.assertIn(f"MTF at 1/2   pixel {sinc(0.4) * sinc(0.5 * width):.3f}", told)

    def test_cones(self):
        folder = self.render(document(CONE_DISKS, "conical", roll=None, cone="50 deg"))
        self.assert_is(folder, expected(CONE_DISKS, cone=CONE))
        self.assertGreater(self.misses(folder, expected(CONE_DISKS, cone=CONE + 0.2e-3))[1], 0.1)

    def test_blur_does_not_reach_into_the_next_sweep(self):
        """Optics spread a small bright disk over what lies beside it in its own sweep; that the next sweep's lines stand below is nothing to it."""
        # On the last line of the second sweep, in the middle of the image, of 3 px about: seen by that sweep, and by the third's second line.
        x, y, k = SAMPLES / 2, ELEMENTS - 0.5, 1
        east, north = seen(np.array(x), np.array(y), k, times(k, x))
        disk = [(float(east), float(north), 2.0)]
        scene = document(disk)
        scene["sensor"]["psf"] = {"gaussian": {"sigma": "1 px"}}
        image = self.cube(self.render(scene), "radiance") - GROUND
        cells = 12
        at = (np.arange(cells) + 0.5) / cells
        truth = np.zeros((SWEEPS * ELEMENTS, SAMPLES))
        for sweep in range(SWEEPS):  # a wide picture of each sweep, blurred, of which its own lines are taken
            pad = 6
            xs, ys = np.arange(-pad, SAMPLES + pad), np.arange(-pad, ELEMENTS + pad)
            px = (xs[:, None] + at[None, :]).ravel()[None, :]
            py = (ys[:, None] + at[None, :]).ravel()[:, None]
            e, n = seen(px, py, sweep, times(sweep, px))
            wide = ((e - disk[0][0]) ** 2 + (n - disk[0][1]) ** 2 < disk[0][2] ** 2).astype(float)
            d = (np.arange(-6 * cells, 6 * cells + 1)) / cells
            for axis, sigma in ((0, 1.0), (1, STEP / (ANGLE / SAMPLES))):  # a pixel of the focal plane, in samples
                kernel = np.exp(-0.5 * (d / sigma) ** 2)
                kernel /= kernel.sum()
                wide = np.apply_along_axis(lambda v: np.convolve(v, kernel, "same"), axis, wide)
            means = wide.reshape(len(ys), cells, len(xs), cells).mean(axis=(1, 3))
            truth[sweep * ELEMENTS:(sweep + 1) * ELEMENTS] = means[pad:-pad, pad:-pad] * (DISK - GROUND)
        self.assertGreater(truth.max(), 3.0)
        self.assertLess(np.abs(image - truth).max(), 0.15)
        mixed = truth.copy()  # as if the lines below were what lies below
        mixed[2 * ELEMENTS:2 * ELEMENTS + 3] = truth[2 * ELEMENTS - 1:2 * ELEMENTS - 4:-1]
        self.assertGreater(np.abs(image - mixed).max(), 0.5)

    def test_places_and_times_of_samples(self):
        scene = document(DISKS, both_ways=True, output=("radiance", "location", "true_location", "time"))
        scene["platform"]["reported"] = {"position_bias": ["0.7 m", "0 m", "0 m"], "mount": {"roll": "40 deg"}}
        folder = self.render(scene)
        at, places, true = self.cube(folder, "time", "f8"), self.cube(folder, "location", "f8", 3), self.cube(folder, "true_location", "f8", 3)
        x = np.arange(SAMPLES) + 0.5
        for line in range(SWEEPS * ELEMENTS):
            k, y = line // ELEMENTS, line % ELEMENTS + 0.5
            t = times(k, x, True)
            self.assertLess(np.abs(at[line] - t).max(), 1e-9)
            east, north = seen(x, y, k, t)
            off = np.hypot(true[0, line] - east, true[1, line] - north)
            self.assertLess(off[true[2, line] < 1e-6].max(), 0.01 * STEP * HEIGHT_M)
            self.assertLess(np.hypot(places[0, line] - east - 0.7, places[1, line] - north)[places[2, line] < 1e-6].max(), 0.01 * STEP * HEIGHT_M)
            self.assertGreater(np.hypot(true[0, line] - east, true[1, line] - seen(x, y, k, t + 0.001)[1]).max(), 0.01 * STEP * HEIGHT_M)

    def test_tiles_and_threads_do_not_matter_and_runs_go_on(self):
        whole = self.render(document(DISKS), "whole", "--threads", "1")
        scene = document(DISKS)
        scene["sampling"]["tile"] = 4
        parts = self.render(scene, "parts")
        again = self.render(document(DISKS), "again", "--threads", "2")
        for quantity in ("radiance", "half_width"):
            self.assertEqual((whole / f"image_{quantity}.img").read_bytes(), (again / f"image_{quantity}.img").read_bytes())
        off = np.abs(self.cube(parts, "radiance") - self.cube(whole, "radiance"))
        self.assertLess((off > np.hypot(self.cube(parts, "half_width"), self.cube(whole, "half_width")) + 1e-4).mean(), 0.02)
        preview = subprocess.run([PROGRAM, "preview", "whole.json", "--output", "small"], cwd=self.folder, text=True, capture_output=True,
                                 timeout=200, check=False)
        self.assertEqual(preview.returncode, 0, preview.stderr)

    def test_runs_are_refined_and_shared_out(self):
        coarse, fine = document(DISKS), document(DISKS)
        coarse["sampling"]["accuracy"]["error"] = "5 %"
        for scene in (coarse, fine):
            scene["sampling"]["tile"] = 8  # four columns of tiles, of six lines
        self.render(coarse, "coarse", "--keep")
        (self.folder / "coarse.json").write_text(json.dumps(fine))
        refined = self.render(fine, "coarse", "--refine")
        self.assert_is(refined, expected(DISKS))
        whole = self.render(fine, "whole")
        for number in (1, 2):
            self.render(fine, f"share{number}", "--tiles", f"{number}/2")
        subprocess.run([PROGRAM, "merge", "share1", "share2", "--output", "merged"], cwd=self.folder, check=True, capture_output=True, timeout=200)
        for quantity in ("radiance", "half_width"):
            self.assertEqual((whole / f"image_{quantity}.img").read_bytes(), (self.folder / "merged" / f"image_{quantity}.img").read_bytes())

    def test_polarization_is_about_the_sweep(self):
        """Glass under an even sky shows light polarized across the plane of incidence, by Fresnel: that of a whiskbroom's turn, and across that of a cone's."""
        def fresnel(angle):
            t = np.arcsin(np.sin(angle) / 1.5)
            s, p = (np.sin(angle - t) / np.sin(angle + t))**2, (np.tan(angle - t) / np.tan(angle + t))**2
            return (s - p) / (s + p)

        turn = (np.arange(SAMPLES) + 0.5 - SAMPLES / 2) / SAMPLES * math.radians(60.0)
        for camera, keys, roll, expected_q in (("whiskbroom", {"sweep_angle": "60 deg"}, None, -fresnel(np.abs(turn))),
                                               ("conical", {"sweep_angle": "60 deg", "cone": "50 deg", "looks": "ahead"}, None, np.full(SAMPLES, fresnel(CONE)))):
            glass = document([], camera, roll, ("radiance", "stokes"), **keys)
            glass["scene"]["materials"] = {"dark": {"scattering": {"smooth": {"n": 1.5, "k": 0, "over": "absorber"}}}}
            glass["sensor"]["stokes"] = True
            glass["sampling"] = {"grid": {"elements": [3, 3]}}
            stokes = self.cube(self.render(glass, camera), "stokes", bands=4)
            middle = slice(ELEMENTS // 2, None, ELEMENTS)
            q, u = (stokes[k, middle] / stokes[0, middle] for k in (1, 2))
            self.assertLess(np.abs(q - expected_q).max(), 2e-3, camera)
            self.assertLess(np.abs(u).max(), 4e-3, camera)
            self.assertGreater(np.abs(q + expected_q).max(), 0.1, "turned by a right angle")

    def test_what_is_refused(self):
        def with_keys(**keys):
            return document(DISKS, **keys)
        self.assertRegex(self.refused(with_keys(pixels=[30, 32])), r"bad\.json:\d+:\d+: 32 lines are not made by whole sweeps of 6 'elements'; expected a "
                                                                  r"multiple, 30 or 36")
        self.assertRegex(self.refused(with_keys(sweep_time="0.2 s")), r"bad\.json:\d+:\d+: 'sweep_time' is longer than 'period', 0\.12 s; expected at most that")
        bare = document(DISKS)
        del bare["sensor"]["camera"]["whiskbroom"]["sweep_time"]
        bare["sensor"]["camera"]["whiskbroom"]["amplitude"] = "0.9 deg"
        self.assertRegex(self.refused(bare), r"bad\.json:\d+:\d+: a line of sight that swings by 0\.9 deg to each side does not sweep over 2 deg; expected "
                                             r"more than 1 deg")
        self.assertRegex(self.refused(with_keys(amplitude="2 deg")), r"bad\.json:\d+:\d+: with 'amplitude' the sweep's time follows from 'period'; expected one of both")
        still = document(DISKS)
        del still["platform"]
        self.assertRegex(self.refused(still), r"bad\.json:\d+:\d+: a whiskbroom camera moves: expected a 'platform' beside the 'sensor'")
        polarized = document(DISKS)
        polarized["sensor"]["channels"][0]["polarizer"] = {"angle": "0 deg"}
        self.assertRegex(self.refused(polarized), r"bad\.json:\d+:\d+: a whiskbroom camera turns its view, and what that does to the polarization of light on its way")
        whole = document(DISKS)
        whole["sampling"]["accuracy"]["of"] = "image"
        self.assertRegex(self.refused(whole), r"bad\.json:\d+:\d+: \"of\": \"image\" takes an image that is one picture, and each sweep of a whiskbroom")


if __name__ == "__main__":
    unittest.main()
