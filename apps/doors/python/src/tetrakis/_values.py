# SPDX-License-Identifier: Apache-2.0
"""From Python's values to those of C: ctypes cuts integers and text silently, so they are checked
here first."""

from __future__ import annotations

import math
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


def told(value: Any) -> str:
    """The value in a sentence: on one line, and short. What cannot even be written is its type."""
    most = 60
    try:
        line = " ".join(repr(value).split())
    except Exception:  # of integers too long for decimals, say
        return f"a value of type {type(value).__name__}"
    return line if len(line) <= most else line[:most] + "…"


def unsigned(value: Any, what: str, bits: int = 32) -> int:
    """`value` as an integer of so many bits; None is 0, the default of every field."""
    if value is None:
        return 0
    try:
        number = operator.index(value)
    except TypeError:
        raise TksUsageError(f"{what} must be an integer, not {told(value)}.") from None
    if not 0 <= number < 2**bits:
        raise TksUsageError(f"{what} must lie between 0 and {2**bits - 1}, not {told(number)}.")
    return number


def real(value: Any, what: str) -> float:
    """Text is no number, though float() reads it; nor is a masked sample or an array of one."""
    try:
        if isinstance(value, (str, bytes)) or value is np.ma.masked or getattr(value, "shape", ()):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise TksUsageError(f"{what} must be a number, not {told(value)}.") from None


def text(value: Optional[str], what: str) -> Optional[bytes]:
    if value is None:
        return None
    if not isinstance(value, str) or "\0" in value:
        raise TksUsageError(f"{what} must be text without NUL characters, not {told(value)}.")
    try:
        return value.encode()
    except UnicodeEncodeError:
        raise TksUsageError(f"{what} {told(value)} is no text of Unicode.") from None


def crs(value: Optional[str], what: str) -> Optional[bytes]:
    """A name or WKT is whatever its readers know; a code that is none is a mistake. Not all readers
    know EPSG in lower case."""
    if value is not None and not isinstance(value, str):
        raise TksUsageError(
            f'{what} must be text such as "EPSG:32611" or WKT, not {told(value)}'
            " (of a CRS of rasterio or pyproj: crs.to_wkt())."
        )
    if value is None or value[:5].upper() != "EPSG:":
        return text(value, what)
    code = value[5:]
    if not re.fullmatch(r"[0-9]+(\+[0-9]+)?", code):
        raise TksUsageError(f"{what} {told(value)} has no code of EPSG behind the colon.")
    return text("EPSG:" + code, what)


def choice(value: Any, choices: Sequence[Any], what: str) -> int:
    """The place of `value` among the choices; what is no plain value might not even compare."""
    plain = value is None or isinstance(value, (str, int, np.bool_))
    if not plain or value not in choices:
        raise TksUsageError(f"{what} must be one of {tuple(choices)}, not {told(value)}.")
    return choices.index(value)


def flag(value: Any, what: str) -> bool:
    return bool(choice(value, (False, True), what))


def spacing(value: Any) -> Tuple[float, float]:
    """Along x and y; 0 is unknown."""
    if value is None:
        return 0.0, 0.0
    try:
        given = list(value)
    except TypeError:
        given = [value, value]
    if len(given) != 2:
        raise TksUsageError(f"spacing takes one number or two, (x, y), not {told(value)}.")
    return real(given[0], "spacing"), real(given[1], "spacing")


def latitudes(value: Any) -> Tuple[float, float]:
    """Of the first and the last row; both 0 are unknown."""
    if value is None:
        return 0.0, 0.0
    try:
        given = list(value)
    except TypeError:
        given = []
    if len(given) != 2:
        raise TksUsageError(f"latitudes takes two numbers, (first, last), not {told(value)}.")
    return real(given[0], "latitudes"), real(given[1], "latitudes")


