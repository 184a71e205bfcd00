# SPDX-License-Identifier: Apache-2.0
"""CreateCopy: every type and creation option, places and reference systems, what is refused."""

import os
import resource
import subprocess
import sys

import numpy as np
import pytest
from conftest import (
    RGB,
    SAMPLES,
    copy,
    first_band,
    gdal,
    gdal_type,
    memory,
    refused,
    samples,
    system,
    terrain,
    warnings_of,
)


@pytest.mark.parametrize("dtype", SAMPLES)
@pytest.mark.parametrize("shape", [(2, 2), (37, 80), (90, 41)])
def test_lossless(tmp_path, dtype, shape):
    heights = terrain(*shape, dtype)
    name = str(tmp_path / "a.tks")
    dataset = copy(heights, name)
    np.testing.assert_array_equal(samples(dataset), heights)
    assert dataset.GetRasterBand(1).DataType == gdal_type(dtype)
    assert dataset.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSLESS"


@pytest.mark.parametrize("dtype", SAMPLES)
def test_gdal_translate_both_ways(tmp_path, dtype):
    tif, tks, back = (str(tmp_path / name) for name in ("a.tif", "a.tks", "b.tif"))
    options = ["PIXELTYPE=SIGNEDBYTE"] if dtype == "i1" and gdal_type("i1") == gdal.GDT_Byte else []
    gdal.GetDriverByName("GTiff").CreateCopy(tif, memory(terrain(60, 80, dtype)), options=options)
    subprocess.run(["gdal_translate", "-q", tif, tks], check=True)
    subprocess.run(["gdal_translate", "-q", tks, back], check=True)
    np.testing.assert_array_equal(samples(gdal.Open(back)), terrain(60, 80, dtype))
    assert gdal.Open(tks).GetDriver().ShortName == "TKS"


def test_floats_bit_for_bit(tmp_path):
    bits = np.random.default_rng(3).integers(0, 2**32, (50, 60), np.uint32)
    wild = bits.view(np.float32).copy()
    wild[~np.isfinite(wild)] = -0.0
    back = copy(wild, tmp_path / "a.tks").ReadAsArray()
    np.testing.assert_array_equal(back.view(np.uint32), wild.view(np.uint32))


@pytest.mark.parametrize("dtype", ["i2", "u4", "f4"])
@pytest.mark.parametrize("error", ["5", "0.5", "60"])
def test_max_z_error_holds(tmp_path, dtype, error):
    name = tmp_path / "a.tks"
    dataset = copy(terrain(dtype=dtype), name, "MAX_Z_ERROR=" + error)
    off = np.abs(dataset.ReadAsArray().astype(float) - terrain(dtype=dtype).astype(float))
    assert off.max() <= float(error)
    # Half a step of an integer is none: that takes the bytes of lossless, and the error's.
    assert name.stat().st_size < copy_size(tmp_path, terrain(dtype=dtype)) + 9


def copy_size(folder, heights, *options):
    copy(heights, folder / "size.tks", *options)
    return (folder / "size.tks").stat().st_size


def test_max_z_error_is_in_pixel_values(tmp_path):
    """As LERC has it: the scale to metres does not count."""
    heights = terrain(dtype="i2")
    source = memory(heights, scale=0.01, offset=5, unit="m")
    dataset = copy(source, tmp_path / "a.tks", "MAX_Z_ERROR=5")
    off = np.abs(dataset.ReadAsArray().astype(float) - heights)
    assert 2 < off.max() <= 5
    assert dataset.GetMetadataItem("MAX_ERROR", "TKS") == "0.050000000000000003"


def test_bytes_and_psnr(tmp_path):
    heights = terrain()
    name = tmp_path / "a.tks"
    for budget in (500, 4000, 20000):
        copy(heights, name, f"BYTES={budget}")
        assert 0.8 * budget < name.stat().st_size <= budget
    for psnr in (40, 60):
        back = copy(heights, name, f"PSNR={psnr}").ReadAsArray()
        rmse = np.sqrt(np.mean((back.astype(float) - heights) ** 2))
        assert 20 * np.log10(np.ptp(heights) / rmse) >= psnr


