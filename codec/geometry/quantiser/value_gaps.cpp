// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/value_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline quantiser {

namespace {

/// The factor by which a wide gap exceeds the usual gap and the gaps beside it. With a larger
/// factor fewer gaps are bridged: early prefixes lose, and lossless tables take fewer bytes.
constexpr double kWide = 16;
/// The first values of a bridge are the usual gap apart; then each gap is twice the one before.
/// More values make tables longer, and let errors beside an island fall more evenly.
constexpr int kEvenValues = 16, kMostValues = 32;

/// Adds the values of a bridge beside one of its ends, up to a limit in the direction of `step`.
void addSide(double from, double step, double limit, std::vector<double>& values) {
  for (int i = 0; i < kMostValues; ++i) {
    from += step;
    if (std::abs(limit - from) < std::abs(step) || (limit - from) * step <= 0) return;
    values.push_back(from);
    if (i >= kEvenValues) step *= 2;
  }
}

}  // namespace

ValueGaps::ValueGaps(std::vector<double> values) : values_(std::move(values)) {
  std::vector<double> gaps;
  for (size_t i = 1; i < values_.size(); ++i) gaps.push_back(gap(i));
  if (gaps.empty()) return;
  const auto middle = gaps.begin() + static_cast<ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  usual_ = *middle;
}

std::vector<double> ValueGaps::bridge(size_t i) const {
  if (!isWide(i)) return {};
  const double low = values_[i - 1], high = values_[i], middle = low + gap(i) / 2;
  const double below = gap(i - 1), above = gap(i + 1);
  std::vector<double> values;
  if (below > 0) addSide(low, std::max(below, usual_), above > 0 ? middle : high, values);
  if (above > 0) addSide(high, -std::max(above, usual_), below > 0 ? middle : low, values);
  std::sort(values.begin(), values.end());
  return values;
}

double ValueGaps::unevenness(const std::vector<uint32_t>& samples) const {
  double count = 0, squares = 0, logarithms = 0;
  for (size_t i = 0; i < values_.size(); ++i) {
    const double square = squaredGap(i);
    if (square == 0) continue;
    count += samples[i];
    squares += samples[i] * square;
    logarithms += samples[i] * portable::log2(square);
  }
  return count > 0 ? (portable::log2(squares / count) - logarithms / count) / 2 : 0;
}

double ValueGaps::gap(size_t i) const {
  return i == 0 || i >= values_.size() ? 0 : values_[i] - values_[i - 1];
}

bool ValueGaps::isWide(size_t i) const {
  if (gap(i) == 0) return false;
  const double beside = std::max(gap(i - 1), gap(i + 1));
  return beside > 0 && gap(i) > kWide * std::max(beside, usual_);
}

double ValueGaps::squaredGap(size_t i) const {
  double squares = 0;
  int gaps = 0;
  for (const size_t side : {i, i + 1}) {
    if (gap(side) == 0 || isWide(side)) continue;
    squares += gap(side) * gap(side);
    ++gaps;
  }
  return gaps > 0 ? squares / gaps : 0;
}

}  // namespace tetrakis::inline quantiser
