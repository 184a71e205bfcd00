# SPDX-License-Identifier: Apache-2.0
"""Chunks of Zarr arrays to streams and back: what both codecs need."""

from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np
from numpy.typing import NDArray

from . import _values as values
from ._encode_sequence import encode_sequence
from ._errors import TksUsageError
from ._sequence import open_sequence
from ._sequence_library import MOST_FRAMES
from ._source import BytesLike
from ._tks import tks_check, tks_decode, tks_encode


def configuration(
    bytes: Optional[int],
    psnr: Optional[float],
    max_error: Optional[float],
    nodata: Optional[float],
) -> Dict[str, Any]:
    """The options that are set, as they are written in the metadata of an array."""
    options = dict(bytes=bytes, psnr=psnr, max_error=max_error, nodata=nodata)
    return {name: value for name, value in options.items() if value is not None}


def check_type(dtype: np.dtype) -> None:
    values.samples(np.empty((0, 0), dtype), "A chunk")


def layer(chunk: NDArray[Any]) -> NDArray[Any]:
    """Without axes of length 1 in front (time, band), and of one channel."""
    array = chunk
    while array.ndim > 2 and array.shape[0] == 1:
        array = array[0]
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[..., 0]
    return array


def _frames(array: NDArray[Any]) -> Optional[Dict[str, NDArray[Any]]]:
    """A layer for each step of an axis in front, as what encode_sequence() takes."""
    if array.ndim == 4 and _is_texture(array[0]):
        return dict(texture=array)
    return dict(heights=array) if array.ndim == 3 else None


def to_stream(chunk: NDArray[Any], options: Dict[str, Any]) -> BytesLike:
    check_type(chunk.dtype)
    array = layer(chunk)
    if array.ndim == 2 or _is_texture(array):
        return tks_encode(array, **options)
    frames = _frames(array)
    if frames is None:
        raise TksUsageError(
            f"A chunk of shape {chunk.shape} and type {chunk.dtype} is neither heights, (rows, "
            "columns), nor a texture, (rows, columns, 1 to 4 channels) of uint8 or uint16, nor "
            "several of these along an axis of time in front: choose other chunks."
        )
    if "bytes" in options:
        options = {**options, "bytes": options["bytes"] // len(array)}
    return encode_sequence(**frames, group=MOST_FRAMES, seekable=False, **options)


def _is_texture(array: NDArray[Any]) -> bool:
    texels = array.dtype.newbyteorder("=") in values.TEXELS
    return array.ndim == 3 and 1 <= array.shape[2] <= 4 and texels


def from_stream(stream: BytesLike) -> NDArray[Any]:
    if tks_check(stream):
        return tks_decode(stream)
    with open_sequence(stream) as frames:
        return np.asarray(frames)
