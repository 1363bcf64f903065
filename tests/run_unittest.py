#!/usr/bin/env python3
"""Runs one unittest file for ctest; ends with status 77 where every test in it was skipped. A test that fails with the words by
which a program says that it was built without a part is skipped with them. `--environment FOLDER` runs it by the Python of a virtual
environment that `make python` has made, and skips it where that is not there."""

import importlib.util
import os
import pathlib
import re
import sys
import unittest

NOT_BUILT = re.compile(r"this ifov was built without \w+ \(\w+=OFF\)")


class Result(unittest.TextTestResult):
    def skipped_for(self, test, error):
        found = NOT_BUILT.search(str(error[1]))
        if found:
            self.addSkip(test, found.group(0))
        return found is not None

    def addError(self, test, err):
        if not self.skipped_for(test, err):
            super().addError(test, err)

    def addFailure(self, test, err):
        if not self.skipped_for(test, err):
            super().addFailure(test, err)

    def addSubTest(self, test, subtest, err):
        if err is None or not self.skipped_for(subtest, err):
            super().addSubTest(test, subtest, err)


def main():
    if sys.argv[1] == "--environment":
        environment = pathlib.Path(sys.argv[2])
        if not (environment / "ready").exists():
            missing = environment.with_name("venv.missing")
            print("skipped:", missing.read_text().strip() if missing.exists() else "the Python package was not made (make python)")
            sys.exit(77)
        os.execv(environment / "bin/python", [environment / "bin/python", __file__, *sys.argv[3:]])
    file = pathlib.Path(sys.argv[1]).resolve()
    sys.path.insert(0, str(file.parent))
    specification = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(specification)
    sys.modules[file.stem] = module
    specification.loader.exec_module(module)

    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout, resultclass=Result).run(
        unittest.defaultTestLoader.loadTestsFromModule(module)
    )
    if result.testsRun == 0 and not result.errors and not result.skipped:
        sys.exit("no tests in " + str(file))
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(77 if len(result.skipped) >= max(1, result.testsRun) else 0)


if __name__ == "__main__":  # a test that spawns processes has this file read again in each
    main()
