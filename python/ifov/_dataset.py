"""What is known of an image as an xarray.Dataset, whether it comes from files or from memory."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from . import accessor as _accessor  # noqa: F401  so that datasets have .ifov

RADIANCE_UNIT = "W m-2 sr-1 um-1"
STOKES = ("I", "Q", "U", "V")
#: Bit by bit, and from 1 on the classes of quality_class (docs/formats/products.md).
REASONS = ("unjudged", "samples", "time", "error", "structure", "unseen_light", "air", "nodes", "psf_cut", "edge")
_GRAVEST = ("converged", *REASONS)

#: Cubes whose bands are variables of their own: (variable, what, unit).
_BANDS: dict[str, list[tuple[str, str, str]]] = {
    "samples": [
        ("samples", "points that were looked at", "1"),
        ("label_rays", "points of which only what they meet was asked", "1"),
        ("radiance_evaluations", "points whose radiance was worked out", "1"),
    ],
    "quality": [
        ("converged", "whether the pixel meets the accuracy that was asked for", "1"),
        ("worst_ratio", "largest half-width over its limit", "1"),
        ("missable_fraction", "share of the pixel's area of a compact feature that may be missed", "1"),
        ("border_share", "share of the variance that borders make", "1"),
    ],
    "location": [
        ("easting", "easting of what the middle of the pixel sees", "m"),
        ("northing", "northing of what the middle of the pixel sees", "m"),
        ("height", "height of what the middle of the pixel sees", "m"),
    ],
    "true_location": [
        ("true_easting", "easting of what the middle of the pixel sees by the sensor's true pose", "m"),
        ("true_northing", "northing of that", "m"),
        ("true_height", "height of that", "m"),
    ],
    "view_angles": [
        ("view_zenith", "zenith angle of the direction to the sensor", "degree"),
        ("view_azimuth", "azimuth of the direction to the sensor, clockwise from north", "degree"),
    ],
    "temperature": [
        ("temperature", "temperature of what the middle of the pixel sees", "K"),
        ("temperature_deviation", "standard deviation of that, where it is estimated", "K"),
    ],
    "normal": [
        (f"normal_{axis}", f"{axis} component of the normal of what the middle of the pixel sees", "1")
        for axis in ("east", "north", "up")
    ],
    "slope": [
        ("slope", "angle between the vertical and the normal of what the middle of the pixel sees", "degree"),
        ("aspect", "azimuth of the direction in which it faces, clockwise from north", "degree"),
    ],
    "gsd": [
        ("gsd_across", "size of the pixel along image x on what its middle sees", "m"),
        ("gsd_along", "size of the pixel along image y on what its middle sees", "m"),
    ],
    "sun_angles": [
        ("sun_zenith", "zenith angle of the direction to the Sun", "degree"),
        ("sun_azimuth", "azimuth of the direction to the Sun, clockwise from north", "degree"),
        ("incidence", "angle between that direction and the normal of what the middle of the pixel sees", "degree"),
    ],
}
#: Of variables in a dataset; others come behind.
_ORDER = ("radiance", "standard_error", "half_width", "abundance", "quality", "samples", "reasons", "quality_class")
#: As CF conventions and UDUNITS write the units of headers.
_UNITS = {"deg": "degree", "count": "1", "": "1"}


@dataclasses.dataclass
class Image:
    """channels: (name, centre in um, full width at half maximum in um); geotransform: as GDAL counts"""

    width: int
    height: int
    channels: list[tuple[str, float, float]]
    materials: list[str]
    geotransform: tuple[float, ...] | None = None
    crs_wkt: str = ""


@dataclasses.dataclass
class Quantity:
    """Values of one cube. ``values()``: [band, row, column], perhaps mapped; they are read when they are asked for."""

    values: Callable[[], Any]
    bands: int
    dtype: np.dtype[Any]
    band_names: Sequence[str]
    what: str
    unit: str


@dataclasses.dataclass
class _Held:
    """An array that is there, called for as one that is read would be. (Datasets go to other processes: no lambda.)"""

    array: Any

    def __call__(self) -> Any:
        return self.array


class _Lazy(BackendArray):
    """Bands of a quantity, read where they are indexed."""

    def __init__(self, quantity: Quantity, shape: tuple[int, ...], band: int | None = None, dtype: Any = None):
        self.quantity = quantity
        self.shape = shape
        self.band = band
        self.dtype = np.dtype(dtype) if dtype is not None else quantity.dtype.newbyteorder("=")

    def __getitem__(self, key: Any) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key: tuple[Any, ...]) -> Any:
        values = self.quantity.values()
        if self.band is not None:
            values = values[self.band]
        elif values.shape != self.shape:  # components and channels
            strides = (self.shape[1] * values.strides[0], *values.strides)
            values = np.lib.stride_tricks.as_strided(values, self.shape, strides, writeable=False)
        if self.dtype == bool:  # what is not a number is not true
            return np.asarray(values[key]) == 1
        return np.array(values[key], dtype=self.dtype)


def dataset(image: Image, quantities: Mapping[str, Quantity], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """Dims (wavelength, y, x), (material, y, x), (y, x). Where the channels' wavelengths do not rise or fall from one to the next, the
    first of them is ``channel``."""
    centres = [centre for _, centre, _ in image.channels]
    steps = np.diff(centres)
    spectral = "wavelength" if bool(np.all(steps > 0) or np.all(steps < 0)) else "channel"
    names = [name for name, _, _ in image.channels]
    made = xarray.Dataset(coords=_coordinates(image, spectral), attrs=dict(attributes))
    size = (image.height, image.width)
    for name in sorted(quantities, key=lambda name: (_ORDER.index(name) if name in _ORDER else len(_ORDER), name)):
        quantity = quantities[name]
        if name in _BANDS and quantity.bands == len(_BANDS[name]):
            for band, (variable, what, unit) in enumerate(_BANDS[name]):
                dtype = bool if variable == "converged" else None
                made[variable] = _variable(("y", "x"), _Lazy(quantity, size, band, dtype), what, unit)
            continue
        if name.startswith("stokes") and quantity.bands == 4 * len(names):
            dims: tuple[str, ...] = ("stokes", spectral, "y", "x")
            made.coords["stokes_component"] = ("stokes", list(STOKES), {"long_name": "component of the Stokes vector"})
            array = _Lazy(quantity, (4, len(names), *size))
            name = {"stokes": "stokes_vector"}.get(name, name)
        elif quantity.bands == 1 and (list(quantity.band_names) != names or name in ("reasons", "quality_class")):
            dims, array = ("y", "x"), _Lazy(quantity, size, 0)
        elif list(quantity.band_names) == image.materials and name.startswith("abundance"):
            dims, array = ("material", "y", "x"), _Lazy(quantity, (quantity.bands, *size))
        elif quantity.bands == len(names):
            dims, array = (spectral, "y", "x"), _Lazy(quantity, (quantity.bands, *size))
        else:
            dims, array = (f"{name}_band", "y", "x"), _Lazy(quantity, (quantity.bands, *size))
            made.coords[f"{name}_band"] = list(quantity.band_names)
        made[name] = _variable(dims, array, quantity.what, quantity.unit)
    _relations(made)
    return made


def in_memory(values: np.ndarray[Any, Any], band_names: Sequence[str], what: str, unit: str) -> Quantity:
    """Of an array [band, row, column]."""
    return Quantity(_Held(values), values.shape[0], values.dtype, band_names, what, unit)


def _variable(dims: tuple[str, ...], array: _Lazy, what: str, unit: str) -> xarray.Variable:
    lazy: Any = indexing.LazilyIndexedArray(array)
    data = indexing.CopyOnWriteArray(lazy)
    return xarray.Variable(dims, data, {"long_name": what, "units": _UNITS.get(unit, unit)})


def _coordinates(image: Image, spectral: str) -> dict[str, Any]:
    um = {"units": "um"}
    coordinates: dict[str, Any] = {
        "wavelength": (
            spectral,
            [centre for _, centre, _ in image.channels],
            {"standard_name": "radiation_wavelength", "long_name": "centre of the channel", **um},
        ),
        "fwhm": (spectral, [width for _, _, width in image.channels], {"long_name": "full width at half maximum", **um}),
        "channel": (spectral, [name for name, _, _ in image.channels], {"long_name": "name of the channel"}),
    }
    if image.materials:
        coordinates["material"] = ("material", image.materials, {"long_name": "name of the material"})
    if image.geotransform is None:
        return coordinates
    transform = image.geotransform
    # + 0: no -0 of a turn by nothing
    reference: dict[str, Any] = {"GeoTransform": " ".join(repr(float(value) + 0.0) for value in transform)}
    if image.crs_wkt:
        reference |= {"crs_wkt": image.crs_wkt, "spatial_ref": image.crs_wkt}
    coordinates["spatial_ref"] = ((), 0, reference)
    if transform[2] == 0 and transform[4] == 0:
        for axis, first, step, count in (
            ("x", transform[0], transform[1], image.width),
            ("y", transform[3], transform[5], image.height),
        ):
            words = {"units": "m", "long_name": f"{axis} of the middle of the pixel", "axis": axis.upper()}
            if image.crs_wkt:
                words["standard_name"] = f"projection_{axis}_coordinate"
            coordinates[axis] = (axis, first + (np.arange(count) + 0.5) * step, words)
    return coordinates


def _relations(made: xarray.Dataset) -> None:
    """What CF conventions say of variables that belong together."""
    if "radiance" in made:
        errors = [name for name in ("standard_error", "half_width", "air_half_width") if name in made]
        if errors:
            made["radiance"].attrs["ancillary_variables"] = " ".join(errors)
    if "reasons" in made:
        made["reasons"].attrs |= {
            "flag_masks": np.array([1 << bit for bit in range(len(REASONS))], made["reasons"].dtype),
            "flag_meanings": " ".join(REASONS),
        }
    if "quality_class" in made:
        made["quality_class"].attrs |= {
            "flag_values": np.arange(len(_GRAVEST), dtype=made["quality_class"].dtype),
            "flag_meanings": " ".join(_GRAVEST),
        }
    for name in ("material_class", "dominant_material"):
        if name in made and "material" in made.coords:
            words = ("nothing", *made.coords["material"].values)
            made[name].attrs |= {
                "flag_values": np.arange(len(words), dtype=made[name].dtype),
                "flag_meanings": " ".join("_".join(str(word).split()) for word in words),
            }
    if "spatial_ref" in made.coords:
        for variable in made.data_vars.values():
            variable.encoding["grid_mapping"] = "spatial_ref"
