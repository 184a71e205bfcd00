# SPDX-License-Identifier: Apache-2.0
"""Streams of several components: combined, listed, and shown one in the place of another."""

import io
import pickle

import numpy as np
import pytest
from conftest import REPOSITORY, photograph, terrain
from range_server import Server

import tetrakis

VECTORS = REPOSITORY / "conformance" / "vectors"
PLACE = dict(crs="EPSG:32611", geotransform=(4e5, 10, 0, 3.8e6, 0, -10))


@pytest.fixture(scope="module")
def parts():
    """Streams that join: heights with a texture, heights of another kind, and two textures."""
    voids = terrain(30, 44, "f4", 8)
    voids[3:9, 4:20] = np.nan
    return {
        "today": tetrakis.encode(terrain(), photograph(), unit="m", **PLACE),
        "2019": tetrakis.encode(
            voids, unit="ft", nodata=-1, scale=0.5, crs="EPSG:32633",
            geotransform=(5e5, 20, 0, 4e6, 0, -20), registration="point",
        ),
        "normal": tetrakis.encode(texture=photograph(20, 24), psnr=40),
        "classes": tetrakis.encode(texture=photograph(45, 59, 1)),
    }  # fmt: skip


@pytest.fixture(scope="module")
def combined(parts):
    return tetrakis.combine(parts["today"], _others(parts), name="today")


def _others(parts):
    return {name: stream for name, stream in parts.items() if name != "today"}


def test_each_component_is_its_own_stream_again(parts, combined):
    for name in ("2019", "normal", "classes", "today"):
        alone = tetrakis.open(parts[name])
        with tetrakis.open(combined, component=name) as opened:
            assert opened.info.components == 5
            if alone.info.shape:
                _assert_same_heights(opened, alone)
            else:
                assert opened.info.crs == "EPSG:32611"  # the first heights stay beside it
            if alone.info.texture_shape:
                np.testing.assert_array_equal(opened.texture(), alone.texture())
                part = np.s_[2:9, 3:8]
                np.testing.assert_array_equal(opened.texture(1, part), alone.texture(1, part))
            opened.verify()


def _assert_same_heights(opened, alone):
    facts = "shape dtype unit nodata scale offset crs geotransform registration lossless has_voids"
    for fact in facts.split():
        assert getattr(opened.info, fact) == getattr(alone.info, fact), fact
    for read in ("heights", "surface", "validity"):
        for where in ({}, dict(level=1), dict(window=np.s_[4:11, 2:30])):
            made = getattr(opened, read)(**where)
            np.testing.assert_array_equal(made, getattr(alone, read)(**where))
    mesh, expected = opened.mesh(50), alone.mesh(50)
    np.testing.assert_array_equal(mesh.vertices, expected.vertices)


def test_components_are_listed(parts, combined):
    listed = tetrakis.open(combined).components
    assert [(one.number, one.name, one.kind, one.shape, one.taken) for one in listed] == [
        (0, "today", "heights", (45, 59), True),
        (1, "today", "texture", (40, 48), True),
        (2, "2019", "heights", (30, 44), False),
        (3, "normal", "texture", (20, 24), False),
        (4, "classes", "texture", (45, 59), False),
    ]
    assert listed[2].bytes == tetrakis.open(parts["2019"]).info.geometry_bytes
    info = tetrakis.open(combined).info
    assert sum(one.bytes for one in listed) < info.stream_bytes - info.header_bytes
    taken = [one.taken for one in tetrakis.open(combined, component=["2019", 4]).components]
    assert taken == [False, False, True, False, True]
    plain = tetrakis.open(parts["classes"]).components
    assert plain == [
        tetrakis.Component(0, None, "texture", (45, 59), plain[0].bytes, True)
    ]  # fmt: skip


def test_a_name_of_heights_and_of_a_texture_takes_both(parts):
    other = {"2019": parts["2019"]}
    pairs = [("2019", parts["2019"]), ("2019", parts["normal"])]
    stream = tetrakis.combine(parts["today"], pairs)
    with tetrakis.open(stream, component="2019") as opened:
        assert [one.taken for one in opened.components] == [False, False, True, True]
    assert len(tetrakis.open(tetrakis.combine(parts["today"], other)).components) == 3


def test_what_is_taken_can_be_said_by_number_too(combined):
    wanted = tetrakis.open(combined, component="2019").heights()
    for component in (2, "2", np.int64(2), ["2019"], (2, "normal")):
        opened = tetrakis.open(combined, component=component)
        np.testing.assert_array_equal(opened.heights(), wanted)
    number_first = tetrakis.open(combined, component=[2, 0])
    assert number_first.info.unit == "m"  # the last one of a kind


