// SPDX-License-Identifier: Apache-2.0
// A view says which samples of a plane a caller wants: all of them, every 2^level-th one in both
// directions, or those in a rectangle. Every decoder takes one.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline base {

/// A rectangle of samples, which lies inside a plane and holds at least one sample.
struct Window {
  uint32_t x = 0, y = 0, width = 0, height = 0;

  Extent extent() const { return {width, height}; }
  bool isInside(Extent plane) const {
    return width > 0 && height > 0 && width <= plane.width && height <= plane.height &&
           x <= plane.width - width && y <= plane.height - height;
  }
  /// Whether the two have a sample in common.
  bool meets(const Window& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
           other.y < y + height;
  }
  bool operator==(const Window&) const = default;
};

/// The default view shows the whole plane.
struct View {
  int level = 0;                 ///< the samples at multiples of 2^level in x and y are shown
  std::optional<Window> window;  ///< of these only those in the window, in numbers of them
  uint32_t frame = 0;            ///< of a component in frames, the one that is shown
  uint32_t patch_rows = 0;       ///< of patches that lie one below the other, each of which has
                                 ///< levels of its own; 0: the plane is one patch

  bool isWhole() const { return level == 0 && !window; }
  /// How many samples of a plane of that size are shown.
  Extent extentIn(Extent plane) const {
    assert(!window || window->isInside(View{level, {}, 0, patch_rows}.extentIn(plane)));
    if (window) return window->extent();
    const uint32_t of_patch = patch_rows > 0 ? patch_rows : plane.height;
    return {shownOf(plane.width), plane.height / of_patch * shownOf(of_patch)};
  }
  /// The column and the row of the plane that the first shown sample lies in.
  uint32_t firstColumn() const { return window ? window->x << level : 0; }
  uint32_t firstRow() const { return rowOf(0); }
  /// The row of the plane that a shown row lies in.
  uint32_t rowOf(uint32_t shown) const {
    if (window) shown += window->y;
    if (level == 0 || patch_rows == 0) return shown << level;
    const uint32_t of_patch = shownOf(patch_rows);
    return shown / of_patch * patch_rows + (shown % of_patch << level);
  }
  /// The distance between shown samples in the plane.
  uint32_t step() const { return uint32_t{1} << level; }

 private:
  /// How many of so many samples in a line are shown, without a window.
  uint32_t shownOf(uint32_t samples) const { return ((samples - 1) >> level) + 1; }
};

/// What a decoder may use, beside what it decodes. Memory is a type of the decoder.
template <class Memory>
struct DecodeContext {
  uint32_t threads = 1;      ///< at most so many threads run at a time; 0 counts as 1
  Memory* memory = nullptr;  ///< what earlier calls with a shorter codeword have left; null: none
};

/// Copies the values that a view shows. A plane without values stays empty: masks without bytes
/// mark every sample of a view as well.
template <class T>
std::vector<T> slice(std::span<const T> values, Extent plane, const View& view) {
  std::vector<T> shown;
  if (values.empty()) return shown;
  assert(values.size() == plane.samples());
  const Extent extent = view.extentIn(plane);
  shown.reserve(extent.samples());
  for (uint32_t y = 0; y < extent.height; ++y) {
    const T* row = values.data() + size_t{view.rowOf(y)} * plane.width + view.firstColumn();
    if (view.level == 0) {
      shown.insert(shown.end(), row, row + extent.width);
      continue;
    }
    for (uint32_t x = 0; x < extent.width; ++x) shown.push_back(row[size_t{x} << view.level]);
  }
  return shown;
}

/// The values of a window: copied, unless it shows the whole plane, which outlives this.
template <class T>
class WindowValues {
 public:
  WindowValues(std::span<const T> values, Extent plane, const Window& window) : values_(values) {
    if (values.empty() || window.extent() == plane) return;
    copy_ = slice(values, plane, {0, window});
    values_ = copy_;
  }
  WindowValues(const WindowValues&) = delete;
  WindowValues& operator=(const WindowValues&) = delete;

  std::span<const T> values() const { return values_; }

 private:
  std::vector<T> copy_;
  std::span<const T> values_;
};

}  // namespace tetrakis::inline base
