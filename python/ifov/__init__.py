"""Synthetic remote-sensing images with an error on every pixel.

>>> import ifov
>>> ds = ifov.render(ifov.read("scene.json"))        # doctest: +SKIP

docs/guide/python.md shows the rest. Importing this imports neither xarray nor the extension module; they come when they are needed.
"""

from __future__ import annotations

import sys
from typing import Any

from . import materials, radiometry, sampling, sensors
from ._assets import Copies, Mesh, Raster, Spectrum
from ._atmosphere import atmosphere
from ._document import Document, read
from ._errors import DocumentError, SystemError  # noqa: A004
from ._library import library as _library
from ._load import load
from ._render import Check, Message, Scene, SceneWarning, Tile, check, render
from ._run import Forecast, Outcome, Run, Status, detect, forecast, merge, run, status

if "xarray" in sys.modules:
    from . import accessor as _accessor  # noqa: F401


def schema() -> dict[str, Any]:
    """The JSON Schema (draft 7) of documents."""
    import json

    made: dict[str, Any] = json.loads(_library().schema())
    return made


def version() -> str:
    """Version of the library, "0.1.0"."""
    return str(_library().version())


__all__ = [
    "Check",
    "Copies",
    "Document",
    "DocumentError",
    "Forecast",
    "Mesh",
    "Message",
    "Outcome",
    "Raster",
    "Run",
    "Scene",
    "SceneWarning",
    "Spectrum",
    "Status",
    "SystemError",
    "Tile",
    "atmosphere",
    "check",
    "detect",
    "forecast",
    "load",
    "materials",
    "merge",
    "radiometry",
    "read",
    "render",
    "run",
    "sampling",
    "schema",
    "sensors",
    "status",
    "version",
]
