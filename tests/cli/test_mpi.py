"""Runs of several ranks under mpirun: the bytes of one process, whatever the ranks do and whichever of them dies."""

import ctypes
import json
import os
import pathlib
import random
import re
import select
import shutil
import signal
import struct
import subprocess
import threading
import time
import unittest

from program import PROGRAM, Folder, WholeProducts, products, run
from test_runs import ENDLESS, KILLS, SCENE, wait_for_tiles

# Minutes of work in tiles of a tenth of a second.
LONG = ENDLESS.replace('"0.01 %"', '"1 %"')

MPIRUN = shutil.which("mpirun")
# Root has to ask for it, and more ranks than cores are part of the test.
LAUNCH = [MPIRUN, "--allow-run-as-root", "--oversubscribe"]
TCP = ["--mca", "btl", "tcp,self"]
HAS_MPI = "built without MPI" not in run("--version").stdout
# What containers may lack, and Open MPI then complains of: the machine's topology, copies between processes.
os.environ |= {"HWLOC_HIDE_ERRORS": "2", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
# Fewer kills than in the runs of one process by default, because each start takes longer.
MPI_KILLS = KILLS if "IFOV_KILLS" in os.environ else 3


def mpirun(ranks, *arguments, cwd, launch=()):
    """The finished process, without what mpirun's libraries say of the machine."""
    done = subprocess.run(
        [*LAUNCH, *launch, "-n", str(ranks), PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
        timeout=200,
    )
    done.stderr = "".join(line for line in done.stderr.splitlines(keepends=True) if not line.startswith("[hwloc"))
    return done


def start(ranks, *arguments, cwd, launch=()):
    return subprocess.Popen(
        [*LAUNCH, *launch, "-n", str(ranks), PROGRAM, "render", "scene.json", *arguments], cwd=cwd, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True,
    )


def children_of(process):
    return pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()


def ranks_of(process):
    """Process ids of the ranks that an mpirun has started, by rank."""
    found = {}
    for child in children_of(process):
        try:
            environment = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
        except OSError:
            continue
        for entry in environment:
            if entry.startswith(b"OMPI_COMM_WORLD_RANK="):
                found[int(entry.split(b"=")[1])] = int(child)
    return found


def wait_for_end(process):
    """Until an mpirun whose rank was killed has ended. One that lost a rank as it began may wait for itself for ever
    (PMIx's lock, in PMIx_server_finalize), all its ranks being gone: it is ended then."""
    def at_work(child):
        return pathlib.Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()[0] != "Z"

    for _ in range(20):
        try:
            return process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            is_launcher = pathlib.Path(f"/proc/{process.pid}/comm").read_text().strip() in ("mpirun", "orterun")
            if is_launcher and not any(map(at_work, children_of(process))):
                process.kill()
    raise AssertionError("the ranks are at work 200 s after one of them was killed")


def tiles_in(pack):
    return pack.read_bytes().count(b"IFOVTILE")


def wait_for(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"not within {seconds} s")
        time.sleep(0.02)


@unittest.skipUnless(MPIRUN, "mpirun is not installed (Debian: openmpi-bin)")
@unittest.skipUnless(HAS_MPI, "ifov was built without MPI")
class Ranks(WholeProducts, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(scene=SCENE)
        done = run("render", "scene.json", "-j", 2, "--no-state", cwd=cls._folder.path)
        assert done.returncode == 0, done.stderr
        cls.reference = products(cls._folder.path / "scene.out")

    def expect_resumed(self, folder, ranks):
        done = mpirun(ranks, "render", "scene.json", "--resume", cwd=folder) if ranks > 1 else run(
            "render", "scene.json", "--resume", cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_whole(folder / "scene.out")
        return done

    def test_any_number_of_ranks_gives_the_same_bytes(self):
        for ranks, launch in ((2, ()), (3, TCP), (8, ())):
            with self.subTest(ranks=ranks, launch=launch), Folder(scene=SCENE) as folder:
                done = mpirun(ranks, "render", "scene.json", cwd=folder, launch=launch)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                # Said once, by the first rank.
                self.assertEqual(len(re.findall(r"^1800 pixels, ", done.stdout, re.MULTILINE)), 1, done.stdout)
                self.expect_whole(folder / "scene.out")

    def test_tiles_that_take_no_time_are_handed_out_in_groups(self):
        """Thousands of them, far quicker than a message."""
        cheap = re.sub(r'"sampling": .*\n', '"sampling": {"single": {}, "tile": 4},\n', SCENE).replace("[45, 40]", "[400, 300]")
        with Folder(scene=cheap) as folder:
            self.assertEqual(run("render", "scene.json", "-o", "alone", cwd=folder).returncode, 0)
            done = mpirun(3, "render", "scene.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(products(folder / "scene.out"), products(folder / "alone"))

    def test_ranks_of_different_speed(self):
        with Folder(scene=SCENE) as folder:
            process = start(3, cwd=folder)
            wait_for_tiles(folder / "scene.out")
            slow = ranks_of(process)[1]
            try:
                while process.poll() is None:  # the second rank works a fifth of the time
                    os.kill(slow, signal.SIGSTOP)
                    time.sleep(0.04)
                    os.kill(slow, signal.SIGCONT)
                    time.sleep(0.01)
            except ProcessLookupError:  # it is done
                pass
            said = process.communicate()
            self.assertEqual((process.returncode, said[1]), (0, ""))
            self.expect_whole(folder / "scene.out")

    def test_tiles_are_handed_out_while_the_first_rank_traces(self):
        """One thread each and a first rank that is at work all the time: the others have tiles nevertheless."""
        for launch in ((), TCP):
            with Folder(scene=LONG) as folder:
                kept = folder / "scene.out" / "run.part" / "tiles"
                process = start(3, "-j", "1", cwd=folder, launch=launch)
                try:
                    wait_for(lambda: all(sum(map(tiles_in, kept.glob(f"*.{rank}.tiles"))) > 5 for rank in (1, 2)), 100)
                finally:
                    process.send_signal(signal.SIGINT)
                    process.communicate()

    def test_the_counter_serves_shares_too(self):
        with Folder(scene=SCENE) as folder:
            for share in (1, 2):
                done = mpirun(2, "render", "scene.json", "--tiles", f"{share}/2", cwd=folder)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
            done = run("merge", "scene.out.1-of-2", "scene.out.2-of-2", "--output", "scene.out", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.expect_whole(folder / "scene.out")

    def test_a_rank_that_dies_ends_the_run_and_resuming_completes_it(self):
        for victim, ranks_then in ((1, 4), (2, 1), (0, 2)):
            with self.subTest(victim=victim), Folder(scene=LONG) as folder:
                process = start(3, "-j", "1", cwd=folder)
                wait_for_tiles(folder / "scene.out")
                os.kill(ranks_of(process)[victim], signal.SIGKILL)
                said = "".join(process.communicate(timeout=30))
                self.assertNotEqual(process.returncode, 0)
                self.assertIn(f"process rank {victim} ", said)
                self.assertIn("exited on signal 9 (Killed)", said)
                if victim != 0:
                    self.assertIn("ifov: stopped (Ctrl-C, or a rank ended: mpirun says which); unfinished products "
                                  "carry the ending .part, and --resume goes on with what is finished\n", said)
                status = run("status", "scene.out", cwd=folder).stdout
                done = int(re.search(r"done +(\d+) of 2300 tiles", status)[1])
                self.assertGreater(done, 0)
                # Taken over, whatever the number of ranks, and gone on with.
                process = (start(ranks_then, "--resume", cwd=folder) if ranks_then > 1 else
                           subprocess.Popen([PROGRAM, "render", "scene.json", "--resume"], cwd=folder, stderr=subprocess.PIPE))
                try:
                    wait_for(lambda: int(re.search(r"done +(\d+) of", run("status", "scene.out", cwd=folder).stdout)[1]) > done, 100)
                finally:
                    process.send_signal(signal.SIGINT)
                    process.communicate()

    def test_killed_at_random_moments(self):
        """Any rank; taken up by another number of ranks each time."""
        moments = random.Random(11)
        kills = 0
        while kills < MPI_KILLS:
            with Folder(scene=SCENE) as folder:
                while True:
                    ranks = moments.choice((1, 2, 3, 4))
                    if ranks == 1:
                        process = subprocess.Popen([PROGRAM, "render", "scene.json", "--resume"], cwd=folder,
                                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                    else:
                        process = start(ranks, "--resume", cwd=folder)
                    try:
                        process.wait(timeout=moments.uniform(0.1, 1.5))
                    except subprocess.TimeoutExpired:
                        victims = ranks_of(process) if ranks > 1 else {0: process.pid}
                        if victims:
                            kills += 1
                            try:
                                os.kill(victims[moments.choice(sorted(victims))], signal.SIGKILL)
                            except ProcessLookupError:
                                pass
                    wait_for_end(process)
                    if process.returncode == 0:
                        break
                self.expect_whole(folder / "scene.out")

    def test_ctrl_c_keeps_what_is_finished(self):
        with Folder(scene=LONG) as folder:
            process = start(3, "-j", "1", cwd=folder)
            wait_for_tiles(folder / "scene.out")
            begin = time.monotonic()
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=30)
            self.assertLess(time.monotonic() - begin, 10.0)
            self.assertNotEqual(process.returncode, 0)
            self.assertEqual(said[1].count("ifov: stopped "), 1, said[1])
            self.assertIn("--resume goes on with what is finished", said[1])
            self.assertRegex(run("status", "scene.out", cwd=folder).stdout, r"done +[1-9]\d* of 2300 tiles")

    def test_a_run_that_is_kept_and_refined_has_the_same_bytes_whoever_does_it(self):
        """Kept by some ranks and refined by others; the tiles in run.kept lie in other files then."""

        def whole(folder):
            content = products(folder)
            return content | {"run.kept": sorted(os.listdir(folder / "run.kept"))}

        first = SCENE.replace("[45, 40]", "[30, 25]")
        with Folder(scene=first) as folder:
            launchers = {"alone": lambda *words: run("render", "scene.json", *words, cwd=folder),
                         "ranks": lambda *words: mpirun(3, "render", "scene.json", *words, cwd=folder)}
            for name, launch in launchers.items():
                done = launch("--keep", "-o", name)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(whole(folder / "ranks"), whole(folder / "alone"))
            shutil.copytree(folder / "alone", folder / "alone by ranks")
            shutil.copytree(folder / "ranks", folder / "ranks alone")
            (folder / "scene.json").write_text(first.replace('"2 %"', '"1 %"'))
            for where, name in (("alone", "alone"), ("ranks", "ranks"), ("alone by ranks", "ranks"), ("ranks alone", "alone")):
                done = launchers[name]("--refine", "-o", where)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual(whole(folder / where), whole(folder / "alone"), where)

    def test_a_damaged_kept_tile_is_told_by_the_rank_that_met_it(self):
        first = SCENE.replace("[45, 40]", "[30, 25]")
        with Folder(scene=first) as folder:
            self.assertEqual(run("render", "scene.json", "--keep", cwd=folder).returncode, 0)
            for pack in (folder / "scene.out/run.kept/tiles").iterdir():
                content = bytearray(pack.read_bytes())
                content[-1] ^= 1  # of its last tile
                pack.write_bytes(content)
            (folder / "scene.json").write_text(first.replace('"2 %"', '"1 %"'))
            done = mpirun(3, "render", "scene.json", "--refine", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stderr, r"warning: (rank [12] on \S+: )?tile \d+ of the kept run is damaged or missing: it is "
                                          r"rendered from the beginning")

    def test_a_dry_run_divides_the_time_among_all_ranks(self):
        with Folder(scene=SCENE) as folder:
            done = mpirun(3, "render", "scene.json", "--dry-run", "-j", "1", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            found = re.search(r"^time +([\d.]+) s, give or take \d+ %; ([\d.]+) s of processor time$", done.stdout, re.MULTILINE)
            elapsed, processor = map(float, found.groups())
            self.assertLess(elapsed, 0.3 + 0.6 * processor)
            self.assertEqual(os.listdir(folder), ["scene.json"])

    def test_errors_are_said_once(self):
        with Folder(scene=SCENE, wrong=SCENE.replace('"radius"', '"radios"')) as folder:
            for arguments, code, words in (
                (("wrong.json",), 1, "radios"),
                (("nothing.json",), 2, "nothing.json"),
                (("scene.json", "--no-state"), 1, "--no-state: several ranks put their tiles together in the run's folder"),
            ):
                with self.subTest(arguments=arguments):
                    done = mpirun(3, "render", *arguments, cwd=folder)
                    own = done.stderr.split("-" * 74)[0]
                    self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
                    alone = run("render", *arguments, cwd=folder)
                    self.assertEqual(own.count(words), 1 if words.startswith("--") else alone.stderr.count(words), own)
            # A fault of one rank alone is told with its name: the document is another one where it looks.
            (folder / "other").mkdir()
            shutil.copy(folder / "scene.json", folder / "other")
            (folder / "other" / "scene.json").write_text(SCENE.replace('"seed": 5', '"seed": 6'))
            done = subprocess.run(
                [*LAUNCH, "-n", "1", PROGRAM, "render", "scene.json", ":", "-n", "1", "--wdir", folder / "other", PROGRAM, "render",
                 "scene.json"], cwd=folder, capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertRegex(done.stderr, r"rank 1 on \S+: its tiles would not fit those of the first rank, there and here:\n"
                                          r"  the document: line 3 was '\"seed\": 5,' and is '\"seed\": 6,'\n")

    def test_an_output_folder_that_is_not_shared(self):
        with Folder(scene=SCENE) as folder:
            (folder / "other").mkdir()
            shutil.copy(folder / "scene.json", folder / "other")
            done = subprocess.run(
                [*LAUNCH, "-n", "1", PROGRAM, "render", "scene.json", ":", "-n", "1", "--wdir", folder / "other", PROGRAM, "render",
                 "scene.json"], cwd=folder, capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, r"rank 1 on \S+: 'scene\.out/run\.part/state\.json', which the first rank wrote, is not to be "
                                          r"seen from here: the output folder \(--output\) must be on a file system that all machines share")

    def test_without_mpirun_mpi_is_never_touched(self):
        """Its components are loaded when it is initialised."""

        def components(process):
            return "/mca_" in pathlib.Path(f"/proc/{process}/maps").read_text()

        with Folder(scene=LONG) as folder:
            process = subprocess.Popen([PROGRAM, "render", "scene.json", "-q"], cwd=folder)
            wait_for_tiles(folder / "scene.out")
            touched = components(process.pid)
            process.kill()
            process.wait()
            self.assertFalse(touched)
            process = start(2, "--resume", "-q", cwd=folder)
            wait_for(lambda: len(ranks_of(process)) == 2 and all(map(components, ranks_of(process).values())))
            process.send_signal(signal.SIGINT)
            process.communicate()

    def test_the_scene_is_read_once_on_a_machine(self):
        """The mesh's file is opened as often by three ranks as by one process: what the first one has read, the others
        find in the cache."""
        rows = 120
        text = "".join(f"v {x} {y} {0.1 * ((x * y) % 3)}\n" for y in range(rows) for x in range(rows))
        for y in range(rows - 1):
            for x in range(rows - 1):
                corner = 1 + y * rows + x
                text += f"f {corner} {corner + 1} {corner + rows}\nf {corner + 1} {corner + rows + 1} {corner + rows}\n"
        scene = json.loads(SCENE)
        scene["sensor"]["camera"]["orthographic"]["pixels"] = [27, 27]  # nine tiles
        scene["scene"]["objects"].append({"mesh": {"file": "hills.obj", "unit": "m"}, "material": "ball"})
        opened = {}
        for ranks, arguments in ((1, ()), (3, ()), (1, ("--no-cache",)), (3, ("--no-cache",))):
            with Folder(scene=json.dumps(scene)) as folder:
                (folder / "hills.obj").write_text(text)
                with Opened(folder / "hills.obj") as count:
                    if ranks == 1:
                        done = run("render", "scene.json", "-q", *arguments, cwd=folder)
                    else:
                        done = mpirun(ranks, "render", "scene.json", "-q", *arguments, cwd=folder)
                self.assertIn(done.returncode, (0, 6), done.stderr)  # the hills hang in the air
                opened[ranks, arguments] = count.times
        self.assertGreater(opened[1, ()], 0)
        self.assertEqual(opened[3, ()], opened[1, ()])
        self.assertGreater(opened[3, ("--no-cache",)], opened[1, ("--no-cache",)])


class Opened:
    """Counts how often a file is opened (inotify)."""

    IN_OPEN, IN_CLOSE_NOWRITE, IN_NONBLOCK = 0x20, 0x10, 0o4000

    def __init__(self, file):
        libc = ctypes.CDLL(None, use_errno=True)
        self.descriptor = libc.inotify_init1(self.IN_NONBLOCK)
        if self.descriptor < 0 or libc.inotify_add_watch(
                self.descriptor, os.fsencode(file), self.IN_OPEN | self.IN_CLOSE_NOWRITE) < 0:
            raise OSError(ctypes.get_errno(), "inotify")
        self.times = 0
        self.ended = threading.Event()
        self.counting = threading.Thread(target=self.count)

    def count(self):
        """At once, and closings as well: like events that follow each other and were not fetched become one."""
        while not self.ended.is_set():
            select.select([self.descriptor], [], [], 0.05)
            self.fetch()

    def fetch(self):
        try:
            events = os.read(self.descriptor, 1 << 16)
        except BlockingIOError:
            return
        self.times += sum(mask & self.IN_OPEN != 0 for _, mask, _, _ in struct.iter_unpack("<iIII", events))

    def __enter__(self):
        self.counting.start()
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.counting.join()
        self.fetch()
        os.close(self.descriptor)


if __name__ == "__main__":
    unittest.main()
