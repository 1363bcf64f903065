"""Single-ray rendering of the forest (51 million instanced triangles) against a floor: a bare program that traces a ray
and a shadow ray and shades 210 bands, with no framework. Floor and product run alternately; ratios are medians."""

import os
import pathlib
import re
import subprocess

from drivers.figures import ROOT, at_least, at_most, figure, median, not_measured, run_json

FLOOR_SOURCE = pathlib.Path(os.environ.get("IFOV_LIMITS", ROOT / "../shared/limits")) / "one_bounce.cpp"


def build_floor(context):
    """The floor program, built beside the benchmarks; None where its source is absent."""
    if not FLOOR_SOURCE.exists():
        return None
    program = context.folder / "one_bounce"
    if not program.exists() or program.stat().st_mtime < FLOOR_SOURCE.stat().st_mtime:
        subprocess.run(
            ["g++", "-std=c++17", "-O3", "-march=native", "-o", program, FLOOR_SOURCE, "-lembree3", "-lpthread"],
            check=True,
        )
    return program


def floor_samples_per_s(program):
    """The floor's best: single rays or packets of 8, one sample a pixel, two threads."""
    output = subprocess.run(
        [program, "--bands", "210", "--n", "1024", "--spp", "1", "--reps", "3", "--threads", "2", "--mode", "shade",
         "--out", "line", "--only", "I1,I8"],
        stdout=subprocess.PIPE, text=True, check=True,
    ).stdout
    return 1e6 * max(float(rate) for rate in re.findall(r"wall\s+([\d.]+)", output))


def run(context):
    program = context.program("bench_scene")
    forest = context.folder / "forest"
    subprocess.run([program, "prepare", forest], check=True)
    floor = build_floor(context)

    ratios, bands, threads, rates, answers = [], [], [], [], []
    for _ in range(5 if context.long else 3):
        floor_rate = floor_samples_per_s(floor) if floor else None
        times = run_json([program, "single", forest])
        rates.append(times["pixels"] / times["bands_210_threads_2_s"])
        if floor_rate:
            ratios.append(rates[-1] / floor_rate)
        bands.append(times["bands_210_threads_2_s"] / times["bands_1_threads_2_s"])
        threads.append(times["bands_210_threads_1_s"] / times["bands_210_threads_2_s"])
        answers.append(times["largest_relative_error"])

    return {
        "speed.single_ray_over_floor": at_least(median(ratios), 0.65, "of the floor's rate") if ratios
        else not_measured(f"no floor program at {FLOOR_SOURCE.name}"),
        "speed.single_ray_rate": figure(round(median(rates) / 1e6, 3), "million samples/s"),
        "speed.bands_210_over_1": at_most(median(bands), 1.3, "times the time"),
        "speed.threads_2_over_1": at_least(median(threads), 1.85, "times the speed"),
        "speed.answer": at_most(max(answers), 1e-4, "largest relative error", 8),
    }
