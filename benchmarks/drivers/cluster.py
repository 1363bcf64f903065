"""A run of several ranks (MPI): efficiency of two on one machine, and of up to a thousand by simulation, fed with what
tiles and messages take here and now. The scene's cost is very uneven: a thicket of spheres in one corner of a plain. Two
ranks are timed on a run of forty seconds, because MPI takes 0.4 s to start and to end."""

import json
import os
import random
import resource
import shutil
import subprocess
import time

from drivers.figures import at_least, at_most, figure, median, not_measured, run_json

RANKS = [1, 2, 8, 32, 128, 512, 1000]
TILES = [8, 16, 32, 64]
COPIES = 16  # the scene is this many times beside and above itself in the simulation: 4096 x 4096 pixels
LEAST_2, LEAST_1000 = 0.95, 0.9
ERROR_PERCENT, ERROR_PERCENT_2 = 2, 1.33  # of the scene that is simulated, and of the run of two ranks
BOTH_CORES = 0.98  # two runs that share nothing keep this much of their speed where both cores are ours


def write_scene(file, error_percent):
    """The thicket takes a sixteenth of the image."""
    places = random.Random(3)
    spheres = [
        {"sphere": {"center": [f"{places.uniform(16, 31):.3f} m", f"{places.uniform(-31, -16):.3f} m", f"{places.uniform(0, 2):.3f} m"],
                    "radius": f"{places.uniform(0.15, 0.5):.3f} m"}, "material": "leaf"} for _ in range(900)
    ]
    document = {
        "ifov": 1,
        "scene": {
            "materials": {"ground": {"reflectance": 0.25}, "leaf": {"reflectance": 0.5}},
            "objects": [{"plane": {}, "material": "ground"}, *spheres],
        },
        "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"radiance": "40 W m-2 sr-1 um-1"}},
        "sensor": {
            "camera": {"orthographic": {"gsd": "0.25 m", "pixels": [256, 256]}},
            "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}],
        },
        "sampling": {"accuracy": {"error": f"{error_percent} %"}, "tile": 16},
        "output": {"formats": ["envi"]},
    }
    file.write_text(json.dumps(document, indent=1))


def mpirun(*words):
    return [shutil.which("mpirun"), "--allow-run-as-root", "--oversubscribe", *map(str, words)]


def processor_s():
    """Of all programs that have ended, and of those that they started."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def seconds(command, folder):
    """(wall time, processor time)"""
    begin, processor = time.monotonic(), processor_s()
    subprocess.run(list(map(str, command)), cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - begin, processor_s() - processor


def two_ranks(context, folder):
    """One rank, two ranks, and two runs side by side, which share nothing but the machine; in turn."""
    program = context.program("ifov")
    one, two, beside, processor = [], [], [], []
    write_scene(folder / "longer.json", ERROR_PERCENT_2)
    render = [program, "render", "longer.json", "--restart", "--threads", 1]
    for _ in range(5 if context.long else 3):
        wall, of_one = seconds([*render, "-o", "one"], folder)
        one.append(wall)
        wall, of_two = seconds(mpirun("-n", 2, *render, "-o", "two"), folder)
        two.append(wall)
        processor.append(of_one / of_two)
        begin = time.monotonic()
        pair = [subprocess.Popen(list(map(str, [*render, "-o", name])), cwd=folder, stdout=subprocess.DEVNULL)
                for name in ("left", "right")]
        if any(process.wait() for process in pair):
            raise RuntimeError("a run beside another one failed")
        beside.append(time.monotonic() - begin)
    efficiency = median([a / (2 * b) for a, b in zip(one, two)])
    machine = median([a / b for a, b in zip(one, beside)])
    alone = (at_least(efficiency, LEAST_2, "of one rank, start to products") if machine >= BOTH_CORES
             else figure(round(efficiency, 3), "of one rank, start to products", f"not judged: the machine gives {machine:.2f}"))
    same = all((folder / "one" / f"image_{name}.img").read_bytes() == (folder / "two" / f"image_{name}.img").read_bytes()
               for name in ("radiance", "half_width", "samples"))
    return {
        "cluster.efficiency_2_ranks": alone,
        "cluster.efficiency_2_ranks_over_machine": at_least(
            median([a / (2 * b) for a, b in zip(beside, two)]), LEAST_2, "of two runs side by side"),
        "cluster.processor_time_2_ranks": at_least(median(processor), LEAST_2, "of it one rank takes"),
        "cluster.same_bytes": at_least(int(same), 1, "1: as of one rank"),
        "cluster.one_rank": figure(round(median(one), 1), "s"),
        "cluster.two_ranks": figure(round(median(two), 1), "s"),
        "cluster.two_runs_side_by_side": figure(round(machine, 3), "of their speed alone"),
        "cluster.load": figure(round(os.getloadavg()[1], 1), "load average, 5 min (2: ours alone)"),
    }


def run(context):
    if shutil.which("mpirun") is None:
        return {"cluster.efficiency_2_ranks": not_measured("mpirun is not installed")}
    folder = context.folder / "cluster"
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.json"
    bench = context.program("bench_cluster")
    write_scene(scene, ERROR_PERCENT)
    figures = two_ranks(context, folder)

    images = run_json([bench, "costs", scene, *TILES])
    tcp, shared = (run_json(mpirun(*launch, "-n", 2, bench, "messages"))
                   for launch in (("--mca", "btl", "tcp,self"), ()))
    simulation = {"round_trip_s": tcp["round_trip_s"], "service_s": tcp["service_s"], "copies": COPIES, "ranks": RANKS,
                  "images": images}
    (folder / "simulation.json").write_text(json.dumps(simulation))
    rows = run_json([bench, "simulate", folder / "simulation.json"])
    (folder / "efficiency.json").write_text(json.dumps(rows, indent=1))

    print(f"  {'tiles and scheduling, efficiency with ranks':<44}" + "".join(f"{ranks:>7}" for ranks in RANKS))
    for tile in TILES:
        for kind, words in (("shares", "fixed shares"), ("rows", "counter, row by row"), ("schedule", "counter, dearest first")):
            found = {row["ranks"]: row["efficiency"] for row in rows if (row["tile_px"], row["scheduling"]) == (tile, kind)}
            print(f"  {f'{tile} px, {words}':<44}" + "".join(f"{found[ranks]:7.3f}" for ranks in RANKS))
    many = {row["tile_px"]: row["efficiency"] for row in rows if (row["ranks"], row["scheduling"]) == (RANKS[-1], "schedule")}
    best = max(many, key=many.get)
    by_tile = next(image for image in images if image["tile_px"] == 16)["seconds"]
    ordered = sorted(by_tile)
    return figures | {
        "cluster.dearest_tile": figure(round(ordered[-1] / ordered[len(ordered) // 2], 1), "times the median tile"),
        "cluster.ask_tcp": at_most(1e3 * tcp["round_trip_s"], 2.0, "ms, mean, measured now"),
        "cluster.ask_tcp_99": figure(round(1e3 * tcp["round_trip_99_s"], 3), "ms, 99th percentile, now"),
        "cluster.ask_shared_memory": figure(round(1e3 * shared["round_trip_s"], 3), "ms, mean, measured now"),
        "cluster.service": figure(round(1e6 * tcp["service_s"], 1), "us per ask, now"),
        "cluster.simulated_1000_ranks": at_least(many[best], LEAST_1000, "efficiency"),
        "cluster.simulated_tile": figure(best, "pixels wide"),
    } | {
        f"cluster.simulated_1000_ranks_{tile}_px": figure(round(many[tile], 3), "efficiency") for tile in TILES
    }
