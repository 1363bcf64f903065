"""What the air of a document does to light."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._document import Written
from ._library import library
from ._progress import Reporter, Show
from ._render import parsed

if TYPE_CHECKING:
    import xarray

_RADIANCE, _IRRADIANCE = "W m-2 sr-1 um-1", "W m-2 um-1"
_WORDS = {
    "solar_irradiance": (_IRRADIANCE, "the Sun's irradiance above the air, across the beam"),
    "sun_transmittance": ("1", "transmittance of direct sunlight down to the ground"),
    "view_transmittance": ("1", "direct transmittance from the ground to the sensor"),
    "diffuse_transmittance": ("1", "from bright ground all around to the sensor, scattered on the way"),
    "solar_path": (_RADIANCE, "sunlight that the path to the sensor adds"),
    "thermal_path": (_RADIANCE, "emission that the path to the sensor adds"),
    "direct_irradiance": (_IRRADIANCE, "direct sunlight on level ground"),
    "solar_sky": (_IRRADIANCE, "sunlight from the sky on level ground"),
    "thermal_sky": (_IRRADIANCE, "emission of the sky on level ground"),
    "spherical_albedo": ("1", "albedo of the air for light from below"),
    "path_q": (_RADIANCE, "Q of solar_path about the vertical plane of the line of sight"),
    "path_u": (_RADIANCE, "U of solar_path"),
    "ground_diffuse": (_IRRADIANCE, "the sky's light on level ground as asked for"),
    "ground_up": (_IRRADIANCE, "light that level ground as asked for reflects"),
    "sensor_direct": (_IRRADIANCE, "straight sunlight through the level of the sensor"),
    "sensor_diffuse": (_IRRADIANCE, "other light that comes down through the level of the sensor"),
    "sensor_up": (_IRRADIANCE, "light that goes up through the level of the sensor"),
    "radiance": (_RADIANCE, "at the sensor, over ground as asked for, which emits nothing"),
    "q": (_RADIANCE, "Q of radiance"),
    "u": (_RADIANCE, "U of radiance"),
}


def atmosphere(
    document: Mapping[str, Any],
    *,
    sun: tuple[float, float] | None = None,
    view: tuple[float, float] | None = None,
    night: bool = False,
    altitude: float | None = None,
    ground: float | str = 0.0,
    spectrum: bool = False,
    sky: bool = False,
    sky_channel: str = "",
    threads: int = 0,
    progress: Show = False,
) -> xarray.Dataset:
    """What the document's modelled atmosphere does to the light of each channel, over black ground.

    sun, view: (zenith, azimuth) of the direction from the ground, degrees, azimuth clockwise from north, in place of the document's;
    night: no Sun; altitude: of the sensor, km; ground: reflectance, or a material of the document (or
    ``"surroundings"``), below ``radiance``, ``q``, ``u`` and the fluxes ``ground_...`` and ``sensor_...``; spectrum: also at the resolution of the band model; sky: the whole sky in one channel

    Returns a Dataset: transmittances, path radiances (W m-2 sr-1 um-1) and irradiances (W m-2 um-1) along ``channel``; with ``spectrum``
    the same as ``spectral_...`` along ``wavelength``; with ``sky`` ``sky(zenith, azimuth, stokes)``, zenith and azimuth from the Sun's in
    degrees. ``attrs["table"]`` is what ``ifov atmosphere`` prints. Throws ``DocumentError`` where there is no modelled atmosphere.
    """
    import xarray

    def radians(angles: tuple[float, float] | None) -> tuple[float, float] | None:
        return None if angles is None else (math.radians(angles[0]), math.radians(angles[1]))

    with Reporter(progress, None) as reporter, Written(document) as written:
        told = library().atmosphere(
            parsed(written), radians(sun), radians(view), night, altitude, ground, spectrum, sky, sky_channel, threads, reporter.function()
        )
    um, degree = {"units": "um"}, {"units": "degree"}
    made = xarray.Dataset(
        coords={
            "channel": told["channel"],
            "channel_wavelength": ("channel", told["channels"].pop("wavelength"), um),
            "first": ("channel", told["first_um"], um),
            "last": ("channel", told["last_um"], um),
        },
        attrs={"description": "\n".join(told["description"]), "table": told["table"]},
    )
    _add(made, "", "channel", told["channels"])
    for name in ("sun_zenith", "sun_azimuth", "view_zenith"):
        if told[f"{name}_rad"] is not None:
            made.attrs[f"{name}_deg"] = math.degrees(told[f"{name}_rad"])
    made.attrs["sensor_altitude_km"] = told["sensor_altitude_km"]
    if "spectrum" in told:
        made.coords["wavelength"] = ("wavelength", told["spectrum"].pop("wavelength"), um)
        _add(made, "spectral_", "wavelength", told["spectrum"])
    if "sky" in told:
        seen = told["sky"]
        made.coords["zenith"] = ("zenith", np.degrees(seen["zenith_rad"]), degree)
        made.coords["azimuth"] = ("azimuth", np.degrees(seen["azimuth_rad"]), degree)
        made.coords["stokes"] = ["I", "Q", "U"]
        values = np.array(seen["stokes"], float).reshape(made.sizes["zenith"], made.sizes["azimuth"], 3)
        words = {"units": _RADIANCE, "long_name": f"light of the sky in channel {seen['channel']}"}
        made["sky"] = (("zenith", "azimuth", "stokes"), values, words)
    return made


def _add(made: xarray.Dataset, prefix: str, dim: str, columns: Mapping[str, Any]) -> None:
    for name, values in columns.items():
        unit, what = _WORDS[name]
        made[prefix + name] = (dim, np.asarray(values, float), {"units": unit, "long_name": what})
