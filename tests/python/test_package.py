"""The package as it is installed: what importing it brings, its types, and its neighbours in one process."""

import ast
import importlib.metadata
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import scenes

import ifov

PACKAGE = scenes.ROOT / "python" / "ifov"


def run(code, **environment):
    """What a process of its own prints."""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, env=os.environ | environment, cwd="/"
    )
    return done.stdout.strip() if done.returncode == 0 else f"{done.returncode}: {done.stdout}{done.stderr}"


class Package(unittest.TestCase):
    def test_is_that_of_this_tree(self):
        """Else `make python` has to be run again."""
        installed = pathlib.Path(ifov.__file__).parent
        for file in PACKAGE.iterdir():
            if file.suffix in (".py", ".pyi", ".typed"):
                self.assertEqual(file.read_bytes(), (installed / file.name).read_bytes(), file.name)

    def test_version(self):
        self.assertEqual(importlib.metadata.version("ifov"), ifov.version())

    def test_importing_is_light(self):
        code = "import sys, ifov; print([name for name in ('xarray', 'pandas', 'ifov._ifov', 'tqdm') if name in sys.modules])"
        self.assertEqual(run(code), "[]")

    def test_the_accessor_is_there_where_xarray_was_first(self):
        self.assertEqual(run("import xarray, ifov; print(hasattr(xarray.Dataset, 'ifov'))"), "True")

    def test_schema(self):
        import json

        self.assertEqual(ifov.schema(), json.loads(subprocess.run([scenes.PROGRAM, "schema"], capture_output=True).stdout))

    def test_materials(self):
        found = ifov.materials.search("asphalt")
        self.assertTrue(found)
        curve = found[0].curves[0]
        self.assertEqual(curve.wavelength.shape, curve.reflectance.shape)
        with self.assertRaisesRegex(ifov.DocumentError, "asphalt"):
            ifov.materials.search("asphelt")

    def test_the_module_shows_no_symbols_but_its_own(self):
        names = subprocess.run(["nm", "-D", "--defined-only", ifov._library().__file__], capture_output=True, text=True, check=True)
        own = [line.split()[-1] for line in names.stdout.splitlines()]
        self.assertEqual([name for name in own if name != "PyInit__ifov"], [])


    def test_the_module_stands_on_the_facade_alone(self):
        """Its sources include the headers of include/ifov, nanobind, the standard library, the process's number (unistd.h) and each other."""
        sources = sorted((scenes.ROOT / "python" / "src").glob("*.*"))
        self.assertGreater(len(sources), 8)
        own = {file.name for file in sources}
        for file in sources:
            for name in re.findall(r'#include [<"]([^>"]+)[>"]', file.read_text(encoding="utf-8")):
                there = name in own or name.startswith("nanobind/") or name == "unistd.h" or "/" not in name and "." not in name
                self.assertTrue(there or (name.startswith("ifov/") and (scenes.ROOT / "include" / name).exists()), (file.name, name))


