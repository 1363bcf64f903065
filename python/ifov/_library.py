"""The extension module, where it was built, and a word where it was not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import ModuleType


def library() -> Any:
    """``ifov._ifov``. Throws ``ImportError``, which says how to get it."""
    found = _found()
    if isinstance(found, ImportError):
        raise ImportError(
            f"this needs the extension module of ifov, which is not there ({found}): pip install . in ifov's folder builds it"
        ) from found
    return found


def _found() -> ModuleType | ImportError:
    try:
        from . import _ifov
    except ImportError as error:
        return error
    module: ModuleType = _ifov
    return module
