# SPDX-License-Identifier: Apache-2.0
"""CreateCopy of textures: beside heights, alone, masked, on other ground."""

import numpy as np
import pytest
from conftest import RGB, copy, first_band, gdal, memory, refused, terrain, warnings_of


def test_textures(tmp_path):
    heights = terrain(20, 25, "i2")
    for bands, colours in ((1, None), (2, (gdal.GCI_GrayIndex, gdal.GCI_AlphaBand)), (3, RGB)):
        for dtype in ("u1", "u2"):
            layers = np.stack([terrain(45, 60, dtype, seed) for seed in range(bands)])
            facts = {"colours": colours} if colours else {}
            image = str(tmp_path / "image.tif")
            gdal.GetDriverByName("GTiff").CreateCopy(image, memory(layers, **facts))
            name = tmp_path / "a.tks"
            copy(heights, name, "TEXTURE=" + image)
            back = gdal.Open(f'TKS:"{name}":texture')
            np.testing.assert_array_equal(back.ReadAsArray(), layers if bands > 1 else layers[0])
            np.testing.assert_array_equal(gdal.Open(str(name)).ReadAsArray(), heights)
    image = str(tmp_path / "five.tif")
    for layers, words in (
        (np.zeros((5, 8, 9), np.uint8), "1 to 4 bands"),
        (np.zeros((8, 9), np.float32), "bands of Byte"),
    ):
        gdal.GetDriverByName("GTiff").CreateCopy(image, memory(layers))
        refused(lambda: copy(heights, tmp_path / "b.tks", "TEXTURE=" + image), words)


def test_an_image_alone_is_a_texture(tmp_path):
    """Of colours, or with alpha. Grey alone is heights, and other bands are refused."""
    rgba = (*RGB, gdal.GCI_AlphaBand)
    grey = (gdal.GCI_GrayIndex, gdal.GCI_AlphaBand)
    for colours in (RGB, rgba, grey):
        for dtype in ("u1", "u2"):
            layers = np.stack([terrain(45, 60, dtype, seed) for seed in range(len(colours))])
            source = memory(layers, colours=colours)
            source.SetGeoTransform((500000, 10, 0, 4000000, 0, -10))
            back = copy(source, tmp_path / "a.tks")
            np.testing.assert_array_equal(back.ReadAsArray(), layers)
            assert back.GetGeoTransform() == source.GetGeoTransform()
            assert back.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSLESS"
            assert [back.GetRasterBand(i + 1).GetColorInterpretation()
                    for i in range(len(colours))] == list(colours)
    backwards = memory(np.arange(4 * 48, dtype=np.uint8).reshape(4, 6, 8), colours=rgba[::-1])
    backwards.GetRasterBand(1).SetDescription("cut out")
    turned = copy(backwards, tmp_path / "a.tks")
    np.testing.assert_array_equal(turned.ReadAsArray(), backwards.ReadAsArray()[::-1])
    assert turned.GetRasterBand(1).GetDescription() == ""
    name = tmp_path / "a.tks"
    copy(memory(layers, colours=grey), name, "BYTES=1500")
    assert name.stat().st_size <= 1500
    picture = memory(np.zeros((3, 8, 9), np.uint8), colours=RGB)
    bounded = refused(lambda: copy(picture, tmp_path / "b.tks", "MAX_Z_ERROR=1"), "MAX_Z_ERROR")
    assert "taken for a texture" in bounded and "3 bands" in bounded
    for layers in (np.zeros((5, 8, 9), np.uint8), np.zeros((3, 8, 9), np.float32)):
        refused(lambda: copy(memory(layers), tmp_path / "b.tks"), "band")
    assert not (tmp_path / "b.tks").exists()


