# SPDX-License-Identifier: Apache-2.0
"""What CreateCopy keeps beside samples: place, reference system, nodata values, masks, metadata."""

import json
import subprocess

import numpy as np
import pytest
from conftest import REPOSITORY, copy, first_band, gdal, memory, refused, system, terrain, warnings_of

TETRAKIS = REPOSITORY / "build/tetrakis"


@pytest.mark.parametrize(
    "transform",
    [
        (400000, 30, 0, 3800000, 0, -30),
        (100.25, 3, 8, 900, 4, -6),
        (-180, 0.1, 0, 90, 0, -0.1),
        (5, -2, 0, 5, 0, 3),
    ],
)
def test_geotransforms_are_kept(tmp_path, transform):
    for registration in ("Area", "Point"):
        source = memory(terrain(20, 30), transform=transform, area_or_point=registration)
        dataset = copy(source, tmp_path / "a.tks")
        assert dataset.GetGeoTransform() == transform
        assert dataset.GetMetadataItem("AREA_OR_POINT") == registration
        assert not (tmp_path / "a.tks.aux.xml").exists()
    assert copy(terrain(20, 30), tmp_path / "b.tks").GetGeoTransform(can_return_null=True) is None


def facts_of(name):
    """What the command line tells of a stream."""
    told = subprocess.run([TETRAKIS, "info", "--json", name], capture_output=True, check=True)
    return json.loads(told.stdout)


def fitted(name):
    """The bytes of the longitudes and latitudes that a stream takes along: heights, texture."""
    facts = facts_of(name)
    parts = [facts[part] or {} for part in ("heights", "texture")]
    return [part.get("position_bytes") or 0 for part in parts]


def test_places_that_browsers_do_not_know_take_degrees_along(tmp_path, texture):
    grid, name = (2600000, 30, 0, 1200000, 0, -30), tmp_path / "a.tks"
    for crs, known in (("EPSG:2056", False), ("EPSG:32632", True), (LOCAL, True)):
        copy(memory(terrain(120, 130), crs=crs, transform=grid), name)
        heights, nothing = fitted(name)
        assert (heights == 0) == known and heights <= 200 and nothing == 0
    # Those of heights serve a texture over the same ground.
    ground = memory(terrain(120, 130), crs="EPSG:2056", transform=grid)
    copy(ground, name, f"TEXTURE={texture}")
    assert fitted(name)[0] > 0
    picture = memory(
        np.zeros((3, 130, 140), np.uint8), crs="EPSG:2056", transform=(2600000, 1, 0, 1200000, 0, -1)
    )
    copy(picture, name)
    assert fitted(name)[1] > 0
    # A stream of few bytes has no room for them.
    copy(ground, name, "BYTES=700")
    assert fitted(name) == [0, 0]


LOCAL = 'LOCAL_CS["my grid",UNIT["metre",1]]'
LAMBERT = "+proj=lcc +lat_1=44 +lat_2=49 +lat_0=46.5 +lon_0=3 +x_0=7e5 +y_0=6.6e6 +ellps=GRS80"


@pytest.mark.parametrize(
    "crs", ["EPSG:32611", "EPSG:4326", "EPSG:32611+5773", "EPSG:6893", LOCAL, LAMBERT]
)
def test_reference_systems_are_kept(tmp_path, crs):
    source = memory(terrain(20, 30), crs=crs, transform=(1, 1, 0, 1, 0, -1))
    name = tmp_path / "a.tks"
    copy(source, name)
    back = gdal.Open(str(name)).GetSpatialRef()
    assert back.IsSame(system(crs)), back.ExportToWkt()
    axes = source.GetSpatialRef().GetDataAxisToSRSAxisMapping()
    assert back.GetDataAxisToSRSAxisMapping() == axes
    assert not (tmp_path / "a.tks.aux.xml").exists()
    if crs.startswith("EPSG"):
        assert b"CRS[" not in name.read_bytes()  # a code is enough


