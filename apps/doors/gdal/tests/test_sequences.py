# SPDX-License-Identifier: Apache-2.0
"""Sequences: a band for each frame, frames by their names, and what writes them: FRAMES=YES, and the
command line with textures."""

import subprocess

import numpy as np
import pytest
from conftest import REPOSITORY, SAMPLES, copy, gdal, memory, refused, samples, terrain, warnings_of
from test_open_options import Server, opened, served

TETRAKIS = REPOSITORY / "build/tetrakis"
PLACE = dict(transform=(400000, 10, 0, 3800000, 0, -10), crs="EPSG:32611")


def moving(frames=21, rows=70, columns=80, dtype="i2"):
    """A terrain with a hill that crosses it, and voids that come and go."""
    y, x = np.mgrid[0:rows, 0:columns]
    still = terrain(rows, columns, "i2") // 64
    cube = np.stack([still + 90 * np.exp(-((x - 4 * t) ** 2 + (y - 20) ** 2) / 60) for t in
                     range(frames)])  # fmt: skip
    cube = np.floor(cube)
    cube[3:9, 40:60, 50:70] = -9999
    return cube.astype(dtype)


def timed(cube, units="hours since 1900-01-01 00:00:0.0", numbers=None, **facts):
    """As the netCDF driver shows a variable with an axis of time."""
    source = memory(cube, **facts)
    if units:
        source.SetMetadataItem("time#units", units)
    for number, time in enumerate(range(len(cube)) if numbers is None else numbers, 1):
        band = source.GetRasterBand(number)
        band.SetMetadataItem("NETCDF_DIM_time", repr(time))
        if "nodata" in facts:
            band.SetNoDataValue(facts["nodata"])
    return source


@pytest.fixture(scope="module")
def cube():
    return moving()


@pytest.fixture(scope="module")
def sequence(tmp_path_factory, cube):
    name = tmp_path_factory.mktemp("sequence") / "a.tks"
    copy(timed(cube, nodata=-9999, **PLACE), name, "FRAMES=YES", "BLOCKSIZE=32")
    return name


@pytest.mark.parametrize("dtype", SAMPLES)
def test_bands_come_back_as_frames(tmp_path, dtype):
    cube = np.stack([terrain(40, 50, dtype, seed) for seed in range(5)])
    source = memory(cube)
    if dtype == "i1":
        for number in range(1, 6):
            band = source.GetRasterBand(number)
            band.SetMetadataItem("PIXELTYPE", "SIGNEDBYTE", "IMAGE_STRUCTURE")
    back = copy(source, tmp_path / "a.tks", "FRAMES=YES")
    np.testing.assert_array_equal(samples(back), cube)
    assert back.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSLESS"
    assert back.GetMetadataItem("FRAMES", "TKS") == "5"


def test_what_is_said_of_frames(sequence, cube):
    dataset = gdal.Open(str(sequence))
    assert dataset.RasterCount == 21 and dataset.GetFileList() == [str(sequence)]
    assert dataset.GetGeoTransform() == PLACE["transform"]
    assert dataset.GetSpatialRef().GetAuthorityCode(None) == "32611"
    assert dataset.GetMetadataItem("time#units") == "hours since 1900-01-01 00:00:0.0"
    assert dataset.GetMetadataItem("NETCDF_DIM_EXTRA") == "{time}"
    numbers = dataset.GetMetadataItem("NETCDF_DIM_time_VALUES")
    assert numbers == "{" + ",".join(map(str, range(21))) + "}"
    for number in (1, 17, 21):
        band = dataset.GetRasterBand(number)
        assert band.GetMetadataItem("NETCDF_DIM_time") == str(number - 1)
        assert band.GetMetadata()["TIME"] == f"1900-01-01T{number - 1:02}:00:00Z"
        assert band.GetDescription() == band.GetMetadataItem("TIME")
        assert band.GetNoDataValue() == -9999 and band.GetOverviewCount() == 0
        mask = band.GetMaskBand().ReadAsArray() != 0
        np.testing.assert_array_equal(mask, cube[number - 1] != -9999)
    with pytest.raises(RuntimeError, match="overviews"):
        dataset.BuildOverviews("nearest", [2])


