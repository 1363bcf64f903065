#!/usr/bin/env python3
"""Runs ctest and closes with what a reader wants to know: passed, failed, skipped, and why each skipped test was."""

import argparse
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

# GoogleTest:  "file.cpp:12: Skipped\nreason\n";  unittest -v:  "test_x (...) ... skipped 'reason'"
GTEST_SKIP = re.compile(r":\d+: Skipped\n(.*)\n")
UNITTEST_SKIP = re.compile(r"^(\w+) \(.*\.\.\. skipped ['\"](.*)['\"]$", re.MULTILINE)


def skip_reasons(test_case):
    """(name, reason) of everything that a ctest test skipped, itself or single unittest methods of it."""
    name = test_case.get("name")
    output = test_case.findtext("system-out") or ""
    parts = [(f"{name}.{method}", reason) for method, reason in UNITTEST_SKIP.findall(output)]
    if parts:
        return parts
    if test_case.get("status") == "notrun" or test_case.find("skipped") is not None:
        found = GTEST_SKIP.search(output)
        return [(name, found.group(1).strip() if found and found.group(1).strip() else "no reason given")]
    return []


def summary(junit_file):
    """Closing lines for a junit file of ctest."""
    cases = ElementTree.parse(junit_file).getroot().findall("testcase")
    skipped = [case for case in cases if case.find("skipped") is not None]
    failed = [case for case in cases if case.find("failure") is not None or case.get("status") == "fail"]
    lines = []
    reasons = [pair for case in cases for pair in skip_reasons(case)]
    if reasons:
        lines.append("Skipped:")
        lines += [f"  {name}: {reason}" for name, reason in reasons]
    lines.append(
        f"{len(cases) - len(failed) - len(skipped)} passed, {len(failed)} failed, {len(skipped)} skipped"
    )
    return lines, len(cases)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", help="the build folder")
    parser.add_argument("--jobs", default="2")
    arguments = parser.parse_args()

    junit = pathlib.Path(arguments.build).resolve() / "tests.xml"
    junit.unlink(missing_ok=True)
    status = subprocess.run(
        ["ctest", "--test-dir", arguments.build, "-j", arguments.jobs, "--output-on-failure", "--no-tests=error",
         "--output-junit", str(junit), "--test-output-size-passed", "200000"],
        check=False,
    ).returncode
    if not junit.exists():
        return status or 1
    lines, count = summary(junit)
    print("\n" + "\n".join(lines), flush=True)
    return status if count else 1


if __name__ == "__main__":
    sys.exit(main())
