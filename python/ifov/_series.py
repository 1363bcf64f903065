"""The runs of a series (``ifov render --times``) as one dataset with a dim ``time``."""

from __future__ import annotations

import json
import pathlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from ._errors import DocumentError


class _Times(BackendArray):
    """One variable of several datasets, along a first dim; only what is indexed is read."""

    def __init__(self, variables: Sequence[xarray.Variable]):
        self.variables = list(variables)
        self.shape = (len(self.variables), *self.variables[0].shape)
        self.dtype = self.variables[0].dtype

    def __getitem__(self, key: Any) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key: tuple[Any, ...]) -> Any:
        chosen, within = key[0], tuple(key[1:])
        if not isinstance(chosen, slice):
            return np.asarray(self.variables[int(chosen)][within].values)
        parts = [np.asarray(variable[within].values) for variable in self.variables[chosen]]
        return np.stack(parts) if parts else np.empty((0, *self.variables[0][within].shape), self.dtype)


def load_series(record_file: pathlib.Path) -> xarray.Dataset:
    """Those of its times that are made."""
    from ._load import _finished

    record = json.loads(record_file.read_text(encoding="utf-8"))
    made: list[tuple[np.datetime64, xarray.Dataset]] = []
    for one in record["times"]:
        if pathlib.Path(one["folder"]).name != one["folder"] or one["folder"] in ("", ".", ".."):
            raise DocumentError(f"{record_file}: {one['folder']!r} is no folder beside it", str(record_file))
        run = record_file.parent / one["folder"] / f"{record['name']}_run.json"
        if run.exists():
            made.append((np.datetime64(one["time"].removesuffix("Z"), "ns"), _finished(run)))
    if not made:
        raise DocumentError(f"{record_file}: none of its {len(record['times'])} times is made yet", str(record_file))
    dataset = _along_time(record_file, [one for _, one in made])
    dataset.coords["time"] = ("time", [time for time, _ in made], {"standard_name": "time", "long_name": "time (UTC)"})
    dataset.attrs["times_left"] = len(record["times"]) - len(made)
    return dataset


def _along_time(record_file: pathlib.Path, runs: Sequence[xarray.Dataset]) -> xarray.Dataset:
    first = runs[0]
    for other in runs[1:]:
        for name in ("channel", "material"):
            if name in first.coords and not (name in other.coords and first.coords[name].equals(other.coords[name])):
                raise DocumentError(f"{record_file}: the times differ in their {name}s, and are no series", str(record_file))
        if any(first.sizes[axis] != other.sizes[axis] for axis in ("y", "x")):
            raise DocumentError(f"{record_file}: the times differ in size, and are no series", str(record_file))
    # Where a sensor sees something else at each time, the pixels have no place that is that of all.
    same = {name: all(name in run.coords and first.coords[name].identical(run.coords[name]) for run in runs) for name in first.coords}
    dataset = xarray.Dataset(coords={name: first.coords[name] for name in first.coords if same[name]})
    dataset.attrs = {key: value for key, value in first.attrs.items() if all(run.attrs.get(key) == value for run in runs)}
    for variable in first.data_vars:
        variables = [run.variables[variable] for run in runs if variable in run.data_vars]
        if len(variables) < len(runs) or any(one.dims != variables[0].dims or one.shape != variables[0].shape for one in variables):
            continue
        lazy: Any = indexing.LazilyIndexedArray(_Times(variables))
        dataset[variable] = xarray.Variable(
            ("time", *variables[0].dims), indexing.CopyOnWriteArray(lazy), variables[0].attrs, variables[0].encoding
        )
    return dataset
