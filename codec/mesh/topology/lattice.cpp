// SPDX-License-Identifier: Apache-2.0
// Size and numbering of the 4-8 lattice.
#include "codec/mesh/topology/lattice.hpp"

#include <bit>
#include <cassert>

namespace tetrakis::inline topology {
namespace {
constexpr BorderRule kRule = BorderRule::kOverhanging;
}

Result<Lattice> Lattice::make(uint32_t width, uint32_t height) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 2 || height < 2)
    return Status(TKS_USAGE, "Heights of " + size + " samples have no area, and so no mesh.");
  if (uint64_t{width} * height > uint64_t{1} << 31)
    return Status(TKS_LIMIT, "A mesh of " + size + " samples is too large; the limit is 2^31.");
  Lattice lattice(width, height);
  lattice.addLevels();
  return lattice;
}

Lattice::Lattice(uint32_t width, uint32_t height)
    : right_(width - 1),
      bottom_(height - 1),
      root_side_(uint32_t{1} << depthOf(kRule, width, height)) {}

void Lattice::addLevels() {
  assert(std::has_single_bit(root_side_));
  for (uint32_t step = root_side_ / 2; step > 0; step /= 2) {
    Plan plan;
    plan.step = step;
    plan.shift = static_cast<uint32_t>(std::countr_zero(step));
    plan.first = vertex_count_;
    plan.columns = centresAlong(kRule, width(), step);
    plan.rows = centresAlong(kRule, height(), step);
    vertex_count_ += plan.columns * plan.rows;
    addLevel(plan);
    plan.first = vertex_count_;
    plan.columns = multiplesAlong(kRule, width(), step);
    plan.rows = multiplesAlong(kRule, height(), step);
    vertex_count_ += static_cast<uint32_t>(uint64_t{plan.columns} * plan.rows / 2);
    addLevel(plan);
  }
}

void Lattice::addLevel(Plan plan) {
  for (uint32_t cell = 0; cell < plan.offsets.size(); ++cell) {
    const uint32_t offset = cell / 8 * plan.columns + cell % 8;
    plan.offsets[cell] = isCentre(levelCount()) ? offset : offset / 2;
  }
  assert(plan.columns > 0 && plan.rows > 0);
  levels_.push_back(plan);
}

}  // namespace tetrakis::inline topology
