"""``ds.ifov``: what is often done with images. Importing this gives it to all datasets of xarray; ``ifov.load`` and ``ifov.render`` do."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray

from . import _geo, radiometry


@xarray.register_dataset_accessor("ifov")  # type: ignore[no-untyped-call]
class Accessor:
    """Of a Dataset with ``radiance(wavelength, y, x)``, and errors beside it."""

    def __init__(self, dataset: xarray.Dataset):
        self._dataset = dataset

    def rgb(self, um: Sequence[float] = (0.66, 0.56, 0.48), percent: tuple[float, float] = (1.0, 99.0)) -> xarray.DataArray:
        """A picture: (y, x, rgb), of a series (time, y, x, rgb), 0 to 1, of the channels nearest to three wavelengths (um), linear between the given percentiles of all
        three together. Pixels without a value are not a number."""
        names = self._dataset["channel"].values
        chosen = [int(np.abs(self._dataset["wavelength"].values - wanted).argmin()) for wanted in um]
        picture = self._radiance.isel({self._spectral: chosen}).transpose(..., "y", "x", self._spectral).astype(float)
        low, high = np.nanpercentile(picture.values, percent) if np.isfinite(picture.values).any() else (0.0, 1.0)
        values = np.clip((picture.values - low) / (high - low if high > low else 1.0), 0.0, 1.0)
        coords = {axis: self._dataset.coords[axis] for axis in ("time", "x", "y") if axis in self._dataset.coords}
        words = {"long_name": "red, green, blue of " + ", ".join(str(names[one]) for one in chosen), "units": "1"}
        return xarray.DataArray(values, coords | {"rgb": ["r", "g", "b"]}, (*picture.dims[:-1], "rgb"), "rgb", words)

    def spectrum(self, x: float, y: float) -> xarray.Dataset:
        """Spectra of the pixel nearest to a place: in map coordinates where the dataset has coordinates x and y, else column and row from
        0. What has a value for each channel is in it, and the rest of the pixel's values."""
        place: dict[str, Any] = {}
        for axis, wanted in (("x", x), ("y", y)):
            count = self._dataset.sizes[axis]
            index = round(wanted)
            if axis in self._dataset.coords:
                values = self._dataset[axis].values
                index = int(np.abs(values - wanted).argmin())
                half = abs(values[1] - values[0]) / 2 if count > 1 else np.inf
                if abs(values[index] - wanted) > half * (1 + 1e-9):
                    index = -1
            if not 0 <= index < count:
                raise IndexError(f"{axis} = {wanted}: outside of the image")
            place[axis] = index
        return self._dataset.isel(place)

    def channel(self, name: str) -> xarray.Dataset:
        """What is told of one channel, by its name: as ``isel`` of its place. Throws ``KeyError`` with the names that there are."""
        names = [str(one) for one in np.atleast_1d(self._dataset["channel"].values)]
        if name not in names:
            raise KeyError(f"channel: found {name!r}; expected one of " + ", ".join(repr(one) for one in names))
        return self._dataset.isel({self._spectral: names.index(name)})

    def brightness_temperature(self) -> xarray.DataArray:
        """K, (wavelength, y, x): of a black body that has the radiance at the channel's centre; 0 where there is no light."""
        array = self._of_radiance(radiometry.brightness_temperature, self._radiance, self._dataset["wavelength"])
        array.name = "brightness_temperature"
        array.attrs = {"units": "K", "long_name": "brightness temperature at the channel's centre"}
        array.attrs["standard_name"] = "brightness_temperature"
        return array

    def brightness_temperature_half_width(self) -> xarray.DataArray:
        """K, (wavelength, y, x): the half-width of the radiance over the slope of Planck's law, dB/dT, at the brightness temperature. Not
        a number where there is no light."""
        slope = self._of_radiance(radiometry.planck_slope, self.brightness_temperature(), self._dataset["wavelength"])
        array: xarray.DataArray = self._half_width / slope.where(slope > 0)
        array.name = "brightness_temperature_half_width"
        array.attrs = {"units": "K", "long_name": "half-width of the brightness temperature's interval"}
        return array

    def relative_error(self) -> xarray.DataArray:
        """Half-width of the interval over the radiance, (wavelength, y, x), 1. Not a number where there is no light."""
        radiance = self._radiance
        array: xarray.DataArray = self._half_width / np.abs(radiance.where(radiance != 0))
        array.name = "relative_error"
        array.attrs = {"units": "1", "long_name": "half-width of the interval over the radiance"}
        return array

    def to_netcdf(self, path: str | os.PathLike[str], **options: Any) -> None:
        """Writes everything by the CF conventions. options: of ``xarray.Dataset.to_netcdf``."""
        self._dataset.to_netcdf(path, **options)

    def to_zarr(self, store: Any, **options: Any) -> None:
        """Writes everything as Zarr. Needs the package zarr. options: of ``xarray.Dataset.to_zarr``."""
        options.setdefault("zarr_format", 2)  # of which other programs read texts, too
        self._dataset.to_zarr(store, **options)

    def to_cog(self, path: str | os.PathLike[str], variable: str = "radiance") -> None:
        """Writes one variable as a Cloud Optimized GeoTIFF, a band a channel. Needs the package rasterio."""
        _geo.write_cog(self._dataset, pathlib.Path(path), variable)

    def to_stac(self, path: str | os.PathLike[str] | None = None, assets: dict[str, str] | None = None) -> dict[str, Any]:
        """An Item of STAC 1.0 (with the extensions eo, projection, view and processing), as a dict and, where a path is given, in a file.
        assets: links to files by the name of what they hold, {"radiance": "image_radiance.img"}. It says the same as what runs write
        (``"formats": ["stac"]``) of datasets that ``ifov.load`` has; others do not know camera and Sun."""
        item = _geo.stac_item(self._dataset, assets or {}, "ifov" if path is None else pathlib.Path(path).stem)
        if path is not None:
            pathlib.Path(path).write_text(json.dumps(item, indent=2) + "\n", encoding="utf-8")
        return item

    @property
    def _radiance(self) -> xarray.DataArray:
        if "radiance" not in self._dataset:
            raise KeyError("radiance: this dataset has none")
        return self._dataset["radiance"]

    @property
    def _half_width(self) -> xarray.DataArray:
        if "half_width" not in self._dataset:
            raise KeyError("half_width: this dataset knows no errors")
        return self._dataset["half_width"]

    @property
    def _spectral(self) -> str:
        if self._dataset["wavelength"].ndim == 0:
            raise ValueError("the dataset is of one channel alone; take what needs several from the whole one")
        return str(self._dataset["wavelength"].dims[0])

    def _of_radiance(self, function: Any, radiance: xarray.DataArray, wavelength: xarray.DataArray) -> xarray.DataArray:
        made: xarray.DataArray = xarray.apply_ufunc(function, wavelength, radiance, dask="allowed")
        return made.transpose(*radiance.dims)
