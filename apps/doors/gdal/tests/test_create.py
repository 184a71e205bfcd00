# SPDX-License-Identifier: Apache-2.0
"""Create(): programs that write piece by piece, and what stands under a name meanwhile."""

import gc
import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from conftest import RGB, first_band, gdal, memory, refused, system, terrain

TRANSFORM = (400000, 10, 0, 3800000, 0, -10)


def create(name, columns=90, rows=70, bands=1, kind=gdal.GDT_Float32, options=()):
    driver = gdal.GetDriverByName("TKS")
    return driver.Create(str(name), columns, rows, bands, kind, options=list(options))


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """Two GeoTIFFs side by side, polygons and points over them."""
    folder = tmp_path_factory.mktemp("inputs")
    heights = terrain(70, 180, "i2")
    heights[20:25, 30:40] = -5
    for number in (0, 1):
        place = (TRANSFORM[0] + 900 * number, *TRANSFORM[1:])
        part = heights[:, 90 * number : 90 * number + 90]
        source = memory(part, transform=place, crs="EPSG:32611", nodata=-5)
        gdal.GetDriverByName("GTiff").CreateCopy(str(folder / f"{number}.tif"), source)

    def features(geometries):
        crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32611"}}
        each = [
            {"type": "Feature", "properties": {"z": 7 + i}, "geometry": geometry}
            for i, geometry in enumerate(geometries)
        ]
        return json.dumps({"type": "FeatureCollection", "crs": crs, "features": each})

    corners = [(400100, 3799900), (400500, 3799900), (400500, 3799500), (400100, 3799900)]
    (folder / "areas.json").write_text(features([{"type": "Polygon", "coordinates": [corners]}]))
    points = [(400050 + 97 * i, 3799950 - 61 * (i * 5 % 9)) for i in range(9)]
    (folder / "points.json").write_text(
        features([{"type": "Point", "coordinates": point} for point in points])
    )
    return folder


COMMANDS = {
    "gdal_calc.py": ["-A", "0.tif", "--calc=A*2", "--type=Int32", "--NoDataValue=-9", "--quiet"],
    "gdal_rasterize": ["-q", "-a", "z", "-tr", "10", "10", "-a_nodata", "-1", "areas.json"],
    "gdal_grid": ["-q", "-zfield", "z", "-outsize", "60", "50", "-ot", "Float32", "points.json"],
    "gdal_merge.py": ["-q", "-a_nodata", "-5", "0.tif", "1.tif"],
    "gdalwarp": ["-q", "-t_srs", "EPSG:4326", "-r", "bilinear", "0.tif", "1.tif"],
    "gdal_proximity.py": ["-q", "-values", "-5", "0.tif"],
    "gdal_fillnodata.py": ["-q", "0.tif"],
    "gdaldem": ["slope", "-q", "0.tif"],
}


@pytest.mark.parametrize("tool", COMMANDS)
def test_programs_write_streams(inputs, tmp_path, tool):
    """They write what they write as a GeoTIFF."""
    written = {}
    for driver, extension in (("GTiff", "tif"), ("TKS", "tks")):
        name = str(tmp_path / f"out.{extension}")
        output = {
            "gdal_calc.py": [f"--outfile={name}", f"--format={driver}"],
            "gdal_merge.py": ["-of", driver, "-o", name],
            "gdaldem": [name, "-of", driver],
        }.get(tool)
        command = [tool, *COMMANDS[tool], *(output or ["-of", driver, name])]
        done = subprocess.run(
            command, cwd=inputs, capture_output=True, text=True, timeout=60, check=False
        )
        assert done.returncode == 0 and "ERROR" not in done.stderr, done.stderr
        dataset = gdal.Open(name)
        assert dataset.GetDriver().ShortName == driver
        written[driver] = dataset
    stream, tif = written["TKS"], written["GTiff"]
    np.testing.assert_array_equal(stream.ReadAsArray(), tif.ReadAsArray())
    assert stream.GetGeoTransform() == pytest.approx(tif.GetGeoTransform(), rel=1e-12)
    assert (stream.GetSpatialRef() is None) == (tif.GetSpatialRef() is None)
    if tif.GetSpatialRef() is not None:
        assert stream.GetSpatialRef().IsSame(tif.GetSpatialRef())
    bands = first_band(stream), first_band(tif)
    assert bands[0].GetNoDataValue() == bands[1].GetNoDataValue()
    assert set(os.listdir(tmp_path)) <= {"out.tif", "out.tks", "out.tif.aux.xml", "out.tks.aux.xml"}


