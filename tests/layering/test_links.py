"""Who wants a document links none of the libraries that read rasters and meshes or draw: the build's own commands tell."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

BUILD = pathlib.Path(os.environ.get("IFOV_BUILD", pathlib.Path(__file__).resolve().parents[2] / "build"))
HEAVY = ("cairo", "tinygltf", "crypto", "zstd")
# Loaded when first called (cmake/LateLibrary.cmake): to load them takes 80 ms, of which most starts of the program have no use.
LATE = ("gdal", "geos", "netcdf")


def linked(target):
    """What the command that links a program names, without the folders of its own objects."""
    text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands", "-s", target], capture_output=True, text=True, check=True).stdout
    return [pathlib.Path(word).name for word in text.split() if re.search(r"\.(a|so[.\d]*)$|^-l", word)]


def among(names, some):
    return sorted({word for word in some for name in names if word in name})


@unittest.skipUnless(shutil.which("ninja") and (BUILD / "build.ninja").exists(), "needs a build by ninja")
class Links(unittest.TestCase):
    def test_a_document_alone(self):
        names = linked("test_io_document")
        self.assertIn("libifov_io_document.a", names)
        self.assertEqual(among(names, HEAVY + LATE), [])
        for part in ("readers", "products", "runs"):
            self.assertNotIn(f"libifov_io_{part}.a", names)

    def test_the_whole_room_would_be_seen(self):
        self.assertEqual(among(linked("test_io"), HEAVY), sorted(HEAVY))

    @unittest.skipUnless(shutil.which("ldd"), "needs ldd")
    def test_what_is_loaded_late_is_not_loaded_at_the_start(self):
        for file in ("ifov", "libifov.so"):
            loaded = [line.split()[0] for line in subprocess.run(["ldd", str(BUILD / file)], capture_output=True, text=True, check=True).stdout.splitlines()]
            self.assertIn("libembree", " ".join(loaded))
            self.assertEqual(among(loaded, LATE), [], file)

    def test_scene_generators_and_studies_are_in_no_library_of_others(self):
        # libifov.so is a link to the file with its version.
        names = linked(re.search(r"^build (libifov\.so[.\d]*):", (BUILD / "build.ninja").read_text(), re.MULTILINE)[1])
        self.assertIn("libifov_io_document.a", names)
        self.assertFalse({"libifov_landscape.a", "libifov_studies.a"} & set(names))
        self.assertTrue({"libifov_landscape.a", "libifov_studies.a"} <= set(linked("ifov")))


if __name__ == "__main__":
    unittest.main()
