"""The program with what a page of docs/developer adds, made beside the tree: its new files and its changes to old ones."""

import concurrent.futures
import functools
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
HAS_NINJA = bool(shutil.which("ninja")) and (BUILD / "build.ninja").exists()


class Page:
    """A page of docs/developer. Its blocks of code begin with a line that names their file, `// src/...`: those in ``cpp``
    are code, those in ``diff`` changes to a file of the tree."""

    def __init__(self, name):
        self.text = (ROOT / "docs/developer" / name).read_text()

    def blocks(self, language):
        """(path, text) of every block that names its file."""
        return re.findall(rf"^```{language}\n// (\S+)\n(.*?)^```", self.text, re.MULTILINE | re.DOTALL)

    def code(self, path):
        return dict(self.blocks("cpp"))[path]


def changed(text, diff):
    """A file's text after the lines of a diff: what it shows of the file has to stand there once."""
    lines = diff.splitlines(keepends=True)
    if any(line[0] not in " +-" for line in lines):
        raise AssertionError(f"a line of a diff begins with ' ', '+' or '-':\n{diff}")
    old = "".join(line[1:] for line in lines if line[0] != "+")
    new = "".join(line[1:] for line in lines if line[0] != "-")
    if text.count(old) != 1:
        raise AssertionError(f"these lines stand {text.count(old)} times in the file, not once:\n{old}")
    return text.replace(old, new)


def files_to_edit(what):
    """What the table of extending.md says: the existing files to edit in order to add such a thing."""
    rows = re.findall(rf"^\| \[{re.escape(what)}\]\([^)]*\) \| (\d+) \| ([^|]*) \|", (ROOT / "docs/developer/extending.md").read_text(), re.MULTILINE)
    if len(rows) != 1:
        raise AssertionError(f"extending.md has {len(rows)} rows '{what}'")
    files = re.findall(r"`([^`]+)`", rows[0][1])
    if len(files) != int(rows[0][0]):
        raise AssertionError(f"extending.md says {rows[0][0]} and names {len(files)} files to edit for '{what}'")
    return set(files)


@functools.lru_cache
def command_for(output):
    """The shell command by which the build makes a file."""
    text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands", "-s", output], capture_output=True, text=True, check=True).stdout
    return text.strip().splitlines()[-1]


def objects_of_the_program():
    """Objects that the program is linked of, each with the archive of its room, or None for the program's own."""
    archives = sorted(set(re.findall(r"src/\w+/libifov_\w+\.a", command_for("ifov"))))
    found = {made: archive for archive in archives for made in re.findall(r"\S+\.c(?:pp|xx)\.o", command_for(archive))}
    return found | {made: None for made in re.findall(r"\S+\.c(?:pp|xx)\.o", command_for("ifov"))}


def joining(made):
    """The file that joins an object's sources; None where it has one source."""
    file = BUILD / made.removesuffix(".o")
    return file if "/Unity/" in made else None


def sources_of(made):
    """What an object is made of, as paths from the tree's root."""
    file = joining(made)
    if file is None:
        return [re.sub(r"CMakeFiles/\w+\.dir/(.*)\.o$", r"\1", made)]
    return [str(pathlib.Path(source).relative_to(ROOT)) for source in re.findall(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE)]


