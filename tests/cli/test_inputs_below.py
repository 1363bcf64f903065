"""--inputs-below DIR: nothing outside of DIR is opened, whatever a document names, and so nothing of it is quoted."""

import json
import unittest

from program import Folder, run
from test_mistakes import MATERIALS, OBJECTS, WARM, ascii_grid, box_obj, changed, several

SECRET = "root:x:0:0:secret\n" * 2
OBJ = box_obj((-1, -1, 0), (1, 1, 3))


def lawn(spectrum):
    return changed(MATERIALS + ".lawn", {"reflectance": spectrum, "temperature": "22 degC"})


def thing(shape):
    return changed(OBJECTS + "[+]", {**shape, "material": "wall"})


def copies(rows):
    return several(
        ("scene.prototypes", {"post": [{"box": {"low": ["0 m", "0 m", "0 m"], "high": ["1 m", "1 m", "1 m"]}, "material": "wall"}]}),
        (OBJECTS + "[+]", {"instances": {"of": "post", **rows}}),
    )


def gltf(buffer):
    return json.dumps({"asset": {"version": "2.0"}, "buffers": [{"uri": buffer, "byteLength": 12}]})


# What names the file; a document that has FILE in its place; the ending that its kind has.
READERS = [
    ("an OBJ mesh", thing({"mesh": {"file": "FILE"}}), ".obj"),
    ("a PLY mesh", thing({"mesh": {"file": "FILE"}}), ".ply"),
    ("a glTF mesh", thing({"mesh": {"file": "FILE"}}), ".gltf"),
    ("a binary glTF mesh", thing({"mesh": {"file": "FILE"}}), ".glb"),
    ("a city", thing({"city": {"file": "FILE"}}), ".json"),
    ("a terrain", changed(OBJECTS + "[0]", {"terrain": {"file": "FILE"}, "material": "lawn"}), ".asc"),
    ("copies in text", copies({"csv": "FILE"}), ".csv"),
    ("binary copies", copies({"binary": "FILE"}), ".ifovinst"),
    ("a temperature map", changed(OBJECTS + "[0].temperature", {"map": {"file": "FILE", "unit": "K"}}), ".asc"),
    ("a spectrum", lawn({"csv": "FILE", "wavelength_unit": "um"}), ".csv"),
    ("an ECOSTRESS spectrum", lawn({"ecostress": "FILE"}), ".txt"),
    ("a USGS spectrum", lawn({"usgs": "FILE"}), ".txt"),
    ("an ASD spectrum", lawn({"asd": "FILE"}), ".asd"),
    ("an ENVI library", lawn({"sli": "FILE", "spectrum": 1}), ".hdr"),
    ("a DIRSIG spectrum", lawn({"ems": "FILE"}), ".ems"),
    ("a channel", changed("sensor.channels[0]", {"name": "red", "tabulated": {"file": "FILE", "wavelength_unit": "um"}}), ".csv"),
    ("a kernel", changed("sensor.psf", {"kernel": {"file": "FILE", "samples_per_pixel": 1}}), ".png"),
    ("weather", changed("weather", {"file": "FILE"}), ".epw"),
    ("an atmosphere", several(("light.sky", None), ("atmosphere", {"imported": {"files": ["FILE"]}})), ".csv"),
]


class Scene:
    """DIR with a document in it, and a file outside that it is not to read."""

    def __init__(self, folder):
        self.inside, self.outside = folder / "inside", folder / "outside"
        self.inside.mkdir()
        self.outside.mkdir()
        self.path = self.inside / "scene.json"

    def check(self, document, name, *options):
        self.path.write_text(json.dumps(document, indent=1).replace("FILE", str(name)))
        return run("check", "--no-cache", self.path, *options)


