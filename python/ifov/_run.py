"""Runs in folders: products, and what goes on after a stop."""

from __future__ import annotations

import copy
import dataclasses
import os
import pathlib
import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, cast

from . import _load
from ._document import Written
from ._library import library
from ._progress import Callback, Reporter, Show
from ._render import _said, checked_limit, parsed

if TYPE_CHECKING:
    import xarray


@dataclasses.dataclass(frozen=True)
class Status:
    """How far a run is. Pixels, tiles: of its share. worst_error_ratio: largest half-width over its limit; at_work: who, "" where
    nobody is; text: what ``ifov status`` prints."""

    complete: bool
    kept: bool
    document: str
    version: str
    seed: int
    share_number: int
    share_count: int
    tiles_done: int
    tiles_wanted: int
    pixels_done: int
    pixels_wanted: int
    pixels_converged: int
    rays: int
    elapsed_s: float
    worst_error_ratio: float
    at_work: str
    text: str

    def __str__(self) -> str:
        return self.text.rstrip("\n")


@dataclasses.dataclass(frozen=True)
class Outcome:
    """How a run ended. exit_code: that of ``ifov render``: 0, 4 time limit, 5 not all pixels converged, 6 warned."""

    exit_code: int
    converged: bool
    folder: pathlib.Path
    products: list[pathlib.Path]
    accuracy_statement: str
    warnings: list[str]
    tiles_done: int
    tiles_left: int


@dataclasses.dataclass(frozen=True)
class Forecast:
    """What a run will take. uncertainty: relative standard error of rays and times; shortages: what will not do, empty: it will."""

    rays: float
    elapsed_s: float
    processor_s: float
    uncertainty: float
    memory_bytes: int
    disk_bytes: int
    product_bytes: int
    probes: int
    probed_share: float
    probing_s: float
    shortages: list[str]


class Run:
    """A run of a document in a folder; nothing is begun by making one.

    document: a dict or what ``read`` gives; folder: of the products; scene_cache: as of ``run``
    """

    def __init__(
        self,
        document: Mapping[str, Any],
        folder: str | os.PathLike[str],
        assets: Mapping[str, Any] | None = None,
        *,
        threads: int = 0,
        scene_cache: bool | None = None,
    ):
        self.document = document
        self.folder = pathlib.Path(folder)
        self.assets = assets
        self.threads = threads
        self.scene_cache = bool(getattr(document, "file", None)) and assets is None if scene_cache is None else scene_cache
        self.outcome: Outcome | None = None

    def start(
        self,
        *,
        restart: bool = False,
        keep: bool = False,
        share: tuple[int, int] = (1, 1),
        time_limit: float | None = None,
        anyway: bool = False,
        progress: Show = "auto",
        callback: Callback | None = None,
    ) -> Run:
        """As :func:`run`."""
        start = "restart" if restart else "fresh"
        return self._go(self.document, start, keep, False, share, time_limit, anyway, progress, callback)

    def resume(
        self,
        *,
        keep: bool = False,
        share: tuple[int, int] = (1, 1),
        time_limit: float | None = None,
        progress: Show = "auto",
        callback: Callback | None = None,
    ) -> Run:
        """Goes on where it was stopped; begins where there is nothing yet."""
        return self._go(self.document, "resume", keep, False, share, time_limit, False, progress, callback)

    def refine(self, error: str, *, time_limit: float | None = None, progress: Show = "auto", callback: Callback | None = None) -> Run:
        """Takes a run that was kept (``keep=True``) to a smaller error, such as "0.5 %", and traces only what is new."""
        changed: Any = copy.deepcopy(self.document)
        changed["sampling"] = {**changed["sampling"], "accuracy": {**changed["sampling"]["accuracy"], "error": error}}
        self._go(changed, "fresh", False, True, (1, 1), time_limit, False, progress, callback)
        self.document = changed
        return self

    def status(self) -> Status:
        """Looks at the folder; may be called while the run is at work in another process or thread."""
        return status(self.folder)

    def load(self) -> xarray.Dataset:
        """What is there, as :func:`ifov.load` has it."""
        return _load.load(self.folder)

    def __repr__(self) -> str:
        return f"<ifov.Run of {Written(self.document).full_name} in {self.folder}>"

    def _go(
        self,
        document: Mapping[str, Any],
        start: str,
        keep: bool,
        refine: bool,
        share: tuple[int, int],
        time_limit: float | None,
        anyway: bool,
        progress: Show,
        callback: Callback | None,
    ) -> Run:
        begun = time.monotonic()
        checked_limit(time_limit)
        with Reporter(progress, callback) as reporter, Written(document) as written:
            told = reporter.function()
            simulation = library().load(parsed(written, self.assets), self.scene_cache, self.threads, told, _said)
            left = None if time_limit is None else max(0.0, time_limit - (time.monotonic() - begun))
            ended = simulation.render(self.folder, self.threads, start, keep, refine, anyway, share, left, told, _said)
        self.outcome = _of(Outcome, ended)
        return self


