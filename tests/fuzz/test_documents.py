"""The fuzzer of documents itself: it makes the same ones again, it makes all kinds, and it notices every kind of fault."""

import array
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "fuzz" / "documents"))
import fuzz_documents  # noqa: E402
import running  # noqa: E402
import seeds  # noqa: E402
import values  # noqa: E402
from generator import Generator  # noqa: E402
from schema import Schema  # noqa: E402
from writing import written  # noqa: E402

PROGRAM = os.environ.get("IFOV_PROGRAM", str(ROOT / "build" / "ifov"))
SCHEMA = json.loads(subprocess.run([PROGRAM, "schema"], stdout=subprocess.PIPE, check=True).stdout)


def generator():
    return Generator(Schema(SCHEMA), seeds.documents(), lambda parent, key: ["files/a"])


class Documents(unittest.TestCase):
    def test_depend_on_seed_and_number_alone(self):
        first, second = generator(), generator()
        second.document(1, 0)
        self.assertEqual(written(first.document(1, 5)), written(second.document(1, 5)))
        self.assertNotEqual(written(first.document(2, 5)), written(second.document(1, 5)))

    def test_are_valid_and_invalid(self):
        made, schema = generator(), Schema(SCHEMA)
        valid = [schema.valid(json.loads(written(made.document(1, number))), schema.root) for number in range(60)]
        self.assertGreater(sum(valid), 15)
        self.assertGreater(len(valid) - sum(valid), 5)

    def test_have_every_key_and_alternative(self):
        made = generator()
        made.random, made.wildness, made.grafts = random.Random(1), 0.1, {}
        for name, definition in SCHEMA["definitions"].items():
            seen = set()
            for _ in range(400):
                seen.update(made.make(definition, depth=3))
            with self.subTest(definition=name):
                # Former names of keys are made rarely; tests of documents read each.
                wanted = {key for key, what in definition.get("properties", {}).items() if "deprecated" not in what}
                self.assertEqual(wanted - seen, set())
                for key in wanted:
                    choices = made.schema.alternatives(definition["properties"][key])
                    if len(choices) > 1:
                        taken = [made.schema.alternative_of(made.make(definition["properties"][key], key=key), definition["properties"][key])
                                 for _ in range(400)]
                        types = {choice.get("type") for choice in choices}
                        self.assertEqual({one.get("type") for one in taken}, types, key)

    def test_hold_extreme_numbers_in_every_unit(self):
        chance = random.Random(1)
        pattern = r"^[ \t]*[+-]?([0-9]+)[ \t]*(m|W\/\(m2 um\))[ \t]*$"
        units = values.units_of(pattern)
        self.assertEqual(units, ["m", "W/(m2 um)"])
        texts = {values.quantity(chance, pattern, units, "", 1.0) for _ in range(20000)}
        for unit in units:
            for number in (*values.FAR, *values.ENDS, *values.BEYOND, *values.NO_NUMBER):
                self.assertIn(f"{number} {unit}", texts)


class Validity(unittest.TestCase):
    def test_is_that_of_an_independent_validator(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("python3-jsonschema is not installed")
        schema, judge, made = Schema(SCHEMA), jsonschema.Draft7Validator(SCHEMA), generator()
        judged = 0
        for number in range(50):
            document = json.loads(written(made.document(3, number)))
            # Those that other documents complete are valid whatever they lack.
            if isinstance(document, dict) and not {"include", "instruments"} & document.keys():
                self.assertEqual(schema.valid(document, schema.root), judge.is_valid(document), number)
                judged += 1
        self.assertGreater(judged, 15)


class Faults(unittest.TestCase):
    def faults_of(self, script, wall_s=200):
        limits = running.Limits(processor_s=0.5, resident_mib=200, kill_s=2, wall_s=wall_s)
        with tempfile.TemporaryDirectory() as folder:
            ended = running.run([sys.executable, "-c", script], pathlib.Path(folder), limits)
        return " ".join(running.faults(ended, limits))

    def test_of_each_kind_are_noticed(self):
        for script, fault in (
            ("import os; os.kill(os.getpid(), 11)", "ended by SIGSEGV"),
            ("exit(3)", "exit code 3"),
            ("while True: pass", "not done after 2 s of processor time"),
            ("import time\nwhile time.process_time() < 1: pass", "s of processor time"),
            ("x = bytearray(b'x') * 2**28", "MiB of memory"),
            ("import sys; sys.exit('document.json:1:1: ' + 'x' * 9000)", "says more than 8192 bytes"),
            ("import sys; sys.exit('wrong')", "does not say where"),
            ("import sys; print('a.cpp:1:2: runtime error: overflow', file=sys.stderr)", "a sanitizer's find"),
        ):
            with self.subTest(fault=fault):
                self.assertIn(fault, self.faults_of(script))

    def test_of_waiting_for_ever_are_noticed(self):
        self.assertIn("hangs", self.faults_of("import time; time.sleep(60)", wall_s=1))

    def test_of_a_good_end_there_are_none(self):
        self.assertEqual(self.faults_of("import sys; sys.exit('document.json:1:1: wrong')"), "")
        self.assertEqual(self.faults_of("exit(6)"), "")

    def test_of_radiance_are_noticed(self):
        with tempfile.NamedTemporaryFile() as file:
            array.array("f", [1.0, float("nan"), float("inf"), 0.0]).tofile(file)
            file.flush()
            self.assertEqual(running.values_without_number(pathlib.Path(file.name)), 2)

    def test_of_a_program_that_takes_everything_are_noticed(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for name, lines in {
                "ifov": f'[ "$1" = schema ] && exec {PROGRAM} schema\n[ "$1" = check ] || {{ echo document.json:1:1 >&2; exit 1; }}',
                "fuzz_readers": 'mkdir -p "$2/a" && echo > "$2/a/a"',
            }.items():
                (folder / name).write_text(f"#!/bin/sh\n{lines}\n")
                (folder / name).chmod(0o755)
            fuzzer = fuzz_documents.Fuzzer(folder / "ifov", folder / "fuzz_readers", folder, running.Limits())
            faults = " ".join(fault for number in range(30) for fault in fuzzer.try_document(1, number)[1])
            self.assertIn("taken, though the schema refuses it", faults)
            self.assertIn("refused, though 'check' takes it", faults)


if __name__ == "__main__":
    unittest.main()
