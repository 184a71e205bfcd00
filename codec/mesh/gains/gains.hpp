// SPDX-License-Identifier: Apache-2.0
// vertexGains() computes from a surface the worth of each lattice vertex, by the diamond form of
// the global error (thesis 5.3).
//
// Inserting v splits the one or two triangles of its diamond. g(v) = sum of E over them - sum of E
// over their halves is fixed and local, whatever else is in the mesh. So for every closed set S the
// squared error of its mesh is D = sum of g(v) over the vertices v that are not in S (full
// resolution has D = 0).
#pragma once

#include <vector>

#include "base/status.hpp"
#include "codec/mesh/surface/surface_view.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline gains {

/// TKS_USAGE for weights that are not one for each sample, or negative or not finite.
Status checkWeights(const SurfaceView& surface);

/// Returns g of every vertex, in squared height steps. A gain may be negative. Gains are rounded to
/// multiples of one power of two (2^-30 of the largest weight where that is fine enough), chosen so
/// that every sum of gains is exact in any order; so no order of vertices that is built from them
/// depends on rounding. The surface must have the size of the lattice and pass checkWeights().
std::vector<double> vertexGains(const Lattice& lattice, const SurfaceView& surface);

}  // namespace tetrakis::inline gains
