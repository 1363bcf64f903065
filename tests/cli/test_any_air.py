"""Airs, Suns, sensors and channels by chance through `ifov atmosphere`: what no air can be, none is.

Most of what a solver does is interpolated between few solutions, by ratios that may have next to nothing below the bar. IFOV_AIRS=200 tries as many.
"""

import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
PROGRAM = os.environ.get("IFOV_PROGRAM", str(pathlib.Path(__file__).resolve().parents[2] / "build" / "ifov"))

TYPES = ["rural", "maritime", "urban", "tropospheric", "desert", "continental clean", "continental average", "continental polluted",
         "biomass burning", "savanna burning"]
PROFILES = ["tropical", "mid-latitude summer", "mid-latitude winter", "subarctic summer", "subarctic winter", "US standard 1976"]
CENTRES_UM = [.36, .4, .45, .55, .65, .76, .86, .94, 1.13, 1.38, 1.6, 1.9, 2.06, 2.2, 2.7, 3.3, 3.85, 4.3, 4.8, 6.3, 8.5, 9.6, 11, 13, 15]
SUNS_DEG = [0, 1, 10, 20, 30, 45, 60, 70, 75, 78, 80, 85, 89, 91, 94]


def made(number):
    """A document and the options to look at it with; the same for a number."""
    draw = random.Random(number)
    air = {"profile": draw.choice(PROFILES), "aerosol": {"type": draw.choice(TYPES), "visibility": f"{draw.choice([1.5, 3, 5, 10, 23, 50, 100])} km"}}
    if draw.random() < 0.3:
        air["aerosol"] = {"kind": draw.choice(TYPES), "optical_depth": draw.choice([0.01, 0.1, 0.5, 1.5, 4]), "humidity": f"{draw.choice([20, 60, 90])} %"}
    if draw.random() < 0.3:
        air["clouds"] = [{"kind": draw.choice(["water", "ice"]), "optical_depth": draw.choice([0.1, 1, 5, 30]), "base": "2 km", "top": "3 km"}]
    channels = []
    for k, centre in enumerate(draw.sample(CENTRES_UM, 3)):
        channels.append({"name": f"c{k}", "gaussian": {"center": f"{centre} um", "fwhm": f"{centre * draw.choice([10, 30, 80]):g} nm"}})
    document = {
        "ifov": 1,
        "scene": {"materials": {"lawn": {"reflectance": 0.2, "temperature": "22 degC"}}, "objects": [{"plane": {}, "material": "lawn"}]},
        "light": {"sun": {"disc": {"zenith": f"{draw.choice(SUNS_DEG)} deg", "azimuth": "225 deg"}}}, "atmosphere": air,
        "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [2, 2]}}, "channels": channels}}
    options = ["--view", f"{draw.choice([0, 0, 10, 30, 55, 70, 79])},{draw.choice([0, 45, 90, 180, 222])}"]
    if draw.random() < 0.5:
        options += ["--altitude", str(draw.choice([0.02, 0.3, 1, 2.5, 4, 10, 30]))]
    if draw.random() < 0.3:
        air["aerosol"] = own_haze(draw)
    if draw.random() < 0.2:
        air.update(ground_altitude="1.2 km", gases={gas: "off" for gas in draw.sample(["h2o", "co2", "o3", "ch4", "o2"], 2)})
        if "--altitude" in options:
            options[-1] = "400"
    return document, options


def own_haze(draw):
    part = {"optical_depth": draw.choice([0.05, 0.5, 4]), "angstrom": draw.choice([0, 1.3, 2.5]), "single_scattering_albedo": draw.choice([0, 0.5, 0.9, 1]),
            "asymmetry": draw.choice([-0.3, 0, 0.6, 0.95])}
    spheres = {"radius": f"{draw.choice([0.05, 0.2, 1])} um", "sigma": draw.choice([1.3, 2]), "index": draw.choice([[1.45, 0], [1.33, 0.001], [1.75, 0.4]])}
    aloft = {**part, "heights": [{"altitude": "2 km", "density": 0}, {"altitude": "3 km", "density": 1}, {"altitude": "6 km", "density": 0}]}
    return draw.choice([{**part, "scale_height": "1.5 km"}, {"mixture": [{**part, "base": "1.2 km", "top": "3 km"}, aloft]},
                        {"optical_depth": draw.choice([0.1, 1]), "top": "3 km", "mie": spheres}])


def impossible(row, sun_deg):
    """What of a row of --summary no air can be."""
    value = {key: float(text) for key, text in row.items() if key != "channel" and text not in ("", "-")}
    found = [key for key, number in value.items() if not math.isfinite(number)]
    white = value["solar_irradiance"] / math.pi
    if not 0 <= value["solar_path_radiance"] <= 1.2 * white + 1e-9:
        found.append("solar_path_radiance")
    if value["thermal_path_radiance"] < 0:
        found.append("thermal_path_radiance")
    for key in ("direct_transmittance_down", "direct_transmittance_up", "spherical_albedo"):
        if not -1e-9 <= value[key] <= 1.0001:
            found.append(key)
    if value["direct_transmittance_up"] + value["diffuse_transmittance_up"] > 1.005:
        found.append("diffuse_transmittance_up")
    if sun_deg < 75 and value["direct_transmittance_down"] + value["diffuse_transmittance_down"] > 1.005:
        found.append("diffuse_transmittance_down")
    if math.hypot(value["path_q"], value["path_u"]) > 1.001 * max(value["solar_path_radiance"] + value["thermal_path_radiance"], 1e-12):
        found.append("path_q, path_u")
    if value["wavelength"] < 2.4 and sun_deg < 75:  # what goes in at the sensor's level and does not reach the ground is taken by the air
        down, ground = (value[level + "_direct"] + value[level + "_diffuse"] for level in ("sensor", "ground"))
        if down > 1e-4 * value["solar_irradiance"] and down - value["sensor_up"] < ground - value["ground_up"] - 0.01 * down:
            found.append("sensor_up")
    return found


def one_sided(there, back, mirrored):
    """What is not the same of light that goes the other way, and of its mirror image."""
    def differs(one, other, least, share):
        return abs(one - other) > share * max(abs(one), abs(other), least)

    found = []
    if differs(there["path_reflectance"], back["path_reflectance"], 1e-6, 0.005):
        found.append("path_reflectance")
    down = there["direct_transmittance_down"] + there["diffuse_transmittance_down"]
    if differs(down, back["direct_transmittance_up"] + back["diffuse_transmittance_up"], 1e-6, 0.004):
        found.append("transmittance")
    path = there["solar_path_radiance"]
    for key, sign in (("solar_path_radiance", 1), ("path_q", 1), ("path_u", -1), ("ground_diffuse", 1)):
        if differs(there[key], sign * mirrored[key], 0.01 * path, 2e-3):
            found.append("mirrored " + key)
    return found


class AnyAir(unittest.TestCase):
    def rows(self, document, options):
        with tempfile.TemporaryDirectory() as folder:
            path, table = pathlib.Path(folder, "air.json"), pathlib.Path(folder, "air.csv")
            path.write_text(json.dumps(document))
            done = subprocess.run([PROGRAM, "atmosphere", path, "--summary", table, "-q", *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            return list(csv.DictReader(line for line in table.read_text().splitlines() if not line.startswith("#")))

    def test_is_one_that_can_be(self):
        for number in range(int(os.environ.get("IFOV_AIRS", "6"))):
            document, options = made(number)
            sun_deg = float(document["light"]["sun"]["disc"]["zenith"].split()[0])
            for row in self.rows(document, options):
                with self.subTest(number=number, channel=row["channel"], air=document["atmosphere"], sun=sun_deg, options=options):
                    self.assertEqual(impossible(row, sun_deg), [])

    def test_known_finds(self):
        """Once 1e25 of path under a high Sun, 1e5 at dusk, 1e14 of diffuse transmittance to a sensor below the ozone, and 1e17 over cirrus."""
        document, _ = made(0)
        cirrus = [{"kind": "ice", "optical_depth": 5, "base": "2 km", "top": "3 km"}]
        for um, sun_deg, clouds, options in ((2.2, 20, [], ["--view", "0,0"]), (0.76, 91, [], ["--view", "0,0", "--altitude", "10"]),
                                             (9.6, 30, [], ["--view", "79,0", "--altitude", "4"]), (0.55, 40, cirrus, ["--view", "30,90"])):
            document["atmosphere"] = {"profile": "mid-latitude summer", **({"clouds": clouds} if clouds else {})}
            document["light"]["sun"]["disc"]["zenith"] = f"{sun_deg} deg"
            document["sensor"]["channels"] = [{"name": "one", "gaussian": {"center": f"{um} um", "fwhm": f"{10 * um:g} nm"}}]
            for row in self.rows(document, options):
                with self.subTest(um=um, sun=sun_deg, options=options):
                    self.assertEqual(impossible(row, sun_deg), [])

    def test_cloud_lets_out_what_comes_in(self):
        """Nothing here absorbs. Under a Sun 10 degrees above the horizon a fifth of its light was once lost in the cloud."""
        document, _ = made(0)
        nothing = {gas: "off" for gas in ("h2o", "co2", "o3", "n2o", "co", "ch4", "o2", "nh3", "no", "no2", "so2", "n2")}
        for kind, depth, suns_deg in (("water", 10, (60, 75, 80)), ("ice", 3, (80,))):
            clouds = [{"kind": kind, "optical_depth": depth, "base": "1 km", "top": "2 km"}]
            document["atmosphere"] = {"profile": "mid-latitude summer", "gases": nothing, "aerosol": {"type": "none"}, "clouds": clouds}
            document["sensor"]["channels"] = [{"name": "one", "gaussian": {"center": "0.65 um", "fwhm": "3 nm"}}]
            for sun_deg in suns_deg:
                document["light"]["sun"]["disc"]["zenith"] = f"{sun_deg} deg"
                with self.subTest(kind=kind, sun=sun_deg):
                    light = {key: float(text) for key, text in self.rows(document, ["--view", "0,0"])[0].items() if key.split("_")[0] in ("sensor", "ground")}
                    out = light["sensor_up"] + light["ground_direct"] + light["ground_diffuse"]
                    self.assertAlmostEqual(out / (light["sensor_direct"] + light["sensor_diffuse"]), 1, delta=0.01)

    def test_nothing_jumps_at_the_top_of_a_cloud(self):
        """Within a cloud light is told relative to sunlight at the sensor's height; that of the ground, which vapour below dims, made it 15 % brighter."""
        document, _ = made(0)
        document["atmosphere"] = {"profile": "mid-latitude summer", "clouds": [{"kind": "water", "optical_depth": 5, "base": "2 km", "top": "3 km"}]}
        document["light"]["sun"]["disc"]["zenith"] = "50 deg"
        document["sensor"]["channels"] = [{"name": "vapour", "gaussian": {"center": "0.94 um", "fwhm": "6 nm"}}]
        below, above = (self.rows(document, ["--view", "30,90", "--altitude", height])[0] for height in ("2.995", "3.005"))
        for key in ("solar_path_radiance", "sensor_up"):
            self.assertAlmostEqual(float(below[key]) / float(above[key]), 1, delta=0.02, msg=key)

    def test_light_goes_both_ways_alike(self):
        """Sun and sensor change places (Chandrasekhar 1950, section 52), all is turned, and mirrored at the Sun's vertical plane: IFOV_AIRS as above."""
        for number in range(max(3, int(os.environ.get("IFOV_AIRS", "0")) // 8)):
            draw = random.Random(7000 + number)
            document, _ = made(draw.randrange(10**6))
            document["atmosphere"]["gases"] = {gas: "off" for gas in ("h2o", "co2", "o3", "n2o", "co", "ch4", "o2", "nh3", "no", "no2", "so2", "n2")}
            um = draw.choice([0.42, 0.55, 0.87, 1.04, 1.6, 2.2])
            document["sensor"]["channels"] = [{"name": "one", "gaussian": {"center": f"{um} um", "fwhm": f"{10 * um:g} nm"}}]
            low, high, turn, north = draw.choice([5, 20, 40]), draw.choice([45, 58, 65]), draw.choice([35, 90, 140]), draw.choice([0, 77, 225])

            def seen(sun, view, azimuth):
                return {key: float(text) for key, text in self.rows(document, ["--sun", f"{sun},{north}", "--view", f"{view},{(azimuth + north) % 360}"])[0].items()
                        if key != "channel"}

            there, back, mirrored = seen(low, high, turn), seen(high, low, turn), seen(low, high, 360 - turn)
            with self.subTest(number=number, air=document["atmosphere"], um=um, sun=low, view=high, turn=turn):
                self.assertEqual(one_sided(there, back, mirrored), [])
                for key, less in (("path_reflectance", 0.02 * there["path_reflectance"]), ("diffuse_transmittance_up", 0.01)):  # twins
                    self.assertEqual(len(one_sided(there, {**back, key: back[key] - less}, mirrored)), 1, key)
                other = {**mirrored, "path_u": mirrored["path_u"] + 0.01 * there["solar_path_radiance"]}
                self.assertEqual(one_sided(there, back, other), ["mirrored path_u"])

    def test_impossible_air_is_seen(self):
        document, options = made(0)
        row = self.rows(document, options)[0]
        for key, text in (("solar_path_radiance", "1e20"), ("diffuse_transmittance_up", "1.5"), ("thermal_path_radiance", "-1"), ("spherical_albedo", "nan"),
                          ("sensor_up", "1e9")):
            self.assertIn(key, impossible({**row, key: text}, 30))


if __name__ == "__main__":
    unittest.main()
