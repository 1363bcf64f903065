"""Bars, and what calls of Python get while a run works."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import TracebackType
from typing import Any, Literal

Show = Literal["auto"] | bool
#: Called with pixels_done, pixels_total, pixels_converged, rays, worst_error_ratio (largest half-width over its limit) and elapsed_s.
Callback = Callable[[Any], object]


class Reporter:
    """What the library tells its progress to: a bar of tqdm, the user's callback, both or neither."""

    def __init__(self, show: Show, callback: Callback | None):
        self.callback = callback
        self.bar: Any = None
        if show == "auto":
            show = _is_watched()
        elif not isinstance(show, bool):
            raise ValueError(f"progress: found {show!r}; expected 'auto', True or False")
        if show:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self.bar = tqdm(total=None, unit="px", leave=False, desc="reading the scene")

    def function(self) -> Callable[[Any, str], None] | None:
        return self._told if self.bar is not None or self.callback is not None else None

    def _told(self, progress: Any, phase: str) -> None:
        if self.bar is not None:
            self._draw(progress, phase)
        # Pieces of the atmosphere are no pixels.
        if self.callback is not None and progress is not None and not phase:
            self.callback(progress)

    def _draw(self, progress: Any, phase: str) -> None:
        self.bar.set_description(phase or "rendering", refresh=progress is None)
        if progress is None:
            self.bar.reset()
            return
        self.bar.total = progress.pixels_total
        self.bar.n = progress.pixels_done
        if not phase and progress.worst_error_ratio > 0:
            self.bar.set_postfix(worst=f"{progress.worst_error_ratio:.2f}", refresh=False)
        self.bar.refresh()

    def __enter__(self) -> Reporter:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if self.bar is not None:
            self.bar.close()


def _is_watched() -> bool:
    """By somebody at a terminal or in a notebook."""
    if "ipykernel" in sys.modules:
        return True
    return sys.stderr is not None and sys.stderr.isatty()
