"""What detectors remember, what runs over and what is corrected: `ifov detect` and `ifov sensor` of documents, on radiance that is written into the cubes of small runs."""

import array
import json
import math
import unittest

from program import Folder, run

WIDTH, HEIGHT = 12, 40
LINE_MS, CONSTANT_MS, LAG = 14.0, 9.0, 0.06
KEPT = math.exp(-LINE_MS / CONSTANT_MS)
PLATFORM = {"straight": {"frame": "scene", "position": ["0 m", "0 m", "500 m"], "velocity": ["0 m/s", "70 m/s", "0 m/s"]}}
CAMERAS = {
    "pushbroom": {"pixels": [WIDTH, HEIGHT], "focal_length": "50 mm", "pitch": "100 um", "line_period": f"{LINE_MS} ms"},
    "whiskbroom": {"pixels": [WIDTH, HEIGHT], "elements": 4, "focal_length": "50 mm", "pitch": "100 um", "sweep_angle": "10 deg", "period": "0.2 s", "both_ways": True,
                   "sweep_time": f"{WIDTH * LINE_MS} ms"},
    "frame": {"pixels": [WIDTH, HEIGHT], "focal_length": "50 mm", "pitch": "100 um"}}
PHYSICS = {"integration_time": "10 us", "quantum_efficiency": 0.7, "full_well": "8e6 e-", "read_noise": "100 e-"}


def document(camera, detector, physics=False):
    channel = {"name": "long", "top_hat": {"from": "10 um", "to": "11 um"}}
    made = {
        "ifov": 1,
        "scene": {"materials": {"ground": {"emissivity": 1, "temperature": "300 K"}}, "objects": [{"plane": {}, "material": "ground"}]},
        "platform": PLATFORM,
        "sensor": {"camera": {camera: CAMERAS[camera]}, "channels": [channel if physics else {**channel, "noise_temperature": "1e-6 K"}], "detector": detector},
        "sampling": {"single": {}}, "output": {"formats": ["envi"]}}
    if physics:
        made["sensor"]["optics"] = {"f_number": 4}
        made["sensor"]["detector"] = {**PHYSICS, **detector}
    return json.dumps(made, indent=1)


