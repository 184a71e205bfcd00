# SPDX-License-Identifier: Apache-2.0
"""Decoders over the bytes of one stream, wherever these lie.

A stream with an index that can be read by ranges is: a window or a level fetches the packets that
it needs. Any other is read from front to end, once. A decoder takes the stream's packets apart when
it is made, so those that no call uses are kept for the next call.
"""

from __future__ import annotations

import builtins
import threading
from contextlib import contextmanager
from typing import Any, Iterator, List, Optional, Tuple

from . import _components as components
from . import _library as c
from . import _values as values
from ._decoder import Decoder, header_bytes
from ._errors import TksCorruptError, TksUnsupportedError, TksUsageError
from ._info import Info
from ._source import Ranged, first_bytes, ranged

# The first request: most headers, and the whole of small streams.
_FIRST = 1 << 16
# Bytes between two ranges that cost less than a request of their own.
_GAP = 1 << 14
# Decoders that wait for a call: as many as threads often call side by side.
_IDLE = 4
_SEQUENCE = b"TKG\x1a"

Need = Tuple[int, Optional[c.Window]]


class Access:
    """`data` is the beginning of the stream; `source` has the rest, None where there is none.
    Decoders take the `chosen` components."""

    def __init__(
        self,
        data: builtins.bytes,
        source: Optional[Ranged],
        limits: c.Limits,
        threads: int,
        chosen: components.Chosen = (),
    ) -> None:
        self._data: Optional[builtins.bytes] = data
        self._source = source
        self._limits = limits
        self._threads = threads
        self._chosen = chosen
        self._start()

    def _start(self) -> None:
        self._lock = threading.RLock()
        self._idle: List[Decoder] = []
        self._sound: Optional[bool] = None
        if self._bytes()[: len(_SEQUENCE)] == _SEQUENCE:
            raise TksUnsupportedError("This is a sequence of frames: open_sequence() opens it.")
        with self._made() as decoder:
            self._header = decoder.info()
        if self._source is not None and not self._header.index:
            self._read_all()  # nothing tells where its packets lie
            if self._header.shows_sketch:
                with self._made() as decoder:
                    self._header = decoder.info()

    def __getstate__(self) -> Any:
        return self._data, self._source, self._limits, self._threads, self._chosen

    def __setstate__(self, state: Any) -> None:
        self._data, self._source, self._limits, self._threads, self._chosen = state
        self._start()

    def close(self) -> None:
        with self._lock:
            self._data = self._source = None
            self._drop_idle()

    @property
    def closed(self) -> bool:
        return self._data is None

    def info(self) -> Info:
        """By what has been read so far."""
        self._bytes()
        return self._header

    @contextmanager
    def glance(self, count: Optional[int]) -> Iterator[Decoder]:
        """A decoder of the first `count` bytes, or of those that have been read, damaged or not:
        for what the stream says of itself."""
        if count is None:
            with self._taken() as decoder:
                yield decoder
            return
        with self._cut(count) as decoder:
            yield decoder

    @contextmanager
    def whole(self) -> Iterator[Decoder]:
        """A decoder of all bytes, damaged or not."""
        self._read_all()
        with self._taken() as decoder:
            yield decoder

    @contextmanager
    def prefix(self, count: Optional[int]) -> Iterator[Decoder]:
        """A decoder of the first `count` bytes, or of all, unless their checksum refuses them."""
        self._bytes()
        if count is not None and values.unsigned(count, "bytes", 63) < self._header.stream_bytes:
            with self.glance(count) as decoder:
                yield decoder
            return
        with self.whole() as decoder:
            self._check(decoder)
            yield decoder

    @contextmanager
    def part(self, levels: Tuple[int, int], needs: List[Need]) -> Iterator[Decoder]:
        """A decoder that gives windows and levels as one of the whole stream would."""
        if self._source is None:
            with self.prefix(None) as decoder:
                decoder.set_levels(*levels)
                yield decoder
            return
        with self._taken() as decoder:
            decoder.set_levels(*levels)
            if all(self._fetch(decoder, part, window) for part, window in needs):
                yield decoder
                return
        self._read_all()  # the file ends before its index does
        with self.part(levels, needs) as decoder:
            yield decoder

    def _bytes(self) -> builtins.bytes:
        data = self._data
        if data is None:
            raise TksUsageError("The stream is closed.")
        return data

    def _cut(self, count: int) -> Decoder:
        """Of the first bytes."""
        data = self._front(values.unsigned(count, "bytes", 63))
        return Decoder(data, self._limits, self._threads, self._chosen)

    def _front(self, count: int) -> builtins.bytes:
        """The first bytes, of which more than were read are read now."""
        data, source = self._bytes(), self._source
        if count > len(data) and source is not None:
            return data + source.read(len(data), count - len(data))
        return data[:count]

    def _read_all(self) -> None:
        data, source = self._bytes(), self._source
        if source is None:
            return
        rest = max(0, self._header.stream_bytes - len(data))
        data += source.read(len(data), rest)
        with self._lock:
            if self._source is None:  # another thread was first, or the stream is closed
                return
            self._data, self._source = data, None
            self._drop_idle()
            with self._made() as decoder:
                self._header = decoder.info()

    def _check(self, decoder: Decoder) -> None:
        """Complete streams that promise something have a checksum, which is looked at once."""
        with self._lock:
            if self._sound is None:
                promised = self._header.lossless or self._header.max_error is not None
                complete = self._header.available_bytes >= self._header.stream_bytes
                try:
                    if promised and complete:
                        decoder.verify()
                    self._sound = True
                except TksCorruptError:
                    self._sound = False
            if not self._sound:
                decoder.verify()

    def _fetch(self, decoder: Decoder, part: int, window: Optional[c.Window]) -> bool:
        """Whether the index, of which pages may lie behind the stream, is there."""
        source = self._source
        if source is None:
            raise TksUsageError("The stream is closed.")
        while True:
            wanted = _joined(decoder.missing(part, window))
            pieces = [(offset, source.read(offset, count)) for offset, count in wanted]
            decoder.put(pieces)
            ends = [offset + count for offset, count in wanted]
            if not ends or ends[-1] <= self._header.stream_bytes:
                return True
            if sum(pieces[-1][:1]) + len(pieces[-1][1]) < ends[-1]:
                return False

    def _made(self) -> Decoder:
        return Decoder(self._bytes(), self._limits, self._threads, self._chosen)

    @contextmanager
    def _taken(self) -> Iterator[Decoder]:
        """One that waits, or a new one; it waits again once its call has gone well."""
        with self._lock:
            data = self._bytes()
            decoder = self._idle.pop() if self._idle else self._made()
        try:
            yield decoder
            decoder.set_levels(0, 0)
            decoder.set_frame(0)
        except BaseException:
            decoder.close()
            raise
        with self._lock:
            if data is self._data and len(self._idle) < _IDLE:
                self._idle.append(decoder)
                return
        decoder.close()

    def _drop_idle(self) -> None:
        for decoder in self._idle:
            decoder.close()
        self._idle = []


