"""Intervals against closed forms and plain path tracers, scene by scene (benchmarks/honesty)."""

import json
import subprocess

from drivers.figures import figure


def run(context):
    # The judge first, then what it judges.
    parts = {
        "reference": ["--check-reference"],
        "scenes": ["--seeds", "200"] if context.long else [],
        "rows": ["--rows-study", "400"],
        "named": ["--named"] + ([] if context.long else ["--seeds", "5", "--effort", "0.3"]),
        "images": ["--images", "--seeds", "200" if context.long else "4"],
        "wild": ["--wild", "2000" if context.long else "57", "--first-seed", "100000"]
                + ([] if context.long else ["--effort", "0.1"]),
    }
    figures = {}
    for part, arguments in parts.items():
        file = context.folder / f"honesty_{part}.json"
        subprocess.run(
            [context.program("bench_honesty"), "--output", file, "--work", context.folder / "honesty"] + arguments,
            check=True,
        )
        for name, row in json.loads(file.read_text()).items():
            figures[f"honesty.{name}"] = figure(row["value"], row["unit"], row["must"], row["ok"])
    return figures
