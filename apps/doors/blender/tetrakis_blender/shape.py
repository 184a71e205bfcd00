# SPDX-License-Identifier: Apache-2.0
"""From a stream to what Blender's meshes and images are made of. Knows nothing of Blender, so that
any Python can test it.

Blender keeps texture coordinates with the corners of faces: vertices of objects that are equal
become one here, and the mesh is smooth across the sides of patches.
"""

from typing import Any, NamedTuple, Optional

import numpy as np


class Shape(NamedTuple):
    """A mesh with z up, and its image."""

    name: str
    """That of the stream; "": it has none."""
    vertices: Any
    """float64 (n, 3)"""
    faces: Any
    """int64 (m, 3): places in `vertices`, counter-clockwise seen from outside or above."""
    corner_uv: Optional[Any]
    """float64 (m, 3, 2): of the corners of faces, v growing upwards; None without an image."""
    image: Optional[Any]
    """float32 (rows, columns, 4): red, green, blue and alpha of 0 to 1, the lowest row first."""


def shape_of(stream: Any, triangles: int = 0, y_is_up: bool = False) -> Shape:
    """The shape of an open stream of `tetrakis`. triangles: about the most; 0: all. y_is_up: the
    points of an object have y up, as those of most scans; terrain has z up in any case."""
    if stream.is_object:
        return _of_object(stream, triangles, y_is_up)
    if stream.info.domain == "cube":
        globe = stream.globe_mesh(triangles or None)
        return _welded(stream, globe.positions, globe.triangles)
    return _of_terrain(stream, triangles)


def _of_object(stream: Any, triangles: int, y_is_up: bool) -> Shape:
    mesh = stream.object(triangles)
    points = mesh.points[:, [0, 2, 1]] * [1, -1, 1] if y_is_up else mesh.points
    return _welded(stream, points, mesh.triangles, mesh.texcoords, mesh.atlas)


def _of_terrain(stream: Any, triangles: int) -> Shape:
    """In metres, with the origin below the middle."""
    vertices, faces, uv = stream.mesh(triangles or None)
    if len(vertices):
        middle = (vertices[:, :2].min(axis=0) + vertices[:, :2].max(axis=0)) / 2
        vertices = vertices - [*middle, 0]
    if stream.info.texture_shape is None:
        return _welded(stream, vertices, faces)
    return _welded(stream, vertices, faces, uv, stream.texture())


def _welded(
    stream: Any, points: Any, triangles: Any, uv: Optional[Any] = None, texels: Optional[Any] = None
) -> Shape:
    vertices, one = np.unique(points, axis=0, return_inverse=True)
    faces = one.reshape(-1)[triangles].astype(np.int64)
    # Blender takes no face that names a vertex twice.
    a, b, c = faces.T
    sound = (a != b) & (b != c) & (c != a)
    name = stream.info.description or ""
    if uv is None or texels is None:
        return Shape(name, vertices, faces[sound], None, None)
    upwards = np.asarray(uv, np.float64) * [1, -1] + [0, 1]
    return Shape(name, vertices, faces[sound], upwards[triangles][sound], _image(stream, texels))


def _image(stream: Any, texels: Any) -> Any:
    info = stream.info
    pixels = texels.reshape(*texels.shape[:2], -1).astype(np.float32)
    largest = np.float32(np.iinfo(texels.dtype).max)
    has_alpha = info.texture_alpha and pixels.shape[2] in (2, 4)
    colours = pixels.shape[2] - (1 if pixels.shape[2] in (2, 4) else 0)
    image = np.ones((*pixels.shape[:2], 4), np.float32)
    image[..., :3] = np.minimum(pixels[..., :colours] / (info.texture_white_level or largest), 1)
    if has_alpha:
        image[..., 3] = pixels[..., -1] / largest
    return image[::-1]
