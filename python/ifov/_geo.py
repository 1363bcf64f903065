"""Datasets in formats of maps and catalogues."""

from __future__ import annotations

import datetime
import json
import math
import pathlib
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from ._key_path import without_comments

if TYPE_CHECKING:
    import xarray

_STAC_EXTENSIONS = {
    "eo:": "https://stac-extensions.github.io/eo/v1.1.0/schema.json",
    "processing:": "https://stac-extensions.github.io/processing/v1.1.0/schema.json",
    "proj:": "https://stac-extensions.github.io/projection/v1.1.0/schema.json",
    "view:": "https://stac-extensions.github.io/view/v1.0.0/schema.json",
}
_MEDIA = {
    ".img": "application/octet-stream",
    ".hdr": "text/plain",
    ".tif": "image/tiff; application=geotiff; profile=cloud-optimized",
    ".nc": "application/netcdf",
    ".vrt": "application/xml",
    ".png": "image/png",
    ".html": "text/html",
    ".json": "application/json",
}
_OVERVIEWS, _TOLD = (".png",), (".hdr", ".html", ".json")
_EARTH_M = 6371000.0
_PLACES_OF_SIDE = 32


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
    """A dict of JSON values. Without a place on the Earth its geometry is null. What the program writes (format "stac") says the same."""
    channels = [
        {"name": str(channel), "center_wavelength": float(centre), "full_width_half_max": float(width)}
        for channel, centre, width in zip(
            dataset["channel"].values, dataset["wavelength"].values, dataset["fwhm"].values, strict=True
        )
    ]
    acquisition = json.loads(dataset.attrs.get("acquisition", "{}"))
    document = pathlib.PurePath(str(dataset.attrs.get("document_name", name))).name
    properties: dict[str, Any] = {
        **_instants(dataset, acquisition),
        "title": f"{document}, rendered by {dataset.attrs.get('source', 'ifov')}",
        "proj:epsg": None,
        "proj:shape": [dataset.sizes["y"], dataset.sizes["x"]],
        **_views(acquisition),
        "processing:software": {"ifov": dataset.attrs.get("version", "")},
        "ifov:asked": dataset.attrs.get("asked", ""),
        "ifov:reached": dataset.attrs.get("reached", ""),
    }
    if (gsd := acquisition.get("camera", {}).get("ground_sample_m", 0)) > 0:
        properties["gsd"] = gsd
    if (transform := _transform(dataset)) is not None:
        properties["proj:epsg"] = _epsg(_wkt(dataset))
        properties["proj:transform"] = [transform[1], transform[2], transform[0], transform[4], transform[5], transform[3]]
        if properties["proj:epsg"] is None and (wkt2 := _wkt2(_wkt(dataset))):
            properties["proj:wkt2"] = wkt2
    used = [link for prefix, link in _STAC_EXTENSIONS.items() if prefix == "eo:" or any(key.startswith(prefix) for key in properties)]
    rings = _polygons(_outline(dataset, acquisition))
    item: dict[str, Any] = {
        "type": "Feature",
        "stac_version": "1.0.0",
        "stac_extensions": used,
        "id": name,
        "geometry": None,
        "properties": properties,
        "links": [],
        "assets": {key: _asset(dataset, key, link, channels) for key, link in assets.items()},
    }
    if rings:
        closed: list[Any] = [[[list(place) for place in (*ring, ring[0])]] for ring in rings]
        item["geometry"] = (
            {"type": "Polygon", "coordinates": closed[0]}
            if len(closed) == 1
            else {"type": "MultiPolygon", "coordinates": closed}
        )
        latitudes = [latitude for ring in rings for _, latitude in ring]
        # Over the date line west is greater than east.
        west, east = min(longitude for longitude, _ in rings[0]), max(longitude for longitude, _ in rings[-1])
        item["bbox"] = [west, min(latitudes), east, max(latitudes)]
    return item


