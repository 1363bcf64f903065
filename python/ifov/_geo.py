"""Datasets in formats of maps and catalogues."""

from __future__ import annotations

import datetime
import json
import pathlib
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from ._key_path import without_comments

if TYPE_CHECKING:
    import xarray

_STAC_EXTENSIONS = [
    "https://stac-extensions.github.io/eo/v1.1.0/schema.json",
    "https://stac-extensions.github.io/projection/v1.1.0/schema.json",
]


def _transform(dataset: xarray.Dataset) -> list[float] | None:
    """As GDAL counts."""
    if "spatial_ref" not in dataset.coords or "GeoTransform" not in dataset["spatial_ref"].attrs:
        return None
    return [float(number) for number in dataset["spatial_ref"].attrs["GeoTransform"].split()]


def _wkt(dataset: xarray.Dataset) -> str:
    return str(dataset["spatial_ref"].attrs.get("crs_wkt", "")) if "spatial_ref" in dataset.coords else ""


def write_cog(dataset: xarray.Dataset, path: pathlib.Path, variable: str) -> None:
    """Of one variable (y, x) or (band, y, x)."""
    try:
        import rasterio
        import rasterio.shutil
        from rasterio.io import MemoryFile
    except ImportError as error:
        raise ImportError("to_cog needs the package rasterio: pip install rasterio") from error
    array = dataset[variable]
    if array.dims[-2:] != ("y", "x") or array.ndim > 3:
        raise ValueError(f"{variable}: has dims {array.dims}; expected (y, x), or one more before them")
    values = array.values if array.ndim == 3 else array.values[None]
    if values.dtype == bool:
        values = values.astype(np.uint8)
    profile: dict[str, Any] = {
        "driver": "GTiff",
        "dtype": values.dtype,
        "count": values.shape[0],
        "height": values.shape[1],
        "width": values.shape[2],
    }
    if values.dtype.kind == "f":
        profile["nodata"] = float("nan")
    if (transform := _transform(dataset)) is not None:
        profile["transform"] = rasterio.Affine.from_gdal(*transform)
    if wkt := _wkt(dataset):
        profile["crs"] = wkt
    spectral = array.ndim == 3 and array.dims[0] in ("wavelength", "channel")
    with MemoryFile() as memory:
        with memory.open(**profile) as image:
            image.write(values)
            if spectral:
                for band in range(values.shape[0]):
                    image.set_band_description(band + 1, str(dataset["channel"].values[band]))
                    wavelength, fwhm = (float(dataset[name].values[band]) for name in ("wavelength", "fwhm"))
                    image.update_tags(band + 1, wavelength=repr(wavelength), wavelength_units="Micrometers", fwhm=repr(fwhm))
            image.update_tags(units=array.attrs.get("units", ""), source=dataset.attrs.get("source", ""))
        with memory.open() as image:
            rasterio.shutil.copy(image, path, driver="COG", compress="DEFLATE")


def stac_item(dataset: xarray.Dataset, assets: dict[str, str], name: str) -> dict[str, Any]:
    """A dict of JSON values. Without a place on the Earth its geometry is null."""
    channels = [
        {"name": str(channel), "center_wavelength": float(centre), "full_width_half_max": float(width)}
        for channel, centre, width in zip(
            dataset["channel"].values, dataset["wavelength"].values, dataset["fwhm"].values, strict=True
        )
    ]
    properties: dict[str, Any] = {
        **_instants(dataset),
        "title": f"{dataset.attrs.get('document_name', name)}, rendered by {dataset.attrs.get('source', 'ifov')}",
        "processing:software": {"ifov": dataset.attrs.get("version", "")},
        "ifov:asked": dataset.attrs.get("asked", ""),
        "ifov:reached": dataset.attrs.get("reached", ""),
    }
    item: dict[str, Any] = {
        "type": "Feature",
        "stac_version": "1.0.0",
        "stac_extensions": _STAC_EXTENSIONS,
        "id": name,
        "geometry": None,
        "properties": properties,
        "links": [],
        "assets": {
            key: {"href": link, "roles": ["data"], "title": key} | ({"eo:bands": channels} if key == "radiance" else {})
            for key, link in assets.items()
        },
    }
    transform = _transform(dataset)
    if transform is not None:
        rows, columns = dataset.sizes["y"], dataset.sizes["x"]
        properties |= {"proj:shape": [rows, columns], "proj:epsg": _epsg(_wkt(dataset))}
        properties["proj:transform"] = [transform[1], transform[2], transform[0], transform[4], transform[5], transform[3]]
        if wkt := _wkt(dataset):
            corners = [
                (transform[0] + c * transform[1] + r * transform[2], transform[3] + c * transform[4] + r * transform[5])
                for c, r in ((0, rows), (columns, rows), (columns, 0), (0, 0))
            ]
            if (ring := _degrees(wkt, corners)) is not None:
                item["geometry"] = {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}
                longitudes, latitudes = zip(*ring, strict=True)
                item["bbox"] = [min(longitudes), min(latitudes), max(longitudes), max(latitudes)]
    return item


def _epsg(wkt: str) -> int | None:
    """The code at the end of a WKT; None where it has none."""
    found = re.search(r'AUTHORITY\["EPSG",\s*"(\d+)"\]\s*\]\s*$', wkt)
    return int(found.group(1)) if found else None


def _degrees(wkt: str, corners: list[tuple[float, float]]) -> list[list[float]] | None:
    """Longitude and latitude (WGS 84), by pyproj or rasterio; None where there is neither."""
    x, y = zip(*corners, strict=True)
    try:
        from pyproj import Transformer

        longitude, latitude = Transformer.from_crs(wkt, "EPSG:4326", always_xy=True).transform(x, y)
    except ImportError:
        try:
            from rasterio.warp import transform
        except ImportError:
            return None
        longitude, latitude = transform(wkt, "EPSG:4326", x, y)
    return [[float(a), float(b)] for a, b in zip(longitude, latitude, strict=True)]


def _instants(dataset: xarray.Dataset) -> dict[str, Any]:
    """One, or of a series the first and the last."""
    if "time" not in dataset.coords:
        return {"datetime": _instant(dataset)}
    times = [f"{time}Z" for time in np.datetime_as_string(np.atleast_1d(dataset["time"].values), unit="s")]
    if dataset["time"].ndim == 0:
        return {"datetime": times[0]}
    return {"datetime": None, "start_datetime": times[0], "end_datetime": times[-1]}


def _instant(dataset: xarray.Dataset) -> str:
    """That of the document; STAC asks for one, so else the present."""
    if time := dataset.attrs.get("acquisition_time"):
        return str(time)
    try:
        document = json.loads(without_comments(dataset.attrs.get("document", "{}")))
    except json.JSONDecodeError:
        document = {}
    if isinstance(document, dict) and isinstance(document.get("time"), str):
        return str(document["time"])
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
