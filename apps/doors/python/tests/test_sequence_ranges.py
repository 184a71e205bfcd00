# SPDX-License-Identifier: Apache-2.0
"""Sequences are read by ranges, of files and of web servers: a frame takes the bytes of its
group."""

import io
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import moving
from range_server import Server

import tetrakis
from tetrakis import _groups

FRAMES = 200
CUBE = np.random.default_rng(3).integers(0, 90, (FRAMES, 8, 9), "u1")
TIMES = np.datetime64("2020-01-01") + 3 * np.arange(FRAMES)


@pytest.fixture(autouse=True)
def small_tails(monkeypatch):
    """So that the end of a small file leads to its beginning as that of a large one does."""
    monkeypatch.setattr(_groups, "_TAIL", 300)
    monkeypatch.setattr(_groups, "_HEAD", 300)


@pytest.fixture(scope="module")
def sequence():
    return tetrakis.encode_sequence(CUBE, times=TIMES, group=2)


@pytest.fixture(scope="module")
def unindexed():
    return tetrakis.encode_sequence(CUBE[::3], times=TIMES[::3], group=2, seekable=False)


def test_a_server_sends_few_bytes_for_a_frame(sequence):
    with Server(sequence) as server, tetrakis.open_sequence(server.url) as opened:
        assert opened.shape == CUBE.shape
        for number in (101, 3, 199, 50):
            before = server.requests
            np.testing.assert_array_equal(opened.frame(number).heights(), CUBE[number])
            assert server.requests - before <= 4
        before = server.requests
        assert opened.find(TIMES[155] + 1) == 155
        np.testing.assert_array_equal(opened.at(TIMES[155]).heights(), CUBE[155])
        assert server.requests - before <= 4
        assert server.sent < len(sequence) / 1.5
        np.testing.assert_array_equal(opened.times, TIMES)


def test_every_frame_is_found_by_number_and_by_time(sequence):
    file = io.BytesIO(b"before" + sequence)
    for number in range(0, FRAMES, 17):
        file.seek(6)
        opened = tetrakis.open_sequence(file)
        assert opened.find(TIMES[number]) == number
        np.testing.assert_array_equal(opened.frame(number).heights(), CUBE[number])


@pytest.mark.parametrize("cut", [0, 1, 30, 200, 700])
def test_files_that_end_inside_a_group(sequence, unindexed, tmp_path, cut):
    path = tmp_path / "a.tks"
    for whole in (sequence, unindexed):
        part = whole[: len(whole) - cut]
        path.write_bytes(part)
        memory = tetrakis.open_sequence(part)
        with tetrakis.open_sequence(path) as opened:
            assert len(opened) == len(memory) > 50
            for number in (0, 41, len(memory) - 1):
                wanted = memory.frame(number).heights()
                np.testing.assert_array_equal(opened.frame(number).heights(), wanted)
            for number in (41, 17):
                assert opened.find(memory.times[number]) == number
            np.testing.assert_array_equal(opened.times, memory.times)
            np.testing.assert_array_equal(opened[5:50:7], memory[5:50:7])


def test_threads_that_look_for_groups_at_once(sequence, tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(sequence)
    with tetrakis.open_sequence(path) as opened, ThreadPoolExecutor(8) as threads:
        tasks = [threads.submit(lambda: opened.times) for _ in range(4)]
        tasks += [threads.submit(opened.find, time) for time in TIMES[::29]]
        results = [task.result() for task in tasks]
    for times in results[:4]:
        np.testing.assert_array_equal(times, TIMES)
    assert results[4:] == list(range(0, FRAMES, 29))


def test_files_go_to_other_processes(sequence, tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(sequence)
    with tetrakis.open_sequence(path) as opened:
        for thing in (opened, opened.frame(177)):
            again = pickle.loads(pickle.dumps(thing))
            np.testing.assert_array_equal(np.asarray(again), np.asarray(thing))


def test_what_fsspec_opens(sequence):
    fsspec = pytest.importorskip("fsspec")
    with fsspec.open("memory://frames.tks", "wb") as file:
        file.write(sequence)
    with tetrakis.open_sequence("memory://frames.tks") as opened:
        np.testing.assert_array_equal(opened[190:], CUBE[190:])
    with fsspec.open("memory://frames.tks", "rb") as file, tetrakis.open_sequence(file) as opened:
        np.testing.assert_array_equal(opened[-1], CUBE[-1])


def test_windows_of_a_frame_fetch_parts_of_its_group():
    cube = moving(4, 700, 700).astype("i4") + np.random.default_rng(1).integers(0, 99, (700, 700))
    coded = tetrakis.encode_sequence(cube.astype("i4"), regions=64, index="windows", group=2)
    with Server(coded) as server, tetrakis.open_sequence(server.url) as opened:
        part = opened[3, 100:130, 500:530]
        np.testing.assert_array_equal(part, cube[3, 100:130, 500:530])
        assert server.sent < len(coded) / 3
