// SPDX-License-Identifier: Apache-2.0
// Reference decoder: meshes of triangles that are coded as they are (docs/FORMAT.md, section 11,
// "Triangles").
#pragma once

#include "conformance/reference_decoder.hpp"
#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

/// FORMAT 2, Triangle mesh.
TriangleMeshHeader readTriangleMesh(Reader& in);

Triangles readTriangles(const TriangleMeshHeader& header);

}  // namespace tetrakis::reference
