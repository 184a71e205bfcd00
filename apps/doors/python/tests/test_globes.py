# SPDX-License-Identifier: Apache-2.0
"""Heights of the whole Earth: on a cube and on their grid again, and as meshes round the globe."""

import numpy as np
import pytest
from conftest import photograph
from range_server import Server

import tetrakis

ROWS, COLUMNS = 90, 180
PLACE = (-180.0, 2.0, 0.0, 90.0, 0.0, -2.0)


def world(dtype="f4", rows=ROWS, columns=COLUMNS):
    """Smooth on the sphere, from -4000 to 4000."""
    latitude = np.radians(90 - (np.arange(rows)[:, np.newaxis] + 0.5) * 180 / rows)
    longitude = np.radians(-180 + (np.arange(columns) + 0.5) * 360 / columns)
    x, y = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)
    return (2000 * (np.sin(2 * x + 0.3) * np.cos(3 * y) + np.sin(latitude) ** 3)).astype(dtype)


def on_cube(**options):
    wanted = dict(psnr=70, domain="cube", geotransform=PLACE, crs="EPSG:4326", unit="m")
    return tetrakis.encode(options.pop("heights", world()), **{**wanted, **options})


@pytest.fixture(scope="module")
def cube():
    with tetrakis.open(on_cube()) as opened:
        yield opened


def rmse(a, b):
    return float(np.sqrt(np.mean((a.astype("f8") - b) ** 2)))


def closed(mesh):
    """Whether vertices at one place, taken for one, leave a sphere."""
    places, welded = np.unique(mesh.positions, axis=0, return_inverse=True)
    corners = welded.reshape(-1)[mesh.triangles]
    sides = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges, uses = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
    return (uses == 2).all() and len(places) - len(edges) + len(corners) == 2


def test_a_cube_gives_its_grid(cube):
    info = cube.info
    assert (info.domain, info.cube_depth, info.shape) == ("cube", 6, (ROWS, COLUMNS))
    assert (info.geotransform, info.crs, info.unit) == (PLACE, "EPSG:4326", "m")
    assert not info.lossless and info.max_error is None and info.coarsest_level == 5
    assert info.spacing == pytest.approx((222267, 222267), rel=1e-3)
    heights = cube.heights()
    assert heights.shape == cube.shape == (ROWS, COLUMNS) and heights.dtype == np.float32
    assert rmse(heights, world()) < 3
    np.testing.assert_array_equal(heights, cube.surface())
    assert cube.validity().all() and not np.ma.getmaskarray(cube.heights(masked=True)).any()


def test_windows_of_a_cube_are_cut_from_its_grid(cube):
    whole = cube.heights()
    for window in (np.s_[0:7, 170:180], np.s_[40:90, 0:1], (179, 89, 1, 1)):
        part = cube.heights(window=window)
        x, y, columns, rows = window if len(window) == 4 else (0, 0, 0, 0)
        cut = window if len(window) == 2 else np.s_[y : y + rows, x : x + columns]
        np.testing.assert_array_equal(part, whole[cut])
        assert cube.validity(window=window).shape == part.shape
    np.testing.assert_array_equal(cube[10:20:3, -4:], whole[10:20:3, -4:])
    placed = cube.describe(window=np.s_[10:20, 30:50])
    assert placed.geotransform == (-120, 2, 0, 70, 0, -2) and placed.shape == (10, 20)
    out = np.empty((ROWS, COLUMNS), "f4")
    assert cube.surface(out=out) is out
    np.testing.assert_array_equal(out, whole)
    refused = (dict(level=6), dict(window=(179, 0, 181, 1)), dict(window=(180, 0, 1, 1)))
    for each in (*refused, dict(out=out[1:])):
        with pytest.raises(tetrakis.TksUsageError):
            cube.heights(**each)


