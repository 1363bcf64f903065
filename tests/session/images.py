"""Images that tests of cameras render: by the program, of a document, into a folder of their own."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    np = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))
SCENES = ROOT / "benchmarks" / "honesty" / "scenes"
FULL_SCENES = ("panel_boxes", "gable_roof", "wall_foot", "penumbra", "slab_gaps", "alley", "street_canyon")


def run(document, folder, *more, command="render"):
    (folder / "scene.json").write_text(json.dumps(document, indent=1))
    more = ("-o", "out", "--no-state", *more) if command == "render" else more
    return subprocess.run([PROGRAM, command, "scene.json", *more], cwd=folder, capture_output=True, text=True, check=False)


def image_of(document, folder, sampling, seed=1, *more):
    """Radiance, and half-widths where an accuracy is asked for."""
    wanted = ["radiance", "half_width"] if "accuracy" in sampling else ["radiance"]
    done = run({**document, "seed": seed, "sampling": sampling, "output": {"products": wanted}}, folder, *more)
    if done.returncode not in (0, 5, 6):
        raise RuntimeError(done.stderr)
    read = [np.fromfile(folder / f"out/image_{what}.img", "f4").astype(float) for what in wanted]
    return read if len(read) > 1 else read[0]


class RenderedCase(unittest.TestCase):
    """A test that renders documents in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_ifov(self, command, described, *options):
        source = pathlib.Path(self.folder.name) / "doc.json"
        source.write_text(json.dumps(described))
        return subprocess.run([PROGRAM, command, str(source), *options], capture_output=True, text=True, check=False)

    def rendered(self, described, *shape):
        """Radiance, and half-widths where there are any, of this shape or one after the other: [line][channel][column]."""
        out = pathlib.Path(self.folder.name) / f"run{len(list(pathlib.Path(self.folder.name).iterdir()))}"
        done = self.run_ifov("render", described, "--output", str(out))
        self.assertIn(done.returncode, (0, 5, 6), done.stderr)
        files = {product: out / f"image_{product}.img" for product in ("radiance", "half_width")}
        return {product: np.fromfile(file, "<f4").astype(float).reshape(shape or -1) for product, file in files.items() if file.exists()}
