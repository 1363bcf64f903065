"""What keeping finished tiles costs runs of the suburb, measured by turning it off (`--no-state`): by turns with and
without, so that what others do to the machine meets both."""

import json
import os
import re
import statistics
import subprocess
import time

from drivers.ends import DONE
from drivers.figures import at_most, figure

MOST = 2.0  # percent
QUIET = 0.5  # load average before the first run up to which wall time says something
WINDOW = 64  # pixels, out of the middle of the suburb


def window(document, sampling):
    """The same scene, fewer pixels: what tiles cost is by the pixel, and so is what keeping them costs."""
    text = document.read_text()
    text, cameras = re.subn(r'"pixels": \[\d+, \d+\]', f'"pixels": [{WINDOW}, {WINDOW}]', text)
    text, plans = re.subn(r'"sampling": \{.*\}', lambda _: f'"sampling": {json.dumps(sampling)}', text)
    if (cameras, plans) != (1, 1):
        raise RuntimeError(f"{document}: not as the generator wrote it")
    file = document.with_name(f"bookkeeping_{document.name}")
    file.write_text(text)
    return file


def spent(command):
    """(processor time, wall time) in seconds"""
    begin = time.monotonic()
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in DONE:
        raise subprocess.CalledProcessError(process.returncode, command)
    return usage.ru_utime + usage.ru_stime, time.monotonic() - begin


def least(times):
    """The mean of the lowest third, which others have disturbed least."""
    return statistics.fmean(sorted(times)[: max(1, len(times) // 3)])


def measure(context, name, document, folder, is_quiet):
    program = context.program("ifov")
    spent([program, "check", "--quiet", document])  # fills the scene's cache
    loading = [spent([program, "check", document]) for _ in range(4)]
    runs = {"--restart": [], "--no-state": []}
    pairs = 30 if context.long else 9
    for k in range(pairs):
        for kind in sorted(runs, reverse=k % 2 == 1):
            runs[kind].append(spent([program, "render", document, "--quiet", "--threads", 2, kind, "-o", folder]))
    figures = {}
    for place, clock in enumerate(("processor", "wall")):
        kept, plain, load = (least([run[place] for run in times]) for times in (runs["--restart"], runs["--no-state"], loading))
        percent = 100.0 * (kept - plain) / (plain - load)
        differences = [a[place] - b[place] for a, b in zip(runs["--restart"], runs["--no-state"])]
        error = 100.0 * statistics.stdev(differences) / len(differences) ** 0.5 / (plain - load)
        unit = f"% of {clock} time, +- {error:.2g}"
        figures[f"bookkeeping.{name}_{clock}"] = (at_most(percent, MOST, unit) if clock == "processor" or is_quiet
                                                  else figure(round(percent, 3), unit, "not judged: others were at work"))
        figures[f"bookkeeping.{name}_{clock}_run"] = figure(round(plain - load, 2), "s without it and without loading")
    return figures


def run(context):
    is_quiet = os.getloadavg()[0] < QUIET
    program, folder = context.program("ifov"), context.folder / "bookkeeping"
    folder.mkdir(parents=True, exist_ok=True)
    suburb = folder / "suburb"
    if not (suburb / "render_vswir.json").exists():
        subprocess.run([program, "make", "suburb", "--size", "100m", "--seed", "7", "--quiet", "--force", suburb], check=True)
    figures = {}
    for name, document, sampling in (("thermal", "render_thermal.json", {"accuracy": {"error": "0.5 K"}}),
                                     ("210_channels", "render_vswir.json", {"grid": {"elements": [12, 12]}})):
        figures |= measure(context, name, window(suburb / document, sampling), folder / "out", is_quiet)
    return figures
