# SPDX-License-Identifier: Apache-2.0
"""A tks_sequence of the C interface."""

from __future__ import annotations

import builtins
import ctypes
from typing import Any, Optional

from . import _library as c
from . import _sequence_library as s
from ._encode import taken
from ._errors import Status, error
from ._source import Ranged

# A source is asked for no more at once.
_PART = 1 << 24


class SequenceHandle:
    """Owns a tks_sequence, for one call at a time."""

    def __init__(self, limits: Optional[c.Limits] = None) -> None:
        self._handle = ctypes.c_void_p()
        status = c.lib.tks_sequence_open(limits, self._handle)
        if status != Status.OK:
            raise error(status, "There is not enough memory.")

    def __enter__(self) -> "SequenceHandle":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    def close(self) -> None:
        c.lib.tks_sequence_close(self._handle)
        self._handle = ctypes.c_void_p()

    @property
    def address(self) -> ctypes.c_void_p:
        return self._handle

    def append(self, data: builtins.bytes) -> None:
        self._check(c.lib.tks_sequence_append(self._handle, data, len(data)))

    def append_all(self, source: Ranged) -> None:
        offset = source.begin
        while part := source.read(offset, _PART):
            self.append(part)
            offset += len(part)

    def info(self) -> s.SequenceInfo:
        info = s.SequenceInfo(size=ctypes.sizeof(s.SequenceInfo))
        c.lib.tks_sequence_get_info(self._handle, info)
        return info

    def group(self, frame: int) -> Optional[s.Group]:
        """None where there is no such frame."""
        group = s.Group(size=ctypes.sizeof(s.Group))
        status = c.lib.tks_sequence_group(self._handle, frame, group)
        return group if status == Status.OK else None

    def time(self, frame: int) -> int:
        """That of a frame which is there, in ticks."""
        time = ctypes.c_int64()
        c.lib.tks_sequence_time(self._handle, frame, time)
        return time.value

    def decoder(self, frame: int) -> ctypes.c_void_p:
        """Of the group of a frame; it belongs to the sequence."""
        decoder = ctypes.c_void_p()
        self._check(c.lib.tks_sequence_frame(self._handle, frame, decoder))
        return decoder

    def thinned(self, frame_bytes: int) -> builtins.bytes:
        buffer, message = c.Buffer(), ctypes.create_string_buffer(1024)
        arguments = (self._handle, frame_bytes, buffer, message, len(message))
        status = c.lib.tks_sequence_thin(*arguments)
        if status != Status.OK:
            raise error(status, message.value.decode("utf-8", "replace"))
        return taken(buffer)

    def _check(self, status: int) -> None:
        if status != Status.OK:
            sentence = c.lib.tks_sequence_message(self._handle).decode("utf-8", "replace")
            raise error(status, sentence)
