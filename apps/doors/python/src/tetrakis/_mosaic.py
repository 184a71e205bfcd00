# SPDX-License-Identifier: Apache-2.0
"""A mosaic in its folder: which tiles it has, and the tasks that code and merge them."""

from __future__ import annotations

import builtins
import ctypes
import os
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Union

from . import _library as c
from . import _mosaic_library as m
from . import _values as values
from ._encode import described_heights
from ._errors import Status, error
from ._stoppable import Progress
from ._windows import Samples
from ._work_folder import Guard, WorkFolder, appearing, tiles_of

PathLike = Union[str, "os.PathLike[str]"]


class Tile(NamedTuple):
    """What one task codes: a column and row of a group of levels. Group 0 reads the source; each
    further group, with a 64th of the tiles or less, what the one before has left."""

    group: int
    column: int
    row: int


class Mosaic:
    """A plan, the folder that its tasks share, and the source. It can be pickled."""

    def __init__(
        self, folder: Path, plan: builtins.bytes, samples: Samples, place: Dict[str, Any]
    ) -> None:
        self._folder, self._plan = folder, plan
        self._samples, self._place = samples, place

    @property
    def tiles(self) -> List[Tile]:
        """All tiles, each behind those that it needs."""
        return _named(tiles_of(c.lib.tks_mosaic_tiles, self._plan, len(self._plan)))

    @property
    def groups(self) -> List[List[Tile]]:
        """The tiles of each group. Those of one need only tiles of the group before."""
        tiles = self.tiles
        return [[t for t in tiles if t.group == g] for g in range(tiles[-1].group + 1)]

    def needs(self, tile: Tile) -> List[Tile]:
        """The tiles whose parts the task of a tile reads."""
        given = self._plan, len(self._plan), m.MosaicTile(*tile)
        return _named(tiles_of(c.lib.tks_mosaic_needs, *given))

    def is_done(self, tile: Tile) -> bool:
        """Whether the parts of a tile are in the folder, whole and of this plan."""
        done, files = ctypes.c_int(), WorkFolder(self._folder, Guard())
        given = self._plan, len(self._plan), m.MosaicTile(*tile)
        status = c.lib.tks_mosaic_is_done(*given, files.struct, done)
        if status != Status.OK:
            raise error(status, "There is no such tile.")
        return bool(done.value)

    def code(self, tile: Tile, threads: int = 1) -> None:
        """Runs the task of a tile. It takes about 20 bytes for each sample of the tile. Raises what the source raises; :class:`TksIOError` if parts that it needs
        are missing."""
        guard = Guard()
        source = source_struct(self._samples, self._place, guard)
        files = WorkFolder(self._folder, guard)
        count = values.unsigned(threads, "threads")
        given = self._plan, len(self._plan), m.MosaicTile(*tile), source, files.struct, count
        run_guarded(guard, c.lib.tks_mosaic_code, *given)

    def merge(
        self, out: PathLike, *, layout: str = "mixed", preview: Optional[int] = None
    ) -> None:
        """Joins the parts of all tiles into a file, which appears when it is whole.

        layout: "progressive" makes the best prefixes, and has no index; "windows" lays the stream
            out region by region, with an index, for windows over a network; "mixed" does the first
            in `preview` bytes (a tenth of all), and the second behind them.
        """
        options = m.MergeOptions(
            size=ctypes.sizeof(m.MergeOptions),
            layout=values.choice(layout, m.LAYOUTS, "layout"),
            preview=values.unsigned(preview, "preview", 63),
        )
        guard = Guard()
        files = WorkFolder(self._folder, guard)
        with appearing(Path(out)) as file:

            def write(_user: Any, offset: int, data: int, size: int) -> int:
                def at() -> None:
                    file.seek(offset)
                    file.write((ctypes.c_char * size).from_address(data))

                return guard.run(at)

            given = self._plan, len(self._plan), files.struct, options, m.WRITE_AT(write), None
            run_guarded(guard, c.lib.tks_mosaic_merge, *given)

    def name_of(self, tile: Tile) -> str:
        """That of its parts, without their endings."""
        return f"g{tile.group}-x{tile.column}-y{tile.row}"

    def for_others(self) -> "Mosaic":
        """For other processes, which see the folder."""
        source = self._samples.source.for_others(self._folder)
        samples = Samples(source, self._place["nodata"])
        return Mosaic(self._folder.absolute(), self._plan, samples, self._place)


def _named(tiles: List[m.MosaicTile]) -> List[Tile]:
    return [Tile(tile.group, tile.column, tile.row) for tile in tiles]


def source_struct(
    samples: Samples, place: Dict[str, Any], guard: Guard, progress: Optional[Progress] = None
) -> m.MosaicSource:
    whole, done = samples.shape[0] * samples.shape[1], [0]

    def read(_user: Any, window: Any, out: int) -> int:
        def into() -> None:
            at = window[0]
            part = samples.window(at.x, at.y, at.width, at.height)
            ctypes.memmove(out, part.ctypes.data, part.nbytes)
            done[0] += part.size
            if progress is not None:
                progress(min(1.0, done[0] / whole))

        return guard.run(into)

    heights = described_heights(samples.shape, samples.dtype, samples.nodata, place)
    return m.MosaicSource(
        ctypes.sizeof(m.MosaicSource), ctypes.pointer(heights), m.READ_WINDOW(read)
    )


def run_guarded(guard: Guard, call: Any, *arguments: Any) -> None:
    message = ctypes.create_string_buffer(1024)
    status = call(*arguments, message, len(message))
    guard.raise_noted()
    if status != Status.OK:
        raise error(status, message.value.decode("utf-8", "replace"))
