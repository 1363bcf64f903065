"""The accuracy sampler as a tool of its own: a function of the plane in, means over pixels and their intervals out."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._library import library

if TYPE_CHECKING:
    import xarray

#: (x, y) or (x, y, random): pixels, of shape (n,) each, random (n, k); the values, (n,) or (n, component).
Field = Callable[..., npt.ArrayLike]
#: (x, y): the number of the part of the picture that each point belongs to, (n,).
Labels = Callable[[npt.NDArray[np.float64], npt.NDArray[np.float64]], npt.ArrayLike]


def integrate(
    field: Field,
    shape: tuple[int, int],
    error: float | str = "1 %",
    *,
    labels: Labels | None = None,
    random: int = 0,
    floor: float = 0.0,
    confidence: float = 0.95,
    seed: int = 1,
    max_samples: int = 65536,
    lattice: int = 3,
) -> xarray.Dataset:
    """Means of a function over the pixels of an image, each with an interval, by as many points as the error needs.

    field: a function of NumPy arrays, ``field(x, y)``, of shape (n,) each: pixel (i, j) covers i to i + 1 of x, to the right, and j to j + 1 of
        y, downwards. It returns (n,) or (n, component) numbers, and is asked up to a pixel beyond the image, too. With ``random`` = k it is
        ``field(x, y, u)``, u (n, k) of random numbers from 0 to 1, and its mean over them is meant
    shape: (rows, columns) of the image
    error: largest half-width of an interval that is allowed: a number in the field's unit, or "1 %" of the pixel's value
    labels: ``labels(x, y)``, (n,) whole numbers: which part of the picture a point belongs to. Borders between parts are traced, which takes
        far fewer points than the values alone; without it all is one part
    floor: where values are smaller, percent are of this
    confidence: with which each interval holds the true mean
    max_samples: a pixel; lattice: points along a pixel's side where parts are looked for at first, 1 to 32

    Returns a Dataset: mean, half_width (y, x) or (component, y, x), samples, converged, reasons, missable_fraction (largest part, as a share of the pixel,
    that may have been missed with a probability of 5 %) (y, x). The values depend on seed, never on threads. What ``field`` throws arrives as
    it was. Throws ``ValueError`` on arguments out of their range, answers of another shape and values that are not finite.

    An interval without ``labels`` rests on the scatter of the values that were met: a thing that no point met is not in it.
    """
    import xarray

    from ._dataset import REASONS

    allowed, relative = _error(error)
    rows, columns = (int(number) for number in shape)
    first = np.asarray(_asked(field, np.array([0.5]), np.array([0.5]), np.full((1, random), 0.5)))
    if first.ndim not in (1, 2) or first.shape[0] != 1:
        raise ValueError(f"field: found an answer of shape {first.shape} to one point; expected (1,) or (1, component)")
    components = 1 if first.ndim == 1 else first.shape[1]

    def parts(x: Any, y: Any) -> Any:
        if labels is None:
            return np.zeros(x.shape[0], np.uint64)
        found = np.asarray(labels(x[:, 0], y[:, 0]))
        if found.shape != (x.shape[0],) or found.dtype.kind not in "biu":
            raise ValueError(f"labels: found shape {found.shape} of {found.dtype}; expected ({x.shape[0]},) of whole numbers")
        return np.ascontiguousarray(found.astype(np.int64).view(np.uint64) if found.dtype.kind != "u" else found, np.uint64)

    def values(x: Any, y: Any, u: Any) -> Any:
        found = np.asarray(_asked(field, x[:, 0], y[:, 0], u.reshape(x.shape[0], random)))
        if found.shape != (x.shape[0], *first.shape[1:]):
            raise ValueError(f"field: found shape {found.shape} for {x.shape[0]} points; expected {(x.shape[0], *first.shape[1:])}")
        return parts(x, y), np.ascontiguousarray(found, np.float64)

    told = library().integrate(
        components, random, parts, values, columns, rows, allowed, relative, floor, confidence, seed, max_samples, lattice
    )
    by_component = ("y", "x") if first.ndim == 1 else ("component", "y", "x")
    made = xarray.Dataset(
        coords={
            "x": ("x", np.arange(columns) + 0.5, {"long_name": "middle of the pixel", "units": "1"}),
            "y": ("y", np.arange(rows) + 0.5, {"long_name": "middle of the pixel, downwards", "units": "1"}),
        },
        attrs={"asked": str(error), "confidence": confidence, "seed": seed, "source": f"ifov {library().version()}"},
    )
    for name, what in (("mean", "mean over the pixel"), ("half_width", "half-width of its interval")):
        array = told[name][:, :, 0] if first.ndim == 1 else told[name].transpose(2, 0, 1)
        made[name] = (by_component, array, {"long_name": what})
    made["samples"] = (("y", "x"), told["samples"], {"long_name": "points that were looked at", "units": "1"})
    made["converged"] = (("y", "x"), told["reasons"] == 0, {"long_name": "whether the pixel meets the accuracy that was asked for"})
    flags = {"flag_masks": np.array([1 << bit for bit in range(len(REASONS))], np.uint16), "flag_meanings": " ".join(REASONS)}
    made["reasons"] = (("y", "x"), told["reasons"], flags)
    words = {"long_name": "share of the pixel's area of a compact part that may be missed", "units": "1"}
    made["missable_fraction"] = (("y", "x"), told["missable_fraction"], words)
    return made


def _asked(field: Field, x: Any, y: Any, u: Any) -> npt.ArrayLike:
    return field(x, y, u) if u.shape[1] else field(x, y)


def _error(error: float | str) -> tuple[float, bool]:
    if not isinstance(error, str):
        return float(error), False
    try:
        if error.strip().endswith("%"):
            return float(error.strip()[:-1]) / 100.0, True
    except ValueError:
        pass
    raise ValueError(f'error: found {error!r}; expected a number in the field\'s unit, or percent as "1 %"')
