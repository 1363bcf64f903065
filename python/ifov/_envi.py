"""ENVI cubes, by NumPy alone."""

from __future__ import annotations

import pathlib
import re
from typing import Any

import numpy as np

_TYPES = {1: "u1", 2: "i2", 3: "i4", 4: "f4", 5: "f8", 12: "u2", 13: "u4", 14: "i8", 15: "u8"}


class Cube:
    """What an ENVI file is and where its bytes lie; opened again for each reading, so that it can be sent to other processes.

    shape: (bands, rows, columns)
    """

    def __init__(self, data: pathlib.Path, header: pathlib.Path):
        self.path = data
        self.fields = header_fields(header)
        try:
            self.shape = tuple(int(self.fields[key]) for key in ("bands", "lines", "samples"))
            kind = _TYPES[int(self.fields["data type"])]
            order = ">" if self.fields.get("byte order", "0").strip() == "1" else "<"
            self.offset = int(self.fields.get("header offset", "0"))
        except (KeyError, ValueError) as error:
            raise ValueError(f"{header}: {error} is missing in the ENVI header, or is no known number") from None
        self.dtype = np.dtype(order + kind)
        self.interleave = self.fields.get("interleave", "bsq").strip().lower()
        self.band_names = items(self.fields.get("band names", ""))

    @property
    def numbers(self) -> list[float]:
        """Wavelengths; empty: none."""
        return [float(item) for item in items(self.fields.get("wavelength", ""))]

    def values(self) -> np.ndarray[Any, Any]:
        """[band, row, column], mapped."""
        return mapped(self.path, self.dtype, self.shape, self.interleave, self.offset)


def mapped(
    path: pathlib.Path, dtype: np.dtype[Any], size: tuple[int, ...], interleave: str, offset: int = 0
) -> np.ndarray[Any, Any]:
    """Values of a file as [band, row, column], the order of ``size``, however they lie in it."""
    bands, rows, columns = size
    shapes = {
        "bil": ((rows, bands, columns), (1, 0, 2)),
        "bip": ((rows, columns, bands), (2, 0, 1)),
        "bsq": ((bands, rows, columns), (0, 1, 2)),
    }
    shape, axes = shapes[interleave]
    return np.memmap(path, dtype, "r", offset, shape).transpose(axes)


def header_fields(path: pathlib.Path) -> dict[str, str]:
    """Keys in small letters, values as written without the outermost braces."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if not text.startswith("ENVI"):
        raise ValueError(f"{path}: no ENVI header")
    fields: dict[str, str] = {}
    for key, braced, rest in re.findall(r"^([^=\n]+?)\s*=\s*(?:\{(.*?)\}|([^\n]*))", text[4:], re.MULTILINE | re.DOTALL):
        fields[key.strip().lower()] = braced.strip() if braced else rest.strip()
    return fields


def items(text: str) -> list[str]:
    """Of a list in a header."""
    return [item.strip() for item in text.split(",")] if text.strip() else []


def find_cube(path: pathlib.Path) -> Cube | None:
    """The cube of a data file; None where it has no header."""
    for header in (path.with_name(path.name + ".hdr"), path.with_suffix(".hdr")):
        if header.exists():
            return Cube(path, header)
    return None
