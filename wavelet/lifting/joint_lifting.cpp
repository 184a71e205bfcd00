// SPDX-License-Identifier: Apache-2.0
#include "wavelet/lifting/joint_lifting.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline lifting {

namespace {

constexpr uint32_t kFraction = (1 << kJointPlaces) - 1;

/// Gives values so many more binary places.
void widen(std::span<const int32_t> values, int places, std::span<int32_t> out) {
  assert(values.size() == out.size());
  for (size_t i = 0; i < values.size(); ++i) out[i] = values[i] << places;
}

}  // namespace

bool liftsJointly(FilterId id) {
  return liftingFilter(id).steps.size() == 2;
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
      halves_(block.extent.width) {
  assert(liftsJointly(id) && block.extent.width >= 2 && block.extent.height >= 2);
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

/// d += [Px (c + Py a) + Py b]
void JointLifting::centres(uint32_t row) {
  const std::span<int32_t> c = halves_.room(true, block_.extent.width);
  widen(half(row, false), kJointPlaces - placesIn(), c);
  addColumns({row, false, true}, Direction::kAnalysis, c);
  sums_.assign(half(row, true).size(), 0);
  addRow(true, kJointPlaces);
  addColumns({row, true, true}, Direction::kAnalysis, sums_);
  round({row, true});
}

/// b += [Px a + Uy d]
void JointLifting::rightSides(uint32_t row) {
  const auto low = half(row, false);
  std::copy(low.begin(), low.end(), halves_.room(true, block_.extent.width).begin());
  sums_.assign(half(row, true).size(), 0);
  addRow(true, placesIn());
  addColumns({row, true, false}, Direction::kAnalysis, sums_);
  round({row, true});
}

/// c += [Py a + Ux d]
void JointLifting::lowerSides(uint32_t row) {
  const auto high = half(row, true);
  std::copy(high.begin(), high.end(), halves_.room(false, block_.extent.width).begin());
  sums_.assign(half(row, false).size(), 0);
  addRow(false, 0);
  addColumns({row, false, true}, Direction::kAnalysis, sums_);
  round({row, false});
}

/// Ux (b - Uy d) + Uy c
void JointLifting::sumCorners(uint32_t row) {
  const std::span<int32_t> b = halves_.room(false, block_.extent.width);
  widen(half(row, true), kJointPlaces, b);
  addColumns({row, true, false}, Direction::kSynthesis, b);
  sums_.assign(half(row, false).size(), 0);
  addRow(false, kJointPlaces);
  addColumns({row, false, false}, Direction::kAnalysis, sums_);
}

/// a += [Ux (b - Uy d) + Uy c]
void JointLifting::corners(uint32_t row) {
  sumCorners(row);
  if (!block_.fractions_out) return roundCorners(row);
  const bool analyses = direction_ == Direction::kAnalysis;
  const std::span<int32_t> a = half(row, false);
  const int shift = kJointPlaces - placesIn();
  for (size_t i = 0; i < a.size(); ++i) {
    const auto value = static_cast<uint32_t>(a[i]), sum = static_cast<uint32_t>(sums_[i]);
    a[i] = analyses ? static_cast<int32_t>((value << shift) + sum)
                    : static_cast<int32_t>(value - sum) >> shift;
  }
}

void JointLifting::findFractions(uint32_t first_row, uint32_t end_row, std::span<uint8_t> low) {
  const size_t columns = half(0, false).size();
  for (uint32_t row = first_row; row < end_row; ++row) {
    if (row % 2 != 0) continue;
    sumCorners(row);
    uint8_t* const to = low.data() + row / 2 * columns;
    for (size_t i = 0; i < columns; ++i)
      to[i] = static_cast<uint8_t>((fractionAt({row, false}, i) + static_cast<uint32_t>(sums_[i])) &
                                   kFraction);
  }
}

uint32_t JointLifting::fractionAt(HalfRow of, size_t index) const {
  if (!block_.fractions_in) return 0;
  return block_.fractions[size_t{of.row} * block_.extent.width + 2 * index + of.high];
}

std::span<int32_t> JointLifting::half(uint32_t row, bool high) const {
  const uint32_t highs = block_.extent.width / 2, lows = block_.extent.width - highs;
  int32_t* const values = block_.first + row * block_.pitch;
  return high ? std::span(values + lows, highs) : std::span(values, lows);
}

LiftingRule JointLifting::ruleOf(bool predicts, int places, Direction direction) const {
  return {filter_.steps[predicts ? 0 : 1], filter_.shift - kJointPlaces + places, direction, wide_};
}

/// What the halves hold has so many binary places.
void JointLifting::addRow(bool predicts, int places) {
  const LiftingRule rule = ruleOf(predicts, places, Direction::kAnalysis);
  liftStep(sums_.data(), halves_.sources(predicts, rule.step.pairs), rule, sums_.size());
}

/// Adds what a step along the columns makes of whole numbers, or takes it off.
void JointLifting::addColumns(const Columns& of, Direction direction,
                              std::span<int32_t> sums) const {
  const LiftingRule rule = ruleOf(of.predicts, of.predicts ? placesIn() : 0, direction);
  const Rows<int32_t> rows{half(0, of.high).data(), block_.pitch, block_.extent.height,
                           static_cast<uint32_t>(sums.size())};
  liftStep(sums.data(), rows.sources(of.row, rule.step.pairs), rule, sums.size());
}

/// Adds the brackets to values, or takes them off, rounded to whole numbers.
void JointLifting::round(HalfRow of) const {
  const std::span<int32_t> target = half(of.row, of.high);
  if (block_.fractions_in) return roundFractions(of, 0);
  addRounded(kJointPlaces, target);
}

void JointLifting::roundCorners(uint32_t row) const {
  if (block_.fractions_in) return roundFractions({row, false}, block_.doubled ? 1 : 0);
  const std::span<int32_t> a = half(row, false);
  if (!block_.doubled) return addRounded(kJointPlaces, a);
  if (direction_ == Direction::kAnalysis) doubleValues(a);
  addRounded(kJointPlaces - 1, a);
  if (direction_ == Direction::kSynthesis) halveValues(a);
}

/// Where samples are whole numbers: adds the brackets, or takes them off, rounded at a binary
/// place.
void JointLifting::addRounded(int places, std::span<int32_t> target) const {
  const uint32_t half = 1u << (places - 1);
  const uint32_t sign = direction_ == Direction::kAnalysis ? 0 : ~0u;  // -c is ~c + 1
  for (size_t i = 0; i < target.size(); ++i) {
    const auto sum = static_cast<int32_t>(static_cast<uint32_t>(sums_[i]) + half) >> places;
    target[i] = static_cast<int32_t>(static_cast<uint32_t>(target[i]) +
                                     (static_cast<uint32_t>(sum) ^ sign) - sign);
  }
}

/// Where samples have fractions, that is n + r with a whole number n and r sixteenths: the analysis
/// makes of each a whole coefficient n + [r + s], where s is the sum of the brackets and [ ]
/// rounds, or 2 n + [2 (r + s)] if the level doubles its low band. The synthesis finds n again,
/// because decoders know r (findFractions()) and s before they come to the sample.
void JointLifting::roundFractions(HalfRow of, int doublings) const {
  const int places = kJointPlaces - doublings;
  const std::span<int32_t> target = half(of.row, of.high);
  const auto moved = [places](uint32_t sixteenths) {
    const uint32_t half = 1u << (places - 1);
    return static_cast<int32_t>(sixteenths + half) >> places;
  };
  for (size_t i = 0; i < target.size(); ++i) {
    const auto value = static_cast<uint32_t>(target[i]), sum = static_cast<uint32_t>(sums_[i]);
    if (direction_ == Direction::kAnalysis) {
      target[i] = moved(value + sum);
      continue;
    }
    const uint32_t fraction = fractionAt(of, i);
    const uint32_t left = value - static_cast<uint32_t>(moved(sum + fraction));
    const int32_t n =
        doublings > 0 ? halved(static_cast<int32_t>(left)) : static_cast<int32_t>(left);
    target[i] = static_cast<int32_t>((static_cast<uint32_t>(n) << kJointPlaces) + fraction);
  }
}

}  // namespace tetrakis::inline lifting
