// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/lifting/lifting.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline lifting {

namespace {

/// Gives values so many more binary places.
void widen(std::span<const int32_t> values, int places, std::span<int32_t> out) {
  assert(values.size() == out.size());
  for (size_t i = 0; i < values.size(); ++i) out[i] = values[i] << places;
}

}  // namespace

bool liftsJointly(FilterId id) {
  return liftingFilter(id).steps.size() == 2;
}

size_t jointRounds(FilterId id) {
  return liftingFilter(id).steps.size() / 2;
}

std::array<JointStep, 4> JointLifting::steps(Direction direction) {
  using enum JointStep;
  if (direction == Direction::kAnalysis) return {kHalves, kCentres, kSides, kCorners};
  return {kCorners, kSides, kCentres, kHalves};
}

JointLifting::JointLifting(const JointBlock& block, FilterId id, Direction direction, bool wide)
    : block_(block),
      filter_(liftingFilter(id)),
      direction_(direction),
      wide_(wide),
      halves_(block.extent.width, block.ends) {
  assert(block.round < jointRounds(id));
  assert(block.extent.width >= 2 && block.extent.height >= 2);
}

void JointLifting::run(JointStep step, uint32_t first_row, uint32_t end_row) {
  for (uint32_t row = first_row; row < end_row; ++row) {
    const bool odd = row % 2 != 0;
    if (step == JointStep::kHalves) orderHalves(row);
    if (step == JointStep::kCentres && odd) centres(row);
    if (step == JointStep::kSides) odd ? lowerSides(row) : rightSides(row);
    if (step == JointStep::kCorners && !odd) corners(row);
  }
}

void JointLifting::orderHalves(uint32_t row) {
  const uint32_t width = block_.extent.width;
  int32_t* const values = half(row, false).data();
  if (direction_ == Direction::kAnalysis) {
    halves_.takeApart(values, width);
    halves_.copyTo(values);
  } else {
    halves_.copyFrom(values, width);
    halves_.putTogether(values);
  }
}

std::span<const int32_t> JointLifting::raised(uint32_t row) {
  const std::span<int32_t> c = halves_.room(true, block_.extent.width);
  widen(half(row, false), kJointPlaces, c);
  addColumns({row, false, true}, Direction::kAnalysis, c);
  hold(row, false, block_.held.raised, c);
  return c;
}

std::span<const int32_t> JointLifting::lowered(uint32_t row) {
  const std::span<int32_t> b = halves_.room(false, block_.extent.width);
  widen(half(row, true), kJointPlaces, b);
  addColumns({row, true, false}, Direction::kSynthesis, b);
  hold(row, true, block_.held.lowered, b);
  return b;
}

/// d += [Px (c + Py a) + Py b]
void JointLifting::centres(uint32_t row) {
  raised(row);
  sums_.assign(half(row, true).size(), 0);
  addRow(true, kJointPlaces);
  addColumns({row, true, true}, Direction::kAnalysis, sums_);
  addRounded(kJointPlaces, half(row, true));
}

/// b += [Px a + Uy d]
void JointLifting::rightSides(uint32_t row) {
  const auto low = half(row, false);
  std::copy(low.begin(), low.end(), halves_.room(true, block_.extent.width).begin());
  sums_.assign(half(row, true).size(), 0);
  addRow(true, 0);
  addColumns({row, true, false}, Direction::kAnalysis, sums_);
  addRounded(kJointPlaces, half(row, true));
}

/// c += [Py a + Ux d]
void JointLifting::lowerSides(uint32_t row) {
  const auto high = half(row, true);
  std::copy(high.begin(), high.end(), halves_.room(false, block_.extent.width).begin());
  sums_.assign(half(row, false).size(), 0);
  addRow(false, 0);
  addColumns({row, false, true}, Direction::kAnalysis, sums_);
  addRounded(kJointPlaces, half(row, false));
}

/// a += [Ux (b - Uy d) + Uy c]
void JointLifting::corners(uint32_t row) {
  lowered(row);
  sums_.assign(half(row, false).size(), 0);
  addRow(false, kJointPlaces);
  addColumns({row, false, false}, Direction::kAnalysis, sums_);
  roundCorners(row);
}

std::span<int32_t> JointLifting::half(uint32_t row, bool high) const {
  const uint32_t highs = block_.extent.width / 2, lows = block_.extent.width - highs;
  int32_t* const values = block_.first + row * block_.pitch;
  return high ? std::span(values + lows, highs) : std::span(values, lows);
}

void JointLifting::hold(uint32_t row, bool high, const int32_t* values,
                        std::span<int32_t> half) const {
  if (block_.held.numbers == nullptr) return;
  const uint32_t lows = block_.extent.width - block_.extent.width / 2;
  const uint16_t* const numbers = block_.held.numbers + row * block_.pitch + (high ? lows : 0);
  for (size_t i = 0; i < half.size(); ++i)
    if (numbers[i] != 0) half[i] = values[numbers[i] - 1];
}

LiftingRule JointLifting::ruleOf(bool predicts, int places, Direction direction) const {
  const size_t step = 2 * block_.round + (predicts ? 0 : 1);
  return {filter_.steps[step], filter_.shift - kJointPlaces + places, direction, wide_};
}

/// What the halves hold has so many binary places.
void JointLifting::addRow(bool predicts, int places) {
  const LiftingRule rule = ruleOf(predicts, places, Direction::kAnalysis);
  liftStep(sums_.data(), halves_.sources(predicts, rule.step.pairs), rule, sums_.size());
}

/// Adds what a step along the columns makes of whole numbers, or takes it off.
void JointLifting::addColumns(const Columns& of, Direction direction,
                              std::span<int32_t> sums) const {
  const LiftingRule rule = ruleOf(of.predicts, 0, direction);
  const Rows<int32_t> rows{half(0, of.high).data(), block_.pitch, block_.extent.height,
                           static_cast<uint32_t>(sums.size())};
  liftStep(sums.data(), rows.sources(of.row, rule.step.pairs), rule, sums.size());
}

void JointLifting::roundCorners(uint32_t row) const {
  const std::span<int32_t> a = half(row, false);
  if (!block_.doubled) return addRounded(kJointPlaces, a);
  if (direction_ == Direction::kAnalysis) doubleValues(a);
  addRounded(kJointPlaces - 1, a);
  if (direction_ == Direction::kSynthesis) halveValues(a);
}

/// Adds the brackets, or takes them off, rounded at a binary place.
void JointLifting::addRounded(int places, std::span<int32_t> target) const {
  const uint32_t half = 1u << (places - 1);
  const uint32_t sign = direction_ == Direction::kAnalysis ? 0 : ~0u;  // -c is ~c + 1
  for (size_t i = 0; i < target.size(); ++i) {
    const auto sum = static_cast<int32_t>(static_cast<uint32_t>(sums_[i]) + half) >> places;
    target[i] = static_cast<int32_t>(static_cast<uint32_t>(target[i]) +
                                     (static_cast<uint32_t>(sum) ^ sign) - sign);
  }
}

}  // namespace tetrakis::inline lifting
