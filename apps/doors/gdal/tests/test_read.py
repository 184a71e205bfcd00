# SPDX-License-Identifier: Apache-2.0
"""What GDAL says of streams, and the samples it reads of them: all, windows, overviews, masks."""

import itertools
import json
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import REPOSITORY, copy, first_band, gdal, means_over, memory, refused, samples, terrain


def gdalinfo(name, *options):
    done = subprocess.run(["gdalinfo", "-json", *options, name], capture_output=True, check=True)
    return json.loads(done.stdout)


def test_gdalinfo_says_all(placed):
    said = gdalinfo(placed)
    assert said["driverShortName"] == "TKS" and said["size"] == [340, 300]
    assert said["geoTransform"] == [400000, 10, 0, 3800000, 0, -10]
    assert said["coordinateSystem"]["wkt"].startswith("COMPOUNDCRS")
    assert "EGM96 height" in said["coordinateSystem"]["wkt"]
    assert said["metadata"][""]["AREA_OR_POINT"] == "Point"
    assert said["metadata"]["IMAGE_STRUCTURE"] == {"COMPRESSION_REVERSIBILITY": "LOSSLESS"}
    subdatasets = said["metadata"]["SUBDATASETS"]
    assert subdatasets["SUBDATASET_1_NAME"] == f'TKS:"{placed}":heights'
    assert subdatasets["SUBDATASET_2_NAME"] == f'TKS:"{placed}":texture'
    (band,) = said["bands"]
    assert (band["type"], band["unit"], band["scale"], band["offset"]) == ("Int16", "m", 0.5, 100)
    assert band["noDataValue"] == -32768 and band["description"] == "ridges"
    assert [each["size"] for each in band["overviews"]] == [[170, 150]]


def test_subdatasets(placed, texture):
    for name in (f'TKS:"{placed}":heights', f"TKS:{placed}:heights"):
        heights = gdal.Open(name)
        assert heights.RasterCount == 1 and not heights.GetMetadata("SUBDATASETS")
        np.testing.assert_array_equal(heights.ReadAsArray(), terrain(dtype="i2"))
        assert heights.GetFileList() == [placed]
    image, original = gdal.Open(f'TKS:"{placed}":texture'), gdal.Open(texture)
    np.testing.assert_array_equal(image.ReadAsArray(), original.ReadAsArray())
    assert image.GetGeoTransform() == pytest.approx(original.GetGeoTransform(), rel=1e-15)
    assert image.GetSpatialRef().GetAuthorityCode(None) == "32611"
    colours = [image.GetRasterBand(i).GetColorInterpretation() for i in range(1, 5)]
    assert colours == [gdal.GCI_RedBand, gdal.GCI_GreenBand, gdal.GCI_BlueBand, gdal.GCI_AlphaBand]
    assert image.GetRasterBand(1).GetMaskFlags() == gdal.GMF_ALPHA + gdal.GMF_PER_DATASET
    assert gdal.Open(f'TKS:"{placed}":Texture').RasterCount == 4
    forms = ('TKS:"FILE":heights', 'TKS:"FILE":texture')
    for wrong in (f'TKS:"{placed}":water', f"TKS:{placed}", "TKS:/vsicurl/http://host:8765/a.tks"):
        refused(lambda wrong=wrong: gdal.Open(wrong), wrong, *forms)


def test_a_texture_without_a_place_lies_as_on_meshes(tmp_path):
    name = str(tmp_path / "a.tks")
    transform = (400000, 10, 2, 3800000, 3, -10)
    image = str(tmp_path / "image.png")
    gdal.GetDriverByName("PNG").CreateCopy(image, memory(np.stack([terrain(90, 170, "u1")] * 3)))
    heights = memory(terrain(31, 35), transform=transform, crs="EPSG:32611+5773")
    copy(heights, name, "TEXTURE=" + image)
    texture = gdal.Open(f'TKS:"{name}":texture')
    assert texture.GetSpatialRef().GetAuthorityCode(None) == "32611"
    assert not texture.GetSpatialRef().IsCompound()
    # Its outer corners are the middles of the outer samples.
    for corner, sample in (((0, 0), (0.5, 0.5)), ((170, 90), (34.5, 30.5))):
        ground = gdal.ApplyGeoTransform(transform, *sample)
        assert gdal.ApplyGeoTransform(texture.GetGeoTransform(), *corner) == pytest.approx(ground)


