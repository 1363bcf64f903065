"""Instruments whose channels are known, and what follows of a document's sensor before a ray is cast."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._document import Written
from ._key_path import without_comments
from ._library import library
from ._render import parsed

if TYPE_CHECKING:
    import xarray

#: (name in the library, variable, unit, what)
_OF_CHANNELS = (
    ("pixel_mtf", "pixel_mtf", "1", "modulation at half a cycle a pixel, of the sensitive square"),
    ("psf_mtf", "psf_mtf", "1", "the same of the document's point spread function"),
    ("diffraction_mtf", "diffraction_mtf", "1", "the same of the optics' aperture"),
    ("radiance", "radiance", "W m-2 sr-1 um-1", "the detector's reference, of which the next are told"),
    ("photons", "photons", "1", "photons that meet the element in one exposure"),
    ("electrons", "electrons", "1", "electrons of the reference"),
    ("background", "background", "1", "electrons of the optics' own emission"),
    ("dark", "dark", "1", "electrons of the dark current"),
    ("well_share", "well_share", "1", "share of the full well that all electrons fill"),
    ("snr", "snr", "1", "signal over the noise's standard deviation"),
    ("nedl", "nedl", "W m-2 sr-1 um-1", "standard deviation of the noise as a radiance (NEdL)"),
    ("nedt", "nedt", "K", "the same as a temperature difference (NEdT)"),
    ("nedt_at_k", "nedt_at", "K", "temperature at which NEdT is told"),
    ("correction_left", "correction_left", "W m-2 sr-1 um-1", "what a correction leaves from element to element, at the reference"),
    ("step_share", "step_share", "1", "share of a step of the light that the first exposure shows, by lag and time constant"),
    ("memory_mtf", "memory_mtf", "1", "modulation at half a cycle an exposure, by lag and time constant"),
    ("corner_light", "corner_light", "1", "share of the light of the middle that falls on the image's corners, by vignetting"),
    ("corner_snr", "corner_snr", "1", "signal over noise there"),
    ("corner_nedt", "corner_nedt", "K", "noise there as a temperature difference (NEdT)"),
)
#: (name in the library, variable, unit, what): by detector column, the least and the most
_BY_COLUMN = (
    ("centres_um", "centre", "um", "centre of the response"),
    ("fwhms_um", "width", "um", "width of the response"),
    ("shift_px", "shift", "px", "how far to the right a column looks"),
)


@dataclasses.dataclass(frozen=True)
class Preset:
    """name: as documents name it (``"sensor": {"preset": name}``); also: other names of it; sources: publications with their licences; bands: how
    many channels; range_um: between their outermost half-maxima; noise: what is told of it, such as ``"SNR"``, empty where nothing is; ground: size of
    its pixels, or its kind; document: it over the shore of a lake, to be changed"""

    name: str
    also: list[str]
    about: str
    sources: list[str]
    bands: int
    range_um: tuple[float, float]
    noise: str
    ground: str
    document: dict[str, Any]

    @property
    def channels(self) -> list[dict[str, Any]]:
        """As a document's ``sensor.channels``, to be changed."""
        return list(self.document["sensor"]["channels"])


def presets() -> list[Preset]:
    """All instruments that are known."""
    return [_preset(found) for found in library().sensor_preset_list()]


def find(name: str) -> Preset:
    """An instrument by its name or another that it has, letters compared without case. Throws ``DocumentError``, which names near misses."""
    return _preset(library().find_sensor_preset(name))


def describe(document: Mapping[str, Any]) -> xarray.Dataset:
    """What ``ifov sensor`` tells of a document's sensor: MTF, and with a detector electrons, SNR, NEdL and NEdT, along ``channel``; what is
    not known is not a number. Of a spectrometer with smile or keystone, centre_least and centre_most, width_least, shift_least and so on are
    over detector columns. Attributes: width_px, height_px, gsd_m, swath_m, ifov_rad, f_number, mosaic (channels by element) and, of a frame
    that flies, smear_px and row_shift_px, where they are known. No scene is loaded."""
    import xarray

    with Written(document) as written:
        told = library().describe_sensor(parsed(written))
    um = {"units": "um"}
    made = xarray.Dataset(
        coords={
            "channel": [channel.name for channel in told.channels],
            "wavelength": ("channel", [channel.centre_um for channel in told.channels], um),
            "fwhm": ("channel", [channel.fwhm_um for channel in told.channels], um),
        }
    )
    needs_detector = {"radiance", "photons", "electrons", "background", "dark"}
    for name, variable, unit, what in _OF_CHANNELS:
        values = [
            np.nan if name in needs_detector and not channel.has_detector else getattr(channel, name) for channel in told.channels
        ]
        if name == "nedl":  # 0: no noise is told
            values = [value or np.nan for value in values]
        made[variable] = ("channel", np.array(values, float), {"units": unit, "long_name": what})
    for name, variable, unit, what in _BY_COLUMN:
        ranges = [getattr(channel, name) for channel in told.channels]
        if not any(ranges):
            continue
        for end in ("least", "most"):
            values = [np.nan if one is None else getattr(one, end) for one in ranges]
            made[f"{variable}_{end}"] = ("channel", np.array(values), {"units": unit, "long_name": f"{what}, the {end} of all columns"})
    if told.mosaic:
        made.attrs["mosaic"] = told.mosaic
    for name in ("width_px", "height_px", "gsd_m", "swath_m", "ifov_rad", "f_number", "smear_px", "row_shift_px"):
        if (value := getattr(told, name)) is not None:
            made.attrs[name] = value
    return made


def _preset(found: Any) -> Preset:
    return Preset(
        found.name,
        list(found.also),
        found.about,
        list(found.sources),
        found.bands,
        (found.first_um, found.last_um),
        found.noise,
        found.ground,
        json.loads(without_comments(found.document)),
    )
