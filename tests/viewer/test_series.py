"""A series of times in the viewer: what the page is told, and the page in a browser (browsing.py)."""

import json
import os
import subprocess
import unittest

from browsing import InBrowser, Keys, Select
from viewing import PROGRAM, Refused, Scratch, Viewer, write_products

TIMES = [f"2026-06-21T{hour:02}:00Z" for hour in range(6, 12)]


def write_series(folder, made=5, name="image", times=TIMES):
    """Six times, of which the last are not made; of each all values are those of the first times (1 + its number)."""
    folder.mkdir(parents=True)
    folders = [time.replace(":", "") for time in times]
    (folder / f"{name}_series.json").write_text(json.dumps({
        "program": {"name": "ifov", "version": "0.1.0"}, "document": "scene.json", "name": name, "complete": made == len(times),
        "times": [{"time": t, "folder": f} for t, f in zip(times, folders)], "files": []}))
    for k, one in enumerate(folders[:made]):
        write_products(folder / one, factor=1 + k)
    return folder


class Asked(unittest.TestCase):
    def test_times_are_told_and_shown_one_or_two_at_a_time(self):
        with Scratch() as folder:
            write_series(folder / "day")
            with Viewer(folder / "day", "--no-browser") as viewer:
                said = viewer.ask("sources")
                self.assertEqual((said["times"], said["made"], said["working"]), (TIMES, "111110", ""))
                self.assertEqual([s["index"] for s in said["sources"]], [0])
                said = viewer.ask("sources", a=4, b=2)
                self.assertEqual([(s["index"], s["generation"], s["run"]["width"]) for s in said["sources"]], [(4, 1, 24), (2, 1, 24)])
                for k in (4, 2):
                    _, values = viewer.ask("band", source=k, generation=1, cube="radiance", band=1, x0=3, y0=2, x1=4, y1=3, step=1)
                    self.assertAlmostEqual(values[0], (1 + k) * 102.03, places=3)
                about, values = viewer.ask("spread", cube="radiance", band=1)
                self.assertEqual((about["times"], len(values)), (5, 5 * 24 * 16))
                for k in range(5):
                    self.assertAlmostEqual(values[384 * k + 24 * 2 + 3], (1 + k) * 102.03, places=3)
                with self.assertRaisesRegex(Refused, "404: the run has no cube"):
                    viewer.ask("spread", cube="../x", band=1)
                with self.assertRaisesRegex(Refused, "expected a whole number from 0 to 5"):
                    viewer.ask("sources", a=6)
                self.assertIn("no products", viewer.ask("sources", a=5)["sources"][0]["fault"])
                # The last is made while one looks.
                write_products(folder / "day/2026-06-21T1100Z")
                self.assertEqual(viewer.ask("sources", a=5)["made"], "111111")

    def test_many_times_do_not_stay_open(self):
        with Scratch() as folder:
            times = [f"2026-06-{day:02}T00:00Z" for day in range(1, 31)]
            write_series(folder / "month", made=30, times=times)
            with Viewer(folder / "month", "--no-browser") as viewer:
                before = len(os.listdir(f"/proc/{viewer.process.pid}/fd"))
                viewer.ask("sources", a=0)
                each = len(os.listdir(f"/proc/{viewer.process.pid}/fd")) - before
                self.assertGreater(each, 3)
                for k in [*range(30), 0]:
                    self.assertEqual(viewer.ask("sources", a=k)["sources"][0]["generation"], 1)
                    _, values = viewer.ask("band", source=k, generation=1, cube="radiance", band=1, x0=3, y0=2, x1=4, y1=3, step=1)
                    self.assertAlmostEqual(values[0] / ((1 + k) * 102.03), 1, places=5)
                self.assertLess(len(os.listdir(f"/proc/{viewer.process.pid}/fd")), before + 22 * each)

    def test_a_series_goes_alone(self):
        with Scratch() as folder:
            write_series(folder / "day")
            write_products(folder / "out")
            done = subprocess.run([PROGRAM, "view", folder / "day", folder / "out", "--no-browser"], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1)
            self.assertIn("holds a series of 6 times; expected it alone", done.stderr)


class Shown(InBrowser):
    def test_times_by_slider_beside_each_other_and_played(self):
        write_series(self.folder / "day")
        with Viewer(self.folder / "day", "--no-browser") as viewer:
            self.browser.get(viewer.url)
            self.wait(lambda: self.find("times").is_displayed() and "06:00 UTC" in self.find("time-name").text)
            Select(self.find("layer")).select_by_value("channel")
            self.wait(lambda: "pixel 12, 8: B1 (0.48 \u00b5m) = 8.12" in self.find("readout").text)
            self.find("time").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
            self.wait(lambda: "08:00 UTC" in self.find("time-name").text and "2026-06-21T08:00Z pixel" in self.find("readout").text and "= 24.36" in self.find("readout").text)
            # One stretch for all: at the third of five times, each as much brighter as the first is bright, it is not as bright as by its own.
            def brightness():
                return self.browser.execute_script(
                    "const c = document.getElementById('image'); const d = c.getContext('2d').getImageData(c.width / 2, 0.3 * c.height, 1, 1).data; return d[0] + d[1] + d[2];")
            held = brightness()
            self.find("hold").click()
            self.wait(lambda: brightness() > held + 20)
            self.find("hold").click()
            Select(self.find("time-b")).select_by_value("0")
            self.wait(lambda: self.find("compare").is_displayed())
            self.shot("series")
            self.find("compare").find_elements("tag name", "button")[1].click()
            self.wait(lambda: "B 2026-06-21T06:00Z pixel 12, 8: B1 (0.48 \u00b5m) = 8.12" in self.find("readout").text)
            self.find("compare").find_elements("tag name", "button")[0].click()
            # Played: the last, which is not made, is left out.
            self.find("play").click()
            for hour in ("09", "10", "06"):
                self.wait(lambda: f"{hour}:00 UTC" in self.find("time-name").text)
            self.find("play").click()
            # A lasso stays on its pixels when the time is another.
            self.find("tab-scatter").click()
            self.wait(lambda: "384 pixels" in self.find("cloud-text").text)
            self.browser.get("about:blank")


if __name__ == "__main__":
    unittest.main()