def test_windows_blocks_and_all_bands_are_those_of_the_source(sequence, cube):
    whole = gdal.Open(str(sequence)).ReadAsArray()
    np.testing.assert_array_equal(whole, cube)
    dataset = gdal.Open(str(sequence))
    random = np.random.default_rng(4)
    for _ in range(30):
        x, y = random.integers(0, 75), random.integers(0, 65)
        width, height = random.integers(1, 81 - x), random.integers(1, 71 - y)
        number = int(random.integers(1, 22))
        part = dataset.GetRasterBand(number).ReadAsArray(*map(int, (x, y, width, height)))
        np.testing.assert_array_equal(part, cube[number - 1, y : y + height, x : x + width])
    series = dataset.ReadAsArray(33, 44, 1, 1)
    np.testing.assert_array_equal(series[:, 0, 0], cube[:, 44, 33])
    side, _ = dataset.GetRasterBand(5).GetBlockSize()
    block = np.frombuffer(dataset.GetRasterBand(5).ReadBlock(0, 0), "i2").reshape(side, side)
    np.testing.assert_array_equal(block[:70, :80], cube[4, :side, :side])


@pytest.mark.parametrize("options", [["BLOCKSIZE=64"], ["BLOCKSIZE=NONE"], ["MAX_Z_ERROR=9"]])
def test_overviews_are_those_of_each_frame(tmp_path, options):
    cube = moving(18, 300, 340)
    copy(timed(cube, nodata=-9999), tmp_path / "a.tks", "FRAMES=YES", *options)
    dataset = gdal.Open(str(tmp_path / "a.tks"))
    for number in (1, 5, 18):
        band, frame = dataset.GetRasterBand(number), cube[number - 1].astype(float)
        assert band.GetOverviewCount() == 1
        frame[frame == -9999] = np.nan
        with np.errstate(invalid="ignore"):
            means = np.nanmean(frame.reshape(150, 2, 170, 2), axis=(1, 3))
        overview = band.GetOverview(0).ReadAsArray()
        known = ~np.isnan(means) & (overview != -9999)
        assert (np.isnan(means) == (overview == -9999)).mean() > 0.99
        assert np.abs(overview - means)[known].mean() < 4
    kept = [dataset.GetRasterBand(number).GetOverview(0) for number in range(1, 19)]
    wanted = [overview.ReadAsArray() for overview in kept]
    for overview, before in zip(reversed(kept), reversed(wanted)):
        np.testing.assert_array_equal(overview.ReadAsArray(), before)


def test_a_frame_by_its_name_is_an_ordinary_dataset(sequence, cube):
    for number in (0, 7, 16, 20):
        for name in (f'TKS:"{sequence}":frame={number}', f"TKS:{sequence}:frame={number}:heights"):
            frame = gdal.Open(name)
            assert frame.RasterCount == 1 and frame.GetFileList() == [str(sequence)]
            np.testing.assert_array_equal(frame.ReadAsArray(), cube[number])
            assert frame.GetGeoTransform() == PLACE["transform"]
            assert frame.GetMetadataItem("BLOCKSIZE", "TKS") == "32"
    np.testing.assert_array_equal(gdal.Open(f"TKS:{sequence}:heights").ReadAsArray(), cube)
    refused(lambda: gdal.Open(f"TKS:{sequence}:frame=21"), "has no frame 21")
    refused(lambda: gdal.Open(f"TKS:{sequence}:frame=-1"), "frame=NUMBER")
    refused(lambda: gdal.Open(f"TKS:{sequence}:frame=3:texture"), "has no texture")
    refused(lambda: gdal.Open(str(sequence), gdal.GA_Update), "in place")


def test_a_stream_of_frames_has_a_band_for_each(sequence, cube, tmp_path):
    whole = sequence.read_bytes()
    first = whole[whole.index(b"TKS\x1a") :]  # of 16 frames
    (tmp_path / "a.tks").write_bytes(first)
    dataset = gdal.Open(str(tmp_path / "a.tks"))
    assert dataset.RasterCount == 16
    np.testing.assert_array_equal(dataset.ReadAsArray(), cube[:16])
    frame = gdal.Open(f"TKS:{tmp_path}/a.tks:frame=9")
    np.testing.assert_array_equal(frame.ReadAsArray(), cube[9])
    refused(lambda: gdal.Open(f"TKS:{tmp_path}/a.tks:frame=16"), "has no frame 16")


