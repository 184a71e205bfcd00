// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/patch_texture.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable_math.hpp"

namespace tetrakis::inline pictures {

PatchPlace patchPlaceOf(const SeenTriangle& seen, int depth, int texture_depth) {
  const uint32_t squares = uint32_t{1} << depth, triangles = 2 * squares * squares;
  const uint32_t in_patch = seen.triangle % triangles, square = in_patch / 2;
  const bool has_north_east = in_patch % 2 == 1;
  const float both = seen.second + seen.third;
  const float right = has_north_east ? both : seen.third;
  const float down = has_north_east ? seen.second : both;
  const auto along = [&](uint32_t whole, float part) {
    return std::clamp((static_cast<float>(whole) + part) / static_cast<float>(squares), 0.f, 1.f);
  };
  const double texels = std::ldexp(0.5, 2 * (texture_depth - depth));
  const double level = seen.samples > 0 ? portable::log2(texels / double{seen.samples}) / 2 : 0;
  return {seen.triangle / triangles, along(square % squares, right), along(square / squares, down),
          static_cast<float>(std::max(level, 0.0))};
}

PatchTexture::PatchTexture(const Texels& texels, int depth) {
  levels_.push_back({(uint32_t{1} << depth) + 1, shownTexels(texels)});
  while (levels_.back().side > 2) levels_.push_back(halved(levels_.back()));
}

/// Every other texel with its neighbours, by weights of 1 2 1 in both directions. Beyond a side of
/// a patch its texels are mirrored.
PatchTexture::Level PatchTexture::halved(const Level& fine) {
  constexpr Lanes kHalf = 0x0008'0008'0008, kBytes = 0x00ff'00ff'00ff;
  const uint32_t n = fine.side - 1, side = n / 2 + 1;
  const size_t area = size_t{fine.side} * fine.side;
  Level coarse{side, {}};
  coarse.texels.reserve(fine.texels.size() / area * side * side);
  for (size_t first = 0; first < fine.texels.size(); first += area) {
    const Lanes* const patch = &fine.texels[first];
    for (uint32_t y = 0; y <= n; y += 2) {
      const uint32_t above = y > 0 ? y - 1 : 1, below = y < n ? y + 1 : n - 1;
      for (uint32_t x = 0; x <= n; x += 2) {
        const uint32_t west = x > 0 ? x - 1 : 1, east = x < n ? x + 1 : n - 1;
        const auto along = [&](uint32_t row) {
          const Lanes* const from = patch + size_t{row} * fine.side;
          return from[west] + 2 * from[x] + from[east];
        };
        coarse.texels.push_back((along(above) + 2 * along(y) + along(below) + kHalf) >> 4 & kBytes);
      }
    }
  }
  return coarse;
}

void PatchTexture::addBilinear(const Level& level, const PatchPlace& place, float weight,
                               Colour& sum) {
  const uint32_t n = level.side - 1;
  const float x = place.u * static_cast<float>(n), y = place.v * static_cast<float>(n);
  const uint32_t west = std::min(static_cast<uint32_t>(x), n - 1);
  const uint32_t north = std::min(static_cast<uint32_t>(y), n - 1);
  const float fx = x - static_cast<float>(west), fy = y - static_cast<float>(north);
  const Lanes* const nw =
      &level.texels[(size_t{place.patch} * level.side + north) * level.side + west];
  const Lanes* const sw = nw + level.side;
  for (size_t c = 0; c < 3; ++c) {
    const auto value = [&](Lanes lanes) { return static_cast<float>(lanes >> 16 * c & 0xffff); };
    const float upper = value(nw[0]) + fx * (value(nw[1]) - value(nw[0]));
    const float lower = value(sw[0]) + fx * (value(sw[1]) - value(sw[0]));
    sum[c] += weight * (upper + fy * (lower - upper));
  }
}

Colour PatchTexture::at(const PatchPlace& place) const {
  const float detail = std::min(place.level, static_cast<float>(levels_.size() - 1));
  const auto fine = static_cast<size_t>(detail);
  const float rest = detail - static_cast<float>(fine);
  Colour sum{};
  addBilinear(levels_[fine], place, 1 - rest, sum);
  if (rest > 0) addBilinear(levels_[fine + 1], place, rest, sum);
  return sum;
}

}  // namespace tetrakis::inline pictures
