"""The extension module (python/src). It is for the modules of this package, which give its values their types."""

from typing import Any

def __getattr__(name: str) -> Any: ...
