"""What `--dry-run` foretells against what runs take. Times are processor time of the programs, so that others who use the
machine do not count."""

import json
import os
import re
import subprocess

from drivers.ends import DONE, TOO_SMALL
from drivers.figures import ROOT, at_most, figure

WITHIN = 1.5  # times, either way
PREFIXES = {"": 1.0, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}


def measured(command):
    """(processor time in s, most memory in bytes, what it printed)"""
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (*DONE, TOO_SMALL):
        raise subprocess.CalledProcessError(process.returncode, command)
    return usage.ru_utime + usage.ru_stime, 1024.0 * usage.ru_maxrss, text


def number(pattern, text):
    """A number with a prefix, "1.31 G", or a time, "12:40" or "8.20 s"."""
    found = re.search(pattern, text, re.MULTILINE)[1].strip()
    if ":" in found:
        seconds = 0.0
        for part in found.split(":"):
            seconds = 60.0 * seconds + float(part)
        return seconds
    value, prefix = re.fullmatch(r"([\d.]+) ?([kMGT]?)(?:B| s)?", found).groups()
    return float(value) * PREFIXES[prefix]


def apart(foretold, found):
    """How many times they differ, whichever is more."""
    return max(foretold / found, found / foretold)


def forecast(context, name, document, folder):
    program = context.program("ifov")
    measured([program, "check", document])  # fills the scene's cache
    loading = min(measured([program, "check", document])[0] for _ in range(3))
    _, _, said = measured([program, "render", document, "--dry-run", "--threads", 2])
    processor, memory, _ = measured([program, "render", document, "--restart", "--quiet", "--threads", 2, "-o", folder])
    rays = json.loads((folder / "image_run.json").read_text())["cost"]["rays"]["total"]
    foretold = number(r"; (.*) of processor time$", said)
    figures = {
        f"runs.forecast_{name}_rays": at_most(apart(number(r"^rays +(.*)$", said), rays), WITHIN, "times, either way"),
        f"runs.forecast_{name}_time": at_most(apart(foretold + loading, processor), WITHIN, "times, either way"),
        f"runs.forecast_{name}_memory": at_most(apart(number(r"^memory +(.*)$", said), memory), WITHIN, "times, either way"),
        f"runs.{name}_processor": figure(round(processor, 2), "s, of it loading " + f"{loading:.2f}"),
    }
    cubes = sum(file.stat().st_size for file in folder.glob("*.img")) + sum(file.stat().st_size for file in folder.glob("*.tif"))
    if cubes > 1e6:  # else the picture and the report are most of it
        figures[f"runs.forecast_{name}_disk"] = at_most(apart(number(r"works, (.*) of products$", said), cubes), WITHIN,
                                                        "times, either way")
    return figures


def run(context):
    program, folder = context.program("ifov"), context.folder / "runs"
    folder.mkdir(parents=True, exist_ok=True)
    for study in ("aliasing", "thermal"):
        subprocess.run([program, "study", study, "--quiet", "--trials", "10", "--output", folder / study], check=False)
    subprocess.run([program, "make", "suburb", "--size", "100m", "--seed", "7", "--quiet", "--force", folder / "suburb"], check=True)
    documents = {
        "demo": ROOT / "examples" / "demo.json",
        "aliasing": folder / "aliasing" / "chart.json",
        "thermal": folder / "thermal" / "dome.json",
        "thermal_textured": folder / "thermal" / "textured_dome.json",
        "suburb_colour": folder / "suburb" / "quicklook.json",
        "suburb_thermal": folder / "suburb" / "render_thermal.json",
    }
    if context.long:
        documents["suburb_spectrometer"] = folder / "suburb" / "render_vswir.json"
    figures = {}
    for name, document in documents.items():
        figures |= forecast(context, name, document, folder / "out" / name)
    return figures
