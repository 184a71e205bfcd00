# SPDX-License-Identifier: Apache-2.0
"""A stream is an array of its heights; lists and arrays of other numbers become streams."""

import base64
import itertools
import re
import zlib

import numpy as np
import pytest
from conftest import photograph, terrain

import tetrakis

SLICES = [
    slice(None),
    slice(3, 9),
    slice(None, None, 4),
    slice(40, 2, -3),
    slice(-5, None),
    slice(7, 7),
    slice(100, 200),
    0,
    -1,
    17,
]


@pytest.fixture(scope="module")
def opened():
    return tetrakis.open(tetrakis.encode(terrain(45, 59, "i2"), photograph()))


@pytest.mark.parametrize("rows, columns", itertools.product(SLICES, SLICES))
def test_an_index_means_what_it_means_to_numpy(opened, rows, columns):
    whole = opened.heights()
    np.testing.assert_array_equal(opened[rows, columns], whole[rows, columns])


def test_short_indices_and_dots(opened):
    whole = opened.heights()
    for key in (3, np.int64(-2), slice(2, 5), ..., (..., 4), (4, ...), (..., slice(3), 1), ()):
        np.testing.assert_array_equal(opened[key], whole[key])
    assert opened[3, 4] == whole[3, 4] and opened[3, 4].dtype == whole.dtype
    for wrong in ((1, 2, 3), (..., ...), 45, (0, -60)):
        with pytest.raises(IndexError):
            opened[wrong]
    for wrong in ([1, 2], None, "x", 1.5, np.arange(3), (0, np.ones(59, bool))):
        with pytest.raises(tetrakis.TksUsageError):
            opened[wrong]


def test_a_stream_is_an_array(opened):
    whole = opened.heights()
    assert (opened.shape, opened.dtype, opened.ndim) == (whole.shape, whole.dtype, 2)
    assert (opened.size, len(opened)) == (whole.size, len(whole))
    np.testing.assert_array_equal(np.asarray(opened), whole)
    assert np.asarray(opened, "f8").dtype == np.float64
    assert np.mean(opened) == whole.mean()
    texture = tetrakis.open(tetrakis.encode(texture=photograph(20, 30, 4)))
    assert texture.shape == (20, 30, 4)
    np.testing.assert_array_equal(texture[3:9, ::2, -1], photograph(20, 30, 4)[3:9, ::2, -1])
    np.testing.assert_array_equal(texture[2], photograph(20, 30, 4)[2])


def pixels_of(page):
    png = base64.b64decode(re.search(r"base64,([^']+)'", page).group(1))
    rows, columns = (int.from_bytes(png[i : i + 4], "big") for i in (20, 16))
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    raw = np.frombuffer(zlib.decompress(png[41:-16]), "u1").reshape(rows, -1)
    return raw[:, 1:].reshape(rows, columns, -1)


@pytest.mark.parametrize("shape", [(1, 1), (1, 300), (2, 2), (45, 59), (300, 700)])
def test_notebooks_show_a_picture(shape):
    heights = terrain(*shape) if min(shape) > 1 else np.zeros(shape, "f4")
    with tetrakis.open(tetrakis.encode(heights, unit="m", crs="<&>")) as opened:
        page = opened._repr_html_()
        picture = pixels_of(page)
        assert max(picture.shape) <= 256 and "&lt;&amp;&gt;" in page
        assert min(shape) <= 2 or np.ptp(picture) > 100
    voids = np.where(heights > np.median(heights), np.float32(np.nan), heights)
    assert (pixels_of(tetrakis.open(tetrakis.encode(voids))._repr_html_()) <= 255).all()


@pytest.mark.parametrize("dtype, channels", [("u1", 1), ("u2", 3), ("u1", 4), ("u2", 2)])
def test_notebooks_show_textures(dtype, channels):
    texels = photograph(33, 44, channels, dtype)
    picture = pixels_of(tetrakis.open(tetrakis.encode(texture=texels))._repr_html_())
    assert picture.shape == (33, 44, channels) and np.ptp(picture[..., 0]) > 100


EXACT = [
    (np.array([[1.5, -2.25], [np.nan, 1e6]]), "f4"),
    (np.array([[1.5, np.inf - np.inf]], "f2"), "f4"),
    (np.array([[1, -70000]], "i8"), "i4"),
    (np.array([[0, 2**32 - 1]], "u8"), "u4"),
    (np.array([[2**32 - 1]], "i8"), "u4"),
    ([[1, 2], [3, 4]], "i4"),
    ([[0.5, 2]], "f4"),
]


@pytest.mark.parametrize("given, dtype", EXACT)
def test_other_numbers_are_taken_where_nothing_is_lost(given, dtype):
    back = tetrakis.open(tetrakis.encode(given)).heights()
    assert back.dtype == dtype
    np.testing.assert_array_equal(back, np.asarray(given))


@pytest.mark.parametrize(
    "given",
    [[[0.1]], [[1e300]], [[2**24 + 1.0]], [[-1, 2**31]], [[2**32]], [[-(2**31) - 1]], [[True]]],
)
def test_what_no_type_holds_is_refused(given):
    with pytest.raises(tetrakis.TksUsageError, match="astype"):
        tetrakis.encode(given)


@pytest.mark.parametrize("most, dtype", [(255, "u1"), (256, "u2"), (65535, "u2")])
def test_textures_of_other_integers(most, dtype):
    texels = np.arange(12).reshape(3, 4) * (most // 11)
    texels[-1, -1] = most
    back = tetrakis.open(tetrakis.encode(texture=texels)).texture()
    assert back.dtype == dtype
    np.testing.assert_array_equal(back, texels)
    for wrong in (texels + 65536, texels - 1, texels / 2):
        with pytest.raises(tetrakis.TksUsageError):
            tetrakis.encode(texture=wrong)


def test_masked_arrays_of_other_numbers():
    heights = np.ma.MaskedArray([[1.5, 1e300, 3.0]], mask=[[0, 1, 0]])
    back = tetrakis.open(tetrakis.encode(heights)).heights(masked=True)
    np.testing.assert_array_equal(back.mask, heights.mask)
    assert back[0, 0] == 1.5 and back[0, 2] == 3
    whole = np.ma.MaskedArray(np.array([[7, 2**60, 9]]), mask=[[0, 1, 0]])
    back = tetrakis.open(tetrakis.encode(whole)).heights(masked=True)
    assert back.tolist() == [[7, None, 9]] and back.dtype == "i4"


def test_an_axis_of_one_band_does_not_count(heights):
    stream = tetrakis.encode(heights)
    assert tetrakis.encode(heights[np.newaxis]) == stream
    assert tetrakis.encode(np.ma.MaskedArray(heights[np.newaxis])) == stream
    grey = photograph(channels=1)
    assert tetrakis.encode(texture=grey[np.newaxis]) == tetrakis.encode(texture=grey)
    with pytest.raises(tetrakis.TksUsageError, match="shape"):
        tetrakis.encode(np.stack([heights, heights]))


def test_windows_are_described(stream):
    with tetrakis.open(stream) as opened:
        whole, part = opened.info, opened.describe(window=np.s_[4:24, 10:40])
        assert part.shape == (20, 30) and part.dtype == whole.dtype
        left, step_x, _, top, _, step_y = whole.geotransform
        assert part.geotransform == (left + 10 * step_x, step_x, 0, top + 4 * step_y, 0, step_y)
        coarse = opened.describe(1, window=np.s_[2:12, 5:20])
        assert coarse.shape == (10, 15) and coarse.geotransform[1] == 2 * step_x
        assert opened.describe(window=None) == whole
