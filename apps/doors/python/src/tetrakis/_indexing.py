# SPDX-License-Identifier: Apache-2.0
"""What `stream[...]` asks for: the smallest window that holds it, and where it lies in there."""

from __future__ import annotations

import operator
from typing import Any, List, Tuple

from . import _library as c
from . import _values as values
from ._errors import TksUsageError


def selection(key: Any, shape: Tuple[int, ...]) -> Tuple[c.Window, Tuple[Any, ...], bool]:
    """The window, the key of the same samples inside it, and whether there are none.

    Integers, slices of any step and an ellipsis, as NumPy has them (basic indexing).
    """
    parts = for_each_axis(key if isinstance(key, tuple) else (key,), len(shape))
    rows, columns = (_span(part, size) for part, size in zip(parts[:2], shape))
    inner = (_moved(parts[0], rows), _moved(parts[1], columns), *parts[2:])
    window = c.Window(columns.start, rows.start, max(1, len(columns)), max(1, len(rows)))
    return window, inner, not (len(rows) and len(columns))


def for_each_axis(parts: Tuple[Any, ...], axes: int) -> List[Any]:
    """An integer or a slice for each of the axes."""
    dots = [i for i, part in enumerate(parts) if part is Ellipsis]
    if len(dots) > 1:
        raise IndexError("An index has one ellipsis at most.")
    at = dots[0] if dots else len(parts)
    missing = axes - (len(parts) - len(dots))
    if missing < 0:
        raise IndexError(f"Too many indices: the stream has {axes} axes.")
    full = [*parts[:at], *[slice(None)] * missing, *parts[at + 1 :]]
    return [part if isinstance(part, slice) else _integer(part) for part in full]


def _integer(part: Any) -> int:
    try:
        return operator.index(part)
    except TypeError:
        raise TksUsageError(
            f"A stream takes integers and slices, not {values.told(part)}; decode with "
            "numpy.asarray() or a window first, then index the array."
        ) from None


def _span(part: Any, size: int) -> range:
    """All places from the first that is asked for to the last, in rising order."""
    if not isinstance(part, slice):
        if not -size <= part < size:
            raise IndexError(f"Index {part} lies outside of an axis of {size}.")
        return range(part % size, part % size + 1)
    asked = range(size)[part]
    if not asked:
        return range(0)
    return range(min(asked[0], asked[-1]), max(asked[0], asked[-1]) + 1)


def _moved(part: Any, span: range) -> Any:
    if not isinstance(part, slice):
        return 0
    step = 1 if part.step is None else operator.index(part.step)
    return slice(None, None, step)
