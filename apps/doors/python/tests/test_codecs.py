# SPDX-License-Identifier: Apache-2.0
"""The functions that imagecodecs' codecs have, and the codec of numcodecs and Zarr 2."""

import importlib
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import SAMPLES, photograph, terrain

import tetrakis


def test_tks_functions(heights, texture):
    stream = tetrakis.tks_encode(heights)
    assert tetrakis.tks_check(stream) and not tetrakis.tks_check(b"GIF89a")
    assert not tetrakis.tks_check(b"TK") and tetrakis.tks_check(bytearray(stream))
    np.testing.assert_array_equal(tetrakis.tks_decode(stream), heights)
    np.testing.assert_array_equal(tetrakis.tks_decode(tetrakis.tks_encode(texture)), texture)
    lossy = tetrakis.tks_encode(heights, 40, numthreads=2)
    assert len(lossy) < len(stream) and lossy == tetrakis.encode(heights, psnr=40)
    assert tetrakis.tks_decode(stream, level=1).shape == (23, 30)
    out = np.empty_like(heights)
    assert tetrakis.tks_decode(stream, out=out) is out
    assert tetrakis.tks_encode(heights, threads=2) == stream
    for twice in (dict(psnr=30), dict(numthreads=2, threads=2)):
        with pytest.raises(tetrakis.TksUsageError, match="give one"):
            tetrakis.tks_encode(heights, 40, **twice)
    for no_bytes in (5, "TKS", None):
        with pytest.raises(tetrakis.TksUsageError, match="bytes"):
            tetrakis.tks_check(no_bytes)


