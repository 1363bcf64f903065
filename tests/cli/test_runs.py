"""Runs that are killed, starved and disturbed: what is finished is kept, and the products are the same bytes."""

import array
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from program import PROGRAM, Folder, WholeProducts, products, run

KILLER = pathlib.Path(os.environ.get("IFOV_BUILD", pathlib.Path(PROGRAM).parent)) / "tests" / "libkill_at_call.so"

JUMPING_CLOCK = KILLER.with_name("libjumping_clock.so")

LIMITS_MEMORY = unittest.skipIf("IFOV_SANITIZER" in os.environ, "a sanitizer takes terabytes of addresses")

# A long version is run with IFOV_KILLS=100.
KILLS = int(os.environ.get("IFOV_KILLS", "8"))

# Rough ground under spheres: 25 tiles, a second or so of processor time.
SCENE = """{
  "ifov": 1,
  "seed": 5,
  "scene": {
    "materials": {
      "ground": {"reflectance": 0.3, "temperature": "20 degC"},
      "ball": {"reflectance": 0.6, "temperature": "35 degC"}
    },
    "objects": [
      {"plane": {}, "material": "ground"},
      {"sphere": {"center": ["-3 m", "2 m", "1 m"], "radius": "2.3 m"}, "material": "ball"},
      {"sphere": {"center": ["4 m", "-3 m", "1 m"], "radius": "1.7 m"}, "material": "ball"}
    ]
  },
  "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
  "sensor": {
    "camera": {"orthographic": {"gsd": "0.33 m", "pixels": [45, 40]}},
    "channels": [
      {"name": "red", "monochromatic": {"at": "0.65 um"}},
      {"name": "T", "monochromatic": {"at": "10 um"}}
    ]
  },
  "sampling": {"accuracy": {"error": "2 %"}, "tile": 9},
  "output": {"formats": ["envi", "geotiff", "png"]}
}
"""

# Work for much longer than any test waits.
ENDLESS = (
    SCENE.replace("[45, 40]", "[600, 550]").replace("0.33 m", "2.5 cm").replace('"2 %"', '"0.01 %"').replace('"tile": 9', '"tile": 12')
)

# The same files and tiles in no time: for what becomes of files, whatever stands in them.
QUICK = SCENE.replace('"accuracy": {"error": "2 %"}', '"grid": {"elements": [2, 2]}')


def start(folder, *arguments, **environment):
    return subprocess.Popen(
        [PROGRAM, "render", "scene.json", "-j", "2", *arguments], cwd=folder, env={**os.environ, **environment},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )


def run_within(megabytes, *arguments, cwd):
    """The finished run of a process that may map no more than this (`ulimit -v`)."""
    limit = megabytes << 20
    return subprocess.run(
        [PROGRAM, "render", *arguments], cwd=cwd, capture_output=True, text=True, timeout=120,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )


# What is said where memory runs out: in the run, in the library that traces rays, or before there is anything.
MEMORY_WORDS = (
    r"^ifov: (memory ran out: [\d.]+ MB were held at most, and no more than [\d.]+ MB may be mapped \(ulimit -v\); fewer threads "
    r"or smaller tiles take less|the run takes [\d.]+ MB of memory, [\d.]+ \wB are there; .*|the ray tracer cannot start: there is "
    r"too little memory, or no thread can be made|.*Resource temporarily unavailable)(\n|$)"
)


def wait_for_tiles(folder, seconds=30):
    """Until a pack of tiles is there."""
    end = time.monotonic() + seconds
    while not list(pathlib.Path(folder).glob("run.part/tiles/*.tiles")):
        if time.monotonic() > end:
            raise AssertionError(f"no tiles in {folder} after {seconds} s")
        time.sleep(0.01)


