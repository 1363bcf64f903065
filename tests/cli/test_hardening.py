"""The program that was built has every guard of cmake/Hardening.cmake, and speaks up on an old processor."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from program import PROGRAM


def tool(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


class Hardening(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cache = pathlib.Path(os.environ.get("IFOV_BUILD", pathlib.Path(PROGRAM).parent)) / "CMakeCache.txt"
        settings = cache.read_text() if cache.exists() else ""
        if "IFOV_HARDEN:BOOL=OFF" in settings:
            raise unittest.SkipTest("built with IFOV_HARDEN=OFF")
        if not shutil.which("readelf") or not shutil.which("objdump"):
            raise unittest.SkipTest("readelf and objdump (binutils) are not there")
        cls.sanitized = re.search(r"IFOV_SANITIZE:\w+=(?!OFF)\w", settings) is not None
        cls.debug = "CMAKE_BUILD_TYPE:STRING=Debug" in settings
        cls.segments = tool("readelf", "-lW", PROGRAM)
        cls.dynamic = tool("readelf", "-dW", PROGRAM)
        cls.imports = tool("readelf", "--dyn-syms", "-W", PROGRAM)

    def test_addresses_differ_from_run_to_run(self):
        self.assertRegex(tool("readelf", "-hW", PROGRAM), r"Type:\s+DYN")
        self.assertRegex(self.dynamic, r"FLAGS_1\).*\bPIE\b")

    def test_tables_of_the_linker_are_read_only(self):
        self.assertIn("GNU_RELRO", self.segments)
        self.assertRegex(self.dynamic, r"FLAGS_1\).*\bNOW\b")

    def test_no_memory_is_both_written_and_executed(self):
        self.assertRegex(self.segments, r"GNU_STACK\s.* RW ")
        self.assertNotRegex(self.segments, r"\bRWE\b")

    def test_the_stack_has_canaries(self):
        self.assertIn("__stack_chk_fail", self.imports)

    def test_the_c_library_checks_bounds(self):
        if self.sanitized or self.debug:
            self.skipTest("not in such builds")
        self.assertRegex(self.imports, r"__(mem|str|read|pread|v?s?n?printf|fprintf|readlink)\w*_chk@")

    def test_functions_are_marked_as_targets(self):
        for name in ("main", "_ZN4ifov2io10parse_jsonENSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEERKS6_RKNS0_9JsonRulesE"):
            code = tool("objdump", "-d", "--no-show-raw-insn", f"--disassemble={name}", PROGRAM)
            found = re.search(rf"<{name}>:\n\s*[0-9a-f]+:\s*(\w+)", code)
            self.assertIsNotNone(found, f"no {name} in the program")
            self.assertEqual(found.group(1), "endbr64", name)


class OldProcessor(unittest.TestCase):
    def test_one_line_and_exit_code_2(self):
        emulator = shutil.which("qemu-x86_64") or shutil.which("qemu-x86_64-static")
        if not emulator:
            self.skipTest("no qemu-x86_64 to be an old processor")
        done = subprocess.run([emulator, "-cpu", "Nehalem", PROGRAM, "--version"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("ifov: this processor lacks avx, and this ifov was built for ", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_the_check_itself_needs_no_new_instructions(self):
        if not shutil.which("objdump"):
            self.skipTest("objdump (binutils) is not there")
        code = tool("objdump", "-dC", "--no-show-raw-insn", PROGRAM)
        found = re.search(r"<\(anonymous namespace\)::refuse_old_processor\(\)>:\n(.*?)\n\n", code, re.DOTALL)
        self.assertIsNotNone(found, "the check is not in the program")
        instructions = re.findall(r"^\s*[0-9a-f]+:\s+(\w+)", found.group(1), re.MULTILINE)
        self.assertGreater(len(instructions), 5)
        new = [i for i in instructions if re.match(r"v[a-z]|sarx|shlx|shrx|rorx|andn|bextr|blsr|tzcnt|lzcnt|mulx|pdep|pext|bzhi", i)]
        self.assertEqual(new, [])


if __name__ == "__main__":
    unittest.main()
