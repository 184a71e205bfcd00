# SPDX-License-Identifier: Apache-2.0
"""Frames become sequences, and sequences frames: arrays, iterators, live sources."""

import io
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import SAMPLES, moving, photograph, terrain

import tetrakis

CUBE = moving()


@pytest.fixture(scope="module")
def sequence():
    return tetrakis.encode_sequence(CUBE, nodata=-9999, group=8, unit="m", crs="EPSG:32611")


@pytest.mark.parametrize("dtype", SAMPLES)
def test_arrays_come_back(dtype):
    cube = np.stack([terrain(20, 24, dtype, seed) for seed in range(5)])
    with tetrakis.open_sequence(tetrakis.encode_sequence(cube, group=3)) as opened:
        assert (opened.shape, opened.dtype, opened.ndim) == (cube.shape, cube.dtype, 3)
        np.testing.assert_array_equal(opened, cube)


@pytest.mark.parametrize("dtype", ["u1", "u2"])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_textures_come_back_beside_heights_and_alone(dtype, channels):
    texels = np.stack([np.roll(photograph(20, 24, channels, dtype), t, 0) for t in range(4)])
    for heights in (None, CUBE[:4]):
        with tetrakis.open_sequence(tetrakis.encode_sequence(heights, texels)) as opened:
            for t in range(4):
                np.testing.assert_array_equal(opened.frame(t).texture(), texels[t])
            np.testing.assert_array_equal(opened.read("texture", np.s_[1:3, 4:9]), texels[1:3, 4:9])
            assert opened.shape == (texels if heights is None else heights).shape


KEYS = [np.s_[5], np.s_[-1, 3], np.s_[:, 10, 20], np.s_[2:19:4], np.s_[::-3, 4:9, ::5], np.s_[...],
        np.s_[..., 7], np.s_[4:4], np.s_[9:3], np.s_[2:9, 3:3], np.s_[20:99]]  # fmt: skip


@pytest.mark.parametrize("key", KEYS, ids=str)
def test_an_index_gives_what_it_gives_of_the_array(sequence, key):
    with tetrakis.open_sequence(sequence) as opened:
        np.testing.assert_array_equal(opened[key], CUBE[key])


def test_frames_are_streams(sequence):
    with tetrakis.open_sequence(sequence) as opened:
        assert len(list(opened.frames())) == len(opened) == len(CUBE)
        for frame, heights, samples in zip(opened.frames(), CUBE, opened):
            np.testing.assert_array_equal(frame.heights(), heights)
            np.testing.assert_array_equal(samples, heights)
            np.testing.assert_array_equal(frame.validity(), heights != -9999)
            np.testing.assert_array_equal(frame[3:9, ::4], heights[3:9, ::4])
            alone = tetrakis.open(tetrakis.encode(heights, nodata=-9999))
            np.testing.assert_array_equal(frame.heights(masked=True).mask, heights == -9999)
            assert frame.info.crs == "EPSG:32611" and frame.info.frames in (8, 5)
            assert frame.heights(level=1).shape == alone.heights(level=1).shape
            assert len(frame.mesh(50).triangles) > 10
        kept = opened.frame(20)
    np.testing.assert_array_equal(kept.heights(), CUBE[20])
    for read in (lambda: opened[0], lambda: opened.frame(0), opened.__enter__):
        with pytest.raises(tetrakis.TksUsageError, match="closed"):
            read()


def test_what_is_not_there(sequence):
    opened = tetrakis.open_sequence(sequence)
    for wrong in (21, 2**63, -1, 1.5):
        with pytest.raises(tetrakis.TksUsageError):
            opened.frame(wrong)
    with pytest.raises(IndexError):
        opened[21]
    with pytest.raises(tetrakis.TksUsageError, match="in memory"):
        tetrakis.open_sequence(io.BytesIO(sequence)).append(b"")
    with pytest.raises(tetrakis.TksUnsupportedError, match="open_sequence"):
        tetrakis.open(sequence)


def test_single_streams_open():
    one = tetrakis.open_sequence(tetrakis.encode(CUBE[0]))
    assert one.shape == (1, 30, 35) and not one.is_moving and one.times.tolist() == [0]
    np.testing.assert_array_equal(one[0], CUBE[0])


def stream_of(sequence):
    """That of the first group."""
    begin = sequence.index(b"TKS\x1a")
    return sequence[begin:]


