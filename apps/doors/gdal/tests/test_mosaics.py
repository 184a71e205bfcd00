# SPDX-License-Identifier: Apache-2.0
"""CreateCopy by tiles (TILES): the same samples and facts as a copy in memory, in the memory of a
tile, and nothing left behind."""

import subprocess
import sys

import numpy as np
import pytest
from conftest import (
    SAMPLES,
    copy,
    gdal,
    memory,
    refused,
    samples,
    terrain,
    warnings_of,
)
from test_open_options import Server, served

SMALL = ("TILES=64", "BLOCKSIZE=32")
PLACE = dict(transform=(400000, 10, 0, 3800000, 0, -10), crs="EPSG:32611+5773")


def mosaic(source, name, *options, **more):
    return copy(source, name, *SMALL, *options, **more)


@pytest.fixture(scope="module")
def ground(tmp_path_factory):
    """A VRT of four GeoTIFFs, and their samples."""
    folder = tmp_path_factory.mktemp("ground")
    heights = terrain(330, 420, "i2")
    for row in range(2):
        for column in range(2):
            part = heights[165 * row :, 210 * column :][:165, :210]
            x, y = 400000 + 2100 * column, 3800000 - 1650 * row
            source = memory(part, transform=(x, 10, 0, y, 0, -10), crs="EPSG:32611")
            name = str(folder / f"{row}{column}.tif")
            gdal.GetDriverByName("GTiff").CreateCopy(name, source, options=["COMPRESS=DEFLATE"])
    parts = sorted(str(part) for part in folder.glob("*.tif"))
    gdal.BuildVRT(str(folder / "all.vrt"), parts).FlushCache()
    return folder / "all.vrt", heights


def test_a_vrt_of_several_files(tmp_path, ground):
    vrt, heights = ground
    back = mosaic(gdal.Open(str(vrt)), tmp_path / "a.tks")
    np.testing.assert_array_equal(back.ReadAsArray(), heights)
    np.testing.assert_array_equal(back.ReadAsArray(150, 100, 99, 77), heights[100:177, 150:249])
    assert back.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSLESS"
    assert back.GetMetadataItem("INDEX", "TKS") == "WINDOWS"
    assert gdal.OpenEx(str(tmp_path / "a.tks"), open_options=["STRICT=YES"]) is not None
    assert [path.name for path in tmp_path.iterdir()] == ["a.tks"]


@pytest.mark.parametrize("tiles", ["32", "128", "4096"])
@pytest.mark.parametrize("threads", ["1", "3"])
def test_bytes_do_not_depend_on_tiles_and_threads(tmp_path, ground, tiles, threads):
    source = gdal.Open(str(ground[0]))
    options = ("BLOCKSIZE=32", "INDEX=NO")
    copy(source, tmp_path / "a.tks", "TILES=64", *options)
    copy(source, tmp_path / "b.tks", "TILES=" + tiles, "NUM_THREADS=" + threads, *options)
    assert (tmp_path / "a.tks").read_bytes() == (tmp_path / "b.tks").read_bytes()


@pytest.mark.parametrize("dtype", [*SAMPLES, "f8"])
def test_types(tmp_path, dtype):
    heights = terrain(150, 170, "f4" if dtype == "f8" else dtype).astype(dtype)
    np.testing.assert_array_equal(samples(mosaic(heights, tmp_path / "a.tks")), heights)


def facts_of(dataset):
    band = dataset.GetRasterBand(1)
    return (
        dataset.GetGeoTransform(),
        dataset.GetProjection(),
        dataset.GetMetadata(),
        dataset.GetMetadataItem("VERTICAL_DATUM", "TKS"),
        dataset.GetMetadataItem("TARGET", "TKS"),
        band.DataType,
        band.GetNoDataValue(),
        (band.GetScale(), band.GetOffset(), band.GetUnitType(), band.GetDescription()),
        band.GetMetadata(),
    )


def test_facts_are_those_of_a_copy_in_memory(tmp_path):
    source = memory(
        terrain(200, 210, "i2"),
        **PLACE,
        nodata=-32768,
        unit="m",
        scale=0.5,
        offset=100,
        description="ridges",
        area_or_point="Point",
    )
    source.SetMetadataItem("ORIGIN", "a survey")
    for options in ((), ("MAX_Z_ERROR=3",), ("BYTES=9000",)):
        by_tiles = mosaic(source, tmp_path / "a.tks", *options)
        whole = copy(source, tmp_path / "b.tks", "BLOCKSIZE=32", *options)
        assert facts_of(by_tiles) == facts_of(whole)


