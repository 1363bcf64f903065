"""Numbers that the program computes for figures: `figure_data NAME` of the build (FIGURE_DATA, or build/figure_data)."""

import functools
import os
import subprocess

from style import ROOT


@functools.lru_cache
def lines(name):
    program = os.environ.get("FIGURE_DATA", str(ROOT / "build" / "figure_data"))
    text = subprocess.run([program, name], capture_output=True, text=True, check=True).stdout
    return [line.split() for line in text.splitlines()]


def columns(name, word, *words):
    """Columns of the lines that begin so, as lists of numbers."""
    head = [word, *words]
    rows = [[float(x) for x in line[len(head):]] for line in lines(name) if line[: len(head)] == head]
    return [list(column) for column in zip(*rows)]
