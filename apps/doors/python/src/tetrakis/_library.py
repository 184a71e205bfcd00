# SPDX-License-Identifier: Apache-2.0
"""The C interface by ctypes: structs, prototypes and the shared library.

Names and order of fields are those of include/tetrakis/tetrakis.h; tests/test_header.py has a C
compiler say where each field lies and compares. ctypes releases the GIL during every call.
"""

from __future__ import annotations

import ctypes
from ctypes import (
    CFUNCTYPE,
    POINTER,
    c_char_p,
    c_double,
    c_float,
    c_int,
    c_int32,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)
from pathlib import Path

PROGRESS = CFUNCTYPE(c_int, c_void_p, c_double)
LOCATOR = CFUNCTYPE(
    c_int, c_void_p, c_double, c_double, POINTER(c_double), POINTER(c_double)
)
PICTURE_ERROR = CFUNCTYPE(
    c_int, c_void_p, c_void_p, c_void_p, POINTER(c_double), POINTER(c_double)
)
EXPLAIN = CFUNCTYPE(None, c_void_p, c_void_p)
GEOTRANSFORM = c_double * 6

REGISTRATIONS = (None, "area", "point")
WEIGHTS = ("psnr", "visual")
INDEXES = (False, True, "windows", "pages")
GIVEN_INDEXES = INDEXES[:3]  # pages are those of mosaics
OBJECT_KINDS = ("auto", "resampled", "triangles")
NO_SKETCH = 2**64 - 1
DOMAINS = ("plane", "cylinder", "forest")
GIVEN_DOMAINS = ("plane", "cylinder", "cube")  # a cube is a forest

CUBE_PATCHES, MOST_CUBE_DEPTH = 6, 14

PART_HEIGHTS, PART_VALIDITY, PART_TEXTURE = 0, 1, 2
MESH_CODED, MESH_BUDGET = 0, 1


class Forest(ctypes.Structure):
    """tks_forest."""

    _fields_ = [("depth", c_uint32), ("patches", c_uint32), ("sides", POINTER(c_uint32))]


class BaseMesh(ctypes.Structure):
    """tks_base_mesh."""

    _fields_ = [
        ("position_bits", c_uint32),
        ("cell", c_double),
        ("origin", c_double * 3),
        ("corners", POINTER(c_int32)),
    ]


class Heights(ctypes.Structure):
    """tks_heights."""

    _fields_ = [
        ("size", c_size_t),
        ("width", c_uint32),
        ("height", c_uint32),
        ("sample", c_int),
        ("data", c_void_p),
        ("scale", c_double),
        ("offset", c_double),
        ("step", c_double),
        ("spacing_x", c_double),
        ("spacing_y", c_double),
        ("unit", c_char_p),
        ("vertical_datum", c_char_p),
        ("crs", c_char_p),
        ("has_nodata", c_int),
        ("nodata", c_double),
        ("geotransform", GEOTRANSFORM),
        ("has_geotransform", c_int),
        ("registration", c_int),
        ("description", c_char_p),
        ("geo_keys", c_char_p),
        ("positions", c_void_p),
        ("positions_size", c_size_t),
        ("domain", c_int),
        ("first_latitude", c_double),
        ("last_latitude", c_double),
        ("forest", Forest),
        ("grid_width", c_uint32),
        ("grid_height", c_uint32),
        ("base_mesh", BaseMesh),
    ]


class Image(ctypes.Structure):
    """tks_image."""

    _fields_ = [
        ("size", c_size_t),
        ("width", c_uint32),
        ("height", c_uint32),
        ("channels", c_uint32),
        ("sample", c_int),
        ("data", c_void_p),
        ("geotransform", GEOTRANSFORM),
        ("has_geotransform", c_int),
        ("registration", c_int),
        ("crs", c_char_p),
        ("geo_keys", c_char_p),
        ("opaque", c_int),
        ("white_level", c_uint32),
        ("positions", c_void_p),
        ("positions_size", c_size_t),
        ("domain", c_int),
        ("forest", Forest),
    ]


