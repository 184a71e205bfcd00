# SPDX-License-Identifier: Apache-2.0
"""From a mesh of triangles to a stream."""

from __future__ import annotations

import builtins
import ctypes
import json
from typing import Any, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _library as c
from . import _stoppable as stoppable
from . import _values as values
from ._encode import image_struct, run_encoder, set_target
from ._errors import TksUsageError

# So many triangles and less are coded before anybody would press Ctrl-C.
_SHORT = 1 << 9

_PLAIN_IMAGE = dict(
    crs=None,
    geotransform=None,
    registration=None,
    geo_keys=None,
    alpha=True,
    white_level=0,
    domain="plane",
)


class ObjectTrial(NamedTuple):
    """A stream of one kind, for the target."""

    bytes: int
    psnr: float
    """Of the surface, as of :class:`ObjectReport`."""
    screen_psnr: Optional[float]
    """Of pictures from all around the mesh, in dB; None: there is no texture."""


class ObjectReport(NamedTuple):
    """What became of a mesh. Distances are between its surface and that of the decoded stream, in
    its unit, of 20 000 places of either."""

    triangles: int
    """That are left after cleaning."""
    dropped_triangles: int
    """Degenerate or double ones."""
    cut_edges: int
    """Of more than two triangles, or of two that cannot face one way."""
    components: int
    """Connected parts."""
    borders: int
    """Closed rings of open edges."""
    patches: int
    depth: int
    """Patches have (2^depth + 1)^2 samples."""
    diagonal: float
    """Of the box around the mesh."""
    resampling_error: float
    """Of all samples, uncoded: the larger of the two RMS distances."""
    error: float
    """Of the stream, likewise."""
    largest: float
    """The largest distance."""
    psnr: float
    """20 log10(diagonal / error)."""
    texture_depth: Optional[int]
    """As `depth`, of texels; None: there is no texture on the patches."""
    kind: str
    """How it was coded: "resampled" or "triangles", which have no patches."""
    coded_triangles: Optional[int]
    """Of "triangles": how many there are."""
    as_resampled: Optional[ObjectTrial]
    as_triangles: Optional[ObjectTrial]
    """Of which `kind` is the better one. None: it was not asked for, or cannot meet the target."""
    sketch_bytes: Optional[int]
    """Of the sketch that the stream begins with; None: there is none."""


class EncodedObject(builtins.bytes):
    """A stream, as bytes, with the `report` of its encoder. Slices are plain bytes."""

    report: ObjectReport


class _Given(NamedTuple):
    """A mesh of whatever kind."""

    points: Any
    triangles: Any
    texcoords: Any
    texture: Any


def _unpacked(mesh: Any) -> _Given:
    """Points and triangles, texture coordinates and image of an object that has them: of trimesh,
    whose v grows upwards, or of meshio."""
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        visual = getattr(mesh, "visual", None)
        uv, material = getattr(visual, "uv", None), getattr(visual, "material", None)
        image = getattr(material, "baseColorTexture", None)
        image = getattr(material, "image", None) if image is None else image
        if uv is None or image is None:
            return _Given(mesh.vertices, mesh.faces, None, None)
        uv = np.array(uv, np.float64)
        uv[:, 1] = 1 - uv[:, 1]
        return _Given(mesh.vertices, mesh.faces, uv, _pixels(image))
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        triangles = mesh.cells_dict.get("triangle", np.empty((0, 3), np.uint32))
        return _Given(mesh.points, triangles, None, None)
    raise TksUsageError(
        "encode_object takes points and triangles, or a mesh with vertices and faces, "
        f"not {values.told(mesh)}."
    )


def _beside(mesh: _Given, given: _Given) -> _Given:
    """The mesh with the texture that is given, or its own."""
    if given.texture is None and given.texcoords is None:
        return mesh
    return mesh._replace(texcoords=given.texcoords, texture=given.texture)


def _pixels(image: Any) -> NDArray[Any]:
    """Of an image of Pillow: those of a palette, say, are not yet colours."""
    mode = getattr(image, "mode", "RGB")
    return np.asarray(image if mode in ("L", "LA", "RGB", "RGBA") else image.convert("RGB"))


def _points(given: Any) -> NDArray[np.float64]:
    points = _numbers(given, "Points")
    if points.ndim != 2 or points.shape[1] != 3:
        raise TksUsageError(f"Points are (n, 3), not an array of shape {points.shape}.")
    kept = points.astype(np.float64, order="C")
    whole = points.dtype.kind in "iu" and points.dtype.itemsize == 8
    if whole and np.abs(kept).max(initial=0) > 2.0**53:
        raise TksUsageError(f"Points of type {points.dtype} have values that float64 cannot hold.")
    return kept


