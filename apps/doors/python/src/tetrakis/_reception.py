# SPDX-License-Identifier: Apache-2.0
"""From what `tetrakis serve` serves to frames, as they come."""

from __future__ import annotations

import ctypes
import re
import threading
import time
from dataclasses import dataclass
from typing import Any, Iterator, Optional, Sequence, Tuple, Union

import numpy as np

from . import _library as c
from . import _receiver_library as r
from . import _values as values
from ._clock import Clock, from_struct
from ._control_url import ControlFailure, ControlUrl
from ._errors import TksCorruptError, TksUnsupportedError, TksUsageError
from ._receiver_handle import ReceivedFrame, ReceiverHandle
from ._stream import Stream

# Seconds behind the first failure of several, and the most; and between messages where nothing
# comes and the server does not wait itself.
_FIRST_REST, _MOST_REST = 0.1, 2.0
# So many damaged answers one behind the other are not of what came before.
_MOST_DAMAGED = 2
_CHANNEL = re.compile(r"\s*([0-9.]+)\s*([kMG]?)(?:b|bit)?/s\s*")
_FACTORS = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}

ViewLike = Tuple[Sequence[float], int, int]


@dataclass(frozen=True)
class TimedFrame:
    """A frame that came."""

    number: int
    tick: int
    """Its time, in ticks of the clock."""
    time: Any
    """Likewise as datetime64 in UTC, where the clock has an epoch in the calendar of everyday life,
    else as ticks."""
    stream: Stream
    """What :func:`tetrakis.open` gives, of the bytes that came: `heights`, `texture`, `mesh`. It is
    there while the reception keeps the frame."""


def receive(
    url: str,
    *,
    live: bool = False,
    frame: int = 0,
    channel: Union[float, str, None] = None,
    triangles: Optional[int] = None,
    view: Optional[ViewLike] = None,
    seconds: Optional[float] = None,
    wait: Optional[float] = None,
    keep: int = 64,
    patience: float = 30,
    timeout: float = 15,
    max_memory: Optional[int] = None,
) -> "Reception":
    """Receives the frames of a sequence from an address that `tetrakis serve` prints.

        for frame in tetrakis.receive("http://127.0.0.1:8000/flood.tks", live=True, seconds=60):
            print(frame.time, frame.stream.heights().max())

    url: what `tetrakis serve` prints.
    live: the newest frame, again and again, as it comes; who is slow misses frames between. Without
        it all frames from `frame` on, one after the other, up to the last one that the server has.
    channel: bits a second of the link, a number or "64k/s": frames pass as if no more came, and each
        group has its share.
    triangles: the receiver draws meshes of so many: heights that these do not show are not sent.
    view: (matrix, width, height): the 16 numbers, row by row, that take (column, row, height, 1) to
        clip coordinates, and the pixels of the picture; bytes of what it shows come first.
    seconds: ends the iteration after so long; None: never.
    wait: raises TimeoutError where no frame comes for so many seconds; None: never.
    keep: how many frames behind the newest stay decodable.
    patience: messages may fail for so many seconds, in which a server can restart; then
        :class:`TksIOError` is raised.
    timeout: so many seconds without a byte of an answer are a failure.
    max_memory: bytes that a decoder may take, as of :func:`tetrakis.open`.
    """
    limits = c.Limits(
        size=ctypes.sizeof(c.Limits), max_memory=values.unsigned(max_memory, "max_memory", 64)
    )
    times = {"seconds": seconds, "wait": wait, "patience": patience, "timeout": timeout}
    for name, value in times.items():
        if value is not None and not values.real(value, name) >= 0:
            raise TksUsageError(f"{name} is a number of seconds, not {values.told(value)}.")
    reception = Reception(ControlUrl(url, timeout or None), limits, patience)
    reception._follow(values.flag(live, "live"), values.unsigned(frame, "frame", 38))
    reception._until(seconds, wait, values.unsigned(keep, "keep"))
    reception.want(channel=channel, triangles=triangles, view=view)
    return reception