def test_all_that_is_set_is_kept(tmp_path):
    name = tmp_path / "a.tks"
    heights = terrain(70, 90, "i2")
    dataset = create(name, kind=gdal.GDT_Int16)
    band = dataset.GetRasterBand(1)
    band.WriteArray(heights)
    band.WriteArray(np.full((10, 20), -7, "i2"), 30, 40)  # over what was written
    heights[40:50, 30:50] = -7
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)
    dataset.SetGeoTransform(TRANSFORM)
    dataset.SetSpatialRef(system("EPSG:32611+5773"))
    dataset.SetMetadataItem("MISSION", "SRTM")
    dataset.SetMetadataItem("AREA_OR_POINT", "Point")
    band.SetNoDataValue(-7)
    band.SetUnitType("m")
    band.SetScale(0.5)
    band.SetOffset(100)
    band.SetDescription("ridges")
    band.SetMetadataItem("SENSOR", "C")
    assert os.listdir(tmp_path) == []
    dataset = band = None
    back = gdal.Open(str(name))
    band = back.GetRasterBand(1)
    np.testing.assert_array_equal(back.ReadAsArray(), heights)
    assert back.GetGeoTransform() == TRANSFORM
    assert back.GetSpatialRef().IsSame(system("EPSG:32611+5773"))
    assert back.GetMetadata() == {"MISSION": "SRTM", "AREA_OR_POINT": "Point"}
    assert (band.GetNoDataValue(), band.GetUnitType(), band.GetDescription()) == (-7, "m", "ridges")
    assert (band.GetScale(), band.GetOffset()) == (0.5, 100)
    assert band.GetMetadataItem("SENSOR") == "C"
    assert set(os.listdir(tmp_path)) == {"a.tks", "a.tks.aux.xml"}


KINDS = ["Byte", "UInt16", "Int16", "UInt32", "Int32", "Float32", "Float64"]


@pytest.mark.parametrize("kind", KINDS)
def test_types(tmp_path, kind):
    heights = terrain(70, 90, "u1")
    dataset = create(tmp_path / "a.tks", kind=gdal.GetDataTypeByName(kind))
    dataset.GetRasterBand(1).WriteArray(heights)
    dataset = None
    back = first_band(gdal.Open(str(tmp_path / "a.tks")))
    assert gdal.GetDataTypeName(back.DataType) == ("Float32" if kind == "Float64" else kind)
    np.testing.assert_array_equal(back.ReadAsArray(), heights)


@pytest.mark.parametrize("kind", [gdal.GDT_Byte, gdal.GDT_UInt16])
@pytest.mark.parametrize("bands", [2, 3, 4])
def test_textures(tmp_path, bands, kind):
    colours = [gdal.GCI_GrayIndex] if bands == 2 else list(RGB)
    colours += [gdal.GCI_AlphaBand] * (bands % 2 == 0)
    layers = np.stack([terrain(70, 90, "u1", seed) for seed in range(bands)])
    dataset = create(tmp_path / "a.tks", bands=bands, kind=kind)
    for number, (layer, colour) in enumerate(zip(layers, colours), 1):
        dataset.GetRasterBand(number).SetColorInterpretation(colour)
        dataset.GetRasterBand(number).WriteArray(layer)
    dataset = None
    back = gdal.Open(str(tmp_path / "a.tks"))
    np.testing.assert_array_equal(back.ReadAsArray(), layers)
    said = [back.GetRasterBand(i + 1).GetColorInterpretation() for i in range(bands)]
    assert said == colours


@pytest.mark.parametrize("of_band", [False, True])
def test_masks(tmp_path, of_band):
    heights = terrain(70, 90, "i2")
    mask = np.full((70, 90), 255, np.uint8)
    mask[20:30, 40:60] = 0
    dataset = create(tmp_path / "a.tks", kind=gdal.GDT_Int16)
    band = dataset.GetRasterBand(1)
    if of_band:
        band.CreateMaskBand(0)
    else:
        dataset.CreateMaskBand(gdal.GMF_PER_DATASET)
    band.WriteArray(heights)
    band.GetMaskBand().WriteArray(mask)
    assert os.listdir(tmp_path) == []
    dataset = band = None
    back = first_band(gdal.Open(str(tmp_path / "a.tks")))
    np.testing.assert_array_equal(back.GetMaskBand().ReadAsArray(), mask)
    np.testing.assert_array_equal(back.ReadAsArray()[mask > 0], heights[mask > 0])
    assert os.listdir(tmp_path) == ["a.tks"]


