# SPDX-License-Identifier: Apache-2.0
"""Sequences whose groups go on from the group before: REFERENCE and ENTRY, and frames of them in
any order."""

import subprocess

import numpy as np
import pytest
from conftest import copy, gdal, memory, refused
from test_open_options import Server, opened, served
from test_sequences import TETRAKIS, moving, timed

GROUP, ENTRY = 4, 3


def encoded(folder, cube, *options, **facts):
    """By the command line, which makes small groups. facts: of the sources."""
    for number, layers in enumerate(cube):
        name = str(folder / f"{number:03}.tif")
        gdal.GetDriverByName("GTiff").CreateCopy(name, memory(layers, **facts))
    groups = ["--group", str(GROUP), "--reference", "all", "--entry", str(ENTRY)]
    command = [TETRAKIS, "encode", *options, *groups, "-q", "-o", "a.tks"]
    subprocess.run(command, check=True, cwd=folder)
    return folder / "a.tks"


@pytest.fixture(scope="module")
def cube():
    return moving(6 * GROUP, 60, 72)


@pytest.fixture(scope="module")
def sequence(tmp_path_factory, cube):
    folder = tmp_path_factory.mktemp("references")
    return encoded(folder, cube, "*.tif", "--lossless", nodata=-9999)


def test_frames_are_those_of_the_source_in_any_order(sequence, cube):
    np.testing.assert_array_equal(gdal.Open(str(sequence)).ReadAsArray(), cube)
    dataset = gdal.Open(str(sequence))
    random = np.random.default_rng(4)
    for number in random.permutation(len(cube)):
        x, y = random.integers(0, 70), random.integers(0, 58)
        width, height = random.integers(1, 73 - x), random.integers(1, 61 - y)
        band = dataset.GetRasterBand(int(number) + 1)
        part = band.ReadAsArray(*map(int, (x, y, width, height)))
        np.testing.assert_array_equal(part, cube[number, y : y + height, x : x + width])
    series = dataset.ReadAsArray(33, 44, 1, 1)
    np.testing.assert_array_equal(series[:, 0, 0], cube[:, 44, 33])
    for number in (20, 23, 15, 3):
        frame = gdal.Open(f"TKS:{sequence}:frame={number}")
        np.testing.assert_array_equal(frame.ReadAsArray(), cube[number])
    np.testing.assert_array_equal(opened(sequence, "STRICT=YES").ReadAsArray(), cube)


def test_what_stands_still_takes_next_to_no_bytes(tmp_path):
    still = np.repeat(np.random.default_rng(1).integers(0, 99, (1, 8, 9), "i2"), 6 * 16, 0)
    sizes = []
    for options in (["NONE"], ["ALL", "ENTRY=2"], ["90"], ["all"]):
        back = copy(timed(still), tmp_path / "a.tks", "FRAMES=YES", f"REFERENCE={options[0]}",
                    *options[1:])  # fmt: skip
        np.testing.assert_array_equal(back.ReadAsArray(), still)
        sizes.append((tmp_path / "a.tks").stat().st_size)
    assert sizes[0] > sizes[1] > sizes[3]


def test_lossy_frames_and_overviews_are_the_same_in_every_order(tmp_path):
    cube = moving(3 * GROUP, 300, 340)
    cube[cube == -9999] = 0
    name = encoded(tmp_path, cube, "*.tif", "--max-error", "9")
    numbers = [5, 2, 11, 4, 6, 10]
    forwards, dataset = opened(name), opened(name)
    wanted = {}
    for number in sorted(numbers):
        band = forwards.GetRasterBand(number + 1)
        wanted[number] = band.ReadAsArray(), band.GetOverview(0).ReadAsArray()
        assert np.abs(wanted[number][0] - cube[number]).max() <= 9
    for number in numbers:
        band = dataset.GetRasterBand(number + 1)
        np.testing.assert_array_equal(band.GetOverview(0).ReadAsArray(), wanted[number][1])
        np.testing.assert_array_equal(band.ReadAsArray(), wanted[number][0])


