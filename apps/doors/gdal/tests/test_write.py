# SPDX-License-Identifier: Apache-2.0
"""CreateCopy: every type and creation option, what is refused, cancelled and passed on."""

import os
import resource
import subprocess
import sys

import numpy as np
import pytest
from conftest import SAMPLES, copy, first_band, gdal, gdal_type, memory, refused, samples, terrain


@pytest.mark.parametrize("dtype", SAMPLES)
@pytest.mark.parametrize("shape", [(2, 2), (37, 80), (90, 41)])
def test_lossless(tmp_path, dtype, shape):
    heights = terrain(*shape, dtype)
    name = str(tmp_path / "a.tks")
    dataset = copy(heights, name)
    np.testing.assert_array_equal(samples(dataset), heights)
    assert dataset.GetRasterBand(1).DataType == gdal_type(dtype)
    assert dataset.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSLESS"


@pytest.mark.parametrize("dtype", SAMPLES)
def test_gdal_translate_both_ways(tmp_path, dtype):
    tif, tks, back = (str(tmp_path / name) for name in ("a.tif", "a.tks", "b.tif"))
    options = ["PIXELTYPE=SIGNEDBYTE"] if dtype == "i1" and gdal_type("i1") == gdal.GDT_Byte else []
    gdal.GetDriverByName("GTiff").CreateCopy(tif, memory(terrain(60, 80, dtype)), options=options)
    subprocess.run(["gdal_translate", "-q", tif, tks], check=True)
    subprocess.run(["gdal_translate", "-q", tks, back], check=True)
    np.testing.assert_array_equal(samples(gdal.Open(back)), terrain(60, 80, dtype))
    assert gdal.Open(tks).GetDriver().ShortName == "TKS"


def test_floats_bit_for_bit(tmp_path):
    bits = np.random.default_rng(3).integers(0, 2**32, (50, 60), np.uint32)
    wild = bits.view(np.float32).copy()
    wild[~np.isfinite(wild)] = -0.0
    back = copy(wild, tmp_path / "a.tks").ReadAsArray()
    np.testing.assert_array_equal(back.view(np.uint32), wild.view(np.uint32))


@pytest.mark.parametrize("dtype", ["i2", "u4", "f4"])
@pytest.mark.parametrize("error", ["5", "0.5", "60"])
def test_max_z_error_holds(tmp_path, dtype, error):
    name = tmp_path / "a.tks"
    dataset = copy(terrain(dtype=dtype), name, "MAX_Z_ERROR=" + error)
    off = np.abs(dataset.ReadAsArray().astype(float) - terrain(dtype=dtype).astype(float))
    assert off.max() <= float(error)
    # Half a step of an integer is none: that takes the bytes of lossless, and the error's.
    assert name.stat().st_size < copy_size(tmp_path, terrain(dtype=dtype)) + 9


def copy_size(folder, heights, *options):
    copy(heights, folder / "size.tks", *options)
    return (folder / "size.tks").stat().st_size


def test_max_z_error_is_in_pixel_values(tmp_path):
    """As LERC has it: the scale to metres does not count."""
    heights = terrain(dtype="i2")
    source = memory(heights, scale=0.01, offset=5, unit="m")
    dataset = copy(source, tmp_path / "a.tks", "MAX_Z_ERROR=5")
    off = np.abs(dataset.ReadAsArray().astype(float) - heights)
    assert 2 < off.max() <= 5
    assert dataset.GetMetadataItem("MAX_ERROR", "TKS") == "0.050000000000000003"


def test_bytes_and_psnr(tmp_path):
    heights = terrain()
    name = tmp_path / "a.tks"
    for budget in (500, 4000, 20000):
        copy(heights, name, f"BYTES={budget}")
        assert 0.8 * budget < name.stat().st_size <= budget
    for psnr in (40, 60):
        back = copy(heights, name, f"PSNR={psnr}").ReadAsArray()
        rmse = np.sqrt(np.mean((back.astype(float) - heights) ** 2))
        assert 20 * np.log10(np.ptp(heights) / rmse) >= psnr


