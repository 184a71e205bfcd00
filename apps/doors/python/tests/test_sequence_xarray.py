# SPDX-License-Identifier: Apache-2.0
"""Arrays of xarray with a time axis become sequences, and sequences such arrays."""

import numpy as np
import pytest
from conftest import moving, photograph

import tetrakis

xarray = pytest.importorskip("xarray")

PLACE = (4e5, 10.0, 0.0, 3.8e6, 0.0, -10.0)
CUBE = np.where(moving() == -9999, np.nan, moving()).astype("f4")
DATES = np.datetime64("2019-02-27T22:30", "ns") + np.timedelta64(90, "m") * np.arange(21)


def data_array(samples, dims, times=DATES, **attributes):
    y = PLACE[3] + PLACE[5] * (np.arange(CUBE.shape[1]) + 0.5)
    x = PLACE[0] + PLACE[1] * (np.arange(CUBE.shape[2]) + 0.5)
    coordinates = dict(time=times, y=y, x=x)
    return xarray.DataArray(samples, coordinates, dims, "ground", attributes)


@pytest.fixture
def array():
    return data_array(CUBE, ("time", "y", "x"), units="m")


@pytest.fixture
def file(array, tmp_path):
    path = tmp_path / "a.tks"
    tetrakis.from_xarray(array, path=path, crs="EPSG:32611", group=8)
    return path


def test_arrays_with_time_become_sequences(array):
    opened = tetrakis.open_sequence(tetrakis.from_xarray(array, max_error=2))
    np.testing.assert_array_equal(opened.times, DATES)
    assert np.nanmax(np.abs(np.asarray(opened) - CUBE)) <= 2
    assert (opened.info.geotransform, opened.info.unit) == (PLACE, "m")
    assert opened.info.description == "ground"
    one = tetrakis.from_xarray(array[:1])
    np.testing.assert_array_equal(tetrakis.open(one).heights(), CUBE[0])


def test_textures_with_time(array):
    array = array[:3]
    texels = np.stack([np.roll(photograph(30, 35), t, 0) for t in range(3)])
    placed = data_array(texels, ("time", "y", "x", "channel"), DATES[:3])
    for heights in (None, array):
        for axes in (("time", "y", "x", "channel"), ("time", "channel", "y", "x")):
            opened = tetrakis.open_sequence(tetrakis.from_xarray(heights, placed.transpose(*axes)))
            np.testing.assert_array_equal(opened.read("texture", ...), texels)
            np.testing.assert_array_equal(opened.times, DATES[:3])
            assert opened.info.texture_geotransform in (None, PLACE)
    grey = tetrakis.open_sequence(tetrakis.from_xarray(array, placed[..., 1]))
    np.testing.assert_array_equal(grey.frame(2).texture(), texels[2, ..., 1])


def test_sequences_open_as_datasets(file):
    with xarray.open_dataset(file) as dataset:
        assert dict(dataset.sizes) == dict(time=21, y=30, x=35)
        np.testing.assert_array_equal(dataset.time, DATES)
        np.testing.assert_array_equal(dataset.heights, CUBE)
        day = dataset.heights.sel(time="2019-02-28")
        assert day.shape[0] == 16
        np.testing.assert_array_equal(day, CUBE[1:17])
        picked = dataset.heights.isel(time=[9, 2, 20], y=slice(3, 9), x=[4, 1])
        np.testing.assert_array_equal(picked, CUBE[[9, 2, 20], 3:9][..., [4, 1]])
        np.testing.assert_array_equal(dataset.heights[:, 4, 5], CUBE[:, 4, 5])
        assert dataset.x[0] == PLACE[0] + 5 and dataset.heights.units == "m"
        again = tetrakis.open_sequence(tetrakis.from_xarray(dataset.heights, group=8))
        np.testing.assert_array_equal(again, CUBE)
        np.testing.assert_array_equal(again.times, DATES)
        assert again.info.crs == "EPSG:32611" and again.info.geotransform == PLACE
    with xarray.open_dataset(file, level=1, decode_times=False) as coarse:
        assert coarse.heights.shape == (21, 15, 18) and coarse.time[1] == 90
        assert coarse.time.units == "minutes since 2019-02-27 22:30:00"


def test_chunks_of_dask(file):
    pytest.importorskip("dask")
    with xarray.open_dataset(file, chunks=dict(time=8)) as dataset:
        np.testing.assert_allclose(dataset.heights.mean("time"), np.nanmean(CUBE, 0), rtol=1e-5)


@pytest.mark.parametrize("clock, numbers, units", [
    (None, [0, 1, 2], None),
    (0.1, [0, 100, 200], "milliseconds"),
    (1 / 30, [0, 1 / 30, 2 / 30], "seconds"),
    ("days since 2000-02-28", [0, 1, 2], "days since 2000-02-28"),
    (tetrakis.Clock(7200, "2000-02-28T12:00:00Z", "noleap"), [0, 2, 4],
     "hours since 2000-02-28 12:00:00"),
])  # fmt: skip
def test_times_of_all_clocks(tmp_path, clock, numbers, units):
    path = tmp_path / "a.tks"
    tetrakis.encode_sequence(CUBE[:3], path=path, clock=clock)
    with xarray.open_dataset(path, decode_times=False) as dataset:
        np.testing.assert_allclose(dataset.time, numbers)
        assert dataset.time.attrs.get("units") == units
        again = tetrakis.open_sequence(tetrakis.from_xarray(dataset.heights))
    if units is None or " since " in units:
        given = tetrakis.open_sequence(path)
        np.testing.assert_array_equal(
            again.ticks * float(again.clock.tick or 1), given.ticks * float(given.clock.tick or 1)
        )
        assert again.clock.dates(again.ticks) is None or again.times[2] == given.times[2]


def test_streams_of_one_frame_have_no_time(tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(tetrakis.encode(CUBE[0]))
    with xarray.open_dataset(path) as dataset:
        assert dataset.heights.dims == ("y", "x")
        np.testing.assert_array_equal(dataset.heights, CUBE[0])
