# SPDX-License-Identifier: Apache-2.0
"""The C interface of components by ctypes: names and order of fields are those of
include/tetrakis/components.h."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_uint32, c_uint64, c_void_p

from ._library import Buffer, Limits, declare, lib

COMPONENT_KINDS = ("heights", "texture", "unknown")


class Component(ctypes.Structure):
    """tks_component."""

    _fields_ = [
        ("size", c_size_t),
        ("kind", c_int),
        ("name", c_char_p),
        ("is_taken", c_int),
        ("width", c_uint32),
        ("height", c_uint32),
        ("domain", c_int),
        ("available_bytes", c_uint64),
    ]


class Combined(ctypes.Structure):
    """tks_combined."""

    _fields_ = [
        ("size", c_size_t),
        ("data", c_char_p),
        ("data_size", c_size_t),
        ("name", c_char_p),
        ("weight", c_double),
    ]


class CombineOptions(ctypes.Structure):
    """tks_combine_options."""

    _fields_ = [
        ("size", c_size_t),
        ("bytes", c_uint64),
        ("limits", POINTER(Limits)),
    ]


STRUCTS = {
    "tks_component": Component,
    "tks_combined": Combined,
    "tks_combine_options": CombineOptions,
}

PROTOTYPES = {
    "tks_get_component": (c_int, [c_void_p, c_uint32, POINTER(Component)]),
    "tks_choose_component": (c_int, [c_void_p, c_uint32]),
    "tks_combine": (
        c_int,
        [
            POINTER(Combined),
            c_uint32,
            POINTER(CombineOptions),
            POINTER(Buffer),
            c_char_p,
            c_size_t,
        ],
    ),
}

declare(lib, PROTOTYPES)
