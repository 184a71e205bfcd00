# SPDX-License-Identifier: Apache-2.0
"""Prefixes, windows, levels, meshes; closed streams; bytes that mean harm."""

import io
import pickle
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import photograph, terrain

import tetrakis


def test_every_prefix_opens_or_says_what_it_lacks(stream):
    needed = tetrakis.open(stream).info.header_bytes
    for length in range(needed):
        with pytest.raises(tetrakis.TksTruncatedError):
            tetrakis.open(stream[:length])
    for length in [*range(needed, needed + 64), *range(needed + 64, len(stream), 61), len(stream)]:
        with tetrakis.open(stream[:length]) as prefix:
            assert prefix.info.available_bytes == length
            assert np.isfinite(prefix.heights()).all()
            assert prefix.texture().shape == prefix.info.texture_shape


def test_prefixes_can_be_taken_in_four_ways(stream, tmp_path):
    cut = tetrakis.truncate(stream, 2000)
    assert cut == stream[:2000]
    path = tmp_path / "a.tks"
    path.write_bytes(stream)
    wanted = tetrakis.open(cut).heights()
    for opened in (
        tetrakis.open(path, bytes=2000),
        tetrakis.open(str(path), bytes=2000),
        tetrakis.open(io.BytesIO(stream), bytes=2000),
        tetrakis.open(memoryview(stream), bytes=2000),
        tetrakis.open(bytearray(stream), bytes=2000),
    ):
        np.testing.assert_array_equal(opened.heights(), wanted)
    np.testing.assert_array_equal(tetrakis.open(stream).heights(bytes=2000), wanted)
    assert tetrakis.truncate(bytearray(stream), 10**9) == stream
    with pytest.raises(tetrakis.TksTruncatedError, match="needed"):
        tetrakis.truncate(stream, 10)


class ShortReads(io.RawIOBase):
    """Gives 100 bytes at most, as a pipe or a socket may."""

    def __init__(self, data):
        self._rest = data

    def readable(self):
        return True

    def readinto(self, buffer):
        part = self._rest[: min(100, len(buffer))]
        buffer[: len(part)] = part
        self._rest = self._rest[len(part) :]
        return len(part)


def test_files_that_give_less_than_they_are_asked_for(stream):
    for count in (2000, None, len(stream) + 9):
        wanted = tetrakis.open(stream, bytes=count).info
        assert tetrakis.open(ShortReads(stream), bytes=count).info == wanted
    spread = memoryview(np.repeat(np.frombuffer(stream, "u1"), 2))[::2]
    assert tetrakis.open(spread).info == tetrakis.open(stream).info
    closed = io.BytesIO(stream)
    closed.close()
    with pytest.raises(ValueError, match="closed"):
        tetrakis.open(closed)


def test_what_is_open_goes_to_other_processes(stream):
    opened = pickle.loads(pickle.dumps(tetrakis.open(stream)))
    np.testing.assert_array_equal(opened.heights(), tetrakis.open(stream).heights())
    with pytest.raises(tetrakis.TksCorruptError) as caught:
        tetrakis.open(b"GIF89a, or so")
    sent = pickle.loads(pickle.dumps(caught.value))
    assert sent.code == caught.value.code and str(sent) == str(caught.value)


def test_more_bytes_are_nearer(stream, heights):
    opened = tetrakis.open(stream)
    errors = [np.mean((opened.surface(bytes=n) - heights) ** 2) for n in (300, 1000, 2000, 4000)]
    assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize("regions", [1, 16])
def test_windows_equal_slices(regions):
    heights, texture = terrain(50, 60), photograph(55, 40)
    heights[:20, :30] = np.nan
    stream = tetrakis.open(tetrakis.encode(heights, texture, bytes=4000, regions=regions))
    for count in (700, 2000, None):
        whole, surface = stream.heights(bytes=count), stream.surface(bytes=count)
        valid, texels = stream.validity(bytes=count), stream.texture(bytes=count)
        for x, y, width, height in [(0, 0, 1, 1), (17, 9, 20, 30), (39, 49, 1, 1), (0, 0, 40, 50)]:
            window, part = (x, y, width, height), np.s_[y : y + height, x : x + width]
            for given in (window, part):
                taken = dict(window=given, bytes=count)
                np.testing.assert_array_equal(stream.heights(**taken), whole[part])
                np.testing.assert_array_equal(stream.surface(**taken), surface[part])
                np.testing.assert_array_equal(stream.validity(**taken), valid[part])
                np.testing.assert_array_equal(stream.texture(**taken), texels[part])
            masked = stream.heights(window=window, bytes=count, masked=True)
            np.testing.assert_array_equal(masked.mask, ~valid[part])


