// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/near_grid.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

namespace tetrakis::inline quantiser {

namespace {

/// The grids that floats may lie near, from the widest on; 0.3048 are feet in metres. More of them
/// take the time of a pass over the samples each, until a sample does not suit.
constexpr std::array kGridUnits = {10., 1., 0.3048, 0.1, 0.01};

}  // namespace

std::optional<double> nearGrid(const tks_heights& heights, Mask valid, double error) {
  assert(heights.sample == TKS_F32);
  const size_t count = size_t{heights.width} * heights.height;
  const std::span samples(static_cast<const float*>(heights.data), count);
  const auto suits = [&](double unit) {
    for (size_t i = 0; i < count; ++i) {
      const auto sample = static_cast<double>(samples[i]);
      if (valid[i] && !(std::abs(sample - unit * std::round(sample / unit)) <= error)) return false;
    }
    return true;
  };
  const auto unit = std::find_if(kGridUnits.begin(), kGridUnits.end(),
                                 [&](double wide) { return wide > 2 * error && suits(wide); });
  return unit == kGridUnits.end() ? std::nullopt : std::optional(*unit);
}

}  // namespace tetrakis::inline quantiser