def test_targets(tmp_path, ground):
    vrt, heights = ground
    source = gdal.Open(str(vrt))
    back = mosaic(source, tmp_path / "a.tks", "MAX_Z_ERROR=40")
    assert 10 < np.abs(back.ReadAsArray().astype(float) - heights).max() <= 40
    for budget in (3000, 20000):
        mosaic(source, tmp_path / "a.tks", f"BYTES={budget}")
        assert 0.99 * budget < (tmp_path / "a.tks").stat().st_size <= budget
    for psnr in (50, 60):
        back = mosaic(source, tmp_path / "a.tks", f"PSNR={psnr}").ReadAsArray()
        rmse = np.sqrt(np.mean((back.astype(float) - heights) ** 2))
        assert abs(20 * np.log10(np.ptp(heights.astype(float)) / rmse) - psnr) < 0.5


def hole(shape):
    hidden = np.zeros(shape, bool)
    hidden[40:150, 60:222] = hidden[7, :] = True
    return hidden


@pytest.mark.parametrize(
    "dtype, nodata", [("i2", -32768), ("u1", 255), ("f4", -9999), ("f8", -1e300)]
)
def test_voids(tmp_path, dtype, nodata):
    heights = terrain(200, 260, "f4" if dtype[0] == "f" else dtype).astype(dtype)
    heights[heights == nodata] = 3
    hidden = hole(heights.shape)
    source = memory(np.where(hidden, heights.dtype.type(nodata), heights), nodata=nodata)
    by_tiles, _ = warnings_of(lambda: mosaic(source, tmp_path / "a.tks"))
    whole, _ = warnings_of(lambda: copy(source, tmp_path / "b.tks"))
    np.testing.assert_array_equal(by_tiles.ReadAsArray(), whole.ReadAsArray())
    assert by_tiles.GetRasterBand(1).GetNoDataValue() == whole.GetRasterBand(1).GetNoDataValue()
    mask = by_tiles.GetRasterBand(1).GetMaskBand().ReadAsArray()
    np.testing.assert_array_equal(mask == 0, hidden)
    np.testing.assert_array_equal(by_tiles.ReadAsArray()[~hidden], heights[~hidden])


@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_masks_of_floats_become_nan(tmp_path, dtype):
    heights = terrain(200, 260).astype(dtype)
    hidden = hole(heights.shape)
    source = memory(heights)
    source.CreateMaskBand(gdal.GMF_PER_DATASET)
    source.GetRasterBand(1).GetMaskBand().WriteArray(np.where(hidden, 0, 255).astype("u1"))
    back = mosaic(source, tmp_path / "a.tks").ReadAsArray()
    np.testing.assert_array_equal(np.isnan(back), hidden)
    np.testing.assert_array_equal(back[~hidden], heights[~hidden])


def test_what_stands_for_voids_is_found(tmp_path):
    heights = terrain(200, 260)
    hidden = hole(heights.shape)
    holed = np.where(hidden, np.float32(-9999), heights)
    back, told = warnings_of(lambda: mosaic(holed, tmp_path / "a.tks", strict=False))
    assert back.GetRasterBand(1).GetNoDataValue() == -9999
    assert any("declared as nodata" in warning for warning in told)
    back, told = warnings_of(lambda: mosaic(holed, tmp_path / "a.tks", strict=True))
    assert back.GetRasterBand(1).GetNoDataValue() is None
    assert any("-a_nodata -9999" in warning for warning in told)
    np.testing.assert_array_equal(back.ReadAsArray(), holed)


def test_doubles_that_no_float_holds(tmp_path):
    heights = terrain(150, 170).astype("f8") + 1e-9
    source = memory(heights)
    refused(lambda: mosaic(source, tmp_path / "a.tks"), "Float64")
    assert not list(tmp_path.iterdir())
    written = lambda: mosaic(source, tmp_path / "a.tks", "MAX_Z_ERROR=1", strict=False)
    back, told = warnings_of(written)
    assert any("rounded to Float32" in warning for warning in told)
    assert np.abs(back.ReadAsArray() - heights).max() <= 1


