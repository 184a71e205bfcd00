# SPDX-License-Identifier: Apache-2.0
"""What an object decodes to: its base mesh, its surface as triangles, and its texture as an image.

Texels lie on patches, as heights do, one below the other. Viewers want one image of about as many
rows as columns, and read a little across the edge of a patch: the atlas has the patches side by
side, each with a rim of copies of its outermost texels.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _library as c

# Texels of the rim on each side of a patch.
_GUTTER = 1


class BaseMesh(NamedTuple):
    """The quads of an object, one for each patch. Heights count along their normals."""

    bits: int
    """Coordinates in `corners` are below 2^bits."""
    cell: float
    """Side of a cell of the grid of corners, in `Info.unit`."""
    origin: Tuple[float, float, float]
    corners: NDArray[Any]
    """int32 (patches, 4, 3): x, y and z in cells; a corner lies at origin + cell * (x, y, z). They
    are those of a patch with its first row and column, first row and last column, the last of
    both, last row and first column: clockwise seen in the raster."""
    depth: int
    """Patches have (2^depth + 1)^2 samples."""
    sides: NDArray[Any]
    """uint32 (patches, 4): which side each side of a patch is glued to, as `tks_forest` says:
    4 * patch + 0 for the first row, 1 for the last column, 2 for the last row, 3 for the first
    column; 4294967295 for none."""
    texture_depth: Optional[int]
    """Likewise of texels; None: there is no texture on the patches."""

    @property
    def places(self) -> NDArray[Any]:
        """float64 (patches, 4, 3): the corners in `Info.unit`."""
        return np.array(self.origin) + self.cell * self.corners


class ObjectMesh(NamedTuple):
    """The surface of an object; unpacks as ``points, triangles, pixels, texcoords, atlas``."""

    points: NDArray[Any]
    """float64 (n, 3): x, y and z in `Info.unit`. Beside a texture, points on sides of patches come
    once for each patch, equal to the last bit."""
    triangles: NDArray[Any]
    """uint32 (m, 3): places in `points`, counter-clockwise seen from outside."""
    pixels: Optional[NDArray[Any]]
    """float64 (n, 2): column and row in the raster of the patches, of which (0, 0) is the outer
    corner of the first sample. None where triangles are coded as they are."""
    texcoords: Optional[NDArray[Any]]
    """float64 (n, 2): place in the atlas; (0, 0) is its upper left corner, (1, 1) its lower right
    one. So v grows downwards, as in glTF; trimesh and PyVista take ``1 - v``. None without a
    texture."""
    atlas: Optional[NDArray[Any]]
    """(rows, columns) or (rows, columns, channels) of `Info.texture_dtype`: patch p lies in row
    p // k and column p % k of a grid, k = ceil(sqrt(patches)); its texels have a rim of one texel
    round them, a copy of the nearest one. Fields that no patch fills are 0. Where triangles are
    coded as they are: the texture itself, which repeats beyond its corners."""


def base_of(raw: c.StreamInfo) -> Optional[BaseMesh]:
    """A copy: the decoder owns the arrays."""
    base, forest, texture = raw.base_mesh, raw.forest, raw.texture_forest
    if base.position_bits == 0:
        return None
    shape = (forest.patches, 4)
    on_patches = raw.has_texture and texture.patches == forest.patches
    return BaseMesh(
        bits=int(base.position_bits),
        cell=float(base.cell),
        origin=(base.origin[0], base.origin[1], base.origin[2]),
        corners=np.ctypeslib.as_array(base.corners, (*shape, 3)).copy(),
        depth=int(forest.depth),
        sides=np.ctypeslib.as_array(forest.sides, shape).copy(),
        texture_depth=int(texture.depth) if on_patches else None,
    )


def atlas_of(texels: NDArray[Any]) -> NDArray[Any]:
    """Patches of the raster side by side."""
    side = texels.shape[1]
    patches = texels.reshape(-1, side, *texels.shape[1:])
    across = _across(len(patches))
    down = -(-len(patches) // across)
    rim = [(0, 0), (_GUTTER, _GUTTER), (_GUTTER, _GUTTER)] + [(0, 0)] * (patches.ndim - 3)
    framed = np.pad(patches, rim, mode="edge")
    fields = np.zeros((down * across, *framed.shape[1:]), texels.dtype)
    fields[: len(framed)] = framed
    rows = fields.reshape(down, across, *framed.shape[1:]).swapaxes(1, 2)
    field = side + 2 * _GUTTER
    return np.ascontiguousarray(rows).reshape(down * field, across * field, *texels.shape[2:])


def texcoords_of(pixels: NDArray[Any], base: BaseMesh) -> NDArray[Any]:
    """Where samples of the raster lie in the atlas."""
    side, texture_side = 2**base.depth + 1, 2 ** (base.texture_depth or 0) + 1
    patch = (pixels[:, 1] // side).astype(np.int64)
    within = np.stack([pixels[:, 0], pixels[:, 1] - side * patch], axis=1) - 0.5
    across = _across(len(base.corners))
    down = -(-len(base.corners) // across)
    field = texture_side + 2 * _GUTTER
    corner = field * np.stack([patch % across, patch // across], axis=1)
    texel = corner + _GUTTER + 0.5 + within * ((texture_side - 1) / (side - 1))
    return texel / (field * np.array([across, down]))


def _across(patches: int) -> int:
    """Fields in a row of the atlas."""
    return math.isqrt(patches - 1) + 1
