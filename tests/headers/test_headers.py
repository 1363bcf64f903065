"""Headers compile alone: they include what they use."""

import concurrent.futures
import functools
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
FLAGS = ["-std=c++20", "-march=x86-64-v3"]


def first_source(file):
    """Of sources that the build joins in a file of its own, the first; else the file itself."""
    if not file.is_relative_to(BUILD) or not file.exists():
        return file
    included = re.search(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE)
    return pathlib.Path(included.group(1)) if included else file


def chains(headers):
    """The headers in lists, each header of which includes all before it, itself or by others: compiled in this order, each
    shows what it would show alone, and one source for many takes a fraction of the time."""
    names = {header.relative_to(ROOT / "src").as_posix(): header for header in sorted((ROOT / "src").rglob("*.h"))}
    includes = {name: [n for n in re.findall(r'^#include "([^"]+)"', header.read_text(), re.MULTILINE) if n in names]
                for name, header in names.items()}

    @functools.cache
    def brings(name):
        return frozenset().union(*({n} | brings(n) for n in includes[name]))

    by_last = {}
    for name in sorted((n for n, header in names.items() if header in headers), key=lambda n: (len(brings(n)), n)):
        before = max((n for n in by_last if n in brings(name)), key=lambda n: (len(brings(n)), n), default=None)
        by_last[name] = [*by_last.pop(before, []), names[name]]
    return list(by_last.values())


def compiler_and_flags():
    """The compiler of the build, with ccache before it where that is there, and per room and per folder of one the include paths
    and definitions that its sources are built with."""
    flags, compiler = {}, ["c++"]
    for command in json.loads((BUILD / "compile_commands.json").read_text()):
        file = first_source(pathlib.Path(command["file"]))
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


def words_of(flags):
    return [word for flag in flags for word in flag.split(" ")]


def caches(compiler):
    """Whether ccache keeps what is compiled: then nothing need be quick but what changed."""
    return len(compiler) > 1 and "CCACHE_DISABLE" not in os.environ


# Parsing these is most of what a header costs. Where the build joins sources, they are compiled before, for all headers at once: what a
# header then has of the standard library without bringing it is found by its text (missing_of_the_standard_library), and by builds
# that compile each source alone.
STANDARD = ("algorithm array atomic chrono cmath complex condition_variable cstddef cstdint filesystem functional initializer_list limits map "
            "memory mutex numbers optional set span stdexcept string string_view thread tuple type_traits utility variant vector").split()


def joins_sources():
    return any("/Unity/" in command["file"] for command in json.loads((BUILD / "compile_commands.json").read_text()))


def compiled_before(compiler, flags, folder):
    """Words that have a source take STANDARD as it is once compiled with these flags."""
    header = pathlib.Path(folder) / "standard.h"
    header.write_text("".join(f"#include <{name}>\n" for name in STANDARD))
    subprocess.run([compiler[-1], *FLAGS, *words_of(flags), "-x", "c++-header", str(header), "-o", f"{header}.gch"], capture_output=True,
                   check=True)
    return ["-include", str(header)]


def standard_headers_of(header):
    """What of the standard library a header brings, itself or by others of ours, by name."""
    return set(_standard_headers(header))


@functools.cache
def _standard_headers(header):
    text = header.read_text()
    others = [ROOT / "src" / name for name in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE)]
    return frozenset(re.findall(r"^#include <(\w+)>", text, re.MULTILINE)).union(
        *(_standard_headers(other) for other in others if other.exists()))


