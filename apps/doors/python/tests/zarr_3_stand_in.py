# SPDX-License-Identifier: Apache-2.0
"""What Zarr 3 is to a codec, after the interface in zarr.abc.codec and zarr.core.buffer (zarr-python
3.0): the abstract classes, buffers, and an array that calls a codec as its pipeline does: metadata
in JSON, whole chunks at the edges, chunks in batches, some of them missing. Debian 12 has Zarr 2."""

import asyncio
import json
import sys
import types
from abc import ABC, abstractmethod
from dataclasses import dataclass
from importlib import metadata
from itertools import product

import numpy as np


class Buffer:
    """Bytes; NumPy holds them."""

    def __init__(self, array):
        assert array.dtype == np.uint8 and array.ndim == 1
        self._array = array

    @classmethod
    def from_bytes(cls, data):
        return cls(np.frombuffer(data, np.uint8))

    def to_bytes(self):
        return self._array.tobytes()


class NDBuffer:
    def __init__(self, array):
        self._array = array

    @classmethod
    def from_ndarray_like(cls, array):
        assert isinstance(array, np.ndarray)
        return cls(array)

    def as_ndarray_like(self):
        return self._array


@dataclass(frozen=True)
class BufferPrototype:
    buffer: type = Buffer
    nd_buffer: type = NDBuffer


@dataclass(frozen=True)
class ArraySpec:
    shape: tuple
    dtype: np.dtype
    fill_value: object
    prototype: BufferPrototype = BufferPrototype()


@dataclass(frozen=True)
class Metadata(ABC):
    """Codecs are frozen dataclasses over this."""


class ArrayBytesCodec(Metadata):
    @abstractmethod
    def compute_encoded_size(self, input_byte_length, chunk_spec):
        ...

    def resolve_metadata(self, chunk_spec):
        return chunk_spec

    def evolve_from_array_spec(self, array_spec):
        return self

    def validate(self, *, shape, dtype, chunk_grid):
        ...

    async def encode(self, chunks_and_specs):
        return await self._batch(self._encode_single, chunks_and_specs)

    async def decode(self, chunks_and_specs):
        return await self._batch(self._decode_single, chunks_and_specs)

    @staticmethod
    async def _batch(function, chunks_and_specs):
        async def one(chunk, spec):
            return None if chunk is None else await function(chunk, spec)

        return await asyncio.gather(*(one(*item) for item in chunks_and_specs))


class Array:
    """An array in a store that is a dictionary."""

    def __init__(self, store):
        self._store = store
        about = json.loads(store["zarr.json"])
        self.shape = tuple(about["shape"])
        self._chunks = tuple(about["chunk_grid"]["configuration"]["chunk_shape"])
        (codec,) = about["codecs"]
        dtype = np.dtype(about["data_type"])
        self._spec = ArraySpec(self._chunks, dtype, dtype.type(about["fill_value"]))
        kind = self._registered(codec["name"]).from_dict(codec)
        self._codec = kind.evolve_from_array_spec(self._spec)
        self._codec.validate(shape=self.shape, dtype=dtype, chunk_grid=self._chunks)

    @classmethod
    def create(cls, array, chunks, codec, fill_value=0):
        store = {}
        grid = {"name": "regular", "configuration": {"chunk_shape": list(chunks)}}
        about = dict(zarr_format=3, node_type="array", shape=array.shape, chunk_grid=grid)
        about.update(data_type=array.dtype.name, fill_value=fill_value, codecs=[codec.to_dict()])
        store["zarr.json"] = json.dumps(about)
        created = cls(store)
        created._write(array)
        return created, store

    @staticmethod
    def _registered(name):
        entry_points = metadata.entry_points()
        if hasattr(entry_points, "select"):
            (found,) = entry_points.select(group="zarr.codecs", name=name)
        else:
            (found,) = [e for e in entry_points["zarr.codecs"] if e.name == name]
        return found.load()

    def _places(self):
        counts = (-(-size // chunk) for size, chunk in zip(self.shape, self._chunks))
        for place in product(*map(range, counts)):
            yield "c/" + "/".join(map(str, place)), tuple(
                slice(i * chunk, (i + 1) * chunk) for i, chunk in zip(place, self._chunks)
            )

    def _write(self, array):
        """A chunk of nothing but the fill value is not kept."""
        keys, batch = [], []
        for key, part in self._places():
            chunk = np.full(self._chunks, self._spec.fill_value, self._spec.dtype)
            inside = array[part]
            chunk[tuple(map(slice, inside.shape))] = inside
            empty = (chunk == self._spec.fill_value).all()
            keys.append(key)
            batch.append((None if empty else NDBuffer(chunk), self._spec))
        for key, stream in zip(keys, asyncio.run(self._codec.encode(batch))):
            if stream is not None:
                self._store[key] = stream.to_bytes()

    def read(self):
        places = list(self._places())
        held = (self._store.get(key) for key, _ in places)
        batch = [(None if h is None else Buffer.from_bytes(h), self._spec) for h in held]
        out = np.full(self.shape, self._spec.fill_value, self._spec.dtype)
        for (_, part), chunk in zip(places, asyncio.run(self._codec.decode(batch))):
            if chunk is not None:
                inside = out[part]
                samples = chunk.as_ndarray_like()
                assert samples.shape == self._chunks and samples.dtype == self._spec.dtype
                inside[...] = samples[tuple(map(slice, inside.shape))]
        return out


def install(monkeypatch):
    """As the modules that tetrakis.zarr imports."""
    module = types.ModuleType("zarr.abc.codec")
    module.ArrayBytesCodec = ArrayBytesCodec
    for name in ("zarr", "zarr.abc"):
        monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
    monkeypatch.setitem(sys.modules, "zarr.abc.codec", module)
