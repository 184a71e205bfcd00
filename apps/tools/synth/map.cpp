// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/map.hpp"

#include <algorithm>
#include <array>

namespace tetrakis::tools::synth {
namespace {

using Rgb = std::array<uint8_t, 3>;

constexpr Rgb kSea{151, 193, 222}, kInland{120, 175, 214}, kContour{178, 137, 96},
    kIndexContour{139, 94, 60}, kHouse{92, 88, 86};
constexpr std::array<Rgb, 7> kBelts = {{{172, 208, 165},
                                        {189, 204, 150},
                                        {225, 228, 181},
                                        {239, 235, 192},
                                        {222, 214, 163},
                                        {202, 185, 130},
                                        {245, 244, 242}}};

constexpr double kInterval = 50;    // metres between contour lines
constexpr int kIndexEvery = 5;      // lines from one heavy one to the next
constexpr double kLowestBelt = 60;  // metres; each belt reaches twice as high as the one below
constexpr uint32_t kTexelsPerSample = 2;

Rgb beltOf(double height) {
  size_t belt = 0;
  for (double top = kLowestBelt; height >= top && belt + 1 < kBelts.size(); top *= 2) ++belt;
  return kBelts[belt];
}

class Cartographer {
 public:
  explicit Cartographer(const Relief& relief) : relief_(relief) {}

  /// `river`: metres to the nearest bank, negative in the water.
  Rgb colourAt(uint32_t x, uint32_t y, double river) const {
    const Point p = onTerrain(x, y);
    const Cover cover = relief_.cover.clamped(static_cast<int64_t>(std::floor(p.x + 0.5)),
                                              static_cast<int64_t>(std::floor(p.y + 0.5)));
    if (cover == Cover::kSea) return kSea;
    if (cover == Cover::kRoof) return kHouse;
    if (cover == Cover::kLake || river < 0) return kInland;
    const auto [lowest, highest] =
        std::minmax({contourBelow(x, y), contourBelow(x + 1, y), contourBelow(x, y + 1)});
    if (highest == lowest) return beltOf(sampleAt(relief_.height, p));
    return highest % kIndexEvery == 0 ? kIndexContour : kContour;
  }

 private:
  Point onTerrain(uint32_t x, uint32_t y) const {
    return {(x + 0.5) / kTexelsPerSample + relief_.margin,
            (y + 0.5) / kTexelsPerSample + relief_.margin};
  }
  int contourBelow(uint32_t x, uint32_t y) const {
    return static_cast<int>(std::floor(sampleAt(relief_.height, onTerrain(x, y)) / kInterval));
  }

  const Relief& relief_;
};

}  // namespace

ImageFile drawMap(const Relief& relief, const Rivers& rivers, uint32_t size) {
  const uint32_t texels = kTexelsPerSample * (size - 1);
  const Cartographer cartographer(relief);
  ImageFile map{texels, texels, 3, TKS_U8, std::vector<std::byte>(size_t{3} * texels * texels)};
  rivers.forStrips([&](const RiverStrip& strip) {
    std::byte* out = &map.data[size_t{3} * strip.first * texels];
    for (uint32_t y = strip.first; y < strip.end; ++y) {
      for (uint32_t x = 0; x < texels; ++x) {
        for (const uint8_t value : cartographer.colourAt(x, y, strip.distance(x, y)))
          *out++ = std::byte{value};
      }
    }
  });
  return map;
}

}  // namespace tetrakis::tools::synth
