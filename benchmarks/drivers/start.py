"""Starts of a scene with one mesh of fifty million triangles that all differ (PLY): the first, which reads it and writes the
scene cache, and the second, until a small image of a part of it is there; a large image of all of it; and what chunks
cost rays. Takes about 9 GiB of memory and 3 of disk."""

import os
import shutil
import subprocess
import time

from drivers.ends import DONE
from drivers.figures import at_least, at_most, figure, not_measured, run_json

CELLS = 5000
NEEDED_GIB = 12


def started(program, document, folder, *more):
    """(elapsed s, processor s, most memory in GiB)"""
    command = [program, "render", document, "--output", folder, "--quiet", "--no-state", *more]
    begin = time.monotonic()
    process = subprocess.Popen(list(map(str, command)))
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in DONE:
        raise subprocess.CalledProcessError(process.returncode, command)
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 2**20


def leave_memory(file):
    """The system forgets what it has of a file in memory."""
    with open(file, "rb") as opened:
        os.posix_fadvise(opened.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def run(context):
    program, maker = context.program("ifov"), context.program("bench_start")
    if not maker.exists():
        return {}
    if os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") < NEEDED_GIB * 2**30:
        return {"start.second_s": not_measured(f"less than {NEEDED_GIB} GiB of memory are free")}
    folder = context.folder / "start"
    shutil.rmtree(folder, ignore_errors=True)
    try:
        subprocess.run([maker, "write", folder, str(CELLS)], check=True)
        first = started(program, folder / "part.json", folder / "first")
        again = [started(program, folder / "part.json", folder / "second") for _ in range(5 if context.long else 3)]
        second = min(again)
        os.sync()
        for name in ("part.ifovcache", "mesh.ply"):
            leave_memory(folder / name)
        cold = started(program, folder / "part.json", folder / "cold")
        (folder / "part.ifovcache").rename(folder / "whole.ifovcache")
        whole = started(program, folder / "whole.json", folder / "whole")
        images = [(folder / name / "image_radiance.img").read_bytes() for name in ("first", "second", "cold")]
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    rays = run_json([maker, "trace", 2000])
    return {
        "start.same_bytes": at_least(int(images[0] == images[1] == images[2]), 1, "first, second and cold start"),
        "start.first_s": figure(round(first[0], 1), "s, with reading the PLY"),
        "start.second_s": at_most(second[0], 3.0, "s", 2),
        "start.second_processor_s": figure(round(second[1], 2), "s of all threads"),
        "start.second_peak_gib": figure(round(second[2], 2), "GiB, pages of the cache included"),
        "start.cold_s": figure(round(cold[0], 2), "s, cache and PLY not in memory"),
        "start.whole_image_s": figure(round(whole[0], 1), "s, all trees made"),
        "start.whole_image_processor_s": figure(round(whole[1], 1), "s of all threads"),
        "start.whole_image_peak_gib": figure(round(whole[2], 2), "GiB"),
        "start.rays_that_met": at_least(rays["met"] / rays["rays"], 0.5, "of the rays"),
        "start.hits_unlike_one_tree": at_most(rays["different"], 0, "hits"),
        "start.wrong_hits": at_most(rays["wrong"], 0, "hits"),
        "start.time_of_rays_over_one_tree": at_most(rays["time_over_at_once"], 1.1, "times, half of the rays incoherent"),
    }
