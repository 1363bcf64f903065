"""What those who do not see, or use no mouse, find of each screen of the viewer: names that the browser works out for assistive
technology, contrast, the order of focus, headings and landmarks; planted faults are found. With axe-core (a file axe.min.js that
IFOV_AXE names) its rules as well."""

import json
import os
import pathlib
import subprocess
import unittest

from browsing import By, InBrowser, Keys
from test_scene import scene
from test_series import write_series
from viewing import LONG, PROGRAM, Viewer, write_products

AXE = os.environ.get("IFOV_AXE")
NAMED = {"button", "checkbox", "combobox", "ComboBoxSelect", "spinbutton", "searchbox", "slider", "textbox", "tab", "tabpanel", "tablist", "application",
         "img", "image", "progressbar", "ProgressIndicator", "radiogroup", "listbox", "table", "link", "RootWebArea"}

CONTRAST = """
const light = c => { const [r, g, b] = c.map(v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
const over = (top, a, under) => top.map((v, i) => a * v + (1 - a) * under[i]);
const ground = e => {
  if (!e) return [255, 255, 255];
  const t = getComputedStyle(e).backgroundColor, m = t.match(/[\\d.]+/g).map(Number), a = t.startsWith("rgba") || t.startsWith("color") ? (m[3] === undefined ? 1 : m[3]) : 1;
  if (a === 0) return ground(e.parentElement);
  const rgb = t.startsWith("color(srgb") ? m.slice(0, 3).map(v => 255 * v) : m.slice(0, 3);
  return a >= 1 ? rgb : over(rgb, a, ground(e.parentElement));
};
const found = [];
let count = 0;
const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walk.nextNode()) {
  const e = walk.currentNode.parentElement, text = walk.currentNode.textContent.trim();
  if (!text || !e.checkVisibility({opacityProperty: true, visibilityProperty: true}) || e.closest(":disabled, [aria-hidden=true], title, option, datalist, canvas")) continue;
  const s = getComputedStyle(e), svg = e.closest("svg"), m = (svg ? s.fill : s.color).match(/[\\d.]+/g).map(Number);
  const at = ground(e), ink = m[3] === undefined ? m.slice(0, 3) : over(m.slice(0, 3), m[3], at), [x, y] = [light(ink), light(at)];
  const ratio = (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05), size = parseFloat(s.fontSize), large = size >= 24 || (size >= 18.66 && s.fontWeight >= 700);
  ++count;
  if (ratio < (large ? 3 : 4.5)) found.push(`${text.slice(0, 30)}: ${ratio.toFixed(2)}`);
}
return {found, count};
"""

STRUCTURE = """
const found = [], all = s => [...document.querySelectorAll(s)], seen = e => e.checkVisibility();
if (!document.documentElement.lang) found.push("the page has no language");
if (!document.title) found.push("the page has no title");
for (const [what, count] of [["main", 1], ["body > header", 1], ["h1", 1]]) if (all(what).filter(seen).length !== count) found.push(`${all(what).length} ${what}`);
let level = 0;
for (const h of all("h1,h2,h3,h4,h5,h6").filter(seen)) {
  const now = Number(h.tagName[1]);
  if (now > level + 1) found.push(`a heading of level ${now} behind ${level}: ${h.textContent}`);
  if (!h.textContent.trim()) found.push("a heading is empty");
  level = now;
}
const ids = all("[id]").map(e => e.id);
for (const id of new Set(ids)) if (ids.filter(i => i === id).length > 1) found.push(`two of id ${id}`);
for (const name of ["aria-controls", "aria-labelledby", "aria-describedby", "for", "list"])
  for (const e of all(`[${name}]`)) for (const id of e.getAttribute(name).split(" ")) if (!document.getElementById(id)) found.push(`${name} of ${e.id || e.tagName}: no ${id}`);
for (const e of all("[role=group], fieldset")) if (!e.getAttribute("aria-label") && !e.querySelector("legend")) found.push(`a group has no name: ${e.id}`);
for (const e of all("[tabindex]")) if (e.tabIndex > 0) found.push(`a tab index of ${e.tabIndex}`);
const tabs = all("[role=tab]"), chosen = tabs.filter(t => t.getAttribute("aria-selected") === "true");
if (chosen.length !== 1 || tabs.filter(t => t.tabIndex === 0).length !== 1 || chosen[0].tabIndex !== 0) found.push("not one tab is chosen and in the order of focus");
if (all("[role=tabpanel]").filter(seen).map(e => e.getAttribute("aria-labelledby")).join() !== chosen.map(t => t.id).join()) found.push("the panel is not that of the chosen tab");
for (const e of all("body *").filter(e => e.childElementCount === 0 && e.textContent.trim() && seen(e) && !e.closest("main, header, [role=status], svg, title"))) found.push(`outside of landmarks: ${e.textContent.trim().slice(0, 30)}`);
// What scrolls can be scrolled by keys.
for (const e of all("body *").filter(seen)) {
  const s = getComputedStyle(e);
  if (/auto|scroll/.test(s.overflowY) && e.scrollHeight > e.clientHeight + 1 && e.tabIndex < 0 && !e.querySelector("a[href],button:not(:disabled),input,select,summary,[tabindex='0']")) found.push(`scrolls by no key: ${e.id || e.className || e.tagName}`);
}
return found;
"""