def test_blocksize_and_index(tmp_path):
    heights = terrain(dtype="i2")
    plain = copy_size(tmp_path, heights)
    assert copy_size(tmp_path, heights, "BLOCKSIZE=32", "INDEX=NO") > plain
    assert copy_size(tmp_path, heights, "BLOCKSIZE=NONE") == plain
    assert copy_size(tmp_path, heights, "INDEX=NO") == plain
    assert copy_size(tmp_path, heights, "INDEX=YES") > plain
    assert copy_size(tmp_path, heights, "INDEX=WINDOWS", "BLOCKSIZE=32") > plain
    refused(lambda: copy(heights, tmp_path / "b.tks", "INDEX=WINDOWS", "BYTES=4000"), "lossless")
    refused(lambda: copy(heights, tmp_path / "b.tks", "INDEX=MAYBE"), "INDEX=MAYBE")
    unregioned = ("INDEX=WINDOWS", "BLOCKSIZE=NONE")
    refused(lambda: copy(heights, tmp_path / "b.tks", *unregioned), *unregioned)
    for side in ("8", "100", "2097152", "-64", "x"):
        option = "BLOCKSIZE=" + side
        refused(lambda option=option: copy(heights, tmp_path / "b.tks", option), option)
    assert not (tmp_path / "b.tks").exists()
    blocks = first_band(copy(heights, tmp_path / "b.tks", "BLOCKSIZE=128"))
    assert blocks.GetBlockSize() == [64, 64]


def test_lossless_copies_in_regions_are_for_windows(tmp_path):
    """Nothing else is: what is small has no windows, and what is lossy is made to be cut."""
    large, small = terrain(1030, 1030, "u1"), terrain(300, 340, "u1")

    def index(heights, *options):
        dataset = copy(heights, tmp_path / "a.tks", *options)
        return dataset.GetMetadataItem("INDEX", "TKS"), dataset.GetMetadataItem("BLOCKSIZE", "TKS")

    assert index(large) == index(large, "LOSSLESS=YES") == ("WINDOWS", "256")
    assert index(large, "INDEX=NO") == ("NO", "512")
    assert index(large, "BLOCKSIZE=NONE") == ("NO", None)
    assert index(large, "BYTES=9000") == index(large, "MAX_Z_ERROR=9") == ("NO", "512")
    assert index(small) == index(small, "BLOCKSIZE=256") == ("NO", None)
    assert index(small, "BLOCKSIZE=64") == ("WINDOWS", "64")
    image = str(tmp_path / "image.tif")
    gdal.GetDriverByName("GTiff").CreateCopy(image, memory(np.stack([small] * 3)))
    assert index(large, "TEXTURE=" + image)[0] == "NO"  # whose regions would cost the small one


def test_num_threads_changes_no_byte(tmp_path):
    written = []
    for threads in ("1", "4", "ALL_CPUS"):
        copy(terrain(), tmp_path / "a.tks", "NUM_THREADS=" + threads)
        written.append((tmp_path / "a.tks").read_bytes())
    assert written[0] == written[1] == written[2]
    for wrong in ("NUM_THREADS=0", "NUM_THREADS=2.5"):
        refused(lambda: copy(terrain(), tmp_path / "b.tks", wrong), wrong)


