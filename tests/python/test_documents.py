"""Dicts as documents: what they are written as, and errors that say where."""

import copy
import datetime
import json
import pathlib
import pickle
import unittest

import numpy as np
import scenes

import ifov
from ifov import _document
from ifov._key_path import key_path_at

COMMENTED = """// a file with comments
{"ifov": 1, /* the first
   version */ "scene": {"materials": {"lawn": {"reflectance": 0.12}},
   "objects": [{"plane": {}, "material": "lawn"},
               {"plane": {}, "material": "lown"}]},
 "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
 "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [8, 8]}},
            "channels": [{"name": "a // b", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}}]},
 "sampling": {"accuracy": {"error": "1 %"}}}
"""


class Written(scenes.InFolder):
    def plain(self, value):
        return json.loads(_document.to_text({"key": value}))["key"]

    def test_values_of_python_and_numpy(self):
        zone = datetime.timezone(datetime.timedelta(hours=2))
        for value, written in (
            (np.float64(0.1), 0.1),
            (np.float32(0.1), 0.1),
            (np.int16(7), 7),
            (np.bool_(True), True),
            (np.array([[1.5, 2.0]]), [[1.5, 2.0]]),
            (np.array([0.1], np.float32), [0.1]),
            ((1, "2 m", None), [1, "2 m", None]),
            (pathlib.Path("a") / "b.obj", "a/b.obj"),
            (datetime.datetime(2026, 6, 21, 12, tzinfo=zone), "2026-06-21T10:00:00Z"),
            (datetime.datetime(2026, 6, 21, 12), "2026-06-21T12:00:00Z"),
            (np.datetime64("2026-06-21T10:00"), "2026-06-21T10:00:00Z"),
        ):
            self.assertEqual(self.plain(value), written)

    def test_quantities_of_pint(self):
        try:
            import pint
        except ImportError:
            self.skipTest("pint is not installed")
        units = pint.UnitRegistry()
        self.assertEqual(self.plain(550 * units.nm), "550 nm")
        self.assertEqual(self.plain(0.55 * units.um), "0.55 um")
        self.assertEqual(self.plain(units.Quantity(22.5, units.degC)), "22.5 degC")
        self.assertEqual(self.plain([0, 0, 3] * units.m), ["0 m", "0 m", "3 m"])
        document = scenes.small()
        document["light"]["sun"]["point"]["zenith"] = 40 * units.deg
        document["sensor"]["camera"]["orthographic"]["gsd"] = 30 * units.cm
        document["scene"]["materials"]["ball"]["temperature"] = units.Quantity(35, units.degC)
        self.assertTrue(ifov.check(document), str(ifov.check(document)))

    def test_what_is_no_value_names_its_key(self):
        for value, words in (
            (float("nan"), "found nan; expected a finite number"),
            (np.inf, "found inf; expected a finite number"),
            (1j, "found complex"),
            (np.datetime64("NaT"), "found NaT"),
            (datetime.date(2026, 6, 21), "found the date 2026-06-21 without a time of day; expected a datetime"),
        ):
            document = scenes.small()
            document["sensor"]["channels"][1]["top_hat"]["to"] = value
            with self.assertRaisesRegex(ifov.DocumentError, words) as caught:
                ifov.check(document)
            self.assertEqual(caught.exception.key_path, "sensor.channels[1].top_hat.to")
            self.assertIn("sensor.channels[1].top_hat.to: found", str(caught.exception))

    def test_a_time_is_taken(self):
        document = scenes.small(time=datetime.datetime(2026, 6, 21, 10, tzinfo=datetime.timezone.utc))
        self.assertTrue(ifov.check(document), str(ifov.check(document)))


