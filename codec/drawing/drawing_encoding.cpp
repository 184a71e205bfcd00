// SPDX-License-Identifier: Apache-2.0
// A sample is like the one before it, or else like the one above it, or else it is alone. The
// estimate is the entropy of these three, beside which of the samples around are alike, and of the
// values of those that are alone, or of their differences to the ones before them.
#include "codec/drawing/drawing_encoding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/portable_math.hpp"

namespace tetrakis::inline drawing {

namespace {

/// Values of samples that are like none around that are told apart. With fewer, wide terrain would
/// seem to take few bits; more of them take memory.
constexpr size_t kAlones = 1 << 14;
/// Samples whose rows stand for a large plane, about. More of them tell its bits more exactly, and
/// take time.
constexpr size_t kSamplesOfAll = size_t{1} << 19;

/// Bits of so many decisions, each coded as often as it occurs.
double entropyOf(std::span<const uint32_t> counts) {
  double all = 0, bits = 0;
  for (const uint32_t count : counts) all += count;
  for (const uint32_t count : counts) {
    if (count > 0) bits += count * portable::log2(all / count);
  }
  return bits;
}

template <class Value>
class Tally {
 public:
  explicit Tally(Alone alone) : alone_(alone) {}

  /// The samples of a row from the third to the last but one. above: the row before.
  void add(const Value* above, const Value* row, const uint8_t* valid, uint32_t width) {
    for (uint32_t x = 2; x + 1 < width; ++x) {
      if (valid != nullptr && valid[x] == 0) continue;
      const Value value = row[x], west = row[x - 1], north = above[x];
      const size_t context = size_t{west == above[x - 1]} + 2 * size_t{above[x - 1] == north} +
                             4 * size_t{north == above[x + 1]} + 8 * size_t{row[x - 2] == west};
      const size_t kind = value == west ? 0 : value == north ? 1 : 2;
      ++kinds_[context][kind];
      if (kind < 2) continue;
      const uint32_t from = alone_ == Alone::kDifference ? static_cast<uint32_t>(west) : 0;
      ++alones_[(static_cast<uint32_t>(value) - from) % kAlones];
    }
  }

  double bits() const {
    double bits = entropyOf(alones_);
    for (const auto& counts : kinds_) bits += entropyOf(counts);
    return bits;
  }

 private:
  std::array<std::array<uint32_t, 3>, 16> kinds_{};
  std::vector<uint32_t> alones_ = std::vector<uint32_t>(kAlones);
  Alone alone_;
};

}  // namespace

/// Some rows of a large plane stand for all of them.
template <class Value>
double estimateDrawing(const PlaneView<const Value>& samples, Alone alone) {
  const auto between = static_cast<uint32_t>(1 + samples.extent().samples() / kSamplesOfAll);
  Tally<Value> tally(alone);
  uint32_t rows = 0;
  for (uint32_t y = 1; y < samples.height; y += between, ++rows) {
    const uint8_t* valid =
        samples.valid.all() ? nullptr : samples.valid.from(size_t{y} * samples.width);
    tally.add(samples.row(y - 1), samples.row(y), valid, samples.width);
  }
  return tally.bits() / 8 * samples.height / std::max<uint32_t>(rows, 1);
}

template double estimateDrawing(const PlaneView<const int32_t>&, Alone);
template double estimateDrawing(const PlaneView<const uint16_t>&, Alone);

}  // namespace tetrakis::inline drawing
