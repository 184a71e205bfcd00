# SPDX-License-Identifier: Apache-2.0
"""From frames, as they come, to the bytes of a sequence."""

from __future__ import annotations

import builtins
import ctypes
import inspect
import threading
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _library as c
from . import _sequence_library as s
from . import _stoppable as stoppable
from . import _values as values
from ._clock import ClockLike, clock_of
from ._encode import SHORT, encode, heights_struct, image_struct, options_struct, places, taken
from ._errors import Status, TksUsageError, error
from ._sequence_handle import SequenceHandle
from ._source import Source, anywhere

_DEFAULTS = {
    name: parameter.default
    for name, parameter in inspect.signature(encode).parameters.items()
    if parameter.kind is inspect.Parameter.KEYWORD_ONLY
}
# Not of frames, or not of this call.
_NOT_OF_FRAMES = ("depth", "latitudes", "triangles", "weights", "progress")

USUAL_GROUP = 16
Reference = Union[int, str, None]


class SequenceEncoder:
    """Takes frames of heights, of textures, or of both, one after the other, and hands over the
    bytes of a sequence, for live sources. For arrays and files use
    :func:`tetrakis.encode_sequence`, which says what the arguments are.

        with tetrakis.SequenceEncoder(clock=1 / 30, bytes=4000) as encoder:
            for frame in camera:
                encoder.push(frame)
                socket.sendall(encoder.take())  # of a group, once it is whole
            encoder.flush()
            socket.sendall(encoder.take())

    What was taken is never changed: a file that grows by it can be opened at any time, and one that
    was cut shows its frames as well as it can. Memory is that of one group.
    """

    def __init__(
        self,
        *,
        clock: ClockLike = None,
        group: int = USUAL_GROUP,
        seekable: bool = True,
        reference: Reference = None,
        entry: Optional[int] = None,
        **options: Any,
    ) -> None:
        self._handle = ctypes.c_void_p()
        given = _arguments(options)
        self._place, self._texture_place = places(given)
        self.clock = clock_of(clock)
        self._group = values.unsigned(group, "group")
        self._pending, self._next = 0, 0
        self._one_codes = threading.Lock()
        self._report: Any = None
        self._callback = c.PROGRESS(self._told)
        encode_options = options_struct(given)
        encode_options.progress = self._callback
        sequence_options = s.SequenceOptions(
            size=ctypes.sizeof(s.SequenceOptions),
            group=self._group,
            encode=ctypes.pointer(encode_options),
            clock=self.clock.struct(),
            no_index=not values.flag(seekable, "seekable"),
            reference=_reference(reference),
            entry=_entry(entry, reference),
        )
        message = ctypes.create_string_buffer(1024)
        status = c.lib.tks_sequence_encoder_open(
            sequence_options, self._handle, message, len(message)
        )
        if status != Status.OK:
            raise error(status, message.value.decode("utf-8", "replace"))

    def __enter__(self) -> "SequenceEncoder":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if self._handle:
            self.close()

    def close(self) -> None:
        """Drops the frames that were not flushed, and the bytes that were not taken."""
        with self._one_codes:
            c.lib.tks_sequence_encoder_close(self._handle)
            self._handle = ctypes.c_void_p()

    def follow(self, written: Source) -> None:
        """Lets an encoder that has taken no frame go on behind a sequence of whole groups, by its
        path or its bytes: what is taken from then on follows these bytes, and frames without times
        the last one of these. The clock of both is the same."""
        with SequenceHandle() as sequence:
            sequence.append_all(anywhere(written))
            self.follow_handle(sequence)

    def follow_handle(self, written: SequenceHandle) -> None:
        """As `follow`, behind a sequence that is open."""
        self._run(c.lib.tks_sequence_encoder_continue, (written.address,), True)
        self._next = written.time(written.info().end_frame - 1) + 1

    def push(
        self,
        heights: Optional[ArrayLike] = None,
        texture: Optional[ArrayLike] = None,
        time: Any = None,
    ) -> None:
        """Takes one frame, which is copied. The last one of a group is taken when the group is
        coded; Ctrl-C ends that as it ends `encode`, and the frame is not taken.

        time: in ticks of the clock, or a datetime64 or datetime; later than that of the frame
            before. Without it, one tick after it; of the first frame 0.
        """
        tick = self._next if time is None else self.clock.ticks(time)
        height_field, samples = (None, None) if heights is None else self._heights(heights)
        image, texels = (None, None)
        if texture is not None:
            image, texels = image_struct(texture, self._texture_place)
        arrays = [array for array in (samples, texels) if array is not None]
        last = self._pending + 1 >= (self._group or USUAL_GROUP)
        size = sum(array.size for array in arrays) * (self._pending + 1)
        short = not last or size <= SHORT
        self._run(c.lib.tks_sequence_push, (height_field, image, tick), short, arrays)
        self._pending = 0 if last else self._pending + 1
        self._next = tick + 1
        if height_field is not None and self._place["nodata"] in ("auto", None):
            # Frames have one nodata value: that of the first one.
            self._place["nodata"] = height_field.nodata if height_field.has_nodata else None

    def flush(self) -> None:
        """Codes the frames that are no whole group yet."""
        self._run(c.lib.tks_sequence_flush, (), self._pending == 0)
        self._pending = 0

    def take(self) -> builtins.bytes:
        """The bytes that are ready and follow those that were taken before; there may be none."""
        buffer = c.Buffer()
        with self._one_codes:
            status = c.lib.tks_sequence_take(self._handle, buffer)
        if status != Status.OK:
            raise error(status, "The encoder is closed.")
        return taken(buffer)

    def _heights(self, heights: Any) -> Tuple[c.Heights, Any]:
        nameless = self._place["nodata"] in (None, "auto")
        if nameless and np.ma.is_masked(heights) and heights.dtype.kind != "f":
            raise TksUsageError(
                "Masked samples of integers are voids by a nodata value that no sample of any "
                "frame has: give nodata."
            )
        return heights_struct(heights, self._place)

    def _run(
        self, function: Any, arguments: Tuple[Any, ...], short: bool, kept: Any = None
    ) -> None:
        """`kept` lives as long as the call, which an interrupt may leave behind."""
        if not self._handle:
            raise TksUsageError("The encoder is closed.")

        def call(callback: Any, _kept: Any = kept) -> None:
            self._call(callback, function, arguments)

        stoppable.run(call, None, short)

    def _call(self, callback: Any, function: Any, arguments: Tuple[Any, ...]) -> None:
        message = ctypes.create_string_buffer(1024)
        with self._one_codes:
            self._report = callback
            status = function(self._handle, *arguments, message, len(message))
        if status != Status.OK:
            raise error(status, message.value.decode("utf-8", "replace"))

    def _told(self, user: Any, done: float) -> int:
        """What C calls while it codes a group."""
        return int(self._report(user, done)) if self._report else 0


def _reference(reference: Reference) -> int:
    """In bytes a frame; 0: none."""
    if reference == "all":
        return s.ALL_BYTES
    if isinstance(reference, str) or reference == 0:
        told = values.told(reference)
        raise TksUsageError(f'reference is "all" or one byte a frame or more, not {told}.')
    return values.unsigned(reference, "reference", 64)


def _entry(entry: Optional[int], reference: Reference) -> int:
    if entry is not None and reference is None:
        raise TksUsageError("entry is of groups that go on from others: give reference.")
    return values.unsigned(entry, "entry")


def _arguments(options: Dict[str, Any]) -> Dict[str, Any]:
    """Those of `encode`, as far as they concern frames."""
    for name in options:
        if name not in _DEFAULTS:
            raise TypeError(f"There is no option {name!r}.")
        if name in _NOT_OF_FRAMES:
            raise TksUsageError(f"{name} is not for sequences.")
    given = {**_DEFAULTS, **options}
    if given["domain"] == "cube":
        raise TksUsageError('Sequences have no domain "cube".')
    return given
