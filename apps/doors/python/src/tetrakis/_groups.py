# SPDX-License-Identifier: Apache-2.0
"""The groups of a sequence: which frames they have, when these are, and where their bytes lie.

A group is found from the index at the end of the source, or, where there is none, by passing from
head to head. Nothing else of a group is read here.
"""

from __future__ import annotations

import bisect
import ctypes
from typing import Callable, Dict, Iterator, List, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _sequence_library as s
from ._access import access_by_ranges
from ._clock import Clock, from_struct
from ._errors import Status, TksCorruptError, TksError, TksUsageError, error
from ._sequence_handle import SequenceHandle
from ._source import Memory, Ranged

# Enough for most heads, with the header of the stream behind it.
_HEAD = 4096
# The index of the last group, of most files.
_TAIL = 1 << 16
_LATEST = 2**61
# An index leads to the group, or to another index that does.
_STEPS = 3
_STREAM = b"TKS\x1a"


class Group(NamedTuple):
    first_frame: int
    times: NDArray[np.int64]
    offset: int
    bytes: int
    stream_offset: int
    stream_bytes: int
    depth: int = 0
    bytes_back: int = 0

    @property
    def end_frame(self) -> int:
        return self.first_frame + len(self.times)

    @property
    def end(self) -> int:
        return self.offset + self.bytes


class _Heads(SequenceHandle):
    """It is given the beginnings of groups alone."""

    def give(self, data: bytes) -> s.SequenceInfo:
        try:
            self.append(data)
        except TksError:
            if self.info().groups == 0:  # else it is told when the place behind a group is read
                raise
        return self.info()

    def groups(self, info: s.SequenceInfo, begin: int) -> Iterator[Group]:
        """Those of bytes that begin at this place, up to frames that were cut out."""
        frame = info.first_frame
        while info.groups and (raw := self.group(frame)) is not None:
            frames = range(raw.first_frame, raw.first_frame + raw.frames)
            times = np.array([self.time(each) for each in frames], np.int64)
            places = (begin + raw.offset, raw.bytes, begin + raw.stream_offset, raw.stream_bytes)
            yield Group(raw.first_frame, times, *places, raw.depth, raw.bytes_back)
            frame = frames.stop


def _check(status: int, sentence: str) -> None:
    if status != Status.OK:
        raise error(status, sentence)


