#!/usr/bin/python3
"""Draws all figures that scripts of this folder make, or those of the scripts named. Needs Debian's python3-matplotlib, and
figure_data of the build (cmake --build build --target figure_data); see docs/developer/building.md."""

import multiprocessing
import pathlib
import runpy
import sys

HERE = pathlib.Path(__file__).resolve().parent
OTHERS = {"style", "data", "make_figures"}


def main():
    sys.path.insert(0, str(HERE))
    import style  # noqa: F401  Matplotlib, which takes most scripts longer to import than to draw with
    for name in sys.argv[1:] or sorted(path.stem for path in HERE.glob("*.py") if path.stem not in OTHERS):
        script = multiprocessing.get_context("fork").Process(
            target=runpy.run_path, args=(str(HERE / f"{name.removesuffix('.py')}.py"), None, "__main__"))
        script.start()
        script.join()
        if script.exitcode != 0:
            sys.exit(f"{name} failed")


if __name__ == "__main__":
    main()
