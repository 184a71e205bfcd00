# SPDX-License-Identifier: Apache-2.0
"""Ranges of a file on a web server (RFC 9110, section 14), by Python's own client."""

from __future__ import annotations

import threading
import urllib.error
import urllib.request
from typing import Any, Optional

from . import _values as values
from ._source import Ranged

_SECONDS = 60


class Http(Ranged):
    """An http or https address. A server that knows no ranges is asked once, for everything. What
    changes between two requests raises OSError: parts of two files make no stream."""

    def __init__(self, url: str) -> None:
        self._url = url
        self._whole: Optional[bytes] = None
        self._state: Optional[str] = None
        self._size: Optional[int] = None  # once a range has come
        self._one_notes = threading.Lock()

    def read(self, offset: int, count: int) -> bytes:
        if self._whole is None and count > 0:
            headers = {
                "Range": f"bytes={offset}-{offset + count - 1}",
                "Accept-Encoding": "identity",  # ranges of compressed bytes are of no use
            }
            request = urllib.request.Request(self._url, headers=headers)
            try:
                with urllib.request.urlopen(request, timeout=_SECONDS) as answer:
                    self._note(answer.headers)
                    body: bytes = answer.read()
                    if answer.status == 206:
                        return body
                    self._whole = body
            except urllib.error.HTTPError as error:
                if error.code == 416:  # the file ends before
                    return b""
                raise
        return (self._whole or b"")[offset : offset + count]

    def size(self) -> Optional[int]:
        return len(self._whole) if self._whole is not None else self._size

    def _note(self, headers: Any) -> None:
        total = str(headers.get("Content-Range", "")).rpartition("/")[2]
        self._size = int(total) if total.isdigit() else None
        state = headers.get("ETag") or headers.get("Last-Modified")
        with self._one_notes:
            if self._state is not None and state != self._state:
                raise OSError(f"{values.told(self._url)} has changed while it was read: open anew.")
            self._state = state

    def __reduce__(self) -> Any:
        return Http, (self._url,)
