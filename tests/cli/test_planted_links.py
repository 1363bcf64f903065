"""Archives of scenes from strangers: links under the names that ifov writes are not followed.

Each row plants one link (or second name) beside a document that is then rendered. What it leads to stays as it was; the
run either replaces the link by its own file, or refuses and names the link.
"""

import os
import pathlib
import unittest

from program import DOME, Folder, run

REFUSED, REPLACED = "refused", "replaced"
PRECIOUS = "export PATH=/usr/bin\n"
RESULT = "x.out"

# Where the link stands; what it leads to (a file or a folder of the user's); what becomes of it.
PLANTED = [
    ("the output folder", "x.out", "folder", REFUSED),
    ("the folder that the document names", "products", "folder", REFUSED),
    ("a folder above the one that the document names", "a", "folder", REFUSED),
    ("a cube that is being written", "x.out/image_radiance.img.part", "file", REPLACED),
    ("a cube", "x.out/image_radiance.img", "file", REPLACED),
    ("a header", "x.out/image_radiance.img.hdr.part", "file", REPLACED),
    ("the GeoTIFF", "x.out/image_radiance.tif.part", "file", REPLACED),
    ("the style for QGIS", "x.out/image_radiance.qml.part", "file", REPLACED),
    ("the picture", "x.out/image_quicklook.png.part", "file", REPLACED),
    ("the report", "x.out/image_report.html.part", "file", REPLACED),
    ("the run record", "x.out/image_run.json.part", "file", REPLACED),
    ("the folder of the run's state", "x.out/run.part", "folder", REFUSED),
    ("the lock", "x.out/run.part/lock", "file", REPLACED),
    ("the state", "x.out/run.part/state.json.part", "file", REPLACED),
    ("the folder of tiles", "x.out/run.part/tiles", "folder", REPLACED),
    ("the scene cache", "x.ifovcache", "file", REPLACED),
]


class Stranger:
    """A document in an unpacked archive, and the user's own files beside it."""

    def __init__(self, folder, text=DOME):
        self.home = folder / "home"
        self.scene = folder / "scene"
        for place in (self.home / "folder", self.scene):
            place.mkdir(parents=True)
        (self.home / "file").write_text(PRECIOUS)
        (self.home / "folder" / "000000.part").write_text(PRECIOUS)
        self.document = self.scene / "x.json"
        self.document.write_text(text)

    def plant(self, name, target):
        link = self.scene / name
        link.parent.mkdir(parents=True, exist_ok=True)
        link.symlink_to(self.home / target)
        return link

    def contents(self):
        return {str(p): p.read_text() for p in sorted(self.home.rglob("*")) if p.is_file()}


def document_for(name):
    formats = DOME.replace('["envi", "png"]', '["envi", "png", "geotiff", "html"]')
    if name == "products":
        return formats.replace('"output": {', '"output": {"folder": "products", ')
    if name == "a":
        return formats.replace('"output": {', '"output": {"folder": "a/b", ')
    if name == "x.ifovcache":  # only large meshes are kept in it
        return formats.replace('{"plane": {}, "material": "ground"}', '{"mesh": {"file": "large.obj"}, "material": "ground"}')
    return formats


def large_obj():
    cells = range(100)
    vertices = "".join(f"v {x} {y} 0\n" for y in range(101) for x in range(101))
    faces = "".join(f"f {y * 101 + x + 1} {y * 101 + x + 2} {y * 101 + x + 103} {y * 101 + x + 102}\n" for y in cells for x in cells)
    return vertices + faces


class PlantedLinks(unittest.TestCase):
    def test_no_link_is_followed(self):
        self.assertGreaterEqual(len(PLANTED), 12)
        for title, name, target, fate in PLANTED:
            with self.subTest(title), Folder() as folder:
                stranger = Stranger(folder, document_for(name))
                (stranger.scene / "large.obj").write_text(large_obj())
                link = stranger.plant(name, target)
                before = stranger.contents()
                done = run("render", stranger.document)
                self.assertEqual(stranger.contents(), before)
                if fate == REFUSED:
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertIn(f"ifov: '{link}' is a link (to '{stranger.home / target}')", done.stderr)
                    self.assertIn("--output", done.stderr)
                else:
                    self.assertIn(done.returncode, (0, 6), done.stderr)
                    self.assertFalse(link.is_symlink(), "the link is still there")

    def test_second_names_of_files_are_not_written_over(self):
        for name in ("x.out/image_radiance.img.part", "x.out/image_radiance.tif.part", "x.out/run.part/lock"):
            with self.subTest(name), Folder() as folder:
                stranger = Stranger(folder, document_for(name))
                (stranger.scene / name).parent.mkdir(parents=True)
                os.link(stranger.home / "file", stranger.scene / name)
                before = stranger.contents()
                done = run("render", stranger.document)
                self.assertIn(done.returncode, (0, 6), done.stderr)
                self.assertEqual(stranger.contents(), before)

    def test_a_pipe_makes_nobody_wait(self):
        for name in ("x.out/image_radiance.img.part", "x.out/run.part/lock", "x.ifovcache"):
            with self.subTest(name), Folder() as folder:
                stranger = Stranger(folder)
                (stranger.scene / name).parent.mkdir(parents=True, exist_ok=True)
                os.mkfifo(stranger.scene / name)
                self.assertIn(run("render", stranger.document).returncode, (0, 6))

    def test_states_of_runs_are_read_through_no_link(self):
        secret = "top secret words"
        for name in ("x.out/run.part/state.json", "x.out/run.kept/state.json"):
            with self.subTest(name), Folder() as folder:
                stranger = Stranger(folder)
                (stranger.home / "file").write_text(secret)
                stranger.plant(name, "file")
                for command in (["render", stranger.document], ["render", stranger.document, "--resume"],
                                ["render", stranger.document, "--refine"], ["status", stranger.scene / "x.out"]):
                    done = run(*command)
                    self.assertNotIn(secret, done.stdout + done.stderr)

    def test_a_log_that_is_a_link(self):
        with Folder() as folder:
            stranger = Stranger(folder)
            stranger.plant("run.log", "file")
            done = run("render", stranger.document, "--log", stranger.scene / "run.log")
            self.assertEqual(done.returncode, 2)
            self.assertIn("run.log': it is a link to", done.stderr)
            self.assertEqual((stranger.home / "file").read_text(), PRECIOUS)
            self.assertIn(run("render", stranger.document, "--log", "/dev/null").returncode, (0, 6))

    def test_figures_replace_links(self):
        with Folder() as folder:
            stranger = Stranger(folder)
            link = stranger.plant("grass.png", "file")
            self.assertEqual(run("materials", "grass", "--plot", link, cwd=folder).returncode in (0, 1), True)
            self.assertEqual((stranger.home / "file").read_text(), PRECIOUS)

    def test_the_users_own_folder_may_be_a_link(self):
        with Folder() as folder:
            stranger = Stranger(folder)
            link = stranger.plant("mine", "folder")
            done = run("render", stranger.document, "--output", link)
            self.assertIn(done.returncode, (0, 6), done.stderr)
            self.assertTrue((stranger.home / "folder" / "image_run.json").exists())
            # The folder that holds the document may be one as well.
            (folder / "shortcut").symlink_to(stranger.scene)
            done = run("render", folder / "shortcut" / "x.json")
            self.assertIn(done.returncode, (0, 6), done.stderr)
            self.assertTrue((pathlib.Path(stranger.scene) / RESULT / "image_run.json").exists())


if __name__ == "__main__":
    unittest.main()
