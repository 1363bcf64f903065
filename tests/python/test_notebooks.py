"""The notebooks of docs/notebooks run as written, offline, and draw what can be read."""

import contextlib
import io
import json
import pathlib
import re
import sys
import unittest
import warnings

import scenes

sys.path.insert(0, str(scenes.ROOT / "tools"))
import run_notebooks

FOLDER = scenes.ROOT / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
GUIDE = (scenes.ROOT / "docs" / "guide" / "notebooks.md").read_text(encoding="utf-8")


def faults_of(figure):
    """What a reader would miss in a figure."""
    found = []
    for axes in figure.axes:
        shared_x = axes.get_subplotspec() is not None and not axes.get_subplotspec().is_last_row() and axes.get_shared_x_axes()
        if not axes.get_xlabel() and not shared_x and axes.get_label() != "<colorbar>":
            found.append("an x axis without a name")
        shared_y = axes.get_subplotspec() is not None and not axes.get_subplotspec().is_first_col()
        if not axes.get_ylabel() and not shared_y and axes.get_label() != "<colorbar>":
            found.append("a y axis without a name")
        if axes.get_label() == "<colorbar>" and not axes.get_xlabel() and not axes.get_ylabel():
            found.append("a bar of colours without a name")
    return found


class Notebooks(unittest.TestCase):
    def test_there_are_those_of_the_guide(self):
        self.assertEqual(sorted(set(re.findall(r"notebooks/(\w+\.ipynb)", GUIDE))), [file.name for file in NOTEBOOKS])

    def test_outputs_are_of_the_readers_own_run(self):
        for file in NOTEBOOKS:
            self.assertTrue(run_notebooks.is_stripped(run_notebooks.read(file)), f"python3 tools/run_notebooks.py --strip {file}")

    def test_studies_are_ten_cells(self):
        for name in ("hot_dome_smaller_than_a_pixel", "what_is_in_the_pixels_of_a_suburb"):
            self.assertLessEqual(len(run_notebooks.read(FOLDER / f"{name}.ipynb")["cells"]), 10)

    def test_mitsuba_is_told_by_version(self):
        stored = json.loads((FOLDER / "beside_mitsuba.json").read_text(encoding="utf-8"))
        self.assertEqual((stored["version"], len(stored["seeds"])), ("3.9.1", 64))


def _test_of(file):
    def test(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not installed")
        drawn = []
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            # Of what is shown nobody is to be warned.
            warnings.simplefilter("error", category=UserWarning)
            run_notebooks.run(file, lambda figure, cell: drawn.append((cell, faults_of(figure))))
        self.assertTrue(drawn)
        self.assertEqual([one for one in drawn if one[1]], [])

    return test


for _file in NOTEBOOKS:
    setattr(Notebooks, f"test_{_file.stem}", _test_of(_file))


class Runner(scenes.InFolder):
    def notebook(self, *sources):
        cells = [{"cell_type": "code", "source": [one], "outputs": [], "execution_count": None} for one in sources]
        file = self.folder / "one.ipynb"
        file.write_text(json.dumps({"cells": cells}), encoding="utf-8")
        return file

    def test_a_cell_that_fails_is_shown(self):
        file = self.notebook("a = 1", "assert a == 2, 'two'")
        with self.assertRaisesRegex(RuntimeError, r"one\.ipynb, cell 2:\nassert a == 2, 'two'\nAssertionError: two"):
            run_notebooks.run(file)
        self.assertEqual(pathlib.Path.cwd(), self.folder)

    def test_figures_without_names_are_noticed(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not installed")
        drawn = []
        file = self.notebook("import matplotlib.pyplot as plt", "plt.plot([1, 2])")
        run_notebooks.run(file, lambda figure, cell: drawn.append((cell, faults_of(figure))))
        self.assertEqual(drawn, [(2, ["an x axis without a name", "a y axis without a name"])])

    def test_outputs_are_stripped(self):
        file = self.notebook("1")
        notebook = run_notebooks.read(file)
        notebook["cells"][0].update(outputs=["1"], execution_count=3)
        file.write_text(json.dumps(notebook), encoding="utf-8")
        self.assertFalse(run_notebooks.is_stripped(notebook))
        run_notebooks.strip(file)
        self.assertTrue(run_notebooks.is_stripped(run_notebooks.read(file)))


if __name__ == "__main__":
    unittest.main()