class Camera(ctypes.Structure):
    """tks_camera."""

    _fields_ = [
        ("name", c_char_p),
        ("eye", c_double * 3),
        ("target", c_double * 3),
        ("up", c_double * 3),
        ("fov_y", c_double),
        ("width", c_uint32),
        ("height", c_uint32),
        ("weight", c_double),
    ]


class WeighedPlan(ctypes.Structure):
    """tks_weighed_plan."""

    _fields_ = [
        ("size", c_size_t),
        ("is_texture", c_int),
        ("verdict", c_int),
        ("base", c_int),
        ("residual", c_int),
        ("step", c_double),
        ("table_values", c_uint32),
        ("fractions", c_int),
        ("filters", c_char_p),
        ("predictor", c_char_p),
        ("layers", c_char_p),
        ("cut", c_double),
        ("within", c_double),
        ("expected_bytes", c_double),
        ("coded", c_int),
        ("coded_bytes", c_uint64),
        ("needed_bytes", c_uint64),
        ("header_bytes", c_uint64),
        ("rmse", c_double),
    ]


class EncodeOptions(ctypes.Structure):
    """tks_encode_options."""

    _fields_ = [
        ("size", c_size_t),
        ("bytes", c_uint64),
        ("psnr", c_double),
        ("max_error", c_double),
        ("lossless", c_int),
        ("triangles", c_uint32),
        ("threads", c_uint32),
        ("regions", c_uint32),
        ("index", c_int),
        ("weights", c_int),
        ("progress", PROGRESS),
        ("user", c_void_p),
        ("cameras", POINTER(Camera)),
        ("camera_count", c_uint32),
        ("picture_error", PICTURE_ERROR),
        ("picture_user", c_void_p),
        ("explain", EXPLAIN),
        ("explain_user", c_void_p),
    ]


class Buffer(ctypes.Structure):
    """tks_buffer."""

    _fields_ = [("data", c_void_p), ("size", c_size_t)]


class Ground(ctypes.Structure):
    """tks_ground."""

    _fields_ = [
        ("size", c_size_t),
        ("width", c_uint32),
        ("height", c_uint32),
        ("locate", LOCATOR),
        ("user", c_void_p),
        ("tolerance", c_double),
    ]


class TriangleMesh(ctypes.Structure):
    """tks_triangle_mesh."""

    _fields_ = [
        ("size", c_size_t),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("positions", c_void_p),
        ("triangles", c_void_p),
        ("unit", c_char_p),
        ("description", c_char_p),
        ("texcoords", c_void_p),
        ("kind", c_int),
        ("sketch_bytes", c_uint64),
        ("material", c_char_p),
        ("texels", c_uint32),
        ("maps", c_void_p),
        ("map_count", c_uint32),
    ]


class ObjectMap(ctypes.Structure):
    """tks_object_map."""

    _fields_ = [
        ("size", c_size_t),
        ("name", c_char_p),
        ("image", c_void_p),
        ("weight", c_double),
    ]


class ObjectTrial(ctypes.Structure):
    """tks_object_trial."""

    _fields_ = [
        ("bytes", c_uint64),
        ("psnr", c_double),
        ("screen_psnr", c_double),
    ]


class ObjectReport(ctypes.Structure):
    """tks_object_report."""

    _fields_ = [
        ("size", c_size_t),
        ("triangles", c_uint32),
        ("dropped_triangles", c_uint32),
        ("cut_edges", c_uint32),
        ("components", c_uint32),
        ("borders", c_uint32),
        ("patches", c_uint32),
        ("depth", c_uint32),
        ("diagonal", c_double),
        ("resampling_error", c_double),
        ("error", c_double),
        ("largest", c_double),
        ("psnr", c_double),
        ("texture_depth", c_uint32),
        ("kind", c_int),
        ("coded_triangles", c_uint32),
        ("as_resampled", ObjectTrial),
        ("as_triangles", ObjectTrial),
        ("sketch_bytes", c_uint64),
    ]


class Outliers(ctypes.Structure):
    """tks_outliers."""

    _fields_ = [
        ("size", c_size_t),
        ("count", c_uint64),
        ("value", c_double),
        ("is_fill", c_int),
    ]


class Limits(ctypes.Structure):
    """tks_limits."""

    _fields_ = [
        ("size", c_size_t),
        ("max_samples", c_uint64),
        ("max_texels", c_uint64),
        ("max_memory", c_uint64),
    ]


