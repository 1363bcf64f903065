"""Every document of the examples, the documentation and the benchmarks, and many that are made by chance, is written so that it
reads back as the same: each key and value that it gives stands in what is written of it with all keys, and what is written is
written the same again."""

import datetime
import functools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/fuzz/documents"))

PROGRAM = pathlib.Path(os.environ.get("IFOV_PROGRAM", ROOT / "build/ifov"))
BUILD = PROGRAM.parent
DEGREE = math.pi / 180
# Units in which the same quantity may be written: number * factor + offset is the same.
UNITS = [
    {"m": 1, "km": 1e3, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "ft": 0.3048, "in": 0.0254, "µm": 1e-6, "μm": 1e-6},
    {"deg": DEGREE, "rad": 1, "mrad": 1e-3, "°": DEGREE},
    {"K": 1, "degC": (1, 273.15), "degF": (5 / 9, 273.15 - 32 * 5 / 9), "°C": (1, 273.15), "mK": 1e-3},
    {"m/s": 1, "m s-1": 1, "km/h": 1 / 3.6, "kn": 1852 / 3600},
    {"hPa": 1, "Pa": 1e-2, "kPa": 10, "mbar": 1, "mb": 1},
    {"g/cm2": 1, "kg/m2": 0.1, "mm": 0.1, "cm": 1, "g cm-2": 1, "kg m-2": 0.1, "g/cm^2": 1},
    {"DU": 1, "atm-cm": 1e3},
    {"ppm": 1, "ppb": 1e-3, "ppmv": 1},
    {"g/kg": 1, "g kg-1": 1},
    {"lm": 1, "klm": 1e3},
    {"px": 1, "pixel": 1, "pixels": 1},
    {"au": 1, "AU": 1},
    {"m-2": 1, "ha-1": 1e-4, "km-2": 1e-6, "m^-2": 1, "per m2": 1, "per ha": 1e-4, "per km2": 1e-6, "/m2": 1, "/ha": 1e-4, "/km2": 1e-6},
    {"W m-2 um-1": 1, "W m-2 nm-1": 1e3, "mW m-2 nm-1": 1, "W/m2/um": 1, "W/m^2/um": 1, "W/(m2 um)": 1, "W m^-2 um^-1": 1, "W/m2/nm": 1e3},
    {"W m-2 sr-1 um-1": 1, "W m-2 sr-1 nm-1": 1e3, "mW m-2 sr-1 nm-1": 1, "uW cm-2 sr-1 nm-1": 10, "W/m2/sr/um": 1, "W/m^2/sr/um": 1,
     "W/(m2 sr um)": 1, "W/(m^2 sr um)": 1, "W m^-2 sr^-1 um^-1": 1, "W/m2/sr/nm": 1e3},
    {"s": 1, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60, "h": 3600, "d": 86400},
    {"Hz": 1, "kHz": 1e3},
    {"e-": 1, "ke-": 1e3, "Me-": 1e6},
    {"e-/s": 1, "fA": 1e-15 / 1.602176634e-19, "pA": 1e-12 / 1.602176634e-19, "nA": 1e-9 / 1.602176634e-19, "A": 1 / 1.602176634e-19},
    {"e-/count": 1, "e-/DN": 1},
    {"W m-1 K-1": 1, "kcal m-1 h-1 K-1": 4186.8 / 3600, "W/m/K": 1, "W/(m K)": 1},
    {"kg/m3": 1, "g/cm3": 1e3, "kg m-3": 1, "g cm-3": 1e3},
    {"J kg-1 K-1": 1, "kJ kg-1 K-1": 1e3, "cal g-1 K-1": 4186.8, "J/kg/K": 1, "J/(kg K)": 1},
    {"W m-2": 1, "kW m-2": 1e3, "W/m2": 1},
    {"s/m": 1, "s m-1": 1},
]
QUANTITY = re.compile(r"^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S.*?)\s*$")


def without_comments(text):
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda match: match[1] or "", text, flags=re.DOTALL)


def read(text):
    return json.loads(without_comments(text.removeprefix("\ufeff")))


def same_number(a, b):
    return math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-300)


def same_text(one, other):
    if one == other or os.path.normpath(one) == os.path.normpath(other):
        return True
    a, b = QUANTITY.match(one), QUANTITY.match(other)
    if a and b:
        for units in UNITS + [{a[2]: 1}]:
            if a[2] in units and b[2] in units:
                values = [float(match[1]) * factor + offset for match in (a, b) for factor, offset in [scale(units[match[2]])]]
                if same_number(*values):
                    return True
    try:
        return time_of(one) == time_of(other)
    except ValueError:
        return False


