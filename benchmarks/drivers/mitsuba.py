"""The forest from above, Sun, sky and all scattering, against Mitsuba 3: our time over theirs to the same RMS error in
every band. Theirs is read off between two runs of few and many samples, on logarithmic scales."""

import glob
import json
import math
import os
import pathlib
import re
import subprocess
import sys

from drivers.figures import ROOT, at_most, figure, not_measured, run_json

PIXELS, SIDE_M = 64, 64
NAMES = ("mitsuba.time_ratio_3_bands", "mitsuba.time_ratio_210_bands")


def llvm_library():
    """An LLVM that Mitsuba's vectorised variants can use: older ones than 17 lack instructions that it asks for."""
    if "DRJIT_LIBLLVM_PATH" in os.environ:
        return os.environ["DRJIT_LIBLLVM_PATH"]
    found = {}
    for path in glob.glob("/usr/lib/*/libLLVM*.so*") + glob.glob("/usr/lib/llvm-*/lib/libLLVM*.so*"):
        version = re.search(r"libLLVM(?:-|\.so\.)(\d+)", path)
        if version and int(version.group(1)) >= 17:
            found[int(version.group(1))] = path
    return found[max(found)] if found else None


def python_with_mitsuba(context):
    """The Python of a virtual environment that has Mitsuba, made where it is not there; None where that fails."""
    folder = pathlib.Path(os.environ.get("IFOV_MITSUBA", context.folder / "mitsuba"))
    python = folder / "bin/python"
    if subprocess.run([python, "-c", "import mitsuba"], capture_output=True, check=False).returncode == 0 if python.exists() else False:
        return python
    made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, check=False)
    if made.returncode != 0:
        return None
    installed = subprocess.run([python, "-m", "pip", "-q", "install", "mitsuba", "numpy"], capture_output=True, check=False)
    return python if installed.returncode == 0 else None


def theirs(python, llvm, forest, bands, variant, samples, reference):
    """What forest_mitsuba.py prints: time and RMS error by band for each number of samples."""
    description = forest / f"view_{bands}.json"
    return run_json(
        [python, ROOT / "benchmarks/mitsuba/forest_mitsuba.py", forest, "--scene", description, "--variant", variant,
         "--samples", *samples, "--reference", reference],
        env={**os.environ, "DRJIT_LIBLLVM_PATH": llvm}, stderr=subprocess.DEVNULL,
    )


def seconds_to(result, rms):
    """Time to come to these errors in every band."""
    few, many = result["runs"]
    slowest = 0.0
    for own_few, own_many, wanted in zip(few["rms"], many["rms"], rms):
        share = math.log(own_few / wanted) / math.log(own_few / own_many)
        slowest = max(slowest, few["seconds"] * (many["seconds"] / few["seconds"]) ** share)
    return slowest


def run(context):
    llvm = llvm_library()
    if llvm is None:
        return {name: not_measured("no LLVM of 17 or newer (package libllvm19)") for name in NAMES}
    python = python_with_mitsuba(context)
    if python is None:
        return {name: not_measured("Mitsuba 3 cannot be installed") for name in NAMES}

    scene = context.program("bench_scene")
    forest = context.folder / "forest"
    subprocess.run([scene, "prepare", forest], check=True)
    results, reference = {}, 1024 if context.long else 400
    for bands in (3, 210):
        (forest / f"view_{bands}.json").write_text(json.dumps(run_json([scene, "description", forest, bands, PIXELS, SIDE_M])))
        results[bands] = run_json([scene, "converge", forest, bands, PIXELS, SIDE_M, "30 %", reference])

    figures = {}
    rgb = theirs(python, llvm, forest, 3, "llvm_ad_rgb", (64, 256), 4096)
    difference = max(abs(ours / other - 1.0) for ours, other in zip(results[3]["mean"], rgb["mean"]))
    figures["mitsuba.means_agree"] = at_most(difference, 0.01, "largest relative difference", 4)

    # 210 bands in Mitsuba: its spectral variant, or its three-band variant seventy times; the faster counts.
    spectral = theirs(python, llvm, forest, 210, "llvm_ad_spectral", (64, 256), 4096 if context.long else 1024)
    for bands, name in zip((3, 210), NAMES):
        for method in ("accuracy", "grid"):
            ours = results[bands][method]
            other = seconds_to(rgb, ours["rms"][:3])  # the three bands are the first of the 210
            if bands == 210:
                other = min(seconds_to(spectral, ours["rms"]), 70 * other)
            figures[f"{name}.{method}"] = figure(round(ours["seconds"] / other, 4), "our time over theirs")
    return figures
