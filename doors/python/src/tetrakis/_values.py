# SPDX-License-Identifier: Apache-2.0
"""From Python's values to those of C: ctypes cuts integers and text silently, so they are checked
here first."""

from __future__ import annotations

import operator
import re
from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from ._errors import TksUsageError

# In the order of tks_sample.
SAMPLES = tuple(np.dtype(name) for name in ("u1", "i1", "u2", "i2", "u4", "i4", "f4"))
TEXELS = (np.dtype("u1"), np.dtype("u2"))

# (x, y, width, height) in samples, or the slices (rows, columns) that would cut it from an array.
WindowLike = Union[Tuple[int, int, int, int], Tuple[slice, slice], slice]
_WINDOW = "A window is (x, y, width, height), or slices of rows and columns."


def unsigned(value: Any, what: str, bits: int = 32) -> int:
    """`value` as an integer of so many bits; None is 0, the default of every field."""
    if value is None:
        return 0
    try:
        number = operator.index(value)
    except TypeError:
        raise TksUsageError(f"{what} must be an integer, not {value!r}.") from None
    if not 0 <= number < 2**bits:
        raise TksUsageError(f"{what} must lie between 0 and {2**bits - 1}, not {number}.")
    return number


def real(value: Any, what: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TksUsageError(f"{what} must be a number, not {value!r}.") from None


def text(value: Optional[str], what: str) -> Optional[bytes]:
    if value is None:
        return None
    if not isinstance(value, str) or "\0" in value:
        raise TksUsageError(f"{what} must be text without NUL characters, not {value!r}.")
    try:
        return value.encode()
    except UnicodeEncodeError:
        raise TksUsageError(f"{what} {value!r} is no text of Unicode.") from None


def crs(value: Optional[str], what: str) -> Optional[bytes]:
    """A name or WKT is whatever its readers know; a code that is none is a mistake. Not all readers
    know EPSG in lower case."""
    if not isinstance(value, str) or value[:5].upper() != "EPSG:":
        return text(value, what)
    code = value[5:]
    if not re.fullmatch(r"[0-9]+(\+[0-9]+)?", code):
        raise TksUsageError(f"{what} {value!r} has no code of EPSG behind the colon.")
    return text("EPSG:" + code, what)


def choice(value: Any, choices: Sequence[Any], what: str) -> int:
    if value not in choices:
        raise TksUsageError(f"{what} must be one of {tuple(choices)}, not {value!r}.")
    return choices.index(value)


def geotransform(values: Optional[Sequence[float]], what: str) -> Tuple[Any, int]:
    """The six numbers, and whether there are any."""
    if values is None:
        return c.GEOTRANSFORM(), 0
    numbers = [real(value, what) for value in values]
    if len(numbers) != 6:
        raise TksUsageError(
            f"{what} takes 6 numbers in the order of GDAL, not {len(numbers)}"
            " (of an Affine: transform.to_gdal())."
        )
    return c.GEOTRANSFORM(*numbers), 1


def window(asked: Optional[WindowLike], shape: Tuple[int, ...]) -> Optional[c.Window]:
    """A window in an array of (rows, columns, ...); slices mean what they mean to NumPy."""
    if asked is None:
        return None
    if isinstance(asked, slice):
        asked = (asked, slice(None))
    try:
        asked = tuple(asked)
    except TypeError:
        raise TksUsageError(_WINDOW) from None
    if len(asked) == 2 and all(isinstance(part, slice) for part in asked):
        if any(part.step not in (None, 1) for part in asked):
            raise TksUsageError("The slices of a window must have step 1; take a level instead.")
        (top, bottom, _), (left, right, _) = (
            part.indices(size) for part, size in zip(asked, shape)
        )
        asked = (left, top, max(right - left, 0), max(bottom - top, 0))
    if len(asked) != 4:
        raise TksUsageError(_WINDOW)
    return c.Window(*(unsigned(number, "A window's number") for number in asked))


def samples(array: NDArray[Any], what: str, allowed: Sequence[np.dtype] = SAMPLES) -> NDArray[Any]:
    """The array in C order and this machine's byte order; refused if no sample type fits."""
    native = array.dtype.newbyteorder("=")
    if native not in allowed:
        names = ", ".join(str(dtype) for dtype in allowed)
        raise TksUsageError(
            f"{what} of type {array.dtype} cannot be coded; the types are {names}. "
            "Convert with astype() to one that holds your values."
        )
    return np.asarray(array, native, order="C")


def output(out: Optional[NDArray[Any]], shape: Tuple[int, ...], dtype: np.dtype) -> NDArray[Any]:
    """`out` if it can take the samples, else a new array."""
    if out is None:
        return np.empty(shape, dtype)
    fits = isinstance(out, np.ndarray) and out.shape == shape and out.dtype == dtype
    if not fits or not out.flags.c_contiguous or not out.flags.writeable:
        raise TksUsageError(
            f"out must be a writable array in C order of shape {shape} and type {dtype}."
        )
    return out