def test_blocksize_and_index(tmp_path):
    heights = terrain(dtype="i2")
    plain = copy_size(tmp_path, heights)
    assert copy_size(tmp_path, heights, "BLOCKSIZE=32") > plain
    assert copy_size(tmp_path, heights, "BLOCKSIZE=NONE") == plain
    assert copy_size(tmp_path, heights, "INDEX=NO") == plain
    assert copy_size(tmp_path, heights, "INDEX=YES") > plain
    assert copy_size(tmp_path, heights, "INDEX=WINDOWS", "BLOCKSIZE=32") > plain
    refused(lambda: copy(heights, tmp_path / "b.tks", "INDEX=WINDOWS", "BYTES=4000"), "lossless")
    refused(lambda: copy(heights, tmp_path / "b.tks", "INDEX=MAYBE"), "INDEX=MAYBE")
    unregioned = ("INDEX=WINDOWS", "BLOCKSIZE=NONE")
    refused(lambda: copy(heights, tmp_path / "b.tks", *unregioned), *unregioned)
    for side in ("8", "100", "2097152", "-64", "x"):
        option = "BLOCKSIZE=" + side
        refused(lambda option=option: copy(heights, tmp_path / "b.tks", option), option)
    assert not (tmp_path / "b.tks").exists()
    blocks = first_band(copy(heights, tmp_path / "b.tks", "BLOCKSIZE=128"))
    assert blocks.GetBlockSize() == [64, 64]


def test_num_threads_changes_no_byte(tmp_path):
    written = []
    for threads in ("1", "4", "ALL_CPUS"):
        copy(terrain(), tmp_path / "a.tks", "NUM_THREADS=" + threads)
        written.append((tmp_path / "a.tks").read_bytes())
    assert written[0] == written[1] == written[2]
    for wrong in ("NUM_THREADS=0", "NUM_THREADS=2.5"):
        refused(lambda: copy(terrain(), tmp_path / "b.tks", wrong), wrong)


@pytest.mark.parametrize(
    "options, words",
    [
        (["BYTES=4000", "PSNR=40"], "exclude each other"),
        (["MAX_Z_ERROR=1", "BYTES=4000"], "exclude each other"),
        (["MAX_Z_ERROR=0", "PSNR=40"], "exclude each other"),
        (["MAX_Z_ERROR=-1"], "MAX_Z_ERROR=-1"),
        (["MAX_Z_ERROR=some"], "MAX_Z_ERROR=some"),
        (["BYTES=0"], "BYTES=0"),
        (["BYTES=10"], ""),
        (["PSNR=0"], "PSNR"),
        (["PSNR=nan"], "PSNR=nan"),
        (["TEXTURE=/nowhere.png"], ""),
    ],
)
def test_options_that_make_no_sense(tmp_path, options, words):
    with pytest.raises(RuntimeError, match=words):
        copy(terrain(40, 50), tmp_path / "a.tks", *options)
    assert list(tmp_path.iterdir()) == []


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
    refused(lambda: copy(terrain(20, 25), tmp_path / "b.tks", "TEXTURE=" + name), "no mask")
    refused(lambda: copy(gdal.Open(name), tmp_path / "c.tks"), "one band", "no mask")


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
    """Beside heights there is no place for it; a picture alone keeps it beside the stream."""
    image = str(tmp_path / "image.tif")
    layers = memory(np.stack([terrain(20, 30, "u1")] * 3), colours=RGB, nodata=7)
    gdal.GetDriverByName("GTiff").CreateCopy(image, layers)
    heard = warnings_of(lambda: copy(terrain(20, 30), tmp_path / "a.tks", "TEXTURE=" + image))[1]
    assert len(heard) == 1 and "not applied and not kept" in heard[0], heard
    heard = warnings_of(lambda: copy(layers, tmp_path / "b.tks"))[1]
    assert heard == []
    assert first_band(gdal.Open(str(tmp_path / "b.tks"))).GetNoDataValue() == 7


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


