"""Scenes by rule and chance against a tracer of their own: what is sure of itself is right (docs/developer/benchmarks.md)."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("IFOV_BUILD", str(ROOT / "build"))) / "bench_honesty"

# Kinds whose scenes are right or say that they may not be. `bench_honesty --wild N --kinds ...` knows more: a kind
# comes here when its scenes keep the promise.
KINDS = ["blocks", "colours", "rows_map", "rows_boxes", "rows_mesh", "gaps", "walls", "panels", "texture", "facade", "hot_sphere",
         "mixture", "wide", "airy", "wires", "lamps", "yard", "ball", "hemisphere", "overhead", "night", "copies", "holes", "hot_cells", "faces",
         "gloss", "glass", "water", "relief", "street"]
SHORT = ["--seeds", "2", "--pixels", "12", "--effort", "0.01", "--threads", "1"]


def run(*arguments):
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "figures.json"
        result = subprocess.run(
            [PROGRAM, "--work", folder, "--output", output, *map(str, arguments)], capture_output=True, text=True, timeout=280
        )
        figures = json.loads(output.read_text()) if output.exists() else {}
        documents = {file.name: file.read_text() for file in pathlib.Path(folder).glob("wild_*.json")}
    return result, figures, documents


@unittest.skipUnless(PROGRAM.exists(), "bench_honesty is not built (IFOV_BENCHMARKS)")
class Wild(unittest.TestCase):
    def test_every_kind_is_listed_once(self):
        result, _, _ = run("--wild", 1, "--kinds", "no such kind")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no kind of scene 'no such kind': choose from ", result.stderr)
        known = result.stderr.strip().split("choose from ")[1].split(", ")
        self.assertEqual(sorted(known), sorted(KINDS))

    def test_the_plain_tracer_agrees_with_closed_forms(self):
        result, figures, _ = run("--check-reference")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(len(figures), 8)
        for name, row in figures.items():
            self.assertTrue(row["ok"], f"{name}: {row}")

    def test_what_is_sure_is_right(self):
        poor = 0.0
        # The first night takes as long as all others together, the third a tenth of that.
        for first, kinds in ((1000, [kind for kind in KINDS if kind != "night"]), (1031, ["night"])):
            result, figures, _ = run("--wild", len(kinds), "--first-seed", first, "--kinds", ",".join(kinds), *SHORT)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertTrue(figures["wild_lies"]["ok"], result.stdout)
            self.assertTrue(figures["wild_failures"]["ok"], result.stdout)
            self.assertTrue(figures["wild_converged"]["ok"], result.stdout)
            poor += figures["wild_poor_scenes"]["value"] * len(kinds)
        # One may fall below 0.9 by chance: most have at most 24 values.
        self.assertLess(poor, 1.5)

    def test_intervals_that_claim_too_much_are_found(self):
        result, figures, _ = run("--wild", 4, "--first-seed", 1100, "--kinds", "blocks", "--boast", "0.1", *SHORT)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(figures["wild_lies"]["value"], 0.01, result.stdout)
        self.assertGreater(figures["wild_poor_scenes"]["value"], 0.5, result.stdout)

    def test_a_number_is_a_scene(self):
        def scene(first):
            return run("--wild", 1, "--first-seed", first, "--kinds", "panels", *SHORT)[2]

        first, again, other = scene(9), scene(9), scene(28)
        strip = lambda documents: {n: t.split("// Found")[0] for n, t in documents.items()}  # noqa: E731
        self.assertEqual(len(first), 1)
        self.assertEqual(strip(first), strip(again))
        self.assertNotEqual(list(first), list(other))


if __name__ == "__main__":
    unittest.main()
