"""Documents made from the schema by chance (tests/fuzz/documents): how many were tried, and what was found."""

import re
import subprocess
import sys

from drivers.figures import ROOT, at_most, figure


def run(context):
    context.program("fuzz_readers")
    finds = context.folder / "documents"
    # A seed that the tests do not have, so that these are other documents.
    ended = subprocess.run(
        [sys.executable, ROOT / "tests" / "fuzz" / "documents" / "fuzz_documents.py", "--build", context.build,
         "--seconds", "3600" if context.long else "60", "--seed", "2", "--finds", finds],
        stdout=subprocess.PIPE, text=True, check=False,
    )
    counts = {what: int(count) for what, count in re.findall(r"(\w[\w ]*): (\d+)", ended.stdout.strip().splitlines()[-1])}
    if counts["finds"]:
        print(ended.stdout)
    return {
        "documents.tried": figure(counts["documents"], "documents"),
        "documents.rendered": figure(counts.get("rendered", 0), "documents"),
        "documents.finds": at_most(counts["finds"], 0, "documents"),
    }
