# SPDX-License-Identifier: Apache-2.0
"""Where the samples of a mesh lie on the ground and in the texture."""

from __future__ import annotations

import re
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from ._info import GeoTransform, Info


def _at(transform: GeoTransform, columns: Any, rows: Any) -> Tuple[Any, Any]:
    t = transform
    return t[0] + columns * t[1] + rows * t[2], t[3] + columns * t[4] + rows * t[5]


def mesh_place(
    info: Info, columns: NDArray[Any], rows: NDArray[Any], transform: Optional[GeoTransform]
) -> Tuple[NDArray[Any], NDArray[Any], bool]:
    """x, y, and whether they lie as in a mirror: rows usually run against y."""
    t = info.geotransform
    mirrored = t is not None and t[1] * t[5] - t[2] * t[4] > 0
    if transform is None:
        spacing_x, spacing_y = info.spacing or (1.0, 1.0)
        y = rows * spacing_y
        return columns * spacing_x, y if mirrored else 0.0 - y, mirrored
    return (*_at(transform, columns + 0.5, rows + 0.5), mirrored)


def mesh_uv(info: Info, columns: NDArray[Any], rows: NDArray[Any]) -> NDArray[Any]:
    """By both geotransforms where heights and texture have one in the same CRS. Otherwise the first
    and last samples lie on the texture's borders, as in the meshes of the command line."""
    height, width = info.shape or (0, 0)
    u, v = columns / (width - 1), rows / (height - 1)
    ground, t = info.geotransform, info.texture_geotransform
    if ground and t and info.texture_shape and _plain(info.texture_crs) == _plain(info.crs):
        determinant = t[1] * t[5] - t[2] * t[4]
        if determinant != 0:
            x, y = _at(ground, columns + 0.5, rows + 0.5)
            x, y = x - t[0], y - t[3]
            u = (x * t[5] - y * t[2]) / determinant / info.texture_shape[1]
            v = (y * t[1] - x * t[4]) / determinant / info.texture_shape[0]
    uv: NDArray[Any] = np.stack([u, v], axis=1).astype(np.float32)
    return uv


def _plain(crs: Optional[str]) -> Optional[str]:
    """A code in capitals, without a vertical part; any other text as it is."""
    code = re.fullmatch(r"(\w+:\w+)(\+\w+)?", crs or "")
    return code.group(1).upper() if code else crs
