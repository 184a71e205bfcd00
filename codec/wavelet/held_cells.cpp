// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/held_cells.hpp"

#include <array>
#include <cassert>

#include "codec/wavelet/lifting/lifting.hpp"

namespace tetrakis::inline wavelet {

HeldCells::HeldCells(const WaveletSpec& spec, const Pyramid& pyramid) : spec_(spec) {
  const std::span<const int32_t> values = pyramid.held().values;
  values_.emplace_back(values.begin(), values.end());
  for (int l = 1; l <= pyramid.levels(); ++l) {
    const HeldCellsOfLevel cells = level(l);
    std::vector<int32_t>& low = values_.emplace_back();
    low.reserve(values.size());
    for (const HeldCell& cell : cells.after) low.push_back(cell.corner);
  }
}

HeldCellsOfLevel HeldCells::level(int level) const {
  const FilterId id = spec_.filter(level);
  assert(liftsJointly(id));
  // A cell that is mirrored about its sides is the whole surface.
  std::array<int32_t, 4> cell;
  const JointBlock block{cell.data(), 2, {2, 2}, Ends::kMirrored, spec_.doubles(level)};
  JointLifting lifting(block, id, Direction::kAnalysis, spec_.jointlyWide(level));
  HeldCellsOfLevel all;
  for (const int32_t v : values_[static_cast<size_t>(level - 1)]) {
    cell.fill(v);
    all.before.push_back({v, v, v});
    all.raised.push_back(lifting.raised(1).front());
    lifting.run(JointStep::kCentres, 0, 2);
    lifting.run(JointStep::kSides, 0, 2);
    all.lowered.push_back(lifting.lowered(0).front());
    lifting.run(JointStep::kCorners, 0, 2);
    all.after.push_back({cell[0], cell[1], cell[3]});
  }
  return all;
}

}  // namespace tetrakis::inline wavelet
