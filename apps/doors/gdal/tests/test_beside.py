# SPDX-License-Identifier: Apache-2.0
"""What is kept beside a stream (name.aux.xml): it precedes, but tells nothing of the stream itself,
and is the same by every name of a raster."""

import os
import re
import shutil
import subprocess

import numpy as np
import pytest
from conftest import RGB, copy, first_band, gdal, memory, refused, system, terrain, warnings_of


@pytest.fixture
def image(tmp_path):
    name = str(tmp_path / "image.tif")
    layers = np.stack([terrain(40, 50, "u1", seed) for seed in range(3)])
    gdal.GetDriverByName("GTiff").CreateCopy(name, memory(layers, colours=RGB))
    return name


def with_metadata(array, **facts):
    source = memory(array, **facts)
    source.SetMetadataItem("MISSION", "SRTM")
    return source


def reversibility(dataset):
    return dataset.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE")


def test_only_what_the_stream_does_not_say_goes_beside(tmp_path, image):
    name = tmp_path / "a.tks"
    source = with_metadata(terrain(200, 300), area_or_point="Point", description="ridges")
    copy(source, name, "TEXTURE=" + image)
    first_band(gdal.Open(str(name))).ComputeStatistics(False)
    beside = (tmp_path / "a.tks.aux.xml").read_text()
    assert "MISSION" in beside and "STATISTICS_MEAN" in beside
    for own in ("COMPRESSION", "MAX_ERROR", "SUBDATASET", "AREA_OR_POINT", "ridges"):
        assert own not in beside, beside
    dataset = gdal.Open(str(name))
    assert dataset.GetMetadata() == {"AREA_OR_POINT": "Point", "MISSION": "SRTM"}
    assert dataset.GetRasterBand(1).GetDescription() == "ridges"


def of_stream(name):
    """The domain TKS of a lossless stream of heights without regions."""
    size = str(name.stat().st_size)
    return {
        "COMPLETE": "YES",
        "BYTES": size,
        "BYTES_ANNOUNCED": size,
        "TARGET": "LOSSLESS",
        "INDEX": "NO",
        "MAX_ERROR": "0",
        "RMSE": "0",
    }


def test_a_prefix_beside_metadata_is_lossy(tmp_path, image):
    name = str(tmp_path / "a.tks")
    copy(with_metadata(terrain(200, 300)), name, "TEXTURE=" + image)
    prefix = gdal.OpenEx(name, open_options=["BYTES=4000"])
    assert prefix.GetMetadataItem("MISSION") == "SRTM"
    assert reversibility(prefix) == "LOSSY"
    assert prefix.GetMetadataItem("COMPLETE", "TKS") == "NO"
    assert prefix.GetMetadataItem("MAX_ERROR", "TKS") is None
    assert reversibility(gdal.Open(name)) == "LOSSLESS"


def without_checksum(beside):
    """As plugins wrote it that did not bind it to its stream, or as other programs write it."""
    text, count = re.subn("<TKSStream>[0-9A-F]{8}</TKSStream>", "", beside.read_text())
    assert count > 0
    beside.write_text(text)


def test_claims_of_a_stream_that_was_replaced(tmp_path):
    """By a program that does not know of the file beside it."""
    name, other = tmp_path / "a.tks", tmp_path / "b.tks"
    signed = with_metadata(terrain(20, 30, "i1"), area_or_point="Point", description="ridges")
    copy(signed, name, "MAX_Z_ERROR=2")
    copy(memory(terrain(20, 30, "u1"), area_or_point="Area", description="roofs"), other)
    os.replace(other, name)
    without_checksum(tmp_path / "a.tks.aux.xml")
    dataset = gdal.Open(str(name))
    band = dataset.GetRasterBand(1)
    assert reversibility(dataset) == "LOSSLESS"
    assert dataset.GetMetadata("TKS") == of_stream(name)
    assert dataset.GetMetadata() == {"AREA_OR_POINT": "Area", "MISSION": "SRTM"}
    assert band.GetDescription() == "roofs"
    assert band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE") is None


def painted(array):
    source = with_metadata(array, colours=[gdal.GCI_PaletteIndex])
    table = gdal.ColorTable()
    table.SetColorEntry(3, (10, 20, 30, 255))
    source.GetRasterBand(1).SetColorTable(table)
    return source


