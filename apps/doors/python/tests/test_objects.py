# SPDX-License-Identifier: Apache-2.0
"""Surfaces of triangle meshes: coded, cut, and back as meshes with their texture."""

import copy
import json
import pickle
import re
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import photograph

import tetrakis
from tetrakis import _sketch


def wound(rows, columns, closed_rows):
    """Triangles of a grid whose columns, and perhaps rows, go round."""
    r, c = np.mgrid[0 : rows if closed_rows else rows - 1, 0:columns]
    a, b = r * columns + c, r * columns + (c + 1) % columns
    below = (r + 1) % rows
    d, e = below * columns + c, below * columns + (c + 1) % columns
    return np.concatenate([np.stack([a, d, b], -1), np.stack([b, d, e], -1)]).reshape(-1, 3)


def around(theta, phi):
    """Points of the unit sphere, (rows, columns, 3)."""
    x, y = np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)
    return np.stack([x, y, np.broadcast_to(np.cos(theta), x.shape)], axis=-1)


def sphere(rows=13, columns=24, radius=10.0):
    """Points of a pole are at one place; triangles there are degenerate, and dropped."""
    theta = np.linspace(0, np.pi, rows)[:, np.newaxis]
    phi = np.arange(columns) * 2 * np.pi / columns
    points = radius * around(theta, phi).reshape(-1, 3)
    points[:columns], points[-columns:] = [0, 0, radius], [0, 0, -radius]
    return points, wound(rows, columns, False)


def torus(rows=12, columns=24, large=10.0, small=3.0):
    u = np.arange(rows)[:, np.newaxis] * 2 * np.pi / rows
    v = np.arange(columns) * 2 * np.pi / columns
    ring = large + small * np.cos(u)
    x, y, z = np.broadcast_arrays(ring * np.cos(v), ring * np.sin(v), small * np.sin(u))
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), wound(rows, columns, True)[:, ::-1]


def off_sphere(points):
    return np.abs(np.linalg.norm(points, axis=1) - 10)


def off_torus(points):
    return np.abs(np.hypot(np.hypot(points[:, 0], points[:, 1]) - 10, points[:, 2]) - 3)


SHAPES = {"sphere": (sphere, off_sphere, 2), "torus": (torus, off_torus, 0)}


def characteristic(mesh):
    """Of Euler, with equal points taken for one; every edge has two triangles."""
    places, welded = np.unique(mesh.points, axis=0, return_inverse=True)
    corners = welded.reshape(-1)[mesh.triangles]
    sides = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges, uses = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
    assert (uses == 2).all()
    return len(places) - len(edges) + len(corners)


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


@pytest.fixture(scope="module", params=list(SHAPES))
def shape(request):
    made, off, euler = SHAPES[request.param]
    points, triangles = made()
    stream = tetrakis.encode_object(
        points, triangles, bytes=1500, kind="resampled", unit="mm", description="a thing"
    )
    return SimpleNamespace(stream=stream, off=off, euler=euler, points=points, triangles=triangles)


def test_the_surface_comes_back(shape):
    assert isinstance(shape.stream, bytes) and 1000 < len(shape.stream) <= 1500
    with tetrakis.open(shape.stream) as opened:
        assert opened.is_object and (opened.info.unit, opened.info.description) == ("mm", "a thing")
        mesh = opened.object()
        assert mesh.points.dtype == np.float64 and mesh.texcoords is None and mesh.atlas is None
        assert len(mesh.points) == len(mesh.pixels) and mesh.triangles.dtype == np.uint32
        error = shape.off(mesh.points)
        # The facets of the input are some 0.1 off as well.
        assert np.sqrt(np.mean(error**2)) < 0.2 and error.max() < 0.6
        assert characteristic(mesh) == shape.euler
        ratio = volume(mesh.points, mesh.triangles) / volume(shape.points, shape.triangles)
        assert ratio == pytest.approx(1, rel=0.01)


