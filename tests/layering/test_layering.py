"""The source tree keeps the rules of docs/developer/architecture.md; a tree that breaks each of them is caught."""

import dataclasses
import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

from layering import (  # noqa: E402
    crowded_folders,
    emptiness_faults,
    folder_circles,
    folder_table_faults,
    libraries_of,
    part_violations,
    public_violations,
    read_rules,
    violations,
    whole_documents,
    without_comments_and_strings,
)

PAGE = (ROOT / "docs/developer/architecture.md").read_text()
RULES = read_rules(PAGE)


class SourceTree(unittest.TestCase):
    def test_tables_are_read(self):
        self.assertEqual(RULES.levels["core"], 0)
        self.assertEqual(RULES.levels["studies"], 11)
        self.assertEqual(RULES.levels["cli"], 12)
        self.assertEqual(RULES.adapters["embree"], ["geometry"])
        self.assertEqual(RULES.public["ifov/error.h"], ["core"])

    def test_source_keeps_the_rules(self):
        found = violations(ROOT / "src", RULES)
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_the_command_line_is_a_program_like_any_other(self):
        (program,) = libraries_of(ROOT / "src/cli")
        self.assertEqual(sorted(program.rooms), ["core", "landscape", "studies", "viewer"])

    def test_parts_of_rooms_are_those_of_the_table(self):
        self.assertIn("io_document", RULES.parts)
        self.assertEqual(part_violations(ROOT / "src", RULES), [])

    def test_assemblers_take_the_parts_of_a_document_that_are_theirs(self):
        self.assertEqual(whole_documents(ROOT / "src/session/assembly"), [])

    def test_public_headers_show_nothing_of_the_inside(self):
        self.assertEqual(public_violations(ROOT / "include"), [])
        headers = {f"ifov/{file.name}" for file in (ROOT / "include/ifov").iterdir()} - {"ifov/api.h"}
        self.assertEqual(headers, set(RULES.public), "the table of public headers")

    def test_folders_are_read_in_one_sitting_and_have_an_order(self):
        self.assertEqual(crowded_folders(ROOT / "src"), [])
        self.assertEqual(folder_circles(ROOT / "src"), [])

    def test_the_page_says_which_rooms_are_empty_and_which_folders_there_are(self):
        self.assertEqual(emptiness_faults(PAGE, ROOT / "src"), [])
        self.assertEqual(folder_table_faults(PAGE, ROOT / "src"), [])


class PlantedFolders(unittest.TestCase):
    def test_a_page_that_is_not_true_is_found(self):
        page = ("| level | folder | what |\n|---|---|---|\n| 1 | `math` | vectors |\n| 3 | `sensor` | cameras |\n"
                "| 5 | `thermal` | *no code yet:* balance |\n\n| room | folders |\n|---|---|\n| `math` | `solid/a`, `b` (see `c`) |\n")
        with tempfile.TemporaryDirectory() as name:
            source = pathlib.Path(name)
            for path in ("math/solid/a/x.h", "math/b/y.h", "math/b/c/z.cpp"):
                (source / path).parent.mkdir(parents=True, exist_ok=True)
                (source / path).write_text("")
            self.assertEqual(emptiness_faults(page, source), ["sensor: has no code, and the page says otherwise"])
            self.assertEqual(folder_table_faults(page, source), [])
            for path in ("thermal/x.h", "sensor/x.h", "sensor/lens/x.h"):
                (source / path).parent.mkdir(parents=True, exist_ok=True)
                (source / path).write_text("")
            (source / "math/b/c/z.cpp").unlink()
            self.assertEqual(emptiness_faults(page, source), ["thermal: has code, and the page says otherwise"])
            self.assertEqual(folder_table_faults(page, source), ["math has no folder 'c'", "sensor/lens is not in the table"])

    def test_a_circle_of_folders_is_found(self):
        with tempfile.TemporaryDirectory() as name:
            source = pathlib.Path(name)
            for path, target in (("io/a/x.h", "io/b/y.h"), ("io/b/y.h", "io/z.h"), ("io/z.h", "io/a/x.h"), ("io/c/w.h", "io/a/x.h")):
                (source / path).parent.mkdir(parents=True, exist_ok=True)
                (source / path).write_text(f'#include "{target}"\n')
            self.assertEqual(folder_circles(source), ["io, io/a, io/b"])
            self.assertEqual(crowded_folders(source), [])
            for k in range(40):
                (source / f"io/c/{k}.h").write_text("")
            self.assertEqual(crowded_folders(source), ["io/c: 41 files"])


