# SPDX-License-Identifier: Apache-2.0
"""Terrain that no machine holds becomes one stream, tile by tile.

    tetrakis.mosaic.encode("country.vrt", "country.tks", lossless=True)

The stream is one plane: there are no borders between tiles. Tasks code one tile each, and share a
folder and nothing else, so that any number of workers on any machines may run them, and die at any
time; a run that begins again in the same folder does what is missing. The bytes depend on the
source and the options alone.
"""

from __future__ import annotations

import builtins
import ctypes
import json
import os
from pathlib import Path
from typing import Any, Dict, Optional, Union

from . import _library as c
from . import _mosaic_engines as engines
from . import _mosaic_library as m
from . import _values as values
from ._encode import set_target
from ._errors import TksUsageError
from ._mosaic import Mosaic, PathLike, Tile, run_guarded, source_struct
from ._stoppable import Progress
from ._windows import Samples, WindowSource, source_of
from ._work_folder import Guard, appearing, folder_for

__all__ = ["Mosaic", "Tile", "encode", "plan"]

# Shares of the progress of `encode`: of the plan, and of all but the merge.
_PLANNED, _CODED = 0.1, 0.97

# What `tetrakis.encode` takes of heights, and its defaults. A mosaic is a plane.
_PLACE: Dict[str, Any] = dict(
    nodata=None,
    unit=None,
    spacing=None,
    scale=1.0,
    offset=0.0,
    step=None,
    crs=None,
    geotransform=None,
    registration=None,
    vertical_datum=None,
    description=None,
    geo_keys=None,
)
_PLANE = dict(domain="plane", latitudes=None)


def plan(
    source: Any,
    *,
    workdir: PathLike,
    bytes: Optional[int] = None,
    psnr: Optional[float] = None,
    max_error: Optional[float] = None,
    lossless: Optional[bool] = None,
    regions: Optional[int] = None,
    tile: Optional[int] = None,
    band: int = 1,
    progress: Optional[Progress] = None,
    **place: Any,
) -> Mosaic:
    """Makes the plan of a mosaic in a folder, or takes the one that is there.

    source: a path of a raster that osgeo or rasterio opens (`band` of it), or an array of any
        library, (rows, columns), with a shape, a dtype, and slices: of NumPy (np.memmap too),
        Dask, Zarr, xarray, h5py, netCDF4, or a class of your own. It is read window by window: once
        for the plan, and once for the tiles. float64, int64 and uint64 are taken if float32 and
        int32 hold every value exactly.
    workdir: the folder that tasks share. A plan of the same options, shape, type and, of a raster,
        files of the same size and time is taken; another one is an error. An array whose samples
        have changed needs a new folder.
    bytes, psnr, max_error, lossless: as for :func:`tetrakis.encode`; floats without a common step
        cannot be lossless.
    regions: side of the regions by which windows decode: a power of two from 16; 512. tile: side
        of the tiles, likewise, from a region to 16384; 4096.
    progress: called with a number from 0 to 1.
    place: what the samples are, as for :func:`tetrakis.encode`: nodata (a number), unit, spacing,
        scale, offset, step, crs, geotransform, registration, vertical_datum, description, geo_keys.
        They replace what a raster or an array of xarray says itself.
    """
    folder = Path(workdir)
    folder.mkdir(parents=True, exist_ok=True)
    target = dict(bytes=bytes, psnr=psnr, max_error=max_error, lossless=lossless)
    options = _options(target, regions, tile)
    return _planned(source_of(source, band), folder, options, place, progress)


