"""Optics of scanners blur on the focal plane: in the image by as many lines, or samples of a sweep, as the ground moves by in a pitch."""

import math
import pathlib
import tempfile
import unittest

from images import image_of, np, run

PIXELS, HEIGHT_M, PITCH_M, SIGMA_PX = 25, 1000.0, 0.5, 0.6
FOCUS = {"focal_length": "50 mm", "pitch": "25 um"}
# A hot plate of a tenth of a pitch: what it is seen by is the pixel's response.
AT_M, PLATE_M = (0.07, 0.13), 0.05


def document(camera, speed_m_s, psf, shift=None):
    middle = lambda sign: [f"{at + sign * PLATE_M / 2} m" for at in AT_M]
    channel = {"name": "thermal", "monochromatic": {"at": "10 um"}, **({"shift": shift} if shift else {})}
    return {
        "ifov": 1,
        "scene": {"materials": {"road": {"reflectance": 0, "temperature": "290 K"}, "hot": {"reflectance": 0, "temperature": "900 K"}},
                  "objects": [{"plane": {}, "material": "road"},
                              {"box": {"low": middle(-1) + ["0 m"], "high": middle(1) + ["0.1 mm"]}, "material": "hot"}]},
        "light": {"sky": {"none": {}}},
        "platform": {"straight": {"frame": "scene", "position": ["0 m", "0 m", f"{HEIGHT_M} m"], "velocity": ["0 m/s", f"{speed_m_s} m/s", "0 m/s"]}},
        "sensor": {"camera": camera, "psf": psf, "channels": [channel]}}


def pushbroom(lines_a_pitch, lines=PIXELS):
    """Its camera and speed, with the middle of its image straight above the scene's."""
    period_s = 0.01
    return {"pushbroom": {**FOCUS, "pixels": [PIXELS, lines], "line_period": f"{period_s} s", "start": f"{-lines / 2 * period_s} s"}}, PITCH_M / lines_a_pitch / period_s


def whiskbroom(samples_a_pitch):
    """As many elements as lines, in one sweep that takes next to no time."""
    turn = PIXELS * PITCH_M / HEIGHT_M / samples_a_pitch
    return {"whiskbroom": {**FOCUS, "pixels": [PIXELS, PIXELS], "elements": PIXELS, "sweep_angle": f"{turn!r} rad", "period": "1 ms", "sweep_time": "0.1 ms"}}, 1.0


def spread(camera, speed_m_s, psf, shift=None):
    """Of the plate's image: middle and standard deviation along x and along y, in pixels."""
    with tempfile.TemporaryDirectory() as folder:
        radiance, _ = image_of(document(camera, speed_m_s, psf, shift), pathlib.Path(folder), {"accuracy": {"error": "0.5 %"}})
    light = radiance.reshape(PIXELS, PIXELS) - np.median(radiance)
    light[light < 1e-3 * light.max()] = 0.0
    at, found = np.arange(PIXELS) + 0.5 - PIXELS / 2, []
    for share in (light.sum(axis=0) / light.sum(), light.sum(axis=1) / light.sum()):
        middle = (share * at).sum()
        found += [middle, math.sqrt((share * (at - middle) ** 2).sum())]
    return found


RADII = np.linspace(0.0, 60.0, 12001) if np is not None else None


def airy_density(r_px, q_px):
    """Of a circular aperture: (pi / 4 q^2) (2 J1(v) / v)^2 with v = pi r / q, J1 by Bessel's integral."""
    if not hasattr(airy_density, "table"):
        v, turn = np.pi * np.maximum(RADII, 1e-9) / q_px, (np.arange(400) + 0.5) * np.pi / 400
        j1 = np.mean([np.cos(t - v * math.sin(t)) for t in turn], axis=0)
        airy_density.table = np.pi / 4 / q_px**2 * (2 * j1 / v) ** 2
    return np.interp(r_px, RADII, airy_density.table)


def wide(blur_px):
    """With the pixel that it is seen by."""
    return math.hypot(blur_px, math.sqrt(1 / 12))


