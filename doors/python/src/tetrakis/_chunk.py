# SPDX-License-Identifier: Apache-2.0
"""Chunks of Zarr arrays to streams and back: what both codecs need."""

from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np
from numpy.typing import NDArray

from . import _values as values
from ._errors import TksUsageError
from ._stream import BytesLike
from ._tks import tks_decode, tks_encode


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


def to_stream(chunk: NDArray[Any], options: Dict[str, Any]) -> bytes:
    array = layer(chunk)
    if array.ndim not in (2, 3):
        raise TksUsageError(
            f"A chunk of shape {chunk.shape} is neither (rows, columns) nor (rows, columns, "
            "channels): choose chunks of one layer."
        )
    return tks_encode(array, **options)


def from_stream(stream: BytesLike) -> NDArray[Any]:
    return tks_decode(stream)
