"""Files are opened in few places: where links are not followed, and where --inputs-below is held."""

import pathlib
import re
import unittest

from layering import without_comments_and_strings

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPENS = re.compile(
    r"\b(?:if|of|f)stream\b|\bf(?:re)?open(?:64)?\s*\(|(?<![\w.>:])(?:::)?(?:open|openat|creat|mkstemp)\s*\([^;]*,"
    r"|\bGDAL(?:Open\w*|AllRegister|CreateCopy|Create)\s*\(|\bGDALRegister_"
)

# Each with what it does about links and --inputs-below.
ALLOWED = {
    "cli/terminal/console.h": "the log, which may not be a link",
    "core/machine_memory.cpp": "files of the system in /proc and /sys",
    "io/files/input_file.cpp": "the one way in",
    "io/files/own_files.cpp": "makes files anew",
    "io/products/part_file.cpp": "makes files anew",
    "io/products/geotiff.cpp": "the part of a product, made by PartFile",
    "io/raster/fill_unknown.cpp": "a raster in memory",
    "io/raster/gdal_setup.cpp": "the list of drivers, and GDAL's way in",
    "io/raster/netcdf_variable.cpp": "a file that was opened as an input before",
    "io/raster/raster.cpp": "by gdal_input_name()",
    "io/raster/raster_writer.cpp": "in a new folder",
    "io/run_state/run_lock.cpp": "a lock, which may not be a link",
    "io/run_state/tile_index.cpp": "packs, which may not be links",
    "io/run_state/tile_packs.cpp": "packs, which may not be links",
}


def openings(name, text):
    return sorted({match.group(0).split("(")[0].strip() for match in OPENS.finditer(without_comments_and_strings(text))})


class FileOpenings(unittest.TestCase):
    def test_only_where_it_is_safe(self):
        found = {}
        for path in sorted((ROOT / "src").rglob("*")):
            if path.suffix in (".h", ".cpp"):
                ways = openings(path.name, path.read_text())
                if ways:
                    found[str(path.relative_to(ROOT / "src"))] = ways
        self.assertEqual({name: ways for name, ways in found.items() if name not in ALLOWED}, {},
                         "use io::InputFile or io::read_input() to read, io::PartFile or io::write_new_file() to write")
        self.assertEqual([name for name in ALLOWED if name not in found], [], "no longer opens anything")

    def test_other_ways_would_be_found(self):
        for line in ("std::ifstream file(path);", "std::ofstream f;", "FILE* f = fopen(p, a);", "int d = open(p.c_str(), 0);",
                     "::open(p, 0)", "openat(a, b, 0)", "GDALOpenEx(p)", "GDALAllRegister();", "GDALCreateCopy(d)"):
            self.assertNotEqual(openings("a.cpp", line), [], line)
        for line in ("file.open(p);", "cache->open(p)", "reopen(p, 0)", "std::vector<int> open(pixels);", "// std::ifstream f;", 'say("open(");', "is_open(p)"):
            self.assertEqual(openings("a.cpp", line), [], line)


if __name__ == "__main__":
    unittest.main()
