"""A kept run that is taken to a tighter accuracy: what it costs, what it says, what becomes of it when it is disturbed."""

import array
import json
import math
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

from program import PROGRAM, Folder, products, run
from test_runs import wait_for_tiles

# Low crowns of leaves and trunks over rough ground, in the visible and the thermal infrared: traced borders, textures of
# light, clutter.
SCENE = """{
  "ifov": 1,
  "seed": 5,
  "scene": {
    "materials": {
      "ground": {"reflectance": 0.3, "temperature": "20 degC"},
      "leaf": {"reflectance": 0.1, "temperature": "26 degC"},
      "ball": {"reflectance": 0.6, "temperature": "35 degC"}
    },
    "prototypes": {"tree": [%s]},
    "objects": [
      {"plane": {}, "material": "ground"},
      {"sphere": {"center": ["-3 m", "2 m", "1 m"], "radius": "2.3 m"}, "material": "ball"},
      {"instances": {"of": "tree", "at": [["3 m", "-3 m", "0 m"], ["4.1 m", "3 m", "0 m"], ["-4 m", "-4 m", "0 m"]]}}
    ]
  },
  "light": {"sun": {"disc": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"radiance": {"table": {"wavelength": ["0.3 um", "1 um", "3 um"], "values": ["30 W m-2 sr-1 um-1", "30 W m-2 sr-1 um-1", "0 W m-2 sr-1 um-1"]}, "outside": "extend"}}},
  "sensor": {
    "camera": {"orthographic": {"gsd": "0.5 m", "pixels": [32, 30]}},
    "channels": [
      {"name": "red", "monochromatic": {"at": "0.65 um"}},
      {"name": "T", "monochromatic": {"at": "10 um"}}
    ]
  },
  "sampling": {"accuracy": {"error": "2 %%"}, "tile": 12},
  "output": {"formats": ["envi", "png"]}
}
""" % ", ".join(
    '{"disk": {"center": ["%.2f m", "%.2f m", "%.2f m"], "normal": [%.1f, 0.2, 1], "radius": "0.2 m"}, "material": "leaf"}'
    % (1.5 * math.cos(2.4 * k) * math.sqrt(k / 60), 1.5 * math.sin(2.4 * k) * math.sqrt(k / 60), 1 + (k * 7 % 10) / 5,
       0.1 * (k % 9 - 4))
    for k in range(60)
)


def document(error, text=SCENE):
    return text.replace('"2 %"', f'"{error}"')


def write(folder, error, text=SCENE):
    (folder / "scene.json").write_text(document(error, text))


def cube(folder, name):
    values = array.array("f")
    values.frombytes((pathlib.Path(folder) / f"image_{name}.img").read_bytes())
    return values


def rays(folder):
    return json.loads((pathlib.Path(folder) / "image_run.json").read_text())["cost"]["rays"]["total"]


