# SPDX-License-Identifier: Apache-2.0
"""Heights that come by windows: arrays of any library, and rasters that osgeo or rasterio opens.

A source can be pickled, and be read by any number of threads. A raster is opened by each thread for
itself, since GDAL's datasets belong to one at a time.
"""

from __future__ import annotations

import math
import mmap
import os
import threading
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _gdal_raster as gdal_raster
from . import _values as values
from ._errors import TksIOError, TksUsageError


class WindowSource:
    """Heights of a shape and type. `said`: what the source says of them, as options of `encode`.
    `fingerprint`: values of JSON, which change where the samples do, as far as that can be told."""

    shape: Tuple[int, int]
    dtype: np.dtype
    said: Dict[str, Any]
    fingerprint: List[Any]

    def read(self, rows: slice, columns: slice) -> Any:
        """Samples of the source's own type; masked ones are voids."""
        raise NotImplementedError

    def for_others(self, _folder: Path) -> "WindowSource":
        """The same source for other processes, which see files in the folder."""
        return self


class ArraySource(WindowSource):
    """Anything with a shape, a type, and windows by slices."""

    def __init__(self, array: Any) -> None:
        self._array = array
        self._front = (0,) * (len(array.shape) - 2)
        self.shape = tuple(array.shape[-2:])
        self.dtype = np.dtype(array.dtype)
        self.said = {}
        self.fingerprint = []

    def read(self, rows: slice, columns: slice) -> Any:
        part = self._array[(*self._front, rows, columns)]
        if hasattr(part, "__dask_graph__"):
            import dask

            # A task of a cluster that waits for others would take the place that they need.
            part = part.compute(scheduler=dask.get)
        return part if isinstance(part, np.ma.MaskedArray) else np.asarray(part)

    def for_others(self, folder: Path) -> WindowSource:
        if not isinstance(self._array, np.ndarray) or _lies_in_a_file(self._array):
            return self
        path = folder / "source.npy"
        np.save(path, self._array)
        return ArraySource(np.load(path, mmap_mode="r"))

    def __getstate__(self) -> Dict[str, Any]:
        state = dict(self.__dict__)
        array = self._array
        if isinstance(array, np.ndarray) and _lies_in_a_file(array):
            order = "C" if array.flags.c_contiguous else "F"
            state["_array"] = _Mapped(array.filename, array.dtype, array.offset, array.shape, order)
        return state

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        if isinstance(self._array, _Mapped):
            self._array = self._array.opened()


class _Mapped:
    """Where an array lies in a file."""

    def __init__(self, path: Any, dtype: Any, offset: int, shape: Any, order: Any) -> None:
        self._place = os.path.abspath(path), dtype, "r", offset, shape, order

    def opened(self) -> Any:
        return np.memmap(*self._place)


def _lies_in_a_file(array: Any) -> bool:
    """Views of a mapped file do not know where in it they begin."""
    mapped = isinstance(array, np.memmap) and isinstance(array.base, mmap.mmap)
    return mapped and array.filename is not None


class RasterSource(WindowSource):
    """A band of a raster by its path."""

    def __init__(self, path: str, band: int) -> None:
        self._path, self._band = path, band
        self._opened = threading.local()
        raster = self._raster()
        self.shape, self.dtype = raster.shape, raster.dtype
        self.said, self.fingerprint = raster.said, [_state_of(file) for file in raster.files]

    def _raster(self) -> Any:
        if not hasattr(self._opened, "raster"):
            self._opened.raster = gdal_raster.opened(self._path, self._band)
        return self._opened.raster

    def read(self, rows: slice, columns: slice) -> Any:
        return self._raster().read(rows, columns)

    def __getstate__(self) -> Dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_opened"}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._opened = threading.local()


def _state_of(file: str) -> List[Any]:
    """Size and time of a file; of one in another place, its name."""
    try:
        state = os.stat(file)
    except (OSError, ValueError):
        return [file]
    return [os.path.abspath(file), state.st_size, state.st_mtime_ns]


def source_of(given: Any, band: int) -> WindowSource:
    """Raises TksUsageError if it gives no windows."""
    if isinstance(given, WindowSource):
        return given
    if isinstance(given, (str, os.PathLike)):
        return RasterSource(os.fspath(given), values.unsigned(band, "band"))
    said = {}
    if hasattr(given, "dims") and hasattr(given, "coords"):
        from . import _xarray

        given = _xarray.layer(given)
        said = _xarray.heights_facts(given)
    shape = tuple(getattr(given, "shape", ()))
    if len(shape) < 2 or any(side != 1 for side in shape[:-2]) or not hasattr(given, "dtype"):
        raise TksUsageError(
            "The source of a mosaic is a path of a raster, or has a shape (rows, columns), a dtype "
            f"and slices, unlike {values.told(given)}."
        )
    source = ArraySource(given)
    source.said = said
    return source


class Samples:
    """Windows of a source in a type that streams have. `nodata`: that of the stream, or None."""

    def __init__(self, source: WindowSource, nodata: Optional[float]) -> None:
        self.source = source
        self.shape = source.shape
        self.dtype = _coded(source.dtype)
        self._given = nodata
        self.nodata = nodata if nodata is None or self._holds(nodata) else None

    def _holds(self, nodata: float) -> bool:
        if self.dtype.kind != "f" or math.isnan(nodata):
            return True
        with np.errstate(over="ignore"):
            return float(np.float32(nodata)) == nodata

    def window(self, x: int, y: int, width: int, height: int) -> NDArray[Any]:
        """In C order."""
        part = self.source.read(slice(y, y + height), slice(x, x + width))
        if part.shape != (height, width):
            raise TksIOError(
                f"The source gave an array of shape {part.shape} for a window of {(height, width)}."
            )
        where = f"in columns {x} to {x + width - 1}, rows {y} to {y + height - 1}"
        return self._as_coded(np.ma.getdata(part), self._voids(part, where), where)

    def _voids(self, part: Any, where: str) -> Any:
        """Marks of the samples that the type's own nodata value does not tell, or None."""
        voids = None
        if np.ma.is_masked(part):
            voids = np.ma.getmaskarray(part)
            if self.dtype.kind != "f" and self.nodata is None:
                raise TksUsageError(
                    f"Samples {where} are masked: give a nodata value that no sample has."
                )
        if self.nodata is None and self._given is not None:
            beyond = np.ma.getdata(part) == self._given
            voids = beyond if voids is None else voids | beyond
        return voids

    def _as_coded(self, data: NDArray[Any], voids: Any, where: str) -> NDArray[Any]:
        if voids is not None:
            data = np.where(voids, data.dtype.type(0), data)
        with np.errstate(over="ignore", invalid="ignore"):
            kept = np.array(data, self.dtype, order="C")
        if data.dtype != self.dtype and not _same(kept, data):
            raise TksUsageError(
                f"The samples {where} are {data.dtype}, and {self.dtype} does not hold them "
                "exactly: give a source of a type that is near enough for you."
            )
        if voids is not None:
            kept[voids] = np.nan if self.dtype.kind == "f" else self.nodata
        return kept


def _same(kept: NDArray[Any], data: NDArray[Any]) -> bool:
    same = kept == data
    if data.dtype.kind == "f":
        same |= np.isnan(data)
    return bool(same.all())


def _coded(dtype: np.dtype) -> np.dtype:
    """The type of streams for samples of a type; its values have to fit."""
    native = dtype.newbyteorder("=")
    if native in values.SAMPLES:
        return native
    if native.kind not in "iuf":
        raise TksUsageError(f"Heights of type {dtype} cannot be coded.")
    return np.dtype("f4" if native.kind == "f" else "i4")
