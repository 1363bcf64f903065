"""The published JSON Schema against the reader: an independent validator judges the same documents."""

import copy
import json
import re
import unittest

from program import DOME, ROOT, Folder, run

try:
    import jsonschema
except ImportError:
    jsonschema = None

# Uses every section; needs no other file, so that only its own content decides.
WHOLE = {
    "$schema": "./ifov.schema.json",
    "ifov": 1,
    "seed": 3,
    "time": "2026-06-21T17:00:00Z",
    "scene": {
        "origin": {"latitude": "43 deg", "longitude": "-77 deg", "height": "10 m"},
        "materials": {
            "soil": {"reflectance": 0.2, "temperature": "20 degC", "scattering": "lambertian"},
            "roof": {
                "emissivity": {"table": {"wavelength": ["0.3 um", "15 um"], "values": [0.9, 0.95]}, "outside": "extend"},
                "temperature": "310 K",
            },
        },
        "prototypes": {"hut": [{"box": {"low": ["0 m", "0 m", "0 m"], "high": ["1 m", "1 m", "1 m"]}, "material": "roof"}]},
        "objects": [
            {"plane": {"height": "0 m"}, "material": "soil"},
            {"name": "ball", "sphere": {"center": ["0 m", "0 m", "1 m"], "radius": "50 cm"}, "material": "roof", "pilot_ray": True},
            {
                "cylinder": {"base": ["3 m", "0 m", "0 m"], "height": "1 m", "radius": "1 ft", "capped": False},
                "material": "roof",
                "temperature": "300 K",
                "transform": {"translate": ["1 m", "0 m", "0 m"], "rotate": {"axis": [0, 0, 1], "angle": "30 deg"}, "scale": [1, 1, 2]},
            },
            {"disk": {"center": ["0 m", "3 m", "2 m"], "normal": [0, 0, 1], "radius": "1 m"}, "material": "roof"},
            {"polygon": {"vertices": [["5 m", "0 m", "1 m"], ["6 m", "0 m", "1 m"], ["5 m", "1 m", "1 m"]]}, "material": "roof"},
            {"instances": {"of": "hut", "at": [["-3 m", "0 m", "0 m"]]}},
        ],
    },
    "light": {
        "sun": {"disc": {"zenith": "30 deg", "azimuth": "180 deg", "diameter": "0.53 deg", "distance": "1 au", "spectrum": "1800 W m-2 um-1"}},
        "sky": {"radiance": "10 W/m2/sr/um"},
        "surroundings": {"reflectance": 0.1, "temperature": "280 K"},
    },
    "atmosphere": {"tabulated": {"transmittance": 0.9, "path_radiance": "1 W m-2 sr-1 um-1", "sun_transmittance": 0.8}},
    "sensor": {
        "camera": {
            "frame": {
                "focal_length": "50 mm",
                "pitch": "50 um",
                "pixels": [4, 3],
                "position": ["0 m", "0 m", "100 m"],
                "look_at": ["0 m", "0 m", "0 m"],
                "up": [0, 1, 0],
            }
        },
        "channels": [
            {"name": "red", "gaussian": {"center": "650 nm", "fwhm": "20 nm"}},
            {"top_hat": {"from": "0.8 um", "to": "0.9 um"}},
            {"monochromatic": {"at": "8.5 um"}},
            {"series": {"gaussian": {"from": "400 nm", "to": "450 nm", "count": 2, "fwhm": "10 nm"}}},
        ],
        "psf": {"gaussian": {"sigma": "0.5 px"}},
        "fill_factor": "90 %",
    },
    "sampling": {"adaptive": {"sub_elements": [2, 2], "allowed_difference": "2 %", "max_samples": 16, "channel": "red"}, "tile": 16, "max_depth": 3, "mirror_reflections": 1},
    "output": {"folder": "out", "formats": ["envi"], "quicklook": {"channels": ["red"]}},
}

# What a schema cannot say, and the reader does.
READER_ONLY = re.compile(
    r"there is no (material|prototype|channel)|two channels are named|needs a 'frame' camera|has no direction"
    r"|outside the plane|enclose no area|is not above|where the camera itself is|has no length|has two channels"
    r"|values for \d+ wavelengths|does not rise|'time'|a temperature of at least 0 K|an angle between"
    r"|has no reflectance of its own"
)


def verdicts(documents):
    """For each document, empty where the reader takes it, else its message."""
    with Folder(**{f"d{i}": json.dumps(document, indent=1) for i, document in enumerate(documents)}) as folder:
        done = run("check", "--quiet", *(f"d{i}.json" for i in range(len(documents))), cwd=folder)
    if done.returncode not in (0, 1, 6):
        raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
    messages = [""] * len(documents)
    for message in re.split(r"^(?=d\d+\.json)", done.stderr, flags=re.MULTILINE):
        named = re.match(r"d(\d+)\.json", message)
        if named:
            messages[int(named[1])] = message
    return messages


