"""The scene screen in a real browser: what is seen, how one moves, what a click tells."""

import json
import math
import unittest

from browsing import ActionChains, By, InBrowser, Keys, Select
from test_scene import CENTRE, EAST, NORTH, RADIUS, scene
from viewing import Viewer

EVIL = '<img src=x onerror=document.title="broken">'


class SceneScreen(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "scene.json").write_text(json.dumps(scene(), indent=1))
        cls.viewer = Viewer(cls.folder / "scene.json", "--no-browser")

    @classmethod
    def tearDownClass(cls):
        cls.viewer.end()
        super().tearDownClass()

    def setUp(self):
        self.open(self.viewer)

    def open(self, viewer):
        self.browser.get("about:blank")
        self.browser.get(viewer.url)
        self.fine()

    def view(self):
        return self.find("view")

    def fine(self):
        """Where the eye is, once its picture is fine."""
        self.wait(lambda: self.view().get_attribute("data-step") == "1")
        return json.loads(self.view().get_attribute("data-eye"))

    def after(self, act):
        before = self.view().get_attribute("data-eye")
        act()
        self.wait(lambda: self.view().get_attribute("data-eye") != before)
        return self.fine()

    def keys(self, *keys):
        return self.after(lambda: self.view().send_keys(*keys))

    def place(self, point):
        """Where a point of the scene is in the picture, from the middle of the canvas, px."""
        eye = json.loads(self.view().get_attribute("data-eye"))
        a, e = math.radians(eye["azimuth"]), math.radians(eye["elevation"])
        forward = (math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), math.sin(e))
        right = (math.cos(a), -math.sin(a), 0)
        up = (-math.sin(a) * math.sin(e), -math.cos(a) * math.sin(e), math.cos(e))
        d = [p - q for p, q in zip(point, eye["at"])]
        depth = sum(x * y for x, y in zip(d, forward))
        scale = self.view().size["height"] / (2 * math.tan(math.radians(eye["fov"]) / 2) * depth)
        return [scale * sum(x * y for x, y in zip(d, right)), -scale * sum(x * y for x, y in zip(d, up))]

    def click(self, point):
        x, y = self.place(point)
        ActionChains(self.browser, 20).move_to_element_with_offset(self.view(), round(x), round(y)).click().perform()

    def colours(self):
        """How many pixels of the canvas have each colour."""
        return self.browser.execute_script(
            "const c = document.getElementById('view'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, n = {};"
            "for (let k = 0; k < d.length; k += 4) { const key = [d[k], d[k + 1], d[k + 2]].join(); n[key] = (n[key] || 0) + 1; } return n;")

    def test_a_document_is_shown_before_it_is_rendered(self):
        self.assertEqual(self.find("tab-scene").get_attribute("aria-selected"), "true")
        self.assertIn("3 objects", self.find("scene-text").text)
        self.assertIn("Sensor: 40 \u00d7 20 pixels, standing still, 100 m from what its middle sees", self.find("scene-sensor").text)
        self.assertFalse(self.find("scene-wrong").is_displayed())
        self.assertFalse(self.find("scene-progress").is_displayed())
        # What the sensor sees is framed: the middle is that of its image on the ground.
        for found, expected in zip(self.fine()["pivot"], (0, 0, 0)):
            self.assertAlmostEqual(found, expected, places=6)
        colours = self.colours()
        self.assertGreater(len(colours), 20)
        # The outline of what the sensor sees is drawn, and no longer where it is not wanted.
        self.assertGreater(colours.get("255,157,46", 0), 100)
        self.find("overlay").click()
        self.wait(lambda: "255,157,46" not in self.colours())

    def test_a_click_names_what_is_there(self):
        top = [CENTRE[0], CENTRE[1], CENTRE[2] + RADIUS]
        eye = self.keys("+", "+")
        towards = [e - c for e, c in zip(eye["at"], CENTRE)]
        length = math.hypot(*towards)
        on_ball = [c + RADIUS * t / length for c, t in zip(CENTRE, towards)]
        self.click(on_ball)
        told = self.wait(lambda: "ball" in self.find("picked").text and self.find("picked").text)
        self.assertIn("paint", told)
        x, y, z = (float(v) for v in told.split("position, m")[1].splitlines()[0].split(","))
        self.assertLess(math.dist((x - EAST, y - NORTH, z), on_ball), 0.25)  # a pixel
        self.assertIn("255,211,77", self.colours())  # what was clicked is outlined
        self.shot("scene_picked")
        # The place in the document.
        self.find("picked").find_element(By.TAG_NAME, "button").click()
        aim = self.wait(lambda: self.find("listing").find_elements(By.CLASS_NAME, "aim"))
        self.assertEqual(aim[0].text.strip(), "{")
        self.assertIn("ball", aim[0].find_element(By.XPATH, "following-sibling::div").text)
        self.assertGreater(top[2], 0)

    def test_orbit_by_keys_wheel_and_mouse(self):
        eye = self.fine()
        turned = self.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_DOWN)
        self.assertAlmostEqual((turned["azimuth"] - eye["azimuth"] + 180) % 360 - 180, -10, places=6)
        self.assertAlmostEqual(turned["elevation"], eye["elevation"] + 5, places=6)
        for one in (eye, turned):
            self.assertAlmostEqual(math.dist(one["at"], one["pivot"]), math.dist(eye["at"], eye["pivot"]), places=6)
        nearer = self.keys("+")
        self.assertAlmostEqual(math.dist(nearer["at"], nearer["pivot"]) / math.dist(eye["at"], eye["pivot"]), 0.8, places=6)
        dragged = self.after(lambda: ActionChains(self.browser, 20).move_to_element(self.view()).click_and_hold().move_by_offset(60, 0).release().perform())
        self.assertAlmostEqual(abs((dragged["azimuth"] - nearer["azimuth"] + 180) % 360 - 180), 18, delta=2)
        self.assertEqual(self.find("picked").text, "Click the picture: what is met is told here.")  # a drag is no click
        moved = self.after(lambda: self.view().send_keys(Keys.SHIFT, Keys.ARROW_UP))
        self.assertGreater(math.dist(moved["pivot"], dragged["pivot"]), 1)
        whole = self.after(lambda: self.find("frame").click())
        self.assertEqual(whole, eye)

    def test_walk(self):
        self.find("mode-walk").click()
        # On the plane, as high as eyes are.
        self.wait(lambda: abs(self.fine()["at"][2] - 1.7) < 1e-6)
        eye = self.fine()
        self.assertEqual(self.find("mode-walk").get_attribute("aria-pressed"), "true")
        walked = self.keys("w", "w", "d")
        self.assertAlmostEqual(walked["at"][2], 1.7, places=6)
        step = math.dist(walked["at"], eye["at"])
        self.assertGreater(step, 0.4)
        ahead = (math.sin(math.radians(eye["azimuth"])), math.cos(math.radians(eye["azimuth"])))
        self.assertAlmostEqual(sum(a * (p - q) for a, p, q in zip(ahead, walked["at"], eye["at"])), step * 2 / math.sqrt(5), places=6)
        self.view().send_keys("e")
        self.wait(lambda: abs(self.fine()["at"][2] - 2.2) < 1e-6)
        self.shot("scene_walk")
        self.view().send_keys("m")
        self.wait(lambda: self.find("mode-orbit").get_attribute("aria-pressed") == "true")

    def test_from_the_sensor(self):
        eye = self.after(lambda: self.find("through").click())
        self.assertEqual(eye["at"], [0, 0, 100])
        self.assertAlmostEqual(eye["elevation"], -90, places=6)
        # On from there with the field of view of a person, about what the sensor looks at.
        near = self.after(lambda: self.find("mode-orbit").click())
        self.assertLess(math.dist(near["at"], [0, 0, 0]), 100)
        self.assertEqual(near["fov"], 50)

    def test_colours(self):
        coloured = lambda: sum(n for colour, n in self.colours().items() if max(rgb := list(map(int, colour.split(",")))) - min(rgb) > 40)
        self.find("overlay").click()
        self.wait(lambda: coloured() == 0)  # all reflect as much red as blue
        Select(self.find("paint-scene")).select_by_value("material")
        self.wait(lambda: self.view().get_attribute("data-step") == "1" and coloured() > 10000)

    def test_dark_and_light(self):
        for _ in range(2):
            name = self.browser.execute_script("return document.documentElement.dataset.theme")
            self.shot(f"scene_{name}")
            self.find("theme").click()

    def test_mistakes_are_said_and_the_rest_is_shown(self):
        document = scene()
        document["scene"]["objects"][1]["material"] = EVIL
        document["sensor"] = {"camera": {"frame": {"pixels": [4, 4]}}}
        (self.folder / "wrong.json").write_text(json.dumps(document, indent=1))
        with Viewer(self.folder / "wrong.json", "--no-browser") as viewer:
            self.open(viewer)
            self.assertIn("2 mistakes are left out of the picture", self.find("scene-wrong").text)
            said = self.find("scene-faults").text
            self.assertIn("'scene.objects[1]' is shown grey", said)
            self.assertIn(f"there is no material '{EVIL}'", said)
            self.assertIn("no sensor is shown", said)
            self.assertIn("No sensor is shown.", self.find("scene-sensor").text)
            self.assertFalse(self.find("through").is_enabled())
            self.shot("scene_mistakes")
            self.browser.get("about:blank")
        self.browser.get_log("browser")

    def test_without_a_camera(self):
        document = scene()
        document["sensor"] = {"points": {"at": [{"position": [f"{EAST + 3 * k} m", f"{NORTH + 12} m", "1 m"], "normal": [0, 0, 1]} for k in range(4)]},
                              "channels": document["sensor"]["channels"]}
        (self.folder / "points.json").write_text(json.dumps(document))
        with Viewer(self.folder / "points.json", "--no-browser") as viewer:
            self.open(viewer)
            self.assertIn("No camera: 4 points", self.find("scene-sensor").text)
            self.assertIn("255,157,46", self.colours())
            self.shot("scene_points")
            self.browser.get("about:blank")
        self.browser.get_log("browser")


if __name__ == "__main__":
    unittest.main()