class Range(ctypes.Structure):
    """tks_range."""

    _fields_ = [("offset", c_uint64), ("size", c_uint64), ("gain", c_double)]


class StreamInfo(ctypes.Structure):
    """tks_info."""

    _fields_ = [
        ("size", c_size_t),
        ("format_version", c_uint32),
        ("profile", c_uint32),
        ("level", c_uint32),
        ("header_bytes", c_uint64),
        ("stream_bytes", c_uint64),
        ("available_bytes", c_uint64),
        ("packets", c_uint64),
        ("geometry_bytes", c_uint64),
        ("texture_bytes", c_uint64),
        ("has_heights", c_int),
        ("has_texture", c_int),
        ("width", c_uint32),
        ("height", c_uint32),
        ("coarsest_level", c_uint32),
        ("sample", c_int),
        ("scale", c_double),
        ("offset", c_double),
        ("step", c_double),
        ("base", c_double),
        ("spacing_x", c_double),
        ("spacing_y", c_double),
        ("exact_steps", c_int),
        ("lossless", c_int),
        ("has_voids", c_int),
        ("has_nodata", c_int),
        ("nodata", c_double),
        ("max_error", c_double),
        ("triangles", c_uint32),
        ("regions", c_uint32),
        ("texture_regions", c_uint32),
        ("texture_width", c_uint32),
        ("texture_height", c_uint32),
        ("texture_channels", c_uint32),
        ("texture_coarsest_level", c_uint32),
        ("texture_cutout", c_int),
        ("texture_drawn", c_int),
        ("texture_sample", c_int),
        ("heights_rmse", c_double),
        ("texture_psnr", c_double),
        ("unit", c_char_p),
        ("vertical_datum", c_char_p),
        ("crs", c_char_p),
        ("heights_drawn", c_int),
        ("has_geotransform", c_int),
        ("geotransform", GEOTRANSFORM),
        ("registration", c_int),
        ("description", c_char_p),
        ("geo_keys", c_char_p),
        ("texture_has_geotransform", c_int),
        ("texture_geotransform", GEOTRANSFORM),
        ("texture_registration", c_int),
        ("texture_crs", c_char_p),
        ("texture_geo_keys", c_char_p),
        ("index", c_int),
        ("texture_opaque", c_int),
        ("voids_known", c_int),
        ("texture_white_level", c_uint32),
        ("positions", c_void_p),
        ("positions_size", c_size_t),
        ("texture_positions", c_void_p),
        ("texture_positions_size", c_size_t),
        ("domain", c_int),
        ("texture_domain", c_int),
        ("forest", Forest),
        ("texture_forest", Forest),
        ("grid_width", c_uint32),
        ("grid_height", c_uint32),
        ("base_mesh", BaseMesh),
        ("object_triangles", c_uint32),
        ("frames", c_uint32),
        ("frame", c_uint32),
        ("components", c_uint32),
        ("shows_sketch", c_int),
        ("least_bytes", c_uint64),
        ("material", c_char_p),
        ("index_bytes", c_uint64),
    ]


class Window(ctypes.Structure):
    """tks_window."""

    _fields_ = [("x", c_uint32), ("y", c_uint32), ("width", c_uint32), ("height", c_uint32)]


class GeographicGrid(ctypes.Structure):
    """tks_geographic_grid."""

    _fields_ = [
        ("size", c_size_t),
        ("width", c_uint32),
        ("height", c_uint32),
        ("geotransform", GEOTRANSFORM),
    ]


class Ranges(ctypes.Structure):
    """tks_ranges."""

    _fields_ = [("count", c_size_t), ("ranges", POINTER(Range))]


class Mesh(ctypes.Structure):
    """tks_mesh."""

    _fields_ = [
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("grid_index", POINTER(c_uint32)),
        ("height", POINTER(c_float)),
        ("triangles", POINTER(c_uint32)),
    ]


class Globe(ctypes.Structure):
    """tks_globe."""

    _fields_ = [
        ("size", c_size_t),
        ("semi_major", c_double),
        ("semi_minor", c_double),
        ("degrees", c_double),
        ("exaggeration", c_double),
    ]