def places(value, path=()):
    """Paths of values within a document, itself left out; of alike items of a list, the first."""
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        if isinstance(key, int) and key > 0 and not isinstance(child, dict):
            continue
        yield (*path, key)
        yield from places(child, (*path, key))


def changed(path, change):
    """The whole document with change(container, key) done at a path."""
    document = copy.deepcopy(WHOLE)
    container = document
    for key in path[:-1]:
        container = container[key]
    change(container, path[-1])
    return document


def rename(container, key):
    container[key + "_"] = container.pop(key)


def remove(container, key):
    del container[key]


def negate(container, key):
    container[key] = "-" + container[key] if isinstance(container[key], str) else -1


def with_value(value):
    return lambda container, key: container.__setitem__(key, value)


@unittest.skipIf(jsonschema is None, "python3-jsonschema is not installed")
class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(run("schema").stdout)
        cls.validator = jsonschema.Draft7Validator(cls.schema)

    def test_is_a_valid_schema(self):
        jsonschema.Draft7Validator.check_schema(self.schema)

    def test_both_accept_good_documents(self):
        plain = json.loads(re.sub(r"//.*", "", DOME))
        for document in (WHOLE, plain):
            self.assertEqual([error.message for error in self.validator.iter_errors(document)], [])
            self.assertEqual(verdicts([document]), [""])

    def test_accepts_every_example(self):
        examples = sorted((ROOT / "examples").glob("*.json"))
        self.assertTrue(examples)
        for example in examples:
            text = re.sub(r"^\s*//.*$|\s//\s.*$", "", example.read_text(), flags=re.MULTILINE)
            errors = [f"{list(error.absolute_path)}: {error.message}" for error in self.validator.iter_errors(json.loads(text))]
            self.assertEqual(errors, [], example)

    def test_explains_every_key(self):
        for name, definition in self.schema["definitions"].items():
            self.assertTrue(definition["description"], name)
            self.assertIs(definition["additionalProperties"], False, name)
            for key, value in definition["properties"].items():
                self.assertTrue(value["description"], f"{name}.{key}")

    def test_defaults_are_valid_values(self):
        for name, definition in self.schema["definitions"].items():
            for key, value in definition["properties"].items():
                if "default" in value:
                    one = {**value, "definitions": self.schema["definitions"]}
                    self.assertTrue(jsonschema.Draft7Validator(one).is_valid(value["default"]), f"{name}.{key}")

    def agree(self, changes):
        """Changes, each (path, function), on which schema and reader agree; the reader's messages.

        What the schema refuses, the reader refuses; what the reader alone refuses is known to be beyond a schema.
        """
        documents = [changed(path, change) for path, change in changes]
        messages = verdicts(documents)
        for (path, _), document, message in zip(changes, documents, messages):
            place = ".".join(map(str, path))
            if not self.validator.is_valid(document):
                self.assertNotEqual(message, "", f"the schema refuses a change at {place}, the reader does not")
            elif message:
                self.assertRegex(message, READER_ONLY, f"the reader refuses a change at {place}, the schema does not")
        return messages

    def test_agrees_with_the_reader_on_misspelt_keys(self):
        chosen_by_the_user = (("scene", "materials"), ("scene", "prototypes"))
        keys = [path for path in places(WHOLE) if isinstance(path[-1], str) and path[:-1] not in chosen_by_the_user]
        for message in self.agree([(path, rename) for path in keys]):
            self.assertIn("unknown key", message)

    def test_agrees_with_the_reader_on_missing_values(self):
        messages = self.agree([(path, remove) for path in places(WHOLE)])
        self.assertGreater(sum(message != "" for message in messages), 50)
        self.assertGreater(sum(message == "" for message in messages), 20)

    def test_agrees_with_the_reader_on_wrong_types(self):
        self.assertNotIn("", self.agree([(path, with_value(None)) for path in places(WHOLE)]))

    def test_agrees_with_the_reader_on_units(self):
        changes = []
        for path in places(WHOLE):
            value = WHOLE
            for key in path:
                value = value[key]
            if isinstance(value, str) and re.match(r"^-?[\d.]+ ", value):
                changes += [(path, change) for change in (with_value(1.5), with_value("1.5"), with_value("1.5 parsec"), negate)]
        self.assertGreater(len(changes), 100)
        messages = self.agree(changes)
        self.assertNotIn("", messages[2::4])

    def test_agrees_with_the_reader_on_two_of_a_kind(self):
        changes = [
            (path, lambda container, _, key=key, value=value: container.__setitem__(key, value))
            for path, key, value in (
                (("scene", "objects", 0, "plane"), "disk", {}),
                (("scene", "materials", "soil", "reflectance"), "emissivity", 1),
                (("light", "sky", "radiance"), "none", {}),
                (("sampling", "adaptive"), "single", {}),
                (("sensor", "psf", "gaussian"), "none", {}),
            )
        ]
        for message in self.agree(changes):
            self.assertIn("cannot stand beside", message)


if __name__ == "__main__":
    unittest.main()
