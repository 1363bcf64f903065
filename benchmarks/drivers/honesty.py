"""Intervals against a plain path tracer, scene by scene (benchmarks/honesty)."""

import json
import subprocess

from drivers.figures import figure


def run(context):
    file = context.folder / "honesty.json"
    subprocess.run(
        [context.program("bench_honesty"), "--output", file, "--work", context.folder / "honesty"]
        + (["--seeds", "200"] if context.long else []),
        check=True,
    )
    figures = {}
    for name, row in json.loads(file.read_text()).items():
        figures[f"honesty.{name}"] = figure(row["value"], row["unit"], row["must"], row["ok"])
    return figures
