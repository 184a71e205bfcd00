# SPDX-License-Identifier: Apache-2.0
"""What a stream says of itself."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Optional, Tuple, Union

import numpy as np

from . import _cube as cube
from . import _library as c
from . import _objects as objects
from . import _values as values

GeoTransform = Tuple[float, float, float, float, float, float]


@dataclass(frozen=True)
class Info:
    """What a stream, or its prefix, says of itself. What is unknown, or not there, is None.

    Shapes, spacings and geotransforms are those of the mip level asked for (0 from `Stream.info`).
    """

    format_version: int
    header_bytes: int
    """Bytes before the first packet: the shortest prefix that opens."""
    stream_bytes: int
    """What the encoder wrote."""
    available_bytes: int
    """What there is of it."""
    packets: int
    geometry_bytes: int
    texture_bytes: int
    index: Union[bool, str]
    """As for `encode`: False, True, or "windows"."""
    lossless: bool
    """The complete stream restores every sample."""

    shape: Optional[Tuple[int, int]]
    """Of the heights: (rows, columns)."""
    dtype: Optional[np.dtype[Any]]
    coarsest_level: int
    """The greatest `level` that `heights` takes."""
    scale: float
    """A sample v is the height v * scale + offset, in `unit`."""
    offset: float
    step: float
    base: float
    exact_steps: bool
    spacing: Optional[Tuple[float, float]]
    """Metres per sample: (x, y)."""
    unit: Optional[str]
    vertical_datum: Optional[str]
    crs: Optional[str]
    geotransform: Optional[GeoTransform]
    """Six numbers in the order of GDAL; (0, 0) is the outer corner of the first sample."""
    registration: Optional[str]
    """"area", "point", or None."""
    description: Optional[str]
    geo_keys: Optional[str]
    domain: str
    """"plane", "cylinder", "cube" or another "forest": of the heights. Those of a cube that was
    made of a grid come back on the grid, which `shape`, `spacing` (on the equator) and
    `geotransform` are of; `heights_rmse` is that of the cube. Heights of an object, which has a
    `base_mesh`, lie on a "forest" as well: its patches are one below the other."""
    cube_depth: Optional[int]
    """Faces of such a cube have 2^cube_depth x 2^cube_depth squares."""
    has_voids: bool
    """Some samples may be void."""
    voids_known: bool
    """False: bytes of their mask are missing; some voids may be shown as ground."""
    nodata: Optional[float]
    """The value of voids; None: they are NaN."""
    max_error: Optional[float]
    """Guaranteed for the complete stream, in `unit`."""
    heights_rmse: Optional[float]
    """Of these bytes, as the encoder measured it, in `unit`."""
    heights_drawn: int
    triangles: Optional[int]
    regions: Optional[int]
    """Side of the regions in samples."""

    texture_shape: Optional[Tuple[int, ...]]
    """(rows, columns) of a grey one, else (rows, columns, channels)."""
    texture_dtype: Optional[np.dtype[Any]]
    texture_alpha: bool
    """The last channel of the texture is alpha."""
    texture_white_level: Optional[int]
    """What pictures show as white."""
    texture_coarsest_level: int
    texture_cutout: int
    texture_drawn: int
    texture_psnr: Optional[float]
    """Of these bytes, as the encoder measured it, in dB; inf: exact."""
    texture_regions: Optional[int]
    texture_crs: Optional[str]
    texture_geotransform: Optional[GeoTransform]
    texture_registration: Optional[str]
    texture_geo_keys: Optional[str]
    texture_domain: str

    base_mesh: Optional[objects.BaseMesh] = field(compare=False)
    """Of an object: the quads that its heights lie over."""
    object_triangles: Optional[int]
    """Of an object whose triangles are coded as they are: how many these are."""
    material: Optional[str]
    """Of an object with maps of a material, which are components: factors, as the JSON of glTF."""

    frames: int
    """How many the stream has; those of several are for :func:`tetrakis.open_sequence`."""
    components: int
    """How many rasters the stream has: `Stream.components` lists them."""
    shows_sketch: bool
    """The bytes end inside the header: all but `header_bytes`, `stream_bytes` and `available_bytes`
    is about the sketch that the stream of an object begins with."""
    least_bytes: int
    """The fewest bytes of the stream that show something: its header or, with a sketch, that of
    the sketch."""


_PLAIN = (
    "format_version header_bytes stream_bytes available_bytes packets geometry_bytes texture_bytes "
    "least_bytes coarsest_level frames components heights_drawn scale offset step base texture_coarsest_level "
    "texture_cutout texture_drawn"
).split()
_BOOLEAN = "lossless exact_steps has_voids voids_known shows_sketch".split()
_TEXT = "unit vertical_datum crs description geo_keys texture_crs texture_geo_keys material".split()
_FROM_ZERO = "max_error heights_rmse texture_psnr".split()
_ABOVE_ZERO = "triangles regions texture_regions texture_white_level".split()


def _texture_shape(raw: c.StreamInfo) -> Tuple[int, ...]:
    shape = (raw.texture_height, raw.texture_width)
    return shape if raw.texture_channels == 1 else (*shape, raw.texture_channels)


def _known(raw: c.StreamInfo) -> dict[str, Any]:
    """Fields with a value of their own for what is unknown: "", less than 0, or 0."""
    known: dict[str, Any] = {}
    for name in _TEXT:
        known[name] = (getattr(raw, name) or b"").decode("utf-8", "replace") or None
    for name in _FROM_ZERO:
        known[name] = getattr(raw, name) if getattr(raw, name) >= 0 else None
    for name in _ABOVE_ZERO:
        known[name] = getattr(raw, name) or None
    return known


def from_struct(raw: c.StreamInfo) -> Info:
    depth = cube.depth_of(raw)
    info = _as_coded(raw)
    return info if depth is None else _of_grid(info, raw, depth)


def _of_grid(info: Info, raw: c.StreamInfo, depth: int) -> Info:
    """Of a grid on a cube: nothing is promised of the grid's samples."""
    spacing = info.spacing
    if spacing is not None:
        east = spacing[0] * 4 * 2**depth / raw.grid_width
        spacing = (east, east * abs(raw.geotransform[5] / raw.geotransform[1]))
    return replace(
        info,
        domain="cube",
        cube_depth=depth,
        shape=(raw.grid_height, raw.grid_width),
        spacing=spacing,
        lossless=False,
        max_error=None,
    )


