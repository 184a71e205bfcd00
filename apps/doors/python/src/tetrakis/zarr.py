# SPDX-License-Identifier: Apache-2.0
"""The codec of chunks for Zarr 3; needs zarr 3 or later.

Found by its entry point, so arrays open without an import::

    zarr.create_array(store, shape=heights.shape, dtype=heights.dtype, chunks=(512, 512),
                      serializer=tetrakis.zarr.TetrakisCodec(max_error=0.1), compressors=None)
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import Any, Dict, Optional

import numpy as np
from zarr.abc.codec import ArrayBytesCodec

from . import _chunk

NAME = "tetrakis"


@dataclass(frozen=True)
class TetrakisCodec(ArrayBytesCodec):
    """Chunks of (rows, columns) as heights, of (rows, columns, channels) as textures, and those
    with an axis of time in front as sequences of either, in groups of 32 frames; axes of length 1
    in front do not count. Three axes of uint8 or uint16, the last of up to 4, are a texture.
    Lossless unless `bytes` (of a chunk), `psnr` (dB) or `max_error`
    (in units of the samples) is given; samples equal to `nodata` are voids."""

    bytes: Optional[int] = None
    psnr: Optional[float] = None
    max_error: Optional[float] = None
    nodata: Optional[float] = None

    is_fixed_size = False

    @classmethod
    def from_dict(cls, data: Dict[str, Any]) -> "TetrakisCodec":
        if data.get("name") != NAME:
            raise ValueError(f"Expected the codec {NAME}, not {data.get('name')!r}.")
        return cls(**data.get("configuration", {}))

    def to_dict(self) -> Dict[str, Any]:
        return {"name": NAME, "configuration": self._options()}

    def validate(self, *, shape: Any, dtype: Any, chunk_grid: Any) -> None:
        """Refuses types before an array is made of them; Zarr 3.1 wraps those of NumPy."""
        native = dtype.to_native_dtype() if hasattr(dtype, "to_native_dtype") else dtype
        _chunk.check_type(np.dtype(native))

    def compute_encoded_size(self, input_byte_length: int, chunk_spec: Any) -> int:
        raise NotImplementedError("The size of a stream is not known before it is coded.")

    async def _encode_single(self, chunk_array: Any, chunk_spec: Any) -> Any:
        array = np.asarray(chunk_array.as_ndarray_like())
        stream = await asyncio.to_thread(_chunk.to_stream, array, self._options())
        return chunk_spec.prototype.buffer.from_bytes(stream)

    async def _decode_single(self, chunk_bytes: Any, chunk_spec: Any) -> Any:
        samples = await asyncio.to_thread(_chunk.from_stream, chunk_bytes.to_bytes())
        samples = samples.reshape(chunk_spec.shape)
        return chunk_spec.prototype.nd_buffer.from_ndarray_like(samples)

    def _options(self) -> Dict[str, Any]:
        return _chunk.configuration(self.bytes, self.psnr, self.max_error, self.nodata)