@pytest.mark.parametrize(
    "crs, place, metres",
    [
        ("EPSG:32611", (5e5, 4e6), (7, 9)),
        ("EPSG:6893", (-9e6, 0), (7, 9)),
        ("EPSG:2263", (1e6, 2e5), (7 * 1200 / 3937, 9 * 1200 / 3937)),
        (LOCAL, (1, 1), (7, 9)),
        ('LOCAL_CS["my grid",UNIT["foot",0.3048]]', (1, 1), (7 * 0.3048, 9 * 0.3048)),
        ('LOCAL_CS["my sky",UNIT["degree",0.0174532925199433]]', (1, 1), (0, 0)),
        (None, (1, 1), (0, 0)),
        # At 60 degrees a map by Mercator is twice as large as the ground.
        ("EPSG:3857", (1e6, 8399738), (7 * 0.50125, 9 * 0.50042)),
        # A degree of the Moon has 30 km.
        ("+proj=longlat +R=1737400", (20, 60), (7 * 15161.68, 9 * 30323.35)),
        ("+proj=merc +R=1737400", (1e6, 2288079), (7 * 0.5, 9 * 0.5)),
    ],
)
def test_spacing_is_in_metres_of_the_ground(tmp_path, crs, place, metres):
    """The codec weighs heights against texture by it."""
    facts = {"crs": crs} if crs else {}
    step = 1 if crs is None or "longlat" not in crs else 1e-4
    transform = (place[0] - 15 * 7 * step, 7 * step, 0, place[1] + 10 * 9 * step, 0, -9 * step)
    copy(memory(terrain(20, 30), transform=transform, **facts), tmp_path / "a.tks")
    heights = facts_of(tmp_path / "a.tks")["heights"]
    spacing = [heights["spacing_x"] or 0, heights["spacing_y"] or 0]
    np.testing.assert_allclose(spacing, np.multiply(metres, step), rtol=2e-4)


def test_epoch_goes_beside(tmp_path):
    crs = system("EPSG:9754")
    crs.SetCoordinateEpoch(2020.5)
    source = memory(terrain(20, 30))
    source.SetSpatialRef(crs)
    copy(source, tmp_path / "a.tks")
    assert gdal.Open(str(tmp_path / "a.tks")).GetSpatialRef().GetCoordinateEpoch() == 2020.5


def test_reference_system_that_cannot_be_parsed(tmp_path, monkeypatch):
    """A stream may hold any text there; the raster is opened without, and a warning says why."""
    source = memory(terrain(20, 30), crs=LOCAL)
    name = tmp_path / "a.tks"
    copy(source, name)
    data = bytearray(name.read_bytes())
    at = data.index(b"ENGCRS")
    data[at : at + 6] = b"HUMBUG"
    # The header ends with a checksum of all bytes before it (docs/FORMAT.md, section 2).
    import zlib

    size, shift, start = 0, 0, 7
    while True:
        size |= (data[start] & 127) << shift
        shift, start = shift + 7, start + 1
        if data[start - 1] < 128:
            break
    end = start + size
    data[end : end + 4] = zlib.crc32(data[:end]).to_bytes(4, "little")
    name.write_bytes(data)
    dataset, heard = warnings_of(lambda: gdal.Open(str(name)))
    assert dataset.GetSpatialRef() is None and any("HUMBUG" in text for text in heard)
    np.testing.assert_array_equal(dataset.ReadAsArray(), terrain(20, 30))


def test_facts_of_the_band(tmp_path):
    source = memory(
        terrain(20, 30, "i2"), nodata=-7, unit="ft", scale=-2.5, offset=1e3, description="höhe"
    )
    band = first_band(copy(source, tmp_path / "a.tks"))
    assert (band.GetScale(), band.GetOffset(), band.GetUnitType()) == (-2.5, 1000, "ft")
    assert band.GetDescription() == "höhe" and band.GetNoDataValue() == -7
    plain = first_band(copy(terrain(20, 30), tmp_path / "b.tks"))
    assert plain.GetScale() is None and plain.GetOffset() is None and plain.GetUnitType() == ""


@pytest.mark.parametrize("nodata", [-9999, -3.4028234663852886e38, -3.402823e38, float("nan"), 0.1])
def test_nodata_of_floats(tmp_path, nodata):
    heights = terrain(30, 40)
    heights[3:9, 5:20] = nodata
    dataset = copy(memory(heights, nodata=nodata), tmp_path / "a.tks", "MAX_Z_ERROR=1")
    band = dataset.GetRasterBand(1)
    np.testing.assert_array_equal(band.ReadAsArray()[3:9, 5:20], heights[3:9, 5:20])
    void = np.zeros((30, 40), bool)
    void[3:9, 5:20] = True
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() == 0, void)


