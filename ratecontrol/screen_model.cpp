// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/screen_model.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline ratecontrol {

namespace {

constexpr uint32_t kPatchSide = 16;    // cells of 2 x 2 texels
constexpr uint32_t kMostPatches = 64;  // along one side: a statistic needs no more

/// One channel, or the sum over a cell of 2 x 2 texels: what is moved on the screen is the decoded
/// texture, and its finest octave is lost at the rates where the split between tracks matters.
class Cells {
 public:
  explicit Cells(const Texels& texels) : texels_(texels) {}
  uint32_t width() const { return texels_.width / 2; }
  uint32_t height() const { return texels_.height / 2; }
  double at(uint32_t x, uint32_t y, uint32_t channel) const {
    const auto texel = [&](uint32_t u, uint32_t v) -> double {
      return texels_.samples[(size_t{v} * texels_.width + u) * texels_.channels + channel];
    };
    return (texel(2 * x, 2 * y) + texel(2 * x + 1, 2 * y) + texel(2 * x, 2 * y + 1) +
            texel(2 * x + 1, 2 * y + 1)) /
           4;
  }

 private:
  const Texels& texels_;
};

/// Sums over the cells of a patch.
struct Moments {
  double sum = 0, squares = 0, gradient = 0, count = 0;

  double variance() const {
    return count == 0 ? 0 : squares / count - (sum / count) * (sum / count);
  }
  /// Mean squared gradient per texel; cells are two texels apart.
  double meanGradient() const { return count == 0 ? 0 : gradient / count / 4; }
};

Moments momentsOf(const Cells& cells, uint32_t x0, uint32_t y0, uint32_t channel) {
  Moments m;
  for (uint32_t y = y0; y + 1 < std::min(cells.height(), y0 + kPatchSide); ++y) {
    for (uint32_t x = x0; x + 1 < std::min(cells.width(), x0 + kPatchSide); ++x) {
      const double here = cells.at(x, y, channel);
      const double dx = cells.at(x + 1, y, channel) - here, dy = cells.at(x, y + 1, channel) - here;
      m.sum += here;
      m.squares += here * here;
      m.gradient += dx * dx + dy * dy;
      ++m.count;
    }
  }
  return m;
}

}  // namespace

ScreenModel::ScreenModel(const Texels& texture, double texels_per_height)
    : squared_parallax_(texels_per_height * texels_per_height) {
  const Cells cells(texture);
  const uint32_t colours = texture.channels < 3 ? 1 : 3;
  const uint32_t pitch =
      std::max(kPatchSide, std::max(cells.width(), cells.height()) / kMostPatches);
  for (uint32_t y = 0; y < cells.height(); y += pitch) {
    for (uint32_t x = 0; x < cells.width(); x += pitch) {
      Patch patch{0, 0};
      for (uint32_t c = 0; c < colours; ++c) {
        const Moments m = momentsOf(cells, x, y, c);
        patch.variance += m.variance() / colours;
        patch.gradient += m.meanGradient() / colours;
      }
      patches_.push_back(patch);
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

}  // namespace tetrakis::inline ratecontrol
