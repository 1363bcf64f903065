"""The parts of the radiance: they add up to it in every pixel under every way of sampling, take no ray, and each is what a
closed form says, which a part that is taken for another is not."""

import array
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
RADIANCES = ("emitted_radiance", "sun_radiance", "sky_radiance", "scene_radiance", "path_radiance")
PARTS = (*RADIANCES, "transmittance")
PRODUCTS = [word + end for word in PARTS for end in ("", "_standard_error")]

# Mirrors, lacquer with highlights, a pane, water, hot and cold things, lamps: light comes by all ways that there are.
MATERIALS = {
    "lawn": {"reflectance": {"table": {"wavelength": ["0.3 um", "0.6 um", "1 um", "14 um"], "values": [0.05, 0.1, 0.4, 0.03]}}, "temperature": "290 K"},
    "wall": {"reflectance": 0.5, "temperature": "305 K"},
    "stove": {"reflectance": 0.1, "temperature": "500 K"},
    "mirror": {"reflectance": 0.9, "scattering": "mirror", "temperature": "285 K"},
    "lacquer": {"reflectance": 0.2, "temperature": "300 K", "scattering": {"rough_dielectric": {"index": 1.5, "roughness": 0.05}}},
    "pane": {"temperature": "295 K", "scattering": {"slab": {"n": 1.5, "k": 1e-6, "thickness": "4 mm"}}},
    "water": {"temperature": "285 K", "scattering": {"smooth": {"n": 1.33, "k": {
        "table": {"wavelength": ["0.3 um", "2 um", "3 um", "14 um"], "values": [1e-8, 1e-5, 0.02, 0.05]}}}}},
}
OBJECTS = [
    {"plane": {"height": "-1 m"}, "material": "lawn"},
    {"box": {"low": ["-30 m", "-30 m", "-1 m"], "high": ["-0.2 m", "30 m", "0 m"]}, "material": "lawn"},
    {"box": {"low": ["0.2 m", "-30 m", "-1 m"], "high": ["30 m", "30 m", "-0.1 m"]}, "material": "water"},
    {"box": {"low": ["-3 m", "1.5 m", "0 m"], "high": ["-1 m", "2 m", "2 m"]}, "material": "wall"},
    {"box": {"low": ["-3.1 m", "-1.5 m", "0 m"], "high": ["-2.6 m", "-0.5 m", "0.6 m"]}, "material": "stove"},
    {"sphere": {"center": ["-1.2 m", "-1.2 m", "0.5 m"], "radius": "0.5 m"}, "material": "mirror"},
    {"sphere": {"center": ["-1.2 m", "0.4 m", "0.5 m"], "radius": "0.5 m"}, "material": "lacquer"},
    {"polygon": {"vertices": [["-2.6 m", "0 m", "0 m"], ["-1.8 m", "0 m", "0 m"], ["-1.8 m", "0 m", "1 m"], ["-2.6 m", "0 m", "1 m"]]}, "material": "pane"},
    {"disk": {"center": ["2 m", "1 m", "0.3 m"], "normal": [0.2, -0.3, 1], "radius": "0.5 m"}, "material": "mirror"},
]
SUN = {"disc": {"zenith": "35 deg", "azimuth": "160 deg"}}
LAMPS = [{"sphere": {"at": ["-2 m", "0.8 m", "1.5 m"], "radius": "8 cm", "flux": "20000 lm", "temperature": "2900 K"}}]
CHANNELS = [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "4 nm"}},
            {"name": "middle", "gaussian": {"center": "3.9 um", "fwhm": "0.02 um"}},
            {"name": "thermal", "gaussian": {"center": "10.5 um", "fwhm": "0.1 um"}}]
CAMERA = {"frame": {"pixels": [6, 5], "focal_length": "20 mm", "pitch": "1.5 mm", "position": ["0 m", "-9 m", "9 m"], "look_at": ["-0.3 m", "0 m", "0 m"]}}
MODELLED = {"profile": "mid-latitude summer", "aerosol": {"type": "rural", "visibility": "23 km"}}
TABULATED = {"tabulated": {"transmittance": 0.8, "path_radiance": "2 W m-2 sr-1 um-1"}}
SAMPLERS = {"single": {"single": {}}, "grid": {"grid": {"elements": [4, 4]}},
            "adaptive": {"adaptive": {"sub_elements": [3, 3], "allowed_difference": "2 %", "max_samples": 60}},
            "pixel": {"accuracy": {"error": "12 %"}}, "image": {"accuracy": {"error": "12 %", "of": "image"}},
            "pooled": {"accuracy": {"error": "12 %", "of": "image", "pooling": True}}}


