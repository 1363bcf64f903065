"""`ifov render --times`: a day in one run, as a user meets it."""

import array
import csv
import json
import math
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

from program import PROGRAM, Folder, products, run

ROOT = pathlib.Path(__file__).resolve().parents[2]
GUIDE = (ROOT / "docs" / "guide" / "temperatures.md").read_text()
JUNE = re.search(r"```csv\n(.*?)```", GUIDE, re.DOTALL).group(1)

# A pillar on asphalt and lawn.
STREET = """{"ifov": 1, "time": "2026-06-21T12:00Z",
 "scene": {
   "origin": {"latitude": "52 deg", "longitude": "4.4 deg"},
   "materials": {
     "road": {"reflectance": {"library": "asphalt, road, weathered"}, "temperature": "solved"},
     "roof": {"reflectance": {"library": "roof tile, red clay"}, "temperature": "solved"},
     "lawn": {"reflectance": {"library": "grass, lawn"}, "temperature": "solved"}},
   "objects": [{"plane": {}, "material": "road"},
               {"box": {"low": ["-9 m", "-9 m", "-1 m"], "high": ["-1 m", "9 m", "0.02 m"]}, "material": "lawn"},
               {"box": {"low": ["0 m", "0 m", "0 m"], "high": ["2 m", "2 m", "3 m"]}, "material": "roof"}]},
 "weather": {"file": "june.csv"},
 "temperatures": {"spin_up": "1 d", "step": "15 min", "repeat_first_day": true},
 "light": {"sky": {"temperature": "255 K"}},
 "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [14, 10]}},
            "channels": [{"name": "thermal", "top_hat": {"from": "10 um", "to": "12 um"}}]},
 "sampling": {"accuracy": {"error": "8 K"}, "tile": 5},
 "output": {"products": ["half_width", "abundance", "temperature"], "formats": ["envi", "png"]}}
"""
LONG = STREET.replace("[14, 10]", "[56, 40]").replace("0.5 m", "12.6 cm")
NIGHT = "2026-06-21T18:00Z/PT2H/3"
# Steps of 15 minutes do not fall on each other: each time has paths of its own.
APART = "2026-06-21T18:00Z/PT2H5M/3"


def planck_k(um, radiance):
    """The temperature of a black body, from Planck's law and CODATA's constants."""
    h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23
    metres = um * 1e-6
    return h * c / (metres * k) / math.log1p(2.0 * h * c * c / metres**5 / (radiance * 1e6))


def cube(path):
    """Bands of an ENVI cube of ifov's, each a flat list."""
    header = path.with_suffix(".img.hdr").read_text()
    size = {key: int(re.search(rf"^{key} = (\d+)", header, re.MULTILINE).group(1)) for key in ("samples", "lines", "bands")}
    values = array.array("f")
    values.frombytes(path.read_bytes())
    width, bands = size["samples"], size["bands"]
    return [[v for line in range(size["lines"]) for v in values[(line * bands + b) * width:(line * bands + b + 1) * width]]
            for b in range(bands)]