def test_what_is_beside_belongs_to_its_stream(tmp_path):
    """Statistics, colours and all else are not those of another stream that takes its name."""
    name, other, beside = tmp_path / "a.tks", tmp_path / "b.tks", tmp_path / "a.tks.aux.xml"
    copy(painted(terrain(20, 30, "u1")), name)
    first_band(gdal.Open(str(name))).ComputeStatistics(False)
    dataset, heard = warnings_of(lambda: gdal.Open(str(name)))
    assert not heard and dataset.GetMetadataItem("MISSION") == "SRTM"
    assert dataset.GetRasterBand(1).GetMetadataItem("STATISTICS_MEAN") is not None
    dataset = None
    copy(terrain(20, 30, "u1", seed=2), other)
    os.replace(other, name)
    dataset, heard = warnings_of(lambda: gdal.Open(str(name)))
    assert len(heard) == 1 and "a.tks" in heard[0] and "another stream" in heard[0]
    band = dataset.GetRasterBand(1)
    assert dataset.GetMetadata() == {} and band.GetMetadata() == {}
    assert band.GetColorTable() is None and band.GetColorInterpretation() == gdal.GCI_GrayIndex
    # What is kept from now on is of the new one, and all of it.
    band.SetNoDataValue(7)
    band = dataset = None
    assert "MISSION" not in beside.read_text()
    dataset, heard = warnings_of(lambda: gdal.Open(str(name)))
    assert not heard and dataset.GetRasterBand(1).GetNoDataValue() == 7
    dataset = None
    without_checksum(beside)
    copy(terrain(20, 30, "u1", seed=3), other)
    os.replace(other, name)
    dataset, heard = warnings_of(lambda: gdal.Open(str(name)))
    assert not heard and dataset.GetRasterBand(1).GetNoDataValue() == 7


def test_what_is_beside_belongs_to_its_stream_by_all_names(tmp_path, image):
    name, other = str(tmp_path / "a.tks"), str(tmp_path / "b.tks")

    def replace(seed):
        copy(terrain(20, 30, seed=seed), other, "TEXTURE=" + image)
        os.replace(other, name)

    def nodata(part):
        dataset, heard = warnings_of(lambda: gdal.Open(f'TKS:"{name}":{part}'))
        return dataset.GetRasterBand(1).GetNoDataValue(), len(heard)

    replace(1)
    first_band(gdal.Open(f'TKS:"{name}":texture')).SetNoDataValue(3)
    assert nodata("texture") == (3, 0) and nodata("heights") == (None, 0)
    first_band(gdal.Open(name)).SetNoDataValue(9)
    assert nodata("texture") == (3, 0) and nodata("heights") == (9, 0)
    replace(2)
    assert nodata("texture") == (None, 1) and nodata("heights") == (None, 1)
    # What is now kept of the one does not bring back what was there of the other.
    first_band(gdal.Open(f'TKS:"{name}":texture')).SetNoDataValue(4)
    assert nodata("texture") == (4, 0) and nodata("heights") == (None, 1)
    replace(3)
    first_band(gdal.Open(name)).SetNoDataValue(8)
    assert nodata("texture") == (None, 0) and nodata("heights") == (8, 0)


def test_claims_that_another_program_has_written_beside(tmp_path):
    name = tmp_path / "a.tks"
    copy(terrain(20, 30, "u1"), name)
    (tmp_path / "a.tks.aux.xml").write_text(
        '<PAMDataset><Metadata domain="IMAGE_STRUCTURE"><MDI key="NBITS">4</MDI></Metadata>'
        '<Metadata domain="TKS"><MDI key="MAX_ERROR">7</MDI></Metadata>'
        '<Metadata domain="SUBDATASETS"><MDI key="SUBDATASET_1_NAME">x</MDI></Metadata>'
        '<PAMRasterBand band="1"><Metadata domain="IMAGE_STRUCTURE">'
        '<MDI key="PIXELTYPE">SIGNEDBYTE</MDI></Metadata></PAMRasterBand></PAMDataset>'
    )
    dataset = gdal.Open(str(name))
    assert dataset.GetMetadata("IMAGE_STRUCTURE") == {"COMPRESSION_REVERSIBILITY": "LOSSLESS"}
    assert dataset.GetMetadata("TKS") == of_stream(name) and not dataset.GetSubDatasets()
    assert not dataset.GetRasterBand(1).GetMetadata("IMAGE_STRUCTURE")


