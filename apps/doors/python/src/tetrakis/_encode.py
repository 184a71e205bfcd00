# SPDX-License-Identifier: Apache-2.0
"""From arrays to a stream."""

from __future__ import annotations

import builtins
import ctypes
from typing import Any, Dict, Literal, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _cube as cube
from . import _library as c
from . import _stoppable as stoppable
from . import _values as values
from ._errors import Status, TksUsageError, error

_OF_HEIGHTS = (
    "nodata unit spacing scale offset step crs geotransform registration vertical_datum "
    "description geo_keys domain latitudes"
).split()
_OF_TEXTURE = "crs geotransform registration geo_keys alpha white_level domain".split()

# So many samples and less are coded before anybody would press Ctrl-C.
SHORT = 1 << 14


def _unused_value(valid: NDArray[Any], fill_value: Any) -> int:
    """An integer of the array's type that none of the valid samples has."""
    limits = np.iinfo(valid.dtype)
    for value in (int(fill_value), limits.min, limits.max):
        if limits.min <= value <= limits.max and not (valid == value).any():
            return value
    used = np.unique(valid).astype(np.int64)
    gaps = np.flatnonzero(np.diff(used) > 1)
    if not gaps.size:
        raise TksUsageError(
            f"Every value of {valid.dtype} is a height, so none is left for masked samples: "
            "convert to a wider type."
        )
    return int(used[gaps[0]]) + 1


def _nodata(given: Union[float, str, None]) -> Tuple[Optional[float], bool]:
    """The value, and whether to look for it."""
    if given is None:
        return None, False
    if not isinstance(given, str):
        return values.real(given, "nodata"), False
    if given != "auto":
        raise TksUsageError(f'nodata takes a number or "auto", not {values.told(given)}.')
    return None, True


def _layer(array: Any) -> Any:
    """Rasters are read as (bands, rows, columns): without the axis of a single band."""
    if not isinstance(array, np.ma.MaskedArray):
        array = values.array(array, "Heights")
    return array[0] if array.ndim == 3 and array.shape[0] == 1 else array


def _filled(heights: np.ma.MaskedArray, nodata: Optional[float]) -> Tuple[NDArray[Any], Any]:
    """Heights whose masked samples are voids, and the nodata value to declare. Those of floats are
    NaN, which come back as whatever nodata is declared."""
    data = np.ma.getdata(heights)
    mask = np.ma.getmaskarray(heights)
    if not mask.any() or data.dtype.kind not in "iuf":
        return data, nodata
    data = values.exact(np.where(mask, data.dtype.type(0), data), "Heights")
    if data.dtype.kind == "f":
        return np.where(mask, data.dtype.type(np.nan), data), nodata
    if nodata is None:
        nodata = _unused_value(data[~mask], heights.fill_value)
    limits = np.iinfo(data.dtype)
    if not float(nodata).is_integer() or not limits.min <= nodata <= limits.max:
        raise TksUsageError(f"Masked samples of {data.dtype} cannot become the nodata {nodata}.")
    return np.where(mask, data.dtype.type(int(nodata)), data), nodata


def heights_struct(array: Any, place: dict) -> Tuple[c.Heights, NDArray[Any]]:
    """The struct, and the samples that it points to: they must live as long."""
    nodata, searched = _nodata(place["nodata"])
    array = _layer(array)
    if isinstance(array, np.ma.MaskedArray):
        array, nodata = _filled(array, nodata)
    data = values.exact(array, "Heights")
    if data.ndim != 2:
        raise TksUsageError(f"Heights are (rows, columns), not an array of shape {data.shape}.")
    struct = described_heights(data.shape, data.dtype, nodata, place)
    struct.data = data.ctypes.data
    if searched:
        _declare_fill(struct)
    return struct, data


