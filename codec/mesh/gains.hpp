// SPDX-License-Identifier: Apache-2.0
// What each lattice vertex is worth: the diamond form of the global error (thesis 5.3).
//
// Inserting v splits the one or two triangles of its diamond. g(v) = sum of E over them - sum of E
// over their halves is fixed and local, whatever else is in the mesh. So for every closed set S the
// squared error of its mesh is D = sum of g(v) over the vertices v that are not in S (full
// resolution has D = 0).
#pragma once

#include <vector>

#include "base/status.hpp"
#include "codec/mesh/lattice.hpp"
#include "codec/mesh/surface_view.hpp"

namespace tetrakis {

/// TKS_USAGE for weights that are not one for each sample, or negative or not finite.
Status checkWeights(const SurfaceView& surface);

/// g of every vertex, in squared height steps; may be negative. Rounded to multiples of one power
/// of two, chosen (2^-30 of the largest weight where that is fine enough) so that every sum of
/// gains is exact in any order: orders of vertices built from them depend on no rounding. The
/// surface has the lattice's size, and weights that pass.
std::vector<double> vertexGains(const Lattice& lattice, const SurfaceView& surface);

}  // namespace tetrakis
