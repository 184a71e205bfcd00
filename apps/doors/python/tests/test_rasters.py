# SPDX-License-Identifier: Apache-2.0
"""Rasters of rasterio and arrays of xarray keep samples, voids and place on the way to a stream and
back."""

import numpy as np
import pytest
from conftest import photograph, terrain

import tetrakis

PLACE = (4e5, 10.0, 0.0, 3.8e6, 0.0, -10.0)


def raster(path, samples, **more):
    rasterio = pytest.importorskip("rasterio")
    bands = samples[np.newaxis] if samples.ndim == 2 else np.moveaxis(samples, -1, 0)
    profile = dict(
        driver="GTiff",
        count=len(bands),
        height=bands.shape[1],
        width=bands.shape[2],
        dtype=bands.dtype.name,
        crs="EPSG:32611",
        transform=rasterio.Affine.from_gdal(*PLACE),
    )
    with rasterio.open(path, "w", **{**profile, **more}) as dataset:
        dataset.write(bands)
    return path


@pytest.mark.parametrize("dtype", ["u1", "u2", "i2", "u4", "i4", "f4", "f8"])
def test_rasters_come_back(tmp_path, dtype):
    rasterio = pytest.importorskip("rasterio")
    heights = terrain(dtype="f4" if dtype == "f8" else dtype).astype(dtype)
    heights[3:9, 4:20] = 0
    path = raster(tmp_path / "a.tif", heights, nodata=0)
    with rasterio.open(path, "r+") as dataset:
        dataset.units, dataset.scales, dataset.offsets = ("m",), (0.5,), (-3.0,)
        dataset.set_band_description(1, "ground")
        dataset.update_tags(AREA_OR_POINT="Point")
    stream = tetrakis.from_rasterio(path, bytes=None)
    opened = tetrakis.open(stream)
    info = opened.info
    assert (info.crs, info.geotransform, info.registration) == ("EPSG:32611", PLACE, "point")
    assert (info.unit, info.scale, info.offset) == ("m", 0.5, -3.0)
    assert (info.description, info.nodata, info.spacing) == ("ground", 0, (10, 10))
    back = tmp_path / "b.tif"
    tetrakis.to_geotiff(opened, back, compress="deflate")
    with rasterio.open(path) as before, rasterio.open(back) as after:
        np.testing.assert_array_equal(before.read(1), after.read(1))
        np.testing.assert_array_equal(before.dataset_mask(), after.dataset_mask())
        for name in "crs transform units scales offsets descriptions nodata".split():
            assert getattr(before, name) == getattr(after, name), name
        assert after.tags()["AREA_OR_POINT"] == "Point"


