# SPDX-License-Identifier: Apache-2.0
"""The codec of chunks for Zarr 2 and whatever else uses numcodecs; needs numcodecs.

Found by its entry point, so arrays open without an import::

    zarr.array(heights, chunks=(512, 512), compressor=tetrakis.numcodecs.Tetrakis(max_error=0.1))
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numcodecs.abc import Codec
from numcodecs.compat import ensure_bytes, ndarray_copy
from numcodecs.registry import register_codec
from numpy.typing import NDArray

from . import _chunk
from ._errors import TksUsageError


class Tetrakis(Codec):
    """Chunks of (rows, columns) as heights, of (rows, columns, channels) as textures, and those
    with an axis of time in front as sequences of either, in groups of 32 frames; axes of length 1
    in front do not count. Three axes of uint8 or uint16, the last of up to 4, are a texture.
    Lossless unless `bytes` (of a chunk), `psnr` (dB) or `max_error`
    (in units of the samples) is given; samples equal to `nodata` are voids."""

    codec_id = "tetrakis"

    def __init__(
        self,
        bytes: Optional[int] = None,
        psnr: Optional[float] = None,
        max_error: Optional[float] = None,
        nodata: Optional[float] = None,
    ) -> None:
        self.bytes = bytes
        self.psnr = psnr
        self.max_error = max_error
        self.nodata = nodata

    def encode(self, buf: Any) -> Any:
        options = _chunk.configuration(self.bytes, self.psnr, self.max_error, self.nodata)
        return _chunk.to_stream(_as_it_lies(np.asarray(buf)), options)

    def decode(self, buf: Any, out: Any = None) -> Any:
        return ndarray_copy(_chunk.from_stream(ensure_bytes(buf)), out)


def _as_it_lies(chunk: NDArray[Any]) -> NDArray[Any]:
    """The chunk with its axes in the order of its memory. What decode() returns counts as memory:
    nothing there tells the byte order or the order of axes that the array has."""
    if not chunk.dtype.isnative:
        raise TksUsageError(
            f"Chunks of type {chunk.dtype.str} would come back in this machine's byte order: make "
            f"the array of type {chunk.dtype.newbyteorder('=').str}."
        )
    if chunk.flags.c_contiguous or not chunk.flags.f_contiguous:
        return chunk
    layer = _chunk.layer(chunk)
    if layer.ndim > 2:
        raise TksUsageError(
            "Chunks with channels or time are coded in C order only: use order='C'."
        )
    return layer.T


register_codec(Tetrakis)
