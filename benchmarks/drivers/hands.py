"""The Python package and the viewer: what Python costs beside the program, how long an import takes, what a thousand renders leave behind,
how soon Ctrl-C ends a render, and a cube of 14 GB in the viewer."""

import http.client
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import urllib.parse

from drivers.bookkeeping import least, window
from drivers.ends import DONE
from drivers.figures import at_most, figure, median, not_measured

WIDTH, HEIGHT, BANDS = 4000, 3900, 224  # 14 GB of float32


def processor_s(command):
    """Of a process that ends well, or with a few pixels above the limit."""
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in DONE:
        raise subprocess.CalledProcessError(process.returncode, command)
    return usage.ru_utime + usage.ru_stime


def overhead(context, python):
    """Processor time of `ifov render` and of the same document through Python, by turns, of the suburb from above."""
    suburb = context.folder / "hands_suburb"
    if not (suburb / "scene.json").exists():
        subprocess.run([context.program("ifov"), "make", "suburb", suburb, "--size", "100m", "--seed", "3", "--force", "-q"], check=True)
    document = window(suburb / "render_thermal.json", {"accuracy": {"error": "3 %"}})
    out = context.folder / "hands_out"
    code = f"import ifov; ifov.run(ifov.read({str(document)!r}), {str(out)!r}, restart=True, progress=False, threads=2, scene_cache=False)"
    memory = f"import ifov; ifov.render(ifov.read({str(document)!r}), progress=False, threads=2)"
    start, imports = "import ifov; ifov.version()", "import ifov, xarray; ifov.version()"  # a run in a folder takes no xarray
    program = [context.program("ifov"), "render", document, "--quiet", "--threads", "2", "--restart", "--no-cache", "-o", out]
    times = {"program": [], "run": [], "memory": [], "start": [], "import": []}
    ways = {"program": program, "run": [python, "-c", code], "memory": [python, "-c", memory], "start": [python, "-c", start], "import": [python, "-c", imports]}
    for k in range(15 if context.long else 7):
        for name in sorted(ways, reverse=k % 2 == 1):
            times[name].append(processor_s(ways[name]))
    cost = {name: least(values) for name, values in times.items()}
    started = cost["import"]  # xarray and its parts, once a session
    return {
        "hands.suburb_program": figure(round(cost["program"], 2), "s of processors"),
        "hands.python_over_program": at_most(100 * ((cost["run"] - cost["start"]) / cost["program"] - 1), 2.0, "% of processor time", 2),
        "hands.python_in_memory_over_program": at_most(100 * ((cost["memory"] - started) / cost["program"] - 1), 2.0, "% of processor time", 2),
        "hands.python_start_with_xarray": figure(round(started, 2), "s of processors"),
    }


def imports(python):
    code = "import time; t = time.perf_counter(); import ifov; print(time.perf_counter() - t)"
    times = [float(subprocess.run([python, "-c", code], capture_output=True, text=True, check=True).stdout) for _ in range(9)]
    return {"hands.import": at_most(median(times), 0.5, "s")}


MANY = """
import json, os, sys, xarray, ifov
scene = json.loads(sys.argv[1])
def memory(): return int(open("/proc/self/statm").read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
for k in range(int(sys.argv[2])):
    ifov.render(scene, progress=False, callback=lambda _: None, on_tile=lambda _: None)
    if k == int(sys.argv[2]) // 5: before = memory()
print(json.dumps({"grown": memory() - before, "files": len(os.listdir("/proc/self/fd"))}))
"""

STOPPED = """
import json, os, random, signal, sys, threading, time, xarray, ifov
scene = ifov.Scene(ifov.read(sys.argv[1]))
random.seed(1)
waits = []
for _ in range(int(sys.argv[2])):
    sent = []
    def interrupt(): time.sleep(random.uniform(0.3, 6)); sent.extend((time.monotonic(), time.process_time())); os.kill(os.getpid(), signal.SIGINT)
    thread = threading.Thread(target=interrupt); thread.start()
    try: scene.render(progress=False)
    except KeyboardInterrupt: waits.append((time.monotonic() - sent[0], time.process_time() - sent[1]))
    thread.join()
print(json.dumps(waits))
"""


def python_calls(context, python):
    scene = {"ifov": 1, "scene": {"materials": {"m": {"reflectance": 0.3, "temperature": "20 degC"}},
                                  "objects": [{"plane": {}, "material": "m"}, {"sphere": {"center": ["0 m", "0 m", "1 m"], "radius": "1 m"}, "material": "m"}]},
             "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
             "sensor": {"camera": {"orthographic": {"gsd": "0.3 m", "pixels": [12, 10]}}, "channels": [{"name": "a", "monochromatic": {"at": "0.6 um"}}]},
             "sampling": {"accuracy": {"error": "4 %"}}}

    def ask(code, *words):
        done = subprocess.run([python, "-W", "ignore", "-c", code, *map(str, words)], stdout=subprocess.PIPE, text=True, check=True)
        return json.loads(done.stdout.splitlines()[-1])

    left = ask(MANY, json.dumps(scene), 1000)
    demo = pathlib.Path(__file__).resolve().parents[2] / "examples/demo.json"
    waits = ask(STOPPED, demo, 40 if context.long else 15)
    return {
        "hands.memory_of_800_renders": at_most(left["grown"], 10.0, "MB"),
        "hands.ctrl_c_tracing_wall": figure(round(median([wall for wall, _ in waits]), 3), "s, median", "<= 0.1 where nobody else works"),
        "hands.ctrl_c_tracing_processors": at_most(max(used for _, used in waits), 0.2, "s of two, worst"),
    }