def _asset(dataset: xarray.Dataset, key: str, link: str, channels: list[dict[str, Any]]) -> dict[str, Any]:
    ending = pathlib.PurePath(link).suffix
    role = "overview" if ending in _OVERVIEWS else "metadata" if ending in _TOLD else "data"
    made: dict[str, Any] = {"href": link, "title": key, "roles": [role]}
    if ending in _MEDIA:
        made["type"] = _MEDIA[ending]
    spectral = dataset["channel"].dims[:1]
    if key in ("geotiff", "netcdf", "vrt", "demosaiced") or (key in dataset and dataset[key].ndim == 3 and dataset[key].dims[:1] == spectral):
        made["eo:bands"] = channels
    return made


def _views(acquisition: dict[str, Any]) -> dict[str, float]:
    """Angles of the image's middle, degrees."""
    angles: dict[str, float] = {}
    camera = acquisition.get("camera", {})
    east, north, up = camera.get("forward", (0.0, 0.0, 0.0))
    if up < 0:
        nadir = np.array([0.0, 0.0, -1.0])
        if "position_m" in camera:
            sensor = np.array(camera["position_m"]) - np.array(acquisition["origin"]["map_m"])
            nadir = np.array([0.0, 0.0, -(_EARTH_M + acquisition["origin"]["height_m"])]) - sensor
            nadir /= np.linalg.norm(nadir)
        sight = np.array([east, north, up])
        angles["view:off_nadir"] = math.degrees(math.atan2(float(np.linalg.norm(np.cross(nadir, sight))), float(nadir @ sight)))
        angles["view:incidence_angle"] = math.degrees(math.atan2(math.hypot(east, north), -up))
        if math.hypot(east, north) > 1e-9:
            angles["view:azimuth"] = math.degrees(math.atan2(-east, -north)) % 360.0
    if sun := acquisition.get("sun"):
        angles["view:sun_azimuth"], angles["view:sun_elevation"] = sun["azimuth_deg"], 90.0 - sun["zenith_deg"]
    return angles


def _outline(dataset: xarray.Dataset, acquisition: dict[str, Any]) -> list[tuple[float, float]]:
    """Longitudes and latitudes around the image, as well as they are known."""
    rows, columns = dataset.sizes["y"], dataset.sizes["x"]
    wkt = _wkt(dataset)
    places: list[tuple[float, float]] = []
    if (transform := _transform(dataset)) is not None and wkt:
        places = [
            (transform[0] + c * transform[1] + r * transform[2], transform[3] + c * transform[4] + r * transform[5])
            for c, r in ((0, 0), (columns, 0), (columns, rows), (0, rows))
        ]
    elif transform is None and (wkt := acquisition.get("map_system", "")) and "easting" in dataset:
        right, low = columns - 1, rows - 1
        rim = [(0, 0), (right, 0), (right, low), (0, low), (0, 0)]
        for (x0, y0), (x1, y1) in zip(rim, rim[1:], strict=False):
            steps = min(max(abs(x1 - x0), abs(y1 - y0), 1), _PLACES_OF_SIDE)
            for k in range(steps):
                column, row = x0 + int((x1 - x0) * k / steps), y0 + int((y1 - y0) * k / steps)
                x, y = (float(dataset[name][row, column]) for name in ("easting", "northing"))
                if math.isfinite(x) and math.isfinite(y):
                    places.append((x, y))
    if len(places) >= 3 and (degrees := _degrees(wkt, places)) is not None:
        return [(longitude, latitude) for longitude, latitude in degrees]
    corners = [corner for corner in acquisition.get("footprint", ()) if corner and "latitude_deg" in corner]
    return [(corner["longitude_deg"], corner["latitude_deg"]) for corner in corners]


_Ring = list[tuple[float, float]]


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _area(ring: _Ring) -> float:
    return sum(_turn(ring[0], ring[k], ring[k + 1]) for k in range(1, len(ring) - 1)) / 2


def _crosses_itself(ring: _Ring) -> bool:
    sides = list(zip(ring, ring[1:] + ring[:1], strict=True))
    return any(
        _turn(a, b, c) * _turn(a, b, d) < 0 and _turn(c, d, a) * _turn(c, d, b) < 0
        for i, (a, b) in enumerate(sides)
        for c, d in sides[i + 2 :]
    )


