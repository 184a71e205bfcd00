# SPDX-License-Identifier: Apache-2.0
"""bench/sequence runs this: sequence.py TETRAKIS FOLDER|FILE... Each FOLDER holds frames (*.tif or
*.png); a FILE that GDAL reads has a frame in each band, of which the first 128 count. It prints
bytes: of a sequence in groups of 16, of one whose groups go on from the one before, of each frame
by itself, and of peers (sequence_videos.py). With --pace HEIGHTS TEXTURES it prints the frames a
second that one core encodes of both. Needs NumPy, GDAL's Python module, zfpy, aomenc and x265."""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import zfpy
from osgeo import gdal
from sequence_videos import av1, hevc

gdal.UseExceptions()
gdal.SetConfigOption("GRIB_NORMALIZE_UNITS", "NO")  # as the file has them
MOST, GROUP = 128, 16
BOUNDS = (1e-2, 1e-3)  # of the range of the heights


def frames_of(source, folder):
    """The names of the frames."""
    if source.is_dir():
        return sorted(p for p in source.iterdir() if p.suffix in (".tif", ".png"))
    names = []
    data = gdal.Open(str(source))
    for band in range(1, min(data.RasterCount, MOST) + 1):
        names.append(folder / f"{band:04}.tif")
        samples = data.GetRasterBand(band).ReadAsArray().astype(np.float32)
        write(samples, names[-1])
    return names


def write(samples, name, options=(), nodata=None):
    kind = {"float32": gdal.GDT_Float32, "uint16": gdal.GDT_UInt16, "int16": gdal.GDT_Int16}
    made = gdal.GetDriverByName("GTiff").Create(
        str(name), samples.shape[1], samples.shape[0], 1, kind[samples.dtype.name], list(options)
    )
    if nodata is not None:
        made.GetRasterBand(1).SetNoDataValue(nodata)
    made.GetRasterBand(1).WriteArray(samples)


def tetrakis(program, names, group, *target):
    """Bytes and seconds."""
    with tempfile.TemporaryDirectory() as out:
        pattern = str(names[0].parent / ("*" + names[0].suffix))
        inputs = [pattern] if names[0].suffix == ".tif" else ["--texture", pattern]
        begin = time.time()
        subprocess.run(
            [program, "encode", *inputs, "--group", str(group), *target, "-q", "-o",
             out + "/s.tks"],
            check=True,
        )
        return Path(out + "/s.tks").stat().st_size, time.time() - begin


def geotiffs(names, options, predictor=True):
    """Bytes of all frames as files of their own."""
    total = 0
    with tempfile.TemporaryDirectory() as out:
        for name in names:
            data = gdal.Open(str(name))
            real = data.GetRasterBand(1).DataType == gdal.GDT_Float32
            more = [f"PREDICTOR={3 if real else 2}"] if predictor else []
            gdal.GetDriverByName("GTiff").CreateCopy(
                out + "/f.tif", data, options=[*options, *more]
            )
            total += Path(out + "/f.tif").stat().st_size
    return total


def netcdf(names):
    """Bytes of one NetCDF-4 file, shuffled and deflated."""
    with tempfile.TemporaryDirectory() as out:
        cube = gdal.BuildVRT("", [str(n) for n in names], separate=True)
        options = ["FORMAT=NC4C", "COMPRESS=DEFLATE", "ZLEVEL=9"]
        gdal.GetDriverByName("netCDF").CreateCopy(out + "/c.nc", cube, options=options)
        return Path(out + "/c.nc").stat().st_size


def zfp(cube, **bound):
    """Bytes of ZFP, which codes blocks of 4 x 4 x 4 samples."""
    return len(zfpy.compress_numpy(np.ascontiguousarray(cube, np.float32), **bound))


def bytes_at(curve, psnr):
    """Between the qualities that were coded; nothing beyond them."""
    if not curve[0][0] <= psnr <= curve[-1][0]:
        return None
    return int(np.exp(np.interp(psnr, [p for p, _ in curve], [np.log(b) for _, b in curve])))


def tell(name, what, found):
    ours = found["sequence"]
    peers = {k: v for k, v in found.items() if k not in ("sequence", "going_on")}
    best = min((k for k in peers if k != "frames"), key=peers.get)
    ours = min(ours, found["going_on"])
    cells = "  ".join(f"{k} {v}" for k, v in found.items())
    print(f"{name:10} {what:12} {cells}  of frames {ours / peers['frames']:.3f}"
          f"  of {best} {ours / peers[best]:.3f}", flush=True)