@pytest.mark.parametrize(
    "transform",
    [
        (400000, 30, 0, 3800000, 0, -30),
        (100.25, 3, 8, 900, 4, -6),
        (-180, 0.1, 0, 90, 0, -0.1),
        (5, -2, 0, 5, 0, 3),
    ],
)
def test_geotransforms_are_kept(tmp_path, transform):
    for registration in ("Area", "Point"):
        source = memory(terrain(20, 30), transform=transform, area_or_point=registration)
        dataset = copy(source, tmp_path / "a.tks")
        assert dataset.GetGeoTransform() == transform
        assert dataset.GetMetadataItem("AREA_OR_POINT") == registration
        assert not (tmp_path / "a.tks.aux.xml").exists()
    assert copy(terrain(20, 30), tmp_path / "b.tks").GetGeoTransform(can_return_null=True) is None


LOCAL = 'LOCAL_CS["my grid",UNIT["metre",1]]'
LAMBERT = "+proj=lcc +lat_1=44 +lat_2=49 +lat_0=46.5 +lon_0=3 +x_0=7e5 +y_0=6.6e6 +ellps=GRS80"


@pytest.mark.parametrize(
    "crs", ["EPSG:32611", "EPSG:4326", "EPSG:32611+5773", "EPSG:6893", LOCAL, LAMBERT]
)
def test_reference_systems_are_kept(tmp_path, crs):
    source = memory(terrain(20, 30), crs=crs, transform=(1, 1, 0, 1, 0, -1))
    name = tmp_path / "a.tks"
    copy(source, name)
    back = gdal.Open(str(name)).GetSpatialRef()
    assert back.IsSame(system(crs)), back.ExportToWkt()
    axes = source.GetSpatialRef().GetDataAxisToSRSAxisMapping()
    assert back.GetDataAxisToSRSAxisMapping() == axes
    assert not (tmp_path / "a.tks.aux.xml").exists()
    if crs.startswith("EPSG"):
        assert b"CRS[" not in name.read_bytes()  # a code is enough


def test_epoch_goes_beside(tmp_path):
    crs = system("EPSG:9754")
    crs.SetCoordinateEpoch(2020.5)
    source = memory(terrain(20, 30))
    source.SetSpatialRef(crs)
    copy(source, tmp_path / "a.tks")
    assert gdal.Open(str(tmp_path / "a.tks")).GetSpatialRef().GetCoordinateEpoch() == 2020.5


def test_reference_system_that_cannot_be_parsed(tmp_path, monkeypatch):
    """A stream may hold any text there; the raster is opened without, and a warning says why."""
    source = memory(terrain(20, 30), crs=LOCAL)
    name = tmp_path / "a.tks"
    copy(source, name)
    data = bytearray(name.read_bytes())
    at = data.index(b"ENGCRS")
    data[at : at + 6] = b"HUMBUG"
    # The header ends with a checksum of all bytes before it (docs/FORMAT.md, section 2).
    import zlib

    size, shift, start = 0, 0, 7
    while True:
        size |= (data[start] & 127) << shift
        shift, start = shift + 7, start + 1
        if data[start - 1] < 128:
            break
    end = start + size
    data[end : end + 4] = zlib.crc32(data[:end]).to_bytes(4, "little")
    name.write_bytes(data)
    dataset, heard = warnings_of(lambda: gdal.Open(str(name)))
    assert dataset.GetSpatialRef() is None and any("HUMBUG" in text for text in heard)
    np.testing.assert_array_equal(dataset.ReadAsArray(), terrain(20, 30))


def test_facts_of_the_band(tmp_path):
    source = memory(
        terrain(20, 30, "i2"), nodata=-7, unit="ft", scale=-2.5, offset=1e3, description="höhe"
    )
    band = first_band(copy(source, tmp_path / "a.tks"))
    assert (band.GetScale(), band.GetOffset(), band.GetUnitType()) == (-2.5, 1000, "ft")
    assert band.GetDescription() == "höhe" and band.GetNoDataValue() == -7
    plain = first_band(copy(terrain(20, 30), tmp_path / "b.tks"))
    assert plain.GetScale() is None and plain.GetOffset() is None and plain.GetUnitType() == ""