def run(
    document: Mapping[str, Any],
    folder: str | os.PathLike[str],
    assets: Mapping[str, Any] | None = None,
    *,
    restart: bool = False,
    keep: bool = False,
    share: tuple[int, int] = (1, 1),
    time_limit: float | None = None,
    anyway: bool = False,
    threads: int = 0,
    scene_cache: bool | None = None,
    progress: Show = "auto",
    callback: Callback | None = None,
) -> Run:
    """Renders a document into a folder, as ``ifov render`` does; returns when it is done or the time is over.

    restart: throw away what an earlier run has left there; keep: leave what ``refine`` goes on from; share: (17, 64) makes the 17th of 64
    shares of the tiles, and no products, for ``merge``; time_limit: s, from loading on; anyway: also where memory or disk will not do;
    scene_cache: keep beside the document what loading works out, as the program does, for the next time; None: of a document
    that was read from a file and has no assets.
    A run that was stopped goes on with ``ifov.Run(document, folder).resume()``.
    """
    return Run(document, folder, assets, threads=threads, scene_cache=scene_cache).start(
        restart=restart, keep=keep, share=share, time_limit=time_limit, anyway=anyway, progress=progress, callback=callback
    )


def status(folder: str | os.PathLike[str]) -> Status:
    """How far the run in a folder is. Throws ``DocumentError`` where there is none."""
    return _of(Status, library().run_status(pathlib.Path(folder)))


def forecast(
    document: Mapping[str, Any],
    folder: str | os.PathLike[str] = "",
    assets: Mapping[str, Any] | None = None,
    *,
    keep: bool = False,
    threads: int = 0,
) -> Forecast:
    """What ``run`` will take: renders small pieces of the image, which takes seconds to a minute."""
    with Written(document) as written:
        simulation = library().load(parsed(written, assets), False, threads, None, _said)
        return _of(Forecast, simulation.forecast(os.fspath(folder), threads, keep))


def merge(
    folders: Sequence[str | os.PathLike[str]], output: str | os.PathLike[str], *, partial: bool = False, threads: int = 0
) -> Outcome:
    """Makes the products of a run of which each folder holds a share. partial: also where tiles are missing; their pixels are not a
    number."""
    paths = [pathlib.Path(folder) for folder in folders]
    return _of(Outcome, library().merge(paths, pathlib.Path(output), partial, threads, _said))


def detect(
    run: str | os.PathLike[str],
    *,
    seed: int = 1,
    count: int = 1,
    folder: str | os.PathLike[str] = "",
    quantities: Sequence[str] = ("radiance",),
    document: Mapping[str, Any] | None = None,
    set: Sequence[str] = (),
    threads: int = 0,
    after: Sequence[str | os.PathLike[str]] = (),
) -> list[pathlib.Path]:
    """Draws what the sensor makes of a finished run, ``count`` times with seeds from ``seed`` on: ``"radiance"``, ``"kelvins"`` and, of
    runs with the Sun up, ``"toa_reflectance"``, and where channels have a detector ``"electrons"`` and ``"counts"``. document: whose channels tell the noise; else the run's, with the values of ``set``
    (``"sensor.detector.integration_time=2 ms"``) in place of its own. after: of a frame camera whose detector has a lag or a time
    constant, runs of the frames before, the last one first. Returns the cubes; ``load`` has those of radiance as
    ``noisy_SEED``."""
    other = None
    if document is not None:
        with Written(document) as written:
            other = parsed(written)
    before = [pathlib.Path(one) for one in after]
    _noise, cubes = library().detect(os.fspath(run), os.fspath(folder), seed, count, list(quantities), other, list(set), threads, before)
    return list(cubes)


_Kind = TypeVar("_Kind")


def _of(kind: type[_Kind], told: Any) -> _Kind:
    return kind(**{field.name: getattr(told, field.name) for field in dataclasses.fields(cast(Any, kind))})
