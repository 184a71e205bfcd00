// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/opening.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace tetrakis::inline flat {

namespace {

/// Samples of one row or column.
struct Line {
  size_t first, pitch;
  uint32_t length;
};

/// A sample becomes 1 if enough of the samples are marked that lie at most so far from it along the
/// line: all of them, or any.
enum class Enough : uint8_t { kAll, kAny };

class Slide {
 public:
  Slide(uint32_t reach, Enough enough) : reach_(reach), enough_(enough) {}

  void run(std::vector<uint8_t>& marks, const Line& line) {
    before_.assign(1, 0);  // how many are marked before each sample
    for (uint32_t i = 0; i < line.length; ++i)
      before_.push_back(before_.back() + marks[line.first + i * line.pitch]);
    for (uint32_t i = 0; i < line.length; ++i) {
      const uint32_t from = i - std::min(i, reach_);
      const uint32_t end = i + std::min(line.length - i, reach_ + 1);
      const uint32_t marked = before_[end] - before_[from];
      const uint32_t wanted = enough_ == Enough::kAll ? end - from : 1;
      marks[line.first + i * line.pitch] = marked >= wanted;
    }
  }

 private:
  uint32_t reach_;
  Enough enough_;
  std::vector<uint32_t> before_;
};

void slide(std::vector<uint8_t>& marks, Extent plane, uint32_t reach, Enough enough) {
  Slide lines(reach, enough);
  for (uint32_t y = 0; y < plane.height; ++y)
    lines.run(marks, {size_t{y} * plane.width, 1, plane.width});
  for (uint32_t x = 0; x < plane.width; ++x) lines.run(marks, {x, plane.width, plane.height});
}

}  // namespace

void openMask(std::vector<uint8_t>& marks, Extent plane, uint32_t reach) {
  assert(marks.size() == plane.samples());
  slide(marks, plane, reach, Enough::kAll);
  slide(marks, plane, reach, Enough::kAny);
}

}  // namespace tetrakis::inline flat