@pytest.mark.parametrize("nodata", [-9999, -3.4028234663852886e38, -3.402823e38, float("nan"), 0.1])
def test_nodata_of_floats(tmp_path, nodata):
    heights = terrain(30, 40)
    heights[3:9, 5:20] = nodata
    dataset = copy(memory(heights, nodata=nodata), tmp_path / "a.tks", "MAX_Z_ERROR=1")
    band = dataset.GetRasterBand(1)
    np.testing.assert_array_equal(band.ReadAsArray()[3:9, 5:20], heights[3:9, 5:20])
    void = np.zeros((30, 40), bool)
    void[3:9, 5:20] = True
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() == 0, void)


@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_nan_without_nodata_stays_undeclared(tmp_path, dtype):
    """As GDAL copies it. Overviews leave it out of their means all the same."""
    heights = terrain(600, 700).astype(dtype)
    heights[30:91, 50:201] = np.nan
    band = first_band(copy(heights, tmp_path / "a.tks"))
    np.testing.assert_array_equal(band.ReadAsArray(), heights)
    assert band.GetNoDataValue() is None and band.GetMaskFlags() == gdal.GMF_ALL_VALID
    coarse = band.GetOverview(0).ReadAsArray()
    np.testing.assert_array_equal(np.isnan(coarse), np.isnan(heights).reshape(300, 2, 350, 2)
                                  .all(axis=(1, 3)))
    declared = first_band(copy(memory(heights, nodata=np.nan), tmp_path / "b.tks"))
    assert np.isnan(declared.GetNoDataValue())


def test_a_scale_of_0_is_none(tmp_path):
    heights = terrain(20, 30, "i2")
    source = memory(heights, scale=0, offset=7)
    dataset, heard = warnings_of(lambda: copy(source, tmp_path / "a.tks"))
    assert [text for text in heard if "scale of 0 is none" in text]
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)
    assert (dataset.GetRasterBand(1).GetScale(), dataset.GetRasterBand(1).GetOffset()) == (1, 7)


@pytest.mark.parametrize("dtype", ["u1", "i2", "u2", "f4"])
def test_masks_become_nodata(tmp_path, dtype):
    heights = terrain(30, 40, dtype) // 2 + 1
    source = memory(heights.astype(dtype))
    source.CreateMaskBand(gdal.GMF_PER_DATASET)
    mask = np.full((30, 40), 255, np.uint8)
    mask[3:9, 5:20] = 0
    source.GetRasterBand(1).GetMaskBand().WriteArray(mask)
    band = first_band(copy(source, tmp_path / "a.tks"))
    assert band.GetNoDataValue() is not None
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray(), mask)
    np.testing.assert_array_equal(band.ReadAsArray()[mask > 0], heights[mask > 0])


def test_a_mask_without_room(tmp_path):
    source = memory(np.arange(512, dtype=np.uint16).astype(np.uint8).reshape(16, 32))
    source.CreateMaskBand(gdal.GMF_PER_DATASET)
    mask = np.full((16, 32), 255, np.uint8)
    mask[0, 0] = 0
    source.GetRasterBand(1).GetMaskBand().WriteArray(mask)
    refused(lambda: copy(source, tmp_path / "a.tks"), "wider type")


def test_doubles(tmp_path):
    exact = terrain(30, 40).astype(np.float64)
    band = first_band(copy(exact, tmp_path / "a.tks"))
    assert band.DataType == gdal.GDT_Float32
    np.testing.assert_array_equal(band.ReadAsArray(), exact)
    refused(lambda: copy(exact + 1e-9, tmp_path / "b.tks"), "Float64")
    assert not (tmp_path / "b.tks").exists()
    gdal.PushErrorHandler("CPLQuietErrorHandler")
    rounded = copy(exact + 1e-9, tmp_path / "b.tks", strict=False)
    gdal.PopErrorHandler()
    np.testing.assert_array_equal(rounded.ReadAsArray(), (exact + 1e-9).astype(np.float32))


def written_quietly(source, name, *options):
    """Without GDAL's warning that doubles are rounded."""
    gdal.PushErrorHandler("CPLQuietErrorHandler")
    try:
        return copy(source, name, *options, strict=False)
    finally:
        gdal.PopErrorHandler()


