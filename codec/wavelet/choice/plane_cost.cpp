// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/plane_cost.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "base/portable_math.hpp"

namespace tetrakis::inline choice {

namespace {

/// In bands of more rows than kLargeRows the first kStrip of every kPeriod rows tell what all rows
/// cost. More rows tell it more exactly, and take time.
constexpr uint32_t kLargeRows = 256, kPeriod = 64, kStrip = 16;

/// Calls take(row, marks) for the coefficients of a subband's rows; marks: 1 for those that are
/// coded; none: all are. Returns for how many rows each one stands.
template <class Take>
double forEachRow(const PlaneLayout& layout, size_t index, std::span<const int32_t> coefficients,
                  const Take& take) {
  const Pyramid& pyramid = layout.pyramid();
  const Subband& band = layout.subbands()[index];
  const bool all_exist = pyramid.allExist(), none_held = pyramid.held().none();
  std::vector<uint8_t> coded(all_exist && none_held ? 0 : band.width, 1);
  uint32_t rows = 0;
  for (uint32_t y = 0; y < band.height; ++y) {
    if (band.height >= kLargeRows && y % kPeriod >= kStrip) continue;
    ++rows;
    const size_t line = size_t{band.planeRow(y)} * pyramid.plane().width;
    if (!all_exist) {
      for (uint32_t x = 0; x < band.width; ++x)
        coded[x] = pyramid.exists(band.sampleColumn(x), band.planeRow(y));
    }
    if (!none_held) {
      const uint16_t* const numbers = pyramid.held().numbers.data() + line;
      for (uint32_t x = 0; x < band.width; ++x)
        coded[x] = static_cast<uint8_t>((all_exist || coded[x] != 0) &&
                                        numbers[band.sampleColumn(x)] == 0);
    }
    take(coefficients.subspan(pyramid.indexOf(band, y), band.width), coded);
  }
  return static_cast<double>(band.height) / std::max(rows, 1u);
}

/// How many bits an integer has: below 2^24 exactly, above sometimes one too many. Compilers make
/// vectors of it, which they do not of std::bit_width().
int32_t widthOf(int32_t value) {
  constexpr int kMantissa = 23, kBias = 126;
  const int32_t exponent = std::bit_cast<int32_t>(static_cast<float>(value)) >> kMantissa;
  return std::max(exponent - kBias, 0);
}

/// Counts numbers of bits by the magnitudes of the neighbours.
class BitCounts {
 public:
  static constexpr int32_t kContexts = 16, kWidths = 32;
  /// The place of what is not counted.
  static constexpr int32_t kNowhere = kContexts * kWidths;

  /// places: kWidths times the context, and the number of bits. Neighbours mostly have one place,
  /// whose counter has to be written before it is read again: so they count in turns in two tables.
  void count(std::span<const int32_t> places) {
    size_t i = 0;
    for (; i + 1 < places.size(); i += 2) {
      ++counts_[0][static_cast<size_t>(places[i])];
      ++counts_[1][static_cast<size_t>(places[i + 1])];
    }
    if (i < places.size()) ++counts_[0][static_cast<size_t>(places[i])];
  }

  /// The entropy of the numbers of bits, and all of these bits: the sign, and those below the
  /// highest.
  double bits() const {
    double bits = 0;
    for (size_t first = 0; first < kNowhere; first += kWidths) {
      std::array<uint32_t, kWidths> row;
      for (size_t i = 0; i < row.size(); ++i)
        row[i] = counts_[0][first + i] + counts_[1][first + i];
      const double sum = std::accumulate(row.begin(), row.end(), 0u);
      if (sum == 0) continue;
      for (size_t i = 0; i < row.size(); ++i) {
        if (row[i] > 0) bits += row[i] * (portable::log2(sum / row[i]) + static_cast<double>(i));
      }
    }
    return bits;
  }

 private:
  std::array<std::array<uint32_t, kNowhere + 1>, 2> counts_{};
};

/// Quantises one band, row by row.
class BandCost {
 public:
  BandCost(uint32_t width, double step, double weight)
      : lossless_(step == 0),
        step_(static_cast<float>(step == 0 ? 1 : step)),
        weight_(weight),
        above_(width + 2),
        row_(width + 2),
        errors_(width),
        places_(width) {}

  void take(std::span<const int32_t> values, std::span<const uint8_t> coded) {
    lossless_ ? takeMagnitudes(values) : quantise(values);
    for (size_t x = 0; x < coded.size(); ++x) {
      row_[x + 1] = coded[x] != 0 ? row_[x + 1] : 0;
      errors_[x] = coded[x] != 0 ? errors_[x] : 0;
    }
    if (!lossless_) squares_ += sumOfSquares();
    const int32_t *const above = above_.data(), *const row = row_.data();
    for (size_t x = 0; x < values.size(); ++x) {
      const int32_t around = 2 * (row[x] + above[x + 1]) + above[x] + above[x + 2];
      const int32_t context = std::min(widthOf(around), BitCounts::kContexts - 1);
      places_[x] = BitCounts::kWidths * context + widthOf(row[x + 1]);
    }
    for (size_t x = 0; x < coded.size(); ++x)
      places_[x] = coded[x] != 0 ? places_[x] : BitCounts::kNowhere;
    counts_.count(places_);
    std::swap(row_, above_);
  }
  PlaneCost cost() const { return {counts_.bits(), weight_ * squares_}; }

