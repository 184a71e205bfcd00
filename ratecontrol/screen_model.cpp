// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/screen_model.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis {

namespace {

constexpr uint32_t kPatchSide = 16;
constexpr uint32_t kMostPatches = 64;  // along one side: a statistic needs no more

struct Moments {
  double sum = 0, squares = 0, gradient = 0;
  double count = 0;
};

}  // namespace

ScreenModel::ScreenModel(const Texels& texture, double texels_per_height)
    : squared_parallax_(texels_per_height * texels_per_height) {
  const uint32_t colours = texture.channels < 3 ? 1 : 3;
  const uint32_t side = std::max(
      kPatchSide, std::max(texture.width, texture.height) / kMostPatches);
  for (uint32_t y0 = 0; y0 < texture.height; y0 += side) {
    for (uint32_t x0 = 0; x0 < texture.width; x0 += side) {
      double variance = 0, gradient = 0;
      for (uint32_t c = 0; c < colours; ++c) {
        Moments m;
        for (uint32_t y = y0; y + 1 < texture.height && y < y0 + kPatchSide; ++y) {
          for (uint32_t x = x0; x + 1 < texture.width && x < x0 + kPatchSide; ++x) {
            const auto at = [&](uint32_t u, uint32_t v) -> double {
              return texture.samples[(size_t{v} * texture.width + u) * texture.channels + c];
            };
            const double here = at(x, y), dx = at(x + 1, y) - here, dy = at(x, y + 1) - here;
            m.sum += here;
            m.squares += here * here;
            m.gradient += dx * dx + dy * dy;
            ++m.count;
          }
        }
        if (m.count == 0) continue;
        variance += m.squares / m.count - (m.sum / m.count) * (m.sum / m.count);
        gradient += m.gradient / m.count;
      }
      patches_.push_back({variance / colours, gradient / colours});
    }
  }
}

double ScreenModel::cost(double height_mse) const {
  double total = 0;
  for (const Patch& patch : patches_) {
    if (patch.variance <= 0) continue;
    const double shift = patch.gradient * squared_parallax_ * height_mse;
    total += 2 * patch.variance * -std::expm1(-shift / (4 * patch.variance));
  }
  return patches_.empty() ? 0 : total / static_cast<double>(patches_.size());
}

}  // namespace tetrakis
