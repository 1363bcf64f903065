"""docs/developer/add_a_bsdf_model.md is true: its model, put beside the others, is read, explained and rendered."""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov")))
BUILD = PROGRAM.parent
PAGE = (ROOT / "docs/developer/add_a_bsdf_model.md").read_text()
FOLDER = "src/materials/bsdf"


def shown(name):
    """The code that the page shows for a file."""
    return re.search(rf"^```cpp\n// {FOLDER}/{re.escape(name)}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL).group(1)


def command_for(output):
    """The shell command by which the build makes a file."""
    text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands", output], capture_output=True, text=True, check=True).stdout
    return text.strip().splitlines()[-1]


@unittest.skipUnless(shutil.which("ninja") and (BUILD / "build.ninja").exists(), "the build was not made by ninja")
class AddAModel(unittest.TestCase):
    def compile(self, source, folder):
        """An object file of a source, made as the build makes that of the registry."""
        made = next(line for line in command_for("src/materials/libifov_materials.a").split() if "bsdf_models.cpp.o" in line)
        words = shlex.split(command_for(made))
        target = folder / (source.name + ".o")
        words = [word for word in words if not word.endswith("ccache")]
        for option, value in (("-o", str(target)), ("-c", str(source)), ("-MF", str(target) + ".d")):
            words[words.index(option) + 1] = value
        words[-1] = str(source)
        words.insert(1, f"-I{folder}")
        result = subprocess.run(words, cwd=BUILD, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr[-3000:])
        return target

    def program_with_the_model(self, folder):
        beside = folder / "materials/bsdf"
        beside.mkdir(parents=True)
        (beside / "minnaert.h").write_text('#pragma once\n#include "materials/bsdf/bsdf_model.h"\nnamespace ifov::materials {\n'
                                           + shown("minnaert.h") + "}\n")
        (beside / "minnaert.cpp").write_text('#include "materials/bsdf/minnaert.h"\n#include <cmath>\n#include <numbers>\n'
                                             "namespace ifov::materials {\n" + shown("minnaert.cpp") + "}\n")
        registry = (ROOT / FOLDER / "bsdf_models.cpp").read_text()
        registry, rows = re.subn(r"^constexpr std::array kModels\{.*?\};\n", shown("bsdf_models.cpp"), registry,
                                 flags=re.MULTILINE | re.DOTALL)
        self.assertEqual(rows, 1)
        (beside / "bsdf_models.cpp").write_text('#include "materials/bsdf/minnaert.h"\n' + registry)
        archive = folder / "libifov_materials.a"
        shutil.copy(BUILD / "src/materials/libifov_materials.a", archive)
        subprocess.run(["ar", "d", archive, "bsdf_models.cpp.o"], check=True)
        objects = [self.compile(beside / name, folder) for name in ("minnaert.cpp", "bsdf_models.cpp")]
        subprocess.run(["ar", "r", archive, *objects], check=True, capture_output=True)
        link = command_for("ifov").replace("src/materials/libifov_materials.a", str(archive))
        program = folder / "ifov"
        link = re.sub(r"-o ifov\b", f"-o {program}", link)
        self.assertIn(str(program), link)
        subprocess.run(link, shell=True, cwd=BUILD, check=True, capture_output=True)
        return program

    def test_two_new_files_and_one_row(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            program = self.program_with_the_model(folder)

            def run(*arguments):
                return subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=100, check=False)

            page = run("schema", "--markdown").stdout
            self.assertIn("| `darkening` | number between 1 and 2 | `1` | exponent; 1 is Lambert's law |", page)
            document = {"ifov": 1, "scene": {"materials": {"dust": {"reflectance": 0.3, "scattering": {"minnaert": {"darkening": 1.5}}}},
                                             "objects": [{"plane": {}, "material": "dust"}]},
                        "light": {"sun": {"point": {"zenith": "60 deg", "azimuth": "90 deg"}}},
                        "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [2, 2]}},
                                   "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]}}

            def radiance(scattering):
                document["scene"]["materials"]["dust"]["scattering"] = scattering
                (folder / "scene.json").write_text(json.dumps(document))
                result = run("render", "scene.json", "-o", "out", "--restart", "-q")
                self.assertIn(result.returncode, (0, 6), result.stderr)
                cubes = list((folder / "out").glob("*_radiance.img"))
                return memoryview(cubes[0].read_bytes()).cast("f")[0]

            plain = radiance("lambertian")
            self.assertGreater(plain, 0.0)
            self.assertAlmostEqual(radiance({"minnaert": {"darkening": 1.0}}) / plain, 1.0, 6)
            self.assertAlmostEqual(radiance("minnaert") / plain, 1.0, 6)
            # The view is from above, the Sun 60 degrees off: cos(60 deg) to the power 0.5.
            self.assertAlmostEqual(radiance({"minnaert": {"darkening": 1.5}}) / plain, 0.5**0.5, 6)
            document["scene"]["materials"]["dust"]["scattering"] = {"minnaert": {"darkening": 3}}
            (folder / "scene.json").write_text(json.dumps(document))
            self.assertIn("minnaert.darkening' is the number 3, expected a number between 1 and 2", run("check", "scene.json").stderr)


if __name__ == "__main__":
    unittest.main()
