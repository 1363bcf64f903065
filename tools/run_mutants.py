#!/usr/bin/env python3
"""Runs the suite against every fault that tools/mutate.py planted, until a test fails:

    tools/run_mutants.py ../faulty

First every test of ctest runs with no fault on: it has to pass, and the faults that it meets are noted. Then each
fault sees the tests that meet it, those of its own room first, the quick before the slow; all others would do what
they did before. A failure, a crash and a test that takes far too long count, once the same test has passed again
without the fault. A fault that no test catches has seen all of them. What was found is kept in mutant_runs.json in
the copy, so that a later call goes on from there: --again 17 25 runs these anew, --new runs what was not caught
against tests that have come since.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time

# They hold the sources, which are full of switches by now, and not what the program does.
OF_SOURCES = ("layering.",)
PAGE = 4096


class Runs:
    """Tests of a build with one fault or none, and what is known of both."""

    def __init__(self, copy, programs):
        self.store = copy / "mutant_runs.json"
        self.mutants = json.loads((copy / "mutants.json").read_text())
        known = json.loads(self.store.read_text()) if self.store.exists() else {}
        self.plain, self.caught = known.get("plain", {}), known.get("caught", {})
        self.lock = threading.Lock()
        shown = subprocess.run(["ctest", "--test-dir", str(copy / "build"), "--show-only=json-v1"], capture_output=True,
                               check=True).stdout
        self.tests = {test["name"]: test for test in json.loads(shown)["tests"]
                      if "command" in test and not test["name"].startswith(OF_SOURCES)
                      and re.search(programs, " ".join(test["command"]))}

    def keep(self):
        with self.lock:
            part = self.store.with_suffix(".part")
            part.write_text(json.dumps({"plain": self.plain, "caught": self.caught}, indent=1))
            part.rename(self.store)

    def run(self, name, limit_s, mutant=0, met=None):
        """(how it failed or None, seconds) of one test; skipped counts as passed."""
        test = self.tests[name]
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        environment = os.environ | dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
        environment |= {"MUTANT": str(mutant)} | ({"MUTANTS_MET": met} if met else {})
        begin = time.monotonic()
        # A folder of its own: the same test may be running beside this with another fault.
        with tempfile.TemporaryFile() as log, tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
            environment["TMPDIR"] = scratch
            running = subprocess.Popen(test["command"], cwd=properties.get("WORKING_DIRECTORY"), env=environment,
                                       stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True)
            try:
                code = running.wait(limit_s)
                how = None if code in (0, properties.get("SKIP_RETURN_CODE")) else "crash" if code < 0 else "failed"
            except subprocess.TimeoutExpired:
                how = "too long"
            if how:
                try:
                    os.killpg(running.pid, 9)
                except ProcessLookupError:
                    pass
                running.wait()
        return how, time.monotonic() - begin

    def plainly(self, name):
        """Runs a test without a fault and notes which it meets."""
        with tempfile.NamedTemporaryFile() as met:
            met.write(bytes(PAGE))
            met.flush()
            how, seconds = self.run(name, 900, met=met.name)
            seen = [number for number, byte in enumerate(pathlib.Path(met.name).read_bytes()) if byte]
        self.plain[name] = {"how": how, "seconds": seconds, "met": seen}
        if how:
            print(f"{name}: {how} without any fault", flush=True)

    def catch(self, mutant, only=None):
        number, room = mutant["number"], mutant["room"].split("/")[0]
        meeting = [n for n, run in self.plain.items() if run["how"] is None and number in run["met"] and n in self.tests
                   and (only is None or n in only)]

        def cost(name):
            own = any(f"test_{room}" in word for word in self.tests[name]["command"])
            return self.plain[name]["seconds"] * (1 if own else 4)

        found = None
        for name in sorted(meeting, key=cost):
            limit_s = 60 + 20 * self.plain[name]["seconds"]
            how, _ = self.run(name, limit_s, number)
            if how and self.run(name, limit_s)[0] is None:
                found = {"test": name, "how": how}
                break
        self.caught[str(number)] = {"tests": len(meeting), "by": found}
        print(f"{number:4} {mutant['file']}:{mutant['line']}: "
              + (f"{found['how']}: {found['test']}" if found else f"NOT CAUGHT by {len(meeting)} tests"), flush=True)
        self.keep()


def change(mutant):
    """What a fault changes, with a word or two to the left and to the right of it."""
    before, after = mutant["original"], mutant["fault"]
    if after == "(dropped)":
        return f"`{before}` dropped"
    if negated := re.search(r"\(!\((.*)\)\)", after):
        if after.replace(negated.group(), f"({negated.group(1)})") == before:
            return f"`{negated.group(1)}` negated"
    words = re.compile(r"[\w.]+|[-+*/<>=!&|:]+|\S")
    left = len(os.path.commonprefix([before, after]))
    right = min(len(os.path.commonprefix([before[::-1], after[::-1]])), len(before) - left, len(after) - left)
    first = max([0] + [m.start() for m in words.finditer(before) if m.end() <= left][-2:][:1])
    last = ([m.end() for m in words.finditer(before) if m.start() >= len(before) - right][:2] or [len(before)])[-1]
    return f"`{before[first:last]}` → `{after[first:len(after) - (len(before) - last)]}`"


def counted(mutants, equivalent):
    """The faults that count: for one that changes nothing, the next spare of its room."""
    kept = [m for m in mutants if not m.get("spare") and m["number"] not in equivalent]
    spares = [m for m in mutants if m.get("spare") and m["number"] not in equivalent]
    for mutant in (m for m in mutants if m["number"] in equivalent and not m.get("spare")):
        stand_in = next(m for m in spares if m["room"] == mutant["room"])
        spares.remove(stand_in)
        kept.append(stand_in)
    return sorted(kept, key=lambda m: m["number"])


def table(runs, equivalent):
    """A Markdown row for each fault that counts. Of instances of a test with parameters only the name is given."""
    for mutant in counted(runs.mutants, equivalent):
        run = runs.caught[str(mutant["number"])]
        how = "" if not run["by"] or run["by"]["how"] == "failed" else f" ({run['by']['how']})"
        by = run["by"]["test"] + how if run["by"] else "none"
        print(f"| {mutant['number']} | `{mutant['file'].removeprefix('src/')}:{mutant['line']}` "
              f"| {change(mutant).replace('|', chr(92) + '|')} | {by} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("copy", type=pathlib.Path)
    parser.add_argument("--programs", default="", help="those tests alone whose command lines match this")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--again", type=int, nargs="*", default=[], help="numbers of faults to run anew")
    parser.add_argument("--new", action="store_true", help="see above")
    parser.add_argument("--table", action="store_true", help="print what is known and run nothing")
    parser.add_argument("--equivalent", type=int, nargs="*", default=[], help="faults that change nothing, by number")
    arguments = parser.parse_args()
    runs = Runs(arguments.copy.resolve(), arguments.programs)
    if arguments.table:
        return table(runs, arguments.equivalent)
    new = [name for name in runs.tests if name not in runs.plain]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(runs.plainly, new))
        runs.keep()
        missed = {int(n) for n, run in runs.caught.items() if run["by"] is None}
        due = [m for m in runs.mutants if str(m["number"]) not in runs.caught or m["number"] in arguments.again
               or arguments.new and m["number"] in missed]
        list(pool.map(lambda m: runs.catch(m, set(new) if arguments.new and m["number"] in missed else None), due))
    numbers = [m["number"] for m in counted(runs.mutants, arguments.equivalent)]
    print(f"caught: {sum(runs.caught[str(n)]['by'] is not None for n in numbers)} of {len(numbers)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
