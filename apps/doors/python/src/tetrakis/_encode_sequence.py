# SPDX-License-Identifier: Apache-2.0
"""From arrays with a time axis, lists and iterators of frames to a sequence."""

from __future__ import annotations

import builtins
import io
import itertools
import os
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, Callable, Iterable, Iterator, Optional, Union

from . import _values as values
from ._clock import ClockLike, from_struct, timeline
from ._errors import TksUsageError
from ._sequence_encoder import USUAL_GROUP, Reference, SequenceEncoder
from ._sequence_handle import SequenceHandle
from ._source import File, Part
from ._work_folder import appearing, extending

_END = object()


def encode_sequence(
    heights: Optional[Iterable[Any]] = None,
    texture: Optional[Iterable[Any]] = None,
    path: Any = None,
    *,
    times: Optional[Iterable[Any]] = None,
    clock: ClockLike = None,
    group: int = USUAL_GROUP,
    seekable: bool = True,
    reference: Reference = None,
    entry: Optional[int] = None,
    append: bool = False,
    progress: Optional[Callable[[int], Any]] = None,
    **options: Any,
) -> Optional[builtins.bytes]:
    """Codes frames of heights, of textures, or of both into a sequence: groups of frames, of each
    of which what stands still takes bytes once. Returns its bytes, or None with a `path`.

    heights: an array (time, rows, columns), or a list or an iterator of frames as `encode` takes
        them: memory is that of one group. All frames have one size and type; each has voids of its
        own. Masked integers take `nodata`, and nodata="auto" is that of the first frame.
    texture: likewise (time, rows, columns) grey, or (time, rows, columns, channels).
    path: a file to write to, which has its name once it is whole; or a file that is open for
        writing bytes, such as one of fsspec or a pipe, which gets each group when it is coded.
        Readers of a file that still grows see the groups so far.

    times: of each frame, rising: whole numbers of ticks, datetime64 or datetimes; without them
        0, 1, 2 and so on. Of an array of dates the clock follows, of an iterator it does not.
    clock: what these mean: a :class:`Clock`, the units of the CF conventions ("hours since
        1900-01-01"), or the seconds of a tick (1 / 30).

    group: frames that are coded together, from 1 to 32: more take fewer bytes, and a frame more
        time. Where frames together cannot be coded as is asked for (floats of no common step to be
        lossless, say), each is a group by itself.
    seekable: False leaves out the index by which readers over a network find a frame in three
        requests; that saves some bytes of each group.
    reference: bytes of each frame of a group that every receiver is known to have, or "all". The
        next group goes on from what they show of the last frame: what stands still takes next to no
        bytes, and the group is decoded only with those before it. Without it each group stands by
        itself.
    entry: beside a reference, at least every so manyth group stands by itself, from 1 to 64; 16
        unless given. Readers begin there.
    append: the frames follow those of the file at `path`, whose groups stay whatever happens; if
        there is no file, one is begun. Without a clock that of the file holds, and without times
        one tick after the last frame. A group that the file ends inside of is written over.
    progress: called with how many frames were taken, after each. What it raises ends the encode.
    options: those of :func:`tetrakis.encode` but for depth, latitudes, triangles and weights.
        `bytes` counts a frame: a group of n frames takes n times as many at most. `psnr` is over
        all frames of a group, `max_error` holds for every height of every frame.

    Raises what `encode` raises; :class:`TksUsageError` for frames that are not alike, or not later
    than those before, or not as many as there are times.
    """
    if progress is not None and not callable(progress):
        raise TksUsageError(f"progress must be a function, not {values.told(progress)}.")
    options.update(group=group, seekable=seekable, reference=reference, entry=entry)
    written = _written(path) if values.flag(append, "append") else None
    if written is not None and clock is None:
        clock = from_struct(written.info().clock)
    known, ticks = timeline(times, clock)
    with SequenceEncoder(clock=known, **options) as encoder:
        if written is not None:
            encoder.follow_handle(written)
        with _opened(path) if written is None else extending(path, written.info().bytes) as file:
            count = 0
            for frame in _together(heights, texture, ticks):
                encoder.push(*frame)
                count += 1
                file.write(encoder.take())
                if progress is not None:
                    progress(count)
            if count == 0:
                raise TksUsageError("A sequence has one frame or more, and there is none.")
            encoder.flush()
            file.write(encoder.take())
            return file.getvalue() if path is None else None


def _together(*parts: Optional[Iterable[Any]]) -> Iterator[Any]:
    """Heights, texture and time of each frame; None of what is not there."""
    if parts[0] is None and parts[1] is None:
        return
    for part in parts:
        if part is not None and not hasattr(part, "__iter__") and not hasattr(part, "__getitem__"):
            raise TksUsageError(f"Frames are an array or come one by one, not {values.told(part)}.")
    there = [part for part in parts if part is not None]
    for frame in itertools.zip_longest(*there, fillvalue=_END):
        if any(part is _END for part in frame):
            raise TksUsageError("There are not as many heights, textures and times of frames.")
        each = iter(frame)
        yield [None if part is None else next(each) for part in parts]


def _written(path: Any) -> Optional[SequenceHandle]:
    """The whole groups of a file; None where there is none."""
    if not isinstance(path, (str, os.PathLike)):
        raise TksUsageError("append takes the path of a file.")
    if not os.path.exists(path):
        return None
    with open(path, "rb") as file:
        source = File(file)
        with SequenceHandle() as given:
            given.append_all(source)
            whole = given.info().whole_bytes
        sequence = SequenceHandle()
        sequence.append_all(Part(source, 0, whole))
        return sequence


@contextmanager
def _opened(path: Any) -> Iterator[Union[BinaryIO, io.BytesIO]]:
    if path is None:
        yield io.BytesIO()
    elif hasattr(path, "write"):
        yield path
    else:
        with appearing(Path(path)) as file:
            yield file
