"""Runs that are stopped at random moments of loading, air, tracing, writing and a wide PSF: how long until they end,
whether anything they leave looks complete that is not, and whether --resume goes on from there."""

import collections
import json
import os
import random
import shutil
import signal
import statistics
import subprocess
import time

from drivers.figures import at_least, at_most, figure

MOMENTS = 100
RESUMED = 10
SLOWEST = 1.0  # seconds from the signal or the time limit to the end of the process
GIVE_UP_S = 600.0
DONE, STOPPED, UNMET = (0, 5, 6), 130, 4

SCENE = {
    "ifov": 1, "seed": 5,
    "scene": {"materials": {"ground": {"reflectance": 0.3, "temperature": "20 degC"},
                            "ball": {"reflectance": 0.6, "temperature": "35 degC"}},
              "objects": [{"plane": {}, "material": "ground"},
                          *({"sphere": {"center": [f"{7 * k - 17} m", f"{5 * (k % 4) - 8} m", "1 m"],
                                        "radius": f"{1 + k % 3} m"}, "material": "ball"} for k in range(6))]},
    "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"temperature": "250 K"}},
    "sensor": {"camera": {"orthographic": {"gsd": "0.2 m", "pixels": [200, 200]}},
               "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
    "sampling": {"accuracy": {"error": "1 %"}}, "output": {"formats": ["envi"]},
}


def scene(gsd, pixels, sampling, channels=1, to="0.7 um", **more):
    camera = {"orthographic": {"gsd": gsd, "pixels": [pixels, pixels]}}
    series = {"series": {"gaussian": {"from": "0.4 um", "to": to, "count": channels, "fwhm": "10 nm"}}}
    listed = [series] if channels > 1 else SCENE["sensor"]["channels"]
    sensor = {"camera": camera, "channels": listed, **more.pop("sensor", {})}
    return json.dumps({**SCENE, "sensor": sensor, "sampling": sampling, **more})


def run_quietly(command):
    return subprocess.run(command, capture_output=True, timeout=GIVE_UP_S, check=False).returncode


class Case:
    """A document and how long it takes, to the end of loading and altogether."""

    def __init__(self, program, folder, name, document, *options, part="whole", text=None):
        self.program, self.name, self.options, self.folder = program, name, options, folder
        self.document = document or folder / f"{name}.json"
        if text:
            self.document.write_text(text)
        self.out, self.whole = folder / f"{name}.out", folder / f"{name}.whole"
        shutil.rmtree(self.whole, ignore_errors=True)
        begin = time.monotonic()
        if run_quietly(self.command(self.whole)) not in DONE:
            raise RuntimeError(f"{self.document} cannot be rendered")
        whole = time.monotonic() - begin
        begin = time.monotonic()
        run_quietly([program, "check", self.document, "--quiet", *options])
        loaded = min(time.monotonic() - begin, whole)
        self.span = {"whole": (0.0, whole), "loading": (0.0, loaded), "after loading": (0.8 * loaded, whole)}[part]

    def command(self, out, *more):
        words = (self.program, "render", self.document, "--quiet", "--output", out, *self.options, *more)
        return [str(word) for word in words]

    def stop(self, moment, how):
        """Stops a run `moment` seconds after its start; (exit code, seconds from there to the end)."""
        shutil.rmtree(self.out, ignore_errors=True)
        limit = ("--time-limit", f"{moment:.3f}s") if how == "limit" else ()
        begin = time.monotonic()
        nowhere = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        with subprocess.Popen(self.command(self.out, *limit), **nowhere) as process:
            if how != "limit":
                try:
                    process.wait(timeout=moment)
                except subprocess.TimeoutExpired:
                    process.send_signal(how)
            process.wait(timeout=GIVE_UP_S)
            return process.returncode, time.monotonic() - begin - moment

    def looks_complete(self, code):
        """What looks complete in the folder of a run that ended so and is not."""
        if code in DONE or not self.out.exists():
            return []
        named = [file.name for file in self.out.iterdir() if file.is_file() and ".part" not in file.name]
        if code == UNMET and named:
            record = self.out / "image_run.json"
            is_marked = record.exists() and "hold no value" in record.read_text() and (self.out / "run.part").is_dir()
            return [] if is_marked else named
        return [name for name in named if not self.is_whole(name)]

    def is_whole(self, name):
        """Products that were whole before the signal came bear their names with reason."""
        reference = self.whole / name
        if name in ("image_run.json", "image_report.html"):  # these tell the time
            return (self.out / name).read_text().rstrip().endswith(reference.read_text().rstrip()[-1])
        return subprocess.run(["cmp", "--silent", self.out / name, reference], check=False).returncode == 0

    def resume(self):
        code = run_quietly(self.command(self.out, "--resume"))
        names = {file.name for file in self.whole.iterdir()}
        return code in DONE and {file.name for file in self.out.iterdir()} == names and all(map(self.is_whole, names))


def suburb(program, folder):
    made = folder / "suburb"
    if not (made / "quicklook.json").exists():
        subprocess.run([program, "make", "suburb", "--size", "200m", "--seed", "7", "--quiet", made], check=True)
    return made / "quicklook.json"


def loading(program, folder):
    return Case(program, folder, "loading", suburb(program, folder), "--no-cache", part="loading")


def air(program, folder):
    """--no-cache: nor are tables of the air kept."""
    text = scene("1 m", 16, {"single": {}}, 211, "2.5 um", light={"sun": SCENE["light"]["sun"]},
                 atmosphere={"profile": "mid-latitude summer"})
    return Case(program, folder, "air", None, "--no-cache", text=text)


def tracing(program, folder):
    return Case(program, folder, "tracing", None, text=scene("0.2 m", 200, {"accuracy": {"error": "1 %"}}))


def writing(program, folder, pixels=1024):
    products = {"formats": ["envi", "geotiff", "netcdf"]}
    text = scene("0.02 m", pixels, {"single": {}}, 60, "1 um", output=products)
    return Case(program, folder, "writing", None, text=text)


def large_writing(program, folder):
    return writing(program, folder, 2048)


def psf(program, folder):
    """50 pixels to each side."""
    sensor = {"psf": {"gaussian": {"sigma": "12.5 px"}}}
    return Case(program, folder, "psf", None, text=scene("0.2 m", 32, {"accuracy": {"error": "5 %"}}, sensor=sensor))


def judge(case, code, late, how):
    """What is wrong with an end, as a text; empty where nothing is."""
    if code == -(how if how != "limit" else 0) and late < 0.2 and not case.out.exists():
        return ""  # before the program looks out for signals, the system ends it
    if code not in DONE and code != (UNMET if how == "limit" else STOPPED):
        return f"exit code {code}"
    complete = case.looks_complete(code)
    return "looks complete: " + ", ".join(complete) if complete else ""


def measure(case, count, chance, resumes):
    """A row for each of `count` moments; `resumes` of the runs go on afterwards."""
    rows = []
    for k in range(count):
        moment, how = max(chance.uniform(*case.span), 0.001), (signal.SIGTERM, signal.SIGINT, "limit")[k % 3]
        code, late = case.stop(moment, how)
        wrong = judge(case, code, late, how)
        rows.append({"case": case.name, "moment_s": moment, "how": str(how), "code": code, "late_s": late,
                     "wrong": wrong, "load": os.getloadavg()[0], "resumed": None})
        if code not in DONE and resumes > 0:
            resumes -= 1
            rows[-1]["resumed"] = case.resume()
        if wrong or late > SLOWEST or rows[-1]["resumed"] is False:
            print("  ", rows[-1], flush=True)
    shutil.rmtree(case.out, ignore_errors=True)
    return rows


def run(context):
    program, folder = context.program("ifov"), context.folder / "signals"
    folder.mkdir(parents=True, exist_ok=True)
    makers = (loading, air, tracing, large_writing if context.long else writing, psf)
    chance, rows, figures = random.Random(1), [], {}
    for make in makers:
        case = make(program, folder)
        found = measure(case, MOMENTS // len(makers), chance, RESUMED // len(makers))
        span = f"s, from {case.span[0]:.1f} to {case.span[1]:.1f} s of the run"
        figures[f"signals.{case.name}_slowest"] = at_most(max(row["late_s"] for row in found), SLOWEST, span)
        rows += found
    (folder / "rows.json").write_text(json.dumps(rows, indent=1))
    counts = collections.Counter(row["code"] for row in rows)
    resumed = [row["resumed"] for row in rows if row["resumed"] is not None]
    return figures | {
        "signals.moments": figure(len(rows), "moments", ", ".join(f"code {c}: {n}" for c, n in sorted(counts.items()))),
        "signals.late": at_most(sum(row["late_s"] > SLOWEST for row in rows), 0, "moments"),
        "signals.wrong": at_most(sum(bool(row["wrong"]) for row in rows), 0, "moments"),
        "signals.resumed": at_least(sum(resumed), RESUMED, f"of {len(resumed)} resumed to the same bytes"),
        "signals.load": figure(round(statistics.fmean(row["load"] for row in rows), 2), "load average of the machine"),
    }
