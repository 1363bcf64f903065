"""Documents checked, loaded and rendered."""

from __future__ import annotations

import copy
import dataclasses
import logging
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _load
from ._assets import assets_of
from ._document import Document, Written
from ._errors import DocumentError
from ._library import library
from ._progress import Callback, Reporter, Show

if TYPE_CHECKING:
    import xarray

_LOG = logging.getLogger("ifov")
#: What a dataset in memory tells beside radiance, half_width and reasons, where nothing else is asked for.
USUAL = ("standard_error", "samples", "quality", "quality_class", "abundance")


class SceneWarning(UserWarning):
    """What is left out of a scene, or is most likely not meant."""


@dataclasses.dataclass(frozen=True)
class Message:
    """severity: "statement", "warning", "error" or "failure"; line, column: from 1, of errors, where they are known"""

    severity: str
    text: str
    file: str = ""
    line: int = 0
    column: int = 0


@dataclasses.dataclass(frozen=True)
class Check:
    """What ``ifov check`` says of a document and of the files that it names. ``str()`` is its text; true where nothing is wrong."""

    messages: tuple[Message, ...]

    @property
    def statements(self) -> list[str]:
        """What is said of the document, a text for each line or paragraph."""
        return [message.text for message in self.messages if message.severity == "statement"]

    @property
    def warnings(self) -> list[str]:
        """What is left out, or is most likely not meant."""
        return [message.text for message in self.messages if message.severity == "warning"]

    @property
    def errors(self) -> list[str]:
        """What is wrong: the document cannot be rendered."""
        return [message.text for message in self.messages if message.severity in ("error", "failure")]

    def __bool__(self) -> bool:
        return not self.errors

    def __str__(self) -> str:
        words = {"warning": "warning: ", "error": "error: ", "failure": "error: "}
        return "\n".join(words.get(message.severity, "") + message.text for message in self.messages)


@dataclasses.dataclass(frozen=True)
class Tile:
    """A finished rectangle of an image. x, y: of its upper left pixel; the arrays are views of those of the whole image.

    radiance: (channel, row, column), W m-2 sr-1 um-1; half_width: the same, or None where no error is known; samples: (row, column)
    """

    x: int
    y: int
    width: int
    height: int
    radiance: npt.NDArray[np.float32]
    half_width: npt.NDArray[np.float32] | None
    samples: npt.NDArray[np.uint32]
    reasons: npt.NDArray[np.uint16]


def parsed(written: Written, assets: Mapping[str, Any] | None = None) -> Any:
    """The library's document."""
    document = library().parse(written.text, written.name, written.folder)
    return document.with_assets(assets_of(assets)) if assets else document


def check(document: Mapping[str, Any], assets: Mapping[str, Any] | None = None) -> Check:
    """What ``ifov check`` says: warnings, then statements or the error that was met. A document that is no document throws
    ``DocumentError``."""
    with Written(document) as written:
        found = library().check(parsed(written, assets))
    return Check(
        tuple(Message(one.severity.name, one.text, one.file, one.line, one.column) for one in found),
    )