@pytest.mark.parametrize("domain", ["cylinder", "cube"])
@pytest.mark.parametrize("level", [0, 1])
def test_windows_go_on_across_180_degrees(domain, level):
    with tetrakis.open(on_cube(domain=domain)) as opened:
        whole = opened.heights(level)
        rows, columns = whole.shape
        for window in ((columns - 3, 2, 9, 4), (columns - 1, 0, columns, rows), (5, 1, columns, 2)):
            x, y, width, height = window
            cut = np.roll(whole, -x, axis=1)[y : y + height, :width]
            part = opened.heights(level, window=window)
            # Angles beyond 180 degrees are rounded otherwise.
            np.testing.assert_allclose(part, cut, atol=1e-2 if domain == "cube" else 0)
            assert opened.validity(level, window=window).all()
        for window in ((columns, 0, 1, 1), (0, 0, columns + 1, 1)):
            with pytest.raises(tetrakis.TksUsageError):
                opened.heights(level, window=window)


def test_levels_of_a_cube_are_grids_of_the_same_ground(cube):
    assert [cube.describe(level).shape for level in (1, 2, 5)] == [(45, 90), (23, 45), (3, 6)]
    for level, most in ((1, 12), (2, 60)):
        rows, columns = cube.describe(level).shape
        place = cube.describe(level).geotransform
        assert place == pytest.approx((-180, 360 / columns, 0, 90, 0, -180 / rows))
        assert rmse(cube.heights(level), world(rows=rows, columns=columns)) < most
        part = cube.heights(level, window=(3, 2, 7, 5))
        np.testing.assert_array_equal(part, cube.heights(level)[2:7, 3:10])


def test_samples_of_a_cube_keep_their_type():
    steps = (world() / 0.5 + 9000).round().astype("u2")
    stream = on_cube(heights=steps, scale=0.5, offset=-4500, nodata=65535, depth=5, threads=2)
    with tetrakis.open(stream) as opened:
        assert opened.info.cube_depth == 5 and opened.info.nodata is None
        assert opened.heights().dtype == np.uint16
        assert rmse(opened.heights() * 0.5 - 4500, world()) < 6
        assert rmse(opened.surface(), world()) < 6


def test_a_texture_stays_on_longitudes_and_latitudes():
    colours = photograph()
    rows, columns = colours.shape[:2]
    with tetrakis.open(on_cube(texture=colours, psnr=None, bytes=40000)) as opened:
        assert (opened.info.domain, opened.info.texture_domain) == ("cube", "cylinder")
        place = opened.info.texture_geotransform
        assert place == pytest.approx((-180, 360 / columns, 0, 90, 0, -180 / rows))
        assert opened.texture().shape == colours.shape
        seam = opened.texture(window=(columns - 2, 0, 5, 3))
        np.testing.assert_array_equal(seam, np.roll(opened.texture(), 2, axis=1)[:3, :5])
    own = dict(texture_geotransform=(0, 1, 0, 50, 0, -1), texture_crs="EPSG:4326")
    with tetrakis.open(on_cube(texture=colours, psnr=None, bytes=40000, **own)) as opened:
        assert opened.info.texture_domain == "plane"
        assert opened.info.texture_geotransform == own["texture_geotransform"]


def test_prefixes_and_files_of_a_cube(tmp_path, cube):
    stream = on_cube(psnr=None, bytes=3000, index=True)
    assert 1500 < len(stream) <= 3000
    (tmp_path / "a.tks").write_bytes(stream)
    with tetrakis.open(tmp_path / "a.tks") as opened:
        part = opened.heights(window=np.s_[3:9, 5:7])
        np.testing.assert_array_equal(part, opened.heights()[3:9, 5:7])
        assert opened.info.heights_rmse < cube.info.heights_rmse
        errors = [rmse(opened.heights(bytes=count), world()) for count in (900, 1400, 3000)]
    assert errors[0] > errors[1] > errors[2]