class GlobeMesh(ctypes.Structure):
    """tks_globe_mesh."""

    _fields_ = [
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("position", POINTER(c_double)),
        ("pixel", POINTER(c_double)),
        ("height", POINTER(c_float)),
        ("triangles", POINTER(c_uint32)),
    ]


class ObjectMesh(ctypes.Structure):
    """tks_object_mesh."""

    _fields_ = [
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("position", POINTER(c_double)),
        ("pixel", POINTER(c_double)),
        ("texcoord", POINTER(c_double)),
        ("height", POINTER(c_float)),
        ("triangles", POINTER(c_uint32)),
    ]


class Pixel(ctypes.Structure):
    """tks_pixel."""

    _fields_ = [("part", c_int), ("column", c_double), ("row", c_double)]


class ScreenCamera(ctypes.Structure):
    """tks_screen_camera."""

    _fields_ = [
        ("size", c_size_t),
        ("width", c_uint32),
        ("height", c_uint32),
        ("clip", c_double * 16),
        ("weight", c_double),
        ("globe", POINTER(Globe)),
    ]


class Fetch(ctypes.Structure):
    """tks_fetch."""

    _fields_ = [
        ("size", c_size_t),
        ("bytes", c_uint64),
        ("triangles", c_uint32),
        ("request_bytes", c_uint64),
    ]


class Screen(ctypes.Structure):
    """tks_screen."""

    _fields_ = [
        ("size", c_size_t),
        ("cameras", POINTER(ScreenCamera)),
        ("camera_count", c_uint32),
        ("texture", POINTER(Image)),
    ]


STRUCTS = {
    "tks_forest": Forest,
    "tks_base_mesh": BaseMesh,
    "tks_heights": Heights,
    "tks_image": Image,
    "tks_camera": Camera,
    "tks_weighed_plan": WeighedPlan,
    "tks_encode_options": EncodeOptions,
    "tks_buffer": Buffer,
    "tks_ground": Ground,
    "tks_object_map": ObjectMap,
    "tks_triangle_mesh": TriangleMesh,
    "tks_object_trial": ObjectTrial,
    "tks_object_report": ObjectReport,
    "tks_outliers": Outliers,
    "tks_limits": Limits,
    "tks_range": Range,
    "tks_info": StreamInfo,
    "tks_window": Window,
    "tks_geographic_grid": GeographicGrid,
    "tks_pixel": Pixel,
    "tks_ranges": Ranges,
    "tks_mesh": Mesh,
    "tks_globe": Globe,
    "tks_globe_mesh": GlobeMesh,
    "tks_object_mesh": ObjectMesh,
    "tks_screen_camera": ScreenCamera,
    "tks_screen": Screen,
    "tks_fetch": Fetch,
}