class Reception:
    """An iterator of :class:`TimedFrame`. Made by :func:`tetrakis.receive`; closes with ``with`` or
    :meth:`close`. All waiting is done in ``next()``, for which a Ctrl-C ends it as well."""

    def __init__(self, url: ControlUrl, limits: c.Limits, patience: float) -> None:
        self._url, self._limits, self._patience = url, limits, patience
        self._receiver = ReceiverHandle(limits)
        self._closed = threading.Event()
        self._wants = r.Wants(size=ctypes.sizeof(r.Wants), link=r.MOST_RATE)
        self._view: Optional[c.ScreenCamera] = None  # that the wants point to
        self._has_link = False
        self._answered = False
        self._rest = _FIRST_REST
        self._frames: Iterator[int] = iter(())

    def _follow(self, live: bool, frame: int) -> None:
        self._frames = self._newest() if live else self._all(frame)

    def _until(self, seconds: Optional[float], wait: Optional[float], keep: int) -> None:
        self._end = None if seconds is None else time.monotonic() + seconds
        self._wait, self._keep = wait, keep

    def want(self, **wants: Any) -> None:
        """Says what is wanted from now on: `channel`, `triangles` and `view` of
        :func:`tetrakis.receive`; what is not given stays. Any thread may call it."""
        for name in wants:
            if name not in ("channel", "triangles", "view"):
                raise TypeError(f"There is no option {name!r}.")
        next_wants = r.Wants.from_buffer_copy(self._wants)
        if "channel" in wants:
            bits = _bits(wants["channel"])
            self._has_link = bits is not None
            next_wants.link = r.MOST_RATE if bits is None else _link(bits)
        if "triangles" in wants:
            next_wants.triangles = values.unsigned(wants["triangles"], "triangles", 28)
        view = _camera(wants["view"]) if "view" in wants else self._view
        next_wants.view = None if view is None else ctypes.pointer(view)
        self._wants, self._view = next_wants, view

    @property
    def clock(self) -> Clock:
        """What a tick is, and when tick 0 is."""
        return from_struct(self._receiver.info().clock)

    @property
    def end_frame(self) -> int:
        """The server has frames up to before this one."""
        return self._receiver.info().source_end_frame

    @property
    def bytes_received(self) -> int:
        """Of groups."""
        return self._receiver.info().bytes

    @property
    def closed(self) -> bool:
        return self._closed.is_set()

    def close(self) -> None:
        """Ends the iteration, from any thread: within the 2 s that a server waits for frames. Frames
        that were handed out stay open."""
        self._closed.set()

    def __enter__(self) -> "Reception":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __iter__(self) -> "Reception":
        return self

    def __next__(self) -> TimedFrame:
        number = next(self._frames)
        found = self._receiver.find(number)
        assert found is not None and found[0] == number
        dates = self.clock.dates(np.array([found[1]]))
        shown = found[1] if dates is None else dates[0]
        self._receiver.forget(max(0, number - self._keep))
        return TimedFrame(number, found[1], shown, Stream(ReceivedFrame(self._receiver, number)))

    def _all(self, frame: int) -> Iterator[int]:
        begin: Optional[int] = None
        came = time.monotonic()
        while self._goes_on(came):
            info = self._ask(frame, None)
            found = self._receiver.find(frame)
            is_there = found is not None and found[0] == frame
            if found is not None and is_there and begin is None:
                begin = found[1]
            if info.last_pieces and not self._has_passed(frame, begin, info):
                continue
            if is_there:
                yield frame
                came = time.monotonic()
            # Of frames that are no more the server sends the first one that is there.
            frame = max(frame + 1, 0 if is_there else info.first_frame)
            if frame >= info.source_end_frame:
                return

    def _has_passed(self, frame: int, begin: Optional[int], info: r.ReceiverInfo) -> bool:
        """Whether the next frame is due, on a link that has brought so many bytes."""
        following = self._receiver.find(frame + 1)
        tick = from_struct(info.clock).tick
        if not self._has_link or tick is None or begin is None or following is None:
            return False
        due = (following[1] - begin) * tick
        return following[0] == frame + 1 and info.bytes / self._wants.link >= due

    def _newest(self) -> Iterator[int]:
        shown, coming = -1, -1  # coming: it may get more bytes
        quiet = 0  # answers without any
        after: Optional[int] = None
        came = time.monotonic()
        while self._goes_on(came):
            info = self._ask(r.NEWEST_FRAME, after)
            after = None if info.last_pieces else info.source_end_frame
            found = self._receiver.find(r.NEWEST_FRAME)
            newest = -1 if found is None else found[0]
            quiet = 0 if info.last_pieces else quiet + 1
            # Of a thin link, where the next one comes before all of this one has.
            ready = coming if coming not in (shown, newest) else shown
            if newest > shown and quiet and self._is_all(newest, quiet):
                ready = newest
            coming = newest
            if ready > shown:
                shown = ready
                yield shown
                came = time.monotonic()

    def _is_all(self, frame: int, quiet: int) -> bool:
        """Whether no more of a frame is waited for. The server, too, may have but a part of it, for
        longer than a message waits where whoever writes has stopped."""
        return quiet > 1 or self._wants.triangles > 0 or self._receiver.is_whole(frame)

    def _goes_on(self, came: float) -> bool:
        now = time.monotonic()
        if self._closed.is_set() or (self._end is not None and now >= self._end):
            return False
        if self._wait is not None and now - came >= self._wait:
            raise TimeoutError(f"No frame came for {self._wait} s.")
        return True

    def _ask(self, frame: int, after: Optional[int]) -> r.ReceiverInfo:
        """What there is behind the next answer that comes."""
        begun, rest, damaged = time.monotonic(), _FIRST_REST, 0
        while True:
            try:
                return self._exchange(frame, after)
            except (ControlFailure, TksCorruptError, TksUnsupportedError) as failed:
                is_damaged = not isinstance(failed, ControlFailure)
                damaged += is_damaged
                late = time.monotonic() - begun >= self._patience
                if not self._answered or late or not getattr(failed, "may_pass", True):
                    raise
                if damaged == _MOST_DAMAGED or getattr(failed, "renews", False):
                    self._receiver, damaged, after = ReceiverHandle(self._limits), 0, None
            if self._closed.wait(rest):
                return self._receiver.info()
            rest = min(2 * rest, _MOST_REST)

    def _exchange(self, frame: int, after: Optional[int]) -> r.ReceiverInfo:
        wants = r.Wants.from_buffer_copy(self._wants)
        wants.frame = frame
        begun = time.monotonic()
        self._receiver.take(self._url.post(self._receiver.control(wants), after))
        self._answered = True
        info = self._receiver.info()
        if info.last_pieces or after is None:
            self._rest = _FIRST_REST
        elif time.monotonic() - begun < _FIRST_REST:  # the file does not grow
            self._closed.wait(self._rest)
            self._rest = min(2 * self._rest, _MOST_REST)
        return info


def _bits(channel: Union[float, str, None]) -> Optional[float]:
    """Bits a second; None: as many as come."""
    if channel is None:
        return None
    if not isinstance(channel, str):
        return values.real(channel, "channel")
    parts = _CHANNEL.fullmatch(channel)
    try:
        return float(parts[1]) * _FACTORS[parts[2]] if parts else -1
    except ValueError:
        return -1


def _link(bits: float) -> int:
    if not bits > 0:
        raise TksUsageError('channel is a number of bits a second above 0, or text as "64k/s".')
    return int(min(max(bits / 8, 1), r.MOST_RATE))


def _camera(view: Optional[ViewLike]) -> Optional[c.ScreenCamera]:
    if view is None:
        return None
    try:
        matrix, width, height = view
        clip = [values.real(number, "view") for number in np.asarray(matrix).ravel()]
    except (TypeError, ValueError):
        clip, width, height = [], 0, 0
    if len(clip) != 16:
        raise TksUsageError("view is (matrix, width, height), of 16 numbers and two of pixels.")
    size = (values.unsigned(width, "width"), values.unsigned(height, "height"))
    return c.ScreenCamera(ctypes.sizeof(c.ScreenCamera), *size, (ctypes.c_double * 16)(*clip))
