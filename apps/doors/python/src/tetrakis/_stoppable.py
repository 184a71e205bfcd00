# SPDX-License-Identifier: Apache-2.0
"""Long calls of the C interface that Ctrl-C ends.

Python runs the handlers of signals in its main thread, between two steps of Python: not while that
thread is in C. And what a handler raises inside a callback of C is lost. So where the main thread
asks for a long call, another thread makes it. The main thread waits, which a signal interrupts, and
calls what reports progress, so that this never runs inside C.
"""

from __future__ import annotations

import queue
import threading
from typing import Any, Callable, List, Optional, TypeVar

from . import _library as c

T = TypeVar("T")
Progress = Callable[[float], Any]

# After an interrupt: a call that has not ended by then goes on alone until it next reports.
_GRACE_SECONDS = 0.5


def run(call: Callable[[Any], T], progress: Optional[Progress], short: bool) -> T:
    """`call` with a C callback. Exceptions of `progress` stop it and come out of here."""
    main = threading.current_thread() is threading.main_thread()
    if not main or (short and progress is None):
        return _run_here(call, progress)
    return _Elsewhere(call, progress).result()


def _run_here(call: Callable[[Any], T], progress: Optional[Progress]) -> T:
    if progress is None:
        return call(c.PROGRESS())
    report, raised = progress, []  # type: Progress, List[BaseException]

    def told(_user: Any, done: float) -> int:
        if raised:
            return 1
        try:
            report(done)
            return 0
        except BaseException as exception:  # it cannot cross C
            raised.append(exception)
            return 1

    try:
        return call(c.PROGRESS(told))
    except Exception:
        if raised:
            raise raised[0] from None
        raise


class _Elsewhere:
    """A call in a thread of its own, which tells the thread that waits how far it is."""

    def __init__(self, call: Callable[[Any], Any], progress: Optional[Progress]) -> None:
        self._call = call
        self._progress = progress
        self._told: "queue.SimpleQueue[Optional[float]]" = queue.SimpleQueue()  # None: it has ended
        self._answers: "queue.SimpleQueue[bool]" = queue.SimpleQueue()
        self._one_asks = threading.Lock()
        self._ended = threading.Event()
        self._stopped = False
        self._value: Any = None
        self._raised: Optional[BaseException] = None

    def result(self) -> Any:
        try:
            # A program that ends does not wait for what it has interrupted.
            threading.Thread(target=self._work, name="tetrakis", daemon=True).start()
            self._wait()
        except BaseException:
            self._stopped = True
            self._answers.put(True)  # for one that waits, if any
            self._ended.wait(_GRACE_SECONDS)
            raise
        if self._raised is not None:
            try:
                raise self._raised
            finally:
                self._raised = None  # whose traceback holds this object
        return self._value

    def _wait(self) -> None:
        while True:
            done = self._told.get()
            if done is None:
                return
            if self._progress is not None:
                self._progress(done)
            self._answers.put(False)

    def _work(self) -> None:
        try:
            self._value = self._call(c.PROGRESS(self._report))
        except BaseException as exception:
            self._raised = exception
        finally:
            self._ended.set()
            self._told.put(None)

    def _report(self, _user: Any, done: float) -> int:
        """What C calls."""
        with self._one_asks:
            if self._progress is None or self._stopped:
                return int(self._stopped)
            self._told.put(done)
            return int(self._answers.get())