def test_missing_components(tmp_path):
    name = str(tmp_path / "heights.tks")
    copy(terrain(20, 30), name)
    refused(lambda: gdal.Open(f'TKS:"{name}":texture'), "has no texture")
    image = str(REPOSITORY / "conformance/vectors/grey_61x40.tks")
    refused(lambda: gdal.Open(f'TKS:"{image}":heights'), "has no heights")
    assert gdal.Open(image).RasterXSize == 61  # opened as what it is


@pytest.mark.parametrize("options", [["BLOCKSIZE=64"], ["BLOCKSIZE=NONE"], ["MAX_Z_ERROR=3"]])
def test_windows_equal_the_whole(tmp_path, options):
    name = str(tmp_path / "a.tks")
    copy(terrain(dtype="i2"), name, *options)
    dataset = gdal.Open(name)
    whole = dataset.ReadAsArray()
    half = dataset.GetRasterBand(1).GetOverview(0).ReadAsArray()
    rng = np.random.default_rng(2)
    for _ in range(12):
        x, y = rng.integers(0, 330), rng.integers(0, 290)
        width, height = rng.integers(1, 341 - x), rng.integers(1, 301 - y)
        fresh = gdal.Open(name)
        part = fresh.ReadAsArray(int(x), int(y), int(width), int(height))
        np.testing.assert_array_equal(part, whole[y : y + height, x : x + width])
        u, v = int(x // 2), int(y // 2)
        block = fresh.GetRasterBand(1).GetOverview(0).ReadAsArray(u, v, 5, 5)
        np.testing.assert_array_equal(block, half[v : v + 5, u : u + 5])


def test_blocks_equal_the_whole(tmp_path):
    name = str(tmp_path / "a.tks")
    copy(terrain(dtype="u2"), name, "BLOCKSIZE=64")
    dataset = gdal.Open(name)
    band, whole = dataset.GetRasterBand(1), terrain(dtype="u2")
    side, _ = band.GetBlockSize()
    for x, y in ((1, 1), (0, 0), (1, 0), (0, 1)):
        block = np.frombuffer(band.ReadBlock(x, y), np.uint16).reshape(side, side)
        part = whole[y * side : (y + 1) * side, x * side : (x + 1) * side]
        np.testing.assert_array_equal(block[: part.shape[0], : part.shape[1]], part)


@pytest.mark.parametrize("rows, columns", [(70, 80), (130, 70), (140, 200), (65, 300)])
def test_statistics_which_read_block_by_block(tmp_path, rows, columns):
    """GDAL puts a block into its cache before it asks for its samples: it is not there yet."""
    name = str(tmp_path / "a.tks")
    heights = terrain(rows, columns, "i2")
    copy(heights, name, "BLOCKSIZE=32")
    dataset = gdal.Open(name)
    low, high, mean, spread = dataset.GetRasterBand(1).ComputeStatistics(False)
    assert (low, high) == (heights.min(), heights.max())
    assert (mean, spread) == pytest.approx((heights.mean(), heights.std()))
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)