def _hull(places: _Ring) -> _Ring:
    """By Andrew's chains."""
    ring: _Ring = []
    for chain in (sorted(places), sorted(places, reverse=True)):
        part: _Ring = []
        for place in chain:
            while len(part) >= 2 and _turn(part[-2], part[-1], place) <= 0:
                part.pop()
            part.append(place)
        ring += part[:-1]
    return ring


def _polygons(outline: _Ring) -> list[_Ring]:
    """Rings, counter-clockwise and without crossings; two where the outline reaches over the date line."""
    ring = [place for k, place in enumerate(outline) if k == 0 or place != outline[k - 1]]
    while len(ring) > 1 and ring[0] == ring[-1]:
        ring.pop()
    if len(ring) < 3:
        return []
    over = max(longitude for longitude, _ in ring) - min(longitude for longitude, _ in ring) > 180
    if over:
        ring = [(longitude + 360 if longitude < 0 else longitude, latitude) for longitude, latitude in ring]
    if _crosses_itself(ring):
        ring = _hull(ring)
    if _area(ring) < 0:
        ring.reverse()
    if len(ring) < 3 or _area(ring) == 0:
        return []
    if not over:
        return [ring]
    west = _beyond_date_line(ring, -1)
    east = [(longitude - 360, latitude) for longitude, latitude in _beyond_date_line(ring, 1)]
    return [part for part in (west, east) if len(part) >= 3]


def _beyond_date_line(ring: _Ring, side: int) -> _Ring:
    part: _Ring = []
    for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
        start, end = side * (a[0] - 180), side * (b[0] - 180)
        if start >= 0:
            part.append(a)
        if start * end < 0:
            part.append((180.0, a[1] + (b[1] - a[1]) * start / (start - end)))
    return part


def _wkt2(wkt: str) -> str | None:
    """None where pyproj is missing."""
    try:
        from pyproj import CRS
    except ImportError:
        return None
    return str(CRS.from_wkt(wkt).to_wkt("WKT2_2019")) if wkt else None


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


def _instants(dataset: xarray.Dataset, acquisition: dict[str, Any]) -> dict[str, Any]:
    """One, or of a series the first and the last; of cameras that scan the middle, the first and the last line's."""
    if "time" in dataset.coords:
        times = [f"{time}Z" for time in np.datetime_as_string(np.atleast_1d(dataset["time"].values), unit="s")]
        if dataset["time"].ndim == 0:
            return {"datetime": times[0]}
        return {"datetime": None, "start_datetime": times[0], "end_datetime": times[-1]}
    instant = _instant(dataset, acquisition)
    lines = acquisition.get("camera", {}).get("lines", [])
    if not lines or not acquisition.get("time"):
        return {"datetime": instant}
    first, last = lines[0]["time_s"], lines[-1]["time_s"]
    return {
        "datetime": _later(instant, (first + last) / 2),
        "start_datetime": _later(instant, min(first, last)),
        "end_datetime": _later(instant, max(first, last)),
    }


def _later(instant: str, seconds: float) -> str:
    moment = datetime.datetime.fromisoformat(instant.replace("Z", "+00:00")) + datetime.timedelta(seconds=seconds)
    moment += datetime.timedelta(microseconds=500)  # to the nearest millisecond
    return moment.strftime("%Y-%m-%dT%H:%M:%S.") + f"{moment.microsecond // 1000:03d}Z"


def _instant(dataset: xarray.Dataset, acquisition: dict[str, Any]) -> str:
    """That of the document; STAC asks for one, so else when the products were made, or the present."""
    if time := dataset.attrs.get("acquisition_time"):
        return str(time)
    try:
        document = json.loads(without_comments(dataset.attrs.get("document", "{}")))
    except json.JSONDecodeError:
        document = {}
    if isinstance(document, dict) and isinstance(document.get("time"), str):
        return str(document["time"])
    if made := acquisition.get("made"):
        return str(made)
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
