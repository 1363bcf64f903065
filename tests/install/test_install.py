"""What `cmake --install` leaves is whole: a program of somebody else finds it, is built with it and runs."""

import array
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("IFOV_BUILD", ROOT / "build"))
EXAMPLE = ROOT / "examples/program"

SCENE = """{"ifov": 1,
 "scene": {"materials": {"lawn": {"reflectance": 0.12}, "metal": {"reflectance": 0.5}},
           "objects": [{"plane": {}, "material": "lawn"},
                       {"sphere": {"center": ["2 m", "1 m", "1 m"], "radius": "1 m"}, "material": "metal"}]},
 "light": {"sun": {"disc": {"zenith": "45 deg", "azimuth": "225 deg"}}, "sky": {"none": {}}},
 "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [16, 12]}},
            "channels": [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}}]},
 "sampling": {"accuracy": {"error": "5 %"}, "tile": 8}}
"""


def done(*command, **more):
    """The output of a command that must succeed."""
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=300, check=False, **more)
    if result.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, command))}\n{result.stdout[-3000:]}\n{result.stderr[-3000:]}")
    return result.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("cmake"):
            raise unittest.SkipTest("cmake is not there")
        settings = (BUILD / "CMakeCache.txt").read_text() if (BUILD / "CMakeCache.txt").exists() else ""
        if not settings:
            raise unittest.SkipTest(f"no build of CMake in {BUILD}")
        if re.search(r"IFOV_SANITIZE:\w+=(?!OFF)\w", settings):
            raise unittest.SkipTest("a program without sanitizers cannot use a library with them")
        cls.compiler = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", settings).group(1)
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        cls.prefix = cls.folder / "prefix"
        done("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.library = next(cls.prefix.rglob("libifov.so"))
        (cls.folder / "scene.json").write_text(SCENE)

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def expect_right_answer(self, program, **environment):
        """What the example says is what the installed program's cube holds."""
        said = done(program, "scene.json", "seed=3", cwd=self.folder, env={**os.environ, **environment})
        shutil.rmtree(self.folder / "scene.out", ignore_errors=True)
        done(self.prefix / "bin/ifov", "render", "scene.json", "--set", "seed=3", "-q", cwd=self.folder)
        values = array.array("f", (self.folder / "scene.out/image_radiance.img").read_bytes())
        errors = array.array("f", (self.folder / "scene.out/image_half_width.img").read_bytes())
        most = max(values)
        place = values.index(most)
        found = re.fullmatch(r"red: (\S+) \+- (\S+) W m-2 sr-1 um-1 at column (\d+), row (\d+)\n", said)
        self.assertIsNotNone(found, said)
        self.assertEqual(found.groups()[:2], (f"{most:g}", f"{errors[place]:g}"))
        self.assertEqual(values[int(found.group(3)) + 16 * int(found.group(4))], most)

    def test_a_program_finds_it_by_cmake(self):
        done("cmake", "-S", EXAMPLE, "-B", self.folder / "by_cmake", f"-DCMAKE_PREFIX_PATH={self.prefix}",
             f"-DCMAKE_CXX_COMPILER={self.compiler}")
        done("cmake", "--build", self.folder / "by_cmake")
        self.expect_right_answer(self.folder / "by_cmake/brightest")

    def test_a_program_finds_it_by_pkg_config(self):
        if not shutil.which("pkg-config"):
            self.skipTest("pkg-config is not there")
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.library.parent / "pkgconfig")}
        flags = shlex.split(done("pkg-config", "--cflags", "--libs", "ifov", env=environment))
        self.assertEqual(done("pkg-config", "--modversion", "ifov", env=environment).strip(),
                         done(self.prefix / "bin/ifov", "--version").split()[1])
        program = self.folder / "by_pkg_config"
        done(self.compiler, "-std=c++20", EXAMPLE / "main.cpp", *flags, "-o", program)
        self.expect_right_answer(program, LD_LIBRARY_PATH=str(self.library.parent))

    def test_another_version_is_not_taken(self):
        project = self.folder / "another"
        project.mkdir()
        (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.20)\nproject(x LANGUAGES NONE)\n"
                                                "find_package(ifov 99 REQUIRED)\n")
        result = subprocess.run(["cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}"],
                                capture_output=True, text=True, timeout=100, check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn('compatible with requested version "99"', " ".join(result.stderr.split()))

    def test_what_lies_where(self):
        headers = {file.name for file in (self.prefix / "include").rglob("*.h")}
        self.assertEqual(headers, {file.name for file in (ROOT / "include/ifov").iterdir()})
        files = {str(file.relative_to(self.prefix)) for file in self.prefix.rglob("*") if not file.is_dir()}
        where = self.library.parent.relative_to(self.prefix)
        for name in ("bin/ifov", f"{where}/libifov.so", f"{where}/cmake/ifov/ifovConfig.cmake",
                     f"{where}/cmake/ifov/ifovConfigVersion.cmake", f"{where}/pkgconfig/ifov.pc", "share/doc/ifov/LICENSE"):
            self.assertIn(name, files)
        self.assertEqual([name for name in files if name.endswith(".a")], [], "archives of the rooms")
        for text in self.prefix.rglob("*.cmake"):
            self.assertNotIn(str(ROOT), text.read_text(), text)

    def test_the_library_shows_its_own_names_alone(self):
        if not shutil.which("nm") or not shutil.which("readelf"):
            self.skipTest("nm and readelf (binutils) are not there")
        names = [line.split(" ", 2)[2] for line in done("nm", "-DC", "--defined-only", self.library).splitlines()]
        plain = {re.sub(r"^(?:vtable|typeinfo|typeinfo name) for ", "", name) for name in names}
        of_facade = re.compile(r"ifov::(?:Document|Simulation|render_series|render_instruments|instruments_of|InputError|SystemError|Cancelled|LogSink|ProgressSink|TileSink"
                               r"|Assets|AtmosphereReport|InputsBelow|Ranks|check|version|document_schema|document_reference|exit_code_of"
                               r"|reason_name|survey_atmosphere|make_gas_model|invert_radiance|run_status|merge|mpi_library|run_info|cube_info|products_in"
                               r"|region_means|series_info|detect|record_of|write_file|mapped_input_at|search_materials|curves_of|materials_list"
                               r"|refractive_indices|refractive_indices_list"
                               r"|BrdfReport|TemperatureReport|survey_temperatures|point_temperature|describe_sensor|integrate|FieldFunction|find_sensor_preset|sensor_preset_list|survey_brdf|survey_model|scattering_models|scattering_models_list|scattering_models_reference"
                               r"|wavelength_um_of|material_text|material_csv|material_figure|planck_radiance|brightness_temperature)\b")
        self.assertEqual(sorted(name for name in plain if not of_facade.match(name)), [])
        self.assertIn("ifov::version[abi:cxx11]()", plain)
        self.assertRegex(done("readelf", "-dW", self.library), r"SONAME\).*\[libifov\.so\.\d+\.\d+\]")

    def test_the_library_is_refused_by_an_old_processor(self):
        if not shutil.which("readelf"):
            self.skipTest("readelf (binutils) is not there")
        if not re.search(r"IFOV_LINKER_MARKS_ISA_V\d:\w+=1", (BUILD / "CMakeCache.txt").read_text()):
            self.skipTest("built for any x86-64, or by a linker that has no mark for it")
        march = re.search(r"IFOV_MARCH:\w+=(.*)", (BUILD / "CMakeCache.txt").read_text()).group(1)
        marks = done("readelf", "-nW", self.library)
        self.assertRegex(marks, r"x86 ISA needed: .*\b" + (march if re.fullmatch(r"x86-64-v\d", march) else r"x86-64-v\d"))
        emulator = shutil.which("qemu-x86_64") or shutil.which("qemu-x86_64-static")
        if not emulator:
            self.skipTest("marked for the loader; no qemu-x86_64 to be an old processor")
        caller = self.folder / "caller.cpp"
        caller.write_text('#include <dlfcn.h>\n#include <cstdio>\n'
                          'int main(int, char** words) { std::puts(dlopen(words[1], RTLD_NOW) ? "there" : dlerror()); }\n')
        done(self.compiler, caller, "-o", self.folder / "caller")
        self.assertIn("CPU ISA level is lower than required", done(emulator, "-cpu", "Nehalem", self.folder / "caller", self.library))

    def test_the_library_has_the_guards_of_the_program(self):
        if not shutil.which("readelf"):
            self.skipTest("readelf (binutils) is not there")
        if "IFOV_HARDEN:BOOL=OFF" in (BUILD / "CMakeCache.txt").read_text():
            self.skipTest("built with IFOV_HARDEN=OFF")
        segments = done("readelf", "-lW", self.library)
        self.assertIn("GNU_RELRO", segments)
        self.assertRegex(segments, r"GNU_STACK\s.* RW ")
        self.assertNotRegex(segments, r"\bRWE\b")
        self.assertRegex(done("readelf", "-dW", self.library), r"FLAGS_1\).*\bNOW\b")
        self.assertIn("__stack_chk_fail", done("readelf", "--dyn-syms", "-W", self.library))

    def test_the_guide_shows_this_program(self):
        page = (ROOT / "docs/guide/library.md").read_text()
        for name in ("CMakeLists.txt", "main.cpp"):
            self.assertIn((EXAMPLE / name).read_text(), page, name)


if __name__ == "__main__":
    unittest.main()
