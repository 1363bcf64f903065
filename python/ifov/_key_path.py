"""Which key of a JSON text, with comments, stands at a line and column."""

from __future__ import annotations

import re

_TOKEN = re.compile(
    r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/|[{}\[\]:,]|[^\s{}\[\]:,"/]+|"|/',
    re.DOTALL,
)


def without_comments(text: str) -> str:
    """The same text with blanks in place of comments, so that lines and columns stay."""

    def blank(match: re.Match[str]) -> str:
        token = match.group(0)
        return re.sub(r"[^\n]", " ", token) if token.startswith(("//", "/*")) else token

    return _TOKEN.sub(blank, text)


def key_path_at(text: str, line: int, column: int) -> str:
    """``scene.objects[2].material`` of the key or value that begins at or before a place, both from 1; "" outside of all."""
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return ""
    target = sum(len(one) + 1 for one in lines[: line - 1]) + max(column, 1) - 1
    steps: list[str | int] = []  # of the value that is being read
    kinds: list[str] = []  # the brackets that are open
    waits_for_key = False
    for match in _TOKEN.finditer(text):
        token = match.group(0)
        if match.start() > target:
            break
        if token.startswith(("//", "/*")):
            continue
        if token in "{[":
            kinds.append(token)
            steps.append(0 if token == "[" else "")
            waits_for_key = token == "{"
        elif token in "}]" and kinds:
            if match.start() == target:
                break
            kinds.pop()
            steps.pop()
            waits_for_key = False
        elif token == "," and kinds:
            if kinds[-1] == "[":
                steps[-1] = int(steps[-1]) + 1
            waits_for_key = kinds[-1] == "{"
        elif waits_for_key and token.startswith('"'):
            steps[-1] = token[1:-1]
            waits_for_key = False
    path = ""
    for step in steps:
        if isinstance(step, int):
            path += f"[{step}]"
        elif step:
            path += f".{step}" if path else step
    return path
