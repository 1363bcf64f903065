"""``load``: the products of a run, or of what is there of one."""

from __future__ import annotations

import json
import math
import os
import pathlib
from typing import TYPE_CHECKING, Any

from . import _envi
from ._errors import DocumentError

if TYPE_CHECKING:
    import xarray

    from ._dataset import Image


def load(folder: str | os.PathLike[str]) -> xarray.Dataset:
    """The products of a run as a Dataset; values are read from the ENVI cubes when they are asked for.

    folder: an output folder, or its run record (``NAME_run.json``). A folder without products, of an unfinished run or of a share of the
    tiles, gives what its finished tiles hold; pixels of the others are not a number. A run at work moves its tiles: ``load(...).load()``
    takes them at once. The folder of a series of times (``ifov render --times``), or its record (``NAME_series.json``), gives those of its
    times that are made, with ``time`` (UTC) as the first dim; ``attrs["times_left"]`` counts the others.

    Dims are (wavelength, y, x) of ``radiance``, ``half_width`` ..., (material, y, x) of ``abundance``, and (y, x) of ``samples``,
    ``converged`` and others (docs/guide/python.md). Throws ``DocumentError`` where there is no run, ``OSError``.
    """
    path = pathlib.Path(folder)
    records = [path] if path.name.endswith("_run.json") else sorted(path.glob("*_run.json"))
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such folder")
    if len(records) == 1:
        return _finished(records[0])
    series = [path] if path.name.endswith("_series.json") else sorted(path.glob("*_series.json"))
    if series and not records:
        from ._series import load_series

        return load_series(series[0])
    if records:
        names = ", ".join(record.name for record in records)
        raise DocumentError(f"{path}: there are several runs, {names}; name the record of one", str(path))
    for state in (path / "run.part", path / "run.kept"):
        if (state / "state.json").exists():
            from ._tiles import unfinished

            return unfinished(path, state)
    raise DocumentError(f"{path}: there is no run: neither NAME_run.json nor run.part nor NAME_series.json", str(path))


def _finished(record_file: pathlib.Path) -> xarray.Dataset:
    from ._dataset import Quantity, dataset

    record = json.loads(record_file.read_text(encoding="utf-8"))
    prefix = record_file.name.removesuffix("run.json")
    quantities: dict[str, Quantity] = {}
    for data in sorted(record_file.parent.glob(prefix + "*.img"), key=lambda data: (data.name != prefix + "radiance.img", data)):
        cube = _envi.find_cube(data)
        if cube is None:
            continue
        what = cube.fields.get("description", "").split(",")[0].strip()
        quantities[data.name.removeprefix(prefix).removesuffix(".img")] = Quantity(
            cube.values, cube.shape[0], cube.dtype, cube.band_names, what, cube.fields.get("data units", "")
        )
    image = image_of(record["image"], record["channels"], record["image"].get("map"))
    accuracy = record["accuracy"]
    return dataset(
        image,
        quantities,
        attributes(
            version=record["program"]["version"],
            document=record["document"]["text"],
            document_name=record["document"]["path"],
            seed=record["seed"],
            asked=accuracy["asked"],
            reached=accuracy["reached"],
            confidence=accuracy["confidence"],
            acquisition=record.get("acquisition"),
            map_system=(record["image"].get("map") or {}).get("system", {}).get("wkt", ""),
            date=record.get("date", ""),
        ),
    )


def image_of(image: dict[str, Any], channels: list[dict[str, Any]], place: dict[str, Any] | None) -> Image:
    """As run records and states tell it."""
    from ._dataset import Image

    made = Image(
        image["width_px"],
        image["height_px"],
        [(channel["name"], channel["centre_um"], channel["fwhm_um"]) for channel in channels],
        list(image["materials"]),
    )
    if place:
        left, top = place.get("upper_left_x_m", place.get("x_m")), place.get("upper_left_y_m", place.get("y_m"))
        if left is not None and top is not None:
            cosine = place["gsd_m"] * math.cos(place["rotation_rad"])
            sine = place["gsd_m"] * math.sin(place["rotation_rad"])
            made.geotransform = (left, cosine, -sine, top, -sine, -cosine)
        made.crs_wkt = place.get("system", {}).get("wkt", "")
    return made


def attributes(
    *,
    version: str,
    document: str,
    document_name: str,
    seed: int,
    asked: str,
    reached: str,
    confidence: float,
    time: str = "",
    acquisition: dict[str, Any] | None = None,
    map_system: str = "",
    date: str = "",
) -> dict[str, Any]:
    """Of a dataset. date: when its products were made."""
    made = {
        "Conventions": "CF-1.8",
        "source": f"ifov {version}",
        "version": version,
        "document": document,
        "document_name": document_name,
        "seed": seed,
        "asked": asked,
        "reached": reached,
        "confidence": confidence,
    }
    if time := time or (acquisition or {}).get("time", ""):
        made["acquisition_time"] = time
    if acquisition:
        made["acquisition"] = json.dumps(acquisition | {"map_system": map_system, "made": date})
    return made
