"""What files do to messages and to the process: control characters, long lines, marks at the start, files that shrink or
may not grow."""

import json
import os
import pathlib
import resource
import subprocess
import time
import unittest

from program import DOME, PROGRAM, Folder, run
from test_inputs_below import copies, lawn, thing
from test_mistakes import GOOD, OBJECTS, WARM, ascii_grid, box_obj, changed

ESCAPES = "\x1b[2J\x1b]0;title\x07\r\u202egnp"
RAW = ("\x1b", "\x07", "\r", "\u202e", "\x9b", "\x08")
OBJ = box_obj((-1, -1, 0), (1, 1, 3))


class Terminal(unittest.TestCase):
    def expect_clean(self, text):
        for symbol in RAW:
            self.assertNotIn(symbol, text)

    def test_names_in_documents(self):
        document = json.loads(json.dumps(GOOD).replace("lawn", "la" + ESCAPES.encode("unicode_escape").decode().replace("\\x", "\\u00") + "wn"))
        with Folder(scene=json.dumps(document)) as folder:
            log = folder / "log"
            for command in (["check", folder / "scene.json"], ["render", folder / "scene.json", "--log", log],
                            ["info", folder / "scene.out"]):
                with self.subTest(command[0]):
                    done = run(*command)
                    self.expect_clean(done.stdout + done.stderr)
            self.expect_clean(log.read_text())

    def test_names_of_what_is_not_there(self):
        for document in (changed(OBJECTS + "[1].material", "wa" + ESCAPES), thing({"mesh": {"file": ESCAPES + ".obj"}}),
                         changed("light.sky", {"radiance": "1 " + ESCAPES}), changed("sampling." + "accuracy", {ESCAPES: 1})):
            with Folder(scene=json.dumps(document)) as folder:
                done = run("check", folder / "scene.json")
                self.assertEqual(done.returncode, 1)
                self.expect_clean(done.stderr)
                self.assertIn("\\x1b[2J", done.stderr)

    def test_lines_of_files(self):
        rows = [
            ("a.obj", f"usemtl {ESCAPES}\nv 0 0 {ESCAPES}\n", thing({"mesh": {"file": "a.obj"}})),
            ("a.ply", f"ply\nformat {ESCAPES} 1.0\n", thing({"mesh": {"file": "a.ply"}})),
            ("a.csv", f"0.4,{ESCAPES}\n0.5,1\n", lawn({"csv": "a.csv", "wavelength_unit": "um"})),
            ("i.csv", f"0,0,0\n0,0,{ESCAPES}\n", copies({"csv": "i.csv"})),
            ("a.asc", f"ncols 4\nnrows {ESCAPES}\n", changed(OBJECTS + "[0].temperature", {"map": {"file": "a.asc", "unit": "K"}})),
            ("c.json", '{"type": "' + "\\u001b[2J" + '"}', thing({"city": {"file": "c.json"}})),
        ]
        for name, text, document in rows:
            with self.subTest(name), Folder(scene=json.dumps(document)) as folder:
                (folder / name).write_text(text)
                done = run("check", folder / "scene.json")
                self.assertEqual(done.returncode, 1, done.stderr)
                self.expect_clean(done.stderr)

    def test_names_of_files(self):
        with Folder() as folder:
            path = folder / f"a{ESCAPES}.json"
            path.write_text(DOME)
            done = run("render", path)
            self.assertIn(done.returncode, (0, 6))
            self.expect_clean(done.stdout + done.stderr)
            self.expect_clean(run("check", folder / (ESCAPES + "none")).stderr)
            self.expect_clean(run(ESCAPES).stderr)
            self.expect_clean(run("check", "--" + ESCAPES).stderr)

    def test_messages_have_an_end(self):
        with Folder(scene=json.dumps(changed(OBJECTS + "[1].material", "w" * 1000000))) as folder:
            done = run("check", folder / "scene.json")
            self.assertEqual(done.returncode, 1)
            self.assertLess(len(done.stderr), 10000)
            self.assertTrue(done.stderr.endswith("…\n"))