 private:
  /// Larger magnitudes count as this one: the neighbours of a coefficient weigh 6 together.
  static constexpr int32_t kMost = INT32_MAX / 8;

  void takeMagnitudes(std::span<const int32_t> values) {
    for (size_t x = 0; x < values.size(); ++x)
      row_[x + 1] = std::abs(std::clamp(values[x], -kMost, kMost));
  }

  void quantise(std::span<const int32_t> values) {
    const float step = step_, per_step = 1 / step_;
    const auto most = static_cast<int32_t>(std::min(double{kMost} * step, double{INT32_MAX}));
    int32_t* const row = row_.data() + 1;
    float* const errors = errors_.data();
    for (size_t x = 0; x < values.size(); ++x) {
      const auto magnitude = static_cast<float>(std::min(std::abs(values[x]), most));
      const auto level = static_cast<int32_t>(magnitude * per_step);
      const auto known = static_cast<float>(std::min(level, 1));
      row[x] = level;
      errors[x] = magnitude - known * (static_cast<float>(level) + 0.5f) * step;
    }
  }

  /// Of the errors of a row.
  double sumOfSquares() const {
    std::array<float, 8> sums{};
    size_t x = 0;
    for (; x + sums.size() <= errors_.size(); x += sums.size())
      for (size_t i = 0; i < sums.size(); ++i) sums[i] += errors_[x + i] * errors_[x + i];
    for (; x < errors_.size(); ++x) sums[0] += errors_[x] * errors_[x];
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  bool lossless_;
  float step_;
  double weight_, squares_ = 0;
  std::vector<int32_t> above_, row_;
  std::vector<float> errors_;
  std::vector<int32_t> places_;  ///< in the counts
  BitCounts counts_;
};

}  // namespace

double PlaneCost::joint(double step) const {
  return step == 0 ? bits : bits + squares / (step * step / 3);
}

PlaneCost costOf(const PlaneLayout& layout, std::span<const int32_t> coefficients, double step) {
  PlaneCost cost;
  for (size_t i = 0; i < layout.subbands().size(); ++i) {
    const double weight = layout.energy(i);
    BandCost band(layout.subbands()[i].width, step / std::sqrt(weight), weight);
    const double each =
        forEachRow(layout, i, coefficients,
                   [&](const auto& row, const auto& coded) { band.take(row, coded); });
    const PlaneCost taken = band.cost();
    cost.bits += each * taken.bits;
    cost.squares += each * taken.squares;
  }
  return cost;
}

namespace {

/// Each step over the one before, 12 dB apart, and the first one behind a target to the last bit.
/// Closer steps judge prefixes more exactly, and take the time of an estimate each.
constexpr double kStepsApart = 4, kFirstLossy = 2;
/// Bits a sample of the shortest prefixes that are compared. A smaller number counts earlier
/// prefixes, whose estimates err more.
constexpr double kLeastPrefixBits = 0.05;
/// Ratios of bits below this one count as this. With a smaller number one step, at which a way
/// costs nothing, may decide alone.
constexpr double kLeastRatio = 0.05;

}  // namespace

ComparedSteps::ComparedSteps(const CostAtStep& plain, double target, double samples) {
  for (double step = target;; step = step == 0 ? kFirstLossy : kStepsApart * step) {
    const PlaneCost cost = plain(step);
    if (!plain_.empty() && cost.bits < kLeastPrefixBits * samples) return;
    plain_.push_back({step, cost.bits, cost.joint(step)});
  }
}

double ComparedSteps::ratio(const CostAtStep& way, double more_bits) const {
  const double target = logRatio(plain_.front(), way, more_bits);
  if (plain_.size() == 1) return portable::exp(target);
  double prefixes = 0;
  for (size_t i = 1; i < plain_.size(); ++i) prefixes += logRatio(plain_[i], way, more_bits);
  return portable::exp((target + prefixes / static_cast<double>(plain_.size() - 1)) / 2);
}

double ComparedSteps::ratioAtTarget(const CostAtStep& way, double more_bits) const {
  return portable::exp(logRatio(plain_.front(), way, more_bits));
}

double ComparedSteps::logRatio(const Plain& plain, const CostAtStep& way, double more_bits) {
  const double change = way(plain.step).joint(plain.step) + more_bits - plain.joint;
  return portable::log(std::max(1 + change / plain.bits, kLeastRatio));
}

}  // namespace tetrakis::inline choice
