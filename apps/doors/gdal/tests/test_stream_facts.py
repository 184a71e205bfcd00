# SPDX-License-Identifier: Apache-2.0
"""The metadata domain TKS: what is there of a stream, what it promises, and how far off it is."""

import subprocess

import numpy as np
import pytest
from conftest import copy, gdal, terrain
from test_open_options import Server, opened, served


def facts(dataset):
    return dataset.GetMetadata("TKS")


def rmse(dataset):
    return np.sqrt(np.mean((dataset.ReadAsArray().astype(float) - terrain()) ** 2))


def test_gdalinfo_tells_all(tmp_path):
    name = tmp_path / "a.tks"
    copy(terrain(), name)
    command = ["gdalinfo", "-mdd", "TKS", str(name)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    size = name.stat().st_size
    for line in (
        "COMPLETE=YES",
        f"BYTES={size}",
        f"BYTES_ANNOUNCED={size}",
        "TARGET=LOSSLESS",
        "RMSE=0",
        "MAX_ERROR=0",
        "INDEX=NO",
    ):
        assert f"  {line}\n" in done.stdout, done.stdout


@pytest.mark.parametrize("option, target", [("BYTES=9000", None), ("MAX_Z_ERROR=8", "MAX_ERROR=8")])
def test_errors_are_those_of_the_bytes_that_are_there(tmp_path, option, target):
    name = tmp_path / "a.tks"
    copy(terrain(), name, option)
    size = name.stat().st_size
    for some in (size, size // 2, size // 4):
        prefix = opened(name, f"BYTES={some}")
        said = facts(prefix)
        assert said.get("TARGET") == target
        assert said["COMPLETE"] == ("YES" if some == size else "NO")
        assert (said["BYTES"], said["BYTES_ANNOUNCED"]) == (str(some), str(size))
        assert 0.8 * rmse(prefix) < float(said["RMSE"]) < 1.3 * rmse(prefix)
        assert ("MAX_ERROR" in said) == (target is not None and some == size)
    cut = tmp_path / "cut.tks"
    cut.write_bytes(name.read_bytes()[:-1])
    assert facts(opened(cut))["COMPLETE"] == "NO"


def test_of_heights_and_texture(tmp_path, texture):
    name = tmp_path / "a.tks"
    copy(terrain(), name, "BYTES=40000", "TEXTURE=" + texture)
    heights, image = opened(name), opened(f'TKS:"{name}":texture')
    assert float(facts(heights)["RMSE"]) > 0 and "RMSE" not in facts(image)
    psnr = float(facts(image)["TEXTURE_PSNR"])
    assert 20 < psnr < 60 and float(heights.GetMetadataItem("TEXTURE_PSNR", "TKS")) == psnr
    copy(terrain(), name, "TEXTURE=" + texture)
    assert facts(opened(name))["TEXTURE_PSNR"] == "inf"


def test_asking_reads_no_indexed_file_whole(tmp_path):
    heights = terrain(600, 700)
    for options in (["MAX_Z_ERROR=1", "INDEX=YES", "BLOCKSIZE=64"], ["BLOCKSIZE=64"]):
        copy(heights, tmp_path / "a.tks", *options)
        with served(tmp_path / "a.tks") as url:
            said = facts(opened(url))
            assert sum(last - first for first, last in Server.ranges) < len(Server.data) / 2
        assert said["COMPLETE"] == "YES" and said["BLOCKSIZE"] == "64"
        assert said.get("RMSE") == ("0" if said["TARGET"] == "LOSSLESS" else None)


def test_it_is_of_the_stream_only(tmp_path):
    """Other programs cannot set it beside, and copies to other formats do not take it along."""
    name = tmp_path / "a.tks"
    copy(terrain(), name)
    dataset = opened(name)
    dataset.SetMetadataItem("COMPLETE", "MAYBE", "TKS")
    dataset = None
    assert facts(opened(name))["COMPLETE"] == "YES"
    tif = gdal.GetDriverByName("GTiff").CreateCopy(str(tmp_path / "a.tif"), opened(name))
    assert not tif.GetMetadata("TKS")
