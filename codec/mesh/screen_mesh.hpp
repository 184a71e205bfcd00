// SPDX-License-Identifier: Apache-2.0
// screenMesh() makes a mesh of few triangles for a surface with weights
// (screen/screen_weights.hpp), whose edges turn to follow ridges and valleys.
#pragma once

#include <cstdint>
#include <functional>

#include "base/status.hpp"
#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/surface/weighted_surface.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline mesh {

/// A mesh of at most max_triangles > 0 triangles whose vertices are those of a 4-8 mesh, chosen
/// among all samples by their weighted error and fitted, and whose edges are then turned
/// (turned_edges.hpp). Where samples are unknown it is that of verticesBesideVoids(), and triangles
/// in voids are part of it. admits: as there. Fails with the errors of FittedSequence::makeFor().
Result<FittedMesh> screenMesh(const Lattice& lattice, const WeightedSurface& surface,
                              uint32_t max_triangles,
                              const std::function<Status(uint64_t)>& admits);

}  // namespace tetrakis::inline mesh