FOCUSABLE = """
return [...document.querySelectorAll("a[href], button, input, select, summary, [tabindex]")]
  .filter(e => e.checkVisibility() && !e.disabled && e.tabIndex >= 0).map(e => e.id || e.dataset.compare || e.outerHTML.slice(0, 60));
"""
FOCUSED = """
const e = document.activeElement, s = getComputedStyle(e);
return e === document.body ? null : [e.id || e.dataset.compare || e.outerHTML.slice(0, 60), s.outlineStyle !== "none" && parseFloat(s.outlineWidth) >= 1];
"""


class Accessibility(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # Colours are those after all transitions.
        cls.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
        write_products(cls.folder / "a")
        write_products(cls.folder / "b")
        wrong = scene()
        wrong["scene"]["objects"][1]["material"] = "pain"
        (cls.folder / "scene.json").write_text(json.dumps(wrong, indent=1))
        write_products(cls.folder / "scene.out")
        (cls.folder / "run").mkdir()
        (cls.folder / "long.json").write_text(LONG)
        write_series(cls.folder / "day")
        cls.viewers = [Viewer(cls.folder / "a", cls.folder / "b", "--no-browser"), Viewer(cls.folder / "scene.json", "--no-browser"),
                       Viewer(cls.folder / "run", "--no-browser"), Viewer(cls.folder / "day", "--no-browser")]

    @classmethod
    def tearDownClass(cls):
        for viewer in cls.viewers:
            viewer.end()
        super().tearDownClass()

    def screens(self):
        """Opens every screen with something in it, and tells its name."""
        two, document, run, series = self.viewers
        render = subprocess.Popen([PROGRAM, "render", "long.json", "-o", "run", "-j", "1", "-q", "--restart"], cwd=self.folder)
        try:
            self.browser.get("about:blank")
            self.browser.get(two.url)
            self.wait(lambda: self.find("spectrum").find_elements(By.CLASS_NAME, "curve"))
            self.find("pin").click()
            self.find("values").click()
            self.wait(lambda: self.find("value-rows").text)
            yield "image"
            self.find("tab-scatter").click()
            self.wait(lambda: "pixels" in self.find("cloud-text").text)
            yield "scatter"
            self.browser.get("about:blank")
            self.browser.get(document.url)
            self.wait(lambda: self.find("tab-scene").is_enabled() or None)
            self.find("tab-scene").click()
            self.wait(lambda: self.find("view").get_attribute("data-step") == "1")
            self.find("view").send_keys(Keys.ENTER)
            self.wait(lambda: "material" in self.find("picked").text)
            yield "scene"
            self.find("tab-document").click()
            self.wait(lambda: self.find("messages").find_elements(By.CLASS_NAME, "error"))
            yield "document"
            self.browser.get("about:blank")
            self.browser.get(run.url)
            self.find("tab-run").click()
            self.wait(lambda: self.find("stop-run").is_displayed() and int(self.find("tiles").get_attribute("data-tiles") or 0) > 0)
            yield "run"
            self.browser.get("about:blank")
            self.browser.get(series.url)
            self.wait(lambda: self.find("times").is_displayed() and self.find("spectrum").find_elements(By.CLASS_NAME, "curve"))
            yield "series"
        finally:
            render.terminate()
            render.wait()
            self.browser.get("about:blank")

    def run_script(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def nameless(self):
        """Of the tree that the browser hands to assistive technology."""
        self.browser.execute_cdp_cmd("Accessibility.enable", {})
        nodes = self.browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        shown = [n for n in nodes if not n["ignored"] and n["role"]["value"] in NAMED]
        self.assertGreater(len(shown), 6)
        return [n["role"]["value"] for n in shown if not n.get("name", {}).get("value", "").strip()]

    def low_contrast(self):
        said = self.run_script(CONTRAST)
        self.assertGreater(said["count"], 8)
        return said["found"]

    def focus_faults(self):
        """Tab goes through all that can be focused in the order of the page, is seen where it is, and comes out again."""
        expected = self.run_script("document.activeElement.blur(); window.getSelection().removeAllRanges(); document.body.tabIndex = -1; document.body.focus(); document.body.removeAttribute('tabindex');" + FOCUSABLE)
        found, faults = [], []
        for _ in range(len(expected) + 3):
            self.browser.switch_to.active_element.send_keys(Keys.TAB)
            now = self.run_script(FOCUSED)
            if now is None or (found and now[0] == found[0]):
                break
            found.append(now[0])
            if not now[1]:
                faults.append(f"focus is not seen: {now[0]}")
        else:
            faults.append("Tab never comes out")
        if found != expected:
            faults.append(f"order of focus: {found}; of the page: {expected}")
        return faults

    def test_every_screen(self):
        seen = []
        for screen in self.screens():
            seen.append(screen)
            for theme in ("light", "dark"):
                with self.subTest(screen=screen, theme=theme):
                    if self.run_script("return document.documentElement.dataset.theme") != theme:
                        self.find("theme").click()
                    self.assertEqual(self.low_contrast(), [])
            with self.subTest(screen=screen):
                self.assertEqual(self.nameless(), [])
                self.assertEqual(self.run_script(STRUCTURE), [])
                self.assertEqual(self.focus_faults(), [])
        self.assertEqual(seen, ["image", "scatter", "scene", "document", "run", "series"])

    @unittest.skipUnless(AXE and pathlib.Path(AXE).is_file(), "IFOV_AXE names no axe.min.js of axe-core")
    def test_axe_finds_nothing(self):
        rules = pathlib.Path(AXE).read_text()
        for screen in self.screens():
            for theme in ("light", "dark"):
                with self.subTest(screen=screen, theme=theme):
                    if self.run_script("return document.documentElement.dataset.theme") != theme:
                        self.find("theme").click()
                    self.run_script(rules)
                    said = self.browser.execute_async_script("const done = arguments[arguments.length - 1]; axe.run().then(done, e => done({error: String(e)}));")
                    self.assertGreater(len(said["passes"]), 15)
                    self.assertEqual([(v["id"], v["impact"], [n["html"][:120] for n in v["nodes"]][:4]) for v in said["violations"]], [])

    def test_planted_faults_are_found(self):
        self.browser.get("about:blank")
        self.browser.get(self.viewers[0].url)
        self.wait(lambda: self.find("spectrum").find_elements(By.CLASS_NAME, "curve"))
        plant = "const e = Object.assign(document.createElement(arguments[0]), arguments[1]); e.dataset.planted = 1; document.querySelector(arguments[2]).append(e);"
        clear = "for (const e of document.querySelectorAll('[data-planted]')) e.remove();"
        self.run_script(plant, "button", {}, "#image-controls")
        self.assertEqual(self.nameless(), ["button"])
        self.run_script(clear + plant, "p", {"textContent": "faint", "id": "faint"}, ".side")
        self.run_script("document.getElementById('faint').style.color = '#999'; document.documentElement.dataset.theme = 'light';")
        self.assertEqual(len(self.low_contrast()), 1)
        self.assertTrue(self.low_contrast()[0].startswith("faint: 2.8"))
        for name, values, where, text in (("button", {"textContent": "x", "tabIndex": 5}, "main", "a tab index of 5"), ("h4", {"textContent": "x"}, "#screen-image", "a heading of level 4 behind 1: x"),
                                          ("h1", {"textContent": "x"}, "main", "2 h1"), ("p", {"textContent": "stray"}, "body", "outside of landmarks: stray"),
                                          ("i", {"id": "band"}, "main", "two of id band")):
            self.run_script(clear + plant, name, values, where)
            self.assertIn(text, self.run_script(STRUCTURE))
        self.run_script(clear + plant, "button", {"textContent": "first", "tabIndex": 5}, "main")
        self.assertIn("order of focus", " ".join(self.focus_faults()))
        self.run_script(clear)
        self.assertEqual((self.run_script(STRUCTURE), self.focus_faults(), self.nameless()), ([], [], []))
        self.browser.get("about:blank")


if __name__ == "__main__":
    unittest.main()
