# SPDX-License-Identifier: Apache-2.0
"""The address that control messages of a receiver go to (docs/CONTROL.md), by Python's own
client."""

from __future__ import annotations

import http.client
import urllib.error
import urllib.parse
import urllib.request
from typing import Optional

from . import _values as values
from ._errors import TksIOError, TksUsageError

# No server sends more at a time: 2^20 bytes, unless it was told more.
_MOST_ANSWER = 1 << 26
# Statuses below 500 of servers that are busy, and of a message that does not fit to theirs.
_PASSING = (408, 409, 425, 429)
_MOST_TEXT = 200


class ControlFailure(TksIOError):
    """may_pass: another message may be answered; renews: one of another receiver."""

    def __init__(self, sentence: str, may_pass: bool = True, renews: bool = False) -> None:
        super().__init__(sentence)
        self.may_pass, self.renews = may_pass, renews


class ControlUrl:
    """timeout: so many seconds without a byte are too long."""

    def __init__(self, url: str, timeout: float) -> None:
        if not isinstance(url, str) or urllib.parse.urlsplit(url).scheme not in ("http", "https"):
            raise TksUsageError(f"{values.told(url)} is no address that `tetrakis serve` prints.")
        self._url, self._timeout = url, timeout

    def post(self, message: bytes, after: Optional[int]) -> bytes:
        """The answer to a message. after: the server waits, 2 s at most, until it has a frame of
        this number."""
        separator = "&" if "?" in self._url else "?"
        waits = "" if after is None else f"{separator}after={after}"
        headers = {"Content-Type": "application/octet-stream"}
        request = urllib.request.Request(self._url + waits, message, headers)
        name = values.told(self._url)
        try:
            with urllib.request.urlopen(request, timeout=self._timeout) as answer:
                body: bytes = answer.read(_MOST_ANSWER + 1)
        except urllib.error.HTTPError as refused:
            with refused:
                raise self._refused(refused) from None
        except (OSError, http.client.HTTPException) as failed:
            reason = getattr(failed, "reason", failed)
            raise ControlFailure(f"No answer comes from {name}: {reason}.") from failed
        if len(body) > _MOST_ANSWER:
            raise ControlFailure(f"{name} answers with more than 64 MB.", may_pass=False)
        return body

    def _refused(self, answer: urllib.error.HTTPError) -> ControlFailure:
        text = ""
        if (answer.headers.get("Content-Type") or "").startswith("text/plain"):
            text = ": " + answer.read(_MOST_TEXT).decode("utf-8", "replace").strip()
        sentence = f"{values.told(self._url)} answers {answer.code} {answer.reason}{text}"
        may_pass = answer.code >= 500 or answer.code in _PASSING
        return ControlFailure(sentence.rstrip(".") + ".", may_pass, answer.code == 409)
