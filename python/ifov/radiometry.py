"""Planck's law, for arrays, without the extension module."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

#: CODATA 2018, exact: 2 h c^2 in W um^4 m-2 sr-1, and h c / k in um K.
_FIRST = 2.0 * 6.62607015e-34 * 299792458.0**2 * 1e24
_SECOND = 6.62607015e-34 * 299792458.0 / 1.380649e-23 * 1e6


def planck(um: npt.ArrayLike, kelvin: npt.ArrayLike) -> Any:
    """Spectral radiance of a black body, W m-2 sr-1 um-1: 2 h c^2 / wavelength^5 / (exp(h c / (wavelength k T)) - 1). 0 at and below
    0 K.

    um: wavelength, micrometres; kelvin: temperature, K. Any shapes that NumPy broadcasts; the result has that shape.
    """
    um, kelvin = np.asarray(um, float), np.asarray(kelvin, float)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        radiance = _FIRST / um**5 / np.expm1(_SECOND / (um * kelvin))
    result = np.where(kelvin > 0, radiance, np.where(np.isnan(kelvin), np.nan, 0.0))
    return result[()]


def brightness_temperature(um: npt.ArrayLike, radiance: npt.ArrayLike) -> Any:
    """The temperature, K, at which a black body has a radiance: the inverse of :func:`planck`. 0 where the radiance is not above 0.

    um: wavelength, micrometres; radiance: W m-2 sr-1 um-1. Any shapes that NumPy broadcasts.
    """
    um, radiance = np.asarray(um, float), np.asarray(radiance, float)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        kelvin = _SECOND / (um * np.log1p(_FIRST / um**5 / radiance))
    result = np.where(radiance > 0, kelvin, np.where(np.isnan(radiance), np.nan, 0.0))
    return result[()]


def planck_slope(um: npt.ArrayLike, kelvin: npt.ArrayLike) -> Any:
    """dB/dT, the derivative of :func:`planck` by temperature, W m-2 sr-1 um-1 K-1: errors of radiance over it are errors of brightness
    temperature. 0 at and below 0 K.

    um: wavelength, micrometres; kelvin: temperature, K. Any shapes that NumPy broadcasts; the result has that shape.
    """
    um, kelvin = np.asarray(um, float), np.asarray(kelvin, float)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        x = _SECOND / (um * kelvin)
        # x e^x / (e^x - 1) = x / (1 - e^-x)
        slope = planck(um, kelvin) / kelvin * x / -np.expm1(-x)
    result = np.where(kelvin > 0, np.where(np.isfinite(slope), slope, 0.0), np.where(np.isnan(kelvin), np.nan, 0.0))
    return result[()]