def yard(sampling, **more):
    """A document with all of that; of its parts, `more` are others, and None leaves one out."""
    described = {"ifov": 1, "scene": {"materials": MATERIALS, "objects": OBJECTS},
                 "light": {"sun": SUN, "sky": {"radiance": "25 W m-2 sr-1 um-1"}, "sources": LAMPS},
                 "sensor": {"camera": CAMERA, "channels": CHANNELS}, "sampling": {**sampling, "tile": 8},
                 "output": {"formats": ["envi"], "products": PRODUCTS}}
    described.update(more)
    return {key: value for key, value in described.items() if value is not None}


class LightParts(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def run_program(self, described, *options, out="out", codes=(0, 5, 6)):
        path = self.folder / "scene.json"
        path.write_text(json.dumps(described))
        run = subprocess.run([PROGRAM, "render", path, "--output", self.folder / out, *options], check=False, capture_output=True,
                             text=True, timeout=200)
        self.assertIn(run.returncode, codes, run.stderr)
        return run

    def cube(self, name, out="out"):
        return array.array("f", (self.folder / out / f"image_{name}.img").read_bytes())

    def rendered(self, described, *options):
        """All parts and the radiance, by name."""
        self.run_program(described, *options, "--no-state")
        return {name: self.cube(name) for name in ("radiance", *PARTS)}

    def sums_off(self, values):
        """The largest share of the radiance by which the parts do not add up to it."""
        total = [sum(at) for at in zip(*(values[name] for name in RADIANCES))]
        return max(abs(a - b) / abs(b) for a, b in zip(total, values["radiance"]))

    def check_sums(self, described, *options):
        values = self.rendered(described, *options)
        self.assertLessEqual(self.sums_off(values), 1e-6)
        self.assertTrue(all(0.0 <= share <= 1.0 + 1e-6 for share in values["transmittance"]))
        # A part that is left out, or counted twice, is missed.
        for name in RADIANCES:
            if max(map(abs, values[name])) > 1e-3 * max(values["radiance"]):
                self.assertGreater(self.sums_off({**values, name: array.array("f", [1.001 * value for value in values[name]])}), 1e-6)
        return values

    # Sums

    def test_sums_under_every_way_of_sampling(self):
        for name, sampling in SAMPLERS.items():
            with self.subTest(sampler=name):
                asked = yard(sampling, atmosphere=TABULATED)
                values = self.check_sums(asked)
                for part in RADIANCES:
                    self.assertGreater(max(values[part]), 0.0, part)
                self.check_without(asked, values["radiance"], name in ("image", "pooled"))

    def check_without(self, asked, radiance, in_double_precision):
        """The same rays, the same radiance and intervals where parts are not asked for."""
        asked["output"] = {"formats": ["envi"], "products": ["samples"]}
        self.run_program(asked, "--no-state", out="without")
        rays = [json.loads((self.folder / out / "image_run.json").read_text())["cost"]["rays"] for out in ("out", "without")]
        self.assertEqual(*rays)
        if in_double_precision:  # sums of a pixel's values are so with them alone
            self.assertLess(max(abs(a / b - 1.0) for a, b in zip(radiance, self.cube("radiance", "without"))), 1e-4)
        else:
            self.assertEqual(radiance, self.cube("radiance", "without"))
            if (self.folder / "out" / "image_half_width.img").exists():
                self.assertEqual(self.cube("half_width"), self.cube("half_width", "without"))

    def test_sums_in_modelled_air(self):
        light = {"sun": SUN, "sources": LAMPS, "surroundings": {"reflectance": 0.3, "temperature": "290 K"}}
        for name in ("pixel", "pooled"):
            with self.subTest(sampler=name):
                values = self.check_sums(yard(SAMPLERS[name], atmosphere=MODELLED, light=light))
                self.assertLess(max(values["transmittance"]), 1.0)

    def test_sums_with_polarization(self):
        sensor = {"camera": CAMERA, "channels": [{**channel, "polarizer": {"angle": "30 deg"}} for channel in CHANNELS[:1]] + CHANNELS[1:]}
        light = {"sun": SUN, "surroundings": {"reflectance": 0.3}}
        for more in ({"stokes": True}, {}):
            with self.subTest(**more):
                self.check_sums(yard(SAMPLERS["grid"], atmosphere=MODELLED, light=light, sensor={**sensor, **more}))

    def test_sums_with_wings_and_maps_and_the_suns_disc_itself(self):
        (self.folder / "warm.img").write_bytes(array.array("f", [285.0 + (7 * k) % 30 for k in range(256)]).tobytes())
        (self.folder / "warm.hdr").write_text("ENVI\nsamples = 16\nlines = 16\nbands = 1\nheader offset = 0\nfile type = ENVI Standard\n"
                                              "data type = 4\ninterleave = bsq\nbyte order = 0\n")
        warm = {"file": "warm.img", "low_left": ["-5 m", "-5 m"], "size": ["10 m", "10 m"], "unit": "K"}
        materials = {**MATERIALS, "lawn": {"reflectance": 0.2, "temperature": {"map": warm}}}
        from_above = {"camera": {"orthographic": {"gsd": "1 m", "pixels": [6, 6]}}, "channels": CHANNELS[1:]}
        for objects in (OBJECTS[:1], [OBJECTS[0], OBJECTS[4]]):  # maps are control variates there
            self.check_sums(yard({"accuracy": {"error": "0.5 %"}}, scene={"materials": materials, "objects": objects}, sensor=from_above,
                                 light={"sun": SUN, "sky": {"temperature": "260 K"}}))
        sensor = {"camera": CAMERA, "channels": CHANNELS, "psf": {"gaussian": {"sigma": "0.6 px"}}}
        self.check_sums(yard(SAMPLERS["pixel"], sensor=sensor))
        upwards = {"frame": {**CAMERA["frame"], "position": ["0 m", "0 m", "3 m"], "look_at": ["0 m", "-0.7 m", "4 m"]}}
        values = self.check_sums(yard(SAMPLERS["pixel"], sensor={"camera": upwards, "channels": CHANNELS}, atmosphere=TABULATED))
        self.assertGreater(max(values["sun_radiance"]), 10.0 * max(values["path_radiance"]))

    # What it costs, and who carries it

    def test_shares_and_threads_and_refinements_carry_them(self):
        asked = yard(SAMPLERS["pixel"], atmosphere=TABULATED)
        self.run_program(asked, "--threads", "2", "--no-state", out="whole")
        folders = [self.folder / f"share{share}" for share in (1, 2)]
        for share, folder in enumerate(folders, 1):
            self.run_program(asked, "--threads", "1", "--tiles", f"{share}/2", out=folder.name)
        merged = subprocess.run([PROGRAM, "merge", *folders, "--output", self.folder / "merged"], check=False, capture_output=True, text=True)
        self.assertIn(merged.returncode, (0, 5, 6), merged.stderr)
        for product in PRODUCTS:
            self.assertEqual(*((self.folder / out / f"image_{product}.img").read_bytes() for out in ("whole", "merged")), product)
        self.run_program(asked, "--keep", out="kept")
        asked["sampling"]["accuracy"]["error"] = "6 %"
        self.run_program(asked, "--refine", out="kept")
        values = {name: self.cube(name, "kept") for name in ("radiance", *PARTS)}
        self.assertLessEqual(self.sums_off(values), 1e-6)

    # Each part

    def part_of_plane(self, objects=(), light=None, seen_from=("0 m", "0 m", "10 m"), ground=None, **more):
        """Parts of one small pixel at the origin of a plane, at 0.1 %, with their standard errors."""
        camera = {"frame": {"pixels": [1, 1], "focal_length": "100 mm", "pitch": "0.1 mm", "position": list(seen_from),
                            "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}}
        materials = {"ground": {"reflectance": 0.3, "temperature": "300 K", **(ground or {})}, "black": {"reflectance": 0, "temperature": "350 K"},
                     "grey": {"reflectance": 0.6, "temperature": "350 K"}}
        described = {"ifov": 1, "scene": {"materials": materials, "objects": [{"plane": {}, "material": "ground"}, *objects]},
                     "light": light or {"sky": {"none": {}}},
                     "sensor": {"camera": camera, "channels": [{"name": "thermal", "monochromatic": {"at": "10 um"}}]},
                     "sampling": {"accuracy": {"error": "0.1 %"}}, "output": {"formats": ["envi"], "products": PRODUCTS}, **more}
        values = self.rendered(described)
        self.assertLessEqual(self.sums_off(values), 1e-6)
        return {name: (values[name][0], self.cube(name + "_standard_error")[0]) for name in PARTS}

    @staticmethod
    def agree(parts, expected):
        """Within 1e-5, and four standard errors."""
        return all(abs(parts[name][0] - expected.get(name, 0.0)) <= 1e-5 * max(abs(expected.get(name, 0.0)), 1e-6) + 4.0 * parts[name][1]
                   for name in PARTS)

    def check_parts(self, parts, expected):
        self.assertTrue(self.agree(parts, expected), (parts, expected))
        # What one part has, given to another, is noticed.
        names = [name for name in RADIANCES if expected.get(name)]
        for name in names:
            other = RADIANCES[(RADIANCES.index(name) + 1) % len(RADIANCES)]
            wrong = {**expected, name: 0.95 * expected[name], other: expected.get(other, 0.0) + 0.05 * expected[name]}
            self.assertFalse(self.agree(parts, wrong), name)

    @staticmethod
    def planck(kelvin, um=10.0):
        return 1.191042972397188e8 / um**5 / math.expm1(1.438776877e4 / (um * kelvin))

    def test_what_an_isothermal_plane_emits(self):
        parts = self.part_of_plane(atmosphere={"tabulated": {"transmittance": 0.75, "path_radiance": "1.5 W m-2 sr-1 um-1"}})
        self.check_parts(parts, {"emitted_radiance": 0.75 * 0.7 * self.planck(300.0), "path_radiance": 1.5, "transmittance": 0.75})

    def test_sun_and_even_sky_on_a_lambertian_plane(self):
        light = {"sun": {"point": {"zenith": "60 deg", "azimuth": "90 deg", "distance": "1 au", "spectrum": "800 W m-2 um-1"}},
                 "sky": {"radiance": "20 W m-2 sr-1 um-1"}}
        parts = self.part_of_plane(light=light)
        self.check_parts(parts, {"emitted_radiance": 0.7 * self.planck(300.0), "sun_radiance": 0.3 / math.pi * 400.0, "sky_radiance": 6.0,
                                 "transmittance": 1.0})

    def test_a_black_disc_above(self):
        """Of the hemisphere over the middle a parallel disc of radius r at height h fills r^2/(r^2 + h^2)."""
        disc = {"disk": {"center": ["0 m", "0 m", "2 m"], "normal": [0, 0, 1], "radius": "1 m"}, "material": "black"}
        parts = self.part_of_plane([disc], {"sky": {"radiance": "5 W m-2 sr-1 um-1"}}, seen_from=("0 m", "-10 m", "5 m"))
        share = 1.0 / 5.0
        self.check_parts(parts, {"emitted_radiance": 0.7 * self.planck(300.0), "sky_radiance": 0.3 * 5.0 * (1.0 - share),
                                 "scene_radiance": 0.3 * share * self.planck(350.0), "transmittance": 1.0})

    def test_two_parallel_plates(self):
        """Endless grey plates: J1 = e1 B1 + r1 J2, J2 = e2 B2 + r2 J1; what the lower has of the upper is r1 J2."""
        roof = {"disk": {"center": ["0 m", "0 m", "20 m"], "normal": [0, 0, 1], "radius": "200 km"}, "material": "grey"}
        parts = self.part_of_plane([roof], {"sky": {"radiance": "20 W m-2 sr-1 um-1"}})
        lower, upper = 0.7 * self.planck(300.0), 0.4 * self.planck(350.0)
        self.check_parts(parts, {"emitted_radiance": lower, "scene_radiance": 0.3 * (upper + 0.6 * lower) / (1.0 - 0.3 * 0.6), "transmittance": 1.0})

    def test_what_is_seen_in_a_mirror_comes_from_the_scene(self):
        wall = {"disk": {"center": ["0 m", "10 m", "5 m"], "normal": [0, -1, 0], "radius": "4 m"}, "material": "black"}
        parts = self.part_of_plane([wall], seen_from=("0 m", "-10 m", "5 m"), ground={"reflectance": 0.9, "scattering": "mirror"})
        self.check_parts(parts, {"emitted_radiance": 0.1 * self.planck(300.0), "scene_radiance": 0.9 * self.planck(350.0), "transmittance": 1.0})

    # Refused

    def test_irradiances_have_no_parts(self):
        points = {"points": {"at": [{"position": ["0 m", "0 m", "0 m"]}]}, "channels": CHANNELS}
        run = self.run_program(yard(SAMPLERS["pixel"], sensor=points), codes=(1,))
        self.assertRegex(run.stderr, r"scene\.json:\d+:\d+: output\.products has 'emitted_radiance', .* and 'transmittance_standard_error': "
                                     r"sensor\.points measures irradiance, whose parts are not told; that of cameras, distant, hemisphere and "
                                     r"rays is radiance")

    def test_single_views_of_an_area_have_them(self):
        distant = {"distant": {"directions": [{"zenith": "20 deg"}, {"zenith": "50 deg"}], "size": ["4 m", "4 m"]}, "channels": CHANNELS}
        self.check_sums(yard(SAMPLERS["pixel"], sensor=distant))


if __name__ == "__main__":
    unittest.main()
