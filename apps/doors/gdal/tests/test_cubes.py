# SPDX-License-Identifier: Apache-2.0
"""Heights of the whole Earth on a cube: what comes back is their grid."""

import subprocess

import numpy as np
import pytest
from conftest import REPOSITORY, RGB, copy, gdal, memory, refused, system
from test_open_options import Server, opened, served

TETRAKIS = REPOSITORY / "build/tetrakis"
ROWS, COLUMNS = 150, 300
PLACE = (-180.0, 1.2, 0.0, 90.0, 0.0, -1.2)


def world(dtype="f4", rows=ROWS, columns=COLUMNS):
    """Smooth on the sphere, from -4000 to 4000."""
    latitude = np.radians(90 - (np.arange(rows)[:, np.newaxis] + 0.5) * 180 / rows)
    longitude = np.radians(-180 + (np.arange(columns) + 0.5) * 360 / columns)
    x, y = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)
    return (2000 * (np.sin(2 * x + 0.3) * np.cos(3 * y) + np.sin(latitude) ** 3)).astype(dtype)


def globe(heights=None, **facts):
    facts = {"transform": PLACE, "crs": "EPSG:4326", "unit": "m", **facts}
    return memory(world() if heights is None else heights, **facts)


def rmse(dataset, heights=None):
    off = dataset.ReadAsArray().astype("f8") - (world() if heights is None else heights)
    return np.sqrt(np.mean(off**2))


def run(*command):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    name = tmp_path_factory.mktemp("cube") / "a.tks"
    source = globe(area_or_point="Point", description="ground")
    copy(source, name, "DOMAIN=CUBE", "PSNR=70", "INDEX=YES")
    return name


def test_a_cube_gives_its_grid(cube):
    dataset = opened(cube)
    band = dataset.GetRasterBand(1)
    assert (dataset.RasterXSize, dataset.RasterYSize) == (COLUMNS, ROWS)
    assert dataset.GetGeoTransform() == PLACE
    assert dataset.GetSpatialRef().IsSame(system("EPSG:4326"))
    assert dataset.GetMetadataItem("AREA_OR_POINT") == "Point"
    assert band.DataType == gdal.GDT_Float32 and band.GetNoDataValue() is None
    assert (band.GetUnitType(), band.GetDescription()) == ("m", "ground")
    assert rmse(dataset) < 2


def test_it_says_that_it_is_a_cube(cube):
    dataset = opened(cube)
    said = dataset.GetMetadata("TKS")
    assert (said["DOMAIN"], said["DEPTH"]) == ("CUBE", "7")
    assert dataset.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSY"
    assert not {"TARGET", "MAX_ERROR", "BLOCKSIZE"} & set(said)
    assert "DOMAIN=CUBE\n" in run("gdalinfo", "-mdd", "TKS", cube)


def test_windows_are_cut_from_the_grid(cube):
    whole = opened(cube).ReadAsArray()
    for window in ((250, 100, 50, 50), (0, 0, 1, 1), (299, 0, 1, 150), (10, 149, 270, 1)):
        x, y, width, height = window
        for dataset in (opened(cube), opened(cube, "NUM_THREADS=3")):
            part = dataset.ReadAsArray(*window)
            np.testing.assert_array_equal(part, whole[y : y + height, x : x + width])


def test_overviews_are_coarser_grids(tmp_path):
    rows, columns = 600, 1200
    name = tmp_path / "a.tks"
    place = (-180.0, 0.3, 0.0, 90.0, 0.0, -0.3)
    source = globe(world(rows=rows, columns=columns), transform=place)
    copy(source, name, "DOMAIN=CUBE", "PSNR=70", "INDEX=YES")
    dataset = opened(name)
    band = dataset.GetRasterBand(1)
    sizes = [(600, 300), (300, 150), (150, 75)]
    overviews = [band.GetOverview(i) for i in range(band.GetOverviewCount())]
    assert [(each.XSize, each.YSize) for each in overviews] == sizes
    for each, (width, height) in zip(overviews, sizes):
        off = each.ReadAsArray().astype("f8") - world(rows=height, columns=width)
        assert np.sqrt(np.mean(off**2)) < 20 * 300 / width
        part = each.ReadAsArray(7, 5, 40, 30)
        np.testing.assert_array_equal(part, each.ReadAsArray()[5:35, 7:47])
    # GDAL takes the overview that suits a smaller picture.
    small = dataset.ReadAsArray(buf_xsize=300, buf_ysize=150)
    np.testing.assert_array_equal(small, overviews[1].ReadAsArray())


