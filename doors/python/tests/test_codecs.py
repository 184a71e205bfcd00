# SPDX-License-Identifier: Apache-2.0
"""The functions that imagecodecs' codecs have, and the codecs of numcodecs and Zarr."""

import asyncio
import importlib
import sys
import types
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
    with pytest.raises(tetrakis.TksUsageError):
        tetrakis.tks_encode(heights, 40, psnr=30)


def test_tks_encode_into_a_buffer(heights):
    stream = tetrakis.tks_encode(heights)
    room = bytearray(len(stream) + 10)
    written = tetrakis.tks_encode(heights, out=room)
    assert written == stream and room.startswith(stream)
    for small in (bytearray(len(stream) - 1), bytes(len(stream))):
        with pytest.raises(tetrakis.TksUsageError, match="out must"):
            tetrakis.tks_encode(heights, out=small)


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


def test_numcodecs_configuration(codec):
    import numcodecs

    lossy = codec(max_error=0.25, nodata=-9999)
    assert numcodecs.get_codec(lossy.get_config()) == lossy
    chunk = terrain(40, 40)
    chunk[3:9, 5:9] = -9999
    decoded = lossy.decode(lossy.encode(chunk))
    assert np.abs(decoded - chunk).max() <= 0.25
    assert (decoded[3:9, 5:9] == -9999).all()
    for wrong in (np.zeros((3, 4, 5), "f4"), np.zeros(9, "f4"), np.zeros((4, 4))):
        with pytest.raises(tetrakis.TksUsageError):
            codec().encode(wrong)


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
        pytest.skip("this is Zarr 3")
    heights = terrain(70, 40)
    array = zarr.array(heights, chunks=(32, 32), compressor=codec())
    np.testing.assert_array_equal(array[:], heights)
    with ThreadPoolExecutor(4) as pool:
        rows = list(pool.map(lambda row: array[row], range(70)))
    np.testing.assert_array_equal(np.stack(rows), heights)


@pytest.fixture
def zarr_3(monkeypatch):
    """tetrakis.zarr over Zarr 3, or over a stand-in of the one class that it takes from there:
    Debian 12 has Zarr 2."""
    try:
        importlib.import_module("zarr.abc.codec")
    except ImportError:
        stand_in = types.ModuleType("zarr.abc.codec")
        stand_in.ArrayBytesCodec = type("ArrayBytesCodec", (), {})
        for name in ("zarr", "zarr.abc"):
            monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
        monkeypatch.setitem(sys.modules, "zarr.abc.codec", stand_in)
    monkeypatch.delitem(sys.modules, "tetrakis.zarr", raising=False)
    return importlib.import_module("tetrakis.zarr")


class Held:
    """What Zarr 3 hands to a codec, as far as it is looked at: a Buffer or an NDBuffer."""

    def __init__(self, held):
        self.to_bytes = self.as_ndarray_like = lambda: held


@pytest.mark.parametrize("chunk", [terrain(32, 33), photograph(32, 32), terrain()[None]])
def test_zarr_3_chunks_come_back(zarr_3, chunk):
    buffers = types.SimpleNamespace(from_bytes=Held, from_ndarray_like=Held)
    prototype = types.SimpleNamespace(buffer=buffers, nd_buffer=buffers)
    spec = types.SimpleNamespace(prototype=prototype, shape=chunk.shape)
    codec = zarr_3.TetrakisCodec()
    stream = asyncio.run(codec._encode_single(Held(chunk), spec))
    decoded = asyncio.run(codec._decode_single(stream, spec)).as_ndarray_like()
    np.testing.assert_array_equal(decoded, chunk)


def test_zarr_3_configuration(zarr_3):
    codec = zarr_3.TetrakisCodec(psnr=40, nodata=0)
    written = codec.to_dict()
    assert written == {"name": "tetrakis", "configuration": {"psnr": 40, "nodata": 0}}
    assert zarr_3.TetrakisCodec.from_dict(written) == codec
    assert zarr_3.TetrakisCodec.from_dict({"name": "tetrakis"}) == zarr_3.TetrakisCodec()
    with pytest.raises(ValueError):
        zarr_3.TetrakisCodec.from_dict({"name": "gzip"})