class Typed(unittest.TestCase):
    def test_mypy(self):
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is not installed")
        done = subprocess.run(
            [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--cache-dir", os.environ["IFOV_BUILD"] + "/mypy"],
            cwd=scenes.ROOT,
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


    def test_stubtest(self):
        """Properties, enumerations and what the modules in Python have; what it cannot know of nanobind's is listed with reasons."""
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is not installed")
        done = subprocess.run(
            [sys.executable, "-m", "mypy.stubtest", "ifov", "--allowlist", scenes.ROOT / "python" / "stubtest_allowlist.txt",
             "--mypy-config-file", scenes.ROOT / "pyproject.toml"],
            cwd=tempfile.gettempdir(),
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_has_the_arguments_that_there_are(self):
        """Else tools/make_stub.sh has to be run again."""
        if importlib.util.find_spec("nanobind") is None:
            self.skipTest("nanobind is not installed")
        with tempfile.TemporaryDirectory() as folder:
            made = pathlib.Path(folder) / "made.pyi"
            subprocess.run([sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "ifov._ifov", "-o", made], cwd=folder, check=True)
            there = _arguments_of(made.read_text(encoding="utf-8"))
        stub = (PACKAGE / "_ifov.pyi").read_text(encoding="utf-8")
        self.assertIn(("Simulation.cast", ["self", "origins", "directions", "threads"], ["0"]), there)
        self.assertEqual(_arguments_of(stub), there)
        self.assertNotEqual(_arguments_of(stub.replace("ground: float | str, ", "")), there)
        self.assertNotEqual(_arguments_of(stub.replace("threads: int = 0", "threads: int = 1")), there)

    def test_the_stub_names_what_there_is(self):
        """Else tools/make_stub.sh has to be run again. (In stubtest this is allowed for: it takes nanobind's functions for none.)"""
        stub = {}
        for item in ast.parse((PACKAGE / "_ifov.pyi").read_text(encoding="utf-8")).body:
            if isinstance(item, ast.ClassDef):
                stub[item.name] = _names_of(item.body)
            elif isinstance(item, ast.FunctionDef):
                stub[item.name] = None
        module = ifov._library()
        there = {
            name: {own for own in vars(value) if not own.startswith("_")} if isinstance(value, type) else None
            for name, value in vars(module).items()
            if not name.startswith("_")
        }
        self.assertEqual(there, stub)


def _arguments_of(stub):
    """Name, arguments and defaults of each function and method of a stub."""
    found = []
    for item in ast.parse(stub).body:
        functions = item.body if isinstance(item, ast.ClassDef) else [item]
        for one in functions:
            if isinstance(one, ast.FunctionDef):
                name = f"{item.name}.{one.name}" if one is not item else one.name
                arguments = [*one.args.posonlyargs, *one.args.args, *one.args.kwonlyargs]
                found.append((name, [argument.arg for argument in arguments], [ast.unparse(default) for default in one.args.defaults]))
    return found


def _names_of(body):
    """What a class of the stub declares and does not begin with an underscore."""
    names = set()
    for item in body:
        if isinstance(item, ast.FunctionDef):
            names.add(item.name)
        elif isinstance(item, ast.AnnAssign):
            names.add(item.target.id)
        elif isinstance(item, ast.Assign):
            names |= {target.id for target in item.targets}
    return {name for name in names if not name.startswith("_")}


class WithoutTheExtension(scenes.InFolder):
    def test_products_are_loaded(self):
        ifov.run(scenes.small(), "out", progress=False)
        code = (
            "import sys; sys.modules['ifov._ifov'] = None\n"
            "import ifov\n"
            f"ds = ifov.load({str(self.folder / 'out')!r})\n"
            "print(ds.ifov.rgb().shape, ds.ifov.brightness_temperature().shape, ifov.read.__name__)\n"
            "try: ifov.render({})\n"
            "except ImportError as error: print('pip install' in str(error))\n"
        )
        self.assertEqual(run(code), "(14, 20, 3) (2, 14, 20) read\nTrue")


class Neighbours(scenes.InFolder):
    """Others bring libraries of the same names; each keeps its own, in any order."""

    def test_any_order(self):
        import json

        # A document whose terrain is read by the library's own GDAL, and whose products are written by its own netCDF.
        document = scenes.small(output={"formats": ["geotiff", "netcdf"]})
        document["scene"]["origin"] = {"crs": "EPSG:32633", "easting": "500000 m", "northing": "5300000 m", "height": "0 m"}
        pathlib.Path("scene.json").write_text(json.dumps(document), encoding="utf-8")
        parts = {
            "ifov": f"ifov.run(ifov.read({str(self.folder / 'scene.json')!r}), FOLDER, progress=False)",
            "rasterio": "assert rasterio.open(FOLDER + '/image_radiance.tif').crs.to_epsg() == 32633",
            "netCDF4": "assert netCDF4.Dataset(FOLDER + '/image_radiance.nc')['radiance'].shape == (2, 14, 20)",
            "pyproj": "assert abs(pyproj.Transformer.from_crs(32633, 4326, always_xy=True).transform(5e5, 5.3e6)[0] - 15) < 1e-9",
            "mitsuba": "mitsuba.set_variant('scalar_rgb'); lamp = mitsuba.load_dict({'type': 'scene', 'lamp': {'type': 'constant'}})\n"
            "ray = mitsuba.Ray3f([0, 0, 0], [0, 0, 1]); assert not lamp.ray_intersect(ray).is_valid()",
        }
        there = [name for name in parts if importlib.util.find_spec(name) is not None]
        if len(there) < 3:
            self.skipTest(f"of what brings libraries of its own there is only {', '.join(there)}")
        looks_at_products = ("rasterio", "netCDF4")
        for number in range(2 * len(there)):
            # Each is imported first and last once. The first to be used is not always the first to be imported.
            order = there[number // 2 :] + there[: number // 2]
            order = order if number % 2 == 0 else order[::-1]
            work = [name for name in order if name not in ("ifov", *looks_at_products)]
            uses = ["ifov", *work] if number % 4 < 2 else [*work, "ifov"]
            uses += [name for name in order if name in looks_at_products]
            first = "" if number % 4 < 2 or "rasterio" not in there else "from rasterio.crs import CRS; assert CRS.from_epsg(4326).to_wkt()\n"
            code = f"FOLDER = {str(self.folder / str(number))!r}\n" + "".join(f"import {name}\n" for name in order)
            code += first + "\n".join(parts[name] for name in uses) + "\n"
            if "rasterio" in there:
                code += "assert rasterio.__gdal_version__ == rasterio.gdal_version()\n"
            self.assertEqual(run(code + "print('well')"), "well", (order, uses))


if __name__ == "__main__":
    unittest.main()
