# SPDX-License-Identifier: Apache-2.0
"""Streams of several components, as `tetrakis combine` writes them: COMPONENT, subdatasets, the
domain TKS, and what is kept beside."""

import subprocess

import numpy as np
import pytest
from conftest import REPOSITORY, copy, gdal, memory, refused, terrain
from test_open_options import Server, opened, served

TETRAKIS = REPOSITORY / "build/tetrakis"
VECTORS = sorted(
    path
    for kind in ("components", "details", "refused_details")
    for path in (REPOSITORY / "conformance/vectors").glob(kind + "_*.tks")
)


def tetrakis(*arguments):
    command = [str(TETRAKIS), *map(str, arguments)]
    subprocess.run(command, check=True, capture_output=True, timeout=100)


@pytest.fixture(scope="module")
def streams(tmp_path_factory):
    """Heights with a texture, heights elsewhere in other units, normals, and classes."""
    folder = tmp_path_factory.mktemp("components")
    place = dict(crs="EPSG:32611", transform=(400000, 10, 0, 3800000, 0, -10))
    image = memory(np.stack([terrain(300, 340, "u1", seed) for seed in range(3)]), **place)
    gdal.GetDriverByName("GTiff").CreateCopy(str(folder / "image.tif"), image)
    copy(
        memory(terrain(dtype="i2"), unit="m", nodata=-9999, **place),
        folder / "today.tks",
        f"TEXTURE={folder}/image.tif",
    )
    holes = terrain(200, 260, seed=5)
    holes[20:60, 30:90] = -1
    facts = dict(unit="ft", nodata=-1, scale=0.5, offset=7, area_or_point="Point")
    elsewhere = dict(crs="EPSG:32633", transform=(500000, 20, 0, 4000000, 0, -20))
    copy(memory(holes, **facts, **elsewhere), folder / "before.tks")
    shades = memory(np.stack([terrain(80, 90, "u1", seed) for seed in range(3)]))
    copy(shades, folder / "normal.tks", "BYTES=9000")
    copy(image, folder / "classes.tks")
    return folder


@pytest.fixture(scope="module")
def stream(streams):
    name = streams / "all.tks"
    parts = [f"{part}={streams}/{part}.tks" for part in ("today", "before", "normal", "classes")]
    tetrakis("combine", *parts, "-o", name)
    return name


def same(dataset, expected):
    np.testing.assert_array_equal(dataset.ReadAsArray(), expected.ReadAsArray())
    assert dataset.GetGeoTransform(can_return_null=True) == expected.GetGeoTransform(
        can_return_null=True
    )
    assert dataset.GetProjection() == expected.GetProjection()
    assert dataset.RasterCount == expected.RasterCount
    for number in range(1, dataset.RasterCount + 1):
        ours, theirs = dataset.GetRasterBand(number), expected.GetRasterBand(number)
        for ask in ("GetNoDataValue", "GetUnitType", "GetScale", "GetOffset", "DataType",
                    "GetColorInterpretation", "GetOverviewCount"):  # fmt: skip
            told, wanted = getattr(ours, ask), getattr(theirs, ask)
            assert (told() if callable(told) else told) == (wanted() if callable(wanted) else wanted)
        for level in range(ours.GetOverviewCount()):
            np.testing.assert_array_equal(
                ours.GetOverview(level).ReadAsArray(), theirs.GetOverview(level).ReadAsArray()
            )
    assert dataset.GetMetadataItem("AREA_OR_POINT") == expected.GetMetadataItem("AREA_OR_POINT")


@pytest.mark.parametrize(
    "form", ["COMPONENT=before", "COMPONENT=2", 'TKS:"{}":component=2', "TKS:{}:component=before"]
)
def test_other_heights_are_those_of_their_own_stream(stream, streams, form):
    named = form.startswith("TKS:")
    dataset = opened(form.format(stream)) if named else opened(stream, form)
    same(dataset, opened(streams / "before.tks"))
    facts = dataset.GetMetadata("TKS")
    assert facts["TARGET"] == "LOSSLESS" and facts["COMPONENT"] == "2"
    assert dataset.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSLESS"
    assert not dataset.GetMetadata("SUBDATASETS")
    np.testing.assert_array_equal(
        dataset.ReadAsArray(30, 20, 41, 33),
        opened(streams / "before.tks").ReadAsArray(30, 20, 41, 33),
    )


