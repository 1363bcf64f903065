"""Several instruments on one platform in one run: each one's products are those of the same document with that instrument as its
sensor, byte for byte; and what is said where none is chosen, or one that there is not."""

import json
import pathlib
import re
import subprocess
import tempfile
import unittest

from images import PROGRAM, ROOT, np

CHANNELS = {"red": {"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
            "warm": {"name": "warm", "top_hat": {"from": "10 um", "to": "12 um"}}}
OLI = {"camera": {"pushbroom": {"pixels": [12, 10], "focal_length": "20 mm", "pitch": "0.2 mm", "line_period": "20 ms"}},
       "channels": [CHANNELS["red"]]}
TIRS = {"camera": {"frame": {"pixels": [6, 5], "focal_length": "20 mm", "pitch": "0.4 mm"}}, "channels": [CHANNELS["warm"]],
        "psf": {"gaussian": {"sigma": "0.4 px"}}}


def document(**more):
    described = {"ifov": 1, "seed": 3,
                 "scene": {"materials": {"lawn": {"reflectance": 0.1, "temperature": "290 K"}, "roof": {"reflectance": 0.4, "temperature": "310 K"}},
                           "objects": [{"plane": {}, "material": "lawn"},
                                       {"box": {"low": ["-3 m", "-2 m", "0 m"], "high": ["4 m", "3 m", "2 m"]}, "material": "roof"}]},
                 "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "160 deg"}}, "sky": {"radiance": "40 W m-2 sr-1 um-1"}},
                 "platform": {"straight": {"frame": "scene", "position": ["0 m", "0 m", "100 m"], "velocity": ["0 m/s", "50 m/s", "0 m/s"]}},
                 "instruments": {"oli": OLI, "tirs": TIRS},
                 "sampling": {"accuracy": {"error": "3 %"}}, "output": {"products": ["half_width", "samples", "location"]}}
    described.update(more)
    return {key: value for key, value in described.items() if value is not None}


class Instruments(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def call(self, command, described, *more, codes=(0, 5, 6), name="scene.json"):
        (self.folder / name).write_text(json.dumps(described, indent=1))
        done = subprocess.run([PROGRAM, command, name, *more], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, codes, done.stderr)
        return done

    def cubes(self, folder):
        found = {path.name: path.read_bytes() for path in (self.folder / folder).glob("*.img")}
        self.assertIn("image_radiance.img", found)
        return found

    def test_each_is_as_alone(self):
        done = self.call("render", document())
        self.assertEqual(sorted(path.name for path in (self.folder / "scene.out").iterdir()), ["oli", "tirs"])
        self.assertRegex(done.stdout, r"(?s)oli:\n.*tirs:\n")
        for name, sensor in (("oli", OLI), ("tirs", TIRS)):
            self.call("render", document(), "--set", f"instrument={name}", "-o", f"chosen_{name}")
            self.call("render", document(instruments=None, sensor=sensor), "-o", f"alone_{name}", name="alone.json")
            cubes = self.cubes(f"scene.out/{name}")
            self.assertEqual(set(cubes), {"image_radiance.img", "image_half_width.img", "image_samples.img", "image_location.img"})
            self.assertEqual(cubes, self.cubes(f"chosen_{name}"))
            self.assertEqual(cubes, self.cubes(f"alone_{name}"))
        self.assertNotEqual(self.cubes("scene.out/oli"), self.cubes("scene.out/tirs"))
        # Of one that is chosen products go where those of all would.
        before = self.cubes("scene.out/tirs")
        self.call("render", document(seed=4), "--set", "instrument=tirs")
        self.assertNotEqual(self.cubes("scene.out/tirs"), before)
        # The record holds a document of this instrument alone, which renders the same.
        text = json.loads((self.folder / "scene.out/oli/image_run.json").read_text())["document"]["text"]
        (self.folder / "again.json").write_text(text)
        done = subprocess.run([PROGRAM, "render", "again.json", "-o", "again"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        self.assertEqual(self.cubes("again"), self.cubes("scene.out/oli"))

    def test_each_has_mounts_of_its_own(self):
        """On the platform's: as a document whose platform has them all; and lenses apart see places as far apart."""
        lens = {"camera": {"frame": {"pixels": [12, 10], "focal_length": "20 mm", "pitch": "0.2 mm"}}, "channels": [CHANNELS["red"]]}
        plate, own = {"lever_arm": ["0.5 m", "0 m", "0.2 m"]}, {"lever_arm": ["0.3 m", "-0.4 m", "0 m"]}
        turned = {"pitch": "2 deg"}
        described = document(instruments={"bare": lens, "apart": {**lens, "mount": own}, "turned": {**lens, "mount": [own, turned]}})
        described["platform"]["mount"] = plate
        described["scene"]["objects"] = [{"plane": {}, "material": "lawn"}]
        self.call("render", described)
        alone = document(instruments=None, sensor=lens)
        alone["platform"]["mount"] = [plate, own, turned]
        alone["scene"]["objects"] = described["scene"]["objects"]
        self.call("render", alone, "-o", "alone", name="alone.json")
        self.assertEqual(self.cubes("scene.out/turned"), self.cubes("alone"))
        place = {name: np.fromfile(self.folder / f"scene.out/{name}/image_location.img", "<f8").reshape(10, 3, 12) for name in ("bare", "apart", "turned")}
        # The nose is to the north, the right wing to the east.
        np.testing.assert_allclose((place["apart"] - place["bare"])[:, :2].transpose(1, 0, 2).reshape(2, -1).T, [[-0.4, 0.3]] * 120, atol=1e-9)
        middle = lambda name: place[name][4:6, 1].mean()
        ahead = (100.0 - 0.2) * np.tan(np.radians(2.0))
        self.assertAlmostEqual(middle("turned") - middle("apart"), ahead, delta=2e-3 * ahead)

    def test_mounts_need_a_platform(self):
        lens = {"mount": {"lever_arm": ["1 m", "0 m", "0 m"]}, "camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}}, "channels": [CHANNELS["red"]]}
        said = self.call("check", document(instruments=None, sensor=lens, platform=None), codes=(1,)).stderr
        self.assertRegex(said, r"^scene\.json:\d+:\d+: the sensor has a 'mount', and there is no 'platform' that carries it")

    def test_solved_temperatures_are_shared(self):
        """What they are looked up in is worked out once; what they may be off by, where each camera looks."""
        text = (ROOT / "examples/street_day.json").read_text(encoding="utf-8")
        street = json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE))
        channels = street.pop("sensor")["channels"]
        street["weather"]["file"] = str(ROOT / "examples" / street["weather"]["file"]) if "file" in street["weather"] else None
        street["weather"] = {key: value for key, value in street["weather"].items() if value is not None}
        street["instruments"] = {name: {"camera": {"orthographic": {"gsd": gsd, "pixels": [20, 14]}}, "channels": channels}
                                 for name, gsd in (("near", "0.4 m"), ("wide", "1.2 m"))}
        street["temperatures"] = {"spin_up": "1 d", "step": "15 min", "repeat_first_day": True}
        for name, material in street["scene"]["materials"].items():
            if name != "asphalt" and material.get("temperature") == "solved":
                material["temperature"] = "295 K"
                material.pop("thermal", None)
        street["sampling"], street["output"] = {"grid": {"elements": [2, 2]}}, {"products": ["half_width", "temperature"]}
        self.call("render", street)
        self.call("render", street, "--set", "instrument=wide", "-o", "alone")
        self.assertEqual(self.cubes("scene.out/wide"), self.cubes("alone"))

    def test_threads_folders_and_values_that_are_set(self):
        self.call("render", document(), "-j", "1", "-o", "one")
        self.call("render", document(), "-j", "3", "-o", "three", "--set", "sensor.channels[0].name=renamed")
        for name in ("oli", "tirs"):
            self.assertEqual(self.cubes(f"one/{name}"), self.cubes(f"three/{name}"))
            record = json.loads((self.folder / f"three/{name}/image_run.json").read_text())
            self.assertEqual([channel["name"] for channel in record["channels"]], ["renamed"])

    def test_who_looks_at_the_folder_of_all_is_told_where_runs_are(self):
        self.call("render", document())
        for command in (["info", "scene.out"], ["detect", "scene.out"], ["info", "scene.out", "--region", "0,0,2,2"]):
            done = subprocess.run([PROGRAM, *command], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("; its folders 'oli' and 'tirs' hold runs", done.stderr)

    def test_one_of_an_included_document(self):
        (self.folder / "base.json").write_text(json.dumps(document()))
        self.call("render", {"ifov": 1, "include": "base.json", "instruments": {"oli": None}}, "-o", "left")
        self.assertEqual(sorted(path.name for path in (self.folder / "left").glob("*_radiance.img")), ["image_radiance.img"])

    def test_the_gravest_counts(self):
        hard = document()
        hard["instruments"]["tirs"] = {**TIRS, "channels": [CHANNELS["red"]]}
        hard["sampling"] = {"accuracy": {"error": "0.5 %", "max_samples": 20}}
        self.call("render", hard, codes=(5,))
        done = self.call("render", document(), "--strict", "--set", "light.sky=null", codes=(1,))
        self.assertIn("instrument 'oli': ", done.stderr)

    def test_check_and_sensor_take_all(self):
        self.assertRegex(self.call("check", document()).stdout, r"(?s)instrument oli:\n.*12 x 10 pixels.*instrument tirs:\n.*6 x 5 pixels")
        self.assertRegex(self.call("sensor", document()).stdout, r"(?s)instrument oli\n12 x 10 pixels.*instrument tirs\n6 x 5 pixels")
        self.assertNotIn("oli", self.call("check", document(), "--set", "instrument=tirs").stdout)

    @unittest.skipIf(np is None, "numpy is missing")
    def test_the_example_of_landsat_8(self):
        """Things of the document are where it has them, in the light and at the temperatures that they should have."""
        done = subprocess.run([PROGRAM, "render", ROOT / "examples/landsat_8.json", "-o", self.folder / "out", "--no-cache"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        means = {}
        for name, word, bands, size in (("oli", "toa_reflectance", 9, 40), ("tirs", "brightness_temperature", 2, 12)):
            place = np.fromfile(self.folder / f"out/{name}/image_location.img", "<f8").reshape(size, 3, size)
            values = np.fromfile(self.folder / f"out/{name}/image_{word}.img", "<f4").reshape(size, bands, size)
            x, y = place[:, 0], place[:, 1]
            self.assertLess(np.abs([x.mean(), y.mean()]).max(), 60.0)
            for thing, (east, north) in {"lake": (-260, 260), "town": (245, -240), "depots": (-285, -265), "pasture": (150, 300)}.items():
                near = np.hypot(x - east, y - north) < (60.0 if name == "oli" else 75.0)
                self.assertTrue(near.any(), (name, thing))
                means[name, thing] = values.transpose(1, 0, 2)[:, near].mean(axis=1)
        self.assertGreater(means["oli", "pasture"][4], 4.0 * means["oli", "lake"][4])
        self.assertGreater(means["oli", "depots"][1], 1.5 * means["oli", "pasture"][1])
        self.assertGreater(means["oli", "lake"][0], means["oli", "lake"][4] + 0.04, "blue air over dark water")
        kelvin = {thing: means["tirs", thing][0] for thing in ("lake", "pasture", "depots", "town")}
        self.assertEqual(sorted(kelvin, key=kelvin.get), ["lake", "pasture", "depots", "town"])
        self.assertLess(kelvin["town"], 273.15 + 41.0)

    def test_what_is_refused(self):
        for command, described, more, told in (
                ("preview", document(), (), "the document has 2 instruments, 'oli' and 'tirs': choose one, as --set instrument=oli does; ifov "
                                            "render, check and sensor take all of them"),
                ("render", document(), ("--dry-run",), "the document has 2 instruments"),
                ("render", document(instrument="ori"), (), "'instrument' is 'ori'; expected 'oli' or 'tirs'"),
                ("render", document(instruments=None, sensor=OLI, instrument="oli"), (), "an instrument 'oli' is chosen, and there are no 'instruments'"),
                ("render", document(sensor=OLI), (), "'sensor' and 'instruments' are given; give one of them"),
                ("render", document(instruments={}), (), "an object with a sensor under the name of each instrument"),
                ("check", document(instruments={"../up": OLI}), (), "an instrument is called '../up'; expected letters, digits, '-' and '_'"),
                ("render", document(instruments={"oli": OLI, "tirs": {**TIRS, "cameras": 1}}), (), "instrument 'tirs': scene.json:"),
                ("check", document(instrument=3), (), "expected the name of one of the 'instruments'")):
            with self.subTest(told=told):
                done = self.call(command, described, *more, codes=(1,))
                self.assertIn(told, done.stderr)
                self.assertRegex(done.stderr, r"scene\.json:\d+:\d+")
                self.assertFalse((self.folder / "scene.out").exists())


if __name__ == "__main__":
    unittest.main()
