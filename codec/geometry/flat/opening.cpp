// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/opening.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace tetrakis::inline flat {

namespace {

/// A sample becomes 1 if enough of the samples are marked that lie at most so far from it along a
/// row or column: all of them, or any.
enum class Enough : uint8_t { kAll, kAny };

bool areEnough(uint32_t marked, uint32_t all, Enough enough) {
  return marked >= (enough == Enough::kAll ? all : 1);
}

class Slide {
 public:
  Slide(std::vector<uint8_t>& marks, Extent plane, uint32_t reach, Enough enough)
      : marks_(marks), plane_(plane), reach_(reach), enough_(enough) {}

  void rows() {
    std::vector<uint32_t> before(plane_.width + 1);  // how many are marked before each sample
    for (uint32_t y = 0; y < plane_.height; ++y) {
      uint8_t* const row = marks_.data() + rowAt(y);
      for (uint32_t x = 0; x < plane_.width; ++x) before[x + 1] = before[x] + row[x];
      for (uint32_t x = 0; x < plane_.width; ++x) {
        const auto [from, end] = around(x, plane_.width);
        row[x] = areEnough(before[end] - before[from], end - from, enough_);
      }
    }
  }

  /// Row by row, because the samples of a column lie far apart.
  void columns() {
    const std::vector<uint8_t> given = marks_;
    std::vector<uint32_t> marked(plane_.width);  // around the sample of each column
    uint32_t first = 0, next = 0;                // rows that are counted
    for (uint32_t y = 0; y < plane_.height; ++y) {
      const auto [from, end] = around(y, plane_.height);
      for (; next < end; ++next) {
        const uint8_t* const come = given.data() + rowAt(next);
        for (uint32_t x = 0; x < plane_.width; ++x) marked[x] += come[x];
      }
      for (; first < from; ++first) {
        const uint8_t* const go = given.data() + rowAt(first);
        for (uint32_t x = 0; x < plane_.width; ++x) marked[x] -= go[x];
      }
      uint8_t* const row = marks_.data() + rowAt(y);
      for (uint32_t x = 0; x < plane_.width; ++x)
        row[x] = areEnough(marked[x], end - from, enough_);
    }
  }

 private:
  std::pair<uint32_t, uint32_t> around(uint32_t i, uint32_t length) const {
    return {i - std::min(i, reach_), i + std::min(length - i, reach_ + 1)};
  }
  size_t rowAt(uint32_t y) const { return size_t{y} * plane_.width; }

  std::vector<uint8_t>& marks_;
  Extent plane_;
  uint32_t reach_;
  Enough enough_;
};

void slide(std::vector<uint8_t>& marks, Extent plane, uint32_t reach, Enough enough) {
  Slide lines(marks, plane, reach, enough);
  lines.rows();
  lines.columns();
}

}  // namespace

void openMask(std::vector<uint8_t>& marks, Extent plane, uint32_t reach) {
  assert(marks.size() == plane.samples());
  slide(marks, plane, reach, Enough::kAll);
  slide(marks, plane, reach, Enough::kAny);
}

}  // namespace tetrakis::inline flat