def test_other_textures(stream, streams):
    same(opened(stream, "COMPONENT=classes"), opened(streams / "classes.tks"))
    normal = opened(stream, "COMPONENT=normal")
    np.testing.assert_array_equal(
        normal.ReadAsArray(), opened(streams / "normal.tks").ReadAsArray()
    )
    # Without a place of its own it lies where meshes of the first heights show it.
    assert normal.GetGeoTransform() == pytest.approx(
        (400005, 10 * 339 / 90, 0, 3799995, 0, -10 * 299 / 80)
    )
    assert "32611" in normal.GetProjection()


def test_a_name_of_both_kinds_opens_the_heights(stream, streams):
    same(opened(stream, "COMPONENT=today"), opened(stream))
    assert opened(f'TKS:"{stream}":component=today:texture').RasterCount == 3
    assert opened(f'TKS:"{stream}":texture', "COMPONENT=normal").RasterXSize == 90
    assert opened(f'TKS:"{stream}":heights', "COMPONENT=normal").RasterXSize == 340


def test_gdalinfo_lists_what_there_is(stream):
    command = ["gdalinfo", "-mdd", "TKS", str(stream)]
    told = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    for line in (
        "COMPONENTS=5",
        "COMPONENT=0",
        "COMPONENT_0_NAME=today",
        "COMPONENT_1_KIND=TEXTURE",
        "COMPONENT_2_NAME=before",
        "COMPONENT_2_KIND=HEIGHTS",
        "COMPONENT_4_NAME=classes",
        f'SUBDATASET_2_NAME=TKS:"{stream}":texture',
        f'SUBDATASET_3_NAME=TKS:"{stream}":component=2',
        "SUBDATASET_3_DESC=[200x260] heights before",
        "SUBDATASET_5_DESC=[300x340] texture classes",
    ):
        assert f"  {line}\n" in told, told
    assert "SUBDATASET_6" not in told


def test_subdatasets_open(stream):
    listed = opened(stream).GetSubDatasets()
    sizes = [(each.RasterXSize, each.RasterYSize, each.RasterCount)
             for each in (opened(name) for name, _ in listed)]  # fmt: skip
    assert sizes == [(340, 300, 1), (340, 300, 3), (260, 200, 1), (90, 80, 3), (340, 300, 3)]


def test_streams_of_one_kind(streams, tmp_path):
    name = tmp_path / "two.tks"
    tetrakis("combine", streams / "normal.tks", f"more={streams}/classes.tks", "-o", name)
    first, second = (opened(listed) for listed, _ in opened(name).GetSubDatasets())
    same(first, opened(name))
    np.testing.assert_array_equal(
        second.ReadAsArray(), opened(streams / "classes.tks").ReadAsArray()
    )
    assert not opened(streams / "normal.tks").GetMetadata("SUBDATASETS")
    assert "COMPONENTS" not in opened(streams / "today.tks").GetMetadata("TKS")


def test_gdal_translate_gets_one_out(stream, streams, tmp_path):
    for form, source in (("-oo COMPONENT=before", stream), ("", f'TKS:"{stream}":component=2')):
        command = ["gdal_translate", "-q", *form.split(), str(source), str(tmp_path / "a.tif")]
        subprocess.run(command, check=True, timeout=60)
        made, wanted = opened(tmp_path / "a.tif"), opened(streams / "before.tks")
        np.testing.assert_array_equal(made.ReadAsArray(), wanted.ReadAsArray())
        band = made.GetRasterBand(1)
        assert (band.GetNoDataValue(), band.GetUnitType(), band.GetScale()) == (-1, "ft", 0.5)
        assert made.GetGeoTransform() == (500000, 20, 0, 4000000, 0, -20)
        assert made.GetSpatialRef().GetAuthorityCode(None) == "32633"


def test_what_is_kept_beside_is_of_one_component(stream, streams, tmp_path):
    name = tmp_path / "a.tks"
    name.write_bytes(stream.read_bytes())
    opened(name, "COMPONENT=before").SetMetadataItem("SEEN", "before")
    opened(f'TKS:"{name}":component=3').SetMetadataItem("SEEN", "normal")
    opened(name).SetMetadataItem("SEEN", "first")
    assert (tmp_path / "a.tks.aux.xml").exists()
    said = [opened(name, *form).GetMetadataItem("SEEN") for form in
            ([], ["COMPONENT=0"], ["COMPONENT=2"], ["COMPONENT=normal"], ["COMPONENT=classes"],
             ["COMPONENT=1"])]  # fmt: skip
    assert said == ["first", "first", "before", "normal", None, None]
    assert opened(f'TKS:"{name}":component=before').GetMetadataItem("SEEN") == "before"
    rough = opened(name, "COMPONENT=before", "BYTES=20000")
    rough.SetMetadataItem("SEEN", "rough")
    rough = None
    assert opened(name, "COMPONENT=before").GetMetadataItem("SEEN") == "before"


