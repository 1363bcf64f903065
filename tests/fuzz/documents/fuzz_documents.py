#!/usr/bin/env python3
"""Checks and renders documents made from the schema by chance, and stops at nothing but bugs.

A find is a crash, a hang, exit code 3, more time, memory or words than a document of a few pixels may take, an error
that does not say where, radiance that is no number without a warning, a document taken that the schema refuses, or one
that 'check' takes and 'render' refuses. See docs/developer/testing.md."""

import argparse
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import running
import seeds
from effort import of_few_channels, of_few_pixels, with_air
from generator import Generator
from schema import Schema
from writing import written

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Fuzzer:
    def __init__(self, ifov, writer, folder, limits):
        self.ifov, self.folder, self.limits = ifov, folder, limits
        listed = subprocess.run([ifov, "schema"], stdout=subprocess.PIPE, check=True).stdout
        self.schema = Schema(json.loads(listed))
        self.generator = Generator(self.schema, seeds.documents(), seeds.Files(writer, folder))
        self.counts = collections.Counter()

    def try_document(self, seed, number):
        """(the document as it is written, faults of it)."""
        text = written(self.generator.document(seed, number))
        document = json.loads(text)
        (self.folder / "document.json").write_text(text)
        self.counts["documents"] += 1
        limits = with_air(document, self.limits)
        checked = self.run(limits, "check", "document.json", "--no-cache", *of_few_channels(document))
        faults = running.faults(checked, limits)
        if checked.code not in (0, 6):
            self.counts["refused"] += 1
        elif not isinstance(document, dict) or {"include", "instruments"} & document.keys():
            pass
        elif not self.schema.valid(document, self.schema.root):
            faults.append("taken, though the schema refuses it")
        if checked.code in (0, 6) and not faults:
            self.counts["rendered"] += 1
            return text, self.render(document, limits)
        return text, [f"check: {fault}\n{checked.said}" for fault in faults]

    def render(self, document, limits):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        ended = self.run(limits, "render", "document.json", "--output", "out", "--threads", "1", "--no-cache",
                         *of_few_channels(document), *of_few_pixels(document))
        faults = running.faults(ended, limits)
        if ended.code == 1:
            faults.append("refused, though 'check' takes it")
        cube = next((self.folder / "out").glob("*_radiance.img"), None)
        if cube and "warning" not in ended.said and running.values_without_number(cube):
            faults.append("radiance that is no number, without a warning")
        return [f"render: {fault}\n{ended.said}" for fault in faults]

    def run(self, limits, *words):
        ended = running.run([self.ifov, *words], self.folder, limits)
        self.counts[f"exit code {ended.code}"] += 1
        return ended


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    build = pathlib.Path(os.environ.get("IFOV_BUILD", ROOT / "build"))
    parser.add_argument("--build", type=pathlib.Path, default=build, help="the build folder, with ifov and fuzz_readers")
    parser.add_argument("--runs", type=int, default=100, help="documents")
    parser.add_argument("--seconds", type=float, help="time, instead of --runs")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other documents")
    parser.add_argument("--only", type=int, metavar="NUMBER", help="one document of the seed")
    parser.add_argument("--finds", type=pathlib.Path, help="folder for the documents of finds (a new one if not given)")
    parser.add_argument("--sanitized", action="store_true", help="the program is built with sanitizers: wider limits")
    options = parser.parse_args()

    limits = running.Limits()
    if options.sanitized:
        limits = running.Limits(processor_s=60, resident_mib=2048, address_mib=None, kill_s=120, wall_s=1800)
    found = 0
    with tempfile.TemporaryDirectory(prefix="ifov_fuzz_documents_") as folder:
        fuzzer = Fuzzer(options.build.resolve() / "ifov", options.build.resolve() / "fuzz_readers", pathlib.Path(folder), limits)
        begin = time.monotonic()
        number = options.only or 0
        while options.only is None or number == options.only:
            if time.monotonic() - begin > options.seconds if options.seconds else number >= options.runs:
                break
            text, faults = fuzzer.try_document(options.seed, number)
            if faults:
                found += 1
                options.finds = options.finds or pathlib.Path(tempfile.mkdtemp(prefix="ifov_finds_"))
                options.finds.mkdir(parents=True, exist_ok=True)
                file = options.finds / f"seed_{options.seed}_number_{number}.json"
                file.write_text(text)
                print(f"find: seed {options.seed}, number {number}: {file}", *faults, sep="\n  ", flush=True)
            number += 1
    print(f"finds: {found};", ", ".join(f"{what}: {count}" for what, count in sorted(fuzzer.counts.items())))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