class InputsBelow(unittest.TestCase):
    def expect_refusal(self, done, path):
        words = done.stdout + done.stderr
        self.assertNotIn("secret", words)
        self.assertEqual(done.returncode, 1, words)
        self.assertIn("--inputs-below allows no other files", done.stderr)
        self.assertRegex(done.stderr, rf"{path}:\d+:\d+: ")

    def test_every_reader(self):
        for title, document, ending in READERS:
            with Folder() as folder:
                scene = Scene(folder)
                file = scene.outside / f"passwd{ending}"
                file.write_text(SECRET)
                link = scene.inside / f"link{ending}"
                link.symlink_to(file)
                (scene.inside / "door").symlink_to(scene.outside)
                for data in (scene.outside / "passwd.sli", scene.inside / "link.sli"):
                    data.write_text(SECRET)  # belongs to the header of a library
                ways = [
                    ("by its path", file),
                    ("by a link", f"link{ending}"),
                    ("upwards", f"../outside/passwd{ending}"),
                    ("through a linked folder", f"door/passwd{ending}"),
                    ("where there is nothing", f"../outside/none{ending}"),
                ]
                for how, name in ways if ending == ".obj" else ways[:2]:
                    with self.subTest(title, how=how):
                        done = scene.check(document, name, "--inputs-below", scene.inside)
                        self.expect_refusal(done, scene.path)
                with self.subTest(title, how="allowed"):
                    # The same file is reached and found wanting where it may be read: the rows are of this reader.
                    done = scene.check(document, f"link{ending}", "--inputs-below", folder)
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertNotIn("--inputs-below", done.stderr)
                    self.assertIn(f"link{ending}", done.stderr)

    def test_files_named_by_files(self):
        with Folder() as folder:
            scene = Scene(folder)
            (scene.outside / "b.bin").write_text(SECRET)
            (scene.inside / "b.bin").symlink_to(scene.outside / "b.bin")
            for uri in ("b.bin", "../outside/b.bin", str(scene.outside / "b.bin")):
                with self.subTest(uri):
                    (scene.inside / "a.gltf").write_text(gltf(uri))
                    done = scene.check(thing({"mesh": {"file": "FILE"}}), "a.gltf", "--inputs-below", scene.inside)
                    self.assertEqual(done.returncode, 1)
                    self.assertIn("does not lie in the folder of this file", done.stderr)
                    self.assertNotIn("secret", done.stderr)

    def test_what_gdal_finds_beside_a_raster(self):
        """A good raster, and a companion of it that leads outside: it is as if the companion were not there."""
        with Folder() as folder:
            scene = Scene(folder)
            (scene.inside / "warm.asc").write_text(ascii_grid(WARM))
            document = changed(OBJECTS + "[0].temperature", {"map": {"file": "FILE", "unit": "K"}})
            alone = scene.check(document, "warm.asc", "--inputs-below", scene.inside)
            self.assertEqual(alone.returncode, 0, alone.stderr)
            # As a companion of the raster it would scale all its numbers.
            aux = "<PAMDataset><PAMRasterBand band='1'><Offset>1000</Offset><Scale>2</Scale></PAMRasterBand></PAMDataset>"
            (scene.outside / "aux").write_text(aux)
            (scene.inside / "warm.asc.aux.xml").write_text(aux)
            self.assertNotEqual(scene.check(document, "warm.asc").stdout, alone.stdout, "the companion has no effect")
            (scene.inside / "warm.asc.aux.xml").unlink()
            (scene.inside / "warm.asc.aux.xml").symlink_to(scene.outside / "aux")
            self.assertEqual(scene.check(document, "warm.asc", "--inputs-below", scene.inside).stdout, alone.stdout)

    def test_gdals_own_names(self):
        with Folder() as folder:
            scene = Scene(folder)
            vrt = '<VRTDataset rasterXSize="4" rasterYSize="4"><VRTRasterBand dataType="Float32" band="1"><SimpleSource>' \
                  f'<SourceFilename>{scene.outside}/warm.asc</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>'
            (scene.outside / "warm.asc").write_text(ascii_grid(WARM))
            (scene.inside / "warm.vrt").write_text(vrt)
            document = changed(OBJECTS + "[0].temperature", {"map": {"file": "FILE", "unit": "K"}})
            for name in (f"/vsisubfile/0_1000,{scene.outside}/warm.asc", "/vsicurl/http://127.0.0.1:9/a.tif", "warm.vrt",
                         f"NETCDF:{scene.outside}/warm.asc:a", f"GTIFF_DIR:1:{scene.outside}/warm.asc", "/vsistdin/",
                         f"/vsiifov/{scene.outside}/warm.asc", f"vrt://{scene.outside}/warm.asc"):
                for options in ((), ("--inputs-below", scene.inside)):
                    with self.subTest(name, options=options):
                        self.assertEqual(scene.check(document, name, *options).returncode, 1)

    def test_every_command_that_reads_a_document(self):
        with Folder() as folder:
            scene = Scene(folder)
            document = scene.outside / "scene.json"
            document.write_text(SECRET)
            (scene.inside / "link.json").symlink_to(document)
            for command in (["render"], ["check"], ["atmosphere"], ["study", "suburb", "--scene"]):
                for path in (document, scene.inside / "link.json"):
                    with self.subTest(command, path=path):
                        done = run(*command, path, "--inputs-below", scene.inside, cwd=folder)
                        self.assertNotIn("secret", done.stdout + done.stderr)
                        self.assertNotEqual(done.returncode, 0)
                        self.assertIn(f"does not lie below '{scene.inside}'", done.stderr)

    def test_products_that_are_links(self):
        with Folder() as folder:
            scene = Scene(folder)
            (scene.outside / "record").write_text(SECRET)
            (scene.inside / "image_run.json").symlink_to(scene.outside / "record")
            done = run("info", scene.inside, "--inputs-below", scene.inside)
            self.assertEqual(done.returncode, 2)
            self.assertNotIn("secret", done.stderr)
            self.assertIn("secret", run("info", scene.inside).stderr)

    def test_a_run_that_stays_inside(self):
        with Folder() as folder:
            scene = Scene(folder)
            (scene.inside / "kiosk.obj").write_text(OBJ)
            document = thing({"mesh": {"file": "kiosk.obj"}})
            scene.path.write_text(json.dumps(document))
            for arguments in ((scene.path, "--inputs-below", scene.inside), ("scene.json", "--inputs-below", ".", "--restart")):
                done = run("render", *arguments, "--output", folder / "elsewhere", cwd=scene.inside)
                self.assertIn(done.returncode, (0, 5, 6), done.stderr)

    def test_a_folder_that_is_not_there(self):
        with Folder(scene="{}") as folder:
            done = run("check", folder / "scene.json", "--inputs-below", folder / "none")
            self.assertEqual((done.returncode, done.stderr), (1, f"ifov: --inputs-below '{folder}/none': no such file\n"))
            done = run("check", folder / "scene.json", "--inputs-below", folder / "scene.json")
            self.assertIn("found a file; expected a folder", done.stderr)


if __name__ == "__main__":
    unittest.main()
