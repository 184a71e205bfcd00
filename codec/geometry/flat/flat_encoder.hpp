// SPDX-License-Identifier: Apache-2.0
// Finds flat areas, and codes them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "codec/geometry/flat/flat_areas.hpp"

namespace tetrakis::inline flat {

/// Which samples of areas are wanted.
struct FlatShape {
  uint32_t least;      ///< samples of an area, at least
  uint32_t reach = 0;  ///< > 0: opened by squares of that reach (codec/geometry/flat/opening.hpp)
};

/// The areas of one height in a plane, of any size.
class FlatFinder {
 public:
  /// heights: their values outlive this.
  explicit FlatFinder(const PlaneView<const int32_t>& heights);

  Extent extent() const { return heights_.extent(); }

  /// Samples in a window of areas of at least so many.
  uint64_t samplesOf(uint32_t least, const Window& window) const;

  /// What a window shows of areas of that shape, without the samples that touch larger ones of
  /// another height. None if it shows no such area, or too many.
  FlatAreas areas(const FlatShape& shape, const Window& window) const;

 private:
  std::vector<uint8_t> marked(uint32_t least, const Window& window) const;
  bool none() const { return first_.empty(); }
  uint32_t sizeAt(size_t sample) const { return sizes_[first_[sample]]; }

  PlaneView<const int32_t> heights_;
  std::vector<uint32_t> first_;  ///< of each sample: the first one of its area
  std::vector<uint32_t> sizes_;  ///< of each area, at its first sample
};

/// valid: the samples that are not void. There are areas.
std::vector<uint8_t> encodeFlatAreas(const FlatAreas& areas, Extent plane, Mask valid);

}  // namespace tetrakis::inline flat
