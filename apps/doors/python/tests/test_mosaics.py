# SPDX-License-Identifier: Apache-2.0
"""Mosaics: streams of windows of a source, whoever runs the tasks, and what a restart does."""

import pickle
import sys

import numpy as np
import pytest
from conftest import terrain
from test_rasters import PLACE, raster

import tetrakis
from tetrakis import mosaic

SMALL = dict(regions=32, tile=64)  # many tiles of little terrain, in three groups


class Windows:
    """A source that is read by windows alone, and notes them."""

    def __init__(self, heights, fails=lambda rows, columns: False):
        self.shape, self.dtype, self.read = heights.shape, heights.dtype, []
        self._heights, self._fails = heights, fails

    def __getitem__(self, window):
        if self._fails(*window):
            raise LookupError("the storage is away")
        self.read.append(window)
        return self._heights[window]


@pytest.fixture(scope="module")
def ground():
    return np.maximum(terrain(330, 410, "i2"), -32767)  # the lowest value is for voids


def streamed(folder, source, name="a.tks", **options):
    """The bytes of a mosaic, lossless unless the options say another target."""
    mosaic.encode(source, folder / name, **{**SMALL, **options})
    return (folder / name).read_bytes()


def by_a_loop(folder, source, **options):
    """One task after the other, in the order of the C interface."""
    plan = mosaic.plan(source, workdir=folder / "loop", **{**SMALL, **options})
    for tile in plan.tiles:
        plan.code(tile)
    plan.merge(folder / "loop.tks")
    return (folder / "loop.tks").read_bytes()


@pytest.mark.parametrize("target", [{}, dict(bytes=20000), dict(psnr=40), dict(max_error=20)])
@pytest.mark.parametrize("workers", [1, 2, 7])
def test_bytes_are_those_of_a_loop(tmp_path, ground, target, workers):
    expected = by_a_loop(tmp_path, ground, **target)
    assert streamed(tmp_path, ground, workers=workers, **target) == expected
    if "bytes" in target:
        assert len(expected) <= target["bytes"]
    if "max_error" in target:
        off = tetrakis.open(expected).heights().astype(int) - ground
        assert np.abs(off).max() <= target["max_error"]


@pytest.mark.parametrize("dtype", ["u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8", ">i2"])
def test_samples_come_back(tmp_path, dtype):
    heights = terrain(150, 170, "f4" if dtype == "f8" else dtype).astype(dtype)
    stream = tetrakis.open(streamed(tmp_path, heights))
    assert stream.info.lossless and stream.info.regions == 32
    stream.verify()
    np.testing.assert_array_equal(stream.heights(), heights)


def test_sources_of_all_kinds_are_one(tmp_path, ground):
    np.save(tmp_path / "a.npy", ground)
    mapped = np.load(tmp_path / "a.npy", mmap_mode="r")
    masked = np.ma.MaskedArray(ground)
    sources = [ground[np.newaxis], np.asfortranarray(ground), mapped, masked, Windows(ground)]
    expected = streamed(tmp_path, ground)
    for source in sources:
        assert streamed(tmp_path, source) == expected, type(source)


def test_arrays_of_other_libraries(tmp_path, ground):
    zarr, xarray = pytest.importorskip("zarr"), pytest.importorskip("xarray")
    expected = streamed(tmp_path, ground)
    assert streamed(tmp_path, zarr.array(ground, chunks=(100, 100))) == expected
    array = xarray.DataArray(ground, dims=("y", "x"), attrs=dict(units="m"), name="ground")
    info = tetrakis.open(streamed(tmp_path, array)).info
    assert (info.unit, info.description) == ("m", "ground")
    dask = pytest.importorskip("dask.array")
    assert streamed(tmp_path, dask.from_array(ground, chunks=(90, 128))) == expected


def test_voids_come_back(tmp_path, ground):
    hidden = np.zeros(ground.shape, bool)
    hidden[40:200, 90:300] = hidden[250, :] = True
    floats = (ground / np.float32(4)).astype("f4")
    for heights in (np.where(hidden, np.nan, floats), np.ma.MaskedArray(floats, hidden)):
        back = tetrakis.open(streamed(tmp_path, heights)).heights(masked=True)
        np.testing.assert_array_equal(np.isnan(back.filled(np.nan)), hidden)
        np.testing.assert_array_equal(back.data[~hidden], floats[~hidden])
    whole = np.where(hidden, ground.dtype.type(-32768), ground)
    for heights in (whole, np.ma.MaskedArray(ground, hidden)):
        stream = tetrakis.open(streamed(tmp_path, heights, nodata=-32768))
        assert stream.info.nodata == -32768
        np.testing.assert_array_equal(stream.heights(), whole)
    with pytest.raises(tetrakis.TksUsageError, match="masked"):
        streamed(tmp_path, np.ma.MaskedArray(ground, hidden))
    lowest = np.finfo("f8").min  # beyond the floats of 32 bits, and a common nodata value
    wide = np.where(hidden, lowest, floats.astype("f8"))
    back = tetrakis.open(streamed(tmp_path, wide, nodata=lowest)).heights()
    np.testing.assert_array_equal(np.isnan(back), hidden)


