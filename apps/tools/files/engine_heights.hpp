// SPDX-License-Identifier: Apache-2.0
// The functions here write heights as game engines import them: a square of 16-bit samples, little
// endian, of the sizes that their landscapes have, and the scales to type in.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/ground_axes.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

enum class Engine { kUnreal, kUnity };

/// A square of this side in samples.
struct EngineSize {
  Engine engine = Engine::kUnreal;
  uint32_t side = 0;
};

/// "unreal", "unity", or with a side "unreal:2017". Without one the engine's least side that is no
/// shorter than `longest`, else its longest. TKS_USAGE for other engines, and sides that the engine
/// does not have: Unreal's landscapes of whole components, Unity's 2^n + 1.
Result<EngineSize> parseEngineSize(const std::string& text, uint32_t longest);

/// TKS_USAGE if the engine does not import a file of this name: both read .r16 and .raw, Unreal
/// .png.
Status checkEngineFormat(const EngineSize& size, const std::string& path);

/// Heights in metres, row by row; NaN where void.
struct EngineGround {
  std::span<const float> heights;
  uint32_t width = 0, height = 0;
  double spacing_x = 0, spacing_y = 0;  ///< metres
  double metres_per_unit = 1;           ///< of the heights
  GroundAxes axes{};
  /// How far the ground goes on behind the last samples of a coarse level, in samples, 0 to 1.
  double beyond_x = 0, beyond_y = 0;
};

struct EngineHeights {
  EngineSize size;
  std::vector<uint16_t> samples;   ///< 0 the lowest height, 65535 the highest
  double lowest = 0, highest = 0;  ///< metres
  double width = 0, length = 0;    ///< metres from corner to corner
  size_t voids = 0;                ///< samples of the ground without a height: the lowest
  bool askew = false;              ///< rows run neither north and south nor east and west
};

/// The ground from corner to corner by cubic interpolation (Keys 1981), within its range; it is
/// level beyond the last samples. Engines
/// know no geotransform: the first row becomes the northern one, and its first sample the western
/// one, or those that are nearest to that where the ground lies askew. TKS_USAGE if all is void.
Result<EngineHeights> engineHeights(const EngineGround& ground, const EngineSize& size);

/// .png, or 16-bit samples alone. Writes to `path` directly.
Status writeEngineHeights(const std::string& path, const EngineHeights& heights);

}  // namespace tetrakis::tools
