# SPDX-License-Identifier: Apache-2.0
"""Exceptions that carry the stable number of what went wrong."""

from __future__ import annotations

import enum
from typing import Type


class Status(enum.IntEnum):
    """The numbers of tks_status, which the command line returns as its exit codes."""

    OK = 0
    USAGE = 1
    IO = 2
    CORRUPT = 3
    TRUNCATED = 4
    UNSUPPORTED = 5
    LIMIT = 6
    MISMATCH = 7
    NO_MEMORY = 8


class TksError(RuntimeError):
    """What Tetrakis could not do, in one sentence. `code` is a :class:`Status`."""

    code = Status.MISMATCH


class TksUsageError(TksError, ValueError):
    """An argument makes no sense, or the stream was closed: fix the call."""

    code = Status.USAGE


class TksIOError(TksError, OSError):
    """Samples or files cannot be read or written."""

    code = Status.IO


class TksCorruptError(TksError):
    """The bytes are not a Tetrakis stream, or break its syntax."""

    code = Status.CORRUPT


class TksTruncatedError(TksError):
    """There are fewer bytes than the header takes; from `verify`: than the stream has."""

    code = Status.TRUNCATED


class TksUnsupportedError(TksError):
    """This library does not know the version, the profile or a feature."""

    code = Status.UNSUPPORTED


class TksLimitError(TksError):
    """A limit given to `open` would be exceeded; nothing was allocated."""

    code = Status.LIMIT


class TksMismatchError(TksError):
    """The encoder broke a promise, noticed it, and so returns no stream: a fault of ours."""


class TksMemoryError(TksError, MemoryError):
    """Memory ran out."""

    code = Status.NO_MEMORY


_CLASSES: dict[Status, Type[TksError]] = {
    kind.code: kind
    for kind in (
        TksUsageError,
        TksIOError,
        TksCorruptError,
        TksTruncatedError,
        TksUnsupportedError,
        TksLimitError,
        TksMismatchError,
        TksMemoryError,
    )
}


def error(status: int, message: str) -> TksError:
    """The exception for a status other than OK."""
    return _CLASSES[Status(status)](message or "The library gives no reason.")