@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_nan_without_nodata_stays_undeclared(tmp_path, dtype):
    """As GDAL copies it. Overviews leave it out of their means all the same."""
    heights = terrain(600, 700).astype(dtype)
    heights[30:91, 50:201] = np.nan
    band = first_band(copy(heights, tmp_path / "a.tks"))
    np.testing.assert_array_equal(band.ReadAsArray(), heights)
    assert band.GetNoDataValue() is None and band.GetMaskFlags() == gdal.GMF_ALL_VALID
    coarse = band.GetOverview(0).ReadAsArray()
    np.testing.assert_array_equal(np.isnan(coarse), np.isnan(heights).reshape(300, 2, 350, 2)
                                  .all(axis=(1, 3)))
    declared = first_band(copy(memory(heights, nodata=np.nan), tmp_path / "b.tks"))
    assert np.isnan(declared.GetNoDataValue())


def test_a_scale_of_0_is_none(tmp_path):
    heights = terrain(20, 30, "i2")
    source = memory(heights, scale=0, offset=7)
    dataset, heard = warnings_of(lambda: copy(source, tmp_path / "a.tks"))
    assert [text for text in heard if "scale of 0 is none" in text]
    np.testing.assert_array_equal(dataset.ReadAsArray(), heights)
    assert (dataset.GetRasterBand(1).GetScale(), dataset.GetRasterBand(1).GetOffset()) == (1, 7)


@pytest.mark.parametrize("dtype", ["u1", "i2", "u2", "f4"])
def test_masks_become_nodata(tmp_path, dtype):
    heights = terrain(30, 40, dtype) // 2 + 1
    source = memory(heights.astype(dtype))
    source.CreateMaskBand(gdal.GMF_PER_DATASET)
    mask = np.full((30, 40), 255, np.uint8)
    mask[3:9, 5:20] = 0
    source.GetRasterBand(1).GetMaskBand().WriteArray(mask)
    band = first_band(copy(source, tmp_path / "a.tks"))
    assert band.GetNoDataValue() is not None
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray(), mask)
    np.testing.assert_array_equal(band.ReadAsArray()[mask > 0], heights[mask > 0])


def test_a_mask_without_room(tmp_path):
    source = memory(np.arange(512, dtype=np.uint16).astype(np.uint8).reshape(16, 32))
    source.CreateMaskBand(gdal.GMF_PER_DATASET)
    mask = np.full((16, 32), 255, np.uint8)
    mask[0, 0] = 0
    source.GetRasterBand(1).GetMaskBand().WriteArray(mask)
    refused(lambda: copy(source, tmp_path / "a.tks"), "wider type")


@pytest.mark.parametrize("hole", [-np.finfo(np.float64).max, np.finfo(np.float64).max, 1e300])
def test_doubles_with_nodata_beyond_floats(tmp_path, hole):
    """Voids count for no rounding, whether a nodata value or a mask tells them."""
    heights = terrain(30, 40).astype(np.float64)
    void = np.zeros((30, 40), bool)
    void[3:9, 5:20] = True
    heights[void] = hole
    masked = memory(heights)
    masked.CreateMaskBand(gdal.GMF_PER_DATASET)
    masked.GetRasterBand(1).GetMaskBand().WriteArray(np.where(void, 0, 255).astype(np.uint8))
    for source in (memory(heights, nodata=hole), masked):
        for options in ((), ("MAX_Z_ERROR=1",)):
            band = first_band(copy(source, tmp_path / "a.tks", *options))
            np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() == 0, void)
            off = np.abs(band.ReadAsArray() - heights)[~void].max()
            assert off <= (1 if options else 0)


@pytest.mark.parametrize("dtype", ["i2", "f4", "f8"])
def test_fill_that_nobody_declared(tmp_path, capfd, dtype):
    """A copy that need not be strict declares it, and so does not spend a small budget on it."""
    heights = terrain(64, 80).astype(dtype)
    hole = np.zeros(heights.shape, bool)
    hole[::7, ::5] = True
    heights[hole] = -9999
    driver = gdal.GetDriverByName("TKS")
    off = []
    for strict in (False, True):
        name = str(tmp_path / f"{strict}.tks")
        driver.CreateCopy(name, memory(heights), strict, ["BYTES=600"])
        assert ("160 samples are -9999" in capfd.readouterr().err) == (not strict)
        dataset = gdal.Open(name)
        band = dataset.GetRasterBand(1)
        assert band.GetNoDataValue() == (None if strict else -9999)
        off.append(np.abs(band.ReadAsArray() - heights)[~hole].mean())
    assert off[0] < off[1] / 10
    name = str(tmp_path / "exact.tks")
    driver.CreateCopy(name, memory(heights), False)
    dataset = gdal.Open(name)
    band = dataset.GetRasterBand(1)
    np.testing.assert_array_equal(band.ReadAsArray(), heights)
    np.testing.assert_array_equal(band.GetMaskBand().ReadAsArray() == 0, hole)


