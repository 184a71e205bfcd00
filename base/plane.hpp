// SPDX-License-Identifier: Apache-2.0
// A plane is a rectangle of samples, stored row by row. Extent, PlaneView and Mask describe planes
// that somebody else owns: their size, their values, and which of their samples are marked.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tetrakis::inline base {

/// The size of a plane, in samples.
struct Extent {
  uint32_t width = 0, height = 0;

  size_t samples() const { return size_t{width} * height; }
  bool operator==(const Extent&) const = default;
};

/// A mask marks samples of a plane: it holds one byte a sample, row by row, which is 1 where the
/// sample is marked and 0 elsewhere. A mask is named for what it marks (valid, seen, coded). A mask
/// without bytes marks every sample. The bytes belong to somebody else, who keeps them alive.
class Mask {
 public:
  Mask() = default;
  Mask(std::span<const uint8_t> marks) : marks_(marks) {}
  Mask(const std::vector<uint8_t>& marks) : marks_(marks) {}

  /// True if there are no bytes, so that every sample is marked.
  bool all() const { return marks_.empty(); }
  /// True if the sample is marked.
  bool operator[](size_t sample) const { return marks_.empty() || marks_[sample] != 0; }

  /// The bytes themselves; none if every sample is marked.
  std::span<const uint8_t> bytes() const { return marks_; }
  /// The bytes from one sample on. Only for masks that have bytes.
  const uint8_t* from(size_t sample) const {
    assert(sample <= marks_.size() && !all());
    return marks_.data() + sample;
  }

 private:
  std::span<const uint8_t> marks_;
};

/// The values of a plane and the mask of those that exist. Values that do not exist may be anything
/// unless a function says otherwise. The view owns nothing and is cheap to copy.
template <class T>
struct PlaneView {
  T* data = nullptr;
  uint32_t width = 0, height = 0;
  Mask valid;
  uint32_t patch_rows = 0;  ///< of each patch, in the raster of a forest; 0: it is one plane

  PlaneView() = default;
  PlaneView(const PlaneView&) = default;
  PlaneView& operator=(const PlaneView&) = default;
  /// There are width * height values, and as many bytes in the mask if it has any.
  PlaneView(std::span<T> values, Extent extent, Mask mask = {})
      : data(values.data()), width(extent.width), height(extent.height), valid(mask) {
    assert(values.size() == extent.samples());
    assert(mask.all() || mask.bytes().size() == extent.samples());
  }
  /// A plane that may be written is also one that may be read.
  PlaneView(const PlaneView<std::remove_const_t<T>>& other) requires std::is_const_v<T>
      : data(other.data),
        width(other.width),
        height(other.height),
        valid(other.valid),
        patch_rows(other.patch_rows) {}

  Extent extent() const { return {width, height}; }
  std::span<T> values() const { return {data, extent().samples()}; }
  T* row(uint32_t y) const {
    assert(y < height);
    return data + size_t{y} * width;
  }
};

/// Sets the values to 0 that the mask does not mark.
template <class T>
void clearUnmarked(std::span<T> values, Mask mask) {
  if (mask.all()) return;
  assert(mask.bytes().size() == values.size());
  const uint8_t* marks = mask.from(0);
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<T>(values[i] * marks[i]);
}

}  // namespace tetrakis::inline base