def described_heights(
    shape: Tuple[int, ...], dtype: np.dtype, nodata: Optional[float], place: dict
) -> c.Heights:
    """The struct of heights, but for their samples."""
    spacing_x, spacing_y = values.spacing(place["spacing"])
    transform, has_transform = values.geotransform(place["geotransform"], "geotransform")
    first_latitude, last_latitude = values.latitudes(place["latitudes"])
    return c.Heights(
        size=ctypes.sizeof(c.Heights),
        width=values.unsigned(shape[1], "The width"),
        height=values.unsigned(shape[0], "The height"),
        sample=values.SAMPLES.index(dtype),
        scale=values.real(place["scale"], "scale"),
        offset=values.real(place["offset"], "offset"),
        step=values.real(0 if place["step"] is None else place["step"], "step"),
        spacing_x=spacing_x,
        spacing_y=spacing_y,
        unit=values.text(place["unit"], "unit"),
        vertical_datum=values.crs(place["vertical_datum"], "vertical_datum"),
        crs=values.crs(place["crs"], "crs"),
        has_nodata=nodata is not None,
        nodata=0 if nodata is None else nodata,
        geotransform=transform,
        has_geotransform=has_transform,
        registration=values.choice(place["registration"], c.REGISTRATIONS, "registration"),
        description=values.text(place["description"], "description"),
        geo_keys=values.text(place["geo_keys"], "geo_keys"),
        domain=values.choice(place["domain"], c.GIVEN_DOMAINS, "domain"),
        first_latitude=first_latitude,
        last_latitude=last_latitude,
    )


def _declare_fill(heights: c.Heights) -> None:
    """Declares what files write where they have no height, unless a mask has chosen a value."""
    if heights.has_nodata:
        return
    found = c.Outliers(size=ctypes.sizeof(c.Outliers))
    code = c.lib.tks_find_outliers(ctypes.byref(heights), ctypes.byref(found))
    if code == 0 and found.is_fill:
        heights.has_nodata, heights.nodata = 1, found.value


def image_struct(array: Any, place: dict) -> Tuple[c.Image, NDArray[Any]]:
    """The struct, and the texels that it points to: they must live as long."""
    if isinstance(array, np.ma.MaskedArray) and np.ma.getmaskarray(array).any():
        raise TksUsageError("A texture has no masked texels: give an alpha of 0 as last channel.")
    data = values.exact(values.array(array, "A texture"), "A texture", values.TEXELS)
    if data.ndim == 3 and data.shape[0] == 1 and data.shape[2] > 4:
        data = data[0]  # (bands, rows, columns), as rasters are read
    if data.ndim == 2:
        data = data[..., np.newaxis]
    if data.ndim != 3 or not 1 <= data.shape[2] <= 4:
        raise TksUsageError(
            "A texture is (rows, columns) or (rows, columns, channels) of 1 to 4 channels, "
            f"not an array of shape {data.shape}."
        )
    transform, has_transform = values.geotransform(place["geotransform"], "texture_geotransform")
    return c.Image(
        size=ctypes.sizeof(c.Image),
        width=values.unsigned(data.shape[1], "The width"),
        height=values.unsigned(data.shape[0], "The height"),
        channels=data.shape[2],
        sample=values.SAMPLES.index(data.dtype),
        data=data.ctypes.data,
        geotransform=transform,
        has_geotransform=has_transform,
        registration=values.choice(place["registration"], c.REGISTRATIONS, "texture_registration"),
        crs=values.crs(place["crs"], "texture_crs"),
        geo_keys=values.text(place["geo_keys"], "texture_geo_keys"),
        opaque=not values.flag(place["alpha"], "texture_alpha"),
        white_level=values.unsigned(place["white_level"], "texture_white_level"),
        domain=values.choice(place["domain"], c.DOMAINS[:2], "texture_domain"),
    ), data


def set_target(options: Any, target: dict) -> None:
    """Exactly one target; lossless where none is named."""
    named = [name for name, value in target.items() if value is not None and value is not False]
    if len(named) > 1:
        raise TksUsageError(f"Give one target, not {' and '.join(named)} together.")
    if not named and target["lossless"] is False:
        raise TksUsageError("A stream that is not lossless takes bytes, psnr or max_error.")
    name = named[0] if named else "lossless"
    if name == "bytes":
        options.bytes = values.unsigned(target[name], name, 64)
    elif name == "lossless":
        options.lossless = 1
    else:
        setattr(options, name, values.real(target[name], name))
    if not getattr(options, name):
        raise TksUsageError(f"The target {name} must be greater than 0.")


def _target(given: Dict[str, Any]) -> Dict[str, Any]:
    target = {name: given[name] for name in ("bytes", "psnr", "max_error", "lossless")}
    if target["lossless"] is not None:
        target["lossless"] = values.flag(target["lossless"], "lossless")
    return target