class Scene:
    """A document with all that it names, loaded once: it can be rendered and asked as often as one likes, from several threads.

    document: a dict, or what ``read`` gives; assets: what its "asset:NAME" stand for, by name (``Mesh``, ``Raster``, ``Spectrum``,
    ``Copies``, ``bytes`` of a file, or an array, which is a raster); threads: 0 takes all cores; scene_cache: keep beside the document
    what is worked out from large files. Warnings are ``SceneWarning``. Throws ``DocumentError``, ``OSError``, ``KeyboardInterrupt``.
    """

    def __init__(
        self,
        document: Mapping[str, Any],
        assets: Mapping[str, Any] | None = None,
        *,
        threads: int = 0,
        scene_cache: bool = False,
        progress: Show = False,
    ):
        with Reporter(progress, None) as reporter:
            self._open(document, assets, threads, scene_cache, reporter.function())

    def _open(self, document: Mapping[str, Any], assets: Any, threads: int, scene_cache: bool, told: Any) -> None:
        self._document = copy.deepcopy(document)
        self._threads = threads
        with Written(document) as written:
            self._written = written
            self._simulation = library().load(parsed(written, assets), scene_cache, threads, told, _said)

    @property
    def description(self) -> str:
        """What was loaded and where it is, lines."""
        return str(self._simulation.description)

    @property
    def warnings(self) -> list[str]:
        """What loading warned of."""
        return list(self._simulation.warnings)

    def render(
        self,
        *,
        sampling: Mapping[str, Any] | None = None,
        seed: int | None = None,
        quantities: Sequence[str] | None = None,
        progress: Show = "auto",
        callback: Callback | None = None,
        on_tile: Callable[[Tile], object] | None = None,
        time_limit: float | None = None,
        threads: int | None = None,
    ) -> xarray.Dataset:
        """The image, in memory. See :func:`render`. sampling, seed: in place of the document's."""
        with Reporter(progress, callback) as reporter:
            return self._render(sampling, seed, quantities, reporter.function(), on_tile, time_limit, threads)

    def _render(
        self,
        sampling: Mapping[str, Any] | None,
        seed: int | None,
        quantities: Sequence[str] | None,
        told: Any,
        on_tile: Callable[[Tile], object] | None,
        time_limit: float | None,
        threads: int | None,
    ) -> xarray.Dataset:
        from ._dataset import Image, dataset, in_memory

        checked_limit(time_limit)
        other, text = None, self._written.text
        if sampling is not None or seed is not None:
            changed = with_values(self._document, sampling=sampling, seed=seed)
            with Written(changed) as written:
                other, text = parsed(written), written.text
        asked = list(quantities) if quantities is not None else [*USUAL, *_named_products(self._document)]
        image, arrays, outcome = self._simulation.render_tiles(
            self._threads if threads is None else threads,
            other,
            time_limit,
            asked,
            told,
            None if on_tile is None else _tile_function(on_tile),
        )
        made = dataset(
            Image(
                image["width"],
                image["height"],
                image["channels"],
                image["materials"],
                None if image["geotransform"] is None else tuple(image["geotransform"]),
                image["crs"],
            ),
            {name: in_memory(*array) for name, array in arrays.items()},
            _load.attributes(
                version=library().version(),
                document=text,
                document_name=self._written.full_name,
                seed=image["seed"],
                asked=image["accuracy_asked"],
                reached=outcome.accuracy_statement,
                confidence=image["confidence"],
                time=str(self._document.get("time", "")),
            ),
        )
        made.attrs["elapsed_s"] = outcome.totals.elapsed_s
        made.attrs["rays"] = outcome.totals.rays
        if "converged" not in made and "reasons" in made:
            words = {"units": "1", "long_name": "whether the pixel meets the accuracy that was asked for"}
            made["converged"] = (("y", "x"), made["reasons"].values == 0, words)
        return made

    def cast(self, origins: npt.ArrayLike, directions: npt.ArrayLike) -> xarray.Dataset:
        """What rays meet.

        origins: (ray, 3) or (3,), m, in the document's coordinates, with the map's easting and northing where it has them;
        directions: (ray, 3) or (3,), of any length. One origin serves all directions, and one direction all origins.

        The Dataset has, along ``ray``: hit, distance (m), position (m) and normal (unit, on the side of the ray) along ``axis``, u, v,
        object (index in the document's scene.objects, -1: none), material.
        """
        import xarray

        points = {"origins": np.atleast_2d(np.asarray(origins, float)), "directions": np.atleast_2d(np.asarray(directions, float))}
        for name, array in points.items():
            if array.ndim != 2 or array.shape[1] != 3:
                raise ValueError(f"{name}: found shape {np.shape(origins if name == 'origins' else directions)}; expected (ray, 3) or (3,)")
        counts = [len(array) for array in points.values()]
        if 1 not in counts and counts[0] != counts[1]:
            raise ValueError(f"found {counts[0]} origins and {counts[1]} directions; expected as many, or one of either")
        start, way = np.broadcast_arrays(points["origins"], points["directions"])
        told = self._simulation.cast(np.ascontiguousarray(start), np.ascontiguousarray(way), self._threads)
        hit = told["hit"].astype(bool)

        def of_hits(values: Any) -> Any:
            return np.where(hit.reshape(-1, *[1] * (values.ndim - 1)), values, np.nan)

        metres = {"units": "m"}
        return xarray.Dataset(
            {
                "hit": ("ray", hit),
                "distance": ("ray", of_hits(told["distance"]), metres),
                "position": (("ray", "axis"), of_hits(told["position"]), metres),
                "normal": (("ray", "axis"), of_hits(told["normal"]), {"units": "1"}),
                "u": ("ray", of_hits(told["uv"][:, 0]), {"units": "1"}),
                "v": ("ray", of_hits(told["uv"][:, 1]), {"units": "1"}),
                "object": ("ray", told["object"]),
                "material": ("ray", np.array(told["material"], str)),
            },
            coords={"axis": ["x", "y", "z"]},
        )