class Reading(unittest.TestCase):
    def test_a_mark_at_the_start(self):
        """Text editors on Windows put U+FEFF before a text."""
        mark = "\ufeff"
        gltf = run_gltf()
        rows = [
            ("a.obj", OBJ, thing({"mesh": {"file": "a.obj"}})),
            ("a.gltf", gltf, thing({"mesh": {"file": "a.gltf"}})),
            ("a.csv", "0.4,0.1\n15,0.3\n", lawn({"csv": "a.csv", "wavelength_unit": "um"})),
            ("i.csv", "2,2,0\n4,4,0\n", copies({"csv": "i.csv"})),
        ]
        for name, text, document in rows:
            with self.subTest(name), Folder() as folder:
                said = []
                for start in ("", mark):
                    (folder / "scene.json").write_text(start + json.dumps(document))
                    (folder / name).write_text(start + text)
                    done = run("check", "--no-cache", folder / "scene.json")
                    self.assertIn(done.returncode, (0, 6), done.stderr)
                    said.append((done.returncode, done.stdout))
                self.assertEqual(*said)

    def test_a_folder_says_that_it_is_one(self):
        for name, document in (("f.obj", thing({"mesh": {"file": "f.obj"}})), ("f.ply", thing({"mesh": {"file": "f.ply"}})),
                               ("f.csv", lawn({"csv": "f.csv", "wavelength_unit": "um"})),
                               ("f.asc", changed(OBJECTS + "[0].temperature", {"map": {"file": "f.asc", "unit": "K"}}))):
            with self.subTest(name), Folder(scene=json.dumps(document, indent=1)) as folder:
                (folder / name).mkdir()
                done = run("check", folder / "scene.json")
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"cannot read '{folder / name}': it is a folder", done.stderr)

    def test_pipes_and_devices_make_nobody_wait(self):
        with Folder(scene=json.dumps(thing({"mesh": {"file": "f.obj"}}))) as folder:
            os.mkfifo(folder / "f.obj")
            self.assertIn("it is not a plain file", run("check", folder / "scene.json").stderr)
        for device in ("/dev/zero", "/dev/stdin"):
            with Folder(scene=json.dumps(lawn({"csv": device, "wavelength_unit": "um"}))) as folder:
                self.assertIn("it is not a plain file", run("check", folder / "scene.json").stderr)
        with Folder(scene=json.dumps(changed(OBJECTS + "[0].temperature", {"map": {"file": "w.asc", "unit": "K"}}))) as folder:
            (folder / "w.asc").write_text(ascii_grid(WARM))
            os.mkfifo(folder / "w.asc.aux.xml")  # GDAL looks for it
            self.assertIn(run("check", "--no-cache", folder / "scene.json").returncode, (0, 6))

    def test_a_list_of_no_copies(self):
        for text in ("", "# x, y, z\n", "x,y,z\n"):
            with self.subTest(text), Folder(scene=json.dumps(copies({"csv": "i.csv"}))) as folder:
                (folder / "i.csv").write_text(text)
                done = run("check", folder / "scene.json")
                self.assertEqual(done.returncode, 6, done.stderr)
                self.assertIn("i.csv' holds no copies: nothing is placed", done.stderr)
                self.assertIn(run("render", folder / "scene.json").returncode, (0, 5, 6))

    def test_a_prototype_of_no_copies(self):
        document = copies({"at": [["0 m", "0 m", "0 m"]]})
        document["scene"]["prototypes"]["row"] = [{"instances": {"of": "post", "csv": "i.csv"}}]
        document["scene"]["objects"].append({"instance": {"of": "row"}})
        with Folder(scene=json.dumps(document)) as folder:
            (folder / "i.csv").write_text("x,y,z\n")
            done = run("render", folder / "scene.json")
            self.assertIn(done.returncode, (0, 5, 6), done.stderr)
            self.assertIn("i.csv' holds no copies", done.stderr)

    def test_a_file_that_shrinks_while_it_is_read(self):
        with Folder(scene=json.dumps(copies({"csv": "i.csv"}))) as folder:
            rows = folder / "i.csv"
            rows.write_text("0.001,0.002,0.003,0.5\n" * 2500000)
            with subprocess.Popen([PROGRAM, "check", "--no-cache", str(folder / "scene.json")], stderr=subprocess.PIPE,
                                  stdout=subprocess.PIPE, text=True) as process:
                maps = pathlib.Path(f"/proc/{process.pid}/maps")
                while process.poll() is None and str(rows) not in maps.read_text():
                    time.sleep(0.0005)
                os.truncate(rows, 0)
                _, words = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 2, words)
            self.assertIn(f"ifov: '{rows}' was cut short, or its disk failed, while it was being read\n", words)


def run_gltf():
    """A triangle, its numbers in the file itself."""
    import base64
    import struct

    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, -1)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"uri": uri, "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, -1], "max": [1, 1, 0]}],
    })


class Writing(unittest.TestCase):
    def test_a_limit_on_the_size_of_files(self):
        for limit in (100, 5000):
            with self.subTest(limit), Folder(scene=DOME.replace("[3, 3]", "[100, 100]")) as folder:
                done = subprocess.run([PROGRAM, "render", str(folder / "scene.json")], capture_output=True, text=True, timeout=60,
                                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn("the file would be larger than the system allows (ulimit -f)", done.stderr)


if __name__ == "__main__":
    unittest.main()