def test_damage_is_found(heights, texture):
    for array in (heights, texture):
        stream = bytearray(tetrakis.tks_encode(array))
        stream[len(stream) * 2 // 3] ^= 16
        with pytest.raises(tetrakis.TksCorruptError, match="damaged"):
            tetrakis.tks_decode(stream)
        with tetrakis.open(bytes(stream)) as opened:
            with pytest.raises(tetrakis.TksCorruptError, match="damaged"):
                opened.verify()
        assert tetrakis.tks_decode(stream[:-1]).shape == array.shape


def test_tks_encode_into_a_buffer(heights):
    stream = tetrakis.tks_encode(heights)
    room = bytearray(len(stream) + 10)
    written = tetrakis.tks_encode(heights, out=room)
    assert written == stream and room.startswith(stream)
    assert tetrakis.tks_encode(heights, out=len(stream)) == stream
    by_columns = np.zeros((len(stream), 2), order="F")
    for wrong in (bytearray(len(stream) - 1), bytes(len(stream)), len(stream) - 1, -1, by_columns,
                  "text"):  # fmt: skip
        with pytest.raises(tetrakis.TksUsageError, match="out must"):
            tetrakis.tks_encode(heights, out=wrong)


def test_tks_decode_into_so_many_bytes(heights):
    stream = tetrakis.tks_encode(heights)
    np.testing.assert_array_equal(tetrakis.tks_decode(stream, out=heights.nbytes), heights)
    quarter = tetrakis.tks_decode(stream, level=1, out=heights.nbytes)
    np.testing.assert_array_equal(quarter, tetrakis.tks_decode(stream, level=1))
    for wrong in (heights.nbytes - 1, -1):
        with pytest.raises(tetrakis.TksUsageError, match="out must"):
            tetrakis.tks_decode(stream, out=wrong)


@pytest.fixture
def codec():
    pytest.importorskip("numcodecs")
    from tetrakis.numcodecs import Tetrakis

    return Tetrakis


@pytest.mark.parametrize("dtype", SAMPLES)
@pytest.mark.parametrize("shape", [(32, 33), (1, 32, 33), (1, 1, 32, 33)])
def test_numcodecs_chunks_come_back(codec, dtype, shape):
    chunk = terrain(32, 33, dtype).reshape(shape)
    encoded = codec().encode(chunk)
    np.testing.assert_array_equal(codec().decode(encoded).reshape(shape), chunk)
    out = np.empty_like(chunk)
    codec().decode(encoded, out=out)
    np.testing.assert_array_equal(out, chunk)


@pytest.mark.parametrize("shape", [(20, 33), (1, 20, 33), (20, 33, 1)])
def test_numcodecs_keeps_the_order_of_memory(codec, shape):
    """Zarr 2 takes what decode() returns for the memory of a chunk in the array's order."""
    chunk = np.asfortranarray(terrain(20, 33).reshape(shape))
    decoded = codec().decode(codec().encode(chunk))
    np.testing.assert_array_equal(decoded.reshape(-1, order="A"), chunk.reshape(-1, order="A"))
    out = np.empty_like(chunk)
    codec().decode(codec().encode(chunk), out=out)
    np.testing.assert_array_equal(out, chunk)
    strided = terrain(20, 66)[:, ::2]
    np.testing.assert_array_equal(codec().decode(codec().encode(strided)), strided)


def test_numcodecs_refuses_what_would_come_back_as_something_else(codec):
    with pytest.raises(tetrakis.TksUsageError, match="byte order"):
        codec().encode(terrain(20, 33).astype(">f4"))
    with pytest.raises(tetrakis.TksUsageError, match="order='C'"):
        codec().encode(np.asfortranarray(photograph(20, 33)))


def test_numcodecs_configuration(codec):
    import numcodecs

    lossy = codec(max_error=0.25, nodata=-9999)
    assert numcodecs.get_codec(lossy.get_config()) == lossy
    assert pickle.loads(pickle.dumps(lossy)) == lossy
    chunk = terrain(40, 40)
    chunk[3:9, 5:9] = -9999
    decoded = lossy.decode(lossy.encode(chunk))
    assert np.abs(decoded - chunk).max() <= 0.25
    assert (decoded[3:9, 5:9] == -9999).all()
    layers = [((2, 3, 4, 3), "f4"), ((2, 3, 4, 5), "u1"), ((2, 2, 3, 4, 3), "u1")]
    for shape, dtype in [*layers, (9, "f4")]:
        with pytest.raises(tetrakis.TksUsageError, match="choose other chunks"):
            codec().encode(np.zeros(shape, dtype))
    with pytest.raises(tetrakis.TksUsageError, match="A chunk of type float64"):
        codec().encode(np.zeros((4, 4)))


@pytest.mark.parametrize("shape, dtype", [
    ((37, 9, 20), "f4"), ((2, 9, 20), "u1"), ((3, 4, 3), "f4"), ((1, 5, 9, 20), "i2"),
    ((5, 9, 20, 3), "u1"),
])  # fmt: skip
def test_numcodecs_chunks_with_time(codec, shape, dtype):
    chunk = np.resize(terrain(9, 20, "u1"), shape).astype(dtype)
    encoded = codec().encode(chunk)
    np.testing.assert_array_equal(codec().decode(encoded).reshape(shape), chunk)
    assert len(codec(bytes=4000).encode(chunk)) <= 4000
    with pytest.raises(tetrakis.TksUsageError, match="order='C'"):
        codec().encode(np.asfortranarray(chunk))


def test_numcodecs_finds_the_codec_by_its_entry_point(codec):
    entry_points = importlib.import_module("importlib.metadata").entry_points()
    if hasattr(entry_points, "select"):
        found = entry_points.select(group="numcodecs.codecs", name="tetrakis")
    else:
        found = [e for e in entry_points["numcodecs.codecs"] if e.name == "tetrakis"]
    assert [point.load() for point in found] == [codec]


def test_zarr_2_arrays(codec):
    zarr = pytest.importorskip("zarr")
    if int(zarr.__version__.split(".")[0]) > 2:
        pytest.skip("Zarr 3 makes such arrays in test_zarr_3.py")
    heights = terrain(70, 40)
    array = zarr.array(heights, chunks=(32, 32), compressor=codec())
    np.testing.assert_array_equal(array[:], heights)
    with ThreadPoolExecutor(4) as pool:
        rows = list(pool.map(lambda row: array[row], range(0, 70, 9)))
    np.testing.assert_array_equal(np.stack(rows), heights[::9])
    cube = np.stack([heights, heights + 1, heights])
    array = zarr.array(cube, chunks=(2, 32, 32), compressor=codec())
    np.testing.assert_array_equal(array[:], cube)
    by_columns = zarr.array(heights, chunks=(32, 32), order="F", compressor=codec())
    np.testing.assert_array_equal(by_columns[:], heights)