def compile_alone(compiler, flags, chain, folder="src", before=()):
    """What the compiler says to a source that includes these headers (chains()) and nothing else, twice; empty where it is
    content. `before`: compiled_before()."""
    words = [*words_of(flags), *before]
    # The same source for the same header, also in another clone, so that ccache knows it.
    path = chain[-1]
    names = [header.relative_to(ROOT / folder).as_posix() if header.is_relative_to(ROOT) else str(header) for header in chain]
    alone = BUILD / "headers" / (re.sub(r"\W", "_", names[-1]) + ".cpp" if path.is_relative_to(ROOT) else "outside.cpp")
    alone.parent.mkdir(exist_ok=True)
    alone.write_text("".join(f'#include "{name}"\n' for name in [*names, *names]))
    # ccache keeps objects alone.
    what = ["-c", "-o", str(alone.with_suffix(".o"))] if caches(compiler) else ["-fsyntax-only"]
    command = [*compiler, *FLAGS, "-I", str(ROOT / folder), *words, *what, str(alone)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return "" if result.returncode == 0 else f"{', '.join(map(str, chain))}: does not compile alone:\n{result.stderr[:1500]}"


def comes_first(header):
    """Whether a source of the same name includes this header before anything else: compiled alone, or first of those it is joined
    with, it shows that the header compiles alone."""
    source = header.with_suffix(".cpp")
    first = re.search(r'^#include [<"]([^>"]+)', source.read_text(), re.MULTILINE) if source.exists() else None
    return first is not None and first.group(1) == str(header.relative_to(ROOT / "src"))


# Which headers of the standard library bring a name of it; of names that many bring, nothing is said.
BRINGS = {
    **{name: {name} for name in ("any", "array", "atomic", "bitset", "complex", "deque", "function", "future", "list", "map", "mutex",
                                 "numbers", "optional", "set", "span", "thread", "tuple", "unordered_map", "unordered_set", "variant",
                                 "vector", "filesystem", "chrono", "condition_variable", "initializer_list")},
    "initializer_list": {"initializer_list", "vector", "string", "map", "set", "array", "algorithm", "span", "memory"},
    "tuple": {"tuple", "memory", "functional", "map", "filesystem", "mutex", "thread", "variant"},
    "array": {"array", "functional", "span"},
    "function": {"functional"},
    "string": {"string", "filesystem", "stdexcept", "ostream", "istream", "sstream"},
    "string_view": {"string_view", "string", "filesystem"},
    **{name: {"memory"} for name in ("unique_ptr", "make_unique", "make_shared")},
    "shared_ptr": {"memory", "filesystem", "future"},
    **{name: {"cstdint"} for name in ("uint8_t", "uint16_t")},
    "numeric_limits": {"limits"},
    **{name: {"stdexcept"} for name in ("invalid_argument", "logic_error", "runtime_error", "out_of_range")},
    **{name: {"cmath"} for name in ("sqrt", "floor", "hypot", "atan2", "sin", "cos", "exp", "isnan", "isfinite", "pow", "lround", "cbrt", "copysign")},
    **{name: {"algorithm"} for name in ("clamp", "find", "upper_bound", "lower_bound", "any_of", "transform", "binary_search")},
    **{name: {"algorithm", "functional", "memory", "string", "vector", "filesystem", "span", "map"} for name in ("min", "max")},
    **{name: {"cstring"} for name in ("memcpy", "memset")},
}


def missing_of_the_standard_library(header):
    """Names of the standard library that a header uses and nothing that it includes brings, with what would."""
    code = re.sub(r"//[^\n]*|\"(?:[^\"\\\n]|\\.)*\"", "", header.read_text())
    brought = standard_headers_of(header)
    return [f"{header}: std::{name} of <{'> or <'.join(sorted(BRINGS[name]))}>"
            for name in sorted(set(re.findall(r"\bstd::(\w+)", code)) & BRINGS.keys()) if not BRINGS[name] & brought]


class Headers(unittest.TestCase):
    def test_headers_without_a_source_compile_alone(self):
        """Those that come first in a source of their own are shown by builds that compile each source alone (TYPE, COMPILER)."""
        compiler, flags = compiler_and_flags()
        headers = {path for path in (ROOT / "src").rglob("*.h") if not comes_first(path)}
        self.assertGreater(len(headers), 10)

        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
            shared = set.intersection(*map(set, flags.values()))
            before = compiled_before(compiler, sorted(shared), folder) if joins_sources() and not caches(compiler) else ()

            def check(chain):
                # What a folder's sources are compiled with, of all headers here: it adds paths and definitions alone.
                parts = [path.relative_to(ROOT / "src").parts for path in chain]
                own = {flag for p in parts for flag in flags.get("/".join(p[:2]), flags.get(p[0], []))}
                return compile_alone(compiler, sorted(own), chain, before=before)

            complaints = [text for text in pool.map(check, chains(headers)) if text]
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))

    def test_headers_bring_what_they_use_of_the_standard_library(self):
        """Of all headers, by their text: what joined sources would hide."""
        headers = sorted((ROOT / "src").rglob("*.h"))
        self.assertGreater(len(headers), 100)
        complaints = [text for header in headers for text in missing_of_the_standard_library(header)]
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))

    def test_a_missing_standard_header_is_noticed(self):
        with tempfile.NamedTemporaryFile("w", suffix=".h") as header:
            header.write("#pragma once\n#include <string>\nstd::vector<std::string> f();  // std::map\n")
            header.flush()
            self.assertEqual(missing_of_the_standard_library(pathlib.Path(header.name)), [f"{header.name}: std::vector of <vector>"])

    def test_public_headers_need_nothing_else(self):
        compiler, _ = compiler_and_flags()
        headers = sorted((ROOT / "include").rglob("*.h"))
        self.assertGreater(len(headers), 5)
        complaints = [text for text in (compile_alone(compiler, [], [path], "include") for path in headers) if text]
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))

    def test_a_header_that_leans_on_its_includer_is_caught(self):
        compiler, _ = compiler_and_flags()
        with tempfile.NamedTemporaryFile("w", suffix=".h") as header:
            header.write("#pragma once\nstd::vector<int> f();\n")
            header.flush()
            self.assertIn("does not compile alone", compile_alone(compiler, [], [pathlib.Path(header.name)]))


if __name__ == "__main__":
    unittest.main()