def test_a_stream_of_frames_opens(sequence):
    first = stream_of(tetrakis.encode_sequence(CUBE[:6], nodata=-9999, seekable=False))
    opened = tetrakis.open_sequence(first)
    assert opened.is_moving and opened.times.tolist() == list(range(6))
    np.testing.assert_array_equal(opened, CUBE[:6])
    np.testing.assert_array_equal(tetrakis.open(first).heights(), CUBE[0])


def test_targets():
    cube = np.stack([terrain(40, 50, seed=seed) for seed in range(6)])
    within = tetrakis.open_sequence(tetrakis.encode_sequence(cube, max_error=3.0))
    assert 0 < np.abs(np.asarray(within) - cube).max() <= 3
    small = tetrakis.encode_sequence(cube, bytes=500)
    assert 2000 < len(small) <= 6 * 500
    near = tetrakis.open_sequence(tetrakis.encode_sequence(cube, psnr=50))
    mean = np.sqrt(np.square(np.asarray(near) - cube).mean())
    assert 20 * np.log10(np.ptp(cube) / mean) > 49.9
    with pytest.raises(tetrakis.TksUsageError, match="one target"):
        tetrakis.encode_sequence(cube, psnr=50, bytes=500)


def test_frames_come_from_anywhere(sequence, tmp_path):
    options = dict(nodata=-9999, group=8, unit="m", crs="EPSG:32611")
    counts = []
    for frames in (list(CUBE), iter(CUBE), (frame.tolist() for frame in CUBE.astype("i4"))):
        coded = tetrakis.encode_sequence(frames, progress=counts.append, **options)
        np.testing.assert_array_equal(tetrakis.open_sequence(coded), CUBE)
    assert counts == 3 * list(range(1, 22))
    path = tmp_path / "a.tks"
    assert tetrakis.encode_sequence(CUBE, path=path, **options) is None
    assert path.read_bytes() == sequence
    file = io.BytesIO(b"before")
    file.seek(6)
    tetrakis.encode_sequence(CUBE, path=file, **options)
    assert file.getvalue() == b"before" + sequence


def test_memory_is_that_of_a_group():
    """Frames that were taken are not needed again."""
    alive = []

    def frames():
        for frame in CUBE:
            yield frame.copy()
            alive.append(len(file.getvalue()))

    file = io.BytesIO()
    tetrakis.encode_sequence(frames(), path=file, group=4)
    assert alive[0] == 0 < alive[5] < alive[-1]


def test_a_failure_leaves_no_file(tmp_path):
    path = tmp_path / "a.tks"
    path.write_bytes(b"before")

    def frames():
        yield from CUBE[:9]
        raise LookupError

    with pytest.raises(LookupError):
        tetrakis.encode_sequence(frames(), path=path, group=4)

    def stop(count):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tetrakis.encode_sequence(CUBE, path=path, progress=stop)
    assert [file.name for file in tmp_path.iterdir()] == ["a.tks"]
    assert path.read_bytes() == b"before"


def test_voids_of_masks_and_of_nan():
    hidden = CUBE == -9999
    masked = np.ma.masked_where(hidden, CUBE)
    opened = tetrakis.open_sequence(tetrakis.encode_sequence(masked, nodata=-1))
    np.testing.assert_array_equal(opened, np.where(hidden, -1, CUBE))
    with pytest.raises(tetrakis.TksUsageError, match="give nodata"):
        tetrakis.encode_sequence(masked)
    floats = np.where(hidden, np.nan, CUBE).astype("f4")
    np.testing.assert_array_equal(tetrakis.open_sequence(tetrakis.encode_sequence(floats)), floats)
    opened = tetrakis.open_sequence(tetrakis.encode_sequence(CUBE[3:], nodata="auto"))
    assert opened.info.nodata == -9999 and not opened.frame(0).validity().all()
    np.testing.assert_array_equal(opened, CUBE[3:])


WRONG = [
    (dict(heights=[CUBE[0], CUBE[1, 1:]]), "frame"),
    (dict(heights=[CUBE[0], CUBE[1].astype("f4")]), "frame"),
    (dict(heights=CUBE[0]), "rows, columns"),
    (dict(heights=CUBE, texture=photograph(30, 35)[None]), "as many"),
    (dict(heights=CUBE, times=range(20)), "as many"),
    (dict(heights=CUBE[:3], times=[0, 5, 5]), "later"),
    (dict(heights=CUBE[:0]), "one frame or more"),
    (dict(), "one frame or more"),
    (dict(heights=5), "one by one"),
    (dict(heights=CUBE, group=33), "32"),
    (dict(heights=CUBE, triangles=5), "triangles is not"),
    (dict(heights=CUBE, domain="cube"), "cube"),
    (dict(heights=CUBE, progress=5), "progress must"),
    (dict(heights=CUBE, bytes=3), "bytes"),
]