def scale(unit):
    return unit if isinstance(unit, tuple) else (unit, 0.0)


def time_of(text):
    time = datetime.datetime.fromisoformat(text.replace("Z", "+00:00"))
    return time if time.tzinfo else time.replace(tzinfo=datetime.timezone.utc)


def is_nothing(value):
    """What says the same as no key at all."""
    if isinstance(value, list):
        return all(is_nothing(item) for item in value)
    if isinstance(value, dict):
        return list(value) == ["none"] or all(is_nothing(item) for item in value.values()) or is_nothing(value.get("angle", 1))
    if isinstance(value, str):
        match = QUANTITY.match(value)
        return bool(match) and float(match[1]) == 0 and match[2] not in ("degC", "degF", "°C")
    return not isinstance(value, bool) and value == 0


def differences(given, written, path=""):
    """Keys and values of a document that what was written of it lacks, or has otherwise; both as read from JSON."""
    if isinstance(given, list) and not isinstance(written, list):
        if len(given) == 1 or all(item == given[0] for item in given):  # one instead of a list of one, or of the same thrice
            return differences(given[0], written, path)
        return [f"{path}: {given} became {written}"]
    if isinstance(given, dict) and isinstance(written, str):  # a model without parameters; a prototype without a weight
        return [] if written in given or given.get("prototype") == written else [f"{path}: {given} became {written}"]
    if isinstance(given, str) and isinstance(written, dict):  # a model by its name, with all its parameters
        return [] if given in written else [f"{path}: {given} became {written}"]
    if isinstance(given, dict):
        return [fault for key, value in given.items() for fault in member_differences(key, given, value, written, f"{path}.{key}" if path else key)]
    if isinstance(given, list):
        if path.endswith(".products"):
            return [] if set(given) == set(written) or "all" in given + written else [f"{path}: {given} became {written}"]
        if len(given) != len(written):
            return [f"{path}: {len(given)} became {len(written)}"]
        return [fault for k, (a, b) in enumerate(zip(given, written)) for fault in differences(a, b, f"{path}[{k}]")]
    if isinstance(given, str) and isinstance(written, (int, float)):
        match = re.fullmatch(r"\s*([-+\d.eE]+)\s*%\s*", given)
        same = bool(match) and same_number(float(match[1]) / 100, written)
    elif isinstance(given, str) and isinstance(written, str):
        same = same_text(given, written)
    elif isinstance(given, bool) or isinstance(written, bool):
        same = given is written
    else:
        same = same_number(given, written)
    return [] if same else [f"{path}: {given} became {written}"]


@functools.cache
def former_names():
    """By a key's earlier name the one that is written."""
    schema = subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout
    return dict(re.findall(r'"(\w+)":\s*\{[^{}]*"description":\s*"former name of \'(\w+)\'"', schema))


def member_differences(key, given, value, written, path):
    if path in ("$schema", "output.folder"):
        return []
    if key == "channels" and any(item["series"]["gaussian"]["count"] == 2 for item in value if "series" in item):
        return []  # a series of two is two channels
    if key in ("scale", "unit") and "csv" in given and "unit" in given:
        return []  # one factor
    if key == "curve" and "library" in given and isinstance(value, str):
        return []  # its number
    if key == "axis" and "height" in written:
        return differences(value, ["0 m", "0 m", written["height"]], path)
    if key not in written and former_names().get(key) in written:
        return differences(value, written[former_names()[key]], path)
    if key not in written:
        return [] if is_nothing(value) else [f"{path}: is not written"]
    return differences(value, written[key], path)


def from_anywhere(value, folder, written):
    """The same, with the whole path of files beyond the document's folder where that is what was written."""
    if isinstance(value, dict):
        return {key: from_anywhere(inner, folder, written) for key, inner in value.items()}
    if isinstance(value, list):
        return [from_anywhere(inner, folder, written) for inner in value]
    if isinstance(value, str) and ".." in value:
        whole = os.path.normpath(folder / value)
        return whole if json.dumps(whole) in written else value
    return value


