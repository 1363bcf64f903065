"""The figures of the studies (`ifov study`)."""

import json
import subprocess

STUDIES = {"aliasing": [], "thermal": [], "surfaces": ["--trials", "16"]}  # what they are given unless the long way is asked for
A_FIGURE_MISSED = 4  # the study ran, and some figure is not what it must be; the rows say which


def run(context):
    figures = {}
    for study, short in STUDIES.items():
        folder = context.folder / study
        done = subprocess.run(
            [context.program("ifov"), "study", study, "--output", folder] + ([] if context.long else short), stdout=subprocess.DEVNULL,
        )
        if done.returncode not in (0, A_FIGURE_MISSED):
            raise RuntimeError(f"ifov study {study} ended with exit code {done.returncode}")
        for name, row in json.loads((folder / "figures.json").read_text()).items():
            figures[f"{study}.{name}"] = row
    return figures
