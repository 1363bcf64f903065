"""What every benchmark hands back: figures by name, each {"value", "unit", "must", "ok"}."""

import dataclasses
import json
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass
class Context:
    build: pathlib.Path  # programs are here
    folder: pathlib.Path  # and what the benchmarks write goes here
    long: bool

    def program(self, name):
        file = self.build / name
        if not file.exists():
            raise FileNotFoundError(f"{file} is not built: cmake --build {self.build} --target ifov benchmarks")
        return file


def figure(value, unit, must="", ok=None):
    """`ok` None: a figure that is reported but that nothing is asked of."""
    return {"value": value, "unit": unit, "must": must, "ok": ok}


def at_least(value, limit, unit, digits=3):
    return figure(round(value, digits), unit, f">= {limit}", value >= limit)


def at_most(value, limit, unit, digits=3):
    return figure(round(value, digits), unit, f"<= {limit}", value <= limit)


def not_measured(reason):
    return figure(None, "", f"not measured: {reason}")


def show(name, row):
    value = "-" if row["value"] is None else f"{row['value']:.6g}" if isinstance(row["value"], float) else row["value"]
    mark = {True: "ok", False: "NO", None: ""}[row["ok"]]
    print(f"  {name:<58} {value!s:>12} {row['unit']:<22} {row['must']:<24} {mark}".rstrip(), flush=True)


def run_json(command, **options):
    """Runs a program that prints one JSON object as its last line; what it says meanwhile goes to the terminal."""
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, check=True, **options)
    return json.loads(result.stdout.strip().splitlines()[-1])


def median(values):
    ordered = sorted(values)
    middle = len(ordered) // 2
    return ordered[middle] if len(ordered) % 2 else 0.5 * (ordered[middle - 1] + ordered[middle])
