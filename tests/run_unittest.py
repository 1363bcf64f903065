#!/usr/bin/env python3
"""Runs one unittest file for ctest; ends with status 77 where every test in it was skipped."""

import importlib.util
import pathlib
import sys
import unittest

file = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(file.parent))
specification = importlib.util.spec_from_file_location(file.stem, file)
module = importlib.util.module_from_spec(specification)
sys.modules[file.stem] = module
specification.loader.exec_module(module)

result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(
    unittest.defaultTestLoader.loadTestsFromModule(module)
)
if result.testsRun == 0 and not result.errors and not result.skipped:
    sys.exit("no tests in " + str(file))
if not result.wasSuccessful():
    sys.exit(1)
sys.exit(77 if len(result.skipped) >= max(1, result.testsRun) else 0)
