# SPDX-License-Identifier: Apache-2.0
"""Overviews of what has no means: classes, and pixels that a nodata value leaves out."""

import numpy as np
import pytest
from conftest import RGB, copy, first_band, gdal, memory, terrain


def classes(rows, columns, dtype="u1", noise=0.0):
    """1, 7 and 200 in patches; of noise these are mixed, so that a wavelet codes them."""
    y, x = np.mgrid[0:rows, 0:columns] / 37.0
    ground = np.sin(x + 0.3 * y) + np.cos(1.7 * y - 0.2 * x)
    ground += np.random.default_rng(1).normal(0, noise, ground.shape) if noise else 0
    return np.array([1, 7, 200])[np.digitize(ground, [-0.5, 0.5])].astype(dtype)


def paletted(array):
    source = memory(array)
    table = gdal.ColorTable()
    for value in np.unique(array):
        table.SetColorEntry(int(value), (int(value), 20, 30, 255))
    source.GetRasterBand(1).SetColorTable(table)
    source.GetRasterBand(1).SetColorInterpretation(gdal.GCI_PaletteIndex)
    return source


def nearest(array, rows, columns):
    """What GDAL takes of the raster itself."""

    def middles(count, of):
        return np.floor((np.arange(count) + 0.5) * of / count).astype(int)

    return array[..., middles(rows, array.shape[-2]), :][..., middles(columns, array.shape[-1])]