@pytest.mark.parametrize("index", [False, True, "windows"])
def test_index_comes_back(index):
    stream = tetrakis.encode(terrain(50, 60), index=index, regions=16)
    assert tetrakis.open(stream).info.index == index


def test_slices_mean_what_they_mean_to_numpy(stream):
    opened = tetrakis.open(stream)
    whole = opened.heights()
    for part in (np.s_[:, :], np.s_[-5:, 3:], np.s_[:10, :-50], np.s_[40:1000, 50:], np.s_[7:9]):
        np.testing.assert_array_equal(opened.heights(window=part), whole[part])


def test_windows_of_levels(heights, texture):
    voids = np.where(np.add.outer(np.arange(45), np.arange(59)) < 20, np.nan, heights)
    opened = tetrakis.open(tetrakis.encode(voids.astype("f4"), texture))
    part, taken = np.s_[2:9, 5:12], dict(level=1, window=np.s_[2:9, 5:12])
    for read in (opened.heights, opened.surface, opened.validity, opened.texture):
        np.testing.assert_array_equal(read(**taken), read(level=1)[part])
        with pytest.raises(tetrakis.TksUsageError, match="inside"):
            read(level=1, window=(0, 0, 45, 2))
    masked = opened.heights(**taken, masked=True)
    np.testing.assert_array_equal(masked.mask, ~opened.validity(**taken))
    out = np.empty((7, 7), "f4")
    assert opened.surface(**taken, out=out) is out


@pytest.mark.parametrize(
    "window",
    [
        (0, 0, 60, 1), (59, 0, 1, 1), (0, 0, 0, 5), (-1, 0, 2, 2), (2**32, 0, 1, 1), (1, 2, 3),
        (0.5, 0, 1, 1), 7, np.s_[5:5, :], np.s_[::2, :], (2**32 - 1, 2**32 - 1, 2, 2),
        np.s_[0.5:3], np.s_[:, "a":], np.s_[::0], np.s_[:: np.ones(2)],
    ],
)  # fmt: skip
def test_windows_outside_are_refused(stream, window):
    opened = tetrakis.open(stream)
    for read in (opened.heights, opened.surface, opened.validity):
        with pytest.raises(tetrakis.TksUsageError):
            read(window=window)


def test_levels(stream, heights):
    opened = tetrakis.open(stream)
    for level in range(opened.info.coarsest_level + 1):
        info = opened.describe(level)
        assert info.shape == tuple(-(-side // 2**level) for side in heights.shape)
        assert opened.heights(level).shape == opened.surface(level).shape == info.shape
        assert opened.validity(level).all()
        assert opened.info.shape == heights.shape
    assert opened.texture(2).shape == (10, 12, 3)
    for level in (opened.info.coarsest_level + 1, -1, 2**32, 1.5):
        with pytest.raises(tetrakis.TksUsageError):
            opened.heights(level)


def test_output_arrays(stream):
    opened = tetrakis.open(stream)
    out = np.empty(opened.info.shape, "f4")
    assert opened.heights(out=out) is out
    np.testing.assert_array_equal(out, opened.heights())
    read_only = out.copy()
    read_only.flags.writeable = False
    for wrong in (out[1:], out.astype("f8"), np.asfortranarray(out), read_only, [1]):
        with pytest.raises(tetrakis.TksUsageError, match="out must be"):
            opened.heights(out=wrong)


def faces_up(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, corner], :2] for corner in range(3))
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0] > 0).all()


def test_meshes(stream, heights):
    opened = tetrakis.open(stream)
    for budget in (2, 50, 500, None):
        vertices, triangles, uv = mesh = opened.mesh(budget)
        assert vertices.dtype == np.float64 and uv.dtype == np.float32
        assert triangles.dtype == np.uint32 and triangles.shape[1] == 3
        assert budget is None or len(triangles) <= max(budget, 6)
        assert len(uv) == len(vertices) > triangles.max()
        assert faces_up(mesh)
    rows, columns = heights.shape
    assert len(vertices) == heights.size
    x, y = vertices[:, 0] / 10, vertices[:, 1] / -10
    np.testing.assert_allclose(uv, np.stack([x / (columns - 1), y / (rows - 1)], 1), atol=1e-6)
    surface = opened.surface()
    seen = surface[y.round().astype(int), x.round().astype(int)]
    np.testing.assert_allclose(vertices[:, 2], seen)
    ground = opened.mesh(50, coordinates="crs")
    np.testing.assert_allclose(ground.vertices[:, :2] - opened.mesh(50).vertices[:, :2],
                               np.full((len(ground.vertices), 2), (400005.0, 3799995.0)))
    assert faces_up(ground)


