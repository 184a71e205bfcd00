# SPDX-License-Identifier: Apache-2.0
"""Groups that go on from the last frame of the group before; encoders that go on behind a file, and
sequences for thinner channels."""

import io
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import moving, photograph
from range_server import Server

import tetrakis
from tetrakis import _groups

CUBE = moving(24)
FEW = 12
NOISY = CUBE[:FEW].astype("i4") + np.random.default_rng(2).integers(0, 40, CUBE.shape[1:], "i4")
ENTRY = 3  # groups, of two frames each
OPTIONS = dict(nodata=-9999, group=2, reference="all", entry=ENTRY)


@pytest.fixture(scope="module")
def sequence():
    return tetrakis.encode_sequence(CUBE, **OPTIONS)


@pytest.fixture(scope="module")
def lossy():
    """Of noise, so that what groups go on from matters; with a texture, and a reference that is
    part of a group."""
    texels = np.stack([np.roll(photograph(20, 24), t, 0) for t in range(FEW)])
    options = dict(OPTIONS, reference=300, bytes=900)
    return tetrakis.encode_sequence(NOISY, texels, **options)


@pytest.fixture
def small_reads(monkeypatch):
    monkeypatch.setattr(_groups, "_TAIL", 300)
    monkeypatch.setattr(_groups, "_HEAD", 300)


def heads_of(sequence):
    places, at = [], sequence.find(b"TKG\x1a")
    while at >= 0:
        places.append(at)
        at = sequence.find(b"TKG\x1a", at + 1)
    return places


def test_frames_are_those_of_the_source_in_any_order(sequence, small_reads):
    order = np.random.default_rng(1).permutation(len(CUBE))
    for source in (sequence, io.BytesIO(sequence)):
        with tetrakis.open_sequence(source) as opened:
            np.testing.assert_array_equal(opened, CUBE)
            np.testing.assert_array_equal(opened[::-5, 3:9, ::4], CUBE[::-5, 3:9, ::4])
            kept = [opened.frame(number) for number in order]
            for number, frame in zip(order, kept):
                np.testing.assert_array_equal(frame.heights(), CUBE[number])
                np.testing.assert_array_equal(frame.validity(), CUBE[number] != -9999)
            frame.verify()
    for number in order:  # the first that a sequence is asked for
        fresh = tetrakis.open_sequence(io.BytesIO(sequence))
        np.testing.assert_array_equal(fresh.frame(number).heights(), CUBE[number])


def test_what_stands_still_takes_next_to_no_bytes():
    still = np.repeat(CUBE[:1], 24, 0)
    by_itself = tetrakis.encode_sequence(still, nodata=-9999, group=2)
    assert len(tetrakis.encode_sequence(still, **OPTIONS)) < len(by_itself) / 2


def test_every_order_shows_the_same_of_lossy_groups(lossy):
    opened = tetrakis.open_sequence(lossy)

    def shown(frame):
        return frame.heights(), frame.texture(), frame.surface(1)

    forwards = [shown(frame) for frame in opened.frames()]
    for number in np.random.default_rng(5).permutation(FEW):
        frame = opened.frame(number)
        for samples, wanted in zip(shown(frame), forwards[number]):
            np.testing.assert_array_equal(samples, wanted)
        np.testing.assert_array_equal(frame.texture(1), opened.read("texture", number, 1))


def test_a_server_sends_the_groups_from_the_entry_on_once(small_reads):
    cube = np.random.default_rng(3).integers(0, 90, (80, 20, 30), "u1")
    coded = tetrakis.encode_sequence(cube, **dict(OPTIONS, entry=10, nodata=None))
    with Server(coded) as server, tetrakis.open_sequence(server.url) as opened:
        for number in (57, 9, 31):
            before = server.requests
            np.testing.assert_array_equal(opened.frame(number).heights(), cube[number])
            assert server.requests - before <= 4
        assert server.sent < 0.8 * len(coded)
        before = server.sent
        np.testing.assert_array_equal(opened[60:80], cube[60:80])
        assert server.sent - before < len(coded) / 2


