// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/study/decimation_policies.hpp"

#include <cstdint>
#include <numeric>
#include <utility>

#include "codec/mesh/decimation/general_decimation.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/leaf_order.hpp"
#include "codec/mesh/study/local_errors.hpp"

namespace tetrakis::inline study {
namespace {

Status check(const Lattice& lattice, const SurfaceView& surface, std::span<const uint32_t> costs) {
  if (Status status = checkWeights(surface); !status.ok()) return status;
  if (!costs.empty() && costs.size() != lattice.vertexCount())
    return {TKS_USAGE, "A mesh needs one cost for each lattice vertex, or none at all."};
  if (std::accumulate(costs.begin(), costs.end(), uint64_t{0}) > UINT32_MAX)
    return {TKS_LIMIT,
            "The costs of all vertices add up to more than 2^32 - 1; use a larger unit."};
  return {};
}

std::vector<VertexId> orderOf(const Lattice& lattice, const SurfaceView& surface,
                              const std::vector<double>& gains, const DecimationOptions& options) {
  const VertexCosts costs(lattice, options.costs);
  switch (options.policy) {
    case MeshPolicy::kNearHull:
    case MeshPolicy::kGeneralDecimation:
      break;
    case MeshPolicy::kRestrictedDecimation:
      return restrictedDecimation(gains, costs);
    case MeshPolicy::kLocalDecimation:
      return restrictedDecimation(localErrors(lattice, surface), costs);
    case MeshPolicy::kLocalRefinement:
      return refinement(localErrors(lattice, surface), costs);
  }
  return generalDecimation(gains, costs);
}

}  // namespace

Result<MeshSequence> decimate(const SurfaceView& surface, const DecimationOptions& options) {
  if (options.policy == MeshPolicy::kNearHull && options.costs.empty()) return decimate(surface);
  Result<Lattice> lattice = Lattice::make(surface.width, surface.height);
  if (!lattice.ok()) return lattice.status();
  if (const Status status = check(*lattice, surface, options.costs); !status.ok()) return status;
  const std::vector<double> gains = vertexGains(*lattice, surface);
  std::vector<VertexId> order = orderOf(*lattice, surface, gains, options);
  return MeshSequence(std::move(*lattice), std::move(order), gains);
}

}  // namespace tetrakis::inline study
