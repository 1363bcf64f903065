#!/bin/sh
# Writes python/ifov/_ifov.pyi, the types of the extension module, of the module that is in BUILD/venv: tools/make_stub.sh BUILD
set -eu
build=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
made=$(mktemp)
(cd / && "$build/venv/bin/python" -m nanobind.stubgen -q -m ifov._ifov -o "$made")
{
  echo '"""The extension module (python/src), for the modules of this package alone. Written by nanobind (tools/make_stub.sh)."""'
  # What mypy wants to be told of containers.
  sed -e 's/\bos\.PathLike\b/os.PathLike[str]/g' -e 's/-> dict:/-> dict[str, Any]:/' -e 's/-> tuple:/-> tuple[Any, ...]:/' \
    -e 's/^from typing import Annotated$/from typing import Annotated, Any/' "$made"
} >python/ifov/_ifov.pyi
rm -f "$made"