class Rewritten:
    """Documents by their files, and what rewrite_documents made of each: None, or the texts by their names."""

    def __init__(self, files, folder):
        folder.mkdir()
        result = subprocess.run([BUILD / "rewrite_documents", folder, *files], cwd=ROOT, capture_output=True, text=True, check=True)
        self.said = result.stdout.splitlines()
        self.texts = {}
        for k, (file, said) in enumerate(zip(files, self.said)):
            if said == "written":
                name = lambda what: (folder / f"{k}{what}.json").read_text()
                self.texts[file] = {"short": name(""), "again": name(".again"), "all": name(".all"), "from all": name(".from_all")}

    def faults(self, validator=None):
        found = []
        for file, texts in self.texts.items():
            given, every = read((ROOT / file).read_text()), read(texts["all"])
            if texts["again"] != texts["short"]:
                found.append(f"{file}: is written otherwise when it is read again")
            if texts["from all"] != texts["short"]:
                found.append(f"{file}: all keys say something else")
            if len(texts["short"]) > len(texts["all"]):
                found.append(f"{file}: some keys take more room than all")
            if "include" not in given:
                given = from_anywhere(given, (ROOT / file).parent, texts["all"])
                found += [f"{file}: {fault}" for fault in differences(given, every)]
            if validator:
                found += [f"{file}: {error.message}" for text in ("short", "all") for error in validator.iter_errors(read(texts[text]))]
        return found


class WrittenDocuments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def of_the_tree(self):
        """Files that are documents, and those that pages show, each as a file."""
        files = []
        for part in ("examples", "benchmarks", "docs", "tests"):
            for file in sorted((ROOT / part).rglob("*.json")):
                try:
                    if "ifov" in read(file.read_text()):
                        files.append(str(file.relative_to(ROOT)))
                except (ValueError, TypeError, UnicodeDecodeError):
                    continue
        for page in sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]):
            for k, text in enumerate(re.findall(r"^```json\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)):
                file = self.folder / f"{page.stem}_{k}.json"
                file.write_text(text)
                files.append(str(file))
        return files

    def test_documents_of_the_tree(self):
        files = self.of_the_tree()
        rewritten = Rewritten(files, self.folder / "tree")
        self.assertGreater(len(rewritten.texts), 35, rewritten.said)
        self.assertEqual(rewritten.faults(), [])

    def test_documents_made_by_chance(self):
        import seeds
        from generator import Generator
        from schema import Schema
        from writing import written

        (self.folder / "chance").mkdir()
        listed = json.loads(subprocess.run([PROGRAM, "schema"], stdout=subprocess.PIPE, check=True).stdout)
        generator = Generator(Schema(listed), seeds.documents(), seeds.Files(BUILD / "fuzz_readers", self.folder / "chance"))
        files = []
        for number in range(600):
            file = self.folder / "chance" / f"document_{number}.json"
            file.write_text(written(generator.document(3, number)))
            files.append(str(file))
        rewritten = Rewritten(files, self.folder / "chance_written")
        self.assertGreater(len(rewritten.texts), 100)
        self.assertEqual([said for said in rewritten.said if "cannot be written" in said], [])
        try:
            import jsonschema
        except ImportError:
            self.assertEqual(rewritten.faults(), [])
        else:
            self.assertEqual(rewritten.faults(jsonschema.Draft7Validator(listed)), [])


class PlantedFaults(unittest.TestCase):
    """A row that is not written, or says another's value, is found."""

    GIVEN = {"scene": {"origin": {"latitude": "43 deg", "height": "0 m"}, "materials": {"a": {"reflectance": 0.3}}},
             "sampling": {"accuracy": {"error": "1 %", "confidence": 0.9, "pilot_rays": False}}, "channels": ["x", "y"]}

    def change(self, *path, to=None):
        written = json.loads(json.dumps(self.GIVEN))
        inner = written
        for key in path[:-1]:
            inner = inner[key]
        if to is None:
            del inner[path[-1]]
        else:
            inner[path[-1]] = to
        return differences(self.GIVEN, written)

    def test_each(self):
        self.assertEqual(differences(self.GIVEN, self.GIVEN), [])
        self.assertEqual(self.change("scene", "origin", "height"), [])  # 0 m is what it is anyway
        self.assertEqual(self.change("scene", "origin", "latitude", to="4300e-2 deg"), [])
        self.assertEqual(self.change("scene", "origin", "latitude"), ["scene.origin.latitude: is not written"])
        self.assertEqual(self.change("scene", "origin", "latitude", to="44 deg"), ["scene.origin.latitude: 43 deg became 44 deg"])
        self.assertEqual(self.change("scene", "materials", "a", to={"emissivity": 0.3}), ["scene.materials.a.reflectance: is not written"])
        self.assertEqual(self.change("sampling", "accuracy", "error", to="0.01 K"), ["sampling.accuracy.error: 1 % became 0.01 K"])
        self.assertEqual(self.change("sampling", "accuracy", "pilot_rays", to=True), ["sampling.accuracy.pilot_rays: False became True"])
        self.assertEqual(self.change("channels", 0), ["channels: 2 became 1"])
        self.assertEqual(self.change("channels", 0, to="z"), ["channels[0]: x became z"])


if __name__ == "__main__":
    unittest.main()
