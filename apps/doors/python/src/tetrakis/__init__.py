# SPDX-License-Identifier: Apache-2.0
"""Tetrakis: heights and textures of terrain in one stream that may be cut after any byte.

    stream = tetrakis.encode(heights, texture, bytes=65536)
    with tetrakis.open(stream) as terrain:
        coarse = terrain.heights(bytes=4096)
        vertices, triangles, uv = terrain.mesh(triangles=5000)

Surfaces of scans and other triangle meshes likewise:

    stream = tetrakis.encode_object(points, triangles, bytes=20000)
    with tetrakis.open(stream) as thing:
        points, triangles, *_ = thing.object(triangles=5000)

Frames that follow one another in time:

    stream = tetrakis.encode_sequence(cube, times=dates, max_error=0.1)
    with tetrakis.open_sequence(stream) as sequence:
        series = sequence[:, 10, 20]

As a server has them (`tetrakis serve`):

    for frame in tetrakis.receive("http://127.0.0.1:8000/flood.tks", live=True):
        print(frame.time, frame.stream.heights().max())

Further rasters over the same ground, each of which `open(component=...)` takes:

    stream = tetrakis.combine(terrain, {"normal": normals, "2019": before}, bytes=100000)

Terrain that no machine holds, by windows of its source: `tetrakis.mosaic`.
"""

from . import mosaic
from ._clock import Clock
from ._combine import combine
from ._components import Component
from ._encode import encode
from ._encode_object import EncodedObject, ObjectReport, encode_object
from ._encode_sequence import encode_sequence
from ._errors import (
    Status,
    TksCorruptError,
    TksError,
    TksIOError,
    TksLimitError,
    TksMemoryError,
    TksMismatchError,
    TksTruncatedError,
    TksUnsupportedError,
    TksUsageError,
)
from ._info import Info
from ._objects import BaseMesh, ObjectMesh
from ._rasterio import from_rasterio, to_geotiff
from ._reception import Reception, TimedFrame, receive
from ._sequence import Sequence, open_sequence
from ._sequence_encoder import SequenceEncoder
from ._stream import GlobeMesh, Mesh, Stream, open, truncate
from ._tks import tks_check, tks_decode, tks_encode, tks_version
from ._version import __version__
from ._xarray import from_xarray

__all__ = [
    "BaseMesh",
    "Clock",
    "Component",
    "EncodedObject",
    "GlobeMesh",
    "Info",
    "Mesh",
    "ObjectMesh",
    "ObjectReport",
    "Reception",
    "Sequence",
    "SequenceEncoder",
    "Status",
    "Stream",
    "TimedFrame",
    "TksCorruptError",
    "TksError",
    "TksIOError",
    "TksLimitError",
    "TksMemoryError",
    "TksMismatchError",
    "TksTruncatedError",
    "TksUnsupportedError",
    "TksUsageError",
    "__version__",
    "combine",
    "encode",
    "encode_object",
    "encode_sequence",
    "from_rasterio",
    "from_xarray",
    "mosaic",
    "open",
    "open_sequence",
    "receive",
    "tks_check",
    "tks_decode",
    "tks_encode",
    "tks_version",
    "to_geotiff",
    "truncate",
]