@unittest.skipIf(np is None, "NumPy not found")
class PsfOfScanners(unittest.TestCase):
    GAUSSIAN = {"gaussian": {"sigma": f"{SIGMA_PX} px"}}

    def test_along_the_track(self):
        for lines in (1.0, 1.8, 2.5):
            with self.subTest(lines_a_pitch=lines):
                _, across, along, long = spread(*pushbroom(lines), self.GAUSSIAN)
                self.assertAlmostEqual(across / wide(SIGMA_PX), 1.0, delta=0.006)
                self.assertAlmostEqual(long / wide(SIGMA_PX * lines), 1.0, delta=0.006)
                self.assertAlmostEqual(along, AT_M[1] / PITCH_M * lines, delta=0.01)

    def test_along_a_sweep(self):
        for samples in (1.0, 1.8, 2.5):
            with self.subTest(samples_a_pitch=samples):
                _, across, _, along = spread(*whiskbroom(samples), self.GAUSSIAN)
                self.assertAlmostEqual(across / wide(SIGMA_PX * samples), 1.0, delta=0.006)
                self.assertAlmostEqual(along / wide(SIGMA_PX), 1.0, delta=0.006)

    def test_shifts_are_of_the_focal_plane(self):
        x, _, y, _ = spread(*pushbroom(2.0), self.GAUSSIAN, ["0.8 px", "-1.5 px"])
        self.assertAlmostEqual(x, -AT_M[0] / PITCH_M - 0.8, delta=0.01)
        self.assertAlmostEqual(y, 2.0 * (AT_M[1] / PITCH_M + 1.5), delta=0.02)

    def test_two_short_lines_are_a_long_one(self):
        """By diffraction, cut and wings alike."""
        airy = {"airy": {"aperture": "25 mm"}}
        with tempfile.TemporaryDirectory() as folder:
            image = lambda lines_a_pitch: image_of(document(*pushbroom(lines_a_pitch, PIXELS * lines_a_pitch), airy), pathlib.Path(folder), {"accuracy": {"error": "0.5 %"}})
            (short, short_half), (long, half) = image(2), image(1)
        pairs, pair_half = (a.reshape(PIXELS, 2, PIXELS).mean(axis=1) for a in (short, short_half))
        long, half = long.reshape(PIXELS, PIXELS), half.reshape(PIXELS, PIXELS)
        self.assertGreater(np.mean(np.abs(pairs - long) <= pair_half + half), 0.99)
        self.assertLess(np.abs(pairs - long).max() / (long.max() - np.median(long)), 0.02)

    def test_wings_of_elements_of_a_length(self):
        """What is 3 pixels and more away brings the mean of Airy's density over where an element and its stages look while they are exposed; and intervals know it."""
        q = 10.0 * 50 / 25 / 25
        planck = lambda kelvins: 1.191042972e8 / 10**5 / math.expm1(14387.76877 / 10 / kelvins)
        box = (np.arange(8) + 0.5) / 8 - 0.5
        for kind, lines, keys in (("pushbroom", 1.0, {"element_length": "25 um"}), ("pushbroom", 1.3, {"element_length": "25 um", "stages": 4}),
                                  ("whiskbroom", 1.5, {"element_width": "25 um"})):
            with self.subTest(kind, keys=keys), tempfile.TemporaryDirectory() as folder:
                camera, speed = (pushbroom if kind == "pushbroom" else whiskbroom)(lines)
                camera[kind].update(keys)
                scene = document(camera, speed, {"airy": {"aperture": "25 mm"}})
                scene["scene"]["materials"]["hot"]["temperature"] = "3000 K"
                light, half = (a.reshape(PIXELS, PIXELS) for a in image_of(scene, pathlib.Path(folder), {"accuracy": {"error": "0.5 %"}}))
                at = np.arange(PIXELS) + 0.5 - PIXELS / 2
                stages = [(k - 1.5) * (lines - 1.0) for k in range(4)] if "stages" in keys else [0.0]
                spread = np.array([exposed + element * lines + stage for exposed in box for element in box for stage in stages]) / lines
                if kind == "whiskbroom":
                    x, y, dx, dy = at / lines, at, spread, box
                else:
                    x, y, dx, dy = at, at / lines, box, spread
                x, y = x + AT_M[0] / PITCH_M, y - AT_M[1] / PITCH_M
                r = np.hypot(*np.meshgrid(x, y))
                truth = (planck(3000) - planck(290)) * (PLATE_M / PITCH_M) ** 2 * np.array(
                    [[airy_density(np.hypot(*np.meshgrid(a + dx, b + dy)), q).mean() for a in x] for b in y])
                found = light - planck(290)
                far = r > 3.0
                self.assertGreater(far.sum(), 50)
                # A few hundred paths found the plate: all pixels know it alike.
                self.assertAlmostEqual(found[far].sum() / truth[far].sum(), 1.0, delta=0.06)
                self.assertGreater(np.mean((np.abs(found - truth) <= half)[far]), 0.95)
                self.assertLess((half[far] / light[far]).max(), 0.02)
                self.assertGreater((truth[far] / half[far]).max(), 3.0)

    def test_modulation_along_a_sweep_is_of_its_samples(self):
        camera, speed = whiskbroom(2.0)
        with tempfile.TemporaryDirectory() as folder:
            said = run(document(camera, speed, self.GAUSSIAN), pathlib.Path(folder), command="sensor").stdout
        self.assertIn(f"document's PSF {math.exp(-2 * (math.pi * SIGMA_PX * 2.0 * 0.5) ** 2):.3f}", said)


if __name__ == "__main__":
    unittest.main()