@pytest.mark.parametrize("cache", [1 << 17, 1 << 18, 1 << 26])
def test_blocks_one_after_the_other(tmp_path, cache):
    """By rows, by columns, and level 1: strips that are decoded at once, of any height."""
    name = str(tmp_path / "a.tks")
    copy(terrain(300, 260, "i4"), name, "BLOCKSIZE=32")
    before = gdal.GetCacheMax()
    try:
        gdal.SetCacheMax(cache)
        for level in (None, 0):
            for order in (1, -1):
                dataset = gdal.Open(name)
                band = dataset.GetRasterBand(1)
                band = band if level is None else band.GetOverview(level)
                read = np.zeros((band.YSize, band.XSize), "i4")
                for y, x in itertools.product(range(0, band.YSize, 64), range(0, band.XSize, 64)):
                    x, y = (x, y) if order == 1 else (band.XSize - 1 - x, band.YSize - 1 - y)
                    width, height = min(64, band.XSize - x), min(64, band.YSize - y)
                    part = band.ReadAsArray(x, y, width, height)
                    read[y : y + height, x : x + width] = part
                if order == 1:
                    np.testing.assert_array_equal(read, band.ReadAsArray())
                else:
                    np.testing.assert_array_equal(part, band.ReadAsArray(x, y, width, height))
                if level is None and order == 1:
                    np.testing.assert_array_equal(read, terrain(300, 260, "i4"))
    finally:
        gdal.SetCacheMax(before)


def test_small_cache(tmp_path):
    """Strips of blocks are decoded again where the cache cannot keep them: the same samples."""
    name = str(tmp_path / "a.tks")
    copy(terrain(700, 600, "i4"), name, "BLOCKSIZE=64")
    before = gdal.GetCacheMax()
    try:
        gdal.SetCacheMax(1 << 18)
        np.testing.assert_array_equal(gdal.Open(name).ReadAsArray(), terrain(700, 600, "i4"))
    finally:
        gdal.SetCacheMax(before)


