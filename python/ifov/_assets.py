"""Arrays in place of files: what documents name ``asset:NAME``."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._library import library


@dataclasses.dataclass
class Mesh:
    """Triangles, counter-clockwise when seen from outside.

    vertices: (n, 3), metres or the document's ``unit``; triangles: (m, 3), of vertices, from 0; normals: (n, 3) of vertices, or None:
    flat; uv: (n, 2) of vertices; materials: (m,), into material_names
    """

    vertices: npt.ArrayLike
    triangles: npt.ArrayLike
    normals: npt.ArrayLike | None = None
    uv: npt.ArrayLike | None = None
    materials: npt.ArrayLike | None = None
    material_names: Sequence[str] = ()


@dataclasses.dataclass
class Raster:
    """Numbers on a grid, rows from the top: terrain, textures, classes, temperatures, kernels.

    values: (row, column) or (band, row, column), kept as float32; geotransform: x0, dx, x by row, y0, y by column, dy of corners of
    cells; None: the document says where it lies; crs: "EPSG:32633", a WKT or PROJ string; units: of each band
    """

    values: npt.ArrayLike
    geotransform: Sequence[float] | None = None
    crs: str = ""
    nodata: float | None = None
    units: Sequence[str] = ()


@dataclasses.dataclass
class Spectrum:
    """Values at wavelengths that rise or fall: (n,) each; micrometres, or the document's ``wavelength_unit``."""

    wavelength: npt.ArrayLike
    values: npt.ArrayLike


@dataclasses.dataclass
class Copies:
    """Where copies of an object stand. positions: (n, 3), m; yaw: (n,), rad, counter-clockwise from above; scale: (n,), above 0."""

    positions: npt.ArrayLike
    yaw: npt.ArrayLike | None = None
    scale: npt.ArrayLike | None = None


#: An array of two or three axes stands for a Raster, a DataArray along ``wavelength`` for a Spectrum, ``bytes`` for the contents of a file
#: of any format.
Asset = Mesh | Raster | Spectrum | Copies | bytes | npt.NDArray[Any]


def assets_of(given: Mapping[str, Any]) -> Any:
    """The library's. Throws ``DocumentError``, with the name, on arrays that do not fit."""
    made = library().Assets()
    for name, asset in given.items():
        if not isinstance(asset, (bytes, bytearray, memoryview)):
            _check_shapes(name, asset)
        if getattr(asset, "dims", ()) == ("wavelength",):
            asset = Spectrum(asset["wavelength"].values, asset.values)
        if isinstance(asset, Mesh):
            made.add_mesh(
                name,
                _array(asset.vertices, float),
                _array(asset.triangles, np.uint32),
                _array(asset.normals, float),
                _array(asset.uv, float),
                _array(asset.materials, np.uint32),
                list(asset.material_names),
            )
        elif isinstance(asset, Spectrum):
            made.add_spectrum(name, _array(asset.wavelength, float), _array(asset.values, float))
        elif isinstance(asset, Copies):
            made.add_copies(name, _array(asset.positions, float), _array(asset.yaw, float), _array(asset.scale, float))
        elif isinstance(asset, (bytes, bytearray, memoryview)):
            made.add_file(name, bytes(asset))
        else:
            _add_raster(made, name, asset)
    return made


#: Of the arrays of a kind: the length of their second axis, 0 where they have one axis alone.
_SHAPES: dict[type, dict[str, int]] = {
    Mesh: {"vertices": 3, "triangles": 3, "normals": 3, "uv": 2, "materials": 0},
    Spectrum: {"wavelength": 0, "values": 0},
    Copies: {"positions": 3, "yaw": 0, "scale": 0},
}


def _check_shapes(name: str, asset: Any) -> None:
    for field, columns in _SHAPES.get(type(asset), {}).items():
        if (values := getattr(asset, field)) is None:
            continue
        shape = np.shape(values)
        if len(shape) != (2 if columns else 1) or (columns and shape[1] != columns):
            wanted = f"(n, {columns})" if columns else "(n,)"
            raise TypeError(f"assets[{name!r}]: {field}: found shape {shape}; expected {wanted}")


def _add_raster(made: Any, name: str, asset: Any) -> None:
    raster = asset
    if not isinstance(asset, Raster):
        raster = _raster_of(asset)
    values = np.asarray(raster.values)
    if values.dtype.kind not in "biuf" or values.ndim not in (2, 3):
        raise TypeError(
            f"assets[{name!r}]: found {type(asset).__name__} of {values.ndim} axes and type {values.dtype}; "
            "expected ifov.Mesh, Raster, Spectrum, Copies, bytes, or numbers (row, column) or (band, row, column)"
        )
    cells = _array(values if values.ndim == 3 else values[None], np.float32)
    place = None if raster.geotransform is None else [float(number) for number in raster.geotransform]
    made.add_raster(name, cells, place, raster.crs, raster.nodata, list(raster.units))


def _raster_of(asset: Any) -> Raster:
    """An array, or a DataArray with even x and y."""
    if not (hasattr(asset, "coords") and hasattr(asset, "values")):
        return Raster(asset)
    place = None
    if "x" in asset.coords and "y" in asset.coords and asset.sizes["x"] > 1 and asset.sizes["y"] > 1:
        x, y = (np.asarray(asset.coords[axis], float) for axis in ("x", "y"))
        dx, dy = (x[-1] - x[0]) / (x.size - 1), (y[-1] - y[0]) / (y.size - 1)
        place = (x[0] - dx / 2, dx, 0.0, y[0] - dy / 2, 0.0, dy)
    reference = asset.coords["spatial_ref"].attrs.get("crs_wkt", "") if "spatial_ref" in asset.coords else ""
    return Raster(asset.values, place, reference)


def _array(values: Any, kind: Any) -> Any:
    if values is None:
        return None
    array = np.asarray(values)
    if kind is np.uint32 and array.size and (array.dtype.kind not in "iu" or array.min() < 0):
        raise TypeError(f"found indices of type {array.dtype}; expected whole numbers from 0")
    return np.ascontiguousarray(array, kind)
