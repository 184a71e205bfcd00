# SPDX-License-Identifier: Apache-2.0
"""Functions with the names and arguments that the codecs of imagecodecs have."""

from __future__ import annotations

import builtins
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _values as values
from ._encode import encode
from ._errors import TksUsageError
from ._stream import BytesLike, open
from ._version import __version__

# The first bytes of every stream.
SIGNATURE = b"TKS\x1a"


def tks_version() -> str:
    """Name and version: "tetrakis 0.1.0"."""
    return f"tetrakis {__version__}"


def tks_check(data: BytesLike) -> bool:
    """Whether the bytes begin as a stream does."""
    return builtins.bytes(memoryview(data)[: len(SIGNATURE)]) == SIGNATURE


def tks_encode(
    data: ArrayLike,
    /,
    level: Optional[float] = None,
    *,
    numthreads: Optional[int] = None,
    out: Any = None,
    **options: Any,
) -> builtins.bytes:
    """Codes (rows, columns) as heights and (rows, columns, channels) as a texture.

    level: PSNR in dB; without it and without a target among the options: lossless.
    options: those of :func:`tetrakis.encode`.
    out: a writable buffer that takes the stream; the result is then a memoryview of its beginning.
    """
    array = data if isinstance(data, np.ma.MaskedArray) else np.asarray(data)
    if level is not None:
        if options.get("psnr") is not None:
            raise TksUsageError("level is the PSNR: give one of them.")
        options["psnr"] = level
    heights, texture = (None, array) if array.ndim == 3 else (array, None)
    stream = encode(heights, texture, threads=numthreads or 1, **options)
    if out is None:
        return stream
    room = memoryview(out).cast("B")
    if room.readonly or len(room) < len(stream):
        raise TksUsageError(f"out must be writable and hold {len(stream)} bytes.")
    room[: len(stream)] = stream
    return room[: len(stream)]


def tks_decode(
    data: BytesLike,
    /,
    *,
    level: int = 0,
    window: Optional[values.WindowLike] = None,
    masked: bool = False,
    numthreads: Optional[int] = None,
    out: Optional[NDArray[Any]] = None,
) -> NDArray[Any]:
    """The heights, (rows, columns); of a stream without heights the texture. Arguments are those of
    :meth:`tetrakis.Stream.heights`."""
    with open(data, threads=numthreads or 1) as stream:
        if stream.info.shape is not None:
            return stream.heights(level, window, masked=masked, out=out)
        return stream.texture(level, window, out=out)
