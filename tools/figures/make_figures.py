#!/usr/bin/python3
"""Draws all figures that scripts of this folder make, or those of the scripts named. Needs Debian's python3-matplotlib, and
figure_data of the build (cmake --build build --target figure_data); see docs/developer/building.md."""

import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
OTHERS = {"style", "data", "make_figures"}


def main():
    for name in sys.argv[1:] or sorted(path.stem for path in HERE.glob("*.py") if path.stem not in OTHERS):
        subprocess.run(["/usr/bin/python3", str(HERE / f"{name.removesuffix('.py')}.py")], check=True)


if __name__ == "__main__":
    main()
