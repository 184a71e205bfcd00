# SPDX-License-Identifier: Apache-2.0
"""bench/doors runs this: doors.py HEIGHT FOLDER. One thread everywhere; each time is CPU time, of
reads the median of five, each of a dataset that was opened for it. Windows begin in the middle, or
anywhere: the mean of twenty. Heights are whole numbers of UInt16, as JPEG 2000 needs it. The
overview is that of 1/8 of the resolution, held against means of 8 x 8 samples."""

import random
import statistics
import sys
import time
from pathlib import Path

import numpy as np
from osgeo import gdal

gdal.UseExceptions()
SIDE, RUNS, WINDOW, OVERVIEW = 4097, 5, 512, 8


def integers(name):
    """Whole numbers less their minimum (where that takes more than 16 bits, fewer levels), cut or
    mirrored to SIDE."""
    heights = gdal.Open(name).ReadAsArray().astype(np.float64)
    rows, columns = (abs((np.arange(SIDE) + n - 1) % (2 * n - 2) - n + 1) for n in heights.shape)
    heights = heights[np.ix_(rows, columns)]
    heights -= np.nanmin(heights)
    return np.rint(heights / np.ceil(heights.max() / 65535)).astype(np.uint16)


def write(folder, heights, driver, options):
    source = gdal.GetDriverByName("MEM").Create("", SIDE, SIDE, 1, gdal.GDT_UInt16)
    source.GetRasterBand(1).WriteArray(heights)
    name = str(folder / f"bench.{ {'TKS': 'tks', 'COG': 'tif', 'JP2OpenJPEG': 'jp2'}[driver] }")
    start = time.process_time()
    written = gdal.GetDriverByName(driver).CreateCopy(name, source, options=options)
    del written
    return name, time.process_time() - start


def read(name, overview=None, **part):
    """Milliseconds, and the last array."""
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        dataset = gdal.Open(name)
        band = dataset.GetRasterBand(1)
        array = (band if overview is None else band.GetOverview(overview)).ReadAsArray(**part)
        times.append(time.process_time() - start)
        del dataset
    return 1000 * statistics.median(times), array


def anywhere(name):
    """Milliseconds of a window, the mean of twenty."""
    random.seed(1)
    places = [[random.randrange(SIDE - WINDOW + 1) for _ in "xy"] for _ in range(20)]
    start = time.process_time()
    for x, y in places:
        gdal.Open(name).ReadAsArray(x, y, WINDOW, WINDOW)
    return 1000 * (time.process_time() - start) / len(places)


def means_over(heights, rows, columns):
    """Of the areas of so many pixels, all of the same size, that share the raster."""
    for length in (rows, columns):
        sums = np.pad(np.cumsum(heights, axis=0, dtype=np.float64), ((1, 0), (0, 0)))
        ends = np.arange(length + 1) * len(heights) / length
        whole = np.minimum(ends.astype(int), len(heights) - 1)
        part = (ends - whole)[:, None]
        at = sums[whole] * (1 - part) + sums[whole + 1] * part
        heights = (np.diff(at, axis=0) * length / len(heights)).T
    return heights


def by_blocks(name):
    """Milliseconds of all blocks, row by row."""
    start = time.process_time()
    band = (dataset := gdal.Open(name)).GetRasterBand(1)
    width, height = band.GetBlockSize()
    for y in range(0, SIDE, height):
        for x in range(0, SIDE, width):
            band.ReadAsArray(x, y, min(width, SIDE - x), min(height, SIDE - y))
    del dataset
    return 1000 * (time.process_time() - start)


def measure(folder, heights, label, driver, options):
    """Prints one row; returns the RMSE."""
    name, encoding = write(folder, heights, driver, options)
    middle = {"xoff": SIDE // 2, "yoff": SIDE // 2, "win_xsize": WINDOW, "win_ysize": WINDOW}
    window, _ = read(name, **middle)
    overview, pixels = read(name, overview=2)
    whole, array = read(name)
    off = array.astype(np.float64) - heights
    rmse = np.sqrt(np.mean(off**2))
    blur = np.sqrt(np.mean((pixels - means_over(heights, *pixels.shape)) ** 2))
    size = Path(name).stat().st_size
    print(f"| {label} | {size / 1000:.0f} | {rmse:.2f} | {np.abs(off).max():.0f} | {encoding:.1f} "
          f"| {window:.0f} | {anywhere(name):.0f} | {overview:.0f} | {blur:.2f} | {whole:.0f} "
          f"| {by_blocks(name):.0f} |", flush=True)
    Path(name).unlink()
    return rmse


def main():
    heights, folder = integers(sys.argv[1]), Path(sys.argv[2])
    print(f"{heights.shape[1]} x {heights.shape[0]} UInt16, 0 to {heights.max()}\n")
    print(f"| | kB | RMSE | largest error | encode, s | window of {WINDOW}², ms | anywhere, ms "
          f"| 1/{OVERVIEW}, ms | its RMSE to means | all, ms "
          "| all by blocks |\n" + "| --- " * 11 + "|")
    measure(folder, heights, "**lossless**: TKS, INDEX=NO", "TKS", ["INDEX=NO"])
    measure(folder, heights, "TKS (INDEX=WINDOWS)", "TKS", [])
    measure(folder, heights, "TKS, BLOCKSIZE=128", "TKS", ["BLOCKSIZE=128"])
    deflate = ["COMPRESS=DEFLATE", "PREDICTOR=YES"]
    measure(folder, heights, "COG, DEFLATE, predictor", "COG", deflate)
    measure(folder, heights, "COG, LERC_ZSTD", "COG", ["COMPRESS=LERC_ZSTD", "MAX_Z_ERROR=0"])
    exact = ["QUALITY=100", "REVERSIBLE=YES"]
    measure(folder, heights, "JP2OpenJPEG, reversible", "JP2OpenJPEG", exact)
    measure(folder, heights, "**largest error 10**: TKS", "TKS", ["MAX_Z_ERROR=10"])
    measure(folder, heights, "COG, LERC_ZSTD", "COG", ["COMPRESS=LERC_ZSTD", "MAX_Z_ERROR=10"])
    label = "**equal RMSE**: JP2OpenJPEG, QUALITY=10"
    rmse = measure(folder, heights, label, "JP2OpenJPEG", ["QUALITY=10"])
    psnr = 20 * np.log10(np.ptp(heights) / rmse)
    measure(folder, heights, "TKS, PSNR", "TKS", [f"PSNR={psnr:.4f}"])


main()
