// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/near_grid.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

namespace tetrakis::inline quantiser {

std::optional<double> nearGrid(const tks_heights& heights, Mask valid, double error) {
  constexpr std::array kUnits = {10., 1., 0.3048, 0.1, 0.01};  // of metres; 0.3048: feet
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
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(),
                                 [&](double wide) { return wide > 2 * error && suits(wide); });
  return unit == kUnits.end() ? std::nullopt : std::optional(*unit);
}

}  // namespace tetrakis::inline quantiser