def test_overviews_leave_out_a_repeated_column(tmp_path):
    grid = np.concatenate([world(), world()[:, :1]], axis=1)
    copy(globe(grid), tmp_path / "a.tks", "DOMAIN=CUBE", "PSNR=60")
    dataset = opened(tmp_path / "a.tks")
    band = dataset.GetRasterBand(1)
    assert (band.XSize, band.GetOverviewCount(), band.GetOverview(0).XSize) == (301, 1, 150)
    off = band.GetOverview(0).ReadAsArray() - world(rows=75, columns=150)
    assert np.sqrt(np.mean(off.astype("f8") ** 2)) < 20


def test_prefixes_are_rougher_globes(tmp_path):
    cube = tmp_path / "a.tks"
    copy(globe(), cube, "DOMAIN=CUBE", "PSNR=70")
    size = cube.stat().st_size
    errors = []
    for limit in (size * 2 // 5, size * 2 // 3, size):
        prefix = opened(cube, f"BYTES={limit}")
        assert (prefix.RasterXSize, prefix.RasterYSize) == (COLUMNS, ROWS)
        errors.append(rmse(prefix))
        (tmp_path / "cut.tks").write_bytes(cube.read_bytes()[:limit])
        cut = opened(tmp_path / "cut.tks").ReadAsArray()
        np.testing.assert_array_equal(cut, prefix.ReadAsArray())
    assert errors[0] > errors[1] > errors[2]
    assert rmse(opened(cube, "STRICT=YES")) == errors[2]


@pytest.mark.parametrize("index", ["INDEX=NO", "INDEX=YES"])
def test_over_a_network_the_first_pixel_takes_the_stream(tmp_path, index):
    rough = world() + np.random.default_rng(3).normal(0, 50, (ROWS, COLUMNS)).astype("f4")
    copy(globe(rough), tmp_path / "a.tks", "DOMAIN=CUBE", "BYTES=60000", index)
    here = opened(tmp_path / "a.tks").ReadAsArray()
    with served(tmp_path / "a.tks") as url:
        dataset = opened(url)
        assert sum(last - first for first, last in Server.ranges) < len(Server.data) / 2
        for x in (7, 200):
            part = dataset.ReadAsArray(x, 40, 9, 9)
            np.testing.assert_array_equal(part, here[40:49, x : x + 9])
            assert sum(last - first for first, last in Server.ranges) <= len(Server.data)


def test_windows_of_regions_take_what_reaches_them(tmp_path):
    rough = world() + np.random.default_rng(3).normal(0, 50, (ROWS, COLUMNS)).astype("f4")
    options = ("DOMAIN=CUBE", "BYTES=60000", "INDEX=YES", "DEPTH=7", "BLOCKSIZE=16")
    copy(globe(rough), tmp_path / "a.tks", *options)
    copy(globe(rough), tmp_path / "whole.tks", *options[:4])
    assert opened(tmp_path / "a.tks").GetMetadataItem("DOMAIN", "TKS") == "CUBE"
    here = opened(tmp_path / "a.tks").ReadAsArray()
    whole = opened(tmp_path / "whole.tks")
    assert rmse(opened(tmp_path / "a.tks"), rough) < 1.1 * rmse(whole, rough)
    with served(tmp_path / "a.tks") as url:
        dataset = opened(url)
        for window in ((40, 60, 9, 9), (296, 70, 4, 3), (200, 0, 5, 2)):
            x, y, width, height = window
            part = dataset.ReadAsArray(*window)
            np.testing.assert_array_equal(part, here[y : y + height, x : x + width])


@pytest.mark.parametrize("dtype, scale, offset", [("f4", 1, 0), ("i2", 1, 0), ("u2", 0.5, -4500)])
def test_the_command_line_agrees(tmp_path, dtype, scale, offset):
    """It writes the same bytes, and reads the same grid, as samples of the first type."""
    source, out = tmp_path / "a.tif", tmp_path / "back.tif"
    ours, theirs = tmp_path / "ours.tks", tmp_path / "theirs.tks"
    steps = ((world("f8") - offset) / scale).round(0 if dtype != "f4" else 3).astype(dtype)
    dataset = globe(steps, scale=scale, offset=offset, area_or_point="Area")
    gdal.GetDriverByName("GTiff").CreateCopy(str(source), dataset)
    run("gdal_translate", "-co", "DOMAIN=CUBE", "-co", "BYTES=6k", "-co", "DEPTH=6", source, ours)
    run(TETRAKIS, "encode", source, "--domain", "cube", "--bytes", "6k", "--depth", 6, "-o", theirs)
    assert ours.read_bytes() == theirs.read_bytes()
    run(TETRAKIS, "decode", ours, "--height", out)
    there, here = opened(out).ReadAsArray(), opened(ours)
    band = here.GetRasterBand(1)
    assert (band.GetScale() or 1, band.GetOffset() or 0) == (scale, offset)
    grid = here.ReadAsArray()
    assert there.dtype == np.dtype(dtype) and grid.dtype == np.float32
    assert np.abs(grid - there.astype("f8")).max() <= (0 if dtype == "f4" else 0.501)
    assert rmse(here, steps) * scale < 30


def test_other_grids_that_go_round(tmp_path):
    """Of any origin, with rows that go north, in grads, with the first column there again."""
    name = tmp_path / "a.tks"
    half = COLUMNS // 2
    grads = 'GEOGCS["grads",DATUM["a",SPHEROID["b",6378137,298.257]],PRIMEM["Greenwich",0],'
    grads += 'UNIT["grad",0.015707963267948967]]'
    for heights, facts in (
        (np.roll(world(), half, axis=1), {"transform": (0, 1.2, 0, 90, 0, -1.2)}),
        (world()[::-1], {"transform": (-180, 1.2, 0, -90, 0, 1.2)}),
        (np.hstack([world(), world()[:, :1]]), {}),
        (world(), {"transform": (-200, 4 / 3, 0, 100, 0, -4 / 3), "crs": grads}),
    ):
        source = globe(np.ascontiguousarray(heights), **facts)
        dataset = copy(source, name, "DOMAIN=CUBE", "PSNR=70")
        assert dataset.GetMetadataItem("DOMAIN", "TKS") == "CUBE"
        assert dataset.GetGeoTransform() == source.GetGeoTransform()
        assert rmse(dataset, heights) < 3


def test_programs_write_cubes_piece_by_piece(tmp_path):
    name = str(tmp_path / "a.tks")
    options = ["DOMAIN=CUBE", "PSNR=70", "DEPTH=5"]
    made = gdal.GetDriverByName("TKS").Create(name, COLUMNS, ROWS, 1, gdal.GDT_Float32, options)
    made.SetGeoTransform(PLACE)
    made.SetSpatialRef(system("EPSG:4326"))
    made.GetRasterBand(1).WriteArray(world())
    made = None
    assert opened(name).GetMetadataItem("DEPTH", "TKS") == "5"
    assert rmse(opened(name)) < 10


def test_copies_of_a_cube(cube, tmp_path):
    """To another format with its place, and to a stream that keeps the samples."""
    tif = gdal.GetDriverByName("GTiff").CreateCopy(str(tmp_path / "a.tif"), opened(cube))
    np.testing.assert_array_equal(tif.ReadAsArray(), opened(cube).ReadAsArray())
    assert tif.GetGeoTransform() == PLACE
    exact = copy(opened(cube), tmp_path / "a.tks")
    np.testing.assert_array_equal(exact.ReadAsArray(), opened(cube).ReadAsArray())
    assert exact.GetMetadataItem("DOMAIN", "TKS") == "CYLINDER"


@pytest.mark.parametrize("options", [["DOMAIN=CYLINDER"], ["DOMAIN=CUBE", "PSNR=70"]])
def test_gdalwarp_cuts_windows_that_go_on_behind_the_last_column(tmp_path, options):
    name, cut = tmp_path / "a.tks", tmp_path / "cut.tif"
    whole = copy(globe(), name, *options).ReadAsArray()
    # Without -ovr NONE GDAL takes an overview here, of GeoTIFFs that have some as well.
    run("gdalwarp", "-q", "-ovr", "NONE", "-te", 168, 30, 192, 54, "-tr", 1.2, 1.2, name, cut)
    across = np.concatenate([whole[30:50, -10:], whole[30:50, :10]], axis=1)
    np.testing.assert_array_equal(gdal.Open(str(cut)).ReadAsArray(), across)


@pytest.mark.parametrize("placed", [True, False])
def test_a_texture_lies_on_longitudes_and_latitudes_over_a_cube(tmp_path, placed):
    shade = world(rows=64, columns=128) / 32 + 128
    facts = {"transform": (-180, 2.8125, 0, 90, 0, -2.8125), "crs": "EPSG:4326"} if placed else {}
    image = tmp_path / "t.tif"
    gdal.GetDriverByName("GTiff").CreateCopy(str(image), memory(shade.astype("u1"), **facts))
    name = tmp_path / "a.tks"
    copy(globe(), name, "DOMAIN=CUBE", "BYTES=20k", f"TEXTURE={image}", "BLOCKSIZE=32", "INDEX=YES")
    assert rmse(opened(name)) < 20
    texture = gdal.Open(f'TKS:"{name}":texture')
    assert texture.GetMetadataItem("BLOCKSIZE", "TKS") == "32"
    np.testing.assert_allclose(texture.GetGeoTransform(), (-180, 2.8125, 0, 90, 0, -2.8125))
    assert texture.GetSpatialRef().IsSame(system("EPSG:4326"))
    off = texture.ReadAsArray().astype("f8") - shade.astype("u1")
    assert np.sqrt(np.mean(off**2)) < 2


@pytest.mark.parametrize(
    "options, words",
    [
        (["DOMAIN=CUBE"], "give BYTES or PSNR"),
        (["DOMAIN=CUBE", "LOSSLESS=YES"], "give BYTES or PSNR"),
        (["DOMAIN=CUBE", "MAX_Z_ERROR=5"], "give BYTES or PSNR"),
        (["DOMAIN=CUBE", "BYTES=9k", "DEPTH=15"], "DEPTH=15 is no depth"),
        (["DOMAIN=CUBE", "BYTES=9k", "DEPTH=0"], "DEPTH=0 is no depth"),
        (["DEPTH=5", "BYTES=9k"], "give DOMAIN=CUBE"),
        (["DOMAIN=CYLINDER", "DEPTH=5", "BYTES=9k"], "give DOMAIN=CUBE"),
    ],
)
def test_options_that_do_not_go_together_are_refused(tmp_path, options, words):
    refused(lambda: copy(globe(), tmp_path / "a.tks", *options), words)
    assert not (tmp_path / "a.tks").exists()


def test_what_is_no_globe_is_refused(tmp_path):
    def write(source):
        copy(source, tmp_path / "a.tks", "DOMAIN=CUBE", "PSNR=60")

    narrow = (-180.0, 1.1, 0.0, 90.0, 0.0, -1.2)
    refused(lambda: write(globe(transform=narrow)), "do not go once round")
    refused(lambda: write(globe(transform=(-180, 1.2, 0, 95, 0, -1.2))), "between the poles")
    refused(lambda: write(globe(crs="EPSG:3857")), "no angles")
    refused(lambda: write(memory(world(), transform=PLACE)), "no angles")
    refused(lambda: write(memory(world())), "where the heights lie")
    hole = world()
    hole[70, 5] = -9999
    refused(lambda: write(globe(hole, nodata=-9999)), "no voids")
    colours = np.zeros((3, 20, 40), np.uint8)
    refused(lambda: write(memory(colours, colours=RGB)), "DOMAIN=CUBE needs heights")
    assert not (tmp_path / "a.tks").exists()
    create = gdal.GetDriverByName("TKS").Create
    name, options = str(tmp_path / "a.tks"), ["DOMAIN=CUBE", "PSNR=60"]
    refused(lambda: create(name, 40, 20, 3, gdal.GDT_Byte, options), "DOMAIN=CUBE need heights")


def test_a_nodata_value_that_no_sample_has_is_left_out(tmp_path):
    dataset = copy(globe(nodata=-9999), tmp_path / "a.tks", "DOMAIN=CUBE", "PSNR=60")
    assert dataset.GetRasterBand(1).GetNoDataValue() is None


@pytest.mark.parametrize("forest", ["cube_17x102", "torus_33x33", "joint_9x54_17x102"])
def test_patches_without_a_grid_are_refused(forest):
    name = REPOSITORY / f"conformance/vectors/forest_{forest}.tks"
    refused(lambda: opened(name), "square patches", "geographic grid")


def test_textures_on_patches_are_refused():
    name = REPOSITORY / "conformance/vectors/forest_texture_33x66.tks"
    refused(lambda: opened(name), "The texture lies on square patches")
