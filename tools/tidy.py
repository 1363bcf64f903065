#!/usr/bin/env python3
"""Looks for mistakes with clang-tidy, by the checks of the file .clang-tidy:

    tools/tidy.py build                     in every source of src, tests, benchmarks
    tools/tidy.py build --since main        only in what differs from where this branch left main
    tools/tidy.py build src/io/mesh         only in these files and folders

A header is looked at with the sources that include it: where one was changed, with that of its own name or another one.
Ends with 1 where it found something.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Other versions have other checks; this one is Debian 12's.
PROGRAM = "clang-tidy-14"
FOLDERS = ("benchmarks", "src", "tests")


def sources_of(build):
    """Sources of this tree that the build compiles, without what it made itself."""
    files = {pathlib.Path(entry["file"]) for entry in json.loads((build / "compile_commands.json").read_text())}
    return sorted(file for file in files if file.is_relative_to(ROOT) and file.relative_to(ROOT).parts[0] in FOLDERS)


def changed_since(revision):
    """Files that differ from where this branch left `revision`, committed or not."""
    git = lambda *words: subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=True).stdout
    base = git("merge-base", revision, "HEAD").strip()
    names = git("diff", "--name-only", base).splitlines() + git("ls-files", "--others", "--exclude-standard").splitlines()
    return [ROOT / name for name in names]


def shown_by(header, sources):
    """A source that includes this header: the one of its name, or else the first."""
    own = header.with_suffix(".cpp")
    if own in sources:
        return own
    line = re.compile(rf'^#include "(?:[^"]*/)?{re.escape(header.name)}"', re.MULTILINE)
    return next((source for source in sources if line.search(source.read_text())), None)


def chosen(sources, files):
    """The sources that show these files and folders."""
    found = set()
    for file in files:
        if file.suffix == ".h":
            found.add(shown_by(file, sources))
        else:
            found.update(source for source in sources if source.is_relative_to(file))
    return sorted(found - {None})


def complaints(build, source):
    """What clang-tidy says of one source and the headers of this tree that it includes, a text for each finding."""
    # Below every other work: the whole tree takes a while.
    run = subprocess.run(["nice", "-n", "19", PROGRAM, "-p", str(build), "--quiet", "--extra-arg=-Wno-unknown-warning-option",
                          str(source)], capture_output=True, text=True, check=False)
    found = re.split(r"^(?=\S+:\d+:\d+: (?:warning|error): )", run.stdout, flags=re.MULTILINE)[1:]
    if run.returncode and not found:
        found = [f"{source}: {PROGRAM} ended with {run.returncode}: {run.stderr.strip()}\n"]
    return [text.replace(f"{ROOT}/", "") for text in found]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="a folder that CMake has configured")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--since", metavar="REVISION")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    if not shutil.which(PROGRAM):
        sys.exit(f"{PROGRAM} is not installed (Debian's package of that name)")

    build = arguments.build.resolve()
    sources = sources_of(build)
    files = [file.resolve() for file in arguments.files] + (changed_since(arguments.since) if arguments.since else [])
    if arguments.files or arguments.since:
        sources = chosen(sources, files)
    seen = set()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for texts in pool.map(lambda source: complaints(build, source), sources):
            for text in texts:
                if text not in seen:  # of a header, from every source that includes it
                    print(text, end="", flush=True)
                seen.add(text)
    print(f"{len(sources)} sources looked at, {len(seen)} findings")
    return 1 if seen else 0


if __name__ == "__main__":
    sys.exit(main())
