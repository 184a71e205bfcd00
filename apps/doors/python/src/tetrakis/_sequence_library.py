# SPDX-License-Identifier: Apache-2.0
"""The C interface of sequences by ctypes: names and order of fields are those of
include/tetrakis/sequence.h."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, c_char_p, c_int, c_int64, c_size_t, c_uint32, c_uint64, c_void_p

from ._library import Buffer, EncodeOptions, Heights, Image, Limits, Range, declare, lib

MOST_FRAMES = 32  # of one stream
ALL_BYTES = 2**64 - 1  # TKS_ALL_BYTES


class Clock(ctypes.Structure):
    """tks_clock."""

    _fields_ = [
        ("size", c_size_t),
        ("numerator", c_uint64),
        ("denominator", c_uint64),
        ("epoch", c_char_p),
        ("calendar", c_char_p),
    ]


class SequenceOptions(ctypes.Structure):
    """tks_sequence_options."""

    _fields_ = [
        ("size", c_size_t),
        ("group", c_uint32),
        ("encode", POINTER(EncodeOptions)),
        ("clock", Clock),
        ("no_index", c_int),
        ("reference", c_uint64),
        ("entry", c_uint32),
    ]


class SequenceInfo(ctypes.Structure):
    """tks_sequence_info."""

    _fields_ = [
        ("size", c_size_t),
        ("first_frame", c_uint64),
        ("end_frame", c_uint64),
        ("groups", c_uint64),
        ("bytes", c_uint64),
        ("whole_bytes", c_uint64),
        ("clock", Clock),
    ]


class Group(ctypes.Structure):
    """tks_group."""

    _fields_ = [
        ("size", c_size_t),
        ("first_frame", c_uint64),
        ("frames", c_uint64),
        ("offset", c_uint64),
        ("bytes", c_uint64),
        ("stream_offset", c_uint64),
        ("stream_bytes", c_uint64),
        ("available_bytes", c_uint64),
        ("depth", c_uint32),
        ("bytes_back", c_uint64),
    ]


STRUCTS = {
    "tks_clock": Clock,
    "tks_sequence_options": SequenceOptions,
    "tks_sequence_info": SequenceInfo,
    "tks_group": Group,
}

# Those that the package calls. Handles are addresses.
PROTOTYPES = {
    "tks_sequence_encoder_open": (
        c_int,
        [POINTER(SequenceOptions), POINTER(c_void_p), c_char_p, c_size_t],
    ),
    "tks_sequence_encoder_close": (None, [c_void_p]),
    "tks_sequence_push": (
        c_int,
        [c_void_p, POINTER(Heights), POINTER(Image), c_int64, c_char_p, c_size_t],
    ),
    "tks_sequence_flush": (c_int, [c_void_p, c_char_p, c_size_t]),
    "tks_sequence_take": (c_int, [c_void_p, POINTER(Buffer)]),
    "tks_sequence_open": (c_int, [POINTER(Limits), POINTER(c_void_p)]),
    "tks_sequence_close": (None, [c_void_p]),
    "tks_sequence_message": (c_char_p, [c_void_p]),
    "tks_sequence_append": (c_int, [c_void_p, c_char_p, c_size_t]),
    "tks_sequence_get_info": (c_int, [c_void_p, POINTER(SequenceInfo)]),
    "tks_sequence_time": (c_int, [c_void_p, c_uint64, POINTER(c_int64)]),
    "tks_sequence_group": (c_int, [c_void_p, c_uint64, POINTER(Group)]),
    "tks_sequence_frame": (c_int, [c_void_p, c_uint64, POINTER(c_void_p)]),
    "tks_sequence_thin": (c_int, [c_void_p, c_uint64, POINTER(Buffer), c_char_p, c_size_t]),
    "tks_sequence_encoder_continue": (c_int, [c_void_p, c_void_p, c_char_p, c_size_t]),
    "tks_sequence_locate": (
        c_int,
        [c_char_p, c_size_t, c_uint64, c_int, c_int64, POINTER(Range), POINTER(c_int)],
    ),
}

declare(lib, PROTOTYPES)
