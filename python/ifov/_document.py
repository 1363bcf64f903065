"""Documents as dicts, and as the text that the library reads."""

from __future__ import annotations

import copy
import datetime
import json
import math
import os
import pathlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._errors import DocumentError
from ._key_path import without_comments


class Document(dict[str, Any]):
    """A document that was read: a dict that knows its file. As long as nothing is changed in it, it stands for the file's text as it
    was, comments and all; messages then show the lines of the file.

    file: the file that it was read from; relative files that it names are looked for in its folder
    """

    file: pathlib.Path
    _text: str
    _as_read: dict[str, Any]

    def __init__(self, values: Mapping[str, Any], file: pathlib.Path, text: str):
        super().__init__(values)
        self.file = file
        self._text = text
        self._as_read = copy.deepcopy(dict(values))

    def __reduce__(self) -> tuple[Any, ...]:
        return _document_again, (dict(self), self.file, self._text, self._as_read)

    def __deepcopy__(self, memo: dict[int, Any]) -> Document:
        return _document_again(copy.deepcopy(dict(self), memo), self.file, self._text, self._as_read)

    def __copy__(self) -> Document:
        return _document_again(dict(self), self.file, self._text, self._as_read)

    copy = __copy__  # type: ignore[assignment]

    def text(self) -> str:
        """JSON: what the file says, or what was made of it."""
        return self._text if dict(self) == self._as_read else to_text(self)


def _document_again(values: dict[str, Any], file: pathlib.Path, text: str, as_read: dict[str, Any]) -> Document:
    document = Document(values, file, text)
    document._as_read = as_read
    return document


def read(file: str | os.PathLike[str]) -> Document:
    """Reads a document. Comments are allowed; what is in it is looked at by ``check`` and ``render``. Throws ``DocumentError``,
    located, where it is no JSON, and ``OSError``."""
    path = pathlib.Path(file)
    text = path.read_text(encoding="utf-8-sig")
    try:
        values = json.loads(without_comments(text))
    except json.JSONDecodeError as error:
        raise located(text, str(path), error.lineno, error.colno, error.msg) from None
    if not isinstance(values, dict):
        raise located(text, str(path), 1, 1, "a document is an object: { ... }")
    return Document(values, path, text)


def located(text: str, file: str, line: int, column: int, message: str) -> DocumentError:
    """An error that shows the line, as the library's do."""
    shown = text.split("\n")[line - 1] if text else ""
    excerpt = f"{line:5} | {shown}\n      | {' ' * (column - 1)}^"
    error = DocumentError(f"{file}:{line}:{column}: {message}\n{excerpt}", file, line, column)
    error._text = text
    return error


def to_text(document: Mapping[str, Any]) -> str:
    """A document as JSON. Paths, dates, NumPy's numbers and arrays, and quantities of pint become what documents write. Throws
    ``DocumentError``, with the key, on what is no value of a document."""
    return json.dumps(plain(document, ""), indent=2, ensure_ascii=False)


def plain(value: Any, path: str) -> Any:
    """What JSON can say of a value; ``path`` is its key, for messages."""
    if value is None or isinstance(value, (bool, str)):
        return str(value) if isinstance(value, str) else value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        # A float32 is the number that it prints: 0.1, not 0.10000000149.
        number = float(value) if isinstance(value, float) else float(str(value))
        if not math.isfinite(number):
            raise _refused(path, f"found {number}; expected a finite number")
        return number
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (datetime.datetime, np.datetime64)):
        return _instant(value, path)
    if isinstance(value, datetime.date):
        raise _refused(path, f"found the date {value} without a time of day; expected a datetime")
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise _refused(path, f"found the key {key!r}; keys are texts")
        return {str(key): plain(item, f"{path}.{key}" if path else key) for key, item in value.items()}
    if hasattr(value, "magnitude") and hasattr(value, "units"):  # pint
        return _quantity(value, path)
    if isinstance(value, np.ndarray):
        value = value.tolist() if value.dtype.kind in "biuU" else list(value)
        return plain(value, path)
    if isinstance(value, (list, tuple)):
        return [plain(item, f"{path}[{number}]") for number, item in enumerate(value)]
    raise _refused(path, f"found {type(value).__name__}; expected what JSON has, a path, a date or a quantity")


def _refused(path: str, message: str) -> DocumentError:
    error = DocumentError(f"{path or 'the document'}: {message}")
    error._key_path = path
    return error


def _instant(value: datetime.datetime | np.datetime64, path: str) -> str:
    """UTC; an instant without a zone is taken for UTC."""
    if isinstance(value, np.datetime64):
        if np.isnat(value):
            raise _refused(path, "found NaT; expected an instant")
        return str(value.astype("datetime64[s]")) + "Z"
    if value.tzinfo is not None:
        value = value.astimezone(datetime.timezone.utc)
    return value.replace(tzinfo=None).isoformat() + "Z"


_UNITS = {"µm": "um", "μm": "um", "°": "deg", "°C": "degC", "Δ°C": "K", "%": "%"}


def _quantity(value: Any, path: str) -> Any:
    units = format(value.units, "~P")
    units = _UNITS.get(units, units)

    def text(magnitude: Any) -> str:
        return f"{plain(magnitude, path)} {units}".strip()

    magnitude = value.magnitude
    if isinstance(magnitude, (list, tuple, np.ndarray)):
        return [text(item) for item in np.asarray(magnitude).tolist()]
    return text(magnitude)


class Written:
    """A dict or Document as the library is given it: text, name, folder."""

    def __init__(self, document: Mapping[str, Any]):
        self.name, self.folder = "document.json", ""
        if isinstance(document, Document):
            self.text = document.text()
            self.folder, self.name = os.path.split(document.file)
        elif isinstance(document, Mapping):
            self.text = to_text(document)
        else:
            raise TypeError(f"document: found {type(document).__name__}; expected a dict, as ifov.read() gives it")
        self.full_name = os.path.join(self.folder, self.name)

    def __enter__(self) -> Written:
        return self

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> None:
        """Errors about the text know it, for their key."""
        if isinstance(error, DocumentError) and error.file == self.full_name:
            error._text = self.text