@pytest.mark.parametrize("options", [["BLOCKSIZE=128"], ["BLOCKSIZE=NONE"]])
def test_overviews_lie_where_gdal_has_them(tmp_path, options):
    """Overview k is nearer to means of 2^k x 2^k samples than to means that lie elsewhere: that is
    where its pixels are."""
    heights = terrain(1024, 1152)
    dataset = copy(heights, tmp_path / "a.tks", *options)
    band = dataset.GetRasterBand(1)
    assert band.GetOverviewCount() == 3
    for k in range(1, band.GetOverviewCount() + 1):
        side = 2**k
        overview = band.GetOverview(k - 1).ReadAsArray()
        means = heights.reshape(1024 // side, side, 1152 // side, side).mean(axis=(1, 3))
        error = np.sqrt(np.mean((overview - means) ** 2))
        assert error < 0.005 * np.ptp(heights)
        # Sampled where the mip level has its samples it would be this far off.
        level = heights[::side, ::side]
        assert k == 1 or error < 0.2 * np.sqrt(np.mean((level - means) ** 2))
    first = band.GetOverview(0).ReadAsArray()
    means = heights.astype(np.float64).reshape(512, 2, 576, 2).mean(axis=(1, 3))
    np.testing.assert_array_equal(first, means.astype(np.float32))


@pytest.mark.parametrize("rows, columns", [(1025, 513), (527, 258), (1, 2049)])
def test_overviews_of_all_sizes_share_the_ground(tmp_path, rows, columns):
    """GDAL takes overviews as pixels of one size over all of the raster, also where its sides are
    no multiples of 2^k: on slopes the last pixel would be off by almost its own size."""
    slope = np.add.outer(np.arange(rows), np.arange(columns)).astype("f4")
    band = first_band(copy(slope, tmp_path / "a.tks"))
    assert band.GetOverviewCount() > 0
    for number in range(band.GetOverviewCount()):
        overview = band.GetOverview(number).ReadAsArray()
        error = np.abs(overview - means_over(slope, *overview.shape))
        # At its borders a low-pass filter bends slopes.
        assert error[: max(1, len(error) - 4), :-4].max() < 0.05 and error.max() < 0.7


def test_downsampled_reads_use_overviews(placed):
    dataset = gdal.Open(placed)
    overview = dataset.GetRasterBand(1).GetOverview(0).ReadAsArray()
    np.testing.assert_array_equal(
        dataset.GetRasterBand(1).ReadAsArray(buf_xsize=170, buf_ysize=150), overview
    )
    small = gdal.OpenEx(placed, open_options=["OVERVIEW_LEVEL=0"])
    np.testing.assert_array_equal(small.ReadAsArray(), overview)


def test_overviews_of_voids(tmp_path):
    heights = terrain(301, 303)
    heights[40:101, 60:200] = -9999
    dataset = copy(memory(heights, nodata=-9999), tmp_path / "a.tks")
    overview = dataset.GetRasterBand(1).GetOverview(0)
    assert overview.GetNoDataValue() == -9999
    values = overview.ReadAsArray()
    assert values.shape == (151, 152)
    all_void = means_over(heights == -9999, 151, 152) > 1 - 1e-9
    assert all_void.sum() > 1000
    np.testing.assert_array_equal(values == -9999, all_void)
    assert values[~all_void].min() >= 0  # no mean of void and height
    mask = overview.GetMaskBand().ReadAsArray()
    np.testing.assert_array_equal(mask == 0, all_void)


@pytest.mark.parametrize("dtype", ["i2", "u2", "f4"])
@pytest.mark.parametrize("nodata", [0, 9, 32767])
def test_ground_whose_mean_is_nodata_is_no_void(tmp_path, dtype, nodata):
    y, x = np.mgrid[0:300, 0:300]
    heights = (nodata + np.where((x + y) % 2, 3, -3) + (3 if dtype == "u2" else 0)).astype(dtype)
    if dtype == "i2" and nodata == 32767:
        heights = np.where((x + y) % 2, 32766, 32767).astype(dtype)
    declared = nodata + 3 if dtype == "u2" else nodata
    heights[:50, :50] = declared
    band = first_band(copy(memory(heights, nodata=declared), tmp_path / "a.tks"))
    overview = band.GetOverview(0)
    assert (overview.GetMaskBand().ReadAsArray()[30:] == 255).all()
    assert (overview.GetMaskBand().ReadAsArray()[:20, :20] == 0).all()
    off = np.abs(overview.ReadAsArray()[30:].astype(float) - declared)
    assert 0 < off.max() <= 1


def test_overviews_of_cutouts(placed):
    image = gdal.Open(f'TKS:"{placed}":texture')
    small = np.stack([image.GetRasterBand(i).GetOverview(0).ReadAsArray() for i in range(1, 5)])
    assert small.shape == (4, 200, 225)
    assert (small[3, 50:90, 20:100] == 0).all() and (small[3, :50] == 255).all()
    whole = image.ReadAsArray().astype(np.float64)
    means = whole[:, :100].reshape(4, 50, 2, 225, 2).mean(axis=(2, 4))
    np.testing.assert_allclose(small[:, :50], means, atol=0.51)


def test_masks(tmp_path):
    heights = terrain(40, 50, "i2")
    heights[5:9, 7:20] = -1
    dataset = copy(memory(heights, nodata=-1), tmp_path / "a.tks")
    band = dataset.GetRasterBand(1)
    assert band.GetMaskFlags() == gdal.GMF_NODATA
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() != 0, heights != -1)
    plain = first_band(copy(terrain(40, 50), tmp_path / "b.tks"))
    assert plain.GetMaskFlags() == gdal.GMF_ALL_VALID and plain.GetNoDataValue() is None


def test_nan_comes_back_undeclared(tmp_path):
    heights = terrain(40, 50)
    heights[3:8, 11:30] = np.nan
    band = first_band(copy(heights, tmp_path / "a.tks"))
    assert band.GetNoDataValue() is None and band.GetMaskFlags() == gdal.GMF_ALL_VALID
    np.testing.assert_array_equal(band.ReadAsArray(), heights)
    declared = first_band(copy(memory(heights, nodata=np.nan), tmp_path / "b.tks"))
    assert np.isnan(declared.GetNoDataValue())
    np.testing.assert_array_equal(declared.GetMaskBand().ReadAsArray() == 0, np.isnan(heights))


