"""How much of the project a source includes: lines of the headers that it reaches through `#include "..."`."""

import dataclasses
import functools
import pathlib
import re

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)


@dataclasses.dataclass
class Reached:
    source: str  # path below src/
    headers: dict  # path of each header reached, as included -> its lines
    direct: dict  # the headers that the source includes itself -> lines that it would not reach without that one

    @property
    def lines(self):
        return sum(self.headers.values())

    def __str__(self):
        heaviest = sorted(self.direct.items(), key=lambda item: (-item[1], item[0]))[:3]
        return f"{self.source}: {self.lines}, of which " + ", ".join(f"{lines} by {header} alone" for header, lines in heaviest)


class HeaderLines:
    """The headers of a source tree; those below `folders`, from which includes start, are the project's own."""

    def __init__(self, folders):
        self.folders = [pathlib.Path(folder) for folder in folders]

    @functools.cache
    def header(self, name):
        """Lines of a header and what it includes; None where it is not the project's."""
        for folder in self.folders:
            if (folder / name).is_file():
                text = (folder / name).read_text()
                return text.count("\n"), tuple(INCLUDE.findall(text))
        return None

    def closure(self, names):
        found, waiting = {}, list(names)
        while waiting:
            name = waiting.pop()
            header = None if name in found else self.header(name)
            if header:
                found[name] = header[0]
                waiting += header[1]
        return found

    def reached_by(self, file, source):
        included = [name for name in INCLUDE.findall(file.read_text()) if self.header(name)]
        headers = self.closure(included)
        without = lambda name: self.closure(other for other in included if other != name)
        direct = {name: sum(headers.values()) - sum(without(name).values()) for name in included}
        return Reached(file.relative_to(source).as_posix(), headers, direct)

    def of_sources(self, source):
        """Of every source below a folder, the one that reaches most first."""
        files = sorted(source.rglob("*.cpp"))
        return sorted((self.reached_by(file, source) for file in files), key=lambda reached: (-reached.lines, reached.source))


def quantile(reached, share):
    """The lines that so large a share of the sources stay within."""
    lines = sorted(one.lines for one in reached)
    return lines[min(len(lines) - 1, int(share * len(lines)))]
