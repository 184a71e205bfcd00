# SPDX-License-Identifier: Apache-2.0
"""Functions with the names and arguments that the codecs of imagecodecs have."""

from __future__ import annotations

import builtins
import numbers
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _values as values
from ._encode import encode
from ._errors import TksUsageError
from ._source import BytesLike, octets
from ._stream import open
from ._version import __version__

# The first bytes of every stream.
SIGNATURE = b"TKS\x1a"


def tks_version() -> str:
    """Name and version: "tetrakis 0.1.0"."""
    return f"tetrakis {__version__}"


def tks_check(data: BytesLike) -> bool:
    """Whether the bytes begin as a stream does."""
    return octets(data)[: len(SIGNATURE)] == SIGNATURE


def tks_encode(
    data: ArrayLike,
    /,
    level: Optional[float] = None,
    *,
    numthreads: Optional[int] = None,
    out: Any = None,
    **options: Any,
) -> Union[builtins.bytes, memoryview]:
    """Codes (rows, columns) as heights and (rows, columns, channels) as a texture.

    level: PSNR in dB; without it and without a target among the options: lossless.
    options: those of :func:`tetrakis.encode`.
    out: how many bytes the stream may take at most, or a writable buffer that takes it; the result
        is then a memoryview of its beginning.
    """
    array = data if isinstance(data, np.ma.MaskedArray) else values.array(data, "data")
    for name, value, ours in (("level", level, "psnr"), ("numthreads", numthreads, "threads")):
        if value is None:
            continue
        if options.get(ours) is not None:
            raise TksUsageError(f"{name} is the same as {ours}: give one of them.")
        options[ours] = value
    heights, texture = (None, array) if array.ndim == 3 else (array, None)
    stream = encode(heights, texture, **options)
    return stream if out is None else _written(stream, out)


def _written(stream: builtins.bytes, out: Any) -> Union[builtins.bytes, memoryview]:
    if isinstance(out, numbers.Integral):
        _check_room(len(stream), values.unsigned(out, "out", 63))
        return stream
    try:
        room = memoryview(out).cast("B")
    except (TypeError, ValueError):
        room = memoryview(b"")
    if room.readonly:
        raise TksUsageError(
            "out must be a number of bytes or a writable buffer in C order, "
            f"not {values.told(out)}."
        )
    _check_room(len(stream), len(room))
    room[: len(stream)] = stream
    return room[: len(stream)]


def _check_room(needed: int, given: int) -> None:
    if needed > given:
        raise TksUsageError(f"out must have {needed} bytes or more, not {given}.")


def tks_decode(
    data: BytesLike,
    /,
    *,
    level: int = 0,
    window: Optional[values.WindowLike] = None,
    masked: bool = False,
    numthreads: Optional[int] = None,
    out: Union[NDArray[Any], int, None] = None,
) -> NDArray[Any]:
    """The heights, (rows, columns); of a stream without heights the texture. Arguments are those of
    :meth:`tetrakis.Stream.heights`; out may also be how many bytes the array may take at most.
    Raises :class:`TksCorruptError` for a complete stream with a checksum that it does not have."""
    if isinstance(out, numbers.Integral):
        most = values.unsigned(out, "out", 63)
        array = tks_decode(data, level=level, window=window, masked=masked, numthreads=numthreads)
        _check_room(array.nbytes, most)
        return array
    with open(data, threads=1 if numthreads is None else numthreads) as stream:
        if stream.info.shape is not None:
            return stream.heights(level, window, masked=masked, out=out)
        return stream.texture(level, window, out=out)
