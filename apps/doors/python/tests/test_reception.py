# SPDX-License-Identifier: Apache-2.0
"""Frames of `tetrakis serve`: of files, of files that grow and stop growing, of servers that end,
restart and lie. They need a built `tetrakis` (TETRAKIS_CLI)."""

import os
import subprocess
import threading
import time
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import numpy as np
import pytest
from conftest import REPOSITORY, moving

import tetrakis

CLI = os.environ.get("TETRAKIS_CLI", str(REPOSITORY / "build" / "tetrakis"))
CUBE = moving(12)
TIMES = np.datetime64("2026-03-01T00:00:00") + np.arange(12)

pytestmark = pytest.mark.skipif(not os.path.exists(CLI), reason="there is no built tetrakis")


@pytest.fixture(scope="module")
def groups():
    """One frame each, which goes on from the one before."""
    with tetrakis.SequenceEncoder(
        clock=tetrakis.Clock(1, "2026-03-01T00:00:00Z"), group=1, reference="all", entry=4,
        lossless=True, nodata=-9999, index=True,
    ) as encoder:  # fmt: skip
        parts = []
        for frame in CUBE:
            encoder.push(frame)
            parts.append(encoder.take())
    return parts


class Served:
    """A file that grows, and its server."""

    def __init__(self, path, parts, *options):
        self.path, self._options, self._port = path, options, None
        path.write_bytes(b"".join(parts))
        self.start()

    def start(self):
        port = [] if self._port is None else ["--port", str(self._port)]
        command = [CLI, "serve", str(self.path), *self._options, *port]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.url = self._process.stdout.readline().strip()
        self._port = int(self.url.split(":")[2].split("/")[0])

    def append(self, *parts):
        with open(self.path, "ab") as file:
            file.write(b"".join(parts))

    def end(self):
        self._process.kill()
        self._process.wait()
        self._process.stdout.close()


@pytest.fixture
def serving(tmp_path):
    servers = []

    def serve(parts, *options):
        servers.append(Served(tmp_path / f"{len(servers)}.tks", parts, *options))
        return servers[-1]

    yield serve
    for server in servers:
        server.end()


def check(frame, exact=True):
    assert frame.tick == frame.number
    assert frame.time == TIMES[frame.number]
    heights = frame.stream.heights()
    assert heights.shape == CUBE[0].shape
    if exact:
        samples = np.ma.filled(heights, -9999)
        np.testing.assert_array_equal(samples, CUBE[frame.number])
        frame.stream.verify()


def test_all_frames_of_a_file_come_in_their_order(serving, groups):
    server = serving(groups)
    frames = list(tetrakis.receive(server.url))
    assert [frame.number for frame in frames] == list(range(12))
    for frame in frames:
        check(frame)
    with tetrakis.receive(server.url, frame=9) as reception:
        assert [frame.number for frame in reception] == [9, 10, 11]
        assert reception.end_frame == 12
        assert reception.clock == tetrakis.Clock(1, "2026-03-01T00:00:00Z")
        assert reception.bytes_received < sum(map(len, groups))
    assert list(tetrakis.receive(server.url, frame=12)) == []


def test_old_frames_are_given_up(serving, groups):
    frames = list(tetrakis.receive(serving(groups).url, keep=2))
    check(frames[-1])
    with pytest.raises(tetrakis.TksUsageError, match="not there"):
        frames[0].stream.heights()


def test_thin_links_bring_rough_frames(serving):
    clock = tetrakis.Clock(1, "2026-03-01T00:00:00Z")
    alone = tetrakis.encode_sequence(CUBE, clock=clock, group=1, lossless=True, nodata=-9999)
    server = serving([alone])
    with tetrakis.receive(server.url, channel="3k/s") as reception:
        frames = list(reception)
        thin = reception.bytes_received
    assert [frame.number for frame in frames] == list(range(12))
    for frame in frames:
        check(frame, exact=False)
    errors = [np.abs(f.stream.heights() - CUBE[f.number].astype("f8")).max() for f in frames]
    assert max(errors) > 0
    with tetrakis.receive(server.url) as reception:
        list(reception)
        assert thin < 0.8 * reception.bytes_received