def test_masks_that_are_no_nodata_value(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    path = raster(tmp_path / "a.tif", terrain(dtype="i2"))
    hidden = np.zeros((45, 59), bool)
    hidden[5:9, 30:] = True
    with rasterio.open(path, "r+") as dataset:
        dataset.write_mask(~hidden)
    with rasterio.open(path) as dataset:
        back = tetrakis.open(tetrakis.from_rasterio(dataset)).heights(masked=True)
    np.testing.assert_array_equal(back.mask, hidden)
    wide = terrain().astype("f8")
    wide[hidden] = -1.7976931348623157e308
    path = raster(tmp_path / "b.tif", wide, nodata=-1.7976931348623157e308)
    back = tetrakis.open(tetrakis.from_rasterio(str(path))).heights(masked=True)
    np.testing.assert_array_equal(back.mask, hidden)


def test_windows_and_levels_become_geotiffs(tmp_path, heights):
    rasterio = pytest.importorskip("rasterio")
    opened = tetrakis.open(tetrakis.from_rasterio(raster(tmp_path / "a.tif", heights)))
    tetrakis.to_geotiff(opened, tmp_path / "b.tif", level=1, window=np.s_[2:9, 5:12])
    with rasterio.open(tmp_path / "b.tif") as part:
        np.testing.assert_array_equal(part.read(1), opened.heights(1, np.s_[2:9, 5:12]))
        described = opened.describe(1, window=np.s_[2:9, 5:12])
        assert part.transform.to_gdal() == described.geotransform
    with pytest.raises(tetrakis.TksUsageError, match="no texture"):
        tetrakis.to_geotiff(opened, tmp_path / "c.tif", texture=True)
    assert not (tmp_path / "c.tif").exists()


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_textures_of_rasters(tmp_path, channels):
    rasterio = pytest.importorskip("rasterio")
    texels = photograph(channels=channels)
    path = raster(tmp_path / "a.tif", texels)
    names = ["gray"] * (channels < 3) + ["blue", "green", "red"] * (channels > 2)
    names += ["alpha"] * (channels % 2 == 0)
    with rasterio.open(path, "r+") as dataset:
        dataset.colorinterp = [rasterio.enums.ColorInterp[name] for name in names]
    opened = tetrakis.open(tetrakis.from_rasterio(texture=path))
    wanted = texels if channels < 3 else texels[..., [2, 1, 0, *range(3, channels)]]
    np.testing.assert_array_equal(opened.texture(), wanted)
    assert opened.info.texture_geotransform == PLACE
    assert opened.info.texture_alpha == (channels % 2 == 0)
    tetrakis.to_geotiff(opened, tmp_path / "b.tif", texture=True, window=np.s_[3:20, 8:30])
    with rasterio.open(tmp_path / "b.tif") as part:
        back = np.moveaxis(part.read(), 0, -1)
        np.testing.assert_array_equal(back, np.atleast_3d(wanted)[3:20, 8:30])
        assert part.transform.to_gdal()[0] == PLACE[0] + 80


def test_colour_tables_and_nodata_of_textures(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    classes = (terrain(dtype="u1") // 64).astype("u1")
    path = raster(tmp_path / "a.tif", classes, nodata=2)
    table = {i: (i * 60, 255 - i * 60, 9, 255) for i in range(4)}
    with rasterio.open(path, "r+") as dataset:
        dataset.write_colormap(1, table)
    texels = tetrakis.open(tetrakis.from_rasterio(texture=path)).texture()
    np.testing.assert_array_equal(texels[..., 3], np.where(classes == 2, 0, 255))
    kept = classes != 2
    np.testing.assert_array_equal(texels[kept][:, 0], classes[kept] * 60)
    path = raster(tmp_path / "b.tif", photograph(), nodata=7)
    hidden = (photograph() == 7).all(axis=2)
    texels = tetrakis.open(tetrakis.from_rasterio(texture=path)).texture()
    assert texels.shape[2] == 3 or ((texels[..., 3] == 0) == hidden).all()


def data_array(heights, **attributes):
    xarray = pytest.importorskip("xarray")
    y = PLACE[3] + PLACE[5] * (np.arange(heights.shape[-2]) + 0.5)
    x = PLACE[0] + PLACE[1] * (np.arange(heights.shape[-1]) + 0.5)
    dims = ("band", "y", "x")[-heights.ndim :]
    return xarray.DataArray(heights, dict(y=y, x=x), dims, "ground", attributes)


def test_arrays_of_xarray(heights):
    array = data_array(heights, units="m", _FillValue=-5.0)
    info = tetrakis.open(tetrakis.from_xarray(array)).info
    assert (info.geotransform, info.unit, info.nodata) == (PLACE, "m", -5)
    assert info.description == "ground" and info.crs is None
    placed = array.assign_coords(spatial_ref=0)
    placed.spatial_ref.attrs.update(crs_wkt="EPSG:32611", GeoTransform="1 2 0 3 0 -2")
    info = tetrakis.open(tetrakis.from_xarray(placed.astype("f8"), max_error=1)).info
    assert (info.geotransform, info.crs, info.max_error) == ((1, 2, 0, 3, 0, -2), "EPSG:32611", 1)
    uneven = array.assign_coords(x=(array.x - PLACE[0]) ** 2)
    assert tetrakis.open(tetrakis.from_xarray(uneven)).info.geotransform is None
    banded = data_array(heights[np.newaxis])
    assert tetrakis.open(tetrakis.from_xarray(banded)).shape == heights.shape
    with pytest.raises(tetrakis.TksUsageError, match="isel"):
        tetrakis.from_xarray(data_array(heights).expand_dims(["member", "time"]).isel(
            member=[0, 0], time=[0, 0]))  # fmt: skip


def test_textures_of_xarray(heights):
    xarray = pytest.importorskip("xarray")
    texels = photograph()
    for dims, array in (("yxc", texels), ("cyx", np.moveaxis(texels, -1, 0))):
        given = xarray.DataArray(array, dims=tuple(dims))
        stream = tetrakis.from_xarray(data_array(heights), given)
        np.testing.assert_array_equal(tetrakis.open(stream).texture(), texels)


@pytest.fixture()
def file(tmp_path, heights):
    pytest.importorskip("xarray")
    steps = (heights * 2).astype("i2")
    steps[2:5, 7:30] = -32768
    place = dict(crs="EPSG:32611", geotransform=PLACE, scale=0.5, offset=100, unit="m")
    stream = tetrakis.encode(steps, photograph(), nodata=-32768, **place)
    path = tmp_path / "a.tks"
    path.write_bytes(stream)
    return path


def test_xarray_opens_streams(file):
    import xarray

    opened = tetrakis.open(file)
    with xarray.open_dataset(file) as dataset:
        assert dict(dataset.sizes) == dict(y=45, x=59, texture_y=40, texture_x=48, channel=3)
        np.testing.assert_allclose(dataset.heights, opened.surface(), rtol=0, atol=1e-3)
        assert np.isnan(dataset.heights[3, 8]) and dataset.heights.units == "m"
        assert dataset.x[0] == PLACE[0] + 5 and dataset.y[0] == PLACE[3] - 5
        assert dataset.spatial_ref.attrs["spatial_ref"] == "EPSG:32611"
        part = dataset.heights[10:20, ::7].values
        np.testing.assert_allclose(part, opened.surface()[10:20, ::7], atol=1e-3)
        picked = dataset.heights.isel(y=[4, 1, 30], x=xarray.DataArray([3, 9], dims="x"))
        np.testing.assert_allclose(picked, opened.surface()[[4, 1, 30]][:, [3, 9]], atol=1e-3)
        np.testing.assert_array_equal(dataset.texture, opened.texture())
        again = tetrakis.open(tetrakis.from_xarray(dataset.heights.load()))
        assert again.info.geotransform == PLACE and again.info.crs == "EPSG:32611"
    with xarray.open_dataset(file, level=1, mask_and_scale=False) as coarse:
        np.testing.assert_array_equal(coarse.heights, opened.heights(1))
        assert coarse.x[1] - coarse.x[0] == 20
    with xarray.open_dataset(file, drop_variables=["texture"]) as dataset:
        assert "texture" not in dataset