def test_near_infrared_is_no_alpha(tmp_path):
    """The fourth band of an aerial image comes back as itself, and hides nothing."""
    infrared = (*RGB, gdal.GCI_Undefined)
    for colours in (infrared, (gdal.GCI_GrayIndex, gdal.GCI_Undefined)):
        for dtype in ("u1", "u2"):
            layers = np.stack([terrain(45, 60, dtype, seed) for seed in range(len(colours))])
            back = copy(memory(layers, colours=colours), tmp_path / "a.tks")
            np.testing.assert_array_equal(back.ReadAsArray(), layers)
            bands = [back.GetRasterBand(i + 1) for i in range(len(colours))]
            assert [band.GetColorInterpretation() for band in bands] == list(colours)
            assert all(band.GetMaskFlags() == gdal.GMF_ALL_VALID for band in bands)
            plain = gdal.Open(str(tmp_path / "a.tks"))
            over = plain.GetRasterBand(len(colours))
            if over.GetOverviewCount():
                assert over.GetOverview(0).GetColorInterpretation() == gdal.GCI_Undefined
    name = str(tmp_path / "masked.tif")
    masked = gdal.GetDriverByName("GTiff").CreateCopy(name, memory(layers, colours=colours))
    masked.CreateMaskBand(gdal.GMF_PER_DATASET)
    del masked
    for source, options in (terrain(20, 25), ["TEXTURE=" + name]), (gdal.Open(name), []):
        heard = warnings_of(lambda: copy(source, tmp_path / "b.tks", *options))[1]
        assert [text for text in heard if "mask beside the last band" in text], heard


def test_two_bands_are_taken_for_a_texture_with_a_warning(tmp_path):
    """They may be heights, unless one is alpha."""
    for colour, warns in ((gdal.GCI_Undefined, True), (gdal.GCI_AlphaBand, False)):
        colours = (gdal.GCI_GrayIndex, colour)
        layers = memory(np.stack([terrain(20, 30, "u2")] * 2), colours=colours)
        heard = warnings_of(lambda layers=layers: copy(layers, tmp_path / "a.tks"))[1]
        assert ["taken for a texture" in text for text in heard] == [True] * warns


def place_of_texture(crs, left):
    """A texture of 40 x 40 over 400 m."""
    return {"transform": (left, 10, 0, 5000000, 0, -10), "crs": crs}


@pytest.mark.parametrize(
    "place, beside",
    [
        ({}, False),
        (place_of_texture("EPSG:32632", 500000), False),
        (place_of_texture("EPSG:32632", 500350), False),
        (place_of_texture("EPSG:32632", 500450), True),
        (place_of_texture("EPSG:32632", 499500), True),
        ({"transform": (500450, 10, 0, 5000000, 0, -10)}, True),
        # 9 degrees east, 45.152 degrees north
        ({"transform": (9.001, 1e-5, 0, 45.152, 0, -1e-5), "crs": "EPSG:4326"}, False),
        ({"transform": (9.1, 1e-5, 0, 45.152, 0, -1e-5), "crs": "EPSG:4326"}, True),
    ],
)
def test_a_texture_beside_the_ground(tmp_path, place, beside):
    heights = memory(terrain(40, 40), **place_of_texture("EPSG:32632+5773", 500000))
    image = str(tmp_path / "image.tif")
    layers = np.stack([terrain(40, 40, "u1")] * 3)
    gdal.GetDriverByName("GTiff").CreateCopy(image, memory(layers, colours=RGB, **place))
    name = tmp_path / "a.tks"
    heard = warnings_of(lambda: copy(heights, name, "TEXTURE=" + image))[1]
    assert ["lies beside the ground" in text for text in heard] == [True] * beside, heard


def test_nodata_of_a_texture(tmp_path):
    """Beside heights it becomes alpha; a picture alone keeps it beside the stream."""
    colours = np.stack([terrain(20, 30, "u1", seed) for seed in range(3)])
    colours[1:, colours[0] == 7] = 200  # there in one band alone is there
    colours[:, 5:9, 3:20] = 7
    image, layers = str(tmp_path / "image.tif"), memory(colours, colours=RGB, nodata=7)
    gdal.GetDriverByName("GTiff").CreateCopy(image, layers)
    heard = warnings_of(lambda: copy(terrain(20, 30), tmp_path / "a.tks", "TEXTURE=" + image))[1]
    assert heard == []
    back = gdal.Open(f'TKS:"{tmp_path}/a.tks":texture').ReadAsArray()
    hole = np.zeros((20, 30), bool)
    hole[5:9, 3:20] = True
    np.testing.assert_array_equal(back[3], np.where(hole, 0, 255))
    np.testing.assert_array_equal(back[:3][:, ~hole], colours[:, ~hole])
    heard = warnings_of(lambda: copy(layers, tmp_path / "b.tks"))[1]
    assert heard == []
    assert first_band(gdal.Open(str(tmp_path / "b.tks"))).GetNoDataValue() == 7