def test_a_slow_producer_is_followed(serving, groups):
    server = serving(groups[:3], "--live")

    def write():
        for part in groups[3:]:
            time.sleep(0.15)
            server.append(part[: len(part) // 2])
            time.sleep(0.05)
            server.append(part[len(part) // 2 :])

    writer = threading.Thread(target=write)
    numbers = []
    with tetrakis.receive(server.url, live=True, seconds=20) as reception:
        for frame in reception:
            if not numbers:
                writer.start()
            check(frame, exact=False)
            numbers.append(frame.number)
            if frame.number == 11:
                break
    writer.join()
    assert numbers[0] == 2 and numbers == sorted(set(numbers))
    assert len(numbers) >= 8
    check(frame)


def test_a_part_of_a_frame_is_shown_where_no_more_comes(serving, groups):
    server = serving(groups[:3], "--live")
    server.append(groups[3][: len(groups[3]) // 2])  # the disk is full
    frames = tetrakis.receive(server.url, live=True, seconds=20)
    frame = next(frame for frame in frames if frame.number == 3)
    check(frame, exact=False)


def test_a_producer_that_stops(serving, groups):
    server = serving(groups[:3], "--live")
    server.append(groups[3][:40])
    begin = time.monotonic()
    numbers = []
    with pytest.raises(TimeoutError, match="No frame came for 0.5 s"):
        for frame in tetrakis.receive(server.url, live=True, wait=0.5):
            numbers.append(frame.number)
    assert numbers == [2]
    assert time.monotonic() - begin < 5
    begin = time.monotonic()
    assert [f.number for f in tetrakis.receive(server.url, live=True, seconds=0.5)] == [2]
    assert time.monotonic() - begin < 5


def test_close_ends_a_wait(serving, groups):
    reception = tetrakis.receive(serving(groups[:3], "--live").url, live=True)
    check(next(reception))
    threading.Timer(0.3, reception.close).start()
    begin = time.monotonic()
    assert list(reception) == []
    assert time.monotonic() - begin < 4
    assert reception.closed


def test_a_server_that_restarts_and_one_that_ends(serving, groups):
    server = serving(groups[:4], "--live")
    reception = tetrakis.receive(server.url, live=True, patience=20)
    check(next(reception))
    server.end()
    server.append(*groups[4:7])
    threading.Timer(0.5, server.start).start()
    frame = next(reception)
    assert frame.number == 6
    check(frame)
    brief = tetrakis.receive(server.url, live=True, patience=0.3)
    last = next(brief)
    server.end()
    with pytest.raises(tetrakis.TksIOError, match="No answer comes"):
        next(brief)
    check(last)


@contextmanager
def answering(answer):
    """A server that answers each message with what answer(count) gives: (status, body)."""

    class Handler(BaseHTTPRequestHandler):
        count = 0

        def do_POST(self):
            self.rfile.read(int(self.headers["Content-Length"]))
            status, body = answer(Handler.count)
            Handler.count += 1
            self.send_response(status)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/a.tks", Handler
    finally:
        server.shutdown()
        server.server_close()


def test_what_is_no_server_of_sequences(serving, groups):
    with answering(lambda _: (200, b"<!doctype html>")) as (url, handler):
        with pytest.raises(tetrakis.TksCorruptError):
            next(tetrakis.receive(url))
        assert handler.count == 1
    with answering(lambda _: (404, b"")) as (url, _):
        with pytest.raises(tetrakis.TksIOError, match="answers 404"):
            next(tetrakis.receive(url))
    with answering(lambda _: time.sleep(1) or (200, b"")) as (url, _):
        with pytest.raises(tetrakis.TksIOError, match="timed out"):
            next(tetrakis.receive(url, timeout=0.2))
    with pytest.raises(tetrakis.TksIOError, match="No answer comes"):
        next(tetrakis.receive("http://127.0.0.1:1/a.tks"))


@pytest.mark.parametrize(
    "wrong",
    [
        {"url": "a.tks"}, {"url": 3}, {"url": "file:///a.tks"}, {"channel": 0}, {"channel": "64k"},
        {"channel": "x/s"}, {"channel": "1.2.3k/s"}, {"channel": float("nan")}, {"triangles": -1},
        {"view": 3}, {"view": ([1] * 15, 4, 4)}, {"view": ([1] * 16, -1, 4)}, {"seconds": -1},
        {"wait": "x"}, {"keep": -1}, {"frame": -1}, {"live": 2}, {"patience": float("nan")},
    ],
)  # fmt: skip
def test_arguments_that_make_no_sense(wrong):
    with pytest.raises(tetrakis.TksUsageError):
        tetrakis.receive(**{"url": "http://127.0.0.1:1/a.tks", **wrong})


def test_wants_change_on_the_way(serving, groups):
    matrix = np.diag([0.02, 0.02, 0, 1])
    with tetrakis.receive(serving(groups).url, view=(matrix, 640, 480)) as reception:
        check(next(reception))
        reception.want(channel=8000, triangles=50, view=None)
        check(next(reception), exact=False)
        reception.want(channel=None, triangles=None)
        numbers = [frame.number for frame in reception]
        assert numbers == list(range(2, 12))
        with pytest.raises(TypeError):
            reception.want(frame=3)