def test_a_copy_takes_nothing_of_a_file_that_was_there(tmp_path):
    name = tmp_path / "a.tks"
    copy(with_metadata(terrain(20, 30)), name)
    first_band(gdal.Open(str(name))).SetNoDataValue(7)
    name.unlink()  # not by GDAL, which would remove both
    dataset = copy(terrain(20, 30), name)
    assert dataset.GetMetadata() == {} and dataset.GetRasterBand(1).GetNoDataValue() is None
    assert not (tmp_path / "a.tks.aux.xml").exists()


def test_a_file_that_is_moved(tmp_path, image):
    name, moved = str(tmp_path / "a.tks"), str(tmp_path / "b.tks")
    copy(with_metadata(terrain(20, 30)), name, "TEXTURE=" + image)
    for ending in ("", ".aux.xml"):
        os.rename(name + ending, moved + ending)
    heights, texture = gdal.Open(moved).GetSubDatasets()
    assert heights[0] == f'TKS:"{moved}":heights' and texture[0] == f'TKS:"{moved}":texture'
    assert gdal.Open(texture[0]).RasterCount == 3


def sayings(name):
    """All that a dataset says, but for the list of its subdatasets."""
    dataset = gdal.Open(name)
    bands = [dataset.GetRasterBand(i + 1) for i in range(dataset.RasterCount)]
    crs = dataset.GetSpatialRef()
    domains = set(dataset.GetMetadataDomainList()) - {"SUBDATASETS", "DERIVED_SUBDATASETS"}
    return (
        {domain: dataset.GetMetadata(domain) for domain in domains},
        crs and (crs.ExportToWkt(), crs.GetCoordinateEpoch()),
        dataset.GetGeoTransform(),
        dataset.GetFileList(),
        [(band.GetMetadata(), band.GetNoDataValue(), band.GetScale()) for band in bands],
    )


def test_both_names_of_heights_say_the_same(tmp_path, image):
    crs = system("EPSG:9754")
    crs.SetCoordinateEpoch(2020.5)
    source = with_metadata(terrain(20, 30).astype(np.float64) + 1e-6)
    source.SetSpatialRef(crs)
    source.GetRasterBand(1).SetMetadataItem("SENSOR", "C")
    name = str(tmp_path / "a.tks")
    warnings_of(lambda: copy(source, name, "TEXTURE=" + image, strict=False))
    heights, texture = f'TKS:"{name}":heights', f'TKS:"{name}":texture'
    said = sayings(name)
    assert said == sayings(heights)
    metadata, (_, epoch), *_, bands = said
    assert metadata["IMAGE_STRUCTURE"] == {"COMPRESSION_REVERSIBILITY": "LOSSY"}
    assert 0 < float(metadata["TKS"]["MAX_ERROR"]) < 1e-4
    assert metadata[""]["MISSION"] == "SRTM" and epoch == 2020.5
    assert bands[0][0]["SENSOR"] == "C"
    assert reversibility(gdal.Open(texture)) == "LOSSLESS"
    # What is set by one name is there by the other, and the texture keeps its own.
    first_band(gdal.Open(texture)).SetNoDataValue(3)
    first_band(gdal.Open(heights)).SetScale(3)
    first_band(gdal.Open(name)).SetNoDataValue(9)
    assert sayings(name) == sayings(heights)
    assert sayings(name)[-1][0][1:] == (9, 3)
    assert sayings(texture)[-1][0][1:] == (3, None)
    # Where the texture has nothing left to keep, the heights do.
    first_band(gdal.Open(texture)).DeleteNoDataValue()
    assert sayings(texture)[-1][0][1] is None and sayings(name)[-1][0][1:] == (9, 3)


def test_both_names_of_a_picture_say_the_same(tmp_path, image):
    name = str(tmp_path / "a.tks")
    source = gdal.Open(image)
    source.SetMetadataItem("MISSION", "SRTM")
    copy(source, name)
    assert sayings(name)[0][""]["MISSION"] == "SRTM"
    assert sayings(name) == sayings(f'TKS:"{name}":texture')


