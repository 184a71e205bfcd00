# SPDX-License-Identifier: Apache-2.0
"""The C interface of receivers by ctypes: names and order of fields are those of
include/tetrakis/transmit.h."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, c_char_p, c_int, c_int64, c_size_t, c_uint32, c_uint64, c_void_p

from ._library import Limits, ScreenCamera, declare, lib
from ._sequence_library import Clock

MOST_CONTROL_BYTES = 100
NEWEST_FRAME = 2**64 - 1
MOST_RATE = 2**28 - 1  # of links, in bytes a second, and of meshes, in triangles


class Wants(ctypes.Structure):
    """tks_wants."""

    _fields_ = [
        ("size", c_size_t),
        ("frame", c_uint64),
        ("link", c_uint32),
        ("triangles", c_uint32),
        ("view", POINTER(ScreenCamera)),
    ]


class ReceiverInfo(ctypes.Structure):
    """tks_receiver_info."""

    _fields_ = [
        ("size", c_size_t),
        ("first_frame", c_uint64),
        ("end_frame", c_uint64),
        ("source_end_frame", c_uint64),
        ("answers", c_uint64),
        ("last_pieces", c_uint64),
        ("bytes", c_uint64),
        ("clock", Clock),
    ]


STRUCTS = {"tks_wants": Wants, "tks_receiver_info": ReceiverInfo}

# Those that the package calls. Handles are addresses.
PROTOTYPES = {
    "tks_receiver_open": (c_int, [c_uint64, POINTER(Limits), POINTER(c_void_p)]),
    "tks_receiver_close": (None, [c_void_p]),
    "tks_receiver_message": (c_char_p, [c_void_p]),
    "tks_receiver_control": (c_int, [c_void_p, POINTER(Wants), c_char_p, POINTER(c_size_t)]),
    "tks_receiver_take": (c_int, [c_void_p, c_char_p, c_size_t]),
    "tks_receiver_get_info": (c_int, [c_void_p, POINTER(ReceiverInfo)]),
    "tks_receiver_find": (c_int, [c_void_p, c_uint64, POINTER(c_uint64), POINTER(c_int64)]),
    "tks_receiver_frame": (c_int, [c_void_p, c_uint64, POINTER(c_void_p)]),
    "tks_receiver_forget": (c_int, [c_void_p, c_uint64]),
}

declare(lib, PROTOTYPES)