def _joined(ranges: List[Tuple[int, int]]) -> List[Tuple[int, int]]:
    """(offset, count) in order; those that nearly touch are one."""
    joined: List[Tuple[int, int]] = []
    for offset, count in sorted(ranges):
        if joined and offset - sum(joined[-1]) <= _GAP:
            start, held = joined[-1]
            joined[-1] = (start, max(held, offset + count - start))
        else:
            joined.append((offset, count))
    return joined


def access(
    source: Any,
    limit: Optional[int],
    limits: c.Limits,
    threads: int,
    chosen: components.Chosen = (),
) -> Access:
    """Reads the header, and more only of what cannot be read by ranges."""
    parts = None if limit is not None or isinstance(source, bytes) else ranged(source)
    if parts is None:
        return Access(first_bytes(source, limit), None, limits, threads, chosen)
    return access_by_ranges(parts, limits, threads, chosen)


def access_by_ranges(
    parts: Ranged, limits: c.Limits, threads: int, chosen: components.Chosen = ()
) -> Access:
    data = parts.read(0, _FIRST)
    if len(data) < _FIRST:
        return Access(data, None, limits, threads, chosen)
    needed = header_bytes(data)
    while needed > len(data):
        more = parts.read(len(data), needed - len(data))
        if not more:
            break
        data += more
        needed = header_bytes(data)
    return Access(data, parts, limits, threads, chosen)
