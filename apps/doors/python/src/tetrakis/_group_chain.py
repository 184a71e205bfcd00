# SPDX-License-Identifier: Apache-2.0
"""Groups that go on from the ones before them. They decode in a tks_sequence that holds all groups
from their point of entry on."""

from __future__ import annotations

import ctypes
import threading
from contextlib import contextmanager
from typing import Any, Iterator, Optional

from . import _library as c
from . import _values as values
from ._access import Access
from ._decoder import Decoder, header_bytes
from ._errors import TksError
from ._groups import Group
from ._sequence_handle import SequenceHandle
from ._source import Ranged


class GroupChain:
    """Groups in a row, from a place in a source to the furthest one that was asked for."""

    def __init__(self, source: Ranged, limits: c.Limits, begin: int) -> None:
        self.source, self.limits, self.begin = source, limits, begin
        self.sequence = SequenceHandle(limits)
        self.one_decodes = threading.RLock()
        self._end = begin

    def reach(self, end: int) -> None:
        with self.one_decodes:
            data = self.source.read(self._end, max(0, end - self._end))
            self.sequence.append(data)
            self._end += len(data)


def chain_to(
    source: Ranged, limits: c.Limits, group: Group, end: int, before: Optional[GroupChain] = None
) -> GroupChain:
    """With all groups that a group goes on from, and of it what lies before `end`; the chain that
    was there before goes on, if it has the same point of entry. Where these groups are not there it
    has that group alone, of which the library says what it lacks."""
    begin = group.offset - group.bytes_back
    if begin >= source.begin:
        goes_on = before is not None and before.begin == begin
        chain = before if before and goes_on else GroupChain(source, limits, begin)
        try:
            chain.reach(end)
            return chain
        except TksError:
            pass
    alone = GroupChain(source, limits, group.offset)
    alone.reach(end)
    return alone


class _ChainDecoder(Decoder):
    """Belongs to its chain, and shows a group until another one is asked for."""

    def __init__(self, chain: GroupChain, group: Group, threads: int) -> None:
        self._chain = chain
        self._handle = ctypes.c_void_p()
        self._handle = chain.sequence.decoder(group.first_frame)
        self.check(c.lib.tks_set_threads(self._handle, threads))
        self.set_levels(0, 0)

    def close(self) -> None:
        self._handle = ctypes.c_void_p()


class ChainAccess(Access):
    """A group of a chain. Its bytes are there, and calls take turns."""

    def __init__(self, chain: GroupChain, group: Group, threads: int) -> None:
        self._chain, self._group = chain, group
        super().__init__(b"", None, chain.limits, threads)

    def _start(self) -> None:
        self._lock = threading.RLock()
        self._idle = []
        self._sound = None
        with self._taken() as decoder:
            self._header = decoder.info()

    def __getstate__(self) -> Any:
        return self._chain.source, self._limits, self._group, self._threads

    def __setstate__(self, state: Any) -> None:
        source, limits, group, threads = state
        ChainAccess.__init__(self, chain_to(source, limits, group, group.end), group, threads)

    def _cut(self, count: int) -> Decoder:
        source, group = self._chain.source, self._group
        count = min(values.unsigned(count, "bytes", 63), group.stream_bytes)
        front = source.read(group.stream_offset, count)
        if header_bytes(front) > len(front):
            return Decoder(front, self._limits)  # raises
        chain = chain_to(source, self._limits, group, group.stream_offset + count)
        return _ChainDecoder(chain, group, self._threads)

    @contextmanager
    def _taken(self) -> Iterator[Decoder]:
        self._bytes()
        with self._chain.one_decodes:
            with _ChainDecoder(self._chain, self._group, self._threads) as decoder:
                yield decoder
