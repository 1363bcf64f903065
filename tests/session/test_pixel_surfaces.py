"""What pixels hold, and in which units: temperatures over their squares, emissivity towards the sensor, radiance by nanometre and within
the channel; against closed forms."""

import csv
import math
import pathlib
import re
import tempfile
import unittest

from images import np, run

CHANNELS = [{"name": "wide", "top_hat": {"from": "8 um", "to": "9.5 um"}}, {"name": "bell", "gaussian": {"center": "10 um", "fwhm": "1 um"}},
            {"name": "line", "monochromatic": {"at": "11 um"}}]
COLUMNS, LINES = 24, 12
COLD, WARM = 290.0, 310.0


def document(materials, objects, products, camera=None, **more):
    return {"ifov": 1, "scene": {"materials": materials, "objects": objects}, "light": {"sky": {"temperature": "260 K"}},
            "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [COLUMNS, LINES], **(camera or {})}}, "channels": CHANNELS},
            "sampling": {"grid": {"elements": [2, 2]}}, "output": {"formats": ["envi"], "products": products}, **more}


@unittest.skipIf(np is None, "numpy is missing")
class PixelSurfaces(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def cubes(self, described, *names, codes=(0,)):
        done = run(described, self.folder)
        self.assertIn(done.returncode, codes, done.stderr)
        return [np.fromfile(self.folder / f"out/image_{name}.img", "<f4").reshape(LINES, -1, COLUMNS).astype(float) for name in names]

    def test_fluxes_of_solved_temperatures(self):
        """A lawn west and east of a wall in the afternoon, and the wall's top, against the points that `ifov temperature` solves in full."""
        rows = ["time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction,global_irradiance_w_m2"]
        for hour in range(25):
            height = 0.313 + 0.565 * math.cos(math.pi / 12 * (hour + 0.3 - 12))
            air = 18 - 5 * math.cos(math.pi / 12 * (hour - 3))
            rows.append(f"2026-06-{21 + hour // 24}T{hour % 24:02d}:00:00Z,{air:.2f},60,2.5,0,{max(0, 1000 * height - 30):.1f}")
        (self.folder / "june.csv").write_text("\n".join(rows) + "\n")
        solved = lambda name: {"reflectance": {"library": name}, "temperature": "solved"}
        box = {"box": {"low": ["2 m", "-6 m", "0 m"], "high": ["3 m", "6 m", "4 m"]}, "material": "wall"}
        weather = {"time": "2026-06-21T15:00:00Z", "weather": {"file": "june.csv"}, "temperatures": {"spin_up": "1 d", "step": "30 min", "repeat_first_day": True}}
        described = document({"lawn": solved("grass, lawn"), "wall": solved("brick, red")}, [{"plane": {}, "material": "lawn"}, box], ["fluxes"],
                             {"pixels": [COLUMNS, 4]}, **weather)
        described["scene"]["origin"] = {"latitude": "52 deg", "longitude": "5 deg"}
        described["sensor"]["channels"] = CHANNELS[:1]
        done = run(described, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = np.fromfile(self.folder / "out/image_fluxes.img", "<f4").reshape(4, 21, COLUMNS).astype(float)
        np.testing.assert_array_equal(found[:, 20], 1.0)
        np.testing.assert_allclose(found[:, :10].sum(axis=1), 0.0, atol=2e-3)
        # Over four lines, along which all is alike: as far off as both say, and by the half-width of the temperature.
        mean, error = found[:, :10].mean(axis=0), np.sqrt((found[:, 10:20] ** 2).mean(axis=0) / 4)
        fluxes = [f"{name}_w_m2" for name in ("sun", "sky", "reflected", "sky_longwave", "ground_longwave", "emitted", "convection", "latent", "power", "conduction")]
        points, allowed = {}, {}
        for column in (4, 14, 16):  # in the Sun, on the wall, in its shadow
            done = run(described, self.folder, "--at", str(column + 0.5 - COLUMNS / 2), "0", "50", "--csv", "point.csv", command="temperature")
            self.assertEqual(done.returncode, 0, done.stderr)
            told = (self.folder / "point.csv").read_text()
            last = [row for row in csv.DictReader(line for line in told.splitlines() if line[0] != "#") if row["light"] == "here"][-1]
            points[column] = np.array([float(last[name]) for name in fluxes])
            half_width_k = float(re.search(r"state \+-([0-9.]+) K", told)[1])
            # W m-2 by kelvin; what is about a point is also the mean of the 64 rays of the full solution.
            slope = np.array([0, 0, 0, 0, 0, 6.5, 25, 30, 0, 60])
            beside = np.array([0, 1, 1, 1, 1, 0, 0, 0, 0, 1]) * 0.15 * (points[column][2] + points[column][4])
            allowed[column] = 3 * error[:, column] + half_width_k * slope + beside + 0.5
            self.assertTrue((np.abs(mean[:, column] - points[column]) <= allowed[column]).all(), (column, mean[:, column], points[column], allowed[column]))
        self.assertGreater(mean[0, 4], 400.0)
        self.assertLess(mean[0, 16], 1.0)
        # The place beside it is not that point: in the shadow there is less of nearly all.
        self.assertGreater((np.abs(mean[:, 16] - points[4]) > allowed[4]).sum(), 4)
        # A temperature that is given tells nothing of what comes and goes.
        given = dict(described, scene={"materials": {"lawn": {"emissivity": 1, "temperature": "290 K"}}, "objects": [{"plane": {}, "material": "lawn"}]})
        (self.folder / "out/image_fluxes.img").unlink()
        self.assertIn(run(given, self.folder).returncode, (0, 6))
        self.assertFalse((self.folder / "out/image_fluxes.img").exists())

    def test_temperatures_over_the_pixel(self):
        """A roof whose lower edge crosses pixels at 10 degrees: the warm share of each is an integral."""
        tangent = math.tan(math.radians(10.0))
        # Warm where y > tangent x: a sheet, turned so, that reaches beyond the image.
        corners = [[-40.0, -40.0 * tangent], [40.0, 40.0 * tangent], [40.0, 40.0], [-40.0, 40.0]]
        described = document({"lawn": {"emissivity": 0.98, "temperature": f"{COLD} K"}, "roof": {"emissivity": 0.9, "temperature": f"{WARM} K"}},
                             [{"plane": {}, "material": "lawn"}, {"mesh": {"file": "roof.obj"}, "material": "roof"}], ["pixel_temperature"])
        (self.folder / "roof.obj").write_text("".join(f"v {x} {y} 1\n" for x, y in corners) + "f 1 2 3\nf 1 3 4\n")
        found, = self.cubes(described, "pixel_temperature", codes=(6,))
        self.assertEqual(found.shape[1], 6)
        mean, spread, lowest, highest, half_width, share = (found[:, k] for k in range(6))
        fine = (np.arange(400) + 0.5) / 400
        x = np.arange(COLUMNS)[None, :, None] - COLUMNS / 2 + fine
        y = LINES / 2 - np.arange(LINES)[:, None, None]  # upper edge of the pixel
        warm = np.clip(y - tangent * x, 0.0, 1.0).mean(axis=2)
        true = COLD + (WARM - COLD) * warm
        mixed = (warm > 0.0) & (warm < 1.0)
        self.assertGreater(mixed.sum(), 20)
        covered = lambda estimate: (np.abs(estimate - true) <= half_width + 1e-3)[mixed].mean()
        self.assertGreaterEqual(covered(mean), 0.95)
        self.assertLess(covered(mean + 3.0), 0.5)
        self.assertLess(half_width[mixed].max(), 2.8)
        np.testing.assert_allclose(mean[~mixed], true[~mixed], atol=1e-3)
        np.testing.assert_array_equal(half_width[~mixed], 0.0)
        np.testing.assert_array_equal(share, 1.0)
        inner = (warm > 0.1) & (warm < 0.9)
        np.testing.assert_allclose(lowest[inner], COLD)
        np.testing.assert_allclose(highest[inner], WARM)
        # Of two temperatures: the spread follows from their shares.
        of_found = (mean - COLD) / (WARM - COLD)
        np.testing.assert_allclose(spread, (WARM - COLD) * np.sqrt(of_found * (1.0 - of_found)), atol=2e-2)

    def test_emissivity_is_what_reflection_leaves(self):
        """Of an absorber behind a smooth boundary, 55 degrees from the normal, by Fresnel's equations; of a plain one as given."""
        zenith, n = math.radians(55.0), 1.5
        described = document({"floor": {"emissivity": 0.83, "temperature": "290 K"},
                              "glaze": {"reflectance": 1, "scattering": {"smooth": {"n": n, "k": 0, "over": "absorber"}}, "temperature": "300 K"}},
                             [{"plane": {}, "material": "floor"},
                              {"box": {"low": ["-30 m", "-30 m", "-1 m"], "high": ["0 m", "30 m", "0 m"]}, "material": "glaze"}],
                             ["emissivity"], {"view_zenith": "55 deg", "view_azimuth": "90 deg"})
        described["scene"]["objects"][1]["box"]["high"][2] = "0.001 m"
        emissivity, = self.cubes(described, "emissivity")
        inside = math.sqrt(1.0 - (math.sin(zenith) / n) ** 2)
        s = (math.cos(zenith) - n * inside) / (math.cos(zenith) + n * inside)
        p = (n * math.cos(zenith) - inside) / (n * math.cos(zenith) + inside)
        self.assertEqual(emissivity.shape, (LINES, 3, COLUMNS))
        np.testing.assert_allclose(emissivity[:, :, -1], 0.83, rtol=1e-5)
        np.testing.assert_allclose(emissivity[:, :, 0], 1.0 - 0.5 * (s * s + p * p), rtol=1e-4)
        self.assertGreater(abs(0.5 * (s * s + p * p) / ((n - 1) / (n + 1)) ** 2 - 1.0), 0.3)  # what the angle changes would show

    def test_units_of_radiance(self):
        words = ["half_width", "radiance_per_nm", "radiance_per_nm_half_width", "band_radiance", "band_radiance_half_width", "photon_radiance", "photon_radiance_half_width"]
        described = document({"lawn": {"emissivity": 0.98, "temperature": "290 K"}, "roof": {"emissivity": 0.9, "temperature": "310 K"}},
                             [{"plane": {}, "material": "lawn"}, {"hemisphere": {"center": ["0 m", "0 m", "0 m"], "radius": "3.3 m"}, "material": "roof"}],
                             words, sampling={"accuracy": {"error": "3 %"}})
        radiance, half, per_nm, per_nm_half, band, band_half, photons, photons_half = self.cubes(described, "radiance", *words, codes=(0, 5, 6))
        self.assertGreater(half.max(), 0.0)
        np.testing.assert_allclose(per_nm, 0.1 * radiance, rtol=1e-6)  # 1 W m-2 um-1 = 100 uW cm-2 in 1000 nm
        np.testing.assert_allclose(per_nm_half, 0.1 * half, rtol=1e-6)
        bell = math.sqrt(math.pi / (4.0 * math.log(2.0)))  # area of a Gaussian of width and height 1; cut at 4 standard deviations
        for channel, width, within in ((0, 1.5, 1e-5), (1, bell, 2e-4)):
            np.testing.assert_allclose(band[:, channel], width * radiance[:, channel], rtol=within)
            np.testing.assert_allclose(band_half[:, channel], width * half[:, channel], rtol=within)
        for channel, um in ((0, 8.75), (1, 10.0), (2, 11.0)):
            of_joule = um * 1e-6 / (6.62607015e-34 * 299792458.0)
            np.testing.assert_allclose(photons[:, channel], of_joule * radiance[:, channel], rtol=1e-6)
            np.testing.assert_allclose(photons_half[:, channel], of_joule * half[:, channel], rtol=1e-6)
        self.assertTrue(np.isnan(band[:, 2]).all(), "a single wavelength has no width")
        header = (self.folder / "out/image_radiance_per_nm.img.hdr").read_text()
        self.assertIn("data units = uW cm-2 sr-1 nm-1", header)
        self.assertIn("data units = W m-2 sr-1\n", (self.folder / "out/image_band_radiance.img.hdr").read_text())


if __name__ == "__main__":
    unittest.main()