@pytest.mark.parametrize("index", ["YES", "WINDOWS"])
def test_windows_read_their_pages_of_the_index(tmp_path, index):
    heights = terrain(1100, 1300, "i2")
    name = tmp_path / "a.tks"
    copy(memory(heights), name, "TILES=256", "BLOCKSIZE=16", "INDEX=" + index)
    with served(name) as url:
        dataset = gdal.Open(url)
        assert dataset.GetMetadataItem("INDEX", "TKS") == "PAGES"
        Server.ranges.clear()
        window = dataset.ReadAsArray(700, 500, 60, 50)
        np.testing.assert_array_equal(window, heights[500:550, 700:760])
        size = sum(last - first for first, last in Server.ranges)
        assert size < len(Server.data) / 3 and len(Server.ranges) < 64
    small = copy(memory(heights), tmp_path / "b.tks", *SMALL, "BYTES=50000", "INDEX=" + index)
    assert (tmp_path / "b.tks").stat().st_size <= 50000 and small is not None


@pytest.mark.parametrize("missing", [1, 20000])
def test_a_file_without_its_pages_is_read_from_its_beginning(tmp_path, missing):
    heights = terrain(1100, 1000, "i2")
    name = tmp_path / "a.tks"
    copy(memory(heights), name, "TILES=256", "BLOCKSIZE=16", "INDEX=WINDOWS")
    (tmp_path / "b.tks").write_bytes(name.read_bytes()[:-missing])
    dataset = gdal.Open(str(tmp_path / "b.tks"))
    np.testing.assert_array_equal(dataset.ReadAsArray(700, 500, 60, 50), heights[500:550, 700:760])


def test_what_is_not_coded_in_tiles(tmp_path, ground, texture):
    source = gdal.Open(str(ground[0]))
    wrong = {
        "TEXTURE=" + texture: "Textures",
        "DOMAIN=CYLINDER": "plane",
        "BLOCKSIZE=NONE": "BLOCKSIZE=NONE",
    }
    for option, word in wrong.items():
        refused(lambda o=option: copy(source, tmp_path / "a.tks", "TILES=64", o), "TILES", word)
    refused(lambda: mosaic(source, "/vsistdout/"), "renamed")
    globe = memory(terrain(90, 180), transform=(-180, 2, 0, 90, 0, -2), crs="EPSG:4326")
    refused(lambda: mosaic(globe, tmp_path / "a.tks"), "round the Earth", "DOMAIN=PLANE")
    masked = memory(terrain(90, 180, "u1"))
    masked.CreateMaskBand(gdal.GMF_PER_DATASET)
    refused(lambda: mosaic(masked, tmp_path / "a.tks"), "mask", "-a_nodata")
    for tiles in ("0", "100", "32768", "some", ""):
        refused(lambda t=tiles: copy(source, tmp_path / "a.tks", "TILES=" + t), "TILES=" + tiles)
    assert not list(tmp_path.iterdir())
    assert mosaic(globe, tmp_path / "a.tks", "DOMAIN=PLANE") is not None


def test_floats_without_a_common_step_come_back(tmp_path):
    rough = np.random.default_rng(1).normal(size=(90, 180)).astype("f4")
    rough[5, ::7] = -0.0
    back = mosaic(rough, tmp_path / "a.tks").ReadAsArray()
    assert (back.view("u4") == rough.view("u4")).all()


@pytest.mark.parametrize("least", [0, 0.1, 0.3, 0.6, 0.9, 0.98, 1])
def test_stopped_copies_leave_nothing(tmp_path, ground, monkeypatch, least):
    source, told = gdal.Open(str(ground[0])), []

    def progress(done, _message, _data):
        told.append(done)
        return int(done < least)

    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.setenv("CPL_TMPDIR", str(elsewhere))
    with pytest.raises(RuntimeError, match="Stopped by the user"):
        mosaic(source, tmp_path / "a.tks", progress=progress)
    assert told == sorted(told) and told[-1] >= least
    assert [path.name for path in tmp_path.iterdir()] == ["elsewhere"]
    assert not list(elsewhere.iterdir())