@pytest.mark.parametrize(
    "options, words",
    [
        (["BYTES=4000", "PSNR=40"], "exclude each other"),
        (["MAX_Z_ERROR=1", "BYTES=4000"], "exclude each other"),
        (["MAX_Z_ERROR=0", "PSNR=40"], "exclude each other"),
        (["MAX_Z_ERROR=-1"], "MAX_Z_ERROR=-1"),
        (["MAX_Z_ERROR=some"], "MAX_Z_ERROR=some"),
        (["BYTES=0"], "BYTES=0"),
        (["BYTES=10"], ""),
        (["PSNR=0"], "PSNR"),
        (["PSNR=nan"], "PSNR=nan"),
        (["PSNR=x"], "PSNR=x"),
        (["PSNR="], "PSNR="),
        (["MAX_Z_ERROR="], "MAX_Z_ERROR="),
        (["BYTES="], "BYTES="),
        (["LOSSLESS=maybe"], "LOSSLESS=maybe is neither YES nor NO"),
        (["LOSSLESS="], "LOSSLESS= is neither"),
        (["LOSSLESS=NO"], "LOSSLESS=NO needs"),
        (["LOSSLESS=YES", "BYTES=4000"], "LOSSLESS=YES excludes"),
        (["INDEX="], "INDEX="),
        (["BLOCKSIZE="], "BLOCKSIZE="),
        (["NUM_THREADS="], "NUM_THREADS="),
        (["WHITE_LEVEL=9.5"], "WHITE_LEVEL=9.5"),
        (["TEXTURE="], "TEXTURE= names no dataset"),
        (["TEXTURE=/nowhere.png"], ""),
    ],
)
def test_options_that_make_no_sense(tmp_path, options, words):
    with pytest.raises(RuntimeError, match=words):
        copy(terrain(40, 50), tmp_path / "a.tks", *options)
    assert list(tmp_path.iterdir()) == []


def test_doubles(tmp_path):
    exact = terrain(30, 40).astype(np.float64)
    band = first_band(copy(exact, tmp_path / "a.tks"))
    assert band.DataType == gdal.GDT_Float32
    np.testing.assert_array_equal(band.ReadAsArray(), exact)
    refused(lambda: copy(exact + 1e-9, tmp_path / "b.tks"), "Float64")
    assert not (tmp_path / "b.tks").exists()
    gdal.PushErrorHandler("CPLQuietErrorHandler")
    rounded = copy(exact + 1e-9, tmp_path / "b.tks", strict=False)
    gdal.PopErrorHandler()
    np.testing.assert_array_equal(rounded.ReadAsArray(), (exact + 1e-9).astype(np.float32))


def written_quietly(source, name, *options):
    """Without GDAL's warning that doubles are rounded."""
    gdal.PushErrorHandler("CPLQuietErrorHandler")
    try:
        return copy(source, name, *options, strict=False)
    finally:
        gdal.PopErrorHandler()


def test_the_largest_error_counts_what_rounding_doubles_took(tmp_path):
    y, x = np.mgrid[0:40, 0:50]
    heights = 2e7 + 0.7 * x + 0.3 * y  # floats are 2 apart here
    name = tmp_path / "a.tks"
    refused(lambda: written_quietly(heights, name, "MAX_Z_ERROR=0.01"), "Float64", "MAX_Z_ERROR")
    assert not name.exists()
    for options, promised in (("MAX_Z_ERROR=3", 3), ("MAX_Z_ERROR=0", 1), ("BYTES=64k", 1)):
        for scale in (1, 0.5):
            source = memory(heights, scale=scale, offset=0)
            written = written_quietly(source, name, options)
            off = np.abs(written.ReadAsArray().astype(float) - heights).max()
            del written
            back = gdal.Open(str(name))
            assert 0.5 < off <= promised
            assert back.GetMetadataItem("COMPRESSION_REVERSIBILITY", "IMAGE_STRUCTURE") == "LOSSY"
            error = float(back.GetMetadataItem("MAX_ERROR", "TKS"))
            assert off * scale <= error <= promised * scale + 1e-6


def test_sizes_as_the_command_line_has_them(tmp_path):
    name = tmp_path / "a.tks"
    copy(terrain(), name, "BYTES=4k")
    written = name.read_bytes()
    for same in ("4096", "4K", "4kB", "4KiB"):
        copy(terrain(), name, "BYTES=" + same)
        assert name.read_bytes() == written
    for wrong in ("4x", "k", "0k", "4kk", "17179869184G"):
        refused(lambda wrong=wrong: copy(terrain(), name, "BYTES=" + wrong), "no number of bytes")