def test_the_largest_error_counts_what_rounding_doubles_took(tmp_path):
    y, x = np.mgrid[0:40, 0:50]
    heights = 2e7 + 0.7 * x + 0.3 * y  # floats are 2 apart here
    name = tmp_path / "a.tks"
    refused(lambda: written_quietly(heights, name, "MAX_Z_ERROR=0.01"), "Float64", "MAX_Z_ERROR")
    assert not name.exists()
    for options, promised in (("MAX_Z_ERROR=3", 3), ("MAX_Z_ERROR=0", 1), ("BYTES=64k", 1)):
        for scale in (1, 0.5):
            source = memory(heights, scale=scale, offset=0)
            written = written_quietly(source, name, options)
            off = np.abs(written.ReadAsArray().astype(float) - heights).max()
            del written
            back = gdal.Open(str(name))
            assert 0.5 < off <= promised
            assert back.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSY"
            error = float(back.GetMetadataItem("MAX_ERROR", "TKS"))
            assert off * scale <= error <= promised * scale + 1e-6


@pytest.mark.parametrize("hole", [-np.finfo(np.float64).max, np.finfo(np.float64).max, 1e300])
def test_doubles_with_nodata_beyond_floats(tmp_path, hole):
    """Voids count for no rounding, whether a nodata value or a mask tells them."""
    heights = terrain(30, 40).astype(np.float64)
    void = np.zeros((30, 40), bool)
    void[3:9, 5:20] = True
    heights[void] = hole
    masked = memory(heights)
    masked.CreateMaskBand(gdal.GMF_PER_DATASET)
    masked.GetRasterBand(1).GetMaskBand().WriteArray(np.where(void, 0, 255).astype(np.uint8))
    for source in (memory(heights, nodata=hole), masked):
        for options in ((), ("MAX_Z_ERROR=1",)):
            band = first_band(copy(source, tmp_path / "a.tks", *options))
            np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() == 0, void)
            off = np.abs(band.ReadAsArray() - heights)[~void].max()
            assert off <= (1 if options else 0)


@pytest.mark.parametrize("dtype", ["i2", "f4", "f8"])
def test_fill_that_nobody_declared(tmp_path, capfd, dtype):
    """A copy that need not be strict declares it, and so does not spend a small budget on it."""
    heights = terrain(64, 80).astype(dtype)
    hole = np.zeros(heights.shape, bool)
    hole[::7, ::5] = True
    heights[hole] = -9999
    driver = gdal.GetDriverByName("TKS")
    off = []
    for strict in (False, True):
        name = str(tmp_path / f"{strict}.tks")
        driver.CreateCopy(name, memory(heights), strict, ["BYTES=600"])
        assert ("160 samples are -9999" in capfd.readouterr().err) == (not strict)
        dataset = gdal.Open(name)
        band = dataset.GetRasterBand(1)
        assert band.GetNoDataValue() == (None if strict else -9999)
        off.append(np.abs(band.ReadAsArray() - heights)[~hole].mean())
    assert off[0] < off[1] / 10
    name = str(tmp_path / "exact.tks")
    driver.CreateCopy(name, memory(heights), False)
    dataset = gdal.Open(name)
    band = dataset.GetRasterBand(1)
    np.testing.assert_array_equal(band.ReadAsArray(), heights)
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() == 0, hole)


def test_sizes_as_the_command_line_has_them(tmp_path):
    name = tmp_path / "a.tks"
    copy(terrain(), name, "BYTES=4k")
    written = name.read_bytes()
    for same in ("4096", "4K", "4kB", "4KiB"):
        copy(terrain(), name, "BYTES=" + same)
        assert name.read_bytes() == written
    for wrong in ("4x", "k", "0k", "4kk", "17179869184G"):
        refused(lambda wrong=wrong: copy(terrain(), name, "BYTES=" + wrong), "no number of bytes")


@pytest.mark.parametrize("shape", [(1, 9), (9, 1), (1, 1)])
def test_one_line_of_heights(tmp_path, shape):
    heights = np.arange(100, 100 + shape[0] * shape[1], dtype="i2").reshape(shape)
    dataset = copy(heights, tmp_path / "a.tks")
    np.testing.assert_array_equal(dataset.ReadAsArray().reshape(shape), heights)