def test_meshes_of_flipped_grids_face_up(heights):
    place = (0, 10, 0, 0, 0, 10)
    south_up = tetrakis.encode(heights, psnr=30, geotransform=place, spacing=10)
    with tetrakis.open(south_up) as opened:
        ground, local = opened.mesh(100, coordinates="crs"), opened.mesh(100)
        assert faces_up(ground) and faces_up(local)
        np.testing.assert_allclose(ground.vertices - local.vertices, [[5, 5, 0]] * len(local[0]))


def test_textures_with_a_place_of_their_own_meet_the_mesh(heights, texture):
    place = (100.0, 1, 0, 200, 0, -1)
    larger = (90.0, 2, 0, 210, 0, -2)
    stream = tetrakis.encode(
        heights, texture, bytes=3000, geotransform=place, texture_geotransform=larger
    )
    mesh = tetrakis.open(stream).mesh(50, coordinates="crs")
    u, v = (mesh.vertices[:, 0] - 90) / 2 / 48, (210 - mesh.vertices[:, 1]) / 2 / 40
    np.testing.assert_allclose(mesh.uv, np.stack([u, v], 1), rtol=1e-5)


@pytest.mark.parametrize(
    "crs, texture_crs, known",
    [
        ("EPSG:32611", "epsg:32611", True),
        ("esri:54030", "ESRI:54030", True),
        ("EPSG:32611+5773", "EPSG:32611", True),
        ("EPSG:32611", "EPSG:32612", False),
        ("my grid", "My Grid", False),
    ],
)
def test_textures_lie_by_their_place_where_the_crs_is_the_same(crs, texture_crs, known):
    """The texture covers the western half of the heights."""
    place = dict(geotransform=(0, 1, 0, 0, 0, -1), texture_geotransform=(0, 0.5, 0, 0, 0, -1))
    stream = tetrakis.encode(
        terrain(40, 40), photograph(40, 40), psnr=30, crs=crs, texture_crs=texture_crs, **place
    )
    mesh = tetrakis.open(stream).mesh(50)
    u = (mesh.vertices[:, 0] + 0.5) / 20 if known else mesh.vertices[:, 0] / 39
    np.testing.assert_allclose(mesh.uv[:, 0], u, rtol=1e-5)


def test_views_are_parts_of_the_mesh(stream):
    opened = tetrakis.open(stream)
    everything = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]]
    west = [[2 / 20, 0, 0, -1], [0, 2 / 45, 0, -1], [0, 0, 0, 0], [0, 0, 0, 1]]
    whole = opened.mesh(400)
    assert len(opened.mesh(400, everything).triangles) == len(whole.triangles)
    seen = opened.mesh(400, west)
    assert 0 < len(seen.triangles) < len(whole.triangles)
    places = {tuple(vertex) for vertex in whole.vertices}
    assert all(tuple(vertex) in places for vertex in seen.vertices)
    ragged, text = [[1], [2, 3]], np.full((4, 4), "1")
    for wrong in (np.full((4, 4), np.nan), np.eye(3), 1j * np.eye(4), text):
        with pytest.raises(tetrakis.TksUsageError, match="4 x 4"):
            opened.mesh(400, wrong)
    for wrong in ("top", ragged):
        with pytest.raises(tetrakis.TksUsageError, match="view"):
            opened.mesh(400, wrong)


def test_meshes_that_cannot_be(stream, heights):
    with pytest.raises(tetrakis.TksUsageError, match="one triangle"):
        tetrakis.open(stream).mesh(0)
    with pytest.raises(tetrakis.TksUsageError, match="one of"):
        tetrakis.open(stream).mesh(10, coordinates="utm")
    with pytest.raises(tetrakis.TksUsageError, match="where its heights lie"):
        tetrakis.open(tetrakis.encode(heights)).mesh(10, coordinates="crs")
    void = np.full((9, 9), np.nan, "f4")
    mesh = tetrakis.open(tetrakis.encode(void)).mesh()
    assert mesh.vertices.shape == (0, 3) and mesh.triangles.shape == (0, 3)
    assert mesh.uv.shape == (0, 2)


def test_missing_parts_are_refused(heights, texture):
    image = tetrakis.open(tetrakis.encode(texture=texture))
    bare = tetrakis.open(tetrakis.encode(heights))
    for read in (image.heights, image.surface, image.validity, image.mesh, bare.texture):
        with pytest.raises(tetrakis.TksUsageError, match="holds no"):
            read()
        with pytest.raises(tetrakis.TksUsageError, match="holds no"):
            read(3, (0, 0, 1, 1)) if read != image.mesh else read(3, coordinates="crs")


