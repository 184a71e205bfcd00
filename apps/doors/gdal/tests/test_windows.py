# SPDX-License-Identifier: Apache-2.0
"""Windows, pans, points, rows: how much of a raster is decoded for them, and read over HTTP."""

import re
import time

import numpy as np
import pytest
from conftest import RGB, copy, gdal, memory, terrain
from test_open_options import Server, opened, served

SIDE = 1536
LAYOUTS = [[], ["INDEX=NO"], ["INDEX=YES"], ["BLOCKSIZE=128"], ["BLOCKSIZE=512"], ["MAX_Z_ERROR=5"]]


@pytest.fixture(scope="module")
def heights():
    return terrain(SIDE, SIDE, "u1").astype("i4")


@pytest.fixture(scope="module", params=LAYOUTS, ids=lambda options: "-".join(options) or "default")
def stream(request, heights, tmp_path_factory):
    name = tmp_path_factory.mktemp("windows") / "a.tks"
    copy(heights, name, *request.param)
    return name


class Decoded:
    """How often each sample was decoded, as the driver tells it in debug messages."""

    def __init__(self, rows=SIDE, columns=SIDE):
        self.times = np.zeros((rows, columns), int)
        self.calls = 0

    def take(self, _level, _number, message):
        found = re.search(r"decoding (\d+) x (\d+) from (\d+), (\d+)", message)
        if found:
            width, height, x, y = map(int, found.groups())
            self.times[y : y + height, x : x + width] += 1
            self.calls += 1

    def __enter__(self):
        gdal.SetConfigOption("CPL_DEBUG", "TKS")
        gdal.PushErrorHandler(self.take)
        return self

    def __exit__(self, *_):
        gdal.PopErrorHandler()
        gdal.SetConfigOption("CPL_DEBUG", None)

    def share(self):
        return (self.times > 0).mean()


def check(dataset, heights, x, y, width, height):
    part = dataset.ReadAsArray(int(x), int(y), width, height)
    assert np.abs(part - heights[y : y + height, x : x + width]).max() <= 5