class Runs(WholeProducts, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(scene=SCENE)
        cls.reference_folder = cls._folder.path
        begin = time.monotonic()
        done = run("render", "scene.json", "-j", 2, "--no-state", cwd=cls.reference_folder)
        cls.seconds = time.monotonic() - begin
        assert done.returncode == 0, done.stderr
        cls.reference = products(cls.reference_folder / "scene.out")

    def expect_resumed(self, folder, *words, whole=None):
        done = run("render", "scene.json", "-j", 2, "--resume", cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.expect_whole(folder / "scene.out", whole)
        return done

    def test_an_undisturbed_run_leaves_the_same_bytes_and_no_state(self):
        with Folder(scene=SCENE) as folder:
            self.assertEqual(run("render", "scene.json", cwd=folder).returncode, 0)
            self.expect_whole(folder / "scene.out")

    def test_killed_at_random_moments(self):
        moments = random.Random(7)
        kills = 0
        while kills < KILLS:
            with Folder(scene=SCENE) as folder:
                while True:
                    process = start(folder, "--resume")
                    try:
                        process.wait(timeout=moments.uniform(0.0, 0.8 * self.seconds))
                    except subprocess.TimeoutExpired:
                        process.kill()
                        kills += 1
                    errors = process.communicate()[1]
                    if process.returncode == 0:
                        break
                    self.assertEqual(process.returncode, -signal.SIGKILL, errors)
                self.expect_whole(folder / "scene.out")

    def test_killed_at_calls_that_change_files(self):
        if not KILLER.exists():
            self.skipTest(f"{KILLER} is not built")
        with Folder(scene=QUICK) as folder:
            count = folder / "count"
            process = start(folder, LD_PRELOAD=str(KILLER), IFOV_COUNT_CALLS=str(count))
            errors = process.communicate()[1]
            self.assertEqual(process.returncode, 0, errors)
            calls = int(count.read_text())
            whole = products(folder / "scene.out")
        self.assertGreater(calls, 60)
        # The first calls are those of the lock and the plan, the last ones of assembly, publishing and clearing away.
        moments = sorted({*range(1, 9), *range(calls - 40, calls + 1, 4), *random.Random(3).sample(range(1, calls), KILLS // 2)})
        for moment in moments:
            with self.subTest(call=moment), Folder(scene=QUICK) as folder:
                process = start(folder, LD_PRELOAD=str(KILLER), IFOV_KILL_AT=str(moment))
                errors = process.communicate()[1]
                # How many packs there are depends on time: a run may end before its call comes.
                self.assertIn(process.returncode, (0, -signal.SIGKILL), errors)
                self.expect_resumed(folder, whole=whole)

    def test_a_clock_that_jumps_confuses_neither_time_limit_nor_lock_nor_resume(self):
        if not JUMPING_CLOCK.exists():
            self.skipTest(f"{JUMPING_CLOCK} is not built")
        jumping = {"LD_PRELOAD": str(JUMPING_CLOCK)}
        with Folder(scene=SCENE) as folder:
            process = start(folder, "--time-limit", "10min", **jumping)
            errors = process.communicate()[1]
            self.assertEqual(process.returncode, 0, errors)
            self.expect_whole(folder / "scene.out")
            record = json.loads((folder / "scene.out/image_run.json").read_text())
            self.assertTrue(0.0 < record["cost"]["elapsed_s"] < 600.0, record["cost"])
        with Folder(scene=SCENE) as folder:
            process = start(folder, **jumping)
            wait_for_tiles(folder / "scene.out")
            process.kill()
            process.communicate()
            process = start(folder, "--resume", **jumping)
            errors = process.communicate()[1]
            self.assertEqual(process.returncode, 0, errors)
            self.expect_whole(folder / "scene.out")
        with Folder(scene=ENDLESS) as folder:
            begin = time.monotonic()
            process = start(folder, "--time-limit", "4s", **jumping)
            process.communicate()
            self.assertEqual(process.returncode, 4)
            self.assertLess(time.monotonic() - begin, 30.0)
            self.assertRegex(run("status", "scene.out", cwd=folder).stdout, r"so far +\d+ rays, \d+\.\d s")

    def test_a_word_on_the_lock_of_a_dead_process(self):
        with Folder(scene=SCENE) as folder:
            process = start(folder)
            wait_for_tiles(folder / "scene.out")
            process.kill()
            process.communicate()
            self.expect_resumed(
                folder, f"scene.out/run.part: process {process.pid}, which was at work here, is gone: its lock is taken over")

    def test_damaged_tiles_are_computed_again(self):
        for damage, words in (
            (lambda data: data[: len(data) // 2], "the file is cut short"),
            (lambda data: data[:400] + bytes([data[400] ^ 1]) + data[401:], "the checksum of tile"),
        ):
            with Folder(scene=SCENE) as folder:
                process = start(folder)
                wait_for_tiles(folder / "scene.out")
                process.kill()
                process.communicate()
                pack = sorted((folder / "scene.out" / "run.part" / "tiles").glob("*.tiles"))[0]
                pack.write_bytes(damage(pack.read_bytes()))
                done = self.expect_resumed(folder, f"warning: scene.out/run.part/tiles/{pack.name}: {words}")
                self.assertIn("computed again", done.stderr)

    def test_resume_refuses_what_has_changed(self):
        with Folder(scene=SCENE) as folder:
            process = start(folder)
            wait_for_tiles(folder / "scene.out")
            process.kill()
            process.communicate()
            (folder / "scene.json").write_text(SCENE.replace('"seed": 5', '"seed": 6'))
            done = run("render", "scene.json", "--resume", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertIn("scene.out: the run cannot go on, because its tiles would not fit together:\n"
                          "  the document: line 3 was '\"seed\": 5,' and is '\"seed\": 6,'\n"
                          "  the seed was 5 and is 6\n"
                          "Put back what has changed and resume; or keep the ", done.stderr)
            done = run("render", "scene.json", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"scene\.out: this folder holds an unfinished run, \d+ of 25 tiles are done\. Go on "
                                          r"with it \(--resume\), throw it away and start anew \(--restart\), or take another "
                                          r"folder \(--output\)\.\n$")
            self.assertEqual(run("render", "scene.json", "--restart", cwd=folder).returncode, 0)

    def test_resume_notices_another_file_of_the_scene(self):
        text = SCENE.replace('"reflectance": 0.6', '"reflectance": {"csv": "ball.csv", "wavelength_unit": "um"}')
        with Folder(scene=text) as folder:
            (folder / "ball.csv").write_text("wavelength um,reflectance\n0.3,0.6\n15,0.6\n")
            process = start(folder)
            wait_for_tiles(folder / "scene.out")
            process.kill()
            process.communicate()
            (folder / "ball.csv").write_text("wavelength um,reflectance\n0.3,0.6\n15,0.5\n")
            done = run("render", "scene.json", "--resume", cwd=folder)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("\n  the scene's file 'ball.csv' has other bytes\n", done.stderr)

    def test_resume_begins_where_there_is_nothing(self):
        with Folder(scene=SCENE) as folder:
            self.assertEqual(self.expect_resumed(folder).stderr, "")

    def test_two_runs_do_not_share_a_folder_and_status_sees_the_first(self):
        with Folder(scene=ENDLESS) as folder:
            process = start(folder)
            try:
                wait_for_tiles(folder / "scene.out")
                second = run("render", "scene.json", "--resume", cwd=folder)
                self.assertEqual((second.returncode, second.stdout), (2, ""))
                holder = f"process {process.pid} on {socket.gethostname()}"
                self.assertEqual(second.stderr, f"ifov: scene.out/run.part: another run is at work in this folder: {holder}; wait for "
                                                "it, stop it, or take another folder (--output)\n")
                self.assertIn(f"at work    {holder}\n", run("status", "scene.out", cwd=folder).stdout)
            finally:
                process.kill()
                process.communicate()
            said = run("status", "scene.out", cwd=folder)
            self.assertEqual((said.returncode, said.stderr), (0, ""))
            self.assertRegex(said.stdout, r"^scene\.out: unfinished run of scene\.json, ifov [\d.]+, seed 5\n"
                                          r"done       \d+ of 2300 tiles, \d+\.\d % of the pixels\n"
                                          r"accuracy   asked for .*; reached in \d+ of the \d+ pixels done; .*\n"
                                          r"so far     \d+ rays, [\d.]+ \w+\n"
                                          r"left       \d+ tiles, about [\d.]+ \w+ at this rate\n"
                                          r"at work    nobody; --resume goes on\n$")

    def test_status_of_a_complete_run_and_of_nothing(self):
        said = run("status", self.reference_folder / "scene.out")
        self.assertEqual(said.returncode, 0)
        self.assertRegex(said.stdout, r"scene\.out: complete; 'ifov info .*scene\.out' describes it\n$")
        with Folder() as folder:
            said = run("status", ".", cwd=folder)
            self.assertEqual((said.returncode, said.stdout), (1, ""))
            self.assertIn("'.' holds no run: neither an unfinished one (run.part) nor a complete one (NAME_run.json)",
                          said.stderr)

    def test_a_time_limit_gives_whole_products_with_gaps(self):
        with Folder(scene=ENDLESS) as folder:
            begin = time.monotonic()
            done = run("render", "scene.json", "-j", 2, "--time-limit", "6s", cwd=folder)
            self.assertLess(time.monotonic() - begin, 10.0)
            self.assertEqual((done.returncode, done.stderr), (4, ""))
            self.assertRegex(done.stdout, r"\nStopped by the time limit: \d+ of 2300 tiles are done\. --resume goes on\.\n")
            out = folder / "scene.out"
            accuracy = json.loads((out / "image_run.json").read_text())["accuracy"]
            reached = accuracy["reached"]
            self.assertRegex(reached, r"^(\d+) of 330000 pixels hold no value \(NaN\), because the time limit came first\. "
                                      r"Asked for .*\. Reached in ")
            gaps = int(reached.split()[0])
            self.assertEqual(accuracy["pixels_by_reason"]["time"], gaps)
            reasons = array.array("H", (out / "image_reasons.img").read_bytes())
            self.assertEqual(sum(bits & 4 != 0 for bits in reasons), gaps)
            classes = (out / "image_quality_class.img").read_bytes()
            self.assertEqual(sum(quality_class == 3 for quality_class in classes), gaps)
            self.assertIn(reached, (out / "image_radiance.img.hdr").read_text())
            for name, bands in (("radiance", 2), ("half_width", 2), ("abundance", 3)):
                values = array.array("f", (out / f"image_{name}.img").read_bytes())
                self.assertEqual(len(values), bands * 330000)
                self.assertEqual(sum(value != value for value in values), bands * gaps, name)
            counts = array.array("I", (out / "image_samples.img").read_bytes())
            self.assertGreaterEqual(sum(count == 0 for count in counts), 3 * gaps)
            self.assertIn("unfinished run", run("status", "scene.out", cwd=folder).stdout)

    def test_a_run_in_pieces_of_time_ends_with_the_same_bytes(self):
        with Folder(scene=SCENE) as folder:
            for _ in range(200):
                done = run("render", "scene.json", "-j", 2, "--resume", "--time-limit", f"{1.2 + 0.4 * self.seconds}s", cwd=folder)
                self.assertIn(done.returncode, (0, 4), done.stderr)
                if done.returncode == 0:
                    break
            self.expect_whole(folder / "scene.out")

    def test_shares_merge_to_the_same_bytes(self):
        with Folder(scene=SCENE) as folder:
            for share in (1, 3):
                done = run("render", "scene.json", "--tiles", f"{share}/3", cwd=folder)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(f"tiles of this share are done and kept in scene.out.{share}-of-3; 'ifov merge' makes the "
                              "products of all shares.\n", done.stdout)
                self.assertEqual(os.listdir(folder / f"scene.out.{share}-of-3"), ["run.part"])
            shares = [f"scene.out.{share}-of-3" for share in (1, 2, 3)]
            done = run("merge", shares[0], shares[2], "--output", "scene.out", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr, "8 of 25 tiles are missing:\n"
                                          "  8 tiles are in the share of none of these folders\n"
                                          "Finish them with 'ifov render --tiles ... --resume', or make products with gaps "
                                          "(--partial).\n")
            self.assertFalse((folder / "scene.out").exists())
            self.assertEqual(run("merge", shares[0], shares[2], "--partial", "--output", "gaps", cwd=folder).returncode, 0)
            reached = json.loads((folder / "gaps" / "image_run.json").read_text())["accuracy"]["reached"]
            self.assertRegex(reached, r"^\d+ of 1800 pixels hold no value \(NaN\), because their tiles were not there to merge\. ")

            process = start(folder, "--tiles", "2/3")
            wait_for_tiles(folder / shares[1])
            process.kill()
            process.communicate()
            done = run("merge", *shares, "--output", "scene.out", cwd=folder)
            if done.returncode != 0:
                self.assertRegex(done.stderr, r"^\d of 25 tiles are missing:\n  scene\.out\.2-of-3: \d tiles of its share 2/3 are not done\n")
            self.assertEqual(run("render", "scene.json", "--tiles", "2/3", "--resume", cwd=folder).returncode, 0)
            done = run("merge", *shares, "--output", "scene.out", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.expect_whole(folder / "scene.out")

            pack = sorted((folder / shares[0] / "run.part" / "tiles").glob("*.tiles"))[0]
            data = pack.read_bytes()
            pack.write_bytes(data[:400] + bytes([data[400] ^ 1]) + data[401:])
            done = run("merge", *shares, "--output", "damaged", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"^ifov: warning: scene\.out\.1-of-3/run\.part/tiles/" + pack.name + r": the checksum of tile "
                                          r"\d+ is wrong\n1 of 25 tiles are missing:\n  scene\.out\.1-of-3: 1 tiles of its share 1/3 "
                                          r"are not done\n")
            self.assertFalse((folder / "damaged" / "image_run.json").exists())

    def test_shares_of_different_runs_are_refused(self):
        with Folder(scene=SCENE, other=SCENE.replace('"seed": 5', '"seed": 6')) as folder:
            run("render", "scene.json", "--tiles", "1/2", "-o", "a", cwd=folder)
            run("render", "other.json", "--tiles", "2/2", "-o", "b", cwd=folder)
            done = run("merge", "a", "b", "-o", "c", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr, "the tiles in 'a' and in 'b' are not of one run:\n"
                                          "  the document: line 3 was '\"seed\": 5,' and is '\"seed\": 6,'\n"
                                          "  the seed was 5 and is 6\n")
            done = run("merge", "a", "nothing", "-o", "c", cwd=folder)
            self.assertEqual(done.stderr, "'nothing' holds no tiles of a run (run.part); expected the output folder of 'ifov "
                                          "render --tiles'\n")

    def test_a_dry_run_foretells_the_cost(self):
        with Folder(scene=SCENE) as folder:
            done = run("render", "scene.json", "--dry-run", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(os.listdir(folder), ["scene.json"])
            number, unit = re.search(r"^rays +([\d.]+)( [kMG])?$", done.stdout, re.MULTILINE).groups()
            rays = float(number) * {None: 1, " k": 1e3, " M": 1e6, " G": 1e9}[unit]
            ratio = rays / self.reference["image_run.json"]["cost"]["rays"]["total"]
            self.assertTrue(1 / 1.5 < ratio < 1.5, done.stdout)

    def test_mistakes_on_the_command_line(self):
        with Folder(scene=SCENE) as folder:
            for arguments, words in (
                (("--time-limit", "10"), "--time-limit '10': expected a time above 0 with its unit, such as 90s, 10min, 1.5h or 2d"),
                (("--time-limit", "-5min"), "--time-limit '-5min': expected a time above 0"),
                (("--tiles", "5/4"), "--tiles '5/4': expected which share of how many, such as 1/64 to 64/64"),
                (("--tiles", "half"), "--tiles 'half': expected which share"),
                (("--resume", "--restart"), "--resume excludes --restart"),
            ):
                done = run("render", "scene.json", *arguments, cwd=folder)
                self.assertEqual((done.returncode, done.stdout), (1, ""), arguments)
                self.assertIn(words, done.stderr)

    def test_a_run_that_will_not_fit_on_disk_says_so_before_it_begins(self):
        giant = SCENE.replace("[45, 40]", "[30000, 30000]").replace('"tile": 9', '"tile": 256')
        with Folder(scene=giant) as folder:
            free = shutil.disk_usage(folder).free
            if free > 200e9:
                self.skipTest("the disk has room for it")
            done = run("render", "scene.json", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            found = re.fullmatch(r"ifov: scene\.out: the run takes ([\d.]+) GB of disk, ([\d.]+) (\wB) are free\n"
                                 r"Nothing was begun\. --anyway begins all the same; --dry-run says more\.\n", done.stderr)
            self.assertTrue(found, done.stderr)
            # Two channels and three materials: radiance and the errors, pictures of counts and fractions, and what tiles hold besides.
            self.assertTrue(80 < float(found[1]) < 150, done.stderr)
            self.assertAlmostEqual(float(found[2]) * {"kB": 1e3, "MB": 1e6, "GB": 1e9}[found[3]], free, delta=2e9)
            self.assertEqual(os.listdir(folder), ["scene.json"])
            if free < 60e9:  # what --anyway meets then is the disk itself
                done = run("render", "scene.json", "--anyway", cwd=folder)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertRegex(done.stderr, r"^ifov: scene\.out: the disk is full: the products take 65\.1 GB, [\d.]+ \wB free\n$")

    @LIMITS_MEMORY
    def test_a_run_that_will_not_fit_in_memory_says_so_before_it_begins(self):
        wide = SCENE.replace("[45, 40]", "[2048, 2048]").replace('"tile": 9', '"tile": 2048').replace(', "geotiff", "png"', "")
        words = (r"the run takes ([\d.]+) MB of memory, ([\d.]+) MB are there; fewer threads or smaller tiles take less\n")
        with Folder(scene=wide) as folder:
            done = run_within(900, "scene.json", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            found = re.fullmatch("ifov: " + words + r"Nothing was begun\. --anyway begins all the same; --dry-run says more\.\n",
                                 done.stderr)
            self.assertTrue(found, done.stderr)
            self.assertLess(float(found[2]), 900 * 1.048576)
            self.assertGreater(float(found[1]), float(found[2]))
            done = run_within(900, "scene.json", "--dry-run", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (2, ""))
            self.assertRegex(done.stdout, "^memory .*\ndisk .*\nprobed     nothing: there is too little memory\nit will not do: "
                             + words + "$")
            self.assertEqual(os.listdir(folder), ["scene.json"])
            done = run_within(900, "scene.json", "--anyway", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertRegex(done.stderr, r"^ifov: memory ran out: [\d.]+ MB were held at most, and no more than 943\.7 MB may be mapped "
                                          r"\(ulimit -v\); fewer threads or smaller tiles take less\n$")

    @LIMITS_MEMORY
    def test_memory_that_runs_out_is_said_and_nothing_is_lost(self):
        words = 0
        for megabytes in (150, 300, 450, 600, 1200):
            with Folder(scene=SCENE) as folder:
                done = run_within(megabytes, "scene.json", "-j", "2", cwd=folder)
                if done.returncode in (0, 127):  # enough, or not even enough to load the program
                    continue
                words += 1
                self.assertEqual(done.returncode, 2, f"{megabytes} MB: {done.stderr}")
                self.assertRegex(done.stderr, MEMORY_WORDS)
                self.expect_resumed(folder)
        self.assertGreater(words, 0)


class SmallDisk(Runs):
    """On a file system of a few megabytes that the test owns."""

    def setUp(self):
        self.disk = pathlib.Path(tempfile.mkdtemp())
        self.mounted = False
        self.addCleanup(self.clear)
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "ifov-test", self.disk], capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest(f"no file system can be mounted here: {done.stderr.strip()}")
        self.mounted = True
        (self.disk / "scene.json").write_text(SCENE)

    def clear(self):
        if self.mounted:
            subprocess.run(["umount", "-l", self.disk], check=True)
        self.disk.rmdir()

    def remount(self, options):
        subprocess.run(["mount", "-o", f"remount,{options}", self.disk], check=True)


# The tests above need no disk of their own.
for _name in [name for name in dir(Runs) if name.startswith("test_")]:
    setattr(SmallDisk, _name, None)


def _full_disk(self):
    """Room for the products, and then for some tiles only: a hog takes the rest while the run is at work."""
    process = start(self.disk)
    wait_for_tiles(self.disk / "scene.out")
    with open(self.disk / "hog", "wb") as hog:
        try:
            while True:
                hog.write(bytes(4096))
                hog.flush()
        except OSError:
            pass
        try:
            hog.close()
        except OSError:
            pass
    errors = process.communicate()[1]
    if process.returncode == 0:
        self.skipTest("the run was done before the disk was full")
    self.assertEqual(process.returncode, 2, errors)
    self.assertRegex(errors, r"^ifov: scene\.out/.*: (the disk is full: .* wanted, .* free|cannot )")
    self.assertTrue(errors.endswith("\nFinished tiles are kept in scene.out/run.part: put this right and go on with "
                                    "--resume.\n"), errors)
    (self.disk / "hog").unlink()
    self.expect_resumed(self.disk)


def _small_from_the_start(self):
    self.remount("size=100k")
    done = run("render", "scene.json", cwd=self.disk)
    self.assertEqual((done.returncode, done.stdout), (2, ""))
    self.assertRegex(done.stderr, r"^ifov: scene\.out: the run takes \d+\.\d kB of disk, \d+\.\d kB are free\n"
                                  r"Nothing was begun\. --anyway begins all the same; --dry-run says more\.\n$")
    self.assertEqual(os.listdir(self.disk), ["scene.json"])
    done = run("render", "scene.json", "--anyway", cwd=self.disk)
    self.assertEqual((done.returncode, done.stdout), (2, ""))
    self.assertRegex(done.stderr, r"^ifov: scene\.out: the disk is full: .* \d+\.\d kB, \d+\.\d kB free")
    self.assertEqual([f for f in os.listdir(self.disk / "scene.out") if not f.endswith(".part")], [])
    self.remount("size=64m")
    self.expect_resumed(self.disk)


def _room_for_the_products_alone(self):
    """The tiles do not fit beside them: --anyway goes as far as it can, and what is finished is kept."""
    self.remount("size=176k")
    done = run("render", "scene.json", cwd=self.disk)
    self.assertRegex(done.stderr, r"^ifov: scene\.out: the run takes \d+\.\d kB of disk, \d+\.\d kB are free\nNothing was begun\.")
    done = run("render", "scene.json", "--anyway", cwd=self.disk)
    self.assertEqual((done.returncode, done.stdout), (2, ""))
    self.assertRegex(done.stderr, r"^ifov: scene\.out/.*: (the disk is full: .* wanted, .* free|cannot )[^\n]*\n"
                                  r"Finished tiles are kept in scene\.out/run\.part: put this right and go on with --resume\.\n$")
    self.assertIn("unfinished run", run("status", "scene.out", cwd=self.disk).stdout)
    # What the run has taken already is not asked for again.
    self.remount("size=400k")
    self.expect_resumed(self.disk)


def _dry_run_on_a_small_disk(self):
    self.remount("size=100k")
    done = run("render", "scene.json", "--dry-run", cwd=self.disk)
    self.assertEqual(done.returncode, 2, done.stderr)
    self.assertRegex(done.stdout, r"\nit will not do: scene\.out: the run takes \d+\.\d kB of disk, \d+\.\d kB are free\n$")
    self.assertEqual(os.listdir(self.disk), ["scene.json"])


def _read_only(self):
    process = start(self.disk)
    wait_for_tiles(self.disk / "scene.out")
    process.kill()
    process.communicate()
    self.remount("ro")
    done = run("render", "scene.json", "--resume", cwd=self.disk)
    self.assertEqual((done.returncode, done.stdout), (2, ""))
    self.assertEqual(done.stderr, "ifov: scene.out: the folder cannot be written: Read-only file system\n")
    self.remount("rw")
    self.expect_resumed(self.disk)


SmallDisk.test_a_disk_that_fills_up = _full_disk
SmallDisk.test_a_disk_that_is_too_small_from_the_start = _small_from_the_start
SmallDisk.test_anyway_begins_where_the_tiles_will_not_fit = _room_for_the_products_alone
SmallDisk.test_a_dry_run_says_that_the_disk_is_too_small = _dry_run_on_a_small_disk
SmallDisk.test_a_folder_that_became_read_only = _read_only


if __name__ == "__main__":
    unittest.main()