class Refine(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(scene=document("2 %"))
        cls.kept = cls._folder.path
        done = run("render", "scene.json", "--keep", cwd=cls.kept)
        assert done.returncode == 0, done.stderr
        with Folder(scene=document("1 %")) as folder:
            assert run("render", "scene.json", cwd=folder).returncode == 0
            cls.direct_rays = rays(folder / "scene.out")
            cls.direct = {name: cube(folder / "scene.out", name) for name in ("radiance", "half_width")}

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__()

    def copy(self, folder):
        shutil.copytree(self.kept, folder, dirs_exist_ok=True)

    def refuse(self, folder, words, *arguments):
        before = products(folder / "scene.out") if (folder / "scene.out/image_run.json").exists() else None
        done = run("render", "scene.json", "--refine", *arguments, cwd=folder)
        self.assertEqual(done.returncode, 2 if "usage" in words else done.returncode)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(words, done.stderr)
        if before:
            self.assertEqual(products(folder / "scene.out"), before)
        return done

    def test_it_costs_what_the_tighter_accuracy_costs_and_agrees_with_it(self):
        with Folder() as folder:
            self.copy(folder)
            first_rays = rays(folder / "scene.out")
            write(folder, "1 %")
            done = run("render", "scene.json", "--refine", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(rays(folder / "scene.out"), 1.05 * first_rays)
            self.assertLess(rays(folder / "scene.out"), 1.15 * self.direct_rays)
            self.assertIn("Asked for 1 %", done.stdout)
            found, limit = cube(folder / "scene.out", "radiance"), cube(folder / "scene.out", "half_width")
            apart = sum(
                abs(a - b) > math.hypot(h, k) + 1e-6 * abs(a)
                for a, b, h, k in zip(found, self.direct["radiance"], limit, self.direct["half_width"])
            )
            self.assertLess(apart, 0.02 * len(found))
            record = json.loads((folder / "scene.out/image_run.json").read_text())
            self.assertIn("refined from: 2 %", json.dumps(record))
            # Once more, from there.
            write(folder, "0.7 %")
            done = run("render", "scene.json", "--refine", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("Asked for 0.7 %", done.stdout)

    def test_comments_and_blanks_may_change(self):
        with Folder() as folder:
            self.copy(folder)
            write(folder, "1.5 %", SCENE.replace('  "seed": 5,', '  // the fifth\n  "seed":   5,'))
            self.assertEqual(run("render", "scene.json", "--refine", cwd=folder).returncode, 0)

    def test_what_cannot_be_refined(self):
        with Folder() as folder:
            self.copy(folder)
            self.refuse(folder, "a refinement goes to a tighter accuracy, at most 0.75 of the error before. The run was for "
                        "2 % in every channel")
            write(folder, "3 %")
            self.refuse(folder, "the document asks for 3 % in every channel")
            write(folder, "1.9 %")
            self.refuse(folder, "Change sampling.accuracy.error.")
            write(folder, "0.1 K")
            self.refuse(folder, "the document asks for 0.1 K in every channel")
            write(folder, "1 %", SCENE.replace('"seed": 5', '"seed": 6'))
            self.refuse(folder, "the seed was 5 and is 6")
            write(folder, "1 %", SCENE.replace('"2.3 m"', '"2.4 m"'))
            done = self.refuse(folder, "a refinement changes nothing but the error that is asked for")
            self.assertIn("and is '{\"sphere\"", done.stderr)
            write(folder, "1 %", SCENE.replace('{"error": "2 %"}', '{"error": "2 %", "confidence": 0.9}'))
            self.refuse(folder, "the document: line")

    def test_runs_that_left_nothing_to_go_on_from(self):
        with Folder(scene=document("2 %")) as folder:
            self.refuse(folder, "this folder holds no run that could be refined. Render with --keep first.")
            self.assertEqual(run("render", "scene.json", cwd=folder).returncode, 0)
            write(folder, "1 %")
            self.refuse(folder, "what a refinement goes on from was not kept. Render it with --keep")
        with Folder(scene=SCENE.replace('{"accuracy": {"error": "2 %"}, "tile": 12}', '{"grid": {"elements": [2, 2]}}')) as folder:
            done = run("render", "scene.json", "--keep", cwd=folder)
            self.assertIn("only a run to an accuracy can be kept and refined", done.stderr)
        with Folder(scene=document("2 %")) as folder:
            for wrong in (["--keep", "--no-state"], ["--refine", "--tiles", "1/2"]):
                done = run("render", "scene.json", *wrong, cwd=folder)
                self.assertIn("excludes", done.stderr)

    def test_an_unfinished_run_is_finished_first(self):
        with Folder(scene=document("0.05 %")) as folder:
            process = subprocess.Popen(
                [PROGRAM, "render", "scene.json", "--keep"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE
            )
            wait_for_tiles(folder / "scene.out")
            process.send_signal(signal.SIGINT)
            process.communicate()
            write(folder, "0.03 %")
            self.refuse(folder, "the run in this folder is not finished. Finish it first (--resume), then refine it.")

    def test_killed_while_refining_leaves_the_first_products_whole_and_resumes_to_the_same_bytes(self):
        with Folder() as undisturbed, Folder() as folder:
            for place in (undisturbed, folder):
                self.copy(place)
                write(place, "0.3 %")
            before = products(folder / "scene.out")
            self.assertEqual(run("render", "scene.json", "--refine", cwd=undisturbed).returncode, 0)
            process = subprocess.Popen(
                [PROGRAM, "render", "scene.json", "--refine"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE
            )
            wait_for_tiles(folder / "scene.out")
            process.kill()
            process.communicate()
            left = {name: content for name, content in products(folder / "scene.out").items() if name in before}
            self.assertEqual(left, before)
            self.assertIn("unfinished run of scene.json", run("status", "scene.out", cwd=folder).stdout)
            self.assertIn("--resume", self.refuse(folder, "unfinished run").stderr)
            done = run("render", "scene.json", "--resume", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(products(folder / "scene.out"), products(undisturbed / "scene.out"))

    def test_a_damaged_kept_tile_is_rendered_from_the_beginning(self):
        with Folder() as folder:
            self.copy(folder)
            pack = sorted((folder / "scene.out/run.kept/tiles").iterdir())[0]
            content = bytearray(pack.read_bytes())
            content[len(content) // 2] ^= 1
            pack.write_bytes(content)
            write(folder, "1 %")
            done = run("render", "scene.json", "--refine", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("of the kept run is damaged or missing: it is rendered from the beginning", done.stderr)

    def test_status_and_a_plain_run_over_a_kept_one(self):
        with Folder() as folder:
            self.copy(folder)
            self.assertIn("kept for --refine", run("status", "scene.out", cwd=folder).stdout)
            self.assertEqual(run("render", "scene.json", cwd=folder).returncode, 0)
            self.assertFalse((folder / "scene.out/run.kept").exists())


if __name__ == "__main__":
    unittest.main()
