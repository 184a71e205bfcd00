# SPDX-License-Identifier: Apache-2.0
"""Rasters that rasterio opens, to streams, and streams to GeoTIFFs."""

from __future__ import annotations

import builtins
import math
import os
from contextlib import contextmanager
from typing import Any, Iterator, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _values as values
from ._encode import encode
from ._errors import TksUsageError
from ._info import Info
from ._stream import Stream

_REGISTRATIONS = {"Area": "area", "Point": "point"}


def from_rasterio(
    heights: Any = None, texture: Any = None, *, band: int = 1, **options: Any
) -> builtins.bytes:
    """Codes a raster, with its CRS, geotransform, nodata value, unit, scale, offset and name.

    heights, texture: datasets of rasterio, or paths of what it opens. `band` of the heights is
        coded; of a texture all bands (1 to 4), in the order red, green, blue, alpha where the
        dataset says so, and colour tables as colours. What its mask hides gets an alpha of 0.
    options: those of :func:`tetrakis.encode`, which replace what the raster says.
    """
    if heights is not None:
        with _opened(heights) as dataset:
            samples, said = _heights_of(dataset, band)
            options = {**said, **options}
    else:
        samples = None
    texels = None
    if texture is not None:
        with _opened(texture) as dataset:
            texels = _texels_of(dataset)
            options = {**_texture_place(dataset, texels), **options}
    return encode(samples, texels, **options)


def to_geotiff(
    stream: Stream,
    path: Union[str, "os.PathLike[str]"],
    *,
    texture: bool = False,
    level: int = 0,
    window: Optional[values.WindowLike] = None,
    bytes: Optional[int] = None,
    **creation: Any,
) -> None:
    """Writes the heights of a stream, or its texture, as a GeoTIFF that keeps their place, nodata
    value, unit, scale and offset.

    level, window, bytes: as for :meth:`Stream.heights`. creation: options of GDAL's GTiff driver,
    such as ``compress="zstd"``.
    """
    import rasterio

    if (stream.info.texture_shape if texture else stream.info.shape) is None:
        raise TksUsageError(f"The stream has no {'texture' if texture else 'heights'}.")
    if texture:
        info = stream.describe(0, level, bytes)
    else:
        info = stream.describe(level, 0, bytes, window=window)
    read = stream.texture if texture else stream.heights
    samples = read(level, window, bytes)
    if samples.dtype == np.int8:  # GDAL has no such type before 3.7
        samples = samples.astype(np.int16)
    bands = samples[np.newaxis] if samples.ndim == 2 else np.moveaxis(samples, -1, 0)
    profile = dict(
        driver="GTiff",
        count=bands.shape[0],
        height=bands.shape[1],
        width=bands.shape[2],
        dtype=bands.dtype.name,
        crs=info.texture_crs if texture else info.crs,
        nodata=None if texture else info.nodata,
        **creation,
    )
    place = _texture_geotransform(info, window) if texture else info.geotransform
    if place is not None:
        profile["transform"] = rasterio.Affine.from_gdal(*place)
    with rasterio.open(path, "w", **profile) as dataset:
        dataset.write(bands)
        registration = info.texture_registration if texture else info.registration
        if registration is not None:
            dataset.update_tags(AREA_OR_POINT=registration.capitalize())
        if texture:
            _tell_colours(dataset, info)
        else:
            _tell_heights(dataset, info)


def _tell_heights(dataset: Any, info: Info) -> None:
    dataset.scales, dataset.offsets = (info.scale,), (info.offset,)
    if info.unit is not None:
        dataset.units = (info.unit,)
    if info.description is not None:
        dataset.set_band_description(1, info.description)


def _tell_colours(dataset: Any, info: Info) -> None:
    from rasterio.enums import ColorInterp

    names = ["red", "green", "blue"] if dataset.count >= 3 else ["gray"]
    names += ["alpha" if info.texture_alpha else "undefined"] * (dataset.count - len(names))
    dataset.colorinterp = [ColorInterp[name] for name in names]


def _texture_geotransform(info: Info, asked: Optional[values.WindowLike]) -> Any:
    t = info.texture_geotransform
    window = values.window(asked, info.texture_shape or (0, 0))
    if t is None or window is None:
        return t
    x, y = window.x, window.y
    return (t[0] + x * t[1] + y * t[2], t[1], t[2], t[3] + x * t[4] + y * t[5], t[4], t[5])


@contextmanager
def _opened(raster: Any) -> Iterator[Any]:
    if hasattr(raster, "read") and hasattr(raster, "transform"):
        yield raster
        return
    import rasterio

    with rasterio.open(raster) as dataset:
        yield dataset


