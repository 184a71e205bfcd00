# SPDX-License-Identifier: Apache-2.0
"""Who runs the tasks of a mosaic: threads of this process, or a cluster of Dask. Tasks exchange
files, so that an engine only has to begin each behind those that it needs."""

from __future__ import annotations

import heapq
import secrets
from concurrent import futures
from typing import Any, Callable, Dict, List

from ._errors import TksUsageError

# Of a task that fails, as where the storage of a source does not answer for a moment.
_RETRIES = 3

Told = Callable[[int], None]  # is told how many tasks are done


class _Waiting:
    """Tasks in the order in which they may begin. Coarse groups come first: their parts are what
    the largest number of others, in the end the base, waits for."""

    def __init__(self, mosaic: Any, tiles: List[Any]) -> None:
        self._order = {tile: (-tile.group, number) for number, tile in enumerate(tiles)}
        self._needs: Dict[Any, int] = {}
        self._needed_by: Dict[Any, List[Any]] = {tile: [] for tile in tiles}
        for tile in tiles:
            needs = [need for need in mosaic.needs(tile) if need in self._order]
            self._needs[tile] = len(needs)
            for need in needs:
                self._needed_by[need].append(tile)
        self._ready = [(self._order[tile], tile) for tile in tiles if self._needs[tile] == 0]
        heapq.heapify(self._ready)

    def next(self) -> Any:
        """None: all that may begin has begun."""
        return heapq.heappop(self._ready)[1] if self._ready else None

    def done(self, tile: Any) -> None:
        for other in self._needed_by[tile]:
            self._needs[other] -= 1
            if self._needs[other] == 0:
                heapq.heappush(self._ready, (self._order[other], other))


def run_by_threads(mosaic: Any, tiles: List[Any], workers: int, told: Told) -> None:
    """The library releases the GIL, so that threads work side by side."""
    waiting, done = _Waiting(mosaic, tiles), 0
    running: Dict[Any, Any] = {}
    with futures.ThreadPoolExecutor(workers, "tetrakis") as pool:
        while True:
            while len(running) < workers:
                tile = waiting.next()
                if tile is None:
                    break
                running[pool.submit(mosaic.code, tile)] = tile
            if not running:
                return
            for ended in futures.wait(running, return_when=futures.FIRST_COMPLETED).done:
                ended.result()
                waiting.done(running.pop(ended))
                done += 1
                told(done)


def run_by_dask(mosaic: Any, tiles: List[Any], client: Any, told: Told) -> None:
    """One task a tile, behind those that it needs. `client`: of dask.distributed."""
    if not hasattr(client, "submit") or getattr(client, "asynchronous", False):
        raise TksUsageError("client is one of dask.distributed that is not asynchronous.")
    from distributed import as_completed

    run = f"tetrakis-{secrets.token_hex(8)}"
    # Mosaic and source travel once, by a task, so that it can be run again for another worker.
    shared = client.submit(_itself, mosaic, key=run, pure=False)
    submitted: Dict[Any, Any] = {}
    for tile in tiles:
        needs = [submitted[need] for need in mosaic.needs(tile) if need in submitted]
        submitted[tile] = client.submit(
            _code,
            shared,
            tile,
            *needs,
            key=f"{run}-{mosaic.name_of(tile)}",
            retries=_RETRIES,
            priority=tile.group,
            pure=False,
        )
    try:
        ended = as_completed(submitted.values(), with_results=True)  # raises what a task raises
        for done, _ in enumerate(ended, 1):
            told(done)
    finally:
        client.cancel([shared, *submitted.values()], force=True)


def _itself(mosaic: Any) -> Any:
    return mosaic


def _code(mosaic: Any, tile: Any, *_needs: None) -> None:
    """On a worker. Another one may have coded the tile before it was lost."""
    if not mosaic.is_done(tile):
        mosaic.code(tile)