def encode(
    source: Any,
    out: PathLike,
    *,
    bytes: Optional[int] = None,
    psnr: Optional[float] = None,
    max_error: Optional[float] = None,
    lossless: Optional[bool] = None,
    regions: Optional[int] = None,
    tile: Optional[int] = None,
    band: int = 1,
    workdir: Optional[PathLike] = None,
    client: Any = None,
    workers: Optional[int] = None,
    layout: str = "mixed",
    preview: Optional[int] = None,
    progress: Optional[Progress] = None,
    **place: Any,
) -> None:
    """Codes heights that need not fit into memory, and writes them as the stream `out`.

    source, bytes, psnr, max_error, lossless, regions, tile, band, place: as for :func:`plan`.
    workdir: the folder that tasks share. It stays, and a further run goes on in it; remove it when
        the stream is there. Without one there is a folder beside `out`, which is removed.
    client: of dask.distributed. Workers have to see `workdir` (or the folder of `out`) and the
        source; arrays in memory are written into the folder for them. Tasks that fail are tried
        again three times.
    workers: threads without a client; as many as there are cores, unless given. Each codes a tile,
        and takes its memory.
    layout, preview: as for :meth:`Mosaic.merge`.
    progress: called with a number from 0 to 1, in the thread that called `encode`. What it raises
        ends the run, as Ctrl-C does, once the tiles in work are done.

    The bytes depend on the source and the options alone: not on the engine, nor on how many work.
    """
    threads = values.unsigned(workers, "workers", 16) or os.cpu_count() or 1
    if client is not None and workers is not None:
        raise TksUsageError("workers counts threads of this process: a cluster knows its own.")
    target = dict(bytes=bytes, psnr=psnr, max_error=max_error, lossless=lossless)
    options = _options(target, regions, tile)
    report = progress or (lambda done: None)
    path = Path(out)
    with folder_for(workdir, path) as folder:
        opened = source_of(source, band)
        made = _planned(opened, folder, options, place, lambda done: report(_PLANNED * done))
        tiles = made.tiles
        missing = [each for each in tiles if not made.is_done(each)]

        def told(done: int) -> None:
            share = (len(tiles) - len(missing) + done) / len(tiles)
            report(_PLANNED + (_CODED - _PLANNED) * share)

        told(0)
        if client is None:
            engines.run_by_threads(made, missing, threads, told)
        elif missing:
            engines.run_by_dask(made.for_others(), missing, client, told)
        made.merge(path, layout=layout, preview=preview)
        report(1.0)


def _options(target: Dict[str, Any], regions: Any, tile: Any) -> m.MosaicOptions:
    options = m.MosaicOptions(
        size=ctypes.sizeof(m.MosaicOptions),
        regions=values.unsigned(regions, "regions"),
        tile=values.unsigned(tile, "tile"),
    )
    set_target(options, target)
    return options


def _planned(
    source: WindowSource,
    folder: Path,
    options: m.MosaicOptions,
    given: Dict[str, Any],
    progress: Optional[Progress],
) -> Mosaic:
    unknown = set(given) - set(_PLACE)
    if unknown:
        raise TypeError(f"A mosaic takes no {', '.join(sorted(unknown))}.")
    place = {**_PLACE, **source.said, **given, **_PLANE}
    if place["nodata"] is not None:
        place["nodata"] = values.real(place["nodata"], "nodata")
    samples = Samples(source, place["nodata"])
    asked = _asked(source, options, place)
    if not _is_planned(folder, asked):
        with appearing(folder / "plan") as file:
            file.write(_new_plan(samples, options, place, progress))
        with appearing(folder / "asked.json") as file:
            file.write(asked.encode())
    return Mosaic(folder, (folder / "plan").read_bytes(), samples, place)


def _asked(source: WindowSource, options: m.MosaicOptions, place: Dict[str, Any]) -> str:
    """All that a plan depends on, as far as it can be known without reading samples."""
    wanted = {name: getattr(options, name) for name, _ in options._fields_}
    facts = dict(shape=source.shape, type=source.dtype.str, files=source.fingerprint)
    return json.dumps([facts, wanted, place], sort_keys=True, default=str)


def _is_planned(folder: Path, asked: str) -> bool:
    """The plan is written first, so that one that was cut off is made again."""
    known = folder / "asked.json"
    if not known.exists():
        return False
    if known.read_text() == asked:
        return True
    raise TksUsageError(
        f"The folder {folder} holds a mosaic of another source, or with other options: give a "
        "folder of its own."
    )


def _new_plan(
    samples: Samples, options: m.MosaicOptions, place: Dict[str, Any], progress: Optional[Progress]
) -> builtins.bytes:
    guard, buffer = Guard(), c.Buffer()
    source = source_struct(samples, place, guard, progress)
    run_guarded(guard, c.lib.tks_mosaic_plan, source, options, buffer)
    try:
        return ctypes.string_at(buffer.data, buffer.size)
    finally:
        c.lib.tks_free_buffer(buffer)
