"""The program with files put beside those of the tree, as pages of docs/developer show them."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov")))
BUILD = PROGRAM.parent
HAS_NINJA = bool(shutil.which("ninja")) and (BUILD / "build.ninja").exists()


class Page:
    """A page of docs/developer whose code blocks begin with the name of their file."""

    def __init__(self, name):
        self.text = (ROOT / "docs/developer" / name).read_text()

    def code(self, path):
        return re.search(rf"^```cpp\n// {re.escape(path)}\n(.*?)^```", self.text, re.MULTILINE | re.DOTALL).group(1)


def command_for(output):
    """The shell command by which the build makes a file."""
    text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands", output], capture_output=True, text=True, check=True).stdout
    return text.strip().splitlines()[-1]


class Extended:
    """Sources in a folder of their own, laid out as src/, which take the place of the room's or stand beside them."""

    def __init__(self, folder, room):
        self.folder, self.archive = pathlib.Path(folder), f"src/{room}/libifov_{room}.a"

    def write(self, path, text):
        """`path` from src/ on."""
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def compile(self, source, like):
        """An object file of a source, made as the build makes that of the source `like` of the room."""
        made = next(word for word in command_for(self.archive).split() if word.endswith(f"/{like}.o"))
        words = [word for word in shlex.split(command_for(made)) if not word.endswith("ccache")]
        target = self.folder / (source.name + ".o")
        for option, value in (("-o", str(target)), ("-c", str(source)), ("-MF", str(target) + ".d")):
            words[words.index(option) + 1] = value
        words[-1] = str(source)
        words.insert(1, f"-I{self.folder}")
        result = subprocess.run(words, cwd=BUILD, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise AssertionError(result.stderr[-3000:])
        return target

    def program(self, sources, replaced):
        """The program linked with these sources, one of which takes the place of the room's `replaced`."""
        archive = self.folder / pathlib.Path(self.archive).name
        shutil.copy(BUILD / self.archive, archive)
        subprocess.run(["ar", "d", archive, f"{replaced}.o"], check=True)
        objects = [self.compile(source, replaced) for source in sources]
        subprocess.run(["ar", "r", archive, *objects], check=True, capture_output=True)
        program = self.folder / "ifov"
        link = re.sub(r"-o ifov\b", f"-o {program}", command_for("ifov").replace(self.archive, str(archive)))
        if str(program) not in link:
            raise AssertionError(link)
        subprocess.run(link, shell=True, cwd=BUILD, check=True, capture_output=True)
        return program
