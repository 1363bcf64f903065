"""The scene screen's answers before anything is rendered: pictures by rays against geometry worked out here, sensors, mistakes that
are left out, and what a client may cost."""

import json
import math
import os
import pathlib
import socket
import time
import unittest
import urllib.parse

import numpy as np

from viewing import DOME, Refused, Scratch, Viewer, run, write_products

EAST, NORTH = 500000.25, 5400000.5
CENTRE, RADIUS = (10.0, 20.0, 3.0), 2.0  # of a ball; scene frame


def scene(**changes):
    """A ball above a plane and a wall beside it, in map coordinates, without the Sun."""
    x, y, z = CENTRE
    place = [f"{EAST + x!r} m", f"{NORTH + y!r} m", f"{z} m"]
    return {"ifov": 1,
            "scene": {"origin": {"easting": f"{EAST!r} m", "northing": f"{NORTH!r} m"},
                      "materials": {"lawn": {"reflectance": 0.3}, "paint": {"reflectance": 0.7}, "sheet": {"reflectance": 0.1}},
                      "objects": [{"plane": {}, "material": "lawn"},
                                  {"name": "ball", "sphere": {"center": place, "radius": f"{RADIUS} m"}, "material": "paint"},
                                  {"name": "wall", "polygon": {"vertices": [[f"{EAST + 5!r} m", f"{NORTH + v!r} m", f"{w} m"] for v, w in
                                                                            ((15, 0), (25, 0), (25, 4), (15, 4))]}, "material": "sheet"}]},
            "light": {"sky": {"radiance": "10 W m-2 sr-1 um-1"}},
            "sensor": {"camera": {"frame": {"pixels": [40, 20], "focal_length": "100 mm", "pitch": "1 mm",
                                            "position": [f"{EAST!r} m", f"{NORTH!r} m", "100 m"],
                                            "look_at": [f"{EAST!r} m", f"{NORTH!r} m", "0 m"], "up": [0, 1, 0]}},
                       "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]},
            "sampling": {"accuracy": {"error": "1 %"}}, **changes}


class Shown:
    """A document shown, loaded."""

    def __init__(self, document, *arguments, files=None):
        self.scratch = Scratch()
        self.folder = self.scratch.__enter__()
        for name, content in (files or {}).items():
            (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        self.text = document if isinstance(document, str) else json.dumps(document, indent=1)
        (self.folder / "scene.json").write_text(self.text)
        self.viewer = Viewer(self.folder / "scene.json", "--no-browser", *arguments)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.viewer.end()
        self.scratch.__exit__()

    def ready(self, expected="ready"):
        for _ in range(600):
            said = self.viewer.ask("scene")
            if said["state"] != "loading":
                break
            time.sleep(0.05)
        if said["state"] != expected:
            raise AssertionError(f"{said['state']}: {said['failure']}")
        return said

    def line(self, text):
        return self.text[: self.text.index(text)].count("\n") + 1


EYE = {"x": 14.0, "y": 8.0, "z": 6.0, "azimuth": -25.0, "elevation": -14.0, "fov": 50.0, "width": 48, "height": 36}


def direction(eye, u, v):
    """Of the ray through a point of the picture, by the pinhole's definition."""
    a, e = math.radians(eye["azimuth"]), math.radians(eye["elevation"])
    forward = (math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), math.sin(e))
    right = (math.cos(a), -math.sin(a), 0.0)
    up = tuple(right[(k + 1) % 3] * forward[(k + 2) % 3] - right[(k + 2) % 3] * forward[(k + 1) % 3] for k in range(3))
    pixel = 2 * math.tan(math.radians(eye["fov"]) / 2) / eye["height"]
    d = [f + pixel * ((u - eye["width"] / 2) * r + (eye["height"] / 2 - v) * w) for f, r, w in zip(forward, right, up)]
    length = math.hypot(*d)
    return [c / length for c in d]


def met(eye, u, v):
    """(distance, object, cosine at the surface) of the scene() above; (nan, -1, 0): nothing."""
    o, d = (eye["x"], eye["y"], eye["z"]), direction(eye, u, v)
    found = [(math.nan, -1, 0.0)]
    if d[2] < 0:
        found.append((-o[2] / d[2], 0, -d[2]))
    out = [a - b for a, b in zip(o, CENTRE)]
    half = sum(a * b for a, b in zip(out, d))
    under = half * half - sum(a * a for a in out) + RADIUS**2
    if under > 0 and -half - math.sqrt(under) > 0:
        t = -half - math.sqrt(under)
        found.append((t, 1, -sum((a + t * b) * b for a, b in zip(out, d)) / RADIUS))
    t = (5.0 - o[0]) / d[0]
    if t > 0 and 15 < o[1] + t * d[1] < 25 and 0 < o[2] + t * d[2] < 4:
        found.append((t, 2, abs(d[0])))
    return min(found, key=lambda f: math.inf if math.isnan(f[0]) else f[0])


def coded(linear):
    """IEC 61966-2-1."""
    return round(255 * (12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055))


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shown = Shown(scene())
        cls.viewer = cls.shown.viewer
        cls.said = cls.shown.ready()

    @classmethod
    def tearDownClass(cls):
        cls.shown.__exit__()

    def picture(self, paint="reflectance", step=1, **changes):
        eye = {**EYE, **changes}
        window = {"x0": 0, "y0": 0, "x1": eye["width"], "y1": eye["height"], "step": step, "paint": paint}
        about, values = self.viewer.ask("look", **{**eye, **window})
        return about, [values[3 * k : 3 * k + 3] for k in range(len(values) // 3)]

    def test_distances_and_objects_are_those_of_the_geometry(self):
        about, found = self.picture()
        self.assertEqual(about, {"columns": 48, "rows": 36})
        objects, wrong = set(), 0
        for k, (distance, _, one) in enumerate(found):
            far, number, _ = met(EYE, k % 48 + 0.5, k // 48 + 0.5)
            objects.add(number)
            if number != one:
                wrong += 1
            elif number >= 0:
                self.assertLess(abs(distance / far - 1), 2e-6, k)
            else:
                self.assertTrue(math.isnan(distance))
        self.assertEqual(objects, {-1, 0, 1, 2})
        self.assertEqual(wrong, 0)

    def test_colours_are_the_reflectance_by_how_surfaces_face_the_eye(self):
        grey = {0: 0.3, 1: 0.7, 2: 0.1}
        for k, (_, colour, number) in enumerate(self.picture()[1]):
            if number < 0:
                continue
            cosine = met(EYE, k % 48 + 0.5, k // 48 + 0.5)[2]
            expected = coded(grey[int(number)] * (0.42 * (0.75 + 0.25 * cosine) + 0.58 * cosine))
            channels = [int(colour) >> shift & 255 for shift in (16, 8, 0)]
            self.assertLess(max(abs(c - expected) for c in channels), 2, k)

    def test_coarse_pixels_are_pixels_of_the_fine_picture(self):
        fine = self.picture("material")[1]
        about, coarse = self.picture("material", step=5)
        self.assertEqual(about, {"columns": 10, "rows": 8})
        for k, values in enumerate(coarse):
            u, v = min(5 * (k % 10) + 2, 47), min(5 * (k // 10) + 2, 35)
            self.assertEqual(repr(values), repr(fine[48 * v + u]))

    def test_materials_and_objects_have_colours_of_their_own(self):
        for paint in ("material", "object"):
            # Of surfaces that face alike the largest channel tells the hue.
            hues = {}
            for _, colour, number in self.picture(paint)[1]:
                r, g, b = (int(colour) >> shift & 255 for shift in (16, 8, 0))
                hues.setdefault(number, set()).add((r > g, g > b, r > b))
            self.assertEqual(len({tuple(sorted(hues[n])) for n in (0, 1, 2)}), 3, hues)

    def test_a_click_names_object_material_and_position(self):
        for u, v in ((24.5, 18.5), (3.2, 9.9), (20.0, 33.0), (30.7, 12.1)):
            far, number, cosine = met(EYE, u, v)
            picked = self.viewer.ask("pick", **EYE, u=u, v=v)
            self.assertEqual(picked["hit"], number >= 0)
            if number < 0:
                continue
            self.assertEqual(picked["object"], number)
            self.assertEqual(picked["name"], ("a plane", "ball", "wall")[number])
            self.assertEqual(picked["materials"], [{"name": ("lawn", "paint", "sheet")[number], "share": 1}])
            self.assertEqual(picked["file"], self.said["file"])
            self.assertEqual(picked["line"], self.shown.line(('"plane"', '"name": "ball"', '"name": "wall"')[number]) - 1)
            self.assertAlmostEqual(picked["distance"], far, places=6)
            at = [o + far * d for o, d in zip((EYE["x"], EYE["y"], EYE["z"]), direction(EYE, u, v))]
            for found, expected, offset in zip(picked["position"], at, (EAST, NORTH, 0)):
                self.assertAlmostEqual(found, expected + offset, places=5)
            self.assertAlmostEqual(-sum(n * d for n, d in zip(picked["normal"], direction(EYE, u, v))), cosine, places=6)

    def test_where_the_sensor_stands_and_what_it_sees(self):
        sensor = self.said["sensor"]
        self.assertEqual((sensor["kind"], sensor["width"], sensor["height"], sensor["parallel"], sensor["track"]), ("image", 40, 20, False, []))
        # 100 m above the plane a pixel is 1 m.
        expected = [(-20, 10), (20, 10), (20, -10), (-20, -10)]
        for corner, (x, y) in zip(sensor["corners"], expected):
            self.assertEqual(corner["from"], [0, 0, 100])
            for found, value in zip(corner["to"], (x, y, 0)):
                self.assertAlmostEqual(found, value, places=6)
        outline = [sensor["outline"][k : k + 3] for k in range(0, len(sensor["outline"]), 3)]
        for x, y, z in outline:
            self.assertAlmostEqual(z, 0.0, places=9)
            self.assertAlmostEqual(max(abs(x) / 20, abs(y) / 10), 1.0, places=6)
        self.assertEqual(self.said["offset"], [EAST, NORTH, 0])
        self.assertEqual([round(v, 6) for v in self.said["low"] + self.said["high"]], [5, 15, 0, 12, 25, 5])


class Suns(unittest.TestCase):
    def test_the_suns_shadow(self):
        document = scene()
        document["light"]["sun"] = {"point": {"zenith": "45 deg", "azimuth": "90 deg", "distance": "1 au", "spectrum": "1000 W m-2 um-1"}}
        with Shown(document) as shown:
            said = shown.ready()
            for found, expected in zip(said["sun"], (math.sqrt(0.5), 0, math.sqrt(0.5))):
                self.assertAlmostEqual(found, expected, places=9)
            # From above: the ball's shadow lies 3 m west of it; where the plane is lit it faces the Sun at 45 degrees.
            above = {"y": 20.0, "z": 2.5, "azimuth": 0, "elevation": -90, "fov": 1, "width": 1, "height": 1, "x0": 0, "y0": 0, "x1": 1, "y1": 1, "step": 1, "paint": "reflectance"}
            for x, lit in ((7.0, False), (13.0, True)):
                _, (distance, colour, number) = shown.viewer.ask("look", x=x, **above)
                self.assertEqual((round(distance, 4), number), (2.5, 0))
                self.assertLess(abs((int(colour) & 255) - coded(0.3 * (0.42 + 0.58 * math.sqrt(0.5) * lit))), 2)


class Sensors(unittest.TestCase):
    def sensor(self, camera, platform=None, files=None, **changes):
        document = scene(**changes)
        del document["scene"]["origin"]
        document["scene"]["objects"] = document["scene"]["objects"][:1]
        document["sensor"] = {"channels": document["sensor"]["channels"], **camera}
        if platform:
            document["platform"] = platform
        with Shown(document, files=files) as shown:
            said = shown.ready()
            self.assertEqual(said["faults"], [])
            return said["sensor"]

    def test_a_line_scanner_moves(self):
        sensor = self.sensor({"camera": {"pushbroom": {"pixels": [24, 32], "focal_length": "1 m", "pitch": "0.1 mm", "line_period": "10 ms"}}},
                             {"straight": {"frame": "scene", "position": ["0 m", "0 m", "5000 m"], "velocity": ["0 m/s", "50 m/s", "0 m/s"]}})
        self.assertAlmostEqual(sensor["duration"], 0.31, places=9)
        track = [sensor["track"][k : k + 3] for k in range(0, len(sensor["track"]), 3)]
        for k, (x, y, z) in enumerate(track):
            self.assertAlmostEqual(x, 0, places=6)
            self.assertAlmostEqual(y, 50 * 0.32 * k / (len(track) - 1), delta=0.26)  # to half a line
            self.assertAlmostEqual(z, 5000, places=6)
        self.assertEqual(sorted(p[1] for p in track), [p[1] for p in track])
        # 5 km x 0.1 mm / 1 m = 0.5 m a pixel; the first line lies behind, and the left wing is where the image's right is.
        for corner, (x, y) in zip(sensor["corners"], ((6, 0), (-6, 0), (-6, 16), (6, 16))):
            self.assertAlmostEqual(corner["to"][0], x, delta=0.01)
            self.assertAlmostEqual(corner["to"][1], y, delta=0.3)

    def test_parallel_rays(self):
        sensor = self.sensor({"camera": {"orthographic": {"gsd": "2 m", "pixels": [10, 6]}}})
        self.assertTrue(sensor["parallel"])
        for corner, (x, y) in zip(sensor["corners"], ((-10, 6), (10, 6), (10, -6), (-10, -6))):
            for found, value in zip(corner["to"], (x, y, 0)):
                self.assertAlmostEqual(found, value, places=6)

    def test_without_a_camera(self):
        points = self.sensor({"points": {"at": [{"position": ["1 m", "2 m", "3 m"], "normal": [0, 0, 1]}, {"position": ["0 m", "0 m", "1 m"], "normal": [1, 0, 0]}]}})
        self.assertEqual((points["kind"], points["count"], points["corners"]), ("points", 2, []))
        for view, position, normal in zip(points["views"], ((1, 2, 3), (0, 0, 1)), ((0, 0, 1), (1, 0, 0))):
            self.assertLess(math.dist(view["from"], position), 2e-4)
            self.assertLess(math.dist(view["direction"], normal), 1e-9)
            self.assertNotIn("to", view)
        rays = self.sensor({"rays": {"file": "rays.csv"}}, files={"rays.csv": "x_m,y_m,z_m,dx,dy,dz\n0,0,5,0,0,-2\n1,2,5,1,0,-1\n0,0,5,1,0,1\n"})
        self.assertEqual((rays["kind"], rays["count"]), ("rays", 3))
        self.assertLess(math.dist(rays["views"][1]["to"], (6, 2, 0)), 1e-6)
        self.assertNotIn("to", rays["views"][2])
        area = self.sensor({"distant": {"directions": [{"zenith": "60 deg", "azimuth": "90 deg"}], "size": ["10 m", "4 m"]}})
        self.assertEqual(area["kind"], "directions")
        for found, expected in zip(area["views"][0]["direction"], (-math.sin(math.pi / 3), 0, -0.5)):
            self.assertAlmostEqual(found, expected, places=9)
        xs, ys = area["outline"][0::3], area["outline"][1::3]
        self.assertEqual([round(v, 6) for v in (min(xs), max(xs), min(ys), max(ys))], [-5, 5, -2, 2])

    def test_a_sensor_that_sees_past_the_scene(self):
        sensor = self.sensor({"camera": {"frame": {"pixels": [4, 4], "focal_length": "10 mm", "pitch": "5 mm", "position": ["0 m", "0 m", "2 m"],
                                                   "look_at": ["0 m", "10 m", "2 m"], "up": [0, 0, 1]}}})
        self.assertEqual([("to" in corner) for corner in sensor["corners"]], [False, False, True, True])
        self.assertIn(None, sensor["outline"])


class Mistakes(unittest.TestCase):
    def said(self, document, expected="ready", **named):
        with Shown(document, **named) as shown:
            said = shown.ready(expected)
            for fault in said["faults"]:
                fault["at"] = shown.text.splitlines()[fault["line"] - 1].strip() if fault["line"] else ""
            if expected == "ready":
                said["seen"] = [shown.viewer.ask("pick", x=x, y=y, z=50, azimuth=0, elevation=-90, fov=1, width=1, height=1, u=0.5, v=0.5)
                                for x, y in ((10, 20), (40, 40))]
            return said

    def test_an_object_that_is_wrong_is_left_out_and_said(self):
        document = scene()
        document["scene"]["objects"][1]["sphere"]["radius"] = "2 K"
        document["scene"]["objects"].append({"name": "cube", "material": "paint", "box": {"low": [f"{EAST + 39.5} m", f"{NORTH + 39.5} m", "6 m"],
                                             "high": [f"{EAST + 40.5} m", f"{NORTH + 40.5} m", "8 m"]}})
        said = self.said(document)
        (fault,) = said["faults"]
        self.assertEqual((fault["instead"], fault["at"]), ("'scene.objects[1]' is left out", '"radius": "2 K"'))
        self.assertIn("2 K", fault["text"])
        self.assertEqual(said["seen"][0]["name"], "a plane")
        # What comes behind it keeps its number.
        self.assertEqual((said["seen"][1]["name"], said["seen"][1]["object"]), ("cube", 3))

    def test_files_that_are_missing_and_materials_that_are_unknown(self):
        document = scene()
        document["scene"]["objects"] += [{"mesh": {"file": "gone.obj"}, "material": "lawn"}]
        document["scene"]["objects"][1]["material"] = "pain"
        document["scene"]["materials"]["sheet"] = {"reflectance": {"file": "gone.csv"}}
        said = self.said(document)
        self.assertEqual(sorted(f["instead"] for f in said["faults"]),
                         ["'scene.objects[1]' is shown grey", "'scene.objects[3]' is left out", "material 'sheet' is shown grey"])
        self.assertIn("gone.obj", " ".join(f["text"] for f in said["faults"]))
        self.assertEqual((said["seen"][0]["name"], said["seen"][0]["materials"][0]["name"]), ("ball", "(unknown)"))

    def test_what_is_wrong_beside_the_scene(self):
        for change, instead in (({"sensor": {}}, "no sensor is shown"), ({"sampling": {"accuracy": {"error": "1 furlong"}}}, "'sampling' is left out"),
                                ({"nonsense": 3}, "'nonsense' is left out"), ({"light": {"sun": {"disc": {"zenith": "95 K"}}}}, "'light' is left out")):
            said = self.said(scene(**change))
            self.assertEqual([f["instead"] for f in said["faults"]], [instead])
            self.assertEqual("sensor" in said, "sensor" not in change)
            self.assertEqual(said["seen"][0]["name"], "ball")
        document = scene()
        del document["sensor"]
        said = self.said(document)
        self.assertEqual([f["instead"] for f in said["faults"]], ["no sensor is shown"])
        self.assertNotIn("sensor", said)

    def test_nothing_is_left(self):
        said = self.said('{"ifov": 1,\n "scene": {,}}', "failed")
        self.assertIn("scene.json:2:", said["failure"])
        said = self.said('{"ifov": 1}', "failed")
        self.assertIn("scene", said["failure"])
        with Shown('{"ifov": 1}') as shown:
            shown.ready("failed")
            with self.assertRaisesRegex(Refused, "^409: .*scene"):
                shown.viewer.ask("look", **EYE, x0=0, y0=0, x1=1, y1=1, step=1, paint="object")

    def test_a_document_that_is_right_has_no_faults(self):
        self.assertEqual(self.said(scene())["faults"], [])
        with Shown(DOME) as shown:
            said = shown.ready()
            self.assertEqual((said["faults"], said["sensor"]["width"]), ([], 3))

    def test_files_elsewhere_are_not_read_for_strangers(self):
        document = scene()
        with Scratch() as elsewhere:
            (elsewhere / "secret.obj").write_text("v 0 0 9\nv 50 0 9\nv 0 50 9\nf 1 2 3\n")
            document["scene"]["objects"].append({"mesh": {"file": str(elsewhere / "secret.obj")}, "material": "lawn"})
            self.assertEqual(self.said(document)["faults"], [])
            with Scratch() as below:
                (below / "scene.json").write_text(json.dumps(document))
                with Viewer(below / "scene.json", "--no-browser", "--inputs-below", below) as viewer:
                    while (said := viewer.ask("scene"))["state"] == "loading":
                        time.sleep(0.05)
                    self.assertEqual([f["instead"] for f in said["faults"]], ["'scene.objects[3]' is left out"])
                    self.assertIn("--inputs-below", said["faults"][0]["text"])


def hills(size=400):
    """A scene with a mesh, and the mesh."""
    lines = [f"v {x} {y} {(x * y) % 7}" for y in range(size) for x in range(size)]
    lines += [f"f {y * size + x + 1} {y * size + x + 2} {y * size + x + size + 1}" for y in range(size - 1) for x in range(size - 1)]
    document = scene()
    del document["scene"]["origin"]
    document["scene"]["objects"] = [document["scene"]["objects"][0], {"name": "hills", "mesh": {"file": "hills.obj"}, "material": "lawn"}]
    document["sensor"]["camera"]["frame"] |= {"position": ["0 m", "0 m", "100 m"], "look_at": ["0 m", "0 m", "0 m"]}
    return document, {"hills.obj": "\n".join(lines) + "\n"}


def many_hills(size=1100):
    """The same of more triangles than are given their trees at once, as binary PLY."""
    row, column = np.mgrid[0:size, 0:size]
    points = np.stack([column, row, (row * column) % 7], -1).astype("<f4")
    first = (row * size + column)[:-1, :-1].ravel()
    corners = np.concatenate([np.stack([first, first + 1, first + size], -1), np.stack([first + 1, first + size + 1, first + size], -1)])
    faces = np.zeros(len(corners), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, corners
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {size * size}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    document, _ = hills(2)
    document["scene"]["objects"][1]["mesh"]["file"] = "hills.ply"
    return document, {"hills.ply": head.encode() + points.tobytes() + faces.tobytes()}


class Loading(unittest.TestCase):
    def test_what_a_document_names_is_loaded_when_it_is_wanted(self):
        """And by one at a time: the checks come after the picture."""
        document, files = many_hills()
        with Shown(document, files=files) as shown:
            def processor_s():
                words = pathlib.Path(f"/proc/{shown.viewer.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
                return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

            shown.viewer.ask("sources")
            time.sleep(1)
            self.assertLess(processor_s(), 0.3)
            waited = 0
            while shown.viewer.ask("scene")["state"] == "loading":
                self.assertFalse(shown.viewer.ask("document", source=0)["checked"])
                self.assertNotIn("triangles", str(shown.viewer.ask("document", source=0)["messages"]))
                waited += 1
                time.sleep(0.02)
            self.assertGreater(waited, 3)
            for _ in range(600):
                said = shown.viewer.ask("document", source=0)
                if said["checked"]:
                    break
                time.sleep(0.05)
            self.assertIn(f"{2 * 1099 ** 2} triangles", str(said["messages"]))

    def test_progress_is_told(self):
        document, files = hills()
        with Shown(document, files=files) as shown:
            phases = []
            while (said := shown.viewer.ask("scene"))["state"] == "loading":
                if not phases or phases[-1][0] != said["phase"]:
                    phases.append((said["phase"], said["done"], said["of"]))
            self.assertTrue(any(phase.startswith("'hills' (line ") and (done, of) == (1, 2) for phase, done, of in phases), phases)
            self.assertGreater(said["elapsed"], 0)
            self.assertIn("triangles", said["statement"])

    def test_the_program_ends_while_it_loads_and_while_it_traces(self):
        with Shown(scene()) as shown:
            shown.viewer.ask("scene")
            self.assertEqual(shown.viewer.end()[0], 0)


class Bounds(unittest.TestCase):
    MOST = 1 << 17

    @classmethod
    def setUpClass(cls):
        cls.shown = Shown(scene())
        cls.viewer = cls.shown.viewer
        cls.shown.ready()

    @classmethod
    def tearDownClass(cls):
        cls.shown.__exit__()

    LOOK = {**EYE, "x0": 0, "y0": 0, "x1": 4, "y1": 4, "step": 1, "paint": "object"}

    def test_who_may_not_ask(self):
        for name in ("scene", "look", "pick"):
            path = f"/api/{name}?{urllib.parse.urlencode({**self.LOOK, 'u': 1, 'v': 1})}"
            self.assertEqual(self.viewer.request(path)[0], 200)
            self.assertEqual(self.viewer.request(path, token=False)[0], 403)
            self.assertEqual(self.viewer.request(path, token="0" * 32)[0], 403)
            self.assertEqual(self.viewer.request(path, method="POST")[0], 405)
            self.assertEqual(self.viewer.request(path, host="attacker.example")[0], 421)
            self.assertEqual(self.viewer.request(path, headers={"Origin": "http://attacker.example"})[0], 403)
            self.assertEqual(self.viewer.request(path, headers={"Sec-Fetch-Site": "cross-site"})[0], 403)

    def test_numbers_out_of_range(self):
        for key, value in (("x", "nan"), ("x", "inf"), ("x", "-inf"), ("y", "1e999"), ("z", "1e9"), ("x", "0x10"), ("x", ""), ("x", " 1"), ("x", "1,5"), ("x", "1" * 5000),
                           ("elevation", "90.5"), ("azimuth", "361"), ("fov", "0"), ("fov", "179"), ("width", 0), ("width", 8193), ("height", "1e3"), ("step", 0), ("x1", 49), ("y0", -1)):
            with self.assertRaises(Refused) as refused:
                self.viewer.ask("look", **{**self.LOOK, key: value})
            self.assertEqual(refused.exception.status, 400, (key, value))
            self.assertRegex(refused.exception.why, rf"^'{key}' is '{str(value)[:40]}'; expected a (whole )?number from ")
        with self.assertRaisesRegex(Refused, "expected 'reflectance', 'material' or 'object'"):
            self.viewer.ask("look", **{**self.LOOK, "paint": "<b>"})
        for key, value in (("u", "49"), ("v", "-0.1"), ("u", "nan")):
            with self.assertRaisesRegex(Refused, f"^400: '{key}' is '{value}'"):
                self.viewer.ask("pick", **{**EYE, "u": 1, "v": 1, key: value})
        with self.assertRaisesRegex(Refused, f"^400: 8192 x 8192 rays are asked for; expected {self.MOST} at most"):
            self.viewer.ask("look", **{**self.LOOK, "width": 8192, "height": 8192, "x1": 8192, "y1": 8192})

    def test_a_folder_has_no_scene(self):
        with Scratch() as folder:
            write_products(folder / "out")
            with Viewer(folder / "out", "--no-browser") as viewer:
                for name, query in (("scene", {}), ("look", self.LOOK), ("pick", {**EYE, "u": 1, "v": 1})):
                    with self.assertRaisesRegex(Refused, "^404: no document is shown"):
                        viewer.ask(name, **query)

    def test_who_goes_spoils_nothing(self):
        """Not even while the trees of a large mesh are made, as the first rays come near."""
        document, files = many_hills()
        look = {"x": 500, "y": -300, "z": 400, "azimuth": 0, "elevation": -40, "fov": 60, "width": 400, "height": 300, "x0": 0, "y0": 0, "x1": 400, "y1": 300,
                "step": 1, "paint": "object"}
        with Shown(document, files=files) as shown:
            self.assertIn("chunks of large meshes, each built when a ray comes near", shown.ready()["statement"])
            for pause in (0.0, 0.005, 0.01, 0.02, 0.04):
                for connection in self.send(shown.viewer, {**look, "fov": 1 + 1000 * pause}, 1):
                    time.sleep(pause)
                    connection.close()
            _, values = shown.viewer.ask("look", **look)
            self.assertEqual({1.0}, set(values[2::3]) & {1.0})

    def send(self, viewer, query, clients):
        """Connections that have asked and not read."""
        head = f"GET /api/look?{urllib.parse.urlencode(query)} HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Ifov-Token: {viewer.token}\r\nConnection: close\r\n\r\n"
        connections = [socket.create_connection((viewer.host, viewer.port)) for _ in range(clients)]
        for connection in connections:
            connection.sendall(head.encode())
        return connections

    def rays_of(self, clients, gone):
        """How many rays are traced for clients that ask for the most at once, and then close their connections, or do not."""
        before = self.viewer.ask("scene")["rays"]
        connections = self.send(self.viewer, {**self.LOOK, "width": 512, "height": 256, "x1": 512, "y1": 256}, clients)
        for connection in connections:
            if not gone:
                while connection.recv(1 << 16):
                    pass
            connection.close()
        last = -1
        while (now := self.viewer.ask("scene")["rays"]) != last:
            last = now
            time.sleep(0.3)
        return now - before

    def test_work_stops_when_the_client_goes(self):
        self.assertEqual(self.rays_of(10, gone=False), 10 * self.MOST)
        self.assertLess(self.rays_of(10, gone=True), 4 * self.MOST)
        # And the next is answered at once.
        begin = time.monotonic()
        self.viewer.ask("look", **self.LOOK)
        self.assertLess(time.monotonic() - begin, 2)


if __name__ == "__main__":
    unittest.main()