class Errors(scenes.InFolder):
    def test_of_a_dict(self):
        document = scenes.small()
        document["light"]["sun"] = {"point": {"zenit": "40 deg", "azimuth": "120 deg"}}
        with self.assertRaises(ifov.DocumentError) as caught:
            ifov.render(document, progress=False)
        error = caught.exception
        self.assertEqual(error.key_path, "light.sun.point.zenit")
        self.assertEqual(error.file, "document.json")
        self.assertIn("did you mean 'zenith'?", str(error))
        shown, caret = error.excerpt.splitlines()
        self.assertEqual(shown[caret.index("^") :], '"zenit": "40 deg",')
        self.assertEqual(json.dumps(document, indent=2).splitlines()[error.line - 1].strip(), '"zenit": "40 deg",')
        self.assertIsInstance(error, ValueError)

    def test_of_a_file_are_in_the_files_lines(self):
        pathlib.Path("scene.json").write_text(COMMENTED, encoding="utf-8")
        document = ifov.read("scene.json")
        self.assertEqual(document["sensor"]["channels"][0]["name"], "a // b")
        with self.assertRaises(ifov.DocumentError) as caught:
            ifov.render(document, progress=False)
        self.assertEqual((caught.exception.file, caught.exception.line), ("scene.json", 5))
        self.assertEqual(caught.exception.key_path, "scene.objects[1].material")
        # Once it is changed it is a text of its own, with the same name.
        document["seed"] = 3
        with self.assertRaises(ifov.DocumentError) as caught:
            ifov.render(document, progress=False)
        self.assertGreater(caught.exception.line, 5)
        self.assertEqual(caught.exception.key_path, "scene.objects[1].material")

    def test_of_what_is_no_json(self):
        pathlib.Path("broken.json").write_text('{"ifov": 1,\n "seed": }', encoding="utf-8")
        with self.assertRaises(ifov.DocumentError) as caught:
            ifov.read("broken.json")
        self.assertEqual((caught.exception.line, caught.exception.column), (2, 10))
        self.assertEqual(caught.exception.excerpt.splitlines()[0].strip(), '"seed": }')
        with self.assertRaises(FileNotFoundError):
            ifov.read("nowhere.json")
        with self.assertRaises(TypeError):
            ifov.render("scene.json", progress=False)

    def test_of_files_that_documents_name(self):
        document = scenes.small()
        document["scene"]["objects"][0] = {"mesh": {"file": "roof.obj"}, "material": "ground"}
        with self.assertRaisesRegex(ifov.DocumentError, "cannot read 'roof.obj'") as caught:
            ifov.render(document, progress=False)
        self.assertEqual(caught.exception.key_path, "scene.objects[0].mesh.file")
        pathlib.Path("roof.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", encoding="utf-8")
        told = ifov.check(document)
        self.assertFalse(told)
        self.assertEqual(len(told.errors), 1)
        self.assertIn("roof.obj:4", told.errors[0])

    def test_warnings(self):
        document = scenes.small()
        del document["light"]["sky"]
        self.assertTrue(ifov.check(document).warnings)
        with self.assertWarns(ifov.SceneWarning):
            ifov.Scene(document)

    def test_check_says_what_the_program_says(self):
        pathlib.Path("scene.json").write_text(json.dumps(scenes.SMALL), encoding="utf-8")
        self.assertEqual(str(ifov.check(ifov.read("scene.json"))) + "\n", self.program("check", "scene.json"))


class Documents(scenes.InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "below").mkdir()
        (self.folder / "below" / "scene.json").write_text(COMMENTED, encoding="utf-8")

    def test_know_their_file(self):
        document = ifov.read("below/scene.json")
        for one in (document, copy.deepcopy(document), copy.copy(document), pickle.loads(pickle.dumps(document))):
            self.assertEqual(one.file, pathlib.Path("below/scene.json"))
            self.assertEqual(one.text(), COMMENTED)
        document["scene"]["objects"][1]["material"] = "lawn"
        self.assertNotEqual(document.text(), COMMENTED)
        self.assertEqual(json.loads(document.text()), dict(document))

    def test_find_files_beside_them(self):
        pathlib.Path("below/roof.obj").write_text("v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n", encoding="utf-8")
        document = ifov.read("below/scene.json")
        document["scene"]["objects"][1] = {"mesh": {"file": "roof.obj"}, "material": "lawn"}
        self.assertTrue(ifov.check(document), str(ifov.check(document)))


class KeyPaths(unittest.TestCase):
    def test_of_places(self):
        text = '{"a": [1, {"b": /* , */ 2}, []],\n "c": {"d,": "x}"}, "e": 5}'
        for where, path in (
            ('"a"', "a"),
            ("1", "a[0]"),
            ('"b"', "a[1].b"),
            ("2", "a[1].b"),
            ("[]", "a[2]"),
            ('"d,"', "c.d,"),
            ('"x}"', "c.d,"),
            ('"e"', "e"),
            ("5", "e"),
        ):
            before = text[: text.index(where)]
            line, column = before.count("\n") + 1, len(before.split("\n")[-1]) + 1
            self.assertTrue(key_path_at(text, line, column).startswith(path), where)
        self.assertEqual(key_path_at(text, 9, 1), "")


if __name__ == "__main__":
    unittest.main()
