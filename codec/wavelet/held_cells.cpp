// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/held_cells.hpp"

#include <array>

#include "codec/wavelet/lifting/lifting.hpp"

namespace tetrakis::inline wavelet {

HeldCells::HeldCells(const WaveletSpec& spec, const Pyramid& pyramid) : spec_(spec) {
  const std::span<const int32_t> values = pyramid.held().values;
  values_.emplace_back(values.begin(), values.end());
  for (int l = 1; l <= pyramid.levels(); ++l) {
    const HeldRounds rounds = level(l);
    std::vector<int32_t>& low = values_.emplace_back();
    low.reserve(values.size());
    for (const HeldCell& cell : rounds.cells.back()) low.push_back(cell.corner);
  }
}

HeldRounds HeldCells::level(int level) const {
  const FilterId id = spec_.filter(level);
  const size_t rounds = jointRounds(id);
  HeldRounds all{.cells = std::vector<std::vector<HeldCell>>(1), .raised = {}, .lowered = {}};
  for (const int32_t v : values_[static_cast<size_t>(level - 1)])
    all.cells.front().push_back({v, v, v});
  for (size_t round = 0; round < rounds; ++round) {
    // A cell that is mirrored about its sides is the whole surface.
    std::array<int32_t, 4> cell;
    const bool doubled = spec_.doubles(level) && round + 1 == rounds;
    const JointBlock block{cell.data(), 2, {2, 2}, Ends::kMirrored, doubled, round};
    JointLifting lifting(block, id, Direction::kAnalysis, spec_.jointlyWide(level));
    std::vector<HeldCell> after;
    std::vector<int32_t>&raised = all.raised.emplace_back(), &lowered = all.lowered.emplace_back();
    for (const auto& [corner, side, centre] : all.cells.back()) {
      cell = {corner, side, side, centre};
      raised.push_back(lifting.raised(1).front());
      lifting.run(JointStep::kCentres, 0, 2);
      lifting.run(JointStep::kSides, 0, 2);
      lowered.push_back(lifting.lowered(0).front());
      lifting.run(JointStep::kCorners, 0, 2);
      after.push_back({cell[0], cell[1], cell[3]});
    }
    all.cells.push_back(std::move(after));
  }
  return all;
}

}  // namespace tetrakis::inline wavelet
