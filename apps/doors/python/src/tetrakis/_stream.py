# SPDX-License-Identifier: Apache-2.0
"""From a stream to arrays and meshes."""

from __future__ import annotations

import builtins
import ctypes
import math
from contextlib import contextmanager
from typing import Any, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _components as listed
from . import _library as c
from . import _objects as objects
from . import _picture as picture
from . import _sketch as sketch
from . import _values as values
from ._access import Access, access
from ._decoder import Decoder
from ._errors import TksUsageError
from ._ground import mesh_place, mesh_uv
from ._indexing import selection
from ._info import Info, of_window
from ._source import BytesLike, Source, first_bytes


class Mesh(NamedTuple):
    """A conforming mesh; unpacks as ``vertices, triangles, uv``."""

    vertices: NDArray[Any]
    """float64 (n, 3): x, y and the height in `Info.unit`."""
    triangles: NDArray[Any]
    """uint32 (m, 3): places in `vertices`, counter-clockwise seen from above."""
    uv: NDArray[Any]
    """float32 (n, 2): place in the texture; (0, 0) is where its first row and column begin, (1, 1)
    where its last ones end. So v grows downwards, with the rows (without geotransforms it is
    row / (rows - 1)), as in glTF; viewers whose v grows upwards, such as trimesh and PyVista, take
    ``1 - v``. Where heights and texture have geotransforms in one CRS, these say so,
    and what lies outside the texture is below 0 or above 1 (the command line shows the texture's
    border there). CRSs are compared as text, codes without their vertical part and in any case.
    Where they differ, or a geotransform is missing, the texture covers the heights from the first
    sample to the last."""


class GlobeMesh(NamedTuple):
    """A mesh round a globe; unpacks as ``positions, pixels, heights, triangles``."""

    positions: NDArray[Any]
    """float64 (n, 3): metres from the centre; x towards longitude and latitude 0, y towards
    longitude 90, z to the north pole. Vertices on both sides of a seam are equal to the last bit:
    taken for one, they close the mesh."""
    pixels: NDArray[Any]
    """float64 (n, 2): column and row, of which (0, 0) is the outer corner of the first sample; of a
    cube in its raster of 2^depth + 1 columns, with the six faces one below the other."""
    heights: NDArray[Any]
    """float32 (n): in `Info.unit`, not exaggerated."""
    triangles: NDArray[Any]
    """uint32 (m, 3): places in `positions`, counter-clockwise seen from outside."""


_ANY = 2**63  #: samples; memory bounds what is decoded of them


def open(
    source: Source,
    *,
    bytes: Optional[int] = None,
    component: Optional[listed.ComponentLike] = None,
    threads: int = 1,
    max_samples: Optional[int] = None,
    max_texels: Optional[int] = None,
    max_memory: Optional[int] = None,
) -> "Stream":
    """Opens a stream, or any prefix of one that holds its header.

    source: a path, the bytes themselves, a file open for reading bytes, an http or https address,
        or any other address that the package fsspec knows, if it is installed ("s3://...").
        Streams with an index (``encode(index="windows")``) are read by ranges: a window or a level
        fetches the bytes that it needs, and a file has to stay open for that. Others are read at
        once.
    bytes: read no more than so many; the rest is not fetched.
    component: of a stream of several rasters (:func:`tetrakis.combine`) another one than the first
        of its kind, by its name or number, or a list of these: heights and everything that is
        about them, or the texture, are then those. Of a name that heights and a texture share both
        are taken.
    threads: how many one call may use. What is decoded never depends on it.
    max_memory (bytes; 8 GiB unless given), max_samples, max_texels (any number unless given): what
        goes beyond raises :class:`TksLimitError` before anything is allocated. Of a plane that
        memory does not hold there are windows and coarse levels.

    Safe on any bytes: raises :class:`TksCorruptError`, :class:`TksTruncatedError` (the sentence
    says how many bytes the header takes), :class:`TksUnsupportedError`, :class:`TksLimitError`, or
    the OSError of a file that cannot be read.
    """
    limits = c.Limits(
        size=ctypes.sizeof(c.Limits),
        max_samples=values.unsigned(max_samples, "max_samples", 64) or _ANY,
        max_texels=values.unsigned(max_texels, "max_texels", 64) or _ANY,
        max_memory=values.unsigned(max_memory, "max_memory", 64),
    )
    threads = values.unsigned(threads, "threads")
    return Stream(access(source, bytes, limits, threads, listed.chosen(component)))