def _triangles(given: Any) -> NDArray[np.uint32]:
    triangles = _numbers(given, "Triangles")
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise TksUsageError(
            f"Triangles are (m, 3) places in points, not an array of shape {triangles.shape}."
        )
    with np.errstate(invalid="ignore"):
        kept = triangles.astype(np.uint32, order="C")
    if (kept != triangles).any():
        wrong = triangles[kept != triangles][0]
        raise TksUsageError(f"Triangles are places in points, from 0 on, not {wrong}.")
    return kept


def _texcoords(given: Any, points: int, triangles: NDArray[np.uint32]) -> NDArray[np.float32]:
    """Three for each triangle."""
    places = _numbers(given, "Texture coordinates")
    if places.shape == (points, 2):
        if triangles.size and int(triangles.max()) >= points:
            raise TksUsageError(f"A triangle names point {triangles.max()}, which is not there.")
        places = places[triangles]
    if places.shape != (len(triangles), 3, 2):
        raise TksUsageError(
            f"Texture coordinates are ({points}, 2), one for each point, or "
            f"({len(triangles)}, 3, 2), of the corners of each triangle, "
            f"not an array of shape {places.shape}."
        )
    with np.errstate(over="ignore"):
        return places.astype(np.float32, order="C")


def _numbers(given: Any, what: str) -> NDArray[Any]:
    array = values.array(given, what)
    if array.dtype.kind not in "iuf":
        raise TksUsageError(f"{what} are numbers, not of type {array.dtype}.")
    return array


def _mesh_struct(given: _Given, texts: dict) -> Tuple[c.TriangleMesh, Tuple[Any, ...]]:
    """The struct, and the arrays that it points to: they must live as long."""
    points, triangles = _points(given.points), _triangles(given.triangles)
    struct = c.TriangleMesh(
        size=ctypes.sizeof(c.TriangleMesh),
        vertex_count=values.unsigned(len(points), "The number of points"),
        triangle_count=values.unsigned(len(triangles), "The number of triangles"),
        positions=points.ctypes.data,
        triangles=triangles.ctypes.data,
        unit=values.text(texts["unit"], "unit"),
        description=values.text(texts["description"], "description"),
    )
    texcoords = None
    if given.texcoords is not None:
        texcoords = _texcoords(given.texcoords, len(points), triangles)
        struct.texcoords = texcoords.ctypes.data
    return struct, (points, triangles, texcoords)


def _map_structs(maps: Mapping[str, Any]) -> Tuple[Any, Tuple[Any, ...]]:
    """An array of structs, and what it points to, which must live as long."""
    structs, kept = (c.ObjectMap * len(maps))(), []
    for struct, (name, given) in zip(structs, maps.items()):
        image, texels = image_struct(given, _PLAIN_IMAGE)
        struct.size = ctypes.sizeof(c.ObjectMap)
        struct.name = values.text(name, "The name of a map")
        struct.image = ctypes.addressof(image)
        kept.append((image, texels))
    return structs, tuple(kept)


def _material(given: Union[str, Mapping[str, Any], None]) -> Optional[builtins.bytes]:
    """JSON, as it is or of a mapping."""
    if given is not None and not isinstance(given, str):
        try:
            given = json.dumps(given, allow_nan=False)
        except (TypeError, ValueError) as error:
            raise TksUsageError(f"material is not what JSON has: {error}.") from None
    return values.text(given, "material")


def _trial(raw: c.ObjectTrial) -> Optional[ObjectTrial]:
    return ObjectTrial(raw.bytes, raw.psnr, raw.screen_psnr or None) if raw.bytes else None


def _report(raw: c.ObjectReport) -> ObjectReport:
    told = {name: getattr(raw, name) for name in ObjectReport._fields}
    told["kind"] = c.OBJECT_KINDS[raw.kind]
    for name in ("texture_depth", "coded_triangles", "sketch_bytes"):
        told[name] = told[name] or None
    for name in ("as_resampled", "as_triangles"):
        told[name] = _trial(told[name])
    return ObjectReport(**told)


def _sketch_bytes(sketch: Union[str, int, None]) -> int:
    if sketch is None:
        return c.NO_SKETCH
    if sketch == "auto":
        return 0
    if isinstance(sketch, str) or values.unsigned(sketch, "sketch", 63) == 0:
        raise TksUsageError('sketch must be a number of bytes, None or "auto".')
    return int(sketch)