def test_closed_streams_say_so(stream):
    with tetrakis.open(stream) as opened:
        assert not opened.closed
    assert opened.closed and "closed" in repr(opened)
    calls = [opened.heights, opened.surface, opened.validity, opened.texture, opened.mesh]
    calls += [opened.describe, opened.verify, opened.__enter__, lambda: opened.info]
    for call in calls:
        with pytest.raises(ValueError, match="stream is closed") as raised:
            call()
        assert raised.value.code == tetrakis.Status.USAGE
    opened.close()


def test_verify(stream):
    tetrakis.open(stream).verify()
    with pytest.raises(tetrakis.TksTruncatedError):
        tetrakis.open(stream[:-1]).verify()


def test_sources_that_are_none(tmp_path, stream):
    for source in (None, 5, [1, 2], np.zeros((3, 3))[::2], io.StringIO("abc")):
        with pytest.raises(tetrakis.TksError):
            tetrakis.open(source)
    with pytest.raises(FileNotFoundError):
        tetrakis.open(tmp_path / "absent.tks")
    with pytest.raises(tetrakis.TksUsageError, match="no path"):
        tetrakis.open("a\0b")
    assert tetrakis.open(np.frombuffer(stream, "u1")).info.available_bytes == len(stream)


def read_all(data):
    """Decodes all that opens; whatever goes wrong must be a TksError."""
    try:
        with tetrakis.open(data, max_memory=64 << 20) as opened:
            if opened.info.shape:
                opened.heights(masked=True)
                opened.mesh(20)
            if opened.info.texture_shape:
                opened.texture()
    except tetrakis.TksError as error:
        assert error.code != tetrakis.Status.OK and str(error)
        return error.code
    return tetrakis.Status.OK


def test_hostile_bytes_raise_or_decode(stream):
    random = np.random.default_rng(3)
    codes = {read_all(b""), read_all(b"TKS\x1a"), read_all(random.bytes(500))}
    for _ in range(300):
        damaged = bytearray(stream[: random.integers(20, 1500)])
        for _ in range(random.integers(1, 4)):
            reach = 120 if random.random() < 0.7 else len(damaged)
            damaged[random.integers(0, min(reach, len(damaged)))] = random.integers(0, 256)
        codes.add(read_all(bytes(damaged)))
    assert tetrakis.Status.OK in codes and tetrakis.Status.CORRUPT in codes


def test_limits_come_before_arrays(stream):
    with pytest.raises(tetrakis.TksLimitError):
        tetrakis.open(stream, max_samples=100)
    with pytest.raises(tetrakis.TksLimitError):
        tetrakis.open(stream, max_texels=100)
    with pytest.raises(tetrakis.TksLimitError):
        tetrakis.open(stream, max_memory=50_000).heights()


def test_threads_share_a_stream(stream):
    opened = tetrakis.open(stream)
    wanted, texels = opened.heights(), opened.texture()

    def read(number):
        part = np.s_[number % 7 :, number % 5 :]
        np.testing.assert_array_equal(opened.heights(window=part), wanted[part])
        np.testing.assert_array_equal(opened.texture(), texels)
        assert opened.describe(number % 3).shape == opened.heights(number % 3).shape
        return len(opened.mesh(100).triangles)

    with ThreadPoolExecutor(8) as pool:
        assert len(set(pool.map(read, range(64)))) == 1
    several = tetrakis.open(stream, threads=4)
    np.testing.assert_array_equal(several.heights(), wanted)


def test_other_threads_run_during_a_call():
    """With the GIL held, this thread could not count while the other encodes."""
    heights = terrain(200, 200)
    done = threading.Event()

    def work():
        tetrakis.encode(heights, max_error=0.01)
        done.set()

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-4)
    try:
        worker = threading.Thread(target=work)
        worker.start()
        waits = 0
        while not done.wait(0.001):
            waits += 1
        worker.join()
    finally:
        sys.setswitchinterval(interval)
    assert waits > 5


def test_closing_during_calls_of_other_threads_is_safe(stream):
    opened = tetrakis.open(stream)

    def read(_):
        try:
            return opened.heights().shape
        except tetrakis.TksUsageError:
            return None

    with ThreadPoolExecutor(4) as pool:
        results = pool.map(read, range(40))
        opened.close()
        assert set(results) <= {(45, 59), None}


def test_info_is_a_value(stream):
    info = tetrakis.open(stream).info
    assert pickle.loads(pickle.dumps(info)) == info
    with pytest.raises(AttributeError):
        info.unit = "ft"
