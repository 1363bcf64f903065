"""What 210 channels of a suburb under the atmosphere cost over one, at the same paths. The one channel lies where plants
are brightest, so that paths live as long as those of all channels; air and scene are paid for by both and taken out by
the difference of a large and a small run."""

import json
import re
import statistics
import subprocess

from drivers.bookkeeping import spent, window
from drivers.figures import at_most, figure

ONE = '{"name": "S", "gaussian": {"center": "870 nm", "fwhm": "10 nm"}}'
SMALL, LARGE = 4, 20  # sub-elements along a side of a pixel


def one_channel(document):
    text, count = re.subn(r'\{\s*"name": "S",\s*"series": \{"gaussian": \{[^{}]*\}\}\s*\}', ONE, document.read_text())
    if count != 1:
        raise RuntimeError(f"{document}: not as the generator wrote it")
    file = document.with_name(f"one_{document.name}")
    file.write_text(text)
    return file


def rays_and_time(context, document, folder):
    processor, _ = spent([context.program("ifov"), "render", document, "--quiet", "--threads", 2, "--restart", "-o", folder])
    return json.loads((folder / "image_run.json").read_text())["cost"]["rays"]["total"], processor


def run(context):
    program, folder = context.program("ifov"), context.folder / "channels"
    folder.mkdir(parents=True, exist_ok=True)
    suburb = folder / "suburb"
    subprocess.run([program, "make", "suburb", "--size", "100m", "--seed", "7", "--quiet", "--force", suburb], check=True)
    documents = {}
    for side in (SMALL, LARGE):
        many = window(suburb / "render_vswir.json", {"grid": {"elements": [side, side]}})
        many = many.rename(many.with_name(f"many_{side}.json"))
        documents[210, side], documents[1, side] = many, one_channel(many)
    for document in documents.values():  # fills the caches of scene and air
        rays_and_time(context, document, folder / "out")

    ratios, costs = [], []
    for _ in range(9 if context.long else 5):
        per_ray = {}
        for channels in (1, 210):
            small, large = (rays_and_time(context, documents[channels, side], folder / "out") for side in (SMALL, LARGE))
            per_ray[channels] = (large[1] - small[1]) / (large[0] - small[0])
            per_ray[channels, "rays"] = large[0]
        ratios.append(per_ray[210] / per_ray[1])
        costs.append(per_ray[210])
    apart = abs(per_ray[210, "rays"] / per_ray[1, "rays"] - 1.0)
    return {
        "channels.210_over_1_under_air": at_most(statistics.median(ratios), 1.3, "times the processor time a ray"),
        "channels.spread": figure(f"{min(ratios):.3f} to {max(ratios):.3f}", "the same, least and most"),
        "channels.ray": figure(round(1e9 * statistics.median(costs)), "ns of processor time a ray, 210 channels"),
        "channels.paths_apart": at_most(100.0 * apart, 2.0, "% of rays by which the paths differ"),
    }
