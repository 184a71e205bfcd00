# SPDX-License-Identifier: Apache-2.0
"""Streams as datasets of xarray; needs xarray 2022.11 or later.

Found by its entry point and by the name of the file::

    dataset = xarray.open_dataset("alps.tks")            # heights (y, x), texture (…, channel)
    coarse = xarray.open_dataset("alps.tks", level=3)
    part = dataset.heights[0:512, 512:1024].values       # decodes, and fetches, only this window
    melting = xarray.open_dataset("glacier.tks")         # a sequence: heights (time, y, x)
    july = melting.heights.sel(time="2019-07")           # only these groups of frames
"""

from __future__ import annotations

import os
from typing import Any, Iterable, Optional, Union

import numpy as np
import xarray
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing

from ._info import GeoTransform, Info
from ._sequence import Sequence, open_sequence
from ._stream import Stream


class TetrakisBackend(BackendEntrypoint):
    """Opens `.tks` for :func:`xarray.open_dataset`. `level`, `texture_level`: mip levels."""

    description = "Heights and textures of Tetrakis streams"
    open_dataset_parameters = ("filename_or_obj", "drop_variables", "level", "texture_level")

    def open_dataset(
        self,
        filename_or_obj: Any,
        *,
        drop_variables: Optional[Iterable[str]] = None,
        mask_and_scale: bool = True,
        decode_times: bool = True,
        use_cftime: Optional[bool] = None,
        level: int = 0,
        texture_level: int = 0,
    ) -> xarray.Dataset:
        sequence = open_sequence(filename_or_obj)
        info = sequence.frame(sequence.first_frame).describe(level, texture_level)
        frames = sequence if sequence.is_moving else sequence.frame(0)
        variables, coordinates = {}, {}
        if sequence.is_moving:
            coordinates["time"] = _time(sequence)
        if info.shape is not None:
            variables["heights"] = _heights(frames, info, level)
            coordinates.update(_axes(info.geotransform, info.shape, ("y", "x")))
        if info.texture_shape is not None:
            placed_alike = info.texture_geotransform in (None, info.geotransform)
            same = placed_alike and info.shape == info.texture_shape[:2]
            axes = ("y", "x") if same or info.shape is None else ("texture_y", "texture_x")
            variables["texture"] = _texture(frames, info, texture_level, axes)
            if not same:
                coordinates.update(_axes(info.texture_geotransform, info.texture_shape, axes))
        coordinates["spatial_ref"] = _spatial_ref(info)
        dataset = xarray.Dataset(variables, coordinates)
        dataset = dataset.drop_vars(drop_variables or (), errors="ignore")
        dataset = xarray.decode_cf(
            dataset,
            mask_and_scale=mask_and_scale,
            decode_times=decode_times,
            use_cftime=use_cftime,
            decode_timedelta=False,
            decode_coords="all",
        )
        dataset.set_close(frames.close)
        return dataset

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        named = isinstance(filename_or_obj, (str, os.PathLike))
        return named and str(filename_or_obj).lower().endswith(".tks")


# What is opened: one frame, or several along an axis in front.
Frames = Union[Stream, Sequence]


class _Lazy(BackendArray):
    """Samples that are decoded where they are looked at."""

    def __init__(self, frames: Frames, name: str, level: int, shape: Any, dtype: Any) -> None:
        self._frames, self._name, self._level = frames, name, level
        self.shape, self.dtype = shape, dtype

    def __getitem__(self, key: Any) -> Any:
        support = indexing.IndexingSupport.BASIC
        return indexing.explicit_indexing_adapter(key, self.shape, support, self._read)

    def _read(self, key: Any) -> Any:
        return self._frames.read(self._name, key, self._level)


def _lazy(frames: Frames, name: str, level: int, axes: Any, shape: Any, dtype: Any) -> Any:
    """The axes, and the samples along them."""
    if isinstance(frames, Sequence):
        axes, shape = ("time", *axes), (len(frames), *shape)
    data = indexing.LazilyIndexedArray(_Lazy(frames, name, level, shape, dtype))
    return axes[: len(shape)], data


def _heights(frames: Frames, info: Info, level: int) -> xarray.Variable:
    attributes: dict[str, Any] = {"grid_mapping": "spatial_ref"}
    if (info.scale, info.offset) != (1.0, 0.0):
        attributes.update(scale_factor=info.scale, add_offset=info.offset)
    if info.nodata is not None:
        attributes["_FillValue"] = np.array(info.nodata).astype(info.dtype)[()]
    for name, value in (("units", info.unit), ("long_name", info.description)):
        if value is not None:
            attributes[name] = value
    samples = _lazy(frames, "heights", level, ("y", "x"), info.shape, info.dtype)
    return xarray.Variable(*samples, attributes)


def _texture(frames: Frames, info: Info, level: int, axes: Any) -> xarray.Variable:
    shape = info.texture_shape or ()
    samples = _lazy(frames, "texture", level, (*axes, "channel"), shape, info.texture_dtype)
    return xarray.Variable(*samples)


def _time(sequence: Sequence) -> xarray.Variable:
    """As CF has it. What has no epoch is in seconds, what has no clock in ticks."""
    clock, ticks = sequence.clock, sequence.ticks
    attributes = {"axis": "T"}
    if clock.tick is None:
        return xarray.Variable("time", ticks, attributes)
    numbers, attributes["units"] = clock.cf_times(ticks)
    if clock.epoch is not None:
        attributes["standard_name"] = "time"
        attributes["calendar"] = clock.calendar or "standard"
    return xarray.Variable("time", numbers, attributes)


def _axes(place: Optional[GeoTransform], shape: Any, names: Any) -> dict[str, xarray.Variable]:
    """Middles of the samples; none where rows and columns do not run along the axes."""
    if place is None or place[2] != 0 or place[4] != 0:
        return {}
    y = place[3] + place[5] * (np.arange(shape[0]) + 0.5)
    x = place[0] + place[1] * (np.arange(shape[1]) + 0.5)
    return {
        names[0]: xarray.Variable(names[0], y, {"axis": "Y"}),
        names[1]: xarray.Variable(names[1], x, {"axis": "X"}),
    }


def _spatial_ref(info: Info) -> xarray.Variable:
    attributes = {}
    crs = info.crs or info.texture_crs
    if crs is not None:
        attributes["spatial_ref"] = crs
        if "[" in crs:  # WKT, which CF has a name for
            attributes["crs_wkt"] = crs
    if info.geotransform is not None:
        attributes["GeoTransform"] = " ".join(repr(number) for number in info.geotransform)
    return xarray.Variable((), 0, attributes)
