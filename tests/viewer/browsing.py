"""A real browser for tests of the viewer's page: Debian's chromium with chromium-driver and python3-selenium; tests are skipped where
they are missing.

With IFOV_SCREENSHOTS=FOLDER in the environment pictures of the screens are left there, to be looked at."""

import os
import pathlib
import shutil
import time
import unittest

from viewing import Scratch

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains  # noqa: F401
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys  # noqa: F401
    from selenium.webdriver.support.ui import Select  # noqa: F401
except ImportError:
    webdriver = By = Keys = Select = ActionChains = None

BROWSER, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
MISSING = ("python3-selenium is not installed" if webdriver is None else "chromium is not installed" if not BROWSER
           else "chromium-driver is not installed" if not DRIVER else "")
SHOTS = os.environ.get("IFOV_SCREENSHOTS")


def start_browser(profile):
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1100,760", "--force-color-profile=srgb", f"--user-data-dir={profile}",
                 "--no-first-run", "--disable-background-networking", "--disable-dev-shm-usage"):
        options.add_argument(flag)
    options.binary_location = BROWSER
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


@unittest.skipIf(MISSING, MISSING)
class InBrowser(unittest.TestCase):
    """A browser and a scratch folder for all tests of a class."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = Scratch()
        cls.folder = cls.scratch.__enter__()
        cls.browser = start_browser(cls.folder / "profile")

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.scratch.__exit__()

    def tearDown(self):
        wrong = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(wrong, [])
        self.assertNotIn("broken", self.browser.title)

    def find(self, name):
        return self.browser.find_element(By.ID, name)

    def wait(self, what, seconds=20):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            found = what()
            if found:
                return found
            time.sleep(0.05)
        self.fail("it never came: " + self.find("notice").text)

    def shot(self, name):
        if SHOTS:
            time.sleep(0.4)
            self.browser.save_screenshot(str(pathlib.Path(SHOTS) / f"{name}.png"))