class Runs(unittest.TestCase):
    def setUp(self):
        self._folder = Folder()
        self.folder = self._folder.__enter__()
        self.addCleanup(self._folder.__exit__)

    def rendered(self, name, text, radiance):
        """A run whose cube of one channel holds radiance(line, column)."""
        (self.folder / f"{name}.json").write_text(text)
        done = run("render", f"{name}.json", cwd=self.folder)
        self.assertIn(done.returncode, (0, 6), done.stderr)
        values = array.array("f", [radiance(y, x) for y in range(HEIGHT) for x in range(WIDTH)])
        (self.folder / f"{name}.out/image_radiance.img").write_bytes(values.tobytes())

    def detected(self, name, *more, word="noisy"):
        done = run("detect", f"{name}.out", *more, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        values = array.array("f", (self.folder / f"{name}.out/image_{word}_1.img").read_bytes())
        return [list(values[y * WIDTH:(y + 1) * WIDTH]) for y in range(HEIGHT)]

    def test_lines_follow_with_their_time_constant(self):
        step = lambda y, x: 8.0 if y < 15 else 11.0
        self.rendered("line", document("pushbroom", {"time_constant": f"{CONSTANT_MS} ms"}), step)
        seen = self.detected("line")
        for y in range(HEIGHT):
            expected = 8.0 if y < 15 else 11.0 - 3.0 * KEPT**(y - 14)
            self.assertAlmostEqual(seen[y][5], expected, delta=2e-5)

    def test_samples_follow_along_the_sweep_both_ways(self):
        flash = lambda y, x: 10.0 if x == 6 else 8.0
        self.rendered("sweep", document("whiskbroom", {"lag": LAG}), flash)
        seen = self.detected("sweep")
        for y, way in ((2, 1), (5, -1), (9, 1)):
            for n in range(4):
                self.assertAlmostEqual(seen[y][6 + way * n], 8.0 + 2.0 * (1 - LAG) * LAG**n, delta=2e-5)
            self.assertAlmostEqual(seen[y][6 - way], 8.0, delta=2e-5)

    def test_frames_have_what_is_left_of_those_before(self):
        for name, of in (("now", 8.0), ("before", 9.0), ("earlier", 12.0)):
            self.rendered(name, document("frame", {"lag": LAG, "time_constant": "20 ms", "frame_period": "33 ms"}), lambda y, x: of)
        kept = math.exp(-33 / 20)
        first, second = (1 - LAG) * (1 - kept), (1 - LAG) * (1 - kept) * (LAG + kept)
        self.assertAlmostEqual(self.detected("now")[7][3], 8.0, delta=2e-5)
        self.assertAlmostEqual(self.detected("now", "--after", "before.out", "earlier.out")[7][3], 8.0 * first + 9.0 * second + 12.0 * (1 - first - second), delta=2e-5)

    def test_a_full_well_runs_over_along_the_column(self):
        bright = lambda y, x: 2000.0 if (y, x) == (17, 4) else 0.0
        self.rendered("bloom", document("frame", {"blooming": 0.5}, physics=True), bright)
        seen = self.detected("bloom", "--quantity", "electrons", word="electrons")
        record = json.loads((self.folder / "bloom.out/image_run.json").read_text())
        over = 0.5 * (2000.0 * record["channels"][0]["detector"]["electrons_per_radiance"] - 8e6)
        self.assertGreater(over, 4e7)
        column = [line[4] for line in seen]
        self.assertAlmostEqual(sum(column) - 8e6, over, delta=0.01 * over)
        full = int(over / 2 / 8e6)
        for d in range(1, full + 1):
            self.assertAlmostEqual(column[17 + d], 8e6, delta=600)
            self.assertAlmostEqual(column[17 - d], 8e6, delta=600)
        self.assertLess(abs(seen[17][5]), 600)

    def test_the_same_bytes_for_any_threads(self):
        everything = {"lag": 0.1, "time_constant": "30 ms", "blooming": 0.8, "prnu": 0.03, "dsnu": "900 e-", "dead": 0.01, "one_over_f": 0.1, "bits": 14,
                      "correction": {"low": {"temperature": "280 K"}, "high": {"temperature": "320 K"}}}
        for camera in ("pushbroom", "frame"):
            more = {"frame_period": "33 ms"} if camera == "frame" else {}
            self.rendered(camera, document(camera, {**everything, **more}, physics=True), lambda y, x: 8.0 + 0.1 * y + (900.0 if (x, y) == (4, 9) else 0.0))
            drawn = []
            for threads in ("1", "3"):
                self.detected(camera, "-j", threads)
                drawn.append((self.folder / f"{camera}.out/image_noisy_1.img").read_bytes())
            self.assertEqual(*drawn)

    def test_a_correction_takes_the_pattern_out(self):
        uneven = {"prnu": 0.05, "dsnu": "20000 e-"}
        lights = {"correction": {"low": {"temperature": "280 K"}, "high": {"temperature": "320 K"}, "frames": 1000}}
        spread = {}
        for name, more in (("raw", {}), ("corrected", lights)):
            self.rendered(name, document("frame", {**uneven, **more}, physics=True), lambda y, x: 9.0)
            values = sum(self.detected(name), [])
            mean = sum(values) / len(values)
            spread[name] = math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))
        record = json.loads((self.folder / "raw.out/image_run.json").read_text())["channels"][0]["detector"]
        noise = math.sqrt(9.0 * record["electrons_per_radiance"] + 1e4) / record["electrons_per_radiance"]
        self.assertAlmostEqual(spread["corrected"] / noise, 1, delta=3 / math.sqrt(2 * WIDTH * HEIGHT))
        self.assertGreater(spread["raw"], 50 * noise)

    def test_sensor_tells_it(self):
        (self.folder / "line.json").write_text(document("pushbroom", {"time_constant": f"{CONSTANT_MS} ms", "lag": LAG}).replace("1e-6 K", "0.05 K"))
        told = run("sensor", "line.json", cwd=self.folder).stdout
        mtf = (1 - KEPT) / (1 + KEPT) * (1 - LAG) / (1 + LAG)
        self.assertIn(f"memory       {100 * (1 - KEPT) * (1 - LAG):.3g} % of a step in the first exposure, MTF {mtf:.3f} at 1/2 cycle an exposure: "
                      f"NEdT {0.05 / mtf:.4g} K of what changes so fast", told)

    def test_mistakes_are_told(self):
        for camera, detector, physics, what in (
                ("frame", {"time_constant": "9 ms"}, False, "the detector's time constant needs the time from frame to frame: give 'frame_period'"),
                ("pushbroom", {"time_constant": "9 ms", "frame_period": "20 ms"}, False, "elements of the camera are exposed every 14 ms: leave it out"),
                ("pushbroom", {"time_constant": "20 s"}, False, "is 1429 exposures of 14 ms: expected at most 1000"),
                ("whiskbroom", {"blooming": 0.5}, True, "which those of a sweep do not; leave it out"),
                ("pushbroom", {"lag": 0.1, "read_noise": "3 e-"}, False, "states its noise by 'noise_temperature'"),
                ("frame", {"correction": {"low": {"temperature": "320 K"}, "high": {"temperature": "280 K"}}}, True, "expected a 'high' that is brighter than 'low'"),
                ("frame", {"correction": {"low": {"temperature": "280 K"}, "high": {"radiance": "9000 W m-2 sr-1 um-1"}}}, True, "and the detector holds 8e+06: expected a darker one"),
                ("frame", {"lag": 1.0}, False, "lag")):
            with self.subTest(what):
                (self.folder / "wrong.json").write_text(document(camera, detector, physics))
                done = run("sensor", "wrong.json", cwd=self.folder)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(what, done.stderr)
                self.assertRegex(done.stderr, r"^wrong.json:\d+:\d+: ")

    def test_frames_before_must_be_of_use(self):
        self.rendered("plain", document("frame", {"lag": LAG}).replace('"lag": 0.06', '"lag": 0'), lambda y, x: 8.0)
        self.rendered("line", document("pushbroom", {"lag": LAG}), lambda y, x: 8.0)
        for name, what in (("plain", "no channel remembers any"), ("line", "the run's camera scans")):
            done = run("detect", f"{name}.out", "--after", "plain.out", cwd=self.folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn(what, done.stderr)


if __name__ == "__main__":
    unittest.main()
