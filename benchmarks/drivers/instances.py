"""Ten million instances of a tree of 5,000 triangles, from a binary list on disk to the first rays: time, memory, and
whether every hit lies on the triangle that it names, within 0.04 mm. Takes about 3 GiB."""

import os

from drivers.figures import at_least, at_most, figure, not_measured, run_json

COUNT = 10_000_000
NEEDED_GIB = 6


def available_gib():
    return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30


def run(context):
    program = context.program("bench_instances")
    if not program.exists():
        return {}
    if available_gib() < NEEDED_GIB:
        return {"instances.load_s": not_measured(f"less than {NEEDED_GIB} GiB of memory are free")}
    many = run_json([program, context.folder / "instances", COUNT])
    nodes, table = (run_json([program, context.folder / "instances", 10000, how]) for how in ("nodes", "table"))
    wrong = many["wrong"] + nodes["wrong"] + table["wrong"]
    return {
        "instances.placed": at_least(many["instances"], COUNT, "instances"),
        "instances.triangles": at_least(many["triangles"], 5000 * COUNT, "triangles"),
        "instances.load_s": at_most(many["load_s"], 60.0, "s", 1),
        "instances.load_cpu_s": figure(many["load_cpu_s"], "s of all threads"),
        "instances.peak_gib": at_most(many["peak_gib"], 6.0, "GiB"),
        "instances.bytes_per_instance": figure(many["bytes_per_instance"], "bytes in a table"),
        "instances.bytes_per_node": figure(nodes["bytes_per_instance"], "bytes as nodes"),
        "instances.rays_that_met": at_least(many["met"] / many["rays"], 0.5, "of the rays"),
        "instances.wrong_hits": at_most(wrong, 0, "hits"),
        "instances.table_over_nodes": figure(round(table["mrays_per_s"] / nodes["mrays_per_s"], 2), "times the rays/s"),
    }
