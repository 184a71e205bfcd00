// SPDX-License-Identifier: Apache-2.0
// What bench_joint measures of a terrain. Each study prints a table and appends rows.
#pragma once

#include <string>
#include <vector>

#include "bench/allocation/joint_terrain.hpp"
#include "bench/harness/results.hpp"

namespace tetrakis::bench {

struct SplitOptions {
  uint32_t grid = 8;         ///< splits rendered for each number of bytes, beside nine tenths
  bool rendered = false;     ///< also the order of the rendered engine
  std::string view = "all";  ///< preset cameras that are told, and judge
};

/// How far orders of the encoder and fixed splits are from the best pair of prefixes, and what the
/// order gains that is told the cameras.
Status studySplits(const Terrain& terrain, const SplitOptions& options,
                   std::vector<ResultRow>& rows);

/// Prefixes beside JPEG 2000 and AVIF, and meshes of meshoptimizer and Draco and AVIF, both shared
/// by an oracle; and beside heights without loss that leave the rest to the texture. speed:
/// avifenc's.
Status studyPeers(const Terrain& terrain, uint32_t speed, std::vector<ResultRow>& rows);

/// The same with few triangles, at 16 and 64 kB.
Status studyTriangles(const Terrain& terrain, uint32_t speed, std::vector<ResultRow>& rows);

/// Prefixes of 30 lengths beside streams made for these lengths.
Status studyPrefixes(const Terrain& terrain, std::vector<ResultRow>& rows);

/// Figures 6.4 to 6.10 of the thesis, as a page, pictures and numbers in a folder. grid: rates of
/// heights and of textures.
Status drawFigures(const Terrain& terrain, uint32_t grid, const std::string& folder,
                   std::vector<ResultRow>& rows);

}  // namespace tetrakis::bench
