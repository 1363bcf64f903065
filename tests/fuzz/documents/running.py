"""Runs the program under limits of memory and time, and says what is wrong with how it ended."""

import array
import dataclasses
import math
import os
import re
import resource
import signal
import subprocess
import threading

MESSAGE_LIMIT = 8192
PLACE = re.compile(r"(document\.json|files/[^\s:]+)(:\d+)?(:\d+)?|--set|command line")


@dataclasses.dataclass
class Limits:
    """What a document of a few pixels may take."""

    processor_s: float = 5.0
    resident_mib: float = 512.0
    address_mib: float | None = 2048.0  # None under sanitizers, which take terabytes of addresses
    kill_s: int = 10  # of processor time
    wall_s: float = 300.0  # for the machine may be busy with other work


@dataclasses.dataclass
class Ended:
    code: int  # negative: the signal
    said: str  # on standard error
    processor_s: float
    resident_mib: float
    waited_out: bool = False


def run(command, folder, limits):
    """The command's end; standard output is thrown away."""

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (limits.kill_s, limits.kill_s + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if limits.address_mib:
            size = int(limits.address_mib * 2**20)
            resource.setrlimit(resource.RLIMIT_AS, (size, size))

    # Sanitizers end with a code that the program never has; nothing is freed at the end that a leak is made of.
    sanitizers = {"ASAN_OPTIONS": "exitcode=99:detect_leaks=0", "UBSAN_OPTIONS": "exitcode=99:print_stacktrace=1"}
    with open(folder / "said", "wb") as said:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said,
                                   preexec_fn=limit, env={**os.environ, **sanitizers})
        late = threading.Event()
        timer = threading.Timer(limits.wall_s, lambda: (late.set(), os.kill(process.pid, signal.SIGKILL)))
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
    text = (folder / "said").read_bytes()[: 4 * MESSAGE_LIMIT].decode(errors="replace")
    return Ended(process.returncode, text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, late.is_set())


def faults(ended, limits):
    """What is wrong with an end, each as a text."""
    found = []
    if ended.waited_out:
        found.append(f"hangs: not done after {limits.wall_s:g} s")
    elif ended.code == -signal.SIGXCPU or ended.code == -signal.SIGKILL:
        found.append(f"not done after {limits.kill_s} s of processor time")
    elif ended.code < 0:
        found.append(f"ended by {signal.Signals(-ended.code).name}")
    elif ended.code not in (0, 1, 2, 4, 5, 6):
        found.append(f"exit code {ended.code}")
    if "Sanitizer" in ended.said or "runtime error:" in ended.said:
        found.append("a sanitizer's find")
    if len(ended.said.encode()) > MESSAGE_LIMIT:
        found.append(f"says more than {MESSAGE_LIMIT} bytes")
    if ended.code in (1, 2) and not PLACE.search(ended.said):
        found.append("an error that does not say where in the document")
    if ended.processor_s > limits.processor_s and not found:
        found.append(f"{ended.processor_s:.1f} s of processor time")
    if ended.resident_mib > limits.resident_mib:
        found.append(f"{ended.resident_mib:.0f} MiB of memory")
    return found


def values_without_number(file):
    """How many of a cube's values are no finite number."""
    values = array.array("f", file.read_bytes())
    return sum(not math.isfinite(value) for value in values)
