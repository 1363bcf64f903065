#!/usr/bin/env python3
"""Writes docs/guide/python_reference.md: signatures and docstrings of the Python package, by the Python that has it
(build/venv/bin/python tools/make_python_reference.py). `--check` says whether the file is what would be written."""

import dataclasses
import inspect
import pathlib
import re
import sys

import ifov
import ifov.accessor

FILE = pathlib.Path(__file__).resolve().parents[1] / "docs/guide/python_reference.md"
HEAD = """# Python, name by name

What [`import ifov`](python.md) has, from its docstrings by `tools/make_python_reference.py`. Types are those of the package's stubs, for mypy and editors.
"""
GROUPS = (
    ("Documents", ("read", "Document", "check", "Check", "Message", "schema", "DocumentError", "SystemError", "SceneWarning", "version")),
    ("Images", ("render", "Scene", "Tile", "load")),
    ("Arrays in place of files", ("Mesh", "Raster", "Spectrum", "Copies")),
    ("Runs in folders", ("run", "Run", "status", "Status", "forecast", "Forecast", "merge", "Outcome", "detect")),
    ("Light in the air", ("atmosphere",)),
)
MODULES = ("materials", "radiometry", "sensors", "sampling")
ARGUMENT = re.compile(r"^([a-z]\w*(?:, [a-z]\w*)*): ")
NEXT = re.compile(r"; (?=[a-z]\w*(?:, [a-z]\w*)*: )")


def signature(name, thing, method=False):
    found = inspect.signature(thing)
    parameters = [p for p in found.parameters.values() if not (method and p.name == "self")]
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(found.replace(parameters=parameters)))  # annotations are texts
    if len(name + text) > 100:
        inner, rest = text[1:].rsplit(")", 1)
        pieces, depth, piece = [], 0, ""
        for letter in inner:
            depth += letter in "[(" and 1 or letter in "])" and -1 or 0
            if letter == "," and depth == 0:
                pieces.append(piece.strip())
                piece = ""
            else:
                piece += letter
        pieces.append(piece.strip())
        text = "(\n" + "".join(f"    {one},\n" for one in pieces) + ")" + rest
    return f"```python\n{name}{text}\n```\n"


def text_of(thing):
    """A docstring as Markdown: paragraphs, and arguments as a list."""
    blocks = []
    for paragraph in (inspect.getdoc(thing) or "").split("\n\n"):
        lines, items = [], []
        for line in paragraph.split("\n"):
            started = ARGUMENT.match(line)
            # "a: what; b: what" of one line stays together, what is indented belongs to the line before.
            if started and (items or not lines or line is paragraph.split("\n")[0]):
                items.append([line])
            elif items and (line.startswith(" ") or not started):
                items[-1].append(line.strip())
            else:
                lines.append(line.strip())
        if lines:
            blocks.append(" ".join(lines))
        if items:
            told = [one for item in items for one in NEXT.split(" ".join(item))]
            blocks.append("\n".join("- " + ARGUMENT.sub(r"`\1`: ", one, count=1) for one in told))
    text = "\n\n".join(blocks)
    text = re.sub(r":(?:func|class|meth):`(?:~)?([\w.]+)`", r"`\1`", text)
    return re.sub(r"``([^`]+)``", r"`\1`", text) + "\n"


def class_text(name, kind):
    text = f"### {name}\n\n"
    if dataclasses.is_dataclass(kind) or not issubclass(kind, (Exception, dict)):
        text += signature(name, kind) + "\n"
    text += text_of(kind)
    for own, member in vars(kind).items():
        if own.startswith("_") or own == "copy":
            continue
        if isinstance(member, property):
            text += f"\n#### {name}.{own}\n\n" + text_of(member)
        elif inspect.isfunction(member):
            text += f"\n#### {name}.{own}()\n\n" + signature(own, member, True) + "\n" + text_of(member)
    return text


def entry(name, thing):
    if inspect.isclass(thing):
        return class_text(name, thing)
    return f"### {name}()\n\n" + signature(name, thing) + "\n" + text_of(thing)


def written():
    parts = [HEAD]
    told = set(MODULES)
    for title, names in GROUPS:
        parts.append(f"## {title}\n")
        parts += [entry(f"ifov.{name}", getattr(ifov, name)) for name in names]
        told |= set(names)
    if left := set(ifov.__all__) - told:
        raise SystemExit(f"tools/make_python_reference.py: {', '.join(sorted(left))}: in no group")
    for module_name in MODULES:
        module = getattr(ifov, module_name)
        parts.append(f"## ifov.{module_name}\n\n{text_of(module)}")
        for name, thing in vars(module).items():
            own = not name.startswith("_") and getattr(thing, "__module__", "") == module.__name__
            if own and (inspect.isfunction(thing) or inspect.isclass(thing)):
                parts.append(entry(f"ifov.{module_name}.{name}", thing))
    parts.append(f"## Dataset.ifov\n\n{text_of(ifov.accessor.Accessor)}")
    for name, member in vars(ifov.accessor.Accessor).items():
        if not name.startswith("_") and inspect.isfunction(member):
            parts.append(f"### Dataset.ifov.{name}()\n\n" + signature(name, member, True) + "\n" + text_of(member))
    return "\n".join(re.sub(r"\n{3,}", "\n\n", part) for part in parts)


def main():
    text = written()
    if "--check" in sys.argv[1:]:
        if FILE.read_text(encoding="utf-8") != text:
            raise SystemExit(f"{FILE.name} is older than the docstrings: run build/venv/bin/python tools/make_python_reference.py")
        return
    FILE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
