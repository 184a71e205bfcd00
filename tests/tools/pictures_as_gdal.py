#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pictures of every kind that GDAL writes are read as GDAL reads them.

pictures_as_gdal.py TETRAKIS READ_PICTURES: the programs. Interleavings, tilings, compressions,
colour spaces, numbers of bits; `tetrakis encode` refuses a file with a sentence and an exit code of
1 or 2, and leaves no output.
"""
import itertools
import os
import struct
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from osgeo import gdal
except ImportError:
    sys.exit(77)

gdal.UseExceptions()
gdal.PushErrorHandler("CPLQuietErrorHandler")
WIDTH, HEIGHT = 37, 21
TETRAKIS, READER = map(os.path.abspath, sys.argv[1:])
failures = []
counted = 0


def expect(holds, kind, what):
    if not holds:
        failures.append(f"{kind}: {what}")


def run(*arguments):
    return subprocess.run([TETRAKIS, *arguments], capture_output=True, text=True, timeout=60)


def refuses(kind, outcome):
    """A refusal: no signal, one sentence, no file."""
    expect(outcome.returncode in (1, 2), kind, f"exit code {outcome.returncode}")
    expect(outcome.stderr.count("\n") == 1, kind, f"says {outcome.stderr!r}")
    left = [name for name in os.listdir(".") if name.endswith(".tks") or name.startswith(".tet")]
    expect(not left, kind, f"leaves {left}")


class Reader:
    """READ_PICTURES, which is started again if a file kills it."""

    def __init__(self):
        self.program = None

    def __call__(self, part, kind, name):
        """The bands of t.tif and a note; or nothing and a sentence."""
        global counted
        counted += 1
        if os.path.exists("t.tif"):
            os.remove("t.tif")
        if self.program is None:
            self.program = subprocess.Popen([READER], stdin=subprocess.PIPE,
                                            stdout=subprocess.PIPE, text=True)
        self.program.stdin.write(f"{part} {name}\n")
        self.program.stdin.flush()
        answer = self.program.stdout.readline()
        if not answer:
            self.program = None
            expect(False, kind, "the reader dies")
            return None, ""
        status, told = answer.rstrip("\n").split(" ", 1)
        if status == "0":
            return bands("t.tif"), told
        given = ("--texture", name) if part == "texture" else (name,)
        refuses(kind, run("encode", *given, "--lossless", "-o", "t.tks"))
        return None, told


reader = Reader()


def texture(kind, name):
    return reader("texture", kind, name)


def heights(kind, name):
    return reader("heights", kind, name)


def bands(name):
    samples = gdal.Open(name).ReadAsArray()
    return samples[None] if samples.ndim == 2 else samples


def noise(channels, most, dtype, seed=1):
    """Few values."""
    random = np.random.default_rng(seed)
    values = np.linspace(0, most, 5).astype(np.float64)
    steps = np.add.outer(np.arange(HEIGHT) // 4, np.arange(WIDTH) // 5)
    drawn = [values[(steps + i + random.integers(0, 2)) % 5] for i in range(channels)]
    return np.array(drawn).astype(dtype)


def write(name, samples, driver="GTiff", options=(), nodata=None, colours=None, alpha=False):
    types = {"uint8": gdal.GDT_Byte, "uint16": gdal.GDT_UInt16, "uint32": gdal.GDT_UInt32,
             "int16": gdal.GDT_Int16, "int32": gdal.GDT_Int32, "float32": gdal.GDT_Float32,
             "float64": gdal.GDT_Float64}
    memory = gdal.GetDriverByName("MEM").Create(
        "", samples.shape[2], samples.shape[1], len(samples), types[samples.dtype.name])
    for i, band in enumerate(samples):
        memory.GetRasterBand(i + 1).WriteArray(band)
        if nodata is not None:
            memory.GetRasterBand(i + 1).SetNoDataValue(nodata)
    if colours is not None:
        memory.GetRasterBand(1).SetColorTable(colours)
    if len(samples) >= 3 and driver != "GTiff":
        for i, colour in enumerate((gdal.GCI_RedBand, gdal.GCI_GreenBand, gdal.GCI_BlueBand)):
            memory.GetRasterBand(i + 1).SetColorInterpretation(colour)
    if alpha:
        memory.GetRasterBand(len(samples)).SetColorInterpretation(gdal.GCI_AlphaBand)
    gdal.GetDriverByName(driver).CreateCopy(name, memory, options=list(options))


def layouts():
    """Interleavings by tilings."""
    for interleave, tile in itertools.product(("PIXEL", "BAND"), (0, 16)):
        options = [f"INTERLEAVE={interleave}"]
        if tile:
            options += ["TILED=YES", f"BLOCKXSIZE={tile}", f"BLOCKYSIZE={tile}"]
        else:
            options += ["BLOCKYSIZE=8"]
        yield options


def widened(samples, bits):
    """Fewer than 8 bits, as 8."""
    most = (1 << bits) - 1
    return (samples.astype(np.int64) * 255 + most // 2) // most


def check_textures_by_layout():
    """Greys and RGB, with and without alpha, in every layout and compression."""
    compressions = [["COMPRESS=NONE"], ["COMPRESS=LZW", "PREDICTOR=2"], ["COMPRESS=JPEG"],
                    ["COMPRESS=WEBP", "WEBP_LOSSLESS=YES"], ["COMPRESS=ZSTD"], ["COMPRESS=LERC"],
                    ["COMPRESS=PACKBITS"]]
    for layout, compression in itertools.product(layouts(), compressions):
        for channels in (1, 2, 3, 4):
            options = [*layout, *compression]
            if channels % 2 == 0:
                options.append("ALPHA=NON-PREMULTIPLIED")
            if channels >= 3:
                options.append("PHOTOMETRIC=RGB")
            kind = f"{channels} channels {' '.join(options)}"
            if "WEBP" in compression[0] and (channels < 3 or "BAND" in layout[0]):
                continue  # no such file can be
            write("f.tif", noise(channels, 255, np.uint8), options=options)
            got, told = texture(kind, "f.tif")
            wanted = bands("f.tif")
            expect(got is not None and np.array_equal(got, wanted), kind,
                   told if got is None else "other samples")


def check_colour_spaces():
    for layout in layouts():
        for space, channels, dtype, most in (("CMYK", 4, np.uint8, 255),
                                             ("CMYK", 4, np.uint16, 65535),
                                             ("MINISWHITE", 1, np.uint8, 255),
                                             ("MINISWHITE", 1, np.uint16, 65535),
                                             ("CIELAB", 3, np.uint8, 255),
                                             ("ICCLAB", 3, np.uint8, 255),
                                             ("ITULAB", 3, np.uint8, 255)):
            kind = f"{space} of {np.dtype(dtype)} {' '.join(layout)}"
            write("f.tif", noise(channels, most, dtype),
                  options=[*layout, f"PHOTOMETRIC={space}"])
            got, told = texture(kind, "f.tif")
            if "LAB" in space:
                expect(got is None and "makes RGB" in told or "converts it" in told, kind, told)
                continue
            stored = noise(channels, most, dtype).astype(np.int64)
            if space == "CMYK":
                wanted = ((most - stored[:3]) * (most - stored[3]) + most // 2) // most
            else:
                wanted = most - stored
            expect(got is not None and np.array_equal(got, wanted), kind, told)
    for extra in ([], ["TILED=YES"]):
        options = ["COMPRESS=JPEG", "PHOTOMETRIC=YCBCR", *extra]
        write("f.tif", noise(3, 255, np.uint8), options=options)
        got, told = texture("YCbCr", "f.tif")
        expect(np.array_equal(got, bands("f.tif")), f"YCbCr {extra}", told)


def check_numbers_of_bits():
    """As stored from 9 bits on, and all heights."""
    for bits in (*range(1, 8), 9, 10, 11, 12, 13, 14, 15, *range(17, 32)):
        dtype = np.uint8 if bits < 8 else np.uint16 if bits < 16 else np.uint32
        samples = noise(1, (1 << bits) - 1, dtype)
        for layout in list(layouts())[:2]:  # of one channel planes are no others than pixels
            kind = f"{bits} bits {' '.join(layout)}"
            write("f.tif", samples, options=[*layout, f"NBITS={bits}"])
            stored = bands("f.tif")
            expect(np.array_equal(stored, samples), kind, "GDAL writes others")
            got, told = heights(kind, "f.tif")
            expect(got is not None and np.array_equal(got, stored), kind, f"heights: {told}")
            if bits > 16:
                continue
            got, told = texture(kind, "f.tif")
            wanted = widened(stored, bits) if bits < 8 else stored
            expect(got is not None and np.array_equal(got, wanted), kind, f"texture: {told}")
    for layout in layouts():
        kind = f"RGB of 12 bits {' '.join(layout)}"
        write("f.tif", noise(3, 4095, np.uint16), options=[*layout, "NBITS=12"])
        got, told = texture(kind, "f.tif")
        expect(got is not None and np.array_equal(got, bands("f.tif")), kind, told)
    for bits, dtype in ((16, np.float32), (24, np.float32), (32, np.float32)):
        for layout in list(layouts())[:2]:
            kind = f"floats of {bits} bits {' '.join(layout)}"
            samples = (noise(1, 1000, dtype) + np.float32(0.4375)) * np.float32(0.3)
            write("f.tif", samples, options=[*layout, f"NBITS={bits}"] if bits < 32 else layout)
            got, told = heights(kind, "f.tif")
            expect(got is not None and np.array_equal(got, bands("f.tif")), kind, told)


def check_palettes():
    """The class of the nodata value is transparent, others opaque."""
    table = gdal.ColorTable()
    for i in range(16):
        table.SetColorEntry(i, (16 * i, 255 - 16 * i, 7 * i, 255))
    for layout, bits, nodata in itertools.product(layouts(), (4, 8), (None, 3)):
        kind = f"palette of {bits} bits, nodata {nodata} {' '.join(layout)}"
        options = [*layout] + ([f"NBITS={bits}"] if bits < 8 else [])
        samples = noise(1, 12, np.uint8)
        write("f.tif", samples, options=options, nodata=nodata, colours=table)
        got, told = texture(kind, "f.tif")
        if got is None:
            expect(False, kind, told)
            continue
        opened = gdal.Open("f.tif")  # which has to outlive its bands
        found = opened.GetRasterBand(1).GetColorTable()
        entries = np.array([found.GetColorEntry(i) for i in range(16)])
        wanted = entries[samples[0]].transpose(2, 0, 1)
        expect(np.array_equal(got[:3], wanted[:3]), kind, "other colours")
        expect(len(got) == (3 if nodata is None else 4), kind, f"{len(got)} channels")
        if nodata is not None:
            expect(np.array_equal(got[3] == 0, samples[0] == nodata), kind, "other alpha")


def check_sparse():
    for layout, nodata, channels, all_out in itertools.product(
            layouts(), (None, 9), (1, 3), (False, True)):
        kind = f"sparse {channels} channels, nodata {nodata}, all {all_out} {' '.join(layout)}"
        created = gdal.GetDriverByName("GTiff").Create(
            "f.tif", 80, 70, channels, gdal.GDT_Byte, options=[*layout, "SPARSE_OK=TRUE"])
        for i in range(channels):
            if nodata is not None:
                created.GetRasterBand(i + 1).SetNoDataValue(nodata)
            if not all_out:
                created.GetRasterBand(i + 1).WriteArray(
                    np.full((5, 16), 100 + i, np.uint8), 0, 0)
        created = None
        stored = bands("f.tif")
        got, told = texture(kind, "f.tif")
        if got is None:
            expect(False, kind, told)
            continue
        expect(np.array_equal(got[:channels], stored), kind, "other samples")
        if nodata is not None and not all_out:
            expect(np.array_equal(got[-1] == 0, (stored == nodata).all(axis=0)), kind,
                   "other alpha")
        if channels > 1 or not all_out:
            continue
        got, told = heights(kind, "f.tif")
        if got is not None and nodata is None and not all_out:
            # What is missing of heights without a nodata value is void, as CLI.md says.
            opened = gdal.Open("t.tif")
            void = opened.GetRasterBand(1).GetNoDataValue()
            stored = np.where(stored == 0, void, stored)
        expect(got is not None and np.array_equal(got, stored), kind, f"heights: {told}")


def check_jpeg2000():
    """All depths, signed too; with --lossless as GDAL's driver writes them."""
    options = ["QUALITY=100", "REVERSIBLE=YES", "YCBCR420=NO"]
    for bits, channels in itertools.product((1, 4, 8, 10, 12, 15, 16, 17, 20, 24, 28), (1, 3, 4)):
        dtype = np.uint8 if bits <= 8 else np.uint16 if bits <= 16 else np.uint32
        kind = f"JPEG 2000 of {channels} x {bits} bits"
        samples = noise(channels, (1 << bits) - 1, dtype)
        write("f.jp2", samples, "JP2OpenJPEG", [*options, f"NBITS={bits}"], alpha=channels == 4)
        stored = bands("f.jp2")
        if channels == 1:
            got, told = heights(kind, "f.jp2")
            expect(got is not None and np.array_equal(got, stored), kind, f"heights: {told}")
        got, told = texture(kind, "f.jp2")
        if bits > 16:
            expect(got is None and "65535" in told, kind, told)
            continue
        wanted = widened(stored, bits) if bits < 8 else stored.astype(np.int64)
        if channels == 4 and bits > 8:
            most = (1 << bits) - 1
            wanted[3] = (wanted[3] * 65535 + most // 2) // most
        expect(got is not None and np.array_equal(got, wanted), kind, told)
    samples = (noise(1, 6000, np.float64) - 3000).astype(np.int16)
    write("f.jp2", samples, "JP2OpenJPEG", options)
    got, told = heights("signed JPEG 2000", "f.jp2")
    expect(got is not None and np.array_equal(got, samples), "signed JPEG 2000", told)


def bitmap(bits, coding, palette, rows):
    """A BMP of 8 x 4 pixels, from below."""
    head = struct.pack("<IiiHHIIiiII", 40, 8, 4, 1, bits, coding, len(rows), 0, 0, len(palette), 0)
    table = b"".join(bytes([blue, green, red, 0]) for red, green, blue in palette)
    start = 14 + len(head) + len(table)
    return struct.pack("<2sIII", b"BM", start + len(rows), 0, start) + head + table + rows


def targa(kind, bits, attributes, palette, pixels):
    """A TGA of 8 x 4 pixels."""
    head = struct.pack("<BBBHHBHHHHBB", 0, 1 if palette else 0, kind, 0, len(palette),
                       24 if palette else 0, 0, 0, 8, 4, bits, attributes)
    return head + b"".join(bytes(reversed(colour)) for colour in palette) + pixels


def handmade():
    """BMP and TGA of every coding, which GDAL does not write."""
    random = np.random.default_rng(4)
    palette = [tuple(int(c) for c in random.integers(0, 256, 3)) for _ in range(16)]
    places = random.integers(0, 16, (4, 8)).astype(np.uint8)
    noisy = random.integers(0, 256, 8 * 4 * 4).astype(np.uint8).tobytes()
    nibbles = bytes((places.reshape(-1, 2)[:, 0] * 16 + places.reshape(-1, 2)[:, 1]).tolist())
    runs8 = b"".join(bytes([4, r + 1, 4, r + 2, 0, 0]) for r in range(4)) + b"\0\1"
    yield "BMP 1", bitmap(1, 0, palette[:2], b"".join(bytes([b, 0, 0, 0]) for b in (1, 77, 200, 9)))
    yield "BMP 4", bitmap(4, 0, palette, nibbles)
    yield "BMP 8", bitmap(8, 0, palette, places.tobytes())
    yield "BMP RLE8", bitmap(8, 1, palette, runs8)
    yield "BMP 24", bitmap(24, 0, [], noisy[:96])
    yield "BMP 32", bitmap(32, 0, [], noisy)
    for up in (0, 0x20):
        yield f"TGA 1 {up}", targa(1, 8, up, palette, places.tobytes())
        yield f"TGA 2 of 24 {up}", targa(2, 24, up, [], noisy[:96])
        yield f"TGA 2 of 32 {up}", targa(2, 32, up, [], noisy)
        yield f"TGA 2 of 32 with alpha {up}", targa(2, 32, up | 8, [], noisy)
        yield f"TGA 3 {up}", targa(3, 8, up, [], noisy[:32])
        yield f"TGA 10 {up}", targa(10, 24, up, [], b"\x87\1\2\3\x87\4\5\6\7" + noisy[:24] * 2)
        yield f"TGA 11 {up}", targa(11, 8, up, [], b"\x9f\x2a")


def shown(name):
    """As GDAL reads it, palettes looked up."""
    opened = gdal.Open(name)
    table = opened.GetRasterBand(1).GetColorTable()
    if table is None:
        return bands(name)
    entries = np.array([table.GetColorEntry(i)[:3] for i in range(table.GetCount())])
    return entries[bands(name)[0]].transpose(2, 0, 1)


def check_other_formats():
    for kind, file in handmade():
        name = f"f.{kind[:3].lower()}"
        with open(name, "wb") as made:
            made.write(file)
        wanted = shown(name)
        got, told = texture(kind, name)
        if got is None:
            expect("makes one that is" in told, kind, told)
            continue
        if kind.startswith("BMP") and len(got) == 1:  # a palette of greys
            got = np.repeat(got, 3, axis=0)
        expect(np.array_equal(got, wanted), kind, "other samples")
    for driver, channels, dtype, options in (
            ("SGI", 1, np.uint8, []), ("SGI", 3, np.uint8, []), ("PNM", 1, np.uint8, []),
            ("PNM", 3, np.uint16, []), ("JPEG", 1, np.uint8, []), ("JPEG", 3, np.uint8, []),
            ("WEBP", 3, np.uint8, ["LOSSLESS=YES"]), ("GIF", 1, np.uint8, []),
            ("PNG", 2, np.uint16, []), ("PNG", 4, np.uint8, [])):
        kind = f"{driver} of {channels} x {np.dtype(dtype)}"
        name = "f.pgm" if channels == 1 else "f.ppm" if driver == "PNM" else "f.bin"
        write(name, noise(channels, np.iinfo(dtype).max, dtype), driver, options,
              alpha=channels % 2 == 0)
        got, told = texture(kind, name)
        wanted = shown(name)
        expect(got is not None and np.array_equal(got[:len(wanted)], wanted), kind, told)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for check in (check_textures_by_layout, check_colour_spaces, check_numbers_of_bits,
                      check_palettes, check_sparse, check_jpeg2000, check_other_formats):
            check()
            print(check.__name__, counted, len(failures), flush=True)
        os.chdir("/")
    print(f"{counted} files")
    for failure in failures[:40]:
        print(failure)
    sys.exit(1 if failures else 0)


main()