def options_struct(given: Dict[str, Any]) -> c.EncodeOptions:
    """Of the arguments of `encode`, but for its progress."""
    options = c.EncodeOptions(
        size=ctypes.sizeof(c.EncodeOptions),
        triangles=values.unsigned(given["triangles"], "triangles"),
        threads=values.unsigned(given["threads"], "threads"),
        regions=values.unsigned(given["regions"], "regions"),
        index=values.choice(given["index"], c.GIVEN_INDEXES, "index"),
        weights=values.choice(given["weights"], c.WEIGHTS, "weights"),
    )
    set_target(options, _target(given))
    return options


def places(given: Dict[str, Any]) -> Tuple[Dict[str, Any], Dict[str, Any]]:
    """What the arguments of `encode` say of the heights, and of the texture."""
    place = {name: given[name] for name in _OF_HEIGHTS}
    texture_place = {name: given[f"texture_{name}"] for name in _OF_TEXTURE}
    if texture_place["domain"] is None:
        texture_place["domain"] = place["domain"]
    return place, texture_place


def run_encoder(encoder: Any, *arguments: Any) -> builtins.bytes:
    """The stream of an encoder of the C interface, which takes these, a buffer and a message."""
    buffer = c.Buffer()
    message = ctypes.create_string_buffer(1024)
    status = encoder(*arguments, buffer, message, len(message))
    if status != Status.OK:
        raise error(status, message.value.decode("utf-8", "replace"))
    return taken(buffer)


def taken(buffer: c.Buffer) -> builtins.bytes:
    """The bytes of a buffer of the library, which is released."""
    if buffer.size == 0:
        return b""
    try:
        return builtins.bytes((ctypes.c_char * buffer.size).from_address(buffer.data))
    finally:
        c.lib.tks_free_buffer(buffer)


