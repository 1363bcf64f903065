"""What the finished tiles of an unfinished run, or of a share, hold (docs/formats/run_state.md)."""

from __future__ import annotations

import ctypes
import ctypes.util
import dataclasses
import json
import mmap
import pathlib
import struct
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _envi, _load
from ._errors import DocumentError, SystemError

if TYPE_CHECKING:
    import xarray

_HEADER, _LINE = 208, 48
_FORMAT = 7
_TIME = 4  # the reason of pixels that no tile holds
_ABUNDANCE = np.dtype([("pixel", "<u4"), ("material", "<u4"), ("fraction", "<f4"), ("half_width", "<f4")])
_TYPES: dict[str, Any] = {"mean": "<f4", "half_width": "<f4", "reasons": "<u2", "abundances": _ABUNDANCE}
_TYPES |= {name: "<u4" for name in ("samples", "label_rays", "radiance_evaluations")}
_TYPES |= {name: "<f4" for name in ("worst_ratio", "missable_fraction", "border_share")}


@dataclasses.dataclass
class _Tile:
    """rectangle: x0, y0, x1, y1; arrays: name -> (offset among the arrays, elements)"""

    rectangle: tuple[int, int, int, int]
    file: pathlib.Path
    begin: int
    length: int
    in_cubes: bool
    arrays: dict[str, tuple[int, int]]

    @property
    def place(self) -> tuple[slice, slice]:
        x0, y0, x1, y1 = self.rectangle
        return slice(y0, y1), slice(x0, x1)

    @property
    def size(self) -> tuple[int, int]:
        x0, y0, x1, y1 = self.rectangle
        return y1 - y0, x1 - x0

    def content(self) -> bytes:
        """All arrays, one behind the other."""
        with self.file.open("rb") as stream:
            stream.seek(self.begin)
            lying = stream.read(self.length)
        return _decompressed(lying) if self.in_cubes else lying


def unfinished(folder: pathlib.Path, state_folder: pathlib.Path) -> xarray.Dataset:
    """A Dataset of what is there; pixels of other tiles are not a number, or 0 where numbers are whole."""
    from ._dataset import REASONS, Quantity, dataset, in_memory

    state = json.loads((state_folder / "state.json").read_text(encoding="utf-8"))["state"]
    place = dict(state["image"].get("map") or {})
    system = state["image"].get("map_system", "")
    if place and system.startswith(("PROJ", "GEOG", "LOCAL", "BOUND", "COMPD")):
        place["system"] = {"wkt": system}
    image = _load.image_of(state["image"], state["image"]["channels"], place)
    tiles: dict[tuple[int, int, int, int], _Tile] = {}
    for file in sorted((state_folder / "tiles").glob("*.tiles")):
        for tile in _tiles_in(file):
            tiles[tile.rectangle] = tile
    size = (image.height, image.width)
    single = {name: np.zeros(size, _TYPES[name]) for name in ("samples", "label_rays", "radiance_evaluations")}
    single |= {name: np.full(size, np.nan, "<f4") for name in ("worst_ratio", "missable_fraction")}
    single["reasons"] = np.full(size, _TIME, "<u2")
    shares = np.full((len(image.materials), *size), np.nan, "<f4")
    for tile in tiles.values():
        content = tile.content()
        for name, to in single.items():
            if name in tile.arrays:
                offset, elements = tile.arrays[name]
                to[tile.place] = np.frombuffer(content, _TYPES[name], elements, offset).reshape(tile.size)
        shares[(slice(None), *tile.place)] = 0
        offset, elements = tile.arrays.get("abundances", (0, 0))
        found = np.frombuffer(content, _ABUNDANCE, elements, offset)
        rows, columns = np.divmod(found["pixel"].astype(np.int64), tile.size[1])
        shares[found["material"], rows + tile.place[0].start, columns + tile.place[1].start] = found["fraction"]

    names = [name for name, _, _ in image.channels]
    unit = state["image"]["radiance_unit"]
    quantities = {}
    for array, name, what in (
        ("mean", "radiance", "radiance"),
        ("half_width", "half_width", "half-width of the radiance's interval"),
    ):
        if array == "mean" or state["accuracy"]["knows_errors"]:
            products = state["products"]
            cubes = _cubes(folder, products["name"], name)
            values = _Values(array, list(tiles.values()), cubes, (len(names), *size), products.get("interleave", "bil"))
            quantities[name] = Quantity(values.itself, len(names), np.dtype("<f4"), names, what, unit)
    stack = np.stack([single[name] for name in ("samples", "label_rays", "radiance_evaluations")])
    quantities["samples"] = in_memory(stack, (), "", "count")
    quantities["reasons"] = in_memory(single["reasons"][None], ("reasons",), "why pixels are not converged", "1")
    if image.materials:
        quantities["abundance"] = in_memory(shares, image.materials, "share of the pixel's response by material", "1")
    done = sum(rows * columns for rows, columns in (tile.size for tile in tiles.values()))
    made = dataset(
        image,
        quantities,
        _load.attributes(
            version=state["program"]["version"],
            document=state["document"]["text"],
            document_name=state["document"]["path"],
            seed=state["seed"],
            asked=state["accuracy"]["asked"],
            reached=f"Unfinished: {len(tiles)} tiles are done, {done} of {size[0] * size[1]} pixels.",
            confidence=state["accuracy"]["confidence"],
            acquisition=state.get("acquisition"),
            map_system=state["image"].get("map_system", ""),
        ),
    )
    assert REASONS[2] == "time"
    words = {"units": "1", "long_name": "whether the pixel meets the accuracy that was asked for"}
    made["converged"] = (("y", "x"), single["reasons"] == 0, words)
    for name in ("worst_ratio", "missable_fraction"):
        made[name] = (("y", "x"), single[name], {"units": "1"})
    return made


