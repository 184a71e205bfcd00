// SPDX-License-Identifier: Apache-2.0
// withoutNeedless() takes the vertices on water out of a mesh, where they take triangles and lower
// no error. Decimation puts them last, so they are in a mesh if its budget is more than the ground
// around the water can use.
#pragma once

#include <vector>

#include "codec/mesh/surface/surface_view.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline mesh {

/// A closed set without the vertices around which all samples have one height, as far as they and
/// their descendants reach: a closed set again.
std::vector<VertexId> withoutNeedless(const Lattice& lattice, const SurfaceView& surface,
                                      std::vector<VertexId> vertices);

}  // namespace tetrakis::inline mesh
