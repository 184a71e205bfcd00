// SPDX-License-Identifier: Apache-2.0
// Objects whose triangles are coded as they are: all that a stream tells of them stands in its
// header. Triangles are decoded when they are asked for, since they take more memory than bytes.
#pragma once

#include "api/decoder.hpp"

namespace tetrakis::inline api {

/// The stream has a triangle mesh. As tks_decode_object.
Status decodeTriangleObject(const tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles,
                            tks_object_mesh& out);

/// TKS_CORRUPT where they break a rule, TKS_LIMIT where that takes too much memory to see.
Status checkTriangles(const tks_decoder& decoder);

}  // namespace tetrakis::inline api