@pytest.mark.parametrize("package", ["osgeo", "rasterio"])
def test_rasters_keep_their_place(tmp_path, ground, package, monkeypatch):
    pytest.importorskip(package)
    if package == "rasterio":
        monkeypatch.setitem(sys.modules, "osgeo", None)
    path = raster(tmp_path / "a.tif", ground, nodata=int(ground[0, 0]))
    stream = tetrakis.open(streamed(tmp_path, path, description="ground"))
    info = stream.info
    assert (info.crs, info.geotransform, info.spacing) == ("EPSG:32611", PLACE, (10, 10))
    assert (info.description, info.nodata) == ("ground", ground[0, 0])
    np.testing.assert_array_equal(stream.heights(), ground)
    with pytest.raises(tetrakis.TksUsageError, match="bands 1 to 1"):
        streamed(tmp_path, path, band=2)
    with pytest.raises(tetrakis.TksIOError, match="none.tif"):
        streamed(tmp_path, tmp_path / "none.tif")
    path.write_bytes(path.read_bytes()[: len(path.read_bytes()) // 2])
    with pytest.raises(tetrakis.TksIOError, match="cannot be (read|opened)"):
        streamed(tmp_path, path)


def test_osgeo_and_rasterio_say_the_same(tmp_path, ground, monkeypatch):
    rasterio = pytest.importorskip("rasterio")
    pytest.importorskip("osgeo")
    crs = "+proj=laea +lat_0=50 +units=us-ft"
    path = raster(tmp_path / "a.tif", ground, nodata=-32768, crs=crs)
    with rasterio.open(path, "r+") as dataset:
        dataset.units, dataset.scales, dataset.offsets = ("m",), (0.5,), (-3.0,)
        dataset.set_band_description(1, "ground")
        dataset.update_tags(AREA_OR_POINT="Point")
    by_osgeo = streamed(tmp_path, path)
    monkeypatch.setitem(sys.modules, "osgeo", None)
    assert streamed(tmp_path, path) == by_osgeo


def test_masks_of_rasters(tmp_path, ground):
    rasterio = pytest.importorskip("rasterio")
    hidden = np.zeros(ground.shape, bool)
    hidden[5:90, 30:] = True
    path = raster(tmp_path / "a.tif", ground)
    with rasterio.open(path, "r+") as dataset:
        dataset.write_mask(~hidden)
    back = tetrakis.open(streamed(tmp_path, path, nodata=-32768)).heights(masked=True)
    np.testing.assert_array_equal(back.mask, hidden)


def test_memory_is_that_of_windows(tmp_path, ground):
    source = Windows(ground)
    streamed(tmp_path, source, workers=2)
    halo = 128
    for rows, columns in source.read:
        assert rows.stop - rows.start <= max(64 + 2 * halo, ground.shape[0])
    assert len(source.read) >= len(mosaic.plan(ground, workdir=tmp_path / "w", **SMALL).groups[0])


def test_a_window_that_fails(tmp_path, ground):
    """What the source raises comes out, no file is left, and a further run does the rest."""
    expected = streamed(tmp_path, ground, "expected.tks")
    work = tmp_path / "work"
    mosaic.plan(ground, workdir=work, **SMALL)
    broken = Windows(ground, lambda rows, columns: rows.start > 60 and columns.start > 120)
    with pytest.raises(LookupError, match="away"):
        streamed(tmp_path, broken, workdir=work)
    assert not (tmp_path / "a.tks").exists() and not list(tmp_path.glob("*.tmp"))
    assert list(work.glob("g0*.part"))
    assert streamed(tmp_path, ground, workdir=work) == expected
    with pytest.raises(LookupError, match="away"):  # in the plan, and without a folder that stays
        streamed(tmp_path, Windows(ground, lambda *window: True), "b.tks")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.tks", "expected.tks", "work"]


def test_a_restart_does_what_is_missing(tmp_path, ground):
    work = tmp_path / "work"
    expected = streamed(tmp_path, ground, workdir=work)
    plan = mosaic.plan(ground, workdir=work, **SMALL)
    lost, cut, base = plan.groups[0][3], plan.groups[0][7], plan.tiles[-1]
    (work / f"{plan.name_of(lost)}.part").unlink()
    (work / f"{plan.name_of(base)}.part").unlink()
    damaged = work / f"{plan.name_of(cut)}.part"
    damaged.write_bytes(damaged.read_bytes()[:-1])
    missing = [tile for tile in plan.tiles if not plan.is_done(tile)]
    assert missing == [lost, cut, base]
    source, kept = Windows(ground), (work / f"{plan.name_of(plan.tiles[0])}.part").stat()
    assert streamed(tmp_path, source, workdir=work) == expected
    assert len(source.read) == 2
    assert (work / f"{plan.name_of(plan.tiles[0])}.part").stat() == kept
    assert not list(work.glob("*.tmp"))


def test_a_folder_of_another_mosaic_is_refused(tmp_path, ground):
    work = tmp_path / "work"
    streamed(tmp_path, ground, workdir=work)
    for other in (dict(bytes=9000), dict(unit="m"), dict(tile=128)):
        with pytest.raises(tetrakis.TksUsageError, match="another source, or with other options"):
            streamed(tmp_path, ground, workdir=work, **other)
    with pytest.raises(tetrakis.TksUsageError, match="another source"):
        streamed(tmp_path, ground[1:], workdir=work)


def test_missing_parts_are_named(tmp_path, ground):
    plan = mosaic.plan(ground, workdir=tmp_path, **SMALL)
    with pytest.raises(tetrakis.TksIOError):
        plan.code(plan.groups[1][0])
    with pytest.raises(tetrakis.TksIOError, match=r"g0-x0-y0\.part"):
        plan.merge(tmp_path / "a.tks")
    assert not (tmp_path / "a.tks").exists()
    with pytest.raises(tetrakis.TksUsageError):
        plan.code(mosaic.Tile(0, 99, 0))


def test_windows_have_an_index(tmp_path, ground):
    stream = tetrakis.open(streamed(tmp_path, ground, layout="windows"))
    assert stream.info.index == "windows"
    window = np.s_[9:70, 200:333]
    np.testing.assert_array_equal(stream.heights(window=window), ground[window])
    small = streamed(tmp_path, ground, "small.tks", bytes=9000, layout="windows")
    assert len(small) <= 9000 and tetrakis.open(small).info.index == "windows"
    plain = tetrakis.open(streamed(tmp_path, ground, "plain.tks", layout="progressive"))
    assert plain.info.index is False


def test_windows_take_their_pages_of_the_index(tmp_path):
    large = terrain(1500, 1400, "i2")
    data = streamed(tmp_path, large, regions=16, tile=256)
    whole = tetrakis.open(tmp_path / "a.tks")
    assert whole.info.index == "pages"
    window = np.s_[700:790, 300:411]
    np.testing.assert_array_equal(whole.heights(window=window), large[window])
    for end in (whole.info.stream_bytes, len(data) - 1):  # the index is cut off
        (tmp_path / "cut.tks").write_bytes(data[:end])
        cut = tetrakis.open(tmp_path / "cut.tks")
        np.testing.assert_array_equal(cut.heights(window=window), large[window])


def test_progress_and_what_it_raises(tmp_path, ground):
    told = []
    streamed(tmp_path, ground, progress=told.append)
    assert told == sorted(told) and told[-1] == 1 and len(told) > 20

    def stop(done):
        if done > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        streamed(tmp_path, ground, "b.tks", progress=stop)
    assert [path.name for path in tmp_path.iterdir()] == ["a.tks"]


def test_plans_travel(tmp_path, ground):
    """As they do to other processes. Mapped files go by their names."""
    np.save(tmp_path / "a.npy", terrain(1000, 1000, "i2"))
    mapped = np.load(tmp_path / "a.npy", mmap_mode="r")
    plan = mosaic.plan(mapped, workdir=tmp_path / "w", regions=128, tile=256)
    packed = pickle.dumps(plan)
    assert len(packed) < 4000
    other = pickle.loads(packed)
    other.code(plan.tiles[0])
    assert plan.is_done(plan.tiles[0]) and not plan.is_done(plan.tiles[1])


def test_what_makes_no_sense(tmp_path, ground):
    wrong = [
        dict(lossless=True, bytes=100),
        dict(regions=33),
        dict(regions=64, tile=32),
        dict(workers=-1),
        dict(workers=2, client=object()),
        dict(client=object()),
        dict(layout="windowed"),
        dict(layout="windows", preview=100),
        dict(nodata="auto"),
    ]
    for options in wrong:
        with pytest.raises(tetrakis.TksUsageError):
            streamed(tmp_path, ground, **options)
    with pytest.raises(TypeError, match="latitudes"):
        streamed(tmp_path, ground, latitudes=(1, 2))
    for source in (5, [[1, 2]], np.zeros((2, 3, 4)), np.zeros(4), np.zeros((4, 4), bool)):
        with pytest.raises(tetrakis.TksUsageError):
            streamed(tmp_path, source)
    third = np.full((20, 20), 1 / 3)
    with pytest.raises(tetrakis.TksUsageError, match="float64"):
        streamed(tmp_path, third)
    assert not list(tmp_path.iterdir())