@pytest.mark.parametrize("shape", [(1, 9), (9, 1), (1, 1)])
def test_one_line_of_heights(tmp_path, shape):
    heights = np.arange(100, 100 + shape[0] * shape[1], dtype="i2").reshape(shape)
    dataset = copy(heights, tmp_path / "a.tks")
    np.testing.assert_array_equal(dataset.ReadAsArray().reshape(shape), heights)


def test_sources_that_are_no_heights(tmp_path):
    name = tmp_path / "a.tks"
    three = np.zeros((3, 8, 9), np.int16)
    message = refused(lambda: copy(three, name), "one band", "has 3", "-b 1")
    assert "TEXTURE" in message
    refused(lambda: copy(np.zeros((8, 9), np.complex64), name), "CFloat32")
    infinite = terrain(20, 30)
    infinite[4, 7] = np.inf
    refused(lambda: copy(infinite, name), "nfinit")
    assert not name.exists()


def test_unwritable_targets(tmp_path):
    for name in (tmp_path / "nowhere/a.tks", "/proc/a.tks", "/vsicurl/http://localhost:1/a.tks"):
        message = refused(lambda name=name: copy(terrain(20, 30), name), "cannot be written")
        assert "()" not in message
    (tmp_path / "folder.tks").mkdir()
    with pytest.raises(RuntimeError):
        copy(terrain(20, 30), tmp_path / "folder.tks")


def test_a_file_that_cannot_grow(tmp_path):
    """As a full disk: what was written of the stream goes away again."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    try:
        refused(lambda: copy(terrain(), tmp_path / "a.tks"), "cannot be written whole")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert list(tmp_path.iterdir()) == []


def test_virtual_files():
    heights = terrain(20, 30)
    np.testing.assert_array_equal(copy(heights, "/vsimem/a.tks").ReadAsArray(), heights)
    np.testing.assert_array_equal(gdal.Open('TKS:"/vsimem/a.tks":heights').ReadAsArray(), heights)
    gdal.Unlink("/vsimem/a.tks")


def test_streams_that_are_passed_on(tmp_path):
    """What goes to /vsistdout/ cannot be opened again."""
    source, name = str(tmp_path / "a.tif"), tmp_path / "a.tks"
    gdal.GetDriverByName("GTiff").CreateCopy(source, memory(terrain(60, 80, "i2"), nodata=0))
    translate = ["gdal_translate", "-q", "-of", "TKS", source]
    subprocess.run([*translate, str(name)], check=True)
    written = subprocess.run([*translate, "/vsistdout/"], check=True, capture_output=True)
    assert written.stdout == name.read_bytes() and written.stderr == b""
    # Who copies gets a dataset all the same, and nothing stays behind.
    script = (
        "from osgeo import gdal; import sys; source = gdal.Open(sys.argv[1]);"
        "copy = gdal.GetDriverByName('TKS').CreateCopy('/vsistdout/', source);"
        "assert (copy.ReadAsArray() == source.ReadAsArray()).all();"
        "assert not gdal.ReadDir('/vsimem/')"
    )
    done = subprocess.run([sys.executable, "-c", script, source], check=True, capture_output=True)
    assert done.stdout == name.read_bytes()
    assert set(os.listdir(tmp_path)) == {"a.tif", "a.tks"}


@pytest.mark.parametrize("stop", [0.0, 0.05, 0.3, 0.9, 1.0])
def test_cancelled(tmp_path, stop):
    seen = []

    def progress(done, *_):
        seen.append(done)
        return 0 if done >= stop else 1

    message = refused(lambda: copy(terrain(), tmp_path / "a.tks", "BYTES=9000", progress=progress))
    assert "topped by the user" in message
    assert list(tmp_path.iterdir()) == [] and sum(done >= stop for done in seen) == 1


def test_progress(tmp_path):
    seen = []
    copy(terrain(), tmp_path / "a.tks", progress=lambda done, *_: seen.append(done) or 1)
    assert seen == sorted(seen) and seen[-1] == 1 and len(seen) > 3 and seen[-2] < 1
