# SPDX-License-Identifier: Apache-2.0
"""Arrays of xarray with their coordinates to streams.

The place on the ground is written as the CF conventions and rioxarray write it: a coordinate that
`grid_mapping` names (`spatial_ref` otherwise) with `crs_wkt` and `GeoTransform`, or axes in even
steps.
"""

from __future__ import annotations

from typing import Any, Iterator, Optional, Tuple

import numpy as np

from ._clock import Clock
from ._encode import encode
from ._encode_sequence import encode_sequence
from ._errors import TksUsageError

# What axes may stray from even steps, in steps: floats of 32 bits that count degrees do.
_STRAY = 0.02


def from_xarray(heights: Any = None, texture: Any = None, **options: Any) -> Any:
    """Codes a DataArray of heights, (y, x), with its CRS, geotransform, nodata value, unit, scale,
    offset and name. Returns the bytes of the stream.

    texture: a DataArray (y, x), (y, x, channel) or (channel, y, x), of 1 to 4 channels.
    options: those of :func:`tetrakis.encode`, which replace what the arrays say.

    Axes of length 1 in front of the heights (time, band) do not count. A longer one in front is
    time: heights (time, y, x), a texture with one axis more than above or with the time of the
    heights, or both become a sequence, by the options of :func:`tetrakis.encode_sequence`, with
    the dates of the axis in whichever calendar. Frames are read one by one.
    """
    facts: dict[str, Any] = {}
    if heights is not None:
        heights = _without_single_axes(heights)
        facts.update(_described(heights), **_place(heights, heights.dims[-2:]))
    moving = heights is not None and heights.ndim == 3
    if texture is not None:
        in_time = texture.ndim == 4 or (moving and texture.dims[0] == heights.dims[0])
        moving = moving or in_time
        first = texture[0] if in_time else texture
        axes = _texture_axes(first)
        place = _place(texture, axes[:2])
        facts.update({f"texture_{name}": value for name, value in place.items()})
    if moving:
        options = {**facts, **_moments(texture if heights is None else heights), **options}
        texels = None if texture is None else _frames(texture.transpose(texture.dims[0], *axes))
        samples = None if heights is None else _frames(heights)
        return encode_sequence(samples, texels, **options)
    samples = None if heights is None else layer(heights).values
    texels = None if texture is None else texture.transpose(*axes).values
    return encode(samples, texels, **{**facts, **options})


def _frames(array: Any) -> Iterator[Any]:
    return (array[i].values for i in range(array.shape[0]))


def _moments(array: Any) -> dict[str, Any]:
    """What the first axis says of times. Numbers that are not whole and not CF's are no times."""
    axis = array.coords.get(array.dims[0])
    if axis is None or axis.ndim != 1:
        return {}
    units = axis.attrs.get("units") or axis.encoding.get("units")
    calendar = axis.attrs.get("calendar") or axis.encoding.get("calendar")
    if axis.dtype.kind == "M":
        return dict(times=axis.values)
    if axis.dtype.kind == "O":  # dates of another calendar
        from xarray.coding.times import encode_cf_datetime

        numbers, units, calendar = encode_cf_datetime(axis.values, units, calendar)
        return dict(times=numbers, clock=Clock.cf(units, calendar))
    if " since " in str(units):
        return dict(times=axis.values, clock=Clock.cf(units, calendar))
    return dict(times=axis.values) if axis.dtype.kind in "iu" else {}


def heights_facts(array: Any) -> dict[str, Any]:
    """What a layer says of its heights as options of `encode`."""
    return {**_described(array), **_place(array, array.dims)}


def layer(array: Any) -> Any:
    """Without the axes of length 1 in front of (y, x)."""
    array = _without_single_axes(array)
    if array.ndim != 2:
        raise TksUsageError(
            f"Heights have the axes (y, x), not {tuple(array.dims)} of shape {array.shape}: "
            "choose one layer with isel()."
        )
    return array


def _without_single_axes(array: Any) -> Any:
    while array.ndim > 2 and array.shape[0] == 1:
        array = array[0]
    return array


def _texture_axes(array: Any) -> Tuple[Any, ...]:
    axes = tuple(array.dims)
    if array.ndim == 3 and array.shape[0] <= 4 < array.shape[2]:
        return (*axes[1:], axes[0])
    return axes


def _said(array: Any, name: str) -> Any:
    """Decoding moves what it has applied from attributes into the encoding."""
    return array.attrs.get(name)


def _described(array: Any) -> dict[str, Any]:
    nodata = _said(array, "_FillValue")
    if nodata is None:
        nodata = array.encoding.get("_FillValue") if array.dtype.kind == "f" else None
    if nodata is not None and "scale_factor" in array.encoding:
        nodata = None  # it is one of the numbers that were scaled
    scale, offset = _said(array, "scale_factor"), _said(array, "add_offset")
    return dict(
        nodata=None if nodata is None else float(nodata),
        unit=_text(_said(array, "units")),
        scale=1.0 if scale is None else float(scale),
        offset=0.0 if offset is None else float(offset),
        description=_text(_said(array, "long_name")) or _text(array.name),
    )


def _text(value: Any) -> Optional[str]:
    return value if isinstance(value, str) and value else None


def _place(array: Any, axes: Any) -> dict[str, Any]:
    mapping = array.attrs.get("grid_mapping") or array.encoding.get("grid_mapping")
    told = array.coords.get(mapping or "spatial_ref")
    attributes = {} if told is None else told.attrs
    crs = attributes.get("spatial_ref") or attributes.get("crs_wkt")
    numbers = str(attributes.get("GeoTransform", "")).split()
    if len(numbers) == 6:
        return dict(crs=crs, geotransform=tuple(float(number) for number in numbers))
    y, x = (_even_steps(array.coords.get(axis)) for axis in axes)
    if x is None or y is None:
        return dict(crs=crs)
    return dict(crs=crs, geotransform=(x[0], x[1], 0.0, y[0], 0.0, y[1]))


def _even_steps(axis: Any) -> Optional[Tuple[float, float]]:
    """Where an axis of the middles of samples begins, and its step."""
    if axis is None or axis.ndim != 1 or axis.size < 2 or axis.dtype.kind not in "iuf":
        return None
    middles = axis.values.astype(np.float64)
    step = (middles[-1] - middles[0]) / (axis.size - 1)
    even = middles[0] + step * np.arange(axis.size)
    if step == 0 or not np.abs(middles - even).max() <= _STRAY * abs(step):
        return None
    return float(middles[0] - step / 2), float(step)
