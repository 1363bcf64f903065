"""The Debian package holds what it is to hold, names the packages that it needs, and works where it is unpacked."""

import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("IFOV_BUILD", ROOT / "build")).resolve()
sys.path.insert(0, str(ROOT / "tools"))
import make_deb  # noqa: E402  (finds manual beside it)
import manual  # noqa: E402
import policy  # noqa: E402

HAS_PYTHON = any((BUILD / "venv").glob("lib/python3.*/site-packages/ifov/_ifov.*"))


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for tool in ("dpkg-deb", "dpkg", "readelf", "cmake"):
            if not shutil.which(tool):
                raise unittest.SkipTest(f"{tool} is not there")
        settings = (BUILD / "CMakeCache.txt").read_text() if (BUILD / "CMakeCache.txt").exists() else ""
        if not settings or re.search(r"IFOV_SANITIZE:\w+=(?!OFF)\w", settings):
            raise unittest.SkipTest("no build to make a package of")
        cls._folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls._folder.name)
        cls.package = make_deb.make(BUILD, folder, HAS_PYTHON, "none")
        cls.root = folder / "unpacked"
        subprocess.run(["dpkg-deb", "-R", cls.package, cls.root], check=True)
        cls.files = {str(file.relative_to(cls.root)) for file in cls.root.rglob("*") if file.is_symlink() or not file.is_dir()}

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def environment(self):
        return {**os.environ, "LD_LIBRARY_PATH": str(self.root / "usr/lib"), "PYTHONPATH": str(self.root / "usr/lib/python3/dist-packages")}

    def test_what_is_in_it(self):
        version = make_deb.version()
        wanted = {"usr/bin/ifov", "usr/lib/pkgconfig/ifov.pc", "usr/share/bash-completion/completions/ifov", "usr/share/man/man1/ifov.1.gz"}
        wanted |= {f"usr/lib/libifov.so{end}" for end in ("", "." + ".".join(version.split(".")[:2]), "." + version)}
        wanted |= {f"usr/lib/cmake/ifov/ifov{name}.cmake" for name in ("Config", "ConfigVersion", "Targets")}
        wanted |= {f"usr/include/ifov/{header.name}" for header in (ROOT / "include/ifov").glob("*.h")}
        wanted |= {f"usr/share/man/man1/ifov-{command}.1.gz" for command in manual.commands(BUILD / "ifov")}
        wanted |= {f"usr/share/doc/ifov/{name}" for name in ("copyright", "changelog.gz", "CHANGELOG.md.gz", "LICENSE", "NOTICE", "guide/python.md")}
        wanted |= {f"DEBIAN/{name}" for name in ("control", "md5sums", "shlibs", "triggers")}
        wanted.add("usr/share/lintian/overrides/ifov")
        if HAS_PYTHON:
            wanted |= {"DEBIAN/postinst", "DEBIAN/prerm"}
            wanted |= {f"usr/lib/python3/dist-packages/ifov/{file.name}" for file in (ROOT / "python/ifov").iterdir() if file.is_file()}
        self.assertEqual(wanted - self.files, set())
        rest = re.compile(
            r"usr/share/doc/ifov/(guide|formats|images|notebooks|examples)/|usr/lib/cmake/ifov/ifovTargets-\w+\.cmake"
            r"|usr/lib/python3/dist-packages/ifov(/_ifov\.cpython-3\d+-\w+-linux-gnu\.so|-[0-9.]+\.dist-info/)"
        )
        self.assertEqual(sorted(file for file in self.files - wanted if not rest.match(file)), [])
        self.assertEqual([file for file in self.files if "__pycache__" in file or file.endswith(".pyc")], [])

    def test_the_machine_that_made_it_is_not_in_it(self):
        for name in self.files:
            file = self.root / name
            if name.endswith((".cmake", ".pc", "control", "METADATA")):
                self.assertNotIn(str(BUILD), file.read_text(encoding="utf-8"), name)
            if re.search(r"\.so[.0-9]*$|bin/ifov$", name) and not file.is_symlink():
                paths = re.findall(r"\(R(?:UN)?PATH\).*\[(.*)\]", subprocess.run(["readelf", "-dW", file], capture_output=True, text=True).stdout)
                self.assertIn(paths, ([], ["$ORIGIN"]), name)

    def test_what_it_needs(self):
        control = (self.root / "DEBIAN/control").read_text(encoding="utf-8")
        needs = re.search(r"^Depends: (.*)$", control, re.MULTILINE).group(1)
        # What is linked, what is loaded late, and what Python asks for.
        for package in (r"libembree\d\S*", r"libtbb\d+\S*", r"libgdal\d+\S*", r"libgeos-c\S+", r"libnetcdf\d+\S*", r"libc6 \(>= \S+\)"):
            self.assertRegex(needs, rf"(^|, ){package}(,|$)")
        self.assertEqual("python3-xarray" in needs, HAS_PYTHON)
        self.assertNotIn("-dev", needs)

    def test_lintian_finds_nothing(self):
        """But that a package made at home has no address to write to, where DEBEMAIL gives none."""
        if not shutil.which("lintian"):
            self.skipTest("lintian is not installed")
        done = subprocess.run(["lintian", "--allow-root", "--tag-display-limit", "0", self.package], capture_output=True, text=True, check=False)
        # The package of this test is not compressed.
        found = [line for line in done.stdout.splitlines() if re.match(r"[EW]: ", line) and not re.search("bogus-mail-host|uses-no-compression", line)]
        self.assertEqual(found, [], done.stderr)
        # Without the list of what is so on purpose it is found: they are looked for.
        own = subprocess.run(["lintian", "--allow-root", "--no-override", self.package], capture_output=True, text=True, check=False).stdout
        for tag in policy.ON_PURPOSE:
            self.assertIn(f" {tag} ", own)

    def test_licence_changes_and_library(self):
        read = lambda name: (self.root / "usr/share/doc/ifov" / name).read_bytes()
        licence = read("copyright").decode()
        self.assertIn("/usr/share/common-licenses/Apache-2.0", licence)
        for line in (ROOT / "NOTICE").read_text(encoding="utf-8").splitlines():
            self.assertIn(line, licence)
        self.assertEqual(gzip.decompress(read("CHANGELOG.md.gz")).decode(), (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
        parsed = subprocess.run(["dpkg-parsechangelog", "-l", "-"], input=gzip.decompress(read("changelog.gz")), capture_output=True, check=False) \
            if shutil.which("dpkg-parsechangelog") else None
        if parsed:
            self.assertEqual((parsed.returncode, parsed.stderr), (0, b""))
            self.assertIn(f"Version: {make_deb.version()}", parsed.stdout.decode())
        soname = re.search(r"SONAME.*\[libifov\.so\.(.*)\]", subprocess.run(["readelf", "-dW", self.root / "usr/lib/libifov.so"], capture_output=True, text=True).stdout)
        self.assertEqual((self.root / "DEBIAN/shlibs").read_text().split()[:2], ["libifov", soname.group(1)])

    def test_sums(self):
        subprocess.run(["md5sum", "--quiet", "--check", "DEBIAN/md5sums"], cwd=self.root, check=True)
        listed = {line.split("  ")[1] for line in (self.root / "DEBIAN/md5sums").read_text().splitlines()}
        self.assertEqual(listed, {f for f in self.files if f.startswith("usr/") and not (self.root / f).is_symlink()})

    def test_the_program_and_the_package_work(self):
        said = subprocess.run([self.root / "usr/bin/ifov", "--version"], capture_output=True, text=True, check=True).stdout
        self.assertIn(make_deb.version(), said)
        if not HAS_PYTHON:
            self.skipTest("the Python package was not made")
        code = "import ifov; print(ifov.__file__, ifov.version(), len(ifov.schema()) > 3, open('/proc/self/maps').read().count('libifov.so') > 0)"
        done = subprocess.run(["/usr/bin/python3", "-c", code], capture_output=True, text=True, env=self.environment(), check=False, cwd="/")
        self.assertEqual(done.stdout.split()[1:], [make_deb.version(), "True", "True"], done.stderr)
        self.assertTrue(done.stdout.startswith(str(self.root)), done.stdout)

    def test_python_is_compiled_where_it_is_installed(self):
        if not HAS_PYTHON:
            self.skipTest("the Python package was not made")
        for name, word in (("postinst", "py3compile -p ifov"), ("prerm", "py3clean -p ifov")):
            script = self.root / "DEBIAN" / name
            self.assertIn(word, script.read_text())
            self.assertEqual(script.stat().st_mode & 0o777, 0o755)
            subprocess.run(["sh", "-n", script], check=True)

    def test_manual_pages_say_what_help_says(self):
        for command in (None, *manual.commands(BUILD / "ifov")):
            name = f"ifov-{command}" if command else "ifov"
            page = gzip.decompress((self.root / f"usr/share/man/man1/{name}.1.gz").read_bytes()).decode()
            plain = re.sub(r"\\f[BR]|\\&", "", page).replace("\\-", "-").replace("\\e", "\\").lower()
            help_text = manual.help_of(BUILD / "ifov", *([command] if command else []))
            missing = [word for word in re.findall(r"[\w./'\"-]{3,}", help_text.lower()) if word.rstrip(".") not in plain]
            self.assertEqual([word for word in missing if word not in ("usage", "positionals", "subcommands")], [], name)
            if shutil.which("groff"):
                told = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-z"], input=page, capture_output=True, text=True, check=True).stderr
                self.assertEqual([line for line in told.splitlines() if "cannot adjust" not in line and "break" not in line], [], name)

    def test_completion(self):
        if not shutil.which("bash"):
            self.skipTest("bash is not there")
        script = self.root / "usr/share/bash-completion/completions/ifov"

        def completed(*words):
            quoted = " ".join(f"'{word}'" for word in words)
            code = f"source {script}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _ifov; echo \"${{COMPREPLY[@]}}\""
            return subprocess.run(["bash", "--norc", "-c", code], capture_output=True, text=True, check=True, cwd=ROOT).stdout.split()

        self.assertEqual(completed("ifov", "re"), ["render"])
        self.assertEqual(sorted(completed("ifov", "render", "--res")), ["--restart", "--resume"])
        self.assertEqual(completed("ifov", "render", "READ"), ["README.md"])


if __name__ == "__main__":
    unittest.main()