def test_other_metadata_go_beside(tmp_path):
    source = memory(terrain(20, 30))
    source.SetMetadataItem("MISSION", "SRTM")
    copy(source, tmp_path / "a.tks")
    assert gdal.Open(str(tmp_path / "a.tks")).GetMetadataItem("MISSION") == "SRTM"


def test_texts_become_utf8(tmp_path):
    """Older files have them in ISO 8859-1."""
    name = tmp_path / "a.tif"
    source = memory(terrain(20, 30), unit="mQQ", description="HQQhe")
    gdal.GetDriverByName("GTiff").CreateCopy(str(name), source)
    data = name.read_bytes()
    assert b"mQQ" in data and b"HQQhe" in data
    name.write_bytes(data.replace(b"mQQ", b"m\xb2 ").replace(b"HQQhe", b"H\xf6 he"))
    copy(gdal.Open(str(name)), tmp_path / "a.tks")
    band = first_band(gdal.Open(str(tmp_path / "a.tks")))
    assert band.GetUnitType().strip() == "m²"
    assert band.GetDescription() == "Hö he"


def test_the_ground_of_a_globe_comes_first(tmp_path):
    """Errors of geographic grids that reach a pole count by area, as on the command line."""
    heights = terrain(128, 256, "i2")
    area = np.cos(np.radians(90 - (np.arange(128) + 0.5) * 180 / 128))[:, np.newaxis]

    def squares(north, row):
        place = {"transform": (-180, 360 / 256, 0, north, 0, row), "crs": "EPSG:4326"}
        written = copy(memory(heights, **place), tmp_path / "a.tks", "BYTES=3000", "DOMAIN=PLANE")
        return (area * (written.ReadAsArray().astype("f8") - heights) ** 2).sum()

    by_samples = squares(5, -10 / 128)
    assert squares(90, -180 / 128) < by_samples
    assert squares(-90, 180 / 128) < by_samples


def test_grids_that_go_round_are_cylinders(tmp_path):
    """Geographic grids of 360 degrees, of any origin, and pictures on them; no others."""
    heights, picture = terrain(20, 72, "i2"), terrain(20, 72, "u1")

    def domain(array, *options, **facts):
        dataset = copy(memory(array, **facts), tmp_path / "a.tks", *options)
        np.testing.assert_array_equal(dataset.ReadAsArray(), array)
        return dataset.GetMetadataItem("DOMAIN", "TKS")

    world = {"transform": (-180, 5, 0, 50, 0, -5), "crs": "EPSG:4326"}
    assert domain(heights, **world) == "CYLINDER"
    assert domain(heights, transform=(0, 5, 0, -50, 0, 5), crs="EPSG:4326") == "CYLINDER"
    assert domain(heights, "DOMAIN=PLANE", **world) is None
    assert domain(heights, transform=(-180, 4.99, 0, 50, 0, -5), crs="EPSG:4326") is None
    assert domain(heights, transform=(-180, 5, 0, 50, 0, -5), crs="EPSG:3857") is None
    assert domain(heights) is None
    assert domain(heights, "DOMAIN=CYLINDER") == "CYLINDER"
    refused(lambda: domain(heights, "DOMAIN=BALL", **world), "DOMAIN=BALL")

    image = str(tmp_path / "image.tif")
    gdal.GetDriverByName("GTiff").CreateCopy(image, memory(picture))
    name = tmp_path / "b.tks"
    copy(memory(heights, **world), name, "TEXTURE=" + image)
    draped = gdal.Open(f'TKS:"{name}":texture')
    np.testing.assert_array_equal(draped.ReadAsArray(), picture)
    assert draped.GetMetadataItem("DOMAIN", "TKS") == "CYLINDER"
    for transform, expected in ((world["transform"], "CYLINDER"), ((0, 1, 0, 50, 0, -1), None)):
        gdal.GetDriverByName("GTiff").CreateCopy(image, memory(picture, transform=transform))
        copy(memory(heights, **world), name, "TEXTURE=" + image)
        placed = gdal.Open(f'TKS:"{name}":texture')
        assert placed.GetMetadataItem("DOMAIN", "TKS") == expected
