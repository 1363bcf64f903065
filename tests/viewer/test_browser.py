"""The viewer's page in a real browser (browsing.py)."""

import math
import subprocess
import sys
import time

from browsing import ActionChains, By, InBrowser, Keys, Select
from viewing import DOME, LONG, PROGRAM, TILES, Finished, Scratch, Viewer, slowdown, write_products

EVIL = '<img src=x onerror=document.title="broken">'


class Page(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_products(cls.folder / "a", label=EVIL)
        write_products(cls.folder / "b", label=EVIL)
        cls.viewer = Viewer(cls.folder / "a", cls.folder / "b", "--no-browser")

    @classmethod
    def tearDownClass(cls):
        cls.viewer.end()
        super().tearDownClass()

    def setUp(self):
        self.browser.get("about:blank")
        self.browser.get(self.viewer.url)
        self.wait(lambda: self.find("spectrum").find_elements(By.CLASS_NAME, "curve"))

    def colour_at(self, canvas, x, y):
        """Of a pixel of the image, where it is drawn in a canvas that shows all 24 x 16 of them."""
        return self.browser.execute_script(
            "const c = document.getElementById(arguments[0]), k = c.width / c.clientWidth, s = 0.98 * Math.min(c.clientWidth / 24, c.clientHeight / 16);"
            "const u = c.clientWidth / 2 + s * (arguments[1] + 0.2 - 12), v = c.clientHeight / 2 + s * (arguments[2] + 0.2 - 8);"
            "return [...c.getContext('2d').getImageData(u * k, v * k, 1, 1).data].slice(0, 3);", canvas, x, y)

    def test_token_leaves_the_address(self):
        self.assertNotIn(self.viewer.token, self.browser.current_url)
        self.browser.refresh()
        self.wait(lambda: self.find("spectrum").find_elements(By.CLASS_NAME, "curve"))
        self.browser.switch_to.new_window("tab")
        self.browser.get(f"http://127.0.0.1:{self.viewer.port}/")
        self.wait(lambda: "token is missing or wrong" in self.find("notice").text)
        self.browser.get_log("browser")
        self.browser.close()
        self.browser.switch_to.window(self.browser.window_handles[0])

    def test_layers_bands_and_classes(self):
        layers = [o.get_attribute("value") for o in Select(self.find("layer")).options]
        self.assertEqual(layers, ["colour", "channel", "kelvin", "relative", "half_width", "samples", "quality", "reasons", "abundance", "material_class"])
        for layer in layers[1:]:
            before = self.find("image").get_attribute("data-drawn")
            Select(self.find("layer")).select_by_value(layer)
            self.wait(lambda: self.find("image").get_attribute("data-layer") == layer and self.find("image").get_attribute("data-drawn") != before)
        self.wait(lambda: EVIL in self.find("legend").text)
        self.wait(lambda: self.colour_at("image", 2, 2) == [80, 90, 160] and self.colour_at("image", 20, 2) == [40, 90, 160])
        Select(self.find("layer")).select_by_value("channel")
        self.wait(lambda: self.find("band-name").text.startswith("B1"))
        self.find("band").send_keys(Keys.ARROW_RIGHT)
        self.wait(lambda: self.find("band-name").text == "B2 \u00b7 0.56 \u00b5m")
        # Values rise downwards: light where they are large.
        self.wait(lambda: sum(self.colour_at("image", 3, 15)) > sum(self.colour_at("image", 3, 0)) + 100)
        self.shot("synthetic")

    def test_kelvins_are_those_of_plancks_law(self):
        h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23  # CODATA 2018
        for um, kelvin in ((3.7, 900.0), (10.0, 300.0), (12.0, 220.0)):
            metres = um * 1e-6
            radiance = 2e-6 * h * c**2 / metres**5 / math.expm1(h * c / (metres * k * kelvin))
            found = self.browser.execute_script(
                "return import('/tools.js').then(m => m.kelvin(arguments[0], arguments[1]))", um, radiance)
            self.assertAlmostEqual(found, kelvin, places=4)

    def test_pixels_by_keys_and_pins(self):
        image = self.find("image")
        self.wait(lambda: "pixel 12, 8: B1" in self.find("readout").text)
        image.send_keys(Keys.ARROW_LEFT, Keys.ARROW_UP)
        self.wait(lambda: "A pixel 11, 7: B1 (0.48 \u00b5m) = 7.11 \u00b1 0.02 W m-2 sr-1 um-1 at 95 %" in self.find("readout").text)
        image.send_keys("]")
        self.wait(lambda: "B2 (0.56 \u00b5m) = 107.1 \u00b1 0.04" in self.find("readout").text)
        image.send_keys("p")
        self.wait(lambda: len(self.find("pins").find_elements(By.TAG_NAME, "li")) == 2)  # both runs'
        self.assertEqual(len(self.find("spectrum").find_elements(By.CLASS_NAME, "curve")), 4)
        self.find("csv").click()
        table = self.wait(lambda: self.browser.execute_script("return import('/api.js').then(m => m.app.csv)")).splitlines()
        self.assertTrue(table[0].startswith('"channel","wavelength_um","A pixel 11, 7 (W m-2 sr-1 um-1)","half-width of A pixel 11, 7'))
        self.assertEqual(len(table), 7)
        row = table[3].split(",")
        self.assertEqual((row[0], row[1]), ('"B3"', "0.66"))
        self.assertAlmostEqual(float(row[2]), 207.11, places=4)
        self.assertAlmostEqual(float(row[3]), 0.06, places=6)
        self.find("pins").find_element(By.TAG_NAME, "button").click()
        self.wait(lambda: len(self.find("pins").find_elements(By.TAG_NAME, "li")) == 1)

    def test_a_polygon_and_the_library(self):
        image = self.find("image")
        self.find("polygon").click()
        for keys in (" ", Keys.ARROW_RIGHT * 4 + " ", Keys.ARROW_DOWN * 4 + " ", Keys.ARROW_LEFT * 4 + " ", Keys.ENTER):
            image.send_keys(keys)
        # Corners at pixels' middles from 12.5, 8.5 to 16.5, 12.5: 4 x 4 or 5 x 5 pixels' middles lie on or in it.
        self.wait(lambda: "mean of" in self.find("pins").text)
        self.assertRegex(self.find("pins").text, r"A mean of (16|25) pixels")
        self.find("library").send_keys("grass")
        self.wait(lambda: self.find("library-names").find_elements(By.TAG_NAME, "option"))
        self.find("library-add").click()
        self.wait(lambda: self.find("spectrum").find_elements(By.CLASS_NAME, "library"))
        self.shot("library")

    def test_wavelengths_are_chosen_by_a_drag(self):
        plot = self.find("spectrum")
        marks = lambda: [t.text for t in plot.find_elements(By.TAG_NAME, "text")]
        self.assertIn("10", marks())
        self.assertFalse(self.find("whole-plot").is_displayed())
        width = plot.size["width"]
        # From below 0.48 um to about 1 um: four channels, whose values take the whole height.
        ActionChains(self.browser, 20).move_to_element_with_offset(plot, int(-0.37 * width), 0).click_and_hold().move_by_offset(int(0.26 * width), 5).perform()
        self.assertTrue(plot.find_elements(By.CLASS_NAME, "chosen"))
        ActionChains(self.browser, 20).release().perform()
        self.wait(lambda: self.find("whole-plot").is_displayed())
        self.assertNotIn("10", marks())
        self.assertNotIn("500", marks())
        self.assertFalse(plot.find_elements(By.CLASS_NAME, "chosen"))
        self.shot("plot_zoomed")
        # A click is still a band.
        ActionChains(self.browser, 20).move_to_element_with_offset(plot, int(0.2 * width), 0).click().perform()
        self.wait(lambda: "B4" in self.find("readout").text or "B3" in self.find("readout").text)
        self.assertTrue(self.find("whole-plot").is_displayed())
        self.find("whole-plot").click()
        self.wait(lambda: "10" in marks())

    def test_blink_and_swipe(self):
        buttons = {b.get_attribute("data-compare"): b for b in self.find("compare").find_elements(By.TAG_NAME, "button")}
        buttons["swipe"].click()
        self.wait(lambda: self.find("which").get_attribute("textContent") == "A | B")
        self.shot("swipe")
        buttons["blink"].click()
        self.assertEqual({self.wait(lambda: self.find("which").get_attribute("textContent") == side) for side in "AB"}, {True})
        buttons["b"].click()
        self.wait(lambda: self.find("which").get_attribute("textContent") == "B")

    def test_scatter_and_lasso_both_ways(self):
        self.find("tab-scatter").click()
        self.wait(lambda: "384 pixels" in self.find("cloud-text").text)
        Select(self.find("paint")).select_by_value("material")
        self.wait(lambda: EVIL in self.find("materials").text)
        self.find("tool-lasso").click()
        stage = self.find("cloud")
        half = stage.size["height"] * 0.49
        ActionChains(self.browser, 20).move_to_element_with_offset(stage, -int(half), -int(half)).click_and_hold().move_by_offset(int(2 * half), 0).move_by_offset(
            0, int(half)).move_by_offset(-int(2 * half), 0).release().perform()
        self.wait(lambda: "are selected" in self.find("cloud-text").text)
        chosen = int(self.find("cloud-text").text.split(". ")[1].split()[0])
        self.assertTrue(150 < chosen < 240, chosen)  # the upper half of the cloud
        self.shot("scatter")
        # They are the lower half of the image, where values are large.
        self.find("tab-image").click()
        self.wait(lambda: self.colour_at("image", 3, 15)[0] > 200 and self.colour_at("image", 3, 15)[2] < 70)
        self.assertFalse(self.colour_at("image", 3, 1)[0] > 200 and self.colour_at("image", 3, 1)[2] < 70)
        self.find("tab-scatter").click()
        for kind in ("pca", "mnf"):
            Select(self.find("kind")).select_by_value(kind)
            self.wait(lambda: "along the axes" in self.find("cloud-text").text if kind == "pca" else "known noise" in self.find("cloud-text").text)
        self.find("dimensions").clear()
        self.find("dimensions").send_keys("6", Keys.TAB)
        self.find("spin").click()
        before = int(self.find("cloud").get_attribute("data-drawn"))
        self.wait(lambda: int(self.find("cloud").get_attribute("data-drawn")) > before + 5)
        self.find("spin").click()

    def test_graphics_and_hand_draw_the_same_points(self):
        """The two ways to draw a cloud, pixel by pixel; a cloud that is turned by a hundredth is another."""
        self.browser.set_script_timeout(60)
        found = self.browser.execute_async_script("""
            const done = arguments[arguments.length - 1];
            import("/points.js").then(m => {
              const n = 20000, axes = 5, W = 500, H = 400, values = new Float32Array(n * axes), colours = new Uint8Array(4 * n);
              let seed = 1;
              const random = () => (seed = seed * 48271 % 2147483647) / 2147483647;
              for (let i = 0; i < n; ++i) {
                for (let k = 0; k < axes; ++k) values[i * axes + k] = i % 97 ? random() + random() + random() - 1.5 : NaN;
                if (i % 3) colours.set([11, 75, 95, i % 5 ? 0 : 120], 4 * i); else colours.set([200, 60, i % 256, i % 11 ? 0 : 255], 4 * i);
              }
              const draw = (by, angle) => {
                const host = document.createElement("canvas");
                document.body.append(host);
                const painter = m.pointsBelow(host, () => {}, by), c = Math.cos(angle), s = Math.sin(angle);
                painter.take(values, n, axes);
                painter.tint(colours);
                painter.draw({basis: [[c, 0, s, 0, 0], [0, 0.6, 0, 0, 0.8], [-s, 0, c, 0, 0]], scale: 150, W, H, ground: [223, 228, 231]});
                const flat = document.createElement("canvas");
                [flat.width, flat.height] = [W, H];
                flat.getContext("2d").drawImage(painter.canvas, 0, 0);
                painter.canvas.remove(); host.remove();
                return flat.getContext("2d").getImageData(0, 0, W, H).data;
              };
              const off = (a, b) => { let count = 0; for (let k = 0; k < a.length; k += 4) if (Math.max(...[0, 1, 2].map(c => Math.abs(a[k + c] - b[k + c]))) > 2) ++count; return count / (W * H); };
              const hand = draw("hand", 0.3);
              let ground = 0;
              for (let k = 0; k < hand.length; k += 4) if (hand[k] === 223 && hand[k + 1] === 228) ++ground;
              done([off(hand, draw("graphics", 0.3)), off(hand, draw("graphics", 0.31)), ground / (W * H)]);
            }).catch(error => done(String(error)));""")
        same, turned, ground = found
        self.assertLess(same, 0.002, found)
        self.assertGreater(turned, 0.1, found)
        self.assertTrue(0.2 < ground < 0.8, found)

    def test_documents_and_reasons(self):
        (self.folder / "scene.json").write_text('{\n  "ifov": 1,\n  "scene": {"objects": [{"plane": {}, "material": "' + EVIL.replace('"', "'") + '"}]},\n  "sensor": {}\n}\n')
        with Viewer(self.folder / "scene.json", "--no-browser") as viewer:
            self.browser.get(viewer.url)
            self.wait(lambda: self.find("scene-wrong").is_displayed())
            self.find("tab-document").click()
            self.wait(lambda: self.find("messages").find_elements(By.CLASS_NAME, "error"))
            self.assertTrue(self.find("listing").find_elements(By.CLASS_NAME, "wrong"))
            self.shot("document")
            # It is edited: the page follows, its scene too.
            (self.folder / "scene.json").write_text(DOME)
            self.wait(lambda: "A warm dome" in self.find("listing").text and not self.find("messages").find_elements(By.CLASS_NAME, "error"))
            self.wait(lambda: self.find("messages").find_elements(By.CLASS_NAME, "statement"))
            self.assertFalse(self.find("listing").find_elements(By.CLASS_NAME, "wrong"))
            self.find("tab-scene").click()
            self.wait(lambda: "2 objects" in self.find("scene-text").text and not self.find("scene-wrong").is_displayed())
            self.wait(lambda: self.find("view").get_attribute("data-step") == "1")
            before = self.find("view").get_attribute("data-eye"), self.find("view").get_attribute("data-drawn")
            (self.folder / "scene.json").write_text(DOME.replace('"radius": "0.4 m"', '"radius": "0.8 m"'))
            self.wait(lambda: self.find("view").get_attribute("data-drawn") != before[1])
            self.assertEqual(self.find("view").get_attribute("data-eye"), before[0])
            self.browser.get("about:blank")
        self.browser.get_log("browser")

    def test_a_run_at_work(self):
        with Scratch() as folder:
            (folder / "scene.json").write_text(TILES)
            (folder / "out").mkdir()
            with Viewer(folder / "out", "--no-browser") as viewer:
                self.browser.get(viewer.url)
                self.wait(lambda: "no run yet" in self.find("notice").text)
                render = subprocess.Popen([PROGRAM, "render", "scene.json", "-o", "out", "-j", "1", "-q"], cwd=folder)
                self.wait(lambda: int(self.find("tiles").get_attribute("data-tiles") or 0) > 3)
                self.assertIn("tiles", self.find("figures").text)
                self.assertTrue(self.find("stop-run").is_displayed())
                self.shot("run")
                # What is drawn is what was finished a second before, at most, while the run is not done.
                finished, late = Finished(folder / "out"), []
                while (folder / "out/run.part/state.json").exists() and render.poll() is None:
                    drawn = int(self.find("tiles").get_attribute("data-tiles"))
                    finished.look()
                    ends = sorted(finished.elapsed, key=finished.elapsed.get)
                    if len(ends) > drawn:
                        late.append(finished.since(ends[drawn]))
                    time.sleep(0.03)
                print(f"tiles on the page: {max(late):.2f} s at most after they were finished", file=sys.stderr)
                self.assertLess(max(late), slowdown())
                self.assertIn(render.wait(timeout=120), (0, 5, 6))
                self.wait(lambda: self.find("tab-image").is_enabled())
                self.wait(lambda: not self.find("stop-run").is_displayed())
                # Another is stopped, by a key.
                (folder / "scene.json").write_text(LONG)
                render = subprocess.Popen([PROGRAM, "render", "scene.json", "-o", "out", "-j", "1", "-q"], cwd=folder)
                self.wait(lambda: self.find("stop-run").is_displayed() or self.find("tab-run").click())
                self.wait(lambda: int(self.find("tiles").get_attribute("data-tiles") or 0) > 0)
                self.find("stop-run").send_keys(Keys.ENTER)
                self.wait(lambda: not self.find("stop-run").is_enabled())
                self.shot("stopping")
                self.assertEqual(render.wait(timeout=20), 130)
                self.wait(lambda: not self.find("stop-run").is_displayed())
                self.assertIn("nobody", self.find("figures").text)
                self.browser.get("about:blank")
        self.browser.get_log("browser")


if __name__ == "__main__":
    unittest.main()