class PlantedDocument(unittest.TestCase):
    def test_an_assembler_of_the_whole_document_is_found(self):
        with tempfile.TemporaryDirectory() as name:
            file = pathlib.Path(name) / "light.cpp"
            file.write_text('#include "io/document/light_document.h"\n// as io::Document\nvoid f(const io::DocumentSources&);\n')
            self.assertEqual(whole_documents(file.parent), [])
            for line in ('#include "io/document/document.h"', "struct Document;", "void f(const io::Document& document);"):
                file.write_text("\n" + line + "\n")
                self.assertEqual(whole_documents(file.parent), ["light.cpp:2"], line)


class PlantedFaults(unittest.TestCase):
    """Each fault alone, in a made-up tree, is found and named."""

    def check(self, path, text, expected, cmake=None):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder)
            file = source / path
            file.parent.mkdir(parents=True)
            file.write_text(text)
            if cmake:
                (file.parent / "CMakeLists.txt").write_text(cmake)
            self.assertEqual(violations(source, RULES), expected)

    def test_a_clean_file_passes(self):
        self.check(
            "render/a.cpp",
            '#include "render/a.h"\n#include "scene/b.h"\n#include <vector>\n// printf("x"); exit(1)\n'
            'const char* s = "std::cout";\nint n = std::snprintf(b, 2, "x");\nrun.exit(1);\n',
            [],
        )

    def test_upward_include(self):
        self.check("math/a.h", '\n#include "scene/scene.h"\n', ["math/a.h:2: math (level 1) includes scene (level 6)"])

    def test_sideways_include(self):
        self.check(
            "sampling/a.h", '#include "radiometry/planck.h"\n', ["sampling/a.h:1: sampling (level 2) includes radiometry (level 2)"]
        )

    def test_undeclared_dependency(self):
        self.check(
            "render/a.h",
            '#include "geodesy/sun.h"\n',
            ["render/a.h:1: render includes geodesy without declaring it in render/CMakeLists.txt"],
            "ifov_room(render ROOMS core math LIBRARIES x)\n",
        )

    PARTS = ("# ifov_part(io none)\nifov_part(io low FOLDERS a b ROOMS core)\n"
             "ifov_part(io high FOLDERS c\n          PARTS low ROOMS core math LIBRARIES GDAL::GDAL)\nifov_whole_room(io)\n")

    def check_parts(self, files, expected, rules=RULES, found_by=violations):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder)
            for path, text in ({"io/CMakeLists.txt": self.PARTS} | files).items():
                (source / path).parent.mkdir(parents=True, exist_ok=True)
                (source / path).write_text(text)
            self.assertEqual(found_by(source, rules), expected)

    def test_parts_include_what_they_declare(self):
        self.check_parts({"io/a/x.h": '#include "io/b/y.h"\n', "io/c/x.h": '#include "io/a/x.h"\n#include "math/x.h"\n'}, [])
        self.check_parts({"io/a/x.h": '#include "io/c/y.h"\n'}, ["io/a/x.h:1: io_low includes io/c without declaring it in io/CMakeLists.txt"])
        self.check_parts({"io/a/x.h": '\n#include "math/y.h"\n'}, ["io/a/x.h:2: io_low includes math without declaring it in io/CMakeLists.txt"])
        studies = "ifov_room(studies ROOMS core io_low)\n"
        self.check_parts({"studies/CMakeLists.txt": studies, "studies/x.cpp": '#include "io/b/y.h"\n'}, [])
        self.check_parts({"studies/CMakeLists.txt": studies, "studies/x.cpp": '#include "io/c/y.h"\n'},
                         ["studies/x.cpp:1: studies includes io/c without declaring it in studies/CMakeLists.txt"])

    def test_a_part_of_the_own_files_of_a_room(self):
        own = "ifov_part(io low FOLDERS a ROOMS core)\nifov_part(io high FOLDERS . PARTS low ROOMS core)\n"
        files = {"io/CMakeLists.txt": own, "io/x.h": '#include "io/a/y.h"\n', "io/a/y.h": ""}
        self.check_parts(files, [])
        self.check_parts(files | {"io/a/y.h": '#include "io/x.h"\n'},
                         ["io/a/y.h:1: io_low includes io/x.h without declaring it in io/CMakeLists.txt"])
        tables = {"io_low": (["a"], [], []), "io_high": (["."], ["low"], [])}
        self.check_parts(files, [], dataclasses.replace(RULES, parts=tables), part_violations)
        self.check_parts(files | {"io/CMakeLists.txt": "ifov_part(io low FOLDERS a ROOMS core)\n"}, ["io/.: in no part"],
                         dataclasses.replace(RULES, parts={"io_low": (["a"], [], [])}), part_violations)

    def test_outside_header_beyond_its_part(self):
        rules = dataclasses.replace(RULES, adapters={"gdal": ["io_high"]})
        self.check_parts({"io/c/x.h": "#include <gdal.h>\n"}, [], rules)
        self.check_parts({"io/b/x.h": "#include <gdal.h>\n"}, ["io/b/x.h:1: <gdal.h> belongs in io_high only"], rules)

    def test_parts_that_differ_from_the_table(self):
        table = {"io_low": (["a", "b"], [], []), "io_high": (["c"], ["low"], ["GDAL::GDAL"])}
        holds = lambda parts, expected, files=(): self.check_parts(
            {path: "" for path in ("io/a/x.h", "io/b/x.h", "io/c/x.h", *files)}, expected, dataclasses.replace(RULES, parts=parts), part_violations)
        holds(table, [])
        holds(table | {"io_low": (["a"], [], [])}, ["io_low: folders are a in the table, a, b in CMakeLists.txt"])
        holds(table | {"io_high": (["c"], ["low"], [])}, ["io_high: outside libraries are  in the table, GDAL::GDAL in CMakeLists.txt"])
        holds({"io_low": table["io_low"]}, ["io_high: not in the table"])
        holds(table, ["io/d: in no part"], ["io/d/x.h"])

    def test_include_that_hides_its_room(self):
        self.check("math/a.h", '#include "vec3.h"\n', ['math/a.h:1: "vec3.h" does not start at src/ with a room of the table'])

    def test_outside_header_beyond_its_adapter(self):
        for header, rooms in (
            ("embree3/rtcore.h", "geometry"),
            ("gdal_priv.h", "io_readers, io_products"),
            ("cairo/cairo.h", "io_products"),
            ("cairo.h", "io_products"),
            ("rapidjson/reader.h", "io_base"),
            ("CLI/CLI.hpp", "cli"),
            ("erfa.h", "geodesy"),
            ("tbb/parallel_for.h", "core, geometry"),
            ("mpi.h", "cluster"),
        ):
            self.check("scene/a.cpp", f"#include <{header}>\n", [f"scene/a.cpp:1: <{header}> belongs in {rooms} only"])

    def test_public_header_beyond_its_rooms(self):
        for header, rooms in (("ifov/error.h", "core"), ("ifov/simulation.h", "session, viewer, cli"), ("ifov/inside.h", "no room")):
            self.check("scene/a.cpp", f'#include "{header}"\n', [f"scene/a.cpp:1: {header} is included by {rooms} only"])

    def test_public_header_that_shows_the_inside(self):
        with tempfile.TemporaryDirectory() as folder:
            include = pathlib.Path(folder)
            (include / "ifov").mkdir()
            (include / "ifov/a.h").write_text('#include <vector>\n#include "ifov/a.h"\n')
            self.assertEqual(public_violations(include), [])
            for header in ('"session/session.h"', "<gdal.h>", "<rapidjson/reader.h>", '"ifov/none.h"'):
                (include / "ifov/b.h").write_text(f"\n#include {header}\n")
                self.assertEqual(public_violations(include), [f"ifov/b.h:2: a public header includes {header[1:-1]}"])

    def test_printing(self):
        for call in ("printf(", "std::printf(", "puts(", "fmt::print", "std::cerr", "stderr"):
            self.check("io/a.cpp", f"void f() {{ {call}", [f"io/a.cpp:1: a library prints: {call}"])

    def test_exiting(self):
        for call in ("exit(", "std::exit(", "abort(", "std::terminate("):
            self.check("io/a.cpp", f"\nvoid f() {{ {call}", [f"io/a.cpp:2: a library exits: {call}"])

    def test_only_the_command_line_speaks(self):
        self.check("cli/a.cpp", "void f() { std::printf(1); std::exit(1); }", [])

    def test_unknown_room(self):
        self.check("misc/a.h", "", ["misc/: not a room of the table"])

    def test_line_numbers_survive_the_stripping(self):
        self.assertEqual(without_comments_and_strings('a /* 1\n2 */ b // c\n"x\\"y" d'), 'a \n b \n"" d')


if __name__ == "__main__":
    unittest.main()
