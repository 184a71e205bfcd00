// SPDX-License-Identifier: Apache-2.0
// SampleMarks says which samples of a plane exist: all, those of a BitPlane, or, for a view of a
// plane that is too large for that, those of LevelMarks: at the multiples of 8^g, for all g from
// some G on, within rectangles that grow as the samples grow sparse. A transform that makes a
// window, or a level of 3 G or more, reads no others.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/view.hpp"

namespace tetrakis::inline base {

/// The marks of the samples at multiples of 8^g within a rectangle.
struct LevelMarks {
  Window samples;  ///< the rectangle, in numbers of these samples
  BitPlane marks;  ///< of its extent
};

class SampleMarks {
 public:
  static constexpr int kLevelLog2 = 3;  ///< from the samples of one LevelMarks to those of the next

  /// All samples exist.
  SampleMarks() = default;
  /// null: all exist.
  SampleMarks(SharedBits whole) : whole_(std::move(whole)) {}
  /// From g = first on.
  SampleMarks(std::vector<LevelMarks> levels, int first)
      : levels_(std::make_shared<const std::vector<LevelMarks>>(std::move(levels))),
        first_(first) {}

  bool allExist() const { return whole_ == nullptr && levels_ == nullptr; }
  /// Of a whole plane; null: all exist.
  const SharedBits& whole() const {
    assert(levels_ == nullptr);
    return whole_;
  }

  /// split: the sample belongs to what so many levels of splitting leave.
  bool at(int split, uint32_t x, uint32_t y) const {
    if (levels_ == nullptr) return whole_->at(x, y);
    const auto [shift, marks] = levelOf(split);
    const uint32_t column = (x >> shift) - marks.samples.x, row = (y >> shift) - marks.samples.y;
    assert(column < marks.samples.width && row < marks.samples.height);
    return marks.marks.at(column, row);
  }
  /// 32 of these samples of a row that lie 2^log2 apart, from x on; 0 behind the end.
  uint32_t every(int split, int log2, uint32_t x, uint32_t y) const {
    if (levels_ == nullptr) return whole_->every(log2, x, y);
    const auto [shift, marks] = levelOf(split);
    const uint32_t column = (x >> shift) - marks.samples.x, row = (y >> shift) - marks.samples.y;
    if (column >= marks.samples.width || row >= marks.samples.height) return 0;
    return marks.marks.every(log2 - shift, column, row);
  }
  /// Those that a view shows, a byte each; empty: all exist.
  std::vector<uint8_t> shown(const View& view) const {
    if (levels_ == nullptr) return shownMarks(whole_, view);
    const LevelMarks& finest = levels_->front();
    View here{view.level - kLevelLog2 * first_, view.window};
    if (here.window) {  // of samples that are 2^level apart, as the first one is from 0
      here.window->x -= finest.samples.x >> here.level;
      here.window->y -= finest.samples.y >> here.level;
    }
    return finest.marks.bytes(here);
  }

 private:
  struct Found {
    int shift;
    const LevelMarks& marks;
  };
  Found levelOf(int split) const {
    const int last = static_cast<int>(levels_->size()) - 1;
    const int level = std::min(split / kLevelLog2 - first_, last);
    assert(level >= 0);
    return {kLevelLog2 * (first_ + level), (*levels_)[static_cast<size_t>(level)]};
  }

  SharedBits whole_;
  std::shared_ptr<const std::vector<LevelMarks>> levels_;
  int first_ = 0;
};

}  // namespace tetrakis::inline base
