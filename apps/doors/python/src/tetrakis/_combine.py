# SPDX-License-Identifier: Apache-2.0
"""One stream of the components of several."""

from __future__ import annotations

import builtins
import ctypes
from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple, Union

from . import _components_library as c
from . import _library as library
from . import _values as values
from ._encode import run_encoder
from ._errors import TksUnsupportedError, TksUsageError
from ._source import Source, first_bytes

_SEQUENCE = b"TKG\x1a"
_ANY = 2**63  #: samples; memory bounds what is decoded of them

Others = Union[Mapping[str, Source], Iterable[Tuple[str, Source]]]


def combine(
    stream: Source,
    others: Others,
    *,
    name: Optional[str] = None,
    weights: Optional[Mapping[str, float]] = None,
    bytes: Optional[int] = None,
    max_memory: Optional[int] = None,
) -> builtins.bytes:
    """Makes one stream of several, without coding anything anew.

    stream: a path, bytes, a file, or an address, as for :func:`open`. Its heights and its texture
        are those of the result, and so are its unit, its CRS and all else that it says; a texture
        of the others stands in where it has none, and heights likewise.
    others: what else there is over the same ground, such as normals, classes, or heights of another
        year: {name: stream}, or pairs (name, stream) where one name stands for heights and for a
        texture that come as two streams. Their components keep names that they have.
        ``open(combined, component=name)`` shows them, each with its own unit, place and nodata.
    name: of the components of the first stream, if these have none.
    weights: {name: number}, what errors count beside those of others, 1 unless given. Errors are in
        parts of each raster's range of values.
    bytes: the result takes at most so many; without it all that there is. A stream that is cut so
        promises nothing any more: it is neither lossless nor within a largest error.
    max_memory: bytes, as for :func:`open`; of each raster a small level is decoded to know its
        range.

    Any prefix of the result shows all components, each about as well as its weight says.

    Raises :class:`TksUsageError` for more than 16 components, two of a kind with the same name,
    streams of frames, a mesh of triangles or a grid on a cube behind the first stream, or `bytes`
    that do not hold the header;
    :class:`TksCorruptError` and others as :func:`open` does (the sentence counts streams from 0).
    """
    streams = [(name, stream), *_pairs(others)]
    count = values.unsigned(bytes, "bytes", 64)
    if bytes is not None and count == 0:
        raise TksUsageError("The target bytes must be greater than 0.")
    counted = _weights(weights, [called for called, _ in streams])
    limits = library.Limits(
        size=ctypes.sizeof(library.Limits),
        max_samples=_ANY,
        max_texels=_ANY,
        max_memory=values.unsigned(max_memory, "max_memory", 64),
    )
    options = c.CombineOptions(
        size=ctypes.sizeof(c.CombineOptions), bytes=count, limits=ctypes.pointer(limits)
    )
    parts = (c.Combined * len(streams))(
        *(_part(called, source, counted.get(called, 1.0)) for called, source in streams)
    )
    return run_encoder(library.lib.tks_combine, parts, len(parts), options)


def _pairs(others: Any) -> List[Tuple[Any, Any]]:
    pairs = list(others.items() if isinstance(others, Mapping) else _listed(others))
    for pair in pairs:
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            raise TksUsageError(
                f"A stream beside the first is (name, stream), not {values.told(pair)}."
            )
    return [(called, source) for called, source in pairs]


def _listed(others: Any) -> List[Any]:
    try:
        if isinstance(others, (str, builtins.bytes)):
            raise TypeError
        return list(others)
    except TypeError:
        raise TksUsageError(
            f"Streams beside the first are {{name: stream}}, not {values.told(others)}."
        ) from None


def _weights(given: Optional[Mapping[str, float]], names: List[Any]) -> Dict[Any, float]:
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise TksUsageError(f"weights are {{name: number}}, not {values.told(given)}.")
    for called, weight in given.items():
        if called is None or called not in names:
            raise TksUsageError(f"No stream is called {values.told(called)}, which has a weight.")
        if not 0 < values.real(weight, "A weight") < float("inf"):
            raise TksUsageError(f"A weight is a positive number, not {values.told(weight)}.")
    return {called: float(weight) for called, weight in given.items()}


def _part(called: Optional[str], source: Source, weight: float) -> c.Combined:
    named = values.text(called, "A name")
    data = first_bytes(source, None)
    if data[: len(_SEQUENCE)] == _SEQUENCE:
        raise TksUnsupportedError("A sequence of frames is not combined with others.")
    return c.Combined(
        size=ctypes.sizeof(c.Combined), data=data, data_size=len(data), name=named, weight=weight
    )