class Extended:
    """A folder laid out as src/, whose files take the place of the tree's or stand beside them."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.written, self.edited = set(), set()  # paths from src/ on; `edited` are those that the tree has

    def write(self, path, text):
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        self.written.add(path)
        if (ROOT / "src" / path).exists():
            self.edited.add(path)

    def add(self, page):
        """All that a page shows whole."""
        for path, text in page.blocks("cpp"):
            if (ROOT / path).exists():
                raise AssertionError(f"{path} is in the tree")
            self.write(path.removeprefix("src/"), text)
        for path, diff in page.blocks("diff"):
            path = path.removeprefix("src/")
            old = self.folder / path if path in self.edited else ROOT / "src" / path
            self.write(path, changed(old.read_text(), diff))

    def compile(self, source, like):
        """Compiles a file as the build makes the object `like`; the object's path."""
        words = shlex.split(command_for(like))
        words = words[1 + max((i for i, word in enumerate(words[:4]) if word.endswith("ccache")), default=-1):]
        target = self.folder / (str(source).strip("/").replace("/", "-") + ".o")
        for option, value in (("-o", str(target)), ("-c", str(source)), ("-MF", str(target) + ".d")):
            words[words.index(option) + 1] = value
        words.insert(1, f"-I{self.folder}")
        result = subprocess.run(words, cwd=BUILD, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise AssertionError(result.stderr[-3000:])
        return str(target)

    def program(self):
        """The program linked anew, of the files written and of what includes a header of theirs."""
        archive_of = objects_of_the_program()
        sources = {made: sources_of(made) for made in archive_of}
        headers = {str(ROOT / "src" / path) for path in self.edited if path.endswith(".h")}
        edited = {f"src/{path}": self.folder / path for path in self.written if path.endswith(".cpp")}
        known = {source: made for made, own in sources.items() for source in own}
        stale = self.including(headers) & set(archive_of) | {known[source] for source in edited if source in known}
        tasks = {made: (self.replacing(made, sources[made], edited), made) for made in stale}
        for source, file in edited.items():
            if source not in known:
                room = [other for other in known
                        if other.split("/")[:2] == source.split("/")[:2] and "processor" not in other]
                # With the flags of a source of its folder, and so in its library.
                tasks[source] = (file, known[max(room, key=lambda other: len(os.path.commonprefix([other + "\n", source + "\n"])))])
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            compiled = dict(zip(tasks, pool.map(lambda task: self.compile(*task), tasks.values())))

        link = re.sub(r"-o ifov\b", f"-o {self.folder / 'ifov'}", command_for("ifov"))
        for archive in {archive_of[like] for _, like in tasks.values()}:
            kept = {made: compiled.get(made, made) for made in archive_of if archive_of[made] == archive}
            added = [file for what, file in compiled.items() if archive_of[tasks[what][1]] == archive and file not in kept.values()]
            if archive:
                copy = self.folder / pathlib.Path(archive).name
                subprocess.run(["ar", "rcs", copy, *kept.values(), *added], cwd=BUILD, check=True, capture_output=True)
                link = link.replace(archive, str(copy))
            else:
                for made, file in kept.items():
                    link = link.replace(made, file)
                link = link.replace(" -o ", f" {' '.join(added)} -o ", 1)
        subprocess.run(link, shell=True, cwd=BUILD, check=True, capture_output=True)
        return self.folder / "ifov"

    def replacing(self, made, sources, edited):
        """What an object is compiled of, edited files in place of the tree's."""
        if joining(made) is None:
            return edited.get(sources[0], ROOT / sources[0])
        joined = self.folder / "joined" / made.replace("/", "-").removesuffix(".o")
        joined.parent.mkdir(exist_ok=True)
        joined.write_text("".join(f'#include "{edited.get(source, ROOT / source)}"\n' for source in sources))
        return joined

    def including(self, headers):
        """Objects of the tree that depend on one of the headers."""
        if not headers:
            return set()
        text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "deps"], capture_output=True, text=True, check=True).stdout
        return {entry.partition(":")[0] for entry in text.split("\n\n")
                if any(str((BUILD / line.strip()).resolve()) in headers for line in entry.splitlines()[1:])}


@unittest.skipUnless(HAS_NINJA, "the build was not made by ninja")
class PageTest(unittest.TestCase):
    """A test of what a page adds; derived classes name the page and the row of the table in extending.md."""

    page = row = None
    program = None

    def extend(self, tree):
        """Puts what the page adds into the tree."""
        tree.add(Page(self.page))

    def setUp(self):
        name = tempfile.TemporaryDirectory()
        self.addCleanup(name.cleanup)
        self.folder = pathlib.Path(name.name)
        tree = Extended(self.folder / "src")
        self.extend(tree)
        self.assertEqual({f"src/{path}" for path in tree.edited}, files_to_edit(self.row))
        self.program = tree.program()

    def run_it(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=100, check=False)