def test_prefixes_and_strict(stream, streams):
    wanted = opened(streams / "before.tks").ReadAsArray().astype(float)
    errors = []
    for size in (20000, 60000, 10**9):
        rough = opened(stream, "COMPONENT=before", f"BYTES={size}")
        errors.append(np.sqrt(np.mean((rough.ReadAsArray() - wanted) ** 2)))
        if size < 10**9:
            assert float(rough.GetMetadataItem("RMSE", "TKS")) > 0
    assert errors[0] > errors[1] > errors[2] == 0
    np.testing.assert_array_equal(
        opened(stream, "COMPONENT=before", "STRICT=YES").ReadAsArray(), wanted
    )


def test_windows_over_a_network(tmp_path):
    heights = [terrain(600, 700, seed=seed) for seed in (1, 2)]
    for number, each in enumerate(heights):
        copy(each, tmp_path / f"{number}.tks", "BLOCKSIZE=64", "INDEX=WINDOWS")
    tetrakis("combine", tmp_path / "0.tks", f"second={tmp_path}/1.tks", "-o", tmp_path / "a.tks")
    for options, wanted in (([], heights[0]), (["COMPONENT=second"], heights[1])):
        with served(tmp_path / "a.tks") as url:
            dataset = opened(url, *options)
            part = dataset.ReadAsArray(130, 470, 60, 50)
            np.testing.assert_array_equal(part, wanted[470:520, 130:190])
            assert sum(last - first for first, last in Server.ranges) < len(Server.data) / 4
            np.testing.assert_array_equal(dataset.ReadAsArray(), wanted)


@pytest.mark.parametrize("vector", VECTORS, ids=lambda path: path.stem)
def test_components_of_damaged_streams_read_or_are_refused(vector):
    whole = vector.read_bytes()
    rng = np.random.default_rng(len(whole))
    variants = [whole, whole[: len(whole) // 2]]
    for at in rng.integers(0, min(len(whole), 420), 12):
        damaged = bytearray(whole)
        damaged[at] ^= 1 << int(rng.integers(0, 8))
        variants.append(bytes(damaged))
    for number, data in enumerate(variants):
        name = f"/vsimem/{vector.stem}_{number}.tks"
        gdal.FileFromMemBuffer(name, data)
        for component in range(6):
            try:
                dataset = gdal.Open(f'TKS:"{name}":component={component}')
                assert dataset.ReadAsArray() is not None
                assert dataset.GetMetadata("TKS")["COMPONENT"] == str(component)
            except RuntimeError as error:
                assert str(error).rstrip().endswith("."), error
                assert number > 0 or "details" in vector.stem or "no component" in str(error)
        gdal.Unlink(name)


def test_what_is_no_component(stream, streams, tmp_path):
    for form in ("COMPONENT=after", "COMPONENT=5", "COMPONENT=-1", "COMPONENT=2x"):
        refused(lambda form=form: opened(stream, form), "no component")
    refused(lambda: opened(stream, "COMPONENT="), "names no component")
    refused(lambda: opened(f'TKS:"{stream}":component=9'), "no component")
    refused(lambda: opened(f'TKS:"{stream}":component='), "component=NUMBER")
    refused(lambda: opened(f'TKS:"{stream}":component=2', "COMPONENT=3"), "exclude each other")
    refused(lambda: opened(f'TKS:"{streams}/before.tks":component=0:texture'), "has no texture")
    frames = memory(np.stack([terrain(40, 50, "i2", seed) for seed in range(3)]))
    copy(frames, tmp_path / "frames.tks", "FRAMES=YES")
    refused(lambda: opened(tmp_path / "frames.tks", "COMPONENT=0"), "sequence")
    later = REPOSITORY / "conformance/vectors/details_18x11.tks"
    refused(lambda: opened(later, "COMPONENT=unknown"), "does not know")