class Shown:
    """`ifov view` of a folder."""

    def __init__(self, program, folder):
        self.begin = time.monotonic()
        self.process = subprocess.Popen([program, "view", folder, "--no-browser"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        address = urllib.parse.urlsplit(self.process.stdout.readline().strip())
        self.connection = http.client.HTTPConnection(address.hostname, address.port)
        self.token = address.fragment

    def ask(self, name, **query):
        begin = time.monotonic()
        self.connection.request("GET", f"/api/{name}?{urllib.parse.urlencode(query)}", headers={"X-Ifov-Token": self.token})
        answer = self.connection.getresponse()
        body = answer.read()
        if answer.status != 200:
            raise RuntimeError(f"{name}: {answer.status} {body[:200]!r}")
        return body, time.monotonic() - begin

    def most_memory(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmHWM"):
                return int(line.split()[1]) / 1e3
        raise RuntimeError("the system tells no memory")


def large_cube(folder):
    """Products whose cubes are holes of that size, but for one pixel, which is told back."""
    folder.mkdir()
    um = [round(0.4 + 0.01 * k, 4) for k in range(BANDS)]
    names = [f"B{k + 1}" for k in range(BANDS)]
    for name in ("radiance", "half_width"):
        (folder / f"image_{name}.img.hdr").write_text(
            f"ENVI\nsamples = {WIDTH}\nlines = {HEIGHT}\nbands = {BANDS}\nheader offset = 0\nfile type = ENVI Standard\ndata type = 4\n"
            f"interleave = bil\nbyte order = 0\nband names = {{{', '.join(names)}}}\nwavelength units = Micrometers\n"
            f"wavelength = {{{', '.join(map(str, um))}}}\ndata units = W m-2 sr-1 um-1\n")
        with open(folder / f"image_{name}.img", "wb") as file:
            file.truncate(4 * WIDTH * HEIGHT * BANDS)
            for band in range(BANDS):
                file.seek(4 * ((2000 * BANDS + band) * WIDTH + 1000))
                file.write(b"\x00\x00\x80\x3f")  # 1
    (folder / "image_run.json").write_text(json.dumps({
        "program": {"name": "ifov", "version": "0.1.0"}, "seed": 1, "sampler": "accuracy", "document": {"path": "s.json", "text": "{}"},
        "image": {"width_px": WIDTH, "height_px": HEIGHT, "radiance_unit": "W m-2 sr-1 um-1", "footprint_px": 1.0},
        "channels": [{"name": n, "centre_um": u, "fwhm_um": 0.01} for n, u in zip(names, um)],
        "accuracy": {"asked": "1 %", "reached": "", "confidence": 0.95}, "notes": []}))


def viewer(context):
    with tempfile.TemporaryDirectory(dir=context.folder) as folder:
        cubes = pathlib.Path(folder) / "out"
        large_cube(cubes)
        shown = Shown(context.program("ifov"), cubes)
        try:
            said, _ = shown.ask("sources")
            opened = time.monotonic() - shown.begin
            now = {"source": 0, "generation": json.loads(said)["sources"][0]["generation"]}
            whole = {"cube": "radiance", "x0": 0, "y0": 0, "x1": WIDTH, "y1": HEIGHT, "step": 4}
            part = {"cube": "radiance", "x0": 1000, "y0": 1000, "x1": 2400, "y1": 2400, "step": 1}
            bands = [shown.ask("band", **now, **whole, band=40 * k)[1] for k in range(5)]
            parts = [shown.ask("band", **now, **part, band=40 * k + 1)[1] for k in range(5)]
            spectra = [shown.ask("pixel", **now, x=700 * k, y=800 * k)[1] for k in range(5)]
            told = json.loads(shown.ask("pixel", **now, x=1000, y=2000)[0])["radiance"]
            if told != [1.0] * BANDS:
                raise RuntimeError(f"the viewer tells another spectrum: {told[:3]} ...")
            memory = shown.most_memory()
        finally:
            shown.process.send_signal(signal.SIGINT)
            shown.process.wait(30)
    return {
        "hands.viewer_opens_14_gb": at_most(opened, 2.0, "s"),
        "hands.viewer_band": at_most(max(bands), 0.5, "s, worst"),
        "hands.viewer_1400_pixels_in_full": at_most(max(parts), 0.5, "s, worst"),
        "hands.viewer_spectrum": at_most(1e3 * max(spectra), 50.0, "ms, worst"),
        "hands.viewer_memory": at_most(memory, 300.0, "MB at most", 0),
    }


def run(context):
    found = viewer(context)
    python = context.build / "venv/bin/python"
    if not (context.build / "venv/ready").exists():
        return found | {"hands.python_over_program": not_measured("there is no Python package: make python")}
    os.environ.pop("PYTHONPATH", None)
    return found | imports(python) | overhead(context, python) | python_calls(context, python)
