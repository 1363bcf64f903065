"""What goes wrong, as exceptions. The extension module throws these, too."""

from __future__ import annotations

import pathlib
import re

from ._key_path import key_path_at


class DocumentError(ValueError):
    """A document, or a file that it names, is wrong. ``str()`` is the message of the command line, with the place, what was found,
    what was expected, the choices, and the line shown.

    file: name of the file or of the document; "" where there is none
    line, column: from 1; 0 where the file as a whole is meant
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0):
        super().__init__(message)
        self.file = file
        self.line = line
        self.column = column
        self._text: str | None = None
        self._key_path: str | None = None

    @property
    def excerpt(self) -> str:
        """The line of the text, and below it a caret under the column; "" where there is none."""
        found = re.search(r"^ *\d+ \| (.*)\n +\| ( *\^)$", str(self), re.MULTILINE)
        return "\n".join(found.groups()) if found else ""

    @property
    def key_path(self) -> str:
        """The key that is meant, as ``sensor.channels[1].gaussian.fwhm``; "" where it is none of a document."""
        if self._key_path is None:
            self._key_path = key_path_at(self._source(), self.line, self.column) if self.line > 0 else ""
        return self._key_path

    def _source(self) -> str:
        if self._text is None:
            try:
                self._text = pathlib.Path(self.file).read_text(encoding="utf-8-sig")
            except (OSError, UnicodeDecodeError):
                self._text = ""
        return self._text


class SystemError(OSError):  # noqa: A001  the library's name for it
    """What the system lacks or refuses: a missing or unwritable file, a full disk, memory that cannot be had."""
