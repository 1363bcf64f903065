"""HET01 of the radiation transfer model intercomparison at every published angle (examples/rami), by way of documents
and `ifov render`, an image for each angle and one run of single views for all, against the published reflectance factors."""

import csv
import json
import math
import os
import pathlib
import struct
import subprocess
import time

from drivers.ends import DONE
from drivers.figures import ROOT, at_most, figure, not_measured

DATA = pathlib.Path(os.environ.get("IFOV_TRUTH", ROOT / "../shared/truth")) / "rami" / "het01"
SUN_ZENITH_RAD = math.radians(20.0)
DEVIATION_PERCENT, STANDARD_ERROR_PERCENT = 1.0, 0.2
ONE_RUN_PERCENT = 0.5  # half-width that the one run is asked for


def values(file):
    """Of a cube of one channel."""
    return [value for (value,) in struct.iter_unpack("<f", file.read_bytes())]


def render(program, document):
    done = subprocess.run([program, "render", document], stdout=subprocess.DEVNULL, check=False)
    if done.returncode not in DONE:
        done.check_returncode()


def reflectance_factor(program, document):
    """And its standard error."""
    products = document.with_suffix(".out")
    render(program, document)
    scale = math.pi / math.cos(SUN_ZENITH_RAD)
    radiance, error = (values(products / f"image_{name}.img") for name in ("radiance", "standard_error"))
    return scale * sum(radiance) / len(radiance), scale * math.hypot(*error) / len(error)


def all_in_one_run(program, folder):
    """Reflectance factor and its half-width by angle, and the time it took."""
    subprocess.run([ROOT / "examples" / "rami" / "make_scene.py", DATA, folder, "--one"], check=True)
    start = time.monotonic()
    render(program, folder / "het01.json")
    elapsed_s = time.monotonic() - start
    with (folder / "het01.out" / "image_views.csv").open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {float(row["view_zenith_deg"]): (float(row["reflectance_factor"]), float(row["reflectance_half_width"])) for row in rows}, elapsed_s


def run(context):
    if not DATA.exists():
        return {"rami.worst_deviation": not_measured(f"no reference data at {DATA}")}
    folder = context.folder / "rami"
    subprocess.run([ROOT / "examples" / "rami" / "make_scene.py", DATA, folder], check=True)
    with (DATA / "expected_brf.csv").open() as file:
        expected = {float(row["view_zenith_deg"]): float(row["brf"]) for row in csv.DictReader(file)}
    start = time.monotonic()
    found = {angle: reflectance_factor(context.program("ifov"), folder / f"het01_{angle:+03.0f}.json")
             for angle in expected}
    elapsed_s = time.monotonic() - start
    one, one_s = all_in_one_run(context.program("ifov"), folder)

    rows = {angle: {"published": expected[angle], "ours": found[angle][0],
                    "deviation_percent": 100 * (found[angle][0] / expected[angle] - 1),
                    "standard_error_percent": 100 * found[angle][1] / found[angle][0]} for angle in expected}
    (folder / "angles.json").write_text(json.dumps(rows, indent=1) + "\n")
    worst = max(rows, key=lambda angle: abs(rows[angle]["deviation_percent"]))
    mean = sum(row["deviation_percent"] for row in rows.values()) / len(rows)
    return {
        "rami.angles": figure(len(rows), "of the principal plane"),
        "rami.worst_deviation": at_most(abs(rows[worst]["deviation_percent"]), DEVIATION_PERCENT, "%"),
        "rami.its_standard_error": at_most(rows[worst]["standard_error_percent"], STANDARD_ERROR_PERCENT, "%"),
        "rami.its_angle": figure(worst, "degrees"),
        "rami.largest_standard_error": at_most(
            max(row["standard_error_percent"] for row in rows.values()), STANDARD_ERROR_PERCENT, "%"),
        "rami.mean_deviation": figure(round(mean, 3), "%"),
        "rami.time": figure(round(elapsed_s, 1), "s"),
        "rami.one_run_worst_deviation": at_most(
            max(abs(100 * (value / expected[angle] - 1)) for angle, (value, _) in one.items()), DEVIATION_PERCENT, "%"),
        "rami.one_run_largest_half_width": at_most(
            max(100 * half_width / value for value, half_width in one.values()), 1.01 * ONE_RUN_PERCENT, "%"),
        "rami.one_run_time": figure(round(one_s, 1), "s"),
        "rami.one_run_share_of_time": figure(round(100 * one_s / elapsed_s, 1), "% of the images' time"),
    }
