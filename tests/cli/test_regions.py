"""Reasons of pixels in words and counts, and means over regions, as a user meets them."""

import json
import unittest

from program import DOME, Folder, run

# White noise of a half-shaded sky: more values than these pixels may take.
NOISY = """{
  "ifov": 1,
  "scene": {
    "materials": {"ground": {"reflectance": 0.4}, "roof": {"reflectance": 0.1}},
    "objects": [{"plane": {}, "material": "ground"},
                {"box": {"low": ["-1 m", "-8 m", "1 m"], "high": ["1 m", "8 m", "1.2 m"]}, "material": "roof"}]
  },
  "light": {"sky": {"radiance": "50 W m-2 sr-1 um-1"}},
  "sensor": {
    "camera": {"orthographic": {"gsd": "1 m", "pixels": [8, 6], "center": ["0 m", "0 m"]}},
    "channels": [{"name": "red", "top_hat": {"from": "0.63 um", "to": "0.68 um"}}]
  },
  "sampling": {"accuracy": {"error": "0.1 %", "max_samples": 200}}
}
"""


class Reasons(unittest.TestCase):
    def test_the_last_line_info_and_the_record_count_them(self):
        with Folder(noisy=NOISY) as folder:
            done = run("render", "noisy.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (5, ""))
            record = json.loads((folder / "noisy.out/image_run.json").read_text())["accuracy"]
            counts = record["pixels_by_reason"]
            missed = record["pixels"] - record["pixels_converged"]
            self.assertGreater(missed, 10)
            self.assertEqual(counts["samples"], missed)
            self.assertEqual(sum(counts.values()), missed)
            words = f"the samples that a pixel may take were spent ({missed} pixels)"
            self.assertIn(f"{missed} are not converged: {words}. The widest interval is ", done.stdout.splitlines()[-1])
            self.assertIn(f"reasons    {words}\n", run("info", "noisy.out", cwd=folder).stdout)

    def test_shares_and_their_merge_and_status_count_them_too(self):
        tiled = NOISY.replace('"max_samples": 200}', '"max_samples": 200}, "tile": 4')
        with Folder(noisy=tiled) as folder:
            whole = run("render", "noisy.json", cwd=folder)
            for share in ("1/2", "2/2"):
                out = f"share{share[0]}"
                part = run("render", "noisy.json", "--tiles", share, "-o", out, cwd=folder)
                self.assertEqual((part.returncode, part.stderr), (0, ""))
                self.assertIn("the samples that a pixel may take were spent (", part.stdout)
                self.assertIn("(not: the samples that a pixel may take were spent (", run("status", out, cwd=folder).stdout)
            merged = run("merge", "share1", "share2", "-o", "merged", cwd=folder)
            self.assertEqual((merged.returncode, merged.stderr), (5, ""))
            self.assertEqual(merged.stdout.splitlines()[-1], whole.stdout.splitlines()[-1])
            one, other = ((folder / out / "image_run.json").read_text() for out in ("noisy.out", "merged"))
            self.assertEqual(json.loads(one)["accuracy"], json.loads(other)["accuracy"])


class Regions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = Folder(dome=DOME)
        cls.folder = cls._folder.__enter__()
        done = run("render", "dome.json", cwd=cls.folder)
        assert done.returncode == 0, done.stderr
        cls.channel = json.loads((cls.folder / "dome.out/image_run.json").read_text())["channels"][0]

    @classmethod
    def tearDownClass(cls):
        cls._folder.__exit__()

    def means(self, *regions):
        options = [word for region in regions for word in ("--region", region)]
        done = run("info", *options, "dome.out", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_the_whole_image_is_its_mean(self):
        text = self.means("0,0,3,3")
        self.assertIn("means and half-widths at 95 % confidence\nregion 0,0,3,3: 9 pixels, all converged\n", text)
        mean, half_width = text.splitlines()[-1].split("B ")[1].split(" W")[0].split("+-")
        self.assertAlmostEqual(float(mean), self.channel["mean"], places=4)
        self.assertGreater(float(half_width), 0.4 * self.channel["mean_half_width"])
        self.assertLessEqual(float(half_width), 1.01 * self.channel["mean_half_width"])

    def test_several_regions_and_map_coordinates(self):
        text = self.means("1,1,2,2", "map:-0.5,-0.5,0.5,0.5", "0,0,3,0,3,3")
        lines = text.splitlines()[2:]
        self.assertEqual(len(lines), 6)
        self.assertEqual(lines[1], lines[3])  # the middle pixel, by either
        self.assertIn("region 0,0,3,0,3,3: ", lines[4])

    def test_mistakes(self):
        for region, words in (
            ("1,2,3", "region '1,2,3': found 3 numbers; expected x0,y0,x1,y1 (a rectangle)"),
            ("7,7,9,9", "region '7,7,9,9': no pixel's centre lies in it"),
            ("mask:none.img", "none.img"),
        ):
            done = run("info", "dome.out", "--region", region, cwd=self.folder)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(words, done.stderr)
        done = run("info", "dome.json", "--region", "0,0,1,1", cwd=self.folder)
        self.assertIn("expected a folder of products or a run record (NAME_run.json); found 'dome.json'", done.stderr)


if __name__ == "__main__":
    unittest.main()
