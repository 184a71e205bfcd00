# SPDX-License-Identifier: Apache-2.0
"""Whatever an argument is given: it does its work, or a TksError says in one sentence why not."""

import inspect
import io

import numpy as np
import pytest
from conftest import photograph, terrain

import tetrakis


class Incomparable:
    def __eq__(self, other):
        raise RuntimeError("not to be compared")

    __hash__ = None


ODD = {
    "text": "top",
    "no text": "",
    "number as text": "40",
    "NUL": "a\0b",
    "bytes": b"ab",
    "NaN": float("nan"),
    "infinity": float("inf"),
    "negative": -5,
    "fraction": 1.5,
    "64 bits": 2**64,
    "beyond doubles": 10**400,
    "beyond decimals": 10**5000,
    "complex": 1j,
    "list": [1, 2],
    "ragged": [[1], [2, 3]],
    "ragged arrays": [np.ones(2), 3],
    "dictionary": {},
    "set": {1, 2},
    "slice": slice("a", None),
    "slices": (slice(None, None, 0), slice(0, np.ones(2))),
    "object": object(),
    "incomparable": Incomparable(),
    "array": np.ones((2, 3)),
    "array of nothing": np.ones((0, 0)),
    "array of one": np.array([1.0]),
    "array of none": np.array(1.0),
    "array of text": np.array(["area", "point"]),
    "array of dates": np.zeros((2, 2), "M8[s]"),
    "masked": np.ma.masked,
    "masked array": np.ma.masked_all((3, 3), "i2"),
    "type": int,
}


def expect_an_answer(call):
    try:
        call()
    except tetrakis.TksError as refused:
        sentence = str(refused)
        assert sentence and "\n" not in sentence and len(sentence) < 300
    except FileNotFoundError:  # text is a path
        pass


def arguments_of(function):
    names = inspect.signature(function).parameters
    return [name for name in names if name not in ("self", "data", "source", "stream", "options")]


@pytest.fixture(scope="module")
def coded():
    return tetrakis.encode(terrain(12, 13), photograph(12, 13), psnr=30)


@pytest.mark.parametrize("value", ODD.values(), ids=ODD)
def test_encode_takes_or_refuses(value):
    masked = np.ma.MaskedArray(terrain(9, 8, "i2"), mask=np.eye(9, 8, dtype=bool))
    for heights in (terrain(9, 8), masked):
        for name in arguments_of(tetrakis.encode):
            given = {"heights": heights, "texture": photograph(9, 8), name: value}
            expect_an_answer(lambda: tetrakis.encode(**given))
        for name in arguments_of(tetrakis.tks_encode):
            expect_an_answer(lambda: tetrakis.tks_encode(heights, **{name: value}))
    expect_an_answer(lambda: tetrakis.tks_encode(value))


@pytest.mark.parametrize("value", ODD.values(), ids=ODD)
def test_streams_take_or_refuse(coded, value):
    stream = tetrakis.open(coded)
    for method in (stream.heights, stream.surface, stream.validity, stream.texture, stream.mesh,
                   stream.describe):  # fmt: skip
        for name in arguments_of(method):
            expect_an_answer(lambda: method(**{name: value}))
    for read in (stream.heights, stream.texture):
        expect_an_answer(lambda: read(window=(value, slice(2))))
        expect_an_answer(lambda: read(window=(0, 0, 1, value)))


@pytest.mark.parametrize("value", ODD.values(), ids=ODD)
def test_what_opens_streams_takes_or_refuses(coded, value):
    for function in (tetrakis.open, tetrakis.tks_decode, tetrakis.tks_check):
        expect_an_answer(lambda: function(value))
        for name in arguments_of(function):
            expect_an_answer(lambda: function(coded, **{name: value}))
    expect_an_answer(lambda: tetrakis.truncate(value, 50))
    expect_an_answer(lambda: tetrakis.truncate(coded, value))


def test_flags_are_true_or_false(heights):
    lossy = tetrakis.encode(heights, psnr=40)
    for no in (False, 0, np.False_):
        assert tetrakis.encode(heights, psnr=40, lossless=no) == lossy
    assert tetrakis.encode(heights, lossless=np.True_) == tetrakis.encode(heights)
    with pytest.raises(tetrakis.TksUsageError, match="lossless must be one of"):
        tetrakis.encode(heights, lossless="no")


def test_files_may_be_asked_for_more_bytes_than_there_is_memory(coded, tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(coded)
    with open(path, "rb", buffering=0) as file:
        for source in (path, file, io.BytesIO(coded), coded):
            assert tetrakis.open(source, bytes=2**63 - 1).info.available_bytes == len(coded)