def both(program, names, *target):
    """Bytes of groups that stand by themselves, and of groups that go on from the one before."""
    return {"sequence": tetrakis(program, names, GROUP, *target)[0],
            "going_on": tetrakis(program, names, GROUP, *target, "--reference", "all")[0]}


def heights(program, name, names):
    samples = [gdal.Open(str(n)).ReadAsArray() for n in names]
    first = gdal.Open(str(names[0]))  # bands live as long as their file is open
    nodata = first.GetRasterBand(1).GetNoDataValue()
    scale = first.GetRasterBand(1).GetScale() or 1
    cube = np.stack(samples).astype(np.float64)
    known = cube[cube != nodata] if nodata is not None else cube
    span = known.max() - known.min()
    found = {**both(program, names, "--lossless"),
             "frames": tetrakis(program, names, 1, "--lossless")[0],
             "zfp": zfp(cube),
             "zstd": geotiffs(names, ["COMPRESS=ZSTD", "ZSTD_LEVEL=19"]),
             "deflate": geotiffs(names, ["COMPRESS=DEFLATE", "ZLEVEL=9"]),
             "netcdf": netcdf(names)}
    tell(name, "lossless", found)
    for part in BOUNDS:
        bound = f"{part * span:.6g}"
        # Bounds are in the unit of the heights, and LERC's in samples.
        error = f"{float(bound) * scale:.9g}"
        found = {**both(program, names, "--max-error", error),
                 "frames": tetrakis(program, names, 1, "--max-error", error)[0],
                 "zfp": zfp(cube, tolerance=float(bound)),
                 "lerc": geotiffs(names, ["COMPRESS=LERC_ZSTD", f"MAX_Z_ERROR={bound}"], False)}
        tell(name, f"within {part:g}", found)


def latency(program, name, names):
    """Bytes of short groups, which a live receiver waits less for."""
    for group in (1, 4):
        alone = tetrakis(program, names, group, "--lossless")[0]
        on = tetrakis(program, names, group, "--lossless", "--reference", "all")[0]
        print(f"{name:10} groups of {group}  alone {alone}  going_on {on}  of alone "
              f"{on / alone:.3f}", flush=True)


def textures(program, name, names):
    found = {**both(program, names, "--lossless"),
             "frames": tetrakis(program, names, 1, "--lossless")[0],
             "png": sum(n.stat().st_size for n in names)}
    tell(name, "lossless", found)
    frames = [np.moveaxis(gdal.Open(str(n)).ReadAsArray(), 0, 2) for n in names]
    videos = {"av1_intra": av1(frames), "av1": av1(frames, GROUP), "x265": hevc(frames, 8)}
    for psnr in ("32", "38"):
        ours, seconds = tetrakis(program, names, GROUP, "--psnr", psnr)
        frames = tetrakis(program, names, 1, "--psnr", psnr)[0]
        print(f"{name:10} {psnr} dB        sequence {ours}  frames {frames}  "
              + "".join(f"{k} {bytes_at(v, float(psnr))}  " for k, v in videos.items()) +
              f"of frames {ours / frames:.3f}  {len(names) / seconds:.1f} frames a second",
              flush=True)


def pace(program, heights_folder, textures_folder):
    """Frames of heights with textures that one core encodes in a second of processor time."""
    names = [str(Path(f) / "*") for f in (heights_folder, textures_folder)]
    count = len(frames_of(Path(heights_folder), None))
    for group in (["1"], ["1", "--reference", "2k"], ["4"], ["16"]):
        cells = []
        for target in (["--rate", "16k"], ["--rate", "64k"], ["--psnr", "38"], ["--lossless"]):
            with tempfile.TemporaryDirectory() as out:
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                subprocess.run(
                    [program, "encode", names[0], "--texture", names[1], "--fps", "2", "--group",
                     *group, *target, "--threads", "1", "-q", "-o", out + "/s.tks"], check=True)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
            taken = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            cells.append(f"{' '.join(target)}: {count / taken:.1f}")
        print(f"groups of {' '.join(group):17}  {'  '.join(cells)}", flush=True)


def main():
    if sys.argv[2] == "--pace":
        pace(sys.argv[1], *sys.argv[3:5])
        return
    program, sources = sys.argv[1], [Path(a) for a in sys.argv[2:]]
    for source in sources:
        with tempfile.TemporaryDirectory() as folder:
            names = frames_of(source, Path(folder))
            kind = heights if names[0].suffix == ".tif" else textures
            kind(program, source.stem[:10], names)
            latency(program, source.stem[:10], names)


main()