def _heights_of(dataset: Any, band: int) -> Tuple[NDArray[Any], dict[str, Any]]:
    said, hidden = heights_facts(dataset, band)
    return dataset.read(band, masked=hidden), said


def heights_facts(dataset: Any, band: int) -> Tuple[dict[str, Any], bool]:
    """What a raster says of its heights as options of `encode`, and whether a mask that is more
    than the nodata value hides some of them."""
    if not 1 <= values.unsigned(band, "band") <= dataset.count:
        raise TksUsageError(f"The raster has bands 1 to {dataset.count}, not {band}.")
    nodata, dtype = dataset.nodatavals[band - 1], np.dtype(dataset.dtypes[band - 1])
    # A nodata value that the stream's type cannot hold, and masks of other kinds, hide samples.
    declared = nodata is not None and _holds(dtype, nodata)
    hidden = not declared and "all_valid" not in _flags(dataset, band)
    said = dict(
        nodata=nodata if declared else None,
        unit=dataset.units[band - 1] or None,
        scale=dataset.scales[band - 1],
        offset=dataset.offsets[band - 1],
        description=dataset.descriptions[band - 1] or None,
        spacing=_spacing(dataset),
        **_place(dataset),
    )
    return said, hidden


def _flags(dataset: Any, band: int) -> set[str]:
    return {flag.name for flag in dataset.mask_flag_enums[band - 1]}


def _holds(dtype: np.dtype, nodata: float) -> bool:
    if dtype.kind != "f":
        return True
    with np.errstate(over="ignore"):
        return math.isnan(nodata) or float(np.float32(nodata)) == nodata


def _place(dataset: Any) -> dict[str, Any]:
    place: dict[str, Any] = dict(crs=crs_text(dataset.crs))
    if not dataset.transform.is_identity:
        place["geotransform"] = dataset.transform.to_gdal()
    place["registration"] = _REGISTRATIONS.get(dataset.tags().get("AREA_OR_POINT", ""))
    return place


def crs_text(crs: Any) -> Optional[str]:
    """A code, if it says the same as the CRS; else WKT."""
    if not crs:
        return None
    code = crs.to_epsg()
    if code is not None and type(crs).from_epsg(code) == crs:
        return f"EPSG:{code}"
    text: str = crs.to_wkt()
    return text


def _spacing(dataset: Any) -> Optional[Tuple[float, float]]:
    """Metres per sample of a projected CRS."""
    if not dataset.crs or not dataset.crs.is_projected:
        return None
    metres = dataset.crs.linear_units_factor[1]
    t = dataset.transform
    return math.hypot(t.a, t.d) * metres, math.hypot(t.b, t.e) * metres


def _texels_of(dataset: Any) -> NDArray[Any]:
    if dataset.count == 1 and dataset.colorinterp[0].name == "palette":
        return _coloured(dataset)
    texels = np.moveaxis(dataset.read(_order(dataset)), 0, -1)
    has_alpha = any(colour.name == "alpha" for colour in dataset.colorinterp)
    if has_alpha or texels.shape[-1] not in (1, 3):
        return texels
    shown = dataset.dataset_mask()
    if shown.all():
        return texels
    opaque = np.where(shown, np.iinfo(texels.dtype).max, 0).astype(texels.dtype)
    return np.concatenate([texels, opaque[..., np.newaxis]], axis=-1)


def _order(dataset: Any) -> list[int]:
    """Bands, red first and alpha last; as they are where the dataset does not name them."""
    names = [colour.name for colour in dataset.colorinterp]
    wanted = [name for name in ("gray", "red", "green", "blue") if name in names]
    wanted += ["alpha"] * ("alpha" in names)
    if len(wanted) != len(names):
        return list(range(1, dataset.count + 1))
    return [names.index(name) + 1 for name in wanted]


def _coloured(dataset: Any) -> NDArray[Any]:
    table = np.zeros((256, 4), "u1")
    for value, colour in dataset.colormap(1).items():
        table[value] = colour
    if dataset.nodata is not None and 0 <= dataset.nodata < 256:
        table[int(dataset.nodata), 3] = 0
    texels: NDArray[Any] = table[dataset.read(1)]
    return texels[..., :3] if (texels[..., 3] == 255).all() else texels


def _texture_place(dataset: Any, texels: NDArray[Any]) -> dict[str, Any]:
    said = {f"texture_{name}": value for name, value in _place(dataset).items()}
    names = [colour.name for colour in dataset.colorinterp]
    if dataset.count == texels.shape[-1] and dataset.count in (2, 4):
        said["texture_alpha"] = "alpha" in names
    return said
