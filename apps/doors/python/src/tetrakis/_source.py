# SPDX-License-Identifier: Apache-2.0
"""Where the bytes of a stream lie: memory, a file, or a server that answers requests for ranges."""

from __future__ import annotations

import os
import threading
from typing import Any, BinaryIO, Optional, Union

from . import _values as values
from ._errors import TksUsageError

BytesLike = Union[bytes, bytearray, memoryview]
Source = Union[str, "os.PathLike[str]", BytesLike, BinaryIO]

# Files are asked for no more at once: some make room for all that they are asked for.
_PART = 1 << 26


class Ranged:
    """Bytes that are read where they are needed. Any number of threads may read."""

    begin = 0
    """The place of the first one."""

    def read(self, offset: int, count: int) -> bytes:
        """`count` bytes from `offset` on; fewer only where the source ends."""
        raise NotImplementedError

    def size(self) -> Optional[int]:
        """How many bytes there are; None: nobody said."""
        return None

    def rest(self, offset: int) -> bytes:
        """All bytes from `offset` on."""
        parts = []
        while True:
            part = self.read(offset, _PART)
            parts.append(part)
            offset += len(part)
            if len(part) < _PART:
                return b"".join(parts)


class File(Ranged):
    """A file that can seek, such as one of fsspec. Who opened it closes it."""

    def __init__(self, file: Any) -> None:
        self._file = file
        self._start = file.tell()
        self._one_reads = threading.Lock()

    def read(self, offset: int, count: int) -> bytes:
        with self._one_reads:
            self._file.seek(self._start + offset)
            return _up_to(self._file, count)

    def size(self) -> Optional[int]:
        with self._one_reads:
            return max(0, self._file.seek(0, os.SEEK_END) - self._start)

    def __reduce__(self) -> Any:
        self._file.seek(self._start)
        return File, (self._file,)


class Path(File):
    """A file by its name; another process opens it again."""

    def __init__(self, path: Any) -> None:
        self._path = path
        try:
            file = open(path, "rb", buffering=0)
        except ValueError:
            raise TksUsageError(f"{values.told(path)} is no path of a file.") from None
        super().__init__(file)

    def __reduce__(self) -> Any:
        return Path, (self._path,)

    def __del__(self) -> None:
        if hasattr(self, "_file"):
            self._file.close()


class Remote(Ranged):
    """What fsspec knows by its address: `s3://`, `gs://`, `zip://` and others."""

    def __init__(self, url: str) -> None:
        try:
            import fsspec
        except ImportError:
            raise TksUsageError(
                f"{values.told(url)} takes the package fsspec, which is not installed; give a "
                "path, an http or https address, or a file that is open."
            ) from None
        self._url = url
        self._files, self._path = fsspec.core.url_to_fs(url)
        self._size = self._files.size(self._path)

    def read(self, offset: int, count: int) -> bytes:
        end = min(offset + count, self._size)
        if offset >= end:
            return b""
        part: bytes = self._files.cat_file(self._path, start=offset, end=end)
        return part

    def size(self) -> Optional[int]:
        size: int = self._size
        return size

    def __reduce__(self) -> Any:
        return Remote, (self._url,)


class Memory(Ranged):
    """Bytes that are there, to which more may come, and of which the first may be given up."""

    def __init__(self, data: BytesLike, begin: int = 0) -> None:
        self._data, self.begin = data, begin
        self._one_changes = threading.Lock()

    def read(self, offset: int, count: int) -> bytes:
        with self._one_changes:
            first = offset - self.begin
            if first < 0:
                raise TksUsageError("These bytes were given up.")
            return bytes(self._data[first : first + count])

    def size(self) -> Optional[int]:
        return self.begin + len(self._data)

    def append(self, data: BytesLike) -> None:
        with self._one_changes:
            if not isinstance(self._data, bytearray):
                self._data = bytearray(self._data)
            self._data += data

    def give_up(self, offset: int) -> None:
        """The bytes before it."""
        with self._one_changes:
            first = max(0, offset - self.begin)
            self._data = bytearray(self._data[first:])
            self.begin += first

    def __reduce__(self) -> Any:
        with self._one_changes:
            return Memory, (bytes(self._data), self.begin)


class Part(Ranged):
    """Some bytes of another source."""

    def __init__(self, whole: Ranged, offset: int, count: int) -> None:
        self._whole, self._offset, self._count = whole, offset, count

    def read(self, offset: int, count: int) -> bytes:
        count = min(count, self._count - offset)
        return self._whole.read(self._offset + offset, count) if count > 0 else b""

    def size(self) -> Optional[int]:
        return self._count


def anywhere(source: Source) -> Ranged:
    """By ranges where that is possible, else what there is of it."""
    parts = None if isinstance(source, (bytes, bytearray, memoryview)) else ranged(source)
    return Memory(first_bytes(source, None)) if parts is None else parts


def ranged(source: Any) -> Optional[Ranged]:
    """None where only a reading from front to end is possible, or the bytes are there already."""
    if isinstance(source, str) and "://" in source:
        if source.lower().startswith(("http://", "https://")):
            from ._http import Http

            return Http(source)
        return Remote(source)
    if isinstance(source, (str, os.PathLike)):
        path = Path(source)
        return path if path._file.seekable() else None
    seekable = getattr(source, "seekable", None)
    return File(source) if seekable is not None and seekable() else None


def first_bytes(source: Any, limit: Optional[int]) -> bytes:
    """Up to `limit` bytes. What could change under the decoder is copied."""
    count = None if limit is None else values.unsigned(limit, "bytes", 63)
    if isinstance(source, bytes):
        return source[:count]
    parts = ranged(source)
    if parts is not None:
        return parts.rest(0) if count is None else parts.read(0, count)
    if isinstance(source, (str, os.PathLike)):  # a pipe
        with open(source, "rb") as file:
            return _up_to(file, count)
    if hasattr(source, "read"):
        return _up_to(source, count)
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


def _up_to(file: Any, count: Optional[int]) -> bytes:
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
