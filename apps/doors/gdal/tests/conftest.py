# SPDX-License-Identifier: Apache-2.0
"""Terrains that tests share, and short ways to make files. All are made here, and small."""

import os
from pathlib import Path

import numpy as np
import pytest

REPOSITORY = Path(__file__).resolve().parents[4]
os.environ.setdefault("GDAL_DRIVER_PATH", str(REPOSITORY / "build/doors"))

from osgeo import gdal, gdal_array, osr  # noqa: E402

gdal.UseExceptions()

# NumPy's types, and GDAL's. Before GDAL 3.7 signed bytes are Byte and an item of metadata.
SAMPLES = ["u1", "i1", "u2", "i2", "u4", "i4", "f4"]


def gdal_type(dtype):
    dtype = np.dtype(dtype)
    if dtype == np.int8:
        return getattr(gdal, "GDT_Int8", gdal.GDT_Byte)
    return gdal_array.NumericTypeCodeToGDALTypeCode(dtype)


def terrain(rows=300, columns=340, dtype="f4", seed=1):
    """Hills with some noise, over the type's range but its ends (of 32 bits: of 20)."""
    y, x = np.mgrid[0:rows, 0:columns] / 40.0
    hills = np.sin(x) * np.cos(1.3 * y) + 0.3 * np.sin(3.1 * x + y)
    hills += np.random.default_rng(seed).normal(0, 0.003, hills.shape)
    hills = (hills - hills.min()) / np.ptp(hills)
    dtype = np.dtype(dtype)
    if dtype.kind == "f":
        return (np.round(2000 * hills) / 2).astype(dtype)
    limits = np.iinfo(dtype)
    low, high = max(limits.min + 1, -(2**19)), min(limits.max - 1, 2**19)
    return (low + hills * (high - low)).astype(np.int64).astype(dtype)


def means_over(heights, rows, columns):
    """Of the areas of so many pixels, all of the same size, that share the raster."""
    for length in (rows, columns):
        sums = np.pad(np.cumsum(heights.astype(np.float64), axis=0), ((1, 0), (0, 0)))
        ends = np.arange(length + 1) * len(heights) / length
        at = np.stack([np.interp(ends, np.arange(len(sums)), column) for column in sums.T])
        heights = np.diff(at, axis=1) * length / len(heights)
    return heights


def memory(array, **facts):
    """A dataset in memory. facts: transform, crs, nodata, unit, scale, offset, description,
    area_or_point, colours."""
    array = np.asarray(array)
    layers = array[None] if array.ndim == 2 else array
    kind = gdal_type(array.dtype)
    bands, rows, columns = layers.shape
    dataset = gdal.GetDriverByName("MEM").Create("", columns, rows, bands, kind)
    signed = array.dtype == np.int8 and kind == gdal.GDT_Byte
    for number, layer in enumerate(layers, 1):
        band = dataset.GetRasterBand(number)
        if signed:
            band.SetMetadataItem("PIXELTYPE", "SIGNEDBYTE", "IMAGE_STRUCTURE")
        band.WriteArray(layer.view(np.uint8) if signed else layer)
        if "colours" in facts:
            band.SetColorInterpretation(facts["colours"][number - 1])
    band = dataset.GetRasterBand(1)
    if "transform" in facts:
        dataset.SetGeoTransform(facts["transform"])
    if "crs" in facts:
        dataset.SetSpatialRef(system(facts["crs"]))
    if "nodata" in facts:
        band.SetNoDataValue(facts["nodata"])
    if "scale" in facts:
        band.SetScale(facts["scale"])
        band.SetOffset(facts["offset"])
    if "unit" in facts:
        band.SetUnitType(facts["unit"])
    if "description" in facts:
        band.SetDescription(facts["description"])
    if "area_or_point" in facts:
        dataset.SetMetadataItem("AREA_OR_POINT", facts["area_or_point"])
    return dataset


def system(text):
    crs = osr.SpatialReference()
    assert crs.SetFromUserInput(text) == 0
    crs.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    return crs


def copy(source, name, *options, strict=True, progress=None):
    """Writes a stream and opens it."""
    if not isinstance(source, gdal.Dataset):
        source = memory(source)
    driver = gdal.GetDriverByName("TKS")
    return driver.CreateCopy(str(name), source, int(strict), list(options), progress)


def first_band(dataset):
    """Keeps its dataset, which GDAL's Python module does not."""
    band = dataset.GetRasterBand(1)
    band.dataset = dataset
    return band


def samples(band_or_dataset, *window):
    """As NumPy has them; signed bytes too."""
    array = band_or_dataset.ReadAsArray(*window)
    band = band_or_dataset
    if isinstance(band, gdal.Dataset):
        band = band.GetRasterBand(1)
    signed = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE") == "SIGNEDBYTE"
    return array.view(np.int8) if signed and array.dtype == np.uint8 else array


def refused(call, *words):
    """The error is one sentence with these words."""
    with pytest.raises(RuntimeError) as caught:
        call()
    message = str(caught.value)
    for word in words:
        assert word in message, message
    assert message.rstrip().endswith((".", "?")), message
    return message


def warnings_of(call):
    """What the call returns, and what it warns of."""
    heard = []
    gdal.PushErrorHandler(lambda *error: heard.append(error[2]))
    try:
        return call(), heard
    finally:
        gdal.PopErrorHandler()


RGB = (gdal.GCI_RedBand, gdal.GCI_GreenBand, gdal.GCI_BlueBand)


@pytest.fixture(scope="session")
def texture(tmp_path_factory):
    """A GeoTIFF of RGB and alpha, finer than the terrain of the same ground."""
    layers = [terrain(400, 450, "u1", seed) for seed in range(3)]
    hole = np.full((400, 450), 255, np.uint8)
    hole[100:180, 40:200] = 0
    name = str(tmp_path_factory.mktemp("texture") / "image.tif")
    source = memory(
        np.stack([*layers, hole]),
        colours=(*RGB, gdal.GCI_AlphaBand),
        transform=(400000, 10 * 340 / 450, 0, 3800000, 0, -10 * 300 / 400),
        crs="EPSG:32611",
    )
    gdal.GetDriverByName("GTiff").CreateCopy(name, source)
    return name


@pytest.fixture(scope="session")
def placed(tmp_path_factory, texture):
    """A stream with heights and texture that says all that it can of its place."""
    name = str(tmp_path_factory.mktemp("placed") / "placed.tks")
    source = memory(
        terrain(dtype="i2"),
        transform=(400000, 10, 0, 3800000, 0, -10),
        crs="EPSG:32611+5773",
        nodata=-32768,
        unit="m",
        scale=0.5,
        offset=100,
        description="ridges",
        area_or_point="Point",
    )
    copy(source, name, "TEXTURE=" + texture)
    return name


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Tests of a file share what it makes, so one worker takes them; the corpus shares nothing."""
    for item in items:
        if item.path.name != "test_corpus.py":
            item.add_marker(pytest.mark.xdist_group(item.path.name))
