// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/engine_output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/tools/report/scene.hpp"

namespace tetrakis::tools {
namespace {

/// Unreal counts in centimetres; a landscape of scale 100 has a quad a metre, and 128 steps of
/// height a metre, step 32768 at the actor's own height.
struct UnrealScales {
  double x, y, z, location_z;
};

UnrealScales unrealScales(const EngineHeights& heights) {
  const double quads = heights.size.side - 1.0, range = heights.highest - heights.lowest;
  constexpr double kPercent = 100, kStepsPerMetre = 128, kMiddle = 32768, kLast = 65535;
  return {heights.width / quads * kPercent, heights.length / quads * kPercent,
          std::max(range / kLast * kStepsPerMetre * kPercent, 1e-6),
          (heights.lowest + range * kMiddle / kLast) * kPercent};
}

bool isUnreal(const EngineHeights& heights) {
  return heights.size.engine == Engine::kUnreal;
}

}  // namespace

Result<EngineHeights> decodeEngineHeights(Decoder& decoder, const EngineSize& size,
                                          uint64_t copies) {
  const tks_info& info = decoder.info();
  if (!info.has_heights) return Status(TKS_USAGE, "the stream has no heights");
  const uint32_t width = info.width, height = info.height, longest = std::max(width, height);
  uint32_t level = 0;
  while (level < info.coarsest_level && (longest - 1) >> (level + 1) >= size.side - 1) ++level;
  if (const Status set = decoder.setLevels(level, 0); !set.ok()) return set;
  const PlacedFrame frame = frameOf(info);
  const uint64_t bytes = uint64_t{info.width} * info.height * sizeof(float) +
                         uint64_t{size.side} * size.side * 2 * sizeof(uint16_t);
  const auto fits = decoder.checkMemory(TKS_PART_HEIGHTS, nullptr, 0, bytes + copies);
  if (!fits) return fits.status();
  const Result<std::vector<float>> surface = decoder.surface();
  if (!surface) return surface.status();
  if (const Status set = decoder.setLevels(0, 0); !set.ok()) return set;
  const auto beyond = [level](uint32_t whole, uint32_t coarse) {
    return std::ldexp(whole - 1.0, -static_cast<int>(level)) - (coarse - 1.0);
  };
  return engineHeights(
      {*surface, frame.width, frame.height, frame.spacing_x, frame.spacing_y, frame.metres_per_unit,
       frame.axes, beyond(width, frame.width), beyond(height, frame.height)},
      size);
}

Json engineJson(const EngineHeights& heights) {
  Json json{{"engine", isUnreal(heights) ? "unreal" : "unity"},
            {"side", heights.size.side},
            {"lowest", heights.lowest},
            {"highest", heights.highest},
            {"width", heights.width},
            {"length", heights.length},
            {"voids", heights.voids}};
  if (isUnreal(heights)) {
    const UnrealScales scales = unrealScales(heights);
    json["scale_x"] = scales.x;
    json["scale_y"] = scales.y;
    json["scale_z"] = scales.z;
    json["location_z"] = scales.location_z;
  } else {
    json["terrain_height"] = heights.highest - heights.lowest;
    json["position_y"] = heights.lowest;
  }
  return json;
}

std::string engineText(const EngineHeights& heights) {
  char text[400];
  const uint32_t side = heights.size.side;
  if (isUnreal(heights)) {
    const UnrealScales scales = unrealScales(heights);
    std::snprintf(text, sizeof text,
                  "%u x %u for Unreal: landscape scale X %.6g, Y %.6g, Z %.6g; location Z %.6g",
                  side, side, scales.x, scales.y, scales.z, scales.location_z);
  } else {
    std::snprintf(text, sizeof text,
                  "%u x %u for Unity: depth 16 bit, byte order Windows, flip vertically; terrain "
                  "width %.6g, length %.6g, height %.6g; position Y %.6g",
                  side, side, heights.width, heights.length, heights.highest - heights.lowest,
                  heights.lowest);
  }
  return text;
}

}  // namespace tetrakis::tools
