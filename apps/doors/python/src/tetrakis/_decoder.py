# SPDX-License-Identifier: Apache-2.0
"""One decoder of the C interface, for one call."""

from __future__ import annotations

import builtins
import ctypes
from typing import Any, List, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _components as components
from . import _components_library as listed
from . import _cube as cube
from . import _info
from . import _library as c
from . import _values as values
from ._errors import Status, TksUsageError, error


class Decoder:
    """Owns a tks_decoder over `data`, which it keeps alive."""

    def __init__(
        self,
        data: builtins.bytes,
        limits: c.Limits,
        threads: int = 1,
        chosen: components.Chosen = (),
    ) -> None:
        self._handle = ctypes.c_void_p()
        self._data = data
        self._held = [(0, len(data))]
        message = ctypes.create_string_buffer(1024)
        status = c.lib.tks_open(data, len(data), limits, self._handle, message, len(message))
        if status != Status.OK:
            raise error(status, message.value.decode("utf-8", "replace"))
        self.check(c.lib.tks_set_threads(self._handle, threads))
        for one in chosen:
            for number in components.numbers_of(one, self.components()):
                self.check(c.lib.tks_choose_component(self._handle, number))

    def __enter__(self) -> "Decoder":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if self._handle:
            self.close()

    def close(self) -> None:
        c.lib.tks_close(self._handle)
        self._handle = ctypes.c_void_p()

    def check(self, status: int) -> None:
        if status != Status.OK:
            sentence = c.lib.tks_message(self._handle).decode("utf-8", "replace")
            raise error(status, sentence)

    def info(self) -> _info.Info:
        raw = c.StreamInfo(size=ctypes.sizeof(c.StreamInfo))
        self.check(c.lib.tks_get_info(self._handle, raw))
        return _info.from_struct(raw)  # its texts are copied while the decoder is there

    def components(self) -> List[components.Component]:
        raw = listed.Component(size=ctypes.sizeof(listed.Component))
        told = []
        for number in range(self.info().components):
            self.check(c.lib.tks_get_component(self._handle, number, raw))
            told.append(components.from_struct(number, raw))
        return told

    def locate(self, part: int, column: float, row: float) -> Tuple[float, float]:
        longitude, latitude = ctypes.c_double(), ctypes.c_double()
        pixel = c.Pixel(part, column, row)
        self.check(c.lib.tks_locate(self._handle, pixel, longitude, latitude))
        return longitude.value, latitude.value

    def set_levels(self, heights: int, texture: int) -> None:
        self.check(c.lib.tks_set_levels(self._handle, heights, texture))

    def set_frame(self, frame: int) -> None:
        self.check(c.lib.tks_set_frame(self._handle, frame))

    def _allow(self, part: int, window: Optional[c.Window], beside: int) -> None:
        """Refused here, a stream that claims too much costs no array."""
        self.check(c.lib.tks_check_memory(self._handle, part, window, 0, beside, None))

    def _decode(
        self,
        call: Tuple[str, int],
        window: Optional[c.Window],
        target: Tuple[Tuple[int, ...], np.dtype],
        out: Optional[NDArray[Any]],
    ) -> NDArray[Any]:
        """Calls tks_decode_<what>[_window] for `call` = (what, part); `target` is the shape and
        type of all that the level holds."""
        (what, part), (shape, dtype) = call, target
        if window is not None:
            shape = (window.height, window.width, *shape[2:])
        count = int(np.prod(shape, dtype=object))
        self._allow(part, window, 0 if out is not None else count * dtype.itemsize)
        array = values.output(out, shape, dtype)
        # Surfaces are counted in floats, all else in bytes.
        size = count if what == "surface" else array.nbytes
        if window is None:
            function = getattr(c.lib, f"tks_decode_{what}")
            self.check(function(self._handle, array.ctypes.data, size))
        else:
            function = getattr(c.lib, f"tks_decode_{what}_window")
            self.check(function(self._handle, window, array.ctypes.data, size))
        return array

    def heights(
        self, info: _info.Info, window: Optional[c.Window], out: Optional[NDArray[Any]]
    ) -> NDArray[Any]:
        if info.cube_depth is not None:
            grid = self._grid(info, window)
            dtype = info.dtype or np.dtype("f4")
            return _put(cube.as_samples(grid, dtype, info.scale, info.offset), out)
        call = ("heights", c.PART_HEIGHTS)
        return self._decode(call, window, (info.shape or (0, 0), info.dtype or np.dtype("u1")), out)

    def surface(
        self, info: _info.Info, window: Optional[c.Window], out: Optional[NDArray[Any]]
    ) -> NDArray[Any]:
        if info.cube_depth is not None:
            return _put(self._grid(info, window), out)
        call = ("surface", c.PART_HEIGHTS)
        return self._decode(call, window, (info.shape or (0, 0), np.dtype("f4")), out)

    def _grid(self, info: _info.Info, window: Optional[c.Window]) -> NDArray[Any]:
        shape = info.shape or (0, 0)
        if window is not None:
            _inside(window, shape, True)
            out = np.empty((window.height, window.width), np.float32)
            grid = cube.placed(shape[1], shape[0], info.geotransform or ())
            self.check(
                c.lib.tks_decode_grid(self._handle, grid, window, out.ctypes.data, out.size)
            )
            return out
        side = 2 ** (info.cube_depth or 0) + 1
        whole = ((c.CUBE_PATCHES * side, side), np.dtype("f4"))
        surface = self._decode(("surface", c.PART_HEIGHTS), None, whole, None)
        return cube.grid_of(surface, shape, info.geotransform or ())

    def validity(self, info: _info.Info, window: Optional[c.Window]) -> NDArray[Any]:
        shape = info.shape or (0, 0)
        if info.cube_depth is not None:
            cut = ... if window is None else _inside(window, shape, True)
            return np.ones(shape, bool)[cut]
        call = ("validity", c.PART_VALIDITY)
        return self._decode(call, window, (shape, np.dtype("u1")), None).view(bool)

    def texture(
        self, info: _info.Info, window: Optional[c.Window], out: Optional[NDArray[Any]]
    ) -> NDArray[Any]:
        call = ("texture", c.PART_TEXTURE)
        target = (info.texture_shape or (0, 0), info.texture_dtype or np.dtype("u1"))
        return self._decode(call, window, target, out)

    def missing(self, part: int, window: Optional[c.Window]) -> List[Tuple[int, int]]:
        """(offset, count) of the bytes that a call still needs, of a stream with an index."""
        info = self.info()
        windows: List[Optional[c.Window]] = [window]
        if window is not None and part != c.PART_TEXTURE and info.cube_depth is not None:
            shape, place = info.shape or (0, 0), info.geotransform or ()
            windows = [*cube.windows_of(info.cube_depth, shape, place, window)]
        held, gaps = self._held, []
        for each in windows:
            found = [gap for needed in self._needed(part, each) for gap in _without(needed, held)]
            gaps += found
            held = sorted(held + found)
        return gaps

    def _needed(self, part: int, window: Optional[c.Window]) -> List[Tuple[int, int]]:
        raw = c.Ranges()
        self.check(c.lib.tks_needed_ranges(self._handle, part, window, raw))
        try:
            return [(raw.ranges[i].offset, raw.ranges[i].size) for i in range(raw.count)]
        finally:
            c.lib.tks_free_ranges(raw)

    def put(self, pieces: List[Tuple[int, builtins.bytes]]) -> None:
        """Takes bytes from anywhere in the stream: (offset, bytes)."""
        kept = [piece for piece in pieces if piece[1]]
        if not kept:
            return
        ranges = (c.Range * len(kept))(*((offset, len(data)) for offset, data in kept))
        data = (ctypes.c_char_p * len(kept))(*(data for _, data in kept))
        self.check(c.lib.tks_put_ranges(self._handle, ranges, data, len(kept)))
        self._held = sorted(self._held + [(offset, len(data)) for offset, data in kept])

    def verify(self) -> None:
        self.check(c.lib.tks_verify(self._handle))

    def mesh(
        self, triangles: int, view: Optional[NDArray[Any]]
    ) -> Tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Grid indices and heights of the vertices, and (n, 3) corners."""
        raw = c.Mesh()
        if view is None:
            self.check(c.lib.tks_decode_mesh(self._handle, c.MESH_BUDGET, triangles, raw))
        else:
            self._view(triangles, view, raw)
        try:
            return (
                _copied(raw.grid_index, raw.vertex_count, "u4"),
                _copied(raw.height, raw.vertex_count, "f4"),
                _copied(raw.triangles, 3 * raw.triangle_count, "u4").reshape(-1, 3),
            )
        finally:
            c.lib.tks_free_mesh(raw)

    def globe_mesh(self, triangles: int, globe: c.Globe) -> Tuple[NDArray[Any], ...]:
        """Positions, pixels and heights of the vertices, and (n, 3) corners."""
        raw = c.GlobeMesh()
        self.check(c.lib.tks_decode_globe(self._handle, c.MESH_BUDGET, triangles, globe, raw))
        try:
            return _arrays(raw)
        finally:
            c.lib.tks_free_globe_mesh(raw)

    def object_mesh(self, kind: int, triangles: int) -> Tuple[Optional[NDArray[Any]], ...]:
        """Positions, pixels and texcoords of the vertices, the last two where there are any, and
        (n, 3) corners."""
        raw = c.ObjectMesh()
        self.check(c.lib.tks_decode_object(self._handle, kind, triangles, raw))
        try:
            vertices = raw.vertex_count
            return (
                _copied(raw.position, 3 * vertices, "f8").reshape(-1, 3),
                _copied(raw.pixel, 2 * vertices, "f8").reshape(-1, 2) if raw.pixel else None,
                _copied(raw.texcoord, 2 * vertices, "f8").reshape(-1, 2) if raw.texcoord else None,
                _copied(raw.triangles, 3 * raw.triangle_count, "u4").reshape(-1, 3),
            )
        finally:
            c.lib.tks_free_object_mesh(raw)

    def _view(self, triangles: int, view: NDArray[Any], raw: c.Mesh) -> None:
        tree = ctypes.c_void_p()
        self.check(c.lib.tks_decode_mesh_tree(self._handle, c.MESH_BUDGET, triangles, tree))
        try:
            matrix = (ctypes.c_double * 16)(*view.ravel())
            status = c.lib.tks_view_mesh(tree, matrix, raw)
        finally:
            c.lib.tks_free_mesh_tree(tree)
        if status != Status.OK:
            raise error(status, "The view must be a 4 x 4 matrix of finite numbers.")


def header_bytes(data: builtins.bytes) -> int:
    """How many bytes the header takes, or so many that more can be said; 0 of no stream."""
    count = ctypes.c_uint64()
    c.lib.tks_header_bytes(data, len(data), count)
    return count.value


def _without(wanted: Tuple[int, int], held: List[Tuple[int, int]]) -> List[Tuple[int, int]]:
    """What of a range lies in none of those, which are in order."""
    gaps = []
    offset, end = wanted[0], sum(wanted)
    for start, count in held:
        if start >= end:
            break
        if start > offset:
            gaps.append((offset, start - offset))
        offset = max(offset, start + count)
    if offset < end:
        gaps.append((offset, end - offset))
    return gaps


def _inside(window: c.Window, shape: Tuple[int, ...], is_round: bool) -> Tuple[slice, Any]:
    """Rows and columns of the window, whose columns may go on behind the last one of a round."""
    bottom, right = window.y + window.height, window.x + window.width
    inside = window.x < shape[1] and window.width <= shape[1] if is_round else right <= shape[1]
    if not (0 < window.height and bottom <= shape[0] and 0 < window.width and inside):
        raise TksUsageError(
            f"The window must lie inside the {shape[1]} x {shape[0]} samples and hold one or more."
        )
    if right <= shape[1]:
        return slice(window.y, bottom), slice(window.x, right)
    return slice(window.y, bottom), np.arange(window.x, right) % shape[1]


def _put(array: NDArray[Any], out: Optional[NDArray[Any]]) -> NDArray[Any]:
    """In `out`, where that is given."""
    if out is None:
        return array
    out = values.output(out, array.shape, array.dtype)
    out[...] = array
    return out


def _arrays(raw: c.GlobeMesh) -> Tuple[NDArray[Any], ...]:
    return (
        _copied(raw.position, 3 * raw.vertex_count, "f8").reshape(-1, 3),
        _copied(raw.pixel, 2 * raw.vertex_count, "f8").reshape(-1, 2),
        _copied(raw.height, raw.vertex_count, "f4"),
        _copied(raw.triangles, 3 * raw.triangle_count, "u4").reshape(-1, 3),
    )


def _copied(pointer: Any, count: int, dtype: str) -> NDArray[Any]:
    """A copy of the library's memory; an empty array may have no address."""
    if count == 0:
        return np.empty(0, dtype)
    return np.ctypeslib.as_array(pointer, (count,)).astype(dtype)
