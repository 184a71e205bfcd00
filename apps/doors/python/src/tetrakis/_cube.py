# SPDX-License-Identifier: Apache-2.0
"""Heights of a grid that goes round the Earth on a cube, and heights of a cube on their grid."""

from __future__ import annotations

import ctypes
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from ._errors import Status, TksUsageError, error

# Of the Earth's meridians, from a pole to the equator, in metres.
_QUARTER_MERIDIAN = 10_002_000


def check_options(target: dict, geotransform: Any) -> None:
    """Refuses what does not go with other samples than those given."""
    if target["bytes"] is None and target["psnr"] is None:
        raise TksUsageError(
            'domain "cube" resamples heights, so that nothing is lossless or within a largest '
            "error: give bytes or psnr."
        )
    if geotransform is None:
        raise TksUsageError('domain "cube" takes a geotransform, in degrees.')


def place_texture(place: Dict[str, Any], texture: Any, heights: Any, geotransform: Any) -> None:
    """Says that a texture without a place of its own covers the grid from edge to edge."""
    if place["geotransform"] is not None:
        if place["domain"] == "cube":
            place["domain"] = "plane"
        return
    down, across = (of / own for of, own in zip(np.shape(heights), np.shape(texture)))
    x, a, b, y, c_, d = geotransform
    place["geotransform"] = (x, a * across, b * down, y, c_ * across, d * down)
    if place["domain"] == "cube":
        place["domain"] = "cylinder"


def on_cube(
    grid: c.Heights, samples: NDArray[Any], depth: int, threads: int
) -> Tuple[c.Heights, NDArray[Any]]:
    """The heights on a cube, as samples of the same type, which must live as long as the struct.
    depth: 0: the one that suits the grid."""
    depth = depth or c.lib.tks_cube_depth(grid.width)
    side = 2 ** min(depth, c.MOST_CUBE_DEPTH) + 1
    heights, cube = _heights_of(grid, samples), np.empty((c.CUBE_PATCHES * side, side), np.float32)
    message = ctypes.create_string_buffer(1024)
    status = c.lib.tks_cube_from_grid(
        placed(grid.width, grid.height, grid.geotransform),
        heights.ctypes.data,
        depth,
        threads,
        cube.ctypes.data,
        None,
        None,
        message,
        len(message),
    )
    _check(status, message)
    data = as_samples(cube, samples.dtype, grid.scale, grid.offset)
    field = c.Heights.from_buffer_copy(grid)
    field.data, field.height, field.width = data.ctypes.data, *data.shape
    field.spacing_x = field.spacing_y = _QUARTER_MERIDIAN / (side - 1)
    field.has_nodata, field.first_latitude, field.last_latitude = 0, 0, 0
    field.forest = c.Forest(depth, c.CUBE_PATCHES, c.lib.tks_cube_sides())
    field.grid_width, field.grid_height = grid.width, grid.height
    return field, data


def depth_of(raw: c.StreamInfo) -> Optional[int]:
    """Of the cube that the heights lie on, if they were made of a grid."""
    forest = raw.forest
    made = c.DOMAINS[raw.domain] == "forest" and raw.grid_width > 0 and raw.has_geotransform
    if not made or forest.patches != c.CUBE_PATCHES or forest.depth > c.MOST_CUBE_DEPTH:
        return None
    count = 4 * c.CUBE_PATCHES
    same = forest.sides[:count] == c.lib.tks_cube_sides()[:count]
    return int(forest.depth) if same else None


def windows_of(
    depth: int, shape: Tuple[int, int], geotransform: Sequence[float], window: c.Window
) -> List[c.Window]:
    """The windows of the raster of a cube that a window of its grid needs."""
    windows = (c.Window * c.CUBE_PATCHES)()
    message = ctypes.create_string_buffer(1024)
    grid = placed(shape[1], shape[0], geotransform)
    status = c.lib.tks_cube_windows(depth, grid, window, windows, message, len(message))
    _check(status, message)
    return [each for each in windows if each.width > 0]


def grid_of(
    cube: NDArray[Any], shape: Tuple[int, int], geotransform: Sequence[float]
) -> NDArray[Any]:
    """Heights of the grid, as float32."""
    out = np.empty(shape, np.float32)
    message = ctypes.create_string_buffer(1024)
    status = c.lib.tks_grid_from_cube(
        cube.ctypes.data,
        (cube.shape[1] - 1).bit_length() - 1,
        placed(shape[1], shape[0], geotransform),
        None,
        1,
        out.ctypes.data,
        message,
        len(message),
    )
    _check(status, message)
    return out


def as_samples(
    heights: NDArray[Any], dtype: np.dtype[Any], scale: float, offset: float
) -> NDArray[Any]:
    """The nearest samples of the type."""
    samples = (heights.astype(np.float64) - offset) / scale
    if dtype.kind != "f":
        limits = np.iinfo(dtype)
        samples = np.clip(np.rint(samples), limits.min, limits.max)
    return samples.astype(dtype)


def _heights_of(grid: c.Heights, samples: NDArray[Any]) -> NDArray[Any]:
    """In `unit`; voids are NaN."""
    heights = (samples * np.float64(grid.scale) + grid.offset).astype(np.float32)
    if grid.has_nodata:
        heights[samples == grid.nodata] = np.nan
    return heights


def placed(width: int, height: int, geotransform: Sequence[float]) -> c.GeographicGrid:
    numbers = c.GEOTRANSFORM(*geotransform)
    return c.GeographicGrid(ctypes.sizeof(c.GeographicGrid), width, height, numbers)


def _check(status: int, message: Any) -> None:
    if status != Status.OK:
        raise error(status, message.value.decode("utf-8", "replace"))
