# SPDX-License-Identifier: Apache-2.0
"""A band of a raster by windows, through osgeo if that is installed, else through rasterio.

Both give the same samples and facts: `shape`, `dtype`, `said` (options of `encode`), `files`, of
which the raster consists, and `read`.
"""

from __future__ import annotations

import math
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from . import _values as values
from ._errors import TksIOError, TksUsageError


def opened(path: str, band: int) -> Any:
    """TksUsageError: neither package is installed, or there is no such band. TksIOError: it cannot
    be opened."""
    try:
        from osgeo import gdal
    except ImportError:
        return _Rasterio(path, band)
    return _Osgeo(gdal, path, band)


class _Osgeo:
    def __init__(self, gdal: Any, path: str, band: int) -> None:
        self._gdal = gdal
        self._dataset = self._done(f"{path} cannot be opened", gdal.Open, path)
        count = self._dataset.RasterCount
        if not 1 <= band <= count:
            raise TksUsageError(f"The raster has bands 1 to {count}, not {band}.")
        self._path, self._band = path, self._dataset.GetRasterBand(band)
        self.shape = self._dataset.RasterYSize, self._dataset.RasterXSize
        self.dtype = self._dtype()
        self.files: List[str] = self._dataset.GetFileList() or []
        declared = self._band.GetNoDataValue()
        nothing_else = gdal.GMF_ALL_VALID | gdal.GMF_NODATA
        self._masked = not self._band.GetMaskFlags() & nothing_else
        self.said = dict(
            nodata=declared,
            unit=self._band.GetUnitType() or None,
            scale=_or(self._band.GetScale(), 1.0),
            offset=_or(self._band.GetOffset(), 0.0),
            description=self._band.GetDescription() or None,
            **self._place(),
        )

    def read(self, rows: slice, columns: slice) -> Any:
        window = columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start
        what = f"{self._path} cannot be read in columns {columns.start} to {columns.stop - 1}, rows"
        what += f" {rows.start} to {rows.stop - 1}"
        samples = self._done(what, self._band.ReadAsArray, *window).view(self.dtype)
        if not self._masked:
            return samples
        shown = self._done(what, self._band.GetMaskBand().ReadAsArray, *window)
        return np.ma.MaskedArray(samples, shown == 0)

    def _done(self, what: str, call: Any, *arguments: Any) -> Any:
        """Whether a failure of GDAL raises depends on what the program has asked it for."""
        self._gdal.ErrorReset()
        try:
            result = call(*arguments)
        except RuntimeError as failure:
            raise TksIOError(f"{what}: {failure}") from None
        if result is None:
            raise TksIOError(f"{what}: {self._gdal.GetLastErrorMsg() or 'GDAL gives no reason.'}")
        return result

    def _dtype(self) -> np.dtype:
        from osgeo import gdal_array

        signed = self._band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE") == "SIGNEDBYTE"
        kind = gdal_array.GDALTypeCodeToNumericTypeCode(self._band.DataType)
        if kind is None:
            raise TksUsageError(f"{self._path} has no type of samples that streams have.")
        return np.dtype("i1") if signed else np.dtype(kind)

    def _place(self) -> Dict[str, Any]:
        system = self._dataset.GetSpatialRef()
        transform = self._dataset.GetGeoTransform(can_return_null=True)
        registration = self._dataset.GetMetadataItem("AREA_OR_POINT")
        place: Dict[str, Any] = dict(
            crs=None if system is None else _crs_text(system),
            registration={"Area": "area", "Point": "point"}.get(registration),
        )
        if transform is None:
            return place
        place["geotransform"] = tuple(transform)
        if system is not None and system.IsProjected():
            place["spacing"] = _spacing(transform, system.GetLinearUnits())
        return place


def _or(value: Optional[float], otherwise: float) -> float:
    return otherwise if value is None else value


def _crs_text(system: Any) -> str:
    """A code, if it says the same as the CRS; else WKT."""
    from osgeo import osr

    code = system.GetAuthorityCode(None)
    if code is not None and system.GetAuthorityName(None) == "EPSG":
        named = osr.SpatialReference()
        if named.ImportFromEPSG(int(code)) == 0 and named.IsSame(
            system, ["IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES"]
        ):
            return f"EPSG:{code}"
    text: str = system.ExportToWkt()
    return text


def _spacing(transform: Any, metres: float) -> Tuple[float, float]:
    _, a, b, _, d, e = transform
    return math.hypot(a, d) * metres, math.hypot(b, e) * metres


class _Rasterio:
    def __init__(self, path: str, band: int) -> None:
        try:
            import rasterio
        except ImportError:
            raise TksUsageError(
                f"{values.told(path)} takes osgeo or rasterio, and neither is installed; give an "
                "array."
            ) from None
        from . import _rasterio

        self._window = rasterio.windows.Window
        self._failures = (rasterio.errors.RasterioError, OSError)
        self._path, self._band = path, band
        try:
            self._dataset = rasterio.open(path)
        except self._failures as failure:
            raise TksIOError(f"{path} cannot be opened: {failure}") from None
        self.said, self._masked = _rasterio.heights_facts(self._dataset, band)
        self.shape = self._dataset.shape
        self.dtype = np.dtype(self._dataset.dtypes[band - 1])
        self.files: List[str] = list(self._dataset.files)

    def read(self, rows: slice, columns: slice) -> Any:
        window = self._window.from_slices(rows, columns)
        try:
            return self._dataset.read(self._band, masked=self._masked, window=window)
        except self._failures as failure:
            raise TksIOError(
                f"{self._path} cannot be read in columns {columns.start} to {columns.stop - 1}, "
                f"rows {rows.start} to {rows.stop - 1}: {failure}"
            ) from None
