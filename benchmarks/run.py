#!/usr/bin/env python3
"""Runs the benchmarks of a build: one line per figure, and <build>/benchmarks/figures.json.

Each figure has a value, a unit, what it must be, and whether it is; each benchmark verifies its own answer.
See docs/developer/benchmarks.md."""

import argparse
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from drivers import (  # noqa: E402
    atmosphere, bookkeeping, channels, cluster, documents, hands, honesty, instances, micro, mitsuba, rami, refine, runs,
    signals, speed, start, stream, studies, temperatures,
)
from drivers.figures import Context, show  # noqa: E402

GROUPS = {
    "micro": micro.run,
    "instances": instances.run,
    "start": start.run,
    "speed": speed.run,
    "stream": stream.run,
    "studies": studies.run,
    "atmosphere": atmosphere.run,
    "channels": channels.run,
    "refine": refine.run,
    "runs": runs.run,
    "signals": signals.run,
    "bookkeeping": bookkeeping.run,
    "rami": rami.run,
    "honesty": honesty.run,
    "documents": documents.run,
    "cluster": cluster.run,
    "mitsuba": mitsuba.run,
    "hands": hands.run,
    "temperatures": temperatures.run,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="the build folder")
    parser.add_argument("groups", nargs="*", metavar="group", help="of " + ", ".join(GROUPS) + "; all by default")
    parser.add_argument("--long", action="store_true", help="more seeds and repetitions, as for a release")
    arguments = parser.parse_args()
    unknown = [group for group in arguments.groups if group not in GROUPS]
    if unknown:
        parser.error(f"unknown group {unknown[0]}: choose from {', '.join(GROUPS)}")

    context = Context(arguments.build.resolve(), arguments.build.resolve() / "benchmarks", arguments.long)
    context.folder.mkdir(parents=True, exist_ok=True)
    file = context.folder / "figures.json"
    figures = json.loads(file.read_text()) if arguments.groups and file.exists() else {}
    failed = []
    for name in arguments.groups or GROUPS:
        print(f"\n{name}", flush=True)
        try:
            found = GROUPS[name](context)
        except subprocess.CalledProcessError as error:
            failed.append(f"{name}: {error}\n{(error.stderr or '')[-2000:]}")
            continue
        except (RuntimeError, OSError, LookupError, ArithmeticError) as error:  # the other groups go on
            failed.append(f"{name}: {type(error).__name__}: {error}")
            continue
        for figure, row in found.items():
            show(figure, row)
            figures[figure] = row
            if row["ok"] is False:
                failed.append(figure)
        file.write_text(json.dumps(figures, indent=1) + "\n")

    print(f"\nfigures: {file}")
    if failed:
        print("short of what they must be:\n  " + "\n  ".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