def test_a_rounding_counts_for_its_stream_only(tmp_path):
    name, other = str(tmp_path / "a.tks"), str(tmp_path / "b.tks")
    rounded = terrain(20, 30).astype(np.float64) + 1e-6
    warnings_of(lambda: copy(rounded, name, strict=False))
    assert reversibility(gdal.Open(name)) == "LOSSY"
    copy(terrain(20, 30), other)
    shutil.copy(name + ".aux.xml", other + ".aux.xml")
    assert reversibility(gdal.Open(other)) == "LOSSLESS"
    assert gdal.Open(other).GetMetadataItem("MAX_ERROR", "TKS") == "0"


def test_what_is_set_afterwards_precedes(tmp_path):
    name = str(tmp_path / "a.tks")
    copy(memory(terrain(20, 30), unit="m", scale=0.5, offset=100), name)
    edit = ["gdal_edit.py", "-ro", "-units", "ft", "-scale", "2", "-offset", "7", "-a_nodata", "5"]
    subprocess.run([*edit, "-colorinterp_1", "alpha", name], check=True)
    band = first_band(gdal.Open(name))
    assert (band.GetUnitType(), band.GetScale(), band.GetOffset()) == ("ft", 2, 7)
    assert band.GetNoDataValue() == 5 and band.GetColorInterpretation() == gdal.GCI_AlphaBand
    # One of two is set, and the other stays.
    band.SetScale(1)
    assert (band.GetScale(), band.GetOffset()) == (1, 7)
    del band
    again = first_band(gdal.Open(name))
    assert (again.GetScale(), again.GetOffset()) == (1, 7)


def test_what_is_kept_beside_leaves_the_rest_to_the_stream(tmp_path):
    name = str(tmp_path / "a.tks")
    copy(memory(terrain(20, 30), unit="m", scale=0.5, offset=100, nodata=-1), name)
    first_band(gdal.Open(name)).ComputeStatistics(False)
    band = first_band(gdal.Open(name))
    assert (band.GetUnitType(), band.GetScale(), band.GetOffset()) == ("m", 0.5, 100)
    assert band.GetNoDataValue() == -1 and band.GetColorInterpretation() == gdal.GCI_GrayIndex
    band.SetOffset(3)
    del band
    again = first_band(gdal.Open(name))
    assert (again.GetScale(), again.GetOffset()) == (0.5, 3)


def test_what_cannot_be_taken_off_a_stream(tmp_path):
    name = str(tmp_path / "a.tks")
    band = first_band(copy(memory(terrain(20, 30), unit="m", scale=0.5, offset=0, nodata=-1), name))
    refused(lambda: band.SetUnitType(""), "a.tks", "unit", "copy")
    refused(lambda: band.SetScale(1), "a.tks", "scale", "copy")
    refused(band.DeleteNoDataValue, "a.tks", "nodata", "copy")
    # What was set beside it can go again.
    band.SetNoDataValue(7)
    band.DeleteNoDataValue()
    assert band.GetNoDataValue() == -1


def test_a_colour_table_is_kept_beside(tmp_path):
    name = str(tmp_path / "a.tks")
    source = memory(terrain(20, 30, "u1"), colours=[gdal.GCI_PaletteIndex])
    table = gdal.ColorTable()
    table.SetColorEntry(3, (10, 20, 30, 255))
    source.GetRasterBand(1).SetColorTable(table)
    copy(source, name)
    band = first_band(gdal.Open(name))
    assert band.GetColorInterpretation() == gdal.GCI_PaletteIndex
    assert band.GetColorTable().GetColorEntry(3) == (10, 20, 30, 255)


def test_what_is_said_of_bands_goes_where_they_go(tmp_path):
    """Blue comes first here, and last in a stream."""
    source = memory(np.stack([terrain(20, 30, "u1", seed) for seed in range(3)]), colours=RGB[::-1])
    for number in (1, 2, 3):
        band = source.GetRasterBand(number)
        band.SetScale(number + 1)
        band.SetMetadataItem("WAVELENGTH", str(number))
    back = copy(source, tmp_path / "a.tks")
    bands = [back.GetRasterBand(number) for number in (1, 2, 3)]
    assert [band.GetColorInterpretation() for band in bands] == list(RGB)
    assert [band.GetScale() for band in bands] == [4, 3, 2]
    assert [band.GetMetadataItem("WAVELENGTH") for band in bands] == ["3", "2", "1"]
