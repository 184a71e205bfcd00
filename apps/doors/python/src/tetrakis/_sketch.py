# SPDX-License-Identifier: Apache-2.0
"""A small picture of a mesh, for notebooks: points are strewn over each triangle, so densely that
no pixel is missed, and the nearest one of each pixel is drawn."""

from __future__ import annotations

from typing import Any, Iterator, Tuple

import numpy as np
from numpy.typing import NDArray

from ._objects import ObjectMesh
from ._picture import eight_bits

SIZE = 192
TRIANGLES = 4000
_MARGIN = 6

# Right, down and towards the viewer, who stands in front, to the right and above, with z upwards.
_AXES = np.array([[0.8, 0.6, 0.0], [0.18, -0.24, -0.954], [0.572, -0.764, 0.3]])
_LIGHT = np.array([-0.4, -0.5, 0.77])


def drawn(mesh: ObjectMesh, white: int) -> NDArray[Any]:
    """uint8 (SIZE, SIZE, 4); clear where there is nothing."""
    picture = np.zeros((SIZE, SIZE, 4), "u1")
    if len(mesh.triangles) == 0:
        return picture
    corners = _placed(mesh.points)[mesh.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    facing = normal / np.where(length > 0, length, 1)
    facing *= np.where(facing[:, 2:] < 0, -1, 1)  # insides of open surfaces are seen, too
    shade = np.clip(0.35 + 0.65 * (facing @ _LIGHT), 0.2, 1)
    colours = None if mesh.atlas is None else _colours(mesh.atlas, white)
    nearest = np.full(SIZE * SIZE, -np.inf)
    seen = picture.reshape(-1, 4)
    for chosen, weights in _strewn(corners):
        at = np.einsum("wk,tkx->twx", weights, corners[chosen]).reshape(-1, 3)
        light = np.repeat(shade[chosen], len(weights))
        colour = np.full((len(at), 3), 220.0)
        if colours is not None and mesh.texcoords is not None:
            uv = np.einsum("wk,tkx->twx", weights, mesh.texcoords[mesh.triangles[chosen]])
            colour = _looked_up(colours, uv.reshape(-1, 2))
        pixel = at[:, 1].astype(int) * SIZE + at[:, 0].astype(int)
        order = np.argsort(at[:, 2], kind="stable")  # of equal pixels the last one stays
        order = order[at[order, 2] > nearest[pixel[order]]]
        seen[pixel[order], :3] = (light[:, np.newaxis] * colour)[order].astype("u1")
        seen[pixel[order], 3] = 255
        nearest[pixel[order]] = at[order, 2]
    return picture


def _placed(points: NDArray[Any]) -> NDArray[Any]:
    """Column, row and nearness, all in pixels."""
    turned = points @ (_AXES / np.linalg.norm(_AXES, axis=1, keepdims=True)).T
    low, high = turned.min(axis=0), turned.max(axis=0)
    scale = (SIZE - 2 * _MARGIN) / max(float((high - low)[:2].max()), 1e-300)
    return (turned - (low + high) / 2) * scale + SIZE / 2


def _strewn(corners: NDArray[Any]) -> Iterator[Tuple[NDArray[Any], NDArray[Any]]]:
    """Triangles of about one size, and the weights of their corners at points of a grid on each."""
    sides = corners[:, [1, 2, 0], :2] - corners[:, :, :2]
    steps = np.ceil(np.linalg.norm(sides, axis=2).max(axis=1) * 1.42 + 1)
    fineness = np.ceil(np.log2(steps)).astype(int)
    for fine in np.unique(fineness):
        count = 2**fine
        i, j = np.mgrid[0 : count + 1, 0 : count + 1]
        inside = i + j <= count
        weights = np.stack([i[inside], j[inside], (count - i - j)[inside]], axis=1) / count
        chosen = np.flatnonzero(fineness == fine)
        most = max(1, 2**20 // len(weights))  # so that memory stays small
        for first in range(0, len(chosen), most):
            yield chosen[first : first + most], weights


def _colours(atlas: NDArray[Any], white: int) -> NDArray[Any]:
    """float (rows, columns, 3) of 0 to 255."""
    pixels = eight_bits(atlas, white)
    pixels = pixels[..., np.newaxis] if pixels.ndim == 2 else pixels
    grey = pixels.shape[2] < 3
    return np.repeat(pixels[..., :1], 3, axis=2) if grey else pixels[..., :3]


def _looked_up(colours: NDArray[Any], uv: NDArray[Any]) -> NDArray[Any]:
    rows, columns = colours.shape[:2]
    uv = uv - np.floor(uv)  # the texture repeats
    return colours[(uv[:, 1] * rows).astype(int), (uv[:, 0] * columns).astype(int)].astype("f8")