def test_points_decode_what_is_around_them(stream, heights):
    """However many there are: some hundreds of samples a point, and none of them twice."""
    random = np.random.default_rng(1)
    dataset = opened(stream)
    with Decoded() as decoded:
        for _ in range(3):
            x, y = random.integers(0, SIDE // 2, 2)
            check(dataset, heights, x, y, 1, 1)
        assert decoded.calls <= 3 and decoded.share() < 0.5
        for _ in range(60):  # all in the same quarter
            x, y = random.integers(0, SIDE // 2, 2)
            check(dataset, heights, x, y, 1, 1)
    assert decoded.times[: SIDE // 2, : SIDE // 2].mean() < 1.5
    # Regions of 512 show some of what lies beyond.
    assert decoded.times[SIDE - 384 :].max() == 0 and decoded.times[:, SIDE - 384 :].max() == 0


@pytest.mark.parametrize("step", [(64, 0), (0, 64), (64, 64), (48, -16)])
def test_a_pan_pays_for_new_ground(stream, heights, step):
    """Windows of 256 that move on: each sample is decoded about once."""
    dataset = opened(stream)
    start = (100, 100 if step[1] >= 0 else 500)
    with Decoded() as decoded:
        places = [(start[0] + step[0] * i, start[1] + step[1] * i) for i in range(16)]
        for x, y in places:
            check(dataset, heights, x, y, 256, 256)
    assert decoded.times.sum() <= 1.5 * (decoded.times > 0).sum(), decoded.times.max()
    reached = np.zeros((SIDE, SIDE), bool)
    for x, y in places:
        reached[max(y - 512, 0) : y + 768, max(x - 512, 0) : x + 768] = True
    assert not decoded.times[~reached].any()
    with Decoded() as again:
        for x, y in places:
            check(dataset, heights, x, y, 256, 256)
    assert again.calls == 0


def test_windows_again_cost_nothing(stream, heights):
    dataset = opened(stream)
    check(dataset, heights, 700, 600, 300, 200)
    with Decoded() as decoded:
        check(dataset, heights, 700, 600, 300, 200)
        check(dataset, heights, 720, 650, 200, 100)
    assert decoded.calls == 0


@pytest.mark.parametrize("side", [64, 100, SIDE])
@pytest.mark.parametrize("rows", [1, 64])
def test_rows_one_after_the_other(stream, heights, side, rows):
    """Each sample is decoded about once, in ever larger strips."""
    dataset = opened(stream)
    with Decoded() as decoded:
        for y in range(0, SIDE, rows if side == SIDE else side):
            for x in range(0, SIDE, side):
                width = min(side, SIDE - x)
                check(dataset, heights, x, y, width, min(rows if side == SIDE else side, SIDE - y))
    assert decoded.share() == 1
    assert decoded.times.mean() < 1.1 and decoded.calls <= 30, decoded.calls


def test_bands_are_decoded_together(tmp_path):
    """A window of all bands takes one call, and so do these bands one by one."""
    layers = np.stack([terrain(600, 700, "u1", seed) for seed in range(3)])
    copy(memory(layers, colours=RGB), tmp_path / "a.tks", "BLOCKSIZE=128")
    dataset = opened(tmp_path / "a.tks")
    with Decoded(600, 700) as decoded:
        part = dataset.ReadAsArray(200, 150, 300, 250)
        np.testing.assert_array_equal(part, layers[:, 150:400, 200:500])
        for band in (1, 2, 3):
            part = dataset.GetRasterBand(band).ReadAsArray(210, 160, 200, 200)
            np.testing.assert_array_equal(part, layers[band - 1, 160:360, 210:410])
    assert decoded.calls == 1


def test_progress_of_large_reads(tmp_path):
    """A raster that is read at once tells how far it is."""
    copy(np.zeros((9000, 40), "i2") + np.arange(40, dtype="i2"), tmp_path / "a.tks", "BLOCKSIZE=32")
    seen = []
    dataset = opened(tmp_path / "a.tks")
    dataset.ReadAsArray(callback=lambda done, *_: seen.append(done) or 1)
    assert seen == sorted(seen) and seen[-1] == 1
    assert len([done for done in seen if 0.05 < done < 0.95]) > 5


@pytest.mark.parametrize("options", [[], ["INDEX=YES", "BLOCKSIZE=128"]], ids=["WINDOWS", "YES"])
def test_no_byte_comes_twice_over_http(tmp_path, heights, options):
    """Points and windows of a part read a part, all windows together no more than the file."""
    copy(heights, tmp_path / "a.tks", *options)
    random = np.random.default_rng(1)
    with served(tmp_path / "a.tks") as url:
        dataset = opened(url)
        for number in range(40):
            side = (1, 100, 256)[number % 3]
            x, y = random.integers(0, SIDE // 2 - side + 1, 2)
            check(dataset, heights, x, y, side, side)
        part = sum(last - first for first, last in Server.ranges)
        assert part < 0.75 * len(Server.data), (part, len(Server.data))
        for _ in range(60):
            x, y = random.integers(0, SIDE - 255, 2)
            check(dataset, heights, x, y, 256, 256)
        taken = sum(last - first for first, last in Server.ranges)
        assert taken <= len(Server.data) + 16384, (taken, len(Server.data))


def test_a_point_of_a_large_raster_takes_no_time(tmp_path):
    """Of all that there is to decode it takes a hundredth, here at most a tenth."""
    name = tmp_path / "a.tks"
    copy(terrain(SIDE, 2 * SIDE, "i2"), name)

    def seconds(*window):
        start = time.process_time()
        opened(name).ReadAsArray(*window)
        return time.process_time() - start

    points = sorted(seconds(2000 + 50 * i, 700, 1, 1) for i in range(5))
    assert points[2] < 0.25 * seconds()


def test_windows_of_overviews_of_a_large_raster(tmp_path):
    """An overview is made of the level before it: a large one is decoded where it is read."""
    heights = terrain(3000, 3000, "u1")
    name = str(tmp_path / "a.tks")
    copy(heights.astype("i4"), name, "BLOCKSIZE=256", "INDEX=WINDOWS")
    dataset = gdal.Open(name)
    overview = dataset.GetRasterBand(1).GetOverview(1)
    with Decoded(3000, 3000) as decoded:
        part = overview.ReadAsArray(300, 200, 64, 64)
    assert 0 < decoded.share() < 0.1
    whole = overview.ReadAsArray()
    np.testing.assert_array_equal(part, whole[200:264, 300:364])
    means = heights.astype(float).reshape(750, 4, 750, 4).mean((1, 3))
    assert np.sqrt(((whole - means) ** 2).mean()) < 1
