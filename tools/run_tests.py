#!/usr/bin/env python3
"""Runs ctest and closes with what a reader wants to know: passed, failed, skipped, and why each skipped test was."""

import argparse
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

# A test of GoogleTest, where it stands in the output of its suite; one that ended the program has a beginning alone.
GTEST_BEGIN = re.compile(r"^\[ RUN      \] (\S+)$", re.MULTILINE)
GTEST_END = re.compile(r"^\[ *(OK|FAILED|SKIPPED) *\] (\S+?)(?:,.*)? \(\d+ ms\)$", re.MULTILINE)
# GoogleTest:  "file.cpp:12: Skipped\nreason\n";  unittest -v:  "test_x (...) ... skipped 'reason'"
GTEST_SKIP = re.compile(r":\d+: Skipped\n(.*)\n")
UNITTEST_SKIP = re.compile(r"^(\w+) \(.*\.\.\. skipped ['\"](.*)['\"]$", re.MULTILINE)


def reason_in(output):
    found = GTEST_SKIP.search(output)
    return found.group(1).strip() if found and found.group(1).strip() else "no reason given"


def results(test_case):
    """(name, "passed", "failed" or "skipped") of a test of ctest, or of each test of its suite where GoogleTest ran one."""
    output = test_case.findtext("system-out") or ""
    name = test_case.get("name")
    failed = test_case.find("failure") is not None or test_case.get("status") == "fail"
    ends = {test: end for end, test in GTEST_END.findall(output)}
    words = {"OK": "passed", "FAILED": "failed", "SKIPPED": "skipped"}
    found = [(test, words[ends.get(test, "FAILED" if failed else "OK")]) for test in GTEST_BEGIN.findall(output)]
    if failed and not any(how == "failed" for _, how in found):
        found.append((name, "failed"))
    if found:
        return found
    skipped = test_case.get("status") == "notrun" or test_case.find("skipped") is not None
    return [(name, "skipped" if skipped else "passed")]


def skip_reasons(test_case):
    """(name, reason) of everything that a ctest test skipped: itself, tests of its suite, single unittest methods of it."""
    output = test_case.findtext("system-out") or ""
    parts = [(f"{test_case.get('name')}.{method}", reason) for method, reason in UNITTEST_SKIP.findall(output)]
    if parts:
        return parts
    return [(name, reason_in(output.partition(f"[ RUN      ] {name}\n")[2] or output))
            for name, how in results(test_case) if how == "skipped"]


def summary(junit_file):
    """Closing lines for a junit file of ctest."""
    cases = ElementTree.parse(junit_file).getroot().findall("testcase")
    found = [result for case in cases for result in results(case)]
    lines = []
    reasons = [pair for case in cases for pair in skip_reasons(case)]
    if reasons:
        lines.append("Skipped:")
        lines += [f"  {name}: {reason}" for name, reason in reasons]
    failed = [name for name, how in found if how == "failed"]
    if failed:
        lines.append("Failed:")
        lines += [f"  {name}" for name in failed]
    count = {how: sum(result == how for _, result in found) for how in ("passed", "failed", "skipped")}
    lines.append(", ".join(f"{number} {how}" for how, number in count.items()))
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