def test_windows_take_the_regions_of_a_cube_that_reach_them():
    rough = world() + np.random.default_rng(3).normal(0, 50, (ROWS, COLUMNS)).astype("f4")
    stream = on_cube(heights=rough, depth=7, regions=16, index=True)
    with tetrakis.open(stream) as opened:
        whole = opened.heights()
    with Server(stream) as server, tetrakis.open(server.url) as opened:
        for x, y, columns, rows in ((40, 30, 6, 5), (177, 44, 3, 2), (90, 0, 4, 1)):
            part = opened.heights(window=(x, y, columns, rows))
            np.testing.assert_array_equal(part, whole[y : y + rows, x : x + columns])
        np.testing.assert_array_equal(opened.heights(), whole)


def test_rasters_go_to_a_cube_and_come_back(tmp_path, cube):
    rasterio = pytest.importorskip("rasterio")
    tetrakis.to_geotiff(cube, tmp_path / "a.tif")
    with rasterio.open(tmp_path / "a.tif") as dataset:
        assert dataset.transform.to_gdal() == PLACE
        np.testing.assert_array_equal(dataset.read(1), cube.heights())
    stream = tetrakis.from_rasterio(tmp_path / "a.tif", psnr=70, domain="cube")
    assert rmse(tetrakis.open(stream).heights(), cube.heights()) < 3


@pytest.mark.parametrize("domain", ["plane", "cylinder", "cube"])
@pytest.mark.parametrize("triangles", [None, 500])
def test_meshes_round_the_globe_are_closed(domain, triangles):
    with tetrakis.open(on_cube(domain=domain)) as opened:
        mesh = opened.globe_mesh(triangles, exaggeration=50)
    positions, pixels, heights, corners = mesh
    assert len(positions) == len(pixels) == len(heights) and corners.max() < len(heights)
    assert closed(mesh)
    assert triangles is None or len(corners) < 1500
    radii = np.linalg.norm(positions, axis=1) - 50.0 * heights
    assert 6356751 < radii.min() and radii.max() < 6378138
    a, b, c = (positions[corners[:, k]] for k in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0).all()


def test_a_mesh_lies_where_its_pixels_do():
    with tetrakis.open(on_cube(domain="cylinder")) as opened:
        mesh = opened.globe_mesh(300, semi_major=1.0e6, semi_minor=1.0e6)
    inner = (mesh.pixels[:, 1] > 0.5) & (mesh.pixels[:, 1] < ROWS - 0.5)
    longitude, latitude = (PLACE[3 * k] + mesh.pixels[inner, k] * (2, -2)[k] for k in range(2))
    x, y, z = mesh.positions[inner].T
    np.testing.assert_allclose(np.degrees(np.arcsin(z / np.hypot(np.hypot(x, y), z))), latitude)
    np.testing.assert_allclose(np.cos(np.arctan2(y, x) - np.radians(longitude)), 1)


def test_what_is_no_globe_is_refused(cube):
    holes = world()
    holes[4, 5] = np.nan
    for refused in (
        dict(geotransform=(-180.0, 1.0, 0, 90.0, 0, -1.0)),
        dict(geotransform=None),
        dict(psnr=None),
        dict(psnr=None, lossless=True),
        dict(psnr=None, max_error=1),
        dict(heights=holes),
        dict(heights=np.where(np.isnan(holes), -9999, holes).astype("i2"), nodata=-9999),
        dict(depth=15),
        dict(domain="plane", depth=4),
    ):
        with pytest.raises(tetrakis.TksUsageError) as caught:
            on_cube(**refused)
        assert str(caught.value).endswith(".")
    with pytest.raises(tetrakis.TksUsageError, match="globe_mesh"):
        cube.mesh(100)
    regional = on_cube(domain="plane", geotransform=(0.0, 1.0, 0, 50.0, 0, -0.5))
    for refused in (dict(triangles=0), dict(semi_minor=0.0), dict(exaggeration=float("nan"))):
        with pytest.raises(tetrakis.TksUsageError):
            cube.globe_mesh(**refused)
    with pytest.raises(tetrakis.TksUsageError):
        tetrakis.open(regional).globe_mesh()
