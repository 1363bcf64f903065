"""The spectral library that is compiled in."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from ._library import library


@dataclasses.dataclass(frozen=True)
class Curve:
    """The spectra of one sample. wavelength: um; reflectance (directional-hemispherical), transmittance (of leaves; empty: opaque, or
    not known), emissivity: (wavelength,), 1; origins: publications and licences; modelled: else measured"""

    name: str
    sample: str
    origins: list[str]
    modelled: bool
    wavelength: npt.NDArray[np.float64]
    reflectance: npt.NDArray[np.float64]
    transmittance: npt.NDArray[np.float64]
    emissivity: npt.NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Material:
    """name: as documents name it; words: more that it is found by"""

    name: str
    group: str
    about: str
    words: list[str]
    curves: list[Curve]


def search(text: str = "") -> list[Material]:
    """The material of that name, or else all whose name or words hold every word of the text; all of them for an empty one. Throws
    ``DocumentError``, which names near misses, where there is none."""
    return [
        Material(
            found.name,
            found.group,
            found.about,
            list(found.words),
            [
                Curve(
                    curve.name,
                    curve.sample,
                    list(curve.origins),
                    curve.modelled,
                    np.array(curve.wavelength),
                    np.array(curve.reflectance),
                    np.array(curve.transmittance),
                    np.array(curve.emissivity),
                )
                for curve in found.curves
            ],
        )
        for found in library().search_materials(text)
    ]
