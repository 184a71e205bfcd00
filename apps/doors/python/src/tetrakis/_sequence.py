# SPDX-License-Identifier: Apache-2.0
"""From a sequence to frames, and to arrays with a time axis."""

from __future__ import annotations

import ctypes
import math
import threading
from collections import OrderedDict
from typing import Any, Iterator, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _values as values
from ._access import Access, access_by_ranges
from ._clock import Clock
from ._errors import TksCorruptError, TksUnsupportedError, TksUsageError
from ._frame_access import FrameAccess
from ._group_chain import ChainAccess, GroupChain, chain_to
from ._groups import Group, Groups
from ._indexing import for_each_axis
from ._info import Info
from ._sequence_handle import SequenceHandle
from ._source import BytesLike, Memory, Part, Ranged, Source, anywhere, octets
from ._stream import Stream

# Groups whose decoders stay: of calls that go to and fro between two.
_OPEN = 2


def open_sequence(
    source: Source,
    *,
    threads: int = 1,
    max_samples: Optional[int] = None,
    max_texels: Optional[int] = None,
    max_memory: Optional[int] = None,
) -> "Sequence":
    """Opens a sequence, any prefix of one, or a stream of one or several frames.

    The arguments are those of :func:`tetrakis.open`. Files and addresses are read by ranges: a
    frame takes the bytes of its group, which the index at the end of the source finds in three
    requests. Bytes in memory may grow by :meth:`Sequence.append`; there may be none at first.
    """
    limits = c.Limits(
        size=ctypes.sizeof(c.Limits),
        max_samples=values.unsigned(max_samples, "max_samples", 64),
        max_texels=values.unsigned(max_texels, "max_texels", 64),
        max_memory=values.unsigned(max_memory, "max_memory", 64),
    )
    return Sequence(anywhere(source), limits, values.unsigned(threads, "threads"))