def test_groups_without_those_that_they_go_on_from(sequence):
    begin = heads_of(sequence)
    for lost in (0, 1, 4):
        rest = sequence[: begin[lost]] + sequence[begin[lost + 1] :]
        damaged = bytearray(sequence)
        damaged[begin[lost] + 6] ^= 1
        end = lost + ENTRY - lost % ENTRY  # group that stands by itself again
        opened = tetrakis.open_sequence(rest)
        for group in range(lost + 1, end):
            for number in (2 * group, 2 * group + 1):
                with pytest.raises(tetrakis.TksTruncatedError, match="goes on from group"):
                    opened.frame(number).heights()
        good = [*range(2 * lost), *range(2 * end, len(CUBE))]
        for number in np.random.default_rng(lost).permutation(good):
            np.testing.assert_array_equal(opened.frame(number).heights(), CUBE[number])
        if lost:
            file = tetrakis.open_sequence(io.BytesIO(bytes(damaged)))
            with pytest.raises(tetrakis.TksError):
                file.frame(2 * lost + 2)
            np.testing.assert_array_equal(file.frame(2 * end).heights(), CUBE[2 * end])


def test_a_live_sequence_keeps_what_its_groups_go_on_from():
    received = tetrakis.open_sequence(b"")
    with tetrakis.SequenceEncoder(**OPTIONS) as encoder:
        for frame in CUBE:
            encoder.push(frame)
            part = encoder.take()
            for at in range(0, len(part), 150):
                received.append(part[at : at + 150])
                if len(received):  # a cut group shows what it has
                    received.frame(received.first_frame + len(received) - 1).heights()
            end = received.first_frame + len(received)
            for number in range(received.first_frame, end):
                np.testing.assert_array_equal(received.frame(number).heights(), CUBE[number])
            received.forget(end)
            assert len(received) <= 2 * ENTRY
    assert received.first_frame == 2 * 9
    again = pickle.loads(pickle.dumps((received, received.frame(23))))
    for thing in (again[0].frame(23), again[1]):
        np.testing.assert_array_equal(thing.heights(), CUBE[23])


