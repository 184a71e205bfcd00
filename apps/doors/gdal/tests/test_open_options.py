# SPDX-License-Identifier: Apache-2.0
"""BYTES, STRICT, NUM_THREADS; prefixes, damaged and foreign files; files over HTTP."""

import contextlib
import http.server
import re
import threading

import numpy as np
import pytest
from conftest import REPOSITORY, copy, gdal, means_over, memory, refused, terrain

VECTORS = sorted((REPOSITORY / "conformance/vectors").glob("*.tks"))


def opened(name, *options):
    flags = gdal.OF_RASTER | gdal.OF_VERBOSE_ERROR
    return gdal.OpenEx(str(name), flags, open_options=list(options))


@pytest.fixture(scope="module")
def stream(tmp_path_factory):
    name = tmp_path_factory.mktemp("stream") / "a.tks"
    copy(terrain(dtype="i2"), name, "BLOCKSIZE=128", "INDEX=NO")
    return name


def test_bytes(stream, tmp_path):
    size = stream.stat().st_size
    errors = []
    for share in (50, 8, 2):
        limit = size // share
        rough = opened(stream, f"BYTES={limit}")
        assert rough.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSY"
        heights = rough.ReadAsArray().astype(float)
        errors.append(np.sqrt(np.mean((heights - terrain(dtype="i2")) ** 2)))
        cut = tmp_path / "cut.tks"
        cut.write_bytes(stream.read_bytes()[:limit])
        np.testing.assert_array_equal(opened(cut).ReadAsArray(), heights)
    assert errors[0] > errors[1] > errors[2] > 0
    whole = opened(stream, f"BYTES={2 * size}").ReadAsArray()
    np.testing.assert_array_equal(whole, terrain(dtype="i2"))
    refused(lambda: opened(stream, "BYTES=20"), "bytes")
    for wrong in ("0", "-5", "many", "1.5", ""):
        refused(lambda wrong=wrong: opened(stream, f"BYTES={wrong}"), "no number of bytes")


