# SPDX-License-Identifier: Apache-2.0
"""The C interface of mosaics by ctypes: names and order of fields are those of
include/tetrakis/mosaic.h."""

from __future__ import annotations

import ctypes
from ctypes import (
    CFUNCTYPE,
    POINTER,
    c_char_p,
    c_double,
    c_int,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)

from ._library import Buffer, Heights, Window, declare, lib

READ_WINDOW = CFUNCTYPE(c_int, c_void_p, POINTER(Window), c_void_p)
READ_FILE = CFUNCTYPE(
    c_int, c_void_p, c_char_p, c_uint64, c_uint64, c_void_p, POINTER(c_uint64)
)
FILE_SIZE = CFUNCTYPE(c_int, c_void_p, c_char_p, POINTER(c_uint64))
WRITE_FILE = CFUNCTYPE(c_int, c_void_p, c_char_p, c_void_p, c_size_t)
WRITE_AT = CFUNCTYPE(c_int, c_void_p, c_uint64, c_void_p, c_size_t)


class MosaicSource(ctypes.Structure):
    """tks_mosaic_source."""

    _fields_ = [
        ("size", c_size_t),
        ("heights", POINTER(Heights)),
        ("read", READ_WINDOW),
        ("user", c_void_p),
    ]


class MosaicOptions(ctypes.Structure):
    """tks_mosaic_options."""

    _fields_ = [
        ("size", c_size_t),
        ("bytes", c_uint64),
        ("psnr", c_double),
        ("max_error", c_double),
        ("lossless", c_int),
        ("regions", c_uint32),
        ("tile", c_uint32),
    ]


class MosaicTile(ctypes.Structure):
    """tks_tile."""

    _fields_ = [("group", c_uint32), ("column", c_uint32), ("row", c_uint32)]


class MosaicFiles(ctypes.Structure):
    """tks_mosaic_files."""

    _fields_ = [
        ("size", c_size_t),
        ("read", READ_FILE),
        ("length", FILE_SIZE),
        ("write", WRITE_FILE),
        ("user", c_void_p),
    ]


class MergeOptions(ctypes.Structure):
    """tks_merge_options."""

    _fields_ = [("size", c_size_t), ("layout", c_int), ("preview", c_uint64)]


LAYOUTS = ("progressive", "windows", "mixed")

STRUCTS = {
    "tks_mosaic_source": MosaicSource,
    "tks_mosaic_options": MosaicOptions,
    "tks_tile": MosaicTile,
    "tks_mosaic_files": MosaicFiles,
    "tks_merge_options": MergeOptions,
}

_PLAN = [c_char_p, c_size_t]
_TILES = [POINTER(MosaicTile), c_size_t, POINTER(c_size_t)]
_MESSAGE = [c_char_p, c_size_t]

PROTOTYPES = {
    "tks_mosaic_plan": (
        c_int,
        [POINTER(MosaicSource), POINTER(MosaicOptions), POINTER(Buffer), *_MESSAGE],
    ),
    "tks_mosaic_tiles": (c_int, [*_PLAN, *_TILES]),
    "tks_mosaic_needs": (c_int, [*_PLAN, MosaicTile, *_TILES]),
    "tks_mosaic_code": (
        c_int,
        [
            *_PLAN,
            MosaicTile,
            POINTER(MosaicSource),
            POINTER(MosaicFiles),
            c_uint32,
            *_MESSAGE,
        ],
    ),
    "tks_mosaic_is_done": (
        c_int,
        [*_PLAN, MosaicTile, POINTER(MosaicFiles), POINTER(c_int)],
    ),
    "tks_mosaic_merge": (
        c_int,
        [*_PLAN, POINTER(MosaicFiles), POINTER(MergeOptions), WRITE_AT, c_void_p, *_MESSAGE],
    ),
}

declare(lib, PROTOTYPES)