class Groups:
    """Of a source, which may also be a single stream of several frames."""

    def __init__(self, source: Ranged, limits: c.Limits) -> None:
        self._source, self._limits = source, limits
        self.clock = Clock()
        self._listed: List[Group] = []  # one behind the other, up to the end
        self._lists_all = False
        self._found: Dict[int, Group] = {}  # others, by their first frames
        self._tail: Optional[bytes] = None
        data = source.read(source.begin, _HEAD)
        self.is_chain = data[: len(_STREAM)] != _STREAM
        if self.is_chain:
            self._begin()
        else:
            self._take_stream()

    def _begin(self) -> None:
        """By the index, unless all is there, or there is none."""
        self._first = self._at(self._source.begin)[:1]
        by_index = not isinstance(self._source, Memory)
        last = self._located(False, _LATEST) if self._first and by_index else None
        self._lists_all = last is None
        self._listed = [*self._first] if last is None else [last]
        self.go_on()

    def _take_stream(self) -> None:
        with access_by_ranges(self._source, self._limits, 1).glance(None) as decoder:
            info = decoder.info()
        times = np.arange(info.frames, dtype=np.int64)
        self._listed = [Group(0, times, 0, info.stream_bytes, 0, info.stream_bytes)]
        self._first, self._lists_all = self._listed, True

    def go_on(self) -> None:
        """To the end of what there is now."""
        if not self.is_chain:
            return
        for group in self._from(self._listed[-1].end if self._listed else self._source.begin):
            self._follow(self._listed[-1] if self._listed else None, group)
            self._listed.append(group)
        self._first = self._first or self._listed[:1]

    def forget(self, frame: int) -> int:
        """The groups that end before a frame, but for the last one and those that the first one
        of the others goes on from. Returns where the groups begin that stay."""
        first = 0
        while first + 1 < len(self._listed) and self._listed[first].end_frame <= frame:
            first += 1
        if self._listed:
            del self._listed[: max(0, first - self._listed[first].depth)]
        self._first = self._listed[:1]
        return self._listed[0].offset if self._listed else 0

    @property
    def first_frame(self) -> int:
        return self._first[0].first_frame if self._first else 0

    @property
    def end_frame(self) -> int:
        return self._listed[-1].end_frame if self._listed else 0

    @property
    def last_offset(self) -> int:
        return self._listed[-1].offset if self._listed else 0

    def all(self) -> List[Group]:
        """Reads all heads."""
        if not self._lists_all:
            before: List[Group] = []
            for group in self._from(self._first[0].offset):
                if group.offset >= self._listed[0].offset:
                    break
                self._follow(before[-1] if before else None, group)
                before.append(group)
            self._listed, self._lists_all = before + self._listed, True
            self._found = {}
        return self._listed

    def of_frame(self, frame: int) -> Group:
        def holds(group: Group) -> bool:
            return group.first_frame <= frame < group.end_frame

        at = bisect.bisect_right([group.first_frame for group in self._listed], frame) - 1
        known = [self._listed[at]] if at >= 0 else list(self._found.values())
        for group in known:
            if holds(group):
                return group
        if at < 0 and not self._lists_all and frame >= self.first_frame:
            return self._search(False, frame, holds)
        raise TksUsageError(f"The sequence has no frame {frame}.")

    def of_time(self, time: int) -> Group:
        """The group of the last frame that is not after a time; the first one if all are."""
        at = bisect.bisect_right([int(group.times[0]) for group in self._listed], time) - 1
        if at >= 0:
            return self._listed[at]
        if self._lists_all or time < self._first[0].times[0]:
            return self._first[0]
        for group in self._found.values():
            if group.times[0] <= time <= group.times[-1]:
                return group
        return self._search(True, time, lambda group: group.times[0] <= time)

    def _search(self, by_time: bool, place: int, fits: Callable[[Group], bool]) -> Group:
        group = self._located(by_time, place)
        if group is None or not fits(group):
            raise TksCorruptError("Corrupt sequence: its index leads to another group.")
        self._found[group.first_frame] = group
        return group

    def _located(self, by_time: bool, place: int) -> Optional[Group]:
        """By the index at the end of the source, in two more requests at most; None without one."""
        end = self._source.size()
        if end is None:
            return None
        if self._tail is None:
            self._tail = self._source.read(max(0, end - _TAIL), _TAIL)
        tail, found, where = self._tail, ctypes.c_int(), c.Range()
        end = max(0, end - _TAIL) + len(tail)
        for _ in range(_STEPS):
            status = c.lib.tks_sequence_locate(tail, len(tail), end, by_time, place, where, found)
            if status == Status.USAGE:
                return None
            _check(status, "Corrupt sequence: its index lists more than there is.")
            if found.value:
                return next(iter(self._at(where.offset)), None)
            tail = self._source.read(where.offset, where.size)
            end = where.offset + len(tail)
        return None

    def _from(self, offset: int) -> Iterator[Group]:
        groups = self._at(offset)
        while groups:
            yield from groups
            groups = self._at(groups[-1].end)

    def _at(self, offset: int) -> List[Group]:
        """The group that begins there, and those behind it that were read with it; none where the
        source ends."""
        size = _HEAD
        while True:
            data = self._source.read(offset, size)
            with _Heads(self._limits) as heads:
                info = heads.give(data)
                groups = list(heads.groups(info, offset))
                if groups and self.clock == Clock():
                    self.clock = from_struct(info.clock)
            if groups or len(data) < size:
                return groups
            size *= 4

    def _follow(self, before: Optional[Group], group: Group) -> None:
        if before is None:
            return
        if group.first_frame < before.end_frame or group.times[0] <= before.times[-1]:
            raise TksCorruptError(
                f"Corrupt sequence: the group of frame {group.first_frame} does not follow the one "
                "before it."
            )
