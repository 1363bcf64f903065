"""The modelled atmosphere: time and memory that its tables take on two threads, and what it adds to a path, in the
forest, against the same under a uniform sky."""

from drivers.figures import at_least, at_most, figure, run_json


def run(context):
    program = context.program("bench_atmosphere")
    if not program.exists():
        return {}
    found = run_json([program, context.folder / "atmosphere"])
    return {
        "atmosphere.tables_210_channels_s": at_most(found["vswir_s"], 60.0, "s", 2),
        "atmosphere.tables_10_thermal_s": at_most(found["thermal_s"], 20.0, "s", 2),
        "atmosphere.tables_multispectral_s": at_most(found["multispectral_s"], 2.0, "s", 2),
        "atmosphere.tables_right": at_least(int(found["right"]), 1, ""),
        "atmosphere.peak_gib": at_most(found["peak_gib"], 1.0, "GiB"),
        "atmosphere.path_over_uniform_sky": at_most(found["path_over_sky"], 1.15, "times the time"),
        "atmosphere.path_over_uniform_sky_10_channels": at_most(found["path_over_sky_10"], 1.15, "times the time"),
        "atmosphere.path_us": figure(round(found["path_us"], 2), "us of two threads"),
        "atmosphere.columns": figure(found["columns_air"], f"columns, {found['columns_sky']} under a sky"),
    }