def test_prefixes_show_all_components(combined):
    first = tetrakis.open(combined).info.header_bytes
    for component in (None, "2019", "normal"):
        whole = tetrakis.open(combined, component=component)
        for length in range(first, len(combined), 257):
            with tetrakis.open(combined[:length], component=component) as prefix:
                _assert_equal(prefix.surface(), whole.surface(bytes=length))
                _assert_equal(prefix.texture(), whole.texture(bytes=length))
    half = tetrakis.open(combined[: (first + len(combined)) // 2])
    assert all(one.bytes > 0 for one in half.components)
    for length in range(0, first, 7):
        with pytest.raises(tetrakis.TksTruncatedError):
            tetrakis.open(combined[:length], component="2019")


_assert_equal = np.testing.assert_array_equal


def test_a_budget_and_weights_share_the_bytes(parts):
    names = [None, {"today": 1, "2019": 1}, {"2019": 100}, {"today": 100}]
    errors = []
    for weights in names:
        stream = tetrakis.combine(
            parts["today"], {"2019": parts["2019"]}, name="today", weights=weights, bytes=4000
        )
        assert len(stream) <= 4000
        with tetrakis.open(stream, component="2019") as opened:
            assert not opened.info.lossless
            errors.append(opened.info.heights_rmse)
    assert errors[0] == errors[1]
    assert errors[2] < errors[0] < errors[3]


def test_streams_come_from_wherever_open_takes_them(parts, combined, tmp_path):
    path = tmp_path / "today.tks"
    path.write_bytes(parts["today"])
    others = {
        "2019": io.BytesIO(parts["2019"]),
        "normal": memoryview(parts["normal"]),
        "classes": bytearray(parts["classes"]),
    }
    assert tetrakis.combine(path, others, name="today") == combined
    with Server(parts["today"]) as server:
        others = list(_others(parts).items())
        assert tetrakis.combine(server.url, others, name="today") == combined
    with pytest.raises(FileNotFoundError):
        tetrakis.combine(tmp_path / "absent.tks", {})


@pytest.mark.parametrize("source", ["file", "server", "fsspec", "pickled"])
def test_windows_are_read_by_ranges(source, tmp_path):
    noise = [np.random.default_rng(seed).integers(0, 900, (400, 400), "i2") for seed in (1, 2)]
    streams = [tetrakis.encode(each, regions=64, index="windows") for each in noise]
    combined = tetrakis.combine(streams[0], {"second": streams[1]})
    (tmp_path / "a.tks").write_bytes(combined)
    with Server(combined) as server:
        address = tmp_path / "a.tks"
        if source == "server":
            address = server.url
        elif source == "fsspec":
            pytest.importorskip("fsspec")
            address = f"file://{address}"
        for component, wanted in ((None, noise[0]), ("second", noise[1]), (1, noise[1])):
            opened = tetrakis.open(address, component=component)
            if source == "pickled":
                opened = pickle.loads(pickle.dumps(opened))
            before = server.sent
            for part in (np.s_[0:40, 0:40], np.s_[300:380, 190:260]):
                _assert_equal(opened.heights(window=part), wanted[part])
            assert server.sent - before < len(combined) / 3
            assert [one.taken for one in opened.components] == [component is None, bool(component)]
            _assert_equal(opened.heights(), wanted)


def test_a_representation_counts_components(parts, combined):
    assert "of 5 components" in repr(tetrakis.open(combined))
    assert "heights 30 x 44 float32" in repr(tetrakis.open(combined, component="2019"))
    assert "components" not in repr(tetrakis.open(parts["today"]))


def test_components_that_there_are_not(combined, parts):
    missing = ["2020", "", "5", "-1", "٣", "9" * 9000, "Today"]
    for component in (*missing, 5, 2**32 - 1, [0, "2020"]):
        with pytest.raises(tetrakis.TksUsageError, match="no component"):
            tetrakis.open(combined, component=component)
    for component in (1.5, -1, 2**32, b"2019", {"a": 1}, [["2019"]]):
        with pytest.raises(tetrakis.TksUsageError, match="component"):
            tetrakis.open(combined, component=component)
    with pytest.raises(tetrakis.TksUsageError, match="no component ''"):
        tetrakis.open(parts["today"], component="")  # whose components have no names
    later = VECTORS / "details_18x11.tks"
    assert [one.kind for one in tetrakis.open(later).components].count("unknown") == 1
    with pytest.raises(tetrakis.TksUnsupportedError, match="does not know"):
        tetrakis.open(later, component="unknown")


def test_hostile_bytes_raise_or_decode(combined):
    random = np.random.default_rng(7)
    header = tetrakis.open(combined).info.header_bytes
    good, codes = 0, set()
    for _ in range(300):
        damaged = bytearray(combined[: random.integers(header, len(combined))])
        reach = header if random.random() < 0.8 else len(damaged)
        damaged[random.integers(0, reach)] ^= 1 << random.integers(0, 8)
        try:
            for component in range(5):
                with tetrakis.open(bytes(damaged), component=component) as opened:
                    opened.texture(), opened.heights()
                    good += len(opened.components) == 5
            tetrakis.combine(bytes(damaged), {"more": bytes(damaged)})
        except tetrakis.TksError as error:
            codes.add(error.code)
    assert good > 100 and {tetrakis.Status.CORRUPT, tetrakis.Status.USAGE} <= codes


@pytest.mark.parametrize(
    "others, options, says",
    [
        ({}, dict(bytes=10), "header"),
        ({}, dict(bytes=0), "greater than 0"),
        ({}, dict(bytes=-1), "between 0"),
        ({}, dict(weights={"a": 1}), "No stream is called 'a'"),
        ({}, dict(weights={None: 1}), "No stream is called None"),
        ({}, dict(weights=3), "weights are"),
        ({}, dict(name="x" * 256), "255 bytes"),
        ({}, dict(name=b"x"), "must be text"),
        ({}, dict(name="a\0b"), "NUL"),
        (b"TKS", {}, "Streams beside"),
        (5, {}, "Streams beside"),
        (["today"], {}, r"\(name, stream\)"),
        ({"b": None}, {}, "path, bytes or a file"),
        ({5: b""}, {}, "must be text"),
    ],
)
def test_arguments_that_make_no_sense(parts, others, options, says):
    with pytest.raises(tetrakis.TksUsageError, match=says):
        tetrakis.combine(parts["today"], others, **options)


def test_streams_that_do_not_join(parts):
    today, other = parts["today"], parts["2019"]
    for weight in (0, -1, float("nan"), float("inf"), "3"):
        with pytest.raises(tetrakis.TksUsageError, match="weight"):
            tetrakis.combine(today, {"a": other}, weights={"a": weight})
    with pytest.raises(tetrakis.TksUsageError, match="16 components"):
        tetrakis.combine(today, {str(i): other for i in range(15)})
    with pytest.raises(tetrakis.TksUsageError, match="name"):
        tetrakis.combine(today, [("a", other), ("a", other)])
    with pytest.raises(tetrakis.TksCorruptError, match="Stream 1"):
        tetrakis.combine(today, {"a": b"GIF89a, or so, but no stream of ours"})
    with pytest.raises(tetrakis.TksTruncatedError, match="Stream 1"):
        tetrakis.combine(today, {"a": other[:20]})
    with pytest.raises(tetrakis.TksLimitError, match="Stream 0"):
        tetrakis.combine(today, {"a": other}, max_memory=20_000)
    frames = tetrakis.encode_sequence(np.stack([terrain(9, 9)] * 2))
    with pytest.raises(tetrakis.TksUnsupportedError, match="sequence"):
        tetrakis.combine(today, {"a": frames})


def test_combined_streams_combine_again(parts, combined):
    again = tetrakis.combine(combined, {"more": parts["normal"]})
    names = [one.name for one in tetrakis.open(again).components]
    assert names == ["today", "today", "2019", "normal", "classes", "more"]
    _assert_equal(tetrakis.open(again, component="more").texture(),
                  tetrakis.open(parts["normal"]).texture())  # fmt: skip


def test_maps_lie_on_triangles():
    y, x = np.mgrid[0:9, 0:9] / 8
    points = np.stack([x, x * (1 - x) * y, y], axis=-1).reshape(-1, 3)
    corner = (np.arange(8)[:, np.newaxis] * 9 + np.arange(8)).ravel()
    triangles = np.concatenate(
        [np.stack([corner, corner + 9, corner + 1], -1),
         np.stack([corner + 1, corner + 9, corner + 10], -1)]
    )  # fmt: skip
    uv = np.stack([x, y], axis=-1).reshape(-1, 2)
    model = tetrakis.encode_object(
        points, triangles, texcoords=uv, texture=photograph(32, 32), bytes=6000, kind="triangles"
    )
    maps = {
        "normal": tetrakis.encode(texture=photograph(24, 40)),
        "occlusion": tetrakis.encode(texture=photograph(16, 16, 1)),
    }
    shiny = tetrakis.combine(model, maps)
    with tetrakis.open(shiny) as opened:
        assert [one.name for one in opened.components] == [None, "normal", "occlusion"]
        assert opened.info.material is None
        assert opened.object().triangles.shape == triangles.shape
    for name, stream in maps.items():
        with tetrakis.open(shiny, component=name) as opened:
            np.testing.assert_array_equal(opened.texture(), tetrakis.open(stream).texture())
            assert opened.info.object_triangles == len(triangles)
