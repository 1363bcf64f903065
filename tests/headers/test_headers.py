"""Every header compiles alone: it includes what it uses."""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("IFOV_BUILD", ROOT / "build"))


def compiler_and_flags():
    """The compiler of the build, with ccache before it where that is there, and per room and per folder of one the include paths
    and definitions that its sources are built with."""
    flags, compiler = {}, ["c++"]
    for command in json.loads((BUILD / "compile_commands.json").read_text()):
        file = pathlib.Path(command["file"])
        if not file.is_relative_to(ROOT / "src"):
            continue
        words = shlex.split(command["command"])
        command_line = words[1:] if pathlib.Path(words[0]).name == "ccache" else words
        compiler = ["ccache", command_line[0]] if shutil.which("ccache") else command_line[:1]
        parts = file.relative_to(ROOT / "src").parts
        kept = re.findall(r"(?:^| )(-isystem \S+|-[ID]\S+)", " ".join(words))
        for place in (parts[0], "/".join(parts[:2])):
            flags.setdefault(place, set()).update(kept)
    return compiler, {place: sorted(words) for place, words in flags.items()}


def compile_alone(compiler, flags, header, folder="src"):
    """What the compiler says to a source that includes this header alone, twice; empty where it is content."""
    words = [word for flag in flags for word in flag.split(" ")]
    # The same source for the same header, also in another clone, so that ccache knows it.
    path = pathlib.Path(header)
    name = path.relative_to(ROOT / folder).as_posix() if path.is_relative_to(ROOT) else str(path)
    alone = BUILD / "headers" / (re.sub(r"\W", "_", name) + ".cpp" if path.is_relative_to(ROOT) else "outside.cpp")
    alone.parent.mkdir(exist_ok=True)
    alone.write_text(f'#include "{name}"\n#include "{name}"\n')
    command = [*compiler, "-std=c++20", "-march=x86-64-v3", "-I", str(ROOT / folder), *words, "-c", str(alone),
               "-o", str(alone.with_suffix(".o"))]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return "" if result.returncode == 0 else f"{header} does not compile alone:\n{result.stderr[:1500]}"


def proven_by_the_build(header):
    """A source of the same name that includes this header before anything else has shown that it compiles alone."""
    source = header.with_suffix(".cpp")
    if not source.exists():
        return False
    first = re.search(r'^#include [<"]([^>"]+)', source.read_text(), re.MULTILINE)
    return first is not None and first.group(1) == str(header.relative_to(ROOT / "src"))


class Headers(unittest.TestCase):
    def test_every_header_compiles_alone(self):
        compiler, flags = compiler_and_flags()
        headers = [path for path in sorted((ROOT / "src").rglob("*.h")) if not proven_by_the_build(path)]
        self.assertGreater(len(headers), 10)

        def check(path):
            parts = path.relative_to(ROOT / "src").parts
            return compile_alone(compiler, flags.get("/".join(parts[:2]), flags.get(parts[0], [])), path)

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            complaints = [text for text in pool.map(check, headers) if text]
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))

    def test_public_headers_need_nothing_else(self):
        compiler, _ = compiler_and_flags()
        headers = sorted((ROOT / "include").rglob("*.h"))
        self.assertGreater(len(headers), 5)
        complaints = [text for text in (compile_alone(compiler, [], path, "include") for path in headers) if text]
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))

    def test_a_header_that_leans_on_its_includer_is_caught(self):
        compiler, _ = compiler_and_flags()
        with tempfile.NamedTemporaryFile("w", suffix=".h") as header:
            header.write("#pragma once\nstd::vector<int> f();\n")
            header.flush()
            self.assertIn("does not compile alone", compile_alone(compiler, [], header.name))


if __name__ == "__main__":
    unittest.main()
