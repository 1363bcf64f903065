"""The commands as a user meets them: output, exit codes, help, messages."""

import json
import os
import unittest

from program import DOME, Folder, run


class Render(unittest.TestCase):
    def test_renders_a_document_beside_it(self):
        with Folder(dome=DOME) as folder:
            done = run("render", "dome.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("radiance, 1 channel, ENVI", done.stdout)
            self.assertIn("0.1 K in channel 'B'", done.stdout)
            named = [line.split("  (")[0] for line in done.stdout.splitlines() if line.startswith("dome.out/")]
            self.assertGreater(len(named), 3)
            for name in named:
                self.assertTrue((folder / name).exists(), name)
            self.assertEqual([f for f in os.listdir(folder / "dome.out") if f.endswith(".part")], [])

    def test_quiet_prints_nothing_and_output_and_log_go_where_told(self):
        with Folder(dome=DOME) as folder:
            done = run("render", "dome.json", "--quiet", "--output", "else where", "--log", "run.log", "-j", 2, cwd=folder)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            self.assertTrue(any(f.endswith("radiance.img") for f in os.listdir(folder / "else where")))
            self.assertFalse((folder / "dome.out").exists())
            log = (folder / "run.log").read_text()
            self.assertIn("info: scene: 2 objects", log)
            self.assertIn("100.0 %", log)

    def test_a_log_that_cannot_be_written_is_an_error_of_the_environment(self):
        with Folder(dome=DOME) as folder:
            done = run("render", "dome.json", "--log", "no/such/folder/run.log", cwd=folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn("cannot write the log 'no/such/folder/run.log'", done.stderr)


class Check(unittest.TestCase):
    def test_says_what_was_loaded(self):
        with Folder(dome=DOME) as folder:
            done = run("check", "dome.json", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("2 objects", done.stdout)
            self.assertIn("3 x 3 pixels", done.stdout)
            self.assertEqual(sorted(os.listdir(folder)), ["dome.json"])

    def test_locates_an_error(self):
        with Folder(dome=DOME.replace('"radius": "0.4 m"', '"radius": 0.4')) as folder:
            done = run("check", "dome.json", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(
                done.stderr,
                "dome.json:11:82: 'scene.objects[1].hemisphere.radius' is the number 0.4 without a unit, expected a length "
                'above 0 m, such as "1 m" (units: m, km, cm, mm, um, nm, ft, in)\n'
                '   11 | ...{"name": "dome", "hemisphere": {"center": ["0 m", "0 m", "0 m"], "radius": 0.4}, "material": "roof"}\n'
                "      |                                                                               ^\n",
            )

    def test_locates_a_file_that_is_not_there(self):
        text = DOME.replace('"emissivity": 1, "temperature": "40 degC"', '"emissivity": {"ecostress": "roof.txt"}')
        with Folder(dome=text) as folder:
            done = run("check", "dome.json", cwd=folder)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"^dome\.json:7:\d+: .*roof\.txt")
            self.assertEqual(done.stderr.count("dome.json:7:"), 1)
            self.assertIn('    7 |       "roof": {"emissivity": {"ecostress": "roof.txt"}}\n', done.stderr)

    def test_looks_at_all_of_several_documents(self):
        with Folder(a="{", b=DOME, c="[]") as folder:
            done = run("check", "a.json", "b.json", "c.json", "d.json", cwd=folder)
            self.assertEqual(done.returncode, 2)
            self.assertTrue(done.stdout.startswith("b.json:\nscene: 2 objects"))
            self.assertEqual(
                [line.split(":")[0] for line in done.stderr.splitlines() if line[0] != " "], ["a.json", "c.json", "ifov"]
            )

    def test_a_document_that_is_not_there(self):
        done = run("check", "/no/such/file.json")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "ifov: cannot read '/no/such/file.json': no such file\n")


class Info(unittest.TestCase):
    def test_describes_a_folder_its_record_and_its_rasters(self):
        with Folder(dome=DOME) as folder:
            self.assertEqual(run("render", "dome.json", cwd=folder).returncode, 0)
            whole = run("info", "dome.out", cwd=folder)
            self.assertEqual((whole.returncode, whole.stderr), (0, ""))
            for words in ("3 x 3 pixels, 1 channels", "B: 8.5 um", "asked      0.1 K", "9 of 9 pixels", "dome.json"):
                self.assertIn(words, whole.stdout)
            products = os.listdir(folder / "dome.out")
            record = next(f for f in products if f.endswith("run.json"))
            self.assertEqual(run("info", f"dome.out/{record}", cwd=folder).stdout, whole.stdout)
            raster = next(f for f in products if f.endswith("radiance.img"))
            for name in (raster, raster + ".hdr"):
                shown = run("info", f"dome.out/{name}", cwd=folder)
                self.assertEqual((shown.returncode, shown.stderr), (0, ""))
                self.assertIn("3 x 3 pixels, 1 bands", shown.stdout)
                self.assertIn("W m-2 sr-1 um-1", shown.stdout)

    def test_refuses_what_is_no_product(self):
        with Folder(dome=DOME, broken="{") as folder:
            (folder / "empty").mkdir()
            (folder / "other.json").write_text(json.dumps({"program": {"name": "another"}}))
            (folder / "note.txt").write_text("x")
            for name, code, words in (
                ("empty", 1, "holds no product"),
                ("other.json", 1, "this is not the record of a run"),
                ("broken.json", 1, "broken.json:1:"),
                ("note.txt", 1, "is no product that is known here"),
                ("nothing", 2, "there is no 'nothing'"),
            ):
                done = run("info", name, cwd=folder)
                self.assertEqual((done.returncode, done.stdout), (code, ""), name)
                self.assertIn(words, done.stderr)


class CommandLine(unittest.TestCase):
    def test_help_has_examples(self):
        whole = run("--help")
        self.assertEqual(whole.returncode, 0)
        self.assertIn("Exit codes", whole.stdout)
        for command in ("render", "check", "info", "study", "schema"):
            self.assertIn(command, whole.stdout)
            page = run(command, "--help")
            self.assertEqual((page.returncode, page.stderr), (0, ""))
            self.assertIn("ifov " + command, page.stdout)

    def test_version(self):
        self.assertRegex(run("--version").stdout, r"^ifov \d+\.\d+\.\d+\n(Open MPI v\S+|built without MPI)\n$")

    def test_mistakes(self):
        for arguments, words in (
            ((), "A subcommand is required"),
            (("rendr", "x.json"), "there is no command 'rendr'; did you mean 'render'?"),
            (("render",), "FILE is required"),
            (("render", "x.json", "--threads", "-1"), "threads"),
            (("render", "x.json", "--thread", "2"), "--thread"),
        ):
            done = run(*arguments)
            self.assertEqual((done.returncode, done.stdout), (1, ""), arguments)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