class _Values:
    """Means or half-widths of tiles, gathered where they are asked for."""

    def __init__(
        self, array: str, tiles: list[_Tile], cubes: list[pathlib.Path], shape: tuple[int, int, int], interleave: str
    ):
        self.array, self.tiles, self.cubes, self.shape, self.interleave = array, tiles, cubes, shape, interleave

    def itself(self) -> _Values:
        return self

    def __getitem__(self, key: tuple[Any, Any, Any]) -> Any:
        bands = np.atleast_1d(np.arange(self.shape[0])[key[0]])
        gathered = np.full((len(bands), *self.shape[1:]), np.nan, "<f4")
        cube = None
        for tile in self.tiles:
            if tile.in_cubes:
                if cube is None:
                    cube = self._cube()
                gathered[(slice(None), *tile.place)] = cube[(bands, *tile.place)]
            elif self.array in tile.arrays:
                offset, elements = tile.arrays[self.array]
                values = np.memmap(tile.file, "<f4", "r", tile.begin + offset, (elements,))
                by_pixel = values.reshape(*tile.size, self.shape[0])[:, :, bands]
                gathered[(slice(None), *tile.place)] = by_pixel.transpose(2, 0, 1)
        return gathered[0 if isinstance(key[0], (int, np.integer)) else slice(None)][(..., *key[1:])]

    def _cube(self) -> Any:
        bands, rows, columns = self.shape
        for path in self.cubes:
            if path.exists() and path.stat().st_size == 4 * bands * rows * columns:
                return _envi.mapped(path, np.dtype("<f4"), self.shape, self.interleave)
        raise SystemError(f"{self.cubes[0]}: the cube that holds values of finished tiles is not there")


def _cubes(folder: pathlib.Path, stem: str, name: str) -> list[pathlib.Path]:
    return [folder / f"{stem}_{name}.img.part", folder / f"{stem}_{name}.img"]


def _tiles_in(file: pathlib.Path) -> list[_Tile]:
    """Those of one file; what is behind a damaged header is left."""
    found: list[_Tile] = []
    if file.stat().st_size < _HEADER:
        return found
    with file.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as all_bytes:
        at = 0
        while at + _HEADER <= len(all_bytes) and all_bytes[at : at + 8] == b"IFOVTILE":
            _order, tile_format = struct.unpack_from("<II", all_bytes, at + 8)
            if tile_format != _FORMAT:
                raise DocumentError(f"{file}: tiles of format {tile_format}; this ifov reads {_FORMAT}", str(file))
            rectangle = struct.unpack_from("<4i", all_bytes, at + 20)
            _columns, arrays, in_cubes = struct.unpack_from("<3I", all_bytes, at + 36)
            (length,) = struct.unpack_from("<Q", all_bytes, at + 48)
            if at + _HEADER + length > len(all_bytes):
                break
            listed: dict[str, tuple[int, int]] = {}
            offset = 0
            for line in range(arrays):
                name, size, _bands, elements = struct.unpack_from("<32sIIQ", all_bytes, at + _HEADER + line * _LINE)
                listed[name.split(b"\0")[0].decode()] = (offset, elements)
                if not (in_cubes and name.startswith((b"mean\0", b"half_width\0"))):
                    offset += size * elements
            begin = at + _HEADER + arrays * _LINE
            found.append(_Tile(rectangle, file, begin, length - arrays * _LINE, bool(in_cubes), listed))
            at += _HEADER + length
    return found


def _decompressed(frame: bytes) -> bytes:
    """A frame of Zstandard (RFC 8878), by libzstd, which every Debian has."""
    library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    library.ZSTD_getFrameContentSize.restype = ctypes.c_ulonglong
    library.ZSTD_decompress.restype = ctypes.c_size_t
    size = library.ZSTD_getFrameContentSize(frame, ctypes.c_size_t(len(frame)))
    if size >= (1 << 64) - 2 or size > 1 << 34:
        raise SystemError("a tile is damaged: it does not say how large it is")
    content = ctypes.create_string_buffer(size)
    written = library.ZSTD_decompress(content, ctypes.c_size_t(size), frame, ctypes.c_size_t(len(frame)))
    if written != size:
        raise SystemError("a tile is damaged: it cannot be decompressed")
    return content.raw
