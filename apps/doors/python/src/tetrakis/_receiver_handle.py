# SPDX-License-Identifier: Apache-2.0
"""A tks_receiver of the C interface, and the frames that it holds as streams."""

from __future__ import annotations

import builtins
import ctypes
import secrets
import threading
from contextlib import contextmanager
from typing import Any, Iterator, Optional, Tuple

from . import _library as c
from . import _receiver_library as r
from ._access import Access
from ._decoder import Decoder
from ._errors import Status, TksUsageError, error


class ReceiverHandle:
    """Owns a tks_receiver with a number of its own. Calls from several threads take turns."""

    def __init__(self, limits: c.Limits) -> None:
        self.limits = limits
        self.one_decodes = threading.RLock()
        self._handle = ctypes.c_void_p()
        status = c.lib.tks_receiver_open(secrets.randbits(64), limits, self._handle)
        if status != Status.OK:
            raise error(status, "There is not enough memory.")

    def __del__(self) -> None:
        if self._handle:
            c.lib.tks_receiver_close(self._handle)

    def control(self, wants: r.Wants) -> builtins.bytes:
        message = ctypes.create_string_buffer(r.MOST_CONTROL_BYTES)
        size = ctypes.c_size_t()
        self._run(c.lib.tks_receiver_control, wants, message, size)
        return message.raw[: size.value]

    def take(self, answer: builtins.bytes) -> None:
        self._run(c.lib.tks_receiver_take, answer, len(answer))

    def forget(self, frame: int) -> None:
        self._run(c.lib.tks_receiver_forget, frame)

    def info(self) -> r.ReceiverInfo:
        info = r.ReceiverInfo(size=ctypes.sizeof(r.ReceiverInfo))
        with self.one_decodes:
            c.lib.tks_receiver_get_info(self._handle, info)
        return info

    def find(self, frame: int) -> Optional[Tuple[int, int]]:
        """The last frame up to a given one that can be decoded, and its time."""
        found, time = ctypes.c_uint64(), ctypes.c_int64()
        with self.one_decodes:
            status = c.lib.tks_receiver_find(self._handle, frame, found, time)
        return (found.value, time.value) if status == Status.OK else None

    def decoder(self, frame: int) -> ctypes.c_void_p:
        """It belongs to the receiver, until the next call."""
        decoder = ctypes.c_void_p()
        self._run(c.lib.tks_receiver_frame, frame, decoder)
        return decoder

    def is_whole(self, frame: int) -> bool:
        """Whether all bytes of a frame's group have come."""
        with self.one_decodes, _FrameDecoder(self, frame) as decoder:
            info = decoder.info()
            return info.available_bytes >= info.stream_bytes

    def _run(self, function: Any, *arguments: Any) -> None:
        with self.one_decodes:
            status = function(self._handle, *arguments)
            if status == Status.OK:
                return
            sentence = c.lib.tks_receiver_message(self._handle).decode("utf-8", "replace")
        raise error(status, sentence)


class _FrameDecoder(Decoder):
    """Belongs to its receiver, and shows a frame until another one is asked for."""

    def __init__(self, receiver: ReceiverHandle, frame: int) -> None:
        self._handle = ctypes.c_void_p()
        self._handle = receiver.decoder(frame)
        self.set_levels(0, 0)

    def close(self) -> None:
        self._handle = ctypes.c_void_p()

    def set_frame(self, frame: int) -> None:
        """It is set."""


class ReceivedFrame(Access):
    """A frame of a receiver, of the bytes that came, as long as the receiver keeps it."""

    def __init__(self, receiver: ReceiverHandle, frame: int) -> None:
        self._receiver, self._frame = receiver, frame
        super().__init__(b"", None, receiver.limits, 1)

    def _start(self) -> None:
        self._lock = threading.RLock()
        self._idle = []
        self._sound = None
        with self._taken() as decoder:
            self._header = decoder.info()

    def __getstate__(self) -> Any:
        raise TypeError("Frames of a server are not pickled: keep their arrays.")

    def _cut(self, count: int) -> Decoder:
        raise TksUsageError("Frames of a server show all bytes that came: bytes= has no use.")

    @contextmanager
    def _taken(self) -> Iterator[Decoder]:
        self._bytes()
        with self._receiver.one_decodes, _FrameDecoder(self._receiver, self._frame) as decoder:
            yield decoder