def test_options_are_those_of_copies(tmp_path):
    name = tmp_path / "a.tks"
    dataset = create(name, options=["BYTES=900"])
    dataset.GetRasterBand(1).WriteArray(terrain(70, 90))
    dataset = None
    assert 700 < name.stat().st_size <= 900
    dataset = create(name, options=["MAX_Z_ERROR=3"])  # over a file that is there
    dataset.GetRasterBand(1).WriteArray(terrain(70, 90))
    assert os.listdir(tmp_path) == []
    dataset = None
    off = np.abs(gdal.Open(str(name)).ReadAsArray() - terrain(70, 90)).max()
    assert 1 < off <= 3


def test_what_was_not_written_is_0(tmp_path):
    create(tmp_path / "a.tks", 2000, 1500, kind=gdal.GDT_Byte)
    assert not gdal.Open(str(tmp_path / "a.tks")).ReadAsArray().any()


def test_what_no_stream_holds_is_refused_at_once(tmp_path):
    name = tmp_path / "a.tks"
    refused(lambda: create(name, kind=gdal.GDT_CFloat32), "CFloat32")
    refused(lambda: create(name, bands=5, kind=gdal.GDT_Byte), "1 to 4 bands")
    refused(lambda: create(name, bands=3), "bands of Byte")
    refused(lambda: create(name, bands=0), "one band or more")
    refused(lambda: create(name, options=["BYTES=many"]), "BYTES=many")
    many = {"bands": 3, "kind": gdal.GDT_Byte, "options": ["MAX_Z_ERROR=1"]}
    refused(lambda: create(name, **many), "MAX_Z_ERROR")
    refused(lambda: create(tmp_path / "nowhere/a.tks"), "a.tks", "cannot be written")
    texture = create(name, bands=3, kind=gdal.GDT_Byte)
    refused(lambda: texture.GetRasterBand(1).CreateMaskBand(0), "one mask")
    refused(lambda: texture.BuildOverviews("AVERAGE", [2]), "own overviews")
    texture = None
    gc.collect()  # of exceptions that know the dataset
    assert os.listdir(tmp_path) == ["a.tks"]


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize(
    "options, words",
    [([], "infinite"), (["BYTES=10"], "bytes"), (["INDEX=WINDOWS", "BYTES=4000"], "windows")],
)
def test_a_failure_leaves_nothing(tmp_path, options, words):
    """What only the encoder finds is an error of GDAL when the dataset is closed."""
    heights = terrain(70, 90)
    heights[3, 4] = heights[3, 4] if options else np.inf
    dataset = create(tmp_path / "a.tks", options=options)
    dataset.GetRasterBand(1).WriteArray(heights)
    heard = []
    gdal.PushErrorHandler(lambda *error: heard.append(error))
    try:
        dataset = None
    finally:
        gdal.PopErrorHandler()
    failures = [error[2] for error in heard if error[0] == gdal.CE_Failure]
    assert len(failures) == 1 and "a.tks" in failures[0] and words in failures[0], heard
    assert os.listdir(tmp_path) == []


def test_a_process_that_dies_leaves_nothing(tmp_path):
    script = (
        "import os, signal, sys, numpy as np; from osgeo import gdal;"
        "driver = gdal.GetDriverByName('TKS');"
        "dataset = driver.Create(sys.argv[1], 2000, 2000, 1, gdal.GDT_Float32);"
        "dataset.GetRasterBand(1).WriteArray(np.random.rand(2000, 2000).astype('f4'));"
        "dataset.FlushCache();"
        "os.kill(os.getpid(), signal.SIGKILL)"
    )
    done = subprocess.run([sys.executable, "-c", script, str(tmp_path / "a.tks")], timeout=60)
    assert done.returncode == -signal.SIGKILL
    assert os.listdir(tmp_path) == []


def test_virtual_files_and_pipes(tmp_path):
    dataset = create("/vsimem/created.tks")
    dataset.GetRasterBand(1).WriteArray(terrain(70, 90))
    assert not gdal.ReadDir("/vsimem/") or "created.tks" not in gdal.ReadDir("/vsimem/")
    dataset = None
    np.testing.assert_array_equal(gdal.Open("/vsimem/created.tks").ReadAsArray(), terrain(70, 90))
    assert [name for name in gdal.ReadDir("/vsimem/") if "etrakis" in name] == []
    gdal.Unlink("/vsimem/created.tks")