@pytest.fixture(scope="module")
def coloured(tmp_path_factory):
    """Heights and textures of frames, by the command line."""
    folder = tmp_path_factory.mktemp("coloured")
    cube = moving(6)
    texels = np.stack([terrain(70, 80, "u1", seed) for seed in range(18)]).reshape(6, 3, 70, 80)
    for number in range(6):
        for kind, layers in (("h", cube[number]), ("t", texels[number])):
            name = str(folder / f"{kind}{number}.tif")
            facts = dict(nodata=-9999) if kind == "h" else {}
            gdal.GetDriverByName("GTiff").CreateCopy(name, memory(layers, **facts))
    for name, inputs in (("both", ["h*.tif", "--texture", "t*.tif"]),
                         ("alone", ["--texture", "t*.tif"])):  # fmt: skip
        command = [TETRAKIS, "encode", *inputs, "--fps", "2.5", "--lossless", "--group", "4"]
        subprocess.run([*command, "-q", "-o", f"{name}.tks"], check=True, cwd=folder)
    return folder, cube, texels


def test_textures_are_subdatasets(coloured):
    folder, cube, texels = coloured
    both = gdal.Open(str(folder / "both.tks"))
    np.testing.assert_array_equal(both.ReadAsArray(), cube)
    times = [both.GetRasterBand(i).GetMetadataItem("NETCDF_DIM_time") for i in (1, 2, 6)]
    assert times == ["0", "400", "2000"]
    assert both.GetMetadataItem("time#units") == "milliseconds"
    assert both.GetRasterBand(2).GetMetadataItem("TIME") is None
    (heights, words), *textures = both.GetSubDatasets()
    assert heights == f'TKS:"{folder}/both.tks":heights' and words.startswith("[6x70x80]")
    assert len(textures) == 6
    for number, (name, _) in enumerate(textures):
        assert name == f'TKS:"{folder}/both.tks":frame={number}:texture'
        np.testing.assert_array_equal(gdal.Open(name).ReadAsArray(), texels[number])
    first = gdal.Open(f"TKS:{folder}/both.tks:texture")
    np.testing.assert_array_equal(first.ReadAsArray(), texels[0])
    alone = gdal.Open(str(folder / "alone.tks"))
    np.testing.assert_array_equal(alone.ReadAsArray(), texels[0])
    frame = gdal.Open(f"TKS:{folder}/alone.tks:frame=5")
    np.testing.assert_array_equal(frame.ReadAsArray(), texels[5])


def test_statistics_are_kept_beside(sequence, cube, tmp_path):
    name = tmp_path / "a.tks"
    name.write_bytes(sequence.read_bytes())
    for opened_as, number in ((str(name), 5), (f'TKS:"{name}":frame=7', 1)):
        dataset = gdal.Open(opened_as)
        dataset.GetRasterBand(number).ComputeStatistics(False)
        dataset = None
    for opened_as, number, frame in ((str(name), 5, 4), (f'TKS:"{name}":frame=7', 1, 7)):
        dataset = gdal.Open(opened_as)
        band = dataset.GetRasterBand(number)
        ground = cube[frame][cube[frame] != -9999]
        assert float(band.GetMetadataItem("STATISTICS_MEAN")) == pytest.approx(ground.mean())
    dataset = gdal.Open(str(name))
    assert dataset.GetRasterBand(5).GetDescription() == "1900-01-01T04:00:00Z"
    assert dataset.GetRasterBand(6).GetMetadataItem("STATISTICS_MEAN") is None
    assert dataset.GetMetadataItem("FRAMES", "TKS") == "21"
    dataset = None
    copy(timed(cube + 1, nodata=-9999), tmp_path / "b.tks", "FRAMES=YES", "MAX_Z_ERROR=1")
    name.write_bytes((tmp_path / "b.tks").read_bytes())
    dataset = gdal.Open(str(name))
    assert dataset.GetRasterBand(5).GetMetadataItem("STATISTICS_MEAN") is None