def truncate(stream: BytesLike, bytes: int) -> builtins.bytes:
    """The first `bytes` bytes of a stream (all of it, if it has no more), which are a stream too:
    about the best that so few bytes can hold. Raises :class:`TksTruncatedError` if they do not hold
    the header; the sentence says how many do."""
    cut = first_bytes(stream, bytes)
    with Decoder(cut, c.Limits(size=ctypes.sizeof(c.Limits), max_samples=_ANY, max_texels=_ANY)):
        return cut


class Stream:
    """An open stream. Made by :func:`tetrakis.open`; closes with ``with`` or :meth:`close`.

    Each method decodes anew and keeps nothing, so any number of threads may use one stream: they
    run side by side, since decoding releases the GIL.

    A stream is also an array of its heights (of its texture, where it has no heights):
    ``stream.shape``, ``stream[0:64, ::4]``, ``numpy.asarray(stream)``.
    """

    def __init__(self, access: Access) -> None:
        self._access = access

    def __enter__(self) -> "Stream":
        self._access.info()
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        if self.closed:
            return "<tetrakis.Stream, closed>"
        info = self.info
        parts = [
            f"{name} {' x '.join(map(str, shape))} {dtype}"
            for name, shape, dtype in (
                ("heights", info.shape, info.dtype),
                ("texture", info.texture_shape, info.texture_dtype),
            )
            if shape
        ]
        if self.is_object:
            parts.insert(0, f"object of {_parts(info)}")
        if info.components > (info.shape is not None) + (info.texture_shape is not None):
            parts.append(f"of {info.components} components")
        parts.append(f"{info.available_bytes} of {info.stream_bytes} bytes")
        return f"<tetrakis.Stream: {', '.join(parts)}>"

    def _repr_html_(self) -> str:
        """For notebooks: a picture of 256 samples or fewer a side, and what it is of."""
        info = self.info
        facts: dict[str, Any] = {
            "heights": info.shape and f"{' × '.join(map(str, info.shape))} {info.dtype}",
            "texture": info.texture_shape
            and f"{' × '.join(map(str, info.texture_shape))} {info.texture_dtype}",
            "bytes": f"{info.available_bytes} of {info.stream_bytes}",
            "lossless": info.lossless or None,
            "largest error": info.max_error and f"{info.max_error} {info.unit or ''}",
            "CRS": info.crs and info.crs[:60],
        }
        if self.is_object:
            facts = {"object": info.description or "", "of": _parts(info), **facts}
        return picture.page(picture.png(self._thumbnail(info)), facts)

    def _thumbnail(self, info: Info) -> NDArray[Any]:
        if self.is_object:
            most = 0 if info.base_mesh is None else sketch.TRIANGLES
            return sketch.drawn(self.object(most), info.texture_white_level or 65535)
        if info.texture_shape is not None:
            level = _level_for(info.texture_shape, info.texture_coarsest_level)
            return picture.eight_bits(self.texture(level), info.texture_white_level or 65535)
        level = _level_for(info.shape or (1, 1), info.coarsest_level)
        return picture.relief(self.surface(level), (info.spacing or (1.0, 1.0))[0])

    def close(self) -> None:
        """Lets go of the bytes. Calls of other threads that have begun go on to their end."""
        self._access.close()

    @property
    def closed(self) -> bool:
        return self._access.closed

    @property
    def info(self) -> Info:
        """What the stream says of itself at level 0, as an :class:`Info`, by the bytes that have
        been read: of a large file or address with an index these are the first."""
        return self._access.info()

    @property
    def components(self) -> List[listed.Component]:
        """The rasters that the stream has: one or two of most, more of what
        :func:`tetrakis.combine` made. ``open(component=...)`` takes others than the first ones."""
        with self._access.glance(None) as decoder:
            return decoder.components()

    def describe(
        self,
        level: int = 0,
        texture_level: int = 0,
        bytes: Optional[int] = None,
        *,
        window: Optional[values.WindowLike] = None,
    ) -> Info:
        """`info` of mip levels, of the first `bytes` bytes, or of a window of the heights: its
        `shape` and `geotransform`."""
        with self._access.glance(bytes) as decoder:
            decoder.set_levels(*_levels(level, texture_level))
            info = decoder.info()
        if window is None:
            return info
        part = values.window(window, info.shape or (0, 0))
        return info if part is None else of_window(info, part)

    @property
    def shape(self) -> Tuple[int, ...]:
        """(rows, columns) of the heights; of a stream without heights that of the texture."""
        info = self.info
        return info.shape or info.texture_shape or ()

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of the samples that have `shape`."""
        info = self.info
        return info.dtype or info.texture_dtype or np.dtype("u1")

    @property
    def ndim(self) -> int:
        """2, or 3 for a texture of several channels without heights."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """How many samples there are."""
        return math.prod(self.shape)

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, key: Any) -> Any:
        """What ``numpy.asarray(stream)[key]`` gives, for integers and slices: decodes a window."""
        return self.read("heights" if self.info.shape is not None else "texture", key)

    def read(self, component: str, key: Any, level: int = 0) -> Any:
        """The samples that an index of integers and slices selects of "heights" or "texture"."""
        values.choice(component, ("heights", "texture"), "component")
        of_texture = component == "texture"
        info = self.describe(0, level) if of_texture else self.describe(level)
        shape = (info.texture_shape if of_texture else info.shape) or (0, 0)
        window, inner, empty = selection(key, shape)
        if empty:
            return np.empty(shape, info.texture_dtype if of_texture else info.dtype)[key]
        read = self.texture if of_texture else self.heights
        return read(level, (window.x, window.y, window.width, window.height))[inner]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        if copy is False:
            raise ValueError("An array of a stream is decoded, hence new: copy=False has none.")
        samples = self.heights() if self.info.shape is not None else self.texture()
        return samples if dtype is None else samples.astype(dtype, copy=False)

    def heights(
        self,
        level: int = 0,
        window: Optional[values.WindowLike] = None,
        bytes: Optional[int] = None,
        *,
        masked: bool = False,
        out: Optional[NDArray[Any]] = None,
    ) -> NDArray[Any]:
        """Samples of the heights: (rows, columns) of `info.dtype`.

        level: 1/2^level of the resolution, up to `info.coarsest_level`.
        window: (x, y, width, height) in samples of the level, or slices: ``numpy.s_[0:64, 32:96]``.
            The same samples as without it; of streams with regions much faster. Where columns go
            round the Earth, four numbers may go on behind the last column.
        bytes: decodes a prefix of so many bytes.
        masked: gives a masked array whose mask is True at voids; otherwise these are `info.nodata`,
            or NaN without one.
        out: an array in C order to write to, of the right shape and type.
        """
        parts = [c.PART_HEIGHTS] + [c.PART_VALIDITY] * values.flag(masked, "masked")
        with self._part(parts, level, window, bytes) as (decoder, info, part):
            samples = decoder.heights(info, part, out)
            if not masked:
                return samples
            return _masked(samples, decoder.validity(info, part), info)

    def surface(
        self,
        level: int = 0,
        window: Optional[values.WindowLike] = None,
        bytes: Optional[int] = None,
        *,
        out: Optional[NDArray[Any]] = None,
    ) -> NDArray[Any]:
        """Heights in `info.unit` (scale and offset are applied): float32 (rows, columns), voids
        NaN. Prefixes may say more than whole samples can show, so this is what to draw.
        Arguments are those of :meth:`heights`."""
        with self._part([c.PART_HEIGHTS], level, window, bytes) as (decoder, info, part):
            return decoder.surface(info, part, out)

    def validity(
        self,
        level: int = 0,
        window: Optional[values.WindowLike] = None,
        bytes: Optional[int] = None,
    ) -> NDArray[Any]:
        """bool (rows, columns): True where a sample is a height, False where it is void.
        Arguments are those of :meth:`heights`."""
        with self._part([c.PART_VALIDITY], level, window, bytes) as (decoder, info, part):
            return decoder.validity(info, part)

    def texture(
        self,
        level: int = 0,
        window: Optional[values.WindowLike] = None,
        bytes: Optional[int] = None,
        *,
        out: Optional[NDArray[Any]] = None,
    ) -> NDArray[Any]:
        """Texels: (rows, columns) of a grey texture, else (rows, columns, channels), of
        `info.texture_dtype`. Arguments are those of :meth:`heights`, counted in texels."""
        with self._part([c.PART_TEXTURE], level, window, bytes) as (decoder, info, part):
            return decoder.texture(info, part, out)

    def mesh(
        self,
        triangles: Optional[int] = None,
        view: Optional[ArrayLike] = None,
        bytes: Optional[int] = None,
        *,
        coordinates: str = "local",
    ) -> Mesh:
        """The best mesh of at most `triangles` triangles, or the coarsest one where that has more
        (2 for most grids, a few for some, many for long ones). Without a number, all samples.

        view: a 4 x 4 matrix that takes (column, row, height, 1) to clip coordinates: only what a
            camera with it may see.
        bytes: of a prefix of so many bytes.
        coordinates: of the vertices. "local": x = column * spacing, y = -row * spacing in metres,
            or in samples where the spacing is unknown; y = row * spacing where the geotransform is
            that of a mirrored raster, such as one whose first row is the southern one. "crs": x and
            y by `info.geotransform`, at the middle of samples, in units of the CRS. The third is
            the height in `info.unit`.

        Few triangles of a large stream decode only the levels that they can show. No triangle
        touches a void; where all samples are void the mesh is empty.
        """
        count = values.unsigned(triangles, "triangles")
        if triangles is not None and count == 0:
            raise TksUsageError("A mesh takes one triangle or more; None means all samples.")
        values.choice(coordinates, ("local", "crs"), "coordinates")
        matrix = None if view is None else values.matrix(view)
        with self._access.prefix(bytes) as decoder:
            info = decoder.info()
            if info.cube_depth is not None:
                raise TksUsageError("Heights on a cube have a mesh round the globe: globe_mesh().")
            if info.base_mesh is not None or info.object_triangles is not None:
                raise TksUsageError("The surface of an object is a mesh of its own: object().")
            if coordinates == "crs" and info.shape and info.geotransform is None:
                raise TksUsageError("The stream does not say where its heights lie.")
            places, heights, corners = decoder.mesh(count, matrix)
        rows, columns = np.divmod(places.astype(np.int64), (info.shape or (0, 0))[1])
        transform = info.geotransform if coordinates == "crs" else None
        x, y, mirrored = mesh_place(info, columns, rows, transform)
        vertices = np.stack([x, y, heights.astype(np.float64)], axis=1)
        if mirrored:
            corners = np.ascontiguousarray(corners[:, ::-1])
        return Mesh(vertices, corners, mesh_uv(info, columns, rows))

    def globe_mesh(
        self,
        triangles: Optional[int] = None,
        bytes: Optional[int] = None,
        *,
        exaggeration: float = 1.0,
        semi_major: float = 6378137.0,
        semi_minor: float = 6356752.314245,
    ) -> GlobeMesh:
        """The mesh of about `triangles` triangles round the Earth: of heights on a cube, and of
        those whose geotransform in degrees goes once round. It gets some more, up to half as many
        or a few hundred, so that no edge cuts deep through the globe. Without a number, all
        samples.

        bytes: of a prefix of so many bytes.
        exaggeration: what heights are multiplied by.
        semi_major, semi_minor: the globe's semi-axes in metres; without them WGS 84.

        It is closed but around voids and where the grid ends before a pole.
        """
        count = values.unsigned(triangles, "triangles")
        if triangles is not None and count == 0:
            raise TksUsageError("A mesh takes one triangle or more; None means all samples.")
        globe = c.Globe(
            size=ctypes.sizeof(c.Globe),
            semi_major=values.real(semi_major, "semi_major"),
            semi_minor=values.real(semi_minor, "semi_minor"),
            degrees=1,
            exaggeration=values.real(exaggeration, "exaggeration"),
        )
        with self._access.prefix(bytes) as decoder:
            return GlobeMesh(*decoder.globe_mesh(count, globe))

    @property
    def is_object(self) -> bool:
        """Whether this is the surface of an object, whose mesh :meth:`object` gives. Its heights
        are those along the normals of `info.base_mesh`; or it has none, but
        `info.object_triangles`."""
        info = self.info
        return info.base_mesh is not None or info.object_triangles is not None

    def object(
        self, triangles: int = 0, coded: bool = False, bytes: Optional[int] = None
    ) -> objects.ObjectMesh:
        """The surface of an object as the best mesh of at most `triangles` triangles, by the
        squared distance between surfaces, but no fewer than two for each of its patches. 0: of
        every sample. With its texture, where it has one, as an image that lies on the mesh.
        Of triangles that are coded as they are there are no more than asked for: vertices collapse
        into neighbours, and small parts vanish where `triangles` are few.

        coded: the vertices whose heights the stream tells, however many these are.
        bytes: of a prefix of so many bytes.

        Points that are equal are one: taken for one, they leave no edge open but at borders of the
        object.
        """
        count = values.unsigned(triangles, "triangles")
        kind = c.MESH_CODED if values.flag(coded, "coded") else c.MESH_BUDGET
        if count and kind == c.MESH_CODED:
            raise TksUsageError("A coded mesh has the triangles that the stream tells: give none.")
        with self._access.prefix(bytes) as decoder:
            info = decoder.info()
            points, pixels, texcoords, corners = decoder.object_mesh(kind, count)
            base = info.base_mesh
            if base is not None and base.texture_depth is None or info.texture_shape is None:
                return objects.ObjectMesh(points, corners, pixels, None, None)
            texture = decoder.texture(info, None, None)
        if base is None:
            return objects.ObjectMesh(points, corners, None, texcoords, texture)
        atlas = objects.atlas_of(texture)
        return objects.ObjectMesh(
            points, corners, pixels, objects.texcoords_of(pixels, base), atlas
        )

    def locate(
        self, columns: ArrayLike, rows: ArrayLike, *, part: str = "heights"
    ) -> NDArray[np.float64]:
        """Longitudes and latitudes in degrees, (..., 2), of columns and rows of the heights or of
        the `part` "texture", of which (0, 0) is the outer corner of the first sample: for streams
        that hold positions, as `tetrakis encode` writes them where browsers do not know the CRS.
        Raises :class:`TksUnsupportedError` for others."""
        which = values.choice(part, ("heights", "texture"), "part")
        number = (c.PART_HEIGHTS, c.PART_TEXTURE)[which]
        across, down = np.broadcast_arrays(
            np.asarray(columns, np.float64), np.asarray(rows, np.float64)
        )
        with self._decoder(0, 0, None) as decoder:
            places = [decoder.locate(number, *at) for at in zip(across.flat, down.flat)]
        return np.array(places, np.float64).reshape(*across.shape, 2)

    def verify(self) -> None:
        """Checks the syntax of the whole stream. Raises :class:`TksTruncatedError` if it is a
        prefix, :class:`TksCorruptError` if it is damaged."""
        with self._access.whole() as decoder:
            decoder.verify()

    @contextmanager
    def _part(
        self,
        parts: Sequence[int],
        level: int,
        window: Optional[values.WindowLike],
        count: Optional[int],
    ) -> Iterator[Tuple[Decoder, Info, Optional[c.Window]]]:
        """A decoder at `level` with the bytes that these parts of the window need, its info, and
        the window. A whole plane takes all bytes, so that their checksum can be looked at."""
        of_texture = parts[0] == c.PART_TEXTURE
        levels = _levels(0, level) if of_texture else _levels(level, 0)
        with self._access.glance(None) as decoder:
            decoder.set_levels(*levels)
            info = decoder.info()
        part = values.window(window, (info.texture_shape if of_texture else info.shape) or (0, 0))
        if count is None and (part is not None or level > 0):
            with self._access.part(levels, [(each, part) for each in parts]) as decoder:
                yield decoder, info, part
            return
        with self._access.prefix(count) as decoder:
            decoder.set_levels(*levels)
            yield decoder, info, part


def _levels(heights: int, texture: int) -> Tuple[int, int]:
    return values.unsigned(heights, "level"), values.unsigned(texture, "level")


def _parts(info: Info) -> str:
    """Of an object."""
    if info.base_mesh is None:
        return f"{info.object_triangles} triangles"
    side = 2**info.base_mesh.depth + 1
    return f"{len(info.base_mesh.corners)} patches of {side} x {side}"


def _level_for(shape: Sequence[int], coarsest: int) -> int:
    """The finest level of 256 samples or fewer a side."""
    return min(coarsest, max(0, (max(shape[:2]) - 1).bit_length() - 8))


def _masked(samples: NDArray[Any], valid: NDArray[Any], info: Info) -> np.ma.MaskedArray:
    fill = None
    if info.nodata is not None:
        kept = np.array([info.nodata]).astype(samples.dtype)[0]
        fill = kept if kept == info.nodata else None
    return np.ma.MaskedArray(samples, mask=~valid, fill_value=fill)
