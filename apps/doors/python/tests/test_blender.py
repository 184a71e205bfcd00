# SPDX-License-Identifier: Apache-2.0
"""The add-on for Blender: what it makes of streams, and Blender itself where it is installed."""

import importlib.util
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY, photograph, terrain
from test_objects import sphere

import tetrakis

ADDON = REPOSITORY / "apps" / "doors" / "blender"


@pytest.fixture(scope="module")
def shape_of():
    place = ADDON / "tetrakis_blender" / "shape.py"
    spec = importlib.util.spec_from_file_location("shape", place)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.shape_of


@pytest.fixture(scope="module")
def ball():
    """The lower half of its image is red, the upper half blue."""
    points, triangles = sphere(9, 12)
    image = np.zeros((32, 32, 3), "u1")
    image[:16, :, 2], image[16:, :, 0] = 255, 255
    uv = np.stack([np.full(len(points), 0.5), (10 - points[:, 2]) / 20], axis=1)
    return tetrakis.encode_object(
        points,
        triangles,
        texcoords=uv,
        texture=image,
        bytes=2500,
        kind="resampled",
        description="ball",
    )


def edges_of(faces):
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)


def colours_at(shape, uv):
    rows, columns = shape.image.shape[:2]
    return shape.image[(uv[:, 1] * rows).astype(int), (uv[:, 0] * columns).astype(int)]


def test_a_scan_is_closed_and_coloured(shape_of, ball):
    with tetrakis.open(ball) as stream:
        shape = shape_of(stream, 1000)
    assert shape.name == "ball" and len(shape.faces) <= 1000
    edges, uses = edges_of(shape.faces)
    assert (uses == 2).all() and len(shape.vertices) - len(edges) + len(shape.faces) == 2
    assert len(np.unique(shape.vertices, axis=0)) == len(shape.vertices)
    assert shape.corner_uv.shape == (len(shape.faces), 3, 2) and shape.image.dtype == np.float32
    middle = shape.vertices[shape.faces].mean(axis=1)
    colours = colours_at(shape, shape.corner_uv.mean(axis=1))
    for part, channel in ((middle[:, 2] > 3, 2), (middle[:, 2] < -3, 0)):
        assert part.sum() > 100 and np.mean(colours[part, channel] > 0.6) > 0.97
    assert (colours[:, 3] == 1).all()


def test_y_may_be_up(shape_of, ball):
    with tetrakis.open(ball) as stream:
        given, turned = shape_of(stream, 500), shape_of(stream, 500, y_is_up=True)
        points = stream.object(500).points
    np.testing.assert_array_equal(np.unique(turned.vertices[:, 2]), np.unique(points[:, 1]))
    for shape in (given, turned):  # outside stays outside
        a, b, c = (shape.vertices[shape.faces[:, k]] for k in range(3))
        assert np.einsum("ij,ij->", a, np.cross(b, c)) > 0


def test_a_terrain_lies_round_the_origin_with_its_texture(shape_of):
    image = photograph(45, 59, 2, "u2")
    stream = tetrakis.encode(terrain(), image, spacing=10)
    with tetrakis.open(stream) as opened:
        shape = shape_of(opened)
    assert len(shape.vertices) == 45 * 59 and shape.name == ""
    np.testing.assert_allclose(np.ptp(shape.vertices, axis=0)[:2], [580, 440])
    np.testing.assert_allclose(shape.vertices.max(axis=0)[:2], [290, 220])
    assert sorted(shape.vertices[:, 2]) == sorted(terrain().ravel())
    a, b, c = (shape.vertices[shape.faces[:, k], :2] for k in range(3))
    assert (np.cross(b - a, c - a) > 0).all()  # seen from above
    white = tetrakis.open(stream).info.texture_white_level
    north_west = shape.image[-1, 0]  # images of Blender begin below
    np.testing.assert_allclose(north_west[:3], min(1, image[0, 0, 0] / white), rtol=1e-6)
    np.testing.assert_allclose(north_west[3], image[0, 0, 1] / 65535, rtol=1e-6)
    first = np.argmin(shape.vertices[:, 0] - shape.vertices[:, 1])
    at = shape.corner_uv[shape.faces == first]
    assert (at[:, 0] < 0.02).all() and (at[:, 1] > 0.98).all()


def test_streams_without_images(shape_of):
    with tetrakis.open(tetrakis.encode_object(*sphere(9, 12), bytes=800, kind="resampled")) as stream:
        shape = shape_of(stream, 300)
    assert shape.image is None and shape.corner_uv is None and len(shape.faces) > 100
    holes = np.full((8, 8), np.nan, "f4")
    with tetrakis.open(tetrakis.encode(holes)) as stream:
        assert shape_of(stream).faces.shape == (0, 3)


SCRIPT = """
import json, sys
sys.path[:0] = {paths!r}
import bpy, tetrakis_blender
tetrakis_blender.register()
results = []
for options in {calls!r}:
    try:
        done = list(bpy.ops.import_mesh.tks(**options))
    except RuntimeError as error:
        results.append(str(error))
        continue
    thing = bpy.context.view_layer.objects.active
    mesh = thing.data
    image = bpy.data.images.get(thing.name)
    results.append(dict(
        done=done, name=thing.name, vertices=len(mesh.vertices), faces=len(mesh.polygons),
        sound=not mesh.validate(), uv=len(mesh.uv_layers), size=image and list(image.size),
        materials=len(mesh.materials), top=max(v.co.z for v in mesh.vertices)))
print("RESULTS" + json.dumps(results))
tetrakis_blender.unregister()
"""


def test_blender_opens_streams(tmp_path, ball):
    blender = shutil.which("blender")
    if blender is None:
        pytest.skip("no Blender")
    (tmp_path / "ball.tks").write_bytes(ball)
    heights = tetrakis.encode(terrain(), spacing=10)
    (tmp_path / "hills.tks").write_bytes(heights)
    (tmp_path / "no.tks").write_bytes(b"nothing")
    calls = [dict(filepath=str(tmp_path / name)) for name in ("ball.tks", "hills.tks", "no.tks")]
    calls[0]["triangles"] = 600
    calls.append(dict(calls[1], kilobytes=1, triangles=100))
    script = tmp_path / "script.py"
    paths = [str(ADDON), str(Path(tetrakis.__file__).parents[1])]
    script.write_text(SCRIPT.format(paths=paths, calls=calls))
    run = [blender, "--background", "--factory-startup", "--python", str(script)]
    environment = {**os.environ, "HOME": str(tmp_path)}
    printed = subprocess.run(run, capture_output=True, text=True, env=environment, timeout=300)
    found = [line for line in printed.stdout.splitlines() if line.startswith("RESULTS")]
    assert found, printed.stdout[-2000:] + printed.stderr[-2000:]
    scan, hills, nothing, cut = json.loads(found[0][len("RESULTS") :])
    assert scan["done"] == ["FINISHED"] and scan["name"] == "ball" and scan["sound"]
    assert 200 < scan["faces"] <= 600 and scan["uv"] == scan["materials"] == 1
    atlas = tetrakis.open(ball).object(600).atlas
    assert scan["size"] == [atlas.shape[1], atlas.shape[0]] and abs(scan["top"] - 10) < 0.5
    assert hills["name"] == "hills" and hills["vertices"] == 45 * 59 and hills["uv"] == 0
    assert "stream" in nothing
    assert cut["faces"] <= 100 and cut["name"].startswith("hills")
