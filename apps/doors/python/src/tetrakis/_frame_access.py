# SPDX-License-Identifier: Apache-2.0
"""One frame of a stream of several: what :class:`Access` gives, with that frame set.

Decoders are shared with the other frames of the stream, and keep all of them once one was decoded.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Iterator, List, Optional, Tuple

from ._access import Access, Need
from ._decoder import Decoder
from ._errors import TksUsageError
from ._info import Info


class FrameAccess:
    def __init__(self, access: Access, frame: int) -> None:
        self._of_all: Optional[Access] = access
        self._frame = frame

    def close(self) -> None:
        """The other frames stay open."""
        self._of_all = None

    @property
    def closed(self) -> bool:
        return self._of_all is None

    def info(self) -> Info:
        with self.glance(None) as decoder:
            return decoder.info()

    @contextmanager
    def glance(self, count: Optional[int]) -> Iterator[Decoder]:
        with self._access.glance(count) as decoder:
            yield self._shown(decoder)

    @contextmanager
    def whole(self) -> Iterator[Decoder]:
        with self._access.whole() as decoder:
            yield self._shown(decoder)

    @contextmanager
    def prefix(self, count: Optional[int]) -> Iterator[Decoder]:
        with self._access.prefix(count) as decoder:
            yield self._shown(decoder)

    @contextmanager
    def part(self, levels: Tuple[int, int], needs: List[Need]) -> Iterator[Decoder]:
        with self._access.part(levels, needs) as decoder:
            yield self._shown(decoder)

    @property
    def _access(self) -> Access:
        if self._of_all is None:
            raise TksUsageError("The stream is closed.")
        return self._of_all

    def _shown(self, decoder: Decoder) -> Any:
        decoder.set_frame(self._frame)
        return decoder
