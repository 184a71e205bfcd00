# SPDX-License-Identifier: Apache-2.0
"""The bytes of a stream, wherever they lie."""

from __future__ import annotations

import os
from typing import Any, BinaryIO, Optional, Union

from . import _values as values
from ._errors import TksUsageError

BytesLike = Union[bytes, bytearray, memoryview]
Source = Union[str, "os.PathLike[str]", BytesLike, BinaryIO]

# Files are asked for no more at once: some make room for all that they are asked for.
_PART = 1 << 26


def first_bytes(source: Any, limit: Optional[int]) -> bytes:
    """Up to `limit` bytes. What could change under the decoder is copied."""
    count = None if limit is None else values.unsigned(limit, "bytes", 63)
    if isinstance(source, (str, os.PathLike)):
        with _opened(source) as file:
            return _of_file(file, count)
    if hasattr(source, "read"):
        return _of_file(source, count)
    if isinstance(source, bytes):
        return source[:count]
    return octets(source)[:count].tobytes()


def octets(data: BytesLike) -> memoryview:
    """The bytes of a buffer in a row, copied only if they do not lie so."""
    try:
        view = memoryview(data)
    except (TypeError, ValueError):  # of NumPy's dates, say
        kind = type(data).__name__
        raise TksUsageError(f"A stream is a path, bytes or a file, not {kind}.") from None
    plain = view.format == "B" and view.ndim == 1 and view.c_contiguous
    return view if plain else memoryview(view.tobytes())


def _opened(path: Any) -> BinaryIO:
    try:
        return open(path, "rb")
    except ValueError:
        raise TksUsageError(f"{values.told(path)} is no path of a file.") from None


def _of_file(file: Any, count: Optional[int]) -> bytes:
    """Files without a buffer may give less than they are asked for."""
    parts = []
    while count != 0:
        part = file.read(-1 if count is None else min(count, _PART))
        if not isinstance(part, bytes):
            raise TksUsageError("The file must be open for reading bytes (mode 'rb').")
        if not part:
            break
        parts.append(part)
        count = None if count is None else count - len(part)
    return b"".join(parts)
