// SPDX-License-Identifier: Apache-2.0
// A sample is like the one before it, or else like the one above it, or else it is alone. The
// estimate is the entropy of these three, beside which of the samples around are alike, and of the
// differences of those that are alone to the ones before them.
#include "codec/geometry/drawn_heights/drawing_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace tetrakis::inline drawn_heights {

namespace {

/// Bits of so many decisions, each coded as often as it occurs.
double entropyOf(std::span<const uint32_t> counts) {
  double all = 0, bits = 0;
  for (const uint32_t count : counts) all += count;
  for (const uint32_t count : counts) {
    if (count > 0) bits += count * std::log2(all / count);
  }
  return bits;
}

class Tally {
 public:
  /// The samples of a row from the third to the last but one. above: the row before.
  void add(const int32_t* above, const int32_t* row, const uint8_t* valid, uint32_t width) {
    for (uint32_t x = 2; x + 1 < width; ++x) {
      if (valid != nullptr && valid[x] == 0) continue;
      const int32_t step = row[x], west = row[x - 1], north = above[x];
      const size_t context = size_t{west == above[x - 1]} + 2 * size_t{above[x - 1] == north} +
                             4 * size_t{north == above[x + 1]} + 8 * size_t{row[x - 2] == west};
      const size_t kind = step == west ? 0 : step == north ? 1 : 2;
      ++kinds_[context][kind];
      if (kind < 2) continue;
      ++differences_[(static_cast<uint32_t>(step) - static_cast<uint32_t>(west)) % kDifferences];
    }
  }

  double bits() const {
    double bits = entropyOf(differences_);
    for (const auto& counts : kinds_) bits += entropyOf(counts);
    return bits;
  }

 private:
  static constexpr size_t kDifferences = 1 << 14;  // those of wide terrain, which takes many bits

  std::array<std::array<uint32_t, 3>, 16> kinds_{};
  std::vector<uint32_t> differences_ = std::vector<uint32_t>(kDifferences);
};

}  // namespace

/// Some rows of a large plane stand for all of them.
double estimateDrawing(const PlaneView<const int32_t>& heights) {
  constexpr size_t kSamples = size_t{1} << 19;
  const auto between = static_cast<uint32_t>(1 + heights.extent().samples() / kSamples);
  Tally tally;
  uint32_t rows = 0;
  for (uint32_t y = 1; y < heights.height; y += between, ++rows) {
    const uint8_t* valid =
        heights.valid.all() ? nullptr : heights.valid.from(size_t{y} * heights.width);
    tally.add(heights.row(y - 1), heights.row(y), valid, heights.width);
  }
  return tally.bits() / 8 * heights.height / std::max<uint32_t>(rows, 1);
}

}  // namespace tetrakis::inline drawn_heights
