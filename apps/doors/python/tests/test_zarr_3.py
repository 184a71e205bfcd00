# SPDX-License-Identifier: Apache-2.0
"""The codec of Zarr 3: in Zarr 3 itself where that is installed (try_debian_13 has it), else in
what stands for it (zarr_3_stand_in.py)."""

import dataclasses
import importlib
import subprocess
import sys
from importlib import metadata
from types import SimpleNamespace

import numpy as np
import pytest
import zarr_3_stand_in
from conftest import SAMPLES, moving, photograph, terrain

import tetrakis


def is_installed():
    try:
        return int(metadata.version("zarr").split(".")[0]) >= 3
    except metadata.PackageNotFoundError:
        return False


of_zarr_itself = pytest.mark.skipif(not is_installed(), reason="there is no Zarr 3")


@pytest.fixture
def zarr_3(monkeypatch):
    """The arrays of Zarr 3 and our codec for them."""
    if is_installed():
        arrays = importlib.import_module("zarr_3_installed")
    else:
        arrays = zarr_3_stand_in
        arrays.install(monkeypatch)
        monkeypatch.delitem(sys.modules, "tetrakis.zarr", raising=False)
    codec = importlib.import_module("tetrakis.zarr").TetrakisCodec
    return SimpleNamespace(Array=arrays.Array, Codec=codec)


@pytest.mark.parametrize("dtype", SAMPLES)
def test_arrays(zarr_3, dtype):
    heights = terrain(70, 40, dtype)
    heights[:32, :16] = 0
    array, store = zarr_3.Array.create(heights, (32, 16), zarr_3.Codec())
    np.testing.assert_array_equal(array.read(), heights)
    assert "c/0/0" not in store and tetrakis.tks_check(store["c/2/2"])
    np.testing.assert_array_equal(zarr_3.Array(store).read(), heights)


@pytest.mark.parametrize("layers, chunks", [(terrain()[None], (1, 20, 30)),
                                            (photograph(40, 48), (32, 32, 3)),
                                            (moving(5, 40, 48), (2, 32, 32)),
                                            (photograph(40, 48, 1)[..., None], (32, 32, 1))])
def test_axes(zarr_3, layers, chunks):
    array, _ = zarr_3.Array.create(layers, chunks, zarr_3.Codec())
    np.testing.assert_array_equal(array.read(), layers)


def test_lossy_and_refused(zarr_3):
    heights = terrain(70, 40)
    array, _ = zarr_3.Array.create(heights, (32, 16), zarr_3.Codec(max_error=0.75))
    assert 0 < np.abs(array.read() - heights).max() <= 0.75  # the heights are halves
    with pytest.raises(tetrakis.TksUsageError, match="neither"):
        zarr_3.Array.create(np.ones(9, "f4"), (4,), zarr_3.Codec())
    wrapped = SimpleNamespace(to_native_dtype=lambda: np.dtype("f8"))  # Zarr 3.1
    for dtype in (np.dtype("f8"), np.dtype("c8"), wrapped):
        with pytest.raises(tetrakis.TksUsageError, match="A chunk of type"):
            zarr_3.Codec().validate(shape=(8, 9), dtype=dtype, chunk_grid=(4, 4))
    with pytest.raises(NotImplementedError):
        zarr_3.Codec().compute_encoded_size(4096, None)
    with pytest.raises(dataclasses.FrozenInstanceError):
        zarr_3.Codec().bytes = 5


def test_configuration(zarr_3):
    codec = zarr_3.Codec(psnr=40, nodata=0)
    written = codec.to_dict()
    assert written == {"name": "tetrakis", "configuration": {"psnr": 40, "nodata": 0}}
    assert zarr_3.Codec.from_dict(written) == codec
    assert zarr_3.Codec.from_dict({"name": "tetrakis"}) == zarr_3.Codec()
    with pytest.raises(ValueError):
        zarr_3.Codec.from_dict({"name": "gzip"})


