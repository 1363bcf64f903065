"""What solved temperatures cost: the forest (51 million instanced triangles) over 48 hours by steps of a quarter of an hour, against the same
image of given temperatures. Both run by turns; ratios are medians. Times are processor time, which others who use the machine do not change much."""

import json
import math
import os
import subprocess
import time

from drivers.ends import DONE
from drivers.figures import at_most, figure, median

GROUND = ["soil, bare", "grass, lawn", "grass, dry"]
SMALL, LARGE = 24, 96  # pixels along a side
SAMPLINGS = {
    "grid": {"grid": {"elements": [8, 8]}},  # the same paths in both
    "accuracy": {"accuracy": {"error": "1 K"}},
}


def write_weather(file):
    """Two clear days of June at 52 N: hour by hour."""
    lines = ["time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction,global_irradiance_w_m2"]
    for hour in range(49):
        turn = 2.0 * math.pi * (hour - 14.7) / 24.0
        sine = 0.2925 + 0.5675 * math.cos(2.0 * math.pi * (hour - 11.7) / 24.0)  # of the Sun's height
        light = 1098.0 * sine * math.exp(-0.057 / sine) if sine > 0.02 else 0.0
        lines.append(
            f"2026-06-{20 + hour // 24}T{hour % 24:02d}:00:00Z,{17.5 + 5.5 * math.cos(turn):.2f},{62 - 20 * math.cos(turn):.0f},"
            f"{2.5 + 0.6 * math.cos(turn):.2f},0.1,{light:.1f}"
        )
    file.write_text("\n".join(lines) + "\n")


def write_document(folder, name, sampling, solved, side):
    """Ground of three kinds in 32 materials, leaves and bark; given temperatures are about as warm as solved ones."""
    def material(library, kelvin):
        return {"reflectance": {"library": library}, "temperature": "solved" if solved else f"{kelvin} K"}

    slots = {f"ground{k}": f"ground{k}" for k in range(32)}
    materials = {slot: material(GROUND[k % 3], 300 + 2 * (k % 3)) for k, slot in enumerate(slots)}
    materials |= {"tree0": material("leaf, aspen", 296), "tree1": material("wood, pine, fresh", 298)}
    document = {
        "ifov": 1,
        "time": "2026-06-21T14:00:00Z",
        "scene": {
            "origin": {"latitude": "52 deg", "longitude": "4.4 deg"},
            "materials": materials,
            "prototypes": {
                "tree": [{"mesh": {"file": "tree.obj"}, "material": {"slots": {"tree0": "tree0", "tree1": "tree1"}}}]
            },
            "objects": [
                {"mesh": {"file": "terrain.obj"}, "material": {"slots": slots}},
                {"instances": {"of": "tree", "csv": "trees.csv"}},
            ],
        },
        "light": {"sky": {"temperature": "255 K"}},
        "sensor": {
            "camera": {"orthographic": {"gsd": "0.5 m", "pixels": [side, side]}},
            "channels": [{"name": "thermal", "top_hat": {"from": "8 um", "to": "12 um"}}],
        },
        "sampling": sampling,
    }
    if solved:
        document["weather"] = {"file": "june.csv"}
        document["temperatures"] = {"spin_up": "2 d", "step": "15 min", "repeat_first_day": True}
    file = folder / f"{name}.json"
    file.write_text(json.dumps(document))
    return file


def spend(program, document):
    """(processor time in s, most memory in bytes, seconds before the first ray)"""
    out = document.with_suffix("")
    start = time.monotonic()
    process = subprocess.Popen(list(map(str, [program, "render", document, "--quiet", "--threads", 2, "--restart", "-o", out])))
    _, status, usage = os.wait4(process.pid, 0)
    elapsed = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in DONE:
        raise subprocess.CalledProcessError(process.returncode, process.args)
    cost = json.loads((out / "image_run.json").read_text())["cost"]
    return usage.ru_utime + usage.ru_stime, 1024.0 * usage.ru_maxrss, elapsed - cost["elapsed_s"]


def run(context):
    program, folder = context.program("ifov"), context.folder / "forest"
    subprocess.run([context.program("bench_scene"), "prepare", folder], check=True)
    write_weather(folder / "june.csv")
    figures = {}
    for name, sampling in SAMPLINGS.items():
        documents = {
            (solved, side): write_document(folder, f"{'solved' if solved else 'given'}_{name}_{side}", sampling, solved, side)
            for solved in (True, False) for side in (SMALL, LARGE)
        }
        ratios, more_bytes, waits = [], [], []
        for _ in range(5 if context.long else 3):
            found = {key: spend(program, document) for key, document in documents.items()}
            image = {solved: found[solved, LARGE][0] - found[solved, SMALL][0] for solved in (True, False)}
            ratios.append(image[True] / image[False])
            more_bytes.append(found[True, LARGE][1] - found[False, LARGE][1])
            waits.append(found[True, LARGE][2])
        figures[f"temperatures.image_over_given_{name}"] = figure(round(median(ratios), 2), "times the processor time", "aim: 3")
        figures[f"temperatures.spread_{name}"] = figure(f"{min(ratios):.2f} to {max(ratios):.2f}", "the same, least and most")
        figures[f"temperatures.first_ray_{name}"] = at_most(median(waits), 20.0, "s before the first ray", 1)
        figures[f"temperatures.more_memory_{name}"] = at_most(median(more_bytes) / 2**30, 1.0, "GiB more", 3)
    return figures
