# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, and what a progress callable raises or answers, in the main thread and in others."""

import subprocess
import sys
import threading

import pytest
from conftest import terrain

import tetrakis

# Codes for many seconds, in steps of which one takes most of that.
LONG = """
import os, signal, sys, threading, time
import numpy as np, tetrakis

signal.signal(signal.SIGINT, signal.default_int_handler)  # which background jobs ignore
random = np.random.default_rng(1)
heights = random.standard_normal((2000, 2000)).cumsum(0).cumsum(1).astype("f4")
small = np.arange(90000.0, dtype="f4").reshape(300, 300)
before = tetrakis.encode(small, bytes=3000)
sent = []

def interrupt():
    sent.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)

def seconds(**options):
    try:
        tetrakis.encode(heights, max_error=0.5, **options)
    except KeyboardInterrupt:
        return time.monotonic() - sent[-1]
"""


def run(script):
    command = [sys.executable, "-c", LONG + script]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("progress", ["None", "lambda done: None"])
def test_ctrl_c_ends_an_encode_soon(progress):
    done = run(
        f"threading.Timer(0.7, interrupt).start()\n"
        f"print(seconds(progress={progress}))\n"
        f"assert tetrakis.encode(small, bytes=3000) == before\n"
    )
    assert done.returncode == 0 and not done.stderr, done.stderr
    assert float(done.stdout) < 2


def test_ctrl_c_ends_a_sequence_soon():
    done = run(
        "threading.Timer(1.5, interrupt).start()\n"
        "try:\n"
        "    tetrakis.encode_sequence([heights + t for t in range(4)], max_error=0.5, group=4)\n"
        "except KeyboardInterrupt:\n"
        "    print(time.monotonic() - sent[-1])\n"
        "assert tetrakis.encode(small, bytes=3000) == before\n"
    )
    assert done.returncode == 0 and not done.stderr, done.stderr
    assert float(done.stdout) < 2


def test_ctrl_c_in_a_progress_callable_ends_an_encode():
    done = run(
        "def progress(done):\n"
        "    if done == 0: interrupt()\n"
        "print(seconds(progress=progress))\n"
        "assert threading.active_count() == 1\n"
    )
    assert done.returncode == 0 and not done.stderr, done.stderr
    assert float(done.stdout) < 2


def test_ctrl_c_ends_the_program():
    """It does not wait for the encoder, nor crash."""
    done = run("threading.Timer(0.7, interrupt).start()\ntetrakis.encode(heights, max_error=0.5)\n")
    assert done.returncode == -2, done.stderr
    assert done.stderr.rstrip().endswith("KeyboardInterrupt") and "ignored" not in done.stderr


def outcomes(heights):
    """Of one thread: what its callables see, and what comes back."""
    found = {}

    def progress(done):
        found.setdefault("threads", set()).add(threading.current_thread())
        found.setdefault("seen", []).append(done)

    def raises(_done):
        raise KeyError("ours")

    found["stream"] = tetrakis.encode(heights, bytes=2000, threads=2, progress=progress)
    found["same"] = tetrakis.encode(heights, bytes=2000) == found["stream"]
    found["answered"] = tetrakis.encode(heights, bytes=2000, progress=lambda done: True)
    try:
        tetrakis.encode(heights, bytes=2000, progress=raises)
    except KeyError as exception:
        found["raised"] = exception
    try:
        tetrakis.encode(heights, bytes=3)
    except tetrakis.TksError as exception:
        found["refused"] = exception
    return found


def in_a_thread(call):
    results = []
    thread = threading.Thread(target=lambda: results.append(call()))
    thread.start()
    thread.join()
    return results[0], thread


@pytest.mark.parametrize("elsewhere", [False, True])
@pytest.mark.parametrize("side", [20, 200])
def test_progress_is_called_where_encode_was(elsewhere, side):
    call = lambda: outcomes(terrain(side, side))  # noqa: E731
    found, thread = in_a_thread(call) if elsewhere else (call(), threading.current_thread())
    assert found["threads"] == {thread} and found["same"]
    assert found["seen"][0] == 0 and found["seen"] == sorted(found["seen"])
    assert found["answered"] == found["stream"]  # the update() of tqdm returns True, for one
    assert found["raised"].args == ("ours",)
    assert isinstance(found["refused"], tetrakis.TksUsageError)


def test_many_threads_encode_side_by_side():
    arrays = [terrain(150, 140 + i) for i in range(4)]
    alone = [tetrakis.encode(array, bytes=4000) for array in arrays]
    together = [None] * 4

    def work(i):
        together[i] = tetrakis.encode(arrays[i], bytes=4000, progress=lambda done: None)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone
