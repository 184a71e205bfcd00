// SPDX-License-Identifier: Apache-2.0
// Simplifiers of height fields beside Tetrakis, and Draco for their meshes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/meshes/decimation_mesh.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

struct PeerMesh {
  std::string peer;     ///< "martini", "delatin" or "meshoptimizer"
  uint32_t budget = 0;  ///< triangles that were asked for
  PlanMesh mesh;
};

/// Martini (RTIN) and Delatin (Delaunay) by `node`; node_folder holds their npm packages. The
/// raster is a square of side 2^d + 1. TKS_IO if node fails.
Result<std::vector<PeerMesh>> nodeMeshes(const Raster& raster, const std::string& node_folder,
                                         const std::vector<uint32_t>& budgets);

/// Every sample a vertex, its height (in columns) that of the raster times `exaggeration`.
class Simplifier {
 public:
  Simplifier(const Raster& raster, double exaggeration);
  /// meshopt_simplify without a bound on the error.
  PlanMesh run(uint32_t budget) const;

 private:
  const Raster& raster_;
  std::vector<std::array<float, 3>> positions_;
  std::vector<uint32_t> triangles_;
};

/// One encoding of a mesh.
struct CodedMesh {
  uint64_t bytes = 0;
  double rmse = 0;  ///< of the decoded mesh, in the raster's unit
  PlanMesh mesh;    ///< as decoders give it back
};

/// Draco at its slowest level: float positions of 8 to 14 bits with heights stretched to the
/// horizontal extent, and integer positions with heights of 7 to 14 bits over their range.
Result<std::vector<CodedMesh>> dracoCodings(const PlanMesh& mesh, const Raster& raster);

}  // namespace tetrakis::bench