def encode_object(
    points: Union[ArrayLike, Any],
    triangles: Optional[ArrayLike] = None,
    *,
    texcoords: Optional[ArrayLike] = None,
    texture: Optional[ArrayLike] = None,
    maps: Optional[Mapping[str, ArrayLike]] = None,
    material: Union[str, Mapping[str, Any], None] = None,
    bytes: Optional[int] = None,
    psnr: Optional[float] = None,
    max_error: Optional[float] = None,
    kind: str = "auto",
    sketch: Union[str, int, None] = "auto",
    unit: Optional[str] = None,
    description: Optional[str] = None,
    index: Union[bool, str] = False,
    threads: int = 1,
    progress: Optional[stoppable.Progress] = None,
) -> EncodedObject:
    """Codes the surface of a triangle mesh, such as a scan, into one stream, of which every prefix
    that holds the header is a stream as well. The result is bytes, as that of
    :func:`tetrakis.encode`, and has a `report`, an :class:`ObjectReport`.

    kind: "resampled": the mesh is resampled over quads; what comes back is its surface, as triangles
        of any number, not its triangles. This suits scans and sculptures. "triangles": they are
        coded as they are, or fewer ones where the target takes no more; this suits designed parts
        and models of few triangles. "auto": in whichever way comes nearer to the mesh.

    sketch: what the stream begins with, so that something is seen early: a stream of about so many
        bytes, None, or "auto": a 32nd part, where the header is long.

    The mesh
        points: (n, 3) of any numbers that float64 holds. triangles: (m, 3) places in `points`,
            counter-clockwise seen from outside. They need not fit together: points at equal places
            are joined, degenerate and double triangles dropped, and edges of more than two cut.
            Instead of both: a mesh of trimesh (its texture comes along) or of meshio.
        texcoords: (n, 2), or (m, 3, 2) where corners of triangles have their own: places in the
            texture. (0, 0) is its upper left corner and (1, 1) its lower right one, as in glTF; it
            repeats beyond these. They become float32.
        texture: as that of `encode`. It is resampled on quads, and needs no texcoords there.
        maps: images beside a texture, of any size, which lie on the mesh as it does and become
            components of these names. "normal", "metallic_roughness", "occlusion" and "emissive"
            are maps of a material as glTF has them. A resampled mesh leaves "normal" out, whose
            normals count from texcoords.
        material: factors of a glTF material by its names, or their JSON.
        unit: of `points`, such as "mm". description: a name.

    Targets: one of them
        bytes: the stream takes at most so many; the least error is sought. With a texture the only
            target.
        psnr: of the surface, 20 log10(diagonal / error), in dB. The fewest bytes are sought.
        max_error: every sample keeps its height, or every corner its place, within this distance,
            in `unit`.

    index, threads, progress: as for `encode`; each number of quads that is tried begins a progress
    of its own.

    Raises what `encode` raises.
    """
    if progress is not None and not callable(progress):
        raise TksUsageError(f"progress must be a function, not {values.told(progress)}.")
    target = dict(bytes=bytes, psnr=psnr, max_error=max_error, lossless=False)
    if (bytes, psnr, max_error) == (None, None, None):
        raise TksUsageError("An object takes a target: bytes, psnr or max_error.")
    options = c.EncodeOptions(
        size=ctypes.sizeof(c.EncodeOptions),
        threads=values.unsigned(threads, "threads"),
        index=values.choice(index, c.GIVEN_INDEXES, "index"),
    )
    set_target(options, target)
    given = _Given(points, triangles, texcoords, texture)
    if triangles is None:
        given = _beside(_unpacked(points), given)
    if given.texture is None and given.texcoords is not None:
        raise TksUsageError("texcoords are places in a texture: give one.")
    mesh, arrays = _mesh_struct(given, dict(unit=unit, description=description))
    mesh.kind = values.choice(kind, c.OBJECT_KINDS, "kind")
    mesh.sketch_bytes = _sketch_bytes(sketch)
    mesh.material = _material(material)
    image, texels = None, None
    if given.texture is not None:
        image, texels = image_struct(given.texture, _PLAIN_IMAGE)
    if maps and given.texture is None:
        raise TksUsageError("maps lie on a mesh as its texture does: give one.")
    structs, kept = _map_structs(maps or {})
    mesh.maps, mesh.map_count = ctypes.addressof(structs), len(structs)
    report = c.ObjectReport(size=ctypes.sizeof(c.ObjectReport))

    def call(callback: Any, _kept: Any = (arrays, texels, structs, kept)) -> builtins.bytes:
        options.progress = callback
        return run_encoder(c.lib.tks_encode_object, mesh, image, options, report)

    stream = EncodedObject(stoppable.run(call, progress, mesh.triangle_count <= _SHORT))
    stream.report = _report(report)
    return stream
