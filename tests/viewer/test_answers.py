"""What the viewer's page is told, against the numbers in the files."""

import json
import math
import os
import pathlib
import re
import shutil
import statistics
import struct
import subprocess
import sys
import time
import unittest

from viewing import DOME, LONG, PROGRAM, TILES, Finished, Refused, Scratch, Viewer, run, slowdown, write_cube, write_products


class Products(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = Scratch()
        cls.folder = cls.scratch.__enter__()
        write_products(cls.folder / "out", label='<img src=x onerror="alert(1)">')
        cls.viewer = Viewer(cls.folder / "out", "--no-browser")
        cls.here = {"source": 0, "generation": 1}

    @classmethod
    def tearDownClass(cls):
        cls.viewer.end()
        cls.scratch.__exit__()

    def test_the_page_inverts_plancks_law(self):
        # CODATA 2018, exact; W m-2 sr-1 um4 and um K.
        h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23
        script = (pathlib.Path(__file__).resolve().parents[2] / "web/tools.js").read_text()
        c1, c2 = map(float, re.search(r"const C1 = (\S+), C2 = (\S+);", script).groups())
        self.assertAlmostEqual(c1 / (2 * h * c * c * 1e24), 1.0, places=8)
        self.assertAlmostEqual(c2 / (h * c / k * 1e6), 1.0, places=8)

    def test_what_there_is(self):
        (source,) = self.viewer.ask("sources")["sources"]
        run = source["run"]
        self.assertEqual((run["width"], run["height"], run["confidence"], source["fault"]), (24, 16, 0.95, ""))
        self.assertEqual([c["um"] for c in run["channels"]], [0.48, 0.56, 0.66, 0.86, 1.65, 10.8])
        cubes = {c["name"]: c for c in run["cubes"]}
        self.assertEqual(list(cubes), ["radiance", "half_width", "samples", "quality", "reasons", "abundance", "material_class"])
        self.assertEqual(cubes["material_class"]["classes"], ["nothing", '<img src=x onerror="alert(1)">', "roof"])
        self.assertEqual(cubes["material_class"]["lookup"][:6], [0, 90, 160, 40, 90, 160])
        self.assertEqual(cubes["material_class"]["role"], "truth")

    def test_bands_whole_and_in_part(self):
        about, values = self.viewer.ask("band", **self.here, cube="radiance", band=3, x0=0, y0=0, x1=24, y1=16, step=1)
        self.assertEqual(about, {"columns": 24, "rows": 16})
        for y in range(16):
            for x in range(24):
                self.assertAlmostEqual(values[24 * y + x], 300 + y + x / 100, places=3)
        about, values = self.viewer.ask("band", **self.here, cube="radiance", band=1, x0=5, y0=2, x1=12, y1=9, step=3)
        self.assertEqual(about, {"columns": 3, "rows": 3})
        for k, (x, y) in enumerate((x, y) for y in (3, 6, 8) for x in (6, 9, 11)):
            self.assertAlmostEqual(values[k], 100 + y + x / 100, places=3)

    def test_pixels(self):
        pixel = self.viewer.ask("pixel", **self.here, x=7, y=11)
        for c, value in enumerate(pixel["radiance"]):
            self.assertAlmostEqual(value, 100 * c + 11.07, places=4)
        self.assertEqual(pixel["samples"], [64, 40, 24])
        self.assertEqual(pixel["material_class"], [2])

    def test_projections_place_points_on_the_image(self):
        about, values = self.viewer.ask("projection", **self.here, most=60000, kind="bands", a=0, b=2, c=5)
        self.assertEqual((about["step"], about["columns"], about["rows"], about["axes"]), (1, 24, 16, 3))
        x, y = 7, 11
        for k, channel in enumerate((0, 2, 5)):
            self.assertAlmostEqual(values[3 * (24 * y + x) + k], 100 * channel + 11.07, places=3)
        # All channels rise alike: one axis has all the variance, six times that of y + x / 100.
        about, values = self.viewer.ask("projection", **self.here, most=60000, kind="pca")
        self.assertAlmostEqual(about["strength"][0], 6 * ((16**2 - 1) / 12 + (24**2 - 1) / 12e4), places=2)
        self.assertLess(about["strength"][1], 1e-6)
        # Noise c + 1 times 0.02 over the normal quantile: the ratio is that variance times the sum of 1 / noise variance.
        about, values = self.viewer.ask("projection", **self.here, most=60000, kind="mnf")
        noise = [(0.02 * (c + 1) / 1.959964) ** 2 for c in range(6)]
        expected = ((16**2 - 1) / 12 + (24**2 - 1) / 12e4) * sum(1 / v for v in noise)
        self.assertAlmostEqual(about["strength"][0] / expected, 1, places=3)
        self.assertIn("half-widths", about["noise"])

    def test_noise_that_is_not_known_is_said(self):
        with Scratch() as folder:
            write_cube(folder / "cube.img", [[[1.0, 2.0], [3.0, 5.0]], [[1.0, 7.0], [8.0, 9.0]]])
            with Viewer(folder, "--no-browser") as viewer:
                self.assertEqual(viewer.ask("sources")["sources"][0]["run"]["channels"][1]["name"], "band 2")
                self.assertEqual(viewer.ask("pixel", **self.here, x=1, y=0), {"cube": [2, 7]})
                with self.assertRaisesRegex(Refused, "the run tells no errors"):
                    viewer.ask("projection", **self.here, most=60000, kind="mnf")
                with self.assertRaisesRegex(Refused, "need a run record"):
                    viewer.ask("region", **self.here, corners="0,0,2,2")

    def test_materials_of_the_library(self):
        found = self.viewer.ask("materials", text="grass", curves=0)["materials"]
        self.assertGreater(len(found), 0)
        (one,) = self.viewer.ask("materials", text=found[0]["name"], curves=1)["materials"]
        curve = one["curves"][0]
        self.assertEqual(len(curve["um"]), len(curve["reflectance"]))
        self.assertEqual(self.viewer.ask("materials", text="no such thing", curves=0), {"materials": []})

    def test_text_of_others_stays_json(self):
        status, headers, body = self.viewer.request("/api/sources")
        self.assertEqual(headers["Content-Type"], "application/json")
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertIn(b'<img src=x onerror=\\"alert(1)\\">', body)


class Changes(unittest.TestCase):
    here = {"source": 0, "generation": 1}
    window = {"cube": "radiance", "band": 0, "x0": 0, "y0": 0, "x1": 4, "y1": 4, "step": 1}

    def wait_for(self, what):
        for _ in range(100):
            found = what()
            if found:
                return found
            time.sleep(0.1)
        self.fail("it never came")

    def test_a_run_that_is_replaced_is_said_and_shown_anew(self):
        with Scratch() as folder:
            write_products(folder / "out", width=24)
            with Viewer(folder / "out", "--no-browser") as viewer:
                viewer.ask("band", **self.here, **self.window)
                write_products(folder / "new", width=9)
                for file in (folder / "new").iterdir():
                    file.replace(folder / "out" / file.name)
                self.wait_for(lambda: viewer.ask("sources")["sources"][0]["run"]["width"] == 9)
                with self.assertRaisesRegex(Refused, "409: .*the products were made anew"):
                    viewer.ask("band", **self.here, **self.window)
                viewer.ask("band", source=0, generation=2, **self.window)
                self.assertEqual(viewer.end()[::2], (0, ""))

    def test_a_file_cut_short_while_it_is_read_is_said(self):
        with Scratch() as folder:
            write_products(folder / "out")
            with Viewer(folder / "out", "--no-browser") as viewer:
                viewer.ask("band", **self.here, **self.window)
                os.truncate(folder / "out/image_radiance.img", 50)
                with self.assertRaisesRegex(Refused, "503: .*image_radiance.img.*the file ends"):
                    viewer.ask("band", **self.here, **{**self.window, "y0": 3})
                self.assertEqual(viewer.ask("sources")["sources"][0]["run"]["width"], 24)

    def test_products_that_go_away_are_said(self):
        with Scratch() as folder:
            write_products(folder / "out")
            with Viewer(folder / "out", "--no-browser") as viewer:
                viewer.ask("band", **self.here, **self.window)
                (folder / "out/image_run.json").unlink()
                for file in (folder / "out").glob("*.img"):
                    file.unlink()
                fault = self.wait_for(lambda: viewer.ask("sources")["sources"][0]["fault"])
                self.assertIn("the products are gone, or are being made anew", fault)
                viewer.ask("band", **self.here, **self.window)  # what was opened is still there

    def test_a_record_that_does_not_fit_its_cubes(self):
        with Scratch() as folder:
            write_products(folder / "out")
            record = json.loads((folder / "out/image_run.json").read_text())
            record["image"]["width_px"] = 25
            (folder / "out/image_run.json").write_text(json.dumps(record))
            answer = run("view", folder / "out", "--no-browser")
            self.assertEqual(answer.returncode, 1)
            self.assertIn("24 x 16 pixels; expected 25 x 16", answer.stderr)

    def test_a_run_of_another_process(self):
        """Tiles as they come, and the products once they are whole; the values of tiles are those of the products."""
        with Scratch() as folder:
            document = LONG.replace("4000, 4000", "320, 320").replace('"elements": [30, 30]', '"elements": [10, 10]')
            (folder / "scene.json").write_text(document)
            (folder / "out").mkdir()
            with Viewer(folder / "out", "--no-browser") as viewer:
                self.assertIn("there are no products and no run yet", viewer.ask("sources")["sources"][0]["fault"])
                render = subprocess.Popen([PROGRAM, "render", "scene.json", "-o", "out", "-j", "1", "-q"], cwd=folder)
                watch = self.wait_for(lambda: (w := viewer.ask("sources")["sources"][0].get("watch")) and 0 < w["tilesDone"] < w["tilesWanted"] and w)
                self.assertEqual((watch["width"], watch["tilesWanted"], len(watch["done"])), (320, 25, 25))
                tile = watch["done"].index("1")
                about, values = viewer.ask("tile", source=0, tile=tile, band=0)
                self.assertEqual(about["x1"] - about["x0"], 64)
                self.assertEqual(len(values), 2 * 64 * 64)
                with self.assertRaises(Refused):
                    viewer.ask("tile", source=0, tile=25, band=0)
                self.assertIn(render.wait(timeout=120), (0, 5, 6))
                self.wait_for(lambda: "run" in viewer.ask("sources")["sources"][0])
                _, whole = viewer.ask("band", **self.here, cube="radiance", band=0, step=1, **about)
                self.assertEqual(whole, values[: 64 * 64])

    def test_tiles_of_a_run_at_work_come_within_a_second(self):
        """From when the other process has finished them to their values here, whatever it moves meanwhile."""
        with Scratch() as folder:
            (folder / "scene.json").write_text(TILES)
            (folder / "out").mkdir()
            with Viewer(folder / "out", "--no-browser") as viewer:
                render = subprocess.Popen([PROGRAM, "render", "scene.json", "-o", "out", "-j", "1", "-q"], cwd=folder)
                finished, taken, late = Finished(folder / "out"), set(), []
                while render.poll() is None:
                    finished.look()
                    watch = viewer.ask("sources")["sources"][0].get("watch")
                    for tile in [k for k, c in enumerate(watch["done"]) if c == "1" and k not in taken] if watch else []:
                        try:
                            viewer.ask("tile", source=0, tile=tile, band=0)
                        except Refused as refused:
                            self.assertEqual((refused.status, "just ended" in refused.why), (409, True), refused)
                            continue
                        taken.add(tile)
                        if tile in finished.elapsed:
                            late.append(finished.since(tile))
                    time.sleep(0.03)
                self.assertGreater(len(late), 20)
                print(f"tiles of a run at work: {len(late)}, {statistics.median(late):.2f} s after they were finished, {max(late):.2f} s at most", file=sys.stderr)
                self.assertLess(max(late), slowdown())  # on an idle machine a second

    def test_a_run_is_stopped_as_by_ctrl_c(self):
        with Scratch() as folder:
            (folder / "scene.json").write_text(LONG)
            (folder / "out").mkdir()
            with Viewer(folder / "out", "--no-browser") as viewer:
                with self.assertRaises(Refused) as refused:
                    viewer.ask("stop", method="POST", source=0)
                self.assertEqual((refused.exception.status, refused.exception.why), (409, "there is no unfinished run to be stopped"))
                # What an earlier request has left stops no later run.
                (folder / "out/run.part").mkdir()
                (folder / "out/run.part/stop").touch()
                render = subprocess.Popen([PROGRAM, "render", "scene.json", "-o", "out", "-j", "1", "--resume"], cwd=folder,
                                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                self.wait_for(lambda: (w := viewer.ask("sources")["sources"][0].get("watch")) and w["tilesDone"] > 0 and w["atWork"])
                self.assertIsNone(render.poll())
                self.assertEqual(viewer.ask("stop", method="POST", source=0), {"stopping": True})
                begun = time.monotonic()
                _, said = render.communicate(timeout=30)
                self.assertLess(time.monotonic() - begun, 5)
                self.assertEqual(render.returncode, 130, said)
                self.assertIn("--resume", said)
                self.assertFalse((folder / "out/run.part/stop").exists())
                self.assertTrue((folder / "out/run.part/state.json").exists())


class Documents(unittest.TestCase):
    def state(self, folder, text):
        (folder / "scene.json").write_text(text)
        with Viewer(folder / "scene.json", "--no-browser") as viewer:
            for _ in range(200):
                answer = viewer.ask("document", source=0)
                if answer["checked"]:
                    return answer
                time.sleep(0.1)
        self.fail("the checks never end")

    def test_what_the_checks_say(self):
        with Scratch() as folder:
            answer = self.state(folder, DOME)
            self.assertEqual(answer["text"], DOME)
            self.assertIn("statement", {m["severity"] for m in answer["messages"]})
            answer = self.state(folder, DOME.replace('"radius": "0.4 m"', '"radius": "0.4 K"'))
            (message,) = [m for m in answer["messages"] if m["severity"] == "error"]
            self.assertEqual(message["line"], DOME[: DOME.index('"radius"')].count("\n") + 1)
            self.assertIn("0.4 K", message["text"])

    def test_a_document_that_is_edited_is_read_again(self):
        """Its text, what the checks say and its scene, also where an editor puts another file in its place; a version tells them apart."""
        wrong = DOME.replace('"radius": "0.4 m"', '"radius": "0.4 K"')
        with Scratch() as folder:
            (folder / "scene.json").write_text(wrong)
            with Viewer(folder / "scene.json", "--no-browser") as viewer:
                def checked(version):
                    for _ in range(200):
                        answer = viewer.ask("document", source=0)
                        if answer["checked"] and answer["version"] == version:
                            return answer
                        time.sleep(0.05)
                    self.fail("it is not read again")
                def scene(version):
                    for _ in range(200):
                        answer = viewer.ask("scene")
                        if answer["state"] != "loading" and answer["version"] == version:
                            return answer
                        time.sleep(0.05)
                    self.fail("it is not loaded again")
                self.assertIn("error", {m["severity"] for m in checked(1)["messages"]})
                self.assertEqual(len(scene(1)["faults"]), 1)
                (folder / "new.json").write_text(DOME)
                (folder / "new.json").replace(folder / "scene.json")
                begun = time.monotonic()
                while viewer.ask("document", source=0)["text"] != DOME:
                    self.assertLess(time.monotonic() - begun, 1)
                    time.sleep(0.02)
                self.assertEqual(viewer.ask("sources")["documentVersion"], 2)
                self.assertNotIn("error", {m["severity"] for m in checked(2)["messages"]})
                self.assertEqual(scene(2)["faults"], [])
                # Gone for a moment, then written where it lay.
                (folder / "scene.json").unlink()
                time.sleep(0.5)
                self.assertEqual(viewer.ask("document", source=0)["text"], DOME)
                (folder / "scene.json").write_text(wrong)
                self.assertIn("error", {m["severity"] for m in checked(3)["messages"]})
                self.assertEqual(len(scene(3)["faults"]), 1)
                self.assertEqual(viewer.end()[::2], (0, ""))


if __name__ == "__main__":
    unittest.main()