def gif_frames(data):
    """Frames of a GIF as colours, by the GIF89a specification (CompuServe 1990): (delay, list of rgb)."""
    assert data[:6] == b"GIF89a", data[:6]
    width, height = (int.from_bytes(data[k:k + 2], "little") for k in (6, 8))
    colours = 2 << (data[10] & 7)
    table = [tuple(data[13 + 3 * k:16 + 3 * k]) for k in range(colours)]
    at, delay, screen, frames = 13 + 3 * colours, 0, [None] * (width * height), []
    while data[at] != 0x3B:
        if data[at] == 0x21:
            label, at = data[at + 1], at + 2
            if label == 0xF9:
                delay = int.from_bytes(data[at + 2:at + 4], "little")
            while data[at]:
                at += data[at] + 1
            at += 1
            continue
        assert data[at] == 0x2C and data[at + 9] == 0
        left, top, wide, high = (int.from_bytes(data[at + k:at + k + 2], "little") for k in (1, 3, 5, 7))
        bits, at, coded = data[at + 10], at + 11, b""
        while data[at]:
            coded += data[at + 1:at + 1 + data[at]]
            at += data[at] + 1
        at += 1
        pixels = lzw(coded, bits)
        assert len(pixels) == wide * high, (len(pixels), wide, high)
        for k, index in enumerate(pixels):
            screen[(top + k // wide) * width + left + k % wide] = table[index]
        frames.append((delay, list(screen)))
    return width, height, frames


def lzw(coded, bits):
    clear, out, read, have = 1 << bits, [], 0, 0
    known, size, before = {}, bits + 1, None
    for byte in coded:
        read |= byte << have
        have += 8
        while have >= size:
            code, read, have = read & ((1 << size) - 1), read >> size, have - size
            if code == clear:
                known, size, before = {k: [k] for k in range(clear)}, bits + 1, None
                known[clear] = known[clear + 1] = []
                continue
            if code == clear + 1:
                return out
            piece = known[code] if code in known else before + before[:1]
            out += piece
            if before is not None and len(known) < 4096:
                known[len(known)] = before + piece[:1]
            if len(known) == 1 << size and size < 12:
                size += 1
            before = piece
    return out


class Street(unittest.TestCase):
    """Three hours of an evening, rendered once."""

    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(street=STREET)
        cls.folder = cls._folder.__enter__()
        (cls.folder / "june.csv").write_text(JUNE)
        cls.done = run("render", "street.json", "--times", NIGHT, "-o", "day", "-j", "2", cwd=cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__(None, None, None)

    def test_says_what_it_made(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        for line in ("day/image_animation.gif  (brightness temperature, 3 times, GIF)",
                     "day/image_crossovers.csv  (temperatures of 3 materials, CSV)",
                     "day: 3 times, each in a folder of its own", "420 pixels, "):
            self.assertIn(line, self.done.stdout)
        self.assertEqual(sorted(p.name for p in (self.folder / "day").iterdir()),
                         ["2026-06-21T1800Z", "2026-06-21T2000Z", "2026-06-21T2200Z", "image_animation.gif",
                          "image_crossovers.csv", "image_crossovers.png", "image_series.json"])

    def test_a_time_with_paths_of_its_own_has_the_bytes_that_it_has_alone(self):
        done = run("render", "street.json", "--times", APART, "-o", "apart", "-j", "2", "--log", "apart.log", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("each time has paths of its own: the steps of their temperatures do not fall on each other",
                      (self.folder / "apart.log").read_text())
        for clock, threads in (("18:00", 1), ("22:10", 3)):
            alone = run("render", "street.json", "--set", f"time=2026-06-21T{clock}Z", "-o", f"alone{clock}", "-j", threads,
                        "--no-cache", cwd=self.folder)
            self.assertEqual(alone.returncode, 0, alone.stderr)
            of_series = products(self.folder / "apart" / f"2026-06-21T{clock.replace(':', '')}Z")
            of_run = products(self.folder / f"alone{clock}")
            self.assertEqual(sorted(of_series), sorted(of_run))
            for name, content in of_run.items():
                self.assertEqual(of_series[name], content, name)
        self.assertNotEqual(products(self.folder / "alone18:00")["image_radiance.img"],
                            products(self.folder / "alone22:10")["image_radiance.img"])

    def test_times_along_shared_paths_are_within_the_intervals_of_each_alone(self):
        """Independent estimates of 95 % intervals, whose difference lies within both together; that of another time does not."""
        times = "2026-06-21T09:00Z/PT30M/9"
        shared = run("render", "street.json", "--times", times, "-o", "shared", "--log", "shared.log", "--set", "sampling.accuracy.error=6 K",
                     "--set", "sensor.camera.orthographic.pixels=[28, 20]", "--set", "sensor.camera.orthographic.gsd=0.25 m", cwd=self.folder)
        self.assertEqual(shared.returncode, 0, shared.stderr)
        self.assertIn("9 times go along the same paths", (self.folder / "shared.log").read_text())
        images = {}
        for clock in ("0930", "1130", "1300"):
            images["shared", clock] = [cube(self.folder / "shared" / f"2026-06-21T{clock}Z" / f"image_{name}.img")[0]
                                       for name in ("radiance", "half_width")]
            for seed in (5, 6):
                alone = run("render", "street.json", "--set", f"time=2026-06-21T{clock[:2]}:{clock[2:]}Z", "-o", f"own{clock}{seed}",
                            "--set", f"seed={seed}", "--set", "sampling.accuracy.error=6 K",
                            "--set", "sensor.camera.orthographic.pixels=[28, 20]", "--set", "sensor.camera.orthographic.gsd=0.25 m",
                            cwd=self.folder)
                self.assertEqual(alone.returncode, 0, alone.stderr)
                images[seed, clock] = [cube(self.folder / f"own{clock}{seed}" / f"image_{name}.img")[0] for name in ("radiance", "half_width")]
            images["own", clock] = images[5, clock]
            images["mean", clock] = [sum(images[seed, clock][0]) / 2 for seed in (5, 6)]

        def within(one, other):
            return [abs(a - b) <= math.hypot(p, q) for a, b, p, q in zip(one[0], other[0], one[1], other[1])]

        for clock, wrong in (("0930", "1130"), ("1130", "0930"), ("1300", "0930")):
            held = within(images["shared", clock], images["own", clock])
            self.assertGreater(sum(held) / len(held), 0.95, clock)
            mean = sum(images["mean", clock]) / len(held)
            self.assertLess(abs(sum(images["shared", clock][0]) / len(held) / mean - 1.0), 1e-3, clock)  # 0.06 K of the mean of all
            # The planted fault: a time's temperatures at another.
            held = within(images["shared", wrong], images["own", clock])
            self.assertLess(sum(held) / len(held), 0.8, clock)
            bias = sum(a - b for a, b in zip(images["shared", wrong][0], images["own", clock][0])) / len(held)
            self.assertGreater(abs(bias) / mean, 1e-2, clock)
        again = run("render", "street.json", "--times", times, "-o", "again", "-j", "1", "--set", "sampling.accuracy.error=6 K",
                    "--set", "sensor.camera.orthographic.pixels=[28, 20]", "--set", "sensor.camera.orthographic.gsd=0.25 m", cwd=self.folder)
        self.assertEqual(again.returncode, 0, again.stderr)
        for clock in ("0900", "1130", "1300"):
            self.assertEqual(products(self.folder / "shared" / f"2026-06-21T{clock}Z"), products(self.folder / "again" / f"2026-06-21T{clock}Z"))

    def test_curves_are_means_of_the_products(self):
        text = (self.folder / "day" / "image_crossovers.csv").read_text()
        rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
        self.assertEqual(len(rows), 3 * 3)
        for row in rows:
            stem = self.folder / "day" / f"{row['time'][:13]}00Z" / "image"
            share = cube(pathlib.Path(f"{stem}_abundance.img"))[("road", "roof", "lawn").index(row["material"])]
            radiance, warm = cube(pathlib.Path(f"{stem}_radiance.img"))[0], cube(pathlib.Path(f"{stem}_temperature.img"))[0]
            pure = [k for k, s in enumerate(share) if s >= 0.9]
            self.assertEqual(int(row["pixels"]), len(pure))
            for key, values in (("brightness", [planck_k(11.0, radiance[k]) for k in pure]), ("surface", [warm[k] for k in pure])):
                mean = sum(values) / len(values)
                spread = math.sqrt(sum((v - mean)**2 for v in values) / len(values))
                self.assertAlmostEqual(float(row[f"{key}_k"]), mean, delta=2e-3)
                self.assertAlmostEqual(float(row[f"{key}_deviation_k"]), spread, delta=2e-3)

    def test_the_roof_cools_below_the_road_at_dusk(self):
        text = (self.folder / "day" / "image_crossovers.csv").read_text()
        rows = {(row["material"], row["time"][11:13]): float(row["surface_k"])
                for row in csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))}
        lines = re.findall(r"# (\S+) \((\w+)\): '(\w+)' becomes warmer than '(\w+)'", text)
        self.assertIn(("dusk", "lawn", "roof"), [line[1:] for line in lines], text)
        for when, _, warmer, cooler in lines:
            # On the straight line between the times about it.
            hour = int(when[11:13]) + int(when[14:16]) / 60 + int(when[17:19]) / 3600
            first = 18 if hour < 20 else 20
            before, after = (rows[warmer, str(h)] - rows[cooler, str(h)] for h in (first, first + 2))
            self.assertLess(before, 0.0)
            self.assertGreater(after, 0.0)
            self.assertAlmostEqual(hour, first + 2 * before / (before - after), delta=2e-3)

    def test_animation_has_one_scale_for_all_frames(self):
        width, height, frames = gif_frames((self.folder / "day" / "image_animation.gif").read_bytes())
        self.assertEqual(len(frames), 3)
        self.assertEqual({delay for delay, _ in frames}, {60})
        place = {h: cube(self.folder / "day" / f"2026-06-21T{h}00Z" / "image_radiance.img")[0] for h in (18, 20, 22)}
        # Where the image is: 14 x 10 pixels of 40 each, from (16, 58).
        warm = []
        for (_, pixels), hour in zip(frames, (18, 20, 22)):
            for k, radiance in enumerate(place[hour]):
                x, y = 16 + 40 * (k % 14), 58 + 40 * (k // 14)
                block = {pixels[(y + j) * width + x + i] for j in (0, 20, 39) for i in (0, 20, 39)}
                self.assertEqual(len(block), 1, (hour, k))
                warm.append((planck_k(11.0, radiance), sum(block.pop())))
        # Warmer is lighter, whenever it was: colours of one scale.
        warm.sort()
        for (cool, dark), (hot, light) in zip(warm, warm[20:]):
            if hot > cool + 1.0:
                self.assertGreaterEqual(light, dark - 12, (cool, hot))
        self.assertGreater(height, 458)

    def test_status_of_what_is_done(self):
        done = run("status", "day", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"day: series of street.json, ifov \S+, 3 times from 2026-06-21T18:00Z to 2026-06-21T22:00Z\n"
                                      r"times +3 of 3 times, and the products of the series\n")

    def test_info_of_all_times(self):
        for what in ("day", "day/image_series.json"):
            done = run("info", what, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"day\nseries +of street.json, made by ifov \S+\nmade +3 of 3 times\ntimes +2026-06-21T18:00Z  2026-06-21T1800Z\n"
                                          r" +2026-06-21T20:00Z  2026-06-21T2000Z\n +2026-06-21T22:00Z  2026-06-21T2200Z\nfile +image_animation.gif\n")
            self.assertIn("\n\nday/2026-06-21T1800Z/image_run.json\nmade by", done.stdout)
        # What the street's products do not hold, means over regions need.
        done = run("info", "day", "--region", "2,2,5,5", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("image_reasons.img, which means over regions need; expected 'reasons' and 'quality' among the document's output.products", done.stderr)

    def test_means_over_a_region_at_each_time(self):
        whole = run("render", "street.json", "--times", NIGHT, "-o", "whole", "-j", "2", "-q", "--set", 'output.products=["reasons", "quality", "half_width"]', cwd=self.folder)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        done = run("info", "whole", "--region", "2,2,5,5", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = re.findall(r"(\S+Z): whole\S+\nmeans .*\nregion 2,2,5,5: 9 pixels.*\n  thermal +(\S+) \+- (\S+) ", done.stdout)
        self.assertEqual([time for time, _, _ in found], ["2026-06-21T18:00Z", "2026-06-21T20:00Z", "2026-06-21T22:00Z"])
        for time, mean, _ in found:
            values = cube(self.folder / "whole" / time.replace(":", "") / "image_radiance.img")[0]
            self.assertAlmostEqual(float(mean) / (sum(values[14 * y + x] for y in range(2, 5) for x in range(2, 5)) / 9), 1, places=5)

    def test_what_is_done_is_not_made_again(self):
        before = {p: p.stat().st_mtime_ns for p in (self.folder / "day").glob("*/image_radiance.img")}
        again = run("render", "street.json", "--times", NIGHT, "-o", "day", "--resume", cwd=self.folder)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("3 times, each in a folder of its own (3 of them were there already)", again.stdout)
        self.assertEqual(before, {p: p.stat().st_mtime_ns for p in (self.folder / "day").glob("*/image_radiance.img")})
        other = run("render", "street.json", "--times", NIGHT, "-o", "day", "--resume", "--set", "seed=9", cwd=self.folder)
        self.assertEqual(other.returncode, 1)
        self.assertIn("day/2026-06-21T1800Z' holds products of another document, or of another version of ifov: --restart "
                      "makes all times anew", other.stderr)


class Killed(unittest.TestCase):
    def test_goes_on_with_the_times_and_tiles_that_are_missing(self):
        with Folder(street=LONG) as folder:
            (folder / "june.csv").write_text(JUNE)
            whole = run("render", "street.json", "--times", APART, "-o", "whole", "-q", cwd=folder)
            self.assertEqual(whole.returncode, 0, whole.stderr)
            command = [PROGRAM, "render", "street.json", "--times", APART, "-o", "cut", "-q"]
            second = folder / "cut" / "2026-06-21T2005Z" / "run.part"
            with subprocess.Popen(command, cwd=folder) as process:
                end = time.monotonic() + 100
                while not list(second.glob("tiles/*.tiles")) and time.monotonic() < end:
                    time.sleep(0.02)
                process.send_signal(signal.SIGKILL)
            self.assertFalse((folder / "cut" / "image_animation.gif").exists())
            status = run("status", "cut", cwd=folder)
            self.assertRegex(status.stdout, r"times +1 of 3 times\nleft +2 times, about .*\nbegun +2026-06-21T20:05Z\n")
            refused = run("render", "street.json", "--times", APART, "-o", "cut", cwd=folder)
            self.assertEqual(refused.returncode, 1)
            self.assertIn("'cut' holds a series that is not finished: --resume goes on with it, --restart throws it away and "
                          "begins", refused.stderr)
            first = (folder / "cut" / "2026-06-21T1800Z" / "image_radiance.img").stat().st_mtime_ns
            rest = run(*command[1:], "--resume", "--log", "rest.log", cwd=folder)
            self.assertEqual(rest.returncode, 0, rest.stderr)
            self.assertEqual(first, (folder / "cut" / "2026-06-21T1800Z" / "image_radiance.img").stat().st_mtime_ns)
            self.assertRegex((folder / "rest.log").read_text(), r"1 of 3 times are done already")
            for clock in ("1800", "2005", "2210"):
                self.assertEqual(products(folder / "whole" / f"2026-06-21T{clock}Z"), products(folder / "cut" / f"2026-06-21T{clock}Z"))
            for name in ("animation.gif", "crossovers.csv", "crossovers.png"):
                self.assertEqual((folder / "whole" / f"image_{name}").read_bytes(), (folder / "cut" / f"image_{name}").read_bytes())

    def test_times_along_shared_paths_go_on_with_their_tiles(self):
        with Folder(street=LONG) as folder:
            (folder / "june.csv").write_text(JUNE)
            whole = run("render", "street.json", "--times", NIGHT, "-o", "whole", "-q", "-j", "1", cwd=folder)
            self.assertEqual(whole.returncode, 0, whole.stderr)
            command = [PROGRAM, "render", "street.json", "--times", NIGHT, "-o", "cut", "-q"]
            begun = [folder / "cut" / f"2026-06-21T{hour}00Z" / "run.part" for hour in (18, 20, 22)]
            with subprocess.Popen(command, cwd=folder) as process:
                end = time.monotonic() + 100
                while not all(list(one.glob("tiles/*.tiles")) for one in begun) and time.monotonic() < end:
                    time.sleep(0.02)
                process.send_signal(signal.SIGKILL)
            status = run("status", "cut", cwd=folder)
            self.assertRegex(status.stdout, r"times +0 of 3 times\nbegun +2026-06-21T22:00Z\n")
            rest = run(*command[1:], "--resume", "--log", "rest.log", cwd=folder)
            self.assertEqual(rest.returncode, 0, rest.stderr)
            self.assertRegex((folder / "rest.log").read_text(), r"[1-9]\d* of \d+ tiles are done already")
            for hour in (18, 20, 22):
                self.assertEqual(products(folder / "whole" / f"2026-06-21T{hour}00Z"), products(folder / "cut" / f"2026-06-21T{hour}00Z"))
            # One that is done stays, and helps those that are not.
            shutil.rmtree(folder / "cut" / "2026-06-21T2000Z")
            rest = run(*command[1:], "--resume", cwd=folder)
            self.assertEqual(rest.returncode, 0, rest.stderr)
            self.assertEqual(products(folder / "whole" / "2026-06-21T2000Z"), products(folder / "cut" / "2026-06-21T2000Z"))


class Mistakes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(street=STREET, still=STREET.replace('"origin": {"latitude": "52 deg", "longitude": "4.4 deg"},', "")
                             .replace('"temperature": "solved"', '"temperature": "290 K"').replace('"weather": {"file": "june.csv"},', ""))
        cls.folder = cls._folder.__enter__()
        (cls.folder / "june.csv").write_text(JUNE)

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__(None, None, None)

    def refused(self, times, *more, document="street.json"):
        done = run("render", document, "--times", times, "-o", "none", *more, cwd=self.folder)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertFalse((self.folder / "none").exists())
        return done.stderr

    def test_what_is_no_series(self):
        expected = "; expected the first time, a step and how many, such as 2025-06-20T00:00Z/PT15M/96"
        for times, found in (
                ("2026-06-21T18:00Z", "it has 1 part"),
                ("2026-06-21T18:00Z/PT2H/3/4", "it has 4 parts"),
                ("noon/PT2H/3", "'noon'"),
                ("2026-06-21T18:00/PT2H/3", "zone"),
                ("2026-06-21T18:00Z/2h/3", "'2h' is no step of whole seconds, such as PT15M, PT1H30M or P1D"),
                ("2026-06-21T18:00Z/PT/3", "'PT' is no step"),
                ("2026-06-21T18:00Z/P1M/3", "'P1M' is no step"),
                ("2026-06-21T18:00Z/PT5M2H/3", "'PT5M2H' is no step"),
                ("2026-06-21T18:00Z/PT0S/3", "'PT0S' is no step"),
                ("2026-06-21T18:00Z/PT2H/none", "'none' is no number of times, 1 to 100000"),
                ("2026-06-21T18:00Z/PT2H/0", "'0' is no number of times")):
            with self.subTest(times=times):
                said = self.refused(times)
                self.assertIn(f"--times '{times}': ", said)
                self.assertIn(found, said)
                self.assertIn(expected, said)

    def test_weather_that_does_not_reach_is_told_before_the_first_ray(self):
        self.assertRegex(self.refused("2026-06-21T18:00Z/PT2H/6"),
                         r"at 2026-06-22T04:00Z \(6 of 6 times\): street.json:11:\d+: 'june.csv' does not tell "
                         r"the air temperature at 2026-06-22T04:00:00.000Z; its values go from 2026-06-21T00:00:00.000Z to")

    def test_what_goes_with_one_time_alone(self):
        self.assertIn("--set time=2026-06-21T12:00Z: --times gives the document its times", self.refused(NIGHT, "--set", "time=2026-06-21T12:00Z"))
        for option in (["--tiles", "1/4"], ["--keep"], ["--refine"], ["--dry-run"], ["--quick"]):
            self.assertIn("excludes", self.refused(NIGHT, *option), option)

    def test_a_document_that_no_time_changes(self):
        self.assertIn("still.json: nothing in it changes with the time: it has no \"weather\", no object with \"present\"",
                      self.refused(NIGHT, document="still.json"))

    def test_a_document_needs_no_time_of_its_own(self):
        (self.folder / "timeless.json").write_text(STREET.replace('"time": "2026-06-21T12:00Z",', ""))
        done = run("render", "timeless.json", "--times", "2026-06-21T18:00Z/PT1H/1", "-o", "one", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        record = json.loads((self.folder / "one" / "2026-06-21T1800Z" / "image_run.json").read_text())
        self.assertEqual(record["acquisition"]["time"], "2026-06-21T18:00:00.000Z")


if __name__ == "__main__":
    unittest.main()
