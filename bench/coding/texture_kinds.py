# SPDX-License-Identifier: Apache-2.0
"""bench/texture_kinds runs this: texture_kinds.py DIR... [--only KIND,...] [--tetrakis PROGRAM].
From the middle 512 x 512 texels of each DIR/**/*.png of RGB it makes textures as they come in GIS
files, and codes them to the last bit: with Tetrakis, PNG, WebP, JPEG 2000 (OpenJPEG), all by GDAL
but the first, and with JPEG XL (cjxl, effort 7). Prints bytes, and ours over the best peer's.
Needs NumPy, GDAL's Python module and cjxl."""

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from osgeo import gdal

gdal.UseExceptions()
SIDE = 512


def middle(name):
    """Rows x columns x 3, of 8 bits."""
    image = np.moveaxis(gdal.Open(str(name)).ReadAsArray()[:3], 0, 2)
    y, x = (max(0, (side - SIDE) // 2) for side in image.shape[:2])
    return image[y : y + SIDE, x : x + SIDE]


def by_channel(image, change):
    return np.stack([change(image[..., c]) for c in range(image.shape[2])], 2)


def stretched(channel, levels):
    """So many levels over all 256."""
    coarse = np.round(channel * ((levels - 1) / 255.0))
    return np.round(coarse * (255 / (levels - 1))).astype(np.uint8)


def clipped(channel, percent):
    low, high = np.percentile(channel, [percent, 100 - percent])
    wide = (channel - low) * (255 / max(high - low, 1))
    return np.round(np.clip(wide, 0, 255)).astype(np.uint8)


def equalised(channel):
    counts = np.bincount(channel.ravel(), minlength=256)
    return np.round(np.cumsum(counts)[channel] * (255 / channel.size)).astype(np.uint8)


def powered(channel, power):
    return np.round(255 * (channel / 255.0) ** power).astype(np.uint8)


def ten_bits(image):
    """Sums of four texels."""
    quarters = [image[y::2, x::2].astype(np.uint16) for y in (0, 1) for x in (0, 1)]
    rows, columns = (min(q.shape[side] for q in quarters) for side in (0, 1))
    return sum(q[:rows, :columns] for q in quarters)


def five_six_five(image):
    out = image.copy()
    for c, bits in enumerate((5, 6, 5)):
        high = image[..., c] >> (8 - bits)
        out[..., c] = high << (8 - bits) | high >> (2 * bits - 8)
    return out


def enlarged(image, factor):
    rows, columns = (np.floor(np.arange(SIDE) / factor).astype(int) for _ in (0, 1))
    return image[rows[rows < image.shape[0]]][:, columns[columns < image.shape[1]]]


def grey(image):
    return np.round(image @ [0.299, 0.587, 0.114])[..., None].astype(np.uint8)


def ramp_at(brightness):
    ramp = np.array([[40, 90, 60], [120, 160, 80], [220, 200, 140], [150, 100, 70], [250, 250, 250]])
    places = np.linspace(0, 255, len(ramp))
    colours = [np.interp(brightness, places, ramp[:, c]) for c in range(3)]
    return np.round(np.stack(colours, 2)).astype(np.uint8)


def tinted(image):
    """A ramp of colours over the brightness."""
    return ramp_at(grey(image)[..., 0])


def gradient(image):
    """Of the image nothing but its size: a ramp of colours by the distance from a corner."""
    rows, columns = image.shape[:2]
    far = np.hypot(*np.meshgrid(np.arange(columns), np.arange(rows)))
    return ramp_at(far * (255 / far.max()))


KINDS = {
    "as_it_is": lambda i: i,
    "levels_150": lambda i: by_channel(i, lambda c: stretched(c, 150)),
    "levels_200": lambda i: by_channel(i, lambda c: stretched(c, 200)),
    "levels_64": lambda i: by_channel(i, lambda c: stretched(c, 64)),
    "clipped_2_percent": lambda i: by_channel(i, lambda c: clipped(c, 2)),
    "clipped_10_percent": lambda i: by_channel(i, lambda c: clipped(c, 10)),
    "grey_clipped": lambda i: clipped(grey(i), 2),
    "equalised": lambda i: by_channel(i, equalised),
    "gamma_0.5": lambda i: by_channel(i, lambda c: powered(c, 0.5)),
    "gamma_1.8": lambda i: by_channel(i, lambda c: powered(c, 1.8)),
    "bits_5_6_5": five_six_five,
    "times_257": lambda i: i.astype(np.uint16) * 257,
    "ten_bits_high": lambda i: ten_bits(i) * np.uint16(64),
    "ten_bits_over_16": lambda i: np.round(ten_bits(i) * (65535 / 1020)).astype(np.uint16),
    "square_roots_16": lambda i: np.round(np.sqrt(ten_bits(i) / 1020) * 65535).astype(np.uint16),
    "copies_2x2": lambda i: enlarged(i, 2),
    "copies_3x3": lambda i: enlarged(i, 3),
    "copies_4x4": lambda i: enlarged(i, 4),
    "nearest_1.1": lambda i: enlarged(i, 1.1),
    "nearest_1.5": lambda i: enlarged(i, 1.5),
    "nearest_2.3": lambda i: enlarged(i, 2.3),
    "levels_150_copies_2x2": lambda i: enlarged(by_channel(i, lambda c: stretched(c, 150)), 2),
    "tinted": tinted,
    "gradient": gradient,
}


def open_image(image):
    kind = {"uint8": gdal.GDT_Byte, "uint16": gdal.GDT_UInt16}[image.dtype.name]
    rows, columns, channels = image.shape
    made = gdal.GetDriverByName("MEM").Create("", columns, rows, channels, kind)
    for c in range(channels):
        made.GetRasterBand(c + 1).WriteArray(np.ascontiguousarray(image[..., c]))
    return made


def size_of(words, name):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    size = name.stat().st_size
    name.unlink()
    return size


def sizes_of(image, tetrakis, folder):
    """Bytes of each codec that takes such an image."""
    source = open_image(image)
    sizes = {}
    png, tks, jxl, other = (folder / f"image.{end}" for end in ("png", "tks", "jxl", "other"))
    gdal.GetDriverByName("PNG").CreateCopy(str(png), source, options=["ZLEVEL=9"])
    sizes["png"] = png.stat().st_size
    sizes["tetrakis"] = size_of([tetrakis, "encode", "--texture", png, "--lossless", "-o", tks], tks)
    sizes["jxl"] = size_of(["cjxl", "-d", "0", "-e", "7", png, jxl], jxl)
    for codec, driver, options in (
        ("webp", "WEBP", ["LOSSLESS=YES", "QUALITY=100"]),
        ("jp2", "JP2OpenJPEG", ["REVERSIBLE=YES", "QUALITY=100", "RESOLUTIONS=6"]),
    ):
        if codec == "webp" and (image.dtype != np.uint8 or image.shape[2] == 1):
            continue
        gdal.GetDriverByName(driver).CreateCopy(str(other), source, options=options)
        sizes[codec] = other.stat().st_size
        other.unlink()
    return sizes


def main():
    parser = argparse.ArgumentParser(description="Lossless textures by kind, beside peers")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--only", default="", help="kinds, with commas between them")
    built = Path(__file__).parents[2] / "build" / "tetrakis"
    parser.add_argument("--tetrakis", default=built, help="the command line that is measured")
    arguments = parser.parse_args()
    names = sorted(n for folder in arguments.folders for n in Path(folder).rglob("*.png"))
    images = {n: middle(n) for n in names if gdal.Open(str(n)).RasterCount >= 3}
    if not images:
        sys.exit("texture_kinds: no PNG of RGB below " + ", ".join(arguments.folders))
    kinds = arguments.only.split(",") if arguments.only else list(KINDS)
    codecs = ("tetrakis", "png", "webp", "jxl", "jp2")
    print(f"{'kind':22}{'image':>24}" + "".join(f"{c:>10}" for c in codecs) + f"{'ratio':>8}")
    with tempfile.TemporaryDirectory() as folder:
        for kind in kinds:
            logarithms = []
            for name, image in images.items():
                made = np.ascontiguousarray(KINDS[kind](image))
                sizes = sizes_of(made, arguments.tetrakis, Path(folder))
                ratio = sizes["tetrakis"] / min(v for c, v in sizes.items() if c != "tetrakis")
                logarithms.append(math.log(ratio))
                label = name.stem if name.stem != "texture" else name.parent.name
                row = "".join(f"{sizes.get(c, '-'):>10}" for c in codecs)
                print(f"{kind:22}{label[:23]:>24}{row}{ratio:8.3f}", flush=True)
            mean = math.exp(sum(logarithms) / len(logarithms))
            print(f"{kind:22}{'geometric mean':>24}{'':50}{mean:8.3f}", flush=True)


if __name__ == "__main__":
    main()