def test_a_source_that_fails_leaves_nothing(tmp_path, ground):
    for name in ("00.tif", "01.tif", "10.tif", "11.tif", "all.vrt"):
        (tmp_path / name).write_bytes((ground[0].parent / name).read_bytes())
    broken = tmp_path / "11.tif"
    broken.write_bytes(broken.read_bytes()[: broken.stat().st_size // 2])
    out = tmp_path / "out"
    out.mkdir()
    refused(lambda: mosaic(gdal.Open(str(tmp_path / "all.vrt")), out / "a.tks"), "cannot be read")
    assert not list(out.iterdir())


def test_where_files_cannot_be_written(tmp_path, ground, monkeypatch):
    source = gdal.Open(str(ground[0]))
    monkeypatch.setenv("CPL_TMPDIR", str(tmp_path / "none"))
    refused(lambda: mosaic(source, tmp_path / "a.tks"), "temporary")
    monkeypatch.delenv("CPL_TMPDIR")
    refused(lambda: mosaic(source, tmp_path / "none" / "a.tks"), "cannot be written")
    assert not list(tmp_path.iterdir())
    back = mosaic(source, "/vsimem/mosaic.tks")
    np.testing.assert_array_equal(back.ReadAsArray(), ground[1])
    del back
    gdal.Unlink("/vsimem/mosaic.tks")


def test_create_goes_by_tiles(tmp_path, ground):
    name = str(tmp_path / "a.tks")
    heights = ground[1]
    made = gdal.GetDriverByName("TKS").Create(
        name, heights.shape[1], heights.shape[0], 1, gdal.GDT_Int16, list(SMALL)
    )
    made.GetRasterBand(1).WriteArray(heights)
    del made
    np.testing.assert_array_equal(gdal.Open(name).ReadAsArray(), heights)
    assert [path.name for path in tmp_path.iterdir()] == ["a.tks"]


SPARSE = """
import resource, sys
side, limit, name, *options = sys.argv[1:]
from osgeo import gdal
gdal.UseExceptions()
gdal.SetCacheMax(32 << 20)
resource.setrlimit(resource.RLIMIT_AS, (int(limit) << 20,) * 2)
source = gdal.Open(name + ".tif")
gdal.GetDriverByName("TKS").CreateCopy(name + ".tks", source, 1, options)
"""


def sparse(name, side):
    """An empty raster with a hill, which takes no place on the disk."""
    options = ["SPARSE_OK=YES", "TILED=YES"]
    driver = gdal.GetDriverByName("GTiff")
    raster = driver.Create(str(name) + ".tif", side, side, 1, gdal.GDT_Int16, options)
    raster.GetRasterBand(1).WriteArray(terrain(300, 340, "i2"), side // 2, side // 3)


def copied_within(megabytes, name, side, *options):
    command = [sys.executable, "-c", SPARSE, str(side), str(megabytes), str(name), *options]
    return subprocess.run(command, capture_output=True, text=True, timeout=100)


def test_memory_is_that_of_a_tile(tmp_path):
    """8000 x 8000 samples take 128 MB as they are, and a GB to be coded in memory."""
    name, side, megabytes = tmp_path / "a", 8000, 600
    sparse(name, side)
    done = copied_within(megabytes, name, side, "TILES=1024")
    assert done.returncode == 0, done.stderr
    part = gdal.Open(f"{name}.tks").ReadAsArray(side // 2, side // 3, 340, 300)
    np.testing.assert_array_equal(part, terrain(300, 340, "i2"))
    assert copied_within(megabytes, name, side, "TILES=NONE").returncode != 0


def test_heights_that_memory_does_not_hold_go_by_tiles(tmp_path):
    """By themselves, where GDAL knows how much memory there is."""
    name, side, megabytes = tmp_path / "a", 3700, 800
    sparse(name, side)
    done = copied_within(megabytes, name, side)
    assert done.returncode == 0, done.stderr
    by_itself = (tmp_path / "a.tks").read_bytes()
    copy(gdal.Open(f"{name}.tif"), tmp_path / "a.tks", "TILES=1024")
    assert (tmp_path / "a.tks").read_bytes() == by_itself
    copy(gdal.Open(f"{name}.tif"), tmp_path / "a.tks", "TILES=NONE")
    assert (tmp_path / "a.tks").read_bytes() != by_itself