def test_prefixes_of_a_group(lossy):
    opened = tetrakis.open_sequence(lossy)
    frame = opened.frame(5)
    whole = frame.info.stream_bytes
    np.testing.assert_array_equal(frame.heights(bytes=whole), frame.heights())
    cut = frame.describe(bytes=whole // 2)
    assert cut.available_bytes == whole // 2 < frame.info.available_bytes
    assert frame.heights(bytes=whole // 2).shape == frame.shape
    with pytest.raises(tetrakis.TksTruncatedError, match="header"):
        frame.heights(bytes=20)
    for length in range(len(lossy) // 3, len(lossy), 577):
        short = tetrakis.open_sequence(lossy[:length])
        for number in (0, len(short) - 1):
            assert short.frame(number).heights().shape == frame.shape


def test_bytes_that_mean_harm(lossy):
    for at in range(0, len(lossy) // 3, 61):
        bad = bytearray(lossy)
        bad[at] ^= 0x24
        try:
            opened = tetrakis.open_sequence(io.BytesIO(bytes(bad)))
            for number in (4, 7, 1):
                opened.frame(number).heights()
        except tetrakis.TksError:
            pass


def test_threads_share_groups(sequence):
    numbers = list(np.random.default_rng(8).permutation(len(CUBE))) * 2
    with tetrakis.open_sequence(sequence) as opened, ThreadPoolExecutor(4) as threads:
        for number, frame in zip(numbers, threads.map(opened.__getitem__, numbers)):
            np.testing.assert_array_equal(frame, CUBE[number])


@pytest.mark.parametrize("first", [1, 6, 7, 13])
@pytest.mark.parametrize("reference", [None, "all"])
def test_files_grow_at_their_end(tmp_path, first, reference):
    options = dict(OPTIONS, reference=reference, entry=reference and ENTRY)
    path = tmp_path / "a.tks"
    hours = np.datetime64("2019-03-01T00") + np.arange(len(CUBE))
    clock = "hours since 2019-03-01"
    tetrakis.encode_sequence(CUBE[:first], path=path, times=hours[:first], clock=clock, **options)
    before = path.read_bytes()
    tetrakis.encode_sequence(CUBE[first:20], path=path, append=True, **options)
    rest = dict(times=hours[20:], append=True, **options)
    tetrakis.encode_sequence(iter(CUBE[20:]), path=str(path), **rest)
    assert path.read_bytes()[: len(before)] == before
    with tetrakis.open_sequence(path) as opened:
        np.testing.assert_array_equal(opened, CUBE)
        np.testing.assert_array_equal(opened.times, hours)
        assert opened.find(hours[9]) == 9


def test_what_a_file_had_stays(tmp_path, sequence):
    path = tmp_path / "a.tks"
    with pytest.raises(tetrakis.TksUsageError, match="path of a file"):
        tetrakis.encode_sequence(CUBE, append=True, **OPTIONS)
    tetrakis.encode_sequence(CUBE, path=path, append=True, **OPTIONS)
    assert path.read_bytes() == sequence

    def frames():
        yield from CUBE[:5]
        raise LookupError

    cut = sequence[:-9]
    for had in (sequence, cut):
        for wrong in (frames(), CUBE[:, :9], CUBE[:0]):
            path.write_bytes(had)
            with pytest.raises((LookupError, tetrakis.TksUsageError)):
                tetrakis.encode_sequence(wrong, path=path, append=True, **OPTIONS)
            assert path.read_bytes() == had
    with pytest.raises(tetrakis.TksUsageError, match="another clock"):
        tetrakis.encode_sequence(CUBE, path=path, append=True, clock=3, **OPTIONS)
    with pytest.raises(tetrakis.TksUsageError, match="later"):
        tetrakis.encode_sequence(CUBE[:1], path=path, times=[3], append=True, **OPTIONS)
    assert path.read_bytes() == cut
    tetrakis.encode_sequence(CUBE[22:], path=path, append=True, **OPTIONS)
    with tetrakis.open_sequence(path) as opened:
        np.testing.assert_array_equal(opened, CUBE)
    path.write_bytes(b"GIF89a and more")
    with pytest.raises(tetrakis.TksCorruptError):
        tetrakis.encode_sequence(CUBE, path=path, append=True, **OPTIONS)


def test_an_encoder_follows_bytes(sequence):
    with tetrakis.SequenceEncoder(**OPTIONS) as encoder:
        encoder.follow(sequence)
        encoder.push(CUBE[3])
        with pytest.raises(tetrakis.TksUsageError):
            encoder.follow(sequence)
        encoder.flush()
        opened = tetrakis.open_sequence(sequence + encoder.take())
    np.testing.assert_array_equal(opened[24], CUBE[3])
    assert opened.ticks[-1] == 24
    with tetrakis.SequenceEncoder(**OPTIONS) as encoder:
        with pytest.raises(tetrakis.TksUsageError, match="inside a group"):
            encoder.follow(sequence[:-1])


def test_thinner_channels(lossy):
    opened = tetrakis.open_sequence(lossy)
    assert opened.thinned(2**40) == lossy
    before = len(lossy)
    for rate in (700, 400, 1):
        thin = opened.thinned(rate)
        assert len(thin) < before
        before = len(thin)
        less = tetrakis.open_sequence(io.BytesIO(thin))
        assert len(less) == len(opened)
        error = [np.square(s[5].astype(float) - NOISY[5]).mean() for s in (opened, less)]
        assert 0 < error[0] <= error[1]
    assert error[0] < error[1]
    np.testing.assert_array_equal(less.ticks, opened.ticks)
    with pytest.raises(tetrakis.TksUsageError, match="no whole group"):
        tetrakis.open_sequence(lossy[:300]).thinned(500)
    opened.forget(9)
    with pytest.raises(tetrakis.TksUsageError):
        opened.thinned(500)


@pytest.mark.parametrize("arguments, sentence", [
    (dict(reference=0), "reference"), (dict(reference="some"), "reference"),
    (dict(reference=-1), "reference"), (dict(entry=4), "give reference"),
    (dict(reference=5, entry=65), "64"),
])  # fmt: skip
def test_what_makes_no_sense_is_told(arguments, sentence):
    with pytest.raises(tetrakis.TksUsageError, match=sentence):
        tetrakis.encode_sequence(CUBE, **arguments)