class Sequence:
    """Frames of heights, textures or both. Made by :func:`tetrakis.open_sequence`; closes with
    ``with`` or :meth:`close`.

    It is an array, (time, rows, columns) of the heights, or of the texture where there are none:
    ``sequence.shape``, ``sequence[5]``, ``sequence[::10, 0:64, 0:64]``,
    ``numpy.asarray(sequence)``; a `for` goes from frame to frame. The first call for a frame
    decodes all of its group, which stays until two other groups were asked for. A group that goes
    on from others takes all groups from their point of entry on, once if frames are asked for in
    their order. Any number of threads may use a sequence; in such groups they take turns.
    """

    def __init__(self, source: Ranged, limits: c.Limits, threads: int) -> None:
        self._given: Optional[Tuple[Ranged, c.Limits, int]] = (source, limits, threads)
        self._groups = Groups(source, limits)
        self._opened: "OrderedDict[int, Access]" = OrderedDict()
        self._chain: Optional[GroupChain] = None
        self._lock = threading.RLock()
        self._like: Optional[Info] = None

    def __enter__(self) -> "Sequence":
        self._source()
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __reduce__(self) -> Any:
        self._source()
        return Sequence, self._given

    def __repr__(self) -> str:
        if self._given is None:
            return "<tetrakis.Sequence, closed>"
        size = " x ".join(map(str, self.shape))
        return f"<tetrakis.Sequence: {size} {self.dtype if len(self) else 'frames'}>"

    def close(self) -> None:
        """Lets go of the bytes. Frames that were handed out stay open."""
        with self._lock:
            self._given = self._chain = None
            self._opened.clear()

    @property
    def closed(self) -> bool:
        return self._given is None

    @property
    def clock(self) -> Clock:
        """What a tick is, and when tick 0 is."""
        return self._groups.clock

    @property
    def info(self) -> Info:
        """What the first group says of itself, and so of all frames: its sizes, types and place."""
        with self._lock:
            if self._like is None:
                self._like = self.frame(self.first_frame).info
            return self._like

    @property
    def is_moving(self) -> bool:
        """False of a stream of one frame, which :func:`tetrakis.open` opens as well."""
        return self._groups.is_chain or len(self) > 1

    @property
    def first_frame(self) -> int:
        """The number of the first frame that is there: 0, unless groups were cut off or
        forgotten."""
        return self._groups.first_frame

    def __len__(self) -> int:
        return self._groups.end_frame - self._groups.first_frame

    @property
    def shape(self) -> Tuple[int, ...]:
        """(time, rows, columns) of the heights; of a sequence without heights that of the
        texture."""
        info = self.info if len(self) else None
        return (len(self), *((info.shape or info.texture_shape or ()) if info else ()))

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of the samples that have `shape`."""
        return self.info.dtype or self.info.texture_dtype or np.dtype("u1")

    @property
    def ndim(self) -> int:
        """3, or 4 for textures of several channels without heights."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """How many samples there are."""
        return math.prod(self.shape)

    @property
    def ticks(self) -> NDArray[np.int64]:
        """The times of all frames in ticks of the clock. Reads the heads of all groups."""
        with self._lock:
            times = [group.times for group in self._groups.all()]
        ticks = np.concatenate(times) if times else np.empty(0, np.int64)
        if len(ticks) != len(self):
            raise TksUnsupportedError("Frames were cut out of the sequence, and have no times.")
        return ticks

    @property
    def times(self) -> NDArray[Any]:
        """Likewise as datetime64 in UTC, where the clock has an epoch in the calendar of everyday
        life, else as ticks."""
        dates = self.clock.dates(self.ticks)
        return self.ticks if dates is None else dates

    def frame(self, number: int) -> Stream:
        """A frame by its number, which does not change where groups are forgotten, as an open
        stream: `heights`, `texture`, `mesh` and all else are those of this frame; `info` and
        `bytes=` are about its group. Raises :class:`TksUsageError` if it is not there."""
        with self._lock:
            group = self._groups.of_frame(values.unsigned(number, "A frame", 64))
        return Stream(FrameAccess(self._access(group), number - group.first_frame))

    def find(self, time: Any) -> int:
        """The number of the last frame that is not after a time, which is a number of ticks or a
        date; the first one if all are."""
        if not len(self):
            raise TksUsageError("The sequence has no frames.")
        tick = self.clock.floor(time)
        with self._lock:
            group = self._groups.of_time(tick)
        return group.first_frame + max(0, int(np.searchsorted(group.times, tick, "right")) - 1)

    def at(self, time: Any) -> Stream:
        """The frame that :meth:`find` finds."""
        return self.frame(self.find(time))

    def frames(self) -> Iterator[Stream]:
        """All frames, one after the other, as :meth:`frame` gives them. Decoders of groups that lie
        behind are dropped."""
        number = self.first_frame
        while number < self._groups.end_frame:
            yield self.frame(number)
            number += 1

    def __iter__(self) -> Iterator[NDArray[Any]]:
        return (frame[...] for frame in self.frames())

    def __getitem__(self, key: Any) -> Any:
        """What ``numpy.asarray(sequence)[key]`` gives, for integers and slices: decodes windows of
        these frames."""
        return self.read("heights" if self.info.shape is not None else "texture", key)

    def read(self, component: str, key: Any, level: int = 0) -> Any:
        """The samples that an index of integers and slices, the first one of frames, selects of
        "heights" or "texture"."""
        values.choice(component, ("heights", "texture"), "component")
        info, of_texture = self.info, component == "texture"
        shape = (info.texture_shape if of_texture else info.shape) or (0, 0)
        which, *inside = for_each_axis(key if isinstance(key, tuple) else (key,), 1 + len(shape))
        if not isinstance(which, slice):
            place = range(len(self))[which]  # raises IndexError
            return self.frame(self.first_frame + place).read(component, tuple(inside), level)
        places = range(self.first_frame, self.first_frame + len(self))[which]
        if not places:
            dtype = info.texture_dtype if of_texture else info.dtype
            return np.empty((0, *shape), dtype)[(slice(None), *inside)]
        return self._stacked(component, places, tuple(inside), level)

    def _stacked(self, component: str, places: range, inside: Any, level: int) -> NDArray[Any]:
        stack: Optional[NDArray[Any]] = None
        for i, place in enumerate(places):
            samples = self.frame(place).read(component, inside, level)
            if stack is None:
                stack = np.empty((len(places), *np.shape(samples)), samples.dtype)
            stack[i] = samples
        assert stack is not None
        return stack

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        if copy is False:
            raise ValueError("An array of a sequence is decoded, hence new: copy=False has none.")
        samples: NDArray[Any] = self[...]
        return samples if dtype is None else samples.astype(dtype, copy=False)

    def append(self, data: BytesLike) -> None:
        """Takes bytes that follow those that are there, of a sequence that was opened on bytes in
        memory; frames of a group can be decoded once the header of its stream has come, and better
        the more of it has."""
        with self._lock:
            source = self._memory()
            source.append(octets(data))
            self._groups.go_on()
            last = self._groups.last_offset
            self._opened.pop(last, None)  # there may be more of it now

    def forget(self, number: int) -> None:
        """Gives up the bytes of all groups that end before a frame, but for the last one and those
        that the next one goes on from, and these frames: a player of a live sequence takes no more
        memory however long that is."""
        with self._lock:
            source = self._memory()
            source.give_up(self._groups.forget(values.unsigned(number, "A frame", 64)))
            self._opened.clear()
            if self._chain is not None and self._chain.begin < source.begin:
                self._chain = None

    def thinned(self, bytes_a_frame: int) -> bytes:
        """The sequence for a thinner channel: of each whole group at most so many bytes a frame,
        though never less than its header and what the next group goes on from. Frames show what
        the bytes that are left say of them. Raises :class:`TksUsageError` where groups were cut
        out or forgotten, or there is no whole one."""
        with self._lock:
            source = self._source()
        with SequenceHandle() as whole:
            whole.append_all(source)
            return whole.thinned(values.unsigned(bytes_a_frame, "bytes_a_frame", 64))

    def _memory(self) -> Memory:
        source = self._source()
        if not isinstance(source, Memory) or not self._groups.is_chain:
            raise TksUsageError("Only sequences in memory can grow and forget: open them on bytes.")
        return source

    def _source(self) -> Ranged:
        if self._given is None:
            raise TksUsageError("The sequence is closed.")
        return self._given[0]

    def _access(self, group: Group) -> Access:
        with self._lock:
            self._source()
            opened = self._opened.pop(group.offset, None)
            if opened is None:
                opened = self._made(group)
                self._check(opened.info(), group)
            self._opened[group.offset] = opened
            while len(self._opened) > _OPEN:
                self._opened.popitem(last=False)
            return opened

    def _made(self, group: Group) -> Access:
        assert self._given is not None
        source, limits, threads = self._given
        if group.depth == 0:
            part = Part(source, group.stream_offset, group.stream_bytes)
            return access_by_ranges(part, limits, threads)
        self._chain = chain_to(source, limits, group, group.end, self._chain)
        return ChainAccess(self._chain, group, threads)

    def _check(self, info: Info, group: Group) -> None:
        if info.frames != len(group.times):
            raise TksCorruptError("Corrupt sequence: a group has other frames than its head says.")
        like = info if self._like is None else self._like
        for name in ("shape", "dtype", "texture_shape", "texture_dtype"):
            if getattr(info, name) != getattr(like, name):
                raise TksUnsupportedError(
                    f"The frames of the sequence are not alike: from frame {group.first_frame} on "
                    "they have another size or type."
                )
