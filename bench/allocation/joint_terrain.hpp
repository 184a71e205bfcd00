// SPDX-License-Identifier: Apache-2.0
// Textured terrains of bench_joint, and streams of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/tools/report/comparison.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {

struct Terrain {
  std::string name;
  tools::Reference original;
};

/// Folders below `folders` that hold heights and a texture under the names that `tetrakis synth`
/// gives. filters: texts of which a path holds one; none: all.
std::vector<std::filesystem::path> terrainsBelow(const std::vector<std::string>& folders,
                                                 const std::vector<std::string>& filters);

/// spacing: in metres, instead of what the file says; 0: that.
Result<Terrain> readTerrain(const std::filesystem::path& folder, double spacing);

/// What the encoder knows of the judge.
enum class Knows { kNothing, kCameras, kPictures };

struct StreamRequest {
  uint64_t bytes = 0;
  Knows knows = Knows::kNothing;
  uint32_t triangles = 0;
  std::string view = "all";  ///< the cameras that it knows
};

struct EncodedTerrain {
  Buffer stream;
  size_t drawn = 0;  ///< pairs that the encoder had drawn
};

/// One track of heights, and one of texture.
Result<EncodedTerrain> encodeTerrain(const tools::Reference& original,
                                     const StreamRequest& request);

}  // namespace tetrakis::bench
