# SPDX-License-Identifier: Apache-2.0
"""Files that are written whole or not at all, such as those that the tasks of a mosaic exchange:
under another name and renamed, or behind what they had."""

from __future__ import annotations

import ctypes
import os
import secrets
import shutil
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Callable, Iterator, List, Optional

from . import _mosaic_library as m


@contextmanager
def appearing(path: Path) -> Iterator[Any]:
    """A file that is open for writing, and gets its name at the end. A failure leaves none."""
    staged = path.with_name(f"{path.name}.{os.getpid()}-{secrets.token_hex(4)}.tmp")
    try:
        with open(staged, "xb") as file:
            yield file
        os.replace(staged, path)
    except BaseException:
        if staged.exists():
            staged.unlink()
        raise


@contextmanager
def extending(path: Path, begin: int) -> Iterator[Any]:
    """A file that is open for writing from a place on. A failure leaves what it had."""
    with open(path, "r+b") as file:
        file.seek(begin)
        rest = file.read()
        file.seek(begin)
        file.truncate()
        try:
            yield file
            file.flush()
        except BaseException:
            file.seek(begin)
            file.truncate()
            file.write(rest)
            raise


@contextmanager
def folder_for(workdir: Any, out: Path) -> Iterator[Path]:
    """`workdir`, which stays; without one a folder beside `out`, which goes in every case."""
    if workdir is not None:
        folder = Path(workdir)
        folder.mkdir(parents=True, exist_ok=True)
        yield folder
        return
    folder = Path(tempfile.mkdtemp(prefix=f".{out.name}-", dir=out.absolute().parent))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


class Guard:
    """Exceptions cannot cross C: a callback notes the first one, and answers that it failed."""

    def __init__(self) -> None:
        self.raised: Optional[BaseException] = None

    def run(self, call: Callable[[], Any]) -> int:
        try:
            call()
            return 0
        except BaseException as exception:
            self.raised = self.raised or exception
            return 1

    def raise_noted(self) -> None:
        if self.raised is not None:
            try:
                raise self.raised
            finally:
                self.raised = None  # whose traceback holds this object


class WorkFolder:
    """tks_mosaic_files over a folder, for one call of C at a time."""

    def __init__(self, folder: Path, guard: Guard) -> None:
        self._folder, self._guard = folder, guard
        self.struct = m.MosaicFiles(
            ctypes.sizeof(m.MosaicFiles),
            m.READ_FILE(self._read),
            m.FILE_SIZE(self._length),
            m.WRITE_FILE(self._write),
        )

    # What is missing or cannot be read is for the library to tell, which knows what it means.

    def _read(self, _user: Any, name: bytes, offset: int, count: int, out: int, read: Any) -> int:
        try:
            with open(self._folder / name.decode(), "rb", buffering=0) as file:
                file.seek(offset)
                room = memoryview((ctypes.c_char * count).from_address(out)).cast("B")
                read[0] = _fill(file, room)
            return 0
        except OSError:
            return 1

    def _length(self, _user: Any, name: bytes, size: Any) -> int:
        try:
            size[0] = os.stat(self._folder / name.decode()).st_size
            return 0
        except OSError:
            return 1

    def _write(self, _user: Any, name: bytes, data: int, size: int) -> int:
        def write() -> None:
            with appearing(self._folder / name.decode()) as file:
                file.write((ctypes.c_char * size).from_address(data))

        return self._guard.run(write)


def _fill(file: Any, room: memoryview) -> int:
    """Files without a buffer may give less than they are asked for."""
    done = 0
    while done < len(room):
        count = file.readinto(room[done:])
        if not count:
            break
        done += count
    return done


def tiles_of(call: Callable[..., int], *arguments: Any) -> List[m.MosaicTile]:
    """What a function lists that takes room and a count."""
    from ._errors import error

    count = ctypes.c_size_t()
    status = call(*arguments, None, 0, count)
    if status != 0:
        raise error(status, "The plan is none of this version, or has no such tile.")
    tiles = (m.MosaicTile * count.value)()
    call(*arguments, tiles, count, count)
    return list(tiles)
