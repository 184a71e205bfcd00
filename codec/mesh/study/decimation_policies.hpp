// SPDX-License-Identifier: Apache-2.0
// decimate() orders the vertices of a surface by any of the policies that the thesis compares
// (2.5.2, 5.4.2, 5.5.2), with costs of any kind. The library itself decimates in one way
// (codec/mesh/decimation/decimation.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "codec/mesh/decimation/decimation.hpp"

namespace tetrakis::inline study {

/// How the next vertex is chosen.
enum class MeshPolicy {
  kNearHull,              ///< that of the library; with costs the same as kGeneralDecimation
  kGeneralDecimation,     ///< whole merging domains, global error (general_decimation.hpp)
  kRestrictedDecimation,  ///< single vertices, global error (leaf_order.hpp; thesis 5.4.2)
  kLocalDecimation,       ///< single vertices, error at the vertex alone (thesis 2.5.2, 5.5.2)
  kLocalRefinement,       ///< insertion from the roots, likewise (thesis 2.5.2, 5.5.2)
};

struct DecimationOptions {
  MeshPolicy policy = MeshPolicy::kNearHull;
  /// One for each lattice vertex, in any unit (vertex_costs.hpp); empty: triangles.
  std::span<const uint32_t> costs;
};

/// Orders all vertices of a surface by a policy. Fails with the errors of decimate(surface), with
/// TKS_USAGE for costs that are not one for each vertex, and with TKS_LIMIT for costs that add up
/// to 2^32 or more.
Result<MeshSequence> decimate(const SurfaceView& surface, const DecimationOptions& options);

}  // namespace tetrakis::inline study
