// SPDX-License-Identifier: Apache-2.0
// Stream-power incision, hillslope creep, talus.
#include "apps/tools/synth/erosion.hpp"

#include <array>

namespace tetrakis::tools::synth {
namespace {

constexpr std::array<Step, 4> kSides = {kSteps[0], kSteps[1], kSteps[2], kSteps[3]};

double sideNeighbour(const Grid& height, uint32_t x, uint32_t y, const Step& step) {
  return height.clamped(int64_t{x} + step.x, int64_t{y} + step.y);
}

/// With F = K dt sqrt(area) / distance: h' = (h + uplift + F h'(receiver)) / (1 + F). Area and
/// distance are both in cells, so F does not depend on the resolution.
void incise(Grid& height, const Grid* uplift, const Drainage& drainage, double erodibility) {
  const uint32_t side = height.side();
  forUpstream(drainage.receiver, [&](uint32_t cell) {
    const uint32_t to = drainage.receiver[cell];
    if (to == cell) return;
    const bool straight = cell % side == to % side || cell / side == to / side;
    const double f = erodibility * std::sqrt(drainage.area[cell]) / (straight ? 1 : kSqrt2);
    const double raised = uplift != nullptr ? height[cell] + (*uplift)[cell] : height[cell];
    height[cell] = (raised + f * height[to]) / (1 + f);
  });
}

/// Each cell that is not fixed becomes function(heights before, x, y).
template <class Function>
void update(Grid& height, const Raster<uint8_t>& fixed, Function function) {
  const Grid before = height;
  const uint32_t side = height.side();
  forRows(side, side, [&](uint32_t first, uint32_t end) {
    for (uint32_t y = first; y < end; ++y) {
      for (uint32_t x = 0; x < side; ++x) {
        if (!fixed.at(x, y)) height.at(x, y) = function(before, x, y);
      }
    }
  });
}

void creep(Grid& height, const Raster<uint8_t>& fixed, double share) {
  update(height, fixed, [share](const Grid& before, uint32_t x, uint32_t y) {
    double sum = 0;
    for (const Step& step : kSides) sum += sideNeighbour(before, x, y, step);
    return mix(before.at(x, y), sum / 4, share);
  });
}

}  // namespace

void erode(Grid& height, const Grid* uplift, const Raster<uint8_t>& fixed,
           const StreamPower& power) {
  for (int round = 0; round < power.rounds; ++round) {
    incise(height, uplift, drain(height, fixed), power.erodibility);
    creep(height, fixed, power.creep);
  }
}

// Each side neighbour with an excess gives or takes a fifth of it: at most four neighbours, no
// overshoot, and what one cell gives the other takes.
void slide(Grid& height, const Raster<uint8_t>& fixed, double drop, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    update(height, fixed, [drop](const Grid& before, uint32_t x, uint32_t y) {
      const double here = before.at(x, y);
      double moved = 0;
      for (const Step& step : kSides) {
        const double rise = sideNeighbour(before, x, y, step) - here;
        moved += rise - std::clamp(rise, -drop, drop);
      }
      return here + 0.2 * moved;
    });
  }
}

}  // namespace tetrakis::tools::synth
