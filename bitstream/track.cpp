// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track.hpp"

#include <algorithm>
#include <array>

namespace tetrakis {

namespace {

/// Delay of a pass against the plain order by norm * 2^plane, in 1/16 of a bit-plane. Measured: the
/// slope dD/dR of the likely pass is steepest, then the rest, then refinement (bytes against no
/// delay: -2 % on terrain, -3 % on images).
constexpr std::array<int, 3> kDelay = {0, 6, 10};

}  // namespace

bool BandPlan::vacant() const {
  if (shape.empty() || absent.empty()) return shape.empty();
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t x = 0; x < shape.words(); ++x) {
      if ((shape.valid(x) & ~absent[shape.word(row, x)]) != 0) return false;
    }
  }
  return true;
}

std::vector<Pass> schedule(const std::vector<BandPlan>& plan, int planes) {
  std::vector<uint16_t> coded;
  for (size_t band = 0; band < plan.size(); ++band) {
    if (!plan[band].vacant()) coded.push_back(static_cast<uint16_t>(band));
  }
  std::vector<Pass> passes;
  passes.reserve(coded.size() * static_cast<size_t>(planes) * kDelay.size());
  for (int plane = planes - 1; plane >= 0; --plane) {
    for (const uint16_t band : coded) {
      for (int kind = 0; kind < 3; ++kind) {
        passes.push_back({band, static_cast<uint8_t>(plane), static_cast<PassKind>(kind),
                          16 * plane + plan[band].log_norm - kDelay[static_cast<size_t>(kind)]});
      }
    }
  }
  std::stable_sort(passes.begin(), passes.end(),
                   [](const Pass& a, const Pass& b) { return a.key > b.key; });
  return passes;
}

TrackState::TrackState(const std::vector<BandPlan>& plan, int planes) {
  uint32_t classes = 0;
  bands.reserve(plan.size());
  for (const BandPlan& band : plan) {
    bands.emplace_back(band.shape, band.orientation, band.absent).plane = planes;
    classes = std::max(classes, band.models + 1);
  }
  models.resize(classes);
}

}  // namespace tetrakis