# Handles (tks_decoder*, tks_mesh_tree*) and arrays are addresses: c_void_p.
PROTOTYPES = {
    "tks_free_buffer": (None, [POINTER(Buffer)]),
    "tks_encode": (
        c_int,
        [
            POINTER(Heights),
            POINTER(Image),
            POINTER(EncodeOptions),
            POINTER(Buffer),
            c_char_p,
            c_size_t,
        ],
    ),
    "tks_encode_object": (
        c_int,
        [
            POINTER(TriangleMesh),
            POINTER(Image),
            POINTER(EncodeOptions),
            POINTER(ObjectReport),
            POINTER(Buffer),
            c_char_p,
            c_size_t,
        ],
    ),
    "tks_find_outliers": (c_int, [POINTER(Heights), POINTER(Outliers)]),
    "tks_open": (
        c_int,
        [c_char_p, c_size_t, POINTER(Limits), POINTER(c_void_p), c_char_p, c_size_t],
    ),
    "tks_close": (None, [c_void_p]),
    "tks_header_bytes": (c_int, [c_char_p, c_size_t, POINTER(c_uint64)]),
    "tks_put_ranges": (c_int, [c_void_p, POINTER(Range), POINTER(c_char_p), c_size_t]),
    "tks_needed_ranges": (c_int, [c_void_p, c_int, POINTER(Window), POINTER(Ranges)]),
    "tks_free_ranges": (None, [POINTER(Ranges)]),
    "tks_message": (c_char_p, [c_void_p]),
    "tks_get_info": (c_int, [c_void_p, POINTER(StreamInfo)]),
    "tks_locate": (c_int, [c_void_p, POINTER(Pixel), POINTER(c_double), POINTER(c_double)]),
    "tks_fit_positions": (c_int, [POINTER(Ground), POINTER(Buffer)]),
    "tks_set_levels": (c_int, [c_void_p, c_uint32, c_uint32]),
    "tks_set_frame": (c_int, [c_void_p, c_uint32]),
    "tks_set_threads": (c_int, [c_void_p, c_uint32]),
    "tks_decode_heights": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tks_decode_surface": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tks_decode_validity": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tks_decode_texture": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tks_decode_heights_window": (c_int, [c_void_p, POINTER(Window), c_void_p, c_size_t]),
    "tks_decode_validity_window": (c_int, [c_void_p, POINTER(Window), c_void_p, c_size_t]),
    "tks_decode_surface_window": (c_int, [c_void_p, POINTER(Window), c_void_p, c_size_t]),
    "tks_decode_texture_window": (c_int, [c_void_p, POINTER(Window), c_void_p, c_size_t]),
    "tks_check_memory": (
        c_int,
        [c_void_p, c_int, POINTER(Window), c_uint32, c_uint64, POINTER(c_uint64)],
    ),
    "tks_verify": (c_int, [c_void_p]),
    "tks_decode_mesh": (c_int, [c_void_p, c_int, c_uint32, POINTER(Mesh)]),
    "tks_free_mesh": (None, [POINTER(Mesh)]),
    "tks_decode_screen_mesh": (c_int, [c_void_p, POINTER(Screen), c_uint32, POINTER(Mesh)]),
    "tks_decode_globe": (
        c_int,
        [c_void_p, c_int, c_uint32, POINTER(Globe), POINTER(GlobeMesh)],
    ),
    "tks_free_globe_mesh": (None, [POINTER(GlobeMesh)]),
    "tks_decode_object": (c_int, [c_void_p, c_int, c_uint32, POINTER(ObjectMesh)]),
    "tks_free_object_mesh": (None, [POINTER(ObjectMesh)]),
    "tks_cube_sides": (POINTER(c_uint32), []),
    "tks_cube_depth": (c_uint32, [c_uint32]),
    "tks_cube_from_grid": (
        c_int,
        [
            POINTER(GeographicGrid),
            c_void_p,
            c_uint32,
            c_uint32,
            c_void_p,
            POINTER(c_double),
            POINTER(c_double),
            c_char_p,
            c_size_t,
        ],
    ),
    "tks_grid_from_cube": (
        c_int,
        [
            c_void_p,
            c_uint32,
            POINTER(GeographicGrid),
            POINTER(Window),
            c_uint32,
            c_void_p,
            c_char_p,
            c_size_t,
        ],
    ),
    "tks_cube_windows": (
        c_int,
        [
            c_uint32,
            POINTER(GeographicGrid),
            POINTER(Window),
            POINTER(Window),
            c_char_p,
            c_size_t,
        ],
    ),
    "tks_decode_grid": (
        c_int,
        [c_void_p, POINTER(GeographicGrid), POINTER(Window), c_void_p, c_size_t],
    ),
    "tks_decode_mesh_tree": (c_int, [c_void_p, c_int, c_uint32, POINTER(c_void_p)]),
    "tks_view_mesh": (c_int, [c_void_p, POINTER(c_double), POINTER(Mesh)]),
    "tks_free_mesh_tree": (None, [c_void_p]),
}


def declare(library: ctypes.CDLL, prototypes: dict) -> None:
    """Says what the functions of the library take and return."""
    for name, (result, arguments) in prototypes.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments


def _load() -> ctypes.CDLL:
    """The library inside the wheel; packages of a distribution have the system's instead."""
    inside = Path(__file__).with_name("libtetrakis.so")
    library = ctypes.CDLL(str(inside) if inside.exists() else "libtetrakis.so.0")
    declare(library, PROTOTYPES)
    return library


lib = _load()
