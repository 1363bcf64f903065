"""The figures of the studies (`ifov study`)."""

import json
import subprocess

STUDIES = ("aliasing", "thermal")


def run(context):
    figures = {}
    for study in STUDIES:
        folder = context.folder / study
        subprocess.run(
            [context.program("ifov"), "study", study, "--output", folder],
            stdout=subprocess.DEVNULL, check=True,
        )
        for name, row in json.loads((folder / "figures.json").read_text()).items():
            figures[f"{study}.{name}"] = row
    return figures
