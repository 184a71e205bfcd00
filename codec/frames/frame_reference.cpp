// SPDX-License-Identifier: Apache-2.0
#include "codec/frames/frame_reference.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace tetrakis::inline frames {

namespace {

int32_t wrappedSum(int32_t a, uint32_t b) {
  return static_cast<int32_t>(static_cast<uint32_t>(a) + b);
}

/// A sum of weighted values, and that of the weights.
struct Weighted {
  int64_t sum = 0, weights = 0;

  void add(int32_t value, size_t distance) {
    constexpr size_t kNear = 65536;
    const auto weight = static_cast<int64_t>(std::max<size_t>(kNear / distance, 1));
    sum += weight * value;
    weights += weight;
  }
  /// Rounded; halves upwards.
  int32_t mean() const {
    const int64_t twice = 2 * sum + weights, whole = twice / (2 * weights);
    return static_cast<int32_t>(whole - (twice % (2 * weights) < 0 ? 1 : 0));
  }
};

/// Passes along a line of a plane, and adds its last value to each sample behind it that has none.
class Line {
 public:
  Line(const std::vector<int32_t>& values, const std::vector<uint8_t>& valid,
       std::vector<Weighted>& means)
      : values_(values), valid_(valid), means_(means) {}

  /// count samples from `first` on, `step` apart.
  void pass(size_t first, ptrdiff_t step, size_t count) const {
    bool met = false;
    int32_t last = 0;
    size_t distance = 0;
    size_t at = first;
    for (size_t k = 0; k < count; ++k, at += static_cast<size_t>(step)) {
      ++distance;
      if (valid_[at] != 0) {
        met = true;
        last = values_[at];
        distance = 0;
      } else if (met) {
        means_[at].add(last, distance);
      }
    }
  }

 private:
  const std::vector<int32_t>& values_;
  const std::vector<uint8_t>& valid_;
  std::vector<Weighted>& means_;
};

/// Gives samples a value that have one in their row or in their column.
void fillOnce(std::vector<int32_t>& values, std::vector<uint8_t>& valid, Extent extent) {
  const size_t width = extent.width, height = extent.height;
  std::vector<Weighted> means(values.size());
  const Line line(values, valid, means);
  const auto down = static_cast<ptrdiff_t>(width);
  for (size_t y = 0; y < height; ++y) {
    line.pass(y * width, 1, width);
    line.pass(y * width + width - 1, -1, width);
  }
  for (size_t x = 0; x < width; ++x) {
    line.pass(x, down, height);
    line.pass((height - 1) * width + x, -down, height);
  }
  for (size_t i = 0; i < values.size(); ++i) {
    if (valid[i] != 0 || means[i].weights == 0) continue;
    values[i] = means[i].mean();
    valid[i] = 1;
  }
}

}  // namespace

std::vector<int32_t> wholeSteps(std::span<const int32_t> values, int fraction_bits) {
  std::vector<int32_t> whole(values.begin(), values.end());
  if (fraction_bits == 0) return whole;
  const int64_t half = int64_t{1} << (fraction_bits - 1);
  for (int32_t& value : whole) value = static_cast<int32_t>((value + half) >> fraction_bits);
  return whole;
}

std::vector<int32_t> filledReference(std::vector<int32_t> values, std::vector<uint8_t> valid,
                                     Extent extent) {
  assert(values.size() == extent.samples() && (valid.empty() || valid.size() == values.size()));
  if (valid.empty()) return values;
  for (size_t i = 0; i < values.size(); ++i)
    if (valid[i] == 0) values[i] = 0;
  // Behind the first pass a row that has a value has them all.
  for (int pass = 0; pass < 2; ++pass) fillOnce(values, valid, extent);
  return values;
}

void addReference(std::span<const int32_t> reference, Extent plane, const View& view,
                  int fraction_bits, std::span<int32_t> values) {
  const std::vector<int32_t> shown = slice(reference, plane, view);
  assert(shown.size() == values.size());
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = wrappedSum(values[i], static_cast<uint32_t>(shown[i]) << fraction_bits);
}

void takeReference(std::span<const int32_t> reference, int fraction_bits,
                   std::span<int32_t> values) {
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = wrappedSum(values[i], 0u - (static_cast<uint32_t>(reference[i]) << fraction_bits));
}

}  // namespace tetrakis::inline frames