@pytest.fixture(scope="module")
def long(tmp_path_factory):
    name = tmp_path_factory.mktemp("long") / "a.tks"
    cube = np.random.default_rng(3).integers(0, 9000, (200, 30, 35), "i2")
    copy(timed(cube), name, "FRAMES=YES")
    return name, cube


def test_a_server_sends_the_group_of_a_frame(long):
    name, cube = long
    assert name.stat().st_size > 300_000
    with served(name) as url:
        dataset = opened(url)
        assert dataset.RasterCount == 200
        band = dataset.GetRasterBand(101)
        assert band.GetNoDataValue() is None and band.GetOverviewCount() == 0
        np.testing.assert_array_equal(band.ReadAsArray(), cube[100])
        assert band.GetDescription() == "1900-01-05T04:00:00Z"
        assert sum(last - first for first, last in Server.ranges) < len(Server.data) / 2
    with served(name) as url:
        frame = opened(url.replace("/vsicurl", "TKS:/vsicurl") + ":frame=60")
        np.testing.assert_array_equal(frame.ReadAsArray(), cube[60])
        size = len(Server.data)  # also of .aux.xml, which this server has at every address
        taken = [last - first for first, last in Server.ranges if last - first < size]
        assert sum(taken) < size / 2


def test_a_file_that_is_cut_shows_the_groups_that_are_there(long, tmp_path):
    name, cube = long
    whole = name.read_bytes()
    for length in (len(whole) // 3, len(whole) - 5, len(whole) - 900):
        cut = tmp_path / "cut.tks"
        cut.write_bytes(whole[:length])
        dataset, prefix = opened(cut), opened(name, f"BYTES={length}")
        count = dataset.RasterCount
        assert 200 * length / len(whole) - 17 < count <= 200 and prefix.RasterCount == count
        sound = (count - 1) // 16 * 16
        np.testing.assert_array_equal(dataset.ReadAsArray()[:sound], cube[:sound])
        np.testing.assert_array_equal(prefix.ReadAsArray(), dataset.ReadAsArray())
        assert dataset.GetMetadataItem("COMPLETE", "TKS") == "NO"
        refused(lambda cut=cut: opened(cut, "STRICT=YES"), "ends inside a group")
    cut.write_bytes(whole[:30])
    refused(lambda: opened(cut), "before its first frame")
    np.testing.assert_array_equal(opened(name, "STRICT=YES").ReadAsArray(), cube)


def test_bytes_that_mean_harm(sequence, tmp_path):
    whole = sequence.read_bytes()
    name = tmp_path / "a.tks"
    for at in range(0, len(whole), 211):
        bad = bytearray(whole)
        bad[at] ^= 0x24
        name.write_bytes(bad)
        try:
            dataset = gdal.Open(str(name))
            dataset.ReadAsArray()
            dataset.GetMetadata()
        except RuntimeError:
            pass
    name.write_bytes(b"TKG\x1a" + b"x" * 60)
    refused(lambda: gdal.Open(str(name)))


@pytest.mark.parametrize("units, numbers, first, second", [
    ("days since 2000-02-28", [1, 2, 9], "2000-02-29T00:00:00Z", "2000-03-01T00:00:00Z"),
    ("hours since 2019-03-01T00:00:00Z", [0.5, 0.75, 2], "2019-03-01T00:30:00Z",
     "2019-03-01T00:45:00Z"),
    ("seconds since 2019-03-01 00:00 +02:00", [0.04, 0.08, 5], "2019-02-28T22:00:00.04Z",
     "2019-02-28T22:00:00.08Z"),
    ("months since 2000-01-01", [1, 2, 3], None, None),
    ("hours since 1-1-1", [1, 2, 3], None, None),
])  # fmt: skip
def test_times_of_bands(tmp_path, units, numbers, first, second):
    cube = moving(3)
    back = copy(timed(cube, units, numbers), tmp_path / "a.tks", "FRAMES=YES")
    assert [back.GetRasterBand(i).GetMetadataItem("TIME") for i in (1, 2)] == [first, second]
    again = copy(back, tmp_path / "b.tks", "FRAMES=YES")
    for number in (1, 2, 3):
        kept, band = back.GetRasterBand(number), again.GetRasterBand(number)
        assert band.GetDescription() == kept.GetDescription()


def test_times_of_grib_and_none_at_all(tmp_path):
    source = memory(moving(3))
    for number in (1, 2, 3):
        item = f"  {1551398400 + 3600 * number} sec UTC"
        source.GetRasterBand(number).SetMetadataItem("GRIB_VALID_TIME", item)
    back = copy(source, tmp_path / "a.tks", "FRAMES=YES")
    assert back.GetRasterBand(2).GetDescription() == "2019-03-01T02:00:00Z"
    back = copy(memory(moving(3)), tmp_path / "b.tks", "FRAMES=YES")
    assert back.GetRasterBand(2).GetDescription() == "time 1"
    assert back.GetMetadataItem("time#units") is None
    same = timed(moving(3), numbers=[5, 5, 5])
    back, heard = warnings_of(lambda: copy(same, tmp_path / "c.tks", "FRAMES=YES"))
    assert back.RasterCount == 3 and any("do not rise" in warning for warning in heard)


def test_through_netcdf_and_back(sequence, cube, tmp_path):
    if gdal.GetDriverByName("netCDF") is None:
        pytest.skip("no netCDF driver")
    name = str(tmp_path / "a.nc")
    gdal.Translate(name, str(sequence), format="netCDF")
    again = copy(gdal.Open(name), tmp_path / "b.tks", "FRAMES=YES")
    np.testing.assert_array_equal(again.ReadAsArray(), cube)
    before = gdal.Open(str(sequence))
    for number in (1, 12, 21):
        kept, band = before.GetRasterBand(number), again.GetRasterBand(number)
        assert band.GetMetadataItem("TIME") == kept.GetMetadataItem("TIME")
    assert again.GetSpatialRef().GetAuthorityCode(None) == "32611"


def test_targets(tmp_path):
    cube = moving(8).astype("f8") + 1e-12
    name = tmp_path / "a.tks"
    source = memory(cube)
    near, heard = warnings_of(
        lambda: copy(source, name, "FRAMES=YES", "MAX_Z_ERROR=3", strict=False)
    )
    assert np.abs(near.ReadAsArray() - cube).max() <= 3
    assert sum("rounded" in warning for warning in heard) == 1
    assert float(near.GetMetadataItem("TARGET", "TKS").partition("=")[2]) == pytest.approx(3, 0.02)
    copy(memory(moving(8)), name, "FRAMES=YES", "BYTES=6000")
    assert 3000 < name.stat().st_size <= 6000
    refused(lambda: copy(source, name, "FRAMES=YES", "MAX_Z_ERROR=3"), "Float64")


def test_what_cannot_be_frames_is_refused_and_leaves_no_file(tmp_path, texture):
    name = tmp_path / "a.tks"
    for option, words in ((f"TEXTURE={texture}", "TEXTURE does not go"), ("TILES=64", "TILES does"),
                          ("DOMAIN=CUBE", "DOMAIN=CUBE"), ("BYTES=9", "bytes")):  # fmt: skip
        refused(lambda o=option: copy(memory(moving(3)), name, "FRAMES=YES", o), words)
    unlike = memory(moving(3))
    unlike.GetRasterBand(2).SetScale(2)
    refused(lambda: copy(unlike, name, "FRAMES=YES"), "Band 2 has another type, scale or offset")
    unlike = memory(moving(3))
    unlike.GetRasterBand(3).SetNoDataValue(-9999)
    refused(lambda: copy(unlike, name, "FRAMES=YES"), "Band 3 has another nodata value")
    stop = lambda done, *_: done < 0.5  # noqa: E731
    refused(lambda: copy(memory(moving(30)), name, "FRAMES=YES", progress=stop), "Stopped")
    assert not list(tmp_path.iterdir())
    refused(lambda: copy(memory(moving(3)), name), "Heights have one band")
