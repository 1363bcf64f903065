"""Small parts, by Google Benchmark. A benchmark states what it must keep as counters `at_most` or `at_least`, about its
time per item (or per iteration, where it counts no items) in nanoseconds or about the counter `figure`."""

import json
import subprocess

from drivers.figures import at_least, at_most, figure


def run(context):
    program = context.program("bench_micro")
    if not program.exists():
        return {}
    repetitions = "5" if context.long else "1"
    result = subprocess.run(
        [program, "--benchmark_format=json", "--benchmark_min_time=0.2", f"--benchmark_repetitions={repetitions}",
         "--benchmark_report_aggregates_only=" + ("true" if context.long else "false")],
        stdout=subprocess.PIPE, text=True, check=True,
    )
    figures = {}
    for row in json.loads(result.stdout)["benchmarks"]:
        if row.get("aggregate_name", "median") != "median":
            continue
        if row.get("error_occurred"):
            figures["micro." + row["run_name"]] = figure(None, "", row["error_message"], False)
            continue
        if "figure" in row:
            value, unit = row["figure"], row.get("label", "")
        elif "items_per_second" in row:
            value, unit = 1e9 / row["items_per_second"], "ns per item"
        else:
            value, unit = row["cpu_time"], row["time_unit"]
        judge = (
            at_most(value, row["at_most"], unit) if "at_most" in row
            else at_least(value, row["at_least"], unit) if "at_least" in row
            else figure(round(value, 3), unit)
        )
        figures["micro." + row["run_name"]] = judge
    return figures