def _as_coded(raw: c.StreamInfo) -> Info:
    heights, texture = bool(raw.has_heights), bool(raw.has_texture)
    spaced = raw.spacing_x > 0 and raw.spacing_y > 0
    placed, texture_placed = raw.has_geotransform, raw.texture_has_geotransform
    return Info(
        **{name: getattr(raw, name) for name in _PLAIN},
        **{name: bool(getattr(raw, name)) for name in _BOOLEAN},
        **_known(raw),
        shape=(raw.height, raw.width) if heights else None,
        dtype=values.SAMPLES[raw.sample] if heights else None,
        spacing=(raw.spacing_x, raw.spacing_y) if spaced else None,
        geotransform=tuple(raw.geotransform) if placed else None,
        registration=c.REGISTRATIONS[raw.registration],
        domain=c.DOMAINS[raw.domain],
        cube_depth=None,
        base_mesh=objects.base_of(raw),
        object_triangles=raw.object_triangles or None,
        texture_domain=c.DOMAINS[raw.texture_domain],
        index=c.INDEXES[raw.index],
        nodata=raw.nodata if raw.has_nodata else None,
        texture_shape=_texture_shape(raw) if texture else None,
        texture_dtype=values.SAMPLES[raw.texture_sample] if texture else None,
        texture_alpha=texture and not raw.texture_opaque,
        texture_geotransform=tuple(raw.texture_geotransform) if texture_placed else None,
        texture_registration=c.REGISTRATIONS[raw.texture_registration],
    )


def of_window(info: Info, window: c.Window) -> Info:
    """The info of a window of the heights."""
    place = info.geotransform
    if place is not None:
        x, y = window.x, window.y
        place = (
            place[0] + x * place[1] + y * place[2],
            *place[1:3],
            place[3] + x * place[4] + y * place[5],
            *place[4:],
        )
    return replace(info, shape=(window.height, window.width), geotransform=place)