def test_sources_that_are_no_heights(tmp_path):
    name = tmp_path / "a.tks"
    three = np.zeros((3, 8, 9), np.int16)
    message = refused(lambda: copy(three, name), "one band", "has 3", "-b 1")
    assert "TEXTURE" in message
    refused(lambda: copy(np.zeros((8, 9), np.complex64), name), "CFloat32")
    infinite = terrain(20, 30)
    infinite[4, 7] = np.inf
    refused(lambda: copy(infinite, name), "nfinit")
    assert not name.exists()


def test_unwritable_targets(tmp_path):
    for name in (tmp_path / "nowhere/a.tks", "/proc/a.tks", "/vsicurl/http://localhost:1/a.tks"):
        message = refused(lambda name=name: copy(terrain(20, 30), name), "cannot be written")
        assert "()" not in message
    (tmp_path / "folder.tks").mkdir()
    with pytest.raises(RuntimeError):
        copy(terrain(20, 30), tmp_path / "folder.tks")


def test_a_file_that_cannot_grow(tmp_path):
    """As a full disk: what was written of the stream goes away again."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    try:
        refused(lambda: copy(terrain(), tmp_path / "a.tks"), "cannot be written whole")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert list(tmp_path.iterdir()) == []


def test_virtual_files():
    heights = terrain(20, 30)
    np.testing.assert_array_equal(copy(heights, "/vsimem/a.tks").ReadAsArray(), heights)
    np.testing.assert_array_equal(gdal.Open('TKS:"/vsimem/a.tks":heights').ReadAsArray(), heights)
    gdal.Unlink("/vsimem/a.tks")


def test_streams_that_are_passed_on(tmp_path):
    """What goes to /vsistdout/ cannot be opened again."""
    source, name = str(tmp_path / "a.tif"), tmp_path / "a.tks"
    gdal.GetDriverByName("GTiff").CreateCopy(source, memory(terrain(60, 80, "i2"), nodata=0))
    translate = ["gdal_translate", "-q", "-of", "TKS", source]
    subprocess.run([*translate, str(name)], check=True)
    written = subprocess.run([*translate, "/vsistdout/"], check=True, capture_output=True)
    assert written.stdout == name.read_bytes() and written.stderr == b""
    # Who copies gets a dataset all the same, and nothing stays behind.
    script = (
        "from osgeo import gdal; import sys; source = gdal.Open(sys.argv[1]);"
        "copy = gdal.GetDriverByName('TKS').CreateCopy('/vsistdout/', source);"
        "assert (copy.ReadAsArray() == source.ReadAsArray()).all();"
        "assert not gdal.ReadDir('/vsimem/')"
    )
    done = subprocess.run([sys.executable, "-c", script, source], check=True, capture_output=True)
    assert done.stdout == name.read_bytes()
    assert set(os.listdir(tmp_path)) == {"a.tif", "a.tks"}


@pytest.mark.parametrize("stop", [0.0, 0.05, 0.3, 0.9, 1.0])
def test_cancelled(tmp_path, stop):
    seen = []

    def progress(done, *_):
        seen.append(done)
        return 0 if done >= stop else 1

    message = refused(lambda: copy(terrain(), tmp_path / "a.tks", "BYTES=9000", progress=progress))
    assert "topped by the user" in message
    assert list(tmp_path.iterdir()) == [] and sum(done >= stop for done in seen) == 1


def test_progress(tmp_path):
    seen = []
    copy(terrain(), tmp_path / "a.tks", progress=lambda done, *_: seen.append(done) or 1)
    assert seen == sorted(seen) and seen[-1] == 1 and len(seen) > 3 and seen[-2] < 1


def test_other_metadata_go_beside(tmp_path):
    source = memory(terrain(20, 30))
    source.SetMetadataItem("MISSION", "SRTM")
    copy(source, tmp_path / "a.tks")
    assert gdal.Open(str(tmp_path / "a.tks")).GetMetadataItem("MISSION") == "SRTM"
