// SPDX-License-Identifier: Apache-2.0
// localErrors() computes for every vertex the error of its own sample, by which meshes without
// global error are chosen (thesis 2.5.2: errors at the knots alone).
#pragma once

#include <vector>

#include "codec/mesh/surface/surface_view.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline study {

/// For every vertex, the squared error of its own sample, times its weight, in a mesh that has the
/// vertex's parents and not the vertex; 0 for hidden ones. The surface has the lattice's size.
std::vector<double> localErrors(const Lattice& lattice, const SurfaceView& surface);

}  // namespace tetrakis::inline study
