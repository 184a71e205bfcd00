# SPDX-License-Identifier: Apache-2.0
"""Streams with an index are read by ranges: of files, of web servers, of what fsspec opens."""

import io
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import photograph
from range_server import Server

import tetrakis

SIDE = 640


@pytest.fixture(scope="module")
def stream():
    noise = np.random.default_rng(5).integers(0, 900, (SIDE, SIDE), "i2")
    texture = photograph(300, 310)
    return tetrakis.encode(noise, texture, regions=64, index="windows")


WINDOWS = [np.s_[0:40, 0:40], np.s_[100:164, 500:560], np.s_[639:640, 639:640]]


def check(opened, stream):
    """Windows, levels and whole planes are those of the bytes in memory."""
    memory = tetrakis.open(stream)
    for window in WINDOWS:
        for name in ("heights", "surface", "validity"):
            wanted = getattr(memory, name)(window=window)
            np.testing.assert_array_equal(getattr(opened, name)(window=window), wanted)
    np.testing.assert_array_equal(opened.heights(level=2), memory.heights(level=2))
    part = np.s_[10:20, 30:90]
    np.testing.assert_array_equal(opened.texture(1, part), memory.texture(1, part))
    np.testing.assert_array_equal(opened.heights(), memory.heights())
    np.testing.assert_array_equal(opened.texture(), memory.texture())
    assert opened.info == memory.info


def test_a_server_sends_what_a_window_needs(stream):
    with Server(stream) as server, tetrakis.open(server.url) as opened:
        assert opened.info.shape == (SIDE, SIDE) and server.requests == 1
        opened.heights(window=WINDOWS[1])
        assert server.sent < len(stream) / 4
        assert server.requests <= 5
        before = server.sent
        opened.heights(window=WINDOWS[1])
        assert server.sent == before  # nothing is fetched twice
        check(opened, stream)


def test_prefixes_of_a_server(stream):
    with Server(stream) as server:
        with tetrakis.open(server.url, bytes=9000) as opened:
            assert (server.requests, server.sent) == (1, 9000)
            wanted = tetrakis.open(stream[:9000]).heights()
            np.testing.assert_array_equal(opened.heights(), wanted)


def test_a_server_without_ranges(stream):
    with Server(stream, ranges=False) as server, tetrakis.open(server.url) as opened:
        check(opened, stream)
        assert server.requests == 1


def test_a_file_that_changes_while_it_is_read(stream):
    with Server(stream) as server, tetrakis.open(server.url) as opened:
        server.etag = '"two"'
        with pytest.raises(OSError, match="changed"):
            opened.heights(window=WINDOWS[0])


def test_files_are_read_by_ranges(stream, tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(stream)

    class Counted(io.FileIO):
        count = 0

        def read(self, size=-1):
            part = super().read(size)
            Counted.count += len(part)
            return part

    with Counted(path) as file, tetrakis.open(file) as opened:
        opened.heights(window=WINDOWS[0])
        assert 0 < Counted.count < len(stream) / 4
        check(opened, stream)
    check(tetrakis.open(path), stream)
    check(pickle.loads(pickle.dumps(tetrakis.open(path))), stream)
    behind = io.BytesIO(b"x" * 100 + stream)
    behind.seek(100)
    check(tetrakis.open(behind), stream)


def test_what_fsspec_opens(stream):
    fsspec = pytest.importorskip("fsspec")
    with fsspec.open("memory://a.tks", "wb") as file:
        file.write(stream)
    check(tetrakis.open("memory://a.tks"), stream)
    with fsspec.open("memory://a.tks", "rb") as file:
        check(tetrakis.open(file), stream)
    with pytest.raises(FileNotFoundError):
        tetrakis.open("memory://missing.tks")
    with pytest.raises(ValueError):
        tetrakis.open("nonsense://a.tks")


def test_threads_share_a_file(stream, tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(stream)
    whole = tetrakis.open(stream).heights()
    places = [(x, y, 50, 50) for x in range(0, 590, 118) for y in range(0, 590, 118)]
    with tetrakis.open(path) as opened, ThreadPoolExecutor(4) as threads:
        parts = list(threads.map(lambda place: opened.heights(window=place), places))
    for (x, y, width, height), part in zip(places, parts):
        np.testing.assert_array_equal(part, whole[y : y + height, x : x + width])


def test_closed_and_cut_sources(stream, tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(stream)
    opened = tetrakis.open(path)
    opened.close()
    with pytest.raises(tetrakis.TksUsageError, match="closed"):
        opened.heights(window=WINDOWS[0])
    for length in (70_000, len(stream) - 1):
        path.write_bytes(stream[:length])
        with tetrakis.open(path) as opened:
            wanted = tetrakis.open(stream[:length])
            np.testing.assert_array_equal(opened.heights(), wanted.heights())
            with pytest.raises(tetrakis.TksTruncatedError):
                opened.verify()


@pytest.mark.parametrize("index", [False, "windows"])
@pytest.mark.parametrize("options", [dict(lossless=True), dict(max_error=20)])
def test_a_damaged_byte_is_noticed_by_whole_planes(tmp_path, index, options):
    heights = np.random.default_rng(6).integers(0, 900, (300, 300), "i2")
    sound = tetrakis.encode(heights, regions=64, index=index, **options)
    header = tetrakis.open(sound).info.header_bytes
    path = tmp_path / "a.tks"
    for place in np.linspace(header, len(sound) - 1, 12).astype(int):
        bad = bytearray(sound)
        bad[place] ^= 16
        path.write_bytes(bad)
        for source in (bytes(bad), path):
            with pytest.raises(tetrakis.TksCorruptError), tetrakis.open(source) as opened:
                opened.heights()
    bad[-1] ^= 16
    assert tetrakis.open(sound).heights(bytes=len(sound) - 5).shape == (300, 300)
