"""A cube larger than memory: 4096 x 4096 pixels of 210 channels by single rays, its rate against that of plain writes to
the same disk (`cube_io`), run alternately."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import time

from drivers import runs as foretelling
from drivers.ends import DONE
from drivers.figures import ROOT, at_least, at_most, figure, median, not_measured

RAW_SOURCE = pathlib.Path(os.environ.get("IFOV_LIMITS", ROOT / "../shared/limits")) / "cube_io.cpp"
SIDE, CHANNELS = 4096, 210
PRODUCTS = 4 * SIDE * SIDE * (CHANNELS + 3 + 4 + 2 * 2) + 3 * SIDE * SIDE  # values, samples, quality, two materials' fractions; reasons

DOCUMENT = {
    "ifov": 1,
    "seed": 5,
    "scene": {
        "materials": {"ground": {"reflectance": 0.3}, "ball": {"reflectance": 0.6}},
        "objects": [
            {"plane": {}, "material": "ground"},
            {"sphere": {"center": ["-3 m", "2 m", "1 m"], "radius": "2.3 m"}, "material": "ball"},
            {"sphere": {"center": ["4 m", "-3 m", "1 m"], "radius": "1.7 m"}, "material": "ball"},
        ],
    },
    "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}},
    "sensor": {
        "camera": {"orthographic": {"gsd": "0.25 m", "pixels": [SIDE, SIDE]}},
        "channels": [{"name": "S", "series": {"gaussian": {"from": "400 nm", "to": "2500 nm", "count": CHANNELS,
                                                           "fwhm": "10 nm"}}}],
    },
    "sampling": {"single": {}},
    "output": {"formats": ["envi"]},
}


def build_raw(context):
    """The bare program, built beside the benchmarks; None where its source is absent."""
    if not RAW_SOURCE.exists():
        return None
    program = context.folder / "cube_io"
    if not program.exists() or program.stat().st_mtime < RAW_SOURCE.stat().st_mtime:
        flags = subprocess.run(["gdal-config", "--cflags"], stdout=subprocess.PIPE, text=True, check=True).stdout
        subprocess.run(["g++", "-std=c++17", "-O3", "-march=native", "-o", program, RAW_SOURCE, *flags.split(), "-lgdal", "-lpthread"],
                       check=True)
    return program


def raw_rates(program, folder):
    """MB/s to disk by each of the plain ways to write."""
    output = subprocess.run([program, "--dir", folder, "--lines", "1024", "--reps", "1", "--only",
                             "fwrite,fwrite-unbuffered,direct,pwrite-2threads,pwrite-1-reserved"],
                            stdout=subprocess.PIPE, text=True, check=True).stdout
    return {name: float(rate) for name, rate in re.findall(r"^(\S+).*?to disk\s+(\d+)", output, re.MULTILINE)}


def spent(command):
    """(seconds, bytes that went to the disk, largest memory in bytes)"""
    begin = time.monotonic()
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in DONE:
        raise subprocess.CalledProcessError(process.returncode, command)
    return time.monotonic() - begin, 512 * usage.ru_oublock, 1024 * usage.ru_maxrss


def digest(file):
    with file.open("rb", buffering=0) as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def run(context):
    folder, out = context.folder / "stream", context.folder / "stream/out"
    folder.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(out, ignore_errors=True)
    needed = 2.2 * PRODUCTS
    if shutil.disk_usage(folder).free < needed:
        return {"stream": not_measured(f"{needed / 1e9:.0f} GB of disk are needed")}
    document = folder / "cube.json"
    document.write_text(json.dumps(DOCUMENT, indent=1))
    raw = build_raw(context)
    command = [context.program("ifov"), "render", document, "--quiet", "--restart", "--threads", 2, "-o", out]
    plain = [word if word != "--restart" else "--no-state" for word in command]
    rates, runs, sums = [], {"kept": [], "plain": []}, set()
    for _ in range(3):
        if raw:
            rates.append(raw_rates(raw, folder))
        for kind, words in (("kept", command), ("plain", plain)):
            runs[kind].append(spent(words))
            record = json.loads((out / "image_run.json").read_text())
            told = next(f for f in record["files"] if f["name"] == "image_radiance.img")["sha256"]
            sums |= {told} if kind == "plain" or sums else {told, digest(out / "image_radiance.img")}
            shutil.rmtree(out)
    figures = {"stream.memory": at_most(max(memory for r in runs.values() for _, _, memory in r) / 2**30, 2.0, "GiB"),
               "stream.answer": at_most(len(sums), 1, "checksums, told and of the bytes")}
    best = max(rates[0], key=lambda way: median([r[way] for r in rates])) if rates else None
    if best:
        figures["stream.raw"] = figure(round(median([r[best] for r in rates])), f"MB/s to disk ({best})")
    for kind, what in (("kept", "finished tiles kept"), ("plain", "without")):
        seconds = median([s for s, _, _ in runs[kind]])
        to_disk = [1e-6 * b / s for s, b, _ in runs[kind]]
        figures[f"stream.{kind}_time"] = figure(round(seconds, 1), f"s, {what}")
        figures[f"stream.{kind}_products"] = figure(round(1e-6 * PRODUCTS / seconds), "MB/s of products")
        figures[f"stream.{kind}_to_disk"] = figure(round(median(to_disk)), "MB/s to disk")
        if not best:
            figures[f"stream.{kind}_over_raw"] = not_measured(f"no bare program at {RAW_SOURCE.name}")
            continue
        share = median([d / r[best] for d, r in zip(to_disk, rates)])
        # Without kept tiles the processor is the limit and not the disk.
        figures[f"stream.{kind}_over_raw"] = (at_least(share, 0.5, "of the raw rate") if kind == "kept"
                                              else figure(round(share, 3), "of the raw rate"))
    figures |= foretelling.forecast(context, "stream", document, out)
    shutil.rmtree(out)
    return figures