@pytest.mark.parametrize("hidden", [0, 600])
def test_nodata_that_hides_nothing_or_all(tmp_path, hidden):
    image = str(tmp_path / "image.tif")
    colours = np.where(np.arange(600) < hidden, 7, 9).astype("u1").reshape(1, 20, 30)
    layers = memory(np.repeat(colours, 3, axis=0), colours=RGB, nodata=7)
    gdal.GetDriverByName("GTiff").CreateCopy(image, layers)
    heard = warnings_of(lambda: copy(terrain(20, 30), tmp_path / "a.tks", "TEXTURE=" + image))[1]
    assert heard == []
    assert gdal.Open(f'TKS:"{tmp_path}/a.tks":texture').RasterCount == 3


def test_nodata_beside_alpha(tmp_path):
    image = str(tmp_path / "image.tif")
    colours = np.stack([terrain(20, 30, "u1", seed) for seed in range(4)])
    layers = memory(colours, colours=(*RGB, gdal.GCI_AlphaBand), nodata=7)
    gdal.GetDriverByName("GTiff").CreateCopy(image, layers)
    heard = warnings_of(lambda: copy(terrain(20, 30), tmp_path / "a.tks", "TEXTURE=" + image))[1]
    assert len(heard) == 1 and "not applied and not kept" in heard[0], heard


def test_texture_with_a_mask(tmp_path):
    image = str(tmp_path / "image.tif")
    layers = np.stack([terrain(45, 60, "u1", seed) for seed in range(3)])
    with_mask = gdal.GetDriverByName("GTiff").CreateCopy(image, memory(layers, colours=RGB))
    with_mask.CreateMaskBand(gdal.GMF_PER_DATASET)
    mask = np.full((45, 60), 255, np.uint8)
    mask[10:20, 5:50] = 0
    with_mask.GetRasterBand(1).GetMaskBand().WriteArray(mask)
    del with_mask
    copy(terrain(40, 50), tmp_path / "a.tks", "TEXTURE=" + image)
    back = gdal.Open(f'TKS:"{tmp_path}/a.tks":texture')
    assert back.RasterCount == 4
    np.testing.assert_array_equal(back.GetRasterBand(4).ReadAsArray(), mask)
    np.testing.assert_array_equal(back.ReadAsArray()[:3][:, mask > 0], layers[:, mask > 0])


def test_reflectances_have_a_white_level(tmp_path):
    """Found, given, or that of the stream which is copied; pixels stay."""
    layers = np.stack([200 + terrain(45, 60, "u2", seed) % 2800 for seed in range(3)]).astype("u2")
    source = memory(layers, colours=RGB)
    found = int(copy(source, tmp_path / "a.tks").GetMetadataItem("WHITE_LEVEL", "TKS"))
    assert 1500 < found <= 3000
    given = copy(source, tmp_path / "b.tks", "WHITE_LEVEL=1234")
    assert given.GetMetadataItem("WHITE_LEVEL", "TKS") == "1234"
    again = copy(given, tmp_path / "c.tks")
    assert again.GetMetadataItem("WHITE_LEVEL", "TKS") == "1234"
    np.testing.assert_array_equal(again.ReadAsArray(), layers)
    whole = copy(source, tmp_path / "d.tks", "WHITE_LEVEL=65535")
    assert whole.GetMetadataItem("WHITE_LEVEL", "TKS") is None
    for option, words in (("70000", "white level"), ("white", "WHITE_LEVEL")):
        refused(lambda: copy(source, tmp_path / "e.tks", "WHITE_LEVEL=" + option), words)
    heights = terrain(20, 25, "i2")
    refused(lambda: copy(heights, tmp_path / "e.tks", "WHITE_LEVEL=9"), "there is none")
