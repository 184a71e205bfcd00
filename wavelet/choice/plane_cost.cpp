// SPDX-License-Identifier: Apache-2.0
#include "wavelet/choice/plane_cost.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace tetrakis::inline choice {

namespace {

uint32_t magnitudeOf(int32_t value) {
  return static_cast<uint32_t>(value < 0 ? -int64_t{value} : int64_t{value});
}

/// In large bands the first kStrip of every kPeriod rows tell what all rows cost.
constexpr uint32_t kLargeRows = 256, kPeriod = 64, kStrip = 16;

/// Calls take(row, marks) for the coefficients of a subband's rows; marks: 1 for those that are
/// coded. Returns for how many rows each one stands.
template <class Take>
double forEachRow(const PlaneLayout& layout, size_t index, std::span<const int32_t> coefficients,
                  const Take& take) {
  const Pyramid& pyramid = layout.pyramid();
  const Subband& band = layout.subbands()[index];
  std::vector<uint8_t> coded(band.width, 1);
  uint32_t rows = 0;
  for (uint32_t y = 0; y < band.height; ++y) {
    if (band.height >= kLargeRows && y % kPeriod >= kStrip) continue;
    ++rows;
    const size_t line = size_t{band.planeRow(y)} * pyramid.plane().width;
    if (!pyramid.valid().all()) {
      const uint8_t* const valid = pyramid.valid().from(line);
      for (uint32_t x = 0; x < band.width; ++x) coded[x] = valid[band.sampleColumn(x)];
    }
    if (!pyramid.held().none()) {
      const bool all = pyramid.valid().all();
      const uint16_t* const numbers = pyramid.held().numbers.data() + line;
      for (uint32_t x = 0; x < band.width; ++x)
        coded[x] =
            static_cast<uint8_t>((all || coded[x] != 0) && numbers[band.sampleColumn(x)] == 0);
    }
    take(coefficients.subspan(pyramid.indexOf(band, y), band.width), coded);
  }
  return static_cast<double>(band.height) / std::max(rows, 1u);
}

/// Counts numbers of bits by the magnitudes of the neighbours.
class BitCounts {
 public:
  void count(uint32_t neighbours, int bits) {
    const auto context = std::min(static_cast<size_t>(std::bit_width(neighbours)), kContexts - 1);
    ++counts_[context][static_cast<size_t>(bits)];
  }
  double entropy() const {
    double bits = 0;
    for (const auto& row : counts_) {
      const double sum = std::accumulate(row.begin(), row.end(), 0.0);
      if (sum == 0) continue;
      for (const uint32_t n : row) {
        if (n > 0) bits += n * std::log2(sum / n);
      }
    }
    return bits;
  }

 private:
  static constexpr size_t kContexts = 16;
  std::array<std::array<uint32_t, 33>, kContexts> counts_{};
};

/// Quantises one band, coefficient by coefficient.
class BandCost {
 public:
  BandCost(uint32_t width, double step, double weight)
      : lossless_(step == 0), step_(step == 0 ? 1 : step), per_step_(1 / step_), weight_(weight) {
    above_.resize(width + 2);
    row_.resize(width + 2);
  }

  void take(std::span<const int32_t> values, const std::vector<uint8_t>& coded, PlaneCost& cost) {
    for (size_t x = 0; x < values.size(); ++x) {
      row_[x + 1] = 0;
      if (coded[x] == 0) continue;
      const uint32_t magnitude = magnitudeOf(values[x]);
      const uint32_t level =
          lossless_ ? magnitude : static_cast<uint32_t>(static_cast<double>(magnitude) * per_step_);
      const int bits = static_cast<int>(std::bit_width(level));
      const uint64_t around = 2 * (uint64_t{row_[x]} + above_[x + 1]) + above_[x] + above_[x + 2];
      counts_.count(static_cast<uint32_t>(std::min<uint64_t>(around, UINT32_MAX)), bits);
      cost.bits += bits;  // the sign, and those below the highest
      row_[x + 1] = level;
      if (lossless_) continue;
      const double error =
          static_cast<double>(magnitude) - (level == 0 ? 0 : (level + 0.5) * step_);
      cost.squares += weight_ * error * error;
    }
    std::swap(row_, above_);
  }
  double entropy() const { return counts_.entropy(); }

 private:
  bool lossless_;
  double step_, per_step_, weight_;
  std::vector<uint32_t> above_, row_;
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
    PlaneCost taken;
    const double each =
        forEachRow(layout, i, coefficients,
                   [&](const auto& row, const auto& coded) { band.take(row, coded, taken); });
    cost.bits += each * (taken.bits + band.entropy());
    cost.squares += each * taken.squares;
  }
  return cost;
}

}  // namespace tetrakis::inline choice