def render(
    document: Mapping[str, Any],
    assets: Mapping[str, Any] | None = None,
    *,
    seed: int | None = None,
    quantities: Sequence[str] | None = None,
    progress: Show = "auto",
    callback: Callback | None = None,
    on_tile: Callable[[Tile], object] | None = None,
    time_limit: float | None = None,
    threads: int = 0,
) -> xarray.Dataset:
    """Renders a document in memory, and writes no file.

    document: a dict, or what ``read`` gives
    assets: arrays in place of files, see ``Scene``
    seed: in place of the document's
    quantities: what is told beside radiance, half_width and reasons: words of the document's ``output.products`` or "all"; else
        standard_error, samples, quality, quality_class, abundance and what the document names
    progress: a bar of tqdm: "auto" where somebody watches, True, False
    callback: called with the progress after tiles; what it throws stops the run and arrives here as it was
    on_tile: called with each finished ``Tile``, one at a time
    time_limit: s, of rendering; pixels not reached by then are not a number
    threads: 0 takes all cores; the values are the same for any number

    Returns a Dataset: radiance, standard_error, half_width (wavelength, y, x), W m-2 sr-1 um-1; abundance (material, y, x); samples,
    converged, reasons, ... (y, x). The values are those of the products of ``ifov render``, bit for bit. Throws ``DocumentError``,
    ``OSError``, ``KeyboardInterrupt``.
    """
    # One bar for loading and rendering.
    with Reporter(progress, callback) as reporter:
        scene = Scene.__new__(Scene)
        scene._open(document, assets, threads, False, reporter.function())
        return scene._render(None, seed, quantities, reporter.function(), on_tile, time_limit, threads)


def with_values(document: Mapping[str, Any], **values: Any) -> dict[str, Any]:
    """A copy with other members at its root; None leaves them as they are."""
    changed: Any = copy.deepcopy(document)
    changed.update({key: value for key, value in values.items() if value is not None})
    made: dict[str, Any] = changed
    return made


def _named_products(document: Mapping[str, Any]) -> list[str]:
    output = document.get("output")
    products = output.get("products") if isinstance(output, Mapping) else None
    return [str(product) for product in products] if isinstance(products, (list, tuple)) else []


def _tile_function(on_tile: Callable[[Tile], object]) -> Callable[..., None]:
    def told(arrays: dict[str, Any], x: int, y: int, width: int, height: int) -> None:
        def part(name: str) -> Any:
            return arrays[name][0][:, y : y + height, x : x + width] if name in arrays else None

        samples = part("samples")
        if samples is None:
            samples = np.zeros((1, height, width), np.uint32)
        on_tile(Tile(x, y, width, height, part("radiance"), part("half_width"), samples[0], part("reasons")[0]))

    return told


def _said(message: str, is_warning: bool) -> None:
    if is_warning:
        warnings.warn(message, SceneWarning, stacklevel=4)
    else:
        _LOG.info(message)


def checked_limit(time_limit: float | None) -> None:
    if time_limit is not None and not time_limit >= 0:
        raise ValueError(f"time_limit: found {time_limit}; expected seconds, 0 or more")


__all__ = ["Check", "Document", "DocumentError", "Message", "Scene", "SceneWarning", "Tile", "check", "render"]