def check_overviews(dataset, array, exact=True):
    """All of them, and what gdal_translate makes of them."""
    band = dataset.GetRasterBand(1)
    assert band.GetOverviewCount() > 1
    for number in range(band.GetOverviewCount()):
        overview = band.GetOverview(number).ReadAsArray()
        if exact:
            np.testing.assert_array_equal(overview, nearest(array, *overview.shape))
        assert set(np.unique(overview)) <= set(np.unique(array))
        assert np.mean(overview == nearest(array, *overview.shape)) > 0.5
    rows, columns = array.shape
    for width, height in [(columns // 2, rows // 2), (columns // 5, rows // 5)]:
        half = gdal.Translate("", dataset, format="MEM", width=width, height=height)
        assert set(np.unique(half.ReadAsArray())) <= set(np.unique(array))


@pytest.mark.parametrize("dtype", ["u1", "i2"])
def test_overviews_of_land_cover(tmp_path, dtype):
    array = classes(700, 900, dtype)
    source = memory(array, transform=(400000, 30, 0, 3800000, 0, -30), crs="EPSG:32611")
    dataset = copy(source, tmp_path / "a.tks")
    check_overviews(dataset, array)
    for resampling in ("near", "mode"):
        coarse = gdal.Warp("", dataset, format="MEM", xRes=140, yRes=140, resampleAlg=resampling)
        assert set(np.unique(coarse.ReadAsArray())) == {1, 7, 200}


@pytest.mark.parametrize("options", [[], ["BLOCKSIZE=128"], ["INDEX=WINDOWS", "BLOCKSIZE=64"]])
@pytest.mark.parametrize("noise", [0, 0.7])
def test_overviews_of_a_band_with_a_colour_table(tmp_path, options, noise):
    """However it is coded. Drawings have samples at multiples of 2^k, not always the nearest."""
    array = classes(701, 903, noise=noise)
    name = str(tmp_path / "a.tks")
    copy(paletted(array), name, *options)
    for dataset in (gdal.Open(name), gdal.Open(name)):
        check_overviews(dataset, array, exact=bool(options))
    band = first_band(gdal.Open(name))
    overview = band.GetOverview(0)
    assert overview.GetColorInterpretation() == gdal.GCI_PaletteIndex
    assert overview.GetColorTable().GetColorEntry(7) == (7, 20, 30, 255)


@pytest.mark.parametrize("said", ["names", "metadata"])
def test_overviews_of_a_band_that_is_said_to_have_classes(tmp_path, said):
    array = classes(600, 700, noise=0.7)
    source = memory(array)
    if said == "names":
        source.GetRasterBand(1).SetCategoryNames(["none", "water"])
    else:
        source.GetRasterBand(1).SetMetadataItem("LAYER_TYPE", "thematic")
    check_overviews(copy(source, tmp_path / "a.tks", "BLOCKSIZE=128"), array)


def test_overviews_of_a_coarse_map_of_classes(tmp_path):
    """In pieces: below one row of an overview lie many of the raster."""
    array = classes(40, 9000, noise=0.7).T.copy()
    check_overviews(copy(paletted(array), tmp_path / "a.tks", "BLOCKSIZE=64"), array)


def test_overviews_of_a_drawn_image(tmp_path):
    index = classes(700, 900)
    colours = np.stack([index, 255 - index, index // 2])
    dataset = copy(memory(colours, colours=RGB), tmp_path / "a.tks")
    for number in range(2):
        bands = [dataset.GetRasterBand(i + 1).GetOverview(number).ReadAsArray() for i in range(3)]
        np.testing.assert_array_equal(np.stack(bands), nearest(colours, *bands[0].shape))


def test_overviews_of_wavelets_are_means(tmp_path):
    array = classes(600, 700, noise=0.7)
    band = first_band(copy(array, tmp_path / "a.tks", "BLOCKSIZE=128"))
    overview = band.GetOverview(0).ReadAsArray()
    means = array.reshape(300, 2, 350, 2).mean(axis=(1, 3))
    np.testing.assert_allclose(overview, means, atol=0.51)


def photograph(hole, bands=4):
    layers = [terrain(*hole.shape, "u2", seed) // 20 + 691 for seed in range(bands)]
    layers = np.stack(layers)
    layers[:, hole] = 0
    return layers


def with_nodata(layers, colours):
    source = memory(layers, colours=colours)
    for number in range(1, len(layers) + 1):
        source.GetRasterBand(number).SetNoDataValue(0)
    return source


@pytest.mark.parametrize("options", [[], ["BLOCKSIZE=128"]])
def test_overviews_of_an_image_leave_nodata_out(tmp_path, options):
    y, x = np.mgrid[0:600, 0:720]
    hole = (y + x // 4 < 200) | ((y - 400) ** 2 + (x - 300) ** 2 < 900)
    hole |= np.random.default_rng(1).random(hole.shape) < 0.01
    layers = photograph(hole)
    assert layers[layers > 0].min() >= 691
    name = str(tmp_path / "a.tks")
    copy(with_nodata(layers, (*RGB, gdal.GCI_Undefined)), name, *options)
    dataset = gdal.Open(name)
    for band in range(1, 5):
        for number in range(2):
            overview = dataset.GetRasterBand(band).GetOverview(number)
            values, shown = overview.ReadAsArray(), overview.GetMaskBand().ReadAsArray() != 0
            assert overview.GetNoDataValue() == 0
            np.testing.assert_array_equal(shown, values != 0)
            assert values[shown].min() >= 691
    first = dataset.GetRasterBand(1).GetOverview(0).ReadAsArray()
    quads = layers[0].reshape(300, 2, 360, 2).astype(np.float64)
    count = (quads > 0).sum(axis=(1, 3))
    means = quads.sum(axis=(1, 3)) / np.maximum(count, 1)
    np.testing.assert_allclose(first, means, atol=0.51)
    np.testing.assert_array_equal(first == 0, count == 0)


def test_alpha_beside_nodata_is_still_averaged(tmp_path):
    hole = np.zeros((600, 720), bool)
    hole[101:301, 51:401] = True
    layers = photograph(hole)
    layers[3] = np.where(hole, 0, 65535)
    source = with_nodata(layers, (*RGB, gdal.GCI_AlphaBand))
    dataset = copy(source, tmp_path / "a.tks", strict=False)
    alpha = dataset.GetRasterBand(4).GetOverview(0).ReadAsArray()
    means = layers[3].reshape(300, 2, 360, 2).mean(axis=(1, 3))
    np.testing.assert_allclose(alpha, means, atol=0.51)
    red = dataset.GetRasterBand(1).GetOverview(0).ReadAsArray()
    assert red[red > 0].min() >= 691


def test_overviews_of_heights_with_a_nodata_value_beside(tmp_path):
    """Set after the copy (gdal_edit.py -ro -a_nodata)."""
    heights = terrain(600, 700, "i2") // 4 + 9000
    heights[100:301, 51:402] = 0
    name = str(tmp_path / "a.tks")
    copy(heights, name)
    first_band(gdal.Open(name)).SetNoDataValue(0)
    band = first_band(gdal.Open(name))
    overview = band.GetOverview(0)
    values = overview.ReadAsArray()
    assert overview.GetNoDataValue() == 0 and values[values != 0].min() >= heights[heights > 0].min()
    assert (values == 0).sum() == 100 * 175