def encode(
    heights: Optional[ArrayLike] = None,
    texture: Optional[ArrayLike] = None,
    *,
    bytes: Optional[int] = None,
    psnr: Optional[float] = None,
    max_error: Optional[float] = None,
    lossless: Optional[bool] = None,
    nodata: Union[float, Literal["auto"], None] = None,
    unit: Optional[str] = None,
    spacing: Union[float, Tuple[float, float], None] = None,
    scale: float = 1.0,
    offset: float = 0.0,
    step: Optional[float] = None,
    crs: Optional[str] = None,
    geotransform: Optional[Sequence[float]] = None,
    registration: Optional[str] = None,
    vertical_datum: Optional[str] = None,
    description: Optional[str] = None,
    geo_keys: Optional[str] = None,
    texture_crs: Optional[str] = None,
    texture_geotransform: Optional[Sequence[float]] = None,
    texture_registration: Optional[str] = None,
    texture_geo_keys: Optional[str] = None,
    texture_alpha: bool = True,
    texture_white_level: int = 0,
    domain: str = "plane",
    depth: Optional[int] = None,
    texture_domain: Optional[str] = None,
    latitudes: Optional[Tuple[float, float]] = None,
    triangles: Optional[int] = None,
    weights: str = "psnr",
    regions: Optional[int] = None,
    index: Union[bool, str] = False,
    threads: int = 1,
    progress: Optional[stoppable.Progress] = None,
) -> builtins.bytes:
    """Codes heights, a texture, or both over the same ground, into one stream.

    Every prefix of the stream that holds its header (some 100 bytes) is a stream as well.

    Arrays
        heights: (rows, columns), from 1 x 1, of uint8, int8, uint16, int16, uint32, int32 or
            float32; any strides and byte order. Lists, and arrays of other numbers, are taken if
            float32, int32 or uint32 hold every value exactly; so is (1, rows, columns). A sample v
            is the height ``v * scale + offset`` in `unit`. NaN, samples equal to `nodata`, and
            masked samples of a masked array are voids.
            Integers with a mask and without `nodata` are given a nodata value that no sample has.
            nodata="auto" takes as such what files write where they have no height, if all other
            samples lie closer together than to it: -9999 and other rows of nines, -32768, -32767,
            -2147483648 and floats from 1e10 on.
        texture: (rows, columns) grey, or (rows, columns, channels) of 1 to 4 channels (grey, grey
            and alpha, RGB, RGBA), of uint8 or uint16; other integers, and lists, become the smaller
            of these that holds them. Without `texture_alpha` the last of 2 or 4
            channels is a further colour, such as near infrared. `texture_white_level`: the uint16
            that pictures show as white, and that errors count as parts of; found where it is 0
            (reflectances and cameras of 12 bits use a part of 16). No sample is changed.
        Neither may be written to while this function runs: it releases the GIL.

    Targets: one of them; without any, lossless
        bytes: the stream takes at most so many bytes.
        psnr: heights and texture each reach so many dB (peak of heights: their range).
        max_error: every height is within this distance, in `unit`; guaranteed.
        lossless: every bit comes back (of NaN: a quiet NaN, or `nodata`).

    What the samples are, kept in every prefix
        unit: of heights, such as "m". vertical_datum: such as "EPSG:5703".
        spacing: metres from one sample to the next, one number or (x, y). It does not follow from
            a geotransform here, since this package knows no CRS; exports of the command line, which
            does, derive a missing one.
        step: quantisation step in sample units; chosen unless given.
        crs: "EPSG:32611" (also "EPSG:32611+5773"), WKT, or a name. It is kept as it is given (but
            for "epsg:", which becomes "EPSG:") and not looked up: GDAL warns of a CRS that it
            cannot parse, and opens the raster without one. geotransform: six numbers in the order
            of GDAL and in units of the CRS. registration: "area" or "point". texture_...: likewise
            for a texture whose place is not that of the heights, or that comes without heights.
        description, geo_keys: as tks_heights in tetrakis.h has them.
        domain: "cylinder" if the last column lies beside the first one, as on a globe: no seam is
            left between the two. "cube": heights of a grid of longitudes and latitudes in degrees
            that goes round the Earth, without voids, are resampled on a cube, which has neither
            seam nor crowded poles, and come back on the grid; within `bytes` or `psnr` (of the
            cube). A texture stays as it is, on longitudes and latitudes: those of the grid where it
            has none. The cube says what `spacing` is. depth: faces of the cube have 2^depth x
            2^depth squares, to 14; chosen unless given. texture_domain: of the texture, if it is
            another one.
        latitudes: of a geographic grid, in degrees: those of the outer edges of the first and of
            the last row, such as (90, -90). Samples of heights that are coded alone, within `bytes`
            or lossless, then count by their area: a globe takes 1.5 to 3.7 % fewer bytes at equal
            error over the ground. The stream does not keep them.

    How it is coded
        triangles: meshes will have at most so many. weights: "psnr", or "visual" for the eye.
        regions: side in samples of the regions by which windows decode, a power of two from 16;
            1: none; chosen unless given. index: write where every packet lies; "windows" (lossless,
            or heights alone within max_error) also lays each region out in one piece, for windows
            over a network.
        threads: how many may work; the bytes never depend on it.
        progress: called with a number from 0 to 1, in the thread that called `encode`. What it
            raises ends the encode, which raises it; what it returns does not count, since progress
            bars return what they like.

    Raises :class:`TksUsageError` (also a ValueError) for what makes no sense, and other
    :class:`TksError` with their stable `code`. Ctrl-C in the main thread raises KeyboardInterrupt
    within a second, too. What has been begun goes on in the background until it next reports its
    progress, which may take as long as a large array takes to be coded once; the arrays should not
    be written to before (a copy may).
    """
    given = dict(locals())
    if progress is not None and not callable(progress):
        raise TksUsageError(f"progress must be a function, not {values.told(progress)}.")
    options = options_struct(given)
    place, texture_place = places(given)
    chosen = c.GIVEN_DOMAINS[values.choice(domain, c.GIVEN_DOMAINS, "domain")]
    on_cube = heights is not None and chosen == "cube"
    faces = values.unsigned(depth, "depth")
    if on_cube:
        cube.check_options(_target(given), geotransform)
        if texture is not None:
            cube.place_texture(texture_place, texture, heights, geotransform)
    elif faces:
        raise TksUsageError('depth is about a cube: give domain="cube" and heights.')
    height_field, samples = (None, None) if heights is None else heights_struct(heights, place)
    image, texels = (None, None) if texture is None else image_struct(texture, texture_place)
    arrays = [array for array in (samples, texels) if array is not None]

    def call(callback: Any, _kept: Any = arrays) -> builtins.bytes:
        options.progress = callback
        if on_cube:
            field, _samples = cube.on_cube(height_field, samples, faces, options.threads)
            return run_encoder(c.lib.tks_encode, field, image, options)
        return run_encoder(c.lib.tks_encode, height_field, image, options)

    return stoppable.run(call, progress, sum(array.size for array in arrays) <= SHORT)