@pytest.mark.parametrize("index", ["YES", "WINDOWS"])
def test_bytes_beside_an_index(tmp_path, index):
    """However long an index is, few bytes show something: those behind the header count."""
    name = tmp_path / "a.tks"
    copy(terrain(dtype="i2"), name, "BLOCKSIZE=16", f"INDEX={index}")
    data = name.read_bytes()
    with pytest.raises(RuntimeError) as short:
        gdal.FileFromMemBuffer("/vsimem/short.tks", data[:20])
        opened("/vsimem/short.tks")
    header = int(re.search(r"at least (\d+) bytes", str(short.value)).group(1))
    assert header > 4000
    errors = []
    for count in (100, 1000, 4000, len(data) // 2):
        rough = opened(name, f"BYTES={count}")
        heights = rough.ReadAsArray().astype(float)
        errors.append(np.sqrt(np.mean((heights - terrain(dtype="i2")) ** 2)))
        cut = tmp_path / "cut.tks"
        cut.write_bytes(data[: header + count])
        np.testing.assert_array_equal(opened(cut).ReadAsArray(), heights)
    assert errors == sorted(errors, reverse=True) and errors[0] > errors[-1] > 0
    whole = opened(name, f"BYTES={len(data)}").ReadAsArray()
    np.testing.assert_array_equal(whole, terrain(dtype="i2"))


def test_strict(stream, tmp_path):
    whole = stream.read_bytes()
    np.testing.assert_array_equal(opened(stream, "STRICT=YES").ReadAsArray(), terrain(dtype="i2"))
    cut = tmp_path / "cut.tks"
    cut.write_bytes(whole[:-1])
    refused(lambda: opened(cut, "STRICT=YES"), f"{len(whole) - 1} of {len(whole)} bytes")
    assert opened(cut, "STRICT=NO").ReadAsArray().shape == (300, 340)
    for wrong in ("maybe", "", "2", "yess"):
        refused(lambda wrong=wrong: opened(stream, f"STRICT={wrong}"), f"STRICT={wrong} is neither")
    refused(lambda: opened(stream, "STRICT=YES", "BYTES=4000"), "exclude each other")


def test_num_threads(stream):
    for threads in ("1", "3", "ALL_CPUS"):
        dataset = opened(stream, "NUM_THREADS=" + threads)
        np.testing.assert_array_equal(dataset.ReadAsArray(), terrain(dtype="i2"))
    refused(lambda: opened(stream, "NUM_THREADS=none"), "NUM_THREADS=none")


@pytest.mark.parametrize("threads", ["0", "-1", "some", "", "99999999999"])
def test_a_setting_of_threads_that_other_drivers_take(stream, tmp_path, threads):
    """It is for all of GDAL, so that it closes no file."""
    with _Options({"GDAL_NUM_THREADS": threads}):
        np.testing.assert_array_equal(opened(stream).ReadAsArray(), terrain(dtype="i2"))
        copy(terrain(20, 30), tmp_path / "a.tks")


@pytest.mark.parametrize("vector", VECTORS, ids=lambda path: path.stem)
def test_vectors_read_or_are_refused(vector, tmp_path):
    """Streams of every kind, and damaged ones: as a whole, cut, and with a byte that is wrong."""
    whole = vector.read_bytes()
    rng = np.random.default_rng(len(whole))
    variants = [whole, whole[: len(whole) // 2], whole[:9], whole[:4]]
    for at in rng.integers(0, len(whole), 4):
        damaged = bytearray(whole)
        damaged[at] ^= 1 << int(rng.integers(0, 8))
        variants.append(bytes(damaged))
    for number, data in enumerate(variants):
        name = f"/vsimem/{vector.stem}_{number}.tks"
        gdal.FileFromMemBuffer(name, data)
        try:
            for part in ("heights", "texture"):
                dataset = gdal.Open(f'TKS:"{name}":{part}')
                for i in range(1, dataset.RasterCount + 1):
                    dataset.GetRasterBand(i).Checksum()
                assert dataset.ReadAsArray(0, 0, 1, 1) is not None
        except RuntimeError as error:
            assert str(error).rstrip().endswith("."), error
        finally:
            gdal.Unlink(name)
    assert number == 7


def test_a_sketch_is_read_until_the_header_is_there(tmp_path):
    whole = REPOSITORY / "conformance/vectors/sketch_33x33.tks"
    cut = tmp_path / "cut.tks"
    cut.write_bytes(whole.read_bytes()[:100])
    assert opened(whole).RasterXSize == 33
    for dataset in (opened(cut), opened(whole, "BYTES=100")):
        assert dataset.RasterXSize == 9
        assert dataset.ReadAsArray().shape == (9, 9)
    refused(lambda: opened(whole, "BYTES=40"), "BYTES ends inside the header, which takes 48 bytes.")


def test_foreign_files(tmp_path):
    for data in (b"", b"TKS", b"TKS\x1a", b"GIF89a" + bytes(100), b"TKS\x1b" + bytes(99)):
        name = tmp_path / "foreign.tks"
        name.write_bytes(data)
        with pytest.raises(RuntimeError):
            gdal.Open(str(name))
    refused(lambda: gdal.Open(f'TKS:"{tmp_path}/foreign.tks":heights'), "foreign.tks")
    refused(lambda: gdal.Open(f'TKS:"{tmp_path}/nowhere.tks":heights'), "cannot be opened")
    assert gdal.IdentifyDriver(str(VECTORS[0])).ShortName == "TKS"


def test_a_file_that_shrinks(stream, tmp_path):
    name = tmp_path / "shrinks.tks"
    name.write_bytes(stream.read_bytes())
    dataset = gdal.Open(str(name))
    name.write_bytes(stream.read_bytes()[:20000])
    refused(dataset.ReadAsArray, "cannot be read")


class Server(http.server.BaseHTTPRequestHandler):
    """Serves one file by ranges, and notes which."""

    data, ranges = b"", []

    def do_HEAD(self):
        self.send_response(200)
        self.send_header("Content-Length", str(len(self.data)))
        self.send_header("Accept-Ranges", "bytes")
        self.end_headers()

    def do_GET(self):
        asked = re.match(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        first, last = (int(asked[1]), int(asked[2])) if asked else (0, len(self.data) - 1)
        part = self.data[first : last + 1]
        self.ranges.append((first, first + len(part)))
        self.send_response(206 if asked else 200)
        self.send_header("Content-Length", str(len(part)))
        self.send_header("Content-Range", f"bytes {first}-{first + len(part) - 1}/{len(self.data)}")
        self.end_headers()
        self.wfile.write(part)

    def log_message(self, *_):
        pass


class Listening(http.server.ThreadingHTTPServer):
    request_queue_size = 128  # ranges are asked for side by side


@contextlib.contextmanager
def served(name):
    Server.data, Server.ranges = name.read_bytes(), []
    listening = Listening(("127.0.0.1", 0), Server)
    threading.Thread(target=listening.serve_forever, daemon=True).start()
    options = {"GDAL_DISABLE_READDIR_ON_OPEN": "EMPTY_DIR", "GDAL_HTTP_PROXY": "", "NO_PROXY": "*"}
    with _Options(options):
        yield f"/vsicurl/http://127.0.0.1:{listening.server_port}/a.tks"
    listening.shutdown()
    listening.server_close()
    gdal.VSICurlClearCache()


@pytest.fixture
def server(tmp_path, request):
    copy(terrain(1500, 1400, "u2"), tmp_path / "a.tks", *getattr(request, "param", ["INDEX=NO"]))
    with served(tmp_path / "a.tks") as url:
        yield url


class _Options:
    """gdal.config_options, which GDAL 3.6 lacks."""

    def __init__(self, options):
        self.options = options

    def __enter__(self):
        self.before = {key: gdal.GetConfigOption(key) for key in self.options}
        for key, value in self.options.items():
            gdal.SetConfigOption(key, value)

    def __exit__(self, *_):
        for key, value in self.before.items():
            gdal.SetConfigOption(key, value)


def test_vsicurl_reads_only_what_it_needs(server):
    heights = terrain(1500, 1400, "u2")
    dataset = opened(server)
    assert dataset.RasterXSize == 1400
    assert max(last for _, last in Server.ranges) <= 16384, Server.ranges  # the header
    rough = opened(server, "BYTES=65536")
    assert rough.ReadAsArray().shape == (1500, 1400)
    assert max(last for _, last in Server.ranges) <= 65536, Server.ranges
    overview = dataset.GetRasterBand(1).GetOverview(2).ReadAsArray()
    taken = max(last for _, last in Server.ranges)
    assert taken <= 65536 + 188 * 175 * 2 + 16384 < len(Server.data) // 5, taken
    off = overview - means_over(heights, 188, 175)
    assert np.sqrt(np.mean(off**2)) < 0.005 * 65536
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)
    assert len(Server.ranges) <= 5, Server.ranges
    # What an overview shows does not depend on what was read before.
    np.testing.assert_array_equal(dataset.GetRasterBand(1).GetOverview(2).ReadAsArray(), overview)


@pytest.mark.parametrize("server", [["INDEX=YES", "BLOCKSIZE=128"]], indirect=True)
def test_vsicurl_windows_of_an_indexed_stream(server):
    heights = terrain(1500, 1400, "u2")
    dataset = opened(server)
    taken = []
    for x, y, columns, rows in [(650, 660, 100, 80), (0, 0, 1, 1)]:
        Server.ranges.clear()
        window = dataset.ReadAsArray(x, y, columns, rows)
        np.testing.assert_array_equal(window, heights[y : y + rows, x : x + columns])
        taken.append(sum(last - first for first, last in Server.ranges))
        assert len(Server.ranges) <= 65, Server.ranges
    assert 0 < sum(taken) < 0.6 * len(Server.data), (taken, len(Server.data))
    Server.ranges.clear()
    np.testing.assert_array_equal(dataset.ReadAsArray(660, 670, 50, 40), heights[670:710, 660:710])
    assert not Server.ranges  # these bytes are there
    overview = dataset.GetRasterBand(1).GetOverview(2).ReadAsArray()
    # All of it; what was read by ranges is what the file holds.
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)
    np.testing.assert_array_equal(dataset.GetRasterBand(1).GetOverview(2).ReadAsArray(), overview)


@pytest.mark.parametrize("server", [["INDEX=WINDOWS", "BLOCKSIZE=128"]], indirect=True)
def test_vsicurl_windows_of_a_stream_made_for_them(server):
    heights = terrain(1500, 1400, "u2")
    dataset = opened(server)
    window = dataset.ReadAsArray(650, 660, 100, 80)
    np.testing.assert_array_equal(window, heights[660:740, 650:750])
    assert len(Server.ranges) <= 8, Server.ranges
    assert sum(last - first for first, last in Server.ranges) < 0.3 * len(Server.data)
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)


def test_overviews_of_a_stream_for_windows(tmp_path):
    """Its first bytes show some regions and not others, so that they are no overview."""
    random = np.random.default_rng(1)
    means = random.integers(0, 1000, (150, 160))
    heights = (np.kron(means, np.ones((4, 4))) + random.integers(-32, 33, (600, 640))).astype("i2")
    for index, side in [("YES", 32), ("WINDOWS", 32), ("WINDOWS", 16)]:
        copy(heights, tmp_path / "a.tks", f"BLOCKSIZE={side}", "INDEX=" + index)
        dataset = opened(tmp_path / "a.tks")
        overview = dataset.GetRasterBand(1).GetOverview(1).ReadAsArray()
        assert np.sqrt(np.mean((overview - means) ** 2)) < 100  # of missing regions 290
        again = opened(tmp_path / "a.tks")
        np.testing.assert_array_equal(again.ReadAsArray(), heights)
        np.testing.assert_array_equal(
            again.GetRasterBand(1).GetOverview(1).ReadAsArray(), overview
        )


def test_a_coarse_overview_of_a_stream_for_windows_reads_no_fine_regions(tmp_path):
    heights = terrain(200, 2100, "u1").astype("i4")
    copy(heights, tmp_path / "a.tks", "BLOCKSIZE=32", "INDEX=WINDOWS")
    with served(tmp_path / "a.tks") as url:
        dataset = opened(url)
        dataset.GetRasterBand(1).GetOverview(3).ReadAsArray()
        assert sum(last - first for first, last in Server.ranges) < len(Server.data) // 2


def test_windows_of_an_indexed_file(tmp_path):
    """Heights and texture, by windows and as a whole: ranges give what the whole file gives."""
    heights = terrain(700, 600, "i2")
    image = memory(np.stack([terrain(500, 520, "u1", seed) for seed in range(3)]))
    gdal.GetDriverByName("GTiff").CreateCopy(str(tmp_path / "image.tif"), image)
    options = ["BLOCKSIZE=32", f"TEXTURE={tmp_path}/image.tif", "BYTES=120000"]
    names = {}
    for index in ("YES", "NO"):
        names[index] = tmp_path / f"{index}.tks"
        copy(heights, names[index], "INDEX=" + index, *options)
    for part in ("heights", "texture"):
        for index in names:
            whole = opened(f'TKS:"{names[index]}":{part}').ReadAsArray()
            windows = opened(f'TKS:"{names[index]}":{part}')
            for x, y, columns, rows in [(0, 0, 40, 30), (300, 200, 90, 130), (519, 499, 1, 1)]:
                np.testing.assert_array_equal(
                    windows.ReadAsArray(x, y, columns, rows),
                    whole[..., y : y + rows, x : x + columns],
                )