def test_statistics_go_beside(tmp_path):
    name = str(tmp_path / "a.tks")
    copy(terrain(40, 50), name)
    before = (tmp_path / "a.tks").read_bytes()
    dataset = gdal.Open(name)
    low, high, *_ = dataset.GetRasterBand(1).ComputeStatistics(False)
    del dataset
    assert (tmp_path / "a.tks.aux.xml").exists() and (tmp_path / "a.tks").read_bytes() == before
    metadata = first_band(gdal.Open(name)).GetMetadata()
    assert float(metadata["STATISTICS_MAXIMUM"]) == pytest.approx(high)
    assert gdal.Open(name).GetFileList() == [name, name + ".aux.xml"]
    # A place that a user gives goes there too, and counts.
    dataset = gdal.Open(name)
    dataset.SetGeoTransform((7, 1, 0, 9, 0, -1))
    del dataset
    assert gdal.Open(name).GetGeoTransform() == (7, 1, 0, 9, 0, -1)


def test_statistics_of_a_prefix_are_not_kept(tmp_path):
    name = str(tmp_path / "a.tks")
    copy(terrain(40, 50), name)
    prefix = gdal.OpenEx(name, open_options=["BYTES=400"])
    rough = prefix.GetRasterBand(1).ComputeStatistics(False)
    del prefix
    assert not (tmp_path / "a.tks.aux.xml").exists()
    assert first_band(gdal.Open(name)).ComputeStatistics(False) != rough


def test_gdalwarp(placed, tmp_path):
    out = str(tmp_path / "warped.tif")
    options = ["-q", "-novshift", "-t_srs", "EPSG:32611", "-tr", "10", "10"]
    subprocess.run(["gdalwarp", *options, placed, out], check=True)
    warped = gdal.Open(out)
    np.testing.assert_array_equal(warped.ReadAsArray(), terrain(dtype="i2"))
    degrees = str(tmp_path / "degrees.tif")
    subprocess.run(["gdalwarp", "-q", "-t_srs", "EPSG:4326", placed, degrees], check=True)
    assert first_band(gdal.Open(degrees)).ComputeRasterMinMax()[1] > 0


def test_gdaladdo_is_refused(placed):
    before = open(placed, "rb").read()
    for options in (["-ro"], []):
        command = ["gdaladdo", *options, placed, "2", "4"]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode != 0 and "own overviews" in done.stderr, done.stderr
    assert open(placed, "rb").read() == before


def test_update_is_refused(placed):
    refused(lambda: gdal.Open(placed, gdal.GA_Update), "cannot be changed in place")


def test_threads_with_datasets_of_their_own(tmp_path):
    name = str(tmp_path / "a.tks")
    heights = terrain(600, 640, "i2")
    copy(heights, name, "BLOCKSIZE=64")

    def windows(seed):
        rng = np.random.default_rng(seed)
        dataset = gdal.Open(name)
        for _ in range(6):
            x, y = (int(v) for v in rng.integers(0, 500, 2))
            part = dataset.ReadAsArray(x, y, 100, 90)
            if not (part == heights[y : y + 90, x : x + 100]).all():
                return False
        return dataset.GetRasterBand(1).GetOverview(1).Checksum()

    with ThreadPoolExecutor(8) as pool:
        sums = list(pool.map(windows, range(12)))
    assert sums[0] and sums == sums[:1] * 12


def test_checksums_as_autotest(placed):
    """GDAL's autotest idiom."""
    dataset = gdal.Open(placed)
    twin = memory(terrain(dtype="i2"))
    assert dataset.GetRasterBand(1).Checksum() == twin.GetRasterBand(1).Checksum()
    assert dataset.GetDriver().ShortName == "TKS"
    assert samples(dataset).dtype == np.int16
