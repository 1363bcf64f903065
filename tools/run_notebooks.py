#!/usr/bin/env python3
"""Runs the code of notebooks cell by cell, as Jupyter would, without Jupyter: python3 tools/run_notebooks.py NOTEBOOK...

  --figures FOLDER   save what they draw as NOTEBOOK_CELL.png, to be looked at
  --strip            take out outputs and counts of cells first, as notebooks are stored here
"""

import argparse
import ast
import json
import os
import pathlib
import sys
import time

os.environ.setdefault("MPLBACKEND", "Agg")


def read(file):
    return json.loads(pathlib.Path(file).read_text(encoding="utf-8"))


def code_cells(notebook):
    """(number from 1 among all cells, source) of each."""
    return [
        (number, "".join(cell["source"])) for number, cell in enumerate(notebook["cells"], 1) if cell["cell_type"] == "code"
    ]


def is_stripped(notebook):
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    return all(not cell["outputs"] and cell["execution_count"] is None for cell in code)


def strip(file):
    notebook = read(file)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None
    pathlib.Path(file).write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def run(file, drawn=lambda figure, cell: None):
    """Runs all cells in one namespace, which is returned, in the notebook's folder. drawn: called with each figure and the number of the cell that drew it. What a
    cell throws arrives as the cause of a RuntimeError that shows the cell."""
    import matplotlib.pyplot as plt

    names = {"__name__": "__main__"}
    plt.close("all")
    before, notebook = os.getcwd(), read(file)
    os.chdir(pathlib.Path(file).parent)
    try:
        _run_cells(file, notebook, names, drawn)
    finally:
        os.chdir(before)
    return names


def _run_cells(file, notebook, names, drawn):
    import matplotlib.pyplot as plt

    for number, source in code_cells(notebook):
        try:
            body = ast.parse(source, f"{pathlib.Path(file).name}, cell {number}")
            shown = body.body.pop() if body.body and isinstance(body.body[-1], ast.Expr) else None
            exec(compile(body, f"{file}, cell {number}", "exec"), names)  # noqa: S102
            if shown is not None:  # what a notebook shows below the cell has to have a text
                repr(eval(compile(ast.Expression(shown.value), f"{file}, cell {number}", "eval"), names))  # noqa: S307
            for one in plt.get_fignums():
                drawn(plt.figure(one), number)
                plt.close(one)
        except Exception as error:
            raise RuntimeError(f"{file}, cell {number}:\n{source}\n{type(error).__name__}: {error}") from error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("notebooks", nargs="+", type=pathlib.Path)
    parser.add_argument("--figures", type=lambda folder: pathlib.Path(folder).absolute())
    parser.add_argument("--strip", action="store_true")
    options = parser.parse_args()
    for file in options.notebooks:
        if options.strip:
            strip(file)
        stem = file.stem

        def save(figure, cell, stem=stem):
            if options.figures is not None:
                options.figures.mkdir(parents=True, exist_ok=True)
                figure.savefig(options.figures / f"{stem}_{cell}.png")

        begun = time.monotonic()
        run(file, save)
        print(f"{file}: {time.monotonic() - begun:.1f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