@of_zarr_itself
def test_shards_hold_streams_and_are_written_in_part(zarr_3):
    import zarr

    heights = terrain(70, 40)
    store = zarr.storage.MemoryStore()
    array = zarr.create_array(store, shape=heights.shape, dtype="f4", chunks=(16, 16),
                              shards=(64, 32), serializer=zarr_3.Codec(), compressors=None)
    array[...] = heights
    array[5:19, 7:30] = heights[5:19, 7:30] = 3
    np.testing.assert_array_equal(zarr.open_array(store, mode="r")[...], heights)


@of_zarr_itself
@pytest.mark.parametrize("order", "CF")
@pytest.mark.parametrize("turned", [False, True])
def test_orders_and_codecs_around_it(zarr_3, order, turned):
    from zarr.codecs import TransposeCodec, ZstdCodec

    heights = terrain(70, 40)
    filters = [TransposeCodec(order=(1, 0))] if turned else []
    array, _ = zarr_3.Array.create(np.asarray(heights, order=order), (32, 16), zarr_3.Codec(),
                                   order=order, filters=filters, compressors=[ZstdCodec()])
    np.testing.assert_array_equal(array.read(), heights)


@of_zarr_itself
def test_chunks_that_were_not_written_are_the_fill_value(zarr_3):
    import zarr

    heights = terrain(70, 40)
    array = zarr.create_array(zarr.storage.MemoryStore(), shape=heights.shape, dtype="f4",
                              chunks=(32, 16), serializer=zarr_3.Codec(), fill_value=np.nan)
    array[:40] = heights[:40]
    np.testing.assert_array_equal(array[:40], heights[:40])
    assert np.isnan(array[40:]).all()


@of_zarr_itself
def test_another_process_needs_no_import(zarr_3, tmp_path):
    import zarr

    heights = terrain(70, 40)
    group = zarr.create_group(tmp_path / "a.zarr")
    array = group.create_array("dem", shape=heights.shape, dtype="f4", chunks=(32, 16),
                               serializer=zarr_3.Codec(max_error=0.5), compressors=None)
    array[...] = heights
    script = "import sys, zarr; print(zarr.open(sys.argv[1])['dem'][...].sum(dtype='f8'))"
    read = [sys.executable, "-c", script, tmp_path / "a.zarr"]
    total = subprocess.run(read, check=True, capture_output=True, text=True).stdout
    assert float(total) == array[...].sum(dtype="f8")


@of_zarr_itself
def test_what_cannot_be_coded_is_refused_when_the_array_is_made(zarr_3):
    import zarr

    for dtype in ("f8", "c8", "i8", "?"):
        with pytest.raises(tetrakis.TksUsageError, match="A chunk of type"):
            zarr.create_array(zarr.storage.MemoryStore(), shape=(9, 9), dtype=dtype, chunks=(4, 4),
                              serializer=zarr_3.Codec())


@of_zarr_itself
def test_damage_is_found(zarr_3):
    heights = terrain(32, 16)
    array, store = zarr_3.Array.create(heights, (32, 16), zarr_3.Codec())
    for damaged in (b"GIF89a", flipped(store["c/0/0"])):
        with pytest.raises(tetrakis.TksError):
            zarr_3.Array({**store, "c/0/0": damaged}).read()


def flipped(stream):
    changed = bytearray(stream)
    changed[len(changed) * 2 // 3] ^= 16
    return bytes(changed)


@of_zarr_itself
@pytest.mark.parametrize("order", "CF")
def test_arrays_of_format_2(order):
    import zarr

    from tetrakis.numcodecs import Tetrakis

    heights = terrain(70, 40)
    array = zarr.create_array(zarr.storage.MemoryStore(), shape=heights.shape, dtype="f4",
                              chunks=(32, 16), zarr_format=2, order=order, compressors=Tetrakis())
    array[...] = heights
    np.testing.assert_array_equal(array[...], heights)