def geotransform(values: Optional[Sequence[float]], what: str) -> Tuple[Any, int]:
    """The six numbers, and whether there are any."""
    if values is None:
        return c.GEOTRANSFORM(), 0
    try:
        given = list(values)
    except TypeError:
        raise TksUsageError(f"{what} takes 6 numbers, not {told(values)}.") from None
    numbers = [real(value, what) for value in given]
    if len(numbers) != 6:
        raise TksUsageError(
            f"{what} takes 6 numbers in the order of GDAL, not {len(numbers)}"
            " (of an Affine: transform.to_gdal())."
        )
    if _is_flat(numbers):
        raise TksUsageError(f"{what} {tuple(numbers)} puts all samples on one line or one point.")
    return c.GEOTRANSFORM(*numbers), 1


def _is_flat(t: Sequence[float]) -> bool:
    """Rows and columns span no area: the sine of the angle between them is rounding, or there is no
    angle. Each is divided by its length first: products of tiny ones are 0."""
    along, down = math.hypot(t[1], t[4]), math.hypot(t[2], t[5])
    if along == 0 or down == 0:
        return True
    return abs(t[1] / along * (t[5] / down) - t[4] / along * (t[2] / down)) < 1e-9


def matrix(view: Any) -> NDArray[Any]:
    """The 16 numbers of a view."""
    numbers = array(view, "A view")
    if numbers.shape != (4, 4) or numbers.dtype.kind not in "iuf" or not np.isfinite(numbers).all():
        raise TksUsageError("A view is a 4 x 4 matrix of finite numbers.")
    return numbers.astype(np.float64)


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
        (top, bottom), (left, right) = (_bounds(part, size) for part, size in zip(asked, shape))
        asked = (left, top, max(right - left, 0), max(bottom - top, 0))
    if len(asked) != 4:
        raise TksUsageError(_WINDOW)
    return c.Window(*(unsigned(number, "A window's number") for number in asked))


def _bounds(part: slice, size: int) -> Tuple[int, int]:
    try:
        first, end, step = part.indices(size)
    except (TypeError, ValueError):
        raise TksUsageError(f"A window has slices of integers, not {told(part)}.") from None
    if step != 1:
        raise TksUsageError("The slices of a window must have step 1; take a level instead.")
    return first, end


def array(values: Any, what: str) -> NDArray[Any]:
    """Nested lists of different lengths, say, make none."""
    try:
        return np.asarray(values)
    except (TypeError, ValueError):
        raise TksUsageError(f"{what} must be an array, not {told(values)}.") from None


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


def exact(array: NDArray[Any], what: str, allowed: Sequence[np.dtype] = SAMPLES) -> NDArray[Any]:
    """As `samples`, and arrays of other numbers whose every value one of the types holds: those
    that lists, NumPy's defaults and scientific files have."""
    native = array.dtype.newbyteorder("=")
    if native in allowed or native.kind not in "iuf" or array.size == 0:
        return samples(array, what, allowed)
    kept = _as_float(array, allowed) if native.kind == "f" else _as_integers(array, allowed)
    if kept is None:
        names = ", ".join(str(dtype) for dtype in allowed)
        raise TksUsageError(
            f"{what} of type {array.dtype} have values that none of the types {names} holds "
            "exactly. Convert with astype() to the one that is near enough for you."
        )
    return np.asarray(kept, order="C")


def _as_float(array: NDArray[Any], allowed: Sequence[np.dtype]) -> Optional[NDArray[Any]]:
    single = np.dtype("f4")
    with np.errstate(over="ignore"):
        kept = array.astype(single)
    same = (kept == array) | (np.isnan(kept) & np.isnan(array))
    return kept if single in allowed and same.all() else None


def _as_integers(array: NDArray[Any], allowed: Sequence[np.dtype]) -> Optional[NDArray[Any]]:
    """Heights have 32 bits, so that their type does not depend on what they are."""
    low, high = int(array.min()), int(array.max())
    for dtype in (np.dtype("i4"), np.dtype("u4")) if len(allowed) > len(TEXELS) else TEXELS:
        limits = np.iinfo(dtype)
        if limits.min <= low and high <= limits.max:
            return array.astype(dtype)
    return None


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
