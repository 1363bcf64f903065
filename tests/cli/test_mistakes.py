"""Mistakes that people make in documents, and what the program says of each: an error at its place, or a warning.

Each row changes one thing of a good document. None may pass in silence.
"""

import json
import re
import unittest

from mistaken_document import CAMERA, ERROR, FRAME, GOOD, MATERIALS, OBJECTS, WARM, WARNING, ascii_grid, box_obj, changed, several
from more_mistakes import FILES as MORE_FILES, MISTAKES as MORE_MISTAKES
from program import Folder, run


def windows(y_m):
    """Panes placed as copies, 3 m above the ground, in a plane before the house's south wall, which is at y = -3 m."""
    pane = [["-0.4 m", "0 m", "0 m"], ["0.4 m", "0 m", "0 m"], ["0.4 m", "0 m", "0.8 m"], ["-0.4 m", "0 m", "0.8 m"]]
    return several(("scene.prototypes", {"pane": [{"polygon": {"vertices": pane}, "material": "wall"}]}),
                   (OBJECTS + "[+]", {"name": "windows", "instances": {"of": "pane", "at": [[f"{x} m", f"{y_m} m", "3 m"] for x in (-2, 0, 2)]}}))


# What was changed, what is said. An error comes with exit code 1 and the place; a warning with exit code 6.
MISTAKES = [
    # Where things are.
    ("a camera that looks elsewhere", changed(CAMERA + ".orthographic.center", ["500 m", "0 m"]),
     WARNING, "out of the picture: 'house'"),
    ("a camera that looks past everything", several((OBJECTS + "[0]", None), (CAMERA + ".orthographic.center", ["500 m", "0 m"])),
     WARNING, "the camera sees nothing of the scene, which lies at x -4 to 4 m"),
    ("no objects", changed(OBJECTS, []), ERROR, "an empty list"),
    ("a camera below the roof", changed(CAMERA + ".orthographic.height", "3 m"),
     WARNING, "'height' of 3 m lies below the top of the scene at 5 m"),
    ("a frame camera within the house", changed(CAMERA, {"frame": {**FRAME, "position": ["0 m", "0 m", "2 m"], "look_at": ["0 m", "1 m", "2 m"]}}),
     WARNING, "the camera is inside of 'house'"),
    ("a frame camera under the ground", changed(CAMERA, {"frame": {**FRAME, "position": ["30 m", "0 m", "-2 m"], "look_at": ["0 m", "0 m", "-2 m"]}}),
     WARNING, "the camera is under the ground: scene.objects\\[0\\] \\(a plane.*lies 2 m above it"),
    ("a frame camera that looks up", changed(CAMERA, {"frame": {**FRAME, "position": ["0 m", "0 m", "20 m"], "look_at": ["0 m", "0 m", "40 m"]}}),
     WARNING, "the camera sees nothing of the scene"),
    ("a frame camera at what it looks at", changed(CAMERA, {"frame": {**FRAME, "position": ["0 m", "0 m", "0 m"]}}),
     ERROR, "is where the camera itself is"),
    ("pixels of a kilometre", changed(CAMERA + ".orthographic.gsd", "1000 km"), WARNING, "'house' .*a fiftieth of a pixel"),
    ("an easting, and positions about the origin", changed("scene.origin", {"easting": "440000 m", "northing": "4470000 m"}),
     WARNING, "'house' .* lies up to .* km from the picture.*map coordinates"),
    ("longitude and latitude as easting and northing", several(("scene.origin", {"easting": "8.5 m", "northing": "47.4 m"})),
     WARNING, "look like longitude and latitude"),
    ("map coordinates without an origin", changed(OBJECTS + "[+]", {"name": "shed", "box": {"low": ["440000 m", "4470000 m", "0 m"], "high": ["440004 m", "4470003 m", "3 m"]}, "material": "wall"}),
     WARNING, "'shed' .*km from the picture.*give the scene's 'origin' an 'easting'"),
    ("a reference that is not a map's", changed("scene.origin", {"easting": "440000 m", "northing": "4470000 m", "crs": "EPSG:4326"}),
     ERROR, "is not a map projection in metres"),
    ("a reference that nobody knows", changed("scene.origin", {"easting": "440000 m", "northing": "4470000 m", "crs": "EPSG:99999"}),
     ERROR, "EPSG:99999"),
    ("a latitude that contradicts the map", changed("scene.origin", {"latitude": "52 deg", "longitude": "5 deg", "easting": "440000 m", "northing": "4470000 m", "crs": "EPSG:32632"}),
     WARNING, "latitude 52 and longitude 5 deg lie 13.. km from its easting and northing, which are at latitude 40.38 and longitude 8.293 deg"),
    ("latitude above 90", changed("scene.origin", {"latitude": "147 deg", "longitude": "8 deg"}), ERROR, "between -90 and 90 deg"),
    ("a latitude without a unit", changed("scene.origin", {"latitude": 47.4, "longitude": 8.5}), ERROR, "without a unit"),
    ("a mesh in millimetres", changed(OBJECTS + "[+]", {"name": "kiosk", "mesh": {"file": "kiosk_mm.obj"}, "material": "wall"}),
     WARNING, "'kiosk' .*millimetres"),
    ("a mesh whose y points up", changed(OBJECTS + "[+]", {"name": "kiosk", "mesh": {"file": "kiosk_y.obj"}, "material": "wall"}),
     WARNING, 'y points up.*"up": "y"'),
    ("a mesh in the air", changed(OBJECTS + "[+]", {"name": "kiosk", "mesh": {"file": "kiosk.obj"}, "material": "wall", "transform": {"translate": ["6 m", "0 m", "30 m"]}}),
     WARNING, "'kiosk' .*floats up to 30 m above"),
    ("windows in the air", windows(-9.0), WARNING, "'windows' .*3 of 3 copies that were looked at float up to 3 m above what is below"),
    ("a mesh under the ground", changed(OBJECTS + "[+]", {"name": "kiosk", "mesh": {"file": "kiosk.obj"}, "material": "wall", "transform": {"translate": ["6 m", "0 m", "-30 m"]}}),
     WARNING, "'kiosk' .*lies under the ground"),
    ("a road in the plane of the ground", changed(OBJECTS + "[+]", {"name": "road", "polygon": {"vertices": [["-8 m", "-6 m", "0 m"], ["8 m", "-6 m", "0 m"], ["8 m", "-4 m", "0 m"], ["-8 m", "-4 m", "0 m"]]}, "material": "wall"}),
     WARNING, "surfaces of 'road' .*lie in one place in 17 % of the picture: 'road' .*is seen there"),
    ("an empty list of copies", several(("scene.prototypes", {"tree": [{"sphere": {"center": ["0 m", "0 m", "1 m"], "radius": "1 m"}, "material": "wall"}]}), (OBJECTS + "[+]", {"instances": {"of": "tree", "at": []}})),
     ERROR, "an empty list"),
    ("a box inside out", changed(OBJECTS + "[1].box.high", ["-5 m", "3 m", "5 m"]), ERROR, "is not above 'low'"),
    ("a sphere of no size", changed(OBJECTS + "[+]", {"sphere": {"center": ["0 m", "0 m", "0 m"], "radius": "0 m"}, "material": "wall"}), ERROR, "above 0 m"),
    ("a cylinder of no height", changed(OBJECTS + "[+]", {"cylinder": {"base": ["0 m", "0 m", "0 m"], "radius": "1 m", "height": "1e-308 m"}, "material": "wall"}), ERROR, "too small: a length here is at least 1e-09 m"),
    ("a cylinder with an axis of no length", changed(OBJECTS + "[+]", {"cylinder": {"base": ["0 m", "0 m", "0 m"], "radius": "1 m", "axis": ["0 m", "0 m", "0 m"]}, "material": "wall"}), ERROR, "has no length"),
    ("a polygon that is not flat", changed(OBJECTS + "[+]", {"polygon": {"vertices": [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"], ["1 m", "1 m", "1 m"], ["0 m", "1 m", "0 m"]]}, "material": "wall"}), ERROR, "outside the plane"),
    ("a polygon of two corners", changed(OBJECTS + "[+]", {"polygon": {"vertices": [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"]]}, "material": "wall"}), ERROR, "a list of 3"),
    ("a tilted plane", changed(OBJECTS + "[0].transform", {"rotate": {"axis": [1, 0, 0], "angle": "10 deg"}}), ERROR, "must stay horizontal"),
    ("a scale of zero", changed(OBJECTS + "[1].transform", {"scale": 0}), ERROR, "above 0"),
    ("a mesh that is not there", changed(OBJECTS + "[+]", {"mesh": {"file": "gone.obj"}, "material": "wall"}), ERROR, "gone.obj.*(no such file|No such file)"),
    ("a mesh that is a folder", changed(OBJECTS + "[+]", {"mesh": {"file": "folder.obj"}, "material": "wall"}), ERROR, "folder.obj.*(is a folder|Is a directory)"),
    ("a mesh of another format", changed(OBJECTS + "[+]", {"mesh": {"file": "kiosk.stl"}, "material": "wall"}), ERROR, "kiosk.stl"),
    ("a material that nobody declared", changed(OBJECTS + "[1].material", "walls"), ERROR, "there is no material 'walls'; did you mean 'wall'"),
    ("an object without a material", changed(OBJECTS + "[1]", {"box": GOOD["scene"]["objects"][1]["box"]}), ERROR, "material"),
    ("two shapes in one object", changed(OBJECTS + "[1].sphere", {"center": ["0 m", "0 m", "0 m"], "radius": "1 m"}), ERROR, "'sphere' cannot stand beside 'box'"),
    ("coordinates without units", changed(OBJECTS + "[1].box.high", [4, 3, 5]), ERROR, "without a unit"),
    ("two coordinates", changed(OBJECTS + "[1].box.high", ["4 m", "3 m"]), ERROR, "a list of 2"),
    ("a decimal comma", changed(CAMERA + ".orthographic.gsd", "0,5 m"), ERROR, 'decimals follow a point, such as "0.5 m"'),
    ("a unit of nothing known", changed(CAMERA + ".orthographic.gsd", "1 yard"), ERROR, "'yard' is not a unit of length"),
    ("a misspelt key", changed(CAMERA + ".orthographic.gds", "1 m"), ERROR, "unknown key 'gds'"),
    ("half a pixel", changed(CAMERA + ".orthographic.pixels", [16.5, 12]), ERROR, "an integer"),
    ("no pixels", changed(CAMERA + ".orthographic.pixels", [0, 12]), ERROR, "between 1 and"),
    ("a horizon seen by parallel rays", changed(CAMERA + ".orthographic.view_zenith", "90 deg"), ERROR, "between 0 and 89 deg"),
    # Temperatures.
    ("degrees Celsius as kelvins", changed(MATERIALS + ".lawn.temperature", "22 K"), WARNING, "the material 'lawn' is 22 K.*is \"22 degC\" meant"),
    ("an object's degrees as kelvins", changed(OBJECTS + "[1].temperature", "30 K"), WARNING, "temperature of 'house'.*30 K"),
    ("a temperature without a unit", changed(MATERIALS + ".lawn.temperature", 295), ERROR, "is the number 295, expected a temperature"),
    ("a temperature below zero", changed(MATERIALS + ".lawn.temperature", "-300 degC"), ERROR, "of at least 0 K"),
    ("a temperature beyond reason", changed(MATERIALS + ".lawn.temperature", "1e10 K"), ERROR, "too large: a temperature here is at most 100000 K"),
    ("thermal channels and a material without one", changed(MATERIALS + ".wall", {"reflectance": 0.5}), WARNING, "no temperature for 'wall'"),
    ("a map of fill values", changed(OBJECTS + "[0].temperature", {"map": {"file": "fill.asc", "unit": "K"}}), ERROR, "3.4e\\+38 K at row 2, column 3 is no temperature.*nodata"),
    ("a map of zeros", changed(OBJECTS + "[0].temperature", {"map": {"file": "zero.asc", "unit": "K"}}), ERROR, "0 K at row 1, column 1"),
    ("a map in degrees as kelvins", changed(OBJECTS + "[0].temperature", {"map": {"file": "celsius.asc", "unit": "K"}}), WARNING, "are their numbers degC"),
    ("a map with holes", changed(OBJECTS + "[0].temperature", {"map": {"file": "holes.asc", "unit": "K"}}), WARNING, "1 of 16 cells hold no number"),
    ("a map of nothing", changed(OBJECTS + "[0].temperature", {"map": {"file": "nothing.asc", "unit": "K"}}), ERROR, "no cell has a temperature"),
    ("a map that says no unit", changed(OBJECTS + "[0].temperature", {"map": {"file": "warm.asc"}}), ERROR, "unit"),
    ("a picture as a map", changed(OBJECTS + "[0].temperature", {"map": {"file": "kiosk.obj", "unit": "K"}}), ERROR, "kiosk.obj"),
    ("a sky of daylight in the thermal", changed("light.sky", {"radiance": "40 W m-2 sr-1 um-1"}), WARNING, "the sky is as bright as a black body of 440 K in 'thermal'"),
    # Light.
    ("no light", several(("light", None), ("sensor.channels", [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}}])),
     ERROR, "nothing shines"),
    ("no sky", changed("light.sky", None), WARNING, "there is no sky"),
    ("no surroundings, seen aslant", several(("light.surroundings", None), (CAMERA + ".orthographic.view_zenith", "60 deg"), (OBJECTS + "[0]", {"polygon": {"vertices": [["-9 m", "-9 m", "0 m"], ["9 m", "-9 m", "0 m"], ["9 m", "9 m", "0 m"], ["-9 m", "9 m", "0 m"]]}, "material": "lawn"})),
     WARNING, "surroundings are not declared"),
    ("a Sun by night", several(("light.sun", {"disc": {}}), ("time", "2026-06-21T00:00:00Z"), ("scene.origin", {"latitude": "47 deg", "longitude": "8 deg"})),
     WARNING, "deg below the horizon"),
    ("a Sun without a place", changed("light.sun", {"disc": {}}), ERROR, "the Sun has no direction"),
    ("an elevation for a zenith angle", changed("light.sun", {"disc": {"elevation": "45 deg", "azimuth": "225 deg"}}), ERROR, "unknown key 'elevation'"),
    ("a zenith angle above 96", changed("light.sun.disc.zenith", "120 deg"), ERROR, "between 0 and 96 deg"),
    ("a time without a zone", several(("time", "2026-06-21 12:00"),), ERROR, "time"),
    ("a sky that has no unit", changed("light.sky", {"radiance": 40}), ERROR, "is the number 40, expected a spectral radiance"),
    ("a sky in another unit", changed("light.sky", {"radiance": "40 W m-2"}), ERROR, "is not a unit of"),
    ("sky and atmosphere", changed("atmosphere", {"profile": "mid-latitude summer"}), ERROR, "sky"),
    ("an atmosphere that nobody knows", several(("light.sky", None), ("atmosphere", {"profile": "summer"})), ERROR, "summer"),
    # Spectra.
    ("a reflectance in percent", changed(MATERIALS + ".lawn.reflectance", 12), ERROR, "12 % is 0.12"),
    ("a reflectance with a percent sign", changed(MATERIALS + ".lawn.reflectance", "12 %"), ERROR, "reflectance"),
    ("a table in percent", changed(MATERIALS + ".lawn", {"reflectance": {"csv": "percent.csv", "wavelength_unit": "um"}, "temperature": "22 degC"}), ERROR, "scale"),
    ("nanometres as micrometres", changed(MATERIALS + ".lawn", {"reflectance": {"csv": "nm.csv", "wavelength_unit": "um"}, "temperature": "22 degC"}), ERROR, "reach from 400 to 15000 um: are they nm"),
    ("micrometres as nanometres", changed(MATERIALS + ".lawn", {"reflectance": {"csv": "um.csv", "wavelength_unit": "nm"}, "temperature": "22 degC"}), ERROR, "are they um"),
    ("decimal commas in a table", changed(MATERIALS + ".lawn", {"reflectance": {"csv": "comma.csv", "wavelength_unit": "um"}, "temperature": "22 degC"}), ERROR, "comma.csv:2.*decimals follow a point"),
    ("a table that ends before the channel", changed(MATERIALS + ".lawn", {"reflectance": {"csv": "short.csv", "wavelength_unit": "um"}, "temperature": "22 degC"}), ERROR, "short.csv|0.4 to 2.5|beyond"),
    ("a negative reflectance", changed(MATERIALS + ".lawn.reflectance", -0.1), ERROR, "between 0 and 1"),
    ("a library material that is not there", changed(MATERIALS + ".lawn", {"reflectance": {"library": "gras"}}), ERROR, "gras"),
    ("reflectance and emissivity", changed(MATERIALS + ".lawn.emissivity", 0.9), ERROR, "reflectance.*emissivity|emissivity.*reflectance"),
    ("more than all light", changed(MATERIALS + ".lawn", {"reflectance": 0.7, "transmittance": 0.6}), ERROR, "above 1|more than 1|exceed"),
    # The sensor.
    ("a channel in nanometres called um", changed("sensor.channels[0].gaussian.center", "650 um"), WARNING, "'red' are above 100 um: are they nm"),
    ("a channel in micrometres called nm", changed("sensor.channels[0].gaussian", {"center": "2.2 nm", "fwhm": "1 nm"}), WARNING, "'red' are below 0.2 um"),
    ("a channel without a unit", changed("sensor.channels[0].gaussian.center", 0.65), ERROR, "without a unit"),
    ("from above to", changed("sensor.channels[1].top_hat", {"from": "12 um", "to": "10 um"}), ERROR, "is not above 'from'"),
    ("no channels", changed("sensor.channels", []), ERROR, "an empty list"),
    ("two channels of a name", changed("sensor.channels[1].name", "red"), ERROR, "two channels are named 'red'"),
    ("an Airy disc of parallel rays", changed("sensor.psf", {"airy": {"aperture": "10 cm", "wavelength": "0.65 um"}}), ERROR, "frame"),
    ("a channel in the dark", several(("light.sun", None), ("light.surroundings", {"reflectance": 0.1, "temperature": "22 degC"})), WARNING, "nothing shines in 'red'"),
    # Sampling and output.
    ("kelvins in the visible", changed("sampling.accuracy", {"error": "0.1 K"}), WARNING, "an accuracy of 0.1 K is asked of 'red'"),
    ("an accuracy without a unit", changed("sampling.accuracy", {"error": 0.1}), ERROR, "with its unit"),
    ("an accuracy of zero", changed("sampling.accuracy", {"error": "0 %"}), ERROR, "above 0"),
    ("a channel to judge that is not there", changed("sampling.accuracy", {"error": "0.1 K", "channel": "tir"}), ERROR, "there is no channel 'tir'"),
    ("noise that nobody declared", changed("sampling.accuracy", {"error": "0.5 noise"}), ERROR, "noise"),
    ("all of the noise and confidence 1", changed("sampling.accuracy", {"error": "1 %", "confidence": 1}), ERROR, "confidence"),
    ("a confidence in percent", changed("sampling.accuracy", {"error": "1 %", "confidence": 95}), ERROR, "confidence"),
    ("two samplers", changed("sampling.grid", {"elements": [2, 2]}), ERROR, "'grid' cannot stand beside 'accuracy'"),
    ("a format of nothing known", changed("output.formats", ["tiff"]), ERROR, "tiff"),
    ("light that is cut short", changed("sampling.max_depth", 1), WARNING, "max_depth 1"),
    # The document itself.
    ("a version of the future", changed("ifov", 2), ERROR, "ifov"),
    ("no version", changed("ifov", None), ERROR, "ifov"),
    ("a detector that is always full", several(("sensor.optics", {"f_number": 2}), ("sensor.detector", {"pitch": "15 um", "integration_time": "1 ms", "quantum_efficiency": 0.7, "full_well": "1 ke-"})),
     WARNING, "the detector of 'thermal' is full wherever it looks: the darkest that is seen makes .* electrons, and it tells at most 1e\\+03"),
    ("a detector that counts nothing", several(("sensor.optics", {"f_number": 2}), ("sensor.detector", {"pitch": "15 um", "integration_time": "1e-4 us", "quantum_efficiency": 0.7, "full_well": "1 Me-", "bits": 12})),
     WARNING, "the detector of 'red' counts nothing: the brightest that is seen makes .* electrons, and a count is 244 of them"),
    ("no sensor", changed("sensor", None), ERROR, "sensor"),
    ("a list for an object", changed("scene", []), ERROR, "scene"),
    ("an object for a temperature", changed("light.sky", {"temperature": {}}), ERROR, "temperature"),
]

FILES = {
    "kiosk.obj": box_obj((-1, -1, 0), (1, 1, 3)),
    "kiosk_mm.obj": box_obj((-1000, -1000, 0), (1000, 1000, 3000)),
    "kiosk_y.obj": box_obj((-1, 0, -1), (1, 3, 1)),
    "kiosk.stl": "solid kiosk\nendsolid kiosk\n",
    "warm.asc": ascii_grid(WARM),
    "fill.asc": ascii_grid([WARM[0], [295, 296, 3.4e38, 298], WARM[0], WARM[0]]),
    "zero.asc": ascii_grid([[0, 296, 297, 298], WARM[0], WARM[0], WARM[0]]),
    "celsius.asc": ascii_grid([[21, 22, 23, 24]] * 4),
    "holes.asc": ascii_grid([WARM[0], [295, -9999, 297, 298], WARM[0], WARM[0]], nodata=-9999),
    "nothing.asc": ascii_grid([[-9999] * 4] * 4, nodata=-9999),
    "percent.csv": "wavelength,reflectance\n0.4,10\n1,12\n15,30\n",
    "nm.csv": "wavelength,reflectance\n400,0.10\n1000,0.12\n15000,0.30\n",
    "um.csv": "wavelength,reflectance\n0.4,0.10\n1,0.12\n15,0.30\n",
    "comma.csv": "wavelength;reflectance\n0,4;0,10\n1,0;0,12\n15,0;0,30\n",
    "short.csv": "wavelength,reflectance\n0.4,0.10\n1,0.12\n2.5,0.30\n",
}


class Mistakes(unittest.TestCase):
    def test_the_good_document_is_good(self):
        with Folder(good=json.dumps(GOOD, indent=1)) as folder:
            done = run("check", folder / "good.json")
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_windows_that_hang_on_a_wall_do_not_float(self):
        with Folder(windows=json.dumps(windows(-3.05), indent=1)) as folder:
            done = run("check", folder / "windows.json")
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_none_passes_in_silence(self):
        with Folder() as folder:
            for name, content in {**FILES, **MORE_FILES}.items():
                (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
            (folder / "folder.obj").mkdir()
            for title, document, kind, words in MISTAKES + MORE_MISTAKES:
                with self.subTest(title):
                    path = folder / "scene.json"
                    path.write_text(document if isinstance(document, str) else json.dumps(document, indent=1))
                    done = run("check", path, "--no-cache")
                    self.assertRegex(done.stderr, re.compile(words, re.DOTALL))
                    if kind == ERROR:
                        self.assertEqual(done.returncode, 1)
                        self.assertRegex(done.stderr, r"scene\.json:\d+:\d+: ")
                        self.assertLess(len(done.stderr), 2000)
                    else:
                        self.assertEqual(done.returncode, 6)
                        self.assertIn("ifov: warning: ", done.stderr)

    def test_strict_makes_warnings_errors(self):
        with Folder(cold=json.dumps(changed(MATERIALS + ".lawn.temperature", "22 K"), indent=1)) as folder:
            self.assertEqual(run("check", folder / "cold.json", "--strict").returncode, 1)
            done = run("render", folder / "cold.json", "--strict")
            self.assertEqual(done.returncode, 1)
            self.assertIn("which --strict makes an error; nothing was done", done.stderr)
            self.assertFalse((folder / "cold.out").exists())


if __name__ == "__main__":
    unittest.main()