@pytest.mark.parametrize("arguments, sentence", WRONG)
def test_what_makes_no_sense_is_told(arguments, sentence):
    with pytest.raises(tetrakis.TksUsageError, match=sentence):
        tetrakis.encode_sequence(**arguments)


def test_unknown_options():
    with pytest.raises(TypeError, match="qsnr"):
        tetrakis.encode_sequence(CUBE, qsnr=5)


def test_a_live_sequence(sequence):
    received = tetrakis.open_sequence(b"")
    assert len(received) == 0 and list(received) == [] and received.shape == (0,)
    with tetrakis.SequenceEncoder(clock=1 / 25, nodata=-9999, group=4) as encoder:
        for number, frame in enumerate(CUBE):
            encoder.push(frame)
            part = encoder.take()
            assert bool(part) == (number % 4 == 3)
            for at in range(0, len(part), 200):
                received.append(part[at : at + 200])
            end = number + 1 - (number + 1) % 4
            assert received.first_frame + len(received) == end
            for number in range(received.first_frame, end):
                np.testing.assert_array_equal(received.frame(number).heights(), CUBE[number])
            received.forget(max(0, end - 2))
            assert len(received) <= 8 and received.first_frame <= max(0, end - 4)
        encoder.flush()
        received.append(encoder.take())
        assert encoder.take() == b""
    np.testing.assert_array_equal(received.frame(20).heights(), CUBE[20])
    np.testing.assert_array_equal(received[-1], CUBE[20])
    assert received.ticks.tolist() == [16, 17, 18, 19, 20]
    with pytest.raises(tetrakis.TksUsageError, match="no frame"):
        received.frame(0)
    again = pickle.loads(pickle.dumps(received))
    np.testing.assert_array_equal(again.frame(20).heights(), CUBE[20])
    with pytest.raises(tetrakis.TksUsageError, match="closed"):
        encoder.push(CUBE[0])


def test_every_prefix_shows_what_it_has(sequence):
    whole = tetrakis.open_sequence(sequence)
    before = 0
    for length in range(0, len(sequence), 97):
        cut = tetrakis.open_sequence(sequence[:length])
        assert len(cut) >= before
        before = len(cut)
        if before:
            assert cut.frame(before - 1).heights().shape == (30, 35)
            np.testing.assert_array_equal(cut.times, whole.times[:before])
            complete = [frame.info for frame in cut.frames()]
            for i in range(before - 8):
                assert complete[i].available_bytes == complete[i].stream_bytes
    assert before == len(CUBE)


def test_bytes_that_mean_harm(sequence):
    for at in range(0, len(sequence), 53):
        bad = bytearray(sequence)
        bad[at] ^= 0x24
        try:
            opened = tetrakis.open_sequence(bytes(bad))
            for frame in opened.frames():
                frame.heights()
            opened.times
        except tetrakis.TksError:
            pass
    for nothing in (b"GIF89a and more", b"TKG\x1a\x07" + sequence[5:], sequence[:40] + b"x" * 80):
        with pytest.raises(tetrakis.TksError):
            tetrakis.open_sequence(nothing)[0]


def test_groups_of_another_size_are_no_frames_of_this_sequence(sequence):
    other = tetrakis.encode_sequence(moving(17, 31, 35), times=range(100, 117), group=8)
    begin = other.index(b"TKG\x1a", 5)
    received = tetrakis.open_sequence(tetrakis.encode_sequence(CUBE[:8], group=8) + other[begin:])
    assert len(received) == 17
    with pytest.raises(tetrakis.TksUnsupportedError, match="not alike"):
        received[8]


def test_threads_share_a_sequence(sequence):
    with tetrakis.open_sequence(sequence) as opened, ThreadPoolExecutor(4) as threads:
        numbers = list(range(21)) * 3
        for number, frame in zip(numbers, threads.map(opened.__getitem__, numbers)):
            np.testing.assert_array_equal(frame, CUBE[number])