def test_meshes_have_the_triangles_asked_for(shape):
    with tetrakis.open(shape.stream) as opened:
        least = 2 * len(opened.info.base_mesh.corners)
        counts = [len(opened.object(count).triangles) for count in (1, least, 2 * least, 5 * least)]
        assert counts[:2] == [1, least] and least < counts[2] <= 2 * least < counts[3]
        assert counts[3] <= 5 * least < len(opened.object().triangles)
        coded = opened.object(coded=True)
        assert characteristic(coded) == shape.euler and len(coded.triangles) > least
        np.testing.assert_array_equal(opened.object().points, opened.object(0).points)
        for refused in (dict(triangles=-1), dict(triangles=9, coded=True), dict(coded=3)):
            with pytest.raises(tetrakis.TksUsageError):
                opened.object(**refused)


def test_every_prefix_is_a_surface(shape):
    header = tetrakis.open(shape.stream).info.header_bytes
    errors = []
    with tetrakis.open(shape.stream) as opened:
        whole = opened.object().points
        for count in [*range(header, len(shape.stream), 97), len(shape.stream)]:
            mesh = opened.object(1000, bytes=count)
            with tetrakis.open(shape.stream[:count]) as cut:
                np.testing.assert_array_equal(cut.object(1000).points, mesh.points)
            assert characteristic(mesh) == shape.euler
            assert (shape.off(mesh.points) < 1).all()
            points = opened.object(bytes=count).points
            errors.append(np.sqrt(np.mean((points - whole) ** 2)))
    assert errors[0] > errors[len(errors) // 2] > errors[-1] == 0
    with pytest.raises(tetrakis.TksTruncatedError):
        tetrakis.open(shape.stream[: header - 1])


def test_the_base_mesh_lies_under_the_surface(shape):
    with tetrakis.open(shape.stream) as opened:
        base, info = opened.info.base_mesh, opened.info
        mesh, heights = opened.object(), opened.surface()
    patches, side = len(base.corners), 2**base.depth + 1
    assert base.corners.shape == (patches, 4, 3) and base.corners.dtype == np.int32
    assert base.corners.min() >= 0 and base.corners.max() < 2**base.bits
    assert info.shape == (patches * side, side) == heights.shape and info.domain == "forest"
    assert base.sides.shape == (patches, 4) and base.texture_depth is None
    assert (np.sort(base.sides.ravel()) == np.arange(4 * patches)).all()  # closed: each once
    np.testing.assert_allclose(base.places, np.array(base.origin) + base.cell * base.corners)
    assert (shape.off(base.places.reshape(-1, 3)) < 1.5).all()
    # Corners of patches are vertices: at the base's corner, but for the height there.
    column, row = (mesh.pixels - 0.5).T.astype(int)
    for corner, at in enumerate([(0, 0), (0, side - 1), (side - 1, side - 1), (side - 1, 0)]):
        found = (row % side == at[0]) & (column == at[1])
        patch = row[found] // side
        away = np.linalg.norm(mesh.points[found] - base.places[patch, corner], axis=1)
        np.testing.assert_allclose(away, np.abs(heights[row[found], column[found]]), atol=1e-3)


def test_the_report_says_what_became_of_it(shape):
    report = shape.stream.report
    assert (report.components, report.borders, report.cut_edges) == (1, 0, 0)
    assert report.triangles + report.dropped_triangles == len(shape.triangles)
    box = np.linalg.norm(np.ptp(shape.points, axis=0))
    assert report.diagonal == pytest.approx(box, rel=1e-6)
    assert report.psnr == pytest.approx(20 * np.log10(report.diagonal / report.error))
    assert 0 < report.error <= report.largest and report.texture_depth is None
    with tetrakis.open(shape.stream) as opened:
        base = opened.info.base_mesh
        assert (report.patches, report.depth) == (len(base.corners), base.depth)


def test_a_target_of_quality_is_met():
    points, triangles = torus()
    by_psnr = tetrakis.encode_object(points, triangles, psnr=48)
    assert 48 <= by_psnr.report.psnr
    by_error = tetrakis.encode_object(points, triangles, max_error=0.2, kind="resampled")
    with tetrakis.open(by_error) as opened:
        assert opened.info.max_error <= 0.2 and (off_torus(opened.object().points) < 0.8).all()


def test_arrays_of_any_kind_are_the_same_mesh():
    points, triangles = sphere(9, 12)
    points = np.round(points * 8)
    expected = tetrakis.encode_object(points, triangles, bytes=800)
    faces = SimpleNamespace(vertices=points, faces=triangles)
    blocks = SimpleNamespace(points=points, cells_dict={"triangle": triangles, "line": [[0, 1]]})
    for given in (
        (points.tolist(), triangles.tolist()),
        (points.astype("f4")[:, ::-1][:, ::-1], triangles.astype(">u2")),
        (np.asfortranarray(points.astype("i2")), triangles.astype("f8")),
        (faces,),
        (blocks,),
    ):
        assert tetrakis.encode_object(*given, bytes=800) == expected


def test_results_copy_and_pickle_with_their_report():
    stream = tetrakis.encode_object(*sphere(9, 12), bytes=800)
    for again in (copy.copy(stream), pickle.loads(pickle.dumps(stream))):
        assert again == stream and again.report == stream.report
    assert type(stream[:100]) is bytes


def octants(points):
    """A colour for each octant: 40 or 200 in each channel."""
    return np.where(points > 0, 200, 40)


@pytest.fixture(scope="module")
def globe():
    """A sphere with a picture whose columns are longitudes, in two kinds of coordinates."""
    points, triangles = sphere(13, 24)
    rows, columns = 64, 128
    theta = (np.arange(rows)[:, np.newaxis] + 0.5) * np.pi / rows
    phi = (np.arange(columns) + 0.5) * 2 * np.pi / columns
    column = (np.arange(len(points)) % 24)[triangles]
    column = np.where(column.max(axis=1, keepdims=True) - column > 12, column + 24, column)
    row = (np.arange(len(points)) // 24)[triangles]
    texcoords = np.stack([column / 24, row / 12], axis=-1)
    image = octants(around(theta, phi)).astype("u1")
    stream = tetrakis.encode_object(
        points, triangles, texcoords=texcoords, texture=image, bytes=8000, kind="resampled"
    )
    return SimpleNamespace(stream=stream)


def looked_up(mesh, uv):
    rows, columns = mesh.atlas.shape[:2]
    return mesh.atlas[(uv[:, 1] * rows).astype(int), (uv[:, 0] * columns).astype(int)].astype(int)


def test_colours_are_where_they_were(globe):
    assert globe.stream.report.texture_depth >= 3
    with tetrakis.open(globe.stream) as opened:
        assert opened.info.base_mesh.texture_depth == globe.stream.report.texture_depth
        fewest = 2 * globe.stream.report.patches  # fewer stretch the texels that they keep
        for mesh in (opened.object(), opened.object(1000), opened.object(fewest)):
            middle = mesh.points[mesh.triangles].mean(axis=1)
            uv = mesh.texcoords[mesh.triangles].mean(axis=1)
            wrong = np.abs(looked_up(mesh, uv) - octants(middle)).max(axis=1)
            inside = (np.abs(middle) > 1).all(axis=1)
            assert inside.sum() > 50 and np.mean(wrong[inside] > 40) < 0.02


def test_the_atlas_holds_the_texels_with_a_rim(globe):
    with tetrakis.open(globe.stream) as opened:
        mesh, texels, base = opened.object(), opened.texture(), opened.info.base_mesh
    patches, side = len(base.corners), 2**base.texture_depth + 1
    across = int(np.ceil(np.sqrt(patches)))
    assert mesh.atlas.dtype == np.uint8
    assert mesh.atlas.shape == (-(-patches // across) * (side + 2), across * (side + 2), 3)
    for patch in (0, across - 1, across, patches - 1):
        y, x = (side + 2) * (patch // across), (side + 2) * (patch % across)
        field = mesh.atlas[y : y + side + 2, x : x + side + 2]
        part = texels[patch * side : (patch + 1) * side]
        np.testing.assert_array_equal(field, np.pad(part, [(1, 1), (1, 1), (0, 0)], mode="edge"))
    # Samples at corners of patches are at the middle of texels; triangles stay on one patch.
    place = mesh.texcoords * mesh.atlas.shape[1::-1]
    within = place % (side + 2)
    assert within.min() >= 1.5 - 1e-6 and within.max() <= side + 0.5 + 1e-6
    fields = (place // (side + 2)).astype(int)[mesh.triangles]
    assert (fields == fields[:, :1]).all()


def test_prefixes_with_a_texture_are_closed_and_coloured(globe):
    header = tetrakis.open(globe.stream).info.header_bytes
    for count in np.linspace(header, len(globe.stream), 12).astype(int):
        with tetrakis.open(globe.stream[:count]) as cut:
            mesh = cut.object(2000)
        assert characteristic(mesh) == 2 and mesh.atlas.ndim == 3
        assert (off_sphere(mesh.points) < 2).all()


def test_textures_of_other_kinds(globe):
    points, triangles = sphere(9, 12)
    uv = (np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) + 0.5, 0.5 - points[:, 2] / 20)
    uv = np.stack(uv, axis=1)
    grey, deep = photograph(16, 24, 1), photograph(16, 24, 4, "u2")
    options = dict(texcoords=uv, bytes=1500, kind="resampled")
    stream = tetrakis.encode_object(points, triangles, texture=deep, **options)
    atlas = tetrakis.open(stream).object(100).atlas
    assert atlas.shape[2:] == (4,) and atlas.dtype == np.uint16 and len(stream) <= 1500
    stream = tetrakis.encode_object(points, triangles, texture=grey.tolist(), **options)
    expected = tetrakis.open(stream).object(100).atlas
    assert expected.ndim == 2 and expected.dtype == np.uint8
    options["texcoords"] = uv[triangles].astype("f4")
    assert tetrakis.encode_object(points, triangles, texture=grey, **options) == stream
    material = SimpleNamespace(image=grey)  # an array stands for an image of Pillow
    visual = SimpleNamespace(uv=uv * [1, -1] + [0, 1], material=material)
    of_trimesh = SimpleNamespace(vertices=points, faces=triangles, visual=visual)
    opened = tetrakis.open(
        tetrakis.encode_object(of_trimesh, bytes=1500, kind="resampled")
    )
    atlas = opened.object(100).atlas
    np.testing.assert_allclose(atlas.astype(int), expected, atol=3)


def test_notebooks_show_a_picture(globe):
    plain = tetrakis.encode_object(*sphere(9, 12), bytes=800, kind="resampled")
    for stream in (globe.stream, plain[:400]):
        with tetrakis.open(stream) as opened:
            page, line = opened._repr_html_(), repr(opened)
            assert "data:image/png" in page and re.search(r"\d+ patches of \d+ x \d+", page)
            assert line.startswith("<tetrakis.Stream: object of ")
            assert opened.describe().base_mesh is not None
            picture = _sketch.drawn(opened.object(_sketch.TRIANGLES), 255)
            rows, columns = np.nonzero(picture[..., 3])
            assert np.ptp(rows) > 150 and np.ptp(columns) > 150
            middle = picture[50:140, 50:140]  # without holes between the points that are strewn
            assert middle[..., 3].all() and len(np.unique(middle.reshape(-1, 4), axis=0)) > 8


def test_what_makes_no_object_is_refused():
    points, triangles = sphere(6, 8)
    holed = points.copy()
    holed[3, 1] = np.nan
    uv, image = np.zeros((len(points), 2)), np.zeros((4, 4, 3), "u1")
    twice = np.concatenate([triangles, [[0, 1, len(points)]]])
    for wrong in (
        dict(points=points[:, :2]),
        dict(points=holed),
        dict(points="cube"),
        dict(points=[[2**63 - 1, 0, 0]] * 3, triangles=[[0, 1, 2]]),
        dict(points=points.astype("c16")),
        dict(triangles=twice),
        dict(triangles=-triangles),
        dict(triangles=triangles + 0.5),
        dict(triangles=triangles[:0]),
        dict(triangles=triangles[:, :2]),
        dict(triangles=[[0, 0, 1]]),
        dict(triangles=None),
        dict(bytes=None),
        dict(bytes=0),
        dict(bytes=1),
        dict(bytes=None, psnr=-3),
        dict(bytes=None, max_error=float("nan")),
        dict(psnr=40),
        dict(texcoords=uv),
        dict(texture=image),
        dict(texcoords=uv[:3], texture=image),
        dict(texcoords=uv, texture=image, triangles=twice),
        dict(texcoords=uv, texture=image[0, 0, 0]),
        dict(texcoords=uv, texture=image, bytes=None, psnr=40),
        dict(progress=3),
        dict(unit="m\0"),
    ):
        arguments = {**dict(points=points, triangles=triangles, bytes=2000), **wrong}
        with pytest.raises(tetrakis.TksUsageError) as caught:
            tetrakis.encode_object(**arguments)
        assert re.search(r"[.)]$", str(caught.value)), str(caught.value)


def test_objects_and_terrains_are_told_apart(shape, stream):
    with tetrakis.open(stream) as opened:
        assert not opened.is_object and opened.info.base_mesh is None
        with pytest.raises(tetrakis.TksUsageError, match="base mesh"):
            opened.object()
    with tetrakis.open(shape.stream) as opened:
        assert opened.info == opened.describe() and hash(opened.info) == hash(opened.describe())
        for refused in (opened.mesh, opened.globe_mesh):
            with pytest.raises(tetrakis.TksUsageError):
                refused()


def test_progress_is_told_and_may_stop():
    points, triangles = sphere(9, 12)
    told = []
    tetrakis.encode_object(points, triangles, bytes=800, progress=told.append)
    assert told and all(0 <= done <= 1 for done in told)

    def stop(done):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tetrakis.encode_object(points, triangles, bytes=2000, progress=stop)


def test_the_library_has_the_last_word_on_hostile_texcoords():
    points, triangles = sphere(9, 12)
    image = photograph(8, 8)
    for wild in (np.nan, np.inf, -1e30, 1e300):
        uv = np.full((len(points), 2), wild)
        try:
            tetrakis.encode_object(points, triangles, texcoords=uv, texture=image, bytes=1500)
        except tetrakis.TksError as error:
            assert str(error).endswith(".")


def grid(side):
    """Points, triangles and texcoords of a square of steps."""
    y, x = np.divmod(np.arange((side + 1) ** 2), side + 1)
    corner = (np.arange(side)[:, np.newaxis] * (side + 1) + np.arange(side)).reshape(-1)
    triangles = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + side + 2], axis=1),
            np.stack([corner, corner + side + 2, corner + side + 1], axis=1),
        ]
    )
    points = np.stack([x, y, (x + y) % 2], axis=1)
    return points, triangles, np.stack([x, y], axis=1) / side


def test_triangles_come_back_as_they_are():
    points, triangles, _ = grid(7)
    stream = tetrakis.encode_object(points, triangles, max_error=0.01)
    assert (stream.report.kind, stream.report.coded_triangles) == ("triangles", len(triangles))
    assert stream.report.patches == 0 and stream.report.texture_depth is None
    with tetrakis.open(stream) as opened:
        assert opened.is_object and opened.info.base_mesh is None
        assert opened.info.object_triangles == len(triangles)
        assert repr(opened).startswith("<tetrakis.Stream: object of 98 triangles, ")
        mesh = opened.object()
        assert mesh.pixels is None and mesh.texcoords is None and mesh.atlas is None
        near = np.abs(mesh.points[:, np.newaxis] - points).max(axis=2).min(axis=1)
        assert near.max() < 0.01 and len(mesh.points) == len(points)
        assert len(mesh.triangles) == len(triangles)
        for most in (97, 40, 10, 1):
            few = opened.object(most)
            assert 0 < len(few.triangles) <= most
            assert {*map(tuple, few.points)} <= {*map(tuple, mesh.points)}
        assert len(opened.object(40).triangles) >= 38
        assert opened._repr_html_().count("98 triangles") == 1


def test_sketches_are_shown_until_the_header_is_there():
    points, triangles, _ = grid(24)
    make = dict(bytes=7000, kind="triangles")
    stream = tetrakis.encode_object(points, triangles, sketch=900, **make)
    assert len(stream) <= 7000 and 400 < stream.report.sketch_bytes <= 900
    with tetrakis.open(stream) as opened:
        info = opened.info
        assert not info.shows_sketch and info.object_triangles
        assert info.least_bytes < 900 < info.header_bytes
    for cut in (info.least_bytes, 1000, info.header_bytes - 1):
        with tetrakis.open(stream[:cut]) as opened:
            assert opened.info.shows_sketch and opened.info.stream_bytes == len(stream)
            assert len(opened.object(300).triangles) <= 300
    with pytest.raises(tetrakis.TksTruncatedError):
        tetrakis.open(stream[: info.least_bytes - 1])
    assert tetrakis.encode_object(points, triangles, **make).report.sketch_bytes is None
    assert tetrakis.encode_object(points, triangles, sketch=None, **make).report.sketch_bytes is None
    for wrong in ("often", 0, -1, 7000):
        with pytest.raises((tetrakis.TksUsageError, ValueError)):
            tetrakis.encode_object(points, triangles, sketch=wrong, **make)


def test_triangles_lie_under_their_texture():
    points, triangles, texcoords = grid(6)
    rows, columns = np.mgrid[:48, :64]
    texture = np.stack([4 * columns, 5 * rows, 90 + 0 * rows], axis=2).astype("u1")
    stream = tetrakis.encode_object(
        points, triangles, texcoords=texcoords, texture=texture, bytes=6000, kind="triangles"
    )
    with tetrakis.open(stream) as opened:
        mesh = opened.object()
        assert mesh.atlas.shape == texture.shape
        np.testing.assert_allclose(mesh.texcoords, mesh.points[:, :2] / 6, atol=0.02)
        assert np.abs(mesh.atlas.astype(int) - texture).mean() < 3
        assert opened._repr_html_().startswith("<")


def test_kinds_are_named():
    points, triangles, _ = grid(2)
    with pytest.raises(tetrakis.TksUsageError, match="kind must be one of"):
        tetrakis.encode_object(points, triangles, bytes=900, kind="quads")


@pytest.mark.parametrize("kind", ["resampled", "triangles"])
def test_maps_of_a_material_come_along(kind):
    points, triangles = sphere(9, 12)
    texcoords = points[:, :2] / (2 * np.abs(points).max()) + 0.5
    rows, columns = np.mgrid[0:32, 0:48]
    shades = (255 - 2 * rows - columns).astype(np.uint8)
    material = {"pbrMetallicRoughness": {"metallicFactor": 0.25}}
    given = dict(
        texcoords=texcoords,
        texture=np.full((16, 16, 3), 90, np.uint8),
        maps={"occlusion": shades, "emissive": np.dstack([shades] * 3)},
        material=material,
        kind=kind,
    )
    stream = tetrakis.encode_object(points, triangles, bytes=20000, **given)
    assert len(stream) <= 20000
    with tetrakis.open(stream) as opened:
        assert json.loads(opened.info.material) == material
        names = {one.name for one in opened.components}
        assert {"occlusion", "emissive"} <= names
    with tetrakis.open(stream, component="occlusion") as opened:
        decoded = np.asarray(opened.texture()).reshape(-1)
        assert abs(float(decoded.min()) - float(shades.min())) < 60
        assert decoded.max() <= 255 and decoded.max() > 180
    for refused in (dict(texture=None, texcoords=None), dict(material={"a": object()})):
        with pytest.raises(tetrakis.TksUsageError):
            tetrakis.encode_object(points, triangles, bytes=20000, **{**given, **refused})
