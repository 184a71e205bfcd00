# SPDX-License-Identifier: Apache-2.0
"""bench/kinds runs this: kinds.py OUT FOLDER... From the middle 512 x 512 samples of each
FOLDER/**/height.tif it makes files as such heights come in, OUT/TERRAIN_KIND/height.tif, for
bench/lossless. Needs NumPy, SciPy and GDAL's Python module; GDAL decodes LERC."""

import sys
import tempfile
from pathlib import Path

import numpy as np
from osgeo import gdal
from scipy import interpolate, ndimage

gdal.UseExceptions()
SIDE, FOOT, VOID = 512, 0.3048, -32768


def middle(name):
    """Floats without voids, in metres."""
    heights = gdal.Open(str(name)).ReadAsArray().astype(np.float64)
    y, x = (max(0, (side - SIDE) // 2) for side in heights.shape)
    heights = heights[y : y + SIDE, x : x + SIDE]
    return np.where(np.isfinite(heights) & (heights > -12000), heights, 0)


def write(heights, name, options=()):
    kinds = {"float32": gdal.GDT_Float32, "int16": gdal.GDT_Int16, "uint16": gdal.GDT_UInt16}
    rows, columns = heights.shape
    driver = gdal.GetDriverByName("GTiff")
    made = driver.Create(str(name), columns, rows, 1, kinds[heights.dtype.name], list(options))
    if (heights == VOID).any():
        made.GetRasterBand(1).SetNoDataValue(VOID)
    made.GetRasterBand(1).WriteArray(heights)


def through_lerc(heights, error):
    """What a reader gets of a file within an error: each square of 8 x 8 samples has an offset."""
    with tempfile.TemporaryDirectory() as folder:
        name = f"{folder}/lerc.tif"
        write(heights.astype(np.float32), name, ["COMPRESS=LERC", f"MAX_Z_ERROR={error}"])
        return gdal.Open(name).ReadAsArray()


def geoid(heights):
    """A smooth surface of some 30 metres."""
    y, x = np.mgrid[: heights.shape[0], : heights.shape[1]]
    return 30.1234 + 0.0013 * x + 0.0007 * y + 1e-7 * x * y


def slope(heights):
    return 0.0371 * np.arange(heights.shape[1])[None, :] + 0 * heights


def two_surveys(heights):
    decimetres = np.round(heights * 10) / 10
    decimetres[:, heights.shape[1] // 2 :] += 0.0371
    return decimetres


def interpolated(heights):
    """Whole metres, one sample in a hundred between them."""
    odd = np.random.default_rng(1).random(heights.shape) < 0.01
    return np.where(odd, heights, np.round(heights))


def eight_bits(heights):
    span = max(np.ptp(heights), 1)
    return np.round((heights - heights.min()) * 255 / span) * span / 255


def square_roots(heights):
    return (np.sqrt((heights - heights.min()) / max(np.ptp(heights), 1)) * 65535).astype(np.uint16)


def with_holes(heights, share):
    """Whole metres without so many single samples."""
    holes = np.random.default_rng(2).random(heights.shape) < share
    return np.where(holes, VOID, np.round(heights)).astype(np.int16)


def strips(heights):
    """Whole metres between narrow gaps, as beside the paths of a scanner."""
    y, x = np.mgrid[: heights.shape[0], : heights.shape[1]]
    gaps = (0.97 * x - 0.2 * y) % 40 >= 33
    return np.where(gaps, VOID, np.round(heights)).astype(np.int16)


def triangulated(heights, samples_a_point):
    """Linear between points that lie anywhere."""
    last = np.array(heights.shape) - 1
    corners = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
    anywhere = np.random.default_rng(3).random((heights.size // samples_a_point, 2))
    points = np.concatenate([corners, anywhere]) * last
    values = ndimage.map_coordinates(heights, points.T, order=1)
    rows, columns = np.indices(heights.shape)
    return interpolate.LinearNDInterpolator(points, values)(rows, columns)


def nearest(heights, degrees, across, along):
    """Whole metres, turned and stretched by nearest neighbours, as warping does by default."""
    middle_y, middle_x = (side / 2 for side in heights.shape)
    rows, columns = np.indices(heights.shape)
    y, x, angle = rows - middle_y, columns - middle_x, np.deg2rad(degrees)
    from_y = (np.sin(angle) * x + np.cos(angle) * y) * along + middle_y
    from_x = (np.cos(angle) * x - np.sin(angle) * y) * across + middle_x
    places = [
        np.clip(np.round(place), 0, side - 1).astype(int)
        for place, side in zip((from_y, from_x), heights.shape)
    ]
    return np.round(heights)[places[0], places[1]].astype(np.int16)


def resampled(heights):
    """As floats come out of a filter."""
    return ndimage.gaussian_filter(heights, 1)


def enlarged(heights, times):
    """Bilinear, as warping to a finer grid does."""
    rows, columns = np.indices(heights.shape) / times
    return ndimage.map_coordinates(heights, [rows, columns], order=1)


def splines(heights, times):
    """Cubic between every so many samples."""
    rows, columns = np.indices(heights.shape) / times
    return ndimage.map_coordinates(heights[::times, ::times], [rows, columns], order=3)


def beside(heights, other):
    """The left half beside the right half of others."""
    middle_column = heights.shape[1] // 2
    return np.concatenate([heights[:, :middle_column], other[:, middle_column:]], axis=1)


def in_patches(heights, other):
    """Patches of both, as of surveys of different years."""
    patches = ndimage.gaussian_filter(np.random.default_rng(4).normal(size=heights.shape), 40) > 0
    return np.where(patches, heights, other)


KINDS = {
    "feet": lambda h: (np.round(h / FOOT) * FOOT).astype(np.float32),
    "feet_whole_metres": lambda h: np.round(np.round(h / FOOT) * FOOT).astype(np.int16),
    "eight_bits": lambda h: eight_bits(h).astype(np.float32),
    "interpolated": lambda h: interpolated(h).astype(np.float32),
    "square_roots": square_roots,
    "copies_3x3": lambda h: np.round(h)[:170, :170].repeat(3, 0).repeat(3, 1).astype(np.int16),
    "lerc_0.01": lambda h: through_lerc(h, 0.01),
    "lerc_0.1": lambda h: through_lerc(h, 0.1),
    "lerc_0.5": lambda h: through_lerc(h, 0.5),
    "metres_on_slope": lambda h: (np.round(h) + slope(h)).astype(np.float32),
    "metres_above_geoid": lambda h: (np.round(h) + geoid(h)).astype(np.float32),
    "decimetres_above_geoid": lambda h: (np.round(h * 10) / 10 + geoid(h)).astype(np.float32),
    "feet_above_geoid": lambda h: (np.round(h / FOOT) * FOOT + geoid(h)).astype(np.float32),
    "two_surveys": lambda h: two_surveys(h).astype(np.float32),
    "holes_1_percent": lambda h: with_holes(h, 0.01),
    "holes_20_percent": lambda h: with_holes(h, 0.2),
    "strips": strips,
    "tin_20": lambda h: np.round(triangulated(h, 20)).astype(np.int16),
    "tin_150": lambda h: np.round(triangulated(h, 150)).astype(np.int16),
    "tin_1000": lambda h: np.round(triangulated(h, 1000)).astype(np.int16),
    "tin_20_floats": lambda h: triangulated(h, 20).astype(np.float32),
    "tin_150_floats": lambda h: triangulated(h, 150).astype(np.float32),
    "tin_1000_floats": lambda h: triangulated(h, 1000).astype(np.float32),
    "enlarged_floats": lambda h: enlarged(h, 3.7).astype(np.float32),
    "terraces": lambda h: (np.floor(h / 15) * 15).astype(np.int16),
    "smoothed": lambda h: np.round(ndimage.gaussian_filter(h, 6)).astype(np.int16),
    "smoothed_decimetres": lambda h: np.round(ndimage.gaussian_filter(h, 3), 1).astype(np.float32),
    "smoothed_centimetres": lambda h: np.round(ndimage.gaussian_filter(h, 8), 2).astype(np.float32),
    "splines": lambda h: np.round(splines(h, 8), 2).astype(np.float32),
    "turned": lambda h: nearest(h, 23, 0.68, 0.68),
    "warped": lambda h: nearest(h, 1.1, 0.82, 1),
    "metres_beside_tens": lambda h: beside(np.round(h), np.round(h / 10) * 10).astype(np.int16),
    "metres_and_tens": lambda h: in_patches(np.round(h), np.round(h / 10) * 10).astype(np.int16),
    "metres_and_floats": lambda h: in_patches(np.round(h), resampled(h)).astype(np.float32),
}


def main(out, *folders):
    sources = sorted(name for folder in folders for name in Path(folder).rglob("height.tif"))
    if not sources:
        sys.exit("kinds: no height.tif below " + ", ".join(folders))
    for source in sources:
        heights = middle(source)
        for kind, make in KINDS.items():
            folder = Path(out) / f"{source.parent.name}_{kind}"
            folder.mkdir(parents=True, exist_ok=True)
            write(make(heights), folder / "height.tif")
    print(f"{len(sources) * len(KINDS)} files below {out}: bench/lossless {out}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: kinds OUT FOLDER...")
    main(*sys.argv[1:])