def test_a_server_sends_the_groups_from_the_entry_on(tmp_path):
    still = np.random.default_rng(3).integers(0, 9000, (90, 95), "i2")
    cube = np.stack([np.roll(still, t // 10, 0) for t in range(40)])
    cube = (cube + np.random.default_rng(4).integers(0, 99, cube.shape)).astype("i2")
    with served(encoded(tmp_path, cube, "*.tif", "--lossless")) as url:
        frame = opened(url.replace("/vsicurl", "TKS:/vsicurl") + ":frame=30")
        np.testing.assert_array_equal(frame.ReadAsArray(), cube[30])
        size = len(Server.data)  # also of .aux.xml, which this server has at every address
        taken = [last - first for first, last in Server.ranges if last - first < size]
        assert sum(taken) < 0.75 * size


def heads_of(whole):
    places, at = [], whole.find(b"TKG\x1a")
    while at >= 0:
        places.append(at)
        at = whole.find(b"TKG\x1a", at + 1)
    return places


@pytest.mark.parametrize("lost", [1, 4])
def test_groups_without_those_that_they_go_on_from(sequence, cube, tmp_path, lost):
    whole = sequence.read_bytes()
    begin = heads_of(whole)
    assert len(begin) == 6
    (tmp_path / "a.tks").write_bytes(whole[: begin[lost]] + whole[begin[lost + 1] :])
    dataset = gdal.Open(str(tmp_path / "a.tks"))
    behind = (lost + 1) * GROUP
    for number in (behind, behind + 3):
        band = dataset.GetRasterBand(number + 1)
        refused(lambda band=band: band.ReadAsArray(), "goes on from group")
    end = (lost + ENTRY - lost % ENTRY) * GROUP
    for number in [*range(end, len(cube), 5), *range(0, lost * GROUP, 7)]:
        band = dataset.GetRasterBand(number + 1)
        np.testing.assert_array_equal(band.ReadAsArray(), cube[number])


def test_files_that_are_cut_and_bytes_that_mean_harm(sequence, cube, tmp_path):
    whole = sequence.read_bytes()
    for length in (len(whole) - 5, len(whole) // 2):
        prefix = opened(sequence, f"BYTES={length}")
        sound = (prefix.RasterCount - 1) // GROUP * GROUP
        assert sound > 0
        np.testing.assert_array_equal(prefix.ReadAsArray()[:sound], cube[:sound])
    name = tmp_path / "a.tks"
    for at in range(0, len(whole), 397):
        bad = bytearray(whole)
        bad[at] ^= 0x24
        name.write_bytes(bad)
        try:
            dataset = gdal.Open(str(name))
            for number in (len(cube), 7, 20):
                dataset.GetRasterBand(number).ReadAsArray()
        except RuntimeError:
            pass


def test_textures_of_the_command_line(tmp_path):
    still = np.random.default_rng(6).integers(0, 200, (3, 40, 50), "u1")
    texels = np.stack([still + t // 4 for t in range(10)])
    name = encoded(tmp_path, texels, "--texture", "*.tif", "--lossless")
    for number in (7, 2, 8, 0, 3):
        frame = gdal.Open(f"TKS:{name}:frame={number}")
        np.testing.assert_array_equal(frame.ReadAsArray(), texels[number])


@pytest.mark.parametrize("options, words", [
    (["REFERENCE=ALL"], "FRAMES=YES"), (["FRAMES=YES", "ENTRY=4"], "give REFERENCE"),
    (["FRAMES=YES", "REFERENCE=some"], "no number of bytes"),
    (["FRAMES=YES", "REFERENCE=ALL", "ENTRY=65"], "from 1 to 64"),
    (["FRAMES=YES", "REFERENCE=ALL", "ENTRY=0"], "from 1 to 64"),
])  # fmt: skip
def test_what_makes_no_sense_is_told(tmp_path, options, words):
    refused(lambda: copy(memory(moving(3)), tmp_path / "a.tks", *options), words)
    assert not list(tmp_path.iterdir())
